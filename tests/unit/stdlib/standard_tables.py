"""The standard library as names, types and numbers of the standard: `standard/VERSION.json`.

The files hold facts of chapter 8 and nothing of its text: declarations, members in positional
order, defaults, values of enums, factors of units as printed. Corrections go there by hand, with
the section of the standard in the commit.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass, field
from pathlib import Path

FOLDER = Path(__file__).parent / "standard"

_FIELD = re.compile(r"(var )?(\w+): (.*?)(?: = (.*))?")


@dataclass(frozen=True, slots=True)
class Parameter:
    """A field, parameter of a behavior, or parameter of a method."""

    name: str
    type: str
    default: str | None = None
    is_variable: bool = False


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit with its printed factor and offset."""

    type: str
    factor: float
    offset: float


@dataclass(frozen=True, slots=True)
class Method:
    """The signature of a method."""

    parameters: tuple[Parameter, ...]
    result: str


@dataclass(frozen=True, slots=True)
class Compound:
    """A struct, actor, action or modifier; the target of a modifier counts as its base."""

    base: str | None
    fields: tuple[Parameter, ...]


@dataclass(slots=True)
class Tables:
    """The library of one version; `basic` names the structs of the namespace `stdtypes`."""

    types: dict[str, dict[str, int]] = field(default_factory=dict)
    units: dict[str, Unit] = field(default_factory=dict)
    enums: dict[str, list[tuple[str, int]]] = field(default_factory=dict)
    structs: dict[str, Compound] = field(default_factory=dict)
    actors: dict[str, Compound] = field(default_factory=dict)
    actions: dict[str, Compound] = field(default_factory=dict)
    modifiers: dict[str, Compound] = field(default_factory=dict)
    methods: dict[str, Method] = field(default_factory=dict)
    basic: list[str] = field(default_factory=list)


def read_tables(standard: str) -> Tables:
    """Return the library of a version."""
    rows = json.loads((FOLDER / f"{standard}.json").read_text(encoding="utf-8"))
    return Tables(
        types={name: dict(map(_power, text.split())) for name, text in rows["types"].items()},
        units={name: Unit(*row) for name, row in rows["units"].items()},
        enums={name: list(map(_member, text.split())) for name, text in rows["enums"].items()},
        methods={name: Method(_fields(row[1:]), row[0]) for name, row in rows["methods"].items()},
        basic=rows["basic"],
        **{
            kind: {name: Compound(row[0], _fields(row[1:])) for name, row in rows[kind].items()}
            for kind in ("structs", "actors", "actions", "modifiers")
        },
    )


def _power(text: str) -> tuple[str, int]:
    base, _, power = text.partition("^")
    return base, int(power)


def _member(text: str) -> tuple[str, int]:
    name, _, value = text.partition("=")
    return name, int(value)


def _fields(texts: list[str]) -> tuple[Parameter, ...]:
    return tuple(map(_field, texts))


def _field(text: str) -> Parameter:
    match = _FIELD.fullmatch(text)
    assert match, text
    return Parameter(match[2], match[3], match[4], match[1] is not None)
