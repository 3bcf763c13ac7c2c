"""Joint choice of alternatives, if durations around several `one_of` require it.

Two of them in a `serial` of a given duration, in scenarios that it invokes, or in members that are
equally long: only a joint choice shows which alternatives fit (§7.6.2.1, §7.6.2.4). Before a run,
the lengths of the parts of a tree are computed for each choice; one of the choices with which all
durations hold is drawn. Nothing is chosen if the default fits, if no choice fits, or if only the
run determines a length.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import NamedTuple, TypeAlias

from osc2tx_runtime.clock import is_longer
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.tree.base import Behaviour, Node
from osc2tx_runtime.language.tree.compositions import Composition, Serial
from osc2tx_runtime.language.tree.members import is_service
from osc2tx_runtime.language.tree.one_of import OneOf
from osc2tx_runtime.language.tree.parallel import Parallel

MOST_CHOICES = 4096


class _Option(NamedTuple):
    """Duration (s) of a part of a tree, with its alternatives."""

    seconds: float
    chosen: tuple[tuple[OneOf, Behaviour], ...] = ()


_Options: TypeAlias = list[_Option]


class _Unknown(Exception):
    """Only the run determines a duration."""


def choose_alternatives(root: Behaviour, context: ExecutionContext) -> None:
    """Choose the alternatives that durations around them relate to each other.

    Args:
        root: The tree of a run; its nodes need not be set up.
        context: Of the run.
    """
    if not context.first_come and any(isinstance(each, OneOf) for each in root.iterate()):
        _Choice(context).look_at(root)


class _Choice:
    def __init__(self, context: ExecutionContext) -> None:
        self._context = context
        self._shortest: dict[OneOf, Behaviour] = {}

    def look_at(self, node: Behaviour) -> None:
        """Choose in a part of the tree whose lengths are known, or in the parts of it."""
        try:
            options = self._options(node)
        except _Unknown:
            for child in node.children:
                self.look_at(child)
            return
        if not options or len(options[0].chosen) < 2 or any(map(self._is_natural, options)):
            return
        index = 0
        if self._context.one_of != "first":
            index = self._context.random_for("alternatives").randrange(len(options))
        for one_of, chosen in options[index].chosen:
            one_of.choose(chosen)

    def _is_natural(self, option: _Option) -> bool:
        """Whether a race has these winners by default."""
        is_race = self._context.one_of == "race"
        return is_race and all(self._shortest[one_of] is child for one_of, child in option.chosen)

    def _options(self, node: Behaviour) -> _Options:
        """Return the possible durations of a node.

        Raises:
            _Unknown: Only the run determines them.
        """
        known = node.seconds() if isinstance(node, Node) else None
        if known is not None:
            return [_Option(known)]
        if not isinstance(node, Composition):
            raise _Unknown
        match node:
            case OneOf():
                options = self._alternatives(node)
            case Parallel(overlap="start" | "equal", start_to_start=None, end_to_end=None):
                options = list(self._parallel(node))
            case Serial():
                options = [
                    _Option(sum(each.seconds for each in members), _together(members))
                    for members in self._combined([*node.children])
                ]
            case _:
                raise _Unknown
        limits = node.limits
        if limits is None:
            return options
        if limits.until:
            raise _Unknown
        low, high = limits.seconds
        return [each for each in options if self._lies_within(each.seconds, low, high)]

    def _alternatives(self, node: OneOf) -> _Options:
        options = list[_Option]()
        shortest = dict[Behaviour, float]()
        for child in node.children:
            for each in self._options(child):
                options.append(_Option(each.seconds, ((node, child), *each.chosen)))
                shortest[child] = min(each.seconds, shortest.get(child, each.seconds))
        if shortest:
            self._shortest[node] = min(shortest, key=shortest.__getitem__)
        return options

    def _parallel(self, node: Parallel) -> Iterator[_Option]:
        for members in self._combined([c for c in node.children if not is_service(c)]):
            lasting = [each.seconds for each in members if each.seconds] or [0.0]
            most = max(lasting)
            if node.overlap == "start" or self._lies_within(min(lasting), most, most):
                yield _Option(most, _together(members))

    def _combined(self, members: list[Behaviour]) -> Iterator[tuple[_Option, ...]]:
        found = [self._options(member) for member in members]
        count = 1
        for options in found:
            count *= max(len(options), 1)
        if count > MOST_CHOICES:
            raise _Unknown
        return product(*found)

    def _lies_within(self, seconds: float, low: float, high: float) -> bool:
        dt = self._context.dt
        return not is_longer(low, seconds, dt) and not is_longer(seconds, high, dt)


def _together(members: tuple[_Option, ...]) -> tuple[tuple[OneOf, Behaviour], ...]:
    return tuple(choice for each in members for choice in each.chosen)
