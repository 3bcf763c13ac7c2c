"""The file of a scenario: its members, its parameters, what happens."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import field, replace

from osc2tx.importing.statements import INDENT, LINE, Statement, comment_lines
from osc2tx_shared.classes import dataclass

WIDTH = 92
KEPT = WIDTH - len("keep()")
ROAD = "road"
"""The name of the map in scenarios."""
EVENT = "event"


@dataclass
class Declared:
    """A member of a scenario.

    Attributes:
        name: Its name; `""`: it has none.
        type: Its type; all of the line if it has no name; `event`: it is one.
        constraints: Conditions on it.
        value: Its value, or what an event is; `""`: none.
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
        begin, end = [head, *constraints][: len(told)], [head, *constraints][len(told) :]
        beside = [f"{line}  {comment}" for line, comment in zip(begin, told, strict=False)]
        if len(told) <= len(begin) and all(len(each) <= LINE - len(INDENT) for each in beside):
            return [*beside, *end]
        return [*told, head, *constraints]

    def _declaration(self) -> list[str]:
        if not self.name:
            return [self.type]
        if self.type == EVENT:
            return [f"event {self.name} is {self.value}" if self.value else f"event {self.name}"]
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
        remark: A directive to the compiler above the scenario.
    """

    name: str
    header: list[str] = field(default_factory=list)
    imports: list[str] = field(default_factory=list)
    base: str = ""
    brought: Collection[str] = ()
    members: list[Declared] = field(default_factory=list)
    parameters: list[Declared] = field(default_factory=list)
    body: Statement | None = None
    remark: str = ""

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
        ]
        if self.members or self.body is not None:
            lines.append(f"namespace null use {', '.join(('std', 'stdtypes', *self.imports))}")
        inherits = f" inherits {self.base}" if self.base else ""
        is_empty = not (self.members or self.parameters or self.body)
        lines += ["", self.remark] if self.remark else [""]
        lines.append(f"scenario {self.name}{inherits}{'' if is_empty else ':'}")
        parts = [together(self.members), self.parameters]
        for part in filter(None, parts):
            lines += [""] if part is self.parameters and self.members else []
            lines += [f"{INDENT}{line}" for each in part for line in each.lines]
        return "\n".join([*lines, *self.behavior]) + "\n"


def keeps(constraints: Sequence[str]) -> list[str]:
    """Return constraints, several on a line where they fit; a choice is on a line of its own."""
    found: list[str] = []
    for each in constraints:
        joined = f"{found[-1]} and {each}" if found else each
        is_plain = " or " not in joined and " in [" not in joined
        if found and len(joined) <= KEPT and is_plain:
            found[-1] = joined
        else:
            found.append(each)
    return [f"keep({each})" for each in found]
