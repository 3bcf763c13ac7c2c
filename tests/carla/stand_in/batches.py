"""Many commands in one call."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from .actor_calls import ActorCalls
from .rpc import CallError
from .signal_calls import SignalCalls
from .simulation import Simulation
from .vehicle_calls import VehicleCalls

SPAWN = 0


class BatchCalls:
    """Batches. A command is `[[number, fields]]`; its number is its place in the library."""

    def __init__(
        self,
        simulation: Simulation,
        actors: ActorCalls,
        vehicles: VehicleCalls,
        signals: SignalCalls,
    ) -> None:
        self._simulation = simulation
        self._commands: dict[int, Callable[..., object]] = {
            1: actors.destroy_actor,
            2: vehicles.apply_control_to_vehicle,
            3: vehicles.apply_ackermann_control_to_vehicle,
            4: actors.apply_control_to_walker,
            5: vehicles.apply_physics_control,
            6: actors.set_actor_transform,
            7: actors.set_walker_state,
            8: actors.set_actor_target_velocity,
            9: actors.set_actor_target_angular_velocity,
            14: actors.set_actor_simulate_physics,
            15: actors.set_actor_enable_gravity,
            16: vehicles.set_actor_autopilot,
            18: vehicles.set_vehicle_light_state,
            19: actors.set_actor_location,
            21: signals.set_traffic_light_state,
        }

    def apply_batch(self, commands: list[Any], tick: bool = False) -> list[Any]:
        results: list[Any] = []
        for ((number, fields),) in commands:
            try:
                results.append([[1, self._carry_out(number, fields)]])
            except CallError as error:
                results.append([[0, [str(error)]]])
        if tick:
            self._simulation.step()
        return results

    def _carry_out(self, number: int, fields: list[Any]) -> int:
        """Return the id of the actor that a command is about."""
        if number == SPAWN:
            return self._spawn(fields)
        if number not in self._commands:
            raise CallError(f"the stand-in does not know command {number} of batches")
        self._commands[number](*fields)
        return int(fields[0])

    def _spawn(self, fields: list[Any]) -> int:
        description, pose, parent, *_, following = fields
        actor = self._simulation.spawn(description, pose, parent[1] if parent[0] else 0)
        for ((number, (_, *rest)),) in following:
            if number not in self._commands:
                raise CallError(f"the stand-in does not know command {number} of batches")
            with suppress(CallError):  # who spawned an actor hears of no failure of the rest
                self._carry_out(number, [actor.id, *rest])
        return actor.id
