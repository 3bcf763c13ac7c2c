"""Arguments of actions and modifiers, as constants."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import Pace
from osc2tx.backends.xosc.values.constants import Constant, Member, Named
from osc2tx.losses.bounds import Bound
from osc2tx.losses.entries import NOTHING, Inexpressible, Remedy


def construct_of_action(node: ir.Invoke) -> str:
    """Return what an action is called in reports."""
    return f"action {node.action}"


class Arguments:
    """Arguments of an action or a modifier by parameter, as constants.

    Attributes:
        source: The invocation, or the modifier.
        span: Where it stands.
        name: Of the action or the modifier.
        at: When a modifier holds: `all`, `start` or `end`.
        construct: What it is called in reports.
    """

    def __init__(self, ctx: Context, source: ir.ModifierCall | ir.Invoke) -> None:
        """Take the arguments; nothing is computed before it is asked for."""
        self._ctx = ctx
        self._by_name = {argument.parameter: argument for argument in source.arguments}
        self._used: set[str] = set()
        self.source = source
        self.span = source.span
        if isinstance(source, ir.Invoke):
            self.name, self.at, self.construct = source.action, "all", construct_of_action(source)
        else:
            self.name, self.at, self.construct = source.name, source.at, f"modifier {source.name}"

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

    def required(self, name: str) -> float:
        """Return a number, in SI units, that the library requires."""
        number = self.number(name)
        assert number is not None, "the rules ask for it"
        return number

    def size(self, name: str) -> float | None:
        """Return a number, in SI units, or what stands for the range that is said instead."""
        given = self.number(name)
        return self.number(f"{name}_range") if given is None else given

    def distance(self) -> float:
        """Return metres, or what stands for the range that is said instead."""
        size = self.size("distance")
        if size is None:
            instead = " but a shape" if "shape" in self else ""
            raise Inexpressible(f"no distance{instead} is stated", self.span)
        return size

    def count(self, name: str) -> int:
        """Return a whole number, 1 if it is left out."""
        number = self.number(name)
        return 1 if number is None else round(number)

    def lanes_to_left(self) -> int:
        """Return `lane` as a number of lanes to the `side`: positive to the left."""
        count = self.count("lane")
        return count if self.member("side", "left") == "left" else -count

    def beside_lane(self) -> tuple[CastMember | None, int]:
        """Return beside whose lane `lane` is, and how many lanes to the left of that one."""
        same, side = self.entity("same_as"), self.entity("side_of")
        return same or side, 0 if side is None else self.lanes_to_left()

    def ahead_of(self) -> tuple[CastMember | None, bool]:
        """Return ahead of whom `position` is, and whether it is behind instead."""
        ahead, behind = self.entity("ahead_of"), self.entity("behind")
        return ahead or behind, behind is not None

    def offsets(self) -> tuple[float, float]:
        """Return the metres that are left out at the start and the end of a way."""
        return self.number("start_offset") or 0.0, self.number("end_offset") or 0.0

    def pace(self, duration: float | None = None) -> Pace:
        """Return how a change goes that `rate_profile` and `rate_peak` describe."""
        return Pace(self.member("rate_profile", "none"), self.number("rate_peak"), duration)

    def shape(self) -> tuple[Pace, float | None]:
        """Return how a change goes by its `shape`, and to what value if the shape says so.

        Raises:
            Inexpressible: It is a shape of the scenario's own.
        """
        shape, values = self.get("shape"), self._ctx.values
        if shape is None:
            return Pace(), None
        if not isinstance(shape, Named) or not values.is_library_shape(shape.name):
            raise Inexpressible("a user-defined shape is computed during the run")
        profile = values.member_in(shape.name, "rate_profile") or "none"
        peak, target = (values.number_in(shape.name, name) for name in ("rate_peak", "target"))
        return Pace(profile, peak), target

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
            raise Inexpressible(f"`{name}` is no entity of the XML", self.span)
        return self._ctx.cast[value.name]

    def required_entity(self, name: str) -> CastMember:
        """Return an actor that the library requires."""
        entity = self.entity(name)
        assert entity is not None, "the rules ask for it"
        return entity

    def approximate(self, reason: str, bound: Bound, remedy: Remedy = NOTHING) -> None:
        """Report that the action or modifier means nearly the same in the XML."""
        self._ctx.report.approximate(self.construct, self.span, reason, bound, remedy)

    def doubt(self, reason: str, remedy: Remedy = NOTHING, note: str = "") -> None:
        """Report why it may differ in the XML: a played document shows whether it does."""
        self._ctx.report.doubt(self.construct, self.span, reason, remedy, note)

    def finish(self) -> None:
        """Refuse arguments that nobody has asked for: they would be dropped."""
        for name, argument in self._by_name.items():
            if name not in self._used:
                raise Inexpressible(f"argument `{name}` has no counterpart", argument.span)
