// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_JoinReducer.hpp>
#include <detail/Harmos_LargestRate.hpp>
#include <detail/Harmos_PairAccess.hpp>
#include <detail/Harmos_Patch.hpp>
#include <detail/Harmos_RingQuadrature.hpp>

#include <limits>

namespace Harmos
{
namespace
{

using detail::cellGradients;
using detail::CornerGradients;
using detail::Patch;
using detail::planeGradients;

/// A symmetric matrix sum_I w_I B_I B_I^T.
struct GradientSquare
{
  double xx = 0.0, xy = 0.0, yy = 0.0;

  /// across: part of a strain's stress that acts across it.
  KOKKOS_INLINE_FUNCTION void add(double weight, Vector2 const &b, double hoop, double across)
  {
    xx += weight * (b[0] * b[0] + hoop * (hoop + 2.0 * across * b[0]));
    xy += weight * (b[0] + across * hoop) * b[1];
    yy += weight * b[1] * b[1];
  }
  KOKKOS_INLINE_FUNCTION double trace() const { return xx + yy; }
  KOKKOS_INLINE_FUNCTION double largest() const
  {
    return 0.5 * (trace() + Math::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy));
  }
};

/// Without the hoop.
KOKKOS_INLINE_FUNCTION double largestSquare(CornerGradients const &b)
{
  GradientSquare square;
  for (int k = 0; k < 4; ++k)
    square.add(1.0, b.of[k], 0.0, 0.0);
  return square.largest();
}

/// Stiffness of a pair: c^2, and G / (rho c^2).
struct Stiffness
{
  double speed_squared, shear;
};

/// What is added to the scheme's square where edges are free, over that of the whole cell, from what a patch found
/// over the same: a motion exactly at its limit grows with the cycles, and the patch misses what reaches beyond it.
/// That are motions that whole cells carry on along an edge; those well above stay at their place.
KOKKOS_INLINE_FUNCTION double allowance(double found)
{
  constexpr double margin = 0.005, most_missed = 0.03, of_whole_cells = 1.0, of_local_motions = 1.1;
  double const between = (of_local_motions - found) / (of_local_motions - of_whole_cells);
  return margin * found + most_missed * Math::min(Math::max(between, 0.0), 1.0);
}

/// A bound of a frequency's square, and what of it is owed to motions of two directions at free edges. [1/length^2]
struct BoundedSquare
{
  double whole, at_free_edges;
};

/// Courant number up to which whole cells are stable whatever is free around them: a single cell on an axis is to 0.63.
constexpr double harmless_courant = 0.6;

/// Part of a node that is free beside a whole cell, from which on the cell is looked at; at a straight edge a third.
constexpr double least_free_part = 0.1;

struct EdgeStepFunctor
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  View<double *[num_pair_fields]> record;
  View<double *[2]> velocity;
  View<Material *> materials;
  LagrangeOptions options;
  CutGradients cut;
  View<double *> square; // by row of cut
  BoundaryConditions boundary;
  View<double *> dof_mass;
  double dt;        // of the step that is planned
  bool whole_cells; // whether cells that are not cut count too
  bool patches;     // whether pairs whose bound is below dt are looked at more closely

  /// Whether it moves with its dof nodes by its own stress.
  KOKKOS_INLINE_FUNCTION bool deforms(int pair) const
  {
    return record(pair, Mass) > 0.0 && materials(pairs.material(pair)).rigid_body < 0;
  }

  KOKKOS_INLINE_FUNCTION bool isCut(int cell, int pair) const
  {
    return cut.first_row.extent(0) > 0 && cut.first_row(cell) >= 0 &&
           actsOnFilledRegion(options.cut_cell_stress, materials(pairs.material(pair)));
  }

  KOKKOS_INLINE_FUNCTION int row(int cell, int pair) const { return cut.first_row(cell) + pair - pairs.offset(cell); }

  KOKKOS_INLINE_FUNCTION CornerGradients pairGradients(int cell, int pair) const
  {
    CornerGradients b = cellGradients(mesh, cell);
    if (!isCut(cell, pair))
      return b;
    int const r = row(cell, pair);
    for (int k = 0; k < 4; ++k)
    {
      b.of[k] += Vector2{cut.gradient(r, 3 * k + CutGradientX), cut.gradient(r, 3 * k + CutGradientY)};
      b.hoop[k] += cut.gradient(r, 3 * k + CutHoop);
    }
    return b;
  }

  KOKKOS_INLINE_FUNCTION double squareOf(int cell, int pair) const
  {
    return isCut(cell, pair) ? square(row(cell, pair)) : largestSquare(cellGradients(mesh, cell));
  }

  /// Condition of a node; none: index < 0.
  KOKKOS_INLINE_FUNCTION int conditionIndex(int cell, int corner) const
  {
    return boundary.node_index(mesh.cell_node(cell, corner));
  }

  /// Whether conditions hold all corners of a cell: it does not move in two directions.
  KOKKOS_INLINE_FUNCTION bool isHeld(int cell) const
  {
    for (int k = 0; k < 4; ++k)
      if (conditionIndex(cell, k) < 0)
        return false;
    return true;
  }

  /// The angle of a cell at one of its corners.
  KOKKOS_INLINE_FUNCTION double cornerAngle(int cell, int corner) const
  {
    auto const x = detail::cellCorners(mesh, cell);
    int const next = (corner + 1) % 4, last = (corner + 3) % 4;
    Vector2 const a{x.x[next] - x.x[corner], x.y[next] - x.y[corner]},
        b{x.x[last] - x.x[corner], x.y[last] - x.y[corner]};
    return Math::atan2(cross(a, b), dot(a, b));
  }

  /// The angle that the cells around a node could fill: less where conditions hold it. Beyond free sides of the mesh
  /// lies void.
  KOKKOS_INLINE_FUNCTION double wholeAngle(int condition) const
  {
    return condition < 0 ? 2.0 * Math::pi : (boundary.condition(condition).count == 1 ? Math::pi : 0.0);
  }

  /// Of the mass on a dof node what is a pair's, against its cell's part of the volume there: 0 where the node's cells
  /// are filled, or the pair's is held, 1 where no cell but the pair's has mass on it.
  KOKKOS_INLINE_FUNCTION double freePart(int cell, int pair, int corner) const
  {
    if (isHeld(cell))
      return 0.0;
    int const node = mesh.cell_node(cell, corner), dof = pairs.dof_node(pair, corner);
    double mass = 0.0, volume = 0.0, angle = 0.0;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const around = mesh.node_cell.item(i) / 4, there = mesh.node_cell.item(i) % 4;
      double const share = mesh.corner_share(around, there);
      volume += share * mesh.cell_volume(around);
      angle += cornerAngle(around, there);
      for (int p = pairs.offset(around); p < pairs.offset(around + 1); ++p)
        if (pairs.dof_node(p, there) == dof && deforms(p))
          mass += share * record(p, Mass);
    }
    volume *= Math::max(1.0, wholeAngle(conditionIndex(cell, corner)) / angle);
    double const share = mesh.corner_share(cell, corner);
    double const of_mass = share * record(pair, Mass) / mass, of_volume = share * mesh.cell_volume(cell) / volume;
    return of_volume < 1.0 ? Math::max(0.0, (of_mass - of_volume) / (1.0 - of_volume)) : 0.0;
  }

  /// w_I: mean of the gradients' squares on a dof node over the pair's own; a quarter over its corner's share of mass.
  KOKKOS_INLINE_FUNCTION double weightAt(int cell, int pair, int corner) const
  {
    int const node = mesh.cell_node(cell, corner), dof = pairs.dof_node(pair, corner);
    double mass = 0.0, stiffness = 0.0;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const around = mesh.node_cell.item(i) / 4, there = mesh.node_cell.item(i) % 4;
      for (int p = pairs.offset(around); p < pairs.offset(around + 1); ++p)
        if (pairs.dof_node(p, there) == dof && deforms(p))
        {
          double const part = mesh.corner_share(around, there) * record(p, Mass);
          mass += part;
          stiffness += part * squareOf(around, p);
        }
    }
    return stiffness / (4.0 * mesh.corner_share(cell, corner) * mass * squareOf(cell, pair));
  }

  /// Whether a cell and all around hold one and the same material alone: a look that costs less than freePart.
  KOKKOS_INLINE_FUNCTION bool isInside(int cell) const
  {
    if (pairs.cell_kind(cell) != PureCell)
      return false;
    int const material = pairs.material(pairs.offset(cell));
    for (int i = mesh.cell_neighbour.offset(cell); i < mesh.cell_neighbour.offset(cell + 1); ++i)
    {
      int const around = mesh.cell_neighbour.item(i);
      if (pairs.cell_kind(around) != PureCell || pairs.material(pairs.offset(around)) != material)
        return false;
    }
    for (int k = 0; k < 4; ++k)
      if (mesh.face_neighbour(cell, k) < 0 && (conditionIndex(cell, k) < 0 || conditionIndex(cell, (k + 1) % 4) < 0))
        return false;
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool hasFreeEdge(int cell, int pair) const
  {
    for (int k = 0; k < 4; ++k)
      if (freePart(cell, pair, k) > least_free_part)
        return true;
    return false;
  }

  KOKKOS_INLINE_FUNCTION Stiffness stiffnessOf(int pair) const
  {
    Material const &material = materials(pairs.material(pair));
    double const sv = record(pair, SpecificVolume), e = record(pair, InternalEnergy);
    double const c2 =
        longitudinalSoundSpeedSquared(material, equationOfState(material, sv, e).sound_speed_squared, sv, e);
    return {c2, shearModulus(material, sv, e) * sv / c2};
  }

  /// Where the pairs and nodes of a patch are.
  struct PatchPlaces
  {
    int cell[Patch::most_pairs], pair[Patch::most_pairs], node[Patch::most_nodes];
  };

  /// Adds a pair that is not yet there, and its nodes; false: no room.
  KOKKOS_INLINE_FUNCTION bool enlist(int cell, int pair, Patch &patch, PatchPlaces &places) const
  {
    for (int c = 0; c < patch.num_pairs; ++c)
      if (places.pair[c] == pair)
        return true;
    if (patch.num_pairs == Patch::most_pairs)
      return false;
    int const added = patch.num_pairs++;
    places.cell[added] = cell;
    places.pair[added] = pair;
    for (int k = 0; k < 4; ++k)
    {
      int const i = patch.local(pairs.dof_node(pair, k));
      if (i == Patch::most_nodes)
        return false;
      patch.node_of[added][k] = i;
      places.node[i] = mesh.cell_node(cell, k);
    }
    return true;
  }

  /// Adds the pairs on a node of the patch; false: no room.
  KOKKOS_INLINE_FUNCTION bool enlistAround(int local, Patch &patch, PatchPlaces &places) const
  {
    int const node = places.node[local], dof = patch.dof[local];
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const around = mesh.node_cell.item(i) / 4, there = mesh.node_cell.item(i) % 4;
      for (int p = pairs.offset(around); p < pairs.offset(around + 1); ++p)
        if (pairs.dof_node(p, there) == dof && deforms(p) && !enlist(around, p, patch, places))
          return false;
    }
    return true;
  }

  /// The patch of a pair; false: it has no room.
  KOKKOS_INLINE_FUNCTION bool gather(int cell, int pair, Patch &patch) const
  {
    constexpr int layers = 3;
    PatchPlaces places;
    if (!enlist(cell, pair, patch, places))
      return false;
    for (int layer = 0, local = 0; layer < layers; ++layer)
      for (int const end = patch.num_nodes; local < end; ++local)
        if (!enlistAround(local, patch, places))
          return false;
    double const own = stiffnessOf(pair).speed_squared;
    for (int c = 0; c < patch.num_pairs; ++c)
    {
      int const p = places.pair[c];
      Stiffness const stiffness = stiffnessOf(p);
      patch.modulus[c] = record(p, Mass) * Math::min(1.0, stiffness.speed_squared / own);
      patch.shear[c] = stiffness.shear;
      patch.gradient[c] = pairGradients(places.cell[c], p);
    }
    for (int i = 0; i < patch.num_nodes; ++i)
    {
      int const index = boundary.node_index(places.node[i]);
      patch.node_mass[i] = dof_mass(patch.dof[i]);
      patch.condition[i] = index < 0 ? NodeCondition() : boundary.condition(index);
    }
    return true;
  }

  /// lambda of a pair, from the shares of its nodes' masses; g = G / (rho c^2).
  KOKKOS_INLINE_FUNCTION BoundedSquare boundedSquare(int cell, int pair, double g) const
  {
    double const across = Math::max(0.0, 1.0 - 2.0 * g);
    CornerGradients const b = pairGradients(cell, pair);
    GradientSquare weighted;
    double free_part = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      double const before = weighted.trace();
      weighted.add(weightAt(cell, pair, k), b.of[k], b.hoop[k], across);
      free_part += (weighted.trace() - before) * freePart(cell, pair, k);
    }
    double const largest = weighted.largest(), trace = weighted.trace();
    double const at_free_edges = across * (free_part / trace) * (trace - largest);
    return {largest + at_free_edges, at_free_edges};
  }

  /// What a pair's patch asks for; where that has no room, the bound.
  /// \param of_cell The square of the whole cell, which is the least.
  HARMOS_LARGE_FUNCTION double patchSquare(int cell, int pair, BoundedSquare const &bound, double of_cell) const
  {
    Patch patch;
    if (!gather(cell, pair, patch))
      return bound.whole;
    // A patch may hold pairs that ask for more: this one asks for no more than its bound.
    double const found = Math::min(patch.largestSquare(), bound.whole);
    return Math::max(of_cell, found + Math::min(bound.at_free_edges, allowance(found / of_cell) * of_cell));
  }

  /// 1 / dt of a pair at Courant number one; its bound where that is below `least`, the largest that is known.
  KOKKOS_INLINE_FUNCTION double rate(int cell, int pair, double least) const
  {
    Material const &material = materials(pairs.material(pair));
    double const sv = record(pair, SpecificVolume), e = record(pair, InternalEnergy);
    EosState<double> const eos = equationOfState(material, sv, e);
    detail::StepGeometry<double> const whole = detail::stepGeometry(mesh.geometry, detail::cellCorners(mesh, cell),
                                                                    detail::cornerVelocities(pairs, velocity, pair));
    double const of_cell = largestSquare(planeGradients(mesh, cell)); // 1 / l^2 of the step, but for sheared cells
    auto const rateAt = [&](double square)
    {
      detail::StepGeometry<double> part = whole;
      part.inverse_length_squared *= square / of_cell;
      return detail::acousticRate(material, options, part, eos, sv, e);
    };
    BoundedSquare const bound = boundedSquare(cell, pair, stiffnessOf(pair).shear);
    double const bounded = rateAt(bound.whole);
    return patches && bounded * dt > 1.0 && bounded >= least ? rateAt(patchSquare(cell, pair, bound, of_cell))
                                                             : bounded;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int i, detail::LargestRate &largest) const
  {
    int const cell = whole_cells ? i : regions.mixed_cell(i);
    if (mesh.cell_depth(cell) != 0 || (whole_cells && isInside(cell)))
      return;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      if (deforms(pair) && (isCut(cell, pair) || (whole_cells && hasFreeEdge(cell, pair))))
        largest.include(rate(cell, pair, largest.rate), pair);
  }
};

void computeSquares(EdgeStepFunctor const &step)
{
  Kokkos::parallel_for(
      "Harmos::lagrange::gradientSquares", RangePolicy(0, step.regions.num_mixed_cells), KOKKOS_LAMBDA(int i) {
        int const cell = step.regions.mixed_cell(i);
        for (int pair = step.pairs.offset(cell); pair < step.pairs.offset(cell + 1); ++pair)
          if (step.isCut(cell, pair))
            step.square(step.row(cell, pair)) = largestSquare(step.pairGradients(cell, pair));
      });
}

} // namespace

TimeStepLimit edgeStepLimit(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                            PairState const &state, FilledRegions const &regions, BoundaryConditions const &boundary,
                            View<Material *> const &materials, LagrangeOptions const &options, double dt,
                            LagrangeWork &work)
{
  auto &square = work.gradient_square;
  if (square.extent(0) < work.cut.gradient.extent(0))
    square = View<double *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::gradient_square"),
                            work.cut.gradient.extent(0));
  bool const whole_cells = options.courant > harmless_courant;
  int const count = whole_cells ? mesh.num_cells : regions.num_mixed_cells;
  EdgeStepFunctor step{mesh,   pairs,    regions,       state.record, state.velocity, materials, options, work.cut,
                       square, boundary, work.dof_mass, dt,           whole_cells,    false};
  if (work.cut.first_row.extent(0) > 0)
    computeSquares(step);
  for (bool const patches : {false, true})
  {
    step.patches = patches;
    detail::LargestRate largest;
    Kokkos::parallel_reduce("Harmos::lagrange::edgeStepLimit", RangePolicy(0, count), step,
                            JoinReducer<detail::LargestRate>(largest));
    if (largest.rate * dt <= 1.0)
      break;
    if (patches)
      return detail::limitFrom(largest, pairs);
    computeDofMass(mesh, pairs, dof_nodes, state, materials, work);
  }
  return {std::numeric_limits<double>::infinity(), -1, -1};
}

} // namespace Harmos
