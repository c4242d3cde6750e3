// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Remap.hpp>

#include <detail/Harmos_Kept.hpp>
#include <detail/Harmos_Rebuild.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

using namespace RemapDetail;

/// The classes of the cells: as in the last cycle where nothing that they depend on has changed.
Classes const &keepClasses(Input const &in, Kept &kept)
{
  bool const same = in.rigid.offset.extent(0) == 0 && kept.face_neighbour.data() == in.mesh.face_neighbour.data() &&
                    kept.pairs.offset.data() == in.pairs.offset.data() &&
                    kept.pairs.material.data() == in.pairs.material.data() &&
                    kept.pairs.cell_kind.data() == in.pairs.cell_kind.data() &&
                    kept.conditions.boundary.data() == in.conditions.boundary.data() &&
                    kept.materials.data() == in.materials.data() && kept.classes.flags.extent(0) > 0;
  if (!same)
  {
    kept.classes = classify(in);
    kept.pairs = in.pairs;
    kept.conditions = in.conditions;
    kept.materials = in.materials;
  }
  return kept.classes;
}

/// Stage 1: the pure regions.
StageState sweepPureCells(Input const &in, Classes const &classes, Kept &kept, SweptSums &sums)
{
  StageState stage;
  stage.record = recycle(kept.records, "record", in.pairs.num_pairs);
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
  if (kept.window.cell.extent(0) == 0)
  {
    kept.chunks = sweptChunks(in.mesh);
    kept.window = sweptWindow(kept.chunks);
  }
  stage.velocity = recycle(kept.velocities, "velocity", in.dof_nodes.num_dof_nodes);
  sums = sweep(SweptStage(in, classes, kept.window, before, stage.record, stage.kinetic, stage.velocity), kept.chunks,
               in.mesh.num_cells);
  return stage;
}

/// Kinetic energy at `half` of what stage 1 has not summed.
double otherKineticEnergy(Input const &in, Classes const &classes)
{
  if (classes.num_swept == 0)
    return kineticEnergy(in, in.pairs, in.state.record, in.half);
  double sum = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::remap::otherKineticEnergy", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, double &s) {
        int const cell = classes.interface_cell(i);
        if (classes.pure_material(cell) >= 0 || in.mesh.cell_depth(cell) != 0)
          return;
        for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
          if (!in.isRigid(in.pairs.material(pair)))
            s += in.state.record(pair, Mass) * cornerKineticEnergy(in.pairs, in.half, pair);
      },
      sum);
  return sum;
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
  if (!work.kept)
    work.kept = std::make_shared<Kept>();
  Kept &kept = *work.kept;
  Classes const classes = keepClasses(in, kept);
  if (kept.face_neighbour.data() != mesh.face_neighbour.data())
  {
    kept.face_neighbour = mesh.face_neighbour;
    kept.window = {};
  }
  SweptSums sums;
  StageState const stage = sweepPureCells(in, classes, kept, sums);
  sums.kinetic_before += otherKineticEnergy(in, classes);

  Acceptors acceptors;
  double out_kinetic = 0.0;
  if (classes.num_interface > 0)
  {
    Bookings const bookings("Harmos::remap::bookings", classes.num_interface);
    acceptors = intersectInterfaceCells(in, classes, stage, bookings);
    addBookings(classes, bookings, report, out_kinetic);
  }
  Rebuilt rebuilt = rebuild(in, kinematics, classes, stage, acceptors);
  rebuilt.result.state.velocity = stage.velocity;
  bool const in_place = classes.num_swept > 0 && rebuilt.result.pairs.offset.data() == pairs.offset.data();
  if (!in_place)
    rebuilt.result.state.velocity = recycle(kept.velocities, "velocity", rebuilt.result.dof_nodes.num_dof_nodes);
  if (!in_place || classes.num_interface > 0)
    nodalVelocities(in, classes, stage, acceptors, rebuilt, in_place, sums);
  report.wall_impulse += sums.wall_impulse;
  double const returned = options.return_kinetic_defect ? returnKineticDefect(in, rebuilt) : 0.0;
  report.kinetic_loss += sums.kinetic_before - sums.kinetic_after - out_kinetic - returned;
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
