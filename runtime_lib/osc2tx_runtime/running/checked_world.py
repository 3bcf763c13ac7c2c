"""A third-party world whose results are checked, as the run computes with them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, cast

from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.checks.values import CheckedCalls
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.world.measuring.kinematics import Kinematics
from osc2tx_runtime.world.protocol import LightState, Progress, World
from osc2tx_runtime.world.state import ActorState

# Types of attributes, and of results of methods; other results are not used.
ANSWERS: Mapping[str, Any] = {
    "actors": Sequence[str],
    "capabilities": frozenset,
    "changed": Collection[str],
    "collisions": Sequence[tuple[str, str]],
    "control": str,
    "dt": float,
    "environment": Mapping[str, float],
    "lights": LightState,
    "map": RoadMap,
    "motion": Kinematics,
    "name": str,
    "overloads": Sequence[Any],
    "progress": Progress,
    "set_lights": LightState,
    "state": ActorState,
    "take_notes": Sequence[tuple[str, Mapping[str, Any]]],
    "trailer_of": str | None,
    "unsteady": Collection[str],
    "warnings": Sequence[str],
}

_OF_A_WORLD = {name: member for name, member in vars(World).items() if not name.startswith("_")}
METHODS = frozenset(name for name, member in _OF_A_WORLD.items() if callable(member))
ATTRIBUTES = (_OF_A_WORLD.keys() | set(World.__annotations__)) - METHODS


def checked_world(world: object) -> World:
    """Return a world whose errors name it when it fails or returns invalid results.

    The embedded world needs no checks: it checks the results of its plant.
    """
    if type(world) is EmbeddedWorld:
        return world
    return cast(World, _CheckedWorld(world))


class _CheckedWorld:
    """Passes all calls on to a third-party world."""

    def __init__(self, world: object) -> None:
        self._world = world
        self._calls = CheckedCalls("world", world)

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the world; methods check their results."""
        if name.startswith("_"):
            raise AttributeError(name)
        found = self._calls.ask(name, lambda: getattr(self._world, name), Any)
        wanted = ANSWERS.get(name, Any)
        if name in METHODS and not callable(found):
            self._calls.refuse(name, "is not a method")
        if name in METHODS or (callable(found) and name not in ATTRIBUTES):
            return self._method(name, found, wanted)
        return self._calls.ask(name, lambda: found, wanted)

    def _method(self, name: str, function: Callable[..., Any], wanted: Any) -> Callable[..., Any]:
        def call(*arguments: Any, **more: Any) -> Any:
            return self._calls.ask(name, lambda: function(*arguments, **more), wanted)

        self.__dict__[name] = call  # looked up once
        return call
