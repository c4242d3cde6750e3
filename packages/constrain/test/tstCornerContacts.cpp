// SPDX-License-Identifier: BSD-3-Clause
#include "RowsOfScene.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace HarmosTest;

namespace
{

constexpr double pi = 3.14159265358979323846;

/// In the frame of a face, inclined by `angle` through (4.1, 4.2).
struct Frame
{
  double angle;

  Vector2 normal() const { return {-std::sin(angle), std::cos(angle)}; }
  Vector2 at(double along, double up) const
  {
    return Vector2{4.1, 4.2} + along * Vector2{std::cos(angle), std::sin(angle)} + up * normal();
  }
};

/// A block below the face, and a square that stands on its corner above it, turned by `lean` from lying on its side.
/// \param along, gap Of the corner. \param block, square Materials.
TinyScene cornerAboveFace(Frame const &frame, double along, double gap, double lean, int block = 0)
{
  double const c = std::cos(lean), s = std::sin(lean);
  auto const of_square = [&](double x, double y) { return frame.at(along + c * x - s * y, gap + s * x + c * y); };
  return TinyScene(
      rectilinearMesh(uniform(8, 8), uniform(8, 8)),
      {polygonBody(block, {frame.at(-20, -20), frame.at(20, -20), frame.at(20, 0), frame.at(-20, 0)}),
       polygonBody(1 - block, {of_square(0, 0), of_square(2.5, 0), of_square(2.5, 2.5), of_square(0, 2.5)})},
      2, open_box);
}

/// A face with a dent that the corner of a square has made, which goes into it by `deep`.
TinyScene dentedFace(Frame const &frame, double along, double deep, double lean, int block)
{
  double const c = std::cos(lean), s = std::sin(lean);
  auto const of_square = [&](double x, double y) { return frame.at(along + c * x - s * y, -deep + s * x + c * y); };
  Polygon<8> outline{};
  for (Vector2 const &x : {frame.at(-20, -20), frame.at(20, -20), frame.at(20, 0), of_square(deep / s, 0),
                           of_square(0, 0), of_square(0, deep / c), frame.at(-20, 0)})
    outline.push(x);
  Body const dented{block, [outline](Quadrilateral const &cell)
                    {
                      Region part;
                      EXPECT_TRUE(clipConvex(outline, cell, part));
                      return part;
                    }};
  Body const square =
      polygonBody(1 - block, {of_square(0, 0), of_square(2.5, 0), of_square(2.5, 2.5), of_square(0, 2.5)});
  return TinyScene(rectilinearMesh(uniform(8, 8), uniform(8, 8)), {dented, square}, 2, open_box);
}

RigidBody rigidBody(int material)
{
  RigidBody body;
  body.material = material;
  body.motion = RigidMotion::Fixed;
  return body;
}

/// The row between bodies of the least gap near a foot; all others there are further apart.
ContactRow nearestRow(std::vector<ContactRow> const &rows, Vector2 const &foot)
{
  ContactRow nearest = {};
  nearest.gap = 1e300;
  int count = 0;
  for (ContactRow const &row : rows)
    if (!row.isWithinBody() && norm(row.point - foot) < 0.4)
    {
      count += std::fabs(row.gap - nearest.gap) < 1e-6 ? 1 : 0;
      nearest = row.gap < nearest.gap ? row : nearest;
    }
  EXPECT_EQ(count, 0);
  return nearest;
}

/// A corner 0.003 above a face that comes by 0.015 in the step.
TinyScene comingCorner(Frame const &frame, double along, double lean)
{
  TinyScene scene = cornerAboveFace(frame, along, 0.003, lean);
  scene.dt = 1.0;
  scene.setVelocity(
      [&](int material, Vector2 const &) {
        return material == 1 ? -0.015 * frame.normal() : Vector2{0.0, 0.0};
      });
  return scene;
}

void expectOneRowAtTheCorner(Frame const &frame, double along, double gap, double lean, int block)
{
  SCOPED_TRACE(testing::Message() << "face at " << frame.angle << ", corner at " << along << ", " << gap
                                  << ", leans by " << lean << ", block is material " << block);
  ContactRow const row = nearestRow(rowsOf(cornerAboveFace(frame, along, gap, lean, block)), frame.at(along, 0.0));
  EXPECT_EQ(row.material_a, block);
  EXPECT_LT(norm(row.point - frame.at(along, 0.0)), 1e-12);
  EXPECT_LT(norm(row.normal - frame.normal()), 1e-12);
  EXPECT_NEAR(row.gap, gap, 1e-12);
}

} // namespace

TEST(CornerContacts, cornerAboveAFace_hasOneRowAtItsFootWithTheNormalOfTheFace)
{
  for (double const angle : {0.0, 0.3, 0.7})
    for (double const lean : {pi / 4, pi / 6, pi / 10, 0.4 * pi})
      for (double const along : {0.0, 0.15, 0.43})
        for (double const gap : {0.002, 0.05})
          for (int const block : {0, 1})
            expectOneRowAtTheCorner({angle}, along, gap, lean, block);
}

TEST(CornerContacts, cornerThatSlidesAlongAFace_isNotFelt)
{
  // The means of face and edge lean by 22.5 degrees: the corner would come by 0.007 along them.
  Frame const frame{0.3};
  TinyScene scene = cornerAboveFace(frame, 0.1, 0.003, pi / 4);
  Vector2 const along{std::cos(0.3), std::sin(0.3)};
  scene.dt = 1.0;
  scene.setVelocity([&](int material, Vector2 const &) { return material == 1 ? 0.018 * along : Vector2{0.0, 0.0}; });
  ConstraintReport const report = scene.constrain();
  for (PairForce const &force : report.pair_force)
    EXPECT_EQ(norm(force.impulse), 0.0);
}

TEST(CornerContacts, cornerThatComes_isStoppedOnTheFace)
{
  Frame const frame{0.3};
  TinyScene scene = comingCorner(frame, 0.1, pi / 4);
  scene.constrain();
  ContactRow const row = nearestRow(rowsOf(scene), frame.at(0.1, 0.0));
  auto const half = onHost(scene.half);
  double closing = 0.0;
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      closing += row.normal[d] * (row.weight_a[k] * half(row.dof_a[k], d) - row.weight_b[k] * half(row.dof_b[k], d));
  EXPECT_NEAR(closing, 0.003, 1e-10);
}

// What comes goes by what it comes; what the reconstruction has left open below a corner that is pressed closes by a
// tenth in a step.
TEST(CornerContacts, smallGapBelowACorner_closesByWhatComesAndATenth)
{
  Frame const frame{0.3};
  for (double const gap : {0.003, 0.0075, 0.02})
    for (double const comes : {-0.001, 0.0, 0.001, 0.015})
    {
      TinyScene scene = cornerAboveFace(frame, 0.1, gap, pi / 4);
      scene.dt = 1.0;
      scene.setVelocity(
          [&](int material, Vector2 const &) {
            return material == 1 ? -comes * frame.normal() : Vector2{0.0, 0.0};
          });
      ContactRow const row = nearestRow(rowsOf(scene, scene.dt), frame.at(0.1, 0.0));
      double const part = gap == 0.003 ? 0.1 : gap == 0.0075 ? 0.55 : 1.0;
      EXPECT_NEAR(row.gap, std::min(gap, std::max(comes, 0.0) + part * gap), 1e-12) << gap << ' ' << comes;
    }
}

TEST(CornerContacts, cornerPressedFlat_hasOneRowOnItsTip)
{
  // The square is cut off where it would reach into the block, by 0.03: the tip is 0.06 long, and too short for a row.
  Frame const frame{0.3};
  double const side = 2.5 * std::sqrt(0.5), deep = 0.03;
  TinyScene const scene(
      rectilinearMesh(uniform(8, 8), uniform(8, 8)),
      {polygonBody(0, {frame.at(-20, -20), frame.at(20, -20), frame.at(20, 0), frame.at(-20, 0)}),
       polygonBody(1, {frame.at(0.1 - deep, 0.0), frame.at(0.1 + deep, 0.0), frame.at(0.1 + side, side - deep),
                       frame.at(0.1, 2 * side - deep), frame.at(0.1 - side, side - deep)})},
      2, open_box);
  ContactRow const row = nearestRow(rowsOf(scene), frame.at(0.1, 0.0));
  EXPECT_LT(norm(row.point - frame.at(0.1, 0.0)), 1e-12);
  EXPECT_LT(norm(row.normal - frame.normal()), 1e-12);
  EXPECT_NEAR(row.gap, 0.0, 1e-12);
}

TEST(CornerContacts, cornerAndFaceOneOfThemRigid_haveTheRowWithTheNormalOfTheFace)
{
  for (double const lean : {pi / 10, pi / 4, 0.4 * pi})
    for (int const block : {0, 1})
      for (bool const rigid_face : {false, true})
      {
        Frame const frame{0.3};
        TinyScene scene = cornerAboveFace(frame, 0.1, 0.003, lean, block);
        scene.bodies_n = {rigidBody(rigid_face ? block : 1 - block)};
        ContactRow const row = nearestRow(rowsOf(scene), frame.at(0.1, 0.0));
        EXPECT_EQ(row.material_a, block);
        EXPECT_EQ(rigid_face ? row.body_a : row.body_b, 0);
        EXPECT_LT(norm(row.normal - frame.normal()), 1e-12);
        EXPECT_NEAR(row.gap, 0.003, 1e-12);
      }
}

// The face runs from (4, 4.1) to (4.9, 5): the node before it, (4, 5), moves both ends by a tenth, and no more of the
// face than they do, though its shape function is 0.3 at the foot.
TEST(CornerContacts, cornerAboveAFace_pushesTheNodeBeforeItAsTheFaceFollowsIt)
{
  Frame const frame{pi / 4};
  TinyScene const scene = cornerAboveFace(frame, 0.4, 0.003, pi / 4);
  ContactRow const row = nearestRow(rowsOf(scene), frame.at(0.4, 0.0));
  Quadrilateral const x = cellsOf(scene.mesh)(row.cell_a);
  Vector2 place{0.0, 0.0};
  for (int k = 0; k < 4; ++k)
    place += row.weight_a[k] * x[k];
  EXPECT_LT(norm(x[3] - Vector2{4.0, 5.0}), 1e-12);
  EXPECT_NEAR(row.weight_a[3], 0.1, 1e-12);
  EXPECT_NEAR(row.weight_a[0] + row.weight_a[1] + row.weight_a[2] + row.weight_a[3], 1.0, 1e-12);
  EXPECT_LT(norm(place - row.point), 1e-12);
}

// The tip's sides touch those of the dent, where no row stands but that of the corner.
TEST(CornerContacts, rigidCornerInADent_hasOneRowWithTheNormalOfTheFace)
{
  for (double const deep : {0.05, 0.15})
    for (int const block : {0, 1})
    {
      Frame const frame{0.3};
      double const along = 0.1, lean = pi / 4;
      TinyScene scene = dentedFace(frame, along, deep, lean, block);
      scene.bodies_n = {rigidBody(1 - block)};
      auto const rows = rowsOf(scene);
      ContactRow const row = nearestRow(rows, frame.at(along, -deep));
      EXPECT_EQ(row.material_a, block);
      EXPECT_LT(norm(row.point - frame.at(along, -deep)), 1e-12);
      EXPECT_GT(dot(row.normal, frame.normal()), 0.9999);
      EXPECT_EQ(row.gap, 0.0);
      for (ContactRow const &other : rows)
        EXPECT_TRUE(other.key == row.key || norm(other.point - row.point) > 0.5 || other.gap > 0.05);
    }
}

TEST(CornerContacts, cornerAboveAContactWall_hasTheRowWithTheNormalOfTheWall)
{
  for (double const lean : {pi / 10, pi / 4, 0.4 * pi})
    for (double const along : {0.1, 0.43, 0.85})
    {
      Vector2 const tip{4.0 + along, 0.003};
      double const c = 2.5 * std::cos(lean), s = 2.5 * std::sin(lean);
      TinyScene const scene(
          rectilinearMesh(uniform(8, 8), uniform(8, 8)),
          {polygonBody(0, {tip, tip + Vector2{c, s}, tip + Vector2{c - s, s + c}, tip + Vector2{-s, c}})}, 1,
          std::vector<BoundaryKind>(4, BoundaryKind::ContactWall));
      ContactRow const row = nearestRow(rowsOf(scene), tip);
      EXPECT_EQ(row.material_a, 0);
      EXPECT_EQ(row.body_b, -2);
      EXPECT_LT(norm(row.point - tip), 1e-12);
      EXPECT_LT(norm(row.normal - Vector2{0.0, -1.0}), 1e-12);
      EXPECT_NEAR(row.gap, 0.003, 1e-12);
    }
}

TEST(CornerContacts, squareThatLiesOnAFace_keepsTheRowsOfItsFacets)
{
  Frame const frame{0.3};
  auto const rows = rowsOf(cornerAboveFace(frame, 0.1, 0.0, 0.0, 1));
  ASSERT_GE(rows.size(), 3u);
  for (ContactRow const &row : rows)
    EXPECT_EQ(row.material_a, 0);
}

TEST(CornerContacts, bondedMaterials_keepTheRowsOfTheirFacets)
{
  Frame const frame{0.3};
  TinyScene scene = cornerAboveFace(frame, 0.1, 0.002, pi / 4, 1);
  PairInteraction bonded;
  bonded.kind = Interaction::Bonded;
  scene.setInteraction(0, 1, bonded);
  for (ContactRow const &row : rowsOf(scene))
    EXPECT_EQ(row.material_a, 0);
}

namespace
{

std::vector<ContactRow> tiesOf(TinyScene const &scene)
{
  std::vector<ContactRow> ties;
  for (ContactRow const &row : rowsOf(scene))
    if (row.isWithinBody())
      ties.push_back(row);
  return ties;
}

/// In filled cells.
double massAt(TinyScene const &scene, int dof)
{
  return onHost(scene.dof_mass)(dof);
}

} // namespace

TEST(TipTies, lightNodesOfATip_goWithTheLinearVelocityOfACellBehindThem)
{
  int count = 0;
  for (double const angle : {0.0, 0.3, 0.7})
    for (double const lean : {pi / 4, pi / 6, 0.4 * pi})
      for (double const along : {0.0, 0.15, 0.43})
      {
        TinyScene const scene = cornerAboveFace({angle}, along, 0.003, lean);
        auto const x = onHost(scene.mesh.node_position);
        auto const node = onHost(scene.dof_nodes.node);
        for (ContactRow const &tie : tiesOf(scene))
        {
          ++count;
          EXPECT_EQ(tie.material_a, 1);
          EXPECT_EQ(tie.tied, 1);
          double weight = 0.0;
          Vector2 place{0.0, 0.0};
          for (int k = 0; k < 4; ++k)
          {
            weight += tie.weight_b[k];
            place += tie.weight_b[k] * Vector2{x(node(tie.dof_b[k]), 0), x(node(tie.dof_b[k]), 1)};
            if (tie.weight_a[k] == 0.0)
              continue;
            EXPECT_EQ(tie.weight_a[k], 1.0);
            EXPECT_LT(massAt(scene, tie.dof_a[k]), 0.4);
            EXPECT_EQ(tie.point[0], x(node(tie.dof_a[k]), 0));
            EXPECT_EQ(tie.point[1], x(node(tie.dof_a[k]), 1));
            for (int l = 0; l < 4; ++l)
              EXPECT_NE(tie.dof_b[l], tie.dof_a[k]);
          }
          EXPECT_NEAR(weight, 1.0, 1e-14);
          EXPECT_LT(norm(place - tie.point), 1e-13);
        }
      }
  EXPECT_GE(count, 27);
}

TEST(TipTies, cornerThatComes_keepsMomentumAndItsLightNodesFollow)
{
  Frame const frame{0.7};
  TinyScene scene = comingCorner(frame, 0.75, pi / 6);
  ConstraintReport const report = scene.constrain();
  auto const before = scene.sums(scene.predicted, -2), after = scene.sums(scene.half, -2);
  EXPECT_LT(norm(after.momentum - before.momentum), 1e-15);
  EXPECT_NEAR(after.angular, before.angular, 1e-14);
  EXPECT_LT(after.kinetic, before.kinetic);
  // No node is thrown out of the corner's way: without ties one leaves the face at 0.005.
  auto const square = scene.sums(scene.half, 1, frame.normal());
  EXPECT_LT(square.most, -0.004);
  for (int m = 0; m < 2; ++m) // no force of a body on itself
    EXPECT_EQ(norm(report.pair_force[static_cast<std::size_t>(m) * 3 + static_cast<std::size_t>(m)].impulse), 0.0);
}

TEST(TipTies, bodyThatTurns_isLeftAlone)
{
  Frame const frame{0.3};
  TinyScene scene = cornerAboveFace(frame, 0.1, 0.003, pi / 4);
  scene.setVelocity(
      [&](int material, Vector2 const &x)
      {
        Vector2 const d = x - frame.at(0.1, 0.0);
        return material == 1 ? Vector2{-0.1 * d[1], 0.1 * d[0]} + 0.1 * frame.normal() : Vector2{0.0, 0.0};
      });
  EXPECT_GT(tiesOf(scene).size(), 0u);
  scene.constrain();
  auto const half = onHost(scene.half), predicted = onHost(scene.predicted);
  for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(half(dof, d), predicted(dof, d), 1e-14);
}

TEST(TipTies, cornersThatRebound_haveNone)
{
  TinyScene scene = cornerAboveFace({0.3}, 0.1, 0.003, pi / 4);
  EXPECT_GT(tiesOf(scene).size(), 0u);
  PairInteraction law;
  law.restitution = 0.5;
  scene.setInteraction(0, 1, law);
  EXPECT_EQ(tiesOf(scene).size(), 0u);
}
