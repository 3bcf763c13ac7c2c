"""What belongs to no entity: parameters and variables, traffic lights and their cycles."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.courses import number
from osc2tx.xosc.player.errors import Unplayable

ROUNDING = 1e-9  # s


class GlobalState:
    """The state that global actions change.

    Args:
        document: The document, with values of its parameters.
        changed: Is told the name of each variable that is set.

    Attributes:
        variables: Texts of variables and parameters, by name.
        lights: States of traffic lights, by id.
        monitors: Values of monitors, by name.
    """

    def __init__(self, document: Element, changed: Callable[[str], None]) -> None:
        self.variables = {each.name: each.value for each in document.below(xml.VariableDeclaration)}
        parameters = document.below(xml.ParameterDeclaration)
        self.variables |= {each.name: each.value for each in parameters}
        self.lights: dict[str, str] = {}
        declared = document.below(xml.MonitorDeclaration)
        self.monitors = {each.name: bool(each.value) for each in declared}
        self._cycles = {
            node.name: (_phases(node), 0, node.delay or 0.0)
            for node in document.below(xml.TrafficSignalController)
        }
        self._changed = changed

    def execute(self, action: xml.GlobalAction, time: float) -> None:
        """Carry out an action at a time (s)."""
        inner = action.inner
        match inner.tag:
            case "VariableAction" | "ParameterAction":
                self._set(inner)
            case "InfrastructureAction":
                signal = inner.one(xml.TrafficSignalAction).inner
                if signal.tag == "TrafficSignalStateAction":
                    self.lights[signal.said("name")] = signal.said("state")
                else:
                    name = signal.said("trafficSignalControllerRef")
                    phases = self._cycles[name][0]
                    names = [phase.name for phase in phases]
                    self._cycles[name] = (phases, names.index(signal.said("phase")), time)
                    self.advance(time)
            case "SetMonitorAction":
                set_ = action.one(xml.SetMonitorAction)
                self.monitors[set_.monitorRef] = bool(set_.value)
            case "EnvironmentAction":
                pass  # weather has no effect here
            case _:
                raise Unplayable(f"<{inner.tag}> is not played", inner.place)

    def advance(self, time: float) -> None:
        """Show the phases of the controllers at a time (s)."""
        for name, (phases, index, since) in self._cycles.items():
            while time >= since + phases[index].duration - ROUNDING:
                since += phases[index].duration
                index = (index + 1) % len(phases)
            self._cycles[name] = (phases, index, since)
            if time >= since:
                for state in phases[index].all(xml.TrafficSignalState):
                    self.lights[state.said("trafficSignalId")] = state.said("state")

    def _set(self, node: Element) -> None:
        name = node.get("variableRef") or node.said("parameterRef")
        self._changed(name)
        given = node.find(xml.SetAction)
        if given is not None:
            self.variables[name] = given.said("value")
            return
        rule = node.one(xml.ModifyAction).one(xml.Rule).inner
        value, before = number(rule, "value"), float(self.variables[name])
        after = before + value if rule.tag == "AddValue" else before * value
        self.variables[name] = f"{after:g}"


def _phases(controller: xml.TrafficSignalController) -> Sequence[xml.Phase]:
    """Return the phases of a cycle, which takes some time.

    Raises:
        Unplayable: It takes none.
    """
    phases = list(controller.all(xml.Phase))
    if not any(phase.duration > 0.0 for phase in phases):
        raise Unplayable("a cycle that takes no time is not played", controller.place)
    return phases
