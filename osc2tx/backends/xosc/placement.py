"""Where and how actors start: `Storyboard/Init/Actions`."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from osc2tx import ir
from osc2tx.backends.xosc.cast import CastMember
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts import LanePosition, Pose, read_spawn
from osc2tx.backends.xosc.leaf import Arguments
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.scopes import Scope
from osc2tx.backends.xosc.speeds import speed_action
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.backends.xosc.towing import towing
from osc2tx.backends.xosc.tree import Element, element
from osc2tx.backends.xosc.values import Named
from osc2tx.diagnostics import Span


@dataclass(slots=True)
class _Start:
    """The start of one actor: its modifiers by name, and whom it refers to."""

    member: CastMember
    scope: Scope
    placement: ir.Placement | None
    modifiers: dict[str, Arguments]
    references: tuple[str, ...]

    @property
    def span(self) -> Span:
        """Where its start is said, or the actor declared."""
        return self.member.actor.span if self.placement is None else self.placement.span


RELATIVE = ("same_as", "side_of", "ahead_of", "behind", "relative_to")
TURNS = frozenset({"orientation", "speed", "tow_trailer", "yaw"})
"""Modifiers that name others without a place beside them."""


OF_MOVEMENT = frozenset({"acceleration", "distance", "physical_movement"})
"""Modifiers that say nothing about the start, and are written down with their invocation."""


def initial_actions(ctx: Context) -> list[Element]:
    """Return the start of each actor, references first, and note what is known about them."""
    for member in ctx.entities:
        ctx.states[member.name] = ActorState(speed=known(0.0))
    privates = []
    tows = towing(ctx)
    for start in _in_order(_starts(ctx)):
        tow = tows.get(start.member.name)
        if tow is not None:  # where it is follows from the vehicle that tows it
            ctx.states[start.member.name] = replace(ctx.states[tow], lane=None)
            continue
        with ctx.within(start.scope), ctx.report_as("placement", start.span):
            privates.append(_private(ctx, start))
    ctx.at_start = dict(ctx.states)
    return privates


def _starts(ctx: Context) -> list[_Start]:
    found: dict[str, _Start] = {}
    for scope in ctx.scope.all():
        for placement in scope.scenario.placements:
            member = scope.cast.get(placement.actor)
            with ctx.within(scope), ctx.report_as("placement", placement.span):
                if member is None:
                    raise Inexpressible(f"`{placement.actor}` is no entity of the XML")
                if not scope.is_first:
                    raise Inexpressible("the scenario that places it does not begin with the run")
                if member.name in found:
                    raise Inexpressible(f"{member.name} is placed twice")
                found[member.name] = _start(ctx, scope, member, placement)
    tows = towing(ctx)
    return [
        found.get(member.name)
        or _Start(member, ctx.scope, None, {}, tuple(tows.get(member.name, "").split()))
        for member in ctx.entities
    ]


def _start(ctx: Context, scope: Scope, member: CastMember, placement: ir.Placement) -> _Start:
    modifiers = {call.name: Arguments(ctx, call.arguments, call) for call in placement.modifiers}
    tow = towing(ctx).get(member.name)
    references = [] if tow is None else [tow]
    for arguments in modifiers.values():
        for name in RELATIVE:
            other = arguments.entity(name)
            if other is not None:
                references.append(other.name)
    return _Start(member, scope, placement, modifiers, tuple(references))


def _in_order(starts: list[_Start]) -> list[_Start]:
    """Sort so that references come first; a ring keeps its order, and is refused later."""
    placed: set[str] = set()
    ordered: list[_Start] = []
    waiting = list(starts)
    while waiting:
        ready = next((s for s in waiting if placed.issuperset(s.references)), waiting[0])
        waiting.remove(ready)
        placed.add(ready.member.name)
        ordered.append(ready)
    return ordered


def _private(ctx: Context, start: _Start) -> Element:
    member = start.member
    position, state = _position(ctx, start)
    actions = [element("PrivateAction", element("TeleportAction", element("Position", position)))]
    speed = _speed(ctx, start)
    ctx.states[member.name] = replace(state, speed=known(speed))
    if speed != 0.0:
        actions.append(speed_action(speed, "step", "time", 0.0))
    tows = start.modifiers.get("tow_trailer")
    if tows is not None:
        ctx.require("a trailer that is coupled", "1.3", tows.source.span)
        ctx.require_support("TrailerAction", tows.source.span)
        tows.entity("trailer")
    for name, arguments in start.modifiers.items():
        if name not in OF_MOVEMENT:
            arguments.finish()
    comment = ctx.comment(start.span, f"start of {member.name}")
    return element("Private", *actions, entityRef=member.name, comment=comment)


def _speed(ctx: Context, start: _Start) -> float:
    arguments = start.modifiers.get("speed")
    if arguments is None:
        return 0.0
    speed = arguments.number("speed") or 0.0
    for name, sign in (("same_as", 1.0), ("faster_than", 1.0), ("slower_than", -1.0)):
        other = arguments.entity(name)
        if other is not None:
            theirs = ctx.states[other.name].speed
            if theirs is None or not theirs.is_known:
                raise Inexpressible(f"the speed of {other.name} is not known", start.span)
            factor = arguments.number("factor")
            return theirs.low * (1.0 if factor is None else factor) + sign * speed
    return speed


# --- places -------------------------------------------------------------------------------------


def _position(ctx: Context, start: _Start) -> tuple[Element, ActorState]:
    location, position = start.modifiers.get("location"), start.modifiers.get("position")
    if location is not None:
        return _at_pose(ctx, start, location)
    if position is not None and ("at_point" in position or "x" in position):
        return _at_point(ctx, start, position)
    if start.references and not (set(start.modifiers) <= TURNS):
        return _beside(ctx, start)
    return _on_road(ctx, start)


def _at_pose(ctx: Context, start: _Start, location: Arguments) -> tuple[Element, ActorState]:
    pose = location.get("pose")
    if not isinstance(pose, Named):
        raise Inexpressible("the pose is not known before the run", location.source.span)
    numbers = {
        name: _part(ctx, pose.name, path)
        for name, path in (
            ("x", ("position", "x")),
            ("y", ("position", "y")),
            ("z", ("position", "z")),
            ("h", ("orientation", "yaw")),
            ("p", ("orientation", "pitch")),
            ("r", ("orientation", "roll")),
        )
    }
    x, y, z = (numbers[name] or 0.0 for name in "xyz")
    h = numbers["h"] or 0.0
    return _world(Pose(x, y, z, h), numbers["p"], numbers["r"])


def _part(ctx: Context, owner: str, path: tuple[str, ...]) -> float | None:
    value = ctx.values.field(owner, path)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return float(value)


def _world(pose: Pose, pitch: float | None, roll: float | None) -> tuple[Element, ActorState]:
    position = element(
        "WorldPosition",
        x=pose.x,
        y=pose.y,
        z=pose.z,
        h=pose.h,
        p=pitch or None,
        r=roll or None,
    )
    return position, ActorState(speed=known(0.0), offset=None, pose=pose)


def _at_point(ctx: Context, start: _Start, position: Arguments) -> tuple[Element, ActorState]:
    if "at_point" in position:
        point = position.get("at_point")
        if not isinstance(point, Named):
            raise Inexpressible("the point is not known before the run", position.source.span)
        x, y, z = (_part(ctx, point.name, (name,)) or 0.0 for name in "xyz")
        heading = 0.0 if ctx.roads is None else ctx.roads.direction_at(x, y, z)
        if position.get("project_on_route") is not False:
            raise Inexpressible("a point that is moved to the nearest lane", position.source.span)
    else:
        x, y, z = (position.number(name) or 0.0 for name in "xyz")
        heading = position.number("h") or 0.0
        if position.text("frame") == "carla":  # left-handed
            y, heading = -y, -heading
    heading, pitch, roll = _turned(ctx, start, heading)
    return _world(Pose(x, y, z, heading), pitch, roll)


AXES = {"length_to_width": 0.5 * math.pi, "width_to_length": -0.5 * math.pi}
"""Angle (rad) between the lines that `yaw_measure_by` names."""


def _turned(ctx: Context, start: _Start, along: float) -> tuple[float, float | None, float | None]:
    """Return heading, pitch and roll of who starts where the road has a heading (rad)."""
    yaw, orientation = start.modifiers.get("yaw"), start.modifiers.get("orientation")
    given = yaw or orientation
    if given is None:
        return along, None, None
    if yaw is not None:
        angle, pitch, roll = yaw.number("angle"), None, None
        if angle is None:
            angle = yaw.number("angle_range")
        measured = yaw.member("measure_by", "relative_to_road")
        base = 0.5 * math.pi if measured == "relative_to_north" else along
        base += AXES.get(measured, 0.0)
    else:
        angle, pitch, roll = (given.number(name) for name in ("yaw", "pitch", "roll"))
        measured = given.member("measure_by", "relative_to_road")
        base = along if measured == "relative_to_road" else 0.0
    other = given.entity("relative_to")
    if other is not None and measured != "absolute":
        base = _heading_of(ctx, other, given) + AXES.get(measured, 0.0)
    return base + (angle or 0.0), pitch, roll


def _heading_of(ctx: Context, other: CastMember, source: Arguments) -> float:
    state = ctx.states[other.name]
    if state.pose is not None:
        return state.pose.h
    if state.lane is None or ctx.roads is None:
        raise Inexpressible(f"the heading of {other.name} is not known", source.source.span)
    return ctx.roads.pose(state.lane).h


def _on_road(ctx: Context, start: _Start) -> tuple[Element, ActorState]:
    member = start.member
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    number = 1 if lane is None else round(lane.number("lane") or 1)
    edge = "right" if lane is None else lane.member("from", "right")
    spawn = _spawn(ctx, member.name)
    place = spawn
    if place is None:
        if ctx.roads is None:
            raise Inexpressible(
                f"lane {number} needs the map {ctx.map_file}, which is not at hand:"
                f" give its folder with --map-path, or the place with --spawn {member.name}=…",
                start.span,
            )
        distance = None if position is None else position.number("distance")
        place = ctx.roads.numbered(number, edge, distance)
    if place is None:
        raise Inexpressible(f"the map has no lane {number} that far along", None)
    offset = _lateral(start)
    sign = 1.0 if place.lane < 0 else -1.0
    element_ = element(
        "LanePosition",
        roadId=place.road,
        laneId=place.lane,
        s=place.s,
        offset=sign * offset if offset else None,
    )
    known_lane = place if ctx.roads is not None else None
    return element_, ActorState(speed=known(0.0), offset=known(offset), lane=known_lane)


def _spawn(ctx: Context, name: str) -> LanePosition | None:
    return dict(map(read_spawn, ctx.options.spawns)).get(name)


def _lateral(start: _Start) -> float:
    lateral = start.modifiers.get("lateral")
    if lateral is None:
        return 0.0
    distance = lateral.number("distance") or 0.0
    return -distance if lateral.member("side", "left") == "right" else distance


def _beside(ctx: Context, start: _Start) -> tuple[Element, ActorState]:
    """Return a place in or beside the lane of another actor, so far ahead of it or behind it."""
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    along, ahead_of = _along(ctx, start, position)
    lanes, in_lane_of = _lanes_beside(ctx, lane, ahead_of)
    reference = ahead_of or in_lane_of
    span = start.span
    if reference is None or (in_lane_of is not None and in_lane_of is not reference):
        raise Inexpressible("it starts relative to several actors", span)
    offset = _lateral(start)
    theirs = ctx.states[reference.name]
    ctx.init_gaps[start.member.name, reference.name] = -along
    mine = None
    if ctx.roads is not None and theirs.lane is not None:
        beside = ctx.roads.beside(theirs.lane, lanes)
        if beside is None:
            raise Inexpressible(f"there is no such lane beside that of {reference.name}", span)
        mine = ctx.roads.ahead(beside, along)
    state = ActorState(speed=known(0.0), offset=known(offset), lane=mine)
    if ctx.version >= "1.1":
        return (
            element(
                "RelativeLanePosition",
                entityRef=reference.name,
                dLane=lanes,
                dsLane=along,
                offset=offset or None,
            ),
            state,
        )
    return _beside_in_1_0(start, reference, lanes, along, offset, theirs.lane), state


def _beside_in_1_0(
    start: _Start,
    reference: CastMember,
    lanes: int,
    along: float,
    offset: float,
    lane: LanePosition | None,
) -> Element:
    """Return the position of 1.0, where distance and lanes count along the reference line."""
    if lane is not None and lane.lane > 0:
        raise Inexpressible(
            f"{reference.name} is on the left carriageway, where OpenSCENARIO XML 1.0 counts"
            " against the direction of travel",
            start.member.actor.span,
            Remedy(version="1.1"),
        )
    return element(
        "RelativeLanePosition",
        entityRef=reference.name,
        dLane=lanes,
        ds=along,
        offset=offset or None,
    )


def _lanes_beside(
    ctx: Context, lane: Arguments | None, reference: CastMember | None
) -> tuple[int, CastMember | None]:
    if lane is None:
        return 0, None
    same = lane.entity("same_as")
    if same is not None:
        return 0, same
    beside = lane.entity("side_of")
    number = lane.number("lane")
    count = 1 if number is None else round(number)
    if beside is None and reference is not None:
        return _lanes_to_number(ctx, lane, reference, count), reference
    if beside is None:
        raise Inexpressible("a lane without a place along the road", lane.source.span)
    return (count if lane.member("side", "left") == "left" else -count), beside


def _lanes_to_number(ctx: Context, lane: Arguments, reference: CastMember, number: int) -> int:
    """Return how many lanes to the left of a reference the lane with a number is."""
    theirs = ctx.states[reference.name].lane
    if ctx.roads is None or theirs is None:
        raise Inexpressible(
            f"a numbered lane needs the map {ctx.map_file}, which is not at hand: give its folder"
            " with --map-path",
            lane.source.span,
        )
    target = ctx.roads.with_number(theirs, number, lane.member("from", "right"))
    between = None if target is None else ctx.roads.lanes_between(theirs, target)
    if between is None:
        raise Inexpressible(f"there is no lane {number} beside {reference.name}", lane.source.span)
    return between


def _along(
    ctx: Context, start: _Start, position: Arguments | None
) -> tuple[float, CastMember | None]:
    """Return the distance (m, positive ahead) and from whom."""
    if position is None:
        return 0.0, None
    ahead, behind = position.entity("ahead_of"), position.entity("behind")
    reference = ahead or behind
    if reference is None:
        raise Inexpressible(
            "a distance along the road in the lane of an actor", position.source.span
        )
    distance = position.number("distance")
    if distance is None:
        time = position.number("time")
        if time is None:
            raise Inexpressible("it says no distance", position.source.span)
        theirs = ctx.states[reference.name].speed
        own = _speed(ctx, start)
        distance = time * (own if behind else theirs.low if theirs is not None else 0.0)
    return (distance if ahead is not None else -distance), reference
