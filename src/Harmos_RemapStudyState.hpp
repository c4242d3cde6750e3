// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_STUDY_STATE_HPP
#define HARMOS_REMAP_STUDY_STATE_HPP

#include <Harmos_BoundaryConditions.hpp>
#include <Harmos_FilledRegions.hpp>
#include <Harmos_RemapDeck.hpp>
#include <Harmos_RemapFields.hpp>

namespace Harmos
{

/// A field on a mesh that moves: what the remap knows of a material that fills the unit square, and the meshes of a
/// step.
struct Study
{
  Mesh mesh, next;             // before and after the step
  View<double *[2]> reference; // node positions of the regular mesh
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  FilledRegions regions;
  BoundaryConditions conditions;
  View<Material *> materials;
  RemapWork work;
  FieldWork field_work;
  Vector2 wall_impulse = {0.0, 0.0}; // all steps [N s/m]
};

/// The field of the deck on the regular mesh; the material carries a vortex, at rest on the sides, as its velocity.
Study makeStudy(Mesh const &mesh, RemapDeck const &deck);

/// Nodes of `mesh` at their places after `step` of `steps` steps of a motion.
/// \param reference  Their places on the regular mesh, which has `cells` along a side.
void placeNodes(MeshMotion const &motion, int cells, int step, int steps, View<double *[2]> const &reference,
                Mesh &mesh);

/// Cell averages of the field that the state carries.
View<double *> valuesOf(Study const &s, bool density);

/// Set the field on mesh `next`.
void setValues(Study const &s, bool density, View<double *> const &value);

} // namespace Harmos

#endif
