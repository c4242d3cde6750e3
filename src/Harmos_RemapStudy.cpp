// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapStudy.hpp"

#include "Harmos_RemapComparators.hpp"
#include "Harmos_RemapField.hpp"
#include "Harmos_TimeStep.hpp"

#include <Harmos_HostMesh.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_RemapFields.hpp>
#include <Harmos_StateExchange.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>

namespace Harmos
{
namespace
{

/// One line of the table.
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

/// A vortex in the unit square that is at rest on its sides: P = 0, L > 0.
PrescribedField vortex()
{
  PrescribedField field;
  field.kind = FieldKind::Vortex;
  return field;
}

/// A field on a mesh that moves.
struct Study
{
  Mesh mesh, next;
  View<double *[2]> reference; // node positions of the regular mesh
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  FilledRegions regions;
  BoundaryConditions conditions;
  View<Material *> materials;
  RemapWork work;
  FieldWork field_work;
  Vector2 wall_impulse = {0.0, 0.0}; // all steps [N s/m]
};

/// Nodes of `mesh` at their places after a step.
void placeNodes(MeshMotion const &motion, int cells, int step, int steps, View<double *[2]> const &reference,
                Mesh &mesh)
{
  auto const position = mesh.node_position;
  auto const global = mesh.node_global;
  double const t = static_cast<double>(step) / steps;
  bool const home = motion.kind == MotionKind::Random ? step == 0 : step == 0 || step == steps;
  Kokkos::parallel_for(
      "Harmos::placeNodes", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        Vector2 const at{reference(node, 0), reference(node, 1)};
        Vector2 x = at;
        if (!home)
          x = motion.kind == MotionKind::Random ? motion.randomPosition(at, global(node), step, 1.0 / cells)
                                                : motion.position(at, t);
        position(node, 0) = x[0];
        position(node, 1) = x[1];
      });
  updateGeometry(mesh);
}

Study makeStudy(Mesh const &mesh, RemapDeck const &deck)
{
  Study s;
  s.mesh = mesh;
  s.next = mesh;
  s.next.node_position = View<double *[2]>("Harmos::nextPosition", mesh.num_nodes);
  separateGeometry(s.next);
  s.reference = View<double *[2]>("Harmos::reference", mesh.num_nodes);
  Kokkos::deep_copy(s.reference, mesh.node_position);
  s.conditions = buildBoundaryConditions(mesh, View<Boundary *>("boundary", num_boundary_sides)); // slip walls
  s.materials = View<Material *>("materials", 1);
  auto const materials = Kokkos::create_mirror_view(s.materials);
  materials(0) = Material{};
  materials(0).density0 = 1.0;
  Kokkos::deep_copy(s.materials, materials);
  s.pairs.num_pairs = mesh.num_cells;
  s.pairs.offset = View<int *>("offset", mesh.num_cells + 1);
  s.pairs.material = View<int *>("material", mesh.num_cells);
  s.pairs.cell = View<int *>("cell", mesh.num_cells);
  s.state.record = View<double *[num_pair_fields]>("record", mesh.num_cells);
  s.state.centroid = View<double *[2]>("centroid", mesh.num_cells);
  s.regions.cell_region = View<int *>("cell_region", mesh.num_cells);
  Kokkos::deep_copy(s.regions.cell_region, -1);
  View<double *> const f = cellAverages(deck.field, mesh);
  auto const pairs = s.pairs;
  auto const record = s.state.record;
  bool const density = deck.field.density;
  Kokkos::parallel_for(
      "Harmos::fillCells", RangePolicy(0, mesh.num_cells + 1), KOKKOS_LAMBDA(int cell) {
        pairs.offset(cell) = cell;
        if (cell == mesh.num_cells)
          return;
        pairs.cell(cell) = cell;
        record(cell, Mass) = (density ? f(cell) : 1.0) * mesh.cell_volume(cell);
        record(cell, VolumeFraction) = 1.0;
        record(cell, SpecificVolume) = 1.0;
        record(cell, InternalEnergy) = density ? 1.0 : f(cell);
      });
  s.dof_nodes = buildDofNodes(mesh, Kinematics::Xfem, s.state.record, s.pairs);
  s.state.velocity = View<double *[2]>("velocity", s.dof_nodes.num_dof_nodes);
  auto const velocity = s.state.velocity;
  auto const dof_nodes = s.dof_nodes;
  PrescribedField const swirl = vortex();
  Kokkos::parallel_for(
      "Harmos::swirl", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        Vector2 const v = swirl.velocityAt({mesh.node_position(node, 0), mesh.node_position(node, 1)}, 0.0);
        velocity(dof, 0) = v[0];
        velocity(dof, 1) = v[1];
      });
  return s;
}

/// Cell averages of the field that the state carries.
View<double *> valuesOf(Study const &s, bool density)
{
  View<double *> const value("Harmos::values", s.mesh.num_cells);
  auto const record = s.state.record;
  auto const volume = s.mesh.cell_volume;
  Kokkos::parallel_for(
      "Harmos::valuesOf", RangePolicy(0, s.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        value(cell) = density ? record(cell, Mass) / volume(cell) : record(cell, InternalEnergy);
      });
  return value;
}

/// Sums and extrema over owned cells of all ranks. Collective.
struct Sums
{
  double total = 0.0, l1 = 0.0, l2 = 0.0, linf = 0.0, low = 0.0, high = 0.0;
};

Sums sumsOf(Mesh const &mesh, View<double *> const &value, View<double *> const &exact, Exchange const &exchange)
{
  Sums s;
  Kokkos::parallel_reduce(
      "Harmos::sumsOf", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &total, double &l1, double &l2) {
        double const v = mesh.cell_depth(cell) == 0 ? mesh.cell_volume(cell) : 0.0;
        double const difference = value(cell) - exact(cell);
        total += v * value(cell);
        l1 += v * Math::fabs(difference);
        l2 += v * difference * difference;
      },
      s.total, s.l1, s.l2);
  double linf = 0.0, low = 1e300, high = -1e300;
  Kokkos::parallel_reduce(
      "Harmos::extremaOf", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, double &a, double &b, double &c) {
        if (mesh.cell_depth(cell) != 0)
          return;
        a = Math::max(a, Math::fabs(value(cell) - exact(cell)));
        b = Math::min(b, value(cell));
        c = Math::max(c, value(cell));
      },
      Kokkos::Max<double>(linf), Kokkos::Min<double>(low), Kokkos::Max<double>(high));
  double sums[3] = {s.total, s.l1, s.l2};
  exchange.sum(sums, 3);
  return {sums[0], sums[1], std::sqrt(sums[2]), exchange.max(linf), exchange.min(low), exchange.max(high)};
}

/// Of the vortex, over owned cells of all ranks, and the walls' impulse on it. Collective.
struct Swirl
{
  Vector2 momentum, wall_impulse;
  double angular_momentum, kinetic_energy, mass;
};

Swirl swirlOf(Study const &s, Exchange const &exchange)
{
  MaterialSums const m = materialSums(s.mesh, s.pairs, s.state.record, s.state.velocity, 1);
  double sums[7] = {m(0, SumMomentumX), m(0, SumMomentumY), m(0, SumAngularMomentum), m(0, SumKineticEnergy),
                    m(0, SumMass),      s.wall_impulse[0],  s.wall_impulse[1]};
  exchange.sum(sums, 7);
  return {{sums[0], sums[1]}, {sums[5], sums[6]}, sums[2], sums[3], sums[4]};
}

/// Axisymmetric: the axial momentum alone is conserved, and there is no angular momentum.
void noteSwirl(Swirl const &before, Swirl const &now, Geometry geometry, StudyRow &row)
{
  Vector2 change = (now.momentum - before.momentum) - now.wall_impulse;
  bool const planar = geometry == Geometry::Planar;
  if (!planar)
    change[0] = 0.0;
  // sum m |v| <= root of (2 E_kin m)
  double const scale = std::sqrt(2.0 * before.kinetic_energy * before.mass);
  row.momentum = std::fmax(row.momentum, norm(change) / scale);
  if (planar)
    row.angular_momentum =
        std::fmax(row.angular_momentum, std::fabs(now.angular_momentum / before.angular_momentum - 1.0));
  row.kinetic_energy = now.kinetic_energy / before.kinetic_energy;
}

/// Largest displacement of a node over the smallest altitude of the cells around, on either mesh.
double courantOf(Mesh const &from, Mesh const &to)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::courantOf", RangePolicy(0, from.num_cells),
      KOKKOS_LAMBDA(int cell, double &most) {
        Quadrilateral const a = cellQuadrilateral(from, cell), b = cellQuadrilateral(to, cell);
        double altitude = 1e300, shift = 0.0;
        for (int k = 0; k < 4; ++k)
        {
          Vector2 const d = b[k] - a[k], ea = a[(k + 1) % 4] - a[k], eb = b[(k + 1) % 4] - b[k];
          altitude = Math::min(altitude, Math::min(from.cell_area(cell) / Math::sqrt(dot(ea, ea)),
                                                   to.cell_area(cell) / Math::sqrt(dot(eb, eb))));
          shift = Math::max(shift, dot(d, d));
        }
        most = Math::max(most, Math::sqrt(shift) / altitude);
      },
      Kokkos::Max<double>(largest));
  return largest;
}

/// What goes wrong on any rank goes wrong on all. Collective.
void require(bool holds, Exchange const &exchange, std::string const &what)
{
  if (exchange.max(holds ? 0.0 : 1.0) > 0.0)
    throw std::runtime_error(what);
}

void stepByRemap(Study &s, RemapDeck const &deck, Exchange const &exchange, StudyRow &row)
{
  RemapOptions options;
  options.order = deck.order;
  options.limiter = deck.limiter;
  options.swept_faces = deck.scheme == RemapScheme::Swept;
  RemapReport report;
  RemapResult result;
  auto const once = [&]
  {
    report = {};
    // The material rests: dt = 0. Its velocity is one more field.
    result = remap(s.next, Kinematics::Xfem, s.pairs, s.dof_nodes, s.state, s.regions, s.conditions, s.materials,
                   s.state.velocity, 0.0, {}, options, report, s.work, s.mesh.node_position, exchange);
    Kokkos::fence();
  };
  if (!s.work.kept)
    once(); // work arrays and classes, which belong to no step
  Kokkos::Timer timer;
  std::clock_t const cpu = std::clock();
  once();
  row.seconds += timer.seconds();
  row.cpu_seconds += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  require(report.failures == 0, exchange, "remap: a cell left its neighbourhood; expected: more steps");
  s.wall_impulse += report.wall_impulse;
  s.pairs = result.pairs;
  s.dof_nodes = result.dof_nodes;
  s.state = result.state;
  exchangeState(s.next, Kinematics::Xfem, exchange, s.next.halo, s.pairs, s.dof_nodes, s.state);
}

/// Set the field on mesh `next`.
void setValues(Study const &s, bool density, View<double *> const &value)
{
  auto const record = s.state.record;
  auto const volume = s.next.cell_volume;
  Kokkos::parallel_for(
      "Harmos::setValues", RangePolicy(0, s.next.num_cells), KOKKOS_LAMBDA(int cell) {
        if (density)
          record(cell, Mass) = value(cell) * volume(cell);
        else
          record(cell, InternalEnergy) = value(cell);
      });
}

/// The field without its material.
void stepByFields(Study &s, RemapDeck const &deck, Exchange const &exchange, StudyRow &row)
{
  RemapOptions options;
  options.order = deck.order;
  options.limiter = deck.limiter;
  View<double *> const value = valuesOf(s, deck.field.density), next("Harmos::next", s.mesh.num_cells);
  CellFields const fields{View<double **>(value.data(), s.mesh.num_cells, 1)};
  CellFields const remapped{View<double **>(next.data(), s.mesh.num_cells, 1)};
  int failures = 0;
  auto const once = [&]
  {
    failures = remapFields(s.next, s.mesh.node_position, fields, remapped, options, s.field_work, exchange);
    Kokkos::fence();
  };
  if (!s.field_work.scratch)
    once(); // work arrays, which belong to no step
  Kokkos::Timer timer;
  std::clock_t const cpu = std::clock();
  once();
  row.seconds += timer.seconds();
  row.cpu_seconds += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  require(failures == 0, exchange, "remap: a cell left its neighbourhood; expected: more steps");
  setValues(s, deck.field.density, next);
  exchangeState(s.next, Kinematics::Xfem, exchange, s.next.halo, s.pairs, s.dof_nodes, s.state);
}

void stepByComparator(Study &s, RemapDeck const &deck, StudyRow &row)
{
  View<double *> const value = valuesOf(s, false);
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), value);
  Kokkos::Timer timer;
  std::clock_t const cpu = std::clock();
  std::vector<double> const next =
      remapByComparator(deck.scheme, deck.order, s.mesh, s.next, {host.data(), host.data() + host.extent(0)});
  row.seconds += timer.seconds();
  row.cpu_seconds += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  for (std::size_t cell = 0; cell < next.size(); ++cell)
    host(cell) = next[cell];
  Kokkos::deep_copy(value, host);
  setValues(s, false, value);
}

StudyRow runOne(RemapDeck const &deck, int cells, Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  std::vector<double> const lines = gradedCoordinates(0.0, 1.0, cells, 1.0);
  HostMesh const whole = rectilinearMesh(lines, lines);
  Mesh mesh = buildLocalMesh(whole, partitionCells(whole, comm->getSize()), comm->getRank(),
                             comm->getSize() > 1 ? halo_layers : 0);
  setGeometry(mesh, deck.geometry);
  TpetraExchange const exchange(comm, mesh);
  Study s = makeStudy(mesh, deck);
  StudyRow row;
  row.cells = cells;
  row.steps = deck.stepsOf(cells);
  View<double *> const start = valuesOf(s, deck.field.density);
  Sums const before = sumsOf(s.mesh, start, start, exchange);
  Swirl const swirl = swirlOf(s, exchange);
  for (int step = 1; step <= row.steps; ++step)
  {
    placeNodes(deck.motion, cells, step, row.steps, s.reference, s.next);
    require(countInvertedCells(s.next) == 0, exchange, "remap: step " + std::to_string(step) + " folds a cell");
    row.courant = std::max(row.courant, exchange.max(courantOf(s.mesh, s.next)));
    bool const whole_records = deck.scheme == RemapScheme::Swept || deck.scheme == RemapScheme::Intersection;
    if (whole_records)
      stepByRemap(s, deck, exchange, row);
    else if (deck.scheme == RemapScheme::FieldIntersection)
      stepByFields(s, deck, exchange, row);
    else
      stepByComparator(s, deck, row);
    std::swap(s.mesh, s.next);
    if (whole_records)
      noteSwirl(swirl, swirlOf(s, exchange), deck.geometry, row);
    Sums const now = sumsOf(s.mesh, valuesOf(s, deck.field.density), start, exchange);
    row.conservation = std::max(row.conservation, std::fabs(now.total - before.total) / std::fabs(before.total));
    row.below = std::max(row.below, before.low - now.low);
    row.above = std::max(row.above, now.high - before.high);
  }
  Sums const after = sumsOf(s.mesh, valuesOf(s, deck.field.density), cellAverages(deck.field, s.mesh), exchange);
  row.l1 = after.l1;
  row.l2 = after.l2;
  row.linf = after.linf;
  row.seconds = exchange.max(row.seconds);
  exchange.sum(&row.cpu_seconds, 1);
  return row;
}

double orderOf(double coarse, double fine, StudyRow const &a, StudyRow const &b)
{
  return std::log(coarse / fine) / std::log(static_cast<double>(b.cells) / a.cells);
}

/// What stands in the way of writing; empty: nothing.
std::string claimFolder(RunOptions const &options)
{
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path const file = fs::path(options.directory) / "remap.csv";
  if (fs::exists(file, error) && !options.force)
    return "output directory '" + options.directory +
           "' holds results; use --force to overwrite them, or another --output";
  fs::create_directories(options.directory, error);
  if (!std::ofstream(file))
    return "cannot write " + file.string();
  return "";
}

/// All columns of a row; orders against the coarser row, nan without one.
std::vector<double> columnsOf(StudyRow const &row, StudyRow const *coarser)
{
  double const none = std::nan("");
  bool const has = coarser != nullptr;
  return {static_cast<double>(row.cells),
          static_cast<double>(row.steps),
          row.courant,
          row.l1,
          row.l2,
          row.linf,
          has ? orderOf(coarser->l1, row.l1, *coarser, row) : none,
          has ? orderOf(coarser->l2, row.l2, *coarser, row) : none,
          has ? orderOf(coarser->linf, row.linf, *coarser, row) : none,
          row.conservation,
          row.below,
          row.above,
          row.seconds,
          row.cpu_seconds,
          1e9 * row.cpu_seconds / (static_cast<double>(row.cells) * row.cells * row.steps),
          row.momentum,
          row.angular_momentum,
          row.kinetic_energy};
}

} // namespace

ExitStatus studyRemap(RemapDeck const &deck, RunOptions const &options,
                      Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  if (deck.compares() && comm->getSize() > 1)
    throw DeckError("scheme: comparators run on one rank; expected: swept, intersection or field intersection");
  if (!options.restart.empty())
    throw DeckError("--restart means nothing to remap");
  std::string const problem = comm->getRank() == 0 ? claimFolder(options) : "";
  int blocked = problem.empty() ? 0 : 1;
  Teuchos::broadcast(*comm, 0, &blocked);
  if (blocked != 0)
    throw DeckError(problem);
  bool const speaks = comm->getRank() == 0;
  std::ofstream file;
  if (speaks)
  {
    std::printf("%6s %6s %8s %10s %10s %10s %6s %6s %6s %9s %9s %9s %8s\n", "cells", "steps", "courant", "L1", "L2",
                "Linf", "order", "order", "order", "conserved", "below", "above", "ns/cell");
    file.open(std::filesystem::path(options.directory) / "remap.csv");
    file << "cells,steps,courant,L1,L2,Linf,order_L1,order_L2,order_Linf,conservation,below,above,seconds,cpu_seconds,"
            "cpu_ns_per_cell_step,momentum,angular_momentum,kinetic_energy\n";
    std::ofstream(std::filesystem::path(options.directory) / "deck.json") << deck.json << "\n";
  }
  std::vector<StudyRow> rows;
  for (int cells : deck.cells)
  {
    rows.push_back(runOne(deck, cells, comm));
    if (!speaks)
      continue;
    StudyRow const *const coarser = rows.size() > 1 ? &rows[rows.size() - 2] : nullptr;
    std::vector<double> const c = columnsOf(rows.back(), coarser);
    std::printf("%6.0f %6.0f %8.2g %10.4g %10.4g %10.4g %6.2f %6.2f %6.2f %9.1e %9.1e %9.1e %8.1f\n", c[0], c[1], c[2],
                c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11], c[14]);
    file << std::setprecision(17) << c[0];
    for (std::size_t i = 1; i < c.size(); ++i)
      file << ',' << c[i];
    file << std::endl;
  }
  return Completed;
}

} // namespace Harmos
