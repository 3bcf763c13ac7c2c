"""Requests about weather, friction, traffic lights and the camera; all is as before in the end."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import carla

from .actors import Actors
from .session import Session


class Surroundings:
    """Changes the surroundings of the actors; its methods are requests.

    Args:
        session: A connected one.
        actors: Of the session.
    """

    def __init__(self, session: Session, actors: Actors) -> None:
        self._session, self._actors = session, actors
        self._weather: Any = None  # before the first change

    def set_weather(self, values: Mapping[str, float]) -> None:
        """Change the weather; values left out stay."""
        if self._weather is None:
            self._weather = self._session.world.get_weather()
            self._session.undo.append(lambda: self._session.world.set_weather(self._weather))
        weather = self._session.world.get_weather()
        for name, value in values.items():
            setattr(weather, name, value)
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
        """Return the OpenDRIVE ids of the lights; `look` has their states from now on."""
        lights = self._session.world.get_actors().filter("traffic.traffic_light*")
        self._session.lights = {each.get_opendrive_id(): each for each in lights}
        return [name for name in self._session.lights if name]

    def reset_lights(self) -> None:
        """Have the cycles of all lights begin anew, so that a run does not depend on its time."""
        self._session.world.reset_all_traffic_lights()

    def set_light(self, name: str, state: str) -> None:
        """Have a traffic light show a state; batches have no command for that."""
        self._session.lights[name].set_state(carla.TrafficLightState.names[state])

    def freeze_lights(self) -> None:
        """Stop the cycles of all lights; in the end each is as it was."""
        lights = self._session.world.get_actors().filter("traffic.traffic_light*")
        before = [(light, light.state, light.is_frozen()) for light in lights]

        def thaw() -> None:
            for light, state, _ in before:
                light.set_state(state)
            if not all(frozen for *_, frozen in before):
                self._session.world.freeze_all_traffic_lights(False)

        self._session.undo.append(thaw)
        self._session.world.freeze_all_traffic_lights(True)

    def spectator(self) -> int:
        """Return the camera of the server's window, which is put back in the end."""
        camera = self._session.world.get_spectator()
        before = camera.get_transform()
        self._session.undo.append(lambda: camera.set_transform(before))
        return int(camera.id)
