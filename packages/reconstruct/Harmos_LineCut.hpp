// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_LINE_CUT_HPP
#define HARMOS_LINE_CUT_HPP

#include <Harmos_AreaWeight.hpp>

namespace Harmos
{

/// A chord that divides a convex polygon. Below it lie the vertices first, next(first), ..., last.
struct LineCut
{
  double offset;      // dot(normal, x) = offset on the chord [length]
  Vector2 begin, end; // of the chord: on the edge that leaves `last`, on the edge that enters `first`
  int first, last;
  bool converged; // false: the volume lies outside [0, |polygon|]; the chord is then at the nearer end
};

namespace Detail
{

/// Between two heights of a convex polygon: the chord's width and the weight at its middle, both linear in the height.
struct WeightedSlab
{
  double height = 0.0, width_low = 0.0, width_high = 0.0, weight_low = 0.0, weight_high = 0.0;

  /// Weighted volume of the lower `part`, from 0 to 1.
  KOKKOS_INLINE_FUNCTION double volumeBelow(double part) const
  {
    double const dw = width_high - width_low, dg = weight_high - weight_low;
    return height * part *
           (width_low * weight_low +
            part * (0.5 * (dw * weight_low + dg * width_low) + part * (dw * dg * (1.0 / 3.0))));
  }

  /// The part below which a volume lies, 0 < volume <= volumeBelow(1): Newton's method from the root of the quadratic
  /// that leaves out the cubic's last term, by bisection where it leaves the bracket. It ends with a step whose square
  /// is round-off.
  KOKKOS_INLINE_FUNCTION double partOf(double volume) const
  {
    constexpr int max_iterations = 100;
    constexpr double last_step = 1e-9; // of the part
    double const dw = width_high - width_low, dg = weight_high - weight_low;
    double const start = height * width_low * weight_low, bend = 0.5 * height * (dw * weight_low + dg * width_low);
    double low = 0.0, high = 1.0;
    double part = 2.0 * volume / (start + Math::sqrt(Math::max(0.0, start * start + 4.0 * bend * volume)));
    if (!(part > low && part < high))
      part = 0.5;
    for (int i = 0; i < max_iterations; ++i)
    {
      double const excess = volumeBelow(part) - volume;
      (excess > 0.0 ? high : low) = part;
      double const slope = height * (width_low + part * dw) * (weight_low + part * dg);
      double next = slope > 0.0 ? part - excess / slope : 0.5 * (low + high);
      if (Math::fabs(next - part) <= last_step * part)
        return Math::clamp(next, 0.0, 1.0);
      if (!(next > low && next < high))
        next = 0.5 * (low + high);
      if (next == low || next == high)
        return next;
      part = next;
    }
    return part;
  }
};

/// See lineCut. \tparam Uniform The weight is one.
template <bool Uniform, int Capacity>
HARMOS_LARGE_FUNCTION LineCut weightedLineCut(Polygon<Capacity> const &polygon, Vector2 const &normal, double volume,
                                              AreaWeight const &weight)
{
  int const size = polygon.size;
  int low = 0;
  double least = 0.0;
  for (int i = 1; i < size; ++i)
  {
    double const height = dot(normal, polygon[i] - polygon[0]);
    if (height < least)
    {
      least = height;
      low = i;
    }
  }
  Vector2 const along = perpendicular(normal);
  double s[Capacity], t[Capacity];
  double highest = 0.0;
  for (int i = 0; i < size; ++i)
  {
    Vector2 const d = polygon[i] - polygon[low];
    s[i] = dot(normal, d);
    t[i] = dot(along, d);
    highest = Math::max(highest, s[i]);
  }

  auto const next = [size](int i) { return i + 1 == size ? 0 : i + 1; };
  auto const previous = [size](int i) { return i == 0 ? size - 1 : i - 1; };
  auto const at = [&s, &t](int from, int to, double height)
  {
    return s[to] <= height || s[to] <= s[from] ? t[to]
                                               : t[from] + (t[to] - t[from]) * ((height - s[from]) / (s[to] - s[from]));
  };
  // `right` climbs counter-clockwise, `left` clockwise; both are at or below `level`, the vertices after them above it.
  int right = low, left = low;
  double level = 0.0, width = 0.0, below = 0.0, middle = 0.0; // of the chord at `level`
  bool converged = volume >= 0.0;
  for (int step = 0; step < 2 * size; ++step)
  {
    int const right_next = next(right), left_next = previous(left);
    double const top = Math::max(level, Math::min(s[right_next], s[left_next]));
    double const end_left = at(left, left_next, top), end_right = at(right, right_next, top);
    double const width_top = Math::max(0.0, end_left - end_right);
    double const middle_top = 0.5 * (end_left + end_right);
    Detail::WeightedSlab weighted;
    if (!Uniform)
      weighted =
          Detail::WeightedSlab{top - level, width, width_top, weight.at(polygon[low] + level * normal + middle * along),
                               weight.at(polygon[low] + top * normal + middle_top * along)};
    double const slab = Uniform ? 0.5 * (width + width_top) * (top - level) : weighted.volumeBelow(1.0);
    if (below + slab >= volume || top >= highest)
    {
      double const missing = Math::min(Math::max(0.0, volume - below), slab);
      converged = converged && volume <= (below + slab) * (1.0 + 1e-13) + 1e-300;
      if (missing > 0.0 && !Uniform)
        level = Math::min(top, level + (top - level) * weighted.partOf(missing));
      else if (missing > 0.0)
      {
        double const slope = (width_top - width) / (top - level);
        double const root = Math::sqrt(Math::max(0.0, width * width + 2.0 * slope * missing));
        level = Math::min(top, level + 2.0 * missing / (width + root));
      }
      break;
    }
    below += slab;
    level = top;
    width = width_top;
    middle = middle_top;
    if (s[right_next] <= level)
      right = right_next;
    if (s[left_next] <= level)
      left = left_next;
  }

  auto const point = [&s, &polygon, level](int from, int to)
  {
    double const rise = s[to] - s[from];
    double const part = rise > 0.0 ? Math::clamp((level - s[from]) / rise, 0.0, 1.0) : 0.0;
    return part == 1.0 ? polygon[to] : polygon[from] + part * (polygon[to] - polygon[from]);
  };
  LineCut cut;
  cut.offset = dot(normal, polygon[low]) + level;
  cut.begin = point(right, next(right));
  cut.end = point(left, previous(left));
  cut.first = left;
  cut.last = right;
  cut.converged = converged;
  return cut;
}

} // namespace Detail

/// The chord of given normal that cuts a given volume off a convex polygon: V(d) = |polygon ∩ {n.x <= d}| = volume.
///
/// Closed form: between vertices, taken upwards along n on both chains at once, the chord's length w is linear and V
/// quadratic, V = V_a + w_a h + (1/2) w' h^2; its root h = 2 (V - V_a) / (w_a + sqrt(w_a^2 + 2 w' (V - V_a))) has no
/// cancellation. Heights count from the lowest vertex, so a small volume keeps its relative accuracy: cut the smaller
/// part and take the other as the complement.
///
/// With a weight that is linear in x[0], V is a cubic between vertices: it is the integral of width times the weight at
/// the chord's middle, a quadratic, for which Simpson's rule is exact; its root by Newton's method within a bracket.
///
/// \param polygon Convex, counter-clockwise, at least 3 vertices. [length]
/// \param normal  Unit vector that leaves the part of given volume.
/// \param volume  In [0, |polygon|], weighted. [length^2]
/// \param weight  Of area elements, >= 0 on the polygon, at points as the polygon's.
///
/// Scardovelli & Zaleski, J. Comput. Phys. 164 (2000) 228-237 for squares; here any convex polygon.
template <int Capacity>
HARMOS_LARGE_FUNCTION LineCut lineCut(Polygon<Capacity> const &polygon, Vector2 const &normal, double volume,
                                      AreaWeight const &weight = {})
{
  return weight.uniform() ? Detail::weightedLineCut<true>(polygon, normal, volume, weight)
                          : Detail::weightedLineCut<false>(polygon, normal, volume, weight);
}

/// Append a vertex that differs from the last one.
template <int Capacity>
KOKKOS_INLINE_FUNCTION void pushDistinct(Polygon<Capacity> &polygon, Vector2 const &point)
{
  if (polygon.size > 0 && polygon[polygon.size - 1][0] == point[0] && polygon[polygon.size - 1][1] == point[1])
    return;
  polygon.push(point);
}

template <int Capacity>
KOKKOS_INLINE_FUNCTION void dropRepeatedEnd(Polygon<Capacity> &polygon)
{
  int const last = polygon.size - 1;
  if (last > 0 && polygon[0][0] == polygon[last][0] && polygon[0][1] == polygon[last][1])
    --polygon.size;
}

/// The part of the polygon below the chord. It shares the chord's end points with partAbove, bit for bit.
template <int Capacity>
HARMOS_LARGE_FUNCTION Region partBelow(Polygon<Capacity> const &polygon, LineCut const &cut)
{
  Region part;
  for (int i = cut.first;; i = polygon.next(i))
  {
    pushDistinct(part, polygon[i]);
    if (i == cut.last)
      break;
  }
  pushDistinct(part, cut.begin);
  pushDistinct(part, cut.end);
  dropRepeatedEnd(part);
  return part;
}

/// The part of the polygon above the chord.
template <int Capacity>
HARMOS_LARGE_FUNCTION Region partAbove(Polygon<Capacity> const &polygon, LineCut const &cut)
{
  Region part;
  pushDistinct(part, cut.begin);
  for (int i = polygon.next(cut.last); i != cut.first; i = polygon.next(i))
    pushDistinct(part, polygon[i]);
  pushDistinct(part, cut.end);
  dropRepeatedEnd(part);
  return part;
}

/// The part of a polygon behind a line whose normal leaves it.
struct PartBehind
{
  Region inside;
  Vector2 chord_begin, chord_end;
  Plane2 line;
  bool converged;
};

/// A polygon divided in two by a line.
struct Division : PartBehind
{
  Region outside;
};

namespace Detail
{

/// The smaller part is the one that is cut. \param outside The other part; not asked for: null.
KOKKOS_INLINE_FUNCTION void divide(Region const &polygon, Vector2 const &normal, double inside_volume,
                                   double outside_volume, AreaWeight const &weight, PartBehind &part, Region *outside)
{
  bool const cut_inside = inside_volume <= outside_volume;
  LineCut const cut =
      cut_inside ? lineCut(polygon, normal, inside_volume, weight) : lineCut(polygon, -normal, outside_volume, weight);
  part.inside = cut_inside ? partBelow(polygon, cut) : partAbove(polygon, cut);
  if (outside != nullptr)
    *outside = cut_inside ? partAbove(polygon, cut) : partBelow(polygon, cut);
  part.chord_begin = cut.begin;
  part.chord_end = cut.end;
  part.line = {normal, cut_inside ? cut.offset : -cut.offset};
  part.converged = cut.converged;
}

} // namespace Detail

/// Divide a convex polygon by a line of given normal into given volumes.
///
/// \param inside_volume, outside_volume Their sum is the polygon's (weighted) volume, to round-off. [length^2]
HARMOS_LARGE_FUNCTION Division divide(Region const &polygon, Vector2 const &normal, double inside_volume,
                                      double outside_volume, AreaWeight const &weight = {})
{
  Division division;
  Detail::divide(polygon, normal, inside_volume, outside_volume, weight, division, &division.outside);
  return division;
}

/// Of a division the part behind the line alone.
HARMOS_LARGE_FUNCTION PartBehind partBehind(Region const &polygon, Vector2 const &normal, double inside_volume,
                                            double outside_volume, AreaWeight const &weight = {})
{
  PartBehind part;
  Detail::divide(polygon, normal, inside_volume, outside_volume, weight, part, nullptr);
  return part;
}

} // namespace Harmos

#endif
