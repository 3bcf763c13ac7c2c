"""The actions of the domain model; importing this package registers them.

`movement` has the actions that move an actor, `lights` those for vehicle lights and traffic
lights, `environment` those for weather and light. An action reads the snapshot when it starts,
gives the world one command per slot (`planning` computes it from the modifiers), and ends when the
world reports that the goal is reached.
"""

from __future__ import annotations

from osc2tx_shared.registering import import_all

import_all(__name__, __path__)  # they register their actions
