// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <Harmos_BodyAround.hpp>
#include <Harmos_CornerProblem.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

constexpr double sliver = 1e-6, film = 1e-3;

double misplaced(Scene const &scene, std::vector<Body> const &all)
{
  return misplacedVolume(scene, reconstructed(scene, sliver), all);
}

/// Least part that a body fills of a mixed cell, and least part that is void, where there is some.
void leastParts(Scene const &scene, double &body, double &open)
{
  auto const offset = onHost(scene.pairs.offset);
  auto const record = onHost(scene.state.record);
  body = open = 1.0;
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
  {
    double filled = 0.0;
    for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
    {
      filled += record(pair, VolumeFraction);
      body = std::min(body, record(pair, VolumeFraction));
    }
    if (filled > 0.0 && filled < 1.0 - 1e-13)
      open = std::min(open, 1.0 - filled);
  }
}

/// A body that ends in a convex corner of 40 to 140 degrees, alone or before a plane, anywhere in a cell.
void expectExactCorners(Geometry geometry, bool with_plane)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int looked_at = 0, exact = 0;
  double worst = 0.0;
  for (int i = 0; i < 300; ++i)
  {
    Place const place(geometry, i);
    Vector2 const corner = place.inMiddleCell(random);
    double const ahead = 360.0 * unit(random), half_angle = 20.0 + 50.0 * unit(random);
    std::vector<Body> all{{halfPlane(ahead - 90.0 + half_angle, corner), halfPlane(ahead + 90.0 - half_angle, corner)}};
    if (with_plane)
    {
      double const tilt = (unit(random) - 0.5) * (90.0 - half_angle), gap = 0.3 * unit(random) / 7.0;
      Vector2 const normal = halfPlane(ahead + tilt, corner).normal;
      all.push_back({halfPlane(ahead + tilt + 180.0, corner + gap * normal)});
    }
    Scene const scene = paint(place.mesh, bodies(all, geometry));
    double body = 0.0, open = 0.0;
    leastParts(scene, body, open);
    if (body < 10.0 * sliver || open < film)
      continue; // these go by their neighbours
    ++looked_at;
    double const wrong = misplaced(scene, all);
    exact += wrong < 1e-7 ? 1 : 0;
    EXPECT_LT(wrong, 2e-3) << ahead << " degrees, half an angle " << half_angle << ", corner " << corner[0] << ' '
                           << corner[1];
    worst = std::max(worst, wrong);
  }
  std::printf("%d of %d corners exact, misplaced volume at most %.1e\n", exact, looked_at, worst);
  EXPECT_GT(looked_at, 150);
  EXPECT_GE(exact, 0.98 * looked_at); // a search may end elsewhere
}

bool contains(Quadrilateral const &quad, Vector2 const &x)
{
  for (int k = 0; k < 4; ++k)
    if (cross(quad[(k + 1) % 4] - quad[k], x - quad[k]) < 0.0)
      return false;
  return true;
}

/// A body with a convex corner inside of another that fills the rest.
void expectExactEmbedding(Geometry geometry)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int looked_at = 0, exact = 0;
  for (int i = 0; i < 300; ++i)
  {
    Place const place(geometry, i);
    Vector2 const corner = place.inMiddleCell(random);
    double const ahead = 360.0 * unit(random), half_angle = 20.0 + 50.0 * unit(random);
    int const wedge = i / 2 % 2; // its material
    std::vector<Body> const alone{
        {halfPlane(ahead - 90.0 + half_angle, corner), halfPlane(ahead + 90.0 - half_angle, corner)}};
    CellFills const of_wedge = bodies(alone, geometry);
    Scene const scene = paint(place.mesh,
                              [&](int cell, Quadrilateral const &quad)
                              {
                                Moments<1> const whole = moments<1>(quad, quad[0], areaWeight(geometry, quad[0]));
                                std::vector<Fill> inside = of_wedge(cell, quad);
                                Fill rest{1 - wedge, whole.volume(), quad[0] + whole.centroid()};
                                if (!inside.empty())
                                {
                                  inside[0].material = wedge;
                                  rest.volume -= inside[0].volume;
                                  rest.centroid = (1.0 / rest.volume) * (whole.volume() * (quad[0] + whole.centroid()) -
                                                                         inside[0].volume * inside[0].centroid);
                                  if (rest.volume > 1e-13 * whole.volume())
                                    inside.insert(inside.begin() + (wedge == 0 ? 1 : 0), rest);
                                  return inside;
                                }
                                return std::vector<Fill>{rest};
                              });
    double body = 0.0, open = 0.0;
    leastParts(scene, body, open);
    if (body < film)
      continue;
    ++looked_at;
    // The wedge's own region tells all: what the other one fills is the rest of the cell.
    auto const x = onHost(place.mesh.node_position);
    auto const node = onHost(place.mesh.cell_node);
    FilledRegions const regions =
        reconstructed(scene, sliver, ReconstructionMethod::MomentOfFluid, deviceCopy("fluid", std::vector<int>{0, 1}));
    auto const first = onHost(regions.cell_region);
    auto const polygon = onHost(regions.polygon);
    auto const offset = onHost(scene.pairs.offset);
    auto const material = onHost(scene.pairs.material);
    auto const mixed = onHost(regions.mixed_cell);
    double wrong = 0.0;
    for (int m = 0; m < regions.num_mixed_cells; ++m)
    {
      int const cell = mixed(m);
      if (!contains(hostQuadrilateral(x, node, cell), corner))
        continue; // a wedge through a cell would leave the other one in two parts
      for (int k = 0; k < offset(cell + 1) - offset(cell); ++k)
        if (material(offset(cell) + k) == wedge)
        {
          Region const &region = polygon(first(cell) + k);
          wrong = std::max(wrong, 49.0 * (area(region) - area(intersection(region, alone[0]))));
        }
    }
    exact += wrong < 1e-7 ? 1 : 0;
  }
  std::printf("%d of %d embedded corners exact\n", exact, looked_at);
  EXPECT_GT(looked_at, 150);
  EXPECT_GE(exact, 0.97 * looked_at); // a search may end elsewhere
}

/// Two blocks, a film of void between them, that both end in a cell, on the same side or on opposite ones.
void expectExactPassing(Geometry geometry)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int looked_at = 0, exact = 0;
  for (int i = 0; i < 400; ++i)
  {
    Place const place(geometry, i);
    auto const inCell = [&]() { return place.inMiddleCell(random); };
    double const across = 360.0 * unit(random), gap = std::pow(10.0, -3.0 + 2.0 * unit(random)) / 7.0;
    Vector2 const face = inCell(), normal = halfPlane(across, face).normal;
    std::vector<Body> const all{
        {halfPlane(across, face), halfPlane(across + 90.0, inCell())},
        {halfPlane(across + 180.0, face + gap * normal), halfPlane(across + (i % 4 < 2 ? 90.0 : -90.0), inCell())}};
    Scene const scene = paint(place.mesh, bodies(all, geometry));
    double body = 0.0, open = 0.0;
    leastParts(scene, body, open);
    if (body < 1e-3)
      continue; // tips that are nearly lost in a cell
    ++looked_at;
    exact += misplaced(scene, all) < 1e-7 ? 1 : 0;
  }
  std::printf("%d of %d pairs exact\n", exact, looked_at);
  EXPECT_GT(looked_at, 100);
  EXPECT_GE(exact, 0.95 * looked_at);
}

} // namespace

TEST(ReconstructCorners, cornersInsideOfAnotherBody_areExact)
{
  expectExactEmbedding(Geometry::Planar);
}

TEST(ReconstructCorners, cornersInsideOfAnotherBodyAboutAnAxis_areExact)
{
  expectExactEmbedding(Geometry::Axisymmetric);
}

TEST(ReconstructCorners, cornersThatPassEachOther_areExact)
{
  expectExactPassing(Geometry::Planar);
}

TEST(ReconstructCorners, cornersThatPassEachOtherAboutAnAxis_areExact)
{
  expectExactPassing(Geometry::Axisymmetric);
}

TEST(ReconstructCorners, cornerInVoid_isExact)
{
  expectExactCorners(Geometry::Planar, false);
}

TEST(ReconstructCorners, cornerInVoidAboutAnAxis_isExact)
{
  expectExactCorners(Geometry::Axisymmetric, false);
}

TEST(ReconstructCorners, cornerBeforeAPlane_isExact)
{
  expectExactCorners(Geometry::Planar, true);
}

// A round body has no corner: each of its cells keeps one line, and the part that lies outside stays what it was.
TEST(ReconstructCorners, roundBody_keepsStraightLines)
{
  Mesh const mesh = makeMesh(12, 12, 1.0 / 12.0);
  for (double const radius : {0.2, 0.35})
  {
    Body round;
    for (double degrees = 1.0; degrees < 360.0; degrees += 1.0)
      round.push_back(halfPlane(degrees, Vector2{0.51, 0.47} + radius * halfPlane(degrees, {0.0, 0.0}).normal));
    Scene const scene = paint(mesh, bodies({round}));
    FilledRegions const regions = reconstructed(scene, sliver);
    auto const cut = onHost(regions.cut_component);
    for (std::size_t i = 0; i < cut.extent(0); ++i)
      EXPECT_GE(cut(i), 0);
  }
}

// A fragment within its cell: no neighbour tells how its edges go on, so that one line bounds it.
TEST(ReconstructCorners, fragmentOnAPlane_keepsAStraightLine)
{
  Mesh const mesh = makeMesh(7, 7, 1.0);
  Vector2 const tip{3.5, 3.6}, plane{3.0, 3.3};
  for (double const steep : {20.0, 40.0})
  {
    std::vector<Body> const all{{halfPlane(270.0, plane), halfPlane(steep, tip), halfPlane(180.0 - steep, tip)},
                                {halfPlane(90.0, plane)}};
    Scene const scene = paint(mesh, bodies(all));
    FilledRegions const regions = reconstructed(scene, sliver);
    auto const first = onHost(regions.cell_region);
    auto const cut = onHost(regions.cut_component);
    EXPECT_GE(cut(first(3 * 7 + 3)), 0);
  }
}

// What has flowed has no straight edges, and keeps one line: the same square has its corners before.
TEST(ReconstructCorners, bodyThatHasFlowed_keepsStraightLines)
{
  Mesh const mesh = makeMesh(8, 8, 1.0);
  Body square;
  for (double const degrees : {20.0, 110.0, 200.0, 290.0})
    square.push_back(halfPlane(degrees, Vector2{4.1, 3.9} + 2.0 * halfPlane(degrees, {0.0, 0.0}).normal));
  auto const corners = [&](double strain)
  {
    Scene const scene = paint(mesh, bodies({square}));
    auto const record = onHost(scene.state.record);
    for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
      record(pair, PlasticStrain) = strain;
    Kokkos::deep_copy(scene.state.record, record);
    auto const cut = onHost(reconstructed(scene, sliver).cut_component);
    int number = 0;
    for (std::size_t i = 0; i < cut.extent(0); ++i)
      number += cut(i) < 0 ? 1 : 0;
    return number;
  };
  EXPECT_EQ(corners(0.09), 4);
  EXPECT_EQ(corners(0.11), 0);
}

bool firstBodyGoesOn(ReconstructionField const &field, int cell)
{
  View<int *> const goes_on("goes_on", 1);
  Kokkos::parallel_for(
      "firstBodyGoesOn", RangePolicy(0, 1), KOKKOS_LAMBDA(int) {
        CellComponents const components = cellComponents(field, cell, true);
        goes_on(0) = BodyAround(field, components, 0).goesOn(components.volume[0]) ? 1 : 0;
      });
  return onHost(goes_on)(0) == 1;
}

// Searches for a corner are left out where the neighbours do not hold what would lie beyond it: not one corner's cell,
// but those of a piece of debris, and of a round body that fills all around.
TEST(ReconstructCorners, cornersGoOnInTheNeighbours_fragmentsDoNot)
{
  Mesh const mesh = makeMesh(7, 7, 1.0);
  int const cell = 3 * 7 + 3;
  auto const goesOn = [&](Body const &body)
  {
    Scene const scene = paint(mesh, bodies({body}));
    return firstBodyGoesOn({scene.mesh, scene.pairs, scene.state.record, scene.state.centroid}, cell);
  };
  for (double const opening : {40.0, 90.0, 140.0})
    for (double degrees = 0.0; degrees < 360.0; degrees += 7.0)
      for (double const place : {0.05, 0.5, 0.95})
      {
        Vector2 const apex{3.0 + place, 3.95 - 0.3 * place};
        Body const corner{halfPlane(degrees + 90.0 + 0.5 * opening, apex),
                          halfPlane(degrees - 90.0 - 0.5 * opening, apex)};
        EXPECT_TRUE(goesOn(corner)) << opening << " degrees towards " << degrees;
      }
  auto const round = [](double radius)
  {
    Body disc;
    for (double degrees = 5.0; degrees < 360.0; degrees += 10.0)
      disc.push_back(halfPlane(degrees, Vector2{3.4, 3.55} + radius * halfPlane(degrees, {0.0, 0.0}).normal));
    return disc;
  };
  for (double const radius : {0.45, 0.55, 0.6, 0.65})
    EXPECT_FALSE(goesOn(round(radius))) << radius;
}

CellComponents componentsOf(ReconstructionField const &field, int cell)
{
  View<CellComponents *> const components("components", 1);
  Kokkos::parallel_for(
      "componentsOf", RangePolicy(0, 1), KOKKOS_LAMBDA(int) { components(0) = cellComponents(field, cell, true); });
  return onHost(components)(0);
}

/// Of what a search for a corner measures, at one place: by unknown and residual.
struct Derivatives
{
  int residuals;
  double own[CornerCell::unknowns][CornerCell::most_residuals],
      central[CornerCell::unknowns][CornerCell::most_residuals];
};

/// \param with_rim Whether `rim` is one. \param angles, part The unknowns.
Derivatives derivativesAt(ReconstructionField const &field, CellComponents const &components, Region const &polygon,
                          Plane2 const &rim, bool with_rim, Vector2 const &angles, double part)
{
  View<Derivatives *> const derivatives("derivatives", 1);
  Kokkos::parallel_for(
      "derivativesAt", RangePolicy(0, 1), KOKKOS_LAMBDA(int) {
        constexpr double difference = 1e-5;
        double const x[3] = {angles[0], angles[1], part};
        CornerProblem const problem(field, components, 0, polygon, with_rim ? &rim : nullptr, 0.1);
        Derivatives &d = derivatives(0);
        d.residuals = 2 + problem.around.count;
        problem.derivatives(problem.at(x), d.own);
        for (int p = 0; p < CornerCell::unknowns; ++p)
        {
          double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
          up[p] += difference;
          down[p] -= difference;
          CornerCell const above = problem.at(up), below = problem.at(down);
          for (int r = 0; r < d.residuals; ++r)
            d.central[p][r] = (above.residual[r] - below.residual[r]) / (2.0 * difference);
        }
      });
  return onHost(derivatives)(0);
}

/// Derivatives of the search for a corner, two lines of any angles and parts, against central differences.
void expectDerivatives(Geometry geometry, bool with_rim)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 100; ++i)
  {
    Place const place(geometry, i);
    Vector2 const corner = place.inMiddleCell(random);
    double const ahead = 360.0 * unit(random);
    Scene const scene =
        paint(place.mesh, bodies({{halfPlane(ahead - 50.0, corner), halfPlane(ahead + 50.0, corner)}}, geometry));
    ReconstructionField const field{scene.mesh, scene.pairs, scene.state.record, scene.state.centroid};
    CellComponents components = componentsOf(field, 3 * 7 + 3);
    if (components.count < 2)
      continue;
    Region polygon = components.polygon;
    Plane2 rim{};
    if (with_rim)
    {
      Division const cut =
          divide(polygon, halfPlane(ahead + 60.0 * unit(random), {0.0, 0.0}).normal, 0.1, 0.9, components.weight);
      polygon = cut.outside;
      rim = cut.line;
      components.volume[0] *= 0.9;
      components.volume[1] *= 0.9;
    }
    Vector2 const angles{6.0 * unit(random), 6.0 * unit(random)};
    double const part = 0.1 + 0.8 * unit(random);
    Derivatives const d = derivativesAt(field, components, polygon, rim, with_rim, angles, part);
    for (int p = 0; p < CornerCell::unknowns; ++p)
      for (int r = 0; r < d.residuals; ++r)
        EXPECT_NEAR(d.own[p][r], d.central[p][r], 2e-6) << "corner " << i << ", unknown " << p << ", residual " << r;
  }
}

TEST(ReconstructCorners, derivativesOfTheSearch_areThoseOfWhatItMeasures)
{
  for (Geometry const geometry : {Geometry::Planar, Geometry::Axisymmetric})
    for (bool const with_rim : {false, true})
      expectDerivatives(geometry, with_rim);
}
