"""Requests about weather, friction, traffic lights and the camera; all are restored at the end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import carla

from .actors import Actors
from .commands import transform
from .journal import undoes
from .session import Session, fields_of, set_fields, written


class Surroundings:
    """Changes the surroundings of the actors; its methods are requests.

    Args:
        session: A connected session.
        actors: Of the session.
    """

    def __init__(self, session: Session, actors: Actors) -> None:
        self._session, self._actors = session, actors

    def set_weather(self, values: Mapping[str, float]) -> None:
        """Change the weather; other values are unchanged."""
        weather = self._session.world.get_weather()
        if "weather" not in self._session.journal.changes:
            self._session.journal.note("weather", fields_of(weather))
        set_fields(weather, values)
        self._session.world.set_weather(weather)

    def set_friction(self, friction: float | None) -> None:
        """Set the friction of all tyres everywhere; None: the friction of the models."""
        own = self._session.world.get_actors(self._actors.own)
        for actor in own.filter("static.trigger.friction"):
            actor.destroy()
            self._actors.own.remove(actor.id)
        if friction is not None:
            far = str(1e6)  # cm
            extents = {f"extent_{axis}": far for axis in "xyz"}
            attributes = {"friction": str(friction), **extents}
            self._actors.spawn("static.trigger.friction", attributes, [0.0] * 6)

    def traffic_lights(self) -> Sequence[str]:
        """Return the OpenDRIVE ids of the lights; `look` then returns their states."""
        lights = self._session.world.get_actors().filter("traffic.traffic_light*")
        self._session.lights = {each.get_opendrive_id(): each for each in lights}
        return [name for name in self._session.lights if name]

    def reset_lights(self) -> None:
        """Restart the cycles of all lights, so that a run does not depend on its time."""
        self._session.world.reset_all_traffic_lights()

    def set_light(self, name: str, state: str) -> None:
        """Set the state of a traffic light; batches have no command for it."""
        self._session.lights[name].set_state(carla.TrafficLightState.names[state])

    def freeze_lights(self) -> None:
        """Stop the cycles of all lights; each is restored at the end."""
        lights = self._session.world.get_actors().filter("traffic.traffic_light*")
        before = [[light.id, str(light.state), light.is_frozen()] for light in lights]
        self._session.journal.note("traffic lights", before)
        self._session.world.freeze_all_traffic_lights(True)

    def spectator(self) -> int:
        """Return the camera of the server's window, which is restored at the end."""
        camera = self._session.world.get_spectator()
        if "camera" not in self._session.journal.changes:
            self._session.journal.note("camera", written(camera.get_transform()))
        return int(camera.id)


@undoes("weather")
def _restore_weather(session: Session, values: Sequence[Any]) -> None:
    weather = session.world.get_weather()
    set_fields(weather, values[0])
    session.world.set_weather(weather)


@undoes("camera")
def _restore_camera(session: Session, values: Sequence[Any]) -> None:
    session.world.get_spectator().set_transform(transform(values[0]))


@undoes("traffic lights")
def _thaw(session: Session, values: Sequence[Any]) -> None:
    """Restore each light; cycles continue unless they were stopped before."""
    before = {actor: (state, frozen) for actor, state, frozen in values[0]}
    for light in session.world.get_actors(list(before)):
        light.set_state(carla.TrafficLightState.names[before[light.id][0]])
    if not all(frozen for _, frozen in before.values()):
        session.world.freeze_all_traffic_lights(False)
