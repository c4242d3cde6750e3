// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Simulation.hpp"

#include "Harmos_Interrupt.hpp"
#include "Harmos_Run.hpp"
#include "Harmos_TargetMesh.hpp"

#include <Harmos_DeckSchema.hpp>
#include <Harmos_Failure.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Harmos
{
namespace
{

void book(Ledger &l, CycleReport const &report, Exchange const &exchange)
{
  RemapReport const &remap = report.remap;
  double sums[17] = {remap.kinetic_loss,
                     remap.overlap_volume,
                     remap.void_volume,
                     remap.outflow_mass,
                     remap.outflow_momentum[0],
                     remap.outflow_momentum[1],
                     remap.outflow_energy,
                     static_cast<double>(remap.merged),
                     static_cast<double>(report.reconstruction.unfinished_cells),
                     static_cast<double>(report.update.out_of_range),
                     remap.returned_heat,
                     static_cast<double>(report.light_nodes),
                     remap.closed_volume,
                     static_cast<double>(report.reconstruction.greedy_cells),
                     static_cast<double>(remap.bounded),
                     remap.gas_work,
                     remap.gas_heat};
  exchange.sum(sums, 17);
  l.external_work += report.external_work;
  l.contact_loss += report.constraint.contact_loss + sums[15];
  l.gas_work += sums[15];
  l.gas_heat += sums[16];
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
  l.unfinished_interfaces += sums[8];
  l.out_of_range += sums[9];
  l.returned_heat += sums[10];
  l.unconverged_cycles += report.constraint.converged ? 0.0 : 1.0;
  l.broken_bonds += report.broken_bonds;
  l.light_nodes += sums[11];
  l.closed_volume += sums[12];
  l.greedy_cells += sums[13];
  l.bounded += sums[14];
  l.repeats += report.repeats;
  l.restored_volume += report.restored_volume;
  l.noteOverlap(remap.moved_overlap.volume, remap.moved_overlap.largest, remap.moved_overlap.place);
  l.noteRemappedOverlap(remap.remapped_overlap.volume, remap.remapped_overlap.largest);
}

/// What to say of a condensed material without a failure law that is stretched to less than half of its density: its
/// equation of state is not meant for that, which is often why a run ends.
std::string stretchedWithoutFailure(Run const &run, int material)
{
  LawSpec const &spec = run.deck.laws[run.deck.fields[material].law];
  if (spec.rigid || canFail(spec.law) || spec.law.eos == EosKind::IdealGas)
    return "";
  CellMaterialPairs const pairs = run.state.pairs;
  auto const record = run.state.state.record;
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::largestSpecificVolume", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair, double &value) {
        double const specific_volume = record(pair, SpecificVolume);
        if (pairs.material(pair) == material && specific_volume > value)
          value = specific_volume;
      },
      Kokkos::Max<double>(largest));
  double const ratio = largest * spec.law.density0;
  if (!(ratio > 2.0))
    return "";
  char text[200];
  std::snprintf(
      text, sizeof text,
      "; it is stretched to %.2g of its density and has no failure law (spall_pressure, spall_stress, damage)",
      1.0 / ratio);
  return text;
}

/// All ranks throw when one has a cause; the lowest rank's words are used.
void throwTogether(Run const &run, std::string const &cause)
{
  std::string const first = firstCause(*run.comm, cause);
  if (!first.empty())
    throw RunFailure(first);
}

/// The run would crawl for ever: some cell shrinks or some speed grows without bound. The rank of the limiting pair
/// names it.
void failByTimeStep(Run const &run)
{
  TimeStepLimit const &limit = run.state.limit;
  bool const mine = limit.cell >= 0 && limit.dt == run.exchange->min(limit.dt);
  char text[120];
  std::snprintf(text, sizeof text, "cycle %lld: the time step %.3e s is too small, beside %.3e s at the start",
                run.state.cycle, run.state.dt, run.ledger.first_step);
  throwTogether(run, mine ? std::string(text) + ": set by " + placeOf(run, limit.cell, limit.material) : "");
  throw RunFailure(text);
}

/// The materials of a cell.
std::vector<int> materialsOf(Run const &run, int cell)
{
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), run.state.pairs.offset);
  auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), run.state.pairs.material);
  return {material.data() + offset(cell), material.data() + offset(cell + 1)};
}

/// A cell that gets more materials than there is room for: which, and what to do.
std::string crowdedCell(Run const &run, int cell, std::string const &most)
{
  std::vector<std::string> const names = materialNames(run.deck);
  std::string list;
  for (int material : materialsOf(run, cell))
    list += (list.empty() ? "" : ", ") + names[material];
  return placeOf(run, cell, -1) + "; " + most + ": " + list +
         "; expected: smaller cells there, or bodies of one law that share a field (bodies/NAME/join)";
}

std::string remapFailure(Run const &run, RemapReport const &report)
{
  if (report.first_failed_material >= 0)
    return "the overlays of a donor do not add up to it: " +
           placeOf(run, report.first_failed_cell, report.first_failed_material);
  int const cell = report.first_failed_cell;
  return "more materials come into a cell than it can hold: " +
         crowdedCell(run, cell,
                     std::to_string(materialsOf(run, cell).size()) + " have room, and at least one more comes");
}

/// What makes a state useless stops the run: with cycle, cell, material and cause.
void checkCycle(Run const &run, CycleReport const &report)
{
  std::string cause;
  UpdateReport const &u = report.update;
  if (std::isnan(report.constraint.residual))
    cause = "the impulses of contact are not numbers";
  else if (report.crossing_cell >= 0)
    cause = "the prescribed field carries material through a side of the mesh: " +
            placeOf(run, report.crossing_cell, report.crossing_material);
  else if (u.inverted > 0)
    cause = "a moved cell is inverted: " + placeOf(run, u.cell, u.material);
  else if (u.not_a_number > 0)
    cause = "a value is not a number, a mass negative, or a specific volume not positive: " +
            placeOf(run, u.cell, u.material);
  else if (report.remap.failures > 0)
    cause = remapFailure(run, report.remap);
  else if (report.reconstruction.failures > 0)
    cause = "an interface could not be placed: " + failedCell(run, report.reconstruction);
  if (!cause.empty())
    cause = "cycle " + std::to_string(run.state.cycle) + ": " + cause;
  throwTogether(run, cause);
  if (!(run.state.dt > smallest_step * run.ledger.first_step))
    failByTimeStep(run);
}

/// The errors of the present state, where the history has no row of it too.
void noteErrors(Run &run)
{
  Totals const totals = computeTotals(run.scene, run.state, static_cast<int>(run.deck.fields.size()), false);
  noteErrors(run.scene.mesh.geometry, totals, run.ledger);
}

/// Bodies that go through each other do so without an error of mass, momentum or energy: the sum of what their regions
/// overlapped tells.
void warnOfOverlaps(Run &run)
{
  constexpr double sizeable = 0.05; // of what all materials fill
  Totals const totals = computeTotals(run.scene, run.state, static_cast<int>(run.deck.fields.size()), false);
  double filled = 0.0;
  for (HistoryMaterial const &material : totals.material)
    filled += material.volume;
  double const part = filled > 0.0 ? run.ledger.overlap_volume / filled : 0.0;
  if (part <= sizeable)
    return;
  char text[200];
  std::snprintf(
      text, sizeof text,
      "materials were moved into each other by %.0f%% of what they fill, summed over the run (overlap_volume): "
      "look whether they go through each other",
      100.0 * part);
  warn(run, text);
}

/// Contact has nothing to give: where it did, what it constrains is not stable.
void warnOfGain(Run &run)
{
  constexpr double sizeable = 0.01; // of the largest energy
  Ledger const &l = run.ledger;
  if (!(-l.contact_loss > sizeable * l.largest_energy))
    return;
  char text[320];
  std::snprintf(
      text, sizeof text,
      "contact gave energy, %.2e (contact_loss) beside %.2e that the scene had at most: what it moved is not "
      "to be trusted. Gas that is squeezed to remnants between bodies does that, penalties that are too stiff, and "
      "friction with restitution at corners",
      -l.contact_loss, l.largest_energy);
  warn(run, text);
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

/// What an ideal gas without internal energy has of it; nothing for other laws.
std::string missingEnergy(Run const &run, UpdateReport const &u)
{
  Material const material =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), run.scene.materials)(u.range_material);
  if (material.eos != EosKind::IdealGas || u.range_energy > 0.0)
    return "";
  char text[128];
  std::snprintf(text, sizeof text, ": its internal energy is not positive, %.2e J/kg, in all %.2e %s", u.range_energy,
                u.range_energy * u.range_mass, run.scene.mesh.geometry == Geometry::Planar ? "J/m" : "J per radian");
  return text;
}

/// A pair that has left the range of its equation of state goes on, by floors; the run says so once for each tenfold
/// number of such pairs and cycles, with the first place of the cycle.
void reportRange(Run &run, CycleReport const &report, double before)
{
  double const count = run.ledger.out_of_range;
  if (count == before || std::floor(std::log10(count)) == std::floor(std::log10(std::max(before, 0.5))))
    return;
  UpdateReport const &u = report.update;
  std::string const place = firstCause(
      *run.comm, u.range_cell >= 0 ? placeOf(run, u.range_cell, u.range_material) + missingEnergy(run, u) : "");
  warn(run, "cycle " + std::to_string(run.state.cycle) + ": outside of the range of the equation of state: " + place +
                " (" + std::to_string(std::llround(count)) + " pair steps so far)");
}

/// Pairs whose bonds have a strength are bonded where they touch at the start: a warning for an exception that bonds
/// nothing, and for the default where it bonds no pair.
void reportBonds(Run &run)
{
  constexpr char const *missing = ": no bond was made; with a strength only what touches at the start, to 1e-3 of a "
                                  "cell, is bonded";
  int const n = static_cast<int>(run.deck.fields.size());
  bool asked = false, made = false;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
    {
      PairInteraction const &law = run.deck.interaction[a * n + b];
      std::string const &name = run.deck.exception[a * n + b];
      if (law.kind != Interaction::Bonded || !law.strength.limited())
        continue;
      bool const bonded = std::any_of(run.state.bonds.begin(), run.state.bonds.end(),
                                      [&](Bond const &bond) { return bond.material_a == a && bond.material_b == b; });
      if (name.empty())
      {
        asked = true;
        made = made || bonded;
      }
      else if (!bonded)
        warn(run, "interactions/" + name + missing);
    }
  if (asked && !made)
    warn(run, std::string("interactions/default") + missing);
}

/// One cycle. What a kernel's host code throws is a failed run; on several ranks main ends them all, since the others
/// may wait for the one that threw, unless all throw alike.
CycleReport cycle(Run &run)
{
  try
  {
    return advance(run.scene, run.state, run.times);
  }
  catch (TargetMeshError const &error)
  {
    throw RunFailure("cycle " + std::to_string(run.state.cycle + 1) + ": " + error.what());
  }
  catch (std::exception const &error)
  {
    std::string const text = "cycle " + std::to_string(run.state.cycle + 1) + ": " + error.what();
    if (run.comm->getSize() > 1)
      throw std::runtime_error(text);
    throw RunFailure(text);
  }
}

double partDone(Run const &run)
{
  double const by_time = (run.state.time - run.first_time) / (run.deck.run.end_time - run.first_time);
  double const cycles = static_cast<double>(run.deck.run.max_cycles - run.first_cycle);
  double const by_cycles =
      run.deck.run.max_cycles > 0 ? static_cast<double>(run.state.cycle - run.first_cycle) / cycles : 0.0;
  return std::max(by_time, by_cycles);
}

ExitStatus loop(Run &run, RunOutput &output)
{
  CycleReport report;
  if (run.options.restart.empty())
    output.write(run.scene, run.state, report, run.ledger, 0.0, false);
  double const cells = static_cast<double>(run.whole.mesh.cell.size());
  watchRigidBodies(run);
  watchWalls(run);
  while (!finished(run))
  {
    shortenLastStep(run);
    bool const first = run.state.cycle == 0;
    report = cycle(run);
    if (first)
      reportBonds(run);
    double const out_of_range = run.ledger.out_of_range;
    book(run.ledger, report, *run.exchange);
    checkCycle(run, report);
    reportConvergence(run, report);
    reportRange(run, report, out_of_range);
    reportRigidOverlap(run);
    reportPassedWalls(run);
    run.ledger.cell_steps += cells;
    long long pairs = countOwnedPairs(*run.exchange, run.scene.mesh, run.state.pairs);
    run.exchange->sum(&pairs, 1);
    run.ledger.pair_steps += static_cast<double>(pairs);

    double const wall = run.exchange->max(run.timer.seconds());
    bool const stop = run.exchange->max(interrupted() ? 1.0 : 0.0) > 0.0;
    Kokkos::Timer output_timer;
    output.write(run.scene, run.state, report, run.ledger, wall, finished(run));
    run.output_seconds += output_timer.seconds();
    run.progress.update(partDone(run), run.state.time, report.dt, run.state.cycle, wall,
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
    place += ", material " + names[material] + stretchedWithoutFailure(run, material);
  return place;
}

std::string failedCell(Run const &run, ReconstructionReport const &report)
{
  int const cell = report.first_failed_cell;
  std::string const place = placeOf(run, cell, report.first_failed_material);
  if (cell < 0)
    return place;
  std::size_t const materials = materialsOf(run, cell).size();
  if (materials < max_components)
    return place;
  return crowdedCell(run, cell,
                     std::to_string(materials) + " materials meet in it, and at most " +
                         std::to_string(max_components) + " can, void among them");
}

void checkScene(Deck const &deck, Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  RunOptions const options;
  Run run(deck, options, comm);
  setUp(run);
}

namespace
{

ExitStatus runWithOutput(Run &run)
{
  RunOutput output(run.deck, run.options, run.comm, run.start, run.warnings);
  try
  {
    ExitStatus const status = loop(run, output);
    noteErrors(run);
    warnOfOverlaps(run);
    warnOfGain(run);
    run.progress.finish();
    writeRunSummary(run, status == Completed ? "completed" : "interrupted", true);
    return status;
  }
  catch (RunFailure const &failure)
  {
    std::string text = std::string("failed: ") + failure.what();
    if (!output.lastCheckpoint().empty())
      text += "; the last checkpoint is " + output.lastCheckpoint();
    warnOfGain(run);
    run.warnings.push_back(text);
    run.progress.finish();
    if (run.comm->getRank() == 0)
      std::fprintf(stderr, "harmos: %s\n", text.c_str());
    writeRunSummary(run, "failed", true);
    return FailedRun;
  }
}

} // namespace

ExitStatus simulate(Deck const &deck, RunOptions const &options, Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  Run run(deck, options, comm);
  lockDirectory(run);
  setUp(run);
  if (run.start.restarted && finished(run))
  {
    warn(run, "nothing is left to do: the checkpoint has reached run/end_time or run/max_cycles; no file is touched");
    return Completed;
  }
  claimDirectory(run);
  try
  {
    return runWithOutput(run);
  }
  catch (std::exception const &error)
  {
    summariseByItself(run, error.what());
    throw;
  }
}

} // namespace Harmos
