"""How the values of a coverage item are sorted: `range`, `every` and `buckets` (§7.5.5).

A number without unit is meant in the unit of the item.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from osc2tx.semantics.conversions import dimension_of, is_numeric
from osc2tx.semantics.literal_numbers import constant_number
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.types import ERROR, FLOAT, ListType, RangeType, Type
from osc2tx.syntax import ast

Arguments = Mapping[str, ast.Expression]


def check_slices(r: Resolution, arguments: Arguments, item: Type, env: Environment) -> None:
    """Check the arguments that say which values count, and as one."""
    for other in ("range", "every"):
        if "buckets" in arguments and other in arguments:
            r.report("OSC412", arguments[other].span, f"`buckets` and `{other}` exclude each other")
    if "range" in arguments:
        _check_range(r, arguments["range"], item, env)
    if "every" in arguments:
        _check_every(r, arguments["every"], item, env)
    if "buckets" in arguments:
        _check_buckets(r, arguments["buckets"], item, env)


def _check_range(r: Resolution, value: ast.Expression, item: Type, env: Environment) -> None:
    type_ = r.type_of(value, env)
    if isinstance(type_, RangeType):
        _check_boundary(r, value, type_.element, item, "`range`")
    elif type_ != ERROR:
        r.report("OSC301", value.span, f"`range` must be a range, not `{type_}`")


def _check_every(r: Resolution, value: ast.Expression, item: Type, env: Environment) -> None:
    _check_boundary(r, value, r.type_of(value, env), item, "`every`")
    width = constant_number(r, value)
    if width is not None and width <= 0:
        r.report("OSC412", value.span, "the width of a slice must be positive")


def _check_buckets(r: Resolution, value: ast.Expression, item: Type, env: Environment) -> None:
    type_ = r.type_of(value, env)
    if not isinstance(type_, ListType):
        if type_ != ERROR:
            r.report("OSC301", value.span, f"`buckets` must be a list, not `{type_}`")
        return
    _check_boundary(r, value, type_.element, item, "`buckets`")
    if not isinstance(value, ast.ListLiteral):
        return
    if len(value.elements) < 2:
        r.report("OSC412", value.span, "buckets lie between two boundaries or more")
    for first, second in pairwise(value.elements):
        lower, upper = constant_number(r, first), constant_number(r, second)
        if lower is not None and upper is not None and upper < lower:
            r.report("OSC412", second.span, "the boundaries of buckets must not descend")
            return


def _check_boundary(
    r: Resolution, value: ast.Expression, given: Type, item: Type, what: str
) -> None:
    """Check that a boundary has the dimension of the item, or is a number in its unit."""
    if ERROR in (given, item):
        return
    if not is_numeric(item):
        r.report("OSC412", value.span, f"{what} sorts numbers, not `{item}`")
    elif not is_numeric(given):
        r.report("OSC301", value.span, f"{what} takes numbers, not `{given}`")
    elif dimension_of(given) not in (dimension_of(FLOAT), dimension_of(item)):
        r.report("OSC302", value.span, f"{what} is given in `{given}`, the item in `{item}`")
