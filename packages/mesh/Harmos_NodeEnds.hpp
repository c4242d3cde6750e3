// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_NODE_ENDS_HPP
#define HARMOS_NODE_ENDS_HPP

#include <Harmos_Mesh.hpp>

#include <vector>

namespace Harmos
{

/// For each piece of `cells` cells, in their order: the nodes below the end have no cell beyond the piece. All nodes
/// are below the last end; so are those that come after one with a cell in a later piece.
std::vector<int> nodeEnds(Mesh const &mesh, int cells);

} // namespace Harmos

#endif
