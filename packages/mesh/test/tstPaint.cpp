// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_Paint.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using namespace Harmos;

namespace
{

/// n x n cells on the unit square.
HostMesh unitSquare(int n)
{
  std::vector<double> const x = gradedCoordinates(0.0, 1.0, n, 1.0);
  return rectilinearMesh(x, x);
}

/// The unit square, its inner nodes moved by up to 0.2 cells.
HostMesh distortedSquare(int n)
{
  HostMesh mesh = unitSquare(n);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.2 / n, 0.2 / n);
  for (auto &x : mesh.node)
    for (int d = 0; d < 2; ++d)
      if (x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.0)
        x[d] += shift(random);
  return mesh;
}

Body makeBody(Shape const &shape, int material, double density = 2.0)
{
  Body body;
  body.shape = shape;
  body.material = material;
  body.density = density;
  body.specific_volume = 1.0 / density;
  return body;
}

double massOf(Painting const &painting, int material)
{
  auto const record = onHost(painting.record);
  auto const of = onHost(painting.pairs.material);
  double mass = 0.0;
  for (int pair = 0; pair < painting.pairs.num_pairs; ++pair)
    mass += of(pair) == material ? record(pair, Mass) : 0.0;
  return mass;
}

double largestSum(Mesh const &mesh, Painting const &painting)
{
  auto const record = onHost(painting.record);
  auto const offset = onHost(painting.pairs.offset);
  double largest = 0.0;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
  {
    double sum = 0.0;
    for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
      sum += record(pair, VolumeFraction);
    largest = std::max(largest, sum);
  }
  return largest;
}

} // namespace

TEST(Paint, discAtManyOffsets_hasItsAreaAndCentroid)
{
  Mesh const mesh = buildMesh(distortedSquare(16));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial)
  {
    double const radius = 0.02 + 0.18 * uniform(random);
    Vector2 const centre{0.3 + 0.4 * uniform(random), 0.3 + 0.4 * uniform(random)};
    Painting const painting = paint(mesh, {makeBody(Shape::disc(centre, radius), 0)});
    double const mass = 2.0 * Math::pi * radius * radius;
    worst = std::max(worst, std::abs(massOf(painting, 0) / mass - 1.0));
    auto const record = onHost(painting.record);
    auto const centroid = onHost(painting.centroid);
    Vector2 sum{0.0, 0.0};
    for (int pair = 0; pair < painting.pairs.num_pairs; ++pair)
      sum += record(pair, Mass) / mass * Vector2{centroid(pair, 0), centroid(pair, 1)};
    EXPECT_NEAR(0.0, norm(sum - centre), 1e-13);
  }
  EXPECT_LT(worst, 1e-12);
}

TEST(Paint, discAnnulusAndTheRestCutByThem_fillEveryCellExactly)
{
  Mesh const mesh = buildMesh(distortedSquare(12));
  Body core = makeBody(Shape::disc({0.51, 0.47}, 0.2), 1, 8.0);
  Body shell = makeBody(Shape::annulus({0.51, 0.47}, 0.2, 0.3), 2, 4.0);
  core.cut_from_earlier = true;
  shell.cut_from_earlier = true;
  Painting const painting = paint(mesh, {makeBody(Shape::rectangle({0.5, 0.5}, {1.2, 1.2}), 0), core, shell});
  EXPECT_NEAR(1.0, massOf(painting, 0) / (2.0 * (1.0 - Math::pi * 0.09)), 1e-13);
  EXPECT_NEAR(1.0, massOf(painting, 1) / (8.0 * Math::pi * 0.04), 1e-13);
  EXPECT_NEAR(1.0, massOf(painting, 2) / (4.0 * Math::pi * 0.05), 1e-13);
  EXPECT_EQ(1.0, largestSum(mesh, painting));
  auto const record = onHost(painting.record);
  auto const offset = onHost(painting.pairs.offset);
  auto const material = onHost(painting.pairs.material);
  for (int cell = 0; cell < mesh.num_cells; ++cell)
  {
    double sum = 0.0;
    for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
    {
      sum += record(pair, VolumeFraction);
      EXPECT_TRUE(pair == offset(cell) || material(pair - 1) < material(pair));
    }
    EXPECT_NEAR(1.0, sum, 2e-16);
  }
}

TEST(Paint, bodyOnGridLines_makesPureCellsAlone)
{
  Mesh const mesh = buildMesh(unitSquare(10));
  Painting const painting = paint(mesh, {makeBody(Shape::rectangle({0.5, 0.25}, {0.6, 0.3}), 0),
                                         makeBody(Shape::rectangle({0.5, 0.55}, {0.6, 0.3}), 1)});
  EXPECT_EQ(36, painting.pairs.num_pairs);
  auto const record = onHost(painting.record);
  for (int pair = 0; pair < painting.pairs.num_pairs; ++pair)
    EXPECT_EQ(1.0, record(pair, VolumeFraction));
  EXPECT_NEAR(0.36, massOf(painting, 0), 1e-15);
}

TEST(Paint, tilingByRotatedHalfPlanes_sumsToOneAndNeverAbove)
{
  Mesh const mesh = buildMesh(distortedSquare(16));
  for (double const angle : {0.0, 0.3, 1.0, 2.5})
  {
    Vector2 const normal{std::cos(angle), std::sin(angle)};
    Painting const painting = paint(mesh, {makeBody(Shape::halfPlane({0.41, 0.53}, normal), 0),
                                           makeBody(Shape::halfPlane({0.41, 0.53}, -normal), 1)});
    EXPECT_EQ(1.0, largestSum(mesh, painting));
    EXPECT_NEAR(2.0, massOf(painting, 0) + massOf(painting, 1), 1e-13);
  }
}

TEST(Paint, bodiesThatOverlap_areNamed)
{
  Mesh const mesh = buildMesh(unitSquare(8));
  Body left = makeBody(Shape::rectangle({0.3, 0.5}, {0.4, 0.4}), 0);
  Body right = makeBody(Shape::rectangle({0.6, 0.5}, {0.4, 0.4}), 1);
  left.name = "left";
  right.name = "right";
  try
  {
    paint(mesh, {left, right});
    FAIL() << "an overlap was accepted";
  }
  catch (std::runtime_error const &error)
  {
    std::string const what = error.what();
    EXPECT_NE(std::string::npos, what.find("cell 19:")) << what; // column 3, row 2
    EXPECT_NE(std::string::npos, what.find("left")) << what;
    EXPECT_NE(std::string::npos, what.find("right")) << what;
    EXPECT_NE(std::string::npos, what.find("at (0.4375, 0.3125)")) << what;
  }
  right.cut_from_earlier = true;
  Painting const painting = paint(mesh, {left, right});
  EXPECT_NEAR(0.24, massOf(painting, 0), 1e-15); // 2 * 0.3 * 0.4
  EXPECT_NEAR(0.32, massOf(painting, 1), 1e-15);
}

TEST(Paint, overlapThatALaterBodyCutsAway_isAccepted)
{
  Mesh const mesh = buildMesh(unitSquare(8));
  Body third = makeBody(Shape::rectangle({0.45, 0.5}, {0.2, 0.6}), 2);
  third.cut_from_earlier = true;
  Painting const painting = paint(mesh, {makeBody(Shape::rectangle({0.3, 0.5}, {0.4, 0.4}), 0),
                                         makeBody(Shape::rectangle({0.6, 0.5}, {0.4, 0.4}), 1), third});
  EXPECT_NEAR(2.0 * 0.25 * 0.4, massOf(painting, 0), 1e-15);
  EXPECT_NEAR(2.0 * 0.25 * 0.4, massOf(painting, 1), 1e-15);
}

TEST(Paint, bodiesOfOneMaterial_addUp)
{
  Mesh const mesh = buildMesh(unitSquare(4));
  // Two halves of the third column of cells' width meet at x = 0.4, inside a cell.
  Body a = makeBody(Shape::rectangle({0.2, 0.5}, {0.4, 1.0}), 0, 1.0);
  Body b = makeBody(Shape::rectangle({0.7, 0.5}, {0.6, 1.0}), 0, 3.0);
  a.internal_energy = 4.0;
  Painting const painting = paint(mesh, {a, b});
  EXPECT_EQ(16, painting.pairs.num_pairs);
  EXPECT_NEAR(0.4 + 1.8, massOf(painting, 0), 1e-14);
  auto const record = onHost(painting.record);
  EXPECT_EQ(1.0, record(1, VolumeFraction));
  // Cell 1 spans 0.25..0.5: 0.6 of it has density 1, 0.4 has 3.
  EXPECT_NEAR(4.0 * 0.6 / 1.8, record(1, InternalEnergy), 1e-14);
  EXPECT_NEAR((0.6 + 1.2 / 3.0) / 1.8, record(1, SpecificVolume), 1e-14);
}

TEST(Paint, sliverBelowTheThreshold_makesNoPair)
{
  Mesh const mesh = buildMesh(unitSquare(4));
  double const tiny = 1e-15;
  double const small = 1e-12;
  EXPECT_EQ(8, paint(mesh, {makeBody(Shape::rectangle({0.25, 0.5}, {0.5 + 2.0 * tiny, 1.0}), 0)}).pairs.num_pairs);
  Painting const painting = paint(mesh, {makeBody(Shape::rectangle({0.25, 0.5}, {0.5 + 2.0 * small, 1.0}), 0)});
  EXPECT_EQ(12, painting.pairs.num_pairs);
  auto const centroid = onHost(painting.centroid);
  auto const record = onHost(painting.record);
  EXPECT_NEAR(4e-12, record(2, VolumeFraction), 1e-15);
  EXPECT_NEAR(0.5, centroid(2, 0), 1e-12);
  EXPECT_NEAR(0.125, centroid(2, 1), 1e-12);
}

TEST(Paint, velocities_followTheirBodies)
{
  Mesh const mesh = buildMesh(unitSquare(8));
  Body spinning = makeBody(Shape::disc({0.5, 0.5}, 0.2), 0);
  spinning.angular_velocity = 3.0;
  spinning.rotation_centre = {0.5, 0.5};
  spinning.velocity = {1.0, 0.0};
  Body around = makeBody(Shape::halfPlane({0.5, 2.0}, {0.0, 1.0}), 1);
  around.velocity = {0.1, 0.7};
  spinning.cut_from_earlier = true;
  std::vector<Body> const bodies{around, spinning};
  Painting painting = paint(mesh, bodies);
  for (Kinematics const kinematics : {Kinematics::Xfem, Kinematics::Single})
  {
    NodeMaterialPairs const dofs = buildDofNodes(mesh, kinematics, painting.record, painting.pairs);
    auto const velocity = onHost(paintedVelocity(mesh, bodies, painting, dofs));
    auto const material = onHost(dofs.material);
    auto const node = onHost(dofs.node);
    auto const x = onHost(mesh.node_position);
    for (int dof = 0; dof < dofs.num_dof_nodes; ++dof)
    {
      Vector2 const v{velocity(dof, 0), velocity(dof, 1)};
      Vector2 const at{x(node(dof), 0), x(node(dof), 1)};
      bool const around_alone = material(dof) == 1 || (material(dof) == -1 && norm(at - Vector2{0.5, 0.5}) > 0.45);
      if (around_alone)
      {
        EXPECT_EQ(0.1, v[0]); // to the bit
        EXPECT_EQ(0.7, v[1]);
      }
      if (material(dof) == 0)
      {
        EXPECT_NEAR(0.0, norm(v - spinning.velocityAt(at)), 1e-15);
      }
    }
  }
}

TEST(Paint, bodiesOfOneMaterialThatMeetAtANode_shareItsMomentum)
{
  Mesh const mesh = buildMesh(unitSquare(4));
  Body a = makeBody(Shape::rectangle({0.25, 0.5}, {0.5, 1.0}), 0, 1.0);
  Body b = makeBody(Shape::rectangle({0.75, 0.5}, {0.5, 1.0}), 0, 3.0);
  a.velocity = {1.0, 0.0};
  std::vector<Body> const bodies{a, b};
  Painting painting = paint(mesh, bodies);
  NodeMaterialPairs const dofs = buildDofNodes(mesh, Kinematics::Xfem, painting.record, painting.pairs);
  auto const velocity = onHost(paintedVelocity(mesh, bodies, painting, dofs));
  auto const x = onHost(mesh.node_position);
  for (int dof = 0; dof < dofs.num_dof_nodes; ++dof)
    EXPECT_NEAR(x(dof, 0) < 0.5 ? 1.0 : (x(dof, 0) > 0.5 ? 0.0 : 0.25), velocity(dof, 0), 1e-15);
}

TEST(Paint, meshOfARank_isPaintedAsTheWhole)
{
  HostMesh const whole = distortedSquare(8);
  std::vector<Body> const bodies{makeBody(Shape::disc({0.45, 0.52}, 0.3), 0)};
  Painting const serial = paint(buildMesh(whole), bodies);
  std::vector<int> owner(whole.cell.size());
  for (std::size_t cell = 0; cell < owner.size(); ++cell)
    owner[cell] = cell % 8 < 4 ? 0 : 1;
  Mesh const local = buildLocalMesh(whole, owner, 1, 2);
  Painting const part = paint(local, bodies);
  auto const global = onHost(local.cell_global);
  auto const serial_offset = onHost(serial.pairs.offset);
  auto const offset = onHost(part.pairs.offset);
  auto const serial_record = onHost(serial.record);
  auto const record = onHost(part.record);
  for (int cell = 0; cell < local.num_cells; ++cell)
  {
    int const g = static_cast<int>(global(cell));
    ASSERT_EQ(serial_offset(g + 1) - serial_offset(g), offset(cell + 1) - offset(cell));
    for (int k = 0; k < offset(cell + 1) - offset(cell); ++k)
      EXPECT_EQ(serial_record(serial_offset(g) + k, Mass), record(offset(cell) + k, Mass));
  }
}

TEST(Paint, badBodies_areRefused)
{
  Mesh const mesh = buildMesh(unitSquare(2));
  Body body = makeBody(Shape::disc({0.5, 0.5}, 0.2), 0);
  body.density = 0.0;
  EXPECT_THROW(paint(mesh, {body}), std::runtime_error);
  body.density = 1.0;
  body.specific_volume = std::nan("");
  EXPECT_THROW(paint(mesh, {body}), std::runtime_error);
}

TEST(Paint, noBodies_giveNoPairs)
{
  Painting const painting = paint(buildMesh(unitSquare(2)), {});
  EXPECT_EQ(0, painting.pairs.num_pairs);
  EXPECT_EQ(0, onHost(painting.pairs.offset)(4));
}

TEST(Paint, ringsAboutAnAxis_haveTheVolumesAndMassesOfTheBodies)
{
  Mesh mesh = buildMesh(distortedSquare(16));
  setGeometry(mesh, Geometry::Axisymmetric);
  Shape const sphere = Shape::disc({0.0, 0.5}, 0.31), torus = Shape::disc({0.7, 0.4}, 0.2);
  Painting const painting = paint(mesh, {makeBody(sphere, 0), makeBody(torus, 1)});
  auto const material = onHost(painting.pairs.material);
  auto const cell = onHost(painting.pairs.cell);
  auto const record = onHost(painting.record);
  auto const centroid = onHost(painting.centroid);
  auto const cell_volume = onHost(mesh.cell_volume);
  double volume[2] = {0.0, 0.0}, axial[2] = {0.0, 0.0};
  for (int pair = 0; pair < painting.pairs.num_pairs; ++pair)
  {
    double const part = record(pair, VolumeFraction) * cell_volume(cell(pair));
    volume[material(pair)] += part;
    axial[material(pair)] += part * centroid(pair, 1);
  }
  EXPECT_NEAR(volume[0], 2.0 / 3.0 * 0.31 * 0.31 * 0.31, 1e-13);
  EXPECT_NEAR(volume[1], Math::pi * 0.04 * 0.7, 1e-13);
  EXPECT_NEAR(axial[0] / volume[0], 0.5, 1e-12);
  EXPECT_NEAR(axial[1] / volume[1], 0.4, 1e-12);
}

TEST(RigidVolumes, movedBody_keepsItsVolumeAndCentroid)
{
  Mesh const mesh = buildMesh(distortedSquare(16));
  std::vector<Shape> const start{Shape::rectangle({0.3, 0.3}, {0.3, 0.1}), Shape::disc({0.7, 0.7}, 0.15)};
  auto const area = onHost(mesh.cell_area);
  for (int step = 0; step < 20; ++step)
  {
    std::vector<Shape> const now{start[0].moved({0.01 * step, 0.003 * step}, 0.2 * step),
                                 start[1].moved({-0.007 * step, 0.001 * step}, 0.1 * step)};
    PaintedRows const rows = rigidVolumes(mesh, now, {3, 1});
    auto const offset = onHost(rows.offset);
    auto const material = onHost(rows.material);
    auto const fraction = onHost(rows.volume_fraction);
    auto const centroid = onHost(rows.centroid);
    double volume[2] = {0.0, 0.0};
    Vector2 first[2] = {{0.0, 0.0}, {0.0, 0.0}};
    for (int cell = 0; cell < mesh.num_cells; ++cell)
      for (int i = offset(cell); i < offset(cell + 1); ++i)
      {
        int const body = material(i) == 3 ? 0 : 1;
        EXPECT_LE(fraction(i), 1.0);
        volume[body] += fraction(i) * area(cell);
        first[body] += fraction(i) * area(cell) * Vector2{centroid(i, 0), centroid(i, 1)};
      }
    for (int body = 0; body < 2; ++body)
    {
      EXPECT_NEAR(1.0, volume[body] / now[body].area(), 1e-12);
      EXPECT_NEAR(0.0, norm((1.0 / volume[body]) * first[body] - now[body].centroid()), 1e-12);
    }
  }
}

TEST(RigidVolumes, shapesAndMaterialsOfDifferentNumber_areRefused)
{
  EXPECT_THROW(rigidVolumes(buildMesh(unitSquare(2)), {Shape::disc({0.5, 0.5}, 0.1)}, {}), std::runtime_error);
}
