// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptFluxes.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Centroid of the area that an edge a->b sweeps when its ends move by u_a, u_b, from the ends' mid-step positions.
KOKKOS_INLINE_FUNCTION Vector2 sweptCentroid(Vector2 const &a, Vector2 const &b, Vector2 const &u_a, Vector2 const &u_b)
{
  Vector2 const edge = b - a;
  double const depth_a = cross(u_a, edge);
  double const depth_b = cross(u_b, edge);
  double s = 0.5;
  if (depth_a * depth_b >= 0.0 && depth_a + depth_b != 0.0)
    s = (depth_a + 2.0 * depth_b) / (3.0 * (depth_a + depth_b));
  return a + s * edge;
}

struct SweptFluxFunctor
{
  Input in;
  Classes classes;
  View<double *> kinetic;
  View<double *[16]> geometry;
  View<double *[4][8]> flux;

  static constexpr int fields = 8;

  KOKKOS_INLINE_FUNCTION void load(int cell, double q[fields]) const
  {
    int const pair = in.pairs.offset(cell);
    for (int f = 0; f < fields; ++f)
      q[f] = in.state.record(pair, f);
    q[DensityField] = geometry(cell, MovedDensity);
    q[KineticField] = kinetic.extent(0) > 0 ? kinetic(pair) : 0.0;
  }

  /// Linear-exact gradient from the differences across the cell along its two directions; lower and upper are widened
  /// to the neighbours' values.
  KOKKOS_INLINE_FUNCTION void gradient(int cell, double const q[fields], double gx[fields], double gy[fields],
                                       double lower[fields], double upper[fields]) const
  {
    double difference[2][fields] = {};
    Vector2 d[2] = {{0.0, 0.0}, {0.0, 0.0}};
    Vector2 const centroid{geometry(cell, CentroidX), geometry(cell, CentroidY)};
    int const material = classes.pure_material(cell);
    for (int k = 0; k < 4; ++k)
    {
      int const face = in.mesh.face_neighbour(cell, k);
      if (face < 0 || classes.pure_material(face / 4) != material)
        continue;
      int const neighbour = face / 4;
      double p[fields];
      load(neighbour, p);
      double const sign = k == 1 || k == 2 ? 1.0 : -1.0;
      int const direction = k % 2;
      d[direction] += sign * (Vector2{geometry(neighbour, CentroidX), geometry(neighbour, CentroidY)} - centroid);
      for (int f = 0; f < fields; ++f)
      {
        difference[direction][f] += sign * (p[f] - q[f]);
        lower[f] = p[f] < lower[f] ? p[f] : lower[f];
        upper[f] = p[f] > upper[f] ? p[f] : upper[f];
      }
    }
    if (dot(d[0], d[0]) == 0.0)
      d[0] = -perpendicular(d[1]);
    if (dot(d[1], d[1]) == 0.0)
      d[1] = perpendicular(d[0]);
    double const det = cross(d[0], d[1]);
    double const inverse = det != 0.0 ? 1.0 / det : 0.0;
    for (int f = 0; f < fields; ++f)
    {
      gx[f] = inverse * (difference[0][f] * d[1][1] - difference[1][f] * d[0][1]);
      gy[f] = inverse * (difference[1][f] * d[0][0] - difference[0][f] * d[1][0]);
    }
  }

  KOKKOS_INLINE_FUNCTION static double limiter(double q, double lower, double upper, double least, double most)
  {
    double const up = most > upper - q ? (upper - q) / most : 1.0;
    double const down = least < lower - q ? (lower - q) / least : 1.0;
    return up < down ? up : down;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int i) const
  {
    int const cell = classes.swept_cell(i);
    double volume[4]; // that leave
    bool leaves = false;
    double staying = geometry(cell, MovedVolume);
    for (int k = 0; k < 4; ++k)
    {
      volume[k] = Math::max(geometry(cell, FirstFace + 3 * k), 0.0);
      leaves = leaves || volume[k] > 0.0;
      staying -= volume[k];
    }
    if (!leaves)
      return;
    double q[fields], gx[fields] = {}, gy[fields] = {};
    double lower[fields], upper[fields];
    load(cell, q);
    for (int f = 0; f < fields; ++f)
      lower[f] = upper[f] = q[f];
    if (in.options.order > 1)
      gradient(cell, q, gx, gy, lower, upper);
    writeFluxes(cell, volume, staying, q, gx, gy, lower, upper);
  }

  KOKKOS_INLINE_FUNCTION void writeFluxes(int cell, double const volume[4], double staying, double const q[fields],
                                          double const gx[fields], double const gy[fields], double const lower[fields],
                                          double const upper[fields]) const
  {
    double dx[4], dy[4];
    for (int k = 0; k < 4; ++k)
    {
      dx[k] = volume[k] > 0.0 ? geometry(cell, FirstFace + 3 * k + 1) : 0.0;
      dy[k] = volume[k] > 0.0 ? geometry(cell, FirstFace + 3 * k + 2) : 0.0;
    }
    // Density first: it gives the mass fluxes that weigh the primitives.
    double rho[4];
    double least = 0.0, most = 0.0, sum = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      rho[k] = gx[0] * dx[k] + gy[0] * dy[k];
      least = Math::min(least, rho[k]);
      most = Math::max(most, rho[k]);
      sum -= volume[k] * rho[k];
    }
    sum /= staying;
    double const alpha = limiter(q[0], lower[0], upper[0], Math::min(least, sum), Math::max(most, sum));
    double mass[4];
    double staying_mass = geometry(cell, MovedVolume) * q[0];
    for (int k = 0; k < 4; ++k)
    {
      mass[k] = volume[k] * (q[0] + alpha * rho[k]);
      staying_mass -= mass[k];
    }
    double value[4][fields];
    for (int f = 0; f < fields; ++f)
    {
      bool const by_mass = f >= 1 && f <= 4;
      double low = 0.0, high = 0.0, rest = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        double const delta = gx[f] * dx[k] + gy[f] * dy[k];
        value[k][f] = delta;
        low = delta < low ? delta : low;
        high = delta > high ? delta : high;
        rest -= (by_mass ? mass[k] : volume[k]) * delta;
      }
      rest /= by_mass ? staying_mass : staying;
      low = rest < low ? rest : low;
      high = rest > high ? rest : high;
      double const a = limiter(q[f], lower[f], upper[f], low, high);
      for (int k = 0; k < 4; ++k)
        value[k][f] = (by_mass ? mass[k] : volume[k]) * (q[f] + a * value[k][f]);
    }
    for (int k = 0; k < 4; ++k)
    {
      if (volume[k] <= 0.0)
        continue;
      for (int f = 0; f < fields; ++f)
        flux(cell, k, f) = value[k][f];
      flux(cell, k, DensityField) = mass[k];
    }
  }
};

} // namespace

void sweptGeometry(Input const &in, Classes const &classes, RemapWork const &work)
{
  View<double *[16]> const geometry = work.geometry;
  Kokkos::parallel_for(
      "Harmos::remap::sweptGeometry", RangePolicy(0, in.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        if (classes.pure_material(cell) < 0)
          return;
        int const pair = in.pairs.offset(cell);
        Vector2 moved[4], middle[4], back[4];
        for (int k = 0; k < 4; ++k)
        {
          int const node = in.mesh.cell_node(cell, k);
          Vector2 const x = in.node(node);
          Vector2 const u = in.displacement(in.pairs.dof_node(pair, k));
          bool const swept = classes.node_return(node) == SweptNode;
          moved[k] = x + u;
          back[k] = swept ? u : Vector2{0.0, 0.0};
          middle[k] = swept ? x + 0.5 * u : moved[k];
        }
        AreaCentroid const body = areaCentroid(moved);
        geometry(cell, MovedVolume) = body.area;
        geometry(cell, MovedDensity) = in.state.record(pair, Mass) / body.area;
        geometry(cell, CentroidX) = body.centroid[0];
        geometry(cell, CentroidY) = body.centroid[1];
        for (int k = 0; k < 4; ++k)
        {
          int const next = (k + 1) % 4;
          bool const inside = in.mesh.face_neighbour(cell, k) >= 0;
          Vector2 const centroid = sweptCentroid(middle[k], middle[next], back[k], back[next]) - body.centroid;
          geometry(cell, FirstFace + 3 * k) =
              inside ? 0.5 * cross(back[k] + back[next], middle[next] - middle[k]) : 0.0;
          geometry(cell, FirstFace + 3 * k + 1) = centroid[0];
          geometry(cell, FirstFace + 3 * k + 2) = centroid[1];
        }
      });
}

void sweptFluxes(Input const &in, Classes const &classes, View<double *> const &kinetic, RemapWork const &work)
{
  Kokkos::parallel_for("Harmos::remap::sweptFluxes", RangePolicy(0, classes.num_swept),
                       SweptFluxFunctor{in, classes, kinetic, work.geometry, work.flux});
}

} // namespace RemapDetail
} // namespace Harmos
