"""Actions without an actor."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.importing.cursor import Node
from osc2tx.importing.document import Document
from osc2tx.importing.effects import Effect
from osc2tx.importing.libraries import Shared
from osc2tx.importing.marks import Marks
from osc2tx.importing.signals import TrafficLights
from osc2tx.importing.statements import Emit, Statement, call
from osc2tx.importing.values import Values
from osc2tx.importing.weather import Weather

ENVIRONMENT = "env"
"""The name of the environment in scenarios."""


class Surroundings:
    """Reads actions on variables and on the environment.

    Attributes:
        needs_environment: Whether the scenario needs an environment.
    """

    def __init__(
        self,
        values: Values,
        document: Document,
        shared: Shared,
        lights: TrafficLights,
        marks: Marks,
    ) -> None:
        self._values, self._lights = values, lights
        self._weather = Weather(values, document)
        self._document, self._shared, self._marks = document, shared, marks
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
        reference = node.find("CatalogReference")
        environment = node.find("Environment")
        if environment is None and reference is not None:
            environment = self._values.entry(reference)
        found = None if reference is None else self._document.entry(reference.element)
        owner = ENVIRONMENT if found is None else ""
        calls = [] if environment is None else list(self._weather.calls(environment, owner))
        if reference is not None and found is not None and calls:
            lines = [each.text for each in calls]
            entry = self._shared.behavior(
                found[1], reference.said("entryName"), "environment", lines
            )
            calls = [call(ENVIRONMENT, entry.name)]
        for each in calls:
            self.needs_environment = True
            yield Effect(Statement(each, length=0.0))
