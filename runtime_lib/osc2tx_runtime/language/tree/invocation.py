"""The invocation of a scenario by another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.language.declared import BaseActor
from osc2tx_runtime.language.tree.base import Behaviour, Node
from osc2tx_runtime.language.tree.compositions import Serial
from osc2tx_runtime.language.tree.duration_limits import Duration
from osc2tx_runtime.language.tree.members import is_instant, is_service
from osc2tx_runtime.language.tree.one_of import OneOf
from osc2tx_runtime.language.tree.parallel import Parallel

if TYPE_CHECKING:
    from osc2tx_runtime.language.scenario_parts import ScenarioParts


class Invocation(Serial):
    """Runs the tree of an invoked scenario; one node of the caller's tree.

    Its descendants belong to the invoked scenario: its positions, labels and events.

    Args:
        name: Label, or actor and scenario.
        scenario: The invoked scenario.
        body: Its tree.
        duration: Its duration: seconds, or (least, most) seconds.
    """

    def __init__(
        self, name: str, scenario: ScenarioParts, body: Behaviour, duration: Duration | None = None
    ) -> None:
        super().__init__(name, body, duration=duration)
        self.scenario = scenario


def draw_key(
    caller: ScenarioParts,
    invoked: type[ScenarioParts],
    actor: BaseActor | None,
    arguments: Mapping[str, Any],
) -> str:
    """Return the key of the draws of an invoked scenario: `ego vehicle.approach(lead: car1)`.

    It only contains names in the module. Without values in it, setting or drawing one does not
    change other draws.
    """
    fields = {
        id(value): name for name, value in vars(caller).items() if isinstance(value, BaseActor)
    }
    shown = [
        f"{name}: {fields[id(value)]}" if id(value) in fields else name
        for name, value in arguments.items()
    ]
    who = "" if actor is None else f"{fields.get(id(actor), actor.id)} "
    return f"{who}{invoked.name}({', '.join(shown)})"


def unique_name(name: str, taken: Mapping[str, object]) -> str:
    """Return `name`, or `name_2` and so on if it is taken.

    The number is found by bisection.
    """
    if name not in taken:
        return name
    last, free = 1, 2
    while f"{name}_{free}" in taken:
        last, free = free, 2 * free
    while free - last > 1:
        middle = (last + free) // 2
        if f"{name}_{middle}" in taken:
            last = middle
        else:
            free = middle
    return f"{name}_{free}"


def own_nodes(root: Behaviour) -> Iterator[Node]:
    """Yield the nodes of a scenario, parents first, without those of the scenarios it invokes."""
    if isinstance(root, Node):
        yield root
    if not isinstance(root, Invocation):
        for child in root.children:
            yield from own_nodes(child)


def started_at_once(
    node: Behaviour, race: bool, at_once: bool = True
) -> Iterator[tuple[Behaviour, bool]]:
    """Yield the nodes of a tree, parents first, and whether they certainly start with it.

    Args:
        node: Root of the tree.
        race: All members of a `one_of` start.
        at_once: The root does.
    """
    yield node, at_once
    for child, first in zip(node.children, starts_at_once(node, race), strict=True):
        yield from started_at_once(child, race, at_once and first)


def starts_at_once(node: Behaviour, race: bool) -> list[bool]:
    """Return for each member whether it certainly starts with the composition."""
    members = node.children
    if isinstance(node, Serial):
        instant = [is_instant(child) for child in members]
        return [all(instant[:index]) for index in range(len(members))]
    if isinstance(node, Parallel):
        if node.overlap in ("end", "final") or node.end_to_end is not None:
            return [False] * len(members)
        offset = node.start_to_start
        low = offset[0] if isinstance(offset, tuple) else offset or 0.0
        return [low == 0 or (low > 0 and index == 0) for index in range(len(members))]
    if isinstance(node, OneOf):
        return [race] * len(members)
    return [len(members) == 1 and not is_service(node)] * len(members)
