// SPDX-License-Identifier: BSD-3-Clause
#include "../test/TinyScene.hpp"

#include <Harmos_ContactRows.hpp>

#include <benchmark/benchmark.h>

using namespace HarmosTest;

namespace
{

/// An interface at 15 degrees through n x n cells.
TinyScene oblique(int n)
{
  Plane2 const line{{-std::sin(15 * Math::pi / 180), std::cos(15 * Math::pi / 180)}, 0.31 * n};
  auto const below = [](Quadrilateral const &q, Plane2 const &l)
  {
    Region r;
    clip(q, l, r);
    return r;
  };
  TinyScene scene(rectilinearMesh(uniform(n, n), uniform(n, n)),
                  {{0, [=](Quadrilateral const &q) { return below(q, line); }},
                   {1,
                    [=](Quadrilateral const &q) {
                      return below(q, {-line.normal, -line.offset});
                    }}},
                  2, open_box);
  scene.options.tolerance = 1e-8;
  scene.setVelocity([&](int material, Vector2 const &x)
                    { return (material == 0 ? 10.0 + std::sin(x[0]) : -10.0) * line.normal; });
  return scene;
}

void wholeStep(benchmark::State &state)
{
  TinyScene scene = oblique(static_cast<int>(state.range(0)));
  ConstraintReport report;
  for (auto _ : state)
    report = scene.constrain();
  state.counters["rows"] = static_cast<double>(report.rows);
  state.counters["iterations"] = report.iterations;
}

void segments(benchmark::State &state)
{
  TinyScene const scene = oblique(static_cast<int>(state.range(0)));
  for (auto _ : state)
    findInterfaceSegments(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions,
                          Placement::Midpoint);
}

void rows(benchmark::State &state)
{
  TinyScene const scene = oblique(static_cast<int>(state.range(0)));
  InterfaceSegments const s = findInterfaceSegments(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions,
                                                    scene.conditions, Placement::Midpoint);
  BodyTable const bodies = buildBodyTable({}, 2);
  for (auto _ : state)
  {
    SegmentBins const bins = binSegments(s, largestSegment(scene.mesh, s));
    buildContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, s, castRays(scene.mesh, s, bins), bins,
                     scene.conditions, bodies, scene.bonds, scene.options);
  }
  state.counters["segments"] = s.count;
}

} // namespace

BENCHMARK(wholeStep)->Arg(64)->Arg(512)->Unit(benchmark::kMicrosecond);
BENCHMARK(segments)->Arg(64)->Arg(512)->Unit(benchmark::kMicrosecond);
BENCHMARK(rows)->Arg(64)->Arg(512)->Unit(benchmark::kMicrosecond);
