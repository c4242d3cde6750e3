// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RunOutput.hpp"

#include "Harmos_Version.hpp"
#include <Harmos_FieldSnapshot.hpp>

#include <Teuchos_DefaultMpiComm.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

bool Schedule::due(long long cycle, double time, double wall, bool at_end)
{
  bool due = false;
  if (cadence_.every_cycles > 0 && cycle % cadence_.every_cycles == 0)
    due = true;
  if (cadence_.every_time > 0.0 && time >= next_time_ * (1.0 - 1e-12))
  {
    due = true;
    next_time_ = cadence_.every_time * (std::floor(time / cadence_.every_time * (1.0 + 1e-12)) + 1.0);
  }
  if (cadence_.every_wall_seconds > 0.0 && wall - last_wall_ >= cadence_.every_wall_seconds)
  {
    due = true;
    last_wall_ = wall;
  }
  regular_ = due;
  return due || (at_end && cadence_.at_end);
}

void Schedule::skipTo(double time, double wall)
{
  last_wall_ = wall;
  if (cadence_.every_time > 0.0)
    next_time_ = cadence_.every_time * (std::floor(time / cadence_.every_time * (1.0 + 1e-12)) + 1.0);
}

std::vector<std::string> materialNames(Deck const &deck)
{
  static char const *const side_name[] = {"left", "right", "bottom", "top"};
  std::vector<std::string> names;
  for (FieldSpec const &field : deck.fields)
    names.push_back(field.name);
  if (deck.kinematics == Kinematics::Lagrangian)
    for (int side = 0; side < num_boundary_sides; ++side)
      if (deck.boundary[side].kind == BoundaryKind::ContactWall)
        names.push_back(std::string("wall_") + side_name[side]);
  return names;
}

LedgerErrors ledgerErrors(Geometry geometry, Ledger const &l, Totals const &t)
{
  LedgerErrors e;
  e.mass = std::fabs(t.mass + l.outflow_mass - l.mass0) / std::max(l.mass0, 1e-300);
  double const px = t.momentum_x - l.momentum0_x - l.external_impulse_x + l.outflow_momentum_x;
  double const py = t.momentum_y - l.momentum0_y - l.external_impulse_y + l.outflow_momentum_y;
  e.momentum = geometry == Geometry::Planar ? std::hypot(px, py) : std::fabs(py);
  e.energy = t.kinetic_energy + t.internal_energy - l.external_work + l.contact_loss + l.remap_loss + l.outflow_energy -
             l.energy0;
  return e;
}

LedgerErrors noteErrors(Geometry geometry, Totals const &totals, Ledger &ledger)
{
  LedgerErrors const errors = ledgerErrors(geometry, ledger, totals);
  ledger.noteErrors(errors.mass, errors.momentum, errors.energy, totals.kinetic_energy + totals.internal_energy,
                    totals.speed_momentum);
  ledger.noteAngularMomentum(totals.angular_momentum, totals.moment);
  return errors;
}

namespace
{

CsvStart tableStart(OutputStart const &start)
{
  return start.append ? CsvStart::after(start.history_ended ? start.cycle - 1 : start.cycle) : CsvStart::fresh();
}

std::unique_ptr<PointLog> pointLog(std::vector<PointSpec> const &points, std::string const &path, char const *header,
                                   bool writes, OutputStart const &start)
{
  return points.empty() ? nullptr : std::make_unique<PointLog>(path, header, writes, tableStart(start));
}

std::vector<std::string> fieldNames(Deck const &deck)
{
  std::vector<std::string> names;
  for (FieldSpec const &field : deck.fields)
    names.push_back(field.name);
  return names;
}

MPI_Comm rawComm(Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  auto const mpi = Teuchos::rcp_dynamic_cast<Teuchos::MpiComm<int> const>(comm);
  return mpi.is_null() ? MPI_COMM_SELF : static_cast<MPI_Comm>(*mpi->getRawMpiComm());
}

} // namespace

RunOutput::RunOutput(Deck const &deck, RunOptions const &options, Teuchos::RCP<Teuchos::Comm<int> const> const &comm,
                     OutputStart const &start, std::vector<std::string> const &warnings)
    : deck_(deck), warnings_(warnings), directory_(options.directory), mpi_(rawComm(comm)), names_(fieldNames(deck)),
      all_names_(materialNames(deck)), history_due_(deck.output.history), fields_due_(deck.output.fields),
      checkpoint_due_(deck.output.checkpoint), history_(directory_ + "/history.csv", names_, comm->getRank() == 0,
                                                        tableStart(start), deck.remap.measure_overlap),
      contacts_(directory_ + "/contact.csv", comm->getRank() == 0, tableStart(start)),
      probes_(pointLog(deck.probes, directory_ + "/probes.csv", PointLog::probe_header, comm->getRank() == 0, start)),
      tracers_(
          pointLog(deck.tracers, directory_ + "/tracers.csv", PointLog::tracer_header, comm->getRank() == 0, start))
{
  Cadence const &f = deck.output.fields;
  bool const wanted = f.every_cycles > 0 || f.every_time > 0.0 || f.every_wall_seconds > 0.0 || f.at_end;
  if (wanted && deck.output.xdmf)
  {
    FieldOutputOptions field_options;
    field_options.vtu = deck.output.vtu;
    long long const last = start.fields_ended ? start.cycle - 1 : start.cycle;
    fields_ = std::make_unique<FieldOutput>(mpi_, directory_, all_names_, field_options, start.append ? last : -1);
  }
  if (start.restarted)
  {
    history_due_.skipTo(start.time, 0.0);
    fields_due_.skipTo(start.time, 0.0);
  }
  // No checkpoint of the state that a run starts from: the deck, or the checkpoint that was read, is one.
  checkpoint_due_.skipTo(start.restarted ? start.time : 0.0, 0.0);
}

void RunOutput::write(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger,
                      double wall, bool at_end)
{
  if (history_due_.due(state.cycle, state.time, wall, at_end))
  {
    writeHistory(scene, state, report, ledger);
    writeContacts(scene, state, report);
    writeProbes(scene, state);
    writeTracers(scene, state);
  }
  if (fields_due_.due(state.cycle, state.time, wall, at_end) && fields_)
    fields_->write(state.cycle, state.time,
                   takeSnapshot(scene.mesh, state.pairs, state.dof_nodes, state.state, state.regions, scene.materials));
  if (state.cycle > 0 && checkpoint_due_.due(state.cycle, state.time, wall, at_end))
    checkpoint(scene, state, ledger);
}

void RunOutput::writeHistory(Scene const &scene, CycleState const &state, CycleReport const &report, Ledger &ledger)
{
  Totals const totals = computeTotals(scene, state, static_cast<int>(names_.size()), true);
  LedgerErrors const errors = noteErrors(scene.mesh.geometry, totals, ledger);

  HistoryRow row;
  row.cycle = state.cycle;
  row.time = state.time;
  row.dt = report.dt;
  row.mass = totals.mass;
  row.momentum_x = totals.momentum_x;
  row.momentum_y = totals.momentum_y;
  row.angular_momentum = totals.angular_momentum;
  row.kinetic_energy = totals.kinetic_energy;
  row.internal_energy = totals.internal_energy;
  row.external_work = ledger.external_work;
  row.contact_loss = ledger.contact_loss;
  row.remap_loss = ledger.remap_loss;
  row.energy_error = errors.energy;
  row.overlap_volume = ledger.overlap_volume;
  row.void_volume = ledger.void_volume;
  row.external_impulse_x = ledger.external_impulse_x;
  row.external_impulse_y = ledger.external_impulse_y;
  row.outflow_mass = ledger.outflow_mass;
  row.outflow_momentum_x = ledger.outflow_momentum_x;
  row.outflow_momentum_y = ledger.outflow_momentum_y;
  row.outflow_energy = ledger.outflow_energy;
  row.pairs = totals.pairs;
  row.pairs_mixed = totals.pairs_mixed;
  row.multipliers = report.constraint.rows;
  row.iterations = report.constraint.iterations;
  row.residual = report.constraint.residual;
  row.material = totals.material;
  row.returned_heat = ledger.returned_heat;
  row.polygon_overlap = ledger.polygon_overlap;
  row.polygon_overlap_largest = ledger.largest_overlap;
  row.polygon_overlap_place[0] = ledger.largest_overlap_x;
  row.polygon_overlap_place[1] = ledger.largest_overlap_y;
  row.remapped_overlap = ledger.remapped_overlap;
  row.remapped_overlap_largest = ledger.largest_remapped_overlap;
  history_.write(row);
  // A restart takes an end's row away, and goes on to the next.
  if (history_due_.regular())
    ledger.largest_overlap = ledger.largest_overlap_x = ledger.largest_overlap_y = ledger.largest_remapped_overlap =
        0.0;
}

void RunOutput::writeContacts(Scene const &scene, CycleState const &state, CycleReport const &report)
{
  int const m = static_cast<int>(scene.materials.extent(0));
  auto const name = [&](int i) { return i == m ? std::string("contact_wall") : all_names_[i]; };
  // Of bodies that touch at the start the first impulse stops what meets: a delta, which its whole cycle is to bear.
  double const span = state.cycle == 1 ? report.dt : report.kick;
  std::vector<ContactEntry> entries;
  for (int a = 0; a < m; ++a)
    for (int b = a + 1; b <= m; ++b)
    {
      std::size_t const at = static_cast<std::size_t>(a) * (m + 1) + b;
      if (at >= report.constraint.pair_force.size())
        continue;
      PairForce const &force = report.constraint.pair_force[at];
      if (force.area == 0.0 && force.normal_impulse == 0.0)
        continue;
      entries.push_back({name(a), name(b), force.impulse[0] / span, force.impulse[1] / span, force.normal_impulse,
                         force.area, force.deviation() / span});
    }
  contacts_.write(state.cycle, state.time, entries);
}

std::string RunOutput::materialName(int material) const
{
  return material < 0 ? "void" : all_names_[static_cast<std::size_t>(material)];
}

void RunOutput::writeProbes(Scene const &scene, CycleState const &state)
{
  if (!probes_)
    return;
  std::vector<Vector2> points;
  for (PointSpec const &probe : deck_.probes)
    points.push_back(probe.position);
  if (probe_cell_.empty() || scene.kinematics == Kinematics::Lagrangian || scene.target_mesh)
    probe_cell_ = locatePoints(scene.mesh, points, *scene.exchange);
  std::vector<PointSample> const samples =
      samplePoints(pointField(scene, state), points, probe_cell_, std::vector<int>(points.size(), -1), *scene.exchange);
  std::vector<PointEntry> entries;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    PointSample const &s = samples[i];
    entries.push_back({deck_.probes[i].name,
                       {},
                       materialName(s.material),
                       {s.density, s.pressure, s.velocity[0], s.velocity[1], s.internal_energy, s.plastic_strain,
                        s.von_mises, s.damage}});
  }
  probes_->write(state.cycle, state.time, entries);
}

void RunOutput::writeTracers(Scene const &scene, CycleState const &state)
{
  if (!tracers_)
    return;
  std::vector<Vector2> points;
  std::vector<long long> cells;
  std::vector<int> materials;
  for (Tracer const &tracer : state.tracers)
  {
    points.push_back(tracer.position);
    cells.push_back(tracer.cell);
    materials.push_back(tracer.material);
  }
  std::vector<PointSample> const samples =
      samplePoints(pointField(scene, state), points, cells, materials, *scene.exchange);
  std::vector<PointEntry> entries;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    PointSample const &s = samples[i];
    Tracer const &t = state.tracers[i];
    entries.push_back({deck_.tracers[i].name,
                       {t.position[0], t.position[1], t.velocity[0], t.velocity[1]},
                       s.inside ? materialName(s.material) : "outside",
                       {s.density, s.pressure, s.internal_energy, s.plastic_strain, s.von_mises, s.damage}});
  }
  tracers_->write(state.cycle, state.time, entries);
}

namespace
{

std::vector<double> tracerValues(std::vector<Tracer> const &tracers)
{
  std::vector<double> values;
  for (Tracer const &t : tracers)
    values.insert(values.end(), {t.position[0], t.position[1], t.velocity[0], t.velocity[1],
                                 static_cast<double>(t.cell), static_cast<double>(t.material)});
  return values;
}

} // namespace

std::string RunOutput::checkpoint(Scene const &scene, CycleState const &state, Ledger const &ledger)
{
  CheckpointScalars scalars;
  scalars.cycle = state.cycle;
  scalars.time = state.time;
  scalars.dt = state.dt;
  scalars.last_dt = state.last_dt;
  scalars.kinematics = scene.kinematics;
  scalars.moving_mesh = static_cast<bool>(scene.target_mesh);
  scalars.material_names = all_names_;
  scalars.bodies = state.bodies;
  scalars.arrays["ledger"] = ledger.values();
  scalars.arrays["ended"] = {history_due_.regular() ? 0.0 : 1.0, fields_due_.regular() ? 0.0 : 1.0};
  scalars.arrays["tracers"] = tracerValues(state.tracers);
  scalars.arrays["start_density"] = state.start_density;
  scalars.arrays["bond_tracers"] = tracerValues(state.bond_tracers);
  std::vector<double> bonds;
  for (Bond const &b : state.bonds)
    bonds.insert(bonds.end(), {static_cast<double>(b.material_b), b.broken ? 1.0 : 0.0, b.cell_size, b.transit,
                               b.traction[0], b.traction[1]});
  scalars.arrays["bonds"] = bonds;
  std::vector<double> force;
  for (ContactForce const &f : state.force)
    force.insert(force.end(), {static_cast<double>(f.key >> 32), static_cast<double>(f.key & 0xffffffffLL), f.normal,
                               f.tangential}); // a double holds 53 bits of a key
  scalars.arrays["contact_force"] = force;
  scalars.warnings = warnings_;
  scalars.deck = deck_.yaml;
  scalars.version = version();
  last_checkpoint_ = writeCheckpoint(mpi_, directory_, scene.mesh, state.pairs, state.state, scalars);
  return last_checkpoint_;
}

} // namespace Harmos
