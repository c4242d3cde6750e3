// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_PartDonors.hpp>

#include <Harmos_AreaWeight.hpp>
#include <Harmos_Lens.hpp>
#include <Harmos_Moments.hpp>
#include <detail/Harmos_Overlays.hpp>
#include <detail/Harmos_RegionBounds.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

/// Regions at nodes whose materials move apart by less in the step stay as they are. [cell sizes]
constexpr double least_passing = 0.005;

/// Lenses of less stay: many a cell has some, and all of them together are next to nothing. [of the cell]
constexpr double least_lens = 1e-5;

/// Outlines this near run along each other, as those of cells that move along a line of the mesh do. [cell sizes]
constexpr double along = 1e-5;

/// Of what passes each other, over the line through a lens: tangent of the greatest angle. Steeper is an approach that
/// no row holds; it is for the next cycle's rows to see.
constexpr double steepest = 4.0;

/// Splinters of less hold next to nothing. [of the cell]
constexpr double least_fraction = 1e-4;

/// Edges that cross by less meet. [of the cell]
constexpr double least_fold = 1e-9;

/// What a region keeps of its area at least; else it stays as it is.
constexpr double least_kept = 0.1;

struct PartFunctor
{
  Input in;
  Classes classes;
  Donors donors;
  PartWork work;

  KOKKOS_INLINE_FUNCTION bool takesPart(int donor) const
  {
    bool const has_region = donors.head(donor).kind == MovingDonor || donors.head(donor).kind == QuietDonor;
    return has_region && in.state.record(donors.head(donor).pair, VolumeFraction) > least_fraction;
  }

  /// Arcs of a donor's outline, by the area of their lenses.
  struct Candidates
  {
    int size = 0;
    OutlineArc arc[2 * most_lenses];
    double area[2 * most_lenses];

    KOKKOS_INLINE_FUNCTION void add(OutlineArc const &its_arc, double its_area)
    {
      if (size == 2 * most_lenses)
        return;
      int place = size++;
      for (; place > 0 && area[place - 1] < its_area; --place)
      {
        arc[place] = arc[place - 1];
        area[place] = area[place - 1];
      }
      arc[place] = its_arc;
      area[place] = its_area;
    }
  };

  /// Displacement of a pair at a point of its cell, or near it.
  KOKKOS_INLINE_FUNCTION Vector2 displacementAt(int cell, int donor, Vector2 const &x) const
  {
    double N[4];
    shapeFunctionsAt(in.startQuadrilateral(cell), x, N);
    Vector2 u{0.0, 0.0};
    for (int k = 0; k < 4; ++k)
      u += N[k] * in.displacement(in.pairs.dof_node(donors.head(donor).pair, k));
    return u;
  }

  /// Whether two regions pass each other along their lens rather than run into each other across it.
  KOKKOS_INLINE_FUNCTION bool slides(int cell, int donor, int near, int other, Lens const &lens) const
  {
    Vector2 const middle = 0.5 * (lens.of_a.from + lens.of_a.to), chord = lens.of_a.to - lens.of_a.from;
    Vector2 const apart = displacementAt(near, other, middle) - displacementAt(cell, donor, middle);
    return Math::fabs(cross(chord, apart)) < steepest * Math::fabs(dot(chord, apart));
  }

  /// Arcs of a donor's outline that lie in another of the cell `near`. Whichever of the two asks, the lenses are those
  /// of the lower one with the other: both are cut along the same lines.
  KOKKOS_INLINE_FUNCTION void addArcs(int cell, int donor, int near, int other, Candidates &candidates) const
  {
    bool const first = donor < other;
    double const cell_area = in.mesh.cell_area(first ? cell : near);
    Lenses const lenses = lensesOf(donors.polygon(first ? donor : other), donors.polygon(first ? other : donor),
                                   along * Math::sqrt(cell_area));
    for (int i = 0; i < lenses.size; ++i)
    {
      Lens const &lens = lenses.lens[i];
      if (lens.area > least_lens * cell_area && slides(cell, donor, near, other, lens))
        candidates.add(first ? lens.of_a : lens.of_b, lens.area);
    }
  }

  KOKKOS_INLINE_FUNCTION void partDonor(int cell, int donor) const
  {
    work.parted(donor) = 0;
    if (!takesPart(donor))
      return;
    Region const &region = donors.polygon(donor);
    Bounds const bounds = boundsOf(region);
    int const material = donors.head(donor).material;
    bool const rough = work.rough(donor) != 0;
    Candidates candidates;
    forDonorsAround(in, classes, donors, cell,
                    [&](int near, int other)
                    {
                      if ((rough || work.rough(other) != 0) && takesPart(other) &&
                          donors.head(other).material != material &&
                          !bounds.with(boundsOf(donors.polygon(other))).empty())
                        addArcs(cell, donor, near, other, candidates);
                    });
    OutlineArcs arcs;
    for (int i = 0; i < candidates.size; ++i)
      arcs.add(candidates.arc[i], region.size);
    if (arcs.size == 0)
      return;
    Region &parted = work.polygon(donor);
    if (straightened(region, arcs, parted) && area(parted) > least_kept * area(region) &&
        volume(parted, in.mesh.geometry) > least_kept * donors.shape(donor, 0) &&
        !isFolded(parted, least_fold * in.mesh.cell_area(cell)))
      work.parted(donor) = 1;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const cell = classes.interface_cell(index);
    for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
      partDonor(cell, donor);
  }
};

/// Whether bodies pass each other at a node of the cell.
KOKKOS_INLINE_FUNCTION bool passes(Input const &in, int cell)
{
  double const least = least_passing * least_passing * in.mesh.cell_area(cell);
  for (int k = 0; k < 4; ++k)
  {
    int const node = in.mesh.cell_node(cell, k), end = in.dof_nodes.offset(node + 1);
    for (int a = in.dof_nodes.offset(node); a < end; ++a)
      for (int b = a + 1; b < end; ++b)
      {
        Vector2 const apart = in.displacement(b) - in.displacement(a);
        if (dot(apart, apart) > least)
          return true;
      }
  }
  return false;
}

/// Polygon, centroid and second moments of a parted region; volume and the centre of its cell stay.
KOKKOS_INLINE_FUNCTION void takeParted(Donors const &donors, int donor, Region const &region, Geometry geometry)
{
  donors.polygon(donor) = region;
  Vector2 const origin = region[0];
  Moments<2> const m = moments<2>(region, origin, areaWeight(geometry, origin));
  double const measure = donors.shape(donor, 0) / m.volume();
  Vector2 const d = m.centroid();
  donors.shape(donor, 1) = origin[0] + d[0];
  donors.shape(donor, 2) = origin[1] + d[1];
  donors.shape(donor, 3) = measure * (m.second(0, 0) - d[0] * m.first(0));
  donors.shape(donor, 4) = measure * (m.second(0, 1) - d[0] * m.first(1));
  donors.shape(donor, 5) = measure * (m.second(1, 1) - d[1] * m.first(1));
  donors.head(donor).measure = measure;
  donors.head(donor).kind = MovingDonor; // a quiet one is whole no longer
}

/// Mark the donors that have flowed and are passed. \return Their number.
int findRough(Input const &in, Classes const &classes, Donors const &donors, View<int *> const &rough)
{
  int number = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::findRough", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int index, int &sum) {
        int const cell = classes.interface_cell(index);
        for (int donor = donors.offset(index); donor < donors.offset(index + 1); ++donor)
        {
          DonorHead const head = donors.head(donor);
          // Of before stage 1: after it records are right to one layer of the halo less.
          bool const flowed = head.kind != RigidDonor && hasFlowed(in.state.record(head.pair, PlasticStrain));
          rough(donor) = flowed && passes(in, cell) ? 1 : 0;
          sum += rough(donor);
        }
      },
      number);
  return number;
}

} // namespace

void partDonors(Input const &in, Classes const &classes, Donors const &donors, PartWork &work)
{
  int const cells = classes.num_interface;
  grow(work.rough, "rough", donors.num);
  if (findRough(in, classes, donors, work.rough) == 0)
    return;
  moveOtherRegions(in, classes, donors);
  grow(work.parted, "parted", donors.num);
  grow(work.polygon, "partedPolygon", donors.num);
  Kokkos::parallel_for("Harmos::remap::partDonors", RangePolicy(0, cells), PartFunctor{in, classes, donors, work});
  View<int *> const parted = work.parted;
  View<Region *> const polygon = work.polygon;
  Geometry const geometry = in.mesh.geometry;
  Kokkos::parallel_for(
      "Harmos::remap::takeParted", RangePolicy(0, donors.num), KOKKOS_LAMBDA(int donor) {
        if (parted(donor) != 0)
          takeParted(donors, donor, polygon(donor), geometry);
      });
}

} // namespace RemapDetail
} // namespace Harmos
