// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_OnHost.hpp>
#include <Harmos_RigidSurfaces.hpp>

#include <gtest/gtest.h>

using namespace Harmos;

namespace
{

constexpr double cell = 0.1;

Vector2 normalAt(RigidSurfaces const &surfaces, int body, Vector2 const &midpoint, Vector2 const &facet_normal,
                 Vector2 const &point)
{
  View<Vector2 *> const normal("normal", 1);
  Kokkos::parallel_for(
      "normalAt", RangePolicy(0, 1),
      KOKKOS_LAMBDA(int) { normal(0) = surfaces.normalAt(body, midpoint, facet_normal, cell, point); });
  return onHost(normal)(0);
}

/// The normal of the first of these outlines where its facet and a point of contact are as given.
Vector2 normalOf(Shape const &shape, Vector2 const &midpoint, Vector2 const &facet_normal, Vector2 const &point)
{
  return normalAt(rigidSurfaces({Shape::disc({9.0, 9.0}, 1.0), shape}), 1, midpoint, facet_normal, point);
}

void expectVector(Vector2 const &found, Vector2 const &expected)
{
  EXPECT_NEAR(found[0], expected[0], 1e-15);
  EXPECT_NEAR(found[1], expected[1], 1e-15);
}

Vector2 const none{0.0, 0.0};

} // namespace

TEST(RigidSurfaces, halfPlane_hasItsNormalWhateverTheFacetsTilt)
{
  Vector2 const n = normalised(Vector2{-0.3, 1.0});
  Shape const floor = Shape::halfPlane({0.2, 0.1}, n);
  Vector2 const point = Vector2{0.2, 0.1} + 3.0 * perpendicular(n) + 0.01 * n;
  expectVector(normalOf(floor, point, normalised(n + 0.2 * perpendicular(n)), point), n);
  expectVector(normalOf(floor, point + 0.51 * cell * n, n, point), none);
  expectVector(normalOf(floor, point, -n, point), n);
}

TEST(RigidSurfaces, circles_haveTheirRadialNormalAtThePointOfContact)
{
  Vector2 const centre{0.3, -0.2}, to = normalised(Vector2{0.6, 0.8});
  Vector2 const beside = normalised(to + 0.1 * perpendicular(to));
  Shape const disc = Shape::disc(centre, 1.0), ring = Shape::annulus(centre, 0.5, 1.0);
  expectVector(normalOf(disc, centre + 0.999 * to, to, centre + beside), beside);
  expectVector(normalOf(ring, centre + 0.999 * to, to, centre + beside), beside);
  expectVector(normalOf(ring, centre + 0.501 * to, -to, centre + 0.5 * beside), -beside);
  expectVector(normalOf(ring, centre + 0.501 * to, to, centre + 0.5 * beside), none); // a hole's facet looks inwards
}

TEST(RigidSurfaces, polygons_haveTheirEdgesNormalsAndNoneBeyondTheirEnds)
{
  Shape const box = Shape::rectangle({0.0, 0.0}, {2.0, 1.0});
  expectVector(normalOf(box, {0.95, 0.5}, {0.0, 1.0}, {0.99, 0.51}), {0.0, 1.0});
  expectVector(normalOf(box, {0.95, 0.5}, {0.0, 1.0}, {1.01, 0.51}), none); // beyond the corner
  expectVector(normalOf(box, {1.0, -0.4}, {1.0, 0.0}, {1.0, -0.4}), {1.0, 0.0});
  expectVector(normalOf(box, {0.98, 0.48}, normalised(Vector2{1.0, 1.0}), {0.98, 0.48}), none); // cuts the corner off
  // Either side of a thin plate has its own.
  Shape const plate = Shape::rectangle({0.0, 0.0}, {2.0, 0.01});
  expectVector(normalOf(plate, {0.0, -0.004}, {0.0, 1.0}, {0.0, 0.0}), {0.0, 1.0});
  expectVector(normalOf(plate, {0.0, 0.004}, {0.0, -1.0}, {0.0, 0.0}), {0.0, -1.0});
}

TEST(RigidSurfaces, withoutOutlines_thereIsNone)
{
  expectVector(normalAt(rigidSurfaces({}), 0, {0.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}), none);
}
