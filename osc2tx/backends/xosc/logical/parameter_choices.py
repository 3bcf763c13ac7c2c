"""Values of open parameters that are chosen for one document."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.backends.xosc.logical.parameters import OpenParameter, Point
from osc2tx.backends.xosc.scopes import Scope
from osc2tx.backends.xosc.values.constants import Constant
from osc2tx.options import XmlVersion
from osc2tx.xosc.expressions import LONGEST


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
