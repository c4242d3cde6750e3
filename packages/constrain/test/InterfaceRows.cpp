// SPDX-License-Identifier: BSD-3-Clause
// InterfaceRows CELLS ANGLE OFFSET PLACEMENT: the contact rows of a straight interface between two materials that fill
// the unit square, as text: for studies of the multipliers (test/verification/inf_sup.py).
//
// CELLS in each direction; the interface stands at ANGLE degrees to the x axis, OFFSET cells above the centre.
// Lines: "dof x y material"; "pair fraction dof dof dof dof" (corners of a cell, counter-clockwise);
// "row length nx ny {dof weight} {group share}", weights signed: the row's velocity is sum weight n . v, its impulse
// sum share times the groups' impulses.
#include "TinyScene.hpp"

#include <Harmos_ContactRows.hpp>
#include <Harmos_VitalVertices.hpp>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

using namespace HarmosTest;

namespace
{

std::map<std::string, Placement> const placements = {{"midpoint", Placement::Midpoint},
                                                     {"gauss points", Placement::GaussPoints},
                                                     {"segment ends", Placement::SegmentEnds},
                                                     {"vital vertices", Placement::VitalVertices},
                                                     {"mortar", Placement::Mortar}};

TinyScene twoHalves(int cells, double angle, double offset)
{
  double const a = angle * Math::pi / 180.0;
  Vector2 const n{-std::sin(a), std::cos(a)};
  Plane2 const line{n, dot(n, Vector2{0.5, 0.5}) + offset / cells};
  auto const side = [](Plane2 const &l)
  {
    return [l](Quadrilateral const &q)
    {
      Region r;
      clip(q, l, r);
      return r;
    };
  };
  return TinyScene(rectilinearMesh(uniform(1.0, cells), uniform(1.0, cells)),
                   {{0, side(line)}, {1, side({-line.normal, -line.offset})}}, 2, open_box);
}

void printScene(TinyScene const &scene)
{
  scene.forEachDof([](int, int material, Vector2 const &x)
                   { std::printf("dof %.17g %.17g %d\n", x[0], x[1], material); });
  auto const dof = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.pairs.dof_node);
  auto const record = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), scene.record);
  for (int i = 0; i < scene.pairs.num_pairs; ++i)
    std::printf("pair %.17g %d %d %d %d\n", record(i, VolumeFraction), dof(i, 0), dof(i, 1), dof(i, 2), dof(i, 3));
}

/// By row: the groups that share its multiplier; without groups itself.
std::vector<std::vector<GroupShare>> sharesOf(TinyScene const &scene, std::vector<ContactRow> const &rows)
{
  std::vector<std::vector<GroupShare>> own;
  for (std::size_t i = 0; i < rows.size(); ++i)
    own.push_back({{static_cast<int>(i), 1.0}});
  int groups = 0;
  return sharesMultipliers(scene.options.placement)
             ? vitalGroups(tracesOf(scene.mesh, rows), std::vector<int>(rows.size(), 0), groups)
             : own;
}

void printRows(TinyScene const &scene)
{
  ContactRows const found = findContactRows(scene.mesh, scene.pairs, scene.dof_nodes, scene.regions, scene.conditions,
                                            buildBodyTable({}, 2), scene.bonds, scene.options, serialExchange());
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), found.row);
  std::vector<ContactRow> const rows(host.data(), host.data() + found.count);
  auto const shares = sharesOf(scene, rows);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    ContactRow const &row = rows[i];
    std::printf("row %.17g %.17g %.17g", row.length, row.normal[0], row.normal[1]);
    for (int k = 0; k < 4; ++k)
      std::printf(" %d %.17g %d %.17g", row.dof_a[k], -row.weight_a[k], row.dof_b[k], row.weight_b[k]);
    for (GroupShare const &share : shares[i])
      std::printf(" %d %.17g", share.group, share.weight);
    std::printf("\n");
  }
}

} // namespace

int main(int argc, char **argv)
{
  auto const placement = argc == 5 ? placements.find(argv[4]) : placements.end();
  int const cells = argc == 5 ? std::atoi(argv[1]) : 0;
  if (placement == placements.end() || cells < 1)
  {
    std::fprintf(stderr, "InterfaceRows CELLS ANGLE OFFSET PLACEMENT; placements:");
    for (auto const &[name, value] : placements)
      std::fprintf(stderr, " \"%s\"", name.c_str());
    std::fprintf(stderr, "\n");
    return 2;
  }
  Kokkos::ScopeGuard const guard(argc, argv);
  TinyScene scene = twoHalves(cells, std::atof(argv[2]), std::atof(argv[3]));
  scene.options.placement = placement->second;
  printScene(scene);
  printRows(scene);
  return 0;
}
