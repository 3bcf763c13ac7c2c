"""The tables of a store, and rows as records of them."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from math import isfinite
from types import NoneType
from typing import Any, NamedTuple

from osc2tx_runtime.campaigns import Row, RowResult

_NUMBER = (int, float)
_TEXT_OR_NONE = (str, NoneType)


class Column(NamedTuple):
    """A column of the table of rows.

    Attributes:
        kind: Its type in SQL.
        types: Types of its values.
        value: Returns the value of a result.
        is_json: Whether it is stored as JSON.
    """

    kind: str
    types: Any
    value: Callable[[RowResult], Any]
    is_json: bool = False


RUN: Mapping[str, Column] = {
    "number": Column("integer primary key", int, lambda found: found.row.number),
    "seed": Column("integer not null", int, lambda found: found.row.seed),
    "shares": Column(
        "text",
        (dict, NoneType),
        lambda found: found.row.shares and dict(found.row.shares),
        is_json=True,
    ),
    "given": Column("text not null", dict, lambda found: dict(found.row.set), is_json=True),
    "parameters": Column("text not null", dict, lambda found: dict(found.values), is_json=True),
    "status": Column("text not null", str, lambda found: found.status),
    "reason": Column("text not null", str, lambda found: found.reason),
    "source": Column("text", _TEXT_OR_NONE, lambda found: found.source),
    "steps": Column("integer not null", int, lambda found: found.steps),
    "time": Column("real not null", _NUMBER, lambda found: found.time),
    "measures": Column("text not null", dict, lambda found: dict(found.measures), is_json=True),
    "violations": Column("text not null", list, lambda found: found.violations, is_json=True),
    "digest": Column("text", _TEXT_OR_NONE, lambda found: found.digest),
    "seconds": Column("real not null", _NUMBER, lambda found: found.seconds),
    "attempts": Column("integer not null", int, lambda found: found.attempts),
}
"""The outcome of a row, by column."""

OF_THE_MACHINE = ("seconds", "attempts")
"""Columns whose values depend on the machine and its load."""

SCHEMA = f"""
create table campaign (name text primary key, value text not null) without rowid;
create table run ({", ".join(f"{name} {column.kind}" for name, column in RUN.items())});
create table collision (
    number integer not null, nth integer not null,
    time real not null, one text not null, other text not null, speed real not null,
    primary key (number, nth)
) without rowid;
create table sample (
    number integer not null, nth integer not null,
    kind text not null, line text not null,
    primary key (number, nth)
) without rowid;
create table left_out (number integer primary key);
"""

PLAN_TYPES: Mapping[str, Any] = {
    **{"files": dict, "module": str, "scenario": str, "options": dict, "map_path": list},
    **{"measures": list, "fail_if": list, "digests": bool},
}
"""Types of the common data of all rows."""

IDENTITY_TYPES: Mapping[str, Any] = {
    **{"scenario": str, "modules": str, "osc2tx": str, "sampler": str, "seed": int},
    **{"options": dict, "kpi": list, "fail-if": list},
}
"""Types of the identity of a campaign."""


def row_of(run: Mapping[str, Any]) -> Row:
    """Return the row that a record is of."""
    return Row(run["number"], run["seed"], run["shares"], run["given"])


def record(result: RowResult) -> Sequence[Any]:
    """Return the outcome of a row as a record of the table `run`."""
    found = {name: column.value(result) for name, column in RUN.items()}
    return [
        json.dumps(value, default=str) if RUN[name].is_json and value is not None else value
        for name, value in found.items()
    ]


def decoded(values: Sequence[Any]) -> dict[str, Any]:
    """Return a record by column, JSON decoded.

    Raises:
        ValueError: Nothing that osc2tx writes into a column.
    """
    found = {
        name: json.loads(value) if column.is_json and value is not None else value
        for (name, column), value in zip(RUN.items(), values, strict=True)
    }
    if not all(map(_is_finite, found.values())):
        raise ValueError("a number is not finite")
    require_types(found, {name: column.types for name, column in RUN.items()})
    require_types(found["measures"], dict.fromkeys(found["measures"], (*_NUMBER, NoneType)))
    if not all(isinstance(each, str) for each in found["violations"]):
        raise ValueError("`violations` are no texts")
    return found


def _is_finite(value: Any) -> bool:
    """Whether all numbers of a decoded value are finite; it is flat, or damaged."""
    if isinstance(value, dict):
        return all(map(_is_finite, value.values()))
    if isinstance(value, list):
        return all(map(_is_finite, value))
    return not isinstance(value, float) or isfinite(value)


def require_types(values: Mapping[str, Any], types: Mapping[str, Any]) -> None:
    """Check the values of a mapping.

    Raises:
        ValueError: One is missing, or of another type.
    """
    for name, wanted in types.items():
        if not isinstance(values.get(name), wanted):
            raise ValueError(f"`{name}` is {json.dumps(values.get(name), default=str)[:60]}")
