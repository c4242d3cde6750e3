// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_DonorOverlap.hpp>

#include <Harmos_JoinReducer.hpp>
#include <Harmos_SharedVolume.hpp>
#include <detail/Harmos_RegionBounds.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct OverlapFunctor
{
  Input in;
  Classes classes;
  Donors donors;
  View<Bounds *> bounds;  // donors.num
  View<double *> overlap; // num_interface [length^2]

  /// \param visit (donor, bounds of what lies within `around`), of all that meet it from here and the neighbours.
  template <class Visitor>
  KOKKOS_INLINE_FUNCTION void forDonorsIn(int acceptor, Bounds const &around, Visitor const &visit) const
  {
    forDonorsAround(in, classes, donors, acceptor,
                    [&](int, int donor)
                    {
                      Bounds const both = bounds(donor).with(around);
                      if (!both.empty())
                        visit(donor, both);
                    });
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const acceptor = classes.interface_cell(index);
    double sum = 0.0;
    if (in.mesh.cell_depth(acceptor) == 0)
    {
      Quadrilateral const cell = cellQuadrilateral(in.mesh, acceptor);
      Bounds const box{{in.links.box(acceptor, 0), in.links.box(acceptor, 1)},
                       {in.links.box(acceptor, 2), in.links.box(acceptor, 3)}};
      forDonorsIn(acceptor, box,
                  [&](int a, Bounds const &part)
                  {
                    int const material = donors.head(a).material;
                    forDonorsIn(acceptor, part,
                                [&](int b, Bounds const &)
                                {
                                  if (b > a && donors.head(b).material != material)
                                    sum += sharedVolume(donors.polygon(a), donors.polygon(b), cell, in.mesh.geometry);
                                });
                  });
    }
    overlap(index) = sum;
  }
};

/// Sum over the owned cells of all ranks.
double sumOverRanks(Mesh const &mesh, Classes const &classes, View<double *> const &overlap, Exchange const &exchange)
{
  double largest = 0.0;
  Kokkos::parallel_reduce(
      "Harmos::remap::largestOverlapVolume", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, double &value) { value = Math::max(value, overlap(i)); }, Kokkos::Max<double>(largest));
  long long cells = mesh.num_owned_cells;
  exchange.sum(&cells, 1);
  ReproducibleSum const sum = reproducibleSum(exchange.max(classes.num_interface > 0 ? largest : 0.0), cells);
  long long quanta = 0;
  Kokkos::parallel_reduce(
      "Harmos::remap::sumOverlaps", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, long long &part) { part += sum.quanta(overlap(i)); }, quanta);
  exchange.sum(&quanta, 1);
  return sum.value(quanta);
}

/// Of the owned cells, the lowest where several have as much.
struct LargestPart
{
  double part = 0.0;
  int cell = -1; // none

  KOKKOS_INLINE_FUNCTION void take(double other, int its_cell)
  {
    if (other > part || (other == part && other > 0.0 && its_cell < cell))
    {
      part = other;
      cell = its_cell;
    }
  }
  KOKKOS_INLINE_FUNCTION void join(LargestPart const &other) { take(other.part, other.cell); }
};

LargestPart largestPart(Mesh const &mesh, Classes const &classes, View<double *> const &overlap)
{
  LargestPart largest;
  Kokkos::parallel_reduce(
      "Harmos::remap::largestOverlap", RangePolicy(0, classes.num_interface),
      KOKKOS_LAMBDA(int i, LargestPart &value) {
        int const cell = classes.interface_cell(i);
        value.take(overlap(i) / mesh.cell_volume(cell), cell);
      },
      JoinReducer<LargestPart>(largest));
  return largest;
}

/// The largest of all ranks, and where it is.
void setLargest(Mesh const &mesh, LargestPart const &mine, Exchange const &exchange, MovedOverlap &result)
{
  result.largest = exchange.max(mine.part);
  if (!(result.largest > 0.0))
    return;
  constexpr double none = 1e300; // no cell's number, no coordinate
  double number = none, place[2] = {none, none};
  if (mine.part == result.largest)
  {
    Kokkos::View<double[3], Kokkos::DefaultExecutionSpace::memory_space> const found("Harmos::remap::largestAt");
    int const cell = mine.cell;
    Kokkos::parallel_for(
        "Harmos::remap::placeOfLargest", RangePolicy(0, 1), KOKKOS_LAMBDA(int) {
          Vector2 const centre = cellCentroid(mesh, cell);
          found(0) = static_cast<double>(mesh.cell_global(cell));
          found(1) = centre[0];
          found(2) = centre[1];
        });
    auto const at = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), found);
    number = at(0);
    place[0] = at(1);
    place[1] = at(2);
  }
  bool const first = number == exchange.min(number) && number < none;
  for (int d = 0; d < 2; ++d)
    result.place[d] = exchange.min(first ? place[d] : none);
}

} // namespace

MovedOverlap measureOverlap(Input const &in, Classes const &classes, Donors const &donors, Exchange const &exchange)
{
  int const cells = classes.num_interface;
  View<Bounds *> const bounds = scratch<Bounds *>("donorBounds", cells > 0 ? donors.num : 0);
  View<double *> const overlap = scratch<double *>("overlap", cells);
  if (cells > 0)
  {
    moveOtherRegions(in, classes, donors);
    Kokkos::parallel_for(
        "Harmos::remap::donorBounds", RangePolicy(0, donors.num),
        KOKKOS_LAMBDA(int donor) { bounds(donor) = boundsOf(donors.polygon(donor)); });
    Kokkos::parallel_for("Harmos::remap::measureOverlap", RangePolicy(0, cells),
                         OverlapFunctor{in, classes, donors, bounds, overlap});
  }
  MovedOverlap result;
  result.volume = sumOverRanks(in.mesh, classes, overlap, exchange);
  setLargest(in.mesh, largestPart(in.mesh, classes, overlap), exchange, result);
  return result;
}

} // namespace RemapDetail
} // namespace Harmos
