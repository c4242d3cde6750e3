// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FIELD_OVERLAYS_HPP
#define HARMOS_FIELD_OVERLAYS_HPP

#include <Harmos_Pack.hpp>
#include <Harmos_RemapFields.hpp>
#include <detail/Harmos_RemapInput.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// What the kernels of remapFields read and write. Donors and acceptors are cells: a pack holds as many at once.
struct FieldStage
{
  Mesh mesh;
  View<double *[2]> start;
  NeighbourLinks links;
  int order;
  RemapLimiter limiter;
  CellFields fields, remapped;
  View<double *[2]> range; // of every field, least and largest at the rim of the mesh; extent 0: no limiter

  View<double *[8]> corner; // of the target's cells: x of the four, then y
  View<double *[4]> shape;  // of the start's cells: centroid x, y, area
  int columns;              // of an overlay: its volume, the fields' integrals
  std::ptrdiff_t stride;    // from column to column
  View<double *> overlay;   // by slot (NeighbourLinks), column and donor

  KOKKOS_FORCEINLINE_FUNCTION double *column(int slot, int c) const
  {
    return overlay.data() + stride * (static_cast<std::ptrdiff_t>(slot) * columns + c);
  }
};

/// \return Owned cells that do not get their volume.
int intersectFields(FieldStage const &stage);

} // namespace RemapDetail
} // namespace Harmos

#endif
