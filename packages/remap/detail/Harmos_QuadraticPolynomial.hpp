// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_QUADRATIC_POLYNOMIAL_HPP
#define HARMOS_QUADRATIC_POLYNOMIAL_HPP

#include <detail/Harmos_DonorPolynomial.hpp>
#include <detail/Harmos_OverlayMoments.hpp>
#include <detail/Harmos_QuadraticFit.hpp>

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
  CornerShift shift;            // no offset where the corner velocities are quadratic
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
/// over distance squared. A second derivative that the neighbours do not determine is zero; the linear gradient remains
/// where they do not determine that.
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
    p.shift = {{0.0, 0.0}, 0.0};
    return p;
  }

  KOKKOS_INLINE_FUNCTION OverlayMoments wholeMoments(int donor, MovedVertices const &v) const
  {
    return measuredBy(donors.head(donor).measure, momentsOfVertices<OverlayMoments>(v.size, v.x, v.y));
  }

  /// Density and deviator by volume, the others by mass.
  KOKKOS_INLINE_FUNCTION static StageFields integrate(Polynomial const &p, OverlayMoments const &m, bool largest)
  {
    double w[num_monomials];
    massMoments(p.c, m, w);
    StageFields out = stageFields(0.0);
    for (int i = 0; i < num_monomials; ++i)
    {
      out.record += p.c[i].record * fieldWeights(m.value[i], w[i]);
      out.corner += p.c[i].corner * FieldPack(w[i]);
    }
    Vector2 const shifted = p.shift.moment(w[0], largest);
    out.corner += p.c[1].corner * FieldPack(shifted[0]) + p.c[2].corner * FieldPack(shifted[1]);
    return out;
  }

  /// Of a neighbour.
  KOKKOS_INLINE_FUNCTION Spread spreadOf(int cell, int index, int material, Vector2 const &centroid) const
  {
    int const donor = index < 0 ? -1 : donors.find(index, material);
    if (donor >= 0 && donors.head(donor).kind == MovingDonor)
      return spreadOf(donor);
    int const pair = donor < 0 ? in.pairs.offset(cell) : donors.head(donor).pair;
    Region const region = in.regions.region(in.mesh, in.pairs, pair);
    Moments<2> const m = moments<2>(region, region[0], areaWeight(in.mesh.geometry, region[0]));
    Vector2 const d = m.centroid();
    return {centroid,
            {m.second(0, 0) / m.volume() - d[0] * d[0], m.second(0, 1) / m.volume() - d[0] * d[1],
             m.second(1, 1) / m.volume() - d[1] * d[1]}};
  }

  KOKKOS_INLINE_FUNCTION Spread spreadOf(int donor) const
  {
    Spread s{{donors.shape(donor, 1), donors.shape(donor, 2)}, {}};
    for (int i = 0; i < 3; ++i)
      s.second[i] = donors.shape(donor, 3 + i) / donors.shape(donor, 0);
    return s;
  }

  /// \return Whether all neighbours are full.
  KOKKOS_INLINE_FUNCTION bool gather(QuadraticFit<StageFields> &fit, int cell, int donor, StageFields const &q) const
  {
    int const material = donors.head(donor).material;
    bool full = true;
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      Neighbour n;
      if (!findNeighbour(j, material, n))
        continue;
      int const neighbour = in.mesh.cell_neighbour.item(j);
      fit.add(spreadOf(neighbour, classes.interface_index(neighbour), material, n.centroid), n.filled, n.value - q);
      full = full && n.filled == 1.0;
    }
    forImages(cell, donor, q,
              [&](Neighbour const &n, int j, MirrorImage const &image)
              {
                Spread s = spreadOf(donor);
                if (j >= 0)
                {
                  int const neighbour = in.mesh.cell_neighbour.item(j);
                  s = spreadOf(neighbour, classes.interface_index(neighbour), material, n.centroid);
                }
                s.centroid = n.centroid;
                for (int i = 0; i < image.count; ++i)
                  mirrorTensor(image.normal[i], s.second[0], s.second[1], s.second[2]);
                fit.add(s, n.filled, n.value - q);
              });
    return full;
  }

  /// Means of the monomials over a part of a donor, by volume and by mass.
  struct MonomialMeans
  {
    double by_volume[num_monomials], by_mass[num_monomials], mass;

    KOKKOS_INLINE_FUNCTION FieldPack ofRecord(int i) const { return fieldWeights(by_volume[i], by_mass[i]); }
    KOKKOS_INLINE_FUNCTION FieldPack ofCorner(int i) const { return FieldPack(by_mass[i]); }
  };

  /// With a density whose coefficients are in c.
  KOKKOS_INLINE_FUNCTION static MonomialMeans means(StageFields const (&c)[num_monomials], OverlayMoments const &m)
  {
    MonomialMeans out;
    double w[num_monomials];
    massMoments(c, m, w);
    out.mass = w[0];
    for (int i = 0; i < num_monomials; ++i)
    {
      out.by_volume[i] = m.value[i] / m.volume();
      out.by_mass[i] = w[i] / w[0];
    }
    return out;
  }

  /// What a limiter keeps of gradients and Hessians, field by field.
  struct KeptParts
  {
    FieldPack gradient{1.0}, hessian{1.0};
  };

  /// The means of all parts stay within range: all of the polynomial is scaled, or the gradient alone where more of
  /// that is left.
  KOKKOS_INLINE_FUNCTION static KeptParts partsWithin(Deviations const &all, Deviations const &linear,
                                                      FieldPack const &q, FieldPack const &lower,
                                                      FieldPack const &upper)
  {
    KeptParts kept;
    for (int p = 0; p < FieldPack::parts; ++p)
    {
      Pack const of_all =
          partWithin<Pack>(all.least.part[p], all.most.part[p], q.part[p], lower.part[p], upper.part[p]);
      Pack const of_linear =
          partWithin<Pack>(linear.least.part[p], linear.most.part[p], q.part[p], lower.part[p], upper.part[p]);
      auto const drop = of_linear > of_all;
      kept.gradient.part[p] = select(drop, of_linear, of_all);
      kept.hessian.part[p] = select(drop, Pack(0.0), of_all);
    }
    return kept;
  }

  /// Limit all fields by the means of the parts, with the density of p.c: in the first call of `polynomial` those of
  /// the density itself are right.
  KOKKOS_INLINE_FUNCTION static void limitToRange(OverlayList<OverlayMoments> const &overlays, Polynomial const &p,
                                                  MonomialMeans const &whole, Gradient const &range,
                                                  StageFields (&c)[num_monomials])
  {
    Deviations record_all, record_linear, corner_all, corner_linear;
    int const largest = overlays.largest();
    for (int o = 0; o < overlays.parts(); ++o)
    {
      MonomialMeans const part = means(p.c, overlays.fieldMoments(o));
      Vector2 const shifted = (1.0 / part.mass) * p.shift.moment(part.mass, o == largest);
      FieldPack record(0.0), corner = c[1].corner * FieldPack(shifted[0]) + c[2].corner * FieldPack(shifted[1]);
      for (int i = 1; i < num_monomials; ++i)
      {
        record += c[i].record * (part.ofRecord(i) - whole.ofRecord(i));
        corner += c[i].corner * (part.ofCorner(i) - whole.ofCorner(i));
        if (i != 2)
          continue;
        record_linear.add(record);
        corner_linear.add(corner);
      }
      record_all.add(record);
      corner_all.add(corner);
    }
    KeptParts const of_record =
        partsWithin(record_all, record_linear, p.mean.record, range.lower.record, range.upper.record);
    KeptParts const of_corner =
        partsWithin(corner_all, corner_linear, p.mean.corner, range.lower.corner, range.upper.corner);
    for (int i = 1; i < num_monomials; ++i)
    {
      c[i].record *= i < 3 ? of_record.gradient : of_record.hessian;
      c[i].corner *= i < 3 ? of_corner.gradient : of_corner.hessian;
    }
  }

  /// c[0] such that the mean stays.
  KOKKOS_INLINE_FUNCTION static void keepMean(StageFields const &mean, MonomialMeans const &whole,
                                              StageFields (&c)[num_monomials])
  {
    c[0] = mean;
    for (int i = 1; i < num_monomials; ++i)
    {
      c[0].record -= c[i].record * whole.ofRecord(i);
      c[0].corner -= c[i].corner * whole.ofCorner(i);
    }
  }

  /// The same-material neighbours of a donor, and the donor itself at the end.
  struct Ring
  {
    int size = 0;
    bool full = true; // all neighbours are
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
      ring.full = ring.full && n.filled == 1.0;
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
  /// \param[out] full Whether all neighbours are.
  KOKKOS_INLINE_FUNCTION bool contour(int donor, int cell, StageFields const &before, Polynomial &p, bool &full) const
  {
    Vector2 const centroid{donors.shape(donor, 1), donors.shape(donor, 2)};
    Ring ring;
    gatherRing(cell, donors.head(donor).material, centroid, before, ring);
    full = ring.full;
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

  /// Unlimited coefficients of x .. yy: of the fit, or of the linear gradient where it fails. Corner velocities that
  /// lie about the cells' centres, where one of the cells is not full, are linear (CornerShift): about the centroids of
  /// what fills them they are too steep, and what turns gains energy.
  ///
  /// \return Whether the corner velocities are quadratic.
  KOKKOS_INLINE_FUNCTION bool coefficients(int donor, int cell, StageFields const &before, Gradient const &g,
                                           Polynomial &p) const
  {
    bool full = true, solved = false;
    if (in.options.hessian == RemapHessian::Contour)
      solved = contour(donor, cell, before, p, full);
    else
    {
      QuadraticFit<StageFields> fit(spreadOf(donor), donors.shape(donor, 0));
      full = gather(fit, cell, donor, before);
      solved = fit.solve();
      for (int i = 0; i < 5 && solved; ++i)
        p.c[1 + i] = fit.right[i];
    }
    full = full && in.pairs.cell_kind(cell) == PureCell;
    if (solved && full)
      return true;
    p.c[1] = {solved ? p.c[1].record : g.x.record, g.x.corner};
    p.c[2] = {solved ? p.c[2].record : g.y.record, g.y.corner};
    for (int i = 3; i < num_monomials; ++i)
    {
      p.c[i].corner = FieldPack(0.0);
      if (!solved)
        p.c[i].record = FieldPack(0.0);
    }
    return false;
  }

  /// Of a moving donor of `cell`.
  KOKKOS_INLINE_FUNCTION Polynomial polynomial(int donor, int cell, OverlayList<OverlayMoments> const &overlays) const
  {
    Polynomial p = constant(loadStageFields(&donors.value(donor, 0)));
    Gradient g;
    FaceNeighbours beyond;
    StageFields const before = donorGradient(donor, cell, p.mean, g, beyond);
    bool const quadratic = coefficients(donor, cell, before, g, p);
    if (in.options.limiter == RemapLimiter::VanLeer)
      limitVanLeer(beyond, p);
    bool const to_range = limitsToRange();

    // The density first: it weighs the primitives.
    StageFields c[num_monomials];
    for (int i = 0; i < num_monomials; ++i)
      c[i] = p.c[i];
    MonomialMeans const by_volume = means(p.c, overlays.whole);
    if (to_range)
      limitToRange(overlays, p, by_volume, g, p.c);
    keepMean(p.mean, by_volume, p.c);
    MonomialMeans const by_mass = means(p.c, overlays.whole);
    if (!quadratic)
      p.shift = {Vector2{donors.shape(donor, 1), donors.shape(donor, 2)} +
                     Vector2{by_mass.by_mass[1], by_mass.by_mass[2]} - cellCentre(donor),
                 by_mass.mass};
    if (to_range)
      limitToRange(overlays, p, by_mass, g, c);
    keepMean(p.mean, by_mass, c);
    for (int i = 0; i < num_monomials; ++i)
      p.c[i] = c[i];
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

/// The same where areas are weighted by the radius: rings. Means and second moments of the fit are those of the rings,
/// so that it stays exact for quadratics; the products of density and primitives take plane moments to the fifth.
struct RingQuadraticFinder : QuadraticFinder
{
  using PlaneMoments = QuinticMoments;

  KOKKOS_INLINE_FUNCTION explicit RingQuadraticFinder(PolynomialFinder const &finder) : QuadraticFinder(finder) {}
  KOKKOS_INLINE_FUNCTION static OverlayMoments measured(PlaneMoments const &m, double radius)
  {
    return ringMoments(m, radius);
  }
  KOKKOS_INLINE_FUNCTION OverlayMoments wholeMoments(int donor, MovedVertices const &v) const
  {
    return measuredBy(donors.head(donor).measure,
                      ringMoments(momentsOfVertices<QuinticMoments>(v.size, v.x, v.y), donors.shape(donor, 1)));
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
