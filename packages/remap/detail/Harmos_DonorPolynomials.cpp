// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_Donors.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct PolynomialFunctor
{
  Input in;
  Classes classes;
  StageState stage;
  Donors donors;

  static constexpr int fields = num_stage_fields;

  /// Volume and centroid of a pair between the stages: a donor's own, or those of a pure cell that is at home.
  KOKKOS_INLINE_FUNCTION void place(int pair, double &volume, Vector2 &centroid) const
  {
    int const cell = in.pairs.cell(pair);
    if (classes.interface_index(cell) >= 0)
    {
      int const donor = donors.index(in, classes, pair);
      volume = donors.shape(donor, 0);
      centroid = {donors.shape(donor, 1), donors.shape(donor, 2)};
      return;
    }
    Quadrilateral const q = cellQuadrilateral(in.mesh, cell);
    volume = in.mesh.cell_area(cell);
    centroid = areaCentroid(q.vertex).centroid;
  }

  KOKKOS_INLINE_FUNCTION void load(int pair, double volume, int rotation, View<double *[2]> const &velocity,
                                   double q[fields]) const
  {
    for (int f = 0; f < num_pair_fields; ++f)
      q[f] = stage.record(pair, f);
    q[DensityField] = stage.record(pair, Mass) / volume;
    q[KineticField] = stage.kineticEnergy(in.pairs, pair);
    for (int k = 0; k < 4; ++k)
    {
      int const dof = in.pairs.dof_node(pair, (k + rotation) % 4);
      q[first_corner_field + 2 * k] = velocity(dof, 0);
      q[first_corner_field + 2 * k + 1] = velocity(dof, 1);
    }
  }

  /// Least-squares gradient weighted by filled part over distance squared; along a line where all neighbours lie on
  /// one.
  KOKKOS_INLINE_FUNCTION void gradient(int pair, Vector2 const &centroid, double const q[fields], double gx[fields],
                                       double gy[fields], double lower[fields], double upper[fields]) const
  {
    int const cell = in.pairs.cell(pair);
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (int f = 0; f < fields; ++f)
      gx[f] = gy[f] = 0.0;
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      int const neighbour = in.mesh.cell_neighbour.item(j);
      int const other = in.pairs.find(neighbour, in.pairs.material(pair));
      if (other < 0)
        continue;
      double volume;
      Vector2 d;
      place(other, volume, d);
      d -= centroid;
      double const distance2 = dot(d, d);
      if (!(distance2 > 0.0) || !(volume > 0.0))
        continue;
      double p[fields];
      load(other, volume, cornerRotation(in.mesh, cell, neighbour), in.half, p);
      double const w = volume / (in.mesh.cell_area(neighbour) * distance2);
      xx += w * d[0] * d[0];
      xy += w * d[0] * d[1];
      yy += w * d[1] * d[1];
      for (int f = 0; f < fields; ++f)
      {
        gx[f] += w * d[0] * (p[f] - q[f]);
        gy[f] += w * d[1] * (p[f] - q[f]);
        lower[f] = Math::min(lower[f], p[f]);
        upper[f] = Math::max(upper[f], p[f]);
      }
    }
    double const trace = xx + yy;
    double const det = xx * yy - xy * xy;
    bool const line = det < 1e-6 * trace * trace;
    double const scale = trace > 0.0 ? 1.0 / (line ? trace : det) : 0.0;
    for (int f = 0; f < fields; ++f)
    {
      double const bx = gx[f];
      double const by = gy[f];
      gx[f] = scale * (line ? bx : yy * bx - xy * by);
      gy[f] = scale * (line ? by : xx * by - xy * bx);
    }
  }

  /// The largest part of a gradient that keeps the value within range at all vertices, about `centre`.
  KOKKOS_INLINE_FUNCTION double limit(Region const &region, Vector2 const &centre, double q, double gx, double gy,
                                      double lower, double upper) const
  {
    double most = 0.0, least = 0.0;
    for (int i = 0; i < region.size; ++i)
    {
      double const delta = gx * (region[i][0] - centre[0]) + gy * (region[i][1] - centre[1]);
      most = Math::max(most, delta);
      least = Math::min(least, delta);
    }
    double const up = most > upper - q ? (upper - q) / most : 1.0;
    double const down = least < lower - q ? (lower - q) / least : 1.0;
    return Math::min(up, down);
  }

  KOKKOS_INLINE_FUNCTION void operator()(int donor) const
  {
    if (donors.kind(donor) == RigidDonor)
      return;
    int const pair = donors.pair(donor);
    double const volume = donors.shape(donor, 0);
    Vector2 const centroid{donors.shape(donor, 1), donors.shape(donor, 2)};
    double q[fields], gx[fields] = {}, gy[fields] = {};
    Vector2 mass_offset{0.0, 0.0};
    load(pair, volume, 0, stage.velocity, q);
    if (in.options.order > 1 && donors.kind(donor) == MovingDonor)
      limitedGradients(donor, pair, centroid, q, gx, gy, mass_offset);
    for (int f = 0; f < fields; ++f)
    {
      donors.polynomial(donor, f, 0) = q[f];
      donors.polynomial(donor, f, 1) = gx[f];
      donors.polynomial(donor, f, 2) = gy[f];
    }
    donors.mass_offset(donor, 0) = mass_offset[0];
    donors.mass_offset(donor, 1) = mass_offset[1];
  }

  KOKKOS_INLINE_FUNCTION void limitedGradients(int donor, int pair, Vector2 const &centroid, double const q[fields],
                                               double gx[fields], double gy[fields], Vector2 &mass_offset) const
  {
    double before[fields], lower[fields], upper[fields];
    // Differences of corner velocities are taken between like times.
    load(pair, donors.shape(donor, 0), 0, in.half, before);
    for (int f = 0; f < fields; ++f)
    {
      lower[f] = Math::min(q[f], before[f]);
      upper[f] = Math::max(q[f], before[f]);
    }
    gradient(pair, centroid, before, gx, gy, lower, upper);
    Region const &region = donors.polygon(donor);
    double const alpha = limit(region, centroid, q[0], gx[0], gy[0], lower[0], upper[0]);
    gx[0] *= alpha;
    gy[0] *= alpha;
    double const per_mass = 1.0 / (q[0] * donors.shape(donor, 0));
    mass_offset = {per_mass * (donors.shape(donor, 3) * gx[0] + donors.shape(donor, 4) * gy[0]),
                   per_mass * (donors.shape(donor, 4) * gx[0] + donors.shape(donor, 5) * gy[0])};
    for (int f = 1; f < fields; ++f)
    {
      double const a =
          limit(region, byVolume(f) ? centroid : centroid + mass_offset, q[f], gx[f], gy[f], lower[f], upper[f]);
      gx[f] *= a;
      gy[f] *= a;
    }
  }
};

} // namespace

void donorPolynomials(Input const &in, Classes const &classes, StageState const &stage, Donors const &donors)
{
  Kokkos::parallel_for("Harmos::remap::donorPolynomials", RangePolicy(0, donors.num),
                       PolynomialFunctor{in, classes, stage, donors});
}

} // namespace RemapDetail
} // namespace Harmos
