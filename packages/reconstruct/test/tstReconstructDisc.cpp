// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructScene.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace Harmos;
using namespace Harmos::Testing;

namespace
{

struct Disc
{
  Vector2 centre;
  double radius;
};

/// Moments about the disc's centre of (polygon ∩ disc): Green's theorem along each edge, straight where it is inside,
/// the circle's sector where it is outside.
template <int Capacity>
Moments<1> discMoments(Polygon<Capacity> const &polygon, Disc const &disc)
{
  double const R = disc.radius;
  Moments<1> m;
  for (int i = 0; i < polygon.size; ++i)
  {
    Vector2 const a = polygon[i] - disc.centre, e = polygon[polygon.next(i)] - polygon[i];
    double cuts[4] = {0.0, 1.0, 1.0, 1.0};
    int count = 1;
    double const A = dot(e, e), B = dot(a, e), C = dot(a, a) - R * R, D = B * B - A * C;
    if (D > 0.0)
      for (double const root : {(-B - std::sqrt(D)) / A, (-B + std::sqrt(D)) / A})
        if (root > 0.0 && root < 1.0)
          cuts[count++] = root;
    cuts[count] = 1.0;
    for (int k = 0; k < count; ++k)
    {
      Vector2 const p = a + cuts[k] * e, q = a + cuts[k + 1] * e;
      if (norm(a + 0.5 * (cuts[k] + cuts[k + 1]) * e) <= R)
      {
        double const c = cross(p, q);
        m.value[0] += c / 2.0;
        for (int d = 0; d < 2; ++d)
          m.value[1 + d] += c * (p[d] + q[d]) / 6.0;
      }
      else
      {
        double const from = std::atan2(p[1], p[0]), turn = std::atan2(cross(p, q), dot(p, q)), to = from + turn;
        m.value[0] += R * R * turn / 2.0;
        m.value[1] += R * R * R * (std::sin(to) - std::sin(from)) / 3.0;
        m.value[2] += R * R * R * (std::cos(from) - std::cos(to)) / 3.0;
      }
    }
  }
  return m;
}

/// Symmetric difference of the reconstructed and the exact disc over the disc's area.
double symmetricDifference(int n, Vector2 const &centre, ReconstructionMethod method, double sliver)
{
  Disc const disc{centre, 0.3};
  Scene const scene = paint(makeMesh(n, n, 1.0 / n),
                            [&disc](int, Quadrilateral const &quad)
                            {
                              Moments<1> const m = discMoments(quad, disc);
                              std::vector<Fill> fills;
                              if (m.volume() > 1e-13 * area(quad))
                                fills.push_back({0, m.volume(), disc.centre + m.centroid()});
                              return fills;
                            });
  FilledRegions const regions = reconstructed(scene, sliver, method);
  auto const polygon = onHost(regions.polygon);
  double misplaced = 0.0;
  for (int i = 0; i < regions.num_mixed_cells; ++i) // one pair each
    misplaced += 2.0 * (area(polygon(i)) - discMoments(polygon(i), disc).volume());
  return misplaced / (Math::pi * disc.radius * disc.radius);
}

} // namespace

TEST(ReconstructDisc, discMoments_ofAWholeDiscAreExact)
{
  Quadrilateral square;
  for (Vector2 const &corner : {Vector2{0.0, 0.0}, Vector2{1.0, 0.0}, Vector2{1.0, 1.0}, Vector2{0.0, 1.0}})
    square.push(corner);
  Moments<1> const m = discMoments(square, {{0.4, 0.55}, 0.3});
  EXPECT_NEAR(m.volume(), Math::pi * 0.09, 1e-14);
  EXPECT_NEAR(m.first(0), 0.0, 1e-15);
  EXPECT_NEAR(m.first(1), 0.0, 1e-15);
}

TEST(ReconstructDisc, symmetricDifference_convergesAtSecondOrder)
{
  std::printf("  n  centre        Youngs    least squares  moment-of-fluid\n");
  for (Vector2 const &centre : {Vector2{0.5, 0.5}, Vector2{0.5123, 0.4871}})
  {
    double last = 0.0;
    for (int const n : {32, 64, 128})
    {
      double const youngs = symmetricDifference(n, centre, ReconstructionMethod::Youngs, 1e-3);
      double const fitted = symmetricDifference(n, centre, ReconstructionMethod::MomentOfFluid, 1.0);
      double const mof = symmetricDifference(n, centre, ReconstructionMethod::MomentOfFluid, 1e-3);
      std::printf("%4d %.4f %.4f %.3e %.3e      %.3e\n", n, centre[0], centre[1], youngs, fitted, mof);
      EXPECT_LT(mof, 6.2e-4 * 32 * 32 / (n * n) * (n == 64 ? 1.25 : 1.1));
      EXPECT_LT(fitted, 1.2e-3 * 32 * 32 / (n * n) * 1.1);
      if (last > 0.0)
      {
        EXPECT_LT(mof, 0.4 * last);
      }
      last = mof;
    }
  }
}

// A disc in a socket with a thin void between: the void must lie between the bodies in every three-component cell.
TEST(ReconstructDisc, thinVoidBetweenDiscAndSocket_bodiesStayOnTheirSides)
{
  int const n = 32;
  double const h = 1.0 / n;
  std::printf("  gap / h  largest part of a cell in the wrong body\n");
  for (double const gap : {1e-12, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.3})
  {
    Disc const disc{{0.5123, 0.4871}, 0.3}, socket{disc.centre, disc.radius + gap * h};
    Scene const scene = paint(makeMesh(n, n, h),
                              [&](int, Quadrilateral const &quad)
                              {
                                Moments<1> const inner = discMoments(quad, disc), outer = discMoments(quad, socket);
                                Moments<1> rest = moments<1>(quad, disc.centre);
                                rest -= outer;
                                std::vector<Fill> fills;
                                if (inner.volume() > 1e-13 * area(quad))
                                  fills.push_back({0, inner.volume(), disc.centre + inner.centroid()});
                                if (rest.volume() > 1e-13 * area(quad))
                                  fills.push_back({1, rest.volume(), disc.centre + rest.centroid()});
                                return fills;
                              });
    FilledRegions const regions = reconstructed(scene);
    auto const mixed = onHost(regions.mixed_cell);
    auto const polygon = onHost(regions.polygon);
    auto const offset = onHost(scene.pairs.offset);
    auto const material = onHost(scene.pairs.material);
    double worst = 0.0;
    int r = 0; // regions follow the pairs of the mixed cells
    for (int i = 0; i < regions.num_mixed_cells; ++i)
      for (int pair = offset(mixed(i)); pair < offset(mixed(i) + 1); ++pair, ++r)
      {
        double const in_socket = discMoments(polygon(r), socket).volume();
        double const in_disc = discMoments(polygon(r), disc).volume();
        double const wrong = material(pair) == 0 ? area(polygon(r)) - in_socket : in_disc;
        worst = std::max(worst, wrong / (h * h));
      }
    std::printf("  %7.0e  %.2e\n", gap, worst);
    EXPECT_LT(worst, 6e-3) << "gap " << gap;
  }
}
