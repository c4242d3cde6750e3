// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapStudyState.hpp"

#include "Harmos_RemapField.hpp"

#include <Harmos_Deck.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_PrescribedField.hpp>

namespace Harmos
{
namespace
{

/// A vortex in the unit square that is at rest on its sides: P = 0, L > 0.
PrescribedField vortex()
{
  PrescribedField field;
  field.kind = FieldKind::Vortex;
  return field;
}

} // namespace

void placeNodes(MeshMotion const &motion, int cells, int step, int steps, View<double *[2]> const &reference,
                Mesh &mesh)
{
  auto const position = mesh.node_position;
  auto const global = mesh.node_global;
  double const t = static_cast<double>(step) / steps;
  bool const home = motion.kind == MotionKind::Random ? step == 0 : step == 0 || step == steps;
  Kokkos::parallel_for(
      "Harmos::placeNodes", RangePolicy(0, mesh.num_nodes), KOKKOS_LAMBDA(int node) {
        Vector2 const at{reference(node, 0), reference(node, 1)};
        Vector2 x = at;
        if (!home)
          x = motion.kind == MotionKind::Random ? motion.randomPosition(at, global(node), step, 1.0 / cells)
                                                : motion.position(at, t);
        position(node, 0) = x[0];
        position(node, 1) = x[1];
      });
  updateGeometry(mesh);
}

Study makeStudy(Mesh const &mesh, RemapDeck const &deck)
{
  Study s;
  s.mesh = mesh;
  s.next = mesh;
  s.next.node_position = View<double *[2]>("Harmos::nextPosition", mesh.num_nodes);
  separateGeometry(s.next);
  s.reference = View<double *[2]>("Harmos::reference", mesh.num_nodes);
  Kokkos::deep_copy(s.reference, mesh.node_position);
  s.conditions = buildBoundaryConditions(mesh, View<Boundary *>("boundary", num_boundary_sides)); // slip walls
  s.materials = View<Material *>("materials", 1);
  auto const materials = Kokkos::create_mirror_view(s.materials);
  materials(0) = Material{};
  materials(0).density0 = 1.0;
  Kokkos::deep_copy(s.materials, materials);
  s.pairs.num_pairs = mesh.num_cells;
  s.pairs.offset = View<int *>("offset", mesh.num_cells + 1);
  s.pairs.material = View<int *>("material", mesh.num_cells);
  s.pairs.cell = View<int *>("cell", mesh.num_cells);
  s.state.record = View<double *[num_pair_fields]>("record", mesh.num_cells);
  s.state.centroid = View<double *[2]>("centroid", mesh.num_cells);
  s.regions.cell_region = View<int *>("cell_region", mesh.num_cells);
  Kokkos::deep_copy(s.regions.cell_region, -1);
  View<double *> const f = cellAverages(deck.field, mesh);
  auto const pairs = s.pairs;
  auto const record = s.state.record;
  bool const density = deck.field.density;
  Kokkos::parallel_for(
      "Harmos::fillCells", RangePolicy(0, mesh.num_cells + 1), KOKKOS_LAMBDA(int cell) {
        pairs.offset(cell) = cell;
        if (cell == mesh.num_cells)
          return;
        pairs.cell(cell) = cell;
        record(cell, Mass) = (density ? f(cell) : 1.0) * mesh.cell_volume(cell);
        record(cell, VolumeFraction) = 1.0;
        record(cell, SpecificVolume) = 1.0;
        record(cell, InternalEnergy) = density ? 1.0 : f(cell);
      });
  s.dof_nodes = buildDofNodes(mesh, Kinematics::Xfem, s.state.record, s.pairs);
  s.state.velocity = View<double *[2]>("velocity", s.dof_nodes.num_dof_nodes);
  auto const velocity = s.state.velocity;
  auto const dof_nodes = s.dof_nodes;
  PrescribedField const swirl = vortex();
  Kokkos::parallel_for(
      "Harmos::swirl", RangePolicy(0, dof_nodes.num_dof_nodes), KOKKOS_LAMBDA(int dof) {
        int const node = dof_nodes.node(dof);
        Vector2 const v = swirl.velocityAt({mesh.node_position(node, 0), mesh.node_position(node, 1)}, 0.0);
        velocity(dof, 0) = v[0];
        velocity(dof, 1) = v[1];
      });
  return s;
}

View<double *> valuesOf(Study const &s, bool density)
{
  View<double *> const value("Harmos::values", s.mesh.num_cells);
  auto const record = s.state.record;
  auto const volume = s.mesh.cell_volume;
  Kokkos::parallel_for(
      "Harmos::valuesOf", RangePolicy(0, s.mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        value(cell) = density ? record(cell, Mass) / volume(cell) : record(cell, InternalEnergy);
      });
  return value;
}

void setValues(Study const &s, bool density, View<double *> const &value)
{
  auto const record = s.state.record;
  auto const volume = s.next.cell_volume;
  Kokkos::parallel_for(
      "Harmos::setValues", RangePolicy(0, s.next.num_cells), KOKKOS_LAMBDA(int cell) {
        if (density)
          record(cell, Mass) = value(cell) * volume(cell);
        else
          record(cell, InternalEnergy) = value(cell);
      });
}

} // namespace Harmos
