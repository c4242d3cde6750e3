// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_BODY_AROUND_HPP
#define HARMOS_BODY_AROUND_HPP

#include <Harmos_CellComponents.hpp>
#include <Harmos_Clip.hpp>

namespace Harmos
{

/// What one body fills of a cell's vertex neighbours, to be compared with lines of the cell that are continued there.
/// Beyond a contact wall, where no body is, images of the cells along it stand for those that the mesh lacks.
class BodyAround
{
public:
  static constexpr int most_neighbours = 8;
  int count; // of the neighbours; others are not looked at

  HARMOS_LARGE_FUNCTION BodyAround(ReconstructionField const &field, CellComponents const &components, int body)
      : components_(components)
  {
    Rows const &neighbours = field.mesh.cell_neighbour;
    int const first = neighbours.offset(components.cell);
    all_ = neighbours.offset(components.cell + 1) - first;
    count = Math::min(most_neighbours, all_);
    for (int j = 0; j < count; ++j)
    {
      int const cell = neighbours.item(first + j);
      quad_[j] = unitQuadrilateral(field.mesh, components, cell);
      quad_volume_[j] = Harmos::volume(quad_[j], components.weight);
      fraction_[j] = setFraction(field, components, 1u << body, cell);
    }
    Quadrilateral const own = unitQuadrilateral(field.mesh, components, components.cell);
    for (int k = 0; k < 4; ++k)
    {
      if (!isContactWall(field, components.cell, k))
        continue;
      Plane2 wall = edgeLine(own[k], own[(k + 1) % 4]);
      wall.offset /= norm(wall.normal);
      wall.normal = normalised(wall.normal);
      int const inside = count;
      addImage(own, wall);
      for (int j = 0; j < inside; ++j)
        if (j + first < neighbours.offset(components.cell + 1) && isAtWall(field, neighbours.item(first + j)))
          addImage(quad_[j], wall);
    }
  }

  /// Whether some neighbour tells where an edge goes on: one that the body fills in part. A fragment within its cell
  /// has none, and one parameter would be free.
  KOKKOS_INLINE_FUNCTION bool isTold() const
  {
    constexpr double least_fraction = 1e-9;
    bool told = false;
    for (int j = 0; j < count; ++j)
      told = told || (fraction_[j] > least_fraction && fraction_[j] < 1.0 - least_fraction);
    return told;
  }

  /// Whether the neighbours can hold what lies beyond a corner in the cell. Two lines that leave it go on: between 40
  /// and 150 degrees they leave at least 0.36 of a cell and 2.9 times what is in the cell to eight square neighbours,
  /// and one of these empty at least. (Measured: 6,000 corners anywhere in the cell, for each of four angles.) A
  /// fragment ends before. On stretched cells, whose fractions are those of squares with another corner, the sum may be
  /// 0.2. Where there are not eight neighbours nothing is said.
  ///
  /// \param own What the body fills of the cell.
  KOKKOS_INLINE_FUNCTION bool goesOn(double own) const
  {
    constexpr double least_sum = 0.2, least_ratio = 2.0, least_fraction = 1e-9;
    double sum = 0.0;
    bool empty = false;
    for (int j = 0; j < count; ++j)
    {
      sum += fraction_[j];
      empty = empty || fraction_[j] < least_fraction;
    }
    return all_ != most_neighbours || (empty && sum > least_sum && sum > least_ratio * own);
  }

  /// Part of neighbour j behind all lines, less that which the body fills.
  KOKKOS_INLINE_FUNCTION double miss(int j, Plane2 const *line, int lines) const
  {
    return partBehind(j, line, lines) - fraction_[j];
  }

  /// The part of line l that lies in neighbour j, behind the other lines. \return Whether there is one.
  KOKKOS_INLINE_FUNCTION bool chordIn(int j, Plane2 const *line, int lines, int l, Vector2 &begin, Vector2 &end) const
  {
    Vector2 const from = line[l].offset * line[l].normal, along = perpendicular(line[l].normal);
    double low = -1e300, high = 1e300;
    auto const keepBehind = [&](Plane2 const &plane)
    {
      double const rise = dot(plane.normal, along), room = -plane.distance(from);
      if (rise > 0.0)
        high = Math::min(high, room / rise);
      else if (rise < 0.0)
        low = Math::max(low, room / rise);
      else if (room < 0.0)
        high = -1e300;
    };
    int behind = 0;
    for (int k = 0; k < 4; ++k)
      behind += line[l].distance(quad_[j][k]) <= 0.0 ? 1 : 0;
    if (behind == 0 || behind == 4)
      return false;
    for (int k = 0; k < 4; ++k)
      keepBehind(edgeLine(quad_[j][k], quad_[j][(k + 1) % 4]));
    for (int other = 0; other < lines; ++other)
      if (other != l)
        keepBehind(line[other]);
    begin = from + low * along;
    end = from + high * along;
    return low < high;
  }

  /// Volume of neighbour j.
  KOKKOS_INLINE_FUNCTION double volumeOf(int j) const { return quad_volume_[j]; }

private:
  /// An empty cell beyond a line, where this one is not beyond it, but along it.
  KOKKOS_INLINE_FUNCTION void addImage(Quadrilateral const &of, Plane2 const &line)
  {
    constexpr double along = 1e-6; // [cells]
    int on_line = 0;
    Quadrilateral image;
    for (int k = 4; k-- > 0;)
    {
      double const distance = line.distance(of[k]);
      on_line += Math::fabs(distance) < along ? 1 : 0;
      image.push(of[k] - (2.0 * distance) * line.normal);
    }
    double const size = Harmos::volume(image, components_.weight);
    if (on_line < 2 || count == most_neighbours || !(size > 0.0))
      return;
    quad_[count] = image;
    quad_volume_[count] = size;
    fraction_[count++] = 0.0;
    ++all_;
  }

  /// Part of neighbour j behind all lines.
  KOKKOS_INLINE_FUNCTION double partBehind(int j, Plane2 const *line, int lines) const
  {
    int crossed[3], count_crossed = 0;
    for (int l = 0; l < lines; ++l)
    {
      int behind = 0;
      for (int k = 0; k < 4; ++k)
        behind += dot(line[l].normal, quad_[j][k]) <= line[l].offset ? 1 : 0;
      if (behind == 0)
        return 0.0;
      if (behind < 4)
        crossed[count_crossed++] = l;
    }
    if (count_crossed == 0)
      return 1.0;
    Region part, next;
    clip(quad_[j], line[crossed[0]], part);
    for (int i = 1; i < count_crossed && !part.empty(); ++i)
    {
      clip(part, line[crossed[i]], next);
      part = next;
    }
    return part.empty() ? 0.0 : components_.volumeOfRegion(part) / quad_volume_[j];
  }

  CellComponents const &components_;
  int all_; // neighbours
  Quadrilateral quad_[most_neighbours];
  double quad_volume_[most_neighbours], fraction_[most_neighbours];
};

} // namespace Harmos

#endif
