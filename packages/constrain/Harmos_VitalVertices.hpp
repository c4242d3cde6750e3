// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_VITAL_VERTICES_HPP
#define HARMOS_VITAL_VERTICES_HPP

#include <Harmos_RowTrace.hpp>

#include <vector>

namespace Harmos
{

/// A part of a group's impulse that acts in a row.
struct GroupShare
{
  int group;
  double weight;
};

/// \brief Groups of crossed cell edges, each with one multiplier.
///
/// Of the crossed edges a largest set without common nodes is vital (the one with the fewest neighbours first); every
/// other edge belongs to the nearest vital one that it shares a node with. A multiplier is linear along each segment
/// between the values of the two edges' groups. One multiplier a node layer: more would fight over the same nodes.
///
/// With one row at each segment's midpoint approach vanishes in the mean of the midpoints (Placement::VitalVertices).
/// With rows at the two Gauss points of each segment it is the mortar condition: for each group's piecewise linear
/// function N, integral of N n . (v_b - v_a) ds = 0, exact where the shape functions are polynomials along the segment
/// (cells that are parallelograms; quadratic times linear), and the multiplier is the traction sum_g N_g P_g / integral
/// of N_g.
///
/// Between solids the gap of a group is the least of its rows', beside fluids their mean (decision 0010).
///
/// \return By row: the shares of groups in its impulse, those of a group adding up to one over its rows.
/// Bechet, Moes & Wohlmuth, Int. J. Numer. Meth. Engng 78 (2009) 931-954; Bernardi, Maday & Patera, in: Asymptotic and
/// numerical methods for PDEs with critical parameters, NATO ASI C 384 (1993) 269-286 (mortar).
std::vector<std::vector<GroupShare>> vitalGroups(std::vector<RowTrace> const &trace, std::vector<int> const &kind,
                                                 int &num_groups);

} // namespace Harmos

#endif
