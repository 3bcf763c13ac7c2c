"""Coverage items of the IR (§7.5)."""

from __future__ import annotations

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import EventRef, Moment
from osc2tx.ir.expressions import Expression
from osc2tx.ir.values import Unit
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Bucket:
    """Values of an item that count as one.

    Attributes:
        low: Least value, in the unit.
        high: Greatest value, which the next bucket has, if there is one; equal to `low`: a point.
        value: Instead of both: the only value, an enum's member by its name.
        label: Name of a default bucket.
    """

    low: int | float | None = None
    high: int | float | None = None
    value: bool | int | str | None = None
    label: str = ""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Coverage:
    """`cover` or `record`, overrides merged.

    Attributes:
        kind: `cover` or `record`.
        name: The item.
        span: Its declaration.
        expression: The sampled expression; `None` for a cross of other items.
        items: The items of a cross.
        event: When it is sampled: an event, or the start or end of the scenario.
        unit: The unit of values and slices.
        within: Values of interest, in the unit.
        every: Width of a slice, in the unit.
        buckets: Boundaries between slices, in the unit.
        ignore: The condition of ignored values, over the element of depth 0.
        illegal: The condition of illegal values, likewise.
        target: Hits that each slice should have.
        text: Description.
        comments: The comment lines above it.
        graded: Its buckets, also those by default; empty for a cross, or if its values have no
            declared bounds.
        impossible: Buckets whose values constraints exclude: a position in `graded`, for a cross
            one for each item.
    """

    kind: str
    name: str
    span: Span
    expression: Expression | None
    items: tuple[str, ...] = ()
    event: EventRef | Moment = Moment.END
    unit: Unit | None = None
    within: tuple[int | float, int | float] | None = None
    every: int | float | None = None
    buckets: tuple[int | float, ...] = ()
    ignore: Expression | None = None
    illegal: Expression | None = None
    target: int | None = None
    text: str = ""
    comments: tuple[str, ...] = ()
    graded: tuple[Bucket, ...] = ()
    impossible: tuple[tuple[int, ...], ...] = ()
