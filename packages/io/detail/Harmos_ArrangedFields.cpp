// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_ArrangedFields.hpp>
#include <detail/Harmos_Hdf5File.hpp>

#include <numeric>

namespace Harmos
{

ArrangedFields::ArrangedFields(MPI_Comm comm, FieldSnapshot const &s)
    : node_order(comm, s.nodes.global), cell_order(comm, s.cells.global),
      pair_order(comm, s.pairs.cell, cell_order.length()), segment_order(comm, s.interface.cell, cell_order.length())
{
  block.nodes.global = node_order.key();
  block.nodes.position = node_order.arrange(s.nodes.position, 2);
  block.nodes.velocity = node_order.arrange(s.nodes.velocity, 3);

  // Every global node is owned by one rank, so that its number is its row.
  block.cells.global = cell_order.key();
  block.cells.node = cell_order.arrange(s.cells.node, 4);
  block.cells.volume_fraction = cell_order.arrange(s.cells.volume_fraction);
  block.cells.density = cell_order.arrange(s.cells.density);
  block.cells.pressure = cell_order.arrange(s.cells.pressure);
  block.cells.material = cell_order.arrange(s.cells.material);

  // A polygon is one row of 2 n coordinates.
  RowsOf<double> polygons{s.pairs.offset, s.pairs.vertex};
  for (auto &offset : polygons.offset)
    offset *= 2;
  polygons = pair_order.arrange(polygons);
  for (auto &offset : polygons.offset)
    offset /= 2;
  block.pairs.offset = std::move(polygons.offset);
  block.pairs.vertex = std::move(polygons.value);
  vertices = place(comm, block.pairs.offset.back());
  block.pairs.cell = pair_order.key();
  block.pairs.material = pair_order.arrange(s.pairs.material);
  block.pairs.volume_fraction = pair_order.arrange(s.pairs.volume_fraction);
  block.pairs.density = pair_order.arrange(s.pairs.density);
  block.pairs.pressure = pair_order.arrange(s.pairs.pressure);
  block.pairs.internal_energy = pair_order.arrange(s.pairs.internal_energy);
  block.pairs.plastic_strain = pair_order.arrange(s.pairs.plastic_strain);
  block.pairs.deviator = pair_order.arrange(s.pairs.deviator, 3);
  block.pairs.von_mises = pair_order.arrange(s.pairs.von_mises);
  block.pairs.velocity = pair_order.arrange(s.pairs.velocity, 3);
  block.pairs.has_damage = s.pairs.has_damage;
  if (s.pairs.has_damage)
    block.pairs.damage = pair_order.arrange(s.pairs.damage);

  block.interface.cell = segment_order.key();
  block.interface.material_a = segment_order.arrange(s.interface.material_a);
  block.interface.material_b = segment_order.arrange(s.interface.material_b);
  block.interface.vertex = segment_order.arrange(s.interface.vertex, 4);
}

namespace
{

constexpr long long xdmf_polygon = 3; // cell type in a mixed topology

/// XDMF's mixed topology: type, number of vertices, their rows; for every polygon.
std::vector<long long> mixedTopology(FieldSnapshot::Pairs const &pairs, long long first_vertex)
{
  std::vector<long long> topology;
  topology.reserve(pairs.vertex.size() / 2 + 2 * pairs.cell.size());
  for (std::size_t i = 0; i + 1 < pairs.offset.size(); ++i)
  {
    topology.push_back(xdmf_polygon);
    topology.push_back(pairs.offset[i + 1] - pairs.offset[i]);
    for (long long v = pairs.offset[i]; v < pairs.offset[i + 1]; ++v)
      topology.push_back(first_vertex + v);
  }
  return topology;
}

/// Writes arrays of one table, whose rows are placed by one order.
class TableWriter
{
public:
  TableWriter(Hdf5File &file, std::string group, GlobalOrder const &order)
      : file_(file), group_(std::move(group)), order_(order)
  {
    file_.createGroup(group_);
  }
  template <class T>
  void operator()(char const *name, std::vector<T> const &value, int width = 1) const
  {
    file_.write(group_ + '/' + name, value, width, order_.first(), order_.total());
  }

private:
  Hdf5File &file_;
  std::string group_;
  GlobalOrder const &order_;
};

void writePairs(Hdf5File &file, ArrangedFields const &fields)
{
  auto const &pairs = fields.block.pairs;
  TableWriter const table(file, "/pairs", fields.pair_order);
  table("cell", pairs.cell);
  table("material", pairs.material);
  table("volume_fraction", pairs.volume_fraction);
  table("density", pairs.density);
  table("pressure", pairs.pressure);
  table("internal_energy", pairs.internal_energy);
  table("plastic_strain", pairs.plastic_strain);
  table("deviator", pairs.deviator, 3);
  table("von_mises", pairs.von_mises);
  table("velocity", pairs.velocity, 3);
  if (pairs.has_damage)
    table("damage", pairs.damage);

  // Ends of the polygons: polygon i has the vertices end[i - 1] .. end[i] - 1.
  std::vector<long long> end(pairs.offset.begin() + 1, pairs.offset.end());
  for (auto &e : end)
    e += fields.vertices.first;
  table("polygon_end", end);
  file.write("/pairs/vertex", pairs.vertex, 2, fields.vertices.first, fields.vertices.total);
  file.write("/pairs/topology", mixedTopology(pairs, fields.vertices.first), 1,
             fields.vertices.first + 2 * fields.pair_order.first(),
             fields.vertices.total + 2 * fields.pair_order.total());
}

void writeInterface(Hdf5File &file, ArrangedFields const &fields)
{
  auto const &interface = fields.block.interface;
  TableWriter const table(file, "/interface", fields.segment_order);
  table("cell", interface.cell);
  table("material_a", interface.material_a);
  table("material_b", interface.material_b);
  std::vector<long long> ends(2 * interface.cell.size());
  std::iota(ends.begin(), ends.end(), 2 * fields.segment_order.first());
  table("connectivity", ends, 2);
  file.write("/interface/vertex", interface.vertex, 2, 2 * fields.segment_order.first(),
             2 * fields.segment_order.total());
}

} // namespace

void writeFieldFile(MPI_Comm comm, std::string const &path, ArrangedFields const &fields, FieldFrame const &frame,
                    std::vector<std::string> const &material_names)
{
  Hdf5File file = Hdf5File::create(comm, path);
  file.writeAttribute("/", "format", 1);
  file.writeAttribute("/", "cycle", frame.cycle);
  file.writeAttribute("/", "time", frame.time);
  file.writeAttribute("/", "axisymmetric", frame.axisymmetric);
  for (auto const &[name, value] :
       {std::pair("nodes", frame.nodes), std::pair("cells", frame.cells), std::pair("pairs", frame.pairs),
        std::pair("vertices", frame.vertices), std::pair("segments", frame.segments)})
    file.writeAttribute("/", std::string("num_") + name, value);
  std::string names;
  for (auto const &name : material_names)
    names += name + '\n';
  file.writeText("/materials", names);

  auto const &block = fields.block;
  TableWriter const nodes(file, "/nodes", fields.node_order);
  nodes("position", block.nodes.position, 2);
  nodes("velocity", block.nodes.velocity, 3);
  TableWriter const cells(file, "/cells", fields.cell_order);
  cells("connectivity", block.cells.node, 4);
  cells("volume_fraction", block.cells.volume_fraction);
  cells("density", block.cells.density);
  cells("pressure", block.cells.pressure);
  cells("material", block.cells.material);
  writePairs(file, fields);
  writeInterface(file, fields);
  file.close();
}

} // namespace Harmos
