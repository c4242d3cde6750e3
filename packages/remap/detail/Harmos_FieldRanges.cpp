// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_FieldRanges.hpp>

#include <Harmos_JoinReducer.hpp>

#include <algorithm>
#include <cstring>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

constexpr double no_bound = 1e300;

/// Least and largest values.
struct Bounds
{
  StageFields least = stageFields(no_bound), largest = stageFields(-no_bound);

  KOKKOS_FORCEINLINE_FUNCTION void join(Bounds const &other)
  {
    least = {lesser(least.record, other.least.record), lesser(least.corner, other.least.corner)};
    largest = {greater(largest.record, other.largest.record), greater(largest.corner, other.largest.corner)};
  }
};

KOKKOS_INLINE_FUNCTION bool isAtBoundary(Mesh const &mesh, int cell)
{
  bool any = false;
  for (int k = 0; k < 4; ++k)
    any = any || mesh.face_neighbour(cell, k) < 0;
  return any;
}

KOKKOS_INLINE_FUNCTION bool isAtRim(Mesh const &mesh, int cell)
{
  bool any = isAtBoundary(mesh, cell);
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
    any = any || isAtBoundary(mesh, mesh.cell_neighbour.item(j));
  return any;
}

KOKKOS_FORCEINLINE_FUNCTION Bounds boundsOfCell(Input const &in, int cell)
{
  int const pair = in.pairs.offset(cell);
  Vector2 moved[4];
  double corner[2 * 4];
  for (int k = 0; k < 4; ++k)
  {
    int const dof = in.pairs.dof_node(pair, k);
    moved[k] = in.startNode(in.mesh.cell_node(cell, k)) + in.displacement(dof);
    corner[2 * k] = in.half(dof, 0);
    corner[2 * k + 1] = in.half(dof, 1);
  }
  double volume = areaCentroid(moved).area;
  if (in.mesh.geometry == Geometry::Axisymmetric)
    volume *= areaCentroid(moved).centroid[0]; // Pappus
  Bounds b;
  b.least = {FieldPack(&in.state.record(pair, 0)), FieldPack(corner)};
  b.least.record.set<DensityField>(in.state.record(pair, Mass) / volume);
  b.largest = b.least;
  b.least.record.set<KineticField>(in.carriesDamage() ? in.state.damage(pair) : no_bound);
  b.largest.record.set<KineticField>(in.carriesDamage() ? in.state.damage(pair) : -no_bound);
  return b;
}

Bounds boundsOf(Input const &in, Classes const &classes, View<int *> const &rim, int material)
{
  Bounds bounds;
  Kokkos::parallel_reduce(
      "Harmos::remap::fieldRanges", RangePolicy(0, rim.extent(0)),
      KOKKOS_LAMBDA(int i, Bounds &b) {
        if (classes.pure_material(rim(i)) == material)
          b.join(boundsOfCell(in, rim(i)));
      },
      JoinReducer<Bounds>(bounds));
  return bounds;
}

} // namespace

void joinBounds(Exchange const &exchange, double *bounds, int count)
{
  if (exchange.size() == 1)
    return;
  std::size_t const bytes = static_cast<std::size_t>(count) * sizeof(double);
  char const *const mine = reinterpret_cast<char const *>(bounds);
  std::vector<char> const all = exchange.gather({mine, mine + bytes});
  for (std::size_t from = 0; from < all.size(); from += bytes)
    for (int i = 0; i < count; ++i)
    {
      double theirs;
      std::memcpy(&theirs, all.data() + from + static_cast<std::size_t>(i) * sizeof(double), sizeof(double));
      bounds[i] = std::min(bounds[i], theirs);
    }
}

View<int *> rimCells(Mesh const &mesh)
{
  View<int *> const rim = scratch<int *>("rimCells", mesh.num_cells);
  int count = 0;
  Kokkos::parallel_scan(
      "Harmos::remap::rimCells", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool last) {
        if (mesh.cell_depth(cell) != 0 || !isAtRim(mesh, cell))
          return;
        if (last)
          rim(sum) = cell;
        ++sum;
      },
      count);
  return Kokkos::subview(rim, std::make_pair(0, count));
}

View<double *[2 * num_stage_fields]> fieldRanges(Input const &in, Classes const &classes, View<int *> const &rim,
                                                 Exchange const &exchange)
{
  if (in.options.limiter != RemapLimiter::RangeInside || in.options.order == 1)
    return {};
  int const materials = static_cast<int>(in.materials.extent(0)), count = num_stage_fields;
  std::vector<double> all(static_cast<std::size_t>(2 * count * materials));
  for (int m = 0; m < materials; ++m)
  {
    Bounds const bounds = boundsOf(in, classes, rim, m);
    double *const row = &all[static_cast<std::size_t>(2 * count * m)];
    bounds.least.store(row);
    bounds.largest.store(row + count);
    for (int f = count; f < 2 * count; ++f)
      row[f] = -row[f];
  }
  joinBounds(exchange, all.data(), static_cast<int>(all.size()));
  View<double * [2 * num_stage_fields]> const range("Harmos::remap::fieldRanges", materials);
  auto const host = Kokkos::create_mirror_view(range);
  for (int m = 0; m < materials; ++m)
    for (int f = 0; f < count; ++f)
    {
      double const *const row = &all[static_cast<std::size_t>(2 * count * m)];
      int const first = f < first_corner_field ? f : first_corner_field + f % 2;
      double least = row[f], least_negative = row[count + f];
      for (int k = first; f >= first_corner_field && k < count; k += 2) // a velocity's component at any corner
      {
        least = std::min(least, row[k]);
        least_negative = std::min(least_negative, row[count + k]);
      }
      host(m, f) = least;
      host(m, count + f) = -least_negative;
    }
  Kokkos::deep_copy(range, host);
  return range;
}

} // namespace RemapDetail
} // namespace Harmos
