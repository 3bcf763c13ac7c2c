"""Logical scenarios: a document with open parameters, and the values that they may have.

A parameter stays one where the document says the same for all its values. That is tested, not
assumed: the document is evaluated for values of its domain and compared with what is written down
for the scenario with just these values. What follows from a parameter by no expression gets a
column in the table of values. A parameter on which the elements themselves depend keeps its nominal
value, and the report says so.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.logical.distributions import MOST_COLUMNS, needs_table, single, table
from osc2tx.backends.xosc.logical.parameters import (
    INSIDE,
    OpenParameter,
    Point,
    open_parameters,
    value_text,
)
from osc2tx.backends.xosc.logical.sampling import Choosing, Domain, Row, inward
from osc2tx.options import XmlVersion
from osc2tx.xosc import elements as xml
from osc2tx.xosc.arithmetic import Range
from osc2tx.xosc.columns import Column, columns_of, with_columns
from osc2tx.xosc.comparison import Limits, Place, differences, undefined, with_covering_limits
from osc2tx.xosc.element import Element
from osc2tx_shared.classes import dataclass, replace

Write: TypeAlias = Callable[[Choosing], tuple[Context, Element | None]]
"""Writes the scenario down with a choice of its open parameters."""

Unlike: TypeAlias = frozenset[Place]
"""Attributes in which documents differ."""

NO_VALUES = (
    "hardly any values of the open parameters keep the constraints, and none is found: bounds that"
    " are computed, as in `keep(b in [a..20m])`, leave some in each run"
)

SAME: Unlike = frozenset()


@dataclass(frozen=True, slots=True, eq=False)
class Logical:
    """A scenario as it is written down.

    Attributes:
        ctx: What went with it.
        document: The document; `None` if there is none.
        domain: Open parameters that are parameters of the document, and what they may be.
        columns: Parameters of the document that follow from them.
        causes: Names of columns by the key of a parameter that they follow from.
        rows: Values for runs, if they have to be listed together.
    """

    ctx: Context
    document: Element | None
    domain: Domain
    columns: tuple[Column, ...] = ()
    causes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    rows: tuple[Row, ...] = ()

    @property
    def kept(self) -> tuple[OpenParameter, ...]:
        """Open parameters that are parameters of the document."""
        return self.domain.parameters

    def distributions(self) -> Sequence[xml.DeterministicPart]:
        """Return the values that its parameters may have."""
        if self.rows:
            return [table(self.kept, self.rows, self.columns)]
        return [single(parameter, self.domain) for parameter in self.kept]


class LogicalWriter:
    """Finds out which parameters of a scenario may stay open.

    Args:
        scenario: The scenario.
        module: Where it stands.
        version: Of the XML.
        write: Writes it down.
    """

    def __init__(
        self, scenario: ir.Scenario, module: ir.Module, version: XmlVersion, write: Write
    ) -> None:
        self.parameters = open_parameters(scenario, module)
        self.domain = Domain(scenario, module, self.parameters)
        self._branches = [p for p in self.parameters if p.is_branch]
        constraints = (each.span for each in scenario.constraints)
        self._span = next(constraints, scenario.span)
        self._version = version
        self._write = write
        self._written: dict[frozenset[tuple[str, object]], Element | None] = {}

    def run(self) -> Logical:
        """Return the document in which most parameters stay open."""
        found: list[Logical] = []
        for is_beside in (False, True):  # the middle may be a special place
            nominal = self.domain.nominal(is_beside=is_beside)
            if nominal is None:
                least = self.domain.at([0.0] * len(self.parameters))
                nothing = self._settled(self._branches, least)
                nothing.ctx.report.cannot("constraints", self._span, NO_VALUES)
                return nothing
            found.append(self._settled(self.parameters, nominal))
            if found[-1].document is None or len(found[-1].kept) == len(self.parameters):
                return found[-1]
        return max(found, key=lambda each: len(each.kept))

    def _settled(self, kept: Sequence[OpenParameter], nominal: Point) -> Logical:
        """Return the document with those of some parameters for whose values it is right."""
        while True:
            folded = {p.key: nominal[p.key] for p in self.parameters if p not in kept}
            domain = self.domain.narrowed(kept, folded)
            ctx, document = self._write(Choosing(self.parameters, kept, nominal))
            if document is not None:
                document = with_covering_limits(document, domain.ranges())
            found = Logical(ctx, document, domain)
            if document is None or not ctx.report.is_expressible or not kept:
                return found
            trial = _Trial(document, domain, nominal, self._concrete)
            wrong = trial.wrong(has_columns=self._version >= "1.1")
            if not wrong:
                listed = self._listed(found, trial)
                if listed is not None and listed.document is not None:
                    return replace(listed, document=trial.limits.raised(listed.document))
                wrong = [p for p in kept if not p.is_branch]
                if not wrong:
                    return found
            kept = [parameter for parameter in kept if parameter not in wrong]

    def _concrete(self, point: Point) -> Element | None:
        """Return the document for values of the open parameters."""
        key = frozenset(point.items())
        if key not in self._written:
            ctx, document = self._write(Choosing(self.parameters, self._branches, point))
            self._written[key] = document if ctx.report.is_expressible else None
        return self._written[key]

    def _listed(self, found: Logical, trial: _Trial) -> Logical | None:
        """Return a scenario with a table of values if it needs one; `None` if there is none."""
        unlike = trial.together()
        document, places = trial.compared(trial.nominal)
        if unlike is None or places is None or document is None:
            return None
        unlike |= places
        if self._version == "1.0":
            return None if unlike else found
        if not unlike and not trial.has_special and not needs_table(found.domain):
            return found
        if len(unlike) > MOST_COLUMNS:
            return None
        rows, documents = list(found.domain.rows), [document]
        for index, row in enumerate(rows):
            rows[index], document, places = trial.at_row(row)
            if places is None or document is None:
                return None
            documents.append(document)
            unlike |= places
        if len(unlike) > MOST_COLUMNS or not rows:
            return None
        return _with_columns(found, trial, unlike, rows, documents)


def _with_columns(
    found: Logical, trial: _Trial, unlike: Unlike, rows: Sequence[Row], made: Sequence[Element]
) -> Logical:
    """Return a scenario with columns for attributes, from documents for nominal values and rows."""
    points = [trial.nominal, *(row.point for row in rows)]
    known = {tuple(value_text(point[p.key]) for point in points): p.name for p in found.kept}
    ctx = found.ctx
    columns, same = columns_of(sorted(unlike), made, known, ctx.names)
    causes = {
        key: tuple(c.name for c in columns if not places.isdisjoint(c.places))
        for key, places in trial.causes.items()
    }
    document = with_columns(trial.document, columns, same, ctx.version)
    return replace(
        found, document=document, columns=tuple(columns), causes=causes, rows=tuple(rows)
    )


class _Trial:
    """A document with parameters, which is compared with those for values of them.

    Attributes:
        document: The document.
        nominal: Values in its declarations.
        causes: Attributes that differ for other values of a parameter, by its key.
        has_special: There are single values with other elements.
        limits: Of vehicles, which cover all documents that were compared.
    """

    def __init__(
        self,
        document: Element,
        domain: Domain,
        nominal: Point,
        concrete: Callable[[Point], Element | None],
    ) -> None:
        self.document = document
        self.nominal = nominal
        self.causes: dict[str, Unlike] = {}
        self.has_special = False
        self.limits = Limits(document)
        self._domain = domain
        self._concrete = concrete

    def wrong(self, *, has_columns: bool) -> list[OpenParameter]:
        """Return the parameters for whose other values there are other elements or attributes."""
        found = []
        ranges = self._domain.ranges()
        for parameter in self._domain.parameters:
            if parameter.is_branch:  # all its members are in the document
                continue
            places = self._probed(parameter, ranges)
            if places is None or (places and not has_columns):
                found.append(parameter)
            elif places:
                self.causes[parameter.key] = places
        return found

    def _probed(self, parameter: OpenParameter, ranges: Mapping[str, Range]) -> Unlike | None:
        """Return the attributes that differ for values of a parameter, `None` if elements do."""
        places = undefined(self.document, parameter.name, ranges)
        for share in parameter.probes():
            differing = self._unlike(self._with(parameter, share))
            if differing is None and not parameter.choices:  # it may be a special value
                self.has_special = True
                differing = self._unlike(self._with(parameter, inward(share)))
            if differing is None:
                return None
            places |= differing
        return places

    def _with(self, parameter: OpenParameter, share: float) -> Point:
        """Return the nominal values, but of one parameter another one."""
        values = self._domain.values(parameter, self.nominal)
        return {**self.nominal, parameter.key: parameter.at(share, values)}

    def together(self) -> Unlike | None:
        """Return the attributes that differ where several parameters have other values."""
        found = SAME.union(*self.causes.values())
        if len(self._domain.parameters) < 2:
            return found
        for share in (0.0, INSIDE, 1.0):
            row = self._domain.row([share] * len(self._domain.parameters))
            differing = self._unlike(row.point)
            if differing is None:
                differing = self._unlike(self._domain.beside(row).point)
            if differing is None:
                return None
            found |= differing
        return found

    def at_row(self, row: Row) -> tuple[Row, Element | None, Unlike | None]:
        """Return the document for a row, or one beside it, and the attributes that differ."""
        document, places = self.compared(row.point)
        other = self._domain.beside(row)
        if places is None and self._domain.allows(other.point):
            return (other, *self.compared(other.point))
        return row, document, places

    def _unlike(self, point: Point) -> Unlike | None:
        """Return the attributes that differ for values, `None` if elements do."""
        return SAME if not self._domain.allows(point) else self.compared(point)[1]

    def compared(self, point: Point) -> tuple[Element | None, Unlike | None]:
        """Return the document for values, and the attributes that differ; `None`: elements do."""
        document = self._concrete(point)
        if document is None:
            return None, None
        shown = {
            p.name: float(value)
            for p in self._domain.parameters
            if isinstance(value := point[p.key], (int, float))
        }
        places = differences(self.document, document, shown)
        return document, places if places is None else self.limits.taken_from(places, document)
