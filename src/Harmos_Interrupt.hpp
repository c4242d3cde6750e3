// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_INTERRUPT_HPP
#define HARMOS_INTERRUPT_HPP

namespace Harmos
{

/// From now on SIGINT, SIGTERM and SIGUSR1 only raise a flag; a second one ends the program at once.
void catchInterrupts();

/// Whether a signal came in.
bool interrupted();

} // namespace Harmos

#endif
