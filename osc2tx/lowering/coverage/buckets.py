"""Buckets of coverage items, and which of them no run can hit.

Buckets are those of `range`, `every` and `buckets` (§7.5.5), else the default ones of §7.5.7: both
truth values, the members of an enum, each whole number where there are few, and of any other
bounded number its least and its greatest value with three thirds between them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product

from osc2tx import ir
from osc2tx.analysis import TypeConstraints
from osc2tx.analysis.constraints.domains import (
    TRUE,
    Choice,
    Domain,
    EmptyDomainError,
    Interval,
    intersect,
)
from osc2tx.analysis.constraints.operation_list import Key, OperationListBuilder, domain_of_type
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.constraints.solver import solve, values_on
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.coverage.owners import CoverageOwner
from osc2tx.lowering.value_types import number_in
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.bodies.coverage_items import Item
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

THIRDS = ("low", "mid", "high")
FEW = 256  # integers that have a bucket each: a byte
MOST = 1000  # buckets of an item
MOST_CELLS = 2500  # of a cross of which each is asked whether it is possible
ROUNDING = 1e-9  # of a slice


@dataclass(frozen=True, slots=True, eq=False)
class Sampled:
    """An item whose values are known.

    Attributes:
        item: Its declaration.
        coverage: Its coverage in the IR.
        type: Of its values.
        unit: The unit of their bounds.
        ignore: The condition for values that do not count.
        owner: Its owner.
    """

    item: Item
    coverage: ir.Coverage
    type: types.Type
    unit: sym.UnitSymbol | None
    ignore: ast.Expression | None
    owner: CoverageOwner


def with_buckets(
    ctx: LoweringContext, scenario: Composed, items: Sequence[Sampled]
) -> Iterator[ir.Coverage]:
    """Yield the items of a scenario with their buckets."""
    if not items:
        return
    grading = _Grading(ctx, scenario)
    by_name = {each.coverage.name: each for each in items}
    graded = {
        name: replace(each.coverage, graded=tuple(grading.buckets(each)))
        for name, each in by_name.items()
        if not each.coverage.items
    }
    for each in items:
        coverage = each.coverage
        found = coverage if coverage.items else graded[coverage.name]
        parts = [name for name in coverage.items or (coverage.name,) if name in graded]
        lists = [(by_name[name], graded[name].graded) for name in parts]
        cells = product(*(range(len(buckets)) for _, buckets in lists))
        if math.prod(len(buckets) for _, buckets in lists) > MOST_CELLS:
            yield found
            continue
        impossible = tuple(cell for cell in cells if not grading.can_be(lists, cell))
        yield replace(found, impossible=impossible)


class _Grading:
    """The values that constraints leave to the parameters of a scenario.

    Defaults do not count: settings may replace them.
    """

    def __init__(self, ctx: LoweringContext, scenario: Composed) -> None:
        self._ctx = ctx
        self._found: TypeConstraints = ctx.program.analysis.types[scenario]
        self._firm = [each.operations for each in self._found.firm]
        self._by_key: dict[Key, list[int]] = {}
        for index, operations in enumerate(self._firm):
            for key in operations.keys_in_order:
                self._by_key.setdefault(key, []).append(index)
        self._domains = self._found.domains_to_set()
        self._writer = OperationListBuilder(ctx.model)

    def buckets(self, sampled: Sampled) -> Iterator[ir.Bucket]:
        """Yield the buckets of an item; none if its values have no declared bounds."""
        found = list(self._sliced(sampled) or self._default(sampled))
        if len(found) > MOST:
            return
        yield from (each for each in found if not self._is_ignored(sampled, each))

    def can_be(
        self, lists: Sequence[tuple[Sampled, Sequence[ir.Bucket]]], cell: Sequence[int]
    ) -> bool:
        """Whether constraints leave values in a bucket of each of some items."""
        given: dict[Key, Domain] = {}
        for (sampled, buckets), index in zip(lists, cell, strict=True):
            key = self._key(sampled)
            if key is None:
                continue
            domain = _domain(sampled, buckets[index])
            try:
                known = self._domains.get(key, domain_of_type(sampled.type))
                given[key] = intersect(given.get(key, known), domain)
            except EmptyDomainError:
                return False
        return self._is_solvable(given)

    def _is_solvable(self, given: Mapping[Key, Domain]) -> bool:
        connected = self._found.connected(given)  # others hold as they did in the analysis
        indices = {index for key in connected for index in self._by_key.get(key, ())}
        operations = [self._firm[index] for index in sorted(indices)]
        return not operations or not solve(operations, range(len(operations)), given).conflict

    def _sliced(self, sampled: Sampled) -> list[ir.Bucket]:
        """Return the buckets of the declaration."""
        coverage = sampled.coverage
        if coverage.buckets:
            return [ir.Bucket(low=low, high=high) for low, high in pairwise(coverage.buckets)]
        if coverage.every is None:
            return []
        bounds = coverage.within or self._bounds(sampled)
        if bounds is None:
            return []
        low, high = bounds
        start = low if coverage.within else math.floor(low / coverage.every) * coverage.every
        count = math.ceil((high - start) / coverage.every - ROUNDING)
        if count > MOST:
            return []
        ends = [start + index * coverage.every for index in range(count + 1)]
        ends[-1] = min(ends[-1], high) if coverage.within else ends[-1]
        return [ir.Bucket(low=one, high=other) for one, other in pairwise(ends)]

    def _default(self, sampled: Sampled) -> list[ir.Bucket]:
        """Return the buckets of §7.5.7."""
        match sampled.type:
            case types.PrimitiveType(name="bool"):
                return [ir.Bucket(value=False), ir.Bucket(value=True)]
            case types.EnumType(symbol=symbol):
                return [ir.Bucket(value=member.name) for member in symbol.members.values()]
        bounds = sampled.coverage.within or self._bounds(sampled)
        if bounds is None:
            return []
        low, high = bounds
        is_whole = isinstance(sampled.type, types.PrimitiveType) and sampled.type.name != "float"
        if is_whole and high - low < FEW:
            return [ir.Bucket(value=each) for each in range(int(low), int(high) + 1)]
        if low == high:
            return [ir.Bucket(low=low, high=high)]
        ends = [low, low + (high - low) / 3, low + (high - low) * 2 / 3, high]
        thirds = zip(pairwise(ends), THIRDS, strict=True)
        return [
            ir.Bucket(low=low, high=low, label="min"),
            *(ir.Bucket(low=one, high=other, label=name) for (one, other), name in thirds),
            ir.Bucket(low=high, high=high, label="max"),
        ]

    def _bounds(self, sampled: Sampled) -> tuple[float, float] | None:
        """Return the least and the greatest value in the unit, if constraints state them."""
        key = self._key(sampled)
        domain = None if key is None else self._domains.get(key)
        if not isinstance(domain, Interval) or not math.isfinite(domain.upper - domain.lower):
            return None
        if abs(domain.lower) >= 2**62 or abs(domain.upper) >= 2**62:
            return None
        if sampled.unit is None:
            return domain.lower, domain.upper
        return number_in(sampled.unit, domain.lower), number_in(sampled.unit, domain.upper)

    def _key(self, sampled: Sampled) -> Key | None:
        expression = sampled.item.expression
        if isinstance(expression, ast.ItExpression):
            field = sampled.owner.field(sampled.item.name)
            if field is not None:
                return (*sampled.owner.key, field)
        return None if expression is None else self._place(sampled, None).locate(expression)

    def _place(self, sampled: Sampled, it: Key | None) -> Place:
        owner = sampled.owner
        return Place(model=self._ctx.model, owner=owner.lineage[0], prefix=owner.key, it=it)

    def _is_ignored(self, sampled: Sampled, bucket: ir.Bucket) -> bool:
        """Whether all values of a bucket surely do not count."""
        if sampled.ignore is None:
            return False
        key = self._key(sampled) or (sampled.item.node,)
        place = self._place(sampled, key)
        operations = self._writer.write(sampled.ignore, place.locate)
        return values_on(operations, {key: _domain(sampled, bucket)})[-1] == TRUE


def _domain(sampled: Sampled, bucket: ir.Bucket) -> Domain:
    """Return the values of a bucket, in SI units; members of enums are their numbers."""
    if bucket.value is not None:
        if isinstance(sampled.type, types.EnumType):
            return Choice(frozenset({sampled.type.symbol.members[str(bucket.value)].value}))
        if isinstance(bucket.value, bool | str):
            return Choice(frozenset({bucket.value}))
        return Interval(bucket.value, bucket.value)
    unit = sampled.unit
    factor, offset = (1.0, 0.0) if unit is None else (unit.factor, unit.offset)
    assert bucket.low is not None and bucket.high is not None, "it is one of numbers"
    low, high = bucket.low * factor + offset, bucket.high * factor + offset
    last = sampled.coverage.within[1] if sampled.coverage.within else math.inf
    is_open = bucket.low < bucket.high < last and not bucket.label
    return Interval(low, high, lower_open=bool(bucket.label and low < high), upper_open=is_open)
