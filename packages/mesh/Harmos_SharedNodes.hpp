// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SHARED_NODES_HPP
#define HARMOS_SHARED_NODES_HPP

#include <Harmos_CellMaterialPairs.hpp>
#include <Harmos_Mesh.hpp>

namespace Harmos
{

/// Whether all materials share a dof node (kinematics `single`) and a rigid one, which then moves it, is in a cell
/// around it.
///
/// \param is_rigid Called with a material's number.
template <class IsRigid>
KOKKOS_INLINE_FUNCTION bool movedByARigidOne(Mesh const &mesh, CellMaterialPairs const &pairs,
                                             NodeMaterialPairs const &dof_nodes, int dof, IsRigid const &is_rigid)
{
  if (dof_nodes.material(dof) >= 0)
    return false;
  int const node = dof_nodes.node(dof);
  for (int i = mesh.node_cell.offset(node); i < mesh.node_cell.offset(node + 1); ++i)
  {
    int const cell = mesh.node_cell.item(i) / 4;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      if (is_rigid(pairs.material(pair)))
        return true;
  }
  return false;
}

} // namespace Harmos

#endif
