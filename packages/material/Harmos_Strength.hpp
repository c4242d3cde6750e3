// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_STRENGTH_HPP
#define HARMOS_STRENGTH_HPP

#include <Harmos_FlowStress.hpp>

namespace Harmos
{

/// Stress deviator in plane strain: zz = -(xx + yy), xz = yz = 0. [Pa]
template <class T>
struct Deviator
{
  T xx, yy, xy;
};

/// J2 = s:s / 2 = xx^2 + yy^2 + xx yy + xy^2. [Pa^2]
template <class T>
KOKKOS_INLINE_FUNCTION T secondInvariant(Deviator<T> const &s)
{
  return s.xx * s.xx + s.yy * s.yy + s.xx * s.yy + s.xy * s.xy;
}

/// Turn a stress by a spin increment, w = dt (dv/dx - du/dy) / 2: s' = Q s Q^T.
///
/// Mid-point rule Q = (1 - W/2)^-1 (1 + W/2), an exact rotation by 2 atan(w/2), so that J2 stays whatever w.
/// Hughes & Winget, Int. J. Numer. Meth. Engng 15 (1980) 1862-1867.
template <class T>
KOKKOS_INLINE_FUNCTION Deviator<T> rotate(Deviator<T> const &s, T spin_increment)
{
  T const half = 0.5 * spin_increment;
  T const tan2 = half * half;
  T const inverse = 1.0 / (1.0 + tan2);
  T const cosine = (1.0 - tan2) * inverse;
  T const sine = (2.0 * half) * inverse;
  T const cosine2 = cosine * cosine - sine * sine; // of twice the angle
  T const sine2 = 2.0 * (cosine * sine);
  T const mean = 0.5 * (s.xx + s.yy);
  T const difference = 0.5 * (s.xx - s.yy);
  T const turned = cosine2 * difference - sine2 * s.xy;
  return {mean + turned, mean - turned, sine2 * difference + cosine2 * s.xy};
}

/// Flow stress of StrengthKind::Plastic, yield0 + hardening eps, not below zero. [Pa]
template <class T>
KOKKOS_INLINE_FUNCTION T yieldStress(Material const &material, T plastic_strain)
{
  return Math::max(T(material.yield + material.hardening * plastic_strain), T(0.0));
}

template <class T>
struct ReturnedStress
{
  Deviator<T> deviator;
  T plastic_strain_increment; // equivalent, >= 0
};

/// Bring a trial deviator back to the von Mises surface, sqrt(3 J2) <= Y(eps).
///
/// Elastic: unchanged. None: zero. Plastic: with q = sqrt(3 J2) of the trial, d_eps = (q - Y(eps)) / (3 G + H) where
/// positive, and s = (1 - 3 G d_eps / q) s_trial, which lies on Y(eps + d_eps) exactly for linear hardening.
/// Wilkins, Methods Comput. Phys. 3 (1964) 211-263; Simo & Hughes, Computational Inelasticity (1998), ch. 3.
template <class T>
KOKKOS_INLINE_FUNCTION ReturnedStress<T> radialReturn(Material const &material, Deviator<T> const &trial,
                                                      T plastic_strain)
{
  if (material.strength == StrengthKind::None)
    return {{T(0.0), T(0.0), T(0.0)}, T(0.0)};
  if (material.strength == StrengthKind::Elastic)
    return {trial, T(0.0)};
  T const yield = yieldStress(material, plastic_strain);
  T const squared = 3.0 * secondInvariant(trial);
  auto const yields = squared > yield * yield;
  if (!any(yields))
    return {trial, T(0.0)};
  T const q = Math::sqrt(select(yields, squared, T(1.0)));
  double const three_g = 3.0 * material.shear_modulus;
  T const increment = select(yields, (q - yield) * (1.0 / (three_g + material.hardening)), T(0.0));
  T const scale = select(yields, 1.0 - three_g * increment / q, T(1.0));
  return {{scale * trial.xx, scale * trial.yy, scale * trial.xy}, increment};
}

/// Strain increment in plane strain: zz = 0, xy the tensor component.
template <class T>
struct StrainIncrement
{
  T xx, yy, xy;
};

/// Elastic predictor: s + 2 G dev(strain). G: double or T.
template <class T, class Modulus>
KOKKOS_INLINE_FUNCTION Deviator<T> elasticTrial(Modulus const &shear_modulus, Deviator<T> const &s,
                                                StrainIncrement<T> const &strain)
{
  Modulus const two_g = 2.0 * shear_modulus;
  T const mean = (strain.xx + strain.yy) * (1.0 / 3.0);
  return {s.xx + two_g * (strain.xx - mean), s.yy + two_g * (strain.yy - mean), s.xy + two_g * strain.xy};
}

/// The same and back to the yield surface, for the laws of flowStress; G and f at the end of the step.
///
/// s = (1 - 3 G d_eps / q) s_trial, d_eps by plasticIncrement; neither deviator nor plastic strain where f = 0: the
/// flow of a melt hardens nothing.
template <class T>
HARMOS_RARE_FUNCTION ReturnedStress<T> flowDeviator(Material const &m, Deviator<T> turned, StrainIncrement<T> strain,
                                                    T plastic_strain, T specific_volume, T internal_energy, double dt)
{
  T const f = softeningAt(m, specific_volume, internal_energy);
  T const modulus = m.strength == StrengthKind::SteinbergGuinan ? T(m.shear_modulus * f) : T(m.shear_modulus);
  Deviator<T> const trial = elasticTrial(modulus, turned, strain);
  T const q = Math::sqrt(T(3.0 * secondInvariant(trial)));
  T const increment = Lanes<T>::of(
      [&](int lane)
      {
        return plasticIncrement(m, laneOf(q, lane), laneOf(plastic_strain, lane), dt, laneOf(f, lane),
                                laneOf(modulus, lane));
      });
  T const scale = select(increment > T(0.0), T(1.0 - 3.0 * modulus * increment / Math::max(q, T(1e-300))), T(1.0));
  auto const solid = f > T(0.0);
  T const kept = select(solid, scale, T(0.0));
  return {{kept * trial.xx, kept * trial.yy, kept * trial.xy}, select(solid, increment, T(0.0))};
}

/// The deviator and the plastic strain after a strain increment: elasticTrial and radialReturn, or flowDeviator.
///
/// \param turned The old deviator after rotate. \param specific_volume, internal_energy At the end of the step.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION ReturnedStress<T> strainedDeviator(Material const &material, Deviator<T> const &turned,
                                                               StrainIncrement<T> const &strain, T plastic_strain,
                                                               T specific_volume, T internal_energy, double dt)
{
  if (hasFlowLaw(material))
    return flowDeviator(material, turned, strain, plastic_strain, specific_volume, internal_energy, dt);
  return radialReturn(material, elasticTrial(material.shear_modulus, turned, strain), plastic_strain);
}

} // namespace Harmos

#endif
