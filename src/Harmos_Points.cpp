// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_Points.hpp"

#include <Harmos_EquationOfState.hpp>
#include <Harmos_LocalCell.hpp>
#include <Harmos_LowerBound.hpp>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

namespace Harmos
{
namespace
{

constexpr double nearly = 1e-12; // of the cell: a point this far outside of an edge is on it

template <int Capacity>
KOKKOS_INLINE_FUNCTION bool holds(Polygon<Capacity> const &polygon, Vector2 const &point, double scale)
{
  for (int i = 0; i < polygon.size; ++i)
  {
    Vector2 const edge = polygon[polygon.next(i)] - polygon[i];
    if (cross(edge, point - polygon[i]) < -nearly * scale * norm(edge))
      return false;
  }
  return polygon.size > 2;
}

KOKKOS_INLINE_FUNCTION bool cellHolds(Mesh const &mesh, int cell, Vector2 const &point)
{
  return holds(cellQuadrilateral(mesh, cell), point, Math::sqrt(mesh.cell_area(cell)));
}

/// Local number of an owned cell, or -1.
KOKKOS_INLINE_FUNCTION int ownCell(Mesh const &mesh, long long global)
{
  int const cell = localCell(mesh, global);
  return cell >= 0 && mesh.cell_depth(cell) == 0 ? cell : -1;
}

/// The lowest of a cell and its neighbours that holds a point, or -1.
KOKKOS_INLINE_FUNCTION int cellNear(Mesh const &mesh, int cell, Vector2 const &point)
{
  int found = cellHolds(mesh, cell, point) ? cell : -1;
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
  {
    int const near = mesh.cell_neighbour.item(j);
    if ((found < 0 || near < found) && cellHolds(mesh, near, point))
      found = near;
  }
  return found;
}

/// The pair of a material in a cell, else in the nearest cell around it, else -1.
KOKKOS_INLINE_FUNCTION int pairNear(PointField const &field, int cell, int material, Vector2 const &point)
{
  int pair = field.pairs.find(cell, material);
  if (pair >= 0)
    return pair;
  double least = 1e300;
  Mesh const &mesh = field.mesh;
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
  {
    int const near = mesh.cell_neighbour.item(j);
    int const candidate = field.pairs.find(near, material);
    Quadrilateral const q = cellQuadrilateral(mesh, near);
    double const distance = norm(0.25 * ((q[0] + q[1]) + (q[2] + q[3])) - point);
    if (candidate >= 0 && distance < least)
    {
      least = distance;
      pair = candidate;
    }
  }
  return pair;
}

KOKKOS_INLINE_FUNCTION Vector2 velocityAt(PointField const &field, View<double *[2]> const &velocity, int pair,
                                          Vector2 const &point)
{
  double N[4];
  shapeFunctionsAt(cellQuadrilateral(field.mesh, field.pairs.cell(pair)), point, N);
  Vector2 v{0.0, 0.0};
  for (int k = 0; k < 4; ++k)
  {
    int const dof = field.pairs.dof_node(pair, k);
    v += N[k] * Vector2{velocity(dof, 0), velocity(dof, 1)};
  }
  return v;
}

/// The pair whose filled region holds a point, or -1: void.
KOKKOS_INLINE_FUNCTION int pairAt(PointField const &field, int cell, Vector2 const &point)
{
  double const scale = Math::sqrt(field.mesh.cell_area(cell));
  for (int pair = field.pairs.offset(cell); pair < field.pairs.offset(cell + 1); ++pair)
    if (holds(field.regions.region(field.mesh, field.pairs, pair), point, scale))
      return pair;
  return -1;
}

/// Columns of a travelling sample; all are zero on the ranks that do not own the cell.
enum SampleColumn : int
{
  ColumnInside = 0,
  ColumnMaterial, // one more than its number
  ColumnDensity,
  ColumnPressure,
  ColumnVelocityX,
  ColumnVelocityY,
  ColumnInternalEnergy,
  ColumnPlasticStrain,
  ColumnVonMises,
  ColumnDamage,
  sample_width
};

KOKKOS_INLINE_FUNCTION void sampleAt(PointField const &field, int cell, int material, Vector2 const &point,
                                     View<double **> const &out, int i)
{
  out(i, ColumnInside) = 1.0;
  int const own = material >= 0 ? field.pairs.find(cell, material) : -1;
  int const pair = own >= 0 ? own : pairAt(field, cell, point);
  if (pair < 0)
    return;
  View<double *[num_pair_fields]> const &record = field.state.record;
  Material const &law = field.materials(field.pairs.material(pair));
  double const xx = record(pair, DeviatorXX), yy = record(pair, DeviatorYY), xy = record(pair, DeviatorXY);
  Vector2 const v = velocityAt(field, field.state.velocity, pair, point);
  out(i, ColumnMaterial) = 1.0 + field.pairs.material(pair);
  out(i, ColumnDensity) = record(pair, Mass) / (record(pair, VolumeFraction) * field.mesh.cell_volume(cell));
  out(i, ColumnPressure) =
      law.rigid_body >= 0 ? 0.0
                          : equationOfState(law, record(pair, SpecificVolume), record(pair, InternalEnergy)).pressure;
  out(i, ColumnVelocityX) = v[0];
  out(i, ColumnVelocityY) = v[1];
  out(i, ColumnInternalEnergy) = record(pair, InternalEnergy);
  out(i, ColumnPlasticStrain) = record(pair, PlasticStrain);
  out(i, ColumnVonMises) = Math::sqrt(1.5 * (xx * xx + yy * yy + (xx + yy) * (xx + yy) + 2.0 * xy * xy));
  out(i, ColumnDamage) = field.state.tracks_damage ? Math::min(field.state.damage(pair), 1.0) : 0.0;
}

/// Rows that one rank at most has filled, on all ranks: a sum with zeros keeps the bits.
std::vector<double> gatherRows(View<double **> const &rows, Exchange const &exchange)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows);
  std::vector<double> flat(host.data(), host.data() + host.size());
  exchange.sum(flat.data(), static_cast<int>(flat.size()));
  return flat;
}

constexpr long long nowhere = std::numeric_limits<long long>::max();

/// Global numbers of the cells that hold the points, by the points' own order; `nowhere` for none of this rank's.
std::vector<long long> globalNumbers(Mesh const &mesh, View<int *> const &cell, std::vector<int> const &order)
{
  View<long long *> const global("Harmos::points::global", cell.extent(0));
  Kokkos::parallel_for(
      "Harmos::points::globalNumbers", RangePolicy(0, cell.extent(0)),
      KOKKOS_LAMBDA(int i) { global(i) = cell(i) < mesh.num_cells ? mesh.cell_global(cell(i)) : nowhere; });
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), global);
  std::vector<long long> numbers(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    numbers[order[i]] = host(i);
  return numbers;
}

} // namespace

std::vector<long long> locatePoints(Mesh const &mesh, std::vector<Vector2> const &points, Exchange const &exchange)
{
  if (points.empty()) // on all ranks
    return {};
  int const count = static_cast<int>(points.size());
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return points[a][0] < points[b][0]; });
  std::vector<Vector2> sorted;
  for (int const i : order)
    sorted.push_back(points[i]);
  auto const point = deviceCopy("Harmos::points::position", sorted);
  View<int *> const first("Harmos::points::first", count);
  Kokkos::deep_copy(first, mesh.num_cells);
  Kokkos::parallel_for(
      "Harmos::points::locate", RangePolicy(0, count > 0 ? mesh.num_cells : 0), KOKKOS_LAMBDA(int cell) {
        if (mesh.cell_depth(cell) != 0)
          return;
        Quadrilateral const q = cellQuadrilateral(mesh, cell);
        double const scale = Math::sqrt(mesh.cell_area(cell)), slack = 2.0 * nearly * scale;
        double const left = Math::min(Math::min(q[0][0], q[1][0]), Math::min(q[2][0], q[3][0])) - slack;
        double const right = Math::max(Math::max(q[0][0], q[1][0]), Math::max(q[2][0], q[3][0])) + slack;
        int const begin = lowerBound(count, [&](int i) { return point(i)[0] < left; });
        for (int i = begin; i < count && point(i)[0] <= right; ++i)
          if (holds(q, point(i), scale))
            Kokkos::atomic_fetch_min(&first(i), cell);
      });
  std::vector<long long> const mine = globalNumbers(mesh, first, order);
  std::vector<char> bytes(mine.size() * sizeof(long long));
  std::memcpy(bytes.data(), mine.data(), bytes.size());
  bytes = exchange.gather(bytes);
  std::vector<long long> all(bytes.size() / sizeof(long long));
  std::memcpy(all.data(), bytes.data(), bytes.size());
  std::vector<long long> cells(points.size(), nowhere);
  for (std::size_t i = 0; i < all.size(); ++i)
    cells[i % points.size()] = std::min(cells[i % points.size()], all[i]);
  for (long long &cell : cells)
    cell = cell == nowhere ? -1 : cell;
  return cells;
}

std::vector<PointSample> samplePoints(PointField const &field, std::vector<Vector2> const &points,
                                      std::vector<long long> const &cell, std::vector<int> const &material,
                                      Exchange const &exchange)
{
  int const count = static_cast<int>(points.size());
  std::vector<PointSample> samples(points.size());
  if (count == 0)
    return samples;
  auto const point = deviceCopy("Harmos::points::position", points);
  auto const global = deviceCopy("Harmos::points::cell", cell);
  auto const preferred = deviceCopy("Harmos::points::material", material);
  View<double **> const out("Harmos::points::sample", count, static_cast<int>(sample_width));
  Kokkos::parallel_for(
      "Harmos::points::sample", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        int const own = ownCell(field.mesh, global(i));
        if (own >= 0)
          sampleAt(field, own, preferred(i), point(i), out, i);
      });
  std::vector<double> const rows = gatherRows(out, exchange);
  for (int i = 0; i < count; ++i)
  {
    double const *row = rows.data() + i * sample_width;
    samples[i].inside = row[ColumnInside] > 0.0;
    samples[i].material = static_cast<int>(row[ColumnMaterial]) - 1;
    samples[i].density = row[ColumnDensity];
    samples[i].pressure = row[ColumnPressure];
    samples[i].velocity = {row[ColumnVelocityX], row[ColumnVelocityY]};
    samples[i].internal_energy = row[ColumnInternalEnergy];
    samples[i].plastic_strain = row[ColumnPlasticStrain];
    samples[i].von_mises = row[ColumnVonMises];
    samples[i].damage = row[ColumnDamage];
  }
  return samples;
}

void moveTracers(PointField const &field, View<double *[2]> const &half, double dt, bool moving,
                 Exchange const &exchange, std::vector<Tracer> &tracers)
{
  int const count = static_cast<int>(tracers.size());
  if (count == 0)
    return;
  constexpr int width = 6; // moved, x, y, vx, vy, one more than the cell
  auto const tracer = deviceCopy("Harmos::points::tracer", tracers);
  View<double **> const out("Harmos::points::moved", count, width);
  Kokkos::parallel_for(
      "Harmos::points::moveTracers", RangePolicy(0, count), KOKKOS_LAMBDA(int i) {
        Tracer const &t = tracer(i);
        int const cell = t.cell < 0 ? -1 : ownCell(field.mesh, t.cell);
        if (cell < 0)
          return;
        int const pair = pairNear(field, cell, t.material, t.position);
        Vector2 const v = pair >= 0 ? velocityAt(field, half, pair, t.position) : t.velocity;
        Vector2 const x = t.position + dt * v;
        int const next = moving ? cell : cellNear(field.mesh, cell, x);
        out(i, 0) = 1.0;
        for (int d = 0; d < 2; ++d)
        {
          out(i, 1 + d) = x[d];
          out(i, 3 + d) = v[d];
        }
        out(i, 5) = next < 0 ? 0.0 : 1.0 + static_cast<double>(field.mesh.cell_global(next));
      });
  std::vector<double> const rows = gatherRows(out, exchange);
  for (int i = 0; i < count; ++i)
  {
    double const *row = rows.data() + i * width;
    if (row[0] == 0.0)
      continue;
    tracers[i].position = {row[1], row[2]};
    tracers[i].velocity = {row[3], row[4]};
    tracers[i].cell = static_cast<long long>(row[5]) - 1;
  }
}

} // namespace Harmos
