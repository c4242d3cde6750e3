// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DualProblem.hpp>
#include <Harmos_DualRows.hpp>
#include <Harmos_VitalVertices.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace Harmos
{

namespace
{

int placeOf(std::vector<long long> const &key, long long wanted)
{
  return static_cast<int>(std::lower_bound(key.begin(), key.end(), wanted) - key.begin());
}

/// Where the blocks of rows lie in their matrix: lower triangle by rows, in any order of columns.
struct BlockPattern
{
  std::vector<int> offset = {0}, column;
};

BlockPattern blockPattern(DualRows const &rows)
{
  BlockPattern m;
  m.offset.reserve(rows.key.size() + 1);
  m.column = rows.other;
  for (int const count : rows.count)
    m.offset.push_back(m.offset.back() + count);
  return m;
}

/// Pairs of rows that one free body of few unknowns joins (isSmallBody).
std::vector<std::pair<int, int>> joinedByBodies(DualRows const &rows)
{
  std::vector<std::vector<int>> of_body;
  std::vector<int> unknowns;
  for (std::size_t i = 0; i < rows.row.size(); ++i)
    for (double const body : rows.row[i].body)
    {
      if (body < 0.0)
        continue;
      std::size_t const f = static_cast<std::size_t>(body);
      of_body.resize(std::max(of_body.size(), f + 1));
      unknowns.resize(of_body.size(), 0);
      of_body[f].push_back(static_cast<int>(i));
      unknowns[f] += static_cast<int>(rows.row[i].directions);
    }
  std::vector<std::pair<int, int>> joined;
  for (std::size_t f = 0; f < of_body.size(); ++f)
    for (std::size_t k = 0; isSmallBody(unknowns[f]) && k < of_body[f].size(); ++k)
      for (std::size_t l = 0; l < k; ++l)
        joined.emplace_back(of_body[f][k], of_body[f][l]);
  return joined;
}

/// Rows in an order that keeps those which share dof nodes, or a small body, near each other.
std::vector<int> orderRows(BlockPattern const &m, DualRows const &rows)
{
  int const n = static_cast<int>(m.offset.size()) - 1;
  std::vector<std::pair<int, int>> const joined = joinedByBodies(rows);
  auto const forEachPair = [&](auto const &visit)
  {
    for (auto const &[i, j] : joined)
      if (i != j)
        visit(i, j);
    for (int i = 0; i < n; ++i)
      for (int e = m.offset[i]; e < m.offset[i + 1]; ++e)
        if (i != m.column[e])
          visit(i, m.column[e]);
  };
  std::vector<int> offset(n + 1, 0), filled(n, 0);
  forEachPair(
      [&](int i, int j)
      {
        ++offset[i + 1];
        ++offset[j + 1];
      });
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<int> item(offset[n]);
  forEachPair(
      [&](int i, int j)
      {
        item[offset[i] + filled[i]++] = j;
        item[offset[j] + filled[j]++] = i;
      });
  return reverseCuthillMcKee(offset, item);
}

/// Scaled entries of the matrix, each in the row of its later unknown.
LowerTriangle scalarMatrix(BlockPattern const &m, DualRows const &rows, std::vector<int> const &first,
                           std::vector<double> const &root)
{
  std::vector<MatrixEntry> entry;
  entry.reserve(m.column.size() * (root.size() > rows.row.size() ? 4 : 1));
  int const n = static_cast<int>(m.offset.size()) - 1;
  for (int i = 0; i < n; ++i)
    for (int e = m.offset[i]; e < m.offset[i + 1]; ++e)
    {
      int const j = m.column[e];
      for (int k = 0; k < static_cast<int>(rows.row[i].directions); ++k)
        for (int l = 0; l < static_cast<int>(i == j ? k + 1 : rows.row[j].directions); ++l)
        {
          int const a = first[i] + k, b = first[j] + l;
          double const compliance = a == b ? rows.row[i].compliance[k] : 0.0;
          entry.push_back(
              {std::max(a, b), std::min(a, b), (rows.block[e].value[k][l] + compliance) / (root[a] * root[b])});
        }
    }
  return byRows(entry, root.size());
}

/// Everything but the matrix. \param first By row: its first unknown.
void fillUnknowns(DualRows const &rows, std::vector<int> const &order, std::vector<int> const &first,
                  DualProblem &problem)
{
  std::size_t const most = 2 * order.size();
  problem.root.reserve(most);
  problem.b.reserve(most);
  problem.tied.reserve(most);
  problem.normal_of.reserve(most);
  problem.friction.reserve(most);
  for (int const i : order)
  {
    DualRow const &row = rows.row[i];
    for (int k = 0; k < static_cast<int>(row.directions); ++k)
    {
      int const unknown = first[i] + k;
      bool const rubs = k == 1 && row.tied == 0.0;
      problem.root.push_back(std::sqrt(row.diagonal[k]));
      problem.b.push_back(row.predicted[k] / problem.root[unknown]);
      problem.tied.push_back(row.tied != 0.0 ? 1 : 0);
      problem.normal_of.push_back(rubs ? first[i] : -1);
      problem.friction.push_back(rubs ? row.friction * problem.root[unknown] / problem.root[first[i]] : 0.0);
      for (int side = 0; side < 2; ++side)
        for (int c = 0; row.body[side] >= 0.0 && c < 3; ++c)
          problem.body.push_back({unknown, 3 * static_cast<int>(row.body[side]) + c,
                                  row.jacobian[k][3 * side + c] / problem.root[unknown]});
    }
  }
}

/// Add up what has the same place, in the order of the list.
std::vector<MatrixEntry> merged(std::vector<MatrixEntry> entry)
{
  std::stable_sort(entry.begin(), entry.end(),
                   [](MatrixEntry const &a, MatrixEntry const &b)
                   { return a.row != b.row ? a.row < b.row : a.column < b.column; });
  std::vector<MatrixEntry> sum;
  for (MatrixEntry const &e : entry)
    if (!sum.empty() && sum.back().row == e.row && sum.back().column == e.column)
      sum.back().value += e.value;
    else
      sum.push_back(e);
  return sum;
}

/// Traces of all ranks' rows in the order of keys.
std::vector<RowTrace> allTraces(Mesh const &mesh, ContactSystem const &s, ContactRows const &rows,
                                std::vector<long long> const &own_key, Exchange const &exchange, WorkArrays const &work)
{
  View<RowTrace *> const trace = work.unset<RowTrace *>("Harmos::constrain::trace", s.num_own);
  View<ContactRow *> const row = rows.row;
  launchFor(
      "Harmos::constrain::rowTraces", s.num_own, KOKKOS_LAMBDA(int i) { trace(i) = rowTrace(mesh, row(s.own(i))); });
  std::vector<RowTrace> const own = toHost(trace);
  if (exchange.size() == 1)
    return own;
  std::vector<RowTrace> const all = gathered(own, exchange);
  std::vector<long long> const key = gathered(own_key, exchange);
  std::vector<int> order(key.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  std::vector<RowTrace> sorted;
  for (int const i : order)
    sorted.push_back(all[i]);
  return sorted;
}

/// Which rows may share a multiplier: same materials, same interaction.
std::vector<int> rowKinds(std::vector<RowTrace> const &trace, std::vector<DualRow> const &rows)
{
  std::vector<std::array<double, 4>> known;
  std::vector<int> kind;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    std::array<double, 4> const own = {static_cast<double>(trace[i].material[0]),
                                       static_cast<double>(trace[i].material[1]), rows[i].tied, rows[i].friction};
    auto const at = std::find(known.begin(), known.end(), own);
    kind.push_back(static_cast<int>(at - known.begin()));
    if (at == known.end())
      known.push_back(own);
  }
  return kind;
}

/// The unknowns of groups: two for those of rows with two directions, in the order in which the fine ones meet them.
Spread spreadOf(std::vector<std::vector<GroupShare>> const &shares, std::vector<DualRow> const &rows,
                std::vector<int> const &order, std::vector<int> const &first, int num_groups, int &unknowns)
{
  std::vector<int> first_of_group(num_groups, -1);
  Spread spread;
  unknowns = 0;
  for (int const i : order)
    for (GroupShare const &share : shares[i])
    {
      int const directions = static_cast<int>(rows[i].directions);
      if (first_of_group[share.group] < 0)
      {
        first_of_group[share.group] = unknowns;
        unknowns += directions;
      }
      for (int k = 0; k < directions; ++k)
        spread.entry.push_back({first[i] + k, first_of_group[share.group] + k, share.weight});
    }
  return spread;
}

/// What the rows' gaps add to the b of each unknown [m/s], where their groups take the least of it: between solids.
/// Beside a fluid, whose pressure changes with what is open, rows that bear through gaps would give energy (fluids that
/// ring without viscosity), and the mean in b stays.
std::vector<double> openings(std::vector<DualRow> const &rows, std::vector<RowTrace> const &trace,
                             std::vector<int> const &fluid, std::vector<int> const &first, int num_unknowns)
{
  std::vector<double> opening(num_unknowns, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    bool pressed = false;
    for (int const material : trace[i].material)
      pressed = pressed || (material >= 0 && !fluid.empty() && fluid[material] != 0);
    opening[first[i]] = pressed ? 0.0 : rows[i].opening;
  }
  return opening;
}

/// spread^T (problem) spread, in unknowns scaled by its own row sums; the spread's weights become those between scaled
/// unknowns. A group's gap is the least of its rows': with the mean, rows that touch would come into each other by as
/// much as the others close. \param opening Of b, by fine unknown.
DualProblem coarsen(DualProblem const &fine, std::vector<double> const &opening, int unknowns, Spread &spread)
{
  std::vector<std::vector<Spread::Entry>> by_fine(fine.size());
  for (Spread::Entry const &e : spread.entry)
    by_fine[e.fine].push_back(e);
  DualProblem coarse;
  coarse.body_weight = fine.body_weight;
  coarse.b.assign(unknowns, 0.0);
  coarse.tied.assign(unknowns, 0);
  coarse.normal_of.assign(unknowns, -1);
  coarse.friction.assign(unknowns, 0.0);
  std::vector<double> least_opening(unknowns, 1e300);
  std::vector<MatrixEntry> matrix, body;
  for (int u = 0; u < fine.size(); ++u)
    for (Spread::Entry const &e : by_fine[u])
    {
      coarse.b[e.coarse] += e.weight * (fine.root[u] * fine.b[u] - opening[u]);
      least_opening[e.coarse] = std::min(least_opening[e.coarse], opening[u]);
      coarse.tied[e.coarse] = fine.tied[u];
      if (fine.normal_of[u] >= 0)
      {
        coarse.normal_of[e.coarse] = e.coarse - 1;
        coarse.friction[e.coarse] = fine.friction[u] * fine.root[fine.normal_of[u]] / fine.root[u];
      }
      for (int k = fine.matrix.offset[u]; k < fine.matrix.offset[u + 1]; ++k)
      {
        int const v = fine.matrix.column[k];
        double const a = fine.matrix.value[k] * fine.root[u] * fine.root[v];
        for (Spread::Entry const &f : by_fine[v])
        {
          double const twice = u != v && e.coarse == f.coarse ? 2.0 : 1.0;
          if (u != v || e.coarse >= f.coarse)
            matrix.push_back(
                {std::max(e.coarse, f.coarse), std::min(e.coarse, f.coarse), twice * a * e.weight * f.weight});
        }
      }
    }
  for (BodyEntry const &entry : fine.body)
    for (Spread::Entry const &e : by_fine[entry.unknown])
      body.push_back({e.coarse, entry.component, e.weight * fine.root[entry.unknown] * entry.jacobian});
  matrix = merged(matrix);
  body = merged(body);
  std::vector<double> diagonal(unknowns, 0.0), rigid(unknowns, 0.0), held(unknowns, 0.0);
  for (MatrixEntry const &x : matrix)
  {
    diagonal[x.row] += std::fabs(x.value);
    diagonal[x.column] += x.row != x.column ? std::fabs(x.value) : 0.0;
  }
  for (MatrixEntry const &x : body)
    rigid[x.row] += x.value * x.value * coarse.body_weight[x.column];
  for (int u = 0; u < fine.size(); ++u)
    for (Spread::Entry const &e : by_fine[u])
      held[e.coarse] += e.weight * e.weight * fine.root[u] * fine.root[u];
  for (int i = 0; i < unknowns; ++i)
  {
    // Where node conditions leave nothing free to move, what the rows have without them (rowSum).
    bool const moves = diagonal[i] > 1e-12 * std::max(rigid[i], held[i]);
    coarse.root.push_back(std::sqrt(moves ? diagonal[i] : rigid[i] > 0.0 ? rigid[i] : held[i]));
    coarse.b[i] = (coarse.b[i] + least_opening[i]) / coarse.root[i];
    if (coarse.normal_of[i] >= 0)
      coarse.friction[i] *= coarse.root[i] / coarse.root[i - 1];
  }
  for (MatrixEntry &x : matrix)
    x.value /= coarse.root[x.row] * coarse.root[x.column];
  coarse.matrix = byRows(matrix, coarse.root.size());
  for (MatrixEntry const &x : body)
    coarse.body.push_back({x.row, x.column, x.value / coarse.root[x.row]});
  for (Spread::Entry &e : spread.entry)
    e.weight *= fine.root[e.fine] / coarse.root[e.coarse];
  return coarse;
}

} // namespace

void DualProblem::multiply(std::vector<double> const &x, std::vector<double> &out) const
{
  matrix.multiply(x, out);
  if (body.empty())
    return;
  std::vector<double> motion(body_weight.size(), 0.0);
  for (BodyEntry const &e : body)
    motion[e.component] += e.jacobian * x[e.unknown];
  for (BodyEntry const &e : body)
    out[e.unknown] += e.jacobian * body_weight[e.component] * motion[e.component];
}

void DualProblem::gradient(std::vector<double> const &x, std::vector<double> &out) const
{
  multiply(x, out);
  for (std::size_t i = 0; i < b.size(); ++i)
    out[i] += b[i];
}

double DualProblem::bodyTrace() const
{
  double trace = 0.0;
  for (BodyEntry const &e : body)
    trace += e.jacobian * e.jacobian * body_weight[e.component];
  return trace;
}

std::vector<double> AssembledProblem::unknownsOf(std::vector<ContactForce> const &force, double dt) const
{
  std::vector<double> x(rows.b.size(), 0.0);
  for (ContactForce const &f : force)
  {
    std::size_t const i = static_cast<std::size_t>(placeOf(key, f.key));
    if (i == key.size() || key[i] != f.key)
      continue;
    x[first[i]] = dt * f.normal * rows.root[first[i]];
    if (twoDirections(first[i]))
      x[first[i] + 1] = dt * f.tangential * rows.root[first[i] + 1];
  }
  return x;
}

std::vector<ContactForce> AssembledProblem::forcesOf(std::vector<double> const &x, double dt) const
{
  std::vector<ContactForce> force;
  for (std::size_t i = 0; i < key.size(); ++i)
  {
    int const u = first[i];
    double const across = twoDirections(u) ? x[u + 1] / (dt * rows.root[u + 1]) : 0.0;
    if (x[u] != 0.0 || across != 0.0)
      force.push_back({key[i], x[u] / (dt * rows.root[u]), across});
  }
  return force;
}

AssembledProblem assembleDualProblem(Mesh const &mesh, ContactSystem const &system, ContactRows const &rows,
                                     Placement placement, View<int *> const &fluid, Exchange const &exchange,
                                     WorkArrays const &work)
{
  View<long long *> const key = keysOf(rows, work);
  DualRows own = ownRows(system, key, work);
  bool const grouped = sharesMultipliers(placement);
  std::vector<long long> const own_key = grouped ? own.key : std::vector<long long>();
  std::vector<int> place;
  DualRows const all = allRows(std::move(own), key, exchange, place);
  BlockPattern const blocks = blockPattern(all);
  std::vector<int> const order = orderRows(blocks, all);
  std::vector<int> first(all.key.size());
  int unknowns = 0;
  for (int const i : order)
  {
    first[i] = unknowns;
    unknowns += static_cast<int>(all.row[i].directions);
  }
  AssembledProblem assembled;
  DualProblem &problem = assembled.rows;
  fillUnknowns(all, order, first, problem);
  problem.matrix = scalarMatrix(blocks, all, first, problem.root);
  auto const weight = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), system.body_inverse_mass);
  for (int f = 0; f < system.num_free; ++f)
    for (int c = 0; c < 3; ++c)
      problem.body_weight.push_back(weight(f, c));
  problem.first.reserve(rows.count);
  for (int const i : place)
    problem.first.push_back(i >= 0 ? first[i] : -1);
  assembled.key = all.key;
  assembled.first = first;
  if (grouped)
  {
    std::vector<RowTrace> const trace = allTraces(mesh, system, rows, own_key, exchange, work);
    int num_groups = 0, coarse = 0;
    auto const shares = vitalGroups(trace, rowKinds(trace, all.row), num_groups);
    assembled.spread = spreadOf(shares, all.row, order, first, num_groups, coarse);
    assembled.groups =
        coarsen(problem, openings(all.row, trace, toHost(fluid), first, unknowns), coarse, assembled.spread);
  }
  return assembled;
}

} // namespace Harmos
