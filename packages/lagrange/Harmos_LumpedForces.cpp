// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_LumpedForces.hpp>

#include <Harmos_Bilinear.hpp>
#include <Harmos_EquationOfState.hpp>
#include <detail/Harmos_CornerGradients.hpp>

namespace Harmos
{
namespace
{

/// Columns of LagrangeWork::lumped.
enum LumpedColumn : int
{
  Part0 = 0, // N_I(x_c), I = 0..3
  AlongX = 4,
  AlongY = 5, // t; zero: nothing
  Along = 6,  // of it: part that counts
  Drive = 7   // t . F
};

/// The fluids of cut cells, and where their mass is.
struct CutFluids
{
  Mesh mesh;
  CellMaterialPairs pairs;
  FilledRegions regions;
  View<Material *> materials;
  CutCellStress where;
  View<double *[8]> lumped;

  KOKKOS_INLINE_FUNCTION bool isDriven(int pair) const
  {
    Material const &material = materials(pairs.material(pair));
    return isFluid(material) && actsOnFilledRegion(where, material);
  }

  /// visit(pair, row of its region) for the fluids of a mixed cell.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forEach(int i, Visitor const &visit) const
  {
    int const cell = regions.mixed_cell(i), begin = pairs.offset(cell);
    for (int pair = begin; pair < pairs.offset(cell + 1); ++pair)
      if (isDriven(pair))
        visit(pair, regions.cell_region(cell) + pair - begin);
  }

  /// Whether both ends of an edge lie on one face of the cell.
  static KOKKOS_INLINE_FUNCTION bool liesOnFace(Quadrilateral const &q, Vector2 const &a, Vector2 const &b)
  {
    bool lies = false;
    for (int k = 0; k < 4; ++k)
      lies = lies || (isOnFace(q, k, a) && isOnFace(q, k, b));
    return lies;
  }

  /// Where a pair's mass is, and along what it may be driven.
  KOKKOS_INLINE_FUNCTION void locate(int row, Quadrilateral const &q) const
  {
    Region const &region = regions.polygon(row);
    for (int column = 0; column < 8; ++column)
      lumped(row, column) = column < 4 ? 0.25 : 0.0;
    if (region.size < 3 || !(volume(region, mesh.geometry) > 0.0))
      return;
    double N[4];
    shapeFunctionsAt(q, volumeCentroid(region, mesh.geometry), N);
    double xx = 0.0, xy = 0.0, yy = 0.0;
    Vector2 one_way{0.0, 0.0};
    for (int i = 0; i < region.size; ++i)
    {
      Vector2 const a = region[i], b = region[region.next(i)], d = b - a;
      double const length = norm(d);
      if (!(length > 0.0) || liesOnFace(q, a, b))
        continue;
      xx += d[0] * d[0] / length;
      xy += d[0] * d[1] / length;
      yy += d[1] * d[1] / length;
      one_way += d;
    }
    double const sum = xx + yy, split = Math::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy);
    for (int k = 0; k < 4; ++k)
      lumped(row, Part0 + k) = N[k];
    if (!(split > 0.0))
      return;
    double const angle = 0.5 * Math::atan2(2.0 * xy, xx - yy);
    lumped(row, AlongX) = Math::cos(angle);
    lumped(row, AlongY) = Math::sin(angle);
    lumped(row, Along) = (split / sum) * (split / sum) * dot(one_way, one_way) / (sum * sum);
  }
};

/// What drives them.
struct LumpedForces : CutFluids
{
  View<double *[num_pair_fields]> record;
  BoundaryConditions boundary;
  CutGradients cut;
  View<double *[3]> pressure;
  View<double *[8]> corner_force;

  /// Part of a pair's mass at a corner's shape function.
  KOKKOS_INLINE_FUNCTION double partAt(int pair, int cell, int corner) const
  {
    int const first = regions.cell_region(cell);
    return first < 0 ? mesh.corner_share(cell, corner) : lumped(first + pair - pairs.offset(cell), Part0 + corner);
  }

  /// Force of a pair's pressure at a corner per pressure: V B_I.
  KOKKOS_INLINE_FUNCTION Vector2 forcePerPressure(int pair, int cell, int corner) const
  {
    detail::CornerGradients const mean = detail::cellGradients(mesh, cell);
    Vector2 b = mean.of[corner] + Vector2{mean.hoop[corner], 0.0};
    if (cut.first_row(cell) >= 0)
    {
      int const row = cut.first_row(cell) + pair - pairs.offset(cell);
      b += Vector2{cut.gradient(row, 3 * corner + CutGradientX) + cut.gradient(row, 3 * corner + CutHoop),
                   cut.gradient(row, 3 * corner + CutGradientY)};
    }
    return (record(pair, Mass) * record(pair, SpecificVolume)) * b;
  }

  KOKKOS_INLINE_FUNCTION double drive(int pair, int row) const
  {
    int const cell = pairs.cell(pair), material = pairs.material(pair);
    double const mass = record(pair, Mass);
    Vector2 const along{lumped(row, AlongX), lumped(row, AlongY)};
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      int const node = mesh.cell_node(cell, k);
      double mass_at = 0.0, filled = 0.0, load = 0.0;
      Vector2 force{0.0, 0.0}, per_pressure{0.0, 0.0};
      for (int e = mesh.node_cell.offset(node); e < mesh.node_cell.offset(node + 1); ++e)
      {
        int const of = mesh.node_cell.item(e) / 4, corner = mesh.node_cell.item(e) % 4;
        if (pairs.offset(of + 1) - pairs.offset(of) > 2)
          return 0.0; // films where three materials meet
        int const like = pairs.find(of, material);
        if (like < 0)
          continue;
        mass_at += record(like, Mass) * partAt(like, of, corner);
        filled += pressure(like, 1);
        load += pressure(like, 1) * pressure(like, 0);
        force += Vector2{corner_force(like, 2 * corner), corner_force(like, 2 * corner + 1)};
        per_pressure += forcePerPressure(like, of, corner);
      }
      if (filled > 0.0)
        force = force - (load / filled) * per_pressure;
      int const condition = boundary.node_index(node);
      if (condition >= 0)
        force = boundary.condition(condition).project(force);
      if (mass_at > 0.0)
        sum += mass * lumped(row, Part0 + k) / mass_at * dot(along, force);
    }
    constexpr double most = 0.5; // of what its modulus bears across a cell
    double const c2 = equationOfState(materials(material), record(pair, SpecificVolume), record(pair, InternalEnergy))
                          .sound_speed_squared;
    double const bound = most * mass * c2 / Math::sqrt(mesh.cell_area(cell));
    return Math::clamp(sum, -bound, bound);
  }
};

} // namespace

bool locateCutFluids(Mesh const &mesh, CellMaterialPairs const &pairs, FilledRegions const &regions,
                     View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work)
{
  int const count = static_cast<int>(regions.polygon.extent(0));
  if (static_cast<int>(work.lumped.extent(0)) < count)
    work.lumped = View<double *[8]>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::lagrange::lumped"),
                                    count + count / 8);
  CutFluids const f{mesh, pairs, regions, materials, options.cut_cell_stress, work.lumped};
  int any = 0;
  Kokkos::parallel_reduce(
      "Harmos::lagrange::locateFluids", RangePolicy(0, regions.num_mixed_cells),
      KOKKOS_LAMBDA(int i, int &found) {
        f.forEach(i,
                  [&](int pair, int row)
                  {
                    f.locate(row, cellQuadrilateral(f.mesh, f.pairs.cell(pair)));
                    found = 1;
                  });
      },
      Kokkos::Max<int>(any));
  return any == 1;
}

void addLumpedForces(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                     FilledRegions const &regions, BoundaryConditions const &boundary,
                     View<Material *> const &materials, LagrangeOptions const &options, LagrangeWork &work)
{
  LumpedForces const f{{mesh, pairs, regions, materials, options.cut_cell_stress, work.lumped},
                       state.record,
                       boundary,
                       work.cut,
                       work.pressure,
                       work.corner_force};
  Kokkos::parallel_for(
      "Harmos::lagrange::driveFluids", RangePolicy(0, regions.num_mixed_cells), KOKKOS_LAMBDA(int i) {
        f.forEach(i, [&](int pair, int row)
                  { f.lumped(row, Drive) = f.lumped(row, Along) > 0.0 ? f.drive(pair, row) : 0.0; });
      });
  Kokkos::parallel_for(
      "Harmos::lagrange::lumpForces", RangePolicy(0, regions.num_mixed_cells), KOKKOS_LAMBDA(int i) {
        f.forEach(i,
                  [&](int pair, int row)
                  {
                    double const drive = f.lumped(row, Along) * f.lumped(row, Drive);
                    for (int k = 0; k < 4; ++k)
                    {
                      double const moved =
                          (f.mesh.corner_share(f.pairs.cell(pair), k) - f.lumped(row, Part0 + k)) * drive;
                      f.corner_force(pair, 2 * k) += moved * f.lumped(row, AlongX);
                      f.corner_force(pair, 2 * k + 1) += moved * f.lumped(row, AlongY);
                    }
                  });
      });
}

} // namespace Harmos
