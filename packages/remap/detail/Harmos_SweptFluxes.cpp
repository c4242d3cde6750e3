// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptFluxes.hpp>

#include <detail/Harmos_FieldPack.hpp>

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
  View<double *[8]> moved_record;
  View<double *[16]> geometry;
  View<double *[4][8]> flux;

  struct Gradient
  {
    FieldPack x, y, lower, upper; // and the range of the cell and its face neighbours
  };

  KOKKOS_INLINE_FUNCTION FieldPack load(int cell) const { return FieldPack(&moved_record(cell, 0)); }

  /// Linear-exact gradient from the differences across the cell along its two directions.
  KOKKOS_INLINE_FUNCTION void differentiate(int cell, FieldPack const &q, Gradient &g) const
  {
    FieldPack difference[2] = {FieldPack(0.0), FieldPack(0.0)};
    Vector2 d[2] = {{0.0, 0.0}, {0.0, 0.0}};
    Vector2 const centroid{geometry(cell, CentroidX), geometry(cell, CentroidY)};
    int const material = classes.pure_material(cell);
    for (int k = 0; k < 4; ++k)
    {
      int const face = in.mesh.face_neighbour(cell, k);
      if (face < 0 || classes.pure_material(face / 4) != material)
        continue;
      int const neighbour = face / 4;
      FieldPack const p = load(neighbour);
      Vector2 const to = Vector2{geometry(neighbour, CentroidX), geometry(neighbour, CentroidY)} - centroid;
      if (k == 1 || k == 2)
      {
        d[k % 2] += to;
        difference[k % 2] += p - q;
      }
      else
      {
        d[k % 2] -= to;
        difference[k % 2] -= p - q;
      }
      g.lower = min(g.lower, p);
      g.upper = max(g.upper, p);
    }
    if (dot(d[0], d[0]) == 0.0)
      d[0] = -perpendicular(d[1]);
    if (dot(d[1], d[1]) == 0.0)
      d[1] = perpendicular(d[0]);
    double const det = cross(d[0], d[1]);
    double const inverse = det != 0.0 ? 1.0 / det : 0.0;
    g.x = (inverse * d[1][1]) * difference[0] - (inverse * d[0][1]) * difference[1];
    g.y = (inverse * d[0][0]) * difference[1] - (inverse * d[1][0]) * difference[0];
  }

  /// The largest part of a deviation from q, at most all of it, that keeps q + [least, most] within [lower, upper].
  KOKKOS_INLINE_FUNCTION static FieldPack limiter(FieldPack const &q, Gradient const &g, FieldPack const &least,
                                                  FieldPack const &most)
  {
    FieldPack const one(1.0), tiny(1e-300);
    FieldPack const above = g.upper - q;
    FieldPack const below = q - g.lower;
    FieldPack const drop = FieldPack(0.0) - least;
    FieldPack const up = select(above, most, above / max(most, tiny), one);
    FieldPack const down = select(below, drop, below / max(drop, tiny), one);
    return min(up, down);
  }

  KOKKOS_INLINE_FUNCTION static double densityLimiter(double q, double lower, double upper, double least, double most)
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
    FieldPack const q = load(cell);
    Gradient g;
    g.lower = g.upper = q;
    if (in.options.order > 1)
    {
      differentiate(cell, q, g);
      writeFluxes(cell, volume, staying, q, g);
      return;
    }
    for (int k = 0; k < 4; ++k)
      if (volume[k] > 0.0)
        (fieldWeights(volume[k], volume[k] * moved_record(cell, DensityField)) * q).store(&flux(cell, k, 0));
  }

  KOKKOS_INLINE_FUNCTION void writeFluxes(int cell, double const volume[4], double staying, FieldPack const &q,
                                          Gradient const &g) const
  {
    // Density first: it gives the mass fluxes that weigh the primitives.
    double const rho = moved_record(cell, DensityField);
    double gradient_x[8], gradient_y[8], lower[8], upper[8];
    g.x.store(gradient_x);
    g.y.store(gradient_y);
    g.lower.store(lower);
    g.upper.store(upper);
    double deviation[4];
    double least = 0.0, most = 0.0, rest = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      deviation[k] =
          gradient_x[0] * geometry(cell, FirstFace + 3 * k + 1) + gradient_y[0] * geometry(cell, FirstFace + 3 * k + 2);
      least = Math::min(least, deviation[k]);
      most = Math::max(most, deviation[k]);
      rest -= volume[k] * deviation[k];
    }
    rest /= staying;
    double const alpha = densityLimiter(rho, lower[0], upper[0], Math::min(least, rest), Math::max(most, rest));
    double mass[4];
    double staying_mass = geometry(cell, MovedVolume) * rho;
    for (int k = 0; k < 4; ++k)
    {
      mass[k] = volume[k] * (rho + alpha * deviation[k]);
      staying_mass -= mass[k];
    }
    FieldPack value[4];
    FieldPack low(0.0), high(0.0), left(0.0);
    for (int k = 0; k < 4; ++k)
    {
      if (volume[k] <= 0.0)
        continue;
      value[k] = geometry(cell, FirstFace + 3 * k + 1) * g.x + geometry(cell, FirstFace + 3 * k + 2) * g.y;
      low = min(low, value[k]);
      high = max(high, value[k]);
      left -= fieldWeights(volume[k], mass[k]) * value[k];
    }
    left *= fieldWeights(1.0 / staying, 1.0 / staying_mass);
    FieldPack const a = limiter(q, g, min(low, left), max(high, left));
    for (int k = 0; k < 4; ++k)
    {
      if (volume[k] <= 0.0)
        continue;
      (fieldWeights(volume[k], mass[k]) * (q + a * value[k])).store(&flux(cell, k, 0));
      flux(cell, k, DensityField) = mass[k];
    }
  }
};

} // namespace

void sweptGeometry(Input const &in, Classes const &classes, View<double *> const &kinetic, RemapWork const &work)
{
  bool const carries = kinetic.extent(0) > 0;
  View<double *[16]> const geometry = work.geometry;
  View<double *[8]> const moved_record = work.moved_record;
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
        for (int f = SpecificVolume; f < num_pair_fields; ++f)
          moved_record(cell, f) = in.state.record(pair, f);
        moved_record(cell, DensityField) = in.state.record(pair, Mass) / body.area;
        moved_record(cell, KineticField) = carries ? kinetic(pair) : 0.0;
        geometry(cell, CentroidX) = body.centroid[0];
        geometry(cell, CentroidY) = body.centroid[1];
        for (int k = 0; k < 4; ++k)
        {
          int const next = (k + 1) % 4;
          double const swept =
              in.mesh.face_neighbour(cell, k) >= 0 ? 0.5 * cross(back[k] + back[next], middle[next] - middle[k]) : 0.0;
          Vector2 centroid{0.0, 0.0}; // unused where nothing leaves
          if (swept > 0.0)
            centroid = sweptCentroid(middle[k], middle[next], back[k], back[next]) - body.centroid;
          geometry(cell, FirstFace + 3 * k) = swept;
          geometry(cell, FirstFace + 3 * k + 1) = centroid[0];
          geometry(cell, FirstFace + 3 * k + 2) = centroid[1];
        }
      });
}

void sweptFluxes(Input const &in, Classes const &classes, RemapWork const &work)
{
  Kokkos::parallel_for("Harmos::remap::sweptFluxes", RangePolicy(0, classes.num_swept),
                       SweptFluxFunctor{in, classes, work.moved_record, work.geometry, work.flux});
}

} // namespace RemapDetail
} // namespace Harmos
