"""Actions without an actor: on variables, traffic lights, and the environment with its weather.

An environment is sun, clouds, fog, wind, air, rain and snow, with the friction that they give.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TypeAlias

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import ANGLE, LENGTH, SPEED, short
from osc2tx.importing.effects import Effect, Reader, Readings
from osc2tx.importing.statements import Call, Emit, Statement, call
from osc2tx_runtime.world.grip.friction import ADHESION

ENVIRONMENT = "env"
"""The name of the environment in scenarios."""

OKTAS = ("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
CLOUDS: Mapping[str, int] = {"free": 0, "skyOff": 0, "cloudy": 4, "rainy": 8, "overcast": 8}
"""States of the sky in oktas."""

HEAVIEST_RAIN = 50.0
"""mm/h that are the intensity 1 of a document that has no unit for it."""

FREEZING = 273.15  # K
FALLING: Mapping[str, tuple[float, ...]] = {
    "rain": (ADHESION["wet"], ADHESION["ice"]),
    "snow": (ADHESION["snow"],),
}
"""Friction of roads while it rains or snows."""

OWN = "actor"
"""How the scenarios of an environment call it."""

Action: TypeAlias = tuple[str, dict[str, str]]
"""The name of an action of an environment, with its arguments."""


class Surroundings(Reader):
    """Reads actions on variables and on the environment.

    Attributes:
        needs_environment: Whether the scenario needs an environment.
    """

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
        self._weather = Weather(readings)
        self.needs_environment = False

    def effects(self, node: Node) -> Iterator[Effect]:
        """Return what a global action does."""
        match node.tag:
            case "VariableAction" | "ParameterAction":
                kind = node.tag.removesuffix("Action").lower()
                name = self._values.text(node, f"{kind}Ref")
                event = self._change(node, name)
                if event is None:
                    node.leave_out("what it changes has no number before the run")
                else:
                    yield Effect(Statement(Emit(event), length=0.0))
            case "EnvironmentAction":
                yield from self._environment(node)
            case "InfrastructureAction" if node.inner.tag == "TrafficSignalAction":
                inner = node.inner.inner
                if inner.tag != "TrafficSignalStateAction":
                    inner.leave_out("cycles of traffic lights are not imported")
                    return
                yield Effect(Statement(self._lights.switch(inner), length=0.0))
            case _:
                node.leave_out("the language has no such action, or not for this document")

    def _change(self, node: Node, name: str) -> str | None:
        """Return the event that stands for the value that an action gives a variable."""
        setting = node.find("SetAction")
        if setting is not None:
            return self._marks.set_to(name, self._values.text(setting, "value"))
        by = node.one("ModifyAction").one("Rule").inner
        node.approximate("changes of a variable are taken to come in the order of the document")
        return self._marks.changed(name, by)

    def _environment(self, node: Node) -> Iterator[Effect]:
        environment, reference = node.find("Environment"), node.find("CatalogReference")
        found = None if reference is None else self._values.entry(reference)
        if reference is not None and found is not None:
            lines = [each.text for each in self._weather.calls(found[0])]
            said, kind = reference.said("entryName"), "environment"
            named = [self._shared.behavior(found[1], said, kind, lines)] if lines else []
            calls = [call(ENVIRONMENT, each.name) for each in named]
        else:
            calls = [] if environment is None else [*self._weather.calls(environment, ENVIRONMENT)]
        for each in calls:
            self.needs_environment = True
            yield Effect(Statement(each, length=0.0))


class Weather(Reader):
    """Reads environments."""

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
        self._falling = {
            each.get("precipitationType") or ""
            for each in self._document.resolved_tagged("Precipitation")
        }

    def calls(self, environment: Node, actor: str = "") -> Iterator[Call]:
        """Yield the invocations for an environment that make it as an element says.

        Args:
            environment: The element.
            actor: The environment; `""`: that whose scenario it is.
        """
        for action, arguments in self._actions(environment, actor or OWN):
            yield call(actor, action, **arguments)

    def _actions(self, environment: Node, actor: str) -> Iterator[Action]:
        kind = ""
        for node in environment.children():
            if node.tag == "Weather":
                yield from self._sky(node)
                for each in node.children():
                    kind = each.element.get("precipitationType") or kind
                    yield from self._part(each, actor)
            elif node.tag == "RoadCondition":
                self._road(node, kind)
            elif node.tag != "ParameterDeclarations":
                node.leave_out("of the environment only weather and roads are imported")

    def _sky(self, node: Node) -> Iterator[Action]:
        cover = node.text("fractionalCloudCover")
        state = node.text("cloudState")
        if cover is not None and cover.removesuffix("Oktas") in OKTAS:
            yield "clouds", {"cloudiness": str(OKTAS.index(cover.removesuffix("Oktas")))}
        elif state is not None and state in CLOUDS:
            if state != "free":
                node.approximate(f"a sky that is {state} has {CLOUDS[state]} oktas of clouds here")
            yield "clouds", {"cloudiness": str(CLOUDS[state])}
        elif state is not None or cover is not None:
            node.approximate(f"clouds {cover or state!r} have no counterpart in the DSL")
        parts = {}
        if node.has("temperature"):
            celsius = self._values.nominal(node, "temperature") - FREEZING
            parts["temperature"] = f"{short(round(celsius, 6))}celsius"
        if node.has("atmosphericPressure"):
            pressure = self._values.nominal(node, "atmosphericPressure")
            parts["pressure"] = f"{short(round(0.01 * pressure, 6))}hPa"
        if parts:
            yield "air", parts

    def _part(self, node: Node, actor: str) -> Iterator[Action]:
        match node.tag:
            case "Fog" if node.has("visualRange"):
                visible = self._values.quantity(node, "visualRange", LENGTH)
                yield "fog", {"visual_range": visible.text}
            case "Sun" if node.has("azimuth"):
                for name in ("illuminance", "intensity"):
                    node.idle("how bright the sun is follows from where it stands", name)
                azimuth = self._values.quantity(node, "azimuth", ANGLE)
                elevation = self._values.quantity(node, "elevation", ANGLE)
                where = {"azimuth": azimuth.text, "elevation": elevation.text}
                yield "assign_celestial_position", {"light_source": f"{actor}.sun", **where}
            case "Wind":
                speed = self._values.quantity(node, "speed", SPEED)
                # from where it comes, clockwise from north, instead of whither from east
                whither = self._values.nominal(node, "direction")
                from_ = math.degrees((-0.5 * math.pi - whither) % (2.0 * math.pi))
                yield "wind", {"speed": speed.text, "direction": f"{short(round(from_, 6))}deg"}
            case "Precipitation":
                yield from self._precipitation(node)
        for name, text in (
            node.element.attributes if node.tag not in ("Precipitation", "Wind") else ()
        ):
            if name not in ("visualRange", "azimuth", "elevation", "illuminance", "intensity"):
                node.text(name)
                node.approximate(f"{name}={text!r} has no counterpart in the DSL")

    def _precipitation(self, node: Node) -> Iterator[Action]:
        """Yield what falls; of rain and snow one ends when the other one begins."""
        kind = node.text("precipitationType") or "dry"
        if node.has("precipitationIntensity"):
            amount = self._values.nominal(node, "precipitationIntensity")
        else:
            amount = HEAVIEST_RAIN * self._values.nominal(node, "intensity")
            if amount > 0.0 and kind != "dry":
                node.approximate(f"its intensity 1 is taken to be {HEAVIEST_RAIN:g} mm/h")
        for each in ("rain", "snow"):
            if each in self._falling and each != kind:
                yield each, {"intensity": "0mmph"}
        if kind in ("rain", "snow"):
            yield kind, {"intensity": f"{short(round(amount, 6))}mmph"}

    def _road(self, node: Node, kind: str) -> None:
        """Note how slippery roads are, which follows from what falls here."""
        factor = self._values.nominal(node, "frictionScaleFactor", 1.0)
        expected = FALLING.get(kind, (1.0, *ADHESION.values()) if not kind else (1.0,))
        if factor in expected:
            node.idle("how slippery a road is follows from the weather")
        else:
            node.approximate(f"the friction {factor:g} is that which follows from the weather")
        node.use_all()
