"""Coverage of a campaign (§7.5.7): hits of buckets, holes, grades."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import field
from itertools import product
from typing import Any

from osc2tx.campaigns.identity import plan_of
from osc2tx.campaigns.store import Store
from osc2tx_runtime.campaigns import Executor, Plan
from osc2tx_shared.classes import dataclass

ENDING = ".coverage.json"
ROUNDING = 1e-9  # of the size of a value: so close to a boundary it lies on it

Cell = tuple[int, ...]
"""Positions of buckets: one of an item, one for each item of a cross."""


@dataclass(frozen=True, slots=True)
class Bucket:
    """Values that count as one.

    Attributes:
        low: Least value, in the unit of the item.
        high: Greatest value; it belongs to the next bucket, if there is one.
        value: Instead of both: the only value.
        label: Name of a default bucket.
    """

    low: float = 0.0
    high: float = 0.0
    value: bool | int | str | None = None
    label: str = ""

    def __str__(self) -> str:
        if self.value is not None:
            return str(self.value).lower() if isinstance(self.value, bool) else str(self.value)
        span = f"{self.low:.6g}" if self.low == self.high else f"{self.low:.6g}..{self.high:.6g}"
        return f"{self.label} {span}" if self.label else span


@dataclass(slots=True)
class Item:
    """A sampled value, with its hits.

    Attributes:
        name: With the path of the invocation before it.
        kind: `cover` or `record`.
        group: The event that samples it.
        unit: Name of its unit; empty without one.
        text: Description.
        target: Number of hits required in a bucket.
        parts: Of a cross: its items.
        buckets: Of a single item; empty if its values have no declared bounds.
        impossible: Cells that constraints leave no values for.
        hits: Number of samples in each cell.
        samples: How many there were.
        outside: Those in none of the buckets.
        values: Numbers of an item without buckets, each with its row.
        illegal: Rows with an illegal value.
    """

    name: str
    kind: str
    group: str
    unit: str = ""
    text: str = ""
    target: int = 1
    parts: tuple[Item, ...] = ()
    buckets: tuple[Bucket, ...] = ()
    impossible: frozenset[Cell] = frozenset()
    hits: Counter[Cell] = field(default_factory=Counter)
    samples: int = 0
    outside: int = 0
    values: list[tuple[float, int]] = field(default_factory=list)
    illegal: list[int] = field(default_factory=list)

    def cells(self) -> Iterator[Cell]:
        """Yield all cells, those that are impossible included."""
        sizes = [len(part.buckets) for part in self.parts] or [len(self.buckets)]
        yield from product(*map(range, sizes))

    @property
    def is_graded(self) -> bool:
        """Whether the buckets are known; items that are only recorded have no goal."""
        return self.kind == "cover" and all(part.buckets for part in self.parts or (self,))

    def holes(self) -> list[Cell]:
        """Return the cells with too few hits that some run could hit."""
        if not self.is_graded:
            return []
        return [
            cell
            for cell in self.cells()
            if not self.is_impossible(cell) and self.hits[cell] < self.target
        ]

    def is_impossible(self, cell: Cell) -> bool:
        """Whether constraints leave no values for a cell."""
        return cell in self.impossible or any(
            part.is_impossible((index,)) for part, index in zip(self.parts, cell, strict=False)
        )

    @property
    def possible(self) -> int:
        """How many cells some run could hit."""
        return sum(not self.is_impossible(cell) for cell in self.cells())

    @property
    def grade(self) -> float | None:
        """Share of the cells that some run could hit which have their hits, in percent."""
        if not self.is_graded:
            return None
        possible = self.possible
        return 100.0 * (possible - len(self.holes())) / possible if possible else 100.0

    def name_of(self, cell: Cell) -> str:
        """Return a cell in words."""
        if not self.parts:
            return f"{self.buckets[cell[0]]} {self.unit}".rstrip()
        named = zip(self.parts, cell, strict=True)
        return ", ".join(f"{part.name} {part.name_of((index,))}" for part, index in named)

    def count(self, line: Mapping[str, Any], row: int) -> None:
        """Count a sample."""
        self.samples += 1
        if line.get("illegal") and row not in self.illegal[-1:]:
            self.illegal.append(row)
        short = self.name.rpartition(".")[0]
        value = line["value"]
        if not self.parts and not self.buckets:
            if isinstance(value, int | float) and not isinstance(value, bool):
                self.values.append((value, row))
            return
        if self.parts:
            values = [value[part.name.removeprefix(f"{short}.")] for part in self.parts]
            found = [part.position(each) for part, each in zip(self.parts, values, strict=True)]
        else:
            found = [self.position(value)]
        if None in found:
            self.outside += 1
            return
        self.hits[tuple(index for index in found if index is not None)] += 1

    def position(self, value: Any) -> int | None:
        """Return the bucket of a value; points precede the ranges around them."""
        for index, bucket in enumerate(self.buckets):
            if bucket.value is not None and bucket.value == value:
                return index
        if isinstance(value, bool) or not isinstance(value, int | float):
            return None
        slack = ROUNDING * max(1.0, abs(value))
        for index, bucket in enumerate(self.buckets):
            is_point = bucket.value is None and bucket.low == bucket.high
            if is_point and abs(value - bucket.low) <= slack:
                return index
        last: int | None = None
        for index, bucket in enumerate(self.buckets):
            if bucket.value is None and bucket.low - slack <= value <= bucket.high + slack:
                last = index  # a boundary belongs to the bucket above it
        return last


def has_models(store: Store) -> bool:
    """Return whether a campaign has coverage items, for which its module is imported."""
    return any(name.endswith(ENDING) for name in store.plan["files"])


def items_of(plan: Plan) -> dict[str, Item]:
    """Return the items of a campaign, those of invoked scenarios by path; none has hits yet.

    Raises:
        ScenarioError: The module cannot be imported, or has no values.
    """
    models: dict[str, Sequence[Mapping[str, Any]]] = {}
    for name, text in sorted(plan.files.items()):
        if name.endswith(ENDING):
            models.update(json.loads(text)["scenarios"])
    if not models:
        return {}
    with closing(Executor(plan)) as executor:
        scopes = executor.sampling_scopes()
    found: dict[str, Item] = {}
    for scope, scenario in scopes:
        prefix = f"{scope}." if scope else ""
        for said in models.get(scenario, ()):
            parts = tuple(found[prefix + name] for name in said.get("items", ()))
            found[prefix + said["name"]] = Item(
                name=prefix + said["name"],
                kind=said["kind"],
                group=prefix + said["group"],
                unit=said.get("unit", ""),
                text=said.get("text", ""),
                target=said.get("target", 1),
                parts=parts,
                buckets=tuple(Bucket(**each) for each in said.get("buckets", ())),
                impossible=frozenset(map(tuple, said.get("impossible", ()))),
            )
    return found


def coverage_of(store: Store) -> dict[str, Item]:
    """Return the items of a campaign with their hits.

    Raises:
        CampaignError: Nothing was run yet, or the store is damaged.
        ScenarioError: The module cannot be imported, or has no values.
    """
    plan, samples = plan_of(store), list(store.samples())
    with store.as_written("coverage"):
        items = items_of(plan)
        count_samples(items, samples)
        return items


def count_samples(
    items: dict[str, Item], samples: Iterable[tuple[int, str, Mapping[str, Any]]]
) -> None:
    """Count the samples; an item without a model has no buckets."""
    for number, kind, line in samples:
        name = line["name"]
        if name not in items:
            items[name] = Item(name, kind, "", line.get("unit", ""), line.get("text", ""))
        item = items[name]
        if isinstance(line["value"], dict) and not item.parts:
            item.samples += 1
            continue
        item.count(line, number)


def overall(items: Iterable[Item]) -> float | None:
    """Return the mean grade, in percent; None if nothing has one."""
    grades = [grade for item in items if (grade := item.grade) is not None]
    return math.fsum(grades) / len(grades) if grades else None
