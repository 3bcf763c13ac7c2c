"""Which modifiers of one action go together.

The arguments of a modifier decide its *sort*: a `speed` with `direction: lateral` is another
quantity than one along the road. Modifiers of the same *topic* exclude each other.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Generic, Literal, Protocol, TypeVar

from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules.arguments import Given, Rule, none_of, violations

LATERAL_SPEED = "lateral speed"

RATES = ("speed", "keep_speed", "acceleration")
"""Modifiers that may rule the motion while a place is only met at its end."""

CONTRADICTIONS = ((("movement_mode", "monotonous"), ("option", "prefer_non_physical")),)
"""Arguments that contradict each other in the modifiers of one action."""

RANGES = ("speed_range", "acceleration_range", "distance_range", "time_range", "angle_range")
"""Parameters for the admissible interval of a quantity (§8.9.1.4)."""

REFERENCES = ("faster_than", "slower_than", "same_as", "factor")
"""Parameters that relate a speed to that of another actor."""

STARTING = (none_of("shape", when=["at"], values=["start"]),)
"""What says nothing about a start, in any modifier."""


@dataclass(frozen=True, slots=True)
class Sort:
    """The sort of a modifier with some arguments.

    Attributes:
        name: Of the sort.
        given: Parameters of which one is given,
        value: with this value; empty: with any.
        lacks: None of these is given.
        excludes: Topics and modifiers for which it leaves no room.
    """

    name: str
    given: tuple[str, ...] = ()
    value: str = ""
    lacks: tuple[str, ...] = ()
    excludes: tuple[str, ...] = ()

    def has(self, given: Given) -> bool:
        """Whether a modifier with these arguments is of the sort."""
        if any(name in given for name in self.lacks):
            return False
        words = [given.word(name) for name in self.given if name in given]
        return not self.given or any(not self.value or word == self.value for word in words)


@dataclass(frozen=True, slots=True)
class ModifierRules:
    """What one modifier does to others in the same action.

    Attributes:
        topics: Its quantities; an action accepts one modifier of each topic.
        excludes: Topics and modifiers that it excludes besides.
        sorts: Its sorts with some arguments.
        starts: Whether `at: start` makes it a condition on the start alone.
        no_start: Why it has no condition on the start; empty if it has.
        lanes_only: Whether it is only for actors that follow lanes, but for the start.
        while_moving: Rules of its arguments in an action, unlike at a start.
    """

    topics: tuple[str, ...] = ()
    excludes: tuple[str, ...] = ()
    sorts: tuple[Sort, ...] = ()
    starts: bool = False
    no_start: str = ""
    lanes_only: bool = False
    while_moving: tuple[Rule, ...] = ()


class Call(Protocol):
    """A modifier of an action."""

    @property
    def name(self) -> str:
        """Name of the modifier."""

    @property
    def at(self) -> str:
        """`start`, `end` or `all`."""

    @property
    def given(self) -> Given:
        """Its arguments, `at` among them."""

    @property
    def shaped(self) -> bool:
        """Whether it surely says how its value is reached."""


CallT = TypeVar("CallT", bound=Call)


@dataclass(frozen=True, slots=True)
class Timing:
    """Facts about the length of an action.

    Attributes:
        has_duration: Whether it has a duration of its own.
        end_is_known: Whether it is known in advance when it ends; None if only the run tells.
        seconds: Its duration, if it is a known number.
    """

    has_duration: bool
    end_is_known: bool | None
    seconds: float | None = None


@dataclass(frozen=True, slots=True)
class Clash(Generic[CallT]):
    """What does not go together.

    Attributes:
        kind: `same thing`: two modifiers, of which one may stay; `twice`; `contradiction` of two
            arguments; `no start`: it has no condition on one; `rule`: a rule of its arguments.
        calls: The modifiers, the offending one last.
        text: Description of the error, but for `same thing` and `twice`.
        parameter: The invalid argument, if it is one.
    """

    kind: Literal["same thing", "twice", "contradiction", "no start", "rule"]
    calls: tuple[CallT, ...]
    text: str = ""
    parameter: str | None = None


def sorts_of(call: Call, known: Mapping[str, ModifierRules]) -> Mapping[str, Collection[str]]:
    """Return the name of a modifier, or of its sort, and its sorts.

    Each comes with the topics and modifiers that it excludes.
    """
    rules = known.get(call.name, ModifierRules())
    sorts = {sort.name: sort.excludes for sort in rules.sorts if sort.has(call.given)}
    return sorts if LATERAL_SPEED in sorts else {call.name: rules.excludes, **sorts}


def is_across(call: Call, known: Mapping[str, ModifierRules]) -> bool:
    """Whether it is a speed across the lane, which leaves room for everything along it."""
    return LATERAL_SPEED in sorts_of(call, known)


def is_admissible_range(
    call: Call, calls: Collection[Call], known: Mapping[str, ModifierRules]
) -> bool:
    """Whether a modifier only bounds a quantity for which another one states the end.

    `speed(speed_range: [15mps..20mps])` beside `speed(20mps, at: end)`: the second one determines
    the motion, the first one has to hold on the way (§8.9.1.4).
    """
    if call.at != "all" or "shape" in call.given or not _is_range(call):
        return False
    across = is_across(call, known)
    return any(
        other.name == call.name and other.at == "end" and is_across(other, known) == across
        for other in calls
    )


def clashes(
    calls: Sequence[CallT], known: Mapping[str, ModifierRules], timing: Timing
) -> Iterator[Clash[CallT]]:
    """Yield what does not go together in the modifiers of an action.

    Args:
        calls: The modifiers, in their order.
        known: Rules of all modifiers by name.
        timing: Facts about the length of the action.
    """
    action = _Action(calls, known, timing)
    yield from action.same_things()
    yield from action.twice()
    yield from action.starts()
    yield from action.contradictions()
    for call in action.lasting:
        for broken in violations(f"`{call.name}`", known[call.name].while_moving, call.given):
            yield Clash("rule", (call,), broken.text, broken.parameter)


class _Action(Generic[CallT]):
    def __init__(
        self, calls: Sequence[CallT], known: Mapping[str, ModifierRules], timing: Timing
    ) -> None:
        self.calls = [
            call
            for call in calls
            if call.name in known and not is_admissible_range(call, calls, known)
        ]
        self.known = known
        self.timing = timing
        self.lasting = [call for call in self.calls if not self._is_start(call)]

    def same_things(self) -> Iterator[Clash[CallT]]:
        """Yield pairs that constrain the same motion, each once."""
        seen: set[frozenset[int]] = set()
        for pair in self._same_things():
            identity = frozenset(map(id, pair))
            if identity not in seen:
                yield Clash("same thing", pair)
            seen.add(identity)

    def _same_things(self) -> Iterator[tuple[CallT, CallT]]:
        for call in self.lasting:
            yield from self._excluded_by(call)
        yield from self._ways()
        topics = dict.fromkeys(t for call in self.lasting for t in self.known[call.name].topics)
        for topic in topics:
            first, *others = self._about((topic,))
            yield from ((first, other) for other in others if other.name != first.name)

    def _excluded_by(self, call: CallT) -> Iterator[tuple[CallT, CallT]]:
        """Yield the modifiers for which one leaves no room, though those go together."""
        sorts = sorts_of(call, self.known)
        for sort in sorted(sorts):
            for other in self._about(sorts[sort]):
                arrives = sort in RATES and other.name == "position"
                if other is call or (arrives and self._has_room_for_place()):
                    continue
                if not is_across(other, self.known):
                    yield call, other

    def _ways(self) -> Iterator[tuple[CallT, CallT]]:
        """Yield rates beside a distance to cover, where the time for it is known."""
        if not (self.timing.has_duration or self.timing.end_is_known):
            return
        rates = self._named("acceleration")
        if not self._arrives():
            rates = [*self._speeds(), *rates]
        ways = self._named("distance")
        yield from ((r, way) for r in rates for way in ways if not self._agree(r, way))

    def _agree(self, rate: CallT, way: CallT) -> bool:
        """Whether a speed that is kept covers the distance in the duration (§8.9.4, §8.9.13)."""
        speed, distance = _plain(rate, "speed"), _plain(way, "distance")
        if speed is None or distance is None or self.timing.seconds is None:
            return False
        return rate.name == "speed" and abs(speed * self.timing.seconds - distance) <= 1e-6

    def _has_room_for_place(self) -> bool:
        """Whether there can be a place beside speeds and accelerations: at the end, or in a range.

        The range holds all the time, relative to another actor; the speeds decide the motion.
        """
        places = self._named("position")
        rates = [*self._speeds(), *self._named("acceleration")]
        if any("shape" in each.given or not _leaves_room(each) for each in places):
            return False
        return self._arrives() or all(rate.at == "all" for rate in rates)

    def _arrives(self) -> bool:
        """Whether a place and a speed at the end are asked for, which is known or at that place."""
        places = self._named("position")
        on_road = not any("ahead_of" in each.given or "behind" in each.given for each in places)
        return (
            (self.timing.end_is_known is not False or on_road)
            and all(speed.at == "end" and not speed.shaped for speed in self._speeds())
            and all(place.at == "end" for place in places)
        )

    def twice(self) -> Iterator[Clash[CallT]]:
        """Yield modifiers that stand there twice, both for the start or both for later."""
        found: dict[tuple[str, bool, bool], CallT] = {}
        for call in self.calls:
            subject = call.name, is_across(call, self.known), self._is_start(call)
            if subject in found:
                yield Clash("twice", (found[subject], call))
            found.setdefault(subject, call)

    def starts(self) -> Iterator[Clash[CallT]]:
        """Yield modifiers with `at: start` that have no condition on a start."""
        for call in self.calls:
            if call.at != "start":
                continue
            reason = self.known[call.name].no_start
            if reason:
                yield Clash("no start", (call,), reason)
                continue
            for broken in violations(f"`{call.name}`", STARTING, call.given):
                yield Clash("rule", (call,), broken.text, broken.parameter)

    def contradictions(self) -> Iterator[Clash[CallT]]:
        """Yield arguments that contradict each other."""
        for (one, value), (other, rival) in CONTRADICTIONS:
            first = [c for c in self.calls if one in c.given and c.given.word(one) == value]
            second = [c for c in self.calls if other in c.given and c.given.word(other) == rival]
            if first and second:
                text = f"`{value}` and `{rival}` exclude each other"
                yield Clash("contradiction", (first[-1], second[-1]), text, other)

    # --- modifiers -------------------------------------------------------------------------------

    def _is_start(self, call: CallT) -> bool:
        return call.at == "start" and self.known[call.name].starts

    def _about(self, what: Collection[str]) -> list[CallT]:
        """Return the lasting modifiers that have one of these names, or mention such a topic."""
        return [
            call
            for call in self.lasting
            if call.name in what or any(topic in what for topic in self.known[call.name].topics)
        ]

    def _named(self, name: str) -> list[CallT]:
        return [call for call in self.lasting if call.name == name]

    def _speeds(self) -> list[CallT]:
        """Return the speeds along the road."""
        return [call for call in self._named("speed") if not is_across(call, self.known)]


def _plain(call: Call, name: str) -> float | None:
    """Return the one number that a modifier states for the whole action."""
    others = any(each in call.given for each in (*RANGES, *REFERENCES, "shape", "direction"))
    bounds = call.given.bounds(name) if name in call.given else None
    is_plain = call.at == "all" and not others and bounds is not None and bounds[0] == bounds[1]
    return bounds[0] if bounds is not None and is_plain else None


def _is_range(call: Call) -> bool:
    """Whether a modifier states an interval instead of a value."""
    return any(name in call.given for name in RANGES)


def _leaves_room(place: Call) -> bool:
    """Whether a place does not say how to move all the time."""
    given = place.given
    is_relative = "ahead_of" in given or "behind" in given
    return place.at == "end" or (place.at == "all" and _is_range(place) and is_relative)
