"""What happens in a scenario as values: invocations, waits, events, and compositions of these.

Passes ask and change the values; their lines are written once, at the end.
"""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import field, replace
from textwrap import wrap
from typing import Literal, TypeAlias

from osc2tx_shared.classes import dataclass

Kind: TypeAlias = Literal["serial", "parallel", "one_of"]
INDENT = "    "
LINE = 100
"""Characters of a line."""
NARROW = 60
"""Characters of the lines of a narrow text."""


@dataclass(frozen=True, slots=True)
class Call:
    """An invocation of an action.

    Attributes:
        actor: The actor; `""`: that of the scenario in which it stands.
        action: The action.
        arguments: Their expressions, with their names; `""`: it is told by its position.
    """

    actor: str
    action: str
    arguments: tuple[tuple[str, str], ...] = ()

    @property
    def text(self) -> str:
        """The invocation."""
        told = [f"{name}: {value}" if name else value for name, value in self.arguments]
        owner = f"{self.actor}." if self.actor else ""
        return f"{owner}{self.action}({', '.join(told)})"

    def get(self, name: str) -> str | None:
        """Return an argument."""
        return dict(self.arguments).get(name)


def call(actor: str, action: str, *values: str, **named: str) -> Call:
    """Return an invocation with some arguments."""
    return Call(actor, action, (*(("", each) for each in values), *named.items()))


@dataclass(frozen=True, slots=True)
class When:
    """What is waited for, or ends something.

    Attributes:
        text: Its expression.
        event: The event that it is, of the scenario or of a statement, such as `cut_in.end`.
        time: The time since it began that it is.
        names: The events and statements that it refers to.
    """

    text: str
    event: str = ""
    time: str = ""
    names: frozenset[str] = frozenset()


def elapsed(time: str) -> When:
    """Return the end of a time."""
    return When(f"elapsed({time})", time=time)


def happens(event: str, condition: str = "") -> When:
    """Return an event, if a condition is met then."""
    names = frozenset((event.partition(".")[0],))
    if condition:
        return When(f"@{event} if {condition}", names=names)
    return When(f"@{event}", event=event, names=names)


@dataclass(frozen=True, slots=True)
class Emit:
    """An event that is emitted."""

    event: str


@dataclass
class Statement:
    """A member of `do`.

    Attributes:
        does: An invocation, an event, what is waited for, or the word of a composition.
        label: Its name; `""`: it has none.
        modifiers: What stands below `with:`.
        until: What ends it, there as well.
        members: Members of a composition; none of others.
        comments: Lines above it.
        length: Seconds that it takes, if that is known; `inf`: it ends with what is around it.
        duration: The time that a composition lasts; `""`: that is not said.
    """

    does: Call | Emit | When | Kind
    label: str = ""
    modifiers: Sequence[str] = ()
    until: list[When] = field(default_factory=list)
    members: Sequence[Statement] = ()
    comments: list[str] = field(default_factory=list)
    length: float | None = None
    duration: str = ""

    @property
    def text(self) -> str:
        """The first line of it, without its label."""
        match self.does:
            case Call():
                return self.does.text
            case Emit():
                return f"emit {self.does.event}"
            case When():
                return f"wait {self.does.text}"
            case kind:
                return f"{kind}(duration: {self.duration})" if self.duration else kind

    @property
    def is_composed(self) -> bool:
        """Whether it is a composition."""
        return isinstance(self.does, str)

    @property
    def is_qualified(self) -> bool:
        """Whether something stands below `with:`, or it lasts a time."""
        return bool(self.modifiers or self.until or self.duration)

    @property
    def is_plain(self) -> bool:
        """Whether it has no name, and nothing stands below `with:`."""
        return not (self.label or self.is_qualified)

    @property
    def is_bare(self) -> bool:
        """Whether it is plain, and has no comments."""
        return self.is_plain and not self.comments

    @property
    def calls(self) -> Iterator[Call]:
        """The invocations in it."""
        if isinstance(self.does, Call):
            yield self.does
        for each in self.members:
            yield from each.calls

    @property
    def names(self) -> frozenset[str]:
        """The events and statements to which it refers."""
        own = [self.does] if isinstance(self.does, When) else []
        told = [each.names for each in (*own, *self.until)]
        return frozenset().union(*told, *(each.names for each in self.members))

    def lines(self, indent: int) -> Iterator[str]:
        """Yield its lines."""
        margin = INDENT * indent
        yield from (f"{margin}{line}" for line in comment_lines(self.comments, indent))
        head = f"{self.label}: {self.text}" if self.label else self.text
        if self.is_composed:
            yield f"{margin}{head}:"
            for member in self.members:
                yield from member.lines(indent + 1)
            if self.modifiers or self.until:
                yield f"{margin}with:"
        else:
            yield f"{margin}{head} with:" if self.is_qualified else f"{margin}{head}"
        qualified = [*self.modifiers, *(f"until {each.text}" for each in self.until)]
        yield from (f"{margin}{INDENT}{each}" for each in qualified)


def wait(when: When) -> Statement:
    """Return a wait."""
    return Statement(when)


def composed(kind: Kind, members: Sequence[Statement]) -> Statement:
    """Return members one after the other or side by side; a single one stands for itself."""
    flat: list[Statement] = []
    members = settled(members) if kind == "serial" else members
    for member in members:
        inner = member.members if member.does == kind else ()
        if inner and member.is_plain:
            first = replace(inner[0], comments=[*member.comments, *inner[0].comments])
            flat += [first, *inner[1:]]
        else:
            flat.append(member)
    if kind == "serial":
        later = [*flat[1:], None]
        pairs = zip(flat, later, strict=False)
        flat = [each for each, following in pairs if not _goes_on_as(each, following)]
    if len(flat) == 1:
        return flat[0]
    return Statement(kind, members=flat, length=_length(kind, flat))


def keeps_speed(statement: Statement) -> bool:
    """Whether an actor holds its speed until something else ends that."""
    does = statement.does
    return isinstance(does, Call) and (does.action, does.arguments) == ("keep_speed", ())


def _goes_on_as(statement: Statement, following: Statement | None) -> bool:
    """Whether an actor that keeps its speed for a time goes on with that, without an end."""
    if not statement.is_bare or following is None:
        return False
    if following.label or not keeps_speed(following) or not isinstance(following.does, Call):
        return False
    does = statement.does
    if not isinstance(does, Call) or [name for name, _ in does.arguments] != ["duration"]:
        return False
    return replace(does, arguments=()) == following.does


def without_labels(statement: Statement, kept: Container[str]) -> Statement:
    """Return a statement without the labels that nothing refers to, with fewer compositions."""
    label = statement.label if statement.label in kept else ""
    if not isinstance(statement.does, str):
        return statement if label == statement.label else replace(statement, label=label)
    members = [without_labels(each, kept) for each in statement.members]
    found = composed(statement.does, members)
    if not (label or statement.is_qualified or statement.comments):
        return found
    if not found.is_bare:
        found = replace(statement, members=members)
    return replace(
        found,
        label=label,
        modifiers=statement.modifiers,
        until=statement.until,
        comments=statement.comments,
        length=statement.length,
    )


def settled(members: Sequence[Statement]) -> list[Statement]:
    """Return members of a `serial` in which what never ends by itself lasts up to the next wait.

    What comes behind something that never ends, and waits for nothing, never begins.
    """
    found: list[Statement] = []
    for member in members:
        last = found[-1] if found else None
        if last is None or last.length != math.inf:
            found.append(member)
        elif isinstance(member.does, When):
            found[-1] = ended(last, member.does)
        else:
            break
    return found


def ended(statement: Statement, by: When) -> Statement:
    """Return something that never ends by itself up to an end."""
    if by.time and keeps_speed(statement) and isinstance(statement.does, Call):
        timed = replace(statement.does, arguments=(("duration", by.time),))
        return replace(statement, does=timed, length=None)
    return replace(statement, until=[*statement.until, by], length=None)


def _length(kind: Kind, members: Sequence[Statement]) -> float | None:
    """Return how long members take; what has no end of its own lasts with what is beside it."""
    lengths = [member.length for member in members]
    if kind == "serial":
        known = [length for length in lengths if length is not None]
        if lengths[-1:] == [math.inf]:
            return math.inf
        return sum(known) if len(known) == len(lengths) else None
    bounded = [length for length in lengths if length != math.inf]
    known = [length for length in bounded if length is not None]
    if not bounded:
        return math.inf if lengths else 0.0
    return max(known) if len(known) == len(bounded) else None


_SECONDS = re.compile(r"(\d+\.?\d*)s")


def seconds(statements: Iterable[Statement]) -> float | None:
    """Return how long statements take one after the other, if numbers say it."""
    times = [_seconds_of(each) for each in statements]
    return None if None in times else sum(filter(None, times))


def _seconds_of(statement: Statement) -> float | None:
    if statement.is_composed:
        is_plain = statement.does == "serial" and not statement.is_qualified
        return seconds(statement.members) if is_plain else None
    does, said = statement.does, None
    if isinstance(does, When):
        said = does.time
    elif isinstance(does, Call):
        said = does.get("duration")
        if does.action == "replay_trajectory" and not statement.is_qualified:
            return statement.length
    found = _SECONDS.fullmatch(said or "")
    if statement.is_qualified or found is None:
        return statement.length if statement.length == 0.0 else None
    return float(found[1])


def comment_lines(comments: Iterable[str], indent: int = 1) -> Iterator[str]:
    """Yield comments as lines of a text; one with a line that is too long is a paragraph."""
    width = LINE - len(INDENT) * indent - len("# ")
    for comment in comments:
        lines = [" ".join(line.split()) for line in comment.splitlines()]
        if any(len(line) > width for line in lines):
            lines = [" ".join(lines)]
        for line in _unbroken(lines):
            yield from (f"# {part}" for part in wrap(line, width, break_on_hyphens=False))


def _unbroken(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines, with those as one that only break because a text is narrow."""
    before = ""
    for line in lines:
        if len(before) >= NARROW and line[:1].islower():
            before = f"{before} {line}"
        else:
            yield before
            before = line
    yield before
