// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_NodeEnds.hpp>
#include <Harmos_Pack.hpp>

#include <algorithm>
#include <cstdlib>
#include <type_traits>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

constexpr int least_chunk = 1024;

/// Largest distance in numbers of vertex neighbours.
int largestStride(Mesh const &mesh)
{
  int stride = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::largestStride", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &largest) {
        for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
        {
          int const neighbour = mesh.cell_neighbour.item(j);
          largest = Math::max(largest, neighbour > cell ? neighbour - cell : cell - neighbour);
        }
      },
      Kokkos::Max<int>(stride));
  return stride;
}

/// Whether no node comes when rows of its cells are gone.
bool rowsLast(Mesh const &mesh, SweptChunks const &chunks)
{
  auto const offset = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_cell.offset);
  auto const item = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_cell.item);
  int node = 0;
  for (int t = 0; t < chunks.count; ++t)
    for (; node < chunks.node_end[t]; ++node)
      if (offset(node) < offset(node + 1) && item(offset(node)) / 4 / chunks.chunk + 3 < t)
        return false;
  return true;
}

/// From the first to the last with `depth` <= layers.
SweptRange rangeWithin(View<int *> const &depth, int layers)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), depth);
  SweptRange range{0, static_cast<int>(depth.extent(0))};
  while (range.begin < range.end && host(range.begin) > layers)
    ++range.begin;
  while (range.begin < range.end && host(range.end - 1) > layers)
    --range.end;
  return range;
}

void findRanges(Mesh const &mesh, SweptChunks &chunks)
{
  chunks.all_cells = {0, mesh.num_cells};
  chunks.all_nodes = {0, mesh.num_nodes};
  for (int k = 0; k < 4; ++k)
  {
    SweptRange const range = rangeWithin(mesh.cell_depth, k);
    chunks.within[k] = {range.begin / pack_width * pack_width,
                        std::min((range.end + pack_width - 1) / pack_width * pack_width, mesh.num_cells)};
  }
  chunks.own_nodes = rangeWithin(mesh.node_depth, 0);
}

SweptRange clipped(SweptRange const &range, SweptRange const &wanted)
{
  int const begin = std::max(range.begin, wanted.begin);
  return {begin, std::max(begin, std::min(range.end, wanted.end))};
}

} // namespace

SweptChunks sweptChunks(Mesh const &mesh)
{
  SweptChunks chunks;
  findRanges(mesh, chunks);
  chunks.chunk = least_chunk;
  bool const on_host = std::is_same<MemorySpace, Kokkos::HostSpace>::value;
  int const threads = on_host ? ExecutionSpace().concurrency() : 1;
  int const wanted = on_host ? std::max(largestStride(mesh), least_chunk * threads) : mesh.num_cells;
  while (chunks.chunk < wanted)
    chunks.chunk *= 2;
  for (;; chunks.chunk *= 2)
  {
    chunks.count = (mesh.num_cells + chunks.chunk - 1) / chunks.chunk;
    chunks.node_end = nodeEnds(mesh, chunks.chunk);
    if (chunks.count <= 1 || rowsLast(mesh, chunks))
      return chunks;
  }
}

SweptWindow sweptWindow(SweptChunks const &chunks)
{
  int const rows = 4 * chunks.chunk;
  SweptWindow window;
  window.mask = rows - 1;
  std::size_t const tiles = rows / tile_rows;
  window.columns = View<double *>("Harmos::remap::sweptColumns", tiles * num_swept_columns * column_stride);
  window.block = View<int *>("Harmos::remap::sweptBlocks", rows / pack_width);
  return window;
}

View<double *[4]> sweptSpreads(SweptChunks const &chunks)
{ return scratch<double *[4]>("sweptSpread", 4 * chunks.chunk); }

SweptStage::SweptStage(Input const &in, Classes const &classes, SweptWindow const &window,
                       View<double *> const &damage_before, View<double *[num_pair_fields]> const &record_after,
                       View<double *> const &damage_after, View<double *[2]> const &velocity_after,
                       View<double *[8]> const &corner_after, View<double *[2]> const &part_after,
                       SweptHeat const &heat)
    : geometry(in.mesh.geometry), dt(in.dt), second_order(in.options.order > 1), third_order(in.options.order > 2),
      limiter(in.options.limiter), ranges(in.ranges.data()), boundary(in.mirrors().data()),
      cell_node(in.mesh.cell_node), face_neighbour(in.mesh.face_neighbour), face_boundary(in.mesh.face_boundary),
      position(in.start), target(in.mesh.node_position), retargeted(in.retargeted),
      node_owned(in.mesh.node_owned.data()), first_item(in.mesh.node_cell.offset.data()),
      item(in.mesh.node_cell.item.data()), first_neighbour(in.mesh.cell_neighbour.offset.data()),
      neighbour(in.mesh.cell_neighbour.item.data()), node_condition(in.conditions.node_index.data()),
      condition(in.conditions.condition.data()), first_pair(in.pairs.offset.data()),
      pair_material(in.pairs.material.data()), first_dof(in.dof_nodes.offset.data()), dof_node(in.pairs.dof_node),
      materials(in.materials.data()), record(in.state.record), share(in.share.part), half(in.half),
      damage(damage_before.data()), flags(classes.flags.data()), pure_material(classes.pure_material.data()),
      node_return(classes.node_return.data()), node_final(classes.node_final.data()),
      node_sweep(classes.node_sweep.data()), mask(window.mask), columns(window.columns.data()),
      block(window.block.data()), spread(window.spread), record1(record_after), velocity1(velocity_after),
      corner1(corner_after), own_part(part_after), damage1(damage_after.data()), corner_heat(heat.corner),
      node_heat(heat.node.data())
{
}

SweptSums sweep(SweptStage const &stage, SweptChunks const &chunks, bool owned_alone)
{
  SweptSums sums;
  auto const inChunk = [&](int t, int layers)
  {
    SweptRange const wanted = owned_alone ? chunks.within[layers] : chunks.all_cells;
    return clipped({t * chunks.chunk, (t + 1) * chunks.chunk}, wanted);
  };
  SweptRange const wanted_nodes = owned_alone ? chunks.own_nodes : chunks.all_nodes;
  int node = 0;
  for (int t = 0; t < chunks.count + 2; ++t)
  {
    if (t < chunks.count)
    {
      SweptRange const cells = inChunk(t, 3);
      sweptGeometry(stage, cells.begin, cells.end);
      if (stage.third_order)
        sweptSpread(stage, cells.begin, cells.end);
    }
    if (t >= 1 && t - 1 < chunks.count)
    {
      SweptRange const cells = inChunk(t - 1, 2);
      (stage.third_order ? sweptQuadraticFluxes : sweptFluxes)(stage, cells.begin, cells.end);
    }
    if (t < 2)
      continue;
    SweptRange const cells = inChunk(t - 2, 1);
    sums.kinetic_before += sweptGather(stage, cells.begin, cells.end);
    SweptRange const nodes = clipped({node, chunks.node_end[t - 2]}, wanted_nodes);
    sweptNodes(stage, nodes.begin, nodes.end, sums);
    node = chunks.node_end[t - 2];
  }
  return sums;
}

} // namespace RemapDetail
} // namespace Harmos
