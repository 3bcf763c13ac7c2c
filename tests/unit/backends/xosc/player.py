"""A small player of OpenSCENARIO XML, for tests: independent of the compiler and of its runtime.

It carries out what the back end writes, by the text of the standard: states of storyboard elements,
triggers as OR of ANDs with edges and delays, actions as motion of points along straight roads. A
step at time t looks at the state of t; what starts then acts from t on. Elements see what those
before them in the document did in the same step, and completions one step later.
"""

import math

from lxml import etree

from tests.unit.backends.xosc.courses import RULES, Node, number
from tests.unit.backends.xosc.stage import Entity, Running, Stage


class Player:
    """Plays a document; `starts` and `ends` hold the times of its events, `track` the motion."""

    def __init__(self, xml: str, dt: float = 0.05, *, is_lazy: bool = False) -> None:
        self.is_lazy = is_lazy
        self.root = etree.fromstring(xml.encode())
        self.dt = dt
        self.stage = Stage(self.root, dt)
        self.entities = self.stage.entities
        self.variables = {
            node.get("name"): node.get("value")
            for tag in ("VariableDeclaration", "ParameterDeclaration")
            for node in self.root.iter(tag)
        }
        self.state: dict[Node, str] = {}
        self.completed: set[Node] = set()  # known from the next step on
        self.visible: set[Node] = set()
        self.history: dict[Node, list[tuple[float, bool]]] = {}
        self.last: dict[Node, bool] = {}
        self.work: dict[Node, list[Running]] = {}
        self.starts: dict[str, float] = {}
        self.ends: dict[str, float] = {}
        self.track: dict[str, list[tuple[float, float, float, float]]] = {}
        for private in self.root.iterfind("Storyboard/Init/Actions/Private"):
            for action in private:
                self._start(action, self.entities[private.get("entityRef")])
        for entity in self.entities.values():
            entity.actions.clear()

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.stage.time

    def play(self, most: float = 120.0) -> float:
        """Play to the end; return when that is."""
        steps = 0
        while self.time < most:
            for entity in self.entities.values():
                row = (self.time, entity.x, entity.y, entity.v)
                self.track.setdefault(entity.name, []).append(row)
            if self._fires(self.root.find("Storyboard/StopTrigger")):
                return self.time
            for act in self.root.iter("Act"):
                self._step_act(act)
            self.stage.advance()
            self.visible = set(self.completed)
            steps += 1
            self.stage.time = round(steps * self.dt, 9)
        return math.inf

    # --- storyboard -------------------------------------------------------------------------------

    def _step_act(self, act: Node) -> None:
        state = self.state.setdefault(act, "standby")
        if state == "complete":
            return
        if state == "standby":
            if not self._fires(act.find("StartTrigger")):
                return
            self.state[act] = "running"
        stop = act.find("StopTrigger")
        if stop is not None and self._fires(stop):
            for event in act.iter("Event"):
                self._complete(event)
            self.state[act] = "complete"
            self.completed.add(act)
            return
        for event in act.iter("Event"):
            self._step_event(event)
        if all(self.state.get(event) == "complete" for event in act.iter("Event")):
            self.state[act] = "complete"
            self.completed.add(act)

    def _step_event(self, event: Node) -> None:
        state = self.state.setdefault(event, "standby")
        if state == "running" and all(run.done for run in self.work[event]):
            again = event.get("maximumExecutionCount", "1") != "1"
            self.state[event] = state = "standby" if again else "complete"
            if not again:
                self._complete(event)
            for condition in (
                event.iterfind("StartTrigger/ConditionGroup/Condition") if again else ()
            ):
                self.history.pop(condition, None)
                self.last.pop(condition, None)
        if state == "standby" and self._fires(event.find("StartTrigger")):
            self.state[event] = "running"
            for condition in event.iter("Condition"):  # while it runs nothing is looked at
                self.history.pop(condition, None)
            self.starts.setdefault(event.get("name"), self.time)
            group = event.getparent().getparent()
            actor = group.find("Actors/EntityRef")
            entity = None if actor is None else self.entities[actor.get("entityRef")]
            runs = [self._start(action[0], entity) for action in event.iterfind("Action")]
            self.work[event] = [run for run in runs if run is not None]

    def _complete(self, event: Node) -> None:
        for run in self.work.get(event, ()):
            run.done = True
        if event in self.work:
            self.ends.setdefault(event.get("name"), self.time)
        self.state[event] = "complete"
        self.completed.add(event)

    def _fires(self, trigger: Node | None) -> bool:
        groups = () if trigger is None else trigger.iterfind("ConditionGroup")
        return any([self._all_hold(list(group)) for group in groups])  # each is looked at

    def _all_hold(self, conditions: list[Node]) -> bool:
        """Whether all hold; a lazy tool looks at none behind a false one, but at delayed ones."""
        result = True
        for condition in conditions:
            if result or not self.is_lazy or number(condition, "delay") > 0.0:
                held = self._holds(condition)
                result = result and held
        return result

    def _holds(self, condition: Node) -> bool:
        value = self._test(
            condition[0][0] if condition[0].tag == "ByValueCondition" else condition[0]
        )
        edge, before = condition.get("conditionEdge"), self.last.get(condition)
        self.last[condition] = value
        if edge == "rising":
            value = value and before is False
        elif edge == "falling":
            value = not value and before is True
        history = self.history.setdefault(condition, [])
        history.append((self.time, value))
        delay = number(condition, "delay")
        then = self.time - delay + 1e-9
        return next((held for at, held in reversed(history) if at <= then), False)

    def _test(self, node: Node) -> bool:
        match node.tag:
            case "SimulationTimeCondition":
                return RULES[node.get("rule")](self.time, number(node, "value"))
            case "VariableCondition" | "ParameterCondition":
                name = node.get("variableRef") or node.get("parameterRef")
                value, rule = self.variables[name], node.get("rule")
                if rule in ("equalTo", "notEqualTo"):
                    return (value == node.get("value")) is (rule == "equalTo")
                return RULES[rule](float(value), float(node.get("value")))
            case "StoryboardElementStateCondition":
                kind = {"act": "Act", "event": "Event"}[node.get("storyboardElementType")]
                named = next(
                    each
                    for each in self.root.iter(kind)
                    if each.get("name") == node.get("storyboardElementRef")
                )
                if node.get("state") == "completeState":
                    return named in self.visible
                running = self.state.get(named, "standby")
                return running == node.get("state").removesuffix("State")
            case "ByEntityCondition":
                entity = self.entities[node.find("TriggeringEntities/EntityRef").get("entityRef")]
                return self._test_entity(entity, node.find("EntityCondition")[0])
        raise NotImplementedError(node.tag)

    def _test_entity(self, entity: Entity, node: Node) -> bool:
        if node.tag == "SpeedCondition":
            return RULES[node.get("rule")](entity.v, number(node, "value"))
        if node.tag == "RelativeClearanceCondition":
            other = self.entities[node.find("EntityRef").get("entityRef")]
            apart = other.x - entity.x
            low, high = -number(node, "distanceBackward"), number(node, "distanceForward")
            return not low <= apart <= high
        if node.tag == "RelativeDistanceCondition":
            other = self.entities[node.get("entityRef")]
            return RULES[node.get("rule")](
                self.stage.distance(entity, other, node), number(node, "value")
            )
        raise NotImplementedError(node.tag)

    # --- actions ----------------------------------------------------------------------------------

    def _start(self, action: Node, entity: Entity | None) -> Running | None:
        inner = action[0] if action.tag in ("PrivateAction", "GlobalAction") else action
        if inner.tag in ("VariableAction", "ParameterAction"):
            name = inner.get("variableRef") or inner.get("parameterRef")
            self.variables[name] = inner.find("SetAction").get("value")
            return None
        assert entity is not None
        return self.stage.begin(action, entity)
