// SPDX-License-Identifier: BSD-3-Clause
#include "RandomMesh.hpp"

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

Vector2 slip(int material, Vector2 const &x)
{
  double const s = std::sin(Math::pi * x[0]) * std::sin(Math::pi * x[1]);
  return s * Vector2{0.007 + 0.003 * material, 0.005 * std::cos(3.0 * x[1]) - 0.003 * material};
}

std::vector<std::vector<Layer>> const layouts = {
    {rest(0)}, {disc(0, {0.45, 0.5}, 0.3)}, {disc(0, {0.45, 0.5}, 0.27), halfPlane(2, {0.5, 0.5}, 0.3), rest(1)}};

ResultOnHost remapTo(Scene &scene, MeshOnHost const &target, RemapWork &work)
{
  scene.report = RemapReport{};
  return scene.remapped(target.on_device, scene.report, work, scene.mesh.on_device.node_position);
}

ResultOnHost remapTo(Scene &scene, MeshOnHost const &target)
{
  RemapWork work;
  return remapTo(scene, target, work);
}

Scene makeScene(std::vector<Layer> const &layers, bool intersect, Geometry geometry = Geometry::Planar)
{
  Scene scene(24, 20, 0.15, twoLaws());
  if (geometry == Geometry::Axisymmetric)
    scene.aboutAxis();
  scene.options.swept_faces = !intersect;
  if (intersect && geometry == Geometry::Planar)
    scene.options.order = 3;
  scene.options.merge_below = 0.0;
  scene.paint(layers, wave, wave);
  scene.move(slip);
  return scene;
}

} // namespace

TEST(Target, thatIsTheStartMesh_givesTheBitsOfThePlainRemap)
{
  for (auto const &layers : layouts)
    for (bool intersect : {false, true})
    {
      Scene scene = makeScene(layers, intersect);
      ResultOnHost const plain = scene.remapped();
      EXPECT_EQ(differences(scene, remapTo(scene, shiftedMesh(scene.mesh, 0.0)), plain), 0);
    }
}

TEST(Target, ofRandomNodes_keepsMassMomentumAndEnergyOfEveryMaterial)
{
  for (auto const &layers : layouts)
    for (bool intersect : {false, true})
    {
      Scene scene = makeScene(layers, intersect);
      MeshOnHost const target = shiftedMesh(scene.mesh, 0.009);
      ResultOnHost const result = remapTo(scene, target);
      EXPECT_EQ(scene.report.failures, 0);
      for (int material : {0, 1, 2})
      {
        Totals const a = totals(scene.mesh, scene.pairs, scene.state.record, scene.half, material);
        Totals const b = totals(target, result.pairs, result.state.record, result.state.velocity, material);
        EXPECT_NEAR(b.mass, a.mass, 1e-14 * (1.0 + a.mass));
        EXPECT_NEAR(b.internal, a.internal, 1e-14 * (1.0 + a.internal));
        EXPECT_NEAR(b.thermodynamic_volume, a.thermodynamic_volume, 1e-14);
        EXPECT_NEAR(b.plastic, a.plastic, 1e-15);
      }
      Totals const a = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
      Totals const b = totals(target, result.pairs, result.state.record, result.state.velocity);
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(b.momentum[d], a.momentum[d] + scene.report.wall_impulse[d], 1e-15);
    }
}

TEST(Target, ofRandomNodesAboutAnAxis_keepsMassAndAxialMomentumAndUniformVelocities)
{
  for (auto const &layers : layouts)
    for (bool intersect : {false, true})
      for (bool drift : {false, true})
      {
        Scene scene = makeScene(layers, intersect, Geometry::Axisymmetric);
        if (drift)
        {
          scene.options.merge_below = 1e-6; // slivers' velocities have the digits of their masses
          scene.move([](int, Vector2 const &) { return Vector2{0.0, 0.003}; });
        }
        MeshOnHost const target = shiftedMesh(scene.mesh, 0.009);
        ResultOnHost const result = remapTo(scene, target);
        Totals const a = totals(scene.mesh, scene.pairs, scene.state.record, scene.half);
        Totals const b = totals(target, result.pairs, result.state.record, result.state.velocity);
        EXPECT_NEAR(b.mass, a.mass, 1e-14);
        EXPECT_NEAR(b.momentum[1], a.momentum[1] + scene.report.wall_impulse[1], 1e-15);
        EXPECT_NEAR(scene.report.kinetic_loss, a.kinetic - b.kinetic, 1e-16);
        EXPECT_GE(scene.report.kinetic_loss, -1e-17);
        for (int dof = 0; drift && dof < result.dof_nodes.num_dof_nodes; ++dof)
        {
          double const z = target.node_position(result.dof_nodes.node(dof), 1);
          if (z < 0.4 || z > 0.6) // walls are at rest; both stages and moveShares carry that on by a cell each
            continue;
          EXPECT_EQ(result.state.velocity(dof, 0), 0.0);
          EXPECT_NEAR(result.state.velocity(dof, 1), 0.003, 1e-17);
        }
      }
}

TEST(Target, thatMovesWithTheMaterial_leavesTheCellsAsTheyAre)
{
  for (auto const &layers : layouts)
    for (bool intersect : {false, true})
    {
      Scene scene = makeScene(layers, intersect);
      scene.move([](int, Vector2 const &x) { return slip(0, x); });
      MeshOnHost target = shiftedMesh(scene.mesh, 0.0);
      for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
        for (int d = 0; d < 2; ++d)
          target.node_position(scene.dof_nodes.node(dof), d) =
              scene.mesh.node_position(scene.dof_nodes.node(dof), d) + scene.dt * scene.half(dof, d);
      updateGeometry(target);
      ResultOnHost const result = remapTo(scene, target);
      EXPECT_EQ(scene.report.failures, 0);
      ASSERT_EQ(result.pairs.num_pairs, scene.pairs.num_pairs);
      for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
      {
        ASSERT_EQ(result.pairs.material(pair), scene.pairs.material(pair));
        for (int f = 0; f < num_pair_fields; ++f)
        {
          double const tolerance = f == VolumeFraction ? 2e-2 : 1e-12; // a part of a bent cell changes its share
          EXPECT_NEAR(result.state.record(pair, f), scene.state.record(pair, f), tolerance);
        }
        for (int k = 0; k < 4; ++k)
          for (int d = 0; d < 2; ++d)
            EXPECT_NEAR(result.state.velocity(result.pairs.dof_node(pair, k), d),
                        scene.half(scene.pairs.dof_node(pair, k), d), 1e-13);
      }
    }
}

TEST(Target, ofRandomNodes_uniformStateStaysUniformAndFillsTheCells)
{
  for (bool intersect : {false, true})
  {
    Scene scene = makeScene({disc(0, {0.45, 0.5}, 0.3), rest(1)}, intersect);
    auto const one = [](int, Vector2 const &) { return 1.0; };
    scene.paint({disc(0, {0.45, 0.5}, 0.3), rest(1)}, one, one);
    scene.move([](int, Vector2 const &) { return Vector2{0.0, 0.0}; });
    MeshOnHost const target = shiftedMesh(scene.mesh, 0.009);
    ResultOnHost const result = remapTo(scene, target);
    for (int pair = 0; pair < result.pairs.num_pairs; ++pair)
    {
      double const volume = result.state.record(pair, VolumeFraction) * target.cell_area(result.pairs.cell(pair));
      EXPECT_NEAR(result.state.record(pair, Mass), volume, 1e-15);
      EXPECT_NEAR(result.state.record(pair, InternalEnergy), 1.0, 1e-13);
    }
    EXPECT_NEAR(largestSumOfFractions(target, result), 1.0, 1e-15);
  }
}

TEST(Target, keptWork_servesMovingMeshesAndTheStartMeshInTurn)
{
  Scene scene = makeScene(layouts[2], false);
  MeshOnHost const target = shiftedMesh(scene.mesh, 0.009);
  RemapWork work;
  RemapReport report;
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_EQ(differences(scene, remapTo(scene, target, work), remapTo(scene, target)), 0);
    ResultOnHost const home = scene.remapped(scene.mesh.on_device, report, work);
    EXPECT_EQ(differences(scene, home, scene.remapped()), 0);
  }
}

TEST(Target, withANodeOffItsWall_isRefused)
{
  Scene scene = makeScene(layouts[0], false);
  MeshOnHost const target = shiftedMesh(scene.mesh, 0.0);
  target.node_position(3, 1) = 0.01;
  Kokkos::deep_copy(target.on_device.node_position, target.node_position);
  EXPECT_THROW(remapTo(scene, target), std::runtime_error);
  Scene open = makeScene(layouts[0], false);
  Boundary outflow;
  outflow.kind = BoundaryKind::Outflow;
  open.setBoundaries(std::vector<Boundary>(4, outflow));
  MeshOnHost const sliding = shiftedMesh(open.mesh, 0.0);
  sliding.node_position(3, 0) += 0.001;
  Kokkos::deep_copy(sliding.on_device.node_position, sliding.node_position);
  EXPECT_THROW(remapTo(open, sliding), std::runtime_error);
}

TEST(Target, onPartOfTheMesh_givesTheBitsOfTheWhole)
{
  for (auto const &layers : layouts)
  {
    Scene whole = makeScene(layers, false);
    ResultOnHost const all = remapTo(whole, shiftedMesh(whole.mesh, 0.009));
    std::vector<int> owner(24 * 20);
    for (int cell = 0; cell < 24 * 20; ++cell)
      owner[cell] = cell % 24 < 11 + (cell / 24) % 3 ? 0 : 1;
    Scene part(24, 20, 0.15, twoLaws());
    part.options.merge_below = 0.0;
    part.distribute(owner, 5);
    part.paint(layers, wave, wave);
    part.move(slip);
    EXPECT_EQ(differences(part, remapTo(part, shiftedMesh(part.mesh, 0.009)), all), 0);
  }
}

TEST(LargestSweptPart, uniformMotion_isTheSumOfItsPartsOfACell)
{
  Scene scene(8, 8, 0.0, {Material{}});
  scene.paint(
      {rest(0)}, [](int, Vector2 const &) { return 1.0; }, [](int, Vector2 const &) { return 1.0; });
  scene.move([](int, Vector2 const &) { return Vector2{0.6 / 8.0, -0.5 / 8.0}; });
  EXPECT_NEAR(largestSweptPart(scene.mesh.on_device, scene.device.pairs, scene.device.half, 1.0), 1.1, 1e-13);
  // onto a mesh that goes along in x
  Mesh next = scene.mesh.on_device;
  next.node_position = View<double *[2]>("next", scene.mesh.num_nodes);
  auto const position = Kokkos::create_mirror_view(next.node_position);
  for (int node = 0; node < scene.mesh.num_nodes; ++node)
  {
    position(node, 0) = scene.mesh.node_position(node, 0) + scene.half(scene.dof_nodes.offset(node), 0);
    position(node, 1) = scene.mesh.node_position(node, 1);
  }
  Kokkos::deep_copy(next.node_position, position);
  EXPECT_NEAR(largestSweptPart(next, scene.device.pairs, scene.device.half, 1.0, scene.mesh.on_device.node_position),
              0.5, 1e-13);
}
