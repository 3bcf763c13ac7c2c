"""Start positions of actors: elements of `Init`, and the lane and pose they mean."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.lateral_offsets import offset_in_lane
from osc2tx.backends.xosc.actions.leaf import Arguments
from osc2tx.backends.xosc.actions.points_and_lines import point_along
from osc2tx.backends.xosc.actions.registry import at_start
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import required_roads
from osc2tx.backends.xosc.entities.start_orientations import orientation_in_lane, turned
from osc2tx.backends.xosc.entities.start_statements import Start, speed_at_start
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.facts.run_options import read_spawn
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.backends.xosc.values.constants import Named
from osc2tx.backends.xosc.xml.tree import Element, element

at_start("location", "position", "along", "lane", "lateral")


def position_of(ctx: Context, start: Start) -> tuple[Element, ActorState]:
    """Return the position of an actor at the start, and what is known about the actor there.

    Raises:
        Inexpressible: The XML has no such position, or it is not known before the run.
    """
    location, position = start.modifiers.get("location"), start.modifiers.get("position")
    if location is not None:
        return _at_pose(ctx, start, location)
    if position is not None and ("at_point" in position or "x" in position):
        return _at_point(ctx, start, position)
    if start.is_beside:
        return _beside(ctx, start)
    along = start.modifiers.get("along")
    if along is not None:
        return _on_route(ctx, start, along)
    return _on_road(ctx, start)


def _at_pose(ctx: Context, start: Start, location: Arguments) -> tuple[Element, ActorState]:
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


def _at_point(ctx: Context, start: Start, position: Arguments) -> tuple[Element, ActorState]:
    if "at_point" in position:
        point = position.get("at_point")
        if not isinstance(point, Named):
            raise Inexpressible("the point is not known before the run", position.source.span)
        x, y, z = (_part(ctx, point.name, (name,)) or 0.0 for name in "xyz")
        if position.get("project_on_route") is not False:
            return _near_point(ctx, start, (x, y, z))
        heading = 0.0 if ctx.roads is None else ctx.roads.direction_at(x, y, z)
    else:
        x, y, z = (position.number(name) or 0.0 for name in "xyz")
        heading = position.number("h") or 0.0
        if position.text("frame") == "carla":  # left-handed
            y, heading = -y, -heading
    heading, pitch, roll = turned(ctx, start, heading)
    return _world(Pose(x, y, z, heading), pitch, roll)


def _near_point(
    ctx: Context, start: Start, point: tuple[float, float, float]
) -> tuple[Element, ActorState]:
    """Return the place in the lane that is nearest to a point, or in one of the same road."""
    near = required_roads(ctx).map.locate(*point)
    if near is None:
        raise Inexpressible(f"no lane is near ({point[0]:g}, {point[1]:g})", start.span)
    return _in_lane(ctx, start, _numbered(ctx, start, LanePosition(near.road, near.lane, near.s)))


def _numbered(ctx: Context, start: Start, place: LanePosition) -> LanePosition:
    """Return the lane that a modifier numbers, at a place."""
    lane = start.modifiers.get("lane")
    if lane is None:
        return place
    number = round(lane.number("lane") or 1)
    numbered = required_roads(ctx).with_number(place, number, lane.member("from", "right"))
    if numbered is None:
        raise Inexpressible(f"there is no lane {number} at that place", lane.source.span)
    return numbered


def _on_route(ctx: Context, start: Start, along: Arguments) -> tuple[Element, ActorState]:
    """Return the place at which a route begins, or so far from there."""
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    offset = along.number("start_offset") or 0.0
    along.number("end_offset")
    offset += 0.0 if position is None else position.number("distance") or 0.0
    place = point_along(ctx, along.get("route"), offset)
    if not isinstance(place, LanePosition):
        if lane is not None:
            raise Inexpressible("a lane of a way off the lanes", lane.source.span)
        return _world(place, None, None)
    return _in_lane(ctx, start, _numbered(ctx, start, place))


def _on_road(ctx: Context, start: Start) -> tuple[Element, ActorState]:
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
    return _in_lane(ctx, start, place)


def _in_lane(ctx: Context, start: Start, place: LanePosition) -> tuple[Element, ActorState]:
    """Return the place in a lane; where it is across the lane and turned to comes from others."""
    offset = _lateral(ctx, start, place)
    sign = 1.0 if place.lane < 0 else -1.0
    element_ = element(
        "LanePosition",
        orientation_in_lane(ctx, start, place),
        roadId=place.road,
        laneId=place.lane,
        s=place.s,
        offset=round(sign * offset, 6),
    )
    known_lane = place if ctx.roads is not None else None
    return element_, ActorState(speed=known(0.0), offset=known(offset), lane=known_lane)


def _spawn(ctx: Context, name: str) -> LanePosition | None:
    return dict(map(read_spawn, ctx.options.spawns)).get(name)


def _lateral(ctx: Context, start: Start, place: LanePosition | None) -> float:
    lateral = start.modifiers.get("lateral")
    if lateral is None:
        return 0.0 if place is None else round(place.offset, 6)
    return offset_in_lane(ctx, lateral, start.member, place)


def _beside(ctx: Context, start: Start) -> tuple[Element, ActorState]:
    """Return a place in or beside the lane of another actor, so far ahead of it or behind it."""
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    along, ahead_of = _along(ctx, start, position)
    lanes, in_lane_of = _lanes_beside(ctx, lane, ahead_of)
    reference = ahead_of or in_lane_of
    span = start.span
    if reference is None or (in_lane_of is not None and in_lane_of is not reference):
        raise Inexpressible("it starts relative to several actors", span)
    offset = _lateral(ctx, start, None)
    theirs = ctx.states[reference.name]
    ctx.init_gaps[start.member.name, reference.name] = -along
    mine = None
    if ctx.roads is not None and theirs.lane is not None:
        beside = ctx.roads.beside(theirs.lane, lanes)
        if beside is None:
            raise Inexpressible(f"there is no such lane beside that of {reference.name}", span)
        mine = ctx.roads.ahead(beside, along)
    state = ActorState(speed=known(0.0), offset=known(offset), lane=mine)
    turn = orientation_in_lane(ctx, start, mine)
    if ctx.version >= "1.1":
        return (
            element(
                "RelativeLanePosition",
                turn,
                entityRef=reference.name,
                dLane=lanes,
                dsLane=along,
                offset=offset,
            ),
            state,
        )
    return _beside_in_1_0(start, reference, (lanes, along, offset), theirs.lane, turn), state


def _beside_in_1_0(
    start: Start,
    reference: CastMember,
    place: tuple[int, float, float],
    lane: LanePosition | None,
    turn: Element | None,
) -> Element:
    """Return the position of 1.0, where distance and lanes count along the reference line."""
    if lane is not None and lane.lane > 0:
        raise Inexpressible(
            f"{reference.name} is on the left carriageway, where OpenSCENARIO XML 1.0 counts"
            " against the direction of travel",
            start.member.actor.span,
            Remedy(version="1.1"),
        )
    lanes, along, offset = place
    return element(
        "RelativeLanePosition",
        turn,
        entityRef=reference.name,
        dLane=lanes,
        ds=along,
        offset=offset,
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
    ctx: Context, start: Start, position: Arguments | None
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
        own = speed_at_start(ctx, start)
        distance = time * (own if behind else theirs.low if theirs is not None else 0.0)
    return (distance if ahead is not None else -distance), reference
