"""Values of open parameters that are chosen for one document."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from osc2tx import ir
from osc2tx.backends.xosc.logical.parameters import OpenParameter, Point
from osc2tx.backends.xosc.scopes import Scope
from osc2tx.backends.xosc.values.constants import Constant
from osc2tx.options import XmlVersion


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
        self._branches: dict[tuple[str, Hashable], OpenParameter] = {
            (p.path, p.node.span): p for p in parameters if p.node is not None
        }
        self._sides: dict[tuple[str, Hashable], OpenParameter] = {
            (p.path, p.change.span): p for p in parameters if p.change is not None
        }

    def given(self, version: XmlVersion) -> dict[str, Constant]:
        """Return what stands for the parameters, by their keys."""
        symbols = {p.key: p.symbol(self.point[p.key], version) for p in self.kept}
        return {**self.point, **symbols}

    def branch(self, scope: Scope, node: ir.OneOf) -> OpenParameter | None:
        """Return the parameter that chooses a member."""
        return self._branches.get((scope.path, node.span))

    def side(self, scope: Scope, change: ir.Invoke | ir.ModifierCall) -> Constant | None:
        """Return the side to which a lane is changed that says none."""
        parameter = self._sides.get((scope.path, change.span))
        return None if parameter is None else self.point[parameter.key]


NOTHING_OPEN = Choosing((), (), {})
