"""Invocations that are created when they start.

The arguments of a scenario may depend on the state of the world at that time. A scenario may also
invoke itself: a tree that contains itself would be infinite. Depth and number are limited: beyond
them the invocation fails, which removes an alternative of a `one_of`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import FunctionType
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.tree.assembly import invoked_placements, state_at_start
from osc2tx_runtime.language.tree.base import RUNNING, Behaviour, Node, Status
from osc2tx_runtime.language.tree.members import ended_late, pulse_of

if TYPE_CHECKING:
    from osc2tx_runtime.language.scenario_parts import ScenarioParts
    from osc2tx_runtime.language.tree.invocation import Invocation

MOST_LEVELS = 30
"""Levels of one scenario within itself."""

MOST_INVOCATIONS = 1000
"""Invocations of all scenarios within themselves, in one run."""


def is_recursive(scenario: ScenarioParts, invoked: type[ScenarioParts]) -> bool:
    """Return whether a scenario is invoked by itself, directly or indirectly."""
    return levels(scenario, invoked) > 0


def levels(scenario: ScenarioParts, invoked: type[ScenarioParts]) -> int:
    """Return the number of enclosing scenarios of a class."""
    found, current = 0, scenario
    while True:
        found += type(current) is invoked
        if current._caller is None:
            return found
        current = current._caller.scenario


def late_arguments(given: Mapping[str, Any]) -> set[str]:
    """Return the names of arguments that are functions: they are evaluated when it starts."""
    return {name for name, value in given.items() if isinstance(value, FunctionType)}


class LateInvocation(Node):
    """An invocation that is created when it starts.

    Args:
        name: As of the invocation.
        caller: The scenario that invokes.
        invoked: The classes to choose from: its own, and conditional ones.
        make: Creates the invocation.
    """

    def __init__(
        self,
        name: str,
        caller: ScenarioParts,
        invoked: Sequence[type[ScenarioParts]],
        make: Callable[[], Invocation],
    ) -> None:
        super().__init__(name)
        self.label = name
        self._caller_scenario = caller
        self._invoked = invoked
        self._make = make
        self._pulse_child: Callable[[], Status] | None = None

    def length(self) -> int | None:
        """Return None: only the run determines it."""
        return None

    def initialise(self) -> None:
        """Create the invocation, unless there are too many."""
        self.children, self._pulse_child = [], None
        root = self._caller_scenario._root
        root._recursions += 1
        around = (levels(self._caller_scenario, each) for each in self._invoked)
        is_deep = any(depth > MOST_LEVELS for depth in around)
        if is_deep or root._recursions > MOST_INVOCATIONS:
            return
        known = set(root.actors)
        made = self._make()
        if set(root.actors) != known:
            raise UnsupportedError(
                f"{made.scenario.name} declares actors of its own in an invocation that is made"
                " when it starts: pass them as arguments",
                self.source or None,
            )
        for placement in invoked_placements(root, made):
            if not placement.throughout and not placement.implied:
                state_at_start(made, placement, root.one_of == "race")
        self.children = [made]
        made.parent = self
        for node in made.iterate():
            node.setup(context=self.context)
            if isinstance(node, Node):
                node.position = self.position
        self._pulse_child = pulse_of(made)

    def lateness(self) -> float:
        """Return that of the invocation."""
        return ended_late(self.children[0]) if self.children else 0.0

    def pulse(self) -> Status:
        """Run the invocation for one pass."""
        if self.status is not RUNNING:
            self._begin()
        resting = self.context.resting.nodes
        if self._pulse_child is None:
            status = self.fail(
                f"{self._invoked[0].name} invokes itself more than {MOST_LEVELS} levels deep, or"
                f" more than {MOST_INVOCATIONS} times in all"
            )
        else:
            child: Behaviour = self.children[0]
            status = RUNNING if child in resting else self._pulse_child()
            if child in resting:
                resting.add(self)
        if status is not RUNNING:
            self.stop(status)
        return self.status
