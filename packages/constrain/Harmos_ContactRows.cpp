// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ContactRows.hpp>
#include <Harmos_NormalFit.hpp>

#include <stdexcept>

namespace Harmos
{

BodyTable buildBodyTable(std::vector<RigidBody> const &bodies, int num_materials)
{
  BodyTable table{View<int *>("Harmos::constrain::body_of_material", num_materials),
                  View<RigidBody *>("Harmos::constrain::body", bodies.size())};
  auto const of_material = Kokkos::create_mirror_view(table.of_material);
  auto const body = Kokkos::create_mirror_view(table.body);
  Kokkos::deep_copy(of_material, -1);
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    int const material = bodies[b].material;
    if (material < 0 || material >= num_materials)
      throw std::runtime_error("rigid body " + std::to_string(b) + ": material " + std::to_string(material) +
                               " is not in 0.." + std::to_string(num_materials - 1));
    of_material(material) = static_cast<int>(b);
    body(b) = bodies[b];
  }
  Kokkos::deep_copy(table.of_material, of_material);
  Kokkos::deep_copy(table.body, body);
  return table;
}

namespace
{

/// Contact normal at a segment's point, from the segments of the two materials in the 7 x 7 cells around it.
/// `target` is what the segment's ray meets, a segment of another material (no wall).
KOKKOS_INLINE_FUNCTION Vector2 contactNormal(View<InterfaceSegment *> const &segment, View<RayHit *> const &hit,
                                             SegmentBins const &bins, double shortest, int slave, int target)
{
  constexpr double least_cosine = 0.9; // of the facets that the fit takes
  InterfaceSegment const &s = segment(slave);
  double const h = s.cell_size;
  int const material_a = s.material, material_b = segment(target).material;
  FitSample sample[max_fit_samples];
  double omega[max_fit_samples];
  int count = 0;
  Vector2 const reach{4.0 * h, 4.0 * h};
  bins.forEach(s.point - reach, s.point + reach,
               [&](int j)
               {
                 InterfaceSegment const &c = segment(j);
                 if ((c.material != material_a && c.material != material_b) || hit(j).segment < 0 ||
                     hit(j).cosine < least_cosine || count == max_fit_samples)
                   return;
                 bool const of_a = c.material == material_a;
                 if (segment(hit(j).segment).material != (of_a ? material_b : material_a) ||
                     (!of_a && c.length < shortest * h))
                   return;
                 Vector2 const apart = c.cell_centre - s.cell_centre;
                 if (Math::max(Math::fabs(dot(apart, s.lattice[0])), Math::fabs(dot(apart, s.lattice[1]))) > 3.5)
                   return; // beyond the 7 x 7 cells
                 Vector2 const offset = (1.0 / h) * (c.midpoint - s.point);
                 double const weight = fitWeight(c.length / h, dot(offset, offset), hit(j).gap / h);
                 if (weight > 0.0)
                   sample[count++] = {offset, of_a ? c.normal : -c.normal, c.length / h, weight, of_a ? 0 : 1};
               });
  return fitNormal(sample, omega, count, normalised(s.normal - segment(target).normal));
}

struct RowBuilder
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<InterfaceSegment *> segment;
  View<RayHit *> hit;
  SegmentBins bins;
  BodyTable bodies;
  View<int **> interaction;
  double shortest_segment;
  double exposed_face;

  KOKKOS_INLINE_FUNCTION int bodyOf(int material) const { return material < 0 ? -2 : bodies.of_material(material); }

  KOKKOS_INLINE_FUNCTION bool isSlave(InterfaceSegment const &a, InterfaceSegment const &b) const
  {
    constexpr double finer = 0.8;
    if (b.material < 0 || a.cell_size < finer * b.cell_size)
      return true;
    return a.material < b.material && !(b.cell_size < finer * a.cell_size);
  }

  KOKKOS_INLINE_FUNCTION bool carriesRow(int i) const
  {
    InterfaceSegment const &a = segment(i);
    if (a.material < 0 || hit(i).segment < 0 || mesh.cell_depth(a.cell) != 0 ||
        a.length < shortest_segment * a.cell_size || (a.face >= 0 && a.exposed < exposed_face))
      return false;
    InterfaceSegment const &b = segment(hit(i).segment);
    if (!isSlave(a, b) || (bodies.driven(bodyOf(a.material)) && bodies.driven(bodyOf(b.material))))
      return false;
    // Kinematics `single`: both sides move with the same dof nodes.
    return b.material < 0 || dof_nodes.material(pairs.dof_node(a.pair, 0)) != -1;
  }

  /// The normal of a segment's row; zero where it carries none.
  KOKKOS_INLINE_FUNCTION Vector2 rowNormal(int i) const
  {
    Vector2 const none{0.0, 0.0};
    if (!carriesRow(i))
      return none;
    InterfaceSegment const &b = segment(hit(i).segment);
    Vector2 const n =
        b.material < 0 ? -b.normal : contactNormal(segment, hit, bins, shortest_segment, i, hit(i).segment);
    return dot(segment(i).normal, n) < fit_least_cosine ? none : n;
  }

  KOKKOS_INLINE_FUNCTION void fillSide(InterfaceSegment const &s, Vector2 const &point, int body, int dof[4],
                                       double weight[4]) const
  {
    shapeFunctionsAt(cellQuadrilateral(mesh, s.cell), point, weight);
    for (int k = 0; k < 4; ++k)
      dof[k] = body == -1 ? pairs.dof_node(s.pair, k) : -1;
  }

  KOKKOS_INLINE_FUNCTION ContactRow makeRow(int i, Vector2 const &normal) const
  {
    InterfaceSegment const &a = segment(i);
    InterfaceSegment const &b = segment(hit(i).segment);
    ContactRow row = {};
    row.key = mesh.cell_global(a.cell) * max_cell_segments + a.number;
    row.material_a = a.material;
    row.material_b = b.material;
    row.body_a = bodyOf(a.material);
    row.body_b = bodyOf(b.material);
    row.cell_a = a.cell;
    row.cell_b = b.cell;
    row.point = a.point;
    row.normal = normal;
    row.gap = hit(i).gap;
    row.length = a.length;
    row.tied = b.material >= 0 && interaction(a.material, b.material) == static_cast<int>(Interaction::Tied) ? 1 : 0;
    fillSide(a, a.point, row.body_a, row.dof_a, row.weight_a);
    fillSide(b, a.point + row.gap * a.normal, row.body_b, row.dof_b, row.weight_b);
    return row;
  }
};

} // namespace

ContactRows buildContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                             InterfaceSegments const &segments, View<RayHit *> const &hit, SegmentBins const &bins,
                             BodyTable const &bodies, ConstraintOptions const &options)
{
  RowBuilder const builder{mesh, pairs,  dof_nodes,           segments.segment,         hit,
                           bins, bodies, options.interaction, options.shortest_segment, options.exposed_face};
  View<double *[2]> const normal(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::normal"),
                                 segments.count);
  Kokkos::parallel_for(
      "Harmos::constrain::fitNormals", RangePolicy(0, segments.count), KOKKOS_LAMBDA(int i) {
        Vector2 const n = builder.rowNormal(i);
        normal(i, 0) = n[0];
        normal(i, 1) = n[1];
      });
  View<int *> const place("Harmos::constrain::row_place", segments.count);
  ContactRows rows;
  Kokkos::parallel_scan(
      "Harmos::constrain::countRows", RangePolicy(0, segments.count),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          place(i) = sum;
        sum += normal(i, 0) != 0.0 || normal(i, 1) != 0.0 ? 1 : 0;
      },
      rows.count);
  rows.num_own = rows.count;
  rows.row = View<ContactRow *>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::row"), rows.count);
  rows.own = View<int *>("Harmos::constrain::own_row", rows.count);
  View<ContactRow *> const row = rows.row;
  View<int *> const own = rows.own;
  Kokkos::parallel_for(
      "Harmos::constrain::makeRows", RangePolicy(0, segments.count), KOKKOS_LAMBDA(int i) {
        Vector2 const n{normal(i, 0), normal(i, 1)};
        if (n[0] == 0.0 && n[1] == 0.0)
          return;
        row(place(i)) = builder.makeRow(i, n);
        own(place(i)) = place(i);
      });
  return rows;
}

namespace
{

/// What travels of a row. Dof nodes and bodies follow from cells and materials.
enum RowItem : int
{
  ItemKey = 0,
  ItemCellB,
  ItemMaterialA,
  ItemMaterialB,
  ItemTied,
  ItemWeightA,
  ItemWeightB = ItemWeightA + 4,
  ItemPoint = ItemWeightB + 4,
  ItemNormal = ItemPoint + 2,
  ItemGap = ItemNormal + 2,
  ItemLength,
  row_item_width
};

KOKKOS_INLINE_FUNCTION int localCell(Mesh const &mesh, long long global)
{
  int low = 0, high = mesh.num_cells;
  while (low < high)
  {
    int const middle = low + (high - low) / 2;
    if (mesh.cell_global(middle) < global)
      low = middle + 1;
    else
      high = middle;
  }
  return low < mesh.num_cells && mesh.cell_global(low) == global ? low : -1;
}

KOKKOS_INLINE_FUNCTION void packRow(Mesh const &mesh, ContactRow const &row, View<double **> const &item, int i)
{
  item(i, ItemKey) = static_cast<double>(row.key);
  item(i, ItemCellB) = static_cast<double>(mesh.cell_global(row.cell_b));
  item(i, ItemMaterialA) = row.material_a;
  item(i, ItemMaterialB) = row.material_b;
  item(i, ItemTied) = row.tied;
  for (int k = 0; k < 4; ++k)
  {
    item(i, ItemWeightA + k) = row.weight_a[k];
    item(i, ItemWeightB + k) = row.weight_b[k];
  }
  for (int d = 0; d < 2; ++d)
  {
    item(i, ItemPoint + d) = row.point[d];
    item(i, ItemNormal + d) = row.normal[d];
  }
  item(i, ItemGap) = row.gap;
  item(i, ItemLength) = row.length;
}

/// Dof nodes of a deformable side; false where this rank does not hold its pair.
KOKKOS_INLINE_FUNCTION bool findSide(CellMaterialPairs const &pairs, int cell, int material, int body, int dof[4])
{
  int const pair = body == -1 && cell >= 0 ? pairs.find(cell, material) : -1;
  for (int k = 0; k < 4; ++k)
    dof[k] = pair >= 0 ? pairs.dof_node(pair, k) : -1;
  return body != -1 || pair >= 0;
}

/// \return False where the row's cells or pairs are not on this rank.
KOKKOS_INLINE_FUNCTION bool unpackRow(Mesh const &mesh, CellMaterialPairs const &pairs, BodyTable const &bodies,
                                      View<double **> const &item, int i, ContactRow &row)
{
  row = {};
  row.key = static_cast<long long>(item(i, ItemKey));
  row.cell_a = localCell(mesh, row.key / max_cell_segments);
  row.cell_b = localCell(mesh, static_cast<long long>(item(i, ItemCellB)));
  row.material_a = static_cast<int>(item(i, ItemMaterialA));
  row.material_b = static_cast<int>(item(i, ItemMaterialB));
  row.tied = static_cast<int>(item(i, ItemTied));
  row.body_a = bodies.of_material(row.material_a);
  row.body_b = row.material_b < 0 ? -2 : bodies.of_material(row.material_b);
  for (int k = 0; k < 4; ++k)
  {
    row.weight_a[k] = item(i, ItemWeightA + k);
    row.weight_b[k] = item(i, ItemWeightB + k);
  }
  row.point = {item(i, ItemPoint), item(i, ItemPoint + 1)};
  row.normal = {item(i, ItemNormal), item(i, ItemNormal + 1)};
  row.gap = item(i, ItemGap);
  row.length = item(i, ItemLength);
  bool const a = findSide(pairs, row.cell_a, row.material_a, row.body_a, row.dof_a);
  bool const b = findSide(pairs, row.cell_b, row.material_b, row.body_b, row.dof_b);
  return a && b;
}

/// Rows by slave cell: offsets over the local cells, from rows in cell order.
View<int *> rowsByCell(Mesh const &mesh, ContactRows const &rows)
{
  View<int *> const offset("Harmos::constrain::row_offset", mesh.num_cells + 1);
  View<ContactRow *> const row = rows.row;
  Kokkos::parallel_for(
      "Harmos::constrain::countRowsByCell", RangePolicy(0, rows.count),
      KOKKOS_LAMBDA(int i) { Kokkos::atomic_increment(&offset(row(i).cell_a + 1)); });
  Kokkos::parallel_scan(
      "Harmos::constrain::scanRowsByCell", RangePolicy(0, mesh.num_cells + 1),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        sum += offset(i);
        if (final)
          offset(i) = sum;
      });
  return offset;
}

} // namespace

void exchangeContactRows(Mesh const &mesh, CellMaterialPairs const &pairs, BodyTable const &bodies,
                         Exchange const &exchange, ContactRows &rows)
{
  if (exchange.size() == 1)
    return;
  rows.offset = rowsByCell(mesh, rows);
  View<double **> item("Harmos::constrain::row_item", rows.count, static_cast<int>(row_item_width));
  View<ContactRow *> const packed = rows.row;
  Kokkos::parallel_for(
      "Harmos::constrain::packRows", RangePolicy(0, rows.count),
      KOKKOS_LAMBDA(int i) { packRow(mesh, packed(i), item, i); });
  exchange.exchangeRows(rows.offset, item, row_halo);

  rows.count = static_cast<int>(item.extent(0));
  rows.row = View<ContactRow *>("Harmos::constrain::row", rows.count);
  View<ContactRow *> const row = rows.row;
  View<double **> const received = item;
  int missing = 0;
  Kokkos::parallel_reduce(
      "Harmos::constrain::unpackRows", RangePolicy(0, rows.count),
      KOKKOS_LAMBDA(int i, int &count) {
        if (!unpackRow(mesh, pairs, bodies, received, i, row(i)))
          ++count;
      },
      missing);
  if (missing > 0)
    throw std::runtime_error("contact rows: " + std::to_string(missing) + " touch pairs that rank " +
                             std::to_string(exchange.rank()) + " does not hold; the halo is too thin");
  View<int *> const own("Harmos::constrain::own_row", rows.num_own);
  Kokkos::parallel_scan(
      "Harmos::constrain::listOwnRows", RangePolicy(0, rows.count), KOKKOS_LAMBDA(int i, int &sum, bool final) {
        bool const mine = mesh.cell_depth(row(i).cell_a) == 0;
        if (final && mine)
          own(sum) = i;
        sum += mine ? 1 : 0;
      });
  rows.own = own;
}

} // namespace Harmos
