"""Requests about actors: at the end own ones are removed, foreign ones restored."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import carla

from .commands import transform
from .journal import undoes
from .session import Session

PEDALS = ("throttle", "steer", "brake", "hand_brake", "reverse", "manual_gear_shift", "gear")
"""Fields of the control of a vehicle, in the order of its constructor."""

POLL = 0.1  # s between two searches for a foreign actor
OWN, FOREIGN = "own actors", "foreign actors"
"""Kinds of changes."""

SOLID = ("vehicle.", "walker.", "static.prop.")
"""First parts of the blueprints of solid objects."""

ROLLING = 0.1  # m/s of a controlled vehicle


class Actors:
    """Spawns, finds and describes; its methods are requests.

    Args:
        session: A connected session.
    """

    def __init__(self, session: Session) -> None:
        self._session = session

    @property
    def own(self) -> list[int]:
        """Numbers of the actors that the session has spawned."""
        found: list[int] = self._session.journal.changes.get(OWN, [])
        return found

    def blueprints(self) -> Mapping[str, Mapping[str, Sequence[str]]]:
        """Return recommended values of the attributes of all blueprints."""
        return {
            blueprint.id: {
                attribute.id: [str(value) for value in attribute.recommended_values]
                for attribute in blueprint
            }
            for blueprint in self._session.world.get_blueprint_library()
        }

    def spawn(
        self, blueprint: str, attributes: Mapping[str, str], pose: Sequence[float], parent: int = 0
    ) -> Mapping[str, Any]:
        """Spawn an actor of the session, and return its description."""
        description = self._session.world.get_blueprint_library().find(blueprint)
        for name, value in attributes.items():
            description.set_attribute(name, value)
        holder = self._session.world.get_actor(parent) if parent else None
        actor = self._session.world.spawn_actor(description, transform(pose), attach_to=holder)
        self._session.journal.note(OWN, actor.id)
        return self._described(actor)

    def discard(self, actor: int) -> None:
        """Destroy an actor of the session."""
        self._session.client.apply_batch_sync([carla.command.DestroyActor(actor)], False)
        self.own.remove(actor)
        if actor in self._session.watched:
            self._session.watched.remove(actor)

    def find(self, role: str, patience: float) -> Sequence[Mapping[str, Any]]:
        """Return vehicles and walkers of other clients by their role name.

        Empty if none appears in time.
        """
        end = time.monotonic() + patience
        while True:
            found = [
                actor
                for actor in self._session.world.get_actors()
                if actor.type_id.startswith(("vehicle.", "walker."))
                and actor.attributes.get("role_name") == role
                and actor.is_alive
            ]
            if found or time.monotonic() >= end:
                return [self._described(actor) for actor in found]
            time.sleep(POLL)

    def borrow(self, actor_id: int) -> None:
        """Take over a foreign actor: physics, control and lights are restored at the end."""
        actor = self._session.world.get_actor(actor_id)
        before = actor.get_control()
        if isinstance(actor, carla.Vehicle):
            control = [getattr(before, name) for name in PEDALS]
            self._session.journal.note(FOREIGN, [actor_id, control, int(actor.get_light_state())])
        else:
            way = before.direction
            walk = [[way.x, way.y, way.z], before.speed, before.jump]
            self._session.journal.note(FOREIGN, [actor_id, walk, 0])

    def _described(self, actor: Any) -> Mapping[str, Any]:
        found: dict[str, Any] = {"id": actor.id, "type": actor.type_id}
        if isinstance(actor, carla.Vehicle | carla.Walker) or actor.type_id.startswith("static."):
            self._session.watched.append(actor.id)
            box = actor.bounding_box
            found["box"] = [box.location.x, box.extent.x, box.extent.y, box.extent.z]
        if isinstance(actor, carla.Vehicle):  # read before physics is switched off
            wheels = actor.get_physics_control().wheels
            found["wheels"] = [
                [wheel.position.x, wheel.position.y, wheel.max_steer_angle] for wheel in wheels
            ]
            curve = actor.get_physics_control().steering_curve
            found["steering_curve"] = [[point.x, point.y] for point in curve]
        return found

    def controlled(self, actors: Sequence[int]) -> bool:
        """Return whether all these vehicles are controlled."""
        return all(
            actor.get_control().throttle > 0.0 or actor.get_velocity().length() > ROLLING
            for actor in self._session.world.get_actors(list(actors))
            if isinstance(actor, carla.Vehicle)
        )

    def describe(self, actor: int) -> Mapping[str, Any]:
        """Return the description of an actor."""
        return self._described(self._session.world.get_actor(actor))

    def nearby(self, x: float, y: float, radius: float) -> Sequence[Sequence[Any]]:
        """Return id, blueprint and role name of the actors within a radius (m)."""
        here = carla.Location(x, y, 0.0)
        found = []
        for actor in self._session.world.get_actors():
            at = actor.get_location()
            at.z = 0.0
            if at.distance(here) <= radius and actor.type_id.startswith(SOLID):
                found.append([actor.id, actor.type_id, actor.attributes.get("role_name", "")])
        return found

    def watch_collisions(self, actor: int) -> None:
        """Start noting the contacts of an actor."""
        description = self._session.world.get_blueprint_library().find("sensor.other.collision")
        holder = self._session.world.get_actor(actor)
        sensor = self._session.world.spawn_actor(description, carla.Transform(), attach_to=holder)
        self._session.journal.note(OWN, sensor.id)
        sensor.listen(self._session.collisions.add)
        self._session.handles.append(sensor.stop)

    def enable_for_ros(self, sensor: int) -> None:
        """Make the server publish the data of a sensor, by its native ROS 2."""
        self._session.world.get_actor(sensor).enable_for_ros()


@undoes(OWN)
def _destroy(session: Session, actors: Sequence[int]) -> None:
    destroy = [carla.command.DestroyActor(each) for each in reversed(actors)]
    session.client.apply_batch_sync(destroy, False)
    if session.ticks:
        # The batch would tick while the interpreter is locked.
        session.world.tick(session.timeout)


@undoes(FOREIGN)
def _give_back(session: Session, actors: Sequence[Any]) -> None:
    """Return actors to their clients; removed ones are skipped."""
    for number, control, lights in actors:
        actor = session.world.get_actor(number)
        if isinstance(actor, carla.Vehicle):
            actor.set_simulate_physics(True)
            actor.set_enable_gravity(True)
            actor.set_target_angular_velocity(carla.Vector3D())
            actor.set_light_state(carla.VehicleLightState(lights))
            actor.apply_control(carla.VehicleControl(*control))
        elif actor is not None:
            way, speed, jump = control
            actor.apply_control(carla.WalkerControl(carla.Vector3D(*way), speed, jump))
