// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_QUADRATIC_POLYNOMIAL_HPP
#define HARMOS_QUADRATIC_POLYNOMIAL_HPP

#include <detail/Harmos_DonorPolynomial.hpp>
#include <detail/Harmos_OverlayMoments.hpp>

namespace Harmos
{
namespace RemapDetail
{

constexpr int num_monomials = 6; // 1, x, y, xx, xy, yy
constexpr int most_ring = 16;    // neighbours that contour integrals use

/// Quadratic polynomials of a donor's fields about the donor's centroid.
struct QuadraticPolynomial
{
  StageFields mean;             // of the donor: density and deviator by volume, the others by mass
  StageFields c[num_monomials]; // coefficients; c[0] keeps the mean
};

/// Place of the product of two monomials among the moments.
KOKKOS_INLINE_FUNCTION int productMoment(int i, int j)
{
  int const degree[num_monomials] = {0, 1, 1, 2, 2, 2}, power_y[num_monomials] = {0, 0, 1, 0, 1, 2};
  int const n = degree[i] + degree[j];
  return n * (n + 1) / 2 + power_y[i] + power_y[j];
}

/// Integrals of density times the monomials: what weighs primitives and velocities.
KOKKOS_INLINE_FUNCTION void massMoments(StageFields const (&c)[num_monomials], QuarticMoments const &m,
                                        double (&w)[num_monomials])
{
  for (int i = 0; i < num_monomials; ++i)
  {
    w[i] = 0.0;
    for (int j = 0; j < num_monomials; ++j)
      w[i] += c[j].record[DensityField] * m.value[productMoment(i, j)];
  }
}

/// Finds quadratic polynomials, by default by a least-squares fit that is exact for quadratics: cell averages of
/// g.d + d.H d / 2 over the vertex neighbours of the same material less those over the donor, weighted by filled part
/// over distance squared. Where the neighbours do not determine the six coefficients, the linear gradient remains.
///
/// f = mean + s_G g.d + s_H (d.H d / 2 - chi), chi so that the mean stays (of rho phi where weighted by mass).
struct QuadraticFinder : PolynomialFinder
{
  using Polynomial = QuadraticPolynomial;
  using OverlayMoments = QuarticMoments;
  using PlaneMoments = QuarticMoments;

  KOKKOS_INLINE_FUNCTION static OverlayMoments const &measured(PlaneMoments const &m, double) { return m; }
  static KOKKOS_INLINE_FUNCTION constexpr bool overlaysInPacks() { return false; }

  KOKKOS_INLINE_FUNCTION explicit QuadraticFinder(PolynomialFinder const &finder) : PolynomialFinder(finder) {}

  KOKKOS_INLINE_FUNCTION static Polynomial constant(StageFields const &mean)
  {
    Polynomial p;
    p.mean = p.c[0] = mean;
    for (int i = 1; i < num_monomials; ++i)
      p.c[i] = stageFields(0.0);
    return p;
  }

  KOKKOS_INLINE_FUNCTION OverlayMoments wholeMoments(int, MovedVertices const &v) const
  {
    return momentsOfVertices<OverlayMoments>(v.size, v.x, v.y);
  }

  /// Density and deviator by volume, the others by mass.
  KOKKOS_INLINE_FUNCTION static StageFields integrate(Polynomial const &p, OverlayMoments const &m)
  {
    double w[num_monomials];
    massMoments(p.c, m, w);
    StageFields out = stageFields(0.0);
    for (int i = 0; i < num_monomials; ++i)
    {
      out.record += p.c[i].record * fieldWeights(m.value[i], w[i]);
      out.corner += p.c[i].corner * FieldPack(w[i]);
    }
    return out;
  }

  /// Normal equations of the fit, for x / h, y / h, and the second moments over h^2 of the unknowns
  /// g_x, g_y, H_xx / 2, H_xy, H_yy / 2.
  struct Fit
  {
    double matrix[5][5] = {};
    StageFields right[5];
    double h2, xx, xy, yy; // the donor's volume, and its central second moments over it
  };

  /// Central second moments over volume of a neighbour.
  KOKKOS_INLINE_FUNCTION void spread(int cell, int index, int material, double (&s)[3]) const
  {
    int const donor = index < 0 ? -1 : donors.find(index, material);
    if (donor >= 0 && donors.head(donor).kind == MovingDonor)
    {
      for (int i = 0; i < 3; ++i)
        s[i] = donors.shape(donor, 3 + i) / donors.shape(donor, 0);
      return;
    }
    int const pair = donor < 0 ? in.pairs.offset(cell) : donors.head(donor).pair;
    Region const region = in.regions.region(in.mesh, in.pairs, pair);
    Moments<2> const m = moments<2>(region, region[0]);
    Vector2 const d = m.centroid();
    s[0] = m.second(0, 0) / m.volume() - d[0] * d[0];
    s[1] = m.second(0, 1) / m.volume() - d[0] * d[1];
    s[2] = m.second(1, 1) / m.volume() - d[1] * d[1];
  }

  KOKKOS_INLINE_FUNCTION void addNeighbour(Fit &fit, Neighbour const &n, double const (&s)[3], Vector2 const &d,
                                           StageFields const &q) const
  {
    double const per_h = 1.0 / Math::sqrt(fit.h2), per_h2 = 1.0 / fit.h2;
    double const row[5] = {per_h * d[0], per_h * d[1], per_h2 * (s[0] - fit.xx + d[0] * d[0]),
                           per_h2 * (s[1] - fit.xy + d[0] * d[1]), per_h2 * (s[2] - fit.yy + d[1] * d[1])};
    double const w = n.filled * fit.h2 / dot(d, d);
    StageFields const difference = n.value - q;
    for (int i = 0; i < 5; ++i)
    {
      for (int j = 0; j <= i; ++j)
        fit.matrix[i][j] += w * row[i] * row[j];
      addTimes(fit.right[i], w * row[i], difference);
    }
  }

  KOKKOS_INLINE_FUNCTION void gather(Fit &fit, int cell, int material, Vector2 const &centroid,
                                     StageFields const &q) const
  {
    for (int i = 0; i < 5; ++i)
      fit.right[i] = stageFields(0.0);
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      Neighbour n;
      if (!findNeighbour(j, material, n))
        continue;
      Vector2 const d = n.centroid - centroid;
      if (!(dot(d, d) > 0.0))
        continue;
      double s[3];
      int const neighbour = in.mesh.cell_neighbour.item(j);
      spread(neighbour, classes.interface_index(neighbour), material, s);
      addNeighbour(fit, n, s, d, q);
    }
  }

  /// Cholesky's factors in place; false where the neighbours do not determine the unknowns.
  KOKKOS_INLINE_FUNCTION static bool factorise(Fit &fit)
  {
    constexpr double least_pivot = 0.05; // of the diagonal; 0.75 inside a regular mesh, none where a side is missing
    for (int i = 0; i < 5; ++i)
    {
      double const diagonal = fit.matrix[i][i];
      for (int j = 0; j <= i; ++j)
      {
        double sum = fit.matrix[i][j];
        for (int k = 0; k < j; ++k)
          sum -= fit.matrix[i][k] * fit.matrix[j][k];
        if (j < i)
          fit.matrix[i][j] = sum / fit.matrix[j][j];
        else if (!(sum > least_pivot * diagonal))
          return false;
        else
          fit.matrix[i][i] = Math::sqrt(sum);
      }
    }
    return true;
  }

  KOKKOS_INLINE_FUNCTION static void solve(Fit &fit)
  {
    for (int i = 0; i < 5; ++i)
    {
      for (int k = 0; k < i; ++k)
        addTimes(fit.right[i], -fit.matrix[i][k], fit.right[k]);
      scale(fit.right[i], 1.0 / fit.matrix[i][i]);
    }
    for (int i = 4; i >= 0; --i)
    {
      for (int k = i + 1; k < 5; ++k)
        addTimes(fit.right[i], -fit.matrix[k][i], fit.right[k]);
      scale(fit.right[i], 1.0 / fit.matrix[i][i]);
    }
  }

  KOKKOS_INLINE_FUNCTION static void scale(StageFields &a, double s)
  {
    a.record *= FieldPack(s);
    a.corner *= FieldPack(s);
  }

  /// Set the coefficients of x .. yy of eight fields, limited, and c[0] so that the mean stays.
  /// \param m Means of the monomials, with the weights of the fields.
  KOKKOS_INLINE_FUNCTION static void limit(MovedVertices const &v, bool to_range, FieldPack const (&m)[num_monomials],
                                           FieldPack const &q, FieldPack const &lower, FieldPack const &upper,
                                           FieldPack (&c)[num_monomials])
  {
    for (int p = 0; p < FieldPack::parts; ++p)
    {
      Pack a[num_monomials];
      for (int i = 1; i < num_monomials; ++i)
        a[i] = c[i].part[p];
      if (to_range)
        limitPart(v, m, p, q.part[p], lower.part[p], upper.part[p], a);
      Pack shift = 0.0;
      for (int i = 1; i < num_monomials; ++i)
      {
        shift += a[i] * m[i].part[p];
        c[i].part[p] = a[i];
      }
      c[0].part[p] = q.part[p] - shift;
    }
  }

  /// The largest part, at most all, of deviations between least and most that keeps them within range.
  KOKKOS_INLINE_FUNCTION static Pack partWithin(Pack const &least, Pack const &most, Pack const &q, Pack const &lower,
                                                Pack const &upper)
  {
    Pack const above = upper - q, below = lower - q;
    auto const high = most > above;
    auto const low = below > least;
    Pack const up = select(high, Pack(above / select(high, most, Pack(1.0))), Pack(1.0));
    Pack const down = select(low, Pack(below / select(low, least, Pack(1.0))), Pack(1.0));
    return Math::max(Math::min(up, down), Pack(0.0));
  }

  /// Bounds of the quadratic over the polygon: its Bezier ordinates for all pairs of vertices. Scaled as a whole, or
  /// the gradient alone where more of that is left.
  KOKKOS_INLINE_FUNCTION static void limitPart(MovedVertices const &v, FieldPack const (&m)[num_monomials], int p,
                                               Pack const &q, Pack const &lower, Pack const &upper,
                                               Pack (&a)[num_monomials])
  {
    Pack const linear = a[1] * m[1].part[p] + a[2] * m[2].part[p];
    Pack const whole = linear + a[3] * m[3].part[p] + a[4] * m[4].part[p] + a[5] * m[5].part[p];
    Pack least = 0.0, most = 0.0, least_linear = 0.0, most_linear = 0.0;
    for (int i = 0; i < v.size; ++i)
    {
      Pack const at = Pack(v.x[i]) * a[1] + Pack(v.y[i]) * a[2] - linear;
      least_linear = Math::min(least_linear, at);
      most_linear = Math::max(most_linear, at);
      for (int j = 0; j <= i; ++j)
      {
        Pack const both_ends = Pack(0.5 * (v.x[i] + v.x[j])) * a[1] + Pack(0.5 * (v.y[i] + v.y[j])) * a[2] +
                               Pack(v.x[i] * v.x[j]) * a[3] + Pack(0.5 * (v.x[i] * v.y[j] + v.x[j] * v.y[i])) * a[4] +
                               Pack(v.y[i] * v.y[j]) * a[5] - whole;
        least = Math::min(least, both_ends);
        most = Math::max(most, both_ends);
      }
    }
    Pack const of_all = partWithin(least, most, q, lower, upper);
    Pack const of_linear = partWithin(least_linear, most_linear, q, lower, upper);
    auto const drop = of_linear > of_all;
    Pack const s_g = select(drop, of_linear, of_all), s_h = select(drop, Pack(0.0), of_all);
    a[1] = s_g * a[1];
    a[2] = s_g * a[2];
    for (int i = 3; i < num_monomials; ++i)
      a[i] = s_h * a[i];
  }

  /// The same-material neighbours of a donor, and the donor itself at the end.
  struct Ring
  {
    int size = 0;
    int cell[most_ring];
    Vector2 offset[most_ring];         // of the centroids
    StageFields difference[most_ring]; // from the donor
  };

  KOKKOS_INLINE_FUNCTION void gatherRing(int cell, int material, Vector2 const &centroid, StageFields const &q,
                                         Ring &ring) const
  {
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      int const neighbour = in.mesh.cell_neighbour.item(j);
      int const index = classes.interface_index(neighbour);
      int const rotation = in.links.rotation(j);
      Neighbour n;
      if (ring.size + 1 == most_ring ||
          !(index >= 0 ? fromDonor(index, material, rotation, n) : fromCell(neighbour, material, rotation, n)))
        continue;
      ring.cell[ring.size] = neighbour;
      ring.offset[ring.size] = n.centroid - centroid;
      ring.difference[ring.size++] = n.value - q;
    }
    ring.cell[ring.size] = cell;
    ring.offset[ring.size] = {0.0, 0.0};
    ring.difference[ring.size++] = stageFields(0.0);
  }

  /// G_n = (1/A_n) contour integral of f dS over the polygon of the centroids around a node; false with less than
  /// three of them.
  KOKKOS_INLINE_FUNCTION bool nodeGradient(Ring const &ring, int node, Vector2 const &x, StageFields (&g)[2]) const
  {
    int around[most_ring], size = 0;
    double angle[most_ring];
    for (int i = 0; i < ring.size; ++i)
    {
      bool touches = false;
      for (int k = 0; k < 4; ++k)
        touches = touches || in.mesh.cell_node(ring.cell[i], k) == node;
      if (!touches)
        continue;
      Vector2 const d = ring.offset[i] - x;
      double const turn = Math::atan2(d[1], d[0]);
      int place = size++;
      for (; place > 0 && angle[place - 1] > turn; --place)
      {
        angle[place] = angle[place - 1];
        around[place] = around[place - 1];
      }
      angle[place] = turn;
      around[place] = i;
    }
    double area = 0.0;
    g[0] = g[1] = stageFields(0.0);
    for (int i = 0; i < size; ++i)
    {
      int const a = around[i], b = around[i + 1 < size ? i + 1 : 0];
      Vector2 const edge = ring.offset[b] - ring.offset[a];
      area += 0.5 * cross(ring.offset[a], ring.offset[b]);
      addTimes(g[0], 0.5 * edge[1], ring.difference[a]);
      addTimes(g[0], 0.5 * edge[1], ring.difference[b]);
      addTimes(g[1], -0.5 * edge[0], ring.difference[a]);
      addTimes(g[1], -0.5 * edge[0], ring.difference[b]);
    }
    if (size < 3 || !(area > 0.0))
      return false;
    scale(g[0], 1.0 / area);
    scale(g[1], 1.0 / area);
    return true;
  }

  /// G_e = (1/A_e) sum of A_n G_n over the quarters of the moved cell, H_e = (1/A_e) contour integral of G_n dS
  /// (Dukowicz & Kodis 1987). False where a node has less than three same-material cells around.
  KOKKOS_INLINE_FUNCTION bool contour(int donor, int cell, StageFields const &before, Polynomial &p) const
  {
    Vector2 const centroid{donors.shape(donor, 1), donors.shape(donor, 2)};
    Ring ring;
    gatherRing(cell, donors.head(donor).material, centroid, before, ring);
    Vector2 x[4], centre{0.0, 0.0};
    StageFields g[4][2];
    for (int k = 0; k < 4; ++k)
    {
      int const node = in.mesh.cell_node(cell, k);
      x[k] = in.startNode(node) + in.displacement(in.pairs.dof_node(donors.head(donor).pair, k)) - centroid;
      centre += 0.25 * x[k];
      if (!nodeGradient(ring, node, x[k], g[k]))
        return false;
    }
    double const area = 0.5 * cross(x[2] - x[0], x[3] - x[1]);
    double const per_area = 1.0 / area;
    for (int i = 1; i < num_monomials; ++i)
      p.c[i] = stageFields(0.0);
    for (int k = 0; k < 4; ++k)
    {
      int const next = (k + 1) & 3;
      Vector2 const after = 0.5 * (x[k] + x[next]), behind = 0.5 * (x[k] + x[(k + 3) & 3]);
      double const quarter = 0.5 * per_area * cross(centre - x[k], behind - after);
      addTimes(p.c[1], quarter, g[k][0]);
      addTimes(p.c[2], quarter, g[k][1]);
      Vector2 const edge = (0.5 * per_area) * (x[next] - x[k]);
      for (int end : {k, next})
      {
        addTimes(p.c[3], 0.5 * edge[1], g[end][0]);
        addTimes(p.c[4], -0.5 * edge[0], g[end][0]);
        addTimes(p.c[4], 0.5 * edge[1], g[end][1]);
        addTimes(p.c[5], -0.5 * edge[0], g[end][1]);
      }
    }
    return true;
  }

  /// Unlimited coefficients of x .. yy: of the fit, or of the linear gradient where it fails.
  KOKKOS_INLINE_FUNCTION void coefficients(int donor, int cell, StageFields const &before, Gradient const &g,
                                           Polynomial &p) const
  {
    if (in.options.hessian == RemapHessian::Contour)
    {
      if (contour(donor, cell, before, p))
        return;
      p.c[1] = g.x;
      p.c[2] = g.y;
      for (int i = 3; i < num_monomials; ++i)
        p.c[i] = stageFields(0.0);
      return;
    }
    Fit fit;
    fit.h2 = donors.shape(donor, 0);
    fit.xx = donors.shape(donor, 3) / fit.h2;
    fit.xy = donors.shape(donor, 4) / fit.h2;
    fit.yy = donors.shape(donor, 5) / fit.h2;
    gather(fit, cell, donors.head(donor).material, {donors.shape(donor, 1), donors.shape(donor, 2)}, before);
    bool const fitted = factorise(fit);
    if (!fitted)
    {
      p.c[1] = g.x;
      p.c[2] = g.y;
      return;
    }
    solve(fit);
    double const per_h = 1.0 / Math::sqrt(fit.h2), per_h2 = 1.0 / fit.h2;
    for (int i = 0; i < 5; ++i)
    {
      scale(fit.right[i], i < 2 ? per_h : per_h2);
      p.c[1 + i] = fit.right[i];
    }
  }

  /// Of a moving donor of `cell`; vertices about its centroid.
  KOKKOS_INLINE_FUNCTION Polynomial polynomial(int donor, int cell, MovedVertices const &v) const
  {
    Polynomial p = constant(loadStageFields(&donors.value(donor, 0)));
    StageFields const &q = p.mean;
    Gradient g;
    FaceNeighbours beyond;
    StageFields const before = donorGradient(donor, cell, q, g, beyond);
    coefficients(donor, cell, before, g, p);
    if (in.options.limiter == RemapLimiter::VanLeer)
      limitVanLeer(beyond, p);
    bool const to_range = limitsToRange(cell);

    // By volume: density for good, and what does not matter of the others.
    QuarticMoments const whole = wholeMoments(donor, v);
    FieldPack record[num_monomials], corner[num_monomials], by_volume[num_monomials];
    for (int i = 0; i < num_monomials; ++i)
    {
      record[i] = p.c[i].record;
      corner[i] = p.c[i].corner;
      by_volume[i] = FieldPack(whole.value[i] / whole.volume());
    }
    FieldPack density[num_monomials];
    for (int i = 0; i < num_monomials; ++i)
      density[i] = record[i];
    limit(v, to_range, by_volume, q.record, g.lower.record, g.upper.record, density);
    for (int i = 0; i < num_monomials; ++i)
      p.c[i].record = density[i];
    double w[num_monomials];
    massMoments(p.c, whole, w);
    FieldPack of_record[num_monomials], of_corner[num_monomials];
    for (int i = 0; i < num_monomials; ++i)
    {
      of_record[i] = fieldWeights(whole.value[i] / whole.volume(), w[i] / w[0]);
      of_corner[i] = FieldPack(w[i] / w[0]);
    }
    limit(v, to_range, of_record, q.record, g.lower.record, g.upper.record, record);
    limit(v, to_range, of_corner, q.corner, g.lower.corner, g.upper.corner, corner);
    for (int i = 0; i < num_monomials; ++i)
      p.c[i] = {record[i], corner[i]};
    return p;
  }

  /// The gradient's part for all: s_H = s_G.
  KOKKOS_INLINE_FUNCTION static void limitVanLeer(FaceNeighbours const &beyond, Polynomial &p)
  {
    for (int part = 0; part < FieldPack::parts; ++part)
    {
      Pack const of_record =
          PolynomialFinder::vanLeerPart(beyond, false, part, p.c[1].record.part[part], p.c[2].record.part[part]);
      Pack const of_corner =
          PolynomialFinder::vanLeerPart(beyond, true, part, p.c[1].corner.part[part], p.c[2].corner.part[part]);
      for (int i = 1; i < num_monomials; ++i)
      {
        p.c[i].record.part[part] = of_record * p.c[i].record.part[part];
        p.c[i].corner.part[part] = of_corner * p.c[i].corner.part[part];
      }
    }
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
