"""One invocation of an action, as handlers of actions and modifiers see it.

A handler of an action or a modifier takes a `Leaf` and returns what changes: one `Change` for each
domain (longitudinal, lateral) that it controls.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import Course, Limits, held_by, road_condition, steepest
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.state import LONGITUDINAL, ActorState, Demand
from osc2tx.backends.xosc.values.constants import Constant, Member, Named
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import dataclass

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


Global: TypeAlias = xml.GlobalAction | xml.UserDefinedAction
"""An action that concerns no entity."""


@dataclass(frozen=True, slots=True)
class Later:
    """A global action that is carried out so many seconds after its invocation began."""

    seconds: float
    action: Global


@dataclass(frozen=True, slots=True)
class Performance:
    """What an action does.

    Attributes:
        changes: By domain.
        ends: At its goal, at once, or never by itself.
        lasts: Seconds after which it is over, if that does not follow from its elements.
        reached: Conditions that hold when it is over, likewise; all of them have to.
    """

    changes: tuple[Change, ...]
    ends: Ending
    lasts: float | None = None
    reached: tuple[xml.ByEntityCondition, ...] = ()


@dataclass(frozen=True, slots=True)
class Uneven:
    """How an even change of the speed differs from that of the world.

    Attributes:
        speed: By how much (m/s) at most.
        length: Seconds after which the speeds are the same; `None`: where the change is complete.
    """

    speed: float
    length: float | None


class Arguments:
    """Arguments of an action or modifier by parameter, as constants."""

    def __init__(
        self, ctx: Context, arguments: tuple[ir.Argument, ...], source: ir.ModifierCall | ir.Invoke
    ) -> None:
        """Take the arguments; nothing is computed before it is asked for."""
        self._ctx = ctx
        self._by_name = {argument.parameter: argument for argument in arguments}
        self._used: set[str] = set()
        self.source = source

    def __contains__(self, name: str) -> bool:
        return name in self._by_name

    def expression(self, name: str) -> ir.Expression | None:
        """Return the expression of an argument."""
        self._used.add(name)
        argument = self._by_name.get(name)
        return None if argument is None else argument.value

    def get(self, name: str) -> Constant | None:
        """Return the value of an argument."""
        expression = self.expression(name)
        return None if expression is None else self._ctx.values.of(expression)

    def number(self, name: str) -> float | None:
        """Return a number, in SI units."""
        expression = self.expression(name)
        return None if expression is None else self._ctx.values.number(expression)

    def member(self, name: str, default: str) -> str:
        """Return the name of a member of an enum."""
        value = self.get(name)
        return value.name if isinstance(value, Member) else default

    def text(self, name: str) -> str | None:
        """Return a string."""
        value = self.get(name)
        return value if isinstance(value, str) else None

    def entity(self, name: str) -> CastMember | None:
        """Return an actor."""
        value = self.get(name)
        if value is None:
            return None
        if not isinstance(value, Named) or value.name not in self._ctx.cast:
            raise Inexpressible(f"`{name}` is no entity of the XML", self.source.span)
        return self._ctx.cast[value.name]

    def finish(self) -> None:
        """Refuse arguments that nobody has asked for: they would be dropped.

        Raises:
            Inexpressible: There are some.
        """
        for name, argument in self._by_name.items():
            if name not in self._used:
                raise Inexpressible(f"argument `{name}` has no counterpart", argument.span)


class Leaf:
    """An invocation.

    Attributes:
        ctx: The context.
        node: The invocation.
        member: Who acts.
        arguments: Those of the action.
        state: What is known about the actor at the start.
        duration: Its length (s), if its own duration or one around it says so.
        event: Name of the event that will carry it out.
        is_start: It begins with the run.
        enters: It is the first action of an actor that nothing places at the start of the run.
        course: Of the speed, where the changes say it.
        distance: Metres after which it is over; `None` if no distance ends it.
        reached: Conditions that hold when it is over.
        uneven: How its change of the speed differs, where it only is an even one.
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
    ) -> None:
        """Take the invocation; `time_left` (s) is its length if compositions around it end it."""
        self.ctx = ctx
        self.node = node
        self.member = member
        self.arguments = Arguments(ctx, node.arguments, node)
        self.state = ctx.states[member.name]
        own = None if node.duration is None else ctx.values.number(node.duration)
        self.duration = time_left if own is None else own
        self.event = event
        self.is_start = is_start
        self.enters = not is_start and member.name not in ctx.present
        self.course: Course | None = None
        self.distance: float | None = None
        self.reached: tuple[xml.ByEntityCondition, ...] = ()
        self.uneven: Uneven | None = None
        self.others: list[tuple[CastMember, xml.ActionPart, str]] = []

    def on_me(self, condition: xml.EntityConditionPart) -> xml.ByEntityCondition:
        """Return a condition on the actor."""
        me = xml.EntityRef(entityRef=self.member.name)
        return xml.ByEntityCondition(
            xml.TriggeringEntities(me, triggeringEntitiesRule="any"),
            xml.EntityCondition(condition),
        )

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

    def demand_of(self, changes: Sequence[Change]) -> None:
        """Note what changes ask of the motion of the actor."""
        name = self.member.name
        if self.course is not None:
            self.ctx.demand(name, Demand(0.0, *steepest(self.course)))
        for change in changes:
            for speed in (change.during.speed, change.after.speed):
                if change.domain == LONGITUDINAL and speed is not None:
                    self.ctx.demand(name, Demand(max(map(abs, speed))))

    @property
    def construct(self) -> str:
        """What it is called in reports."""
        return construct_of_action(self.node)


def construct_of_action(node: ir.Invoke) -> str:
    """Return what an action is called in reports."""
    return f"action {node.action}"


Perform: TypeAlias = Callable[[Leaf], Performance]
PerformGlobal: TypeAlias = Callable[[Context, ir.Invoke, Arguments], tuple[Global | Later, ...]]

Modify: TypeAlias = Callable[[Leaf, ir.ModifierCall, Arguments], tuple[Change, ...]]
