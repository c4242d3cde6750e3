// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_OVERLAYS_HPP
#define HARMOS_OVERLAYS_HPP

#include <detail/Harmos_Donors.hpp>

#include <Harmos_Clip.hpp>
#include <Harmos_Moments.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Overlays below this part of the acceptor are dropped; their mass stays in the donor's residue.
constexpr double least_overlay = 1e-15;

/// Intersections of donors with acceptors: slot offset(donor) is the donor's own cell, offset(donor) + 1 + j the j-th
/// of its cell's vertex neighbours.
struct Overlays
{
  View<int *> offset;       // donors.num + 1
  View<double *[6]> moment; // 1, x, y, xx, xy, yy relative to the acceptor's corner 0; volume 0: no overlay

  /// The slot of a donor (of `cell`) in an acceptor, or -1.
  KOKKOS_INLINE_FUNCTION int find(Mesh const &mesh, int donor, int cell, int acceptor) const
  {
    if (cell == acceptor)
      return offset(donor);
    int const begin = mesh.cell_neighbour.offset(cell);
    for (int j = begin; j < mesh.cell_neighbour.offset(cell + 1); ++j)
      if (mesh.cell_neighbour.item(j) == acceptor)
        return offset(donor) + 1 + j - begin;
    return -1;
  }
};

KOKKOS_INLINE_FUNCTION Vector2 acceptorOrigin(Mesh const &mesh, int cell)
{
  int const node = mesh.cell_node(cell, 0);
  return {mesh.node_position(node, 0), mesh.node_position(node, 1)};
}

/// Moments of `polygon` inside a cell, relative to the cell's corner 0, which is subtracted before clipping.
template <int Capacity>
KOKKOS_INLINE_FUNCTION Moments<2> overlayMoments(Mesh const &mesh, int acceptor, Polygon<Capacity> const &polygon)
{
  Quadrilateral window = cellQuadrilateral(mesh, acceptor);
  Vector2 const origin = window[0];
  Vector2 low = window[0], high = window[0];
  for (int k = 1; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
    {
      low[d] = Math::min(low[d], window[k][d]);
      high[d] = Math::max(high[d], window[k][d]);
    }
  bool outside[4] = {true, true, true, true};
  Polygon<Capacity> local;
  for (int i = 0; i < polygon.size; ++i)
  {
    for (int d = 0; d < 2; ++d)
    {
      outside[d] = outside[d] && polygon[i][d] <= low[d];
      outside[2 + d] = outside[2 + d] && polygon[i][d] >= high[d];
    }
    local.push(polygon[i] - origin);
  }
  if (outside[0] || outside[1] || outside[2] || outside[3])
    return {};
  for (int k = 3; k >= 0; --k)
    window[k] -= origin;
  Polygon<2 * Capacity + 8> part; // a region that its motion bent may gain more than one vertex a cut
  clipConvex(local, window, part);
  return moments<2>(part, {0.0, 0.0});
}

/// Integrals of the donor's fields over one overlay.
///
/// With c the donor's centroid, c + e its mass centroid, V, S, T the overlay's moments about c:
/// mass = rho V + grad rho . S; integral of rho phi = phi mass + grad phi . (rho S + T grad rho - e mass); deviator:
/// s V + grad s . S.
/// \param out [DensityField]: mass; primitives and corner velocities: mass-weighted; deviator: volume-weighted.
KOKKOS_INLINE_FUNCTION void integrate(Donors const &donors, int donor, Moments<2> const &m, Vector2 const &origin,
                                      double out[num_stage_fields])
{
  Vector2 const c{donors.shape(donor, 1) - origin[0], donors.shape(donor, 2) - origin[1]};
  double const volume = m.volume();
  double const sx = m.first(0) - c[0] * volume;
  double const sy = m.first(1) - c[1] * volume;
  double const txx = m.second(0, 0) - c[0] * (m.first(0) + sx);
  double const txy = m.second(0, 1) - c[0] * m.first(1) - c[1] * sx;
  double const tyy = m.second(1, 1) - c[1] * (m.first(1) + sy);
  double const rho = donors.polynomial(donor, 0, 0);
  double const rx = donors.polynomial(donor, 0, 1);
  double const ry = donors.polynomial(donor, 0, 2);
  double const mass = rho * volume + (rx * sx + ry * sy);
  double const mx = rho * sx + (txx * rx + txy * ry) - donors.mass_offset(donor, 0) * mass;
  double const my = rho * sy + (txy * rx + tyy * ry) - donors.mass_offset(donor, 1) * mass;
  out[0] = mass;
  for (int f = 1; f < num_stage_fields; ++f)
  {
    bool const volume_weighted = byVolume(f);
    double const weight = volume_weighted ? volume : mass;
    double const x = volume_weighted ? sx : mx;
    double const y = volume_weighted ? sy : my;
    out[f] = donors.polynomial(donor, f, 0) * weight +
             (donors.polynomial(donor, f, 1) * x + donors.polynomial(donor, f, 2) * y);
  }
}

KOKKOS_INLINE_FUNCTION Moments<2> slotMoments(Overlays const &overlays, int slot)
{
  Moments<2> m;
  for (int i = 0; i < 6; ++i)
    m.value[i] = overlays.moment(slot, i);
  return m;
}

/// Intersect every moving donor with its own cell and the vertex neighbours. Whole donors overlap their own cell alone.
///
/// \param kind of donors without any overlay becomes DegenerateDonor.
Overlays intersect(Input const &in, Classes const &classes, Donors const &donors);

} // namespace RemapDetail
} // namespace Harmos

#endif
