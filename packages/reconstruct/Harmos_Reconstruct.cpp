// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Reconstruct.hpp>

#include <Harmos_ApartPlan.hpp>
#include <Harmos_BodyFirstPlan.hpp>
#include <Harmos_CornerCell.hpp>
#include <Harmos_DentedPlan.hpp>
#include <Harmos_NotchedPlan.hpp>
#include <Harmos_PartedPlan.hpp>
#include <Harmos_ThreeBodyPlan.hpp>

namespace Harmos
{

namespace
{

constexpr double volume_tolerance = 1e-13; // of the cell

struct CellStatus
{
  double volume_error; // of the cell
  bool failed, greedy, unfinished;
  int material; // with the largest error; -1: none
};

/// Positions in which components are removed: as listed, then by material, void last.
HARMOS_LARGE_FUNCTION void givenOrder(CellComponents const &components, View<int *> const &listed,
                                      int order[max_components])
{
  ComponentSet left = components.all();
  int count = 0;
  for (int i = 0; i < static_cast<int>(listed.extent(0)); ++i)
  {
    ComponentSet const set = components.setOfMaterial(listed(i)) & left;
    for (int k = 0; k < components.count; ++k)
      if (components.holds(set, k))
        order[count++] = k;
    left &= ~set;
  }
  for (int k = 0; k < components.count; ++k)
    if (components.holds(left, k))
      order[count++] = k;
}

HARMOS_LARGE_FUNCTION RemovalPlan removalPlan(ReconstructionField const &field, CellComponents const &components,
                                              ReconstructionOptions const &options)
{
  SliverBounds const slivers = sliverBounds(field, components, options.sliver);
  if (options.method == ReconstructionMethod::Youngs || options.order.extent(0) > 0 ||
      (components.count <= 2 && !mayBeFilm(components, options.sliver)))
  {
    int order[max_components];
    givenOrder(components, options.order, order);
    RemovalPlan const plan = fixedPlan(field, components, options.method, slivers, order);
    if (options.method == ReconstructionMethod::Youngs || options.order.extent(0) > 0)
      return plan;
    RemovalPlan const notched = notchedPlan(field, components, slivers, plan);
    if (notched.notched)
      return notched;
    RemovalPlan const dented = dentedPlan(field, components, slivers, plan);
    return dented.dented ? dented : cornerPlan(field, components, slivers, plan);
  }
  if (components.count > max_exhaustive_components)
    return greedyPlan(field, components, slivers);
  RemovalPlan const sequence = bestPlan(field, components, slivers);
  RemovalPlan const notched = notchedPlan(field, components, slivers, sequence);
  if (notched.notched)
    return notched;
  RemovalPlan const corner = cornerPlan(field, components, slivers, sequence);
  if (corner.corner)
    return corner;
  RemovalPlan const dented = dentedPlan(field, components, slivers, sequence);
  if (dented.dented)
    return dented;
  RemovalPlan const apart = apartPlan(field, components, slivers, sequence);
  if (apart.apart)
    return apart;
  RemovalPlan const pressed = pressedCornerPlan(field, components, slivers, sequence);
  if (pressed.corner)
    return pressed;
  RemovalPlan const body_first = bodyFirstPlan(field, components, slivers, sequence);
  if (body_first.component[0] != sequence.component[0])
    return body_first;
  RemovalPlan const three_bodies = threeBodyPlan(field, components, slivers, sequence);
  RemovalPlan const plan = partedPlan(field, components, slivers, three_bodies);
  return planForThinVoid(field, components, slivers, plan);
}

/// The plan that a cell was cut by; without components where there is none for those that it has now.
HARMOS_LARGE_FUNCTION RemovalPlan formerPlan(CellComponents const &components, FilledRegions const &before,
                                             int num_pairs)
{
  RemovalPlan plan;
  int const first = before.cell_region(components.cell);
  if (first < 0 || before.cut_component(first) < 0)
    return plan;
  bool const had_void = dot(before.cut_normal(first + num_pairs - 1), before.cut_normal(first + num_pairs - 1)) > 0.0;
  if (num_pairs + (had_void ? 1 : 0) != components.count)
    return plan;
  plan.count = components.count;
  ComponentSet rest = components.all();
  for (int i = 0; i < num_pairs; ++i)
  {
    plan.set(i, before.cut_component(first + i), before.cut_normal(first + i));
    rest &= ~(1u << plan.component[i]);
  }
  for (int k = 0; k < components.count; ++k)
    if (components.holds(rest, k))
      plan.set(num_pairs, k, {0.0, 0.0});
  return plan;
}

/// Cut the cell as planned, write the materials' regions, and return the largest volume error.
HARMOS_LARGE_FUNCTION CellStatus writeRegions(CellComponents const &components, RemovalPlan const &plan,
                                              FilledRegions const &regions, int num_pairs)
{
  CellStatus status{0.0, false, false, plan.unfinished > 0, -1};
  int const first = regions.cell_region(components.cell);
  auto const write = [&](Region const &part, int k)
  {
    double const error = Math::fabs(components.volumeOfRegion(part) - components.volume[k]);
    if (!(error <= status.volume_error))
    {
      status.volume_error = error;
      status.material = components.material[k];
    }
    status.failed = status.failed || !(error <= volume_tolerance);
    if (components.material[k] == void_material)
      return;
    Region &region = regions.polygon(first + k);
    region.size = part.size;
    for (int v = 0; v < part.size; ++v)
      region[v] = components.fromUnit(part[v]);
  };
  // Such cuts are no sequence that `refill` could keep.
  auto const forgetCuts = [&]()
  {
    for (int i = 0; i < num_pairs; ++i)
    {
      regions.cut_component(first + i) = -1;
      regions.cut_normal(first + i) = {0.0, 0.0};
    }
  };
  if (plan.parted)
  {
    double const open[2] = {plan.void_part, components.volume[2] - plan.void_part};
    Division const parts = divide(components.polygon, plan.normal[0], components.volume[0] + open[0],
                                  components.volume[1] + open[1], components.weight);
    for (int k = 0; k < 2; ++k)
    {
      Region const &part = k == 0 ? parts.inside : parts.outside;
      write(open[k] > least_void
                ? divide(part, plan.normal[k + 1], components.volume[k], open[k], components.weight).inside
                : part,
            k);
    }
    forgetCuts();
    return status;
  }
  if (plan.apart)
  {
    for (int k = 0; k < num_pairs; ++k)
      write(regionAlone(components, plan, k), k);
    forgetCuts();
    return status;
  }
  if (plan.dented)
  {
    DentedCell const cell = dentedCell(components, plan);
    write(cell.corner, plan.component[0]);
    write(cell.around, plan.component[1]);
    forgetCuts();
    return status;
  }
  if (plan.notched)
  {
    int const rigid = plan.component[0];
    NotchedCell const cell = notchedCell(components, plan);
    write(cell.around, rigid);
    int number[max_components];
    CellComponents const inside = componentsIn(components, cell.notch, rigid, number);
    RemovalPlan shared;
    shared.count = inside.count;
    for (int i = 0; i < inside.count; ++i)
      for (int k = 0; k < inside.count; ++k)
        if (number[k] == plan.component[i + 1])
          shared.set(i, k, plan.normal[i + 2]);
    forEachPart(inside, shared, [&](Region const &part, int k, Vector2 const &) { write(part, number[k]); });
    forgetCuts();
    return status;
  }
  if (plan.embedded)
  {
    int const body = plan.component[0], other = plan.component[1];
    EmbeddedCorner const corner =
        embeddedCorner(components, body, other, plan.normal[0], plan.normal[1], plan.void_part);
    write(corner.inside, body);
    write(corner.around, other);
    forgetCuts();
    return status;
  }
  if (plan.corner)
  {
    double const open = components.volume[num_pairs], rest = open - plan.void_part;
    int const body = plan.component[num_pairs - 1];
    Region polygon = components.polygon;
    if (num_pairs == 2)
    {
      int const other = plan.component[0];
      Division const cut =
          divide(polygon, plan.normal[0], components.volume[other], components.volume[body] + open, components.weight);
      write(cut.inside, other);
      polygon = cut.outside;
    }
    Division const one =
        divide(polygon, plan.normal[num_pairs - 1], components.volume[body] + rest, plan.void_part, components.weight);
    write(divide(one.inside, plan.normal[num_pairs], components.volume[body], rest, components.weight).inside, body);
    forgetCuts();
    return status;
  }
  if (plan.filmed)
  {
    FilmedCell const cell = filmedCell(components, plan, plan.void_part);
    for (int k = 0; k < num_pairs; ++k)
      write(cell.region[k], k);
    forgetCuts();
    return status;
  }
  for (int i = 0; i < num_pairs; ++i)
  {
    regions.cut_component(first + i) = plan.component[i];
    regions.cut_normal(first + i) = i + 1 < plan.count ? plan.normal[i] : Vector2{0.0, 0.0};
  }
  forEachPart(components, plan, [&](Region const &part, int k, Vector2 const &) { write(part, k); });
  return status;
}

/// \param before Not without cells: its cuts are kept where they can be (refill).
HARMOS_LARGE_FUNCTION CellStatus reconstructCell(ReconstructionField const &field, ReconstructionOptions const &options,
                                                 FilledRegions const &before, FilledRegions const &regions, int cell)
{
  int const num_pairs = field.pairs.offset(cell + 1) - field.pairs.offset(cell);
  if (componentCount(field, cell) > max_components)
  {
    int const first = regions.cell_region(cell);
    for (int k = 0; k < num_pairs; ++k)
    {
      regions.polygon(first + k) = Region();
      regions.cut_component(first + k) = k;
      regions.cut_normal(first + k) = {0.0, 0.0};
    }
    return {1.0, true, false, false, -1};
  }
  bool const by_moments = options.method == ReconstructionMethod::MomentOfFluid;
  CellComponents const components = cellComponents(field, cell, by_moments);
  if (before.num_mixed_cells > 0)
  {
    RemovalPlan const plan = formerPlan(components, before, num_pairs);
    if (plan.count > 0)
      return writeRegions(components, plan, regions, num_pairs);
  }
  CellStatus status = writeRegions(components, removalPlan(field, components, options), regions, num_pairs);
  status.greedy = by_moments && options.order.extent(0) == 0 && components.count > max_exhaustive_components;
  return status;
}

/// The mixed cells and where their regions lie.
FilledRegions listMixedCells(Mesh const &mesh, CellMaterialPairs const &pairs)
{
  FilledRegions regions;
  auto const unset = [](char const *label, int size)
  { return View<int *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, std::string(label)), size); };
  regions.cell_region = unset("Harmos::reconstruct::cell_region", mesh.num_cells);
  View<int *> const listed = unset("Harmos::reconstruct::listed_cell", mesh.num_cells); // its first part is used
  View<int *> const cell_region = regions.cell_region;
  View<int *> const kind = pairs.cell_kind;
  Kokkos::parallel_scan(
      "Harmos::reconstruct::listMixedCells", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int const cell, int &count, bool const final) {
        bool const mixed = kind(cell) == MixedCell;
        if (final)
        {
          cell_region(cell) = -1;
          if (mixed)
            listed(count) = cell;
        }
        count += mixed ? 1 : 0;
      },
      regions.num_mixed_cells);
  regions.mixed_cell = Kokkos::subview(listed, std::make_pair(0, regions.num_mixed_cells));
  View<int *> const mixed_cell = regions.mixed_cell;
  int num_regions = 0;
  View<int *> const offset = pairs.offset;
  Kokkos::parallel_scan(
      "Harmos::reconstruct::countRegions", RangePolicy(0, regions.num_mixed_cells),
      KOKKOS_LAMBDA(int const i, int &count, bool const final) {
        int const cell = mixed_cell(i);
        if (final)
          cell_region(cell) = count;
        count += offset(cell + 1) - offset(cell);
      },
      num_regions);
  // All are written.
  regions.polygon =
      View<Region *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::reconstruct::polygon"), num_regions);
  regions.cut_component = unset("Harmos::reconstruct::cut_component", num_regions);
  regions.cut_normal =
      View<Vector2 *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::reconstruct::cut_normal"), num_regions);
  return regions;
}

void addReport(Mesh const &mesh, View<int *> const &mixed_cell, View<CellStatus *> const &status,
               ReconstructionReport &report)
{
  int const num_mixed = static_cast<int>(mixed_cell.extent(0));
  View<int *> const depth = mesh.cell_depth;
  long long failures = 0, greedy = 0, unfinished = 0;
  Kokkos::parallel_reduce(
      "Harmos::reconstruct::countFailures", RangePolicy(0, num_mixed),
      KOKKOS_LAMBDA(int const i, long long &sum) { sum += depth(mixed_cell(i)) == 0 && status(i).failed ? 1 : 0; },
      failures);
  Kokkos::parallel_reduce(
      "Harmos::reconstruct::countGreedyCells", RangePolicy(0, num_mixed),
      KOKKOS_LAMBDA(int const i, long long &sum) { sum += depth(mixed_cell(i)) == 0 && status(i).greedy ? 1 : 0; },
      greedy);
  Kokkos::parallel_reduce(
      "Harmos::reconstruct::countUnfinishedCells", RangePolicy(0, num_mixed),
      KOKKOS_LAMBDA(int const i, long long &sum) { sum += depth(mixed_cell(i)) == 0 && status(i).unfinished ? 1 : 0; },
      unfinished);
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::reconstruct::largestVolumeError", RangePolicy(0, num_mixed),
      KOKKOS_LAMBDA(int const i, double &error) {
        if (depth(mixed_cell(i)) == 0)
          error = Math::max(error, status(i).volume_error);
      },
      Kokkos::Max<double>(largest));
  if (failures > 0 && report.first_failed_cell < 0)
  {
    int first = 0;
    Kokkos::parallel_reduce(
        "Harmos::reconstruct::firstFailedCell", RangePolicy(0, num_mixed),
        KOKKOS_LAMBDA(int const i, int &least) {
          if (depth(mixed_cell(i)) == 0 && status(i).failed)
            least = Math::min(least, i);
        },
        Kokkos::Min<int>(first));
    CellStatus failed;
    Kokkos::deep_copy(failed, Kokkos::subview(status, first));
    Kokkos::deep_copy(report.first_failed_cell, Kokkos::subview(mixed_cell, first));
    report.first_failed_material = failed.material;
  }
  report.failures += failures;
  report.unfinished_cells += unfinished;
  report.greedy_cells += greedy;
  if (num_mixed > 0)
    report.largest_volume_error = Math::max(report.largest_volume_error, largest);
}

FilledRegions cutCells(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                       FilledRegions const &before, ReconstructionOptions const &options, ReconstructionReport &report)
{
  FilledRegions const regions = listMixedCells(mesh, pairs);
  ReconstructionField const field{mesh,          pairs,         state.record, state.centroid,
                                  options.exact, options.fluid, options.wall, options.corners};
  View<CellStatus *> const status(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::reconstruct::status"),
                                  regions.num_mixed_cells);
  Kokkos::parallel_for(
      "Harmos::reconstruct::mixedCells", RangePolicy(0, regions.num_mixed_cells), KOKKOS_LAMBDA(int const i) {
        status(i) = reconstructCell(field, options, before, regions, regions.mixed_cell(i));
      });
  addReport(mesh, regions.mixed_cell, status, report);
  return regions;
}

} // namespace

FilledRegions reconstruct(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                          ReconstructionOptions const &options, ReconstructionReport &report)
{
  ScopedRegion const region("Harmos::reconstruct");
  return cutCells(mesh, pairs, state, {}, options, report);
}

FilledRegions refill(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                     FilledRegions const &before, ReconstructionOptions const &options, ReconstructionReport &report)
{
  ScopedRegion const region("Harmos::reconstruct::refill");
  return cutCells(mesh, pairs, state, before, options, report);
}

} // namespace Harmos
