"""Reads the tables of spec/domain.md: the standard library as the standard's text has it.

The tables cover 2.1 and 2.2 at once; `[2.2]` marks what is new in 2.2. `read_tables` returns what
belongs to one version.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

WITHOUT_COMMON = frozenset(
    {"keep_position", "keep_speed", "keep_lane", "physical_movement", "avoid_collisions"}
)
MOVEMENT_TARGET = "movable_object.action_for_movable_object"
BASE_ACTIONS = {  # actor association and base of the actions, from the head of section 8
    "movable_object.action_for_movable_object": "osc_actor.osc_action",
    "vehicle.action_for_vehicle": "movable_object.action_for_movable_object",
    "person.action_for_person": "movable_object.action_for_movable_object",
    "environment.action_for_environment": "osc_actor.osc_action",
}
PARENTS = {
    "movable_object": "movable_object.action_for_movable_object",
    "vehicle": "vehicle.action_for_vehicle",
    "person": "person.action_for_person",
    "environment": "environment.action_for_environment",
    "traffic_light_controller": "osc_actor.osc_action",
}
# The text of section 8 states them beside the tables.
ORDER_OF_2_1 = {
    "movable_object.change_position": (
        "target_xyz",
        "target_st",
        "target_odr",
        "interpolation",
        "on_road_network",
    )
}


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
    """The library of one version."""

    types: dict[str, dict[str, int]] = field(default_factory=dict)
    units: dict[str, Unit] = field(default_factory=dict)
    enums: dict[str, list[tuple[str, int]]] = field(default_factory=dict)
    structs: dict[str, Compound] = field(default_factory=dict)
    actors: dict[str, Compound] = field(default_factory=dict)
    actions: dict[str, Compound] = field(default_factory=dict)
    modifiers: dict[str, Compound] = field(default_factory=dict)
    methods: dict[str, Method] = field(default_factory=dict)


def read_tables(page: Path, standard: str) -> Tables:
    """Return the library of a version."""
    text = page.read_text(encoding="utf-8")
    tables = Tables()
    _read_units(tables, _section(text, "## 2 Physical", "| Printed factor"))
    _read_enums(tables, _section(text, "## 5 Enums", "`parallel`"), standard)
    _read_basic_structs(tables, _section(text, "## 3 Basic", "`norm()` is"))
    _read_compounds(tables, _section(text, "## 6 Structs", "### Shapes"))
    _read_shapes(tables, _section(text, "### Shapes", "Time in `compute`"))
    _read_behavioral_model(tables, _section(text, "### Behavioural model", "§8.6 also"))
    _read_compounds(tables, _section(text, "## 7 Actors", "## 8 Actions"))
    _read_actions(tables, _section(text, "## 8 Actions", "## 9 Modifiers"), standard)
    _read_movement_modifiers(tables, _section(text, "### 9.2", "### 9.3"), standard)
    _read_actor_modifiers(tables, _section(text, "### 9.3", "### 9.5"))
    _read_methods(tables, _section(text, "## 10 Methods", "There are no methods"))
    if standard >= "2.2":
        _read_string_methods(tables, _section(text, "## 4 String", "Namespace: **"))
    return tables


def _section(text: str, start: str, end: str) -> str:
    begin = text.index(start)
    return text[begin : text.index(end, begin)]


def _rows(text: str) -> Iterator[list[str]]:
    """Yield the cells of each row of each table below its head."""
    lines = text.split("\n")
    for above, line in zip(["", *lines], lines, strict=False):
        is_head = not above.startswith("|")
        if line.startswith("|") and not is_head and not set(line) <= set("|- "):
            yield [cell.strip() for cell in line.strip("|").split("|")]


def _codes(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


def _read_units(tables: Tables, text: str) -> None:
    for names, exponents, units in _rows(text):
        (name,) = _codes(names)
        tables.types[name] = {
            base: int(power) for base, power in re.findall(r"(\w+)\^(-?\d)", exponents)
        }
        for group in units.split(";"):
            factor, *offset = re.sub(r"`[^`]+`,?|offset", "", group).split()
            for unit in _codes(group):
                assert unit not in tables.units
                tables.units[unit] = Unit(name, float(factor), float(offset[0]) if offset else 0.0)


def _read_enums(tables: Tables, text: str, standard: str) -> None:
    for names, _, members, notes in _rows(text):
        (name,) = _codes(names)
        old = None if standard >= "2.2" else _old_members(notes)
        found = []
        for part in re.split(r", (?=`)", members):
            match = re.match(r"`(\w+)`=(?:(\d+)|`\w+`\((\d+)\))$", part)
            assert match, part
            if old is None or match[1] in old:
                found.append((match[1], int(match[2] or match[3])))
        tables.enums[name] = found


def _old_members(notes: str) -> list[str] | None:
    """Return the members of 2.1 if the remark on an enum lists them."""
    listed = re.search(r"2\.1(?: names)?(?: \([^)]*\))?: ([\w, ]+?) \(", notes)
    return listed[1].split(", ") if listed else None


def _grouped(cell: str) -> Iterator[tuple[str, str, str | None, str]]:
    """Yield name, type, default and version of parameters: "`a`, `b`: length = 0m [2.2]; ..."."""
    cell = re.sub(r"\(default (\w+)\)", r"= \1", cell).replace(" [2.1]", "")
    cell = re.sub(r" \([^)]*\)", "", cell)
    names, default, version = r"((?:`\w+`(?:, )?)+)", r"(?: = ([\w.]+))?", r"(?: \[(2\.2)\])?"
    for match in re.finditer(rf"{names}: ?([\w ]+?){default}{version}(?=[;,]|$)", cell):
        for name in _codes(match[1]):
            yield name, match[2], match[3], match[4] or ""


def _read_basic_structs(tables: Tables, text: str) -> None:
    for names, base, fields, methods in _rows(text):
        (name,) = _codes(names)
        tables.structs[name] = Compound(
            next(iter(_codes(base)), None),
            tuple(Parameter(n, t) for n, t, _, _ in _grouped(fields)),
        )
        for signature in _codes(methods):
            _add_method(tables, f"{name}.{signature}")


def _read_compounds(tables: Tables, text: str) -> None:
    heads = list(re.finditer(r"\*\*(struct|actor) `(\w+)`\*\*(?: inherits `(\w+)`)?", text))
    for head, following in zip(heads, [*heads[1:], None], strict=True):
        body = text[head.end() : following.start() if following else None]
        fields = tuple(
            Parameter(_codes(row[0])[0].removeprefix("var "), row[1], None, "`var " in row[0])
            for row in _rows(body)
        )
        place = tables.structs if head[1] == "struct" else tables.actors
        assert head[2] not in place
        place[head[2]] = Compound(head[3], fields)


def _read_shapes(tables: Tables, text: str) -> None:
    for names, base, members in _rows(text):
        (name,) = _codes(names)
        fields = tuple(Parameter(n, t) for n, t, _, _ in _grouped(members))
        tables.structs[name] = Compound(next(iter(_codes(base)), None), fields)
        for code in _codes(members):
            if "(" in code:
                _add_method(tables, f"{name}.{code}")


def _read_behavioral_model(tables: Tables, text: str) -> None:
    for names, members in _rows(text):
        (name,) = _codes(names)
        fields = tuple(Parameter(n, t) for n, t, _, _ in _grouped(members))
        tables.structs[name] = Compound(None, fields)


def _read_actions(tables: Tables, text: str, standard: str) -> None:
    for name, base in BASE_ACTIONS.items():
        tables.actions[name] = Compound(base, ())
    for row in _rows(text):
        (name,) = _codes(row[0])
        parameters = []
        for part in row[2].split("; ") if row[2] != "-" else ():
            match = re.match(r"`(\w+)`: ([\w ]+?)(?: \(opt\))?(?: = (.*))?$", part)
            assert match, part
            default = "actor" if match[3] == "the actor" else match[3]
            parameters.append(Parameter(match[1], match[2], default))
        # What is new in 2.2 stands in the remark: "`offset_range`: range of length [2.2]".
        for new, type_ in re.findall(r"`(\w+)`: ([\w ]+) \[2\.2\]", row[3]):
            if standard >= "2.2":
                parameters.append(Parameter(new, type_))
        if standard < "2.2" and name in ORDER_OF_2_1:
            known = {parameter.name: parameter for parameter in parameters}
            parameters = [known[wanted] for wanted in ORDER_OF_2_1[name]]
        assert name not in tables.actions
        tables.actions[name] = Compound(PARENTS.get(name.split(".")[0]), tuple(parameters))


def _read_movement_modifiers(tables: Tables, text: str, standard: str) -> None:
    common = (
        Parameter("at", "at", "all"),
        Parameter("movement_mode", "movement_mode", "other"),
        Parameter("track", "track", "actual"),
        Parameter("shape", "any_shape"),
    )
    for row in _rows(text):
        (name,) = _codes(row[0])
        cell = row[1].replace(" + `", ", `") if row[1] != "none" else ""
        parameters = [
            Parameter(parameter, type_, default)
            for parameter, type_, default, version in _grouped(cell)
            if version != "2.2" or standard >= "2.2"
        ]
        own = tuple(parameters) + (() if name in WITHOUT_COMMON else common)
        tables.modifiers[name] = Compound(MOVEMENT_TARGET, own)


def _read_actor_modifiers(tables: Tables, text: str) -> None:
    for row in _rows(text):
        name = _codes(row[0])[0]
        fields = tuple(Parameter(n, t, d) for n, t, d, _ in _grouped(row[1]))
        tables.modifiers[name] = Compound(None, fields)


def _read_methods(tables: Tables, text: str) -> None:
    for row in _rows(text):
        for signature in _codes(row[0]):
            if "*" not in signature:
                _add_method(tables, signature)


def _read_string_methods(tables: Tables, text: str) -> None:
    for row in _rows(text):
        for signature in _codes(row[0]):
            _add_method(tables, f"string.{signature}")


def _add_method(tables: Tables, text: str) -> None:
    match = re.match(r"(\w+\.\w+)\((.*)\)(?: -> ([\w ]+))?$", text)
    assert match, text
    parameters = []
    for part in re.split(r",\s*", match[2]) if match[2] else ():
        name, _, rest = part.partition(":")
        type_, _, default = (side.strip() for side in rest.partition("="))
        parameters.append(Parameter(name.strip(), type_, default or None))
    tables.methods[match[1]] = Method(tuple(parameters), match[3] or "nothing")
