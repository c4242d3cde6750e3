// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_GRUNEISEN_HPP
#define HARMOS_GRUNEISEN_HPP

#include <Harmos_Material.hpp>

namespace Harmos
{

/// Gamma = sv dp/de at constant sv [1]: by how much of itself the work of a pressure changes it.
///
/// Tillotson: a + b, its value in the cold solid (a in hot vapour).
/// T: double, or a pack whose lanes share the material.
template <class T>
KOKKOS_INLINE_FUNCTION T gruneisenParameter(Material const &material, T specific_volume)
{
  if (material.eos == EosKind::MieGruneisen)
    return (material.gruneisen * material.density0) * specific_volume;
  if (material.eos == EosKind::IdealGas)
    return material.gruneisen - 1.0;
  if (material.eos == EosKind::Tillotson)
    return material.tillotson.a + material.tillotson.b;
  return material.gruneisen;
}

} // namespace Harmos

#endif
