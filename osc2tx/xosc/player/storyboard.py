"""The storyboard of a document, from instant to instant.

At an instant the storyboard is evaluated to a fixed point: transitions take no time. Then all
entities move by one step. Elements are compared by identity: two equal ones are two.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.actions import Stage
from osc2tx.xosc.player.agenda import Agenda
from osc2tx.xosc.player.bodies import LATERAL, Body, Running, body_of, couple
from osc2tx.xosc.player.conditions import Conditions
from osc2tx.xosc.player.courses import with_parameters
from osc2tx.xosc.player.distances import Ruler
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.global_state import GlobalState
from osc2tx.xosc.player.reading import BY_THE_STANDARD, Reading
from osc2tx.xosc.reader import read
from osc2tx_runtime.opendrive import RoadMap

Row = tuple[float, float, float, float]  # t, x, y, v
NOTHING: Mapping[str, str] = MappingProxyType({})
SETTLES = 1000  # passes of an instant


Member = tuple[xml.Event, Sequence[xml.Event], xml.ManeuverGroup]
"""An event, those of its maneuver, and the group of its actors."""


class _Act:
    """An act, with what each step asks of it.

    Attributes:
        element: The act.
        start: When it starts; `None`: with the storyboard.
        stop: When it is stopped; `None`: never.
        members: Its events.
        agenda: Which of them are looked at.
        repeatable: The groups that may be executed again, with their events.
    """

    def __init__(self, element: xml.Act) -> None:
        self.element = element
        self.start, self.stop = element.find(xml.StartTrigger), element.find(xml.StopTrigger)
        groups = list(element.all(xml.ManeuverGroup))
        self.members: list[Member] = []
        for group in groups:
            for maneuver in group.all(xml.Maneuver):
                beside = tuple(maneuver.all(xml.Event))
                self.members += [(event, beside, group) for event in beside]
        self.agenda = Agenda(len(self.members))
        several = [group for group in groups if group.maximumExecutionCount > 1]
        self.repeatable = [(group, tuple(group.below(xml.Event))) for group in several]


class Evaluator:
    """Plays a document.

    Attributes:
        time: Seconds since the start.
        step: The same in steps.
        starts: First start of each event and act, by name.
        track: Motion of each entity.
        ends: Times (s) at which entities reached the end of their roads, where they stop.
        forks: Times (s) at which entities reached a fork during a lane change or against the
            traffic, if the tool may take any of the roads.
    """

    def __init__(
        self,
        document: str | Element,
        road_map: RoadMap,
        dt: float,
        *,
        reading: Reading = BY_THE_STANDARD,
        given: Mapping[str, str] = NOTHING,
    ) -> None:
        self.root = with_parameters(
            document if isinstance(document, Element) else read(document), given
        )
        self.dt, self.step = dt, 0
        self.bodies: dict[str, Body] = {}
        for node in self.root.below(xml.ScenarioObject):
            body = body_of(node)
            body.keeps_lanes = body.keeps_lanes or reading.sends_along_lanes
            body.counts_along_road = reading.counts_along_roads
            body.reports_commanded = reading.commands_speeds
            self.bodies[body.name] = body
        self.stage = Stage(self.root, self.bodies, road_map, dt, reading)
        self.ruler = Ruler(road_map)
        self.globals = GlobalState(self.root, self._changed)
        self.states: dict[int, str] = {}
        self.transitions: set[tuple[int, str]] = set()
        self.counts: dict[int, int] = {}
        self.started_at: dict[int, int] = {}
        self.work: dict[int, list[Running]] = {}
        self._event_of = {
            id(action): event
            for event in self.root.below(xml.Event)
            for action in event.all(xml.Action)
        }
        self._runs: dict[int, list[Running]] = {}
        self.starts: dict[str, float] = {}
        self.track: dict[str, list[Row]] = {name: [] for name in self.bodies}
        self.ends: dict[str, float] = {}
        self.forks: dict[str, float] = {}
        self._guesses = reading.guesses_at_forks
        self.conditions = Conditions(self, dt, reading)
        self._stop = self.root.one(xml.Storyboard).find(xml.StopTrigger)
        self._ending = Agenda(1)
        self._acts = [_Act(each) for each in self.root.below(xml.Act)]
        self._place: dict[int, tuple[Agenda, int]] = {}
        self._waiting: dict[int | str, list[tuple[Agenda, int]]] = {}
        for act in self._acts:
            for index, (event, *_) in enumerate(act.members):
                self._place[id(event)] = act.agenda, index
        self._init()

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.step * self.dt

    def _init(self) -> None:
        """Execute `Init`: actions of an entity in order, after the positions they refer to."""
        privates = self.root.one(xml.Storyboard).one(xml.Init).one(xml.Actions).all(xml.Private)
        waiting = [(self.bodies[each.entityRef], list(each.children)) for each in privates]
        while waiting:
            has_begun = False
            for body, actions in waiting:
                while actions and not self._waits(actions[0]):
                    self.stage.begin(actions.pop(0), body, self.time)
                    has_begun = True
            waiting = [each for each in waiting if each[1]]
            if waiting and not has_begun:
                raise Unplayable("positions of Init refer to each other", waiting[0][1][0].place)
        for action in (
            self.root.one(xml.Storyboard).one(xml.Init).one(xml.Actions).all(xml.GlobalAction)
        ):
            self.globals.execute(action, self.time)
        couple(self.root, self.bodies)
        for body in self.bodies.values():
            if body.behind is not None:
                tow, hitch, bar = body.behind
                x, y, h = tow.here
                back = hitch + bar
                body.pose = tow.here._replace(x=x - back * math.cos(h), y=y - back * math.sin(h))
                body.v = tow.v

    def _waits(self, action: Element) -> bool:
        named = (node.get("entityRef") for node in action.walk())
        return any(name is not None and self.bodies[name].pose is None for name in named)

    # --- a run ------------------------------------------------------------------------------------

    def play(self, most: float) -> float:
        """Play to the end; return when that is (s), infinite if it is not over in time."""
        while self.time < most:
            for name, body in self.bodies.items():
                if body.pose is not None:
                    self.track[name].append((self.time, *body.here[:2], body.v))
                if body.is_at_end:
                    self.ends.setdefault(name, self.time)
                if self._guesses and self._is_lost(body):
                    self.forks.setdefault(name, self.time)
            self.transitions.clear()
            self.globals.advance(self.time)
            if self._settle():
                self._note_arrivals()
                return self.time
            self.stage.advance(self.time)
            self.step += 1
        return math.inf

    def _note_arrivals(self) -> None:
        """Take down where entities are put at the end, besides where they have been before."""
        for name, body in self.bodies.items():
            rows = self.track[name]
            if rows and body.here[:2] != rows[-1][1:3]:
                rows.append((self.time, *body.here[:2], body.v))

    def _is_lost(self, body: Body) -> bool:
        """Whether an entity is behind a fork in a lane change, or against the traffic."""
        run, place, road_map = body.actions.get(LATERAL), body.place, self.ruler.map
        is_changing = run is not None and not run.done and run.changes_lane
        if place is None or not (is_changing or body.along < 0):
            return False
        lane = road_map.lane_key(place)
        before, after = road_map.predecessors, road_map.successors
        before, after = (before, after) if body.along > 0 else (after, before)
        return any(len(after(each)) > 1 for each in before(lane))

    def _settle(self) -> bool:
        """Go through the storyboard until nothing changes; return whether it is over."""
        for _ in range(SETTLES):
            if any(self._stops() for _ in self._ending.due(self.time)):
                return True
            if not any([self._act(each) for each in self._acts]):
                return False
        raise Unplayable(f"the storyboard does not come to rest at {self.time:g} s")

    def is_in(self, element: Element, state: str) -> bool:
        """Whether an element is in a state, or just in a transition."""
        if state.endswith("Transition"):
            event = self._event_of.get(id(element), element)  # an action ends with its event
            if not isinstance(event, xml.Event | xml.Act):
                return self._turns(element, state)
            return (id(event), state) in self.transitions
        if isinstance(element, xml.Event | xml.Act):
            return self._state(element) == state
        if isinstance(element, xml.Action):
            return self._state_of_action(element) == state
        inner = {self._state(event) for event in element.below(xml.Event)}
        if inner == {"completeState"}:
            return state == "completeState"
        is_begun = inner != {"standbyState"} or id(element) in self.counts
        return state == ("runningState" if is_begun else "standbyState")

    def _turns(self, element: Element, state: str) -> bool:
        """Whether a group of events is in a transition: with its first one, or with its last."""
        if (id(element), state) in self.transitions:
            return True
        events = list(element.below(xml.Event))
        if not any((id(event), state) in self.transitions for event in events):
            return False
        if state == "startTransition":
            begun = (self.started_at.get(id(event), self.step) for event in events)
            return all(step == self.step for step in begun)
        return all(self._state(event) == "completeState" for event in events)

    def _state_of_action(self, action: xml.Action) -> str:
        runs = self._runs.get(id(action))
        if runs is None:
            return "standbyState"
        return "completeState" if all(run.done for run in runs) else "runningState"

    def _state(self, element: Element) -> str:
        return self.states.get(id(element), "standbyState")

    def _enter(self, element: Element, state: str, *transitions: str) -> None:
        self.states[id(element)] = state
        self._changed(id(element))
        if id(element) in self._place:
            agenda, index = self._place[id(element)]
            agenda.wake(index)
        self.transitions |= {(id(element), transition) for transition in transitions}

    def _changed(self, what: int | str) -> None:
        """Wake the triggers that wait for an element or a variable."""
        for agenda, index in self._waiting.pop(what, ()):
            agenda.wake(index)

    # --- acts and events --------------------------------------------------------------------------

    def _act(self, act: _Act) -> bool:
        """Take an act further; return whether something has changed."""
        element, agenda = act.element, act.agenda
        state, changed = self._state(element), False
        if state == "completeState":
            return False
        if state == "standbyState":
            if act.start is not None and not self.conditions.fires(act.start):
                return False
            self._enter(element, "runningState", "startTransition")
            self.starts.setdefault(element.name, self.time)
            changed = True
        if self.conditions.fires(act.stop):
            for event, *_ in act.members:
                self._break_off(event)
            self._enter(element, "completeState", "stopTransition")
            return True
        for index in agenda.due(self.time):
            member = act.members[index]
            if self._event(*member):
                changed = True
            else:
                self._put_off(member[0], agenda, index)
            if self._state(member[0]) == "completeState":
                agenda.drop(index)
        for group, events in act.repeatable:
            changed = self._repeat(group, events, agenda) or changed
        if agenda.is_over:
            self._enter(element, "completeState", "endTransition")
            changed = True
        return changed

    def _repeat(
        self, group: xml.ManeuverGroup, events: Sequence[xml.Event], agenda: Agenda
    ) -> bool:
        """Execute a group again that has come to its end, if it may be; return whether it is."""
        done = self.counts.get(id(group), 0) + 1
        is_over = all(self._state(event) == "completeState" for event in events)
        if not is_over or not events or done >= group.maximumExecutionCount:
            return False
        self.counts[id(group)] = done
        self.transitions.add((id(group), "endTransition"))
        for event in events:
            self.counts[id(event)] = 0
            agenda.take_up(self._place[id(event)][1])
            self._enter(event, "standbyState")
            trigger = event.find(xml.StartTrigger)
            if trigger is not None:
                self.conditions.forget(trigger)
        return True

    def _put_off(self, event: xml.Event, agenda: Agenda, index: int) -> None:
        """Let an unchanged event wait for the causes of its trigger."""
        trigger = event.find(xml.StartTrigger)
        if self._state(event) != "standbyState" or self.started_at.get(id(event)) == self.step:
            return
        if trigger is not None:
            self._wait(trigger, agenda, index)

    def _stops(self) -> bool:
        """Whether the storyboard is over now."""
        if self.conditions.fires(self._stop):
            return True
        if self._stop is not None:
            self._wait(self._stop, self._ending, 0)
        return False

    def _wait(self, trigger: Element, agenda: Agenda, index: int) -> None:
        """Postpone the start of an element whose trigger does not fire."""
        awaited = self.conditions.awaited(trigger)
        if awaited is not None:
            agenda.sleep(index, awaited.times)
            for what in awaited.changes:
                self._waiting.setdefault(what, []).append((agenda, index))

    def _event(
        self, event: xml.Event, beside: Sequence[xml.Event], group: xml.ManeuverGroup
    ) -> bool:
        """Take an event further, given those of its maneuver; return whether something changed."""
        state = self._state(event)
        if state == "runningState" and all(run.done for run in self.work[id(event)]):
            again = self.counts[id(event)] < event.maximumExecutionCount
            self._enter(event, "standbyState" if again else "completeState", "endTransition")
            return True
        # a trigger is evaluated once in each step in which the event stands by
        if state != "standbyState" or self.started_at.get(id(event)) == self.step:
            return False
        trigger = event.find(xml.StartTrigger)
        if trigger is not None and not self.conditions.fires(trigger):
            return False
        running = [
            each for each in beside if each is not event and self._state(each) == "runningState"
        ]
        self.started_at[id(event)] = self.step
        self.counts[id(event)] = self.counts.get(id(event), 0) + 1
        if event.priority == "skip" and running:
            again = self.counts[id(event)] < event.maximumExecutionCount
            self._enter(event, "standbyState" if again else "completeState", "skipTransition")
            return True
        if event.priority in ("override", "overwrite"):
            for each in running:
                self._break_off(each)
        self._enter(event, "runningState", "startTransition")
        self.starts.setdefault(event.name, self.time)
        self.work[id(event)] = []
        for action in event.all(xml.Action):
            runs = self._runs[id(action)] = list(self._begin(action, group))
            self.work[id(event)] += runs
        return True

    def _begin(self, action: xml.Action, group: xml.ManeuverGroup) -> Iterator[Running]:
        inner = action.inner
        if isinstance(inner, xml.GlobalAction):
            self.globals.execute(inner, self.time)
        elif isinstance(inner, xml.PrivateAction):
            for actor in group.one(xml.Actors).all(xml.EntityRef):
                run = self.stage.begin(inner, self.bodies[actor.entityRef], self.time)
                if run is not None:
                    yield run

    def _break_off(self, event: xml.Event) -> None:
        for run in self.work.get(id(event), ()):
            run.done = True
        if self._state(event) != "completeState":
            self._enter(event, "completeState", "stopTransition")


def map_of(document: str, folders: Sequence[Path]) -> Path:
    """Return the file of the map that a document names.

    Raises:
        Unplayable: No folder has it.
    """
    node = read(document).one(xml.RoadNetwork).one(xml.LogicFile)
    for folder in folders:
        for name in (node.filepath, f"{node.filepath}.xodr"):
            if (folder / name).is_file():
                return folder / name
    raise Unplayable(f"there is no map {node.filepath}", node.place)
