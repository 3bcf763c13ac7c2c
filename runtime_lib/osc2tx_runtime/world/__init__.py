"""The world in which a scenario runs.

Input: placed actors and one command per actor and slot. Output: states, collisions. Start reading
at `protocol` (the interface of every world); `embedded` implements it. Folders, in the order of a
step:

- `commands` are given by actions, `checks` check those of user code.
- `motion` moves one actor over one step, with `longitudinal`, `lateral`, `geometry` and `grip`.
- `plant` hands the commanded states to the system that moves the actors (a simulator, or none) and
  takes its measurements back; `tracking` decides from them whether goals are reached; `drivers` let
  an external driver steer instead.
- `measuring` computes distances, velocities and contacts; `surroundings` traffic lights and sky.

Invariants: fixed step, sequences and ordered dicts only, no clock, no random numbers. Commands
given at step k act from k to k+1; all readable values are those of step k.
"""

from __future__ import annotations

from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.plant import Plant
from osc2tx_runtime.world.plant.scene import Scene, Setpoint

from .actor_dimensions import Limits, Shape
from .commands import Command
from .embedded import EmbeddedWorld
from .protocol import FEATURES, ActorSpec, LightState, Progress, World
from .state import ActorState

__all__ = [
    "FEATURES",
    "ActorSpec",
    "ActorState",
    "Command",
    "EmbeddedWorld",
    "LightState",
    "Limits",
    "Measurement",
    "Plant",
    "Progress",
    "Scene",
    "Setpoint",
    "Shape",
    "World",
]
