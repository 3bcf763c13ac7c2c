"""Scenarios in CARLA 0.9.16: `--world carla`.

CARLA's client library runs in a separate process (`client`): it can end its process, and block the
interpreter while it waits. The run communicates with it over a pipe (`client_process`) with time
limits. The process restores the simulator however the run ends.

`world` creates the world: `connection` reports why a run cannot begin, `level` requires or loads
the map. `attendance` serves observers: software under test that attaches, a camera. `plant` is the
interface: `cast` has the state of each actor, `blueprints` chooses its model, `tracking` drives it
by the `gains` of its kind. `frames`, `surroundings` and `motion_lights` convert values to those of
CARLA; `sensors` reads sensor stacks. `checks` checks a server against the requirements of runs.
`capabilities` has the support of the capability table in CARLA.
"""

from __future__ import annotations

from .world import WORLD

__all__ = ["WORLD"]
