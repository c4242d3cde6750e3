// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SLIP_MIRRORS_HPP
#define HARMOS_SLIP_MIRRORS_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_Pack.hpp>

namespace Harmos
{

/// What maps a plane on its mirror image: x -> x - sum over walls of 2 (n.x - offset) n, across one straight wall or
/// two that are at right angles. It is its own inverse.
struct MirrorImage
{
  int count; // of walls
  Vector2 normal[2];
  double offset[2];
  int face[2];           // of the cell from which they were found, towards them
  double from[2], to[2]; // ends of the wall along perpendicular(normal), as far as it was looked at [length]

  KOKKOS_INLINE_FUNCTION Vector2 direction(Vector2 v) const
  {
    for (int i = 0; i < count; ++i)
      v -= (2.0 * dot(v, normal[i])) * normal[i];
    return v;
  }

  KOKKOS_INLINE_FUNCTION Vector2 point(Vector2 x) const
  {
    for (int i = 0; i < count; ++i)
      x -= (2.0 * (dot(x, normal[i]) - offset[i])) * normal[i];
    return x;
  }

  /// Whether the walls are there beside a point (x, y), so that it has an image; of points in packs by lanes.
  template <class T>
  KOKKOS_INLINE_FUNCTION auto reflects(T const &x, T const &y) const
  {
    auto beside = x == x;
    for (int i = 0; i < count; ++i)
    {
      Vector2 const t = perpendicular(normal[i]);
      T const along = x * T(t[0]) + y * T(t[1]);
      beside = both(beside, both(T(from[i]) <= along, along <= T(to[i])));
    }
    return beside;
  }

  KOKKOS_INLINE_FUNCTION bool reflects(Vector2 const &x) const { return reflects(x[0], x[1]); }
};

/// \brief The mirrors around a cell: slip walls, which are planes of symmetry, and what two of them make at a corner.
///
/// A body that meets such a wall goes on beyond it as its mirror image. What looks at the cells around one finds them
/// there with these: the half of a symmetric scene then does what all of it does.
struct SlipMirrors
{
  static constexpr int most = 8;
  int count = 0;
  MirrorImage image[most];

  KOKKOS_DEFAULTED_FUNCTION SlipMirrors() = default; // none

  /// \param rows How many cells on walls are looked for, the cell's own row the first.
  KOKKOS_INLINE_FUNCTION SlipMirrors(Mesh const &mesh, View<Boundary *> const &boundary, int cell, int rows)
  {
    if (rows < 1 || boundary.extent(0) == 0)
      return;
    int found[4];
    MirrorImage single[4];
    for (int k = 0; k < 4; ++k)
      found[k] = findWall(mesh, boundary, cell, k, rows, single[k]) ? 1 : 0;
    for (int k = 0; k < 4; ++k)
      if (found[k] == 1)
        image[count++] = single[k];
    constexpr double round_off = 1e-9; // of a right angle
    for (int k = 0; k < 4; ++k)
    {
      int const next = (k + 1) % 4;
      if (found[k] == 0 || found[next] == 0 || Math::fabs(dot(single[k].normal[0], single[next].normal[0])) > round_off)
        continue;
      MirrorImage &both = image[count++];
      both = single[k];
      both.count = 2;
      both.face[1] = next;
      both.normal[1] = single[next].normal[0];
      both.offset[1] = single[next].offset[0];
      both.from[1] = single[next].from[0];
      both.to[1] = single[next].to[0];
    }
  }

  /// Whether a face of a cell is on a slip wall (none where no boundaries are given).
  static KOKKOS_INLINE_FUNCTION bool isSlip(Mesh const &mesh, View<Boundary *> const &boundary, int cell, int face)
  {
    int const number = boundary.extent(0) == 0 ? -1 : mesh.face_boundary(cell, face);
    return number >= 0 && boundary(number).kind == BoundaryKind::SlipWall;
  }

private:
  /// Straight from face k of a cell to a slip wall.
  static KOKKOS_INLINE_FUNCTION bool findWall(Mesh const &mesh, View<Boundary *> const &boundary, int cell, int k,
                                              int rows, MirrorImage &wall)
  {
    int const towards = k;
    for (int row = 1; row < rows && mesh.face_neighbour(cell, k) >= 0; ++row)
    {
      int const beyond = mesh.face_neighbour(cell, k);
      cell = beyond / 4;
      k = (beyond % 4 + 2) % 4;
    }
    if (mesh.face_neighbour(cell, k) >= 0 || !isSlip(mesh, boundary, cell, k))
      return false;
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    Vector2 const along = q[(k + 1) % 4] - q[k];
    double const length = norm(along);
    // divided, so that a normal along an axis is exactly that
    wall.count = 1;
    wall.face[0] = towards;
    wall.normal[0] = {along[1] / length, -along[0] / length};
    wall.offset[0] = dot(wall.normal[0], q[k]);
    wall.from[0] = dot(perpendicular(wall.normal[0]), q[k]);
    wall.to[0] = wall.from[0] + length;
    bool const bends_ahead = follow(mesh, boundary, cell, k, 1, wall);
    bool const bends_behind = follow(mesh, boundary, cell, k, 3, wall);
    // one face of an arc is no wall
    return !((bends_ahead || bends_behind) && !(wall.to[0] - wall.from[0] > 1.001 * length));
  }

  /// How far the wall goes on straight to one side of a cell on it.
  /// \param side 1: beyond the face behind the cell's face k, 3: beyond the one before it.
  /// \return Whether it ends in a bend.
  static KOKKOS_INLINE_FUNCTION bool follow(Mesh const &mesh, View<Boundary *> const &boundary, int cell, int k,
                                            int side, MirrorImage &wall)
  {
    constexpr int most_cells = 4;
    constexpr double straight = 1e-9; // [cells]
    int face = (k + side) % 4;
    for (int i = 0; i < most_cells; ++i)
    {
      int const beyond = mesh.face_neighbour(cell, face);
      if (beyond < 0)
        return false;
      cell = beyond / 4;
      int const on_wall = (beyond % 4 + side) % 4;
      face = (beyond % 4 + 2) % 4;
      if (mesh.face_neighbour(cell, on_wall) >= 0 || !isSlip(mesh, boundary, cell, on_wall))
        return false;
      Quadrilateral const q = cellQuadrilateral(mesh, cell);
      Vector2 const end = q[(on_wall + (side == 1 ? 1 : 0)) % 4];
      double const place = dot(perpendicular(wall.normal[0]), end);
      if (Math::fabs(dot(wall.normal[0], end) - wall.offset[0]) > straight * (wall.to[0] - wall.from[0]))
        return true;
      wall.from[0] = Math::min(wall.from[0], place);
      wall.to[0] = Math::max(wall.to[0], place);
    }
    return false;
  }
};

/// Whether a cell has a face on the wall of an image across one.
KOKKOS_INLINE_FUNCTION bool isOnWall(Mesh const &mesh, View<Boundary *> const &boundary, MirrorImage const &image,
                                     int cell)
{
  constexpr double straight = 1e-9; // [cells]
  for (int k = 0; k < 4; ++k)
  {
    if (mesh.face_neighbour(cell, k) >= 0 || !SlipMirrors::isSlip(mesh, boundary, cell, k))
      continue;
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    Vector2 const a = q[k], b = q[(k + 1) % 4];
    double const most = straight * norm(b - a);
    if (Math::fabs(dot(image.normal[0], a) - image.offset[0]) <= most &&
        Math::fabs(dot(image.normal[0], b) - image.offset[0]) <= most)
      return true;
  }
  return false;
}

/// visit(item, image) for the images of a cell and of its vertex neighbours that would be vertex neighbours of it were
/// the mesh to go on beyond slip walls: item of mesh.cell_neighbour, -1 for the cell's own image.
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forMirroredNeighbours(Mesh const &mesh, View<Boundary *> const &boundary, int cell,
                                                  Visitor const &visit)
{
  if (boundary.extent(0) == 0)
    return;
  if (mesh.face_boundary(cell, 0) < 0 && mesh.face_boundary(cell, 1) < 0 && mesh.face_boundary(cell, 2) < 0 &&
      mesh.face_boundary(cell, 3) < 0)
    return;
  SlipMirrors const mirrors(mesh, boundary, cell, 1);
  for (int i = 0; i < mirrors.count; ++i)
  {
    visit(-1, mirrors.image[i]);
    for (int j = mesh.cell_neighbour.offset(cell);
         mirrors.image[i].count == 1 && j < mesh.cell_neighbour.offset(cell + 1); ++j)
      if (isOnWall(mesh, boundary, mirrors.image[i], mesh.cell_neighbour.item(j)))
        visit(j, mirrors.image[i]);
  }
}

} // namespace Harmos

#endif
