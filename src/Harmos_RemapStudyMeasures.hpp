// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_STUDY_MEASURES_HPP
#define HARMOS_REMAP_STUDY_MEASURES_HPP

#include "Harmos_RemapStudyState.hpp"

#include <cmath>

namespace Harmos
{

/// What is measured over one run: a line of the table.
struct StudyRow
{
  int cells = 0, steps = 0;
  double l1 = 0.0, l2 = 0.0, linf = 0.0;
  double conservation = 0.0;       // relative change of the sum of f V, largest over all steps
  double below = 0.0, above = 0.0; // largest over all steps
  double courant = 0.0;            // displacement of a node over the smallest altitude around, largest
  double seconds = 0.0;            // wall clock in remap(), the slowest rank
  double cpu_seconds = 0.0;        // the same of the processors, all ranks
  // of the vortex that the material carries along: all steps, relative; not a number where nothing carries it
  double momentum = std::nan("");         // |change - wall impulse| over sum m |v| at the start, largest
  double angular_momentum = std::nan(""); // change over that at the start, largest
  double kinetic_energy = std::nan("");   // part that is left at the end
};

/// Over owned cells of all ranks: the integral of the field, its errors in the three norms, its least and largest
/// value.
struct Sums
{
  double total = 0.0, l1 = 0.0, l2 = 0.0, linf = 0.0, low = 0.0, high = 0.0;
};

/// \param exact  What the cell averages should be. Collective.
Sums sumsOf(Mesh const &mesh, View<double *> const &value, View<double *> const &exact, Exchange const &exchange);

/// Of the vortex, over owned cells of all ranks, and the walls' impulse on it.
struct Swirl
{
  Vector2 momentum, wall_impulse;
  double angular_momentum, kinetic_energy, mass;
};

/// Collective.
Swirl swirlOf(Study const &s, Exchange const &exchange);

/// What became of the vortex after a step, into the row. Axisymmetric: the axial momentum alone is conserved, and there
/// is no angular momentum.
void noteSwirl(Swirl const &before, Swirl const &now, Geometry geometry, StudyRow &row);

/// Largest displacement of a node over the smallest altitude of the cells around, on either mesh, of this rank.
double courantOf(Mesh const &from, Mesh const &to);

} // namespace Harmos

#endif
