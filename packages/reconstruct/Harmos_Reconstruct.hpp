// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RECONSTRUCT_HPP
#define HARMOS_RECONSTRUCT_HPP

#include <Harmos_FilledRegions.hpp>
#include <Harmos_OutlineCorner.hpp>

namespace Harmos
{

enum class ReconstructionMethod
{
  Youngs,
  MomentOfFluid
};

struct ReconstructionOptions
{
  ReconstructionMethod method = ReconstructionMethod::MomentOfFluid;
  /// Below this volume fraction the line's normal comes from least squares over the neighbours: centroids of slivers
  /// are noise. Below 1e-3: void under that goes by least squares still, unless it is the tip of a void beyond
  /// (planForThinVoid), as do fragments of bodies (sliverBounds), and exact cells of two passing corners are looked for
  /// everywhere (partedPlan).
  double sliver = 1e-6;
  /// Fixed order of removal: material numbers, first removed first; void, written -1, is last when not listed.
  /// Extent 0: all orders are tried by least centroid error (moment-of-fluid), or ascending material number (Youngs).
  View<int *> order;
  /// By material, 1: rigid, so that volumes and centroids are those of its shape and not what remaps have left. Extent
  /// 0: none.
  View<int *> exact;
  /// Materials: 1 where it has no strength. Beside such a one corners inside of another body are kept
  /// (embeddedCornerPlan): a pressure acts on chords that are not there; its neighbours tell no order (threeBodyPlan,
  /// bodyFirstPlan). Extent 0: none.
  View<int *> fluid = {};
  /// By boundary number, 1: a contact wall, which presses corners as another body does. Extent 0: none.
  View<int *> wall = {};
  /// The rigid bodies' corners at their poses; without them corners inside of other bodies, and notches, are drawn as
  /// chords.
  RigidCorners corners = {};
};

struct ReconstructionReport
{
  long long failures = 0;            // owned cells whose volumes are off by more than 1e-13 of the cell
  int first_failed_cell = -1;        // local number
  int first_failed_material = -1;    // of the largest error there; -1: the void, or too many components
  double largest_volume_error = 0.0; // of the cell, owned cells
  long long unfinished_cells = 0;    // owned cells where a search for an angle met its bound; their volumes are exact
  long long greedy_cells = 0;        // owned cells with more than five components, ordered greedily
};

/// Filled regions of all local mixed cells from volume fractions and centroids (method of doc/theory).
///
/// Cells of depth mesh.halo use the neighbours that they have (their result is not used by owned cells).
/// \param report Accumulated counts of owned cells.
FilledRegions reconstruct(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                          ReconstructionOptions const &options, ReconstructionReport &report);

/// The same for fractions that have changed within the cells since `before`, on the same pairs: the cuts keep their
/// order and their normals and move along them until the volumes are met. What turns them, the centroids, has not
/// changed. Cells that were not mixed or are no sequence of cuts (parted, corners, films), and those whose void has
/// come or gone, are reconstructed.
FilledRegions refill(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                     FilledRegions const &before, ReconstructionOptions const &options, ReconstructionReport &report);

} // namespace Harmos

#endif
