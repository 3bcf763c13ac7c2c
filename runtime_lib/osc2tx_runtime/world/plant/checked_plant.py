"""A plant whose answers are checked: it is third-party code."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.checks.values import CheckedCalls, problem_of
from osc2tx_runtime.world.protocol import FEATURES, ActorSpec, ControlMode, Feature

from .plant import Measurement, Plant
from .scene import Scene


class CheckedPlant:
    """Hands every call on to a plant, and names it when it answers garbage or fails.

    Args:
        plant: The plant.

    Attributes:
        name: Of the plant.
    """

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._calls = CheckedCalls("plant", plant)
        self.name = self._calls.ask("name", lambda: plant.name, str)

    def control(self, actor: str) -> ControlMode:
        """The control mode of an actor."""
        return self._calls.ask("control", lambda: self._plant.control(actor), ControlMode)

    def capabilities(self) -> frozenset[Feature]:
        """Its capabilities besides moving actors."""
        found = self._calls.ask("capabilities", self._plant.capabilities, frozenset)
        unknown = [str(each) for each in found if each not in FEATURES]
        if unknown:
            self._calls.refuse("capabilities", f"has {min(unknown)!r}")
        return found

    def shape(self, spec: ActorSpec) -> Shape | None:
        """Size of an actor."""
        return self._calls.ask("shape", lambda: self._plant.shape(spec), Shape | None)

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Puts the actors where they start."""
        return self._measured("begin", lambda: self._plant.begin(scene), scene)

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Goes one step on."""
        return self._measured("moved", lambda: self._plant.moved(scene), scene)

    def close(self) -> None:
        """Leaves the simulator."""
        self._calls.ask("close", self._plant.close, Any)

    def _measured(
        self, method: str, call: Callable[[], Mapping[str, Measurement]], scene: Scene
    ) -> Mapping[str, Measurement]:
        found = self._calls.ask(method, call, Mapping)
        for actor, measurement in found.items():
            if actor not in scene.setpoints:
                self._calls.refuse(method, f"measures {actor!r:.40}, which is no actor")
            problem = problem_of(measurement, Measurement)
            if problem:
                self._calls.refuse(method, f"{actor}: {problem}")
        return found
