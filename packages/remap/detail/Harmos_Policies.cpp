// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_EquationOfState.hpp>
#include <Harmos_PressureAround.hpp>
#include <detail/Harmos_Acceptors.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

constexpr double full_tolerance = 1e-12; // of the cell: sums of fractions this near to one are made one
constexpr double least_share = 1e-10;    // of the cell: what deformable material keeps, at most, under a rigid body
constexpr double most_volume = 2.0;      // of the cell: what a pair's mass times its specific volume may be
constexpr double most_gas_change = 0.1;  // of the gas in a cell: what it takes of overlap and void in one remap
constexpr double shared_by_all = 1e-6;   // of the cell: overlap and void up to this are no matter of a gas alone
constexpr double most_warmth = 2.0;      // over that of the gas around: what heat thin gas keeps

/// Whether a material is soft against its pressure: its bulk modulus is at most ten times that.
KOKKOS_INLINE_FUNCTION bool isGas(Material const &law, double specific_volume, double internal_energy)
{
  constexpr double most_stiffness = 10.0;
  if (!isFluid(law))
    return false;
  EosState<double> const eos = equationOfState(law, specific_volume, internal_energy);
  return eos.pressure > 0.0 && eos.sound_speed_squared <= most_stiffness * eos.pressure * specific_volume;
}

struct FinishFunctor
{
  Input in;
  Classes classes;
  StageState stage;
  Acceptors acceptors;
  Bookings bookings;

  KOKKOS_INLINE_FUNCTION bool kept(int candidate) const { return acceptors.merge_to(candidate) < 0; }

  KOKKOS_INLINE_FUNCTION bool hadVoid(int cell) const
  {
    int const kind = in.pairs.cell_kind(cell);
    if (kind != MixedCell)
      return kind == VoidCell;
    double sum = 0.0;
    for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
      sum += in.state.record(pair, VolumeFraction);
    return sum < 1.0 - full_tolerance;
  }

  /// Void, or a boundary beyond which void lies, explains a gap.
  KOKKOS_INLINE_FUNCTION bool voidAround(int cell) const
  {
    bool any = classes.openAround(cell) != 0 || hadVoid(cell);
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1) && !any; ++j)
      any = hadVoid(in.mesh.cell_neighbour.item(j));
    return any;
  }

  KOKKOS_INLINE_FUNCTION bool hadGas(int cell) const
  {
    for (int pair = in.pairs.offset(cell); pair < in.pairs.offset(cell + 1); ++pair)
      if (isGas(in.materials(in.pairs.material(pair)), stage.record(pair, SpecificVolume),
                stage.record(pair, InternalEnergy)))
        return true;
    return false;
  }

  KOKKOS_INLINE_FUNCTION bool gasAround(int cell) const
  {
    bool any = hadGas(cell);
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1) && !any; ++j)
      any = hadGas(in.mesh.cell_neighbour.item(j));
    return any;
  }

  /// Whether candidate c is a gas, by its record.
  KOKKOS_INLINE_FUNCTION bool isGasNow(int c) const
  {
    return kept(c) && isGas(in.materials(acceptors.material(c)), acceptors.record(c, SpecificVolume),
                            acceptors.record(c, InternalEnergy));
  }

  KOKKOS_INLINE_FUNCTION void setVerbatim(int index, int cell) const
  {
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
    {
      int const pair = in.pairs.find(cell, acceptors.material(c));
      for (int f = 0; f < num_pair_fields; ++f)
        acceptors.record(c, f) = stage.record(pair, f);
      acceptors.kinetic(c) = stage.kineticEnergy(in, pair);
      for (int d = 0; d < 2; ++d)
        acceptors.centroid(c, d) = in.state.centroid(pair, d);
      stage.cornerVelocities(in, classes, pair, &acceptors.corner_velocity(c, 0));
    }
  }

  /// Everything but the volume fraction.
  KOKKOS_INLINE_FUNCTION void setDeformable(int c, int cell) const
  {
    double const mass = acceptors.sum(c, DensityField);
    double const per_mass = 1.0 / mass;
    double const per_volume = 1.0 / acceptors.sum(c, VolumeSum);
    double q[num_pair_fields];
    q[Mass] = mass;
    q[VolumeFraction] = 0.0;
    for (int f = SpecificVolume; f <= PlasticStrain; ++f)
      q[f] = acceptors.sum(c, f) * per_mass;
    for (int f = DeviatorXX; f <= DeviatorXY; ++f)
      q[f] = acceptors.sum(c, f) * per_volume;
    returnToYield(in.materials(acceptors.material(c)), q[PlasticStrain], q[DeviatorXX], q[DeviatorYY], q[DeviatorXY]);
    for (int f = 0; f < num_pair_fields; ++f)
      acceptors.record(c, f) = q[f];
    acceptors.kinetic(c) = acceptors.sum(c, KineticField) * per_mass;
    for (int i = 0; i < 8; ++i)
      acceptors.corner_velocity(c, i) = acceptors.sum(c, first_corner_field + i) * per_mass;
    setCentroid(c, cell, {per_volume * acceptors.sum(c, FirstMomentX), per_volume * acceptors.sum(c, FirstMomentY)});
  }

  KOKKOS_INLINE_FUNCTION void setCentroid(int c, int cell, Vector2 const &local) const
  {
    Vector2 const origin = acceptorOrigin(in.mesh, cell);
    Quadrilateral const q = cellQuadrilateral(in.mesh, cell);
    for (int d = 0; d < 2; ++d)
    {
      double const low = Math::min(Math::min(q[0][d], q[1][d]), Math::min(q[2][d], q[3][d]));
      double const high = Math::max(Math::max(q[0][d], q[1][d]), Math::max(q[2][d], q[3][d]));
      acceptors.centroid(c, d) = Math::clamp(origin[d] + local[d], low, high);
    }
  }

  KOKKOS_INLINE_FUNCTION void setRigid(int c, int cell) const
  {
    Material const &law = in.materials(acceptors.material(c));
    for (int r = in.rigid.offset(cell); r < in.rigid.offset(cell + 1); ++r)
    {
      if (in.rigid.material(r) != acceptors.material(c))
        continue;
      double const fraction = in.rigid.volume_fraction(r);
      for (int f = 0; f < num_pair_fields; ++f)
        acceptors.record(c, f) = 0.0;
      acceptors.record(c, VolumeFraction) = fraction;
      acceptors.record(c, Mass) = law.density0 * fraction * in.mesh.cell_volume(cell);
      acceptors.record(c, SpecificVolume) = 1.0 / law.density0;
      acceptors.kinetic(c) = 0.0;
      for (int d = 0; d < 2; ++d)
        acceptors.centroid(c, d) = in.rigid.centroid(r, d);
      for (int i = 0; i < 8; ++i)
        acceptors.corner_velocity(c, i) = 0.0;
    }
  }

  /// The fractions of a full cell sum to one: the largest takes the round-off.
  KOKKOS_INLINE_FUNCTION void makeFull(int index) const
  {
    int largest = -1;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
      if (kept(c) && (largest < 0 || acceptors.record(c, VolumeFraction) > acceptors.record(largest, VolumeFraction)))
        largest = c;
    double others = 0.0;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
      if (kept(c) && c != largest)
        others += acceptors.record(c, VolumeFraction);
    if (largest >= 0)
      acceptors.record(largest, VolumeFraction) = 1.0 - others;
  }

  KOKKOS_INLINE_FUNCTION double gasVolume(int index) const
  {
    double volume = 0.0;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
      volume += isGasNow(c) ? acceptors.sum(c, VolumeSum) : 0.0;
    return volume;
  }

  /// Whether the deformable and rigid materials of a cell and of those around it are more than one, or a contact wall
  /// is among them: a gas alone with void has a free surface there, which nothing opens.
  KOKKOS_INLINE_FUNCTION bool meetsOthers(int cell) const
  {
    int first = -1;
    auto const differs = [&](int other)
    {
      for (int pair = in.pairs.offset(other); pair < in.pairs.offset(other + 1); ++pair)
      {
        first = first < 0 ? in.pairs.material(pair) : first;
        if (in.pairs.material(pair) != first)
          return true;
      }
      return false;
    };
    bool any = (classes.openAround(cell) & ContactBit) != 0 || differs(cell);
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1) && !any; ++j)
      any = differs(in.mesh.cell_neighbour.item(j));
    return any;
  }

  /// Whether gas fills what is left of a cell that holds `deformable` beside `rigid`, or gives way there.
  KOKKOS_INLINE_FUNCTION bool gasFills(int cell, double deformable, double rigid) const
  {
    double const cell_volume = in.mesh.cell_volume(cell);
    return in.any_fluid && in.options.close_void_beside_gas > 0.0 &&
           Math::fabs(cell_volume - rigid - deformable) > full_tolerance * cell_volume && meetsOthers(cell);
  }

  /// Void that a gas fills, whatever void is around: in its own cells what it can take, beside them what a merged
  /// fragment of it may have left.
  KOKKOS_INLINE_FUNCTION double mostFilledByGas(int index, int cell) const
  {
    double const cell_volume = in.mesh.cell_volume(cell), gas = gasVolume(index);
    if (gas > 0.0)
      return Math::min(in.options.close_void_beside_gas * cell_volume, most_gas_change * gas);
    double const most = Math::min(in.options.close_void_beside_gas, in.options.merge_below);
    return most > 0.0 && gasAround(cell) ? most * cell_volume : 0.0;
  }

  /// The volume that the deformable materials get, and whether the cell is full then.
  KOKKOS_INLINE_FUNCTION double share(int index, int cell, double deformable, double rigid, bool gas_fills,
                                      bool &full) const
  {
    double const cell_volume = in.mesh.cell_volume(cell);
    double const available = Math::max(cell_volume - rigid, Math::min(deformable, least_share * cell_volume));
    double const gap = available - deformable;
    bool const owned = in.mesh.cell_depth(cell) == 0;
    full = true;
    if (Math::fabs(gap) <= full_tolerance * cell_volume)
      return available;
    if (gap < 0.0)
    {
      if (owned)
        bookings(index, BookOverlap) -= gap;
      return available;
    }
    bool const spurious = !voidAround(cell);
    bool const thin = spurious && deformable > 0.0 && gap < in.options.close_void_below * cell_volume;
    if (thin || (deformable > 0.0 && gas_fills && gap < mostFilledByGas(index, cell)))
    {
      if (owned)
        bookings(index, BookClosed) += gap;
      return available;
    }
    full = false;
    if (owned && spurious)
      bookings(index, BookVoid) += gap;
    return deformable;
  }

  /// A splinter between bodies is strained by nodes that hardly anything holds, a quarter a cycle and more: what
  /// follows from its strain alone has no bound, and its neighbours would inherit it by the mean. No pair needs more
  /// than the cell.
  KOKKOS_INLINE_FUNCTION void boundSpecificVolume(int index, int c, int cell) const
  {
    double const largest = most_volume * in.mesh.cell_volume(cell) / acceptors.record(c, Mass);
    if (!(acceptors.record(c, SpecificVolume) > largest))
      return;
    acceptors.record(c, SpecificVolume) = largest;
    if (in.mesh.cell_depth(cell) == 0)
      bookings(index, BookBounded) += 1.0;
  }

  /// Let gas c grow by a part of its volume. Returns the work p dV that it does and its energy lacks then, p what
  /// the cells around bear of its pressure, as the tractions have it, so that their work and this are of one size.
  KOKKOS_INLINE_FUNCTION double expand(int c, int cell, double part) const
  {
    int const material = acceptors.material(c);
    double const s = acceptors.record(c, SpecificVolume), e = acceptors.record(c, InternalEnergy);
    auto const pressure_of = [&](int pair)
    {
      return equationOfState(in.materials(material), in.state.record(pair, SpecificVolume),
                             in.state.record(pair, InternalEnergy))
          .pressure;
    };
    auto const volume_of = [&](int pair)
    { return in.state.record(pair, VolumeFraction) * in.mesh.cell_volume(in.pairs.cell(pair)); };
    double const own = equationOfState(in.materials(material), s, e).pressure;
    double const work = part * s *
                        pressureAround(in.mesh, in.mirrors(), in.pairs, cell, material, own,
                                       acceptors.sum(c, VolumeSum), pressure_of, volume_of);
    acceptors.record(c, SpecificVolume) = s + part * s;
    acceptors.record(c, InternalEnergy) = e - work;
    return acceptors.record(c, Mass) * work;
  }

  /// Volume fractions of the deformable materials of a cell that fill `volume` of it. Of what they lack or have too
  /// much a gas takes its part, density included, and does the work of that: the tractions of contact have done as much
  /// on it where sides slid along what is not their common normal. The rest they share by volume, and keep their
  /// densities. (Where it took the least of it, too, noise of 1e-5 m/s in gas at one bar grew by e in a millisecond:
  /// tractions answer to the mean of pressures around, the filling changes one.)
  KOKKOS_INLINE_FUNCTION void setFractions(int index, int cell, double deformable, double volume, bool gas_fills) const
  {
    double const cell_volume = in.mesh.cell_volume(cell);
    double const gap = volume - deformable, of_gas = Math::fabs(gap) - shared_by_all * cell_volume;
    double gas = 0.0, taken = 0.0;
    if (gas_fills && of_gas > 0.0)
    {
      gas = gasVolume(index);
      taken = (gap > 0.0 ? 1.0 : -1.0) * Math::min(of_gas, most_gas_change * gas);
    }
    double const per_volume = deformable > 0.0 ? volume / ((deformable + taken) * cell_volume) : 0.0;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
    {
      if (!kept(c) || in.isRigid(acceptors.material(c)))
        continue;
      double const part = taken != 0.0 && isGasNow(c) ? taken / gas : 0.0;
      acceptors.record(c, VolumeFraction) = (1.0 + part) * acceptors.sum(c, VolumeSum) * per_volume;
      double const work = part != 0.0 ? expand(c, cell, part) : 0.0;
      if (in.mesh.cell_depth(cell) == 0)
        bookings(index, BookGasWork) += work;
    }
  }

  /// Internal energy per mass that gas has where it is not thin: its mean, by mass, in the cells around, or that of its
  /// warmest body at the start if larger. Not above zero where neither tells: laws may count their energies so.
  KOKKOS_INLINE_FUNCTION double warmth(int cell, int material) const
  {
    double mass = 0.0, energy = 0.0;
    for (int j = in.mesh.cell_neighbour.offset(cell); j < in.mesh.cell_neighbour.offset(cell + 1); ++j)
    {
      int const pair = in.pairs.find(in.mesh.cell_neighbour.item(j), material);
      if (pair < 0 || in.state.record(pair, VolumeFraction) < in.options.cool_gas_below)
        continue;
      mass += in.state.record(pair, Mass);
      energy += in.state.record(pair, Mass) * in.state.record(pair, InternalEnergy);
    }
    bool const known = in.options.start_energy.extent(0) > 0;
    double const start = known ? in.options.start_energy(material) : in.materials(material).energy0;
    return mass > 0.0 ? Math::max(start, energy / mass) : start;
  }

  /// Thin gas gives the liquids and solids of its cell what it is too warm, by mass.
  KOKKOS_INLINE_FUNCTION void coolThinGas(int index, int cell) const
  {
    double heat = 0.0, takers = 0.0;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
      if (kept(c) && !in.isRigid(acceptors.material(c)) && !isGasNow(c))
        takers += acceptors.record(c, Mass);
    if (!(takers > 0.0))
      return;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
    {
      if (!isGasNow(c) || acceptors.record(c, VolumeFraction) >= in.options.cool_gas_below)
        continue;
      double const most = most_warmth * warmth(cell, acceptors.material(c));
      double const surplus = acceptors.record(c, InternalEnergy) - most;
      if (!(most > 0.0 && surplus > 0.0))
        continue;
      heat += surplus * acceptors.record(c, Mass);
      acceptors.record(c, InternalEnergy) -= surplus;
    }
    if (in.mesh.cell_depth(cell) == 0)
      bookings(index, BookGasHeat) += heat;
    for (int c = acceptors.begin(index); heat > 0.0 && c < acceptors.end(index); ++c)
      if (kept(c) && !in.isRigid(acceptors.material(c)) && !isGasNow(c))
        acceptors.record(c, InternalEnergy) += heat / takers;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int index) const
  {
    int const cell = classes.interface_cell(index);
    if (acceptors.verbatim(index) != 0)
    {
      setVerbatim(index, cell);
      return;
    }
    double const cell_volume = in.mesh.cell_volume(cell);
    double deformable = 0.0, rigid = 0.0;
    for (int c = acceptors.begin(index); c < acceptors.end(index); ++c)
    {
      if (!kept(c))
        continue;
      if (in.isRigid(acceptors.material(c)))
      {
        setRigid(c, cell);
        rigid += acceptors.record(c, VolumeFraction) * cell_volume;
      }
      else
      {
        setDeformable(c, cell);
        boundSpecificVolume(index, c, cell);
        deformable += acceptors.sum(c, VolumeSum);
      }
    }
    bool full;
    bool const gas_fills = gasFills(cell, deformable, rigid);
    double const volume = share(index, cell, deformable, rigid, gas_fills, full);
    setFractions(index, cell, deformable, volume, gas_fills);
    if (full)
      makeFull(index);
    if (in.any_fluid && in.options.cool_gas_below > 0.0)
      coolThinGas(index, cell);
  }
};

} // namespace

void finish(Input const &in, Classes const &classes, StageState const &stage, Acceptors const &acceptors,
            Bookings const &bookings)
{
  Kokkos::parallel_for("Harmos::remap::finish", RangePolicy(0, classes.num_interface),
                       FinishFunctor{in, classes, stage, acceptors, bookings});
}

} // namespace RemapDetail
} // namespace Harmos
