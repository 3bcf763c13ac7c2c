"""A session with a server: it undoes its changes, and those of killed sessions."""

from __future__ import annotations

import math
import socket
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import carla

from . import release_of
from .commands import command_of
from .journal import Journal, left_behind, undoes
from .snapshots import Collisions, actor_state, light_states

GLANCE = 0.5  # s to wait for a step of another client
SUBSTEP, MOST_SUBSTEPS = 0.01, 16
"""Length of a substep (s), and the greatest number of substeps in a step."""

LISTENS = 2.0  # s within which a port has to accept a connection
TICKS = 2.0  # s without a step after which no client makes them


class Session:
    """Connection and time; its methods are requests, with JSON values.

    Args:
        folder: Folder of the journals; empty: none.

    Attributes:
        client: Of the library.
        world: Its world.
        timeout: Time limit (s) of a call.
        patience: Time limit (s) of loading the former level at the end.
        ticks: Whether this session makes the steps.
        address: Host and port of the server.
        journal: Its changes.
        handles: Functions that release parts of the library, the last first.
        watched: Actors whose states `look` returns.
        lights: Traffic lights whose states `look` returns.
        collisions: Reports of sensors.
    """

    def __init__(self, folder: str) -> None:
        self._folder = folder
        self.address = ("", 0)
        self.client: Any = None
        self.world: Any = None
        self.timeout = self.patience = 0.0
        self.journal = Journal()
        self.handles: list[Callable[[], object]] = []
        self._left: list[Journal] = []
        self.ticks = False
        self.collisions = Collisions()
        self.lights: dict[str, Any] = {}
        self._frame: int | None = None
        self.watched: list[int] = []

    # --- connection -------------------------------------------------------------------

    def connect(self, host: str, port: int, timeout: float) -> Mapping[str, Any]:
        """Return the findings of a first contact, up to the first missing part.

        Returns:
            `listens`: a port answers. `server`, `client`: versions; both must be of the same
            release, since calls may differ. `streams`: snapshots arrive; else `stream_port` states
            whether the port of the streams, by default the next one, responds. `left`: kinds of
            changes of killed sessions, which `repair` undoes. `synchronous`: steps wait for a
            client, which makes them if `ticks`; `dt` (s): theirs.
        """
        self.address, self.timeout = (host, port), timeout
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
        found |= {"streams": True, "left": self._left_behind()}
        settings = self.world.get_settings()
        found["synchronous"] = settings.synchronous_mode
        if settings.synchronous_mode:
            found |= {"dt": settings.fixed_delta_seconds, "ticks": self._is_ticked()}
        return found

    def _left_behind(self) -> Sequence[str]:
        """Begin a journal, and return the changes of killed sessions."""
        where = ":".join(map(str, self.address))
        self._left += left_behind(self._folder, where, self.world.id)
        self.journal.open(self._folder, where)
        self.journal.enter(self.world.id)
        return sorted({kind for each in self._left for kind in each.changes})

    def repair(self) -> None:
        """Undo the changes of killed sessions."""
        while self._left:
            self._undone(self._left[-1].undo(self))
            self._left.pop().close()

    def _is_ticked(self) -> bool:
        """Return whether another client makes steps."""
        try:
            self.world.wait_for_tick(TICKS)
        except RuntimeError:  # none came
            return False
        return True

    def free_time(self) -> None:
        """End a synchronous mode that a former client has left."""
        settings = self.world.get_settings()
        settings.synchronous_mode, settings.fixed_delta_seconds = False, None
        self.world.apply_settings(settings)

    # --- time ---------------------------------------------------------------------------------

    def own_time(self, dt: float) -> None:
        """Take over the time: this session makes the steps, of a length (s)."""
        note_settings(self)
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
        """Number of steps of the server since the last look."""
        frame = self.world.get_snapshot().frame
        if self._frame is None:
            self._frame = frame
        return int(frame - self._frame)

    def _wait_for_step(self) -> None:
        """Wait until the other client has made a step, possibly before the call."""
        end = time.monotonic() + self.timeout
        while not self._steps_since_look():
            try:
                self.world.wait_for_tick(GLANCE)
            except RuntimeError:  # none came within this time
                if time.monotonic() > end:
                    raise

    def apply(self, commands: Sequence[Sequence[Any]]) -> None:
        """Execute commands; a rejected one is an error."""
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
        """Return the watched actors that are dormant, far from the camera of a large level."""
        return [each.id for each in self.world.get_actors(self.watched) if each.is_dormant]

    # --- end ----------------------------------------------------------------------------------

    def close(self) -> None:
        """Undo what the session changed."""
        if self._undone(self._endings()):
            self.journal.close()

    def _endings(self) -> Iterator[Callable[[], object]]:
        while self.handles:
            yield self.handles.pop()
        if self.journal.changes:
            yield from self.journal.undo(self)
            yield self.world.get_settings  # the library sends most calls asynchronously

    def _undone(self, steps: Iterator[Callable[[], object]]) -> bool:
        """Execute steps of undoing; return whether the server responded to all.

        A server without response may recover: this continues until the process or the server ends.
        """
        for step in steps:
            while not _is_over(step):
                if not listens(*self.address):
                    return False
        return True


def _is_over(step: Callable[[], object]) -> bool:
    """Execute a step, and return whether it is done."""
    try:
        step()
    except RuntimeError as error:
        return "time-out" not in str(error)  # else it cannot be undone
    return True


def note_settings(session: Session) -> None:
    """Note the settings before their first change."""
    if "settings" not in session.journal.changes:
        session.journal.note("settings", fields_of(session.world.get_settings()))


@undoes("settings")
def _restore_settings(session: Session, values: Sequence[Any]) -> None:
    settings = session.world.get_settings()
    set_fields(settings, values[0])
    session.world.apply_settings(settings)


def listens(host: str, port: int) -> bool:
    """Return whether a port accepts connections."""
    try:
        with socket.create_connection((host, port), timeout=LISTENS):
            return True
    except OSError:
        return False


def written(pose: Any) -> list[float]:
    """Return a transform as numbers."""
    at, turn = pose.location, pose.rotation
    return [at.x, at.y, at.z, turn.pitch, turn.yaw, turn.roll]


def fields_of(values: Any) -> Mapping[str, Any]:
    """Return the fields of settings or weather, which have methods and constants besides."""
    found = {name: getattr(values, name) for name in dir(values) if not name.startswith("_")}
    return {n: v for n, v in found.items() if v is None or isinstance(v, bool | int | float)}


def set_fields(values: Any, fields: Mapping[str, Any]) -> None:
    """Set fields of settings or weather."""
    for name, value in fields.items():
        setattr(values, name, value)
