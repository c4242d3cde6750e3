// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ConstraintSums.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Harmos
{

namespace
{

/// A bond as it travels: length of its row (negative), key, point, materials, size of the cell.
constexpr int bond_width = 7;

/// Where cells cut off short segments the longer neighbour's bond takes them: a patch of a tenth of a cell has no mean.
constexpr double least_spacing = 0.75; // of the cell size

/// The values of all ranks one after the other, in the order of the ranks.
std::vector<double> gather(std::vector<double> const &own, Exchange const &exchange)
{
  std::vector<long long> count(static_cast<std::size_t>(exchange.size()), 0);
  std::size_t const rank = static_cast<std::size_t>(exchange.rank());
  count[rank] = static_cast<long long>(own.size());
  exchange.sum(count.data(), exchange.size());
  long long begin = 0, total = 0;
  for (std::size_t r = 0; r < count.size(); total += count[r++])
    begin += r < rank ? count[r] : 0;
  std::vector<double> all(static_cast<std::size_t>(total), 0.0);
  std::copy(own.begin(), own.end(), all.begin() + begin);
  exchange.sum(all.data(), static_cast<int>(total));
  return all;
}

bool near(Bond const &a, Bond const &b, double distance)
{
  Vector2 const apart = a.point - b.point;
  return a.material_a == b.material_a && a.material_b == b.material_b && dot(apart, apart) < distance * distance;
}

/// Bonds that keep their distance from those that came before.
struct SpacedBonds
{
  double size; // of a bin: the largest distance
  std::vector<Bond> bonds;
  std::map<std::array<long long, 2>, std::vector<std::size_t>> in_bin;

  explicit SpacedBonds(double largest_distance) : size(largest_distance) {}

  std::array<long long, 2> binOf(Vector2 const &point) const
  {
    return {static_cast<long long>(std::floor(point[0] / size)), static_cast<long long>(std::floor(point[1] / size))};
  }

  bool hasNear(Bond const &bond) const
  {
    std::array<long long, 2> const middle = binOf(bond.point);
    for (long long x = middle[0] - 1; x <= middle[0] + 1; ++x)
      for (long long y = middle[1] - 1; y <= middle[1] + 1; ++y)
        if (auto const bin = in_bin.find({x, y}); bin != in_bin.end())
          for (std::size_t const other : bin->second)
            if (near(bonds[other], bond, least_spacing * bond.cell_size))
              return true;
    return false;
  }

  void add(Bond const &bond)
  {
    if (hasNear(bond))
      return;
    in_bin[binOf(bond.point)].push_back(bonds.size());
    bonds.push_back(bond);
  }
};

/// Rows of one slave cell follow each other: the first of each pair of materials makes the bond.
std::vector<double> ownBonds(Mesh const &mesh, ContactRows const &rows, HostView<PairInteraction **> const &law)
{
  auto const row = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.row);
  auto const own = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.own);
  auto const cell_area = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_area);
  std::vector<double> bonds;
  std::vector<std::array<int, 3>> made;
  for (int i = 0; i < rows.num_own; ++i)
  {
    ContactRow const &r = row(own(i));
    if (r.material_b < 0 || r.gap > touching_gap * std::sqrt(cell_area(r.cell_a)))
      continue;
    PairInteraction const &pair = law(r.material_a, r.material_b);
    if (pair.kind != Interaction::Bonded || !pair.strength.limited())
      continue;
    std::array<int, 3> const here = {r.cell_a, std::min(r.material_a, r.material_b),
                                     std::max(r.material_a, r.material_b)};
    if (!made.empty() && made.front()[0] != here[0])
      made.clear();
    if (std::find(made.begin(), made.end(), here) != made.end())
      continue;
    made.push_back(here);
    bonds.insert(bonds.end(),
                 {-r.length, static_cast<double>(r.key), r.point[0], r.point[1], static_cast<double>(here[1]),
                  static_cast<double>(here[2]), std::sqrt(cell_area(r.cell_a))});
  }
  return bonds;
}

HostView<PairInteraction **> onHost(View<PairInteraction **> const &interaction)
{
  HostView<PairInteraction **> const host("Harmos::constrain::interaction_host", interaction.extent(0),
                                          interaction.extent(1));
  Kokkos::deep_copy(host, interaction);
  return host;
}

bool canBreak(HostView<PairInteraction **> const &law)
{
  for (std::size_t i = 0; i < law.extent(0); ++i)
    for (std::size_t j = 0; j < law.extent(1); ++j)
      if (law(i, j).kind == Interaction::Bonded && law(i, j).strength.limited())
        return true;
  return false;
}

/// The same interactions, bonds of any strength: what may be bonded before it is known where bonds are.
ConstraintOptions unlimited(ConstraintOptions options, HostView<PairInteraction **> const &law)
{
  options.interaction = View<PairInteraction **>("Harmos::constrain::unlimited", law.extent(0), law.extent(1));
  HostView<PairInteraction **> const endless("Harmos::constrain::unlimited_host", law.extent(0), law.extent(1));
  for (std::size_t i = 0; i < law.extent(0); ++i)
    for (std::size_t j = 0; j < law.extent(1); ++j)
    {
      endless(i, j) = law(i, j);
      endless(i, j).strength = {};
    }
  Kokkos::deep_copy(options.interaction, endless);
  return options;
}

/// The load of bonded rows as the nodes feel it. Multipliers of single rows may alternate where more rows meet than the
/// nodes can tell apart; what they add up to at a node cannot.
struct NodalLoad
{
  ContactSystem s;
  View<ContactRow *> row;
  View<double *[2]> impulse;

  /// The tied rows at a dof node between the materials of a row: sum of N p over sum of N L. [N s/m^2]
  KOKKOS_INLINE_FUNCTION bool meanAt(int dof, ContactRow const &of, Vector2 &mean) const
  {
    double length = 0.0;
    mean = {0.0, 0.0};
    for (int e = s.rows_of.offset(dof); e < s.rows_of.offset(dof + 1); ++e)
    {
      int const other = s.rows_of.item(e) / 8;
      ContactRow const &r = row(other);
      if (r.tied == 0 || Math::min(r.material_a, r.material_b) != Math::min(of.material_a, of.material_b) ||
          Math::max(r.material_a, r.material_b) != Math::max(of.material_a, of.material_b))
        continue;
      double const w = Math::fabs(s.weight(other, s.rows_of.item(e) % 8));
      double const sign = r.material_a == of.material_a ? 1.0 : -1.0;
      mean += (sign * w) * (impulse(other, 0) * r.normal + impulse(other, 1) * perpendicular(r.normal));
      length += w * r.length;
    }
    if (length > 0.0)
      mean = (1.0 / length) * mean;
    return length > 0.0;
  }

  /// Impulse of a tied row along n and across it: its length times the mean of its nodes' loads by its weights.
  KOKKOS_INLINE_FUNCTION Vector2 operator()(int i) const
  {
    ContactRow const &r = row(i);
    Vector2 sum{0.0, 0.0};
    double weights = 0.0;
    for (int k = 0; k < 8; ++k)
    {
      Vector2 mean;
      if (s.dof(i, k) < 0 || !meanAt(s.dof(i, k), r, mean))
        continue;
      double const w = Math::fabs(s.weight(i, k));
      sum += w * mean;
      weights += w;
    }
    if (!(weights > 0.0))
      return {impulse(i, 0), impulse(i, 1)};
    sum = (r.length / weights) * sum;
    return {dot(sum, r.normal), dot(sum, perpendicular(r.normal))};
  }
};

/// Of the own rows; the others' stay zero.
View<double *[2]> nodalImpulses(NodalLoad const &load, WorkArrays const &work)
{
  View<double *[2]> const smooth = work.zeros<double *[2]>("Harmos::constrain::nodal_impulse", load.s.num_rows);
  Kokkos::parallel_for(
      "Harmos::constrain::nodalImpulses", RangePolicy(0, load.s.num_own), KOKKOS_LAMBDA(int i) {
        int const own = load.s.own(i);
        if (load.row(own).bond < 0 || load.row(own).tied == 0)
          return;
        Vector2 const p = load(own);
        smooth(own, 0) = p[0];
        smooth(own, 1) = p[1];
      });
  return smooth;
}

} // namespace

void carry(BondLoad const &load, double kick, Bond &bond)
{
  Vector2 now{0.0, 0.0};
  if (load.length > 0.0)
    now = (1.0 / (kick * load.length)) * Vector2{load.normal, load.tangential};
  double const part = kick < bond.transit ? kick / bond.transit : 1.0;
  bond.traction += part * (now - bond.traction);
}

bool breaks(Vector2 const &traction, BondStrength const &strength)
{
  double const part_n = strength.tensile > 0.0 ? std::max(-traction[0], 0.0) / strength.tensile : 0.0;
  double const part_t = strength.shear > 0.0 ? traction[1] / strength.shear : 0.0;
  return part_n * part_n + part_t * part_t >= 1.0;
}

std::vector<Bond> findBonds(Mesh const &mesh, CellMaterialPairs const &pairs, NodeMaterialPairs const &dof_nodes,
                            FilledRegions const &regions, BoundaryConditions const &conditions,
                            std::vector<RigidBody> const &bodies, ConstraintOptions const &options,
                            Exchange const &exchange)
{
  auto const law = onHost(options.interaction);
  if (!canBreak(law))
    return {};
  BodyTable const table = buildBodyTable(bodies, static_cast<int>(law.extent(0)));
  ContactRows const rows =
      findContactRows(mesh, pairs, dof_nodes, regions, conditions, table, {}, unlimited(options, law), exchange);
  std::vector<double> const values = gather(ownBonds(mesh, rows, law), exchange);
  std::vector<std::array<double, bond_width>> found(values.size() / bond_width);
  for (std::size_t i = 0; i < values.size(); ++i)
    found[i / bond_width][i % bond_width] = values[i];
  std::sort(found.begin(), found.end());
  double largest = 0.0;
  for (auto const &f : found)
    largest = std::max(largest, f[6]);
  SpacedBonds spaced(least_spacing * largest);
  for (auto const &f : found)
    spaced.add({{f[2], f[3]}, static_cast<int>(f[4]), static_cast<int>(f[5]), false, f[6]});
  return spaced.bonds;
}

int breakBonds(std::vector<BondLoad> const &load, ConstraintOptions const &options, double kick,
               std::vector<Bond> &bonds)
{
  if (bonds.empty())
    return 0;
  auto const law = onHost(options.interaction);
  int count = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i)
  {
    if (bonds[i].broken)
      continue;
    carry(load[i], kick, bonds[i]);
    bonds[i].broken =
        load[i].snapped || breaks(bonds[i].traction, law(bonds[i].material_a, bonds[i].material_b).strength);
    count += bonds[i].broken ? 1 : 0;
  }
  return count;
}

void sumBondLoads(ContactSystem const &system, ContactRows const &rows, View<double *[2]> const &impulse,
                  Exchange const &exchange, std::vector<BondLoad> &load, WorkArrays const &work)
{
  if (load.empty())
    return;
  auto const row = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.row);
  auto const own = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), rows.own);
  View<double *[2]> const smooth = nodalImpulses({system, rows.row, impulse}, work);
  auto const p = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), smooth);
  double largest[3] = {0.0, 0.0, 0.0};
  auto const forEachTerm = [&](auto const &use)
  {
    for (int i = 0; i < rows.num_own; ++i)
    {
      ContactRow const &r = row(own(i));
      double const term[3] = {p(own(i), 0), p(own(i), 1), r.length};
      for (int c = 0; r.bond >= 0 && c < 3; ++c)
        use(static_cast<std::size_t>(r.bond), c, term[c]);
    }
  };
  forEachTerm([&](std::size_t, int c, double term) { largest[c] = std::max(largest[c], std::fabs(term)); });
  ReproducibleSum sum[3];
  for (int c = 0; c < 3; ++c)
    sum[c] = reproducibleSum(exchange.max(largest[c]), rows.num_multipliers);
  std::vector<long long> quanta(3 * load.size(), 0);
  forEachTerm([&](std::size_t bond, int c, double term)
              { quanta[3 * bond + static_cast<std::size_t>(c)] += sum[c].quanta(term); });
  exchange.sum(quanta.data(), static_cast<int>(quanta.size()));
  for (std::size_t i = 0; i < load.size(); ++i)
    load[i] = {sum[0].value(quanta[3 * i]), sum[1].value(quanta[3 * i + 1]), sum[2].value(quanta[3 * i + 2]),
               load[i].snapped};
}

bool snapRigidBonds(ContactRows const &rows, std::vector<RigidBody> const &bodies, std::vector<Bond> const &bonds,
                    ConstraintOptions const &options, double kick, std::vector<BondLoad> &load)
{
  if (bonds.empty() || bodies.size() < 2)
    return false;
  auto const law = onHost(options.interaction);
  std::vector<char> rigid(law.extent(0), 0);
  for (RigidBody const &body : bodies)
    rigid[static_cast<std::size_t>(body.material)] = 1;
  HostView<int *> const snapped("Harmos::constrain::snapped_host", bonds.size());
  bool any = false;
  for (std::size_t i = 0; i < bonds.size(); ++i)
  {
    Bond bond = bonds[i];
    bool const both =
        rigid[static_cast<std::size_t>(bond.material_a)] && rigid[static_cast<std::size_t>(bond.material_b)];
    if (bond.broken || load[i].snapped || !both)
      continue;
    carry(load[i], kick, bond);
    if (!breaks(bond.traction, law(bond.material_a, bond.material_b).strength))
      continue;
    load[i].snapped = any = true;
    snapped(i) = 1;
  }
  if (!any)
    return false;
  View<int *> const gone("Harmos::constrain::snapped", bonds.size());
  Kokkos::deep_copy(gone, snapped);
  View<ContactRow *> const row = rows.row;
  Kokkos::parallel_for(
      "Harmos::constrain::snapRigidBonds", RangePolicy(0, rows.count), KOKKOS_LAMBDA(int i) {
        if (row(i).bond >= 0 && gone(row(i).bond) != 0)
          row(i).tied = 0;
      });
  return true;
}

} // namespace Harmos
