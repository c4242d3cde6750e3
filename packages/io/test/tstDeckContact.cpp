// SPDX-License-Identifier: BSD-3-Clause
#include "DeckExample.hpp"

#include <Harmos_DeckReader.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

Deck read(std::vector<std::string> const &overrides)
{
  return readDeckText(exampleDeck(), "deck.yaml", overrides);
}

void expectRefused(std::vector<std::string> const &overrides, std::string const &start)
{
  try
  {
    read(overrides);
    ADD_FAILURE() << start << ": accepted";
  }
  catch (DeckError const &error)
  {
    EXPECT_EQ(std::string(error.what()).substr(0, start.size()), start);
  }
}

} // namespace

TEST(DeckContact, theDefault_hasItsKeysBesideIt)
{
  Deck const deck = read({"interactions/default=friction", "interactions/coefficient=0.3"});
  EXPECT_EQ(deck.interaction[1].kind, Interaction::Friction);
  EXPECT_EQ(deck.interaction[1].friction, 0.3);
  Deck const bonded = read({"interactions/default=bonded", "interactions/tensile_strength=1e6"});
  EXPECT_EQ(bonded.interaction[1].strength.tensile, 1e6);
  EXPECT_EQ(bonded.interaction[1].strength.shear, 0.0);
  EXPECT_EQ(read({}).interaction[1].restitution, 0.0);
  EXPECT_EQ(read({"interactions={default: sliding, restitution: 1.0}"}).interaction[1].restitution, 1.0);
  EXPECT_EQ(read({"boundaries/left={type: contact wall, friction: 0.2}"}).boundary[0].friction, 0.2);
}

TEST(DeckContact, everyMethodHasItsWord)
{
  EXPECT_EQ(read({}).constraint.method, ConstraintMethod::Multipliers);
  std::string const liquid = "materials/air={eos: stiffened, density: 1.2, sound_speed: 340.0}";
  EXPECT_EQ(read({liquid, "numerics/constraint/method=penalty"}).constraint.method, ConstraintMethod::Penalty);
  Deck const nitsche = read({liquid, "numerics/constraint={method: nitsche, penalty: 0.3}"});
  EXPECT_EQ(nitsche.constraint.method, ConstraintMethod::Nitsche);
  EXPECT_EQ(nitsche.constraint.penalty, 0.3);
  std::string const open = "boundaries/top={type: outflow}"; // the example has a contact wall there
  std::string const slides = "interactions={default: sliding}";
  EXPECT_EQ(read({slides, open, "numerics/constraint/method=nodal"}).constraint.method, ConstraintMethod::Nodal);
  EXPECT_EQ(read({slides, open, "numerics/constraint/method=merged"}).constraint.method, ConstraintMethod::Merged);
  EXPECT_EQ(read({"numerics/constraint/placement=gauss points"}).constraint.placement, Placement::GaussPoints);
  EXPECT_EQ(read({"numerics/constraint/placement=segment ends"}).constraint.placement, Placement::SegmentEnds);
  EXPECT_EQ(read({"numerics/constraint/placement=vital vertices"}).constraint.placement, Placement::VitalVertices);
  EXPECT_EQ(read({"numerics/constraint/placement=mortar"}).constraint.placement, Placement::Mortar);
  EXPECT_EQ(read({}).constraint.solver, MultiplierMethod::ProjectedNewton);
  EXPECT_FALSE(read({}).constraint.warm_start);
  for (std::string const solver : {"projected newton", "conjugate gradients", "row sums"})
    EXPECT_TRUE(read({"numerics/constraint={solver: " + solver + ", warm_start: true}"}).constraint.warm_start);
  EXPECT_EQ(read({"numerics/constraint/solver=row sums"}).constraint.solver, MultiplierMethod::RowSums);
  EXPECT_EQ(read({"numerics/constraint/solver=conjugate gradients"}).constraint.solver,
            MultiplierMethod::ConjugateGradients);
}

TEST(DeckContact, whatHasNoMeaning_isRefused)
{
  expectRefused({"interactions/default=friction"}, "deck.yaml: interactions/coefficient: ");
  expectRefused({"interactions/default=tied"}, "deck.yaml: interactions/default: \"tied\" is not allowed");
  expectRefused({"interactions/coefficient=0.3"},
                "deck.yaml: interactions/coefficient: does not belong here, only where default = friction");
  expectRefused({"interactions/glue/tensile_strength=-1"}, "deck.yaml: interactions/glue/tensile_strength: -1");
  expectRefused({"interactions/tape={between: patch, and: ring, type: sliding}"},
                "deck.yaml: interactions/tape: the pair stands in interactions/glue already");
  expectRefused({"kinematics=single"}, "deck.yaml: interactions/glue/type: \"bonded\" has no meaning");
  expectRefused({"numerics/constraint={method: nitsche, placement: gauss points}"},
                "deck.yaml: numerics/constraint/placement: does not belong here");
  expectRefused({"interactions={default: bonded, restitution: 1.0}"},
                "deck.yaml: interactions/restitution: does not belong here");
  expectRefused({"interactions={default: sliding, restitution: 1.1}"}, "deck.yaml: interactions/restitution: ");
  expectRefused({"interactions={default: sliding, restitution: 0.5}", "numerics/constraint/method=penalty"},
                "deck.yaml: numerics/constraint/method: \"penalty\" knows no restitution");
  expectRefused({"interactions={default: sliding, restitution: 0.5}", "kinematics=single"},
                "deck.yaml: interactions/restitution: nothing parts");
  expectRefused({"numerics/constraint/penalty=1"}, "deck.yaml: numerics/constraint/penalty: does not belong here");
  expectRefused({"numerics/constraint={method: penalty, solver: row sums}"},
                "deck.yaml: numerics/constraint/solver: \"row sums\" has nothing to solve with method penalty");
  expectRefused({"numerics/constraint={method: nitsche, warm_start: true}"},
                "deck.yaml: numerics/constraint/warm_start: does not belong here");
  expectRefused({"numerics/constraint={placement: mortar, warm_start: true}"},
                "deck.yaml: numerics/constraint/warm_start: groups of rows");
  for (std::string const placement : {"vital vertices", "mortar"})
    expectRefused({"numerics/constraint={placement: " + placement + ", solver: row sums}"},
                  "deck.yaml: numerics/constraint/solver: \"row sums\" has no groups of rows");
  expectRefused({"numerics/constraint/method=penalty",
                 "bodies/lower={material: platen, shape: disc, center: [0, 0], radius: 1, motion: free}"},
                "deck.yaml: numerics/constraint/method: \"penalty\" takes its stiffness from deformable bodies");
  for (std::string const method : {"penalty", "nitsche"})
  {
    std::string const by_method = "numerics/constraint/method=" + method;
    expectRefused({by_method},
                  "deck.yaml: " + by_method.substr(0, by_method.find('=')) + ": \"" + method +
                      "\" takes its stiffness from the impedance at rest, which the ideal gas air has not");
    // One that no body has does no harm.
    std::string const idle = "materials/helium={eos: ideal gas, gamma: 1.67, density: 0.2}";
    std::string const liquid = "materials/air={eos: stiffened, density: 1.2, sound_speed: 340.0}";
    EXPECT_NO_THROW(read({by_method, idle, liquid}));
  }
  std::string const open = "boundaries/top={type: outflow}";
  expectRefused({open, "numerics/constraint/method=nodal"},
                "deck.yaml: numerics/constraint/method: \"nodal\" knows no strength");
  expectRefused({open, "interactions={default: bonded}", "numerics/constraint/method=merged"},
                "deck.yaml: numerics/constraint/method: \"merged\" ties whatever shares a node");
  expectRefused(
      {"interactions={default: sliding}", "numerics/constraint/method=nodal", "boundaries/left={type: contact wall}"},
      "deck.yaml: boundaries/left/type: a contact wall has no nodes");
}
