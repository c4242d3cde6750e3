// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_FIELDS_HPP
#define HARMOS_REMAP_FIELDS_HPP

#include <Harmos_Remap.hpp>

namespace Harmos
{

/// Fields of cells that know no materials, in averages over the cells: what a host code remaps beside the mechanics.
struct CellFields
{
  View<double **> value; // num_cells, fields
};

/// Work arrays of remapFields that live from call to call, on meshes of one connectivity. Copies share them.
struct FieldWork
{
  std::shared_ptr<struct FieldScratch> scratch;
};

/// Remap cell fields to another mesh of the same connectivity by exact intersection with the own cell and the vertex
/// neighbours; what those do not get stays in the own cell. Conserves the sum of f V of every field to round-off.
///
/// Second order: least-squares gradients over the vertex neighbours, weighted by one over distance squared. With
/// RemapLimiter::Range the means of what each acceptor gets stay within the range of the donor and its neighbours, and
/// so do the new averages; RangeInside: in cells at the mesh's boundary the range goes on to the mirrored value of the
/// cell opposite, where that is within the values at the mesh's rim.
///
/// \param mesh    The target, planar, with convex cells. Runs over all local cells.
/// \param start   Node positions of the mesh that the fields are on [length].
/// \param fields, remapped  Averages over the cells of that mesh, and of the target: other arrays of the same shape.
/// \param options order 1 or 2; limiter Range, RangeInside or None.
/// \param exchange Between the ranks: RangeInside needs the fields' ranges on all of them.
/// \return Owned cells that do not get their volume to 1e-10: nodes moved out of the cells around them.
/// \throw std::runtime_error Axisymmetric meshes, other orders and limiters.
///
/// Right on cells of depth d where the input is right to depth d + 2. Source: Dukowicz & Kodis, SIAM J. Sci. Stat.
/// Comput. 8 (1987) 305-321.
int remapFields(Mesh const &mesh, View<double *[2]> const &start, CellFields const &fields, CellFields const &remapped,
                RemapOptions const &options, FieldWork &work, Exchange const &exchange = {});

} // namespace Harmos

#endif
