"""The world in which a scenario runs.

Input: placed actors and one command per actor and slot. Output: states, collisions. Begin at
`protocol` (what every world offers); `embedded` is the one there is, and `plant` what moves its
actors: a simulator, or nothing. In order of control flow: `commands`, `actor_motion` (the commands
of one actor) and `actor_step` (one actor over one step) with `longitudinal` and `lateral` (commands
at work) on the closed forms of `profiles` and `function_profiles` give the wished states; `cruise`
gives those of who just goes on; `scene` hands them to the plant with `reference_path` beyond them,
`measurement` is what comes back, `anchoring` puts the actors there, `tracking` says whether they
have done what they were to do.
`driving`, `drivers` and `single_track` let somebody else drive, `expectations` measure that.
`attitude`, `collision`, `distances`, `feasibility` serve all; `state` and `actor_dimensions` are
plain values.

Invariants: fixed step, sequences and ordered dicts only, no clock, no random numbers. Commands
given at step k act from k to k+1; everything one can read is the state of step k.
"""

from __future__ import annotations

from .actor_dimensions import Limits, Shape
from .commands import Command
from .embedded import EmbeddedWorld
from .features import FEATURES
from .measurement import Measurement
from .plant import Plant
from .protocol import ActorSpec, LightState, Progress, World
from .scene import Scene, Setpoint
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
