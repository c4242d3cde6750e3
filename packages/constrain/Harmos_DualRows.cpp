// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DualRows.hpp>

#include <numeric>

namespace Harmos
{

namespace
{

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

} // namespace

View<long long *> keysOf(ContactRows const &rows)
{
  View<long long *> const key(Kokkos::view_alloc(Kokkos::WithoutInitializing, "Harmos::constrain::key"), rows.count);
  View<ContactRow *> const row = rows.row;
  Kokkos::parallel_for(
      "Harmos::constrain::keysOf", RangePolicy(0, rows.count), KOKKOS_LAMBDA(int i) { key(i) = row(i).key; });
  return key;
}

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

DualRows allRows(DualRows const &own, Exchange const &exchange)
{
  if (exchange.size() == 1)
    return own;
  DualRows const all{gathered(own.key, exchange), gathered(own.row, exchange), gathered(own.count, exchange),
                     gathered(own.other, exchange), gathered(own.block, exchange)};
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

} // namespace Harmos
