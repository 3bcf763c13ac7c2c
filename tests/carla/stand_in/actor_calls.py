"""Calls about actors of any kind. Methods have the calls' names."""

from __future__ import annotations

import math
from typing import Any

from .simulation import Simulation


class ActorCalls:
    """Spawning, finding, placing, destroying."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._actor = simulation.actor

    def get_spectator(self) -> list[Any]:
        return self._simulation.described(self._simulation.spectator)

    def get_actors_by_id(self, ids: list[int]) -> list[Any]:
        actors = self._simulation.actors
        return [self._simulation.described(actors[each]) for each in ids if each in actors]

    def get_actor_bounding_box(self, actor: int) -> list[Any]:
        return self._simulation.box(self._actor(actor))

    def spawn_actor(self, description: list[Any], pose: list[Any]) -> list[Any]:
        return self._simulation.described(self._simulation.spawn(description, pose))

    def spawn_actor_with_parent(
        self, description: list[Any], pose: list[Any], parent: int, *attachment: Any
    ) -> list[Any]:
        holder = self._actor(parent)
        child = self._simulation.spawn(description, pose, holder.id)
        return self._simulation.described(child)

    def destroy_actor(self, actor: int) -> bool:
        self._simulation.destroy(actor)
        return True

    def set_actor_transform(self, actor: int, pose: list[Any]) -> None:
        moved = self._actor(actor)
        moved.location, moved.rotation = list(pose[0]), list(pose[1])

    def set_actor_location(self, actor: int, location: list[float]) -> None:
        self._actor(actor).location = list(location)

    def set_actor_target_velocity(self, actor: int, velocity: list[float]) -> None:
        if self._actor(actor).physics:
            self._actor(actor).velocity = list(velocity)

    def set_actor_target_angular_velocity(self, actor: int, turning: list[float]) -> None:
        if self._actor(actor).physics:
            self._actor(actor).turning = list(turning)

    def set_actor_simulate_physics(self, actor: int, enabled: bool) -> None:
        self._actor(actor).physics = enabled

    def set_actor_enable_gravity(self, actor: int, enabled: bool) -> None:
        self._actor(actor).gravity = enabled

    def set_actor_collisions(self, actor: int, enabled: bool) -> None:
        self._actor(actor)

    def enable_actor_constant_velocity(self, actor: int, velocity: list[float]) -> None:
        self._actor(actor).constant = list(velocity)

    def disable_actor_constant_velocity(self, actor: int) -> None:
        self._actor(actor).constant = None

    def set_walker_state(self, actor: int, pose: list[Any], speed: float) -> None:
        """Put a walker with its feet at a place, and have it walk where it looks."""
        walker = self._actor(actor)
        (x, y, z), (pitch, yaw, roll) = pose
        walker.location, walker.rotation = [x, y, z + walker.extent[2]], [pitch, yaw, roll]
        ahead = [math.cos(walker.yaw), math.sin(walker.yaw), 0.0]
        walker.walk = [ahead, speed, False]

    def apply_control_to_walker(self, actor: int, control: list[Any]) -> None:
        self._actor(actor).walk = list(control)
