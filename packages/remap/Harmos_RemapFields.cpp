// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_RemapFields.hpp>

#include <detail/Harmos_FieldOverlays.hpp>
#include <detail/Harmos_FieldRanges.hpp>

#include <stdexcept>

namespace Harmos
{

namespace
{

using namespace RemapDetail;

void checkOptions(Mesh const &mesh, CellFields const &fields, CellFields const &remapped, RemapOptions const &options)
{
  if (mesh.geometry != Geometry::Planar)
    throw std::runtime_error("remapFields: the mesh is axisymmetric; cell fields are planar");
  if (options.order < 1 || options.order > 2)
    throw std::runtime_error("remapFields: order " + std::to_string(options.order) + " is none of 1, 2");
  if (options.limiter == RemapLimiter::VanLeer)
    throw std::runtime_error("remapFields: limiter van leer; cell fields take range, range inside or none");
  if (fields.value.data() == remapped.value.data() || fields.value.extent(0) != remapped.value.extent(0) ||
      fields.value.extent(1) != remapped.value.extent(1))
    throw std::runtime_error("remapFields: the new averages need an array of their own, of the same shape");
}

/// Least and largest value of every field at the rim of the mesh, over all ranks.
View<double *[2]> rangesOf(View<int *> const &rim, CellFields const &fields, Exchange const &exchange)
{
  int const count = static_cast<int>(fields.value.extent(1));
  std::vector<double> bounds;
  for (int f = 0; f < count; ++f)
  {
    double least = 1e300, largest = -1e300;
    auto const value = fields.value;
    Kokkos::parallel_reduce(
        "Harmos::remapFields::range", RangePolicy(0, rim.extent(0)),
        KOKKOS_LAMBDA(int i, double &low, double &high) {
          low = Math::min(low, value(rim(i), f));
          high = Math::max(high, value(rim(i), f));
        },
        Kokkos::Min<double>(least), Kokkos::Max<double>(largest));
    bounds.insert(bounds.end(), {least, -largest});
  }
  joinBounds(exchange, bounds.data(), 2 * count);
  View<double *[2]> const range("Harmos::remapFields::range", count);
  auto const host = Kokkos::create_mirror_view(range);
  for (int f = 0; f < count; ++f)
  {
    host(f, 0) = bounds[static_cast<std::size_t>(2 * f)];
    host(f, 1) = -bounds[static_cast<std::size_t>(2 * f + 1)];
  }
  Kokkos::deep_copy(range, host);
  return range;
}

} // namespace

/// Arrays, and the links of a mesh's connectivity.
struct FieldScratch
{
  View<int *> neighbours; // of the mesh that the links belong to
  NeighbourLinks links;
  View<double *[8]> corner;
  View<double *[4]> shape;
  View<double *> overlay;
  View<int *> rim; // rimCells
};

int remapFields(Mesh const &mesh, View<double *[2]> const &start, CellFields const &fields, CellFields const &remapped,
                RemapOptions const &options, FieldWork &work, Exchange const &exchange)
{
  checkOptions(mesh, fields, remapped, options);
  ScopedRegion const region("Harmos::remapFields");
  if (!work.scratch)
    work.scratch = std::make_shared<FieldScratch>();
  FieldScratch &kept = *work.scratch;
  if (kept.neighbours.data() != mesh.cell_neighbour.offset.data())
  {
    kept.links = linkNeighbours(mesh);
    kept.rim = rimCells(mesh);
    kept.neighbours = mesh.cell_neighbour.offset;
  }
  FieldStage stage;
  stage.mesh = mesh;
  stage.start = start;
  stage.links = kept.links;
  stage.order = options.order;
  stage.limiter = options.limiter;
  stage.fields = fields;
  stage.remapped = remapped;
  stage.columns = 1 + static_cast<int>(fields.value.extent(1));
  // Columns of the overlays are no power of two apart, or they would fall on the same lines of the cache.
  stage.stride = numPacks(mesh.num_cells) * pack_width + 24;
  grow(kept.corner, "targetCorner", mesh.num_cells);
  grow(kept.shape, "startShape", mesh.num_cells);
  grow(kept.overlay, "fieldOverlay", static_cast<std::size_t>(stage.stride) * stage.columns * kept.links.slots);
  stage.corner = kept.corner;
  stage.shape = kept.shape;
  stage.overlay = kept.overlay;
  if (options.limiter == RemapLimiter::RangeInside && options.order == 2)
    stage.range = rangesOf(kept.rim, fields, exchange);
  return intersectFields(stage);
}

} // namespace Harmos
