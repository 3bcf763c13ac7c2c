"""A plant whose answers are checked: it is the code of somebody else."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from osc2tx_runtime.errors import OwnCode, ScenarioError, is_own, name_of

from .actor_dimensions import Shape
from .features import FEATURES, Feature
from .plant import Measurement, Plant
from .protocol import ActorSpec, ControlMode
from .scene import Scene
from .value_checks import problem_of

__all__ = ["CheckedPlant"]

T = TypeVar("T")


class CheckedPlant:
    """Hands every call on to a plant, and names it when it answers garbage or fails.

    Args:
        plant: The plant.

    Attributes:
        name: Of the plant.
    """

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._told = f"the plant {name_of(type(plant))}"
        self.name = self._ask("name", lambda: plant.name, str)

    def control(self, actor: str) -> ControlMode:
        """Who moves an actor."""
        return self._ask("control", lambda: self._plant.control(actor), ControlMode)

    def capabilities(self) -> frozenset[Feature]:
        """What it has beside moving actors."""
        found = self._ask("capabilities", self._plant.capabilities, frozenset)
        unknown = [str(each) for each in found if each not in FEATURES]
        return found if not unknown else self._refuse("capabilities", f"has {min(unknown)!r}")

    def shape(self, spec: ActorSpec) -> Shape | None:
        """Size of an actor."""
        return self._ask("shape", lambda: self._plant.shape(spec), Shape | None)

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Puts the actors where they start."""
        return self._measured("begin", lambda: self._plant.begin(scene), scene)

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Goes one step on."""
        return self._measured("moved", lambda: self._plant.moved(scene), scene)

    def close(self) -> None:
        """Leaves the simulator."""
        self._ask("close", self._plant.close, Any)

    def _measured(
        self, method: str, call: Callable[[], Mapping[str, Measurement]], scene: Scene
    ) -> Mapping[str, Measurement]:
        found = self._ask(method, call, Mapping)
        for actor, measurement in found.items():
            if actor not in scene.setpoints:
                self._refuse(method, f"measures {actor!r:.40}, which is no actor")
            problem = problem_of(measurement, Measurement)
            if problem:
                self._refuse(method, f"{actor}: {problem}")
        return found

    def _ask(self, method: str, call: Callable[[], T], wanted: Any) -> T:
        """Return the answer to a call.

        Raises:
            ScenarioError: It is no such thing, or the plant is the user's own and raises something.
        """
        if not is_own(type(self._plant)):
            found = call()
        else:
            with OwnCode(f"{self._told} raised"):
                found = call()
        problem = problem_of(found, wanted)
        return found if not problem else self._refuse(method, problem)

    def _refuse(self, method: str, problem: str) -> Any:
        raise ScenarioError(f"{self._told}: {method}: {problem}")
