// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Donors.hpp>

#include <Harmos_BentEdge.hpp>
#include <Harmos_Fullness.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// The corners of a pair in stage 2: q at the start, moved to x = q + u; swept nodes are at home already.
struct MovedCorners
{
  Quadrilateral q, x;
  Vector2 u[4];
};

/// False where no corner moves, nor the mesh does there.
KOKKOS_INLINE_FUNCTION bool moveCorners(Input const &in, Classes const &classes, int cell, int pair, MovedCorners &c)
{
  bool moves = false;
  c.q = in.startQuadrilateral(cell);
  c.x.size = 4;
  for (int k = 0; k < 4; ++k)
  {
    int const node = in.mesh.cell_node(cell, k);
    bool const swept = classes.node_return(node) == SweptNode;
    Vector2 const home = in.node(node);
    c.u[k] = swept ? home - c.q[k] : in.displacement(in.pairs.dof_node(pair, k));
    c.x[k] = swept ? home : c.q[k] + c.u[k];
    moves = moves || c.u[k][0] != 0.0 || c.u[k][1] != 0.0 || home[0] != c.q[k][0] || home[1] != c.q[k][1];
  }
  return moves;
}

KOKKOS_INLINE_FUNCTION Vector2 interpolated(double const N[4], Vector2 const u[4])
{
  return (N[0] * u[0] + N[1] * u[1]) + (N[2] * u[2] + N[3] * u[3]);
}

KOKKOS_INLINE_FUNCTION void moveRegion(Input const &in, int cell, int pair, MovedCorners const &c, Region &region)
{
  Quadrilateral const &q = c.q;
  Vector2 const *const u = c.u;
  int const first = in.regions.cell_region(cell);
  if (first < 0)
  {
    region.size = 4;
    for (int k = 0; k < 4; ++k)
      region[k] = c.x[k];
    return;
  }
  // Where interfaces are closed edges bend at their middles as the bilinear motion bends them (Harmos_BentEdge.hpp).
  double const full = fullness(in.mesh, in.pairs, in.regions, cell,
                               [&](int material) { return isFluid(in.materials(material)); }),
               cell_area = in.mesh.cell_area(cell);
  Region const &still = in.regions.polygon(first + pair - in.pairs.offset(cell));
  region.size = 0;
  for (int i = 0; i < still.size; ++i)
  {
    Vector2 const x = still[i];
    int corner = -1;
    for (int k = 0; k < 4; ++k)
      if (x[0] == q[k][0] && x[1] == q[k][1])
        corner = k;
    double N[4];
    if (corner < 0)
      shapeFunctionsAt(q, x, N);
    region.push(corner >= 0 ? c.x[corner] : x + interpolated(N, u));
    if (!(full > 0.0) || region.size + still.size - i > max_region_vertices)
      continue;
    Vector2 const next = still[still.next(i)], middle = 0.5 * (x + next);
    double N_next[4], N_middle[4];
    shapeFunctionsAt(q, middle, N_middle);
    double const bend = bendOf(next - x, cell_area, full, in.options.shortest_bent_edge, N_middle);
    if (!(bend > 0.0))
      continue;
    shapeFunctionsAt(q, x, N);
    shapeFunctionsAt(q, next, N_next);
    Vector2 const chord = 0.5 * (interpolated(N, u) + interpolated(N_next, u));
    region.push(middle + chord + bend * (interpolated(N_middle, u) - chord));
  }
}

/// A shift without what would carry a region of this cell through a wall, of which its vertices keep their side: no
/// corner of the cell leaves a wall's line, but the centroid's displacement is not that of a vertex there.
KOKKOS_INLINE_FUNCTION Vector2 withinWalls(Input const &in, int cell, Quadrilateral const &q, Region const &region,
                                           Vector2 const &centroid, Vector2 shift)
{
  for (int k = 0; k < 4; ++k)
  {
    int const index = in.conditions.node_index(in.mesh.cell_node(cell, k));
    int const walls = index < 0 ? 0 : in.conditions.condition(index).count;
    for (int w = 0; w < walls; ++w)
    {
      Vector2 const normal = in.conditions.condition(index).normal[w];
      Vector2 const inward = (dot(normal, centroid - q[k]) < 0.0 ? -1.0 : 1.0) * normal;
      double room = dot(inward, centroid - q[k]);
      for (int i = 0; i < region.size; ++i)
        room = Math::min(room, dot(inward, region[i] - q[k]));
      shift += Math::max(-dot(inward, shift) - Math::max(room, 0.0), 0.0) * inward;
    }
  }
  return shift;
}

/// The filled region at the start; `q`: its cell.
KOKKOS_INLINE_FUNCTION void stillRegion(Input const &in, int cell, int pair, Quadrilateral const &q, Region &region)
{
  int const first = in.regions.cell_region(cell);
  region.size = 4;
  if (first >= 0)
    region = in.regions.polygon(first + pair - in.pairs.offset(cell));
  else
    for (int k = 0; k < 4; ++k)
      region[k] = q[k];
}

/// A needle thinner than the bilinear map bends would fold: it moves as a whole, by the displacement of its centroid,
/// but through no wall.
KOKKOS_INLINE_FUNCTION void shiftRegion(Input const &in, int cell, int pair, MovedCorners const &c, Region &region)
{
  stillRegion(in, cell, pair, c.q, region);
  Vector2 const *const u = c.u;
  Vector2 const centroid = region[0] + moments<1>(region, region[0]).centroid();
  double N[4];
  shapeFunctionsAt(c.q, centroid, N);
  Vector2 const shift = withinWalls(in, cell, c.q, region, centroid, interpolated(N, u));
  for (int i = 0; i < region.size; ++i)
    region[i] += shift;
}

KOKKOS_INLINE_FUNCTION void setCellCentre(Donors const &donors, int donor, Vector2 const &centre)
{
  donors.shape(donor, 6) = centre[0];
  donors.shape(donor, 7) = centre[1];
}

KOKKOS_INLINE_FUNCTION void setShape(Donors const &donors, int donor, double volume, Vector2 const &centroid)
{
  donors.shape(donor, 0) = volume;
  donors.shape(donor, 1) = centroid[0];
  donors.shape(donor, 2) = centroid[1];
  setCellCentre(donors, donor, centroid);
  for (int i = 3; i < 6; ++i)
    donors.shape(donor, i) = 0.0;
}

/// A pure cell's moved region, or a part of a mixed cell: volume, centroid, central second moments.
KOKKOS_INLINE_FUNCTION bool setMovedShape(Donors const &donors, int donor, Geometry geometry, Region const &region,
                                          double least_volume)
{
  if (region.size < 3)
    return false;
  Vector2 const origin = region[0];
  Moments<2> const m = moments<2>(region, origin, areaWeight(geometry, origin));
  if (!(m.volume() > least_volume))
    return false;
  Vector2 const d = m.centroid();
  setShape(donors, donor, m.volume(), origin + d);
  donors.shape(donor, 3) = m.second(0, 0) - d[0] * m.first(0);
  donors.shape(donor, 4) = m.second(0, 1) - d[0] * m.first(1);
  donors.shape(donor, 5) = m.second(1, 1) - d[1] * m.first(1);
  return true;
}

/// Where a whole donor is: the region at time n, carried to the mesh.
KOKKOS_INLINE_FUNCTION void setStillShape(Input const &in, Donors const &donors, int donor, int pair)
{
  int const cell = in.pairs.cell(pair);
  double const cell_volume = in.mesh.cell_volume(cell);
  if (in.pairs.cell_kind(cell) == PureCell)
    setShape(donors, donor, cell_volume, cellCentroid(in.mesh, cell));
  else
  {
    setShape(donors, donor, in.state.record(pair, VolumeFraction) * cell_volume,
             in.carried(cell, {in.state.centroid(pair, 0), in.state.centroid(pair, 1)}));
    setCellCentre(donors, donor, cellCentroid(in.mesh, cell));
  }
}

struct MoveFunctor
{
  Input in;
  Classes classes;
  StageState stage;
  Donors donors;

  KOKKOS_INLINE_FUNCTION void setValue(int donor, int pair) const
  {
    double *value = &donors.value(donor, 0);
    for (int f = 0; f < num_pair_fields; ++f)
      value[f] = stage.record(pair, f);
    value[DensityField] = stage.record(pair, Mass) / donors.shape(donor, 0);
    value[KineticField] = stage.kineticEnergy(in, pair);
    stage.cornerVelocities(in, classes, pair, value + first_corner_field);
    cornerVelocities(in.pairs, in.half, pair, &donors.half(donor, 0));
  }

  KOKKOS_INLINE_FUNCTION int move(int donor, int cell, int pair) const
  {
    MovedCorners c;
    int kind = QuietDonor;
    if (moveCorners(in, classes, cell, pair, c))
    {
      Region &region = donors.polygon(donor);
      moveRegion(in, cell, pair, c, region);
      if (isFolded(region))
        shiftRegion(in, cell, pair, c, region);
      bool const sound = setMovedShape(donors, donor, in.mesh.geometry, region, 1e-15 * in.mesh.cell_volume(cell));
      kind = sound ? MovingDonor : DegenerateDonor;
      if (sound && in.pairs.cell_kind(cell) != PureCell)
      {
        Moments<1> const whole = moments<1>(c.x, c.x[0], areaWeight(in.mesh.geometry, c.x[0]));
        setCellCentre(donors, donor, c.x[0] + whole.centroid());
      }
    }
    if (kind != MovingDonor)
      setStillShape(in, donors, donor, pair);
    return kind;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const cell = classes.interface_cell(index);
    for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
    {
      int const pair = in.pairs.offset(cell) + donor - donors.offset(index);
      int const material = in.pairs.material(pair);
      donors.head(donor) = {pair, material, RigidDonor, 1.0, 0ull};
      if (in.isRigid(material))
        continue;
      donors.head(donor).kind = move(donor, cell, pair);
      setValue(donor, pair);
    }
  }
};

} // namespace

void moveDonors(Input const &in, Classes const &classes, StageState const &stage, Donors &donors)
{
  int const cells = classes.num_interface;
  grow(donors.offset, "donorOffset", cells + 1);
  View<int *> const offset = donors.offset;
  Kokkos::parallel_scan(
      "Harmos::remap::countDonors", RangePolicy(0, cells + 1),
      KOKKOS_LAMBDA(int i, int &sum, bool last) {
        if (last)
          offset(i) = sum;
        if (i < cells)
          sum += in.pairs.offset(classes.interface_cell(i) + 1) - in.pairs.offset(classes.interface_cell(i));
      },
      donors.num);
  grow(donors.head, "donorHead", donors.num);
  grow(donors.polygon, "donorPolygon", donors.num);
  grow(donors.shape, "donorShape", donors.num);
  grow(donors.value, "donorValue", donors.num);
  grow(donors.half, "donorHalf", donors.num);
  Kokkos::parallel_for("Harmos::remap::moveDonors", RangePolicy(0, cells), MoveFunctor{in, classes, stage, donors});
}

void moveOtherRegions(Input const &in, Classes const &classes, Donors const &donors)
{
  Kokkos::parallel_for(
      "Harmos::remap::moveOtherRegions", RangePolicy(0, classes.num_interface), KOKKOS_LAMBDA(int index) {
        int const cell = classes.interface_cell(index);
        for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
        {
          DonorHead const head = donors.head(donor);
          Region &region = donors.polygon(donor);
          MovedCorners c;
          if (head.kind == DegenerateDonor)
            region.size = 0;
          else if (head.kind != MovingDonor && moveCorners(in, classes, cell, head.pair, c))
            moveRegion(in, cell, head.pair, c, region);
          else if (head.kind != MovingDonor)
            stillRegion(in, cell, head.pair, c.q, region);
        }
      });
}

} // namespace RemapDetail
} // namespace Harmos
