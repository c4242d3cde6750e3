// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_FieldSnapshot.hpp>

#include <Harmos_BridgedRegion.hpp>
#include <Harmos_EquationOfState.hpp>
#include <Harmos_OnHost.hpp>

#include <detail/Harmos_OpenEdges.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

namespace
{

/// Host copies of what the snapshot reads.
struct HostState
{
  decltype(onHost(View<double *[2]>())) node_position, velocity;
  decltype(onHost(View<int *[4]>())) cell_node, face_neighbour, face_boundary, dof_node;
  decltype(onHost(View<double *>())) cell_area, cell_volume, damage;
  decltype(onHost(View<int *>())) cell_depth, node_owned, offset, material, cell, cell_region, dof_offset;
  decltype(onHost(View<long long *>())) cell_global, node_global;
  decltype(onHost(View<double *[num_pair_fields]>())) record;
  decltype(onHost(View<double *[4]>())) corner_share;
  decltype(onHost(View<Region *>())) polygon;
  decltype(onHost(View<Material *>())) law;

  Region region(int pair) const
  {
    int const c = cell(pair);
    if (cell_region(c) >= 0)
      return polygon(cell_region(c) + pair - offset(c));
    Region quad;
    for (int k = 0; k < 4; ++k)
      quad.push({node_position(cell_node(c, k), 0), node_position(cell_node(c, k), 1)});
    return quad;
  }
  double pressure(int pair) const
  {
    Material const &m = law(material(pair));
    return m.rigid_body >= 0 ? 0.0
                             : equationOfState(m, record(pair, SpecificVolume), record(pair, InternalEnergy)).pressure;
  }
  /// Material of a cell that one pair fills, else -1.
  int pureMaterial(int c) const
  {
    return offset(c + 1) - offset(c) == 1 && cell_region(c) < 0 ? material(offset(c)) : -1;
  }
};

void addNodes(HostState const &h, bool quarters, int num_nodes, int num_dof_nodes, int num_pairs,
              FieldSnapshot::Nodes &nodes)
{
  std::vector<double> mass(static_cast<std::size_t>(num_dof_nodes), 0.0);
  for (int pair = 0; pair < num_pairs; ++pair)
    for (int k = 0; k < 4; ++k)
      mass[static_cast<std::size_t>(h.dof_node(pair, k))] +=
          (quarters ? 0.25 : h.corner_share(h.cell(pair), k)) * h.record(pair, Mass);
  for (int node = 0; node < num_nodes; ++node)
  {
    if (!h.node_owned(node))
      continue;
    double sum = 0.0, vx = 0.0, vy = 0.0;
    for (int dof = h.dof_offset(node); dof < h.dof_offset(node + 1); ++dof)
    {
      double const m = mass[static_cast<std::size_t>(dof)];
      sum += m;
      vx += m * h.velocity(dof, 0);
      vy += m * h.velocity(dof, 1);
    }
    nodes.global.push_back(h.node_global(node));
    nodes.position.insert(nodes.position.end(), {h.node_position(node, 0), h.node_position(node, 1)});
    nodes.velocity.insert(nodes.velocity.end(), {sum > 0.0 ? vx / sum : 0.0, sum > 0.0 ? vy / sum : 0.0, 0.0});
  }
}

void addCell(HostState const &h, int c, FieldSnapshot::Cells &cells)
{
  double filled = 0.0, mass = 0.0, pressure = 0.0, largest = 0.0;
  int dominant = -1;
  for (int pair = h.offset(c); pair < h.offset(c + 1); ++pair)
  {
    double const fraction = h.record(pair, VolumeFraction);
    filled += fraction;
    mass += h.record(pair, Mass);
    pressure += fraction * h.pressure(pair);
    if (fraction > largest)
    {
      largest = fraction;
      dominant = h.material(pair);
    }
  }
  cells.global.push_back(h.cell_global(c));
  for (int k = 0; k < 4; ++k)
    cells.node.push_back(h.node_global(h.cell_node(c, k)));
  cells.volume_fraction.push_back(filled);
  cells.density.push_back(filled > 0.0 ? mass / (filled * h.cell_volume(c)) : 0.0);
  cells.pressure.push_back(filled > 0.0 ? pressure / filled : 0.0);
  cells.material.push_back(largest >= 1.0 - filled ? dominant : -1);
}

void addPair(HostState const &h, int pair, FieldSnapshot::Pairs &pairs)
{
  int const c = h.cell(pair);
  Region const region = h.region(pair);
  for (int i = 0; i < region.size; ++i)
    pairs.vertex.insert(pairs.vertex.end(), {region[i][0], region[i][1]});
  pairs.offset.push_back(pairs.offset.back() + region.size);
  double const fraction = h.record(pair, VolumeFraction);
  double const xx = h.record(pair, DeviatorXX), yy = h.record(pair, DeviatorYY), xy = h.record(pair, DeviatorXY);
  double const zz = -(xx + yy);
  double v[2] = {0.0, 0.0};
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
      v[d] += 0.25 * h.velocity(h.dof_node(pair, k), d);
  pairs.cell.push_back(h.cell_global(c));
  pairs.material.push_back(h.material(pair));
  pairs.volume_fraction.push_back(fraction);
  pairs.density.push_back(h.record(pair, Mass) / (fraction * h.cell_volume(c)));
  pairs.pressure.push_back(h.pressure(pair));
  pairs.internal_energy.push_back(h.record(pair, InternalEnergy));
  pairs.plastic_strain.push_back(h.record(pair, PlasticStrain));
  pairs.deviator.insert(pairs.deviator.end(), {xx, yy, xy});
  pairs.von_mises.push_back(std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2.0 * xy * xy)));
  pairs.velocity.insert(pairs.velocity.end(), {v[0], v[1], 0.0});
  if (pairs.has_damage)
    pairs.damage.push_back(std::min(h.damage(pair), 1.0));
}

void addSegments(HostState const &h, int pair, FieldSnapshot::Interface &interface)
{
  int const c = h.cell(pair), own = h.material(pair);
  Region const region = h.region(pair);
  double const tolerance = 1e-9 * std::sqrt(h.cell_area(c));

  // The domain's boundary is no interface: it counts as covered by the material itself.
  std::vector<std::pair<Region, int>> others;
  for (int other = h.offset(c); other < h.offset(c + 1); ++other)
    if (other != pair)
      others.emplace_back(h.region(other), h.material(other));
  for (int k = 0; k < 4; ++k)
  {
    int const face = h.face_neighbour(c, k);
    if (face >= 0)
    {
      for (int other = h.offset(face / 4); other < h.offset(face / 4 + 1); ++other)
        others.emplace_back(h.region(other), h.material(other));
    }
    else if (h.face_boundary(c, k) >= 0)
    {
      int const a = h.cell_node(c, k), b = h.cell_node(c, (k + 1) % 4);
      Vector2 const from{h.node_position(a, 0), h.node_position(a, 1)},
          to{h.node_position(b, 0), h.node_position(b, 1)};
      Region wall; // a needle outside the cell: its edge runs against the face
      wall.push(to);
      wall.push(from);
      wall.push(0.5 * (from + to) - perpendicular(to - from));
      others.emplace_back(wall, own);
    }
  }

  std::vector<EdgePart> parts;
  for (int i = 0; i < region.size; ++i)
  {
    Vector2 const a = region[i], b = region[region.next(i)];
    if (norm(b - a) <= tolerance || isBridge(region, i))
      continue;
    parts.clear();
    for (auto const &[other, material] : others)
      addCoveredParts(a, b, other, material, tolerance, parts);
    auto const free = uncoveredParts(parts, tolerance / norm(b - a));
    parts.insert(parts.end(), free.begin(), free.end());
    for (auto const &part : parts)
    {
      if (part.material >= 0 && part.material <= own)
        continue; // the same material, or the other side's own entry
      Vector2 const begin = a + part.begin * (b - a), end = a + part.end * (b - a);
      interface.cell.push_back(h.cell_global(c));
      interface.material_a.push_back(own);
      interface.material_b.push_back(part.material);
      interface.vertex.insert(interface.vertex.end(), {begin[0], begin[1], end[0], end[1]});
    }
  }
}

/// Whether some face or inside of the cell may show an interface: not pure, or beside another kind of cell.
bool mayHoldInterface(HostState const &h, int c)
{
  int const material = h.pureMaterial(c);
  if (material < 0)
    return true;
  for (int k = 0; k < 4; ++k)
    if (h.face_neighbour(c, k) >= 0 ? h.pureMaterial(h.face_neighbour(c, k) / 4) != material
                                    : h.face_boundary(c, k) < 0)
      return true;
  return false;
}

} // namespace

FieldSnapshot takeSnapshot(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                           PairState const &state, FilledRegions const &regions, View<Material *> const &materials)
{
  HostState h;
  h.node_position = onHost(mesh.node_position);
  h.velocity = onHost(state.velocity);
  h.cell_node = onHost(mesh.cell_node);
  h.face_neighbour = onHost(mesh.face_neighbour);
  h.face_boundary = onHost(mesh.face_boundary);
  h.dof_node = onHost(pairs.dof_node);
  h.cell_area = onHost(mesh.cell_area);
  h.damage = onHost(state.damage);
  h.cell_volume = onHost(mesh.cell_volume);
  h.corner_share = onHost(mesh.corner_share.part);
  h.cell_depth = onHost(mesh.cell_depth);
  h.node_owned = onHost(mesh.node_owned);
  h.offset = onHost(pairs.offset);
  h.material = onHost(pairs.material);
  h.cell = onHost(pairs.cell);
  h.cell_region = onHost(regions.cell_region);
  h.dof_offset = onHost(dof_nodes.offset);
  h.cell_global = onHost(mesh.cell_global);
  h.node_global = onHost(mesh.node_global);
  h.record = onHost(state.record);
  h.polygon = onHost(regions.polygon);
  h.law = onHost(materials);

  FieldSnapshot snapshot;
  snapshot.pairs.has_damage = state.tracks_damage;
  snapshot.geometry = mesh.geometry;
  addNodes(h, mesh.corner_share.quarters(), mesh.num_nodes, dof_nodes.num_dof_nodes, pairs.num_pairs, snapshot.nodes);
  for (int c = 0; c < mesh.num_cells; ++c)
  {
    if (h.cell_depth(c) != 0)
      continue;
    addCell(h, c, snapshot.cells);
    bool const look = mayHoldInterface(h, c);
    for (int pair = h.offset(c); pair < h.offset(c + 1); ++pair)
    {
      addPair(h, pair, snapshot.pairs);
      if (look)
        addSegments(h, pair, snapshot.interface);
    }
  }
  return snapshot;
}

} // namespace Harmos
