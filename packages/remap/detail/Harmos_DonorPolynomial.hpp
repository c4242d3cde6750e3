// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DONOR_POLYNOMIAL_HPP
#define HARMOS_DONOR_POLYNOMIAL_HPP

#include <Harmos_AreaWeight.hpp>
#include <detail/Harmos_CornerFit.hpp>
#include <detail/Harmos_DonorNeighbours.hpp>
#include <detail/Harmos_OverlayList.hpp>
#include <detail/Harmos_RangeLimit.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// Corner velocities are fields of the cells, whatever part of a cell is filled: a linear one has its values at the
/// cells' centres. So their polynomial is about the centre of the donor's moved cell, not about what that part's
/// centroid makes of it, and the largest overlay takes the difference, which keeps the donor's momentum. What two
/// cells exchange across a face then has the same velocity both ways, halfway between them, as in stage 1.
struct CornerShift
{
  Vector2 offset; // of the mass centroid from the cell's centre
  double mass;    // of the donor

  /// To add to the integral of a part's mass times its distance from the mass centroid.
  KOKKOS_INLINE_FUNCTION Vector2 moment(double part_mass, bool largest) const
  {
    return (largest ? part_mass - mass : part_mass) * offset;
  }
};

/// Linear polynomials of a donor's fields: density and deviator about the centroid c, primitives about the mass
/// centroid c + e, corner velocities about the centre of its cell (CornerShift).
struct DonorPolynomial
{
  StageFields mean, x, y; // mean, gradient
  Vector2 slope;          // of the density, by which masses are placed
  Vector2 mass_offset;    // e
  CornerShift shift;

  // The limiter's, where it is one of range. Each overlay's deviation from the mean is brought between `least` and
  // `most` by itself; `part` of it is left, so far that the largest overlay, which takes what the others leave, is
  // within range too. So an overlay counts by what it takes (SweptFluxFunctor::keepWithin).
  bool to_range;
  StageFields least, most, part;
  StageFields of_largest; // its deviation
};

KOKKOS_INLINE_FUNCTION DonorPolynomial constantPolynomial(StageFields const &mean)
{
  StageFields const zero = stageFields(0.0);
  return {mean, zero, zero, {0.0, 0.0}, {0.0, 0.0}, {{0.0, 0.0}, 0.0}, false, zero, zero, zero, zero};
}

/// Vertices relative to the donor's centroid.
struct MovedVertices
{
  int size;
  double x[max_region_vertices], y[max_region_vertices];
};

KOKKOS_INLINE_FUNCTION MovedVertices verticesAbout(Region const &region, Vector2 const &centre)
{
  MovedVertices v;
  v.size = region.size;
  for (int i = 0; i < region.size; ++i)
  {
    v.x[i] = region[i][0] - centre[0];
    v.y[i] = region[i][1] - centre[1];
  }
  return v;
}

/// Weights of a linear polynomial's mean and gradient in its integrals over a part of a donor: by volume, by mass.
struct LinearWeights
{
  double volume, mass;
  Vector2 by_volume, by_mass; // of the gradients
};

/// Finds polynomials: gradients from least squares over the same-material pairs of the vertex neighbours, limited
/// in the mean of every overlay to their range (DonorPolynomial).
///
/// Gradients of the corner velocities come from velocities before stage 1, so that they need no wider halo.
struct PolynomialFinder : DonorNeighbours
{
  using Polynomial = DonorPolynomial;
  using OverlayMoments = Moments<2>;
  using PlaneMoments = Moments<2>; // what an overlay is integrated by
  static KOKKOS_INLINE_FUNCTION constexpr bool overlaysInPacks() { return true; }

  KOKKOS_INLINE_FUNCTION static Polynomial constant(StageFields const &mean) { return constantPolynomial(mean); }

  /// The moments of an overlay, plane ones about the donor's centroid at `radius` given.
  KOKKOS_INLINE_FUNCTION static OverlayMoments const &measured(PlaneMoments const &m, double) { return m; }

  KOKKOS_INLINE_FUNCTION OverlayMoments wholeMoments(int donor, MovedVertices const &) const
  {
    OverlayMoments m;
    for (int i = 0; i < OverlayMoments::count; ++i)
      m.value[i] = i == 1 || i == 2 ? 0.0 : donors.shape(donor, i);
    return m;
  }

  /// Of a density rho + g.d, mass centroid at e, over a part with moments V, S, T about the donor's centroid:
  /// mass = rho V + g.S; gradients by mass: rho S + T g - e mass.
  KOKKOS_INLINE_FUNCTION static LinearWeights weights(double rho, Vector2 const &g, Vector2 const &e,
                                                      OverlayMoments const &m)
  {
    LinearWeights w;
    w.volume = m.volume();
    w.mass = rho * m.volume() + (g[0] * m.first(0) + g[1] * m.first(1));
    w.by_volume = {m.first(0), m.first(1)};
    w.by_mass = {rho * m.first(0) + (m.second(0, 0) * g[0] + m.second(0, 1) * g[1]) - e[0] * w.mass,
                 rho * m.first(1) + (m.second(0, 1) * g[0] + m.second(1, 1) * g[1]) - e[1] * w.mass};
    return w;
  }

  /// Deviations of the means over a part from the donor's, before any limiter.
  KOKKOS_INLINE_FUNCTION static StageFields deviations(Polynomial const &p, LinearWeights const &w, bool largest)
  {
    double const per_volume = 1.0 / w.volume, per_mass = 1.0 / w.mass;
    Vector2 const v = per_volume * w.by_volume, m = per_mass * w.by_mass;
    Vector2 const c = m + per_mass * p.shift.moment(w.mass, largest);
    return {p.x.record * fieldWeights(v[0], m[0]) + p.y.record * fieldWeights(v[1], m[1]),
            p.x.corner * FieldPack(c[0]) + p.y.corner * FieldPack(c[1])};
  }

  /// Of a part that is not the largest, each within range.
  KOKKOS_INLINE_FUNCTION static StageFields boundedDeviations(Polynomial const &p, LinearWeights const &w)
  {
    StageFields const d = deviations(p, w, false);
    return {greater(p.least.record, lesser(d.record, p.most.record)),
            greater(p.least.corner, lesser(d.corner, p.most.corner))};
  }

  /// Integrals of the donor's fields over one overlay: density and deviator by volume, primitives phi as rho phi.
  KOKKOS_INLINE_FUNCTION static StageFields integrate(Polynomial const &p, OverlayMoments const &m, bool largest)
  {
    LinearWeights const w = weights(p.mean.record[DensityField], p.slope, p.mass_offset, m);
    StageFields d;
    if (!p.to_range)
      d = deviations(p, w, largest);
    else if (largest)
      d = p.of_largest;
    else
    {
      d = boundedDeviations(p, w);
      d.record *= p.part.record;
      d.corner *= p.part.corner;
    }
    double const mass = w.volume * (p.mean.record[DensityField] + d.record[DensityField]);
    return {(p.mean.record + d.record) * fieldWeights(w.volume, mass), (p.mean.corner + d.corner) * FieldPack(mass)};
  }

  struct Gradient
  {
    StageFields x, y, lower, upper;
  };

  /// What Van Leer's limiter compares with: same-material pairs beyond the faces.
  struct FaceNeighbours
  {
    int size = 0;
    Vector2 offset[4];
    StageFields difference[4];
  };

  /// Least-squares gradients over the same-material neighbours and their images: of the corner velocities between the
  /// cells' centres, of the others between the centroids. Widens the range by the neighbours' values.
  KOKKOS_INLINE_FUNCTION void gradient(int cell, int donor, StageFields const &q, Gradient &g,
                                       FaceNeighbours &beyond) const
  {
    LinearFit of_record;
    CornerFit of_corner;
    Vector2 const centroid{donors.shape(donor, 1), donors.shape(donor, 2)}, centre = cellCentre(donor);
    auto const add = [&](Neighbour const &n, bool beyond_face)
    {
      Vector2 const d = n.centroid - centroid;
      if (!(dot(d, d) > 0.0))
        return;
      StageFields const difference = n.value - q;
      of_record.add(d, n.filled, difference.record);
      of_corner.add(n.centre - centre, n.filled, difference.corner);
      if (in.options.limiter == RemapLimiter::VanLeer && beyond_face && beyond.size < 4)
      {
        beyond.offset[beyond.size] = n.centroid - centroid; // not d: GCC 12 takes it for dangling
        beyond.difference[beyond.size++] = n.value - q;
      }
      g.lower = {lesser(g.lower.record, n.value.record), lesser(g.lower.corner, n.value.corner)};
      g.upper = {greater(g.upper.record, n.value.record), greater(g.upper.corner, n.value.corner)};
    };
    int const material = donors.head(donor).material;
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      Neighbour n;
      if (findNeighbour(j, material, n))
        add(n, isBeyondFace(cell, in.mesh.cell_neighbour.item(j)));
    }
    forImages(cell, donor, q,
              [&](Neighbour const &n, int j, MirrorImage const &image) { add(n, j < 0 && image.count == 1); });
    of_record.solve(g.x.record, g.y.record);
    of_corner.solve(g.x.corner, g.y.corner);
    Vector2 corner[4];
    for (int k = 0; k < 4; ++k)
      corner[k] = in.startNode(in.mesh.cell_node(cell, k));
    double linear[2] = {0.0, 0.0};
    if (in.materials(donors.head(donor).material).strength != StrengthKind::None)
      of_corner.linearity(corner, q.corner, g.x.corner, g.y.corner, linear);
    shareRange(q.corner, linear, g.lower.corner, g.upper.corner);
  }

  /// The largest part of gradients, at most all, that halfway to each neighbour keeps the values between theirs.
  KOKKOS_INLINE_FUNCTION static Pack vanLeerPart(FaceNeighbours const &beyond, bool corner, int p, Pack const &gx,
                                                 Pack const &gy)
  {
    Pack part = 1.0;
    for (int k = 0; k < beyond.size; ++k)
    {
      FieldPack const &all = corner ? beyond.difference[k].corner : beyond.difference[k].record;
      Pack const difference = all.part[p];
      Pack const rise = 0.5 * (Pack(beyond.offset[k][0]) * gx + Pack(beyond.offset[k][1]) * gy);
      auto const outside = rise * (difference - rise) < Pack(0.0);
      part = Math::min(part, select(outside, Pack(difference / select(outside, rise, Pack(1.0))), Pack(1.0)));
    }
    return Math::max(part, Pack(0.0));
  }

  KOKKOS_INLINE_FUNCTION static void limitVanLeer(FaceNeighbours const &beyond, bool corner, FieldPack &gx,
                                                  FieldPack &gy)
  {
    for (int p = 0; p < FieldPack::parts; ++p)
    {
      Pack const part = vanLeerPart(beyond, corner, p, gx.part[p], gy.part[p]);
      gx.part[p] = part * gx.part[p];
      gy.part[p] = part * gy.part[p];
    }
  }

  KOKKOS_INLINE_FUNCTION bool limitsToRange() const
  {
    return in.options.limiter == RemapLimiter::Range || in.options.limiter == RemapLimiter::RangeInside;
  }

  /// Deviations of the parts' means from the donor's.
  struct Deviations
  {
    FieldPack least{0.0}, most{0.0};

    KOKKOS_FORCEINLINE_FUNCTION void add(FieldPack const &d)
    {
      least = lesser(least, d);
      most = greater(most, d);
    }
  };

  /// What of the density's deviations the limiter leaves: the factor of all, and of what the parts take on the whole.
  struct DensityParts
  {
    double part, slope;
  };

  KOKKOS_INLINE_FUNCTION static DensityParts densityParts(OverlayList<OverlayMoments> const &overlays, double rho,
                                                          Vector2 const &g, double lower, double upper)
  {
    int const largest = overlays.largest();
    double rest = 0.0, left = 0.0, all = 0.0;
    for (int o = 0; o < overlays.parts(); ++o)
    {
      if (o == largest)
        continue;
      OverlayMoments const m = overlays.fieldMoments(o);
      double const whole = (g[0] * m.first(0) + g[1] * m.first(1)) / m.volume();
      double const bounded = Math::max(lower - rho, Math::min(whole, upper - rho));
      rest -= m.volume() * bounded;
      left += m.volume() * Math::fabs(bounded);
      all += m.volume() * Math::fabs(whole);
    }
    rest /= overlays.fieldMoments(largest).volume();
    double const part = partWithin<double>(Math::min(rest, 0.0), Math::max(rest, 0.0), rho, lower, upper);
    return {part, all > 0.0 ? part * (left / all) : part};
  }

  /// The factor that keeps a deviation within range.
  KOKKOS_INLINE_FUNCTION static FieldPack partsWithin(FieldPack const &deviation, FieldPack const &q,
                                                      FieldPack const &lower, FieldPack const &upper)
  {
    FieldPack part;
    for (int p = 0; p < FieldPack::parts; ++p)
      part.part[p] = partWithin<Pack>(Math::min(deviation.part[p], Pack(0.0)), Math::max(deviation.part[p], Pack(0.0)),
                                      q.part[p], lower.part[p], upper.part[p]);
    return part;
  }

  /// Limit all fields to range; `density` is the factor of the density's deviations.
  KOKKOS_INLINE_FUNCTION static void limitToRange(OverlayList<OverlayMoments> const &overlays, Gradient const &range,
                                                  double density, Polynomial &p)
  {
    p.to_range = true;
    p.least = range.lower - p.mean;
    p.most = range.upper - p.mean;
    double const rho = p.mean.record[DensityField];
    int const largest = overlays.largest();
    StageFields rest = stageFields(0.0);
    double rest_mass = rho * overlays.whole.volume();
    for (int o = 0; o < overlays.parts(); ++o)
    {
      if (o == largest)
        continue;
      LinearWeights const w = weights(rho, p.slope, p.mass_offset, overlays.fieldMoments(o));
      StageFields const d = boundedDeviations(p, w);
      double const mass = w.volume * (rho + density * d.record[DensityField]);
      rest.record -= d.record * fieldWeights(w.volume, mass);
      rest.corner -= d.corner * FieldPack(mass);
      rest_mass -= mass;
    }
    double const volume = overlays.fieldMoments(largest).volume();
    rest.record *= fieldWeights(1.0 / volume, 1.0 / rest_mass);
    rest.corner *= FieldPack(1.0 / rest_mass);
    p.part.record = partsWithin(rest.record, p.mean.record, range.lower.record, range.upper.record);
    p.part.corner = partsWithin(rest.corner, p.mean.corner, range.lower.corner, range.upper.corner);
    p.of_largest = {rest.record * p.part.record, rest.corner * p.part.corner};
  }

  /// The gradient of a donor of mean q, not yet limited; the range g starts with its values before and after stage 1.
  /// It does not reach down to round-off of the donor's density, the mass of whose parts would have either sign.
  /// \return Its mean before stage 1: differences of corner velocities are taken between like times.
  KOKKOS_INLINE_FUNCTION StageFields donorGradient(int donor, int cell, StageFields const &q, Gradient &g,
                                                   FaceNeighbours &beyond) const
  {
    StageFields const before{q.record, FieldPack(&donors.half(donor, 0))};
    g.lower = {q.record, lesser(q.corner, before.corner)};
    g.upper = {q.record, greater(q.corner, before.corner)};
    gradient(cell, donor, before, g, beyond);
    for (int k = 0; in.ranges.extent(0) > 0 && k < 4; ++k)
      if (fieldsEndAt(cell, k))
        widenBeyond(cell, (k + 2) % 4, donors.head(donor).material, before, g);
    g.lower.record.set<DensityField>(Math::max(g.lower.record[DensityField], least_part * q.record[DensityField]));
    return before;
  }

  KOKKOS_INLINE_FUNCTION static void widenFields(FieldPack const &q, FieldPack const &opposite, double const *least,
                                                 double const *largest, FieldPack &lower, FieldPack &upper)
  {
    FieldPack const low(least), high(largest);
    for (int p = 0; p < FieldPack::parts; ++p)
      widenByMirrored<Pack>(q.part[p], opposite.part[p], low.part[p], high.part[p], lower.part[p], upper.part[p]);
  }

  /// Widen the range of a cell at the boundary, which lies opposite of the given face.
  KOKKOS_INLINE_FUNCTION void widenBeyond(int cell, int face, int material, StageFields const &q, Gradient &g) const
  {
    int const opposite = in.mesh.face_neighbour(cell, face);
    Neighbour n;
    bool found = false;
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
      if (opposite >= 0 && in.mesh.cell_neighbour.item(j) == opposite / 4)
        found = findNeighbour(j, material, n);
    if (!found)
      return;
    double const *const least = &in.ranges(material, 0), *const largest = &in.ranges(material, num_stage_fields);
    widenFields(q.record, n.value.record, least, largest, g.lower.record, g.upper.record);
    widenFields(q.corner, n.value.corner, least + first_corner_field, largest + first_corner_field, g.lower.corner,
                g.upper.corner);
    double const as_is[2] = {0.0, 0.0};
    shareRange(q.corner, as_is, g.lower.corner, g.upper.corner);
  }

  /// Of a moving donor of `cell`.
  KOKKOS_INLINE_FUNCTION DonorPolynomial polynomial(int donor, int cell,
                                                    OverlayList<OverlayMoments> const &overlays) const
  {
    DonorPolynomial result = constantPolynomial(loadStageFields(&donors.value(donor, 0)));
    if (in.options.order == 1)
      return result;
    StageFields const &q = result.mean;
    Gradient g;
    FaceNeighbours beyond;
    donorGradient(donor, cell, q, g, beyond);
    if (in.options.limiter == RemapLimiter::VanLeer)
    {
      limitVanLeer(beyond, false, g.x.record, g.y.record);
      limitVanLeer(beyond, true, g.x.corner, g.y.corner);
    }
    double const rho = q.record[DensityField], volume = donors.shape(donor, 0);
    result.x = g.x;
    result.y = g.y;
    Vector2 const steep{g.x.record[DensityField], g.y.record[DensityField]};
    DensityParts density{1.0, 1.0};
    if (limitsToRange())
      density = densityParts(overlays, rho, steep, g.lower.record[DensityField], g.upper.record[DensityField]);
    Vector2 const slope = result.slope = density.slope * steep;
    double const per_mass = 1.0 / (rho * volume);
    Vector2 const e =
        result.mass_offset = {per_mass * (donors.shape(donor, 3) * slope[0] + donors.shape(donor, 4) * slope[1]),
                              per_mass * (donors.shape(donor, 4) * slope[0] + donors.shape(donor, 5) * slope[1])};
    Vector2 const mass_centroid = Vector2{donors.shape(donor, 1), donors.shape(donor, 2)} + e;
    result.shift = {mass_centroid - cellCentre(donor), rho * volume};
    if (limitsToRange())
      limitToRange(overlays, g, density.part, result);
    return result;
  }
};

/// The same where areas are weighted by the radius: rings.
struct RingPolynomialFinder : PolynomialFinder
{
  using PlaneMoments = Moments<3>;
  static KOKKOS_INLINE_FUNCTION constexpr bool overlaysInPacks() { return false; }

  KOKKOS_INLINE_FUNCTION explicit RingPolynomialFinder(PolynomialFinder const &finder) : PolynomialFinder(finder) {}
  KOKKOS_INLINE_FUNCTION static OverlayMoments measured(PlaneMoments const &m, double radius)
  {
    return weighted<2>(m, AreaWeight{radius, 1.0});
  }
};

} // namespace RemapDetail
} // namespace Harmos

#endif
