// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Borrowed.hpp>
#include <Harmos_Constrain.hpp>
#include <Harmos_ConstraintSums.hpp>
#include <Harmos_ExplicitImpulses.hpp>
#include <Harmos_OutlineRows.hpp>
#include <Harmos_PressureTractions.hpp>
#include <Harmos_RowPointer.hpp>
#include <Harmos_StateExchange.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

/// half = v* + impulses / mass; rigid dof nodes move with their body.
void writeHalf(Mesh const &mesh, NodeMaterialPairs const &dof_nodes, View<double *[2]> const &predicted,
               BodyTable const &bodies, View<double *[2]> const &half)
{
  if (bodies.body.extent(0) == 0)
  {
    launchCopy(half, predicted);
    return;
  }
  View<int *> const dof_material = dof_nodes.material, dof_node = dof_nodes.node, of_material = bodies.of_material;
  View<RigidBody *> const rigid = bodies.body;
  RowPointer<double, 2> const position(mesh.node_position), from(predicted), to(half);
  launchFor(
      "Harmos::constrain::writeHalf", dof_nodes.num_dof_nodes, KOKKOS_LAMBDA(int dof) {
        int const material = dof_material(dof);
        int const number = material >= 0 ? of_material(material) : -1;
        Vector2 v{from(dof, 0), from(dof, 1)};
        if (number >= 0)
        {
          RigidBody const &body = rigid(number);
          v = body.velocity;
          if (body.angular_velocity != 0.0)
            v = body.velocityAt({position(dof_node(dof), 0), position(dof_node(dof), 1)});
        }
        to(dof, 0) = v[0];
        to(dof, 1) = v[1];
      });
}

void addChange(ContactSystem const &system, View<double *[2]> const &change, View<double *[2]> const &half)
{
  View<int *> const dof_node = system.dof_node;
  launchFor(
      "Harmos::constrain::addChange", system.num_dofs, KOKKOS_LAMBDA(int i) {
        half(dof_node(i), 0) += change(i, 0);
        half(dof_node(i), 1) += change(i, 1);
      });
}

void moveFreeBodies(ContactSystem const &system, View<double *[3]> const &body_change, std::vector<RigidBody> &bodies)
{
  auto const change = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), body_change);
  for (int f = 0; f < system.num_free; ++f)
  {
    RigidBody &body = bodies[static_cast<std::size_t>(system.free_number(f))];
    body.velocity += Vector2{change(f, 0), change(f, 1)};
    body.angular_velocity += change(f, 2);
  }
}

std::vector<RigidBody> meanBodies(std::vector<RigidBody> const &bodies_n, std::vector<RigidBody> const &bodies)
{
  std::vector<RigidBody> mean = bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    mean[b].velocity = 0.5 * (bodies_n[b].velocity + bodies[b].velocity);
    mean[b].angular_velocity = 0.5 * (bodies_n[b].angular_velocity + bodies[b].angular_velocity);
  }
  return mean;
}

/// Solve with the iterations that are left after `solution`, whose others count with those of the new one.
/// \return False: none are left, and it did not converge.
bool solveOn(Mesh const &mesh, ContactSystem const &system, ContactRows const &rows, double dt,
             ConstraintOptions options, Exchange const &exchange, std::vector<ContactForce> const &last,
             WorkArrays const &work, MultiplierSolution &solution)
{
  int const before = solution.iterations;
  options.max_iterations -= before;
  if (before > 0 && options.max_iterations < 1)
  {
    solution.converged = false;
    return false;
  }
  solution = solveMultipliers(mesh, system, rows, dt, options, exchange, last, work);
  solution.iterations += before;
  return true;
}

/// Solve, and anew while rows with restitution bear that were not about to touch: what strikes them is what others'
/// impulses move. Each time some row more obeys the law of impact, so that this ends.
/// \param solution What was found before; its iterations count.
/// \return False: it took all iterations.
bool solveWithRebound(Mesh const &mesh, ContactSystem const &system, ContactRows const &rows, Motion const &before,
                      Motion const &predicted, double dt, ConstraintOptions const &options, Exchange const &exchange,
                      std::vector<ContactForce> const &last, WorkArrays const &work, MultiplierSolution &solution)
{
  bool goes_on = solveOn(mesh, system, rows, dt, options, exchange, last, work, solution);
  while (goes_on && reboundWhereStruck(rows, before, predicted, dt, solution.impulse, exchange, system))
    goes_on = solveOn(mesh, system, rows, dt, options, exchange, last, work, solution);
  return goes_on;
}

/// Kinematics `single` without contact walls: both sides of every interface move with the same dof nodes.
bool nothingToSeparate(NodeMaterialPairs const &dof_nodes, BoundaryConditions const &conditions)
{
  if (dof_nodes.num_dof_nodes == 0)
    return true;
  View<int *> const material = dof_nodes.material;
  int first = 0;
  launchReduce(
      "Harmos::constrain::firstMaterial", 1, KOKKOS_LAMBDA(int i, int &sum) { sum += material(i); }, first);
  if (first != -1)
    return false;
  auto const boundary = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), conditions.boundary);
  for (std::size_t i = 0; i < boundary.extent(0); ++i)
    if (boundary(i).kind == BoundaryKind::ContactWall)
      return false;
  return true;
}

} // namespace

ContactRows findContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                            FilledRegions const &regions, BoundaryConditions const &conditions, BodyTable const &table,
                            std::vector<Bond> const &bonds, ConstraintOptions const &options, Exchange const &exchange,
                            Motion const &before, double dt, ConstraintWork *kept, std::vector<Shape> const &outline,
                            std::vector<RigidBody> const &predicted, PressureTractions *tractions)
{
  ConstraintWork own;
  ConstraintWork &work = kept != nullptr ? *kept : own;
  WorkArrays const &arrays = work.arrays;
  if (options.method == ConstraintMethod::Nodal || options.method == ConstraintMethod::Merged)
  {
    ContactRows rows = buildNodalRows(mesh, pairs, dof_nodes, regions, conditions, table, options, arrays);
    exchange.sum(&rows.num_multipliers, 1);
    if (rows.num_multipliers > 0)
      exchangeContactRows(mesh, pairs, table, exchange, rows, arrays);
    return rows;
  }
  InterfaceSegments segments;
  if (!nothingToSeparate(dof_nodes, conditions))
    segments =
        findInterfaceSegments(mesh, pairs, dof_nodes, regions, conditions, options.placement, &work.cells, arrays);
  Mesh const cells = borrowed(mesh);
  double const largest = exchange.max(largestSegment(cells, segments));
  if (largest == 0.0)
    return {};
  SegmentBins const bins = binSegments(segments, largest, arrays);
  View<RayHit *> const hit = castRays(cells, segments, bins, arrays);
  ContactRows rows = buildContactRows(cells, borrowed(pairs), borrowed(dof_nodes), borrowed(regions), segments, hit,
                                      bins, borrowed(conditions), table, bonds, options, before, dt, arrays, tractions);
  if (tractions != nullptr)
  {
    exchange.sum(&tractions->rows.num_multipliers, 1);
    if (tractions->rows.num_multipliers > 0)
      exchangeContactRows(mesh, pairs, table, exchange, tractions->rows, arrays);
  }
  OutlineRows between;
  if (table.outlined)
    between = findOutlineRows(mesh, segments, conditions, outline, predicted, bonds, options, exchange, largest, dt);
  rows.num_multipliers += between.num_multipliers;
  exchange.sum(&rows.num_multipliers, 1);
  if (rows.num_multipliers > 0)
    exchangeContactRows(mesh, pairs, table, exchange, rows, arrays);
  appendRows(between, rows);
  return rows;
}

ConstraintReport constrainVelocities(Mesh const &mesh, CellMaterialPairs const &pairs,
                                     NodeMaterialPairs const &dof_nodes, FilledRegions const &regions,
                                     BoundaryConditions const &conditions, View<double *> const &dof_mass,
                                     View<double *[2]> const &velocity_n, View<double *[2]> const &predicted,
                                     View<double *[2]> &half, std::vector<RigidBody> const &bodies_n,
                                     std::vector<RigidBody> &bodies, double dt, double kick, PairStress const &stress,
                                     std::vector<Bond> const &bonds, ConstraintOptions const &options,
                                     Exchange const &exchange, std::vector<ContactForce> const &last,
                                     ConstraintWork *kept, std::vector<Shape> const &outline)
{
  ScopedRegion const region("Harmos::constrain");
  if (!(dt > 0.0))
    throw std::runtime_error("constrainVelocities: dt = " + std::to_string(dt) + ", must be > 0");
  int const num_materials = static_cast<int>(options.interaction.extent(0));
  ConstraintReport report;
  report.body_impulse.assign(bodies.size(), Vector2{0.0, 0.0});
  report.body_torque.assign(bodies.size(), 0.0);
  std::size_t const width = static_cast<std::size_t>(num_materials) + 1;
  report.pair_force.assign(width * width, PairForce());
  report.bond_load.assign(bonds.size(), BondLoad());

  WorkArrays arrays;
  if (kept != nullptr)
  {
    kept->arrays.begin();
    arrays = kept->arrays;
  }
  BodyTable table = buildBodyTable(bodies, num_materials, arrays);
  table.outlined = options.outline_rows && !outline.empty() && options.method == ConstraintMethod::Multipliers;
  table.surfaces = rigidSurfaces(outline, arrays);
  BodyTable const table_n = withBodies(table, bodies_n, arrays);
  bool const presses = options.fluid.extent(0) > 0 && stress.pressure.extent(0) > 0;
  PressureTractions tractions;
  tractions.pressure = stress.pressure;
  ContactRows const rows =
      findContactRows(mesh, pairs, dof_nodes, regions, conditions, table, bonds, options, exchange,
                      {velocity_n, table_n}, dt, kept, outline, bodies, presses ? &tractions : nullptr);
  report.rows = rows.num_multipliers;
  if (rows.num_multipliers == 0 && tractions.rows.num_multipliers == 0)
  {
    if (bodies.empty())
      half = predicted;
    else
      writeHalf(mesh, dof_nodes, predicted, table, half);
    return report;
  }
  Mesh const cells = borrowed(mesh);
  NodeMaterialPairs const dofs = borrowed(dof_nodes);
  bool const is_explicit = options.method == ConstraintMethod::Penalty || options.method == ConstraintMethod::Nitsche;
  bool const gives_way = options.method != ConstraintMethod::Merged && !sharesMultipliers(options.placement);
  RowScale const scale = is_explicit ? RowScale::None : gives_way ? RowScale::Compliant : RowScale::Sums;
  Motion const before{borrowed(velocity_n), table_n};
  Motion after{borrowed(predicted), table};
  View<double *[2]> pushed = predicted;
  PressureImpulses pressure;
  if (tractions.rows.num_multipliers > 0)
  {
    ContactSystem const of_facets =
        buildContactSystem(cells, borrowed(pairs), tractions.rows, dofs, borrowed(conditions), borrowed(dof_mass),
                           before, after, bodies, dt, RowScale::None, arrays);
    pressure = pressureImpulses(tractions, of_facets, before, kick, exchange, arrays);
    pushed = arrays.unset<double *[2]>("Harmos::constrain::pushed", predicted.extent(0));
    launchCopy(pushed, predicted);
    addChange(of_facets, pressure.solution.change, pushed);
    exchangeDofVelocities(exchange, 3, pairs, pushed);
    moveFreeBodies(of_facets, pressure.solution.body_change, bodies);
    after = {borrowed(pushed), withBodies(table, bodies, arrays)};
  }
  ContactSystem system;
  MultiplierSolution solution;
  bool goes_on = true;
  do
  {
    system = buildContactSystem(cells, borrowed(pairs), rows, dofs, borrowed(conditions), borrowed(dof_mass), before,
                                after, bodies, dt, scale, arrays);
    if (is_explicit)
      solution =
          explicitImpulses({mesh, pairs, before, stress.cauchy}, system, rows, dt, kick, options, exchange, arrays);
    else
      goes_on = solveWithRebound(mesh, system, rows, before, after, dt, options, exchange, last, arrays, solution);
    dropIdleImpulses(system, solution.impulse);
    sumBondLoads(system, rows, solution.impulse, exchange, report.bond_load, arrays);
  } while (goes_on && snapRigidBonds(rows, bodies, bonds, options, kick, report.bond_load));
  report.iterations = solution.iterations;
  report.residual = solution.residual;
  report.converged = solution.converged;
  report.force = solution.force;
  moveFreeBodies(system, solution.body_change, bodies);
  writeHalf(cells, dofs, pushed, system.num_free > 0 ? withBodies(table, bodies, arrays) : table, half);
  addChange(system, solution.change, half);
  exchangeDofVelocities(exchange, 3, pairs, half);
  BodyTable const mean = withBodies(table, meanBodies(bodies_n, bodies), arrays);
  sumConstraint(system, rows, solution, cells, dofs, velocity_n, half, mean, num_materials, exchange, true, report,
                arrays);
  if (tractions.rows.num_multipliers > 0)
    sumConstraint(pressure.system, tractions.rows, pressure.solution, cells, dofs, velocity_n, half, mean,
                  num_materials, exchange, false, report, arrays);
  return report;
}

} // namespace Harmos
