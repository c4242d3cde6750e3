// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <Harmos_JoinReducer.hpp>
#include <detail/Harmos_LargestRate.hpp>
#include <detail/Harmos_PairAccess.hpp>
#include <detail/Harmos_RingQuadrature.hpp>

#include <limits>

namespace Harmos
{
namespace
{

/// Gradients of a pair at the corners of its cell.
struct CornerGradients
{
  Vector2 of[4];
};

/// A symmetric matrix sum_I w_I B_I B_I^T.
struct GradientSquare
{
  double xx = 0.0, xy = 0.0, yy = 0.0;

  KOKKOS_INLINE_FUNCTION void add(double weight, Vector2 const &b)
  {
    xx += weight * b[0] * b[0];
    xy += weight * b[0] * b[1];
    yy += weight * b[1] * b[1];
  }
  KOKKOS_INLINE_FUNCTION double trace() const { return xx + yy; }
  KOKKOS_INLINE_FUNCTION double largest() const
  {
    return 0.5 * (trace() + Math::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy));
  }
};

KOKKOS_INLINE_FUNCTION double largestSquare(CornerGradients const &b)
{
  GradientSquare square;
  for (int k = 0; k < 4; ++k)
    square.add(1.0, b.of[k]);
  return square.largest();
}

KOKKOS_INLINE_FUNCTION CornerGradients cellGradients(Mesh const &mesh, int cell)
{
  auto const x = detail::cellCorners(mesh, cell);
  if (mesh.geometry == Geometry::Planar)
  {
    auto const b = detail::meanGradient(x);
    double const inverse = 1.0 / b.area;
    Vector2 const first{inverse * b.x0, inverse * b.y0}, second{inverse * b.x1, inverse * b.y1};
    return {{first, second, -1.0 * first, -1.0 * second}};
  }
  auto const b = detail::ringGradient(x);
  CornerGradients result;
  for (int k = 0; k < 4; ++k)
    result.of[k] = {b.x[k] / b.volume, b.y[k] / b.volume};
  return result;
}

/// The pairs of a material in a cell (the first of them) and around it, and the dof nodes that move them.
struct Patch
{
  static constexpr int most_cells = 16, most_nodes = 36;

  int num_cells = 0, num_nodes = 0;
  double mass[most_cells];
  CornerGradients gradient[most_cells];
  int node_of[most_cells][4];
  int dof[most_nodes];
  double node_mass[most_nodes];
  NodeCondition condition[most_nodes]; // values play no part

  /// Of a dof node; most_nodes: no room.
  KOKKOS_INLINE_FUNCTION int local(int d)
  {
    for (int i = 0; i < num_nodes; ++i)
      if (dof[i] == d)
        return i;
    if (num_nodes == most_nodes)
      return most_nodes;
    dof[num_nodes] = d;
    return num_nodes++;
  }

  /// a = M^-1 K u for unit c, node conditions held: stress over rho c^2 is 1, 1 - 2 g and g times axial, lateral and
  /// shear strain. [1/length^2]
  KOKKOS_INLINE_FUNCTION void apply(double g, Vector2 const u[most_nodes], Vector2 a[most_nodes]) const
  {
    for (int i = 0; i < num_nodes; ++i)
      a[i] = {0.0, 0.0};
    for (int c = 0; c < num_cells; ++c)
    {
      double xx = 0.0, yy = 0.0, xy = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        Vector2 const &b = gradient[c].of[k], &v = u[node_of[c][k]];
        xx += b[0] * v[0];
        yy += b[1] * v[1];
        xy += b[1] * v[0] + b[0] * v[1];
      }
      double const across = 1.0 - 2.0 * g;
      double const sxx = mass[c] * (xx + across * yy), syy = mass[c] * (across * xx + yy), sxy = mass[c] * g * xy;
      for (int k = 0; k < 4; ++k)
      {
        Vector2 const &b = gradient[c].of[k];
        a[node_of[c][k]] += Vector2{sxx * b[0] + sxy * b[1], sxy * b[0] + syy * b[1]};
      }
    }
    for (int i = 0; i < num_nodes; ++i)
      a[i] = (1.0 / node_mass[i]) * condition[i].project(a[i]);
  }

  KOKKOS_INLINE_FUNCTION double energy(Vector2 const u[most_nodes]) const
  {
    double sum = 0.0;
    for (int i = 0; i < num_nodes; ++i)
      sum += node_mass[i] * dot(u[i], u[i]);
    return sum;
  }

  /// omega^2 / (4 c^2) of its largest frequency, by power iteration from the strain that the first cell resists most.
  KOKKOS_INLINE_FUNCTION double largestSquare(double g) const
  {
    constexpr int turns = 10;
    Vector2 u[most_nodes], a[most_nodes];
    for (int i = 0; i < num_nodes; ++i)
      u[i] = {0.0, 0.0};
    for (int k = 0; k < 4; ++k)
    {
      int const i = node_of[0][k];
      u[i] = (1.0 / node_mass[i]) * condition[i].project(gradient[0].of[k]);
    }
    double square = 0.0;
    for (int turn = 0; turn < turns; ++turn)
    {
      double const before = energy(u);
      if (!(before > 0.0))
        return 0.0;
      apply(g, u, a);
      square = Math::sqrt(energy(a) / before);
      double const scale = 1.0 / Math::sqrt(before);
      for (int i = 0; i < num_nodes; ++i)
        u[i] = scale * a[i];
    }
    return 0.25 * square;
  }
};

/// Part of a square by which a patch may miss the scheme's, where edges are free.
constexpr double most_missed = 0.1;

/// A bound of a frequency's square, and what of it is owed to motions of two directions at free edges. [1/length^2]
struct BoundedSquare
{
  double whole, at_free_edges;
};

/// The shares of a pair's stiffness and mass in those of its material around one of its nodes.
struct NodeShares
{
  double weight;    // mean of the gradients' squares around the node over the pair's own
  double free_part; // 0 where the material fills the cells around the node, 1 where no cell but the pair's has any
};

struct CutStepFunctor
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
  double dt;    // of the step that is planned
  bool patches; // whether pairs whose bound is below it are looked at more closely

  KOKKOS_INLINE_FUNCTION bool isCut(int cell, int pair) const
  {
    return cut.first_row(cell) >= 0 && actsOnFilledRegion(options.cut_cell_stress, materials(pairs.material(pair)));
  }

  KOKKOS_INLINE_FUNCTION int row(int cell, int pair) const { return cut.first_row(cell) + pair - pairs.offset(cell); }

  KOKKOS_INLINE_FUNCTION CornerGradients pairGradients(int cell, int pair) const
  {
    CornerGradients b = cellGradients(mesh, cell);
    int const r = row(cell, pair);
    for (int k = 0; k < 4; ++k)
      b.of[k] += Vector2{cut.gradient(r, 3 * k + CutGradientX), cut.gradient(r, 3 * k + CutGradientY)};
    return b;
  }

  KOKKOS_INLINE_FUNCTION NodeShares sharesAt(int cell, int pair, int corner) const
  {
    int const node = mesh.cell_node(cell, corner);
    int const material = pairs.material(pair);
    double mass = 0.0, stiffness = 0.0, volume = 0.0;
    for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
    {
      int const around = mesh.node_cell.item(i) / 4;
      double const share = mesh.corner_share(around, mesh.node_cell.item(i) % 4);
      volume += share * mesh.cell_volume(around);
      for (int p = pairs.offset(around); p < pairs.offset(around + 1); ++p)
        if (pairs.material(p) == material)
        {
          double const part = share * record(p, Mass);
          mass += part;
          stiffness += part * (isCut(around, p) ? square(row(around, p)) : largestSquare(cellGradients(mesh, around)));
        }
    }
    double const share = mesh.corner_share(cell, corner);
    double const of_mass = share * record(pair, Mass) / mass, of_volume = share * mesh.cell_volume(cell) / volume;
    return {stiffness / (mass * square(row(cell, pair))),
            of_volume < 1.0 ? Math::max(0.0, (of_mass - of_volume) / (1.0 - of_volume)) : 0.0};
  }

  /// The patch of a pair's material around its cell; false: it has no room.
  KOKKOS_INLINE_FUNCTION bool gather(int cell, int pair, Patch &patch) const
  {
    int cells[Patch::most_cells] = {cell};
    patch.num_cells = 1;
    for (int k = 0; k < 4; ++k)
    {
      int const node = mesh.cell_node(cell, k);
      for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
      {
        int const around = mesh.node_cell.item(i) / 4;
        bool known = pairOf(around, pairs.material(pair)) < 0;
        for (int c = 0; c < patch.num_cells; ++c)
          known = known || cells[c] == around;
        if (known)
          continue;
        if (patch.num_cells == Patch::most_cells)
          return false;
        cells[patch.num_cells++] = around;
      }
    }
    for (int c = 0; c < patch.num_cells; ++c)
    {
      int const p = pairOf(cells[c], pairs.material(pair));
      patch.mass[c] = record(p, Mass);
      patch.gradient[c] = isCut(cells[c], p) ? pairGradients(cells[c], p) : cellGradients(mesh, cells[c]);
      for (int k = 0; k < 4; ++k)
      {
        int const i = patch.local(pairs.dof_node(p, k));
        if (i == Patch::most_nodes)
          return false;
        patch.node_of[c][k] = i;
        patch.node_mass[i] = dof_mass(patch.dof[i]);
        int const index = boundary.node_index(mesh.cell_node(cells[c], k));
        patch.condition[i] = index < 0 ? NodeCondition() : boundary.condition(index);
      }
    }
    return true;
  }

  KOKKOS_INLINE_FUNCTION int pairOf(int cell, int material) const
  {
    for (int p = pairs.offset(cell); p < pairs.offset(cell + 1); ++p)
      if (pairs.material(p) == material && record(p, Mass) > 0.0)
        return p;
    return -1;
  }

  /// lambda of a pair, from the shares of its nodes' masses; g = G / (rho c^2).
  KOKKOS_INLINE_FUNCTION BoundedSquare boundedSquare(int cell, int pair, double g) const
  {
    CornerGradients const b = pairGradients(cell, pair);
    GradientSquare weighted;
    double free_part = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      NodeShares const shares = sharesAt(cell, pair, k);
      weighted.add(shares.weight, b.of[k]);
      free_part += shares.weight * dot(b.of[k], b.of[k]) * shares.free_part;
    }
    double const largest = weighted.largest(), trace = weighted.trace();
    double const at_free_edges = Math::max(0.0, 1.0 - 2.0 * g) * (free_part / trace) * (trace - largest);
    return {largest + at_free_edges, at_free_edges};
  }

  /// 1 / dt of a pair at Courant number one.
  KOKKOS_INLINE_FUNCTION double rate(int cell, int pair) const
  {
    Material const &material = materials(pairs.material(pair));
    double const sv = record(pair, SpecificVolume), e = record(pair, InternalEnergy);
    EosState<double> const eos = equationOfState(material, sv, e);
    double const g =
        shearModulus(material, sv, e) * sv / longitudinalSoundSpeedSquared(material, eos.sound_speed_squared, sv, e);
    detail::StepGeometry<double> const whole = detail::stepGeometry(mesh.geometry, detail::cellCorners(mesh, cell),
                                                                    detail::cornerVelocities(pairs, velocity, pair));
    double const of_cell = largestSquare(cellGradients(mesh, cell));
    auto const rateAt = [&](double square)
    {
      detail::StepGeometry<double> part = whole;
      part.inverse_length_squared *= square / of_cell;
      return detail::acousticRate(material, options, part, eos, sv, e);
    };
    BoundedSquare const bound = boundedSquare(cell, pair, g);
    double const bounded = rateAt(bound.whole);
    Patch patch;
    if (!patches || bounded * dt <= 1.0 || !gather(cell, pair, patch))
      return bounded;
    double const found = patch.largestSquare(g) + Math::min(bound.at_free_edges, most_missed * of_cell);
    return rateAt(Math::min(bound.whole, Math::max(of_cell, found)));
  }

  KOKKOS_INLINE_FUNCTION void operator()(int i, detail::LargestRate &largest) const
  {
    int const cell = regions.mixed_cell(i);
    if (mesh.cell_depth(cell) != 0)
      return;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      if (isCut(cell, pair) && record(pair, Mass) > 0.0)
        largest.include(rate(cell, pair), pair);
  }
};

void computeSquares(CutStepFunctor const &step)
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

TimeStepLimit cutStepLimit(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                           PairState const &state, FilledRegions const &regions, BoundaryConditions const &boundary,
                           View<Material *> const &materials, LagrangeOptions const &options, double dt,
                           LagrangeWork &work)
{
  auto &square = work.gradient_square;
  if (square.extent(0) < work.cut.gradient.extent(0))
    square = View<double *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::gradient_square"),
                            work.cut.gradient.extent(0));
  CutStepFunctor step{mesh,   pairs,    regions,       state.record, state.velocity, materials, options, work.cut,
                      square, boundary, work.dof_mass, dt,           false};
  computeSquares(step);
  for (bool const patches : {false, true})
  {
    step.patches = patches;
    detail::LargestRate largest;
    Kokkos::parallel_reduce("Harmos::lagrange::cutStepLimit", RangePolicy(0, regions.num_mixed_cells), step,
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
