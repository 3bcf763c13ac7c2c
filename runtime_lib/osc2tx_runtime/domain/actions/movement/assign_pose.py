"""Actions that set position or orientation instantly (DSL 8.8.2.4, 8.8.2.5)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Unpack

from osc2tx_runtime.domain.modifiers import Lane, Modifier, Orient, Position, Speed, Yaw
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.placing.initial_state import InitialState
from osc2tx_runtime.domain.placing.placer import Placer
from osc2tx_runtime.domain.planning.motion_action import Assignment
from osc2tx_runtime.domain.points_and_poses import OdrPoint, Orientation, Point, RoutePoint
from osc2tx_runtime.domain.routes.lane_coordinates import place_of_odr, place_of_route
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.world.geometry.attitude import Tilt
from osc2tx_shared.rules import at_least_one, at_most_one

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import MovableObject

PLACES = ("position", "route_point", "odr_point", "with")
Target = Point | RoutePoint | OdrPoint


@action(
    "movable_object",
    "assign_position",
    ends="at_once",
    slots=(LONGITUDINAL, LATERAL),
    places=True,
    paces=False,
)
class AssignPosition(Assignment):
    """Teleport to a position; the speed remains.

    Args:
        actor: The actor.
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
                initial = InitialState(place_of_odr(self.world.map, point), None, None)
            case RoutePoint():
                initial = InitialState(place_of_route(self.world.map, point), None, None)
            case _:
                modifiers = self.modifiers
                if point is not None:
                    modifiers = (Position(at_point=point, project_on_route=False),)
                initial = placer.initial_state(self.movable, modifiers, self.here)
        self.be_at(initial)


@action("movable_object", "assign_orientation", ends="at_once", slots=(LATERAL,))
class AssignOrientation(Assignment):
    """Set heading, pitch and roll instantly.

    A vehicle then returns to the direction of its lane, and to the attitude of the road as soon as
    its wheels roll; other actors keep the assigned pose. A pitch or roll of zero follows the road.
    """

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        orientation: Orientation | Callable[[], Orientation],
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.movable = actor
        self.orientation = orientation

    def on_start(self) -> None:
        """Assigns it."""
        wanted = now(self.orientation)
        self.turn(wanted.yaw, Tilt(wanted.pitch or None, wanted.roll or None))
