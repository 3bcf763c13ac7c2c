"""Actors in CARLA: spawned by the run, or by another client."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.plant.scene import Setpoint
from osc2tx_runtime.world.protocol import EXACT, ControlMode

from .blueprints import attributes_of, blueprint_for
from .cast import ABOVE, CastMember, member_of
from .client_process import ClientProcess
from .frames import transform_of

OUT_OF_THE_WAY = 50.0
"""Height (m) above the ground at which actors are spawned before they are moved."""

HEIGHTS = (ABOVE, 2.0 * ABOVE, 4.0 * ABOVE)
"""Heights (m) at which to spawn falling actors, in order of trial: a mesh above the lane blocks the
lower ones."""

CLOSE = 8.0  # m: radius of the search for blocking actors


class Spawning:
    """Spawns the actors of a run.

    Args:
        client: A connected session.
        waiting: Seconds to wait for actors of other clients, by id.
        gains: Gains of the controllers of driven vehicles, if they differ from those of the
            category.
    """

    def __init__(
        self, client: ClientProcess, waiting: Mapping[str, float], gains: Mapping[str, float]
    ) -> None:
        self._client, self._waiting, self._gains = client, waiting, gains
        self._library = client.ask("blueprints")
        self._count = 0
        self.problems: list[str] = []

    @property
    def waits(self) -> bool:
        """Whether another client spawns any actor."""
        return bool(self._waiting)

    def awaited(self, actor: str) -> bool:
        """Whether another client spawns an actor."""
        return actor in self._waiting

    def wait(self, setpoint: Setpoint, control: ControlMode) -> CastMember:
        """Return an actor that another client spawns.

        Raises:
            SimulatorError: It does not appear in time.
        """
        spec = setpoint.spec
        patience = self._waiting[spec.id]
        role = spec.role or spec.id
        found = self._client.ask("find", role, patience, patience=patience)
        if not found:
            raise SimulatorError(
                f"--wait-for {spec.id}: no actor with role_name {role} appeared within"
                f" {patience:g} s"
            )
        if len(found) > 1:
            names = ", ".join(f"{each['type']} {each['id']}" for each in found)
            raise SimulatorError(
                f"--wait-for {spec.id}: several actors have the role_name {role}: {names}"
            )
        self._client.ask("borrow", found[0]["id"])
        member = member_of(spec, found[0], control, self._gains)
        member.foreign = True
        return member

    def spawn(self, setpoint: Setpoint, control: ControlMode) -> CastMember:
        """Spawn an actor at its start.

        Raises:
            SimulatorError: There is no such blueprint, or the position is occupied.
        """
        spec, state = setpoint.spec, setpoint.state
        blueprint = blueprint_for(spec, self._library)
        role = spec.role or spec.id
        attributes, problem = attributes_of(spec, self._library[blueprint], role)
        if problem is not None:
            self.problems.append(problem)
        self._count += 1
        exact = control in EXACT or setpoint.towed
        heights = (OUT_OF_THE_WAY + 5.0 * self._count,) if exact else HEIGHTS
        legs = 1.0 if blueprint.startswith("walker.") else 0.0
        half = 0.5 * spec.shape.length
        ahead = spec.shape.rear - half if spec.shape.wheelbase > 0.0 else 0.0
        pose = Pose(state.x, state.y, state.z, state.h, state.pitch, state.roll)
        for up in heights:
            place = transform_of(pose, ahead, up + legs)
            try:
                found = self._client.ask("spawn", blueprint, attributes, place)
            except SimulatorError as error:
                others = self._others_at(pose)
                if others or up == heights[-1]:
                    raise _refused(setpoint, blueprint, error, others) from None
            else:
                break
        member = member_of(spec, found, control, self._gains)
        member.above = up
        return member

    def _others_at(self, pose: Pose) -> str:
        """Return the names of the actors that may block a position."""
        x, y, *_ = transform_of(pose)
        near: list[Any] = self._client.ask("nearby", x, y, CLOSE)
        return ", ".join(f"{k} {number}{f' ({role})' if role else ''}" for number, k, role in near)


def _refused(
    setpoint: Setpoint, blueprint: str, error: SimulatorError, others: str
) -> SimulatorError:
    """Return the error for an actor that the server does not spawn, with actors nearby."""
    who = f"; there is {others}" if others else ""
    return SimulatorError(
        f"{setpoint.spec.id}: CARLA does not spawn {blueprint} at"
        f" ({setpoint.state.x:.1f}, {setpoint.state.y:.1f}):"
        f" {error.message.removeprefix('CARLA: ')}{who}"
    )
