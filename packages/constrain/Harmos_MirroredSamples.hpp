// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_MIRRORED_SAMPLES_HPP
#define HARMOS_MIRRORED_SAMPLES_HPP

#include <Harmos_NormalFit.hpp>
#include <Harmos_SlipMirrors.hpp>

namespace Harmos
{

/// What part of their weights images beyond each mirror have in the fit at a point (smoothnessAt); of two walls the
/// product.
/// \param samples Around the point, before any image is added. \param h Cell size [length].
KOKKOS_INLINE_FUNCTION void smoothParts(SlipMirrors const &mirrors, FitSamples const &samples, Vector2 const &point,
                                        double h, Vector2 const &along, double part[SlipMirrors::most])
{
  for (int i = 0; i < mirrors.count; ++i)
  {
    MirrorImage const &image = mirrors.image[i];
    part[i] = 1.0;
    for (int k = 0; k < image.count; ++k)
    {
      double const distance = (image.offset[k] - dot(point, image.normal[k])) / h;
      part[i] *= smoothnessAt(samples, image.normal[k], distance, along);
    }
  }
}

} // namespace Harmos

#endif
