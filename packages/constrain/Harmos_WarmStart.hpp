// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_WARM_START_HPP
#define HARMOS_WARM_START_HPP

#include <Harmos_ContactSystem.hpp>

namespace Harmos
{

/// Impulses f dt of this rank's rows, the halo's included, from the forces f of rows with the same key, within their
/// bounds; zero where nothing is known.
///
/// \param last  Of all ranks' rows, ascending by key [N/m]. \param dt Of this step [s].
/// \param p     Out, num_rows [N s/m]. \param reach Out, num_rows: friction's bounds mu p_n [N s/m].
void beginAtForces(ContactSystem const &system, ContactRows const &rows, std::vector<ContactForce> const &last,
                   double dt, View<double *[2]> const &p, View<double *> const &reach, WorkArrays const &work);

/// Forces p / dt of all ranks' rows, ascending by key, those of no impulse left out; the same on every rank. Collective.
///
/// \param p num_rows, own rows are read [N s/m]. \param dt [s] \return [N/m]
std::vector<ContactForce> forcesOf(ContactSystem const &system, ContactRows const &rows, View<double *[2]> const &p,
                                   double dt, Exchange const &exchange, WorkArrays const &work);

} // namespace Harmos

#endif
