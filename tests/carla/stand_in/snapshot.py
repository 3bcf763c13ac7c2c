"""What streams carry: the header of all messages, the state of the world, collisions."""

from __future__ import annotations

import struct
from collections.abc import Iterable
from typing import Any

import msgpack

from .actors import Actor

EPISODE_STREAM = 1
WORLD_OBSERVER, COLLISION = 17, 0
"""Places in the client library's registry of sensors."""

ACTIVE, DORMANT = 1, 2
"""States of an actor."""

STATE_BYTES = 54  # of one kind of actor
SPEED_LIMIT, GREEN_LIGHT = 90.0, 2


def header(sensor: int, frame: int, time: float, actor: Actor | None = None) -> bytes:
    """Return the first 48 bytes of a message."""
    pose = [0.0] * 6 if actor is None else [*actor.location, *actor.rotation]
    return struct.pack("<QQd6f", sensor, frame, time, *pose)


def world_state(
    episode: int, dt: float, time: float, map_changed: bool, actors: Iterable[Actor]
) -> bytes:
    """Return the snapshot that follows a header."""
    head = struct.pack("<Qdf3iI", episode, time, dt, 0, 0, 0, int(map_changed))
    return head + b"".join(map(actor_state, actors))


def actor_state(actor: Actor) -> bytes:
    """Return the state of an actor in 119 bytes."""
    state = DORMANT if actor.dormant else ACTIVE
    motion = (*actor.velocity, *actor.turning, *actor.acceleration)
    head = struct.pack("<IB6f9f", actor.id, state, *actor.location, *actor.rotation, *motion)
    return head + _of_kind(actor).ljust(STATE_BYTES, b"\0")


def _of_kind(actor: Actor) -> bytes:
    if actor.light is not None:
        light = actor.light
        red, yellow, green = light.times
        name = light.sign.encode()[:32]
        times = struct.pack("<32s4fI", name, green, yellow, red, light.since, 0)
        return times + struct.pack("<BB", light.frozen, light.state)
    if actor.kind == "vehicle":
        control = struct.pack("<fff???i", *actor.control)
        return control + struct.pack("<fBBIB", SPEED_LIMIT, GREEN_LIGHT, 0, 0, 0)
    if actor.kind == "walker":
        direction, speed, jump = actor.walk
        return struct.pack("<4f?", *direction, speed, jump)
    return b""


def collision(one: list[Any], other: list[Any], impulse: list[float]) -> bytes:
    """Return a collision between two actors, as calls tell of them."""
    content: bytes = msgpack.packb([one, other, impulse])
    return content
