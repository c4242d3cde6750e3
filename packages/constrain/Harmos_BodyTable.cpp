// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_BodyTable.hpp>

#include <stdexcept>
#include <string>

namespace Harmos
{

BodyTable buildBodyTable(std::vector<RigidBody> const &bodies, int num_materials, WorkArrays const &work)
{
  std::vector<int> of_material(num_materials, -1);
  for (std::size_t b = 0; b < bodies.size(); ++b)
  {
    int const material = bodies[b].material;
    if (material < 0 || material >= num_materials)
      throw std::runtime_error("rigid body " + std::to_string(b) + ": material " + std::to_string(material) +
                               " is not in 0.." + std::to_string(num_materials - 1));
    of_material[material] = static_cast<int>(b);
  }
  return {work.copyOf("Harmos::constrain::body_of_material", of_material),
          work.copyOf("Harmos::constrain::body", bodies)};
}

BodyTable withBodies(BodyTable const &table, std::vector<RigidBody> const &bodies, WorkArrays const &work)
{
  return {table.of_material, work.copyOf("Harmos::constrain::body", bodies), false, table.surfaces};
}

} // namespace Harmos
