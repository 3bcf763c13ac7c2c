"""The text of a scenario, as statements."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Container, Iterable, Iterator, Sequence
from dataclasses import field, replace
from itertools import pairwise
from textwrap import wrap
from typing import Literal, TypeAlias, cast

from osc2tx_shared.classes import dataclass

Kind: TypeAlias = Literal["serial", "parallel", "one_of"]
WIDTH = 92
INDENT = "    "
KEPT = WIDTH - len("keep()")
LINE = 100
"""Characters of a line."""
ROAD = "road"
"""The name of the map in scenarios."""


@dataclass
class Statement:
    """A member of `do`: an invocation, a directive, or a composition.

    Attributes:
        text: The statement; the word of a composition.
        label: Its name; `""`: it has none.
        modifiers: What stands below `with:`.
        members: Members of a composition; `None` for others.
        comments: Lines above it.
        length: Seconds that it takes, if that is known; `inf`: it ends with what is around it.
    """

    text: str
    label: str = ""
    modifiers: list[str] = field(default_factory=list)
    members: list[Statement] | None = None
    comments: list[str] = field(default_factory=list)
    length: float | None = None

    def lines(self, indent: int) -> Iterator[str]:
        """Yield its lines."""
        margin = INDENT * indent
        yield from (f"{margin}{line}" for line in comment_lines(self.comments, indent))
        head = f"{self.label}: {self.text}" if self.label else self.text
        if self.members is not None:
            yield f"{margin}{head}:"
            for member in self.members:
                yield from member.lines(indent + 1)
            if self.modifiers:
                yield f"{margin}with:"
        else:
            yield f"{margin}{head} with:" if self.modifiers else f"{margin}{head}"
        yield from (f"{margin}{INDENT}{modifier}" for modifier in self.modifiers)


def composed(kind: Kind, members: Sequence[Statement]) -> Statement:
    """Return members one after the other or side by side; a single one stands for itself."""
    flat: list[Statement] = []
    members = settled(members) if kind == "serial" else members
    for member in members:
        inner = member.members if member.text == kind else None
        if inner and not member.label and not member.modifiers:
            first = replace(inner[0], comments=[*member.comments, *inner[0].comments])
            flat += [first, *inner[1:]]
        else:
            flat.append(member)
    if kind == "serial":
        pairs = pairwise([*flat, Statement("")])
        flat = [each for each, following in pairs if not _goes_on_as(each, following)]
    if len(flat) == 1:
        return flat[0]
    return Statement(kind, members=flat, length=_length(kind, flat))


def _goes_on_as(statement: Statement, following: Statement) -> bool:
    """Whether an actor that keeps its speed for a time goes on with that, without an end."""
    is_plain = not (statement.label or statement.modifiers or statement.comments)
    is_held = following.text.endswith(".keep_speed()") and not following.label
    return is_plain and is_held and statement.text.startswith(f"{following.text[:-1]}duration: ")


def without_labels(statement: Statement, kept: Container[str]) -> Statement:
    """Return a statement without the labels that nothing refers to, with fewer compositions."""
    label = statement.label if statement.label in kept else ""
    if statement.members is None:
        return statement if label == statement.label else replace(statement, label=label)
    members = [without_labels(each, kept) for each in statement.members]
    found = composed(cast(Kind, statement.text), members)
    if not (label or statement.modifiers or statement.comments):
        return found
    if found.label or found.modifiers or found.comments:
        found = replace(statement, members=members)
    return replace(
        found,
        label=label,
        modifiers=statement.modifiers,
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
        elif member.text.startswith("wait ") and member.members is None:
            found[-1] = ended(last, member)
        else:
            break
    return found


def ended(statement: Statement, by: Statement) -> Statement:
    """Return something that never ends by itself up to what a wait waits for."""
    until = by.text.removeprefix("wait ")
    if statement.text.endswith(".keep_speed()") and until.startswith("elapsed("):
        duration = until.removeprefix("elapsed(")
        return replace(statement, text=f"{statement.text[:-1]}duration: {duration}", length=None)
    return replace(statement, modifiers=[*statement.modifiers, f"until {until}"], length=None)


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


def wait(text: str) -> Statement:
    """Return a wait."""
    return Statement(f"wait {text}")


def comment_lines(comments: Iterable[str], indent: int = 1) -> Iterator[str]:
    """Yield comments as lines of a text; one with a line that is too long is a paragraph."""
    width = LINE - len(INDENT) * indent - len("# ")
    for comment in comments:
        lines = [" ".join(line.split()) for line in comment.splitlines()]
        if any(len(line) > width for line in lines):
            lines = wrap(" ".join(lines), width, break_on_hyphens=False)
        yield from (f"# {line}" for line in lines if line)


@dataclass
class Declared:
    """A member of a scenario.

    Attributes:
        name: Its name; `""`: it has none.
        type: Its type; all of the line if it has no name.
        constraints: Conditions on it.
        value: Its value; `""`: none.
        comments: Lines above it, or one behind it.
        varied: What follows its name in the condition that says what it may be in runs.
    """

    name: str
    type: str
    constraints: list[str] = field(default_factory=list)
    value: str = ""
    comments: list[str] = field(default_factory=list)
    varied: str = ""

    @property
    def words(self) -> set[str]:
        """The names in what gives it and what is said about it."""
        return set(re.findall(r"\w+", " ".join((self.value, *self.constraints))))

    @property
    def lines(self) -> list[str]:
        """Its lines, with its comments: behind it if they fit there, else above it."""
        head, *constraints = self._declaration()
        told = list(comment_lines(self.comments))
        if len(told) == 1 and len(beside := f"{head}  {told[0]}") <= LINE - len(INDENT):
            return [beside, *constraints]
        return [*told, head, *constraints]

    def _declaration(self) -> list[str]:
        if not self.name:
            return [self.type]
        head = f"{self.name}: {self.type}" + (f" = {self.value}" if self.value else "")
        if self.value and len(head) > LINE - len(INDENT) and not self.value.endswith(")"):
            head = f"{self.name}: {self.type} = ({self.value})"  # lines break between brackets
        if not self.constraints:
            return [head]
        return [f"{head} with:", *(f"{INDENT}{each}" for each in keeps(self.constraints))]


def together(members: Sequence[Declared]) -> list[Declared]:
    """Return members, neighbours of which that differ only in their names as one."""
    found: list[Declared] = []
    for each in members:
        last = found[-1] if found else None
        is_plain = bool(each.name) and not (each.value or each.comments)
        joined = f"{last.name}, {each.name}" if last is not None else ""
        is_short = len(f"{INDENT}{joined}: {each.type} with:") <= LINE
        if last is not None and is_plain and is_short and last == replace(each, name=last.name):
            found[-1] = replace(each, name=joined)
        else:
            found.append(each)
    return found


def read_by(members: Sequence[Declared], words: Collection[str]) -> list[Declared]:
    """Return the members that some words name, or others of them that these read."""
    found, words = [], set(words)
    for each in reversed(members):
        if not each.name or each.name in words:
            words |= each.words
            found.append(each)
    return found[::-1]


@dataclass
class Program:
    """A file with a scenario.

    Attributes:
        name: The scenario.
        header: Comment at its beginning.
        imports: Libraries beside it, which import the standard one.
        base: The scenario that it inherits, of a file of that name; `""`: none.
        brought: Libraries that the file of that imports.
        members: Its actors and what else is there.
        parameters: Its parameters, and what is computed from them.
        body: What happens.
    """

    name: str
    header: list[str] = field(default_factory=list)
    imports: list[str] = field(default_factory=list)
    base: str = ""
    brought: Collection[str] = ()
    members: list[Declared] = field(default_factory=list)
    parameters: list[Declared] = field(default_factory=list)
    body: Statement | None = None

    @property
    def behavior(self) -> list[str]:
        """The lines of `do`."""
        if self.body is None:
            return []
        first, *others = self.body.lines(1)
        above = []
        while first.strip().startswith("#"):
            above.append(first)
            first, *others = others
        return [*above, "", f"{INDENT}do {first.strip()}", *others]

    @property
    def text(self) -> str:
        """The text of the file."""
        own = [each for each in self.imports if each not in self.brought]
        imported = [*([self.base] if self.base else []), *sorted(own)]
        lines = [
            *comment_lines(self.header, 0),
            *(f"import {name}" for name in imported or ["osc.standard.all"]),
            "",
        ]
        if self.members or self.body is not None:
            lines += [f"namespace null use {', '.join(('std', 'stdtypes', *self.imports))}", ""]
        inherits = f" inherits {self.base}" if self.base else ""
        is_empty = not (self.members or self.parameters or self.body)
        lines.append(f"scenario {self.name}{inherits}{'' if is_empty else ':'}")
        parts = [together(self.members), self.parameters]
        for part in filter(None, parts):
            lines += [""] if part is self.parameters and self.members else []
            lines += [f"{INDENT}{line}" for each in part for line in each.lines]
        return "\n".join([*lines, *self.behavior]) + "\n"


def keeps(constraints: Sequence[str]) -> list[str]:
    """Return constraints, several on a line where they fit."""
    found: list[str] = []
    for each in constraints:
        joined = f"{found[-1]} and {each}" if found else each
        if found and len(joined) <= KEPT and " or " not in joined:
            found[-1] = joined
        else:
            found.append(each)
    return [f"keep({each})" for each in found]
