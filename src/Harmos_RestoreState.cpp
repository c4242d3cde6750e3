// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Run.hpp"

#include <Harmos_DeckDifference.hpp>
#include <Harmos_DeckReader.hpp>
#include <Harmos_MeshBuilder.hpp>

#include <algorithm>
#include <stdexcept>

namespace Harmos
{
namespace
{

std::vector<double> const &arrayOf(CheckpointScalars const &scalars, char const *name)
{
  auto const found = scalars.arrays.find(name);
  if (found == scalars.arrays.end())
    throw std::runtime_error(std::string("it has no array '") + name + "'");
  return found->second;
}

std::vector<Tracer> tracersFrom(std::vector<double> const &values)
{
  std::size_t const width = 6;
  std::vector<Tracer> tracers;
  for (std::size_t i = 0; i + width <= values.size(); i += width)
  {
    double const *v = values.data() + i;
    tracers.push_back({{v[0], v[1]}, {v[2], v[3]}, static_cast<long long>(v[4]), static_cast<int>(v[5])});
  }
  return tracers;
}

void restoreTracers(Run &run, std::vector<double> const &values)
{
  run.state.tracers = tracersFrom(values);
  if (run.state.tracers.size() != run.deck.tracers.size())
    throw std::runtime_error("it holds " + std::to_string(run.state.tracers.size()) + " tracers, the deck " +
                             std::to_string(run.deck.tracers.size()));
}

/// \param values Of each bond: second material, broken, cell size, transit time, traction along and across n.
void restoreBonds(Run &run, std::vector<double> const &tracers, std::vector<double> const &values)
{
  CycleState &s = run.state;
  s.bond_tracers = tracersFrom(tracers);
  if (values.size() != 6 * s.bond_tracers.size())
    throw std::runtime_error("its bonds and their points differ in number");
  for (std::size_t i = 0; i < s.bond_tracers.size(); ++i)
  {
    double const *const v = &values[6 * i];
    s.bonds.push_back({s.bond_tracers[i].position,
                       s.bond_tracers[i].material,
                       static_cast<int>(v[0]),
                       v[1] != 0.0,
                       v[2],
                       v[3],
                       {v[4], v[5]}});
  }
}

bool canBreak(PairInteraction const &interaction)
{
  return interaction.kind == Interaction::Bonded && interaction.strength.limited();
}

/// Whether two bodies have a bond with a strength that an earlier deck of the same bodies did not give them.
bool bondsAnew(Deck const &before, Deck const &now)
{
  for (std::size_t i = 0; i < now.interaction.size(); ++i)
    if (canBreak(now.interaction[i]) && !canBreak(before.interaction[i]))
      return true;
  return false;
}

/// Whether a key is of a rigid body's law: its mass and inertia go on from the checkpoint.
bool isOfRigidBody(Deck const &deck, std::string const &path)
{
  return std::any_of(deck.bodies.begin(), deck.bodies.end(),
                     [&](BodySpec const &body)
                     {
                       LawSpec const &law = deck.laws[body.law];
                       return law.rigid && path.rfind("materials/" + law.name + "/", 0) == 0;
                     });
}

/// A restart keeps the mesh and the bodies; what else of the physics has changed it names in a warning.
void compareDecks(Run &run, std::string const &before)
{
  std::string changed;
  for (std::string const &path : changedKeys(before, run.deck.yaml))
  {
    auto const begins = [&](char const *start) { return path.rfind(start, 0) == 0; };
    if (begins("run/") || begins("output/") || begins("probes/") || path == "title")
      continue;
    if (path == "geometry" || begins("bodies/") || (begins("mesh/") && !begins("mesh/smoother")))
      throw std::runtime_error("it was written with another value of " + path +
                               " than the deck's; a restart keeps mesh and bodies");
    if (isOfRigidBody(run.deck, path))
      throw std::runtime_error("it was written with another value of " + path +
                               " than the deck's; rigid bodies keep their mass in a restart");
    if (begins("interactions/") && bondsAnew(readDeckText(before, run.options.restart, {}), run.deck))
      throw std::runtime_error("it was written with another value of " + path +
                               " than the deck's; bonds with a strength are placed when a run begins");
    changed += (changed.empty() ? "" : ", ") + path;
  }
  if (!changed.empty())
    warn(run, "since the checkpoint the deck has changed in " + changed);
}

} // namespace

void restoreState(Run &run)
{
  CheckpointScalars const scalars = readCheckpointScalars(run.options.restart);
  if (scalars.material_names != materialNames(run.deck))
    throw std::runtime_error("its materials are not those of the deck");
  if (scalars.kinematics != run.deck.kinematics)
    throw std::runtime_error("its kinematics is not that of the deck");
  compareDecks(run, scalars.deck);
  CheckpointState read = readCheckpoint(MPI_COMM_WORLD, run.options.restart, run.scene.mesh);
  if (run.deck.kinematics != Kinematics::Lagrangian)
    updateCornerShares(run.scene.mesh);
  CycleState &s = run.state;
  s.pairs = read.pairs;
  s.state.record = read.record;
  s.state.centroid = read.centroid;
  s.state.tracks_damage = tracksDamage(run.deck);
  s.state.damage = read.damage;
  if (s.state.tracks_damage != read.has_damage)
    throw std::runtime_error(read.has_damage ? "it holds damage, and no law of the deck can fail"
                                             : "it holds no damage, and laws of the deck can fail");
  s.dof_nodes = buildDofNodes(run.scene.mesh, run.deck.kinematics, read.record, s.pairs);
  s.state.velocity = dofVelocities(s.pairs, s.dof_nodes, read.corner_velocity);
  s.bodies = scalars.bodies;
  s.start_density = arrayOf(scalars, "start_density");
  s.time = scalars.time;
  s.cycle = scalars.cycle;
  s.dt = scalars.dt;
  s.last_dt = scalars.last_dt;
  for (std::size_t i = scalars.warnings.size(); i-- > 0;)
    if (std::find(run.warnings.begin(), run.warnings.end(), scalars.warnings[i]) == run.warnings.end())
      run.warnings.insert(run.warnings.begin(), scalars.warnings[i]);
  run.ledger = Ledger::fromValues(arrayOf(scalars, "ledger"));
  restoreTracers(run, arrayOf(scalars, "tracers"));
  restoreBonds(run, arrayOf(scalars, "bond_tracers"), arrayOf(scalars, "bonds"));
  std::vector<double> const &force = arrayOf(scalars, "contact_force");
  for (std::size_t i = 0; i + 4 <= force.size(); i += 4)
  {
    long long const high = static_cast<long long>(force[i]), low = static_cast<long long>(force[i + 1]);
    s.force.push_back({high * (1LL << 32) + low, force[i + 2], force[i + 3]});
  }
  std::vector<double> const &ended = arrayOf(scalars, "ended");
  run.start = {true, false, s.cycle, s.time, ended.at(0) != 0.0, ended.at(1) != 0.0};
  run.first_cycle = s.cycle;
  run.first_time = s.time;
  run.first_pair_steps = run.ledger.pair_steps;
}

} // namespace Harmos
