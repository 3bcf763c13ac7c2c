"""An evaluator of OpenSCENARIO XML, for tests: by the text of the standard alone.

It shares nothing with the back end that writes the documents, and only the reader of maps with the
runtime. At an instant the storyboard is gone through until nothing changes: transitions take no
time. Then everything moves by one step.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

from lxml import etree

from osc2tx_runtime.opendrive import RoadMap
from tests.xosc.actions import Stage
from tests.xosc.bodies import Body, body_of, couple
from tests.xosc.conditions import BY_THE_STANDARD, Conditions, Reading
from tests.xosc.courses import Node, number, with_parameters
from tests.xosc.distances import Ruler
from tests.xosc.scene import Running

Row = tuple[float, float, float, float]  # t, x, y, v
NOTHING: Mapping[str, str] = MappingProxyType({})
SETTLES = 1000  # passes of an instant


class Evaluator:
    """Plays a document.

    Attributes:
        time: Seconds since the start.
        step: The same in steps.
        starts: First start of each event and act, by name.
        track: Motion of each entity.
    """

    def __init__(
        self,
        xml: str,
        road_map: RoadMap,
        dt: float,
        *,
        reading: Reading = BY_THE_STANDARD,
        given: Mapping[str, str] = NOTHING,
    ) -> None:
        self.root = with_parameters(etree.fromstring(xml.encode()), given)
        self.dt, self.step = dt, 0
        self.bodies: dict[str, Body] = {}
        for node in self.root.iter("ScenarioObject"):
            body = body_of(node)
            self.bodies[body.name] = body
        carries = reading.carries_acceleration
        self.stage = Stage(self.root, self.bodies, road_map, dt, carries=carries)
        self.ruler = Ruler(road_map)
        declared = ("VariableDeclaration", "ParameterDeclaration")
        self.variables: dict[str, str] = {
            node.get("name"): node.get("value") for tag in declared for node in self.root.iter(tag)
        }
        self.lights: dict[str, str] = {}
        self.cycles = {
            node.get("name"): (node, 0, number(node, "delay"))
            for node in self.root.iter("TrafficSignalController")
        }
        self.states: dict[Node, str] = {}
        self.transitions: set[tuple[Node, str]] = set()
        self.counts: dict[Node, int] = {}
        self.started_at: dict[Node, int] = {}
        self.work: dict[Node, list[Running]] = {}
        self.starts: dict[str, float] = {}
        self.track: dict[str, list[Row]] = {name: [] for name in self.bodies}
        self.conditions = Conditions(self, dt, reading)
        self._init()

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.step * self.dt

    def _init(self) -> None:
        """Carry out `Init`: references before what is placed beside them."""
        privates = list(self.root.iterfind("Storyboard/Init/Actions/Private"))
        waiting = [(self.bodies[p.get("entityRef")], list(p)) for p in privates]
        while waiting:
            ready = [each for each in waiting if not self._waits(each[1])]
            assert ready, "places of Init refer to each other"
            for entry in ready:
                waiting.remove(entry)
                for action in entry[1]:
                    self.stage.begin(action, entry[0], self.time)
        for action in self.root.iterfind("Storyboard/Init/Actions/GlobalAction"):
            self._global(action)
        couple(self.root, self.bodies)
        for body in self.bodies.values():
            if body.behind is not None:
                tow, hitch, bar = body.behind
                x, y, h = tow.here
                back = hitch + bar
                body.pose = tow.here._replace(x=x - back * math.cos(h), y=y - back * math.sin(h))
                body.v = tow.v

    def _waits(self, actions: list[Node]) -> bool:
        named = (node.get("entityRef") for action in actions for node in action.iter())
        return any(name is not None and self.bodies[name].pose is None for name in named)

    # --- a run ------------------------------------------------------------------------------------

    def play(self, most: float) -> float:
        """Play to the end; return when that is (s), infinite if it is not over in time."""
        stop = self.root.find("Storyboard/StopTrigger")
        while self.time < most:
            for name, body in self.bodies.items():
                if body.pose is not None:
                    self.track[name].append((self.time, *body.here[:2], body.v))
            self.transitions.clear()
            self._run_cycles()
            if self._settle(stop):
                return self.time
            self.stage.advance(self.time)
            self.step += 1
        return math.inf

    def _settle(self, stop: Node | None) -> bool:
        """Go through the storyboard until nothing changes; return whether it is over."""
        for _ in range(SETTLES):
            if self.conditions.fires(stop):
                return True
            if not any([self._act(act) for act in self.root.iter("Act")]):
                return False
        raise AssertionError(f"the storyboard does not come to rest at {self.time} s")

    def is_in(self, element: Node, state: str) -> bool:
        """Whether an element is in a state, or just in a transition."""
        if state.endswith("Transition"):
            return (element, state) in self.transitions
        if element.tag in ("Event", "Act"):
            return self._state(element) == state
        inner = {self._state(event) for event in element.iter("Event")}
        if inner == {"completeState"}:
            return state == "completeState"
        return state == ("standbyState" if inner == {"standbyState"} else "runningState")

    def _state(self, element: Node) -> str:
        return self.states.get(element, "standbyState")

    def _enter(self, element: Node, state: str, *transitions: str) -> None:
        self.states[element] = state
        self.transitions |= {(element, transition) for transition in transitions}

    # --- acts and events --------------------------------------------------------------------------

    def _act(self, act: Node) -> bool:
        """Take an act further; return whether something has changed."""
        state, changed = self._state(act), False
        if state == "completeState":
            return False
        if state == "standbyState":
            trigger = act.find("StartTrigger")
            if trigger is not None and not self.conditions.fires(trigger):
                return False
            self._enter(act, "runningState", "startTransition")
            self.starts.setdefault(act.get("name"), self.time)
            changed = True
        if self.conditions.fires(act.find("StopTrigger")):
            for event in act.iter("Event"):
                self._stop(event)
            self._enter(act, "completeState", "stopTransition")
            return True
        events = list(act.iter("Event"))
        for group in act.iter("ManeuverGroup"):
            assert group.get("maximumExecutionCount") == "1"
        changed = any([self._event(event) for event in events]) or changed
        if all(self._state(event) == "completeState" for event in events):
            self._enter(act, "completeState", "endTransition")
            changed = True
        return changed

    def _event(self, event: Node) -> bool:
        state = self._state(event)
        if state == "runningState" and all(run.done for run in self.work[event]):
            again = self.counts[event] < number(event, "maximumExecutionCount", 1.0)
            self._enter(event, "standbyState" if again else "completeState", "endTransition")
            return True
        # a trigger is evaluated once in each step in which the event stands by
        if state != "standbyState" or self.started_at.get(event) == self.step:
            return False
        trigger = event.find("StartTrigger")
        if trigger is not None and not self.conditions.fires(trigger):
            return False
        beside = [e for e in event.getparent().iterfind("Event") if e is not event]
        running = [each for each in beside if self._state(each) == "runningState"]
        self.started_at[event] = self.step
        self.counts[event] = self.counts.get(event, 0) + 1
        if event.get("priority") == "skip" and running:
            again = self.counts[event] < number(event, "maximumExecutionCount", 1.0)
            self._enter(event, "standbyState" if again else "completeState", "skipTransition")
            return True
        if event.get("priority") in ("override", "overwrite"):
            for each in running:
                self._stop(each)
        self._enter(event, "runningState", "startTransition")
        self.starts.setdefault(event.get("name"), self.time)
        self.work[event] = [
            run for action in event.iterfind("Action") for run in self._begin(action, event)
        ]
        return True

    def _begin(self, action: Node, event: Node) -> Iterator[Running]:
        inner = action[0]
        if inner.tag == "GlobalAction":
            self._global(inner)
            return
        if inner.tag == "UserDefinedAction":
            return
        actors = event.getparent().getparent().find("Actors")
        for actor in actors.iterfind("EntityRef"):
            run = self.stage.begin(inner, self.bodies[actor.get("entityRef")], self.time)
            if run is not None:
                yield run

    def _stop(self, event: Node) -> None:
        for run in self.work.get(event, ()):
            run.done = True
        if self._state(event) != "completeState":
            self._enter(event, "completeState", "stopTransition")

    # --- what concerns no entity ------------------------------------------------------------------

    def _global(self, action: Node) -> None:
        inner = action[0]
        match inner.tag:
            case "VariableAction" | "ParameterAction":
                self._set(inner)
            case "InfrastructureAction":
                signal = inner.find("TrafficSignalAction")[0]
                if signal.tag == "TrafficSignalStateAction":
                    self.lights[signal.get("name")] = signal.get("state")
                else:
                    name = signal.get("trafficSignalControllerRef")
                    node = self.cycles[name][0]
                    names = [phase.get("name") for phase in node.iterfind("Phase")]
                    self.cycles[name] = (node, names.index(signal.get("phase")), self.time)
                    self._run_cycles()
            case "EnvironmentAction" | "SetMonitorAction":
                pass  # nothing here moves by the weather, or asks a monitor
            case _:
                raise NotImplementedError(inner.tag)

    def _set(self, node: Node) -> None:
        name = node.get("variableRef") or node.get("parameterRef")
        given = node.find("SetAction")
        if given is not None:
            self.variables[name] = given.get("value")
            return
        rule = node.find("ModifyAction/Rule")[0]
        value, before = number(rule, "value"), float(self.variables[name])
        after = before + value if rule.tag == "AddValue" else before * value
        self.variables[name] = f"{after:g}"

    def _run_cycles(self) -> None:
        """Show the phases of the controllers."""
        for name, (node, index, since) in self.cycles.items():
            phases = node.findall("Phase")
            while self.time >= since + number(phases[index], "duration") - 1e-9:
                since += number(phases[index], "duration")
                index = (index + 1) % len(phases)
            self.cycles[name] = (node, index, since)
            if self.time >= since:
                for state in phases[index].iterfind("TrafficSignalState"):
                    self.lights[state.get("trafficSignalId")] = state.get("state")


def map_of(xml: str, folders: tuple[Path, ...]) -> Path:
    """Return the file of the map that a document names."""
    node = etree.fromstring(xml.encode()).find("RoadNetwork/LogicFile")
    name = node.get("filepath")
    found = [folder / each for folder in folders for each in (name, f"{name}.xodr")]
    return next(path for path in found if path.is_file())
