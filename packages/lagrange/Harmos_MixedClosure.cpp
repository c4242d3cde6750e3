// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_Lagrange.hpp>

#include <detail/Harmos_Closure.hpp>
#include <detail/Harmos_PairAccess.hpp>

namespace Harmos
{
namespace
{

struct ClosureFunctor
{
  Mesh mesh;
  CellMaterialPairs pairs;
  RowPointer<double, num_pair_fields> record;
  View<double *[2]> half;
  View<Material *> materials;
  double dt;

  KOKKOS_INLINE_FUNCTION bool deformable(int pair) const { return materials(pairs.material(pair)).rigid_body < 0; }

  /// The deformable components in the order of their pairs; `rigid` is what rigid ones fill.
  KOKKOS_INLINE_FUNCTION detail::ClosureComponents components(int cell, double &rigid) const
  {
    detail::ClosureComponents c;
    rigid = 0.0;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
    {
      double const fraction = record(pair, VolumeFraction);
      if (!deformable(pair))
      {
        rigid += fraction;
        continue;
      }
      double const volume = record(pair, SpecificVolume);
      EosState<double> const eos =
          equationOfState(materials(pairs.material(pair)), volume, record(pair, InternalEnergy));
      c.item[c.count++] = {fraction, eos.pressure, eos.sound_speed_squared / volume, 0.0};
    }
    return c;
  }

  /// Work that a component's own change of volume would do, less what its corner forces do. [J/m]
  KOKKOS_INLINE_FUNCTION double workDefect(detail::ClosureComponent const &m, int pair, double cell_strain) const
  {
    return m.pressure * record(pair, Mass) * record(pair, SpecificVolume) * (cell_strain - m.strain);
  }

  /// Every component does its own -p dV; what that adds up to is taken from all alike, by mass.
  KOKKOS_INLINE_FUNCTION void moveEnergy(int cell, detail::ClosureComponents const &c, double cell_strain) const
  {
    double defect = 0.0, mass = 0.0;
    for (int pair = pairs.offset(cell), i = 0; pair < pairs.offset(cell + 1); ++pair)
      if (deformable(pair))
      {
        defect += workDefect(c.item[i++], pair, cell_strain);
        mass += record(pair, Mass);
      }
    for (int pair = pairs.offset(cell), i = 0; pair < pairs.offset(cell + 1); ++pair)
      if (deformable(pair))
        record(pair, InternalEnergy) += workDefect(c.item[i++], pair, cell_strain) / record(pair, Mass) - defect / mass;
  }

  /// The fractions of a full cell sum to one.
  KOKKOS_INLINE_FUNCTION void makeFull(int cell) const
  {
    int largest = -1;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      if (largest < 0 || record(pair, VolumeFraction) > record(largest, VolumeFraction))
        largest = pair;
    double others = 0.0;
    for (int pair = pairs.offset(cell); pair < pairs.offset(cell + 1); ++pair)
      others += pair == largest ? 0.0 : record(pair, VolumeFraction);
    record(largest, VolumeFraction) = 1.0 - others;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int cell) const
  {
    if (pairs.cell_kind(cell) != MixedCell || pairs.offset(cell + 1) - pairs.offset(cell) > max_components)
      return;
    double rigid;
    detail::ClosureComponents c = components(cell, rigid);
    if (c.count == 0)
      return;
    auto const x = detail::cellCorners(mesh, cell);
    auto const v = detail::cornerVelocities(pairs, half, pairs.offset(cell));
    auto const moved = detail::moved(x, dt, v);
    bool const planar = mesh.geometry == Geometry::Planar;
    double const ratio = planar ? detail::meanGradient(moved).area / detail::meanGradient(x).area
                                : detail::ringGradient(moved).volume / detail::ringGradient(x).volume;
    if (!(ratio > 0.0))
      return;
    double filled = rigid;
    for (int i = 0; i < c.count; ++i)
      filled += c.item[i].fraction;
    double const cell_strain = ratio - 1.0;
    double const void_left = detail::distributeVolume(c, 1.0 - filled, cell_strain * (1.0 - rigid));
    if (c.count > 1)
      moveEnergy(cell, c, cell_strain);
    for (int pair = pairs.offset(cell), i = 0; pair < pairs.offset(cell + 1); ++pair)
      if (deformable(pair))
      {
        double const relative = (1.0 + c.item[i++].strain) / ratio;
        record(pair, SpecificVolume) *= relative;
        record(pair, VolumeFraction) *= relative;
      }
    if (void_left == 0.0)
      makeFull(cell);
  }
};

} // namespace

void closeMixedCells(Mesh const &mesh, CellMaterialPairs const &pairs, PairState const &state,
                     View<Material *> const &materials, double dt, LagrangeWork const &work)
{
  Kokkos::parallel_for("Harmos::lagrange::closeMixedCells", RangePolicy(0, mesh.num_cells),
                       ClosureFunctor{mesh, pairs, state.record, work.half, materials, dt});
}

} // namespace Harmos
