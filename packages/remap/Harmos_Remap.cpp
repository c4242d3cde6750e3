// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Remap.hpp>

#include <detail/Harmos_Rebuild.hpp>
#include <detail/Harmos_SweptFluxes.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

using namespace RemapDetail;

template <class T>
void provide(View<T> &array, char const *label, int extent)
{
  if (static_cast<int>(array.extent(0)) != extent)
    array = scratch<T>(label, extent);
}

/// Stage 1: the pure regions.
StageState sweepPureCells(Input const &in, Classes const &classes, RemapWork &work)
{
  StageState stage;
  stage.record = scratch<double *[num_pair_fields]>("record", in.pairs.num_pairs);
  stage.velocity = in.half;
  View<double *> before;
  if (in.options.return_kinetic_defect)
  {
    before = scratch<double *>("kineticBefore", in.pairs.num_pairs);
    stage.kinetic = scratch<double *>("kinetic", in.pairs.num_pairs);
    Kokkos::parallel_for(
        "Harmos::remap::cornerKineticEnergy", RangePolicy(0, in.pairs.num_pairs),
        KOKKOS_LAMBDA(int pair) { before(pair) = cornerKineticEnergy(in.pairs, in.half, pair); });
  }
  if (classes.num_swept == 0)
  {
    Kokkos::deep_copy(stage.record, in.state.record);
    if (in.options.return_kinetic_defect)
      Kokkos::deep_copy(stage.kinetic, before);
    return stage;
  }
  provide(work.geometry, "geometry", in.mesh.num_cells);
  provide(work.moved_record, "movedRecord", in.mesh.num_cells);
  provide(work.flux, "flux", in.mesh.num_cells);
  provide(work.corner_increment, "cornerIncrement", in.mesh.num_cells);
  stage.velocity = scratch<double *[2]>("velocity", in.dof_nodes.num_dof_nodes);
  sweptGeometry(in, classes, before, work);
  sweptFluxes(in, classes, work);
  sweptGather(in, classes, before, work, stage.record, stage.kinetic);
  sweptMomentum(in, classes, work, stage.record, stage.velocity);
  return stage;
}

/// Stage 2: the interface cells.
Acceptors intersectInterfaceCells(Input const &in, Classes const &classes, StageState const &stage,
                                  Bookings const &bookings)
{
  Donors const donors = moveDonors(in, classes);
  donorPolynomials(in, classes, stage, donors);
  Overlays const overlays = intersect(in, classes, donors);
  Acceptors const acceptors = findCandidates(in, classes, donors, overlays, bookings);
  Residues const residues = findResidues(in, classes, stage, donors, overlays, acceptors, bookings);
  accumulate(in, classes, donors, overlays, residues, acceptors, bookings);
  mergeFragments(in, classes, acceptors, bookings);
  finish(in, classes, stage, acceptors, bookings);
  return acceptors;
}

int firstFailedCell(Classes const &classes, Bookings const &bookings)
{
  int first = classes.num_interface;
  Kokkos::parallel_reduce(
      "Harmos::remap::firstFailedCell", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, int &least) {
        if (bookings(i, BookFailures) > 0.0 && i < least)
          least = i;
      },
      Kokkos::Min<int>(first));
  auto const cell = Kokkos::subview(classes.interface_cell, first);
  int host_cell = -1;
  Kokkos::deep_copy(host_cell, cell);
  return host_cell;
}

void addBookings(Classes const &classes, Bookings const &bookings, RemapReport &report, double &out_kinetic)
{
  double sum[num_bookings];
  for (int c = 0; c < num_bookings; ++c)
    sum[c] = sumColumn(bookings, c);
  report.overlap_volume += sum[BookOverlap];
  report.void_volume += sum[BookVoid];
  report.closed_volume += sum[BookClosed];
  report.merged += static_cast<long long>(sum[BookMerged]);
  report.outflow_mass += sum[BookOutMass];
  report.outflow_energy += sum[BookOutKinetic] + sum[BookOutEnergy];
  report.outflow_momentum += Vector2{sum[BookOutMomentumX], sum[BookOutMomentumY]};
  out_kinetic = sum[BookOutKinetic];
  long long const failures = static_cast<long long>(sum[BookFailures]);
  if (failures > 0 && report.failures == 0)
    report.first_failed_cell = firstFailedCell(classes, bookings);
  report.failures += failures;
}

} // namespace

RemapResult remap(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs const &pairs,
                  NodeMaterialPairs const &dof_nodes, PairState const &state, FilledRegions const &regions,
                  BoundaryConditions const &conditions, View<Material *> const &materials,
                  View<double *[2]> const &half, double dt, RigidRows const &rigid, RemapOptions const &options,
                  RemapReport &report, RemapWork &work)
{
  if (options.order != 1 && options.order != 2)
    throw std::runtime_error("remap: order " + std::to_string(options.order) + " is neither 1 nor 2");
  if (kinematics == Kinematics::Lagrangian)
    throw std::runtime_error("remap: lagrangian kinematics has no remap");
  ScopedRegion const region("Harmos::remap");
  Input const in{mesh, pairs, dof_nodes, state, regions, conditions, materials, half, dt, rigid, options};
  double const kinetic_before = kineticEnergy(in, pairs, state.record, half);
  Classes const classes = classify(in);
  StageState const stage = sweepPureCells(in, classes, work);

  Acceptors acceptors;
  double out_kinetic = 0.0;
  if (classes.num_interface > 0)
  {
    Bookings const bookings("Harmos::remap::bookings", classes.num_interface);
    acceptors = intersectInterfaceCells(in, classes, stage, bookings);
    addBookings(classes, bookings, report, out_kinetic);
  }
  Rebuilt rebuilt = rebuild(in, kinematics, classes, stage, acceptors);
  rebuilt.result.state.velocity = scratch<double *[2]>("velocity", rebuilt.result.dof_nodes.num_dof_nodes);
  report.wall_impulse += nodalVelocities(in, classes, stage, acceptors, rebuilt);
  double const returned = options.return_kinetic_defect ? returnKineticDefect(in, rebuilt) : 0.0;
  RemapResult const &out = rebuilt.result;
  report.kinetic_loss +=
      kinetic_before - kineticEnergy(in, out.pairs, out.state.record, out.state.velocity) - out_kinetic - returned;
  return rebuilt.result;
}

RemapResult remap(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs const &pairs,
                  NodeMaterialPairs const &dof_nodes, PairState const &state, FilledRegions const &regions,
                  BoundaryConditions const &conditions, View<Material *> const &materials,
                  View<double *[2]> const &half, double dt, RigidRows const &rigid, RemapOptions const &options,
                  RemapReport &report)
{
  RemapWork work;
  return remap(mesh, kinematics, pairs, dof_nodes, state, regions, conditions, materials, half, dt, rigid, options,
               report, work);
}

} // namespace Harmos
