"""Monitors: the conditions of the modifiers of an action, checked on the states of its phase.

A modifier is a condition on the states between the start and the end of its action (DSL 8.9.1.1.1):
at the first one (`at: start`), at the last one (`at: end`), or at all. Planning makes the actor
meet it; a monitor checks whether it did, from states alone: the planner, its commands and its
progress are never asked. So it finds errors of the planner, and simulators that do not follow the
commands.

`monitors` registers the monitor of a modifier, `stands_for` the modifiers that an action implies
(the standard's semantic clarification), `unmonitored` the reason why there is none. `phase` checks
the phase of one action, `run` all phases of a run; ADR 6 defines failures and warnings.
"""

from __future__ import annotations

from osc2tx_shared.registering import import_all

import_all(__name__, __path__)  # monitors register
