// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Simulation.hpp"

#include "Harmos_Interrupt.hpp"
#include "Harmos_Progress.hpp"
#include "Harmos_RunOutput.hpp"
#include "Harmos_Setup.hpp"
#include "Harmos_Version.hpp"

#include <Harmos_DeckSchema.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_Summary.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <sys/resource.h>

namespace Harmos
{
namespace
{

using CommRCP = Teuchos::RCP<Teuchos::Comm<int> const>;

/// What a failed run tells.
class RunFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A run between its set-up and its summary.
struct Run
{
  Run(Deck const &d, RunOptions const &o, CommRCP const &c) : deck(d), options(o), comm(c), progress(c->getRank() != 0)
  {
  }

  Deck const &deck;
  RunOptions const &options;
  CommRCP comm;
  Progress progress;
  DeckMesh whole;
  std::unique_ptr<Exchange> exchange;
  Scene scene;
  CycleState state;
  Ledger ledger;
  PhaseTimes times;
  double output_seconds = 0.0;
  std::vector<std::string> warnings;
  Kokkos::Timer timer;
  std::clock_t cpu_start = std::clock();
  long long first_cycle = 0;
  double first_time = 0.0;
};

void warn(Run &run, std::string const &text)
{
  std::size_t const most = 100;
  if (run.warnings.size() < most)
    run.warnings.push_back(text);
  run.progress.message("warning: " + text);
}

/// Results of an earlier run are never overwritten unawares. Rank 0 looks, all ranks throw alike.
void claimDirectory(Run &run)
{
  namespace fs = std::filesystem;
  std::string problem;
  if (run.comm->getRank() == 0)
  {
    std::error_code error;
    fs::path const directory = run.options.directory;
    bool const resumes = !run.options.restart.empty();
    if (fs::exists(directory / "history.csv", error) && !run.options.force && !resumes)
      problem = "output directory '" + directory.string() +
                "' holds results; use --force to overwrite them, or another --output";
    else
    {
      fs::create_directories(directory, error);
      if (error)
        problem = "cannot make output directory '" + directory.string() + "': " + error.message();
      else if (!resumes)
        for (char const *stale : {"summary.json", "fields.xdmf"})
          fs::remove(directory / stale, error);
    }
  }
  int length = static_cast<int>(problem.size());
  Teuchos::broadcast(*run.comm, 0, 1, &length);
  problem.resize(length);
  if (length > 0)
  {
    Teuchos::broadcast(*run.comm, 0, length, &problem[0]);
    throw DeckError(problem);
  }
}

Mesh makeLocalMesh(Run &run)
{
  run.whole = makeMesh(run.deck);
  int const ranks = run.comm->getSize();
  if (ranks == 1)
  {
    run.exchange = std::make_unique<Exchange>();
    return buildMesh(run.whole.mesh);
  }
  if (run.deck.kinematics == Kinematics::Lagrangian)
    throw DeckError("kinematics: lagrangian runs on one rank only (" + std::to_string(ranks) +
                    " given): its blocks share no nodes that a halo could follow");
  if (static_cast<std::size_t>(ranks) > run.whole.mesh.cell.size())
    throw DeckError("mesh: " + std::to_string(run.whole.mesh.cell.size()) + " cells cannot be shared by " +
                    std::to_string(ranks) + " ranks");
  Mesh const mesh =
      buildLocalMesh(run.whole.mesh, partitionCells(run.whole.mesh, ranks), run.comm->getRank(), halo_layers);
  run.exchange = std::make_unique<TpetraExchange>(run.comm, mesh);
  return mesh;
}

/// The state from a checkpoint: the same bits that the interrupted run had.
void restoreState(Run &run, CheckpointScalars const &scalars, MPI_Comm mpi)
{
  if (scalars.material_names != materialNames(run.deck))
    throw DeckError("--restart " + run.options.restart + ": its materials are not those of the deck");
  if (scalars.kinematics != run.deck.kinematics)
    throw DeckError("--restart " + run.options.restart + ": its kinematics is not that of the deck");
  CheckpointState read = readCheckpoint(mpi, run.options.restart, run.scene.mesh);
  CycleState &s = run.state;
  s.pairs = read.pairs;
  s.state.record = read.record;
  s.state.centroid = read.centroid;
  s.dof_nodes = buildDofNodes(run.scene.mesh, run.deck.kinematics, read.record, s.pairs);
  s.state.velocity = dofVelocities(s.pairs, s.dof_nodes, read.corner_velocity);
  s.bodies = scalars.bodies;
  s.time = scalars.time;
  s.cycle = scalars.cycle;
  prepareWork(s.pairs, s.dof_nodes, s.work);
  computeNodeAltitudes(run.scene.mesh, s.work);
  s.dt = scalars.dt;
  run.ledger = Ledger::fromValues(scalars.arrays.at("ledger"));
  run.first_cycle = s.cycle;
  run.first_time = s.time;
}

void startLedger(Run &run)
{
  Totals const totals = computeTotals(run.scene, run.state, static_cast<int>(run.deck.fields.size()), false);
  Ledger &l = run.ledger;
  l.energy0 = totals.kinetic_energy + totals.internal_energy;
  l.mass0 = totals.mass;
  l.momentum0_x = totals.momentum_x;
  l.momentum0_y = totals.momentum_y;
  l.noteErrors(0.0, 0.0, 0.0, l.energy0, totals.speed_momentum);
  if (!(totals.mass > 0.0) && run.state.bodies.empty())
    throw DeckError("bodies: no body has any mass inside of the mesh");
}

void book(Ledger &l, CycleReport const &report, Exchange const &exchange)
{
  RemapReport const &remap = report.remap;
  double sums[8] = {
      remap.kinetic_loss,        remap.overlap_volume,      remap.void_volume,    remap.outflow_mass,
      remap.outflow_momentum[0], remap.outflow_momentum[1], remap.outflow_energy, static_cast<double>(remap.merged)};
  exchange.sum(sums, 8);
  l.external_work += report.external_work;
  l.contact_loss += report.constraint.contact_loss;
  l.external_impulse_x += report.external_impulse[0];
  l.external_impulse_y += report.external_impulse[1];
  l.remap_loss += sums[0];
  l.overlap_volume += sums[1];
  l.void_volume += sums[2];
  l.outflow_mass += sums[3];
  l.outflow_momentum_x += sums[4];
  l.outflow_momentum_y += sums[5];
  l.outflow_energy += sums[6];
  l.merged += sums[7];
  l.unconverged_cycles += report.constraint.converged ? 0.0 : 1.0;
  l.light_nodes += static_cast<double>(report.light_nodes);
  l.repeats += report.repeats;
}

std::string placeOf(Run const &run, int cell, int material)
{
  std::string place;
  if (cell >= 0)
  {
    auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), run.scene.mesh.cell_global);
    place = "cell " + std::to_string(global(cell)) + " on rank " + std::to_string(run.comm->getRank());
  }
  std::vector<std::string> const names = materialNames(run.deck);
  if (material >= 0 && material < static_cast<int>(names.size()))
    place += ", material " + names[material];
  return place;
}

/// All ranks throw when one has a cause; the lowest rank's words are used.
void throwTogether(Run const &run, std::string cause)
{
  int mine = cause.empty() ? run.comm->getSize() : run.comm->getRank(), first = mine;
  Teuchos::reduceAll(*run.comm, Teuchos::REDUCE_MIN, 1, &mine, &first);
  if (first == run.comm->getSize())
    return;
  int length = static_cast<int>(cause.size());
  Teuchos::broadcast(*run.comm, first, 1, &length);
  cause.resize(length);
  Teuchos::broadcast(*run.comm, first, length, &cause[0]);
  throw RunFailure(cause);
}

/// What makes a state useless stops the run: with cycle, cell, material and cause.
void checkCycle(Run const &run, CycleReport const &report)
{
  std::string cause;
  UpdateReport const &u = report.update;
  if (u.inverted > 0)
    cause = "a moved cell is inverted: " + placeOf(run, u.cell, u.material);
  else if (u.not_a_number > 0)
    cause = "a value is not a number, or a specific volume not positive: " + placeOf(run, u.cell, u.material);
  else if (report.remap.failures > 0)
    cause = "the overlays of a donor do not add up to it: " + placeOf(run, report.remap.first_failed_cell, -1);
  else if (report.reconstruction.failures > 0)
    cause = "an interface could not be placed: " + placeOf(run, report.reconstruction.first_failed_cell, -1);
  if (!cause.empty())
    cause = "cycle " + std::to_string(run.state.cycle) + ": " + cause;
  throwTogether(run, cause);
  // Below this a run would crawl for ever: some cell shrinks or some speed grows without bound.
  double const smallest = 1e-7 * run.deck.run.end_time / 1e3;
  if (!(run.state.dt > smallest))
    throwTogether(run, "cycle " + std::to_string(run.state.cycle) + ": the time step " + std::to_string(run.state.dt) +
                           " s is too small" +
                           (run.state.limit.cell >= 0
                                ? ": set by " + placeOf(run, run.state.limit.cell, run.state.limit.material)
                                : ""));
}

void writeRunSummary(Run const &run, RunOutput const &output, std::string const &status)
{
  (void)output;
  Summary s;
  s.status = status;
  s.cycles = run.state.cycle;
  s.end_time = run.state.time;
  s.pair_steps = std::llround(run.ledger.pair_steps);
  s.cell_steps = std::llround(run.ledger.cell_steps);
  s.wall_seconds = run.timer.seconds();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double sums[2] = {static_cast<double>(std::clock() - run.cpu_start) / CLOCKS_PER_SEC,
                    1024.0 * static_cast<double>(usage.ru_maxrss)};
  run.exchange->sum(sums, 2);
  s.cpu_seconds = sums[0];
  s.peak_memory_bytes = std::llround(sums[1]);
  s.phases = {{"reconstruct", run.times.reconstruct}, {"lagrange", run.times.lagrange},
              {"constrain", run.times.constrain},     {"remap", run.times.remap},
              {"exchange", run.times.exchange},       {"output", run.output_seconds}};
  s.pair_steps_per_second = s.wall_seconds > 0.0 ? run.ledger.pair_steps / s.wall_seconds : 0.0;
  s.ranks = run.comm->getSize();
  s.mass_error = run.ledger.largest_mass_error;
  s.momentum_error = run.ledger.largest_momentum_error;
  s.energy_error = run.ledger.largest_energy_error;
  s.unconverged_cycles = std::llround(run.ledger.unconverged_cycles);
  s.warnings = run.warnings;
  s.versions = versions();
  s.deck_json = run.deck.json;
  if (run.comm->getRank() == 0)
    writeSummary(run.options.directory + "/summary.json", s);
}

bool finished(Run const &run)
{
  return run.state.time >= run.deck.run.end_time * (1.0 - 1e-12) ||
         (run.deck.run.max_cycles > 0 && run.state.cycle >= run.deck.run.max_cycles);
}

/// Land on the end exactly, without a last splinter of a step.
void shortenLastStep(Run &run)
{
  double const left = run.deck.run.end_time - run.state.time;
  if (run.state.dt >= left * (1.0 - 1e-9))
    run.state.dt = left;
  else if (run.state.dt > 0.5 * left)
    run.state.dt = 0.5 * left;
}

void reportConvergence(Run &run, CycleReport const &report)
{
  if (report.constraint.converged)
    return;
  // One line for the first and then for every tenfold number of such cycles.
  double const count = run.ledger.unconverged_cycles;
  double const decade = std::floor(std::log10(count));
  if (count == std::pow(10.0, decade))
  {
    char text[160];
    std::snprintf(text, sizeof text,
                  "cycle %lld: the multipliers stopped at residual %.2e after %d iterations (%.0f such cycles so far)",
                  run.state.cycle, report.constraint.residual, report.constraint.iterations, count);
    warn(run, text);
  }
}

ExitStatus loop(Run &run, RunOutput &output)
{
  CycleReport report;
  if (run.options.restart.empty())
    output.write(run.scene, run.state, report, run.ledger, 0.0, false);
  double const cells = static_cast<double>(run.whole.mesh.cell.size());
  while (!finished(run))
  {
    shortenLastStep(run);
    report = advance(run.scene, run.state, run.times);
    book(run.ledger, report, *run.exchange);
    checkCycle(run, report);
    reportConvergence(run, report);
    run.ledger.cell_steps += cells;
    long long pairs[1] = {run.state.pairs.num_pairs};
    if (run.exchange->size() > 1)
      pairs[0] = countOwnedPairs(run.scene.mesh, run.state.pairs);
    run.exchange->sum(pairs, 1);
    run.ledger.pair_steps += static_cast<double>(pairs[0]);

    double const wall = run.exchange->max(run.timer.seconds());
    bool const stop = run.exchange->max(interrupted() ? 1.0 : 0.0) > 0.0;
    Kokkos::Timer output_timer;
    output.write(run.scene, run.state, report, run.ledger, wall, finished(run));
    run.output_seconds += output_timer.seconds();
    double const done = (run.state.time - run.first_time) / (run.deck.run.end_time - run.first_time);
    run.progress.update(done, run.state.time, report.dt, run.state.cycle, wall,
                        cells * static_cast<double>(run.state.cycle - run.first_cycle) / wall);
    if (stop && !finished(run))
    {
      std::string const file = output.checkpoint(run.scene, run.state, run.ledger);
      run.progress.message("interrupted: continue with --restart " + file);
      return Interrupted;
    }
  }
  return Completed;
}

} // namespace

ExitStatus simulate(Deck const &deck, RunOptions const &options, CommRCP const &comm)
{
  Run run(deck, options, comm);
  // All that can be wrong with the input is found before the first file is touched.
  Mesh const mesh = makeLocalMesh(run);
  run.scene = makeScene(deck, run.whole, mesh, *run.exchange);
  if (options.restart.empty())
  {
    run.state = makeInitialState(deck, run.whole, run.scene);
    startLedger(run);
  }
  else
    restoreState(run, readCheckpointScalars(options.restart), MPI_COMM_WORLD);
  ReconstructionReport reconstruction;
  reconstructState(run.scene, run.state, reconstruction);
  claimDirectory(run);

  RunOutput output(deck, options, comm, options.restart.empty() ? -1 : run.state.cycle, run.state.time);
  try
  {
    ExitStatus const status = loop(run, output);
    run.progress.finish();
    writeRunSummary(run, output, status == Completed ? "completed" : "interrupted");
    return status;
  }
  catch (RunFailure const &failure)
  {
    std::string text = std::string("failed: ") + failure.what();
    if (!output.lastCheckpoint().empty())
      text += "; the last checkpoint is " + output.lastCheckpoint();
    run.warnings.push_back(text);
    run.progress.finish();
    if (comm->getRank() == 0)
      std::fprintf(stderr, "harmos: %s\n", text.c_str());
    writeRunSummary(run, output, "failed");
    return FailedRun;
  }
}

} // namespace Harmos
