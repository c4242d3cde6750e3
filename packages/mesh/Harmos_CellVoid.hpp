// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CELL_VOID_HPP
#define HARMOS_CELL_VOID_HPP

#include <Harmos_CellMaterialPairs.hpp>

namespace Harmos
{

/// What no pair of a cell fills, a part of it; round-off may make it slightly negative.
KOKKOS_INLINE_FUNCTION double voidFraction(CellMaterialPairs const &pairs,
                                           View<double *[num_pair_fields]> const &record, int cell)
{
  double rest = 1.0;
  for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
    rest -= record(pair, VolumeFraction);
  return rest;
}

/// The part of its cell that a pair takes up: its outline, or its mass times its specific volume where that is more
/// (where others overlapped it, its outline has been cut).
KOKKOS_INLINE_FUNCTION double filledByVolume(View<double *[num_pair_fields]> const &record, int pair,
                                             double cell_volume)
{
  return Math::max(record(pair, VolumeFraction), record(pair, Mass) * record(pair, SpecificVolume) / cell_volume);
}

/// What is left of a cell then, a part of it; below zero where more matter is in it than has room.
KOKKOS_INLINE_FUNCTION double voidOfVolumes(CellMaterialPairs const &pairs,
                                            View<double *[num_pair_fields]> const &record, int cell, double cell_volume)
{
  double rest = 1.0;
  for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
    rest -= filledByVolume(record, pair, cell_volume);
  return rest;
}

constexpr double least_void = 1e-9; // what is less is round-off

/// Whether there is void in a cell, beyond round-off.
KOKKOS_INLINE_FUNCTION bool isOpen(CellMaterialPairs const &pairs, View<double *[num_pair_fields]> const &record,
                                   int cell)
{
  return voidFraction(pairs, record, cell) > least_void;
}

} // namespace Harmos

#endif
