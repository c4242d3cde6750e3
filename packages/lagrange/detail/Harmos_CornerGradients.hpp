// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_GRADIENTS_HPP
#define HARMOS_CORNER_GRADIENTS_HPP

#include <Harmos_Vector.hpp>
#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{
namespace detail
{

/// Gradients of a pair at the corners of its cell; hoop: N_I / r, planar zero. [1/length]
struct CornerGradients
{
  Vector2 of[4];
  double hoop[4];
};

/// Mean gradients of a cell's bilinear shape functions in the plane.
KOKKOS_INLINE_FUNCTION CornerGradients planeGradients(Mesh const &mesh, int cell)
{
  auto const b = meanGradient(cellCorners(mesh, cell));
  double const inverse = 1.0 / b.area;
  Vector2 const first{inverse * b.x0, inverse * b.y0}, second{inverse * b.x1, inverse * b.y1};
  return {{first, second, -1.0 * first, -1.0 * second}, {0.0, 0.0, 0.0, 0.0}};
}

/// The same in the mesh's geometry: about an axis the means over the ring.
KOKKOS_INLINE_FUNCTION CornerGradients cellGradients(Mesh const &mesh, int cell)
{
  if (mesh.geometry == Geometry::Planar)
    return planeGradients(mesh, cell);
  auto const b = ringGradient(cellCorners(mesh, cell));
  CornerGradients result;
  for (int k = 0; k < 4; ++k)
  {
    result.of[k] = {b.x[k] / b.volume, b.y[k] / b.volume};
    result.hoop[k] = b.hoop[k] / b.volume;
  }
  return result;
}

} // namespace detail
} // namespace Harmos

#endif
