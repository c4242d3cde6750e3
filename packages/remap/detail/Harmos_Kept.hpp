// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_KEPT_HPP
#define HARMOS_KEPT_HPP

#include <detail/Harmos_Acceptors.hpp>
#include <detail/Harmos_PartDonors.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// What a caller keeps from cycle to cycle: arrays, since fresh pages cost as much as a kernel, and what depends on the
/// mesh and on the cells' materials alone.
struct Kept
{
  View<int *[4]> face_neighbour; // of the mesh that `chunks` belong to
  SweptChunks chunks;
  SweptWindow window;
  NeighbourLinks links;
  View<int *> rim;         // rimCells
  bool boxed = false;      // their boxes are the mesh's
  bool moved_mesh = false; // the boxes are of a mesh that is not the caller's for good

  // Held so that their addresses are not given to others: equal addresses then mean equal contents.
  CellMaterialPairs pairs;
  BoundaryConditions conditions;
  View<Material *> materials;
  Classes classes;
  bool swept_faces = true; // what the classes are for
  bool any_fluid = true;   // of the materials

  // Work arrays of stage 2, as large as they were ever needed.
  Donors donors;
  PartWork part;
  Overlays overlays;
  Acceptors acceptors;
  Bookings bookings;

  std::vector<View<double *[num_pair_fields]>> records;
  std::vector<View<double *[2]>> velocities;
  std::vector<View<double *[8]>> corners;
  std::vector<View<double *[2]>> own_parts;
};

/// An array that nobody but the pool holds, or a new one. Contents are arbitrary.
template <class T>
T recycle(std::vector<T> &pool, char const *label, std::size_t extent)
{
  for (std::size_t i = pool.size(); i-- > 0;)
  {
    if (pool[i].use_count() > 1)
      continue;
    if (pool[i].extent(0) == extent)
      return pool[i];
    pool.erase(pool.begin() + static_cast<std::ptrdiff_t>(i));
  }
  pool.push_back(scratch<typename T::data_type>(label, extent));
  return pool.back();
}

} // namespace RemapDetail
} // namespace Harmos

#endif
