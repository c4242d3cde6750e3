// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_TEST_RIGID_WEDGE_HPP
#define HARMOS_TEST_RIGID_WEDGE_HPP

#include "ReconstructScene.hpp"

#include <Harmos_Shape.hpp>

namespace Harmos::Testing
{

/// The sides of a wedge from its tip on: far points, counter-clockwise about it.
/// \param ahead Where the tip points. \param half_angle Of the wedge. [degrees]
inline std::vector<Vector2> wedgeSides(Vector2 const &tip, double ahead, double half_angle)
{
  constexpr double far = 30.0;
  return {tip + far * halfPlane(ahead + 180.0 - half_angle, tip).normal,
          tip + far * halfPlane(ahead + 180.0 + half_angle, tip).normal};
}

/// Corners of one rigid body's outline.
inline RigidCorners cornersOf(Mesh const &mesh, std::vector<Vector2> const &outline, int material)
{
  Shape const shape = Shape::polygon(outline);
  auto const x = onHost(mesh.node_position);
  auto const node = onHost(mesh.cell_node);
  std::vector<int> offset{0};
  std::vector<double> fraction;
  std::vector<OutlineCorner> corner;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
  {
    Quadrilateral const quad = hostQuadrilateral(x, node, cell);
    fraction.push_back(shape.intersectionMoments(quad, mesh.geometry).volume() / volume(quad, mesh.geometry));
    corner.push_back(outlineCorner(quad, mesh.geometry, shape, fraction.back()));
    offset.push_back(cell + 1);
  }
  return {deviceCopy("offset", offset), deviceCopy("material", std::vector<int>(mesh.num_cells, material)),
          deviceCopy("volume_fraction", fraction), deviceCopy("corner", corner)};
}

} // namespace Harmos::Testing

#endif
