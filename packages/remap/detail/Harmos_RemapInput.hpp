// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_INPUT_HPP
#define HARMOS_REMAP_INPUT_HPP

#include <Harmos_Remap.hpp>
#include <Harmos_Select.hpp>
#include <detail/Harmos_NeighbourLinks.hpp>

namespace Harmos
{
namespace RemapDetail
{

/// What every kernel of the remap may read; captured by value.
struct Input
{
  Mesh mesh;
  CellMaterialPairs pairs;
  NodeMaterialPairs dof_nodes;
  PairState state;
  FilledRegions regions;
  BoundaryConditions conditions;
  View<Material *> materials;
  View<double *[2]> half;
  double dt;
  RigidRows rigid;
  RemapOptions options;
  NeighbourLinks links;
  View<double *[2]> start;   // of the nodes: where the motion began; the mesh's own positions unless it is another mesh
  bool retargeted = false;   // it is
  View<double *[32]> ranges; // fieldRanges
  CornerShares share;        // of the mesh where the motion began, in all of the remap (moveShares)
  bool any_fluid = true;     // some material is neither rigid nor has strength: without one there is no gas

  /// Boundaries whose slip walls mirror fields; none where they do not.
  KOKKOS_INLINE_FUNCTION View<Boundary *> mirrors() const
  {
    return options.mirrored_walls ? conditions.boundary : View<Boundary *>();
  }
  KOKKOS_INLINE_FUNCTION bool isRigid(int material) const { return materials(material).rigid_body >= 0; }
  /// Stage field KineticField holds damage.
  KOKKOS_INLINE_FUNCTION bool carriesDamage() const { return state.tracks_damage; }
  KOKKOS_INLINE_FUNCTION Vector2 node(int n) const { return {mesh.node_position(n, 0), mesh.node_position(n, 1)}; }
  KOKKOS_INLINE_FUNCTION Vector2 startNode(int n) const { return {start(n, 0), start(n, 1)}; }
  KOKKOS_INLINE_FUNCTION Quadrilateral startQuadrilateral(int cell) const
  {
    Quadrilateral q;
    q.size = 4;
    for (int k = 0; k < 4; ++k)
      q[k] = startNode(mesh.cell_node(cell, k));
    return q;
  }
  /// The point of the mesh with the local coordinates that a point of a cell had at the start.
  KOKKOS_INLINE_FUNCTION Vector2 carried(int cell, Vector2 const &x) const
  {
    if (!retargeted)
      return x;
    Quadrilateral const q = cellQuadrilateral(mesh, cell);
    double N[4];
    shapeFunctionsAt(startQuadrilateral(cell), x, N);
    return (N[0] * q[0] + N[1] * q[1]) + (N[2] * q[2] + N[3] * q[3]);
  }
  KOKKOS_INLINE_FUNCTION Vector2 displacement(int dof) const { return {dt * half(dof, 0), dt * half(dof, 1)}; }
};

/// An uninitialised array.
template <class T>
View<T> scratch(char const *label, std::size_t extent)
{
  return View<T>(Kokkos::view_alloc(std::string("Harmos::remap::") + label, Kokkos::WithoutInitializing), extent);
}

/// Make room for `extent` rows of a kept array; contents are lost where it has to grow.
template <class T>
void grow(T &view, char const *label, std::size_t extent)
{
  if (view.extent(0) >= extent && view.extent(0) > 0)
    return;
  view = {};
  view = scratch<typename T::data_type>(label, extent + extent / 4 + 1);
}

/// Area and area centroid of a quadrilateral.
struct AreaCentroid
{
  double area;
  Vector2 centroid;
};

KOKKOS_INLINE_FUNCTION AreaCentroid areaCentroid(Vector2 const x[4])
{
  Vector2 const d1 = x[1] - x[0];
  Vector2 const d2 = x[2] - x[0];
  Vector2 const d3 = x[3] - x[0];
  double const lower = 0.5 * cross(d1, d2);
  double const upper = 0.5 * cross(d2, d3);
  double const area = lower + upper;
  Vector2 const first = (lower / 3.0) * (d1 + d2) + (upper / 3.0) * (d2 + d3);
  return {area, x[0] + (1.0 / area) * first};
}

/// Where the volume of a cell of the target mesh balances.
KOKKOS_INLINE_FUNCTION Vector2 cellCentroid(Mesh const &mesh, int cell)
{
  Quadrilateral const q = cellQuadrilateral(mesh, cell);
  return mesh.geometry == Geometry::Planar ? areaCentroid(q.vertex).centroid : volumeCentroid(q, mesh.geometry);
}

/// Radial return of a deviator to the yield surface sqrt(3 J2) <= yield + hardening eps; zero without strength.
/// \tparam T double or Pack
template <class T>
KOKKOS_INLINE_FUNCTION void returnToYield(Material const &law, T const &plastic_strain, T &xx, T &yy, T &xy)
{
  if (law.strength == StrengthKind::None)
  {
    xx = yy = xy = T(0.0);
    return;
  }
  if (law.strength != StrengthKind::Plastic)
    return;
  T const three_j2 = 3.0 * (xx * xx + yy * yy + xx * yy + xy * xy);
  T const yield = law.yield + law.hardening * plastic_strain;
  auto const yields = three_j2 > yield * yield;
  if (!any(yields))
    return;
  T const scale = select(yields, T(yield / Math::sqrt(T(select(yields, three_j2, T(1.0))))), T(1.0));
  xx = scale * xx;
  yy = scale * yy;
  xy = scale * xy;
}

/// Kinetic energy of masses m s_k with the momenta P_k s_k at the corners of a cell: sum s_k |P_k|^2 / (2 m). [J/m]
template <class Corners>
KOKKOS_INLINE_FUNCTION double momentumKineticEnergy(CornerShares const &share, int cell, double mass,
                                                    Corners const &momentum)
{
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
    sum += share(cell, i / 2) * (momentum[i] * momentum[i]);
  return mass > 0.0 ? 0.5 * sum / mass : 0.0;
}

/// Mean of |v|^2 / 2 over the four corners of a pair, by their shares: its kinetic energy per mass.
KOKKOS_INLINE_FUNCTION double cornerKineticEnergy(CornerShares const &share, CellMaterialPairs const &pairs,
                                                  View<double *[2]> const &velocity, int pair)
{
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    int const dof = pairs.dof_node(pair, k);
    sum += share(pairs.cell(pair), k) * (velocity(dof, 0) * velocity(dof, 0) + velocity(dof, 1) * velocity(dof, 1));
  }
  return 0.5 * sum;
}

} // namespace RemapDetail
} // namespace Harmos

#endif
