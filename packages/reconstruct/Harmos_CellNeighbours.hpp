// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CELL_NEIGHBOURS_HPP
#define HARMOS_CELL_NEIGHBOURS_HPP

#include <Harmos_CellComponents.hpp>
#include <Harmos_Pack.hpp>

namespace Harmos
{

/// As many vertex neighbours of a cell as a pack has lanes, in the cell's unit coordinates.
struct NeighbourPack
{
  Pack x[4], y[4]; // corners
  Pack volume;
  Pack present; // 1, or 0 where there is no neighbour: such a lane repeats another one
};

/// The vertex neighbours of a cell, in packs in the order of its row. Those of usual cells are stored.
class CellNeighbours
{
public:
  static constexpr int stored_packs = numPacks(8);

  HARMOS_LARGE_FUNCTION CellNeighbours(ReconstructionField const &field, CellComponents const &components)
      : field_(field), components_(components), first_(field.mesh.cell_neighbour.offset(components.cell)),
        count_(field.mesh.cell_neighbour.offset(components.cell + 1) - first_)
  {
    for (int p = 0; p < Math::min(packs(), stored_packs); ++p)
      stored_[p] = gather(p);
  }

  KOKKOS_INLINE_FUNCTION int count() const { return count_; }
  KOKKOS_INLINE_FUNCTION AreaWeight const &weight() const { return components_.weight; }
  KOKKOS_INLINE_FUNCTION int packs() const { return numPacks(count_); }

  /// \param spare Takes a pack that is not stored.
  KOKKOS_INLINE_FUNCTION NeighbourPack const &pack(int p, NeighbourPack &spare) const
  {
    if (p < stored_packs)
      return stored_[p];
    spare = gather(p);
    return spare;
  }

  /// 1 for the neighbours of a pack, 0 in other lanes.
  KOKKOS_INLINE_FUNCTION Pack present(int p) const { return p < stored_packs ? stored_[p].present : gather(p).present; }

  /// Values of a function on cells; absent neighbours have 0.
  template <class Function>
  KOKKOS_INLINE_FUNCTION Pack values(Function const &f, int p) const
  {
    double value[pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
      value[lane] = p * pack_width + lane < count_ ? f(field_, components_, cell(p, lane)) : 0.0;
    return loadPack(value);
  }

private:
  KOKKOS_INLINE_FUNCTION int cell(int p, int lane) const
  {
    return field_.mesh.cell_neighbour.item(first_ + Math::min(p * pack_width + lane, count_ - 1));
  }

  HARMOS_LARGE_FUNCTION NeighbourPack gather(int p) const
  {
    double row[10][pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
    {
      Quadrilateral const quad = unitQuadrilateral(field_.mesh, components_, cell(p, lane));
      for (int k = 0; k < 4; ++k)
      {
        row[2 * k][lane] = quad[k][0];
        row[2 * k + 1][lane] = quad[k][1];
      }
      row[8][lane] = volume(quad, components_.weight);
      row[9][lane] = p * pack_width + lane < count_ ? 1.0 : 0.0;
    }
    NeighbourPack n;
    for (int k = 0; k < 4; ++k)
    {
      n.x[k] = loadPack(row[2 * k]);
      n.y[k] = loadPack(row[2 * k + 1]);
    }
    n.volume = loadPack(row[8]);
    n.present = loadPack(row[9]);
    return n;
  }

  ReconstructionField const &field_;
  CellComponents const &components_;
  int first_, count_;
  NeighbourPack stored_[stored_packs];
};

} // namespace Harmos

#endif
