// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CONTINUED_LINES_HPP
#define HARMOS_CONTINUED_LINES_HPP

#include <Harmos_BodyAround.hpp>
#include <Harmos_RemovalPlan.hpp>

namespace Harmos
{

constexpr double poor_continuation = 1e-2;  // continuedMisfit of lines that are no order for the bodies
constexpr double better_continuation = 0.1; // part of it that a better order of straight bodies has at most
constexpr double as_good_error = 25.0;      // momentErrors of such an order over those of the given one, at most

/// How a sequence of cuts, its lines continued, suits the neighbours:
///
///     m^2 = 1/N sum_k sum_j (g_kj - f_kj)^2,
///
/// N neighbours j, g_kj the part of one that lies on body k's side of all lines, f_kj what body k fills of it.
/// \param components Bodies and void, four at most.
/// \param around Of the first bodies.
template <int bodies>
KOKKOS_INLINE_FUNCTION double continuedMisfit(CellComponents const &components, RemovalPlan const &plan,
                                              BodyAround const (&around)[bodies])
{
  constexpr int most_lines = 3;
  Plane2 line[most_lines];
  Region polygon = components.polygon;
  ComponentSet rest = components.all();
  double misfit = 0.0;
  for (int i = 0; i < plan.count; ++i)
  {
    int const k = plan.component[i];
    bool const last = i + 1 == plan.count;
    rest &= ~(1u << k);
    if (!last)
    {
      Division const cut =
          divide(polygon, plan.normal[i], components.volume[k], components.volumeOf(rest), components.weight);
      line[i] = cut.line;
      polygon = cut.outside;
    }
    for (int j = 0; k < bodies && j < around[k].count; ++j)
    {
      double const miss = around[k].miss(j, line, last ? i : i + 1);
      misfit += miss * miss;
    }
    if (!last)
      line[i] = {-line[i].normal, -line[i].offset};
  }
  return misfit / Math::max(1, around[0].count);
}

} // namespace Harmos

#endif
