"""A session with a server: it undoes its changes in the end."""

from __future__ import annotations

import math
import socket
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import carla

from . import release_of
from .commands import command_of
from .snapshots import Collisions, actor_state, light_states

GLANCE = 0.5  # s to wait for a step of another client before it is looked for
SUBSTEP, MOST_SUBSTEPS = 0.01, 16
"""s, and how many of them the server makes in a step at most."""

LISTENS = 2.0  # s that a port has to take a connection
TICKS = 2.0  # s without a step after which no client counts as making them


class Session:
    """Connection, level and time; its methods are requests, with values that JSON knows.

    Attributes:
        client: Of the library.
        world: Its world.
        timeout: How long (s) a call may take.
        ticks: Steps are made by this session.
        undo: What undoes its changes, from the last one on.
        watched: Actors whose states a look returns.
        lights: Traffic lights, whose states it returns, too.
        collisions: Reports of sensors.
    """

    def __init__(self) -> None:
        self.client: Any = None
        self.world: Any = None
        self.timeout = 0.0
        self.undo: list[Callable[[], object]] = []
        self.ticks = False
        self.collisions = Collisions()
        self.lights: dict[str, Any] = {}
        self._frame: int | None = None
        self.watched: list[int] = []

    # --- connection and map -------------------------------------------------------------------

    def connect(self, host: str, port: int, timeout: float) -> Mapping[str, Any]:
        """Return the findings of a first contact, up to the first missing part.

        Returns:
            `listens`: a port answers. `server`, `client`: versions; they have to be of one release,
            since others may not even have the same calls. `streams`: snapshots arrive; else
            `stream_port` says whether the port of the streams, the next one by default, answers.
            `synchronous`: steps wait for a client, which makes them if `ticks`; `dt` (s): theirs.
        """
        self._address, self.timeout = (host, port), timeout
        found: dict[str, Any] = {"listens": listens(host, port)}
        if not found["listens"]:
            return found
        self.client = carla.Client(host, port)
        self.client.set_timeout(timeout)
        found["server"] = self.client.get_server_version()
        found["client"] = self.client.get_client_version()
        if release_of(found["server"]) != release_of(found["client"]):
            return found
        try:
            self.world = self.client.get_world()
        except RuntimeError as error:
            if "time-out" not in str(error):
                raise
            return {**found, "streams": False, "stream_port": listens(host, port + 1)}
        settings = self.world.get_settings()
        found |= {"streams": True, "synchronous": settings.synchronous_mode}
        if settings.synchronous_mode:
            found |= {"dt": settings.fixed_delta_seconds, "ticks": self._is_ticked()}
        return found

    def _is_ticked(self) -> bool:
        """Return whether another client makes steps."""
        try:
            self.world.wait_for_tick(TICKS)
        except RuntimeError:  # none came
            return False
        return True

    def free_time(self) -> None:
        """End a synchronous mode that a client has left behind."""
        settings = self.world.get_settings()
        settings.synchronous_mode, settings.fixed_delta_seconds = False, None
        self.world.apply_settings(settings)

    def level(self) -> Mapping[str, Any]:
        """Return name, OpenDRIVE text and spawn points of the level, and which maps there are."""
        found = self.world.get_map()
        return {
            "name": found.name.rpartition("/")[2],
            "text": found.to_opendrive(),
            "spawn_points": [written(point) for point in found.get_spawn_points()],
        }

    def maps(self) -> Sequence[str]:
        """Return the names of the maps that the server has."""
        return [each.rpartition("/")[2] for each in self.client.get_available_maps()]

    def load(self, name: str, patience: float) -> None:
        """Load a map of the server, which may take a time (s)."""
        with self._patient(patience):
            self.world = self.client.load_world(name)

    def generate(self, text: str, patience: float) -> None:
        """Make a level from OpenDRIVE text, without walls beside the road; patience as in `load`.

        A mesh for pedestrians is left out: it takes long, and walkers are led without it.
        """
        parameters = carla.OpendriveGenerationParameters()
        parameters.wall_height = 0.0
        parameters.enable_pedestrian_navigation = False
        with self._patient(patience):
            self.world = self.client.generate_opendrive_world(text, parameters)

    @contextmanager
    def _patient(self, seconds: float) -> Iterator[None]:
        """Give calls more time: the library retries for as long as one call may take."""
        self.client.set_timeout(max(seconds, self.timeout))
        try:
            yield
        finally:
            self.client.set_timeout(self.timeout)

    # --- time ---------------------------------------------------------------------------------

    def own_time(self, dt: float) -> None:
        """Take over the time: steps of a length (s), made by us."""
        before = self.world.get_settings()
        self.undo.append(lambda: self.world.apply_settings(before))
        settings = self.world.get_settings()
        settings.synchronous_mode, settings.fixed_delta_seconds = True, dt
        settings.substepping = True
        settings.max_substeps = min(MOST_SUBSTEPS, max(1, math.ceil(dt / SUBSTEP - 1e-9)))
        settings.max_substep_delta_time = max(SUBSTEP, dt / settings.max_substeps)
        self.ticks = True
        self.world.apply_settings(settings)

    def step(self, commands: Sequence[Sequence[Any]]) -> Mapping[str, Any]:
        """Execute commands, make a step, and return the new state."""
        if self.ticks:
            self.apply(commands)
            self.world.tick(self.timeout)
            return self.look()
        late = self._steps_since_look()
        self.apply(commands)
        self._wait_for_step()
        looked = self.look()
        return {**looked, "skipped": max(looked["skipped"], late)}

    def _steps_since_look(self) -> int:
        """How many steps the server has made since the last look."""
        frame = self.world.get_snapshot().frame
        if self._frame is None:
            self._frame = frame
        return int(frame - self._frame)

    def _wait_for_step(self) -> None:
        """Wait until the other client has made a step, be it before this side began to wait."""
        end = time.monotonic() + self.timeout
        while not self._steps_since_look():
            try:
                self.world.wait_for_tick(GLANCE)
            except RuntimeError:  # none came in so short a time
                if time.monotonic() > end:
                    raise

    def apply(self, commands: Sequence[Sequence[Any]]) -> None:
        """Carry out commands; one that the server refuses is an error."""
        batch = [command_of(each) for each in commands]
        answers = self.client.apply_batch_sync(batch, False) if batch else []
        refused = [
            f"{each[0]} of actor {each[1]}: {answer.error}"
            for each, answer in zip(commands, answers, strict=True)
            if answer.error
        ]
        if refused:
            raise RuntimeError(refused[0])

    def look(self) -> Mapping[str, Any]:
        """Return the latest snapshot: states of the watched actors, traffic lights, contacts."""
        snapshot = self.world.get_snapshot()
        skipped = 0 if self._frame is None else snapshot.frame - self._frame - 1
        self._frame = snapshot.frame
        actors = {}
        for actor in self.watched:
            found = snapshot.find(actor)
            actors[actor] = None if found is None else actor_state(found)
        return {
            "skipped": skipped,
            "dt": snapshot.timestamp.delta_seconds,
            "time": snapshot.timestamp.elapsed_seconds,
            "actors": list(actors.items()),
            "lights": light_states(self.lights),
            "collisions": self.collisions.take(),
            "dormant": self._dormant(),
        }

    def _dormant(self) -> Sequence[int]:
        """Return the watched actors that a large level has put to sleep, far from what it shows."""
        return [each.id for each in self.world.get_actors(self.watched) if each.is_dormant]

    # --- end ----------------------------------------------------------------------------------

    def close(self) -> None:
        """Undo what the session changed.

        A server that does not answer may recover: this continues until the process is ended, or the
        server is gone.
        """
        while self.undo:
            try:
                self.undo[-1]()
            except RuntimeError as error:  # else it cannot be undone
                if "time-out" in str(error):
                    if listens(*self._address):
                        continue
                    return
            self.undo.pop()


def listens(host: str, port: int) -> bool:
    """Return whether a port takes connections."""
    try:
        with socket.create_connection((host, port), timeout=LISTENS):
            return True
    except OSError:
        return False


def written(pose: Any) -> list[float]:
    """Return a transform as numbers."""
    at, turn = pose.location, pose.rotation
    return [at.x, at.y, at.z, turn.pitch, turn.yaw, turn.roll]
