// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Run.hpp"

#include "Harmos_PrescribedCycle.hpp"
#include "Harmos_TargetMesh.hpp"

#include <Harmos_CellFillings.hpp>
#include <Harmos_DeckSchema.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_ResultFiles.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <unistd.h>

namespace Harmos
{
namespace
{

/// What keeps the results of another run, or what bears their names, from being replaced; empty: nothing.
std::string resultsProblem(Run const &run, std::filesystem::path const &directory)
{
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> const results = resultFiles(directory);
  for (fs::path const &file : results)
    if (fs::is_directory(file, error))
      return "'" + file.string() + "' is a folder, where a file of results would be; expected: another --output";
  if (!results.empty() && !run.options.force && !run.start.append)
    return "output directory '" + directory.string() + "' holds results (" + results.front().filename().string() +
           "); use --force to overwrite them, or another --output";
  if (!run.start.append || !fs::exists(directory / "history.csv", error))
    return "";
  std::vector<std::string> names;
  for (FieldSpec const &field : run.deck.fields)
    names.push_back(field.name);
  std::ifstream history(directory / "history.csv");
  std::string header;
  if (!std::getline(history, header) || header != historyHeader(names, run.deck.remap.measure_overlap))
    return "--restart: the columns of '" + (directory / "history.csv").string() + "' are not those of this run";
  return "";
}

/// Take the lock of a folder that is there. \return Who has it already, as a message; empty: nobody.
std::string lockProblem(Run &run)
{
  std::string const &directory = run.options.directory;
  if (!run.lock)
    run.lock = std::make_unique<FolderLock>(directory);
  if (run.lock->holder().empty())
    return "";
  return "output directory '" + directory + "' is in use by another run (" + run.lock->holder() +
         "); expected: another --output, or to wait for its end";
}

/// What stands in the way of writing to the run's folder; empty: nothing. What is in it is looked at when no other run
/// can change it any more.
std::string folderProblem(Run &run)
{
  std::error_code error;
  std::filesystem::path const directory = run.options.directory;
  std::filesystem::create_directories(directory, error);
  if (error)
    return "cannot make output directory '" + directory.string() + "': " + error.message();
  std::string problem = lockProblem(run);
  if (problem.empty())
    problem = resultsProblem(run, directory);
  if (!problem.empty())
    return problem;
  if (::access(directory.c_str(), W_OK) != 0)
    return "cannot write to output directory '" + directory.string() + "': " + std::strerror(errno);
  return "";
}

/// Contact looks for its partner as far as the square root of a cell's area: the halo holds what lies two cells away.
void checkReach(Deck const &deck, HostMesh const &mesh)
{
  std::vector<Boundary> const boundary(deck.boundary, deck.boundary + num_boundary_sides);
  if (deck.prescribed.kind != FieldKind::None || !contactCanArise(deck.kinematics, deck.fields.size(), boundary))
    return;
  double most = 0.0;
  for (std::array<int, 4> const &cell : mesh.cell)
  {
    Quadrilateral q;
    for (int k = 0; k < 4; ++k)
      q[k] = {mesh.node[cell[k]][0], mesh.node[cell[k]][1]};
    most = std::max(most, elongation(q));
  }
  if (most > largest_shared_aspect)
    throw DeckError("mesh: cells of aspect ratio up to " + std::to_string(most + std::sqrt(most * most - 1.0)) +
                    ", across which contact reaches on one rank only; expected: at most 4");
}

Mesh makeLocalMesh(Run &run)
{
  run.whole = makeMesh(run.deck);
  int const ranks = run.comm->getSize();
  if (ranks == 1)
  {
    run.exchange = std::make_unique<Exchange>();
    Mesh mesh = buildMesh(run.whole.mesh);
    setGeometry(mesh, run.deck.geometry);
    return mesh;
  }
  if (run.deck.kinematics == Kinematics::Lagrangian)
    throw DeckError("kinematics: lagrangian runs on one rank only (" + std::to_string(ranks) +
                    " given): its blocks share no nodes that a halo could follow");
  if (static_cast<std::size_t>(ranks) > run.whole.mesh.cell.size())
    throw DeckError("mesh: " + std::to_string(run.whole.mesh.cell.size()) + " cells cannot be shared by " +
                    std::to_string(ranks) + " ranks");
  checkReach(run.deck, run.whole.mesh);
  Mesh mesh = buildLocalMesh(run.whole.mesh, partitionCells(run.whole.mesh, ranks), run.comm->getRank(), halo_layers);
  setGeometry(mesh, run.deck.geometry);
  run.exchange = std::make_unique<TpetraExchange>(run.comm, mesh);
  return mesh;
}

/// Why a field has no mass.
std::string whyNothing(Deck const &deck, int field)
{
  double area = 0.0;
  for (BodySpec const &body : deck.bodies)
    if (body.field == field && body.shape.kind != ShapeKind::MeshPart)
      area += makeShape(body.shape).area();
  double const part = area / (deck.x.smallestCell() * deck.y.smallestCell());
  if (part >= 4.0 * least_fraction) // of the cells around a node
    return "nothing of it lies inside of the mesh";
  char text[120];
  std::snprintf(text, sizeof text, "it fills %.2g of a cell; expected: a body that fills %g of one at least", part,
                least_fraction);
  return text;
}

void startLedger(Run &run)
{
  Totals const totals = computeTotals(run.scene, run.state, static_cast<int>(run.deck.fields.size()), false);
  Ledger &l = run.ledger;
  l.energy0 = totals.kinetic_energy + totals.internal_energy;
  l.mass0 = totals.mass;
  l.momentum0_x = totals.momentum_x;
  l.momentum0_y = totals.momentum_y;
  l.angular_momentum0 = totals.angular_momentum;
  l.noteErrors(0.0, 0.0, 0.0, l.energy0, totals.speed_momentum);
  for (std::size_t m = 0; m < run.deck.fields.size(); ++m)
    if (run.deck.fields[m].rigid_body < 0 && !(totals.material[m].mass > 0.0))
      throw DeckError("bodies/" + run.deck.fields[m].name + ": " + whyNothing(run.deck, static_cast<int>(m)));
}

/// A speed at which the squares of the cycle lose all digits. \throw DeckError on all ranks alike.
void refuseAbsurdSpeeds(Run const &run)
{
  double const most = 299792458.0; // of light
  CycleState const &s = run.state;
  auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.pairs.material);
  auto const dof_node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.pairs.dof_node);
  auto const velocity = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.state.velocity);
  std::vector<std::string> const names = materialNames(run.deck);
  auto const refusal = [most](std::string const &key, double speed)
  {
    char text[100];
    std::snprintf(text, sizeof text, ": a speed of %.3g m/s; expected: at most that of light, %.0f", speed, most);
    return key + text;
  };
  std::string cause;
  bool absurd = false;
  for (std::size_t dof = 0; dof < velocity.extent(0); ++dof)
    absurd = absurd || !(Math::fabs(velocity(dof, 0)) <= 0.5 * most && Math::fabs(velocity(dof, 1)) <= 0.5 * most);
  for (int pair = 0; absurd && cause.empty() && pair < s.pairs.num_pairs; ++pair)
    for (int k = 0; k < 4; ++k)
    {
      double const speed = std::hypot(velocity(dof_node(pair, k), 0), velocity(dof_node(pair, k), 1));
      if (!(speed <= most))
        cause = refusal("bodies/" + names[material(pair)], speed);
    }
  char const *const side_name[] = {"left", "right", "bottom", "top"};
  for (int side = 0; side < num_boundary_sides; ++side)
  {
    double const speed = norm(run.deck.boundary[side].velocity);
    if (!(speed <= most))
      cause = refusal(std::string("boundaries/") + side_name[side], speed);
  }
  cause = firstCause(*run.comm, cause);
  if (!cause.empty())
    throw DeckError(cause);
}

/// Steps with which the run would never get going. \throw DeckError on all ranks alike.
void refuseTinySteps(Run &run)
{
  RunSpec const &given = run.deck.run;
  double const stable = std::min(run.exchange->min(run.state.limit.dt), given.end_time);
  run.ledger.first_step = std::min(stable, run.scene.max_dt);
  std::pair<char const *, double> const keys[] = {{"max_dt", given.max_dt}, {"initial_dt", given.initial_dt}};
  for (auto const &[key, value] : keys)
  {
    char text[140];
    std::snprintf(text, sizeof text, "run/%s: %g s is too small; expected: more than %g of the stable step, %.3g s",
                  key, value, smallest_step, stable);
    if (value > 0.0 && !(value > smallest_step * stable))
      throw DeckError(text);
  }
}

/// A prescribed field that carries a body through a side of the mesh at once. \throw DeckError on all ranks alike.
void refuseSideCrossing(Run const &run)
{
  if (run.scene.prescribed.kind == FieldKind::None)
    return;
  SideCrossing const crossing = findSideCrossing(run.scene, run.state);
  std::string const cause = firstCause(
      *run.comm, crossing.cell < 0 ? ""
                                   : "prescribed_velocity: it carries body " + run.deck.fields[crossing.material].name +
                                         " through a side of the mesh; expected: bodies that keep off "
                                         "the cells at sides that the field crosses");
  if (!cause.empty())
    throw DeckError(cause);
}

void placeTracers(Run &run)
{
  std::vector<Vector2> points;
  for (PointSpec const &point : run.deck.tracers)
    points.push_back(point.position);
  std::vector<long long> const cell = locatePoints(run.scene.mesh, points, *run.exchange);
  std::vector<PointSample> const sample =
      samplePoints(pointField(run.scene, run.state), points, cell, std::vector<int>(points.size(), -1), *run.exchange);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (sample[i].material < 0)
      throw DeckError("tracers/" + run.deck.tracers[i].name +
                      "/position: void is there; a tracer moves with a material");
    run.state.tracers.push_back({points[i], sample[i].velocity, cell[i], sample[i].material});
  }
}

} // namespace

void warn(Run &run, std::string const &text)
{
  std::size_t const most = 100;
  bool const told = std::find(run.warnings.begin(), run.warnings.end(), text) != run.warnings.end(); // before a restart
  if (run.warnings.size() < most && !told)
    run.warnings.push_back(text);
  run.progress.message("warning: " + text);
}

std::string firstCause(Teuchos::Comm<int> const &comm, std::string cause)
{
  int mine = cause.empty() ? comm.getSize() : comm.getRank(), first = mine;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &mine, &first);
  if (first == comm.getSize())
    return "";
  int length = static_cast<int>(cause.size());
  Teuchos::broadcast(comm, first, 1, &length);
  cause.resize(length);
  Teuchos::broadcast(comm, first, length, &cause[0]);
  return cause;
}

namespace
{

/// Splinters of interfaces were seen to jump from end to end of cells longer than those that several ranks allow. In
/// strips of one cell no interface is oblique.
void warnOfLongCells(Run &run)
{
  Deck const &deck = run.deck;
  if (deck.kinematics != Kinematics::Xfem || deck.fields.size() < 2 || run.scene.prescribed.kind != FieldKind::None ||
      deck.x.cells == 1 || deck.y.cells == 1)
    return;
  double const aspect = run.exchange->max(largestElongation(run.scene.mesh));
  if (!(aspect > largest_shared_aspect))
    return;
  char text[200];
  std::snprintf(text, sizeof text,
                "mesh: cells are up to %.3g times as long as wide; beyond 4 splinters of the bodies' interfaces may "
                "jump over them, and contact is rough",
                aspect + std::sqrt(aspect * aspect - 1.0)); // (r + 1/r)/2 = aspect
  warn(run, text);
}

void warnOfIdleKeys(Run &run)
{
  if (run.deck.idle_keys.empty())
    return;
  bool const prescribed = run.deck.prescribed.kind != FieldKind::None;
  warn(run, joined(run.deck.idle_keys) + ": without effect in this run (" +
                (prescribed ? "a prescribed velocity" : "these kinematics and bodies") + ")");
}

/// "mesh: 200 x 100 cells", or the cells of all blocks.
std::string sizeOf(Deck const &deck)
{
  long long cells = 0;
  for (BodySpec const &body : deck.bodies)
    cells += static_cast<long long>(body.cells[0]) * body.cells[1];
  if (deck.kinematics == Kinematics::Lagrangian)
    return "bodies: " + std::to_string(cells) + " cells";
  return "mesh: " + std::to_string(deck.x.cells) + " x " + std::to_string(deck.y.cells) + " cells";
}

/// \throw std::runtime_error where a body is cut out of a rigid one: contact and motion go by its outline, which has no
/// hole but an annulus's.
void refuseCutRigidBodies(Deck const &deck, Mesh const &mesh)
{
  constexpr double touching = 1e-6; // of a cell
  if (deck.kinematics == Kinematics::Lagrangian)
    return;
  for (std::size_t i = 0; i < deck.bodies.size(); ++i)
    for (std::size_t j = i + 1; j < deck.bodies.size(); ++j)
    {
      if (!deck.laws[deck.bodies[i].law].rigid || !deck.bodies[j].cut)
        continue;
      Shape const shape[2] = {paintedBody(deck.bodies[i]).shape, paintedBody(deck.bodies[j]).shape};
      if (shape[0].boundingBox().meets(shape[1].boundingBox()) && mostFilled(mesh, shape) > 1.0 + touching)
        throw std::runtime_error("bodies/" + deck.bodies[j].name + "/cut: the rigid body " + deck.bodies[i].name +
                                 " cannot be cut, its outline stays whole; expected: false, or a shape for " +
                                 deck.bodies[i].name + " that leaves room (annulus, polygon)");
    }
}

/// Of the file, not of the deck.
class CheckpointError : public DeckError
{
public:
  using DeckError::DeckError;
};

void restoreCheckpoint(Run &run)
{
  try
  {
    restoreState(run);
  }
  catch (std::exception const &error)
  {
    std::string const &file = run.options.restart;
    std::string const older = isSound(file) ? "" : soundCheckpointBefore(file);
    throw CheckpointError("--restart " + file + ": " + error.what() +
                          (older.empty() ? "" : "; sound is the one before, " + older));
  }
}

// What one rank alone meets (bodies that overlap in its cells) all ranks throw.
void prepare(Run &run)
{
  bool const fresh = run.options.restart.empty();
  std::string cause, part;
  try
  {
    Mesh const mesh = makeLocalMesh(run);
    run.scene = makeScene(run.deck, run.whole, mesh, *run.exchange);
    refuseCutRigidBodies(run.deck, mesh);
    part = "bodies: ";
    if (fresh)
      run.state = makeInitialState(run.deck, run.whole, run.scene);
  }
  catch (std::bad_alloc const &)
  {
    cause = sizeOf(run.deck) + ": the memory does not hold that many";
  }
  catch (std::exception const &error)
  {
    cause = part + error.what();
  }
  cause = firstCause(*run.comm, cause);
  if (!cause.empty())
    throw DeckError(cause);
  if (!fresh)
    restoreCheckpoint(run);
  double const restored_dt = run.state.dt;
  ReconstructionReport const reconstruction = startCycle(run.scene, run.state);
  if (!fresh)
    run.state.dt = restored_dt;
  else
  {
    refuseAbsurdSpeeds(run);
    if (run.deck.run.initial_dt > 0.0)
      run.state.dt = std::min(run.state.dt, run.deck.run.initial_dt);
    refuseTinySteps(run);
    refuseSideCrossing(run);
    startLedger(run);
  }
  cause = reconstruction.failures == 0 ? "" : "an interface could not be placed: " + failedCell(run, reconstruction);
  cause = firstCause(*run.comm, cause);
  if (!cause.empty())
    throw DeckError(cause);
  if (fresh)
    placeTracers(run);
  warnOfLongCells(run);
  warnOfIdleKeys(run);
}

} // namespace

void setUp(Run &run)
{
  try
  {
    prepare(run);
  }
  catch (CheckpointError const &)
  {
    throw;
  }
  catch (DeckError const &error)
  {
    throw DeckError(run.deck.file + ": " + error.what());
  }
}

void lockDirectory(Run &run)
{
  std::error_code error;
  bool const looks = run.comm->getRank() == 0 && std::filesystem::is_directory(run.options.directory, error);
  std::string const problem = firstCause(*run.comm, looks ? lockProblem(run) : "");
  if (!problem.empty())
    throw DeckError(problem);
}

void claimDirectory(Run &run)
{
  namespace fs = std::filesystem;
  std::error_code error;
  run.start.append = run.start.restarted &&
                     fs::equivalent(fs::absolute(run.options.restart).parent_path(), run.options.directory, error);
  bool const first = run.comm->getRank() == 0;
  std::string const problem = firstCause(*run.comm, first ? folderProblem(run) : "");
  if (!problem.empty())
    throw DeckError(problem);
  // What an earlier run left goes, also what this one would not replace; of one that goes on, how it ended.
  for (fs::path const &file : first ? resultFiles(run.options.directory) : std::vector<fs::path>())
    if (!run.start.append || file.filename() == "summary.json")
      fs::remove(file, error);
}

} // namespace Harmos
