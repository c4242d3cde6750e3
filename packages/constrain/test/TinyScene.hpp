// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONSTRAIN_TEST_TINY_SCENE_HPP
#define HARMOS_CONSTRAIN_TEST_TINY_SCENE_HPP

#include <Harmos_Bilinear.hpp>
#include <Harmos_Clip.hpp>
#include <Harmos_Constrain.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Moments.hpp>
#include <Harmos_OnHost.hpp>
#include <Harmos_RowTrace.hpp>

#include <functional>
#include <vector>

namespace HarmosTest
{

using namespace Harmos;

/// A convex body, or any function that cuts a material's convex region out of a cell.
struct Body
{
  int material;
  std::function<Region(Quadrilateral const &)> region;
};

inline Region wholeCell(Quadrilateral const &cell)
{
  Region r;
  for (int k = 0; k < 4; ++k)
    r.push(cell[k]);
  return r;
}

/// The convex, counter-clockwise polygon of a material.
inline Body polygonBody(int material, std::vector<Vector2> const &corner)
{
  return {material, [corner](Quadrilateral const &cell)
          {
            Region r = wholeCell(cell);
            for (std::size_t i = 0; i < corner.size(); ++i)
            {
              Region cut;
              clip(r, edgeLine(corner[i], corner[(i + 1) % corner.size()]), cut);
              r = cut;
            }
            return r;
          }};
}

inline Body boxBody(int material, double x0, double y0, double x1, double y1)
{
  return polygonBody(material, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

inline Exchange const &serialExchange()
{
  static Exchange const exchange;
  return exchange;
}

/// A mesh with bodies painted into it, at rest, density one unless given.
struct TinyScene
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  View<double *[num_pair_fields]> record;
  FilledRegions regions;
  BoundaryConditions conditions;
  View<double *> dof_mass;
  View<double *[2]> velocity_n, predicted, half;
  std::vector<RigidBody> bodies_n, bodies;
  PairStress stress;
  std::vector<Bond> bonds;
  std::vector<ContactForce> last; // options.warm_start alone
  std::vector<Shape> outline;     // of rigid bodies; empty: contact on segments
  ConstraintOptions options;
  Exchange const *exchange = &serialExchange();
  double dt = 1e-3;
  ConstraintWork *kept = nullptr;

  TinyScene(HostMesh const &host, std::vector<Body> const &body, int num_materials,
            std::vector<BoundaryKind> const &kinds, Kinematics kinematics = Kinematics::Xfem,
            std::vector<double> const &density = {})
      : TinyScene(buildMesh(host), body, num_materials, kinds, kinematics, density)
  {
  }

  TinyScene(Mesh const &on_mesh, std::vector<Body> const &body, int num_materials,
            std::vector<BoundaryKind> const &kinds, Kinematics kinematics = Kinematics::Xfem,
            std::vector<double> const &density = {})
      : mesh(on_mesh)
  {
    paint(body);
    dof_nodes = buildDofNodes(mesh, kinematics, record, pairs);
    View<Boundary *> const boundary("boundary", kinds.size());
    auto const host_boundary = Kokkos::create_mirror_view(boundary);
    for (std::size_t i = 0; i < kinds.size(); ++i)
    {
      host_boundary(i) = Boundary();
      host_boundary(i).kind = kinds[i];
    }
    Kokkos::deep_copy(boundary, host_boundary);
    conditions = buildBoundaryConditions(mesh, boundary);
    options.interaction = View<PairInteraction **>("interaction", num_materials, num_materials);
    options.tolerance = 1e-12;
    lump(density);
  }

  /// Velocities v^{n-1/2} and v* of all dof nodes, from material and position.
  void setVelocity(std::function<Vector2(int, Vector2)> const &v)
  {
    auto const n = Kokkos::create_mirror_view(velocity_n);
    forEachDof(
        [&](int dof, int material, Vector2 const &x)
        {
          Vector2 const u = v(material, x);
          n(dof, 0) = u[0];
          n(dof, 1) = u[1];
        });
    Kokkos::deep_copy(velocity_n, n);
    applyConditions();
  }

  void setInteraction(int a, int b, PairInteraction const &law)
  {
    auto const table = Kokkos::create_mirror_view(options.interaction);
    Kokkos::deep_copy(table, options.interaction);
    table(a, b) = table(b, a) = law;
    Kokkos::deep_copy(options.interaction, table);
  }

  ConstraintReport constrain()
  {
    bodies = bodies_n;
    return constrainVelocities(mesh, pairs, dof_nodes, regions, conditions, dof_mass, velocity_n, predicted, half,
                               bodies_n, bodies, dt, dt, stress, bonds, options, *exchange, last, kept, outline);
  }

  void forEachDof(std::function<void(int, int, Vector2)> const &visit) const
  {
    auto const x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_position);
    auto const node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), dof_nodes.node);
    auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), dof_nodes.material);
    for (int dof = 0; dof < dof_nodes.num_dof_nodes; ++dof)
      visit(dof, material(dof), {x(node(dof), 0), x(node(dof), 1)});
  }

  struct Sums
  {
    double mass = 0.0, kinetic = 0.0, angular = 0.0, least = 1e300, most = -1e300; // least, most: of v.axis
    Vector2 momentum = {0.0, 0.0};
  };

  /// Sums of one material (-2: all that are not rigid) at a velocity.
  Sums sums(View<double *[2]> const &velocity, int of_material, Vector2 const &axis = {1.0, 0.0}) const
  {
    auto const v = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), velocity);
    auto const m = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), dof_mass);
    Sums s;
    forEachDof(
        [&](int dof, int material, Vector2 const &x)
        {
          bool rigid = false;
          for (RigidBody const &b : bodies_n)
            rigid = rigid || b.material == material;
          if (of_material == -2 ? rigid : material != of_material)
            return;
          Vector2 const u{v(dof, 0), v(dof, 1)};
          s.mass += m(dof);
          s.kinetic += 0.5 * m(dof) * dot(u, u);
          s.momentum += m(dof) * u;
          s.angular += m(dof) * cross(x, u);
          s.least = std::min(s.least, dot(u, axis));
          s.most = std::max(s.most, dot(u, axis));
        });
    return s;
  }

  /// The pair of a material in a cell, or -1.
  int pairOf(int cell, int of_material) const
  {
    auto const offset = onHost(pairs.offset);
    auto const material = onHost(pairs.material);
    for (int pair = offset(cell); pair < offset(cell + 1); ++pair)
      if (material(pair) == of_material)
        return pair;
    return -1;
  }

  void applyConditions()
  {
    auto const n = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), velocity_n);
    auto const node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), dof_nodes.node);
    auto const index = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), conditions.node_index);
    auto const condition = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), conditions.condition);
    for (int dof = 0; dof < dof_nodes.num_dof_nodes; ++dof)
      if (index(node(dof)) >= 0)
      {
        Vector2 const u = condition(index(node(dof))).apply({n(dof, 0), n(dof, 1)});
        n(dof, 0) = u[0];
        n(dof, 1) = u[1];
      }
    Kokkos::deep_copy(velocity_n, n);
    Kokkos::deep_copy(predicted, n);
  }

private:
  void paint(std::vector<Body> const &body)
  {
    auto const x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_position);
    auto const cell_node = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_node);
    std::vector<int> offset(1, 0), material, cell, cell_region;
    std::vector<double> fraction;
    std::vector<Region> polygon;
    std::vector<int> mixed;
    for (int c = 0; c < mesh.num_cells; ++c)
    {
      Quadrilateral q;
      for (int k = 0; k < 4; ++k)
        q.push({x(cell_node(c, k), 0), x(cell_node(c, k), 1)});
      std::vector<Region> found;
      for (Body const &b : body)
      {
        Region const r = b.region(q);
        double const vf = area(r) / area(q);
        if (!(vf > 1e-13))
          continue;
        found.push_back(r);
        material.push_back(b.material);
        cell.push_back(c);
        fraction.push_back(vf > 1.0 - 1e-12 ? 1.0 : vf);
      }
      offset.push_back(static_cast<int>(material.size()));
      bool const is_mixed = found.size() > 1 || (found.size() == 1 && fraction.back() != 1.0);
      cell_region.push_back(is_mixed ? static_cast<int>(polygon.size()) : -1);
      if (is_mixed)
      {
        mixed.push_back(c);
        polygon.insert(polygon.end(), found.begin(), found.end());
      }
    }
    pairs.num_pairs = static_cast<int>(material.size());
    pairs.offset = deviceCopy("offset", offset);
    pairs.material = deviceCopy("material", material);
    pairs.cell = deviceCopy("cell", cell);
    record = View<double *[num_pair_fields]>("record", pairs.num_pairs);
    auto const host_record = Kokkos::create_mirror_view(record);
    for (int i = 0; i < pairs.num_pairs; ++i)
      host_record(i, VolumeFraction) = fraction[static_cast<std::size_t>(i)];
    Kokkos::deep_copy(record, host_record);
    regions.num_mixed_cells = static_cast<int>(mixed.size());
    regions.mixed_cell = deviceCopy("mixed", mixed);
    regions.cell_region = deviceCopy("cell_region", cell_region);
    regions.polygon = deviceCopy("polygon", polygon);
  }

  void lump(std::vector<double> const &density)
  {
    int const n = dof_nodes.num_dof_nodes;
    dof_mass = View<double *>("mass", n);
    velocity_n = View<double *[2]>("velocity_n", n);
    predicted = View<double *[2]>("predicted", n);
    half = View<double *[2]>("half", n);
    auto const m = Kokkos::create_mirror_view(dof_mass);
    auto const f = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), record);
    auto const dof = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.dof_node);
    auto const cell = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.cell);
    auto const material = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), pairs.material);
    auto const a = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_area);
    for (int i = 0; i < pairs.num_pairs; ++i)
      for (int k = 0; k < 4; ++k)
        m(dof(i, k)) += 0.25 * f(i, VolumeFraction) * a(cell(i)) *
                        (density.empty() ? 1.0 : density[static_cast<std::size_t>(material(i))]);
    Kokkos::deep_copy(dof_mass, m);
  }
};

/// Coordinates 0, 1/n, ..., 1 times length.
inline std::vector<double> uniform(double length, int cells)
{
  return gradedCoordinates(0.0, length, cells, 1.0);
}

/// Corners of all cells.
inline HostView<Quadrilateral *> cellsOf(Mesh const &mesh)
{
  View<Quadrilateral *> const corner("corner", mesh.num_cells);
  Kokkos::parallel_for(
      "cellsOf", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell) { corner(cell) = cellQuadrilateral(mesh, cell); });
  return onHost(corner);
}

/// The filled regions of all pairs.
inline HostView<Region *> regionsOf(TinyScene const &scene)
{
  Mesh const mesh = scene.mesh;
  CellMaterialPairs const pairs = scene.pairs;
  FilledRegions const regions = scene.regions;
  View<Region *> const region("region", pairs.num_pairs);
  Kokkos::parallel_for(
      "regionsOf", RangePolicy(0, pairs.num_pairs),
      KOKKOS_LAMBDA(int pair) { region(pair) = regions.region(mesh, pairs, pair); });
  return onHost(region);
}

/// The same, moved over the step.
inline HostView<Region *> movedRegions(TinyScene const &scene)
{
  auto const corner = cellsOf(scene.mesh);
  auto const region = regionsOf(scene);
  auto const cell = onHost(scene.pairs.cell);
  auto const dof = onHost(scene.pairs.dof_node);
  auto const half = onHost(scene.half);
  for (int pair = 0; pair < scene.pairs.num_pairs; ++pair)
    for (int i = 0; i < region(pair).size; ++i)
    {
      Vector2 &x = region(pair)[i];
      double weight[4];
      shapeFunctionsAt(corner(cell(pair)), x, weight);
      for (int k = 0; k < 4; ++k)
        x += (scene.dt * weight[k]) * Vector2{half(dof(pair, k), 0), half(dof(pair, k), 1)};
    }
  return region;
}

inline std::vector<RowTrace> tracesOf(Mesh const &mesh, std::vector<ContactRow> const &rows)
{
  View<ContactRow *> const row = deviceCopy("row", rows);
  View<RowTrace *> const trace("trace", rows.size());
  Kokkos::parallel_for(
      "tracesOf", RangePolicy(0, rows.size()), KOKKOS_LAMBDA(int i) { trace(i) = rowTrace(mesh, row(i)); });
  auto const host = onHost(trace);
  return std::vector<RowTrace>(host.data(), host.data() + rows.size());
}

inline std::vector<BoundaryKind> const open_box(4, BoundaryKind::Outflow);

} // namespace HarmosTest

#endif
