"""Requests about the level: the former one is loaded again at the end."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import carla

from .journal import undoes
from .session import Session, fields_of, note_settings, written


class Levels:
    """Describes and loads levels; its methods are requests.

    Args:
        session: A connected session.
    """

    def __init__(self, session: Session) -> None:
        self._session = session

    def level(self, patience: float = 0.0) -> Mapping[str, Any]:
        """Return name, OpenDRIVE text and spawn points of the level.

        The time limit (s) also covers the text of a large level.
        """
        with _patient(self._session, patience):
            found = self._session.world.get_map()
        return {
            "name": found.name.rpartition("/")[2],
            "text": found.to_opendrive(),
            "spawn_points": [written(point) for point in found.get_spawn_points()],
        }

    def maps(self) -> Sequence[str]:
        """Return the names of the maps that the server has."""
        return [each.rpartition("/")[2] for each in self._session.client.get_available_maps()]

    def load(self, name: str, patience: float, keep: bool = False) -> None:
        """Load a map of the server within a time (s).

        The former level is loaded again at the end, unless the new one has to be kept.
        """
        self._leave(patience, keep)
        _load(self._session, name, patience)

    def generate(self, text: str, patience: float, keep: bool = False) -> None:
        """Create a level from OpenDRIVE text, without walls beside the road; see `load`.

        A mesh for pedestrians is omitted: it takes long, and walkers do not need it.
        """
        self._leave(patience, keep)
        _generate(self._session, text, patience)

    def reload(self, patience: float) -> None:
        """Reload the level within a time (s)."""
        note_settings(self._session)
        self._note_view()
        _load_anew(self._session, *self._level_now(), patience)

    def _leave(self, patience: float, keep: bool) -> None:
        """Note the values that a new level resets: settings and weather."""
        note_settings(self._session)
        if keep or "level" in self._session.journal.changes:
            return
        self._note_view()
        self._session.journal.note("level", [*self._level_now(), patience])
        self._session.patience = patience

    def _note_view(self) -> None:
        world, journal = self._session.world, self._session.journal
        journal.note("camera", written(world.get_spectator().get_transform()))
        journal.note("weather", fields_of(world.get_weather()))

    def _level_now(self) -> tuple[str, str]:
        """Return the name of the level, and its text if the server has no map of that name."""
        found = self._session.world.get_map()
        name = found.name.rpartition("/")[2]
        return name, "" if name in self.maps() else found.to_opendrive()


def _load(session: Session, name: str, patience: float) -> None:
    with _patient(session, patience):
        _enter(session, session.client.load_world(name))


def _generate(session: Session, text: str, patience: float) -> None:
    parameters = carla.OpendriveGenerationParameters()
    parameters.wall_height = 0.0
    parameters.enable_pedestrian_navigation = False
    with _patient(session, patience):
        _enter(session, session.client.generate_opendrive_world(text, parameters))


def _load_anew(session: Session, name: str, text: str, patience: float) -> None:
    """Load a level by its name, or create it from its text if the server lacks it.

    A server that waits for steps would not load it.
    """
    session.free_time()
    if text:
        _generate(session, text, patience)
    else:
        _load(session, name, patience)


def _enter(session: Session, world: Any) -> None:
    session.world = world
    session.journal.enter(world.id)


@contextmanager
def _patient(session: Session, seconds: float) -> Iterator[None]:
    """Extend the time limit of calls: the library retries within it."""
    session.client.set_timeout(max(seconds, session.timeout))
    try:
        yield
    finally:
        session.client.set_timeout(session.timeout)


@undoes("level")
def _restore(session: Session, values: Sequence[Any]) -> None:
    _load_anew(session, *values[0])
