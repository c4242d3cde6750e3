// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PRESSURE_AROUND_HPP
#define HARMOS_PRESSURE_AROUND_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_SlipMirrors.hpp>

namespace Harmos
{

/// What the cells around bear of the pressure of a material in a cell: the mean by volume over the cell and its vertex
/// neighbours, of which each counts with its pressure p_j from zero up to 1.1 times the cell's own p_0,
///
///   (p_0 V_0 + sum over j of min(max(p_j, 0), 1.1 p_0) V_j) / (V_0 + sum over j of V_j).
///
/// Images beyond slip walls are neighbours too. The tractions of a fluid have it, and the work of what a gas fills
/// (doc/decisions/0033).
/// \param own p_0 >= 0 [Pa]. \param volume V_0 > 0 [length^2, or per radian length^3].
/// \param pressure_of p_j of a pair. \param volume_of V_j of a pair, of which the material fills that much.
template <class PressureOf, class VolumeOf>
KOKKOS_INLINE_FUNCTION double pressureAround(Mesh const &mesh, View<Boundary *> const &boundary,
                                             CellMaterialPairs const &pairs, int cell, int material, double own,
                                             double volume, PressureOf const &pressure_of,
                                             VolumeOf const &volume_of)
{
  constexpr double most = 1.1;
  double load = own * volume, filled = volume;
  auto const add = [&](int neighbour)
  {
    int const pair = pairs.find(neighbour, material);
    if (pair < 0)
      return;
    double const part = volume_of(pair);
    load += Math::clamp(pressure_of(pair), 0.0, most * own) * part;
    filled += part;
  };
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
    add(mesh.cell_neighbour.item(j));
  forMirroredNeighbours(mesh, boundary, cell,
                        [&](int j, MirrorImage const &)
                        {
                          if (j >= 0)
                            return add(mesh.cell_neighbour.item(j));
                          load += own * volume;
                          filled += volume;
                        });
  return load / filled;
}

} // namespace Harmos

#endif
