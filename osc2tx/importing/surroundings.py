"""Actions without an actor."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import ANGLE, LENGTH
from osc2tx.importing.effects import Effect
from osc2tx.importing.program import Statement
from osc2tx.importing.values import Values


class Surroundings:
    """Reads actions on variables and on the environment.

    Attributes:
        needs_environment: Whether the scenario needs an environment.
    """

    def __init__(
        self, values: Values, name_of_mark: Callable[[str, str], str], emitted: set[str]
    ) -> None:
        self._values = values
        self._name_of_mark, self._emitted = name_of_mark, emitted
        self.needs_environment = False

    def effects(self, node: Node) -> Iterator[Effect]:
        """Return what a global action does."""
        match node.tag:
            case "VariableAction" | "ParameterAction":
                kind = node.tag.removesuffix("Action").lower()
                name = self._values.text(node, f"{kind}Ref")
                setting = node.find("SetAction")
                if setting is None:
                    node.leave_out("variables are events here: they are set, not computed")
                    return
                value = self._values.text(setting, "value")
                event = self._name_of_mark(name, value)
                self._emitted.add(event)
                yield Effect(Statement(f"emit {event}", length=0.0))
            case "EnvironmentAction":
                yield from self._environment(node)
            case _:
                node.leave_out("the language has no such action, or not for this document")

    def _environment(self, node: Node) -> Iterator[Effect]:
        environment = node.find("Environment")
        if environment is None:
            node.leave_out("environments of catalogs are not imported yet")
            return
        for each in environment.children():
            if each.tag == "Weather":
                yield from self._weather(each)
            elif each.tag not in ("ParameterDeclarations",):
                each.leave_out("of the environment only the weather is imported")

    def _weather(self, node: Node) -> Iterator[Effect]:
        for name in ("cloudState", "fractionalCloudCover"):
            if node.has(name):
                node.approximate(f"{name}={node.text(name)!r} has no counterpart in the DSL")
        for each in node.children():
            call = None
            if each.tag == "Fog" and each.has("visualRange"):
                value = self._values.quantity(each, "visualRange", LENGTH)
                call = f"fog(visual_range: {value.text})"
            elif each.tag == "Sun" and each.has("azimuth"):
                azimuth = self._values.quantity(each, "azimuth", ANGLE)
                elevation = self._values.quantity(each, "elevation", ANGLE)
                call = (
                    f"assign_celestial_position(light_source: environment_.sun, "
                    f"azimuth: {azimuth.text}, elevation: {elevation.text})"
                )
            for unsaid in each.element.attributes:
                if unsaid[0] not in ("visualRange", "azimuth", "elevation"):
                    each.text(unsaid[0])
                    each.approximate(f"{unsaid[0]}={unsaid[1]!r} has no counterpart in the DSL")
            if call is not None:
                self.needs_environment = True
                yield Effect(Statement(f"environment_.{call}", length=0.0))
