"""Actions that put an actor somewhere at once (DSL 8.8.2.4, 8.8.2.5)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.argument_rules import at_least_one, at_most_one
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.modifiers import Lane, Modifier, Orient, Position, Speed, Yaw
from osc2tx_runtime.modifiers.base import now
from osc2tx_runtime.places import Placer
from osc2tx_runtime.poses import place_of_odr
from osc2tx_runtime.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.routes import place_of_route
from osc2tx_runtime.values import OdrPoint, Orientation, Point, RoutePoint

from .support import OneStepAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import MovableObject

__all__ = ["AssignOrientation", "AssignPosition"]

PLACES = ("position", "route_point", "odr_point", "with")
Target = Point | RoutePoint | OdrPoint


@action("movable_object", "assign_position", slots=(LONGITUDINAL, LATERAL))
class AssignPosition(OneStepAction):
    """Be somewhere else at the next step; the speed stays.

    Args:
        actor: Who.
        *modifiers: position, lane, speed, yaw, orientation: instead of a point.
        position: Point in the world.
        route_point: Point in route coordinates.
        odr_point: Point in road coordinates.
        **options: Duration and label.
    """

    rules = (at_most_one(*PLACES), at_least_one(*PLACES))
    accepts: ClassVar[tuple[type, ...]] = (Position, Lane, Speed, Yaw, Orient)

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        position: Point | Callable[[], Point] | None = None,
        route_point: RoutePoint | Callable[[], RoutePoint] | None = None,
        odr_point: OdrPoint | Callable[[], OdrPoint] | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.movable = actor
        self.point: Target | Callable[[], Target] | None = position or route_point or odr_point

    def on_start(self) -> None:
        """Assigns it."""
        placer = Placer(self.world)
        point: Target | None = now(self.point)
        match point:
            case OdrPoint():
                at, speed, heading = place_of_odr(self.world.map, point), None, None
            case RoutePoint():
                at, speed, heading = place_of_route(self.world.map, point), None, None
            case _:
                modifiers = self.modifiers
                if point is not None:
                    modifiers = (Position(at_point=point, project_on_route=False),)
                spot = placer.spot(self.movable, modifiers, self.here)
                at, speed, heading = spot.at, spot.speed, spot.heading
        actor_id = self.actor.id
        self.effect(
            "position",
            (at, speed, heading),
            lambda: self.world.assign(actor_id, at=at, speed=speed, heading=heading),
        )


@action("movable_object", "assign_orientation", slots=(LATERAL,))
class AssignOrientation(OneStepAction):
    """Have a heading at the next step; not for vehicles on a lane, which follow it."""

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        orientation: Orientation,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.movable = actor
        self.orientation = orientation

    def on_start(self) -> None:
        """Assigns it."""
        if self.movable.lane_bound and self.here.lane_position is not None:
            raise UnsupportedError(
                f"{self.actor.id} follows its lane, so its orientation cannot be assigned",
                self.source,
            )
        yaw = self.orientation.yaw
        self.effect("heading", yaw, lambda: self.world.assign(self.actor.id, heading=yaw))
