// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NORMAL_FIT_HPP
#define HARMOS_NORMAL_FIT_HPP

#include <Harmos_LaneMoves.hpp>
#include <Harmos_Vector.hpp>

namespace Harmos
{

/// Most segments that one fit takes (7 x 7 cells hold about 30 of both sides around a simple interface); a whole number
/// of packs.
constexpr int max_fit_samples = 192;

/// One segment near the point where the contact normal is wanted; lengths in cells.
struct FitSample
{
  Vector2 offset; // of its midpoint from the point
  Vector2 normal; // unit, from material a to material b on both sides
  double length;
  double weight; // fitWeight
  double gap;    // to what it faces
  int side;      // 0: of a, 1: of b
};

/// The samples of both sides, by component, in the order in which they came.
struct FitSamples
{
  static constexpr int room = max_fit_samples + pack_width; // pushPack writes whole packs
  int count = 0;
  double x[room], y[room], normal_x[room], normal_y[room], length[room], weight[room], gap[room];
  double of_b[room]; // 1 on side b, 0 on side a

  /// False, and no change, when there is no room.
  KOKKOS_INLINE_FUNCTION bool push(FitSample const &s)
  {
    if (count == max_fit_samples)
      return false;
    set(count++, s);
    return true;
  }

  /// Sample j, seen in a mirror and with a part of its weight, as number `to` (at most j).
  KOKKOS_INLINE_FUNCTION void mirror(int j, int to, Vector2 const &its_offset, Vector2 const &its_normal, double part)
  {
    set(to, {its_offset, its_normal, length[j], part * weight[j], gap[j], of_b[j] > 0.5 ? 1 : 0});
  }

  /// The chosen lanes of a pack of samples, as far as there is room.
  KOKKOS_FORCEINLINE_FUNCTION void pushPack(unsigned lanes, Pack const &its_x, Pack const &its_y,
                                            Pack const &its_normal_x, Pack const &its_normal_y, Pack const &its_length,
                                            Pack const &its_weight, Pack const &its_gap, Pack const &its_side)
  {
    LaneCompressor const chosen(lanes);
    int const at = count;
    storePack(x + at, chosen(its_x));
    storePack(y + at, chosen(its_y));
    storePack(normal_x + at, chosen(its_normal_x));
    storePack(normal_y + at, chosen(its_normal_y));
    storePack(length + at, chosen(its_length));
    storePack(weight + at, chosen(its_weight));
    storePack(gap + at, chosen(its_gap));
    storePack(of_b + at, chosen(its_side));
    count = Math::min(max_fit_samples, at + chosen.count);
  }

  /// Behind the last sample the pack is filled with samples of no weight.
  KOKKOS_INLINE_FUNCTION void fillPack()
  {
    for (int j = count; j < numPacks(count) * pack_width; ++j)
      set(j, {{0.0, 0.0}, {0.0, 0.0}, 0.0, 0.0, 0.0, 0});
  }

private:
  KOKKOS_INLINE_FUNCTION void set(int j, FitSample const &s)
  {
    x[j] = s.offset[0];
    y[j] = s.offset[1];
    normal_x[j] = s.normal[0];
    normal_y[j] = s.normal[1];
    length[j] = s.length;
    weight[j] = s.weight;
    gap[j] = s.gap;
    of_b[j] = s.side;
  }
};

constexpr double fit_reach = 3.0; // distance from which on segments have no weight [cells]

/// Base weight L (1 - d^2/9)_+^2 of segments at distance d. [cells]
KOKKOS_INLINE_FUNCTION Pack fitWeight(Pack const &length, Pack const &distance_squared)
{
  Pack const kernel = Math::max(Pack(0.0), Pack(1.0) - distance_squared / Pack(fit_reach * fit_reach));
  return length * kernel * kernel;
}

/// From 0 at part <= 0 to 1 at part >= 1, with no slope at either.
KOKKOS_INLINE_FUNCTION double smoothStep(double part)
{
  double const p = Math::clamp(part, 0.0, 1.0);
  return p * p * (3.0 - 2.0 * p);
}

/// How far an interface goes on smoothly as its image beyond a mirror: 1 where it meets that at a right angle, 0 where
/// it has a kink there. An arc through both legs of a kink would lean to their mean.
///
/// On a circle whose centre is on the mirror the part s = n . wall of the normal is x / R at the distance x from it: of
/// the line s = s_0 + k x through the samples on this side, by least squares with the weights L (1 - x^2/9)_+^2, s_0 is
/// the sine of the kink. Chords that have moved are rough: |s_0| up to four times the root mean square r of what they
/// are off the line is none, from eight times on it is one, with 4 r at least 0.015 and at most 0.06 (0.06
/// of fewer than three samples).
///
/// \param samples Before any image is added. \param wall Unit normal of the mirror, away from them.
/// \param distance Of the point from the mirror. [cells]
/// \param along Unit vector, of the segment and the one that it faces: of two faces that of one side counts.
KOKKOS_INLINE_FUNCTION double smoothnessAt(FitSamples const &samples, Vector2 const &wall, double distance,
                                           Vector2 const &along)
{
  constexpr double roughness = 4.0, least = 0.015, most = 0.06; // sines that are no kink
  constexpr double steepest = 0.7, least_spread = 0.05;        // the last in cells^2
  Vector2 const tangent = perpendicular(wall);
  double w = 0.0, wx = 0.0, wxx = 0.0, ws = 0.0, wxs = 0.0, wss = 0.0;
  int count = 0;
  for (int j = 0; j < samples.count; ++j)
  {
    Vector2 const normal{samples.normal_x[j], samples.normal_y[j]};
    double const x = distance - (samples.x[j] * wall[0] + samples.y[j] * wall[1]), s = dot(normal, wall);
    double const kernel = 1.0 - x * x / (fit_reach * fit_reach);
    if (!(kernel > 0.0) || Math::fabs(s) > steepest || !(dot(normal, tangent) * dot(along, tangent) > 0.0))
      continue;
    double const weight = samples.length[j] * kernel * kernel;
    w += weight;
    wx += weight * x;
    wxx += weight * x * x;
    ws += weight * s;
    wxs += weight * x * s;
    wss += weight * s * s;
    ++count;
  }
  if (!(w > 0.0))
    return 0.0;
  double const x = wx / w, s = ws / w, spread = wxx / w - x * x;
  double const slope = spread > least_spread ? (wxs / w - x * s) / spread : 0.0;
  double const off = Math::max(wss / w - s * s - slope * slope * spread, 0.0); // squared
  double const smooth = count < 3 ? most : Math::clamp(roughness * Math::sqrt(off), least, most);
  return 1.0 - smoothStep(Math::fabs(s - slope * x) / smooth - 1.0);
}

/// What the samples' gaps leave of their base weights w_j:
///
///   (1 - theta) / (1 + (g_j/0.3)^2) + theta / (1 + (g_j/0.003)^2),
///
/// theta from 0 to 1 (smoothly) as what touches, sum_j w_j / (1 + (g_j/0.003)^2), goes from 1.5 to 3 cells of both
/// sides.
///
/// Where enough of both sides lies on each other it alone tells the normal: the sides of a wedge that opens beside it
/// lean by what the wedge opens, and a force along their mean brakes what slides. Corners that touch in a short piece,
/// and what has still to come, have the slopes of what is open near by.
KOKKOS_INLINE_FUNCTION void weighByGaps(FitSamples &s)
{
  constexpr double least_closed = 1.5, closed = 3.0; // weighted lengths [cells]
  Pack const one = 1.0, per_open = 1.0 / 0.3, per_closed = 1.0 / 0.003;
  Pack sum = 0.0;
  for (int j = 0; j < s.count; j += pack_width)
  {
    Pack const g = loadPack(s.gap + j) * per_closed;
    sum += loadPack(s.weight + j) / (one + g * g);
  }
  Pack const theta = smoothStep((laneSum(sum) - least_closed) / (closed - least_closed));
  for (int j = 0; j < s.count; j += pack_width)
  {
    Pack const gap = loadPack(s.gap + j), g = gap * per_open, c = gap * per_closed;
    storePack(s.weight + j, loadPack(s.weight + j) * ((one - theta) / (one + g * g) + theta / (one + c * c)));
  }
}

/// One pass of the fit: weighted least-squares parabolas y = alpha_s + beta t + gamma_s t^2 / 2 of the two sides s, in
/// the frame (t, n).
struct ParabolaFit
{
  double alpha[2] = {0.0, 0.0};
  double beta = 0.0;
  double gamma[2] = {0.0, 0.0};
};

constexpr double fit_least_cosine = 0.7; // segments (and rows) that are tilted more against the normal are left out

/// The samples in the frame of one pass: positions, heights, projected lengths squared over 12, and slopes.
struct FitFrame
{
  double t[max_fit_samples], y[max_fit_samples], spread[max_fit_samples], slope[max_fit_samples];
  double taken[max_fit_samples]; // 1, or 0 for those that are left out
  double omega[max_fit_samples]; // robust factor of the weight
};

/// Moments of one side's samples, what the normal equations are made of: sums of w, w t, w q, w y, and with products of
/// two also those of the slopes' terms, q = (t^2 + spread) / 2.
struct SideMoments
{
  double w, t, q, y, tt, tq, qq, ty, qy;
};

struct FitMoments
{
  SideMoments side[2]; // of a, of b
};

/// Place the samples in the frame of n, and add up their moments.
/// \param weighed Whether the robust factors are known; else they are one.
KOKKOS_INLINE_FUNCTION FitMoments fitMoments(FitSamples const &s, Vector2 const &n, bool weighed, FitFrame &frame)
{
  constexpr int moments = 9, room = 24; // of a side; of both, in whole packs
  Pack const nx = n[0], ny = n[1];
  Pack sum[room];
  HARMOS_UNROLL
  for (int k = 0; k < room; ++k)
    sum[k] = 0.0;
  for (int j = 0; j < s.count; j += pack_width)
  {
    Pack const x = loadPack(s.x + j), z = loadPack(s.y + j);
    Pack const normal_x = loadPack(s.normal_x + j), normal_y = loadPack(s.normal_y + j);
    Pack const along = normal_x * nx + normal_y * ny, t = x * ny - z * nx, y = x * nx + z * ny;
    Pack const projected = loadPack(s.length + j) * along;
    Pack const spread = projected * projected * Pack(1.0 / 12.0);
    // The line's tangent is -perpendicular(normal) seen along t; those that are left out must not divide by zero.
    Pack const slope = (normal_y * nx - normal_x * ny) / Math::max(along, Pack(0.5 * fit_least_cosine));
    Pack const taken = select(Pack(fit_least_cosine) <= along, Pack(1.0), Pack(0.0));
    storePack(frame.t + j, t);
    storePack(frame.y + j, y);
    storePack(frame.spread + j, spread);
    storePack(frame.slope + j, slope);
    storePack(frame.taken + j, taken);
    Pack w = loadPack(s.weight + j) * taken;
    if (weighed)
      w = w * loadPack(frame.omega + j);
    Pack const q = Pack(0.5) * (t * t + spread), u = Pack(0.1) * spread, ut = u * t;
    Pack const term[moments] = {Pack(1.0),         t, q, y, t * t + u, t * q + ut, q * q + ut * t, t * y + u * slope,
                                q * y + ut * slope};
    Pack const of_b = w * loadPack(s.of_b + j), of_a = w - of_b;
    HARMOS_UNROLL
    for (int k = 0; k < moments; ++k)
    {
      sum[k] += of_a * term[k];
      sum[moments + k] += of_b * term[k];
    }
  }
  double m[room];
  laneSums(sum, m);
  return {{{m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]},
           {m[9], m[10], m[11], m[12], m[13], m[14], m[15], m[16], m[17]}}};
}

/// Minimise sum w omega (r^2 + 0.1 spread d^2) + kappa sum_s W_s gamma_s^2 with
/// r = y - alpha_s - beta t - gamma_s (t^2 + spread) / 2, d = slope - beta - gamma_s t, W_s = sum w omega of side s.
///
/// Offsets and curvatures of the sides are eliminated first; unknowns without a pivot are zero.
KOKKOS_INLINE_FUNCTION ParabolaFit fitParabola(FitMoments const &m, double kappa)
{
  constexpr double no_pivot = 1e-300;
  double of_alpha[2], of_gamma[2], tq[2], qy[2], bb = 0.0, b = 0.0;
  for (int side = 0; side < 2; ++side)
  {
    SideMoments const &s = m.side[side];
    of_alpha[side] = s.w > no_pivot ? 1.0 / s.w : 0.0;
    double const t = s.t * of_alpha[side], q = s.q * of_alpha[side];
    double const qq = s.qq - q * s.q + kappa * s.w;
    tq[side] = s.tq - t * s.q;
    qy[side] = s.qy - q * s.y;
    of_gamma[side] = qq > no_pivot ? 1.0 / qq : 0.0;
    double const l = tq[side] * of_gamma[side];
    bb += s.tt - t * s.t - l * tq[side];
    b += s.ty - t * s.y - l * qy[side];
  }
  ParabolaFit fit;
  fit.beta = bb > no_pivot ? b / bb : 0.0;
  for (int side = 0; side < 2; ++side)
  {
    SideMoments const &s = m.side[side];
    fit.gamma[side] = (qy[side] - tq[side] * fit.beta) * of_gamma[side];
    fit.alpha[side] = (s.y - s.t * fit.beta - s.q * fit.gamma[side]) * of_alpha[side];
  }
  return fit;
}

/// Squared misfits r^2 + spread d^2 of the samples (fitParabola), pack by pack.
struct SquaredMisfit
{
  FitSamples const &sample;
  FitFrame const &frame;
  Pack beta, alpha, more_alpha, gamma, more_gamma; // more: of side b

  KOKKOS_INLINE_FUNCTION SquaredMisfit(FitSamples const &samples, FitFrame const &of, ParabolaFit const &fit)
      : sample(samples), frame(of), beta(fit.beta), alpha(fit.alpha[0]), more_alpha(fit.alpha[1] - fit.alpha[0]),
        gamma(fit.gamma[0]), more_gamma(fit.gamma[1] - fit.gamma[0])
  {
  }

  /// Of samples j and following.
  KOKKOS_FORCEINLINE_FUNCTION Pack operator()(int j) const
  {
    Pack const t = loadPack(frame.t + j), spread = loadPack(frame.spread + j), of_b = loadPack(sample.of_b + j);
    Pack const curvature = gamma + of_b * more_gamma;
    Pack const r =
        loadPack(frame.y + j) - (alpha + of_b * more_alpha) - beta * t - Pack(0.5) * curvature * (t * t + spread);
    Pack const d = loadPack(frame.slope + j) - beta - curvature * t;
    return r * r + spread * d * d;
  }
};

/// Robust factors omega of the samples in the next pass; returns the weighted sum of their squared misfits.
KOKKOS_INLINE_FUNCTION double reweigh(FitSamples const &s, ParabolaFit const &fit, FitFrame &frame)
{
  SquaredMisfit const squared(s, frame, fit);
  Pack const largest = 0.25, one = 1.0; // the first of a squared misfit
  Pack misfit = 0.0;
  for (int j = 0; j < s.count; j += pack_width)
  {
    Pack const e2 = select(Pack(0.0) < loadPack(frame.taken + j), squared(j), largest);
    storePack(frame.omega + j, one / (one + e2 * Pack(1.0 / (0.025 * 0.025))));
    misfit += loadPack(s.weight + j) * Math::min(e2, largest);
  }
  return laneSum(misfit);
}

/// A normal and how well the samples that it takes lie on its parabola.
struct NormalGuess
{
  Vector2 normal;
  double misfit; // mean squared, of all samples [cells^2]
};

/// How far the samples lie to one side of the point: 0 where they lie all around, to 1 where the interface ends there
/// (smoothly, as the mean of t goes from half of its standard deviation to all of it).
KOKKOS_INLINE_FUNCTION double oneSided(FitMoments const &m)
{
  constexpr double around = 0.5, least_spread = 1e-12;
  double const w = m.side[0].w + m.side[1].w;
  if (!(w > 0.0))
    return 0.0;
  double const mean = (m.side[0].t + m.side[1].t) / w;
  double const spread = Math::max((m.side[0].tt + m.side[1].tt) / w - mean * mean, least_spread);
  return smoothStep((Math::fabs(mean) / Math::sqrt(spread) - around) / (1.0 - around));
}

/// kappa of a pass, how much curvatures are held back.
///
/// Next to nothing between solids: more flattens arcs, and where samples lie more to one side than to the other the
/// slope turns with what the curvature lacks. At an end of the interface (the rim of an impact) a curvature is
/// extrapolated, and some of that is left. Where samples scatter the more the flatter.
///
/// \param rough  As of fitNormal.
/// \param misfit Mean squared, of the pass before. [cells^2]
KOKKOS_INLINE_FUNCTION double curvatureRidge(FitMoments const &m, bool rough, int pass, double misfit)
{
  constexpr double light = 1e-3, at_ends = 0.03;
  constexpr double first_rough = 0.1, least_rough = 9e-4, rough_misfit = 0.1; // the last in cells
  if (!rough)
    return light + at_ends * oneSided(m);
  return pass == 1 ? first_rough : Math::clamp(misfit / (rough_misfit * rough_misfit), least_rough, 1.0);
}

/// Three passes of the fit from a first normal, two where the first leaves next to no misfit.
/// \param total Of the weights.
/// \param rough As of fitNormal.
KOKKOS_INLINE_FUNCTION NormalGuess turnNormal(FitSamples const &samples, Vector2 n, double total, bool rough,
                                              FitFrame &frame)
{
  // Weights then hardly differ from one: a third pass turned normals by 1e-10 at most.
  constexpr double next_to_none = 1e-3; // root mean square misfit [cells]
  int passes = 3;
  double last_misfit = 0.0;
  for (int pass = 1; pass <= passes; ++pass)
  {
    FitMoments const m = fitMoments(samples, n, pass > 1, frame);
    ParabolaFit const fit = fitParabola(m, curvatureRidge(m, rough, pass, last_misfit));
    if (pass < passes)
    {
      double const misfit = reweigh(samples, fit, frame);
      last_misfit = misfit / total;
      if (misfit <= next_to_none * next_to_none * total)
        passes = 2;
    }
    double const beta = Math::clamp(fit.beta, -1.0, 1.0);
    n = normalised(n + beta * perpendicular(n)); // n - beta t with t = -perpendicular(n)
  }
  return {n, last_misfit};
}

/// Whether the samples that lie within 45 degrees of a normal are a smooth face that tells it: a cell of them, all but
/// a hundredth on their sides' parabolas to 3e-3 cells.
KOKKOS_INLINE_FUNCTION bool isFace(FitSamples const &samples, Vector2 const &n, FitFrame &frame)
{
  constexpr double least_weight = 1.0, most_miss = 3e-3, most_off = 0.01, ridge = 0.1;
  ParabolaFit const fit = fitParabola(fitMoments(samples, n, false, frame), ridge);
  SquaredMisfit const squared(samples, frame, fit);
  Pack const most = most_miss * most_miss, zero = 0.0;
  Pack all = zero, beside = zero;
  for (int j = 0; j < samples.count; j += pack_width)
  {
    Pack const weight = loadPack(samples.weight + j) * loadPack(frame.taken + j);
    all += weight;
    beside += select(most < squared(j), weight, zero);
  }
  double const taken = laneSum(all), off = laneSum(beside);
  return taken >= least_weight && off <= most_off * taken;
}

/// Samples that look the other way are of another face: the far side of a layer or a wedge that lies inside of the
/// other material. With it the mean would be next to nothing, and along whatever is left. Where they weigh more than
/// twice what looks along it is the segment itself that looks the wrong way.
///
/// \param along Unit vector, of the segment and the one that it faces.
KOKKOS_INLINE_FUNCTION void dropOpposed(FitSamples &s, Vector2 const &along)
{
  Pack const x = along[0], y = along[1], zero = 0.0;
  Pack alike = zero, opposed = zero;
  for (int j = 0; j < s.count; j += pack_width)
  {
    Pack const cosine = loadPack(s.normal_x + j) * x + loadPack(s.normal_y + j) * y, weight = loadPack(s.weight + j);
    alike += select(Pack(fit_least_cosine) <= cosine, weight, zero);
    opposed += select(cosine <= Pack(-fit_least_cosine), weight, zero);
  }
  double const most = laneSum(opposed);
  if (!(most > 0.0) || laneSum(alike) < 0.5 * most)
    return;
  for (int j = 0; j < s.count; j += pack_width)
  {
    Pack const cosine = loadPack(s.normal_x + j) * x + loadPack(s.normal_y + j) * y;
    storePack(s.weight + j, select(Pack(-fit_least_cosine) < cosine, loadPack(s.weight + j), zero));
  }
}

/// \brief Normal of the interface between two materials at a point, from the segments of both around it.
///
/// Robust local parabolas of the two sides, that share their slope, each with its own offset and curvature (of a disc
/// on a flat face they differ). Three passes: fit, turn the frame by the slope beta (|beta| <= 1), reweigh. Two where
/// the first one leaves next to no misfit. Before them samples that look the other way are left out (dropOpposed), and
/// the weights follow the gaps (weighByGaps). They begin with the samples' mean normal.
///
/// \param samples  Segments around the point; those of zero weight count for nothing. Its weights are changed.
/// \param fallback Unit vector, of the segment and the one that it faces; returned when the samples have no mean normal
///                 (no sample at all).
/// \param rough Of what scatters: the thin outlines of fluids, and a side alone around a corner (curvatureRidge).
///              Beside a corner of one body inside of another the mean is that of both faces: where it leaves a large
///              misfit, and what lies within 45 degrees of `fallback` is a smooth face (isFace), the passes begin with
///              that one.
/// \return Unit normal from a to b.
KOKKOS_INLINE_FUNCTION Vector2 fitNormal(FitSamples &samples, Vector2 const &fallback, bool rough = false)
{
  constexpr double large_misfit = 0.05; // root mean square [cells]
  samples.fillPack();
  dropOpposed(samples, fallback);
  weighByGaps(samples);
  Pack mean_x = 0.0, mean_y = 0.0, weights = 0.0;
  for (int j = 0; j < samples.count; j += pack_width)
  {
    Pack const w = loadPack(samples.weight + j), length = loadPack(samples.length + j);
    Pack const of_normal = w * length * length;
    mean_x += of_normal * loadPack(samples.normal_x + j);
    mean_y += of_normal * loadPack(samples.normal_y + j);
    weights += w;
  }
  Vector2 const mean{laneSum(mean_x), laneSum(mean_y)};
  double const total = laneSum(weights);
  if (!(norm(mean) > 0.0))
    return fallback;
  FitFrame frame;
  NormalGuess const guess = turnNormal(samples, normalised(mean), total, rough, frame);
  if (rough && guess.misfit > large_misfit * large_misfit && isFace(samples, fallback, frame))
    return turnNormal(samples, fallback, total, rough, frame).normal;
  return guess.normal;
}

} // namespace Harmos

#endif
