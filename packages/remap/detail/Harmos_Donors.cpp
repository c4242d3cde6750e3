// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Donors.hpp>

#include <Harmos_Moments.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Displacement of a corner in stage 2: swept nodes are at home already.
KOKKOS_INLINE_FUNCTION Vector2 cornerDisplacement(Input const &in, Classes const &classes, int pair, int corner)
{
  int const node = in.mesh.cell_node(in.pairs.cell(pair), corner);
  if (classes.node_return(node) == SweptNode)
    return {0.0, 0.0};
  return in.displacement(in.pairs.dof_node(pair, corner));
}

KOKKOS_INLINE_FUNCTION bool moves(Input const &in, Classes const &classes, int pair)
{
  for (int k = 0; k < 4; ++k)
  {
    Vector2 const u = cornerDisplacement(in, classes, pair, k);
    if (u[0] != 0.0 || u[1] != 0.0)
      return true;
  }
  return false;
}

KOKKOS_INLINE_FUNCTION Region movedRegion(Input const &in, Classes const &classes, int pair)
{
  int const cell = in.pairs.cell(pair);
  Quadrilateral const q = cellQuadrilateral(in.mesh, cell);
  Vector2 u[4];
  for (int k = 0; k < 4; ++k)
    u[k] = cornerDisplacement(in, classes, pair, k);
  Region region = in.regions.region(in.mesh, in.pairs, pair);
  for (int i = 0; i < region.size; ++i)
  {
    Vector2 const x = region[i];
    int corner = -1;
    for (int k = 0; k < 4; ++k)
      if (x[0] == q[k][0] && x[1] == q[k][1])
        corner = k;
    if (corner >= 0)
    {
      region[i] += u[corner];
      continue;
    }
    double N[4];
    shapeFunctionsAt(q, x, N);
    region[i] += (N[0] * u[0] + N[1] * u[1]) + (N[2] * u[2] + N[3] * u[3]);
  }
  return region;
}

KOKKOS_INLINE_FUNCTION void setShape(Donors const &donors, int donor, double volume, Vector2 const &centroid)
{
  donors.shape(donor, 0) = volume;
  donors.shape(donor, 1) = centroid[0];
  donors.shape(donor, 2) = centroid[1];
  for (int i = 3; i < 6; ++i)
    donors.shape(donor, i) = 0.0;
}

/// A pure cell's moved region, or a part of a mixed cell: volume, centroid, central second moments.
KOKKOS_INLINE_FUNCTION bool setMovedShape(Donors const &donors, int donor, Region const &region, double least_volume)
{
  if (region.size < 3)
    return false;
  Vector2 const origin = region[0];
  Moments<2> const m = moments<2>(region, origin);
  if (!(m.volume() > least_volume))
    return false;
  Vector2 const d = m.centroid();
  setShape(donors, donor, m.volume(), origin + d);
  donors.shape(donor, 3) = m.second(0, 0) - d[0] * m.first(0);
  donors.shape(donor, 4) = m.second(0, 1) - d[0] * m.first(1);
  donors.shape(donor, 5) = m.second(1, 1) - d[1] * m.first(1);
  return true;
}

/// Where a whole donor is: the region at time n.
KOKKOS_INLINE_FUNCTION void setStillShape(Input const &in, Donors const &donors, int donor)
{
  int const pair = donors.pair(donor);
  int const cell = in.pairs.cell(pair);
  double const cell_area = in.mesh.cell_area(cell);
  if (in.pairs.cell_kind(cell) == PureCell)
  {
    Quadrilateral const q = cellQuadrilateral(in.mesh, cell);
    setShape(donors, donor, cell_area, areaCentroid(q.vertex).centroid);
  }
  else
    setShape(donors, donor, in.state.record(pair, VolumeFraction) * cell_area,
             {in.state.centroid(pair, 0), in.state.centroid(pair, 1)});
}

KOKKOS_INLINE_FUNCTION bool materialMoves(Input const &in, Classes const &classes, int cell)
{
  for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
    if (!in.isRigid(in.pairs.material(pair)) && moves(in, classes, pair))
      return true;
  return false;
}

} // namespace

Donors moveDonors(Input const &in, Classes const &classes)
{
  Donors donors;
  View<int *> const offset = scratch<int *>("donorOffset", classes.num_interface + 1);
  donors.offset = offset;
  Kokkos::parallel_for(
      "Harmos::remap::countDonors", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        int const cell = classes.interface_cell(i);
        offset(i) = in.pairs.offset(cell + 1) - in.pairs.offset(cell);
      });
  donors.num = exclusiveScan(offset);
  donors.pair = scratch<int *>("donorPair", donors.num);
  donors.kind = scratch<int *>("donorKind", donors.num);
  donors.polygon = scratch<Region *>("donorPolygon", donors.num);
  donors.shape = scratch<double *[6]>("donorShape", donors.num);
  donors.polynomial = scratch<double *[num_stage_fields][3]>("donorPolynomial", donors.num);
  donors.mass_offset = scratch<double *[2]>("donorMassOffset", donors.num);
  Donors const out = donors;
  Kokkos::parallel_for(
      "Harmos::remap::moveDonors", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int i) {
        int const cell = classes.interface_cell(i);
        bool const moving = materialMoves(in, classes, cell);
        for (int donor = out.offset(i); donor < out.offset(i + 1); ++donor)
        {
          int const pair = in.pairs.offset(cell) + donor - out.offset(i);
          out.pair(donor) = pair;
          if (in.isRigid(in.pairs.material(pair)))
          {
            out.kind(donor) = RigidDonor;
            continue;
          }
          int kind = QuietDonor;
          if (moving && moves(in, classes, pair))
          {
            Region const region = movedRegion(in, classes, pair);
            out.polygon(donor) = region;
            bool const sound = setMovedShape(out, donor, region, 1e-15 * in.mesh.cell_area(cell));
            kind = sound ? MovingDonor : DegenerateDonor;
          }
          if (kind != MovingDonor)
            setStillShape(in, out, donor);
          out.kind(donor) = kind;
        }
      });
  return donors;
}

} // namespace RemapDetail
} // namespace Harmos
