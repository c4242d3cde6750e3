// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DeckContact.hpp>

#include <algorithm>

namespace Harmos
{

namespace
{

using Teuchos::ParameterList;

/// Zero where the key is not given.
double optionalNumber(ParameterList const &list, char const *key)
{
  return list.isParameter(key) ? list.get<double>(key) : 0.0;
}

void convertMethod(DeckChecker const &check, ParameterList const &list, Deck &deck)
{
  std::string const path = "numerics/constraint/method";
  std::string const method = list.get<std::string>("method");
  bool const is_explicit = method == "penalty" || method == "nitsche";
  deck.constraint.method = method == "penalty"   ? ConstraintMethod::Penalty
                           : method == "nitsche" ? ConstraintMethod::Nitsche
                           : method == "nodal"   ? ConstraintMethod::Nodal
                           : method == "merged"  ? ConstraintMethod::Merged
                                                 : ConstraintMethod::Multipliers;
  if (method == "multipliers")
  {
    std::string const placement = list.get<std::string>("placement");
    deck.constraint.placement = placement == "gauss points"     ? Placement::GaussPoints
                                : placement == "segment ends"   ? Placement::SegmentEnds
                                : placement == "vital vertices" ? Placement::VitalVertices
                                : placement == "mortar"         ? Placement::Mortar
                                                                : Placement::Midpoint;
    check.require(
        deck.constraint.placement != Placement::GaussPoints || deck.kinematics != Kinematics::Lagrangian,
        "numerics/constraint/placement",
        "\"gauss points\" lie on interfaces in cells, which kinematics lagrangian has not; expected: midpoint, "
        "segment ends, vital vertices or mortar");
  }
  if (is_explicit)
    deck.constraint.penalty = list.get<double>("penalty");
  std::string const solver = list.get<std::string>("solver");
  deck.constraint.solver = solver == "row sums"              ? MultiplierMethod::RowSums
                           : solver == "conjugate gradients" ? MultiplierMethod::ConjugateGradients
                                                             : MultiplierMethod::ProjectedNewton;
  if (!is_explicit)
    deck.constraint.warm_start = list.get<bool>("warm_start");
  check.require(!deck.constraint.warm_start || !sharesMultipliers(deck.constraint.placement),
                "numerics/constraint/warm_start",
                "groups of rows have no forces of the last cycle; expected: false, or placement midpoint, gauss points "
                "or segment ends");
  check.require(
      !sharesMultipliers(deck.constraint.placement) || deck.constraint.solver == MultiplierMethod::ProjectedNewton,
      "numerics/constraint/solver",
      "\"" + solver +
          "\" has no groups of rows, as placements vital vertices and mortar need; expected: projected newton");
  check.require(!is_explicit || deck.constraint.solver == MultiplierMethod::ProjectedNewton,
                "numerics/constraint/solver", "\"" + solver + "\" has nothing to solve with method " + method);
  for (BodySpec const &body : deck.bodies)
    check.require(!is_explicit || body.motion != RigidMotion::Free, path,
                  "\"" + method + "\" takes its stiffness from deformable bodies, and " + body.name +
                      " is rigid and free; expected: multipliers, nodal or merged");
  bool const bounces = std::any_of(deck.interaction.begin(), deck.interaction.end(),
                                   [](PairInteraction const &law) { return law.restitution > 0.0; }) ||
                       std::any_of(std::begin(deck.boundary), std::end(deck.boundary),
                                   [](Boundary const &wall) { return wall.restitution > 0.0; });
  check.require(!bounces || method == "multipliers" || method == "nodal", path,
                "\"" + method + "\" knows no restitution; expected: multipliers or nodal");
  for (BodySpec const &body : deck.bodies)
  {
    LawSpec const &law = deck.laws[body.law];
    check.require(!is_explicit || law.rigid || law.law.eos != EosKind::IdealGas, path,
                  "\"" + method + "\" takes its stiffness from the impedance at rest, which the ideal gas " + law.name +
                      " has not; expected: multipliers, nodal or merged");
  }
  if (method != "nodal" && method != "merged")
    return;
  check.require(deck.kinematics == Kinematics::Xfem, path,
                "\"" + method + "\" acts at nodes that several materials share; expected: kinematics xfem");
  for (int side = 0; side < num_boundary_sides; ++side)
    check.require(deck.boundary[side].kind != BoundaryKind::ContactWall,
                  std::string("boundaries/") + side_name[side] + "/type",
                  "a contact wall has no nodes of its own for method " + method + "; expected: slip wall");
  bool breaks = false, interacts = false;
  for (PairInteraction const &law : deck.interaction)
  {
    breaks = breaks || law.strength.limited();
    interacts = interacts || law.kind != Interaction::Sliding;
  }
  check.require(!breaks, path,
                "\"" + method + "\" knows no strength of a bond; expected: multipliers | penalty | nitsche");
  check.require(method == "nodal" || !interacts, path,
                "\"merged\" ties whatever shares a node; expected: no interactions");
}

} // namespace

void convertInteractions(DeckChecker const &check, ParameterList const &list, Deck &deck)
{
  int const n = static_cast<int>(deck.fields.size());
  auto const read = [&](ParameterList const &item, char const *key, std::string const &path)
  {
    PairInteraction law;
    std::string const word = item.get<std::string>(key);
    check.require(word == "sliding" || deck.kinematics != Kinematics::Single, path,
                  "\"" + word + "\" has no meaning where all materials of a cell share one velocity; expected: " +
                      "sliding, or kinematics xfem or lagrangian");
    law.kind = word == "bonded"     ? Interaction::Bonded
               : word == "friction" ? Interaction::Friction
                                    : Interaction::Sliding;
    if (law.kind == Interaction::Friction)
      law.friction = item.get<double>("coefficient");
    if (law.kind != Interaction::Bonded)
      law.restitution = item.get<double>("restitution");
    check.require(law.restitution == 0.0 || deck.kinematics != Kinematics::Single,
                  path.substr(0, path.rfind('/')) + "/restitution",
                  "nothing parts where all materials of a cell share one velocity; expected: 0, or kinematics xfem or "
                  "lagrangian");
    if (law.kind == Interaction::Bonded)
      law.strength = {optionalNumber(item, "tensile_strength"), optionalNumber(item, "shear_strength")};
    return law;
  };
  deck.interaction.assign(static_cast<std::size_t>(n) * n, read(list, "default", "interactions/default"));
  std::vector<std::string> &named = deck.exception;
  named.assign(static_cast<std::size_t>(n) * n, "");
  for (auto i = list.begin(); i != list.end(); ++i)
  {
    if (!list.entry(i).isList())
      continue;
    ParameterList const &item = list.sublist(list.name(i));
    std::string const path = "interactions/" + list.name(i);
    int field[2];
    for (int k = 0; k < 2; ++k)
    {
      char const *key = k == 0 ? "between" : "and";
      std::string const name = item.get<std::string>(key);
      field[k] = deck.bodies[requireIndex(check, deck.bodies, name, keyPath(path, key), "body")].field;
    }
    check.require(field[0] != field[1], path, "both bodies share one velocity field");
    int const pair = std::min(field[0], field[1]) * n + std::max(field[0], field[1]);
    check.require(named[pair].empty(), path, "the pair stands in interactions/" + named[pair] + " already");
    named[pair] = list.name(i);
    PairInteraction const law = read(item, "type", keyPath(path, "type"));
    auto const isDriven = [&](int f)
    {
      return std::any_of(deck.bodies.begin(), deck.bodies.end(),
                         [&](BodySpec const &body)
                         { return body.field == f && deck.laws[body.law].rigid && body.motion != RigidMotion::Free; });
    };
    check.require(!isDriven(field[0]) || !isDriven(field[1]), path,
                  "both bodies are rigid and move as prescribed: nothing acts between them; expected: another pair, or "
                  "motion: free");
    deck.interaction[field[0] * n + field[1]] = law;
    deck.interaction[field[1] * n + field[0]] = law;
  }
}

void convertConstraint(DeckChecker const &check, ParameterList const &list, Deck &deck)
{
  convertMethod(check, list, deck);
  ConstraintMethod const method = deck.constraint.method;
  if (method != ConstraintMethod::Penalty && method != ConstraintMethod::Nitsche)
  {
    deck.constraint.tolerance = list.get<double>("tolerance");
    deck.constraint.max_iterations = list.get<int>("max_iterations");
  }
  if (method != ConstraintMethod::Nodal && method != ConstraintMethod::Merged)
  {
    deck.constraint.shortest_segment = list.get<double>("shortest_segment");
    deck.constraint.exposed_face = list.get<double>("exposed_face");
    deck.lagrange.shortest_bent_edge = deck.remap.shortest_bent_edge = deck.constraint.shortest_segment;
  }
}

} // namespace Harmos
