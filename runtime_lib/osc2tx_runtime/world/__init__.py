"""The world in which a scenario runs.

Input: placed actors and one command per actor and slot. Output: states, collisions. Begin at
`protocol` (what every world offers); `embedded` is the world that needs no simulator. Then, in
order of control flow: `commands`, `actor_motion` (the commands of one actor) and `actor_step` (one
actor over one step) with `longitudinal` and `lateral` (commands at work) on the closed forms of
`profiles` and `function_profiles`, `attitude`, `collision`, `distances`; `state` and
`actor_dimensions` are plain values.

Invariants: fixed step, sequences and ordered dicts only, no clock, no random numbers. Commands
given at step k act from k to k+1; everything one can read is the state of step k.
"""

from __future__ import annotations

from .actor_dimensions import Limits, Shape
from .commands import Command
from .embedded import EmbeddedWorld
from .protocol import ActorSpec, LightState, Progress, World
from .state import ActorState

__all__ = [
    "ActorSpec",
    "ActorState",
    "Command",
    "EmbeddedWorld",
    "LightState",
    "Limits",
    "Progress",
    "Shape",
    "World",
]
