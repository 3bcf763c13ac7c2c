"""Scenarios in CARLA 0.9.16: `--world carla`.

CARLA's client library runs in a process of its own (`client`): it can end the process it lives in,
and hold the interpreter while it waits. This side talks to it over a pipe (`client_process`), and
never waits for ever. That side lets go of the simulator however this one ends.

`world` makes the world: `connection` names what keeps a run from beginning, `level` requires or
loads the map. `attendance` is for those outside the run: a stack that attaches, a camera. `plant`
is the seam: `cast` knows what belongs to each actor, `blueprints` chooses its model, `tracking`
drives it by the `gains` of its kind. `frames`, `surroundings` and `motion_lights` put values into
CARLA's words; `sensors` reads sensor stacks. `checks` compares a server with what all of this
relies on. `capabilities` says what of the capability table holds in CARLA, and how.
"""

from __future__ import annotations

from .world import WORLD

__all__ = ["WORLD"]
