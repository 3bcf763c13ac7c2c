"""The tables of a store, and rows as records of them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from math import isfinite
from types import NoneType
from typing import Any

from osc2tx_runtime.campaigns import Row, RowResult

SCHEMA = """
create table campaign (name text primary key, value text not null) without rowid;
create table run (
    number integer primary key,
    seed integer not null,
    shares text,
    given text not null,
    parameters text not null,
    status text not null,
    reason text not null,
    source text,
    steps integer not null,
    time real not null,
    measures text not null,
    violations text not null,
    digest text,
    seconds real not null,
    attempts integer not null
);
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

# Columns whose values depend on the machine and its load.
OF_THE_MACHINE = ("seconds", "attempts")
COLUMNS = (
    *("number", "seed", "shares", "given", "parameters", "status", "reason", "source", "steps"),
    *("time", "measures", "violations", "digest", "seconds", "attempts"),
)

_NUMBER = (int, float)
_TEXT_OR_NONE = (str, NoneType)

ROW_TYPES: Mapping[str, Any] = {
    **{"number": int, "seed": int, "shares": (dict, NoneType), "given": dict, "parameters": dict},
    **{"status": str, "reason": str, "source": _TEXT_OR_NONE, "steps": int, "time": _NUMBER},
    **{
        "violations": list,
        "measures": dict,
        "digest": _TEXT_OR_NONE,
        "seconds": _NUMBER,
        "attempts": int,
    },
}
"""Types of the values of a row."""

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
    row = result.row
    return (
        row.number,
        row.seed,
        None if row.shares is None else json.dumps(dict(row.shares)),
        json.dumps(dict(row.set)),
        json.dumps(dict(result.values), default=str),
        result.status,
        result.reason,
        result.source,
        result.steps,
        result.time,
        json.dumps(dict(result.measures)),
        json.dumps(result.violations),
        result.digest,
        result.seconds,
        result.attempts,
    )


def decoded(values: Sequence[Any]) -> dict[str, Any]:
    """Return a record by column, JSON decoded.

    Raises:
        ValueError: Nothing that osc2tx writes into a column.
    """
    found = dict(zip(COLUMNS, values, strict=True))
    for name in ("shares", "given", "parameters", "measures", "violations"):
        found[name] = None if found[name] is None else json.loads(found[name])
    if not all(map(_is_finite, found.values())):
        raise ValueError("a number is not finite")
    require_types(found, ROW_TYPES)
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
