"""Values that open parameters may have together: rows of a table, one for each run.

All combinations would be 5^n rows. Instead there are ten for each parameter, and one: a Latin
hypercube. In it each parameter goes from end to end at equal steps and has each value once, while
the orders are those of Halton sequences, so that all corners of the domain are visited. It is
deterministic. Rows that break a constraint are left out, and denser tables tried instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import product
from math import prod
from typing import NamedTuple

from osc2tx import ir
from osc2tx.backends.xosc.logical.parameters import OpenParameter, Point
from osc2tx.backends.xosc.scopes import Scope, open_scopes
from osc2tx.backends.xosc.values.constants import Constant
from osc2tx.backends.xosc.values.folding import Values
from osc2tx.losses.entries import Inexpressible
from osc2tx.options import XmlVersion
from osc2tx.support.latin_hypercube import hypercube, thinned
from osc2tx.xosc.arithmetic import Range
from osc2tx.xosc.expressions import LONGEST

RUNS_EACH = 10
"""Steps of a table for each parameter."""

NUDGE = 0.0137
"""Distance of a place next to another one."""

GOLDEN = 0.618034
"""Its multiples, without whole parts, are all different."""

DENSEST = 64
"""So many times more rows are tried where constraints leave out most."""

MOST_VALUES = 10_000
"""Of a table; with more parameters it has fewer rows."""

MOST_TRIED = 20_000
"""Values that are tried, in all rows of a table together."""

FEWEST_ROWS = 11


class Row(NamedTuple):
    """Places of the parameters between their first (0) and last value (1), and the values."""

    shares: tuple[float, ...]
    point: Point


class Domain:
    """What the open parameters of a scenario may be together."""

    def __init__(
        self,
        scenario: ir.Scenario,
        module: ir.Module,
        parameters: Sequence[OpenParameter],
        folded: Point | None = None,
    ) -> None:
        """Take the parameters, those first that others are computed from.

        Args:
            scenario: The scenario.
            module: Where it stands.
            parameters: Those that may have several values.
            folded: Values of its other open parameters.
        """
        self.parameters = tuple(parameters)
        self._scenario = scenario
        self._module = module
        self._folded = dict(folded or {})
        scopes = open_scopes(scenario, module, self._folded).all()
        self._plain = {scope.path: scope.values for scope in scopes}
        self._is_constrained = any(scope.scenario.constraints for scope in scopes)

    def narrowed(self, parameters: Sequence[OpenParameter], folded: Point) -> Domain:
        """Return the domain of some of the parameters, for values of the others."""
        if tuple(parameters) == self.parameters and folded == self._folded:
            return self
        return Domain(self._scenario, self._module, parameters, folded)

    @property
    def is_joint(self) -> bool:
        """Whether values depend on each other."""
        return self._is_constrained or any(p.is_dependent for p in self.parameters)

    @property
    def most_rows(self) -> int:
        """Rows of a table."""
        number = len(self.parameters)
        return min(RUNS_EACH * number + 1, max(MOST_VALUES // max(number, 1), FEWEST_ROWS))

    def values(self, parameter: OpenParameter, point: Point | None = None) -> Values:
        """Return the constants of the scope of a parameter, for values of others."""
        if point is None or not parameter.is_dependent:
            return self._plain[parameter.path]
        scopes = open_scopes(self._scenario, self._module, point).all()
        return next(scope.values for scope in scopes if scope.path == parameter.path)

    def at(self, shares: Sequence[float]) -> Point:
        """Return the values at places between the first and the last one of each parameter."""
        point = dict(self._folded)
        for parameter, share in zip(self.parameters, shares, strict=True):
            point[parameter.key] = parameter.at(share, self.values(parameter, point))
        return point

    def ranges(self) -> dict[str, Range]:
        """Return between which numbers the parameters are, by their names in the document."""
        found: dict[str, Range] = {}
        ends = [self.at([share] * len(self.parameters)) for share in (0.0, 1.0)]
        for parameter in self.parameters:
            if parameter.is_number:
                each = [parameter.limits(self.values(parameter, point)) for point in ends]
                found[parameter.name] = Range(min(e[0] for e in each), max(e[1] for e in each))
        return found

    def allows(self, point: Point) -> bool:
        """Whether values are within their bounds and agree with the constraints between them."""
        return all(self._is_within(p, point) for p in self.parameters if p.is_dependent) and all(
            _is_kept(scope) for scope in open_scopes(self._scenario, self._module, point).all()
        )

    def _is_within(self, parameter: OpenParameter, point: Point) -> bool:
        low, high = parameter.limits(self.values(parameter, point))
        value = point[parameter.key]
        return isinstance(value, (int, float)) and low <= value <= high

    def nominal(self, *, is_beside: bool = False) -> Point | None:
        """Return values for declarations: of ranges the middle or next to it, of sets the first.

        If constraints do not allow that, it is the middle one of all rows; `None` without any.
        """
        middle = self.row([0.0 if p.choices else 0.5 for p in self.parameters])
        point = self.beside(middle).point if is_beside else middle.point
        if not self._is_constrained or self.allows(point):
            return point
        rows = self.rows
        return rows[len(rows) // 2].point if rows else None

    # --- rows ---

    @cached_property
    def rows(self) -> Sequence[Row]:
        """Values for runs: all combinations of sets if they are few, else a sample."""
        listed = [p.choices for p in self.parameters]
        if all(listed) and prod(map(len, listed)) <= self.most_rows:
            shares = product(*([i / len(each) for i in range(len(each))] for each in listed))
            return [row for row in map(self.row, shares) if self.allows(row.point)]
        wanted, density, number = self.most_rows, 1, len(self.parameters)
        while True:
            candidates = map(self.row, hypercube(number, (wanted - 1) * density + 1))
            found = [row for row in candidates if not self.is_joint or self.allows(row.point)]
            if len(found) >= wanted:
                break
            density *= 2
            if density > DENSEST or wanted * density * number > MOST_TRIED:
                break
        return sorted(thinned(found, wanted), key=self._order)

    def row(self, shares: Sequence[float]) -> Row:
        """Return the row for places between the first and the last value of each parameter."""
        return Row(tuple(shares), self.at(shares))

    def _order(self, row: Row) -> tuple[float, ...]:
        """Return a key that sorts rows by the values of the parameters, the first one first."""
        places = zip(self.parameters, row.shares, strict=True)
        return tuple(
            p.choices.index(row.point[p.key]) if p.choices else share for p, share in places
        )

    def beside(self, row: Row) -> Row:
        """Return a row next to another one, in case that has something special about it."""
        places = enumerate(zip(self.parameters, row.shares, strict=True))
        return self.row([s if p.choices else inward(s, index) for index, (p, s) in places])


def inward(share: float, index: int = 0) -> float:
    """Return a place next to another one, farther from the ends; of each parameter another one."""
    nudge = NUDGE * (1.0 + (index * GOLDEN) % 1.0)
    return share + (nudge if share < 0.5 else -nudge)


def _is_kept(scope: Scope) -> bool:
    """Whether the constraints of a scenario hold for the values in a scope."""
    for constraint in scope.scenario.constraints:
        try:
            if not scope.values.of(constraint.expression):
                return False
        except Inexpressible:  # it is about something else, which is only known during the run
            continue
    return True


class Choosing:
    """The open parameters of a scenario and how they are chosen for one document.

    Attributes:
        parameters: All of them.
        kept: Those that are parameters of the document; the others have just one value there.
        point: The value of each.
    """

    def __init__(
        self, parameters: Sequence[OpenParameter], kept: Sequence[OpenParameter], point: Point
    ) -> None:
        self.parameters = tuple(parameters)
        self.kept = tuple(kept)
        self.point = point
        self._drawn = {(p.path, p.site): p for p in parameters}

    def given(self, version: XmlVersion) -> dict[str, Constant]:
        """Return what stands for the parameters, by their keys."""
        longest = LONGEST if version >= "1.1" else 0  # 1.0 has no expressions
        symbols = {p.key: p.symbol(self.point[p.key], longest) for p in self.kept}
        return {**self.point, **symbols}

    def drawn(self, scope: Scope, node: ir.Behavior | ir.ModifierCall) -> OpenParameter | None:
        """Return the parameter that chooses a member, or the side of a lane change."""
        return self._drawn.get((scope.path, node.span))


NOTHING_OPEN = Choosing((), (), {})
