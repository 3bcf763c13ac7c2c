"""One invocation of an action, as handlers of actions and modifiers see it.

A handler of an action or a modifier takes a `Leaf` and returns what changes: one `Change` for each
domain (longitudinal, lateral) that it controls.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import (
    Course,
    Limits,
    Pace,
    Profile,
    held_by,
    road_condition,
    steepest,
)
from osc2tx.backends.xosc.flattening.lengths import begin_of
from osc2tx.backends.xosc.state import LONGITUDINAL, NOTHING_KNOWN, ActorState, Demand, merged
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import dataclass, replace

UNKNOWN_SPEED = "the speed at the start is only known during the run"

Ending: TypeAlias = Literal["goal", "open", "instant"]


@dataclass(frozen=True, slots=True)
class Change:
    """What an action does in one domain.

    Attributes:
        domain: `longitudinal` or `lateral`.
        actions: Elements that do it, `PrivateAction` or `GlobalAction`; none if it is so already.
        time: Seconds until it is done; `None` if that is not known, infinite if it never is.
        during: What is known about the actor until then.
        after: What is known about it from then on.
        goes_on: It comes to its end though its action is over before, if nothing else begins.
    """

    domain: str
    actions: tuple[xml.ActionPart, ...]
    time: float | None
    during: ActorState
    after: ActorState
    goes_on: bool = False


Changes: TypeAlias = tuple[Change, ...]

Global: TypeAlias = xml.GlobalAction | xml.UserDefinedAction
"""An action that concerns no entity."""


@dataclass(frozen=True, slots=True)
class Later:
    """A global action that is carried out so many seconds after its invocation began."""

    seconds: float
    action: Global


Globals: TypeAlias = tuple[Global | Later, ...]


@dataclass(frozen=True, slots=True)
class Performance:
    """What an action does.

    Attributes:
        changes: By domain.
        ends: At its goal, at once, or never by itself.
        lasts: Seconds after which it is over, if that does not follow from its elements.
        reached: Conditions that hold when it is over, likewise; all of them have to.
    """

    changes: Changes
    ends: Ending
    lasts: float | None = None
    reached: tuple[xml.ByEntityCondition, ...] = ()

    @property
    def actions(self) -> tuple[xml.ActionPart, ...]:
        """Elements of all changes."""
        return tuple(action for change in self.changes for action in change.actions)


def _is_left_to_until(ctx: Context, node: ir.Invoke) -> bool:
    """Whether an `until` decides when an action without end is over, within a range."""
    entry = ir.entry_of(node)
    is_endless = entry is not None and entry.ends == "open"
    if node.duration is None or not node.until or not is_endless or ctx.module.dialect == "carla":
        return False
    low, high = ctx.values.bounds(node.duration)
    return low < high


class Leaf:
    """An invocation.

    Attributes:
        ctx: The context.
        node: The invocation.
        member: Who acts.
        arguments: Those of the action.
        state: What is known about the actor at the start.
        duration: Its length (s), if its own duration or one around it says so.
        limit: What compositions leave it (s) to reach its goal; `None`: nothing limits it.
        event: Name of the event that will carry it out.
        is_start: It begins with the run.
        enters: It is the first action of an actor that nothing places at the start of the run.
        course: Of the speed, where the changes say it.
        distance: Metres after which it is over; `None` if no distance ends it.
        reached: Conditions that hold when it is over.
        others: Who does what from its end on, and a word for it.
    """

    def __init__(
        self,
        ctx: Context,
        node: ir.Invoke,
        member: CastMember,
        event: str,
        *,
        is_start: bool,
        time_left: float | None = None,
        time_limit: float | None = None,
    ) -> None:
        """Take the invocation.

        Compositions around it may end it: after `time_left` (s), or after `time_limit` (s) at the
        most.
        """
        self.ctx = ctx
        self.node = node
        self.member = member
        self.arguments = Arguments(ctx, node)
        self.state = ctx.states[member.name]
        own = None
        if node.duration is not None and not _is_left_to_until(ctx, node):
            own = ctx.values.number(node.duration)
        self.duration = time_left if own is None else own
        self.limit = time_limit
        self.event = event
        self.is_start = is_start
        self.enters = not is_start and member.name not in ctx.present
        self.course: Course | None = None
        self.distance: float | None = None
        self.reached: tuple[xml.ByEntityCondition, ...] = ()
        self.others: list[tuple[CastMember, xml.ActionPart, str]] = []

    @property
    def limits(self) -> Limits:
        """What the actor can do on roads that the weather has wetted."""
        return held_by(self.member.limits, road_condition(self.ctx.weather))

    def demand(self, faster: float, slower: float) -> None:
        """Note an acceleration and a deceleration (m/s^2) that the actor has to be able to."""
        self.ctx.demand(self.member.name, Demand(0.0, faster, slower))

    def follow(self, reference: CastMember, *, rigid: bool) -> None:
        """Note that the speed depends on that of another actor: within limits, or at once."""
        limits = self.limits
        own = Demand(0.0, limits.acceleration, limits.deceleration)
        self.ctx.demand(self.member.name, own)
        if rigid:
            self.ctx.followed.setdefault(self.member.name, set()).add(reference.name)

    def at_open_speed(self, action: xml.PrivateAction, time: float | None) -> Change:
        """Return the change of the speed, in a time (s), to one that only the run shows."""
        state = replace(self.state, speed=None).finished(LONGITUDINAL)
        return Change(LONGITUDINAL, (action,), time, state, state)

    def demand_of(self, changes: Sequence[Change]) -> None:
        """Note what changes ask of the motion of the actor."""
        name = self.member.name
        if self.course is not None:
            self.ctx.demand(name, Demand(0.0, *steepest(self.course)))
        for change in changes:
            for speed in (change.during.speed, change.after.speed):
                if change.domain == LONGITUDINAL and speed is not None:
                    self.ctx.demand(name, Demand(max(map(abs, speed))))

    def modifier(self, name: str) -> Arguments | None:
        """Return the modifier of a name, if the invocation has one."""
        node = next((call for call in self.node.modifiers if call.name == name), None)
        return None if node is None else Arguments(self.ctx, node)

    def in_time(self, call: Arguments, pace: Pace) -> Pace:
        """Return how a change goes that has to be done when the invocation ends, if it has to."""
        is_free = pace.profile != "asap" and pace.peak is None
        return pace._replace(duration=self.duration) if call.at == "end" and is_free else pace

    def within_limit(self, pace: Pace, planned: Callable[[Pace], Profile]) -> tuple[Pace, Profile]:
        """Return how a change goes and its course, in no more time than compositions leave it."""
        course = planned(pace)
        is_free = pace == Pace(pace.profile) and pace.profile != "asap"
        if self.limit is None or course.duration <= self.limit or not is_free:
            return pace, course
        pace = pace._replace(duration=self.limit)
        return pace, planned(pace)

    def starts_behind(self, reference: CastMember) -> float | None:
        """Return by how many metres an actor is behind another one, as at the start of the run.

        `None`: that is not known, or may have changed since.
        """
        apart = self.ctx.init_gaps.get((self.member.name, reference.name))
        is_so = self.is_start or (apart is not None and self._keeps_pace_with(reference))
        return apart if is_so else None

    def _keeps_pace_with(self, reference: CastMember) -> bool:
        """Whether both have been equally fast in their lanes from the start of the run on."""
        ctx, begin = self.ctx, begin_of(self.ctx, self.node)
        speed = ctx.at_start[self.member.name].known_speed
        if begin is None or speed is None or ctx.scope is not ctx.root:
            return False
        nodes = {id(node): node for node in ir.invocations(ctx.scenario.body)}
        for name in (self.member.name, reference.name):
            start, moves = ctx.at_start[name], ctx.moves_of(name)
            if moves is None or start.known_speed != speed:
                return False
            for number, move in moves.items():
                since = begin_of(ctx, nodes[number]) if number in nodes else None
                is_later = since is not None and since >= begin
                if not is_later and not move.during.goes_on_as(start):
                    return False
        return True

    def state_of(self, other: CastMember, *, always: bool = False) -> ActorState:
        """Return what is known of another actor at the start of the action, or all the time.

        Members beside one another are written one after the other: what one of them does may be
        over then, or not.
        """
        ctx, body = self.ctx, self.ctx.scenario.body
        if self.is_start and not always:
            return ctx.at_start[other.name]
        moves = ctx.moves_of(other.name)
        if moves is None:
            return NOTHING_KNOWN
        members = ir.runs_beside(body, self.node)
        beside = {id(n): n for member in members for n in ir.walk_behaviors(member)}
        invokes = any(isinstance(each, ir.InvokeScenario) for each in beside.values())
        is_any = always or invokes or not ir.holds(body, self.node)
        state = (ctx.at_start if is_any else ctx.states)[other.name]
        for node, move in moves.items():
            state = merged(state, move.during) if is_any or node in beside else state
        return state

    def is_left(self, side: str) -> bool:
        """Whether the `inside` or the `outside` of its road is to its left."""
        roads, lane = self.ctx.roads, self.state.lane
        is_right_hand = (
            roads is None or lane is None or roads.map.roads[lane.road].right_hand_traffic
        )
        return (side == "inside") is is_right_hand

    def known_speed(self, otherwise: str = UNKNOWN_SPEED) -> float:
        """Return the speed at the start (m/s).

        Raises:
            Inexpressible: It is not known; `otherwise` says so.
        """
        speed = self.state.known_speed
        if speed is None:
            raise Inexpressible(otherwise)
        return speed


Perform: TypeAlias = Callable[[Leaf], Performance]
PerformGlobal: TypeAlias = Callable[[Context, ir.Invoke, Arguments], Globals]
Modify: TypeAlias = Callable[[Leaf, Arguments], Changes]
