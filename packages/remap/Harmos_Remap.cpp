// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Remap.hpp>

#include <detail/Harmos_DonorOverlap.hpp>
#include <detail/Harmos_FieldRanges.hpp>
#include <detail/Harmos_Kept.hpp>
#include <detail/Harmos_Rebuild.hpp>

#include <Harmos_ReducedValues.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

using namespace RemapDetail;

/// Forget what belongs to another mesh. A mesh that moves keeps its cells and their links, but not their boxes.
void keepMesh(Mesh const &mesh, bool moves, Kept &kept)
{
  if (moves || kept.moved_mesh)
    kept.boxed = false;
  kept.moved_mesh = moves;
  if (kept.face_neighbour.data() == mesh.face_neighbour.data())
    return;
  kept.face_neighbour = mesh.face_neighbour;
  kept.window = {};
  kept.classes = {};
  kept.links = {};
  kept.rim = {};
  kept.boxed = false;
}

/// A boundary node slides along its straight walls, and stays at any other boundary. \throw std::runtime_error
void checkBoundaryNodes(Input const &in)
{
  constexpr double tolerance = 1e-10; // of the face
  int strayed = in.mesh.num_nodes;
  Kokkos::parallel_reduce(
      "Harmos::remap::checkBoundaryNodes", RangePolicy(0, in.mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &least) {
        for (int i = 0; i < 8; ++i)
        {
          int const face = i / 2;
          int const number = in.mesh.face_boundary(cell, face);
          if (number < 0)
            continue;
          BoundaryKind const kind = in.conditions.boundary(number).kind;
          bool const wall = kind == BoundaryKind::SlipWall || kind == BoundaryKind::Fixed;
          int const node = in.mesh.cell_node(cell, (face + i % 2) % 4);
          Vector2 const a = in.startNode(in.mesh.cell_node(cell, face));
          Vector2 const edge = in.startNode(in.mesh.cell_node(cell, (face + 1) % 4)) - a;
          Vector2 const shift = in.node(node) - in.startNode(node);
          double const off = wall ? Math::fabs(cross(edge, shift)) : Math::sqrt(dot(edge, edge) * dot(shift, shift));
          if (off > tolerance * dot(edge, edge) && node < least)
            least = node;
        }
      },
      Kokkos::Min<int>(strayed));
  if (strayed >= in.mesh.num_nodes)
    return;
  long long global = 0;
  Kokkos::deep_copy(global, Kokkos::subview(in.mesh.node_global, strayed));
  throw std::runtime_error("remap: the target mesh moves node " + std::to_string(global) +
                           " off its boundary; nodes may slide along slip and fixed walls and stay at others");
}

/// Corner shares of the mesh where the motion began.
CornerShares startShares(Input const &in)
{
  CornerShares const share{scratch<double *[4]>("startShares", in.mesh.num_cells)};
  Kokkos::parallel_for(
      "Harmos::remap::startShares", RangePolicy(0, in.mesh.num_cells),
      KOKKOS_LAMBDA(int cell) { ringShares(in.startQuadrilateral(cell), &share.part(cell, 0)); });
  return share;
}

/// Whether some material is neither rigid nor has strength.
bool anyFluid(View<Material *> const &materials)
{
  int fluids = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::anyFluid", RangePolicy(0, static_cast<int>(materials.extent(0))),
      KOKKOS_LAMBDA(int m, int &sum) { sum += isFluid(materials(m)) ? 1 : 0; }, fluids);
  return fluids > 0;
}

/// The classes of the cells: as in the last cycle where nothing that they depend on has changed.
Classes const &keepClasses(Input const &in, Kept &kept)
{
  bool const same_scene = kept.conditions.boundary.data() == in.conditions.boundary.data() &&
                          kept.conditions.node_index.data() == in.conditions.node_index.data() &&
                          kept.materials.data() == in.materials.data() && kept.swept_faces == in.options.swept_faces &&
                          kept.classes.flags.extent(0) > 0;
  bool const same_pairs = in.rigid.offset.extent(0) == 0 && kept.pairs.offset.data() == in.pairs.offset.data() &&
                          kept.pairs.material.data() == in.pairs.material.data() &&
                          kept.pairs.cell_kind.data() == in.pairs.cell_kind.data();
  if (!same_scene)
  {
    kept.classes = classify(in);
    kept.any_fluid = anyFluid(in.materials);
  }
  else if (!same_pairs)
    updateClasses(in, kept.classes);
  kept.pairs = in.pairs;
  kept.conditions = in.conditions;
  kept.materials = in.materials;
  kept.swept_faces = in.options.swept_faces;
  return kept.classes;
}

/// Kinetic energy per mass of the pairs: of their corners, and their part of what the nodes lost in stage 1.
void addHeat(Input const &in, Classes const &classes, StageState const &stage, SweptHeat const &heat)
{
  bool const swept = heat.node.extent(0) > 0;
  Kokkos::parallel_for(
      "Harmos::remap::addHeat", RangePolicy(0, in.pairs.num_pairs), KOKKOS_LAMBDA(int pair) {
        double sum = 0.0;
        for (int k = 0; k < 4; ++k)
        {
          Vector2 const v = stage.cornerVelocity(in, classes, pair, k);
          double const lost = swept ? heat.node(in.pairs.dof_node(pair, k)) : 0.0;
          sum += in.share(in.pairs.cell(pair), k) * (0.5 * dot(v, v) + lost);
        }
        stage.kinetic(pair) = sum;
      });
}

/// Stage 1: the pure regions.
StageState sweepPureCells(Input const &in, Classes const &classes, Kept &kept, SweptSums &sums)
{
  StageState stage;
  stage.record = recycle(kept.records, "record", in.pairs.num_pairs);
  stage.velocity = in.half;
  bool const returns_heat = in.options.return_kinetic_defect;
  if (in.carriesDamage() || returns_heat)
    stage.kinetic = scratch<double *>("kinetic", in.pairs.num_pairs);
  if (classes.num_swept == 0)
  {
    Kokkos::deep_copy(stage.record, in.state.record);
    if (in.carriesDamage())
      Kokkos::deep_copy(stage.kinetic, in.state.damage);
    else if (returns_heat)
      addHeat(in, classes, stage, {});
    return stage;
  }
  if (kept.window.columns.extent(0) == 0)
  {
    kept.chunks = sweptChunks(in.mesh);
    kept.window = sweptWindow(kept.chunks);
  }
  if (in.options.order == 3 && kept.window.spread.extent(0) == 0)
    kept.window.spread = sweptSpreads(kept.chunks);
  stage.velocity = recycle(kept.velocities, "velocity", in.dof_nodes.num_dof_nodes);
  if (classes.num_interface > 0)
  {
    stage.corner = recycle(kept.corners, "corner", in.mesh.num_cells);
    stage.own_part = recycle(kept.own_parts, "ownPart", in.dof_nodes.num_dof_nodes);
  }
  SweptHeat heat;
  View<double *> damage;
  if (returns_heat)
  {
    heat.corner = scratch<double *[4]>("cornerHeat", in.mesh.num_cells);
    heat.node = scratch<double *>("nodeHeat", in.dof_nodes.num_dof_nodes);
    Kokkos::deep_copy(heat.node, 0.0);
  }
  if (in.carriesDamage())
    damage = stage.kinetic;
  bool const owned_alone = classes.num_interface == 0; // stage 2 reads the halo; what comes after is told it
  sums = sweep(SweptStage(in, classes, kept.window, in.state.damage, stage.record, damage, stage.velocity, stage.corner,
                          stage.own_part, heat),
               kept.chunks, owned_alone);
  if (returns_heat)
    addHeat(in, classes, stage, heat);
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
            s += in.state.record(pair, Mass) * cornerKineticEnergy(in.share, in.pairs, in.half, pair);
      },
      sum);
  return sum;
}

/// Move the regions of the interface cells, and part them. Collective where overlaps are measured.
void moveRegions(Input const &in, Classes const &classes, StageState const &stage, Kept &kept, RemapReport &report,
                 Exchange const &exchange)
{
  bool const any = classes.num_interface > 0, measure = in.options.measure_overlap;
  if (any)
    moveDonors(in, classes, stage, kept.donors);
  if (measure)
    report.moved_overlap = report.remapped_overlap = measureOverlap(in, classes, kept.donors, exchange);
  if (!in.options.part_overlaps)
    return;
  if (any)
    partDonors(in, classes, kept.donors, kept.part);
  if (measure)
    report.remapped_overlap = measureOverlap(in, classes, kept.donors, exchange);
}

/// Stage 2: the interface cells, whose regions have moved.
void intersectInterfaceCells(Input const &in, Classes const &classes, StageState const &stage, Kept &kept)
{
  grow(kept.bookings, "bookings", classes.num_interface);
  intersect(in, classes, stage, kept.donors, kept.overlays, kept.bookings);
  if (accumulate(in, classes, kept.donors, kept.overlays, kept.acceptors, kept.bookings) > 0)
    mergeFragments(in, classes, kept.acceptors, kept.bookings);
  finish(in, classes, stage, kept.acceptors, kept.bookings);
}

void nameFirstFailure(Classes const &classes, Bookings const &bookings, RemapReport &report)
{
  int first = classes.num_interface;
  Kokkos::parallel_reduce(
      "Harmos::remap::firstFailedCell", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, int &least) {
        if (bookings(i, BookFailures) > 0.0 && i < least)
          least = i;
      },
      Kokkos::Min<int>(first));
  double material = 0.0;
  Kokkos::deep_copy(report.first_failed_cell, Kokkos::subview(classes.interface_cell, first));
  Kokkos::deep_copy(material, Kokkos::subview(bookings, first, static_cast<int>(BookFailedMaterial)));
  report.first_failed_material = static_cast<int>(material) - 1;
}

/// Sums over the interface cells, column by column.
struct BookingSums
{
  using value_type = double[];
  unsigned const value_count = num_bookings;
  Bookings bookings;

  KOKKOS_INLINE_FUNCTION void operator()(int i, value_type sum) const
  {
    for (int c = 0; c < num_bookings; ++c)
      sum[c] += bookings(i, c);
  }
};

void addBookings(Classes const &classes, Bookings const &bookings, RemapReport &report, double &out_kinetic)
{
  double sum[num_bookings];
  BookingSums sums;
  sums.bookings = bookings;
  Kokkos::parallel_reduce("Harmos::remap::addBookings", RangePolicy(0, classes.num_interface), sums,
                          ReducedValues<double>(sum, num_bookings));
  Kokkos::fence();
  report.overlap_volume += sum[BookOverlap];
  report.void_volume += sum[BookVoid];
  report.closed_volume += sum[BookClosed];
  report.merged += static_cast<long long>(sum[BookMerged]);
  report.bounded += static_cast<long long>(sum[BookBounded]);
  report.gas_work += sum[BookGasWork];
  report.gas_heat += sum[BookGasHeat];
  report.outflow_mass += sum[BookOutMass] - sum[BookInMass];
  out_kinetic = sum[BookOutKinetic] - sum[BookInKinetic];
  report.outflow_energy += out_kinetic + sum[BookOutEnergy] - sum[BookInEnergy];
  report.outflow_momentum +=
      Vector2{sum[BookOutMomentumX] - sum[BookInMomentumX], sum[BookOutMomentumY] - sum[BookInMomentumY]};
  long long const failures = static_cast<long long>(sum[BookFailures]);
  if (failures > 0 && report.failures == 0)
    nameFirstFailure(classes, bookings, report);
  report.failures += failures;
}

} // namespace

RemapResult remap(Mesh const &mesh, Kinematics kinematics, CellMaterialPairs const &pairs,
                  NodeMaterialPairs const &dof_nodes, PairState const &state, FilledRegions const &regions,
                  BoundaryConditions const &conditions, View<Material *> const &materials,
                  View<double *[2]> const &half, double dt, RigidRows const &rigid, RemapOptions const &options,
                  RemapReport &report, RemapWork &work, View<double *[2]> const &start, Exchange const &exchange)
{
  if (options.order < 1 || options.order > 3)
    throw std::runtime_error("remap: order " + std::to_string(options.order) + " is none of 1, 2, 3");
  if (options.order == 3 && options.swept_faces && options.hessian == RemapHessian::Contour)
    throw std::runtime_error("remap: contour Hessians are by intersection alone; switch swept_faces off");
  if (kinematics == Kinematics::Lagrangian)
    throw std::runtime_error("remap: lagrangian kinematics has no remap");
  if (options.return_kinetic_defect && state.tracks_damage)
    throw std::runtime_error("remap: where damage is tracked the kinetic defect cannot be returned");
  ScopedRegion const region("Harmos::remap");
  if (!work.kept)
    work.kept = std::make_shared<Kept>();
  Kept &kept = *work.kept;
  bool const retargeted = start.extent(0) > 0;
  keepMesh(mesh, retargeted, kept);
  Input in{mesh,
           pairs,
           dof_nodes,
           state,
           regions,
           conditions,
           materials,
           half,
           dt,
           rigid,
           options,
           {},
           retargeted ? start : mesh.node_position,
           retargeted,
           {},
           mesh.corner_share};
  if (retargeted)
    checkBoundaryNodes(in);
  bool const shares_move = retargeted && !mesh.corner_share.quarters();
  if (shares_move)
    in.share = startShares(in);
  Classes const &classes = keepClasses(in, kept);
  in.any_fluid = kept.any_fluid;
  if (classes.num_interface > 0 && kept.links.box.extent(0) == 0)
    kept.links = linkNeighbours(mesh);
  if (classes.num_interface > 0 && !kept.boxed)
    boxCells(mesh, kept.links);
  kept.boxed = kept.boxed || classes.num_interface > 0;
  in.links = kept.links;
  if (kept.rim.data() == nullptr)
    kept.rim = rimCells(mesh);
  in.ranges = fieldRanges(in, classes, kept.rim, exchange);
  SweptSums sums;
  StageState const stage = sweepPureCells(in, classes, kept, sums);
  sums.kinetic_before += otherKineticEnergy(in, classes);

  moveRegions(in, classes, stage, kept, report, exchange);
  Acceptors const &acceptors = kept.acceptors;
  double out_kinetic = 0.0;
  if (classes.num_interface > 0)
  {
    intersectInterfaceCells(in, classes, stage, kept);
    addBookings(classes, kept.bookings, report, out_kinetic);
  }
  Rebuilt rebuilt = rebuild(in, kinematics, classes, stage, acceptors);
  rebuilt.result.state.velocity = stage.velocity;
  rebuilt.result.state.tracks_damage = state.tracks_damage;
  if (state.tracks_damage)
    rebuilt.result.state.damage = rebuilt.kinetic;
  bool const in_place = classes.num_swept > 0 && rebuilt.result.pairs.offset.data() == pairs.offset.data();
  if (!in_place)
    rebuilt.result.state.velocity = recycle(kept.velocities, "velocity", rebuilt.result.dof_nodes.num_dof_nodes);
  if (!in_place || classes.num_interface > 0)
    nodalVelocities(in, classes, stage, acceptors, rebuilt, in_place, sums);
  if (shares_move)
    moveShares(in, rebuilt, sums);
  report.wall_impulse += sums.wall_impulse;
  double const returned = options.return_kinetic_defect ? returnKineticDefect(in, rebuilt) : 0.0;
  report.kinetic_loss += sums.kinetic_before - sums.kinetic_after - out_kinetic - returned;
  report.returned_heat += returned;
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
