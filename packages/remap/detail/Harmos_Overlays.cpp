// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Overlays.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

KOKKOS_INLINE_FUNCTION void setMoments(Overlays const &overlays, int slot, Moments<2> const &m)
{
  for (int i = 0; i < 6; ++i)
    overlays.moment(slot, i) = m.value[i];
}

/// A whole donor lies in its own cell: volume and first moments; its polynomial is constant.
KOKKOS_INLINE_FUNCTION void setWhole(Input const &in, Donors const &donors, Overlays const &overlays, int donor,
                                     int cell)
{
  Vector2 const origin = acceptorOrigin(in.mesh, cell);
  Moments<2> m;
  m.value[0] = donors.shape(donor, 0);
  m.value[1] = m.value[0] * (donors.shape(donor, 1) - origin[0]);
  m.value[2] = m.value[0] * (donors.shape(donor, 2) - origin[1]);
  setMoments(overlays, overlays.offset(donor), m);
}

/// A donor of which nothing is left above the threshold stays whole: its volume fraction at its old centroid.
KOKKOS_INLINE_FUNCTION void makeWhole(Input const &in, Donors const &donors, int donor, int cell)
{
  int const pair = donors.pair(donor);
  double const volume = in.state.record(pair, VolumeFraction) * in.mesh.cell_area(cell);
  donors.kind(donor) = DegenerateDonor;
  donors.polynomial(donor, 0, 0) *= donors.shape(donor, 0) / volume;
  donors.shape(donor, 0) = volume;
  if (in.pairs.cell_kind(cell) != PureCell)
    for (int d = 0; d < 2; ++d)
      donors.shape(donor, 1 + d) = in.state.centroid(pair, d);
  donors.mass_offset(donor, 0) = donors.mass_offset(donor, 1) = 0.0;
  for (int f = 0; f < num_stage_fields; ++f)
    donors.polynomial(donor, f, 1) = donors.polynomial(donor, f, 2) = 0.0;
}

KOKKOS_INLINE_FUNCTION void intersectDonor(Input const &in, Classes const &classes, Donors const &donors,
                                           Overlays const &overlays, int donor)
{
  int const cell = in.pairs.cell(donors.pair(donor));
  int const slots = overlays.offset(donor + 1) - overlays.offset(donor);
  int const row = in.mesh.cell_neighbour.offset(cell);
  bool any = false;
  for (int s = 0; s < slots; ++s)
  {
    Moments<2> m;
    if (donors.kind(donor) == MovingDonor)
    {
      int const acceptor = s == 0 ? cell : in.mesh.cell_neighbour.item(row + s - 1);
      if (classes.interface_index(acceptor) >= 0)
        m = overlayMoments(in.mesh, acceptor, donors.polygon(donor));
      if (!(m.volume() > least_overlay * in.mesh.cell_area(acceptor)))
        m = Moments<2>{};
      any = any || m.volume() > 0.0;
    }
    setMoments(overlays, overlays.offset(donor) + s, m);
  }
  if (donors.kind(donor) == MovingDonor && !any)
    makeWhole(in, donors, donor, cell);
  if (donors.kind(donor) == QuietDonor || donors.kind(donor) == DegenerateDonor)
    setWhole(in, donors, overlays, donor, cell);
}

} // namespace

Overlays intersect(Input const &in, Classes const &classes, Donors const &donors)
{
  Overlays overlays;
  View<int *> const offset = scratch<int *>("overlayOffset", donors.num + 1);
  overlays.offset = offset;
  Kokkos::parallel_for(
      "Harmos::remap::countOverlays", RangePolicy(0, donors.num), KOKKOS_LAMBDA(int donor) {
        int const cell = in.pairs.cell(donors.pair(donor));
        offset(donor) = 1 + in.mesh.cell_neighbour.offset(cell + 1) - in.mesh.cell_neighbour.offset(cell);
      });
  int const slots = exclusiveScan(offset);
  overlays.moment = scratch<double *[6]>("overlayMoment", slots);
  Overlays const out = overlays;
  Kokkos::parallel_for(
      "Harmos::remap::intersect", RangePolicy(0, donors.num),
      KOKKOS_LAMBDA(int donor) { intersectDonor(in, classes, donors, out, donor); });
  return overlays;
}

} // namespace RemapDetail
} // namespace Harmos
