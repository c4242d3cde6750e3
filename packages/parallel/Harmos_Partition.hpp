// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_PARTITION_HPP
#define HARMOS_PARTITION_HPP

#include <Harmos_HostMesh.hpp>

namespace Harmos
{

/// Rank of each cell: METIS' multilevel partition of the graph of cells that share a face, by recursive bisection up to
/// eight parts, else k-way. Where cells are many, groups that meet at nodes stay together: on a
/// grid blocks of 2 x 2, 4 x 4 and so on.
///
/// The cut has the least sum of weights over its faces: 13 where the cells on both sides have numbers that follow each
/// other, else 10. Kernels run over cells in the order of their numbers, so that of cuts of about the same length the
/// one is taken that leaves runs whole: a square grid is cut between its rows.
///
/// \param parts   Number of ranks, 1 or more; more than there are cells leaves ranks empty.
/// \param weight  Of each cell, >= 0; empty: all the same. Weights balance within 1% where the cells are many.
/// The seed is fixed: every rank computes the same partition from the same mesh. Nothing else depends on it.
/// \throw std::runtime_error on wrong arguments or when METIS reports an error.
///
/// Karypis & Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392.
std::vector<int> partitionCells(HostMesh const &mesh, int parts, std::vector<int> const &weight = {});

} // namespace Harmos

#endif
