// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DualProblem.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Harmos
{

namespace
{

/// A row without its couplings.
struct DualRow
{
  double directions, tied, friction;
  double predicted[2], diagonal[2];
  double body[2];        // compact numbers
  double jacobian[2][6]; // by direction: of side a's body, of side b's
};

/// Part of the coupling of a row to one that is not behind it in the order of keys, by one dof node.
struct DualBlock
{
  double value[2][2]; // by direction of the row, of the other row
};

/// Rows with their couplings, in the order of keys.
struct DualRows
{
  std::vector<long long> key;
  std::vector<DualRow> row;
  std::vector<long long> count; // blocks of a row
  std::vector<long long> other; // key of the other row of a block
  std::vector<DualBlock> block;
};

/// visit(other row, block) for each shared dof of an own row and each row before it, and for the row itself.
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forEachBlock(ContactSystem const &s, int row, Visitor const &visit)
{
  for (int c = 0; c < 8; ++c)
  {
    int const dof = s.dof(row, c);
    if (dof < 0)
      continue;
    double const scale = s.inverse_mass(dof) * s.weight(row, c);
    for (int e = s.rows_of.offset(dof); e < s.rows_of.offset(dof + 1); ++e)
    {
      int const other = s.rows_of.item(e) / 8;
      if (other > row)
        break;
      double const w = scale * s.weight(other, s.rows_of.item(e) % 8);
      DualBlock block = {};
      for (int k = 0; k < s.directions(row); ++k)
      {
        Vector2 const u = w * s.condition(dof).project(s.direction(row, k));
        for (int l = 0; l < s.directions(other); ++l)
          block.value[k][l] = dot(u, s.direction(other, l));
      }
      visit(other, block);
    }
  }
}

KOKKOS_INLINE_FUNCTION DualRow dualRow(ContactSystem const &s, int row)
{
  DualRow d = {};
  d.directions = s.directions(row);
  d.tied = s.tied(row);
  d.friction = s.friction(row);
  for (int side = 0; side < 2; ++side)
    d.body[side] = s.free_body(row, side);
  for (int k = 0; k < s.directions(row); ++k)
  {
    d.predicted[k] = s.predicted(row, k);
    d.diagonal[k] = s.diagonal(row, k);
    for (int side = 0; side < 2; ++side)
      for (int c = 0; s.free_body(row, side) >= 0 && c < 3; ++c)
        d.jacobian[k][3 * side + c] = s.bodyJacobian(row, side, k, c);
  }
  return d;
}

template <class T>
std::vector<T> toHost(View<T *> const &view)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
  return std::vector<T>(host.data(), host.data() + host.extent(0));
}

View<long long *> keysOf(ContactRows const &rows)
{
  View<long long *> const key(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::key"), rows.count);
  View<ContactRow *> const row = rows.row;
  Kokkos::parallel_for(
      "Harmos::constrain::keysOf", RangePolicy(0, rows.count), KOKKOS_LAMBDA(int i) { key(i) = row(i).key; });
  return key;
}

/// This rank's own rows.
DualRows ownRows(ContactSystem const &s, View<long long *> const &key)
{
  View<DualRow *> const row("Harmos::constrain::dual_row", s.num_own);
  View<long long *> const own_key("Harmos::constrain::own_key", s.num_own);
  View<long long *> const count("Harmos::constrain::block_count", s.num_own);
  View<int *> const offset("Harmos::constrain::block_offset", s.num_own);
  int total = 0;
  Kokkos::parallel_scan(
      "Harmos::constrain::countBlocks", RangePolicy(0, s.num_own),
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        int blocks = 0;
        forEachBlock(s, s.own(i), [&](int, DualBlock const &) { ++blocks; });
        if (final)
        {
          row(i) = dualRow(s, s.own(i));
          own_key(i) = key(s.own(i));
          count(i) = blocks;
          offset(i) = sum;
        }
        sum += blocks;
      },
      total);
  View<DualBlock *> const block(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::block"), total);
  View<long long *> const other(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::other"), total);
  Kokkos::parallel_for(
      "Harmos::constrain::fillBlocks", RangePolicy(0, s.num_own), KOKKOS_LAMBDA(int i) {
        int at = offset(i);
        forEachBlock(s, s.own(i),
                     [&](int other_row, DualBlock const &b)
                     {
                       other(at) = key(other_row);
                       block(at++) = b;
                     });
      });
  return {toHost(own_key), toHost(row), toHost(count), toHost(other), toHost(block)};
}

/// The items of all ranks, in the order of ranks. T: made of `Part`s.
template <class Part, class T>
std::vector<T> gathered(std::vector<T> const &mine, Exchange const &exchange)
{
  std::vector<long long> count(static_cast<std::size_t>(exchange.size()), 0);
  count[static_cast<std::size_t>(exchange.rank())] = static_cast<long long>(mine.size());
  exchange.sum(count.data(), exchange.size());
  auto const here = count.begin() + exchange.rank();
  std::vector<T> all(static_cast<std::size_t>(std::accumulate(count.begin(), count.end(), 0LL)), T{});
  std::copy(mine.begin(), mine.end(), all.begin() + std::accumulate(count.begin(), here, 0LL));
  exchange.sum(reinterpret_cast<Part *>(all.data()), static_cast<int>(all.size() * (sizeof(T) / sizeof(Part))));
  return all;
}

/// The rows of all ranks in the order of keys.
DualRows allRows(DualRows const &own, Exchange const &exchange)
{
  if (exchange.size() == 1)
    return own;
  DualRows const all{gathered<long long>(own.key, exchange), gathered<double>(own.row, exchange),
                     gathered<long long>(own.count, exchange), gathered<long long>(own.other, exchange),
                     gathered<double>(own.block, exchange)};
  std::vector<long long> begin(all.count.size() + 1, 0);
  std::partial_sum(all.count.begin(), all.count.end(), begin.begin() + 1);
  std::vector<int> order(all.key.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return all.key[a] < all.key[b]; });
  DualRows sorted;
  for (int const i : order)
  {
    sorted.key.push_back(all.key[i]);
    sorted.row.push_back(all.row[i]);
    sorted.count.push_back(all.count[i]);
    sorted.other.insert(sorted.other.end(), all.other.begin() + begin[i], all.other.begin() + begin[i + 1]);
    sorted.block.insert(sorted.block.end(), all.block.begin() + begin[i], all.block.begin() + begin[i + 1]);
  }
  return sorted;
}

int placeOf(std::vector<long long> const &key, long long wanted)
{
  return static_cast<int>(std::lower_bound(key.begin(), key.end(), wanted) - key.begin());
}

/// Blocks with those of the same two rows added up: lower triangle by rows, in any order of columns.
struct BlockMatrix
{
  std::vector<int> offset = {0}, column;
  std::vector<DualBlock> block;
};

BlockMatrix mergeBlocks(DualRows const &rows)
{
  BlockMatrix m;
  std::vector<int> found(rows.key.size(), -1);
  std::size_t from = 0;
  for (std::size_t i = 0; i < rows.key.size(); ++i)
  {
    for (long long k = 0; k < rows.count[i]; ++k, ++from)
    {
      // Most couple to themselves or to the last ones.
      int const j = rows.other[from] == rows.key[i] ? static_cast<int>(i) : placeOf(rows.key, rows.other[from]);
      if (found[j] < m.offset.back())
      {
        found[j] = static_cast<int>(m.column.size());
        m.column.push_back(j);
        m.block.push_back(DualBlock{});
      }
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
          m.block[found[j]].value[a][b] += rows.block[from].value[a][b];
    }
    m.offset.push_back(static_cast<int>(m.column.size()));
  }
  return m;
}

/// Rows in an order that keeps those which share dof nodes near each other.
std::vector<int> orderRows(BlockMatrix const &m)
{
  int const n = static_cast<int>(m.offset.size()) - 1;
  std::vector<int> offset(n + 1, 0), item(2 * m.column.size()), filled(n, 0);
  for (int i = 0; i < n; ++i)
    for (int e = m.offset[i]; e < m.offset[i + 1]; ++e)
      if (m.column[e] != i)
      {
        ++offset[i + 1];
        ++offset[m.column[e] + 1];
      }
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  for (int i = 0; i < n; ++i)
    for (int e = m.offset[i]; e < m.offset[i + 1]; ++e)
    {
      int const j = m.column[e];
      if (j == i)
        continue;
      item[offset[i] + filled[i]++] = j;
      item[offset[j] + filled[j]++] = i;
    }
  return reverseCuthillMcKee(offset, item);
}

/// Scaled entries of the matrix, each in the row of its later unknown.
LowerTriangle scalarMatrix(BlockMatrix const &m, DualRows const &rows, std::vector<int> const &first,
                           std::vector<double> const &root)
{
  struct Entry
  {
    int row, column;
    double value;
  };
  std::vector<Entry> entry;
  int const n = static_cast<int>(m.offset.size()) - 1;
  for (int i = 0; i < n; ++i)
    for (int e = m.offset[i]; e < m.offset[i + 1]; ++e)
    {
      int const j = m.column[e];
      for (int k = 0; k < static_cast<int>(rows.row[i].directions); ++k)
        for (int l = 0; l < static_cast<int>(i == j ? k + 1 : rows.row[j].directions); ++l)
        {
          int const a = first[i] + k, b = first[j] + l;
          entry.push_back({std::max(a, b), std::min(a, b), m.block[e].value[k][l] / (root[a] * root[b])});
        }
    }
  LowerTriangle matrix;
  matrix.offset.assign(root.size() + 1, 0);
  for (Entry const &x : entry)
    ++matrix.offset[x.row + 1];
  std::partial_sum(matrix.offset.begin(), matrix.offset.end(), matrix.offset.begin());
  std::vector<int> next(matrix.offset.begin(), matrix.offset.end() - 1);
  matrix.column.resize(entry.size());
  matrix.value.resize(entry.size());
  for (Entry const &x : entry)
  {
    matrix.column[next[x.row]] = x.column;
    matrix.value[next[x.row]++] = x.value;
  }
  return matrix;
}

/// Everything but the matrix. \param first By row: its first unknown.
void fillUnknowns(DualRows const &rows, std::vector<int> const &order, std::vector<int> const &first,
                  DualProblem &problem)
{
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

} // namespace

void DualProblem::multiply(std::vector<double> const &x, std::vector<double> &out) const
{
  matrix.multiply(x, out);
  std::vector<double> motion(body_weight.size(), 0.0);
  for (BodyEntry const &e : body)
    motion[e.component] += e.jacobian * x[e.unknown];
  for (BodyEntry const &e : body)
    out[e.unknown] += e.jacobian * body_weight[e.component] * motion[e.component];
}

double DualProblem::bodyTrace() const
{
  double trace = 0.0;
  for (BodyEntry const &e : body)
    trace += e.jacobian * e.jacobian * body_weight[e.component];
  return trace;
}

DualProblem assembleDualProblem(ContactSystem const &system, ContactRows const &rows, Exchange const &exchange)
{
  View<long long *> const key = keysOf(rows);
  DualRows const all = allRows(ownRows(system, key), exchange);
  BlockMatrix const blocks = mergeBlocks(all);
  std::vector<int> const order = orderRows(blocks);
  std::vector<int> first(all.key.size());
  int unknowns = 0;
  for (int const i : order)
  {
    first[i] = unknowns;
    unknowns += static_cast<int>(all.row[i].directions);
  }
  DualProblem problem;
  fillUnknowns(all, order, first, problem);
  problem.matrix = scalarMatrix(blocks, all, first, problem.root);
  auto const weight = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), system.body_inverse_mass);
  for (int f = 0; f < system.num_free; ++f)
    for (int c = 0; c < 3; ++c)
      problem.body_weight.push_back(weight(f, c));
  for (long long const k : toHost(key))
  {
    int const i = placeOf(all.key, k);
    bool const known = i < static_cast<int>(all.key.size()) && all.key[i] == k;
    problem.first.push_back(known ? first[i] : -1);
  }
  return problem;
}

} // namespace Harmos
