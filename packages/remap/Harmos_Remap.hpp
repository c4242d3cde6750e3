// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_HPP
#define HARMOS_REMAP_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_Material.hpp>

namespace Harmos
{

struct RemapOptions
{
  int order = 2;                    // 1 or 2
  double merge_below = 1e-6;        // fragments below this volume fraction merge with same-material neighbours; 0: never
  double close_void_below = 1e-3;   // spurious void below this part of a cell, with no void around, is closed
  bool return_kinetic_defect = false; // kinetic energy lost by the remap becomes internal energy, pair by pair
};

/// Sums over owned cells of one remap, for the history.
struct RemapReport
{
  double overlap_volume = 0.0;  // overlap of moved regions that was scaled away (>= 0) [length^2]
  double void_volume = 0.0;     // spurious void opened and not closed [length^2]
  double closed_volume = 0.0;   // spurious void that was closed
  long long merged = 0;         // fragments merged
  double outflow_mass = 0.0, outflow_energy = 0.0; // kinetic + internal, net of inflow
  Vector2 outflow_momentum = {0.0, 0.0};
  double kinetic_loss = 0.0;    // before - after, less what became heat
  long long failures = 0;       // owned donors whose overlays do not add up to 1e-10 of their volume
  int first_failed_cell = -1;
};

/// What the remap makes: the next cycle's pairs, dof nodes and state.
struct RemapResult
{
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
};

} // namespace Harmos

#endif
