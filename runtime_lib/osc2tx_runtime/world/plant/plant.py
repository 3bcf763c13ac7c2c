"""The interface between commanded and measured states, implemented by simulators.

The world turns commands into the states of its actors at the end of a step. A plant realizes and
measures them: CARLA, another simulator, a vehicle model. `Identity` realizes them exactly.

An actor has one control mode. `exact`: it has the commanded state. `exact-physics`: the same, as a
rigid body moved by its velocities. `driven`: a controller follows the commanded states, and the
actor is measured. `external` and `autopilot`: it has another driver, and is only measured.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.checks.values import CheckedCalls, problem_of
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.scene import Scene
from osc2tx_runtime.world.protocol import FEATURES, ActorSpec, ControlMode, Feature

__all__ = ["Identity", "Measurement", "Plant"]


class Plant(Protocol):
    """Moves the actors of a world.

    Attributes:
        name: For the header of the trace: `carla 0.9.16`.
    """

    name: str

    def control(self, actor: str) -> ControlMode:
        """The control mode of an actor, at the present step."""

    def capabilities(self) -> frozenset[Feature]:
        """Its capabilities besides moving actors."""

    def shape(self, spec: ActorSpec) -> Shape | None:
        """Size of an actor, requested before it is placed; None: that of the scenario."""

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Sets the actors to their start, after the last placement and before step 0.

        Returns:
            The states of those actors that differ from the commanded ones.

        Raises:
            SimulatorError: It cannot.
        """

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Advances by one step, and measures.

        Returns:
            As of `begin`.

        Raises:
            SimulatorError: The simulator is lost.
        """

    def close(self) -> None:
        """Restores the simulator; called once at the end of each run, started or not."""


class Identity:
    """All actors have their commanded states: the embedded world."""

    name = "embedded"

    def control(self, actor: str) -> ControlMode:
        """Always `exact`."""
        return "exact"

    def capabilities(self) -> frozenset[Feature]:
        """All there are."""
        return FEATURES

    def shape(self, spec: ActorSpec) -> Shape | None:
        """The shape of the scenario."""
        return None

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Nothing to measure."""
        return {}

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Nothing to measure."""
        return {}

    def close(self) -> None:
        """Nothing to leave."""


class CheckedPlant:
    """Passes all calls on to a plant, and names it in errors about its results.

    Args:
        plant: The plant.

    Attributes:
        name: Name of the plant.
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
        """Sets the actors to their start."""
        return self._measured("begin", lambda: self._plant.begin(scene), scene)

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Advances by one step."""
        return self._measured("moved", lambda: self._plant.moved(scene), scene)

    def close(self) -> None:
        """Closes the plant."""
        self._calls.ask("close", self._plant.close, Any)

    def _measured(
        self, method: str, call: Callable[[], Mapping[str, Measurement]], scene: Scene
    ) -> Mapping[str, Measurement]:
        found = self._calls.ask(method, call, Mapping)
        for actor, measurement in found.items():
            if actor not in scene.setpoints:
                self._calls.refuse(method, f"measures {actor!r:.40}, which is not an actor")
            problem = problem_of(measurement, Measurement)
            if problem:
                self._calls.refuse(method, f"{actor}: {problem}")
        return found
