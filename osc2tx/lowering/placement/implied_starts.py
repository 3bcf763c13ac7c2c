"""Implied starts: the position and speed that the first action of an actor requires.

An actor without a stated start begins at rest at a free position, unless its first action states
how it continues, or how it ends after a limited time: then the start makes this possible, with the
speed of the end and beside the actor of the end.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from osc2tx import ir
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Span
from osc2tx.lowering.behavior.time_expressions import is_range
from osc2tx_shared.classes import dataclass, replace

_REFERENCES = ("ahead_of", "behind")
_TIMES = ("start", "all", "end")
_SPEEDS = frozenset({"speed", "speed_range", "faster_than", "slower_than", "same_as", "factor"})
_PLACES = frozenset({"position", "along", "along_trajectory", "location"})


@dataclass(frozen=True, slots=True)
class FirstAction:
    """The first action of an actor.

    Attributes:
        node: The action.
        time: Its time limit; `None` without one, or if it is a range.
        is_later: It does not begin with the scenario.
        is_drawn: Another alternative of a `one_of` has another first action.
    """

    node: ir.Invoke
    time: ir.Expression | None
    is_later: bool
    is_drawn: bool = False

    @property
    def positions(self) -> list[ir.ModifierCall]:
        """Its positions along the road."""
        return [each for each in self.node.modifiers if each.name == "position"]

    @property
    def later(self) -> list[ir.ModifierCall]:
        """The same, but of its start."""
        return [each for each in self.positions if each.at != "start"]

    @property
    def paces(self) -> list[ir.ModifierCall]:
        """Modifiers that state a speed, or a position at each time, except `position`."""
        entries = catalogue().modifiers
        return [
            each
            for each in self.node.modifiers
            if each.name != "position" and each.name in entries and entries[each.name].paces
        ]

    def is_within(self, other: FirstAction) -> bool:
        """Whether it surely lasts no longer than another one that starts with it."""
        if self.time is other.time:
            return True
        if self.is_later or other.is_later or self.time is None or other.time is None:
            return False
        own, its = ir.constant(self.time), ir.constant(other.time)
        return own is not None and its is not None and own <= its

    @property
    def only_ends_beside(self) -> bool:
        """Whether its place is stated at the end alone, relative to another actor."""
        if any(each.name in _PLACES and each.at != "end" for each in self.node.modifiers):
            return False
        return len(self.positions) == 1 and len(_references(self.positions[0])) == 1


def implied_starts(first: Mapping[str, FirstAction]) -> Iterator[ir.Placement]:
    """Yield how actors have to begin for their first actions, as far as those leave it open."""
    for actor, action in first.items():
        modifiers = () if action.is_drawn else _implied_by(action, first)
        if modifiers:
            yield ir.Placement(
                actor=actor,
                modifiers=modifiers,
                span=action.node.span,
                is_implied=True,
                is_later=action.is_later,
            )


def _implied_by(
    action: FirstAction, first: Mapping[str, FirstAction]
) -> tuple[ir.ModifierCall, ...]:
    modifiers = action.node.modifiers
    entry = catalogue().actions.get(action.node.qualified_name)
    if entry is None or entry.ends != "open" or entry.paces:
        return ()
    if not all(each.name in catalogue().modifiers for each in modifiers):
        return ()  # actions of a dialect
    positions = action.positions
    if any(argument.parameter == "shape" for each in positions for argument in each.arguments):
        return ()
    found = [*_place_at_end(action, first), *_open_speed(action)]
    return tuple(each for each in found if not _changes(each) and not _is_rest(each))


def _place_at_end(action: FirstAction, first: Mapping[str, FirstAction]) -> list[ir.ModifierCall]:
    """Return the place relative to another actor from which an actor gets to the one at the end.

    Where both keep their speeds, that is by their difference nearer or farther away.
    """
    if action.time is None or not action.only_ends_beside:
        return []
    (end,) = action.positions
    (reference,) = _references(end)
    if not action.paces:
        return [_at_start(end)]
    other = first.get(reference.value.name) if isinstance(reference.value, ir.FieldRef) else None
    own, its = _steady_speed(action), None if other is None else _steady_speed(other)
    (amount, *_), is_ahead = end.arguments, reference.parameter == "ahead_of"
    if own is None or its is None or other is None or not action.is_within(other):
        return []
    if amount.parameter not in ("distance", "time") or is_range(amount.value):
        return []
    size = amount.value
    if amount.parameter == "time":
        size = _of("*", size, its if is_ahead else own, "length")
    gained = _of("*", _of("-", own, its, "speed"), action.time, "length")
    value = _of("-" if is_ahead else "+", size, gained, "length")
    first_argument = replace(amount, parameter="distance", value=value, is_positional=True)
    return [replace(_at_start(end), arguments=(first_argument, *end.arguments[1:]))]


def _steady_speed(action: FirstAction) -> ir.Expression | None:
    """Return the speed that an actor has during all of its first action, or may have."""
    match [(each.name, each.at) for each in action.paces]:
        case [("speed", "all" | "start")]:
            return _value(action.paces[0], "speed")
        case [("speed", "end")] if _begins_as_it_ends(action):
            return _value(action.paces[0], "speed")
    return None


def _begins_as_it_ends(action: FirstAction) -> bool:
    """Whether the speed at the end may be that at the start, in a limited time."""
    (end,) = action.paces
    given = {argument.parameter for argument in end.arguments}
    is_free = not action.later or (action.only_ends_beside and given == {"speed"})
    return action.time is not None and is_free and given <= _SPEEDS


def _open_speed(action: FirstAction) -> list[ir.ModifierCall]:
    """Return the speed that the first action requires at the start."""
    paces, time, later = action.paces, action.time, action.later
    match [(each.name, each.at) for each in paces]:
        case []:
            reference = _kept_reference(action.positions, has_end=time is not None)
            if reference is not None:
                return [_speed("same_as", reference.value, reference.span)]
            return _mean_speed(action.positions, time)
        case [("speed", "end")] if _begins_as_it_ends(action):
            return [_at_start(paces[0])]
        case [("speed", "end")] if time is not None:
            reference = _kept_reference(action.positions, has_end=True)
            if reference is not None:
                return [_speed("same_as", reference.value, reference.span)]
            return _steadily(action.positions, time, paces[0])
        case [("distance", "all")] if time is not None and not later:
            distance = _value(paces[0], "distance")
            if distance is not None:
                return [_speed("speed", _of("/", distance, time, "speed"), paces[0].span)]
        case [("speed", "end"), ("acceleration", "all")] | [
            ("acceleration", "all"),
            ("speed", "end"),
        ]:
            return [] if later or time is None else _speed_before(paces, time)
    return []


def _speed_before(paces: Sequence[ir.ModifierCall], time: ir.Expression) -> list[ir.ModifierCall]:
    """Return the speed from which a steady acceleration leads to the one at the end."""
    end, steady = sorted(paces, key=lambda each: each.name == "acceleration")
    speed, acceleration = _value(end, "speed"), _value(steady, "acceleration")
    if speed is None or acceleration is None or len(end.arguments) > 1:
        return []
    gained = _of("*", acceleration, time, "speed")
    return [_speed("speed", _of("-", speed, gained, "speed"), end.span)]


def _mean_speed(
    positions: Sequence[ir.ModifierCall], time: ir.Expression | None
) -> list[ir.ModifierCall]:
    """Return the speed that leads from one place to another in a given time."""
    places = {each.at: _value(each, "distance") for each in positions}
    first, last = places.get("start"), places.get("end")
    if len(positions) != 2 or first is None or last is None or time is None:
        return []
    way = _of("-", last, first, "length")
    return [_speed("speed", _of("/", way, time, "speed"), positions[-1].span)]


def _steadily(
    positions: Sequence[ir.ModifierCall], time: ir.Expression, end: ir.ModifierCall
) -> list[ir.ModifierCall]:
    """Return the speed from which one acceleration leads to a place and to a speed there."""
    mean, last = _mean_speed(positions, time), _value(end, "speed")
    if not mean or last is None:
        return []
    twice = _of("+", mean[0].arguments[0].value, mean[0].arguments[0].value, "speed")
    first = _of("-", twice, last, "speed")
    is_backwards = (ir.constant(first) or 0.0) < 0.0
    return [] if is_backwards else [_speed("speed", first, end.span)]


def _kept_reference(positions: Sequence[ir.ModifierCall], *, has_end: bool) -> ir.Argument | None:
    """Return the one actor relative to which places are kept, or met at an end that is known."""
    found = {at: [r for p in positions if p.at == at for r in _references(p)] for at in _TIMES}
    given = [found[at] for at in _TIMES if found[at]]
    first, *others = given or [[]]
    is_kept = found["all"] or len(given) == 2 or (has_end and found["end"])
    if not all(len(each) == 1 for each in given) or not is_kept:
        return None
    same = all(other[0].value.span.text == first[0].value.span.text for other in others)
    return first[0] if same else None


def _changes(modifier: ir.ModifierCall) -> bool:
    """Whether a value is known only during the run."""
    return any(ir.is_live(argument.value) for argument in modifier.arguments)


def _is_rest(modifier: ir.ModifierCall) -> bool:
    """Whether the speed is zero, which is the default of an actor."""
    speed = _value(modifier, "speed") if modifier.name == "speed" else None
    return speed is not None and ir.constant(speed) == 0.0


def _references(position: ir.ModifierCall) -> list[ir.Argument]:
    return [argument for argument in position.arguments if argument.parameter in _REFERENCES]


def _value(modifier: ir.ModifierCall, parameter: str) -> ir.Expression | None:
    """Return the only argument of a modifier, if it is this one and a single value."""
    given = [argument.value for argument in modifier.arguments if argument.parameter == parameter]
    if len(given) != 1 or len(modifier.arguments) != 1 or is_range(given[0]):
        return None
    return given[0]


def _of(operator: str, left: ir.Expression, right: ir.Expression, quantity: str) -> ir.Binary:
    type_ = ir.ValueType(ir.Kind.QUANTITY, quantity)
    return ir.Binary(span=left.span, type=type_, operator=operator, left=left, right=right)


def _speed(parameter: str, value: ir.Expression, span: Span) -> ir.ModifierCall:
    argument = ir.Argument(
        parameter=parameter, value=value, is_positional=parameter == "speed", span=span
    )
    return ir.ModifierCall(span=span, name="speed", arguments=(argument,), at="start")


def _at_start(modifier: ir.ModifierCall) -> ir.ModifierCall:
    return replace(modifier, at="start", comments=())
