// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FACING_SEGMENTS_HPP
#define HARMOS_FACING_SEGMENTS_HPP

#include <Harmos_MirroredSamples.hpp>
#include <Harmos_NormalFit.hpp>
#include <Harmos_RayCast.hpp>
#include <Harmos_SlipMirrors.hpp>

namespace Harmos
{

/// What a fit reads of a facing segment, in columns; lengths in the mesh's unit.
enum FacingColumn : int
{
  FacingX,
  FacingY,
  FacingNormalX,
  FacingNormalY,
  FacingLength,
  FacingGap,
  FacingCellX,
  FacingCellY,
  FacingMaterial, // exact integers
  FacedMaterial,  // of what it faces
  num_facing_columns
};

/// The segments whose normals may serve a fit: those that face another one, near enough to parallel.
struct FacingSegments
{
  SegmentBins bins;       // of these alone
  View<double **> column; // num_facing_columns x segments in the order of the bins, and room for a last pack
};

/// \param hit Of the segments' rays.
FacingSegments facingSegments(View<InterfaceSegment *> const &segment, View<RayHit *> const &hit,
                              SegmentBins const &bins, WorkArrays const &work = {});

/// A segment as the images of others see it.
KOKKOS_INLINE_FUNCTION InterfaceSegment mirrored(InterfaceSegment s, MirrorImage const &image)
{
  s.midpoint = image.point(s.midpoint);
  s.point = image.point(s.point);
  s.normal = image.direction(s.normal);
  s.cell_centre = image.point(s.cell_centre);
  for (Vector2 &along : s.lattice)
    along = image.direction(along);
  return s;
}

/// Gathers the samples of a fit at a segment's point, pack by pack.
struct SampleGatherer
{
  FacingSegments const &facing;
  InterfaceSegment const &at;
  double material_a, material_b;
  double shortest; // of side b [cells]
  FitSamples &samples;

  KOKKOS_FORCEINLINE_FUNCTION Pack column(FacingColumn which, int i) const
  {
    return loadPack(&facing.column(which, i));
  }

  /// Cells from `at` to that of the samples, along direction d of the lattice.
  KOKKOS_FORCEINLINE_FUNCTION Pack cellsApart(Pack const &x, Pack const &y, int d) const
  {
    return Math::fabs(x * Pack(at.lattice[d][0]) + y * Pack(at.lattice[d][1]));
  }

  KOKKOS_INLINE_FUNCTION void operator()(int begin, int end) const
  {
    for (int i = begin; i < end; i += pack_width)
      take(i, end);
  }

  /// Samples from number `first` on, which were taken for the image of the point, as images around the point, with a
  /// part of their weights.
  KOKKOS_INLINE_FUNCTION void mirror(MirrorImage const &image, int first, double part) const
  {
    int kept = first;
    for (int j = first; j < samples.count; ++j)
    {
      Vector2 const offset{samples.x[j], samples.y[j]};
      if (image.reflects(at.point + at.cell_size * offset)) // which is where the segment is
        samples.mirror(j, kept++, image.direction(offset), image.direction({samples.normal_x[j], samples.normal_y[j]}),
                       part);
    }
    samples.count = kept;
  }

  KOKKOS_FORCEINLINE_FUNCTION void take(int i, int end) const
  {
    constexpr double most_apart = 3.5; // the 7 x 7 cells
    Pack const a = material_a, b = material_b, inverse_h = 1.0 / at.cell_size;
    Pack const material = column(FacingMaterial, i), faced = column(FacedMaterial, i);
    auto const of_a = both(material == a, faced == b);
    auto const of_b = both(both(material == b, faced == a), Pack(shortest * at.cell_size) <= column(FacingLength, i));
    Pack const x = inverse_h * (column(FacingX, i) - Pack(at.point[0]));
    Pack const y = inverse_h * (column(FacingY, i) - Pack(at.point[1]));
    Pack const distance_squared = x * x + y * y;
    Pack const length = inverse_h * column(FacingLength, i);
    Pack const weight = fitWeight(length, distance_squared);
    Pack const cell_x = column(FacingCellX, i) - Pack(at.cell_centre[0]);
    Pack const cell_y = column(FacingCellY, i) - Pack(at.cell_centre[1]);
    auto const near =
        both(cellsApart(cell_x, cell_y, 0) <= Pack(most_apart), cellsApart(cell_x, cell_y, 1) <= Pack(most_apart));
    auto const serves = both(both(either(of_a, of_b), near), both(weight > Pack(0.0), laneNumbers() < Pack(end - i)));
    unsigned const lanes = lanesOf(serves);
    if (lanes == 0u)
      return;
    Pack const outward = select(of_a, Pack(1.0), Pack(-1.0)); // of a
    samples.pushPack(lanes, x, y, outward * column(FacingNormalX, i), outward * column(FacingNormalY, i), length,
                     weight, inverse_h * column(FacingGap, i), select(of_a, Pack(0.0), Pack(1.0)));
  }
};

/// Length of the segments of two materials, both sides together, that lie on each other within two cells of a segment's
/// point. [cells]
/// \param mirrors Of the cell of s; images count.
KOKKOS_INLINE_FUNCTION double touchingLength(FacingSegments const &facing, SlipMirrors const &mirrors,
                                             InterfaceSegment const &s, int other)
{
  constexpr double reach = 2.0; // [cells]
  Vector2 const box{reach * s.cell_size, reach * s.cell_size};
  Pack const a = s.material, b = other, least = touching_gap * s.cell_size, zero = 0.0;
  Pack sum = 0.0;
  for (int image = -1; image < mirrors.count; ++image)
  {
    Vector2 const at = image < 0 ? s.point : mirrors.image[image].point(s.point);
    facing.bins.forEachRun(
        at - box, at + box,
        [&](int begin, int end)
        {
          for (int i = begin; i < end; i += pack_width)
          {
            Pack const x = loadPack(&facing.column(FacingX, i)) - Pack(at[0]);
            Pack const y = loadPack(&facing.column(FacingY, i)) - Pack(at[1]);
            Pack const of = loadPack(&facing.column(FacingMaterial, i));
            Pack const faced = loadPack(&facing.column(FacedMaterial, i));
            auto const theirs = either(both(of == a, faced == b), both(of == b, faced == a));
            auto const near = both(x * x + y * y <= Pack(box[0] * box[0]), laneNumbers() < Pack(end - i));
            auto lies = both(theirs, loadPack(&facing.column(FacingGap, i)) <= least);
            if (image >= 0)
              lies = both(lies, mirrors.image[image].reflects(Pack(x + Pack(at[0])), Pack(y + Pack(at[1]))));
            sum += select(both(near, lies), loadPack(&facing.column(FacingLength, i)), zero);
          }
        });
  }
  return laneSum(sum) / s.cell_size;
}

/// Contact normal at a segment's point, from the segments of the two materials in the 7 x 7 cells around it.
/// `target` is what the ray of s (a segment or a part of one) meets, a segment of another material (no wall).
/// \param mirrors Of the cell of s: images beyond slip walls are samples too.
/// \param rough As of fitNormal.
KOKKOS_INLINE_FUNCTION Vector2 contactNormal(View<InterfaceSegment *> const &segment, FacingSegments const &facing,
                                             SlipMirrors const &mirrors, double shortest, InterfaceSegment const &s,
                                             int target, bool rough)
{
  FitSamples samples;
  Vector2 const reach{fit_reach * s.cell_size, fit_reach * s.cell_size};
  double const a = s.material, b = segment(target).material;
  facing.bins.forEachRun(s.point - reach, s.point + reach, SampleGatherer{facing, s, a, b, shortest, samples});
  Vector2 const along = normalised(s.normal - segment(target).normal);
  double part[SlipMirrors::most];
  smoothParts(mirrors, samples, s.point, s.cell_size, along, part);
  for (int i = 0; i < mirrors.count; ++i)
  {
    if (!(part[i] > 0.0))
      continue;
    InterfaceSegment const at = mirrored(s, mirrors.image[i]);
    SampleGatherer const gatherer{facing, at, a, b, shortest, samples};
    int const first = samples.count;
    facing.bins.forEachRun(at.point - reach, at.point + reach, gatherer);
    gatherer.mirror(mirrors.image[i], first, part[i]);
  }
  return fitNormal(samples, along, rough);
}

} // namespace Harmos

#endif
