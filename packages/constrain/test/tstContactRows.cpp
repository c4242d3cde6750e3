// SPDX-License-Identifier: BSD-3-Clause
#include "RowsOfScene.hpp"

#include <gtest/gtest.h>

#include <random>

using namespace HarmosTest;

namespace
{

Region cutBy(Quadrilateral const &cell, Plane2 const &line)
{
  Region r;
  clip(cell, line, r);
  return r;
}

Plane2 reversed(Plane2 const &p)
{
  return {-p.normal, -p.offset};
}

Vector2 centreOf(Quadrilateral const &q)
{
  return 0.25 * ((q[0] + q[1]) + (q[2] + q[3]));
}

/// Two materials split in every cell by the line that a function gives for it.
TinyScene split(int n, std::function<Plane2(Quadrilateral const &)> const &line)
{
  return TinyScene(rectilinearMesh(uniform(n, n), uniform(n, n)),
                   {{0, [line](Quadrilateral const &q) { return cutBy(q, line(q)); }},
                    {1, [line](Quadrilateral const &q) { return cutBy(q, reversed(line(q))); }}},
                   2, open_box);
}

/// Rows between two bodies, which a function cuts out of each of 8 x 8 cells.
std::vector<ContactRow> rowsBetween(std::function<Region(Quadrilateral const &)> const &first,
                                    std::function<Region(Quadrilateral const &)> const &second)
{
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)), {{0, first}, {1, second}}, 2, open_box);
  scene.options.short_segments = deviceCopy("short_segments", std::vector<ShortSegments>(2, ShortSegments::Shared));
  return rowsOf(scene);
}

double angleBetween(Vector2 const &a, Vector2 const &b)
{
  return std::fabs(std::atan2(cross(a, b), dot(a, b)));
}

/// The line of given normal below which a cell holds as much as `volume`.
Plane2 lineOfVolume(Quadrilateral const &cell, Vector2 const &normal, double volume)
{
  double low = -1e3, high = 1e3;
  for (int i = 0; i < 100; ++i)
  {
    double const middle = 0.5 * (low + high);
    (area(cutBy(cell, {normal, middle})) < volume ? low : high) = middle;
  }
  return {normal, 0.5 * (low + high)};
}

/// Area of a cell inside a circle, by a polygon of 4000 corners clipped to the cell.
double circleArea(Quadrilateral const &cell, Vector2 const &centre, double radius)
{
  double sum = 0.0;
  int const n = 4000;
  for (int i = 0; i < n; ++i)
  {
    double const a = 2 * Math::pi * i / n, b = 2 * Math::pi * (i + 1) / n;
    Polygon<3> sector;
    sector.push(centre);
    sector.push(centre + radius * Vector2{std::cos(a), std::sin(a)});
    sector.push(centre + radius * Vector2{std::cos(b), std::sin(b)});
    Region part;
    clipConvex(sector, cell, part);
    sum += area(part);
  }
  return sum;
}

} // namespace

TEST(ContactRows, straightLineAt15Degrees_normalsAreExact)
{
  Vector2 const n{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)};
  auto const rows = rowsOf(split(12, [n](Quadrilateral const &) { return Plane2{n, 4.321}; }));
  ASSERT_GE(rows.size(), 12u);
  for (ContactRow const &r : rows)
  {
    EXPECT_LT(angleBetween(r.normal, n), 1e-13);
    EXPECT_NEAR(r.gap, 0.0, 1e-14);
    EXPECT_EQ(r.material_a, 0);
  }
}

// Every cell's line is tilted by up to 3 degrees and cuts off the exact volume, as a reconstruction would.
TEST(ContactRows, noisyLineAt15Degrees_normalsAreAveraged)
{
  Vector2 const n{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)}, t = perpendicular(n);
  auto const rows = rowsOf(split(12,
                                 [&](Quadrilateral const &cell)
                                 {
                                   Vector2 const c = centreOf(cell);
                                   double const tilt = 0.05 * std::sin(13.0 * c[0] + 29.0 * c[1]);
                                   return lineOfVolume(cell, normalised(n + tilt * t), area(cutBy(cell, {n, 4.321})));
                                 }));
  double largest = 0.0;
  for (ContactRow const &r : rows)
    largest = std::max(largest, angleBetween(r.normal, n));
  RecordProperty("largest_angle_error", std::to_string(largest));
  EXPECT_GT(rows.size(), 10u);
  EXPECT_LT(largest, 0.0125); // a quarter of the tilt
}

TEST(ContactRows, circleOfRadius8_normalsAreRadial)
{
  Vector2 const centre{10.13, 9.87};
  auto const rows =
      rowsOf(split(20, [&](Quadrilateral const &cell)
                   { return lineOfVolume(cell, normalised(centreOf(cell) - centre), circleArea(cell, centre, 8.0)); }));
  double largest = 0.0, squares = 0.0;
  for (ContactRow const &r : rows)
  {
    double const e = angleBetween(r.normal, normalised(r.point - centre));
    largest = std::max(largest, e);
    squares += e * e;
  }
  RecordProperty("largest_angle_error", std::to_string(largest));
  RecordProperty("rms_angle_error", std::to_string(std::sqrt(squares / rows.size())));
  EXPECT_GT(rows.size(), 50u);
  EXPECT_LT(largest, 0.02);
}

// A step of 0.3 of a cell in a line on faces: the step's own face piece is a tooth and carries no row.
TEST(ContactRows, smallStepBetweenCells_carriesNoRow)
{
  auto const rows = rowsOf(split(8,
                                 [](Quadrilateral const &cell) {
                                   return Plane2{{0.0, 1.0}, centreOf(cell)[0] < 4.0 ? 4.0 : 4.3};
                                 }));
  EXPECT_EQ(rows.size(), 8u);
  for (ContactRow const &r : rows)
    EXPECT_GT(r.normal[1], 0.9);
}

// Block 0 ends 0.3 of a cell above a face of its neighbour's column: that face is exposed by less than a half.
TEST(ContactRows, faceExposedByLessThanAHalf_carriesNoRow)
{
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)), {boxBody(0, 0, 0, 4, 4.3), boxBody(1, 4, 0, 8, 8)}, 2,
                  open_box);
  EXPECT_EQ(rowsOf(scene).size(), 4u);
  scene.options.exposed_face = 0.25;
  EXPECT_EQ(rowsOf(scene).size(), 5u);
}

TEST(ContactRows, keysAscendAndWeightsReproduceThePoints)
{
  Vector2 const n{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)};
  TinyScene const scene = split(12, [n](Quadrilateral const &) { return Plane2{n, 4.321}; });
  auto const rows = rowsOf(scene);
  std::vector<Vector2> position(static_cast<std::size_t>(scene.dof_nodes.num_dof_nodes));
  scene.forEachDof([&](int dof, int, Vector2 const &x) { position[static_cast<std::size_t>(dof)] = x; });
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (i > 0)
    {
      EXPECT_LT(rows[i - 1].key, rows[i].key);
    }
    Vector2 a{0.0, 0.0}, b{0.0, 0.0};
    for (int k = 0; k < 4; ++k)
    {
      a += rows[i].weight_a[k] * position[static_cast<std::size_t>(rows[i].dof_a[k])];
      b += rows[i].weight_b[k] * position[static_cast<std::size_t>(rows[i].dof_b[k])];
    }
    EXPECT_LT(norm(a - rows[i].point), 1e-13);
    EXPECT_LT(norm(b - rows[i].point), 1e-13);
  }
}

namespace
{

Vector2 const oblique{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)};

/// Two halves of 12 x 12 cells at 15 degrees, `gap` apart.
TinyScene apart(double gap, ShortSegments short_segments)
{
  TinyScene scene(rectilinearMesh(uniform(12, 12), uniform(12, 12)),
                  {{0,
                    [](Quadrilateral const &q) {
                      return cutBy(q, Plane2{oblique, 4.321});
                    }},
                   {1,
                    [gap](Quadrilateral const &q) {
                      return cutBy(q, reversed({oblique, 4.321 + gap}));
                    }}},
                  2, open_box);
  scene.options.short_segments = deviceCopy("short_segments", std::vector<ShortSegments>(2, short_segments));
  return scene;
}

/// What a uniform pressure on the rows does to the dofs of the lower half, per pressure.
std::vector<double> forces(TinyScene const &scene, std::vector<ContactRow> const &rows)
{
  std::vector<double> f(static_cast<std::size_t>(scene.dof_nodes.num_dof_nodes), 0.0);
  for (ContactRow const &r : rows)
    for (int k = 0; k < 4; ++k)
      f[static_cast<std::size_t>(r.dof_a[k])] += r.length * r.weight_a[k];
  return f;
}

double largestDifference(std::vector<double> const &f, std::vector<double> const &g)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i)
    largest = std::max(largest, std::fabs(f[i] - g[i]));
  return largest;
}

} // namespace

// The volume that an edge sweeps: of a bent one its ends count a quarter each and its middle half, of a short one,
// which stays straight, its ends half each.
TEST(ContactRows, weightsAreThoseOfTheSweptVolumeWhereStressIsInBalanceWithThem)
{
  TinyScene scene = apart(0.0, ShortSegments::Kept);
  auto const rows = rowsOf(scene);
  EXPECT_GT(rows.size(), 10u);
  auto const cell = cellsOf(scene.mesh);
  for (ContactRow const &r : rows)
  {
    Quadrilateral const &q = cell(r.cell_a);
    double N[3][4];
    for (int j = 0; j < 3; ++j)
      shapeFunctionsAt(q, r.point + (0.5 * (j - 1) * r.length) * perpendicular(oblique), N[j]);
    double const ends = r.length < 0.1 ? 0.5 : 0.25;
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(r.weight_a[k], ends * (N[0][k] + N[2][k]) + (1.0 - 2.0 * ends) * N[1][k], 1e-13);
  }
}

TEST(ContactRows, shortSegmentsShareTheirTractionsInFullCells)
{
  auto const of = [](double gap, ShortSegments short_segments)
  {
    TinyScene scene = apart(gap, short_segments);
    auto const rows = rowsOf(scene);
    return std::make_pair(rows.size(), forces(scene, rows));
  };
  auto const dropped = of(0.0, ShortSegments::Dropped), kept = of(0.0, ShortSegments::Kept),
             shared = of(0.0, ShortSegments::Shared);
  EXPECT_LT(dropped.first, kept.first);
  EXPECT_EQ(shared.first, dropped.first);
  EXPECT_GT(largestDifference(dropped.second, kept.second), 0.02);
  EXPECT_LT(largestDifference(shared.second, kept.second), 1e-13);
  constexpr double gap = 0.15; // more than 1% of the cell is void where a segment is longer than 0.07 cells
  auto const open = of(gap, ShortSegments::Shared), at_points = of(gap, ShortSegments::Dropped);
  EXPECT_EQ(open.first, at_points.first);
  EXPECT_LT(largestDifference(open.second, at_points.second), 1e-13);
  EXPECT_LT(open.first, of(gap, ShortSegments::Kept).first);
}

// Void takes a wedge from one body, 1e-4 wide to its length, along 0.3 cells of the line in one cell. The wedge is
// between the first body's two edges and the other, or beyond the last piece of its one edge.
TEST(ContactRows, piecesOfOneLineInACellCarryOneRow)
{
  Plane2 const line{oblique, 4.321};
  auto const with = [&](int body, double angle)
  {
    auto const cut = [&line, body, angle](int material, Quadrilateral const &q)
    {
      Plane2 const side = material == 0 ? line : reversed(line);
      Region const whole = cutBy(q, side);
      Vector2 const bend{4.7, (line.offset - 4.7 * oblique[0]) / oblique[1]};
      if (material != body || std::fabs(centreOf(q)[0] - 4.5) > 0.1 || std::fabs(centreOf(q)[1] - bend[1]) > 0.5)
        return whole;
      Vector2 const turned = side.normal + (material == 0 ? angle : -angle) * perpendicular(side.normal);
      Region less;
      clip(whole, {(1.0 / norm(turned)) * turned, dot(turned, bend) / norm(turned)}, less);
      return less;
    };
    return rowsBetween([cut](Quadrilateral const &q) { return cut(0, q); },
                       [cut](Quadrilateral const &q) { return cut(1, q); });
  };
  auto const whole = with(-1, 0.0);
  for (int const body : {0, 1})
    for (double const angle : {1e-4, -1e-4})
    {
      auto const rows = with(body, angle);
      ASSERT_EQ(rows.size(), whole.size()) << body << " " << angle;
      for (std::size_t r = 0; r < rows.size(); ++r)
      {
        EXPECT_LT(norm(rows[r].point - whole[r].point) + std::fabs(rows[r].length - whole[r].length), 2e-4);
        EXPECT_NEAR(rows[r].gap, 0.0, 1e-12);
        for (int k = 0; k < 4; ++k)
          EXPECT_NEAR(rows[r].weight_a[k], whole[r].weight_a[k], 1e-3);
      }
    }
}

// Pieces of 5e-7 and 4e-7 cells in the middle of a line: each ends as near to the other as pieces join.
TEST(ContactRows, piecesShorterThanWhatJoins_carryOneRow)
{
  Plane2 const line{oblique, 4.321};
  auto const with = [&line](bool cut)
  {
    auto const lower = [&line, cut](Quadrilateral const &q)
    {
      Region const whole = cutBy(q, line);
      Region pieces;
      for (int i = 0; i < whole.size; ++i)
      {
        Vector2 const a = whole[i], b = whole[whole.next(i)], middle = 0.5 * (a + b);
        pieces.push(a);
        bool const along = std::fabs(dot(oblique, a) - 4.321) < 1e-12 && std::fabs(dot(oblique, b) - 4.321) < 1e-12;
        for (double const at : {0.0, 5e-7, 9e-7})
          if (cut && along && norm(b - a) > 0.5)
            pieces.push(middle + (at / norm(b - a)) * (b - a));
      }
      return pieces;
    };
    return rowsBetween(lower, [&line](Quadrilateral const &q) { return cutBy(q, reversed(line)); });
  };
  auto const whole = with(false), pieces = with(true);
  ASSERT_EQ(pieces.size(), whole.size());
  for (std::size_t r = 0; r < whole.size(); ++r)
    EXPECT_LT(norm(pieces[r].point - whole[r].point) + std::fabs(pieces[r].length - whole[r].length), 1e-12);
}

namespace
{

/// A wedge of 19 degrees, its tip `gap` of a cell below a block; both come at V / 2 against each other.
TinyScene wedgeBelowBlock(double gap, double V)
{
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)),
                  {polygonBody(0, {{0, 0}, {8, 0}, {8, 2.0}, {4, 3.4}, {0, 2.0}}), boxBody(1, 0, 3.4 + gap, 8, 8)}, 2,
                  open_box);
  scene.dt = 1.0;
  scene.setVelocity([V](int material, Vector2 const &) { return Vector2{0.0, material == 0 ? 0.5 * V : -0.5 * V}; });
  return scene;
}

/// Area in which moved regions of the two materials overlap.
double overlapAfterStep(TinyScene const &scene)
{
  auto const moved = movedRegions(scene);
  auto const material = onHost(scene.pairs.material);
  double sum = 0.0;
  for (int p = 0; p < scene.pairs.num_pairs; ++p)
    for (int q = 0; q < scene.pairs.num_pairs; ++q)
      if (material(p) == 0 && material(q) == 1)
      {
        Polygon<24> both;
        clipConvex(moved(p), moved(q), both);
        sum += area(both);
      }
  return sum;
}

} // namespace

TEST(ContactRows, facetsThatComeFastWithOneEndAhead_haveTwoRows)
{
  TinyScene const scene = wedgeBelowBlock(0.1, 0.3);
  auto const slow = rowsOf(scene, 1e-3), fast = rowsOf(scene, 1.0);
  EXPECT_EQ(fast.size(), 2 * slow.size());
  double length[2] = {0.0, 0.0};
  for (ContactRow const &row : slow)
    length[0] += row.length;
  for (std::size_t i = 0; i < fast.size(); ++i)
  {
    length[1] += fast[i].length;
    if (i > 0)
    {
      EXPECT_LT(fast[i - 1].key, fast[i].key);
    }
    // The gap along the normal of the facet, to y = 3.5.
    double const cosine = 4.0 / std::hypot(4.0, 1.4);
    EXPECT_NEAR(fast[i].gap, (3.5 - fast[i].point[1]) / cosine, 1e-12);
  }
  EXPECT_NEAR(length[0], length[1], 1e-12);
}

// A tip that is 0.1 cells away and closes by 0.3 while the facets beside it, in their middle, still have 0.275 to go.
TEST(ContactRows, tipThatClosesFast_isStopped)
{
  TinyScene scene = wedgeBelowBlock(0.1, 0.3);
  scene.constrain();
  EXPECT_LT(overlapAfterStep(scene), 0.02); // with rows in the middles alone 0.10
}

TEST(ContactRows, parallelFacesThatCloseFast_keepOneRow)
{
  TinyScene scene(rectilinearMesh(uniform(8, 8), uniform(8, 8)), {boxBody(0, 0, 0, 8, 3.4), boxBody(1, 0, 3.5, 8, 8)},
                  2, open_box);
  scene.setVelocity([](int material, Vector2 const &) { return Vector2{0.0, material == 0 ? 0.15 : -0.15}; });
  EXPECT_EQ(rowsOf(scene, 1.0).size(), 8u);
}

TEST(ContactRows, facetsThatTouchAndDoNotClose_keepOneRow)
{
  Vector2 const n{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)};
  TinyScene scene = split(12, [n](Quadrilateral const &) { return Plane2{n, 4.321}; });
  scene.setVelocity([&](int material, Vector2 const &) { return (material == 0 ? 0.4 : -0.4) * perpendicular(n); });
  EXPECT_EQ(rowsOf(scene, 1.0).size(), rowsOf(scene).size());
}

namespace
{

/// Two ranks of which this one holds everything: rows travel through pack and unpack and come back unchanged.
class LoneExchange : public Exchange
{
public:
  int size() const override { return 2; }
};

} // namespace

TEST(ContactRows, packedAndUnpacked_giveTheSameVelocities)
{
  Vector2 const n{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)};
  TinyScene scene = split(12, [n](Quadrilateral const &) { return Plane2{n, 4.321}; });
  scene.setVelocity([&](int material, Vector2 const &x) { return (material == 0 ? 10.0 + x[1] : -10.0 - x[0]) * n; });
  ConstraintReport const one = scene.constrain();
  auto const serial = Kokkos::create_mirror(scene.half);
  Kokkos::deep_copy(serial, scene.half);
  ConstraintReport const two =
      constrainVelocities(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions, scene.dof_mass,
                          scene.velocity_n, scene.predicted, scene.half, {}, scene.bodies, scene.dt, scene.dt,
                          scene.stress, scene.bonds, scene.options, LoneExchange());
  auto const packed = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
  EXPECT_EQ(one.iterations, two.iterations);
  EXPECT_EQ(one.contact_loss, two.contact_loss);
  for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
    for (int d = 0; d < 2; ++d)
      EXPECT_EQ(serial(dof, d), packed(dof, d));
}

// What a call leaves in kept memory must not reach the next one, which has more rows or fewer.
TEST(ContactRows, inKeptArrays_giveTheSameVelocitiesAsInNewOnes)
{
  ConstraintWork kept;
  for (int const cells : {6, 20, 9})
    for (double const offset : {4.321, 5.0})
    {
      Vector2 const n{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)};
      TinyScene scene = split(cells, [&](Quadrilateral const &) { return Plane2{n, offset}; });
      scene.setVelocity([&](int material, Vector2 const &x) { return (material == 0 ? 10.0 + x[1] : -10.0) * n; });
      ConstraintReport const anew = scene.constrain();
      auto const expected = Kokkos::create_mirror(scene.half);
      Kokkos::deep_copy(expected, scene.half);
      scene.kept = &kept;
      for (int call = 0; call < 2; ++call)
      {
        ConstraintReport const again = scene.constrain();
        EXPECT_EQ(again.rows, anew.rows);
        EXPECT_EQ(again.contact_loss, anew.contact_loss);
        auto const found = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.half);
        for (int dof = 0; dof < scene.dof_nodes.num_dof_nodes; ++dof)
          for (int d = 0; d < 2; ++d)
            EXPECT_EQ(found(dof, d), expected(dof, d));
      }
    }
}
