// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_COMPARATORS_HPP
#define HARMOS_REMAP_COMPARATORS_HPP

#include <Harmos_Mesh.hpp>
#include <Harmos_RemapDeck.hpp>

#include <vector>

namespace Harmos
{

/// Ways to remap one field of cell averages that the cycle does not use, to be compared with. On the host, one rank.
///
/// \param from   The mesh of the values. \param to  Of the same connectivity; its cells lie within the vertex
///               neighbours of the same cells of `from`.
/// \param order  1: donors are constant; 2: linear, by least squares, not limited.
/// \return Cell averages on `to`.
///
/// Interpolation: the donor that holds the new centroid, evaluated there. Not conservative.
/// Projection: f_h of the bilinear elements of `to` with (N_i, f_h) = (N_i, f) for all nodes i, integrals over the
/// exact overlays; lumped, or with the consistent mass matrix (Jacobi conjugate gradients); then cell averages of f_h.
/// Conservative, since the N_i sum to one; the lumped one is bounded where donors are constant, up to the quadrature of
/// N_i (three points a triangle), the consistent one is not.
/// Throws std::runtime_error for the other schemes.
std::vector<double> remapByComparator(RemapScheme scheme, int order, Mesh const &from, Mesh const &to,
                                      std::vector<double> const &value);

} // namespace Harmos

#endif
