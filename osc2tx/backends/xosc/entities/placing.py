"""Initial actions (`Storyboard/Init/Actions`): the places of all actors before the start.

They are found one after the other, as the embedded world puts actors somewhere.
"""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.backends.xosc.actions.speed.courses import speed_action
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.start_lanes import note_turn, turned
from osc2tx.backends.xosc.entities.start_positions import position_of
from osc2tx.backends.xosc.entities.start_statements import (
    Start,
    in_order,
    speed_at_start,
    starts_of,
)
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.facts.start_places import Placed, StartRoom, box_at, trailer_pose
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.losses.entries import NoPlace
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Unwritable
from osc2tx_shared.classes import replace


class InitialPlacing(StartRoom[Start]):
    """Finds the positions of all actors at the start, and notes what is known about them there.

    Attributes:
        positions: Elements, by actor.
        refused: Why an actor has none.
    """

    failure = NoPlace

    def __init__(self, ctx: Context) -> None:
        """Take the context."""
        super().__init__(0 if ctx.roads is None else len(ctx.roads.map.spawn_points()))
        self._ctx = ctx
        self.positions: dict[str, xml.PositionPart] = {}
        self.refused: dict[str, Unwritable] = {}

    def place(self, start: Start) -> Placed:
        """Find the position of an actor."""
        self.refused.pop(start.id, None)
        try:
            with self._ctx.within(start.scope):
                return self._towed(start) if start.tow else self._put(start)
        except NoPlace as error:
            error.span = error.span or start.span
            raise
        except Unwritable as error:
            self.refused[start.id] = error
            return self._noted(start, None)

    def cycle_of(self, waiting: Sequence[Start]) -> NoPlace:
        """Return the failure that starts depend on each other."""
        names = " and ".join(start.id for start in waiting)
        return NoPlace(f"the starts of {names} depend on each other", waiting[0].span)

    def _towed(self, start: Start) -> Placed:
        """Note that where a trailer is follows from the vehicle that tows it."""
        tow, ctx = start.tow, self._ctx
        ctx.states[start.id] = replace(ctx.states[tow], lane=None)
        pose = ctx.start_poses.get(tow)
        if pose is not None:
            shapes = {member.name: member.shape for member in ctx.entities}
            pose = trailer_pose(pose, shapes[tow], shapes[start.id])
        return self._noted(start, pose)

    def _put(self, start: Start) -> Placed:
        ctx = self._ctx
        position, state = position_of(ctx, start, lambda place: self._taken_by(start, place))
        pose = self._pose(start, state)
        other = None if pose is None else self.taken_by(box_at(pose, start.member.shape))
        if other is not None:
            raise NoPlace(f"{start.id} overlaps {other} at its start")
        self.positions[start.id] = position
        ctx.states[start.id] = replace(state, speed=known(speed_at_start(ctx, start)))
        return self._noted(start, pose)

    def _pose(self, start: Start, state: ActorState) -> Pose | None:
        roads = self._ctx.roads
        if state.pose is not None or state.lane is None or roads is None:
            return state.pose
        offset = 0.0 if state.offset is None else state.offset.low
        pose = roads.map.pose(state.lane._replace(offset=offset))
        return pose._replace(h=turned(self._ctx, start, pose.h)[0])

    def _noted(self, start: Start, pose: Pose | None) -> Placed:
        lane = self._ctx.states[start.id].lane
        if pose is None:
            return Placed(None, lane)
        self._ctx.start_poses[start.id] = pose
        return Placed(box_at(pose, start.member.shape), lane)

    def _taken_by(self, start: Start, place: LanePosition) -> str | None:
        roads = self._ctx.roads
        assert roads is not None
        if self.was_tried(start, place):
            return "another actor"
        return self.taken_by(box_at(roads.map.pose(place), start.member.shape))


OF_MOVEMENT = frozenset({"acceleration", "distance", "physical_movement"})
"""Modifiers that say nothing about the start, and are written down with their invocation."""


def initial_actions(ctx: Context) -> dict[str, xml.Private]:
    """Return the start of each actor, references first, and note what is known about them."""
    for member in ctx.entities:
        ctx.states[member.name] = ActorState()
    starts = starts_of(ctx)
    placing = InitialPlacing(ctx)
    try:
        placing.fill(starts)
    except NoPlace as error:
        ctx.report.cannot("placement", error.span or ctx.scenario.span, error.reason)
    privates = {}
    for start in in_order(starts):
        if start.id in placing.refused:
            ctx.report.refuse("placement", start.span, placing.refused[start.id])
        elif start.id in placing.positions:
            with ctx.within(start.scope), ctx.report_as("placement", start.span):
                note_turn(ctx, start)
                position = placing.positions[start.id]
                privates[start.member.name] = _private(ctx, start, position)
    ctx.at_start = dict(ctx.states)
    return privates


def _private(ctx: Context, start: Start, position: xml.PositionPart) -> xml.Private:
    member = start.member
    actions = [xml.PrivateAction(xml.TeleportAction(xml.Position(position)))]
    speed = speed_at_start(ctx, start)
    if speed != 0.0:
        actions.append(speed_action(speed))
    tows = start.modifiers.get("tow_trailer")
    if tows is not None:
        ctx.require("a trailer that is coupled", "1.3", tows.source.span)
        ctx.require_support("TrailerAction", tows.source.span)
        tows.entity("trailer")
    for name, arguments in start.modifiers.items():
        if name not in OF_MOVEMENT:
            arguments.finish()
    return xml.Private(*actions, entityRef=member.name)
