// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_DualRows.hpp>

#include <numeric>

namespace Harmos
{

namespace
{

/// visit(other row, u) for each shared dof of an own row and each row before it, and for the row itself: u[k] . d is
/// what the dof adds to the coupling of the row's direction k with the other row's direction d.
template <class Visitor>
KOKKOS_INLINE_FUNCTION void forEachCoupling(ContactSystem const &s, int row, Visitor const &visit)
{
  int const directions = s.directions(row);
  for (int c = 0; c < 8; ++c)
  {
    int const dof = s.dof(row, c);
    if (dof < 0)
      continue;
    double const scale = s.inverse_mass(dof) * s.weight(row, c);
    Vector2 free[2]; // directions of the row, as far as the node conditions let them act
    for (int k = 0; k < directions; ++k)
      free[k] = s.condition(dof).project(s.direction(row, k));
    for (int e = s.rows_of.offset(dof); e < s.rows_of.offset(dof + 1); ++e)
    {
      unsigned const item = static_cast<unsigned>(s.rows_of.item(e));
      int const other = static_cast<int>(item / 8u);
      if (other > row)
        break;
      double const w = scale * s.row(other).weight[item % 8u];
      Vector2 const u[2] = {w * free[0], directions == 2 ? w * free[1] : Vector2{0.0, 0.0}};
      visit(other, u);
    }
  }
}

/// Most visits of forEachCoupling, which may come to a row more than once: later rows are counted too.
KOKKOS_INLINE_FUNCTION int mostBlocks(ContactSystem const &s, int row)
{
  int count = 0;
  for (int c = 0; c < 8; ++c)
  {
    int const dof = s.dof(row, c);
    count += dof < 0 ? 0 : s.rows_of.offset(dof + 1) - s.rows_of.offset(dof);
  }
  return count;
}

KOKKOS_INLINE_FUNCTION DualRow dualRow(ContactSystem const &s, int row)
{
  DualRow d = {};
  d.directions = s.directions(row);
  d.tied = s.tied(row);
  d.friction = s.friction(row);
  d.opening = s.row(row).opening;
  for (int side = 0; side < 2; ++side)
    d.body[side] = s.freeBody(row, side);
  for (int k = 0; k < s.directions(row); ++k)
  {
    d.predicted[k] = s.predicted(row, k);
    d.diagonal[k] = s.diagonal(row, k);
    d.compliance[k] = s.row(row).compliance[k];
    for (int side = 0; side < 2; ++side)
      for (int c = 0; s.freeBody(row, side) >= 0 && c < 3; ++c)
        d.jacobian[k][3 * side + c] = s.bodyJacobian(row, side, k, c);
  }
  return d;
}

/// Append items offset(i) .. offset(i) + count[i] - 1 of all i.
template <class T>
void appendRanges(View<int *> const &offset, std::vector<int> const &count, View<T *> const &item, std::vector<T> &out)
{
  auto const begin = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), offset);
  auto const from = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), item);
  out.reserve(std::accumulate(count.begin(), count.end(), std::size_t(0)));
  for (std::size_t i = 0; i < count.size(); ++i)
    out.insert(out.end(), from.data() + begin(i), from.data() + begin(i) + count[i]);
}

std::vector<long long> sorted(std::vector<long long> keys)
{
  std::sort(keys.begin(), keys.end());
  return keys;
}

} // namespace

View<long long *> keysOf(ContactRows const &rows, WorkArrays const &work)
{
  View<long long *> const key = work.unset<long long *>("Harmos::constrain::key", rows.count);
  View<ContactRow *> const row = rows.row;
  launchFor(
      "Harmos::constrain::keysOf", rows.count, KOKKOS_LAMBDA(int i) { key(i) = row(i).key; });
  return key;
}

DualRows ownRows(ContactSystem const &s, View<long long *> const &key, WorkArrays const &work)
{
  View<DualRow *> const row = work.unset<DualRow *>("Harmos::constrain::dual_row", s.num_own);
  View<long long *> const own_key = work.unset<long long *>("Harmos::constrain::own_key", s.num_own);
  View<int *> const count = work.unset<int *>("Harmos::constrain::block_count", s.num_own);
  View<int *> const offset = work.unset<int *>("Harmos::constrain::block_offset", s.num_own);
  int room = 0;
  launchScan(
      "Harmos::constrain::roomForBlocks", s.num_own,
      KOKKOS_LAMBDA(int i, int &sum, bool final) {
        if (final)
          offset(i) = sum;
        sum += mostBlocks(s, s.own(i));
      },
      room);
  View<DualBlock *> const block = work.unset<DualBlock *>("Harmos::constrain::block", room);
  View<int *> const other = work.unset<int *>("Harmos::constrain::other", room);
  launchFor(
      "Harmos::constrain::fillBlocks", s.num_own, KOKKOS_LAMBDA(int i) {
        row(i) = dualRow(s, s.own(i));
        own_key(i) = key(s.own(i));
        int const begin = offset(i), directions = s.directions(s.own(i));
        int end = begin;
        forEachCoupling(s, s.own(i),
                        [&](int other_row, Vector2 const(&u)[2])
                        {
                          int at = begin;
                          while (at < end && other(at) != other_row)
                            ++at;
                          if (at == end)
                          {
                            other(end) = other_row;
                            block(end++) = DualBlock{};
                          }
                          double(&value)[2][2] = block(at).value;
                          int const its_directions = s.directions(other_row);
                          for (int k = 0; k < directions; ++k)
                            for (int l = 0; l < its_directions; ++l)
                              value[k][l] += dot(u[k], s.direction(other_row, l));
                        });
        count(i) = end - begin;
      });
  DualRows own{toHost(own_key), toHost(row), toHost(count), {}, {}};
  appendRanges(offset, own.count, other, own.other);
  appendRanges(offset, own.count, block, own.block);
  return own;
}

DualRows allRows(DualRows own, View<long long *> const &key, Exchange const &exchange, std::vector<int> &place)
{
  place.resize(key.extent(0));
  if (exchange.size() == 1)
  {
    std::iota(place.begin(), place.end(), 0);
    return own;
  }
  std::vector<long long> all_keys = gathered(own.key, exchange);
  std::vector<long long> const in_order = sorted(all_keys), here = toHost(key);
  for (std::size_t i = 0; i < here.size(); ++i)
  {
    auto const at = std::lower_bound(in_order.begin(), in_order.end(), here[i]);
    place[i] = at != in_order.end() && *at == here[i] ? static_cast<int>(at - in_order.begin()) : -1;
  }
  for (int &other : own.other)
    other = place[other];
  DualRows const all{std::move(all_keys), gathered(own.row, exchange), gathered(own.count, exchange),
                     gathered(own.other, exchange), gathered(own.block, exchange)};
  std::vector<long long> begin(all.count.size() + 1, 0);
  std::partial_sum(all.count.begin(), all.count.end(), begin.begin() + 1);
  std::vector<int> order(all.key.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return all.key[a] < all.key[b]; });
  DualRows rows;
  for (int const i : order)
  {
    rows.key.push_back(all.key[i]);
    rows.row.push_back(all.row[i]);
    rows.count.push_back(all.count[i]);
    rows.other.insert(rows.other.end(), all.other.begin() + begin[i], all.other.begin() + begin[i + 1]);
    rows.block.insert(rows.block.end(), all.block.begin() + begin[i], all.block.begin() + begin[i + 1]);
  }
  return rows;
}

} // namespace Harmos
