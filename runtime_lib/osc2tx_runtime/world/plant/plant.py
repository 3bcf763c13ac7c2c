"""The seam between wished and real states: what a simulator fills.

The world turns commands into the states that its actors are to have at the end of a step. A plant
brings them about, and measures what has become of them: CARLA, another simulator, a vehicle model.
`Identity` carries them out as they are.

An actor is under one control. `exact`: it is where it is wished. `exact-physics`: so, too, as a
rigid body that its velocities bring there. `driven`: a controller has it
follow the wished states, and it is measured. `external` and `autopilot`: somebody else drives it,
it is only measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.protocol import FEATURES, ActorSpec, ControlMode, Feature

from .scene import Scene

__all__ = ["Identity", "Measurement", "Plant"]


class Plant(Protocol):
    """What moves the actors of a world.

    Attributes:
        name: For the header of the trace: `carla 0.9.16`.
    """

    name: str

    def control(self, actor: str) -> ControlMode:
        """Who moves an actor, at the present step."""

    def capabilities(self) -> frozenset[Feature]:
        """What it has beside moving actors."""

    def shape(self, spec: ActorSpec) -> Shape | None:
        """Size of an actor, asked for before it is placed; None: that of the scenario."""

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Puts the actors where they start, after the last placement and before step 0.

        Returns:
            Those of its actors that are not exactly where they were wished.

        Raises:
            SimulatorError: If it cannot.
        """

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Goes one step on, and measures.

        Returns:
            As of `begin`.

        Raises:
            SimulatorError: If the simulator is lost.
        """

    def close(self) -> None:
        """Leaves the simulator as it was; called once, however the run ends, begun or not."""


class Identity:
    """All actors are where they are wished: the embedded world."""

    name = "embedded"

    def control(self, actor: str) -> ControlMode:
        """Always `exact`."""
        return "exact"

    def capabilities(self) -> frozenset[Feature]:
        """All there are."""
        return FEATURES

    def shape(self, spec: ActorSpec) -> Shape | None:
        """That of the scenario."""
        return None

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Nothing to measure."""
        return {}

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Nothing to measure."""
        return {}

    def close(self) -> None:
        """Nothing to leave."""
