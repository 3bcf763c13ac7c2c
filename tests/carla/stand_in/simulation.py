"""The simulation: settings, time, the actors of the level and what happens to them in a step."""

from __future__ import annotations

import secrets
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from .actors import Actor, Light, touch
from .blueprints import BLUEPRINTS, STREAMED, TYRE_FRICTION, Blueprint
from .dynamics import move
from .level import Level
from .rpc import CallError
from .snapshot import COLLISION, EPISODE_STREAM, WORLD_OBSERVER, collision, header, world_state
from .streams import StreamServer
from .traffic_lights import cycle

DEFAULT_STEP = 0.05  # s on the average, where none is fixed
UNEVEN = (0.6, 1.7, 0.7, 1.0)
"""Shares of it: frames take the time that they take (`docs/adv_synchrony_timestep.md`)."""

SETTINGS = [False, False, [False], True, 0.01, 10, 0.0, True, 3000.0, 2000.0, True]
WEATHER = [5.0, 0.0, 0.0, 10.0, -1.0, 45.0, 2.0, 0.75, 0.1, 0.0, 1.0, 0.03, 0.0331, 0.0]
TRIGGER = "static.trigger.friction"


class Simulation:
    """The world of the server.

    Args:
        folders: Where the maps are; the name of a map is that of its file.
        town: The first map.
        loading: Seconds until another map is there.

    Attributes:
        settings: In the order in which they travel.
        weather: So, too.
    """

    def __init__(self, folders: Iterable[Path], town: str, loading: float = 0.0) -> None:
        self.streams = StreamServer()
        self.maps = {file.stem: file for each in folders for file in sorted(each.glob("*.xodr"))}
        self.settings: list[Any] = list(SETTINGS)
        self.frame, self.time = 1, 0.0
        self._loading = loading
        self._next_level: tuple[str, str, Sequence[Any], float] | None = None
        self.load(town, self.maps[town].read_text(encoding="utf-8"))

    def load(self, name: str, text: str) -> None:
        """Begin a new episode on a map."""
        self.level = Level(name, text)
        self.weather: list[float] = list(WEATHER)
        self.actors: dict[int, Actor] = {}
        self._touching: set[tuple[int, int]] = set()
        self._last_id, self._last_stream = 0, EPISODE_STREAM
        self.episode, self._map_changed = secrets.randbits(32), True  # by lot, as `UCarlaEpisode`
        self.spectator = self._add(Blueprint("spectator"), [], [[0.0] * 3, [0.0] * 3])
        for sign, pose in self.level.traffic_lights():
            self._add(Blueprint("traffic.traffic_light"), [], pose).light = Light(sign)

    def load_soon(self, name: str, text: str, settings: Sequence[Any]) -> None:
        """Load a map at a later turn of the clock: the client has its answer by then."""
        self._next_level = (name, text, settings, time.monotonic() + self._loading)

    def load_now(self) -> None:
        """Load the map that was asked for, if its time has come."""
        if self._next_level is not None and time.monotonic() >= self._next_level[-1]:
            name, text, settings, _ = self._next_level
            self._next_level = None
            self.load(name, text)
            self.settings = list(settings)
            self.step()

    # --- actors -------------------------------------------------------------------------------

    def _add(self, blueprint: Blueprint, attributes: list[Any], pose: list[Any]) -> Actor:
        self._last_id += 1
        location, rotation = pose
        actor = Actor(self._last_id, blueprint, attributes, list(location), list(rotation))
        self.actors[actor.id] = actor
        return actor

    def actor(self, actor_id: int) -> Actor:
        """Return an actor; a CallError if there is none."""
        if actor_id not in self.actors:
            raise CallError(f"unable to find actor {actor_id}: it is gone or never was")
        return self.actors[actor_id]

    def lights(self) -> list[tuple[Actor, Light]]:
        """Return the traffic lights."""
        return [(each, each.light) for each in self.actors.values() if each.light is not None]

    def spawn(self, description: list[Any], pose: list[Any], parent: int = 0) -> Actor:
        """Add an actor where nothing else stands."""
        _, name, attributes = description
        if name not in BLUEPRINTS:
            raise CallError(f"blueprint {name} not found")
        actor = self._add(BLUEPRINTS[name], attributes, pose)
        actor.parent = parent
        others = [each for each in self.actors.values() if each is not actor and each.solid]
        if actor.solid and any(touch(actor, each) for each in others):
            del self.actors[actor.id]
            raise CallError("Spawn failed because of collision at spawn position")
        if name in STREAMED:
            self._last_stream += 1
            actor.stream = self._last_stream
        return actor

    def destroy(self, actor_id: int) -> None:
        """Remove an actor and those that are attached to it."""
        del self.actors[self.actor(actor_id).id]
        for child in [each.id for each in self.actors.values() if each.parent == actor_id]:
            self.destroy(child)

    def described(self, actor: Actor) -> list[Any]:
        """Return an actor as calls and collisions tell of it."""
        token = self.streams.token(actor.stream) if actor.stream else b""
        attributes = [list(each[:3]) for each in actor.attributes]
        description = [0, actor.blueprint.id, attributes]
        return [actor.id, actor.parent, description, self.box(actor), b"", token]

    def box(self, actor: Actor) -> list[Any]:
        """Return a bounding box in the axes of its actor."""
        up = actor.extent[2] if actor.kind == "vehicle" else 0.0
        return [[0.0, 0.0, up], list(actor.extent), [0.0, 0.0, 0.0], actor.id]

    # --- time ---------------------------------------------------------------------------------

    @property
    def synchronous(self) -> bool:
        """Whether time waits for a client."""
        return bool(self.settings[0])

    @property
    def dt(self) -> float:
        """Length of a step (s)."""
        fixed = self.settings[2]
        if fixed[0] and fixed[1]:
            return float(fixed[1])
        return DEFAULT_STEP * UNEVEN[self.frame % len(UNEVEN)]

    def step(self) -> None:
        """Go on by a step and tell everybody."""
        dt = self.dt
        triggers = [each for each in self.actors.values() if each.blueprint.id == TRIGGER]
        for actor in self.actors.values():
            if actor.kind == "vehicle":
                inside = [each for each in triggers if _covers(each, actor)]
                slippery = (float(each.attribute("friction")) for each in inside)
                actor.friction = min(slippery, default=TYRE_FRICTION)
            move(actor, dt)
            if actor.physics and actor.gravity and actor.kind in ("vehicle", "walker"):
                self._put_on_ground(actor)
            if actor.light is not None:
                cycle(actor.light, dt)
        for actor in self.actors.values():
            if actor.parent in self.actors:
                actor.location = list(self.actors[actor.parent].location)
        self.frame, self.time = self.frame + 1, self.time + dt
        self._tell_contacts()
        state = world_state(
            self.episode, dt, self.time, self._map_changed, list(self.actors.values())
        )
        self.streams.send(EPISODE_STREAM, header(WORLD_OBSERVER, self.frame, self.time) + state)
        self._map_changed = False

    def _put_on_ground(self, actor: Actor) -> None:
        ground = self.level.ground(actor.location, actor.rotation[1])
        if ground is None:
            return
        actor.location[2], slope = ground
        if actor.kind == "walker":
            actor.location[2] += actor.extent[2]
        else:
            actor.rotation[0] = slope

    def _tell_contacts(self) -> None:
        solid = [each for each in self.actors.values() if each.solid]
        touching = {
            (one.id, other.id)
            for i, one in enumerate(solid)
            for other in solid[i + 1 :]
            if {one.kind, other.kind} != {"static"} and touch(one, other)
        }
        for one, other in sorted(touching - self._touching):
            self._tell_contact(self.actors[one], self.actors[other])
            self._tell_contact(self.actors[other], self.actors[one])
        self._touching = touching

    def _tell_contact(self, me: Actor, other: Actor) -> None:
        impulse = [a - b for a, b in zip(other.velocity, me.velocity, strict=True)]
        content = collision(self.described(me), self.described(other), impulse)
        for sensor in self.actors.values():
            if sensor.parent == me.id and sensor.blueprint.id == "sensor.other.collision":
                self.streams.send(
                    sensor.stream, header(COLLISION, self.frame, self.time, me) + content
                )


def _covers(trigger: Actor, actor: Actor) -> bool:
    """Whether an actor is in the box of a trigger, whose attributes are in centimetres."""
    half = [float(trigger.attribute(f"extent_{axis}")) / 100.0 for axis in "xyz"]
    offsets = zip(actor.location, trigger.location, half, strict=True)
    return all(abs(a - b) <= most for a, b, most in offsets)
