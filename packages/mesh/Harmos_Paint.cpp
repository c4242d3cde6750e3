// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Paint.hpp>

#include <Harmos_CellFillings.hpp>
#include <Harmos_ShapeRegion.hpp>

#include <cstdio>
#include <stdexcept>

namespace Harmos
{

namespace
{

/// A small number as text: std::to_string would show 0.000000.
std::string shortText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

constexpr double overlap_tolerance = 1e-9;

std::string label(Body const &body, int number)
{
  return "body " + std::to_string(number) + (body.name.empty() ? "" : " (" + body.name + ")");
}

struct BodyPainter
{
  std::vector<Body> const &bodies;
  Geometry geometry;
  std::vector<Box> box;

  BodyPainter(std::vector<Body> const &b, Geometry g) : bodies(b), geometry(g)
  {
    for (Body const &body : bodies)
      box.push_back(body.shape.boundingBox());
  }

  /// The part of body i that later bodies leave to it, of those present in the cell.
  Moments<1> remaining(Quadrilateral const &cell, int i, std::vector<int> const &present) const
  {
    std::vector<int> cutters;
    for (int const j : present)
      if (j > i && bodies[j].cut_from_earlier)
        cutters.push_back(j);
    if (cutters.empty())
      return bodies[i].shape.intersectionMoments(cell, geometry);
    ShapeRegion region(cell);
    region.intersect(bodies[i].shape);
    for (int const j : cutters)
      region.subtract(bodies[j].shape);
    return region.moments(geometry);
  }

  /// What both i and the later, not cutting j claim of the cell.
  double sharedVolume(Quadrilateral const &cell, int i, int j, std::vector<int> const &present) const
  {
    ShapeRegion region(cell);
    region.intersect(bodies[i].shape);
    region.intersect(bodies[j].shape);
    for (int const k : present)
      if (k > i && bodies[k].cut_from_earlier)
        region.subtract(bodies[k].shape);
    return region.moments(geometry).volume();
  }

  /// Append the parts of a cell that the bodies fill.
  void parts(Quadrilateral const &cell, long long global_cell, std::vector<Part> &result) const
  {
    Box const of_cell = boundingBox(cell);
    int count = 0, only = -1;
    bool inside = false;
    for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
    {
      CellPosition const position = box[i].meets(of_cell) ? bodies[i].shape.position(cell) : CellPosition::Outside;
      if (position == CellPosition::Outside)
        continue;
      ++count;
      only = i;
      inside = position == CellPosition::Inside;
    }
    if (count == 1 && inside)
      result.push_back({only, moments<1>(cell, cell[0], areaWeight(geometry, cell[0])), true});
    else if (count > 0)
      sharedParts(cell, of_cell, global_cell, result);
  }

  /// The same where an outline crosses the cell, or several bodies meet it.
  void sharedParts(Quadrilateral const &cell, Box const &of_cell, long long global_cell,
                   std::vector<Part> &result) const
  {
    std::vector<int> present;
    for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
      if (box[i].meets(of_cell) && bodies[i].shape.position(cell) != CellPosition::Outside)
        present.push_back(i);
    for (int const i : present)
      result.push_back({i, remaining(cell, i, present), false});

    double const allowed = overlap_tolerance * volume(cell, geometry);
    for (std::size_t a = 0; a < result.size(); ++a)
      for (std::size_t b = a + 1; b < result.size(); ++b)
      {
        int const i = result[a].body;
        int const j = result[b].body;
        if (bodies[j].cut_from_earlier || result[a].moments.volume() <= allowed ||
            result[b].moments.volume() <= allowed)
          continue;
        double const shared = sharedVolume(cell, i, j, present);
        if (shared > allowed)
          throw std::runtime_error("cell " + std::to_string(global_cell) + ": " + label(bodies[i], i) + " and " +
                                   label(bodies[j], j) + " overlap at (" +
                                   shortText(0.5 * (of_cell.low[0] + of_cell.high[0])) + ", " +
                                   shortText(0.5 * (of_cell.low[1] + of_cell.high[1])) + ") by " +
                                   shortText(shared / volume(cell, geometry)) +
                                   " of the cell (more than 1e-9), and the later one is not cut from the earlier");
      }
  }
};

void checkBodies(std::vector<Body> const &bodies)
{
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    Body const &body = bodies[i];
    if (!(body.density > 0.0) || !(body.specific_volume > 0.0) || body.material < 0)
      throw std::runtime_error(label(body, static_cast<int>(i)) + ": density " + shortText(body.density) +
                               " and specific volume " + shortText(body.specific_volume) +
                               " must be positive, material " + std::to_string(body.material) +
                               " must not be negative");
  }
}

/// The items of PaintedRows, with their cells.
struct RigidFillings
{
  std::vector<int> cell, material;
  std::vector<double> fraction;
  std::vector<Vector2> centroid;
  std::vector<OutlineCorner> corner;

  void push(int in_cell, int of_material, double part, Vector2 const &at, OutlineCorner const &its_corner = {})
  {
    corner.push_back(its_corner);
    cell.push_back(in_cell);
    material.push_back(of_material);
    fraction.push_back(part);
    centroid.push_back(at);
  }
};

/// Every cycle that a body moves: only cells that an outline crosses, or that several shapes share, are clipped.
RigidFillings fillRigid(CandidateCells const &candidates, Geometry geometry, std::vector<Shape> const &shapes,
                        std::vector<Box> const &boxes, std::vector<int> const &materials)
{
  auto const cell = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), candidates.cell);
  auto const corner = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), candidates.corner);
  RigidFillings rows;
  std::vector<int> present;
  for (std::size_t c = 0; c < cell.extent(0); ++c)
  {
    Quadrilateral q;
    for (int k = 0; k < 4; ++k)
      q.push({corner(c, k, 0), corner(c, k, 1)});
    Box const of_cell = boundingBox(q);
    present.clear();
    CellPosition last = CellPosition::Outside;
    for (int i = 0; i < static_cast<int>(shapes.size()); ++i)
    {
      CellPosition const position = boxes[i].meets(of_cell) ? shapes[i].position(q) : CellPosition::Outside;
      if (position == CellPosition::Outside)
        continue;
      present.push_back(i);
      last = position;
    }
    if (present.empty())
      continue;
    if (present.size() == 1 && last == CellPosition::Inside)
    {
      rows.push(cell(c), materials[present[0]], 1.0, volumeCentroid(q, geometry));
      continue;
    }
    std::vector<Part> parts;
    for (int const i : present)
      parts.push_back({i, shapes[i].intersectionMoments(q, geometry), false});
    for (Filling const &filling : fillingsOf(q, geometry, parts, materials))
      rows.push(cell(c), filling.material, filling.fraction, filling.centroid,
                filling.body.size() == 1 ? outlineCorner(q, geometry, shapes[filling.body[0]], filling.fraction)
                                         : OutlineCorner());
  }
  return rows;
}

} // namespace

Painting paint(Mesh const &mesh, std::vector<Body> const &bodies)
{
  checkBodies(bodies);
  BodyPainter const painter(bodies, mesh.geometry);
  std::vector<int> material_of_body;
  for (Body const &body : bodies)
    material_of_body.push_back(body.material);
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  FillingRows const rows = fillCells(candidateCells(mesh, painter.box), mesh.geometry, material_of_body,
                                     [&](Quadrilateral const &q, int cell, std::vector<Part> &parts)
                                     { painter.parts(q, global(cell), parts); });

  int const num_pairs = static_cast<int>(rows.cell.size());
  std::size_t const num_items = rows.body.size();
  Painting painting;
  CellMaterialPairs &pairs = painting.pairs;
  pairs.num_pairs = num_pairs;
  pairs.offset = offsetsOf(rows.cell, mesh.num_cells);
  pairs.material = View<int *>("Harmos::pairs::material", num_pairs);
  pairs.cell = View<int *>("Harmos::pairs::cell", num_pairs);
  painting.record = View<double *[num_pair_fields]>("Harmos::pairs::record", num_pairs);
  painting.centroid = View<double *[2]>("Harmos::pairs::centroid", num_pairs);
  painting.pair_body.offset = View<int *>("Harmos::paint::pair_body::offset", num_pairs + 1);
  painting.pair_body.item = View<int *>("Harmos::paint::pair_body::item", num_items);
  painting.body_mass = View<double *>("Harmos::paint::body_mass", num_items);

  auto const cell_volume = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_volume);
  auto const material = Kokkos::create_mirror_view(pairs.material);
  auto const cell = Kokkos::create_mirror_view(pairs.cell);
  auto const record = Kokkos::create_mirror_view(painting.record);
  auto const centroid = Kokkos::create_mirror_view(painting.centroid);
  auto const offset = Kokkos::create_mirror_view(painting.pair_body.offset);
  auto const item = Kokkos::create_mirror_view(painting.pair_body.item);
  auto const body_mass = Kokkos::create_mirror_view(painting.body_mass);
  Kokkos::deep_copy(record, 0.0);

  offset(0) = 0;
  for (int pair = 0; pair < num_pairs; ++pair)
  {
    material(pair) = rows.material[pair];
    cell(pair) = rows.cell[pair];
    for (int d = 0; d < 2; ++d)
      centroid(pair, d) = rows.centroid[pair][d];
    double clipped_volume = 0.0;
    for (int b = rows.first[pair]; b < rows.first[pair + 1]; ++b)
      clipped_volume += rows.volume[b];
    // Normalised fractions decide: the bodies share the pair's volume as they were clipped.
    double const share = rows.fraction[pair] * cell_volume(cell(pair)) / clipped_volume;
    double mass = 0.0;
    double specific_volume = 0.0;
    double internal_energy = 0.0;
    for (int b = rows.first[pair]; b < rows.first[pair + 1]; ++b)
    {
      Body const &body = bodies[rows.body[b]];
      double const m = body.density * (rows.volume[b] * share);
      item(b) = rows.body[b];
      body_mass(b) = m;
      mass += m;
      // Running means: exact where all bodies have the same state.
      specific_volume += m / mass * (body.specific_volume - specific_volume);
      internal_energy += m / mass * (body.internal_energy - internal_energy);
    }
    offset(pair + 1) = rows.first[pair + 1];
    record(pair, Mass) = mass;
    record(pair, VolumeFraction) = rows.fraction[pair];
    record(pair, SpecificVolume) = specific_volume;
    record(pair, InternalEnergy) = internal_energy;
  }

  Kokkos::deep_copy(pairs.material, material);
  Kokkos::deep_copy(pairs.cell, cell);
  Kokkos::deep_copy(painting.record, record);
  Kokkos::deep_copy(painting.centroid, centroid);
  Kokkos::deep_copy(painting.pair_body.offset, offset);
  Kokkos::deep_copy(painting.pair_body.item, item);
  Kokkos::deep_copy(painting.body_mass, body_mass);
  return painting;
}

View<double *[2]> paintedVelocity(Mesh const &mesh, std::vector<Body> const &bodies, Painting const &painting,
                                  NodeMaterialPairs const &dof_nodes)
{
  auto const motion = deviceCopy("Harmos::paint::motion", std::vector<BodyMotion>(bodies.begin(), bodies.end()));

  View<double *[2]> velocity("Harmos::dof_nodes::velocity", dof_nodes.num_dof_nodes);
  Kokkos::parallel_for(
      "Harmos::paint::velocity", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        int const of_material = dof_nodes.material(dof);
        Vector2 const x{mesh.node_position(node, 0), mesh.node_position(node, 1)};
        Vector2 mean{0.0, 0.0};
        double mass = 0.0;
        for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
        {
          int const cell = mesh.node_cell.item(i) / 4;
          for (int pair = painting.pairs.offset(cell); pair < painting.pairs.offset(cell + 1); ++pair)
          {
            if (of_material != -1 && painting.pairs.material(pair) != of_material)
              continue;
            for (int k = painting.pair_body.offset(pair); k < painting.pair_body.offset(pair + 1); ++k)
            {
              Vector2 const v = motion(painting.pair_body.item(k)).velocityAt(x);
              mass += painting.body_mass(k);
              mean += painting.body_mass(k) / mass * (v - mean);
            }
          }
        }
        velocity(dof, 0) = mean[0];
        velocity(dof, 1) = mean[1];
      });
  return velocity;
}

PaintedRows rigidVolumes(Mesh const &mesh, std::vector<Shape> const &shapes, std::vector<int> const &materials)
{
  if (shapes.size() != materials.size())
    throw std::runtime_error("rigidVolumes: " + std::to_string(shapes.size()) + " shapes but " +
                             std::to_string(materials.size()) + " materials");
  std::vector<Box> boxes;
  for (Shape const &shape : shapes)
    boxes.push_back(shape.boundingBox());
  RigidFillings const rows = fillRigid(candidateCells(mesh, boxes), mesh.geometry, shapes, boxes, materials);

  std::size_t const count = rows.cell.size();
  PaintedRows result{offsetsOf(rows.cell, mesh.num_cells), View<int *>("Harmos::rigid::material", count),
                     View<double *>("Harmos::rigid::volume_fraction", count),
                     View<double *[2]>("Harmos::rigid::centroid", count),
                     deviceCopy("Harmos::rigid::corner", rows.corner)};
  auto const material = Kokkos::create_mirror_view(result.material);
  auto const fraction = Kokkos::create_mirror_view(result.volume_fraction);
  auto const centroid = Kokkos::create_mirror_view(result.centroid);
  for (std::size_t i = 0; i < count; ++i)
  {
    material(i) = rows.material[i];
    fraction(i) = rows.fraction[i];
    for (int d = 0; d < 2; ++d)
      centroid(i, d) = rows.centroid[i][d];
  }
  Kokkos::deep_copy(result.material, material);
  Kokkos::deep_copy(result.volume_fraction, fraction);
  Kokkos::deep_copy(result.centroid, centroid);
  return result;
}

} // namespace Harmos
