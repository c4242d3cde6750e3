// SPDX-License-Identifier: BSD-3-Clause
#include "Impact.hpp"

#include <Harmos_Partition.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

/// The unit square on the ranks of the run, a metal in a part of it.
struct Shared
{
  Teuchos::RCP<Teuchos::Comm<int> const> comm = Tpetra::getDefaultComm();
  HostMesh whole = rectilinearMesh(gradedCoordinates(0.0, 1.0, 40, 1.0), gradedCoordinates(0.0, 1.0, 40, 1.0));
  std::vector<int> owner = partitionCells(whole, comm->getSize());
  std::unique_ptr<TpetraExchange> exchange;
  Scene scene;
  CycleState state;

  void build(int halo)
  {
    scene.mesh = buildLocalMesh(whole, owner, comm->getRank(), halo);
    exchange = std::make_unique<TpetraExchange>(comm, scene.mesh);
    scene.exchange = exchange.get();
    scene.boundary = buildBoundaryConditions(scene.mesh, deviceCopy("boundary", std::vector<Boundary>(4)));
    scene.materials = deviceCopy("materials", std::vector<Material>{metal(8930.0)});
    scene.constraint.interaction = View<PairInteraction **>("interaction", 1, 1);
    Body block;
    block.shape = Shape::rectangle({0.5, 0.5}, {0.61, 0.63});
    block.density = 8930.0;
    block.specific_volume = 1.0 / block.density;
    Painting const painting = paint(scene.mesh, {block});
    state.pairs = painting.pairs;
    state.state.record = painting.record;
    state.state.centroid = painting.centroid;
    state.dof_nodes = buildDofNodes(scene.mesh, scene.kinematics, state.state.record, state.pairs);
    state.state.velocity = paintedVelocity(scene.mesh, {block}, painting, state.dof_nodes);
  }

  std::string refusal()
  {
    try
    {
      startCycle(scene, state);
    }
    catch (std::runtime_error const &error)
    {
      return error.what();
    }
    return "";
  }
};

} // namespace

TEST(StartCycleOnRanks, RefusesHalosThatAreTooThin)
{
  for (int const halo : {0, halo_layers - 1, halo_layers})
  {
    Shared shared;
    shared.build(halo);
    std::string const said = shared.refusal();
    EXPECT_EQ(said.find("scene.mesh has a halo of " + std::to_string(halo) + " layers; expected: 7") == 0,
              halo < halo_layers)
        << said;
    EXPECT_EQ(said.empty(), halo == halo_layers) << said;
  }
}

TEST(StartCycleOnRanks, NamesACellThatNoRankOwns)
{
  Shared shared;
  shared.owner[820] = 17;
  shared.build(halo_layers);
  std::string const said = shared.refusal();
  EXPECT_EQ(said.find("cell 820 on rank 0 lies in the halo and comes from no rank; expected: owners from 0 to 1"), 0u)
      << said;
}

TEST(StartCycleOnRanks, TellsAnExchangeOfOneRank)
{
  Exchange const alone;
  Shared shared;
  shared.build(halo_layers);
  shared.scene.exchange = &alone;
  EXPECT_EQ(shared.refusal().find("scene.exchange is of one rank"), 0u);
}

TEST(StartCycleOnRanks, AllSayWhatIsWrongOnOne)
{
  Shared shared;
  shared.build(halo_layers);
  if (shared.comm->getRank() == 1)
    Kokkos::deep_copy(Kokkos::subview(shared.state.state.velocity, 0, 1), std::nan(""));
  std::string const said = shared.refusal();
  EXPECT_NE(said.find(" on rank 1, material 0: state.state.velocity is (0, nan)"), std::string::npos) << said;
}
