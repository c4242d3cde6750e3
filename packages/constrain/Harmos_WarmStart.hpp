// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_WARM_START_HPP
#define HARMOS_WARM_START_HPP

#include <Harmos_ContactSystem.hpp>

namespace Harmos
{

/// Impulses f dt of this rank's rows, the halo's included, from the forces f of rows with the same key, within their
/// bounds; zero where nothing is known.
/// \param last Of all ranks' rows, by key. \param p Out, num_rows; \param reach Out: friction's bounds by it.
void beginAtForces(ContactSystem const &system, ContactRows const &rows, std::vector<ContactForce> const &last,
                   double dt, View<double *[2]> const &p, View<double *> const &reach, WorkArrays const &work);

/// Forces p / dt of all ranks' rows by key, those of no impulse left out; the same on every rank. Collective.
std::vector<ContactForce> forcesOf(ContactSystem const &system, ContactRows const &rows, View<double *[2]> const &p,
                                   double dt, Exchange const &exchange, WorkArrays const &work);

} // namespace Harmos

#endif
