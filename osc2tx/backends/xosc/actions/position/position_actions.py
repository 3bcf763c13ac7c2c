"""Actions that assign a position or go to one (§8.8.2.4, §8.8.2.5, §8.8.2.11).

The modifiers of the position along the road are those of §8.9.8 and §8.9.12.
"""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf, Performance
from osc2tx.backends.xosc.actions.position.paths import follow, note_steering
from osc2tx.backends.xosc.actions.position.points_and_lines import xml_position
from osc2tx.backends.xosc.actions.position.xml_positions import (
    XmlPosition,
    at_place,
    lane_place,
    relative_lane,
    world_position,
)
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, modifier, to_goal
from osc2tx.backends.xosc.actions.speed.courses import (
    Computed,
    follow_course,
    points_for,
    speed_action,
)
from osc2tx.backends.xosc.actions.speed.gaps import Gap, reach
from osc2tx.backends.xosc.actions.speed.speed_modifiers import check_end_is_free, cover_in_time
from osc2tx.backends.xosc.entities.cast import VEHICLE, CastMember
from osc2tx.backends.xosc.facts.actors import CRUISE, Linear, steepest
from osc2tx.backends.xosc.facts.maps import Pose, place_along_road
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL, ActorState, known
from osc2tx.backends.xosc.values.constants import Member, Named
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace


@action("assign_position", takes=(LATERAL,))
def _assign_position(leaf: Leaf) -> Performance:
    names = ("position", "route_point", "odr_point")
    name = next((each for each in names if each in leaf.arguments), None)
    if name is not None:
        target = xml_position(leaf.ctx, leaf.arguments.get(name))
        return Performance(_put(leaf, target), "goal")
    return Performance(_put(leaf, _beside(leaf)), "goal")


def _put(leaf: Leaf, target: XmlPosition) -> Changes:
    place: xml.PositionPart = target.element
    state = leaf.state
    if leaf.member.walks and target.pose is not None:
        pose = target.pose  # which looks along the road: a point has no heading
        place, after = world_position(pose), replace(state, pose=pose, lane=None, offset=None)
    else:
        offset = None if target.lane is None else known(round(target.lane.offset, 6))
        after = replace(state, lane=target.lane, offset=offset, pose=None)
    return (Change(LATERAL, (_teleport(leaf, place),), 0.0, after, after),)


def _beside(leaf: Leaf) -> XmlPosition:
    """Return the place that modifiers give relative to another actor."""
    lanes, along = 0, 0.0
    references: list[CastMember] = []
    for node in leaf.node.modifiers:
        call = Arguments(leaf.ctx, node)
        with leaf.ctx.report_as(call.construct, call.span):
            match call.name:
                case "lane":
                    other, lanes = call.beside_lane()
                    otherwise = "a lane by its number, at a place that is only known during the run"
                case "position":
                    other, is_behind = call.ahead_of()
                    distance = call.number("distance")
                    other = None if distance is None else other
                    along = -(distance or 0.0) if is_behind else distance or 0.0
                    otherwise = "only a distance ahead of or behind an actor can be said"
                case _:
                    raise Inexpressible(f"`{call.name}` of a place to be put to")
            if other is None:
                raise Inexpressible(otherwise)
            call.finish()
            references.append(other)
    if not references or len({each.name for each in references}) > 1:
        raise Inexpressible("it is put relative to none or to several actors")
    reference = references[0]
    lane, roads = leaf.state_of(reference).lane, leaf.ctx.roads
    place = relative_lane(leaf.ctx, reference.name, lanes, along, 0.0)
    on = None
    if lane is not None and roads is not None:
        on = roads.beside(lane, lanes)
        if on is None:
            raise Inexpressible(f"there is no such lane beside that of {reference.name}")
    return XmlPosition(place, on, None)


def _teleport(leaf: Leaf, place: xml.PositionPart) -> xml.PrivateAction:
    """Return the action that puts an actor somewhere, who may be on its way."""
    if leaf.member.kind == VEHICLE or leaf.state.speed != known(0.0):
        leaf.ctx.require_support("TeleportAction/moving")
    return xml.PrivateAction(xml.TeleportAction(xml.Position(place)))


@action("assign_orientation")
def _assign_orientation(leaf: Leaf) -> Performance:
    ctx, given = leaf.ctx, leaf.arguments.get("orientation")
    if not isinstance(given, Named):
        raise Inexpressible("the orientation is only known during the run")
    if not leaf.member.walks:
        raise Inexpressible("a vehicle follows its lane, whatever its orientation")
    angles = (ctx.values.number_in(given.name, name) or 0.0 for name in ("yaw", "pitch", "roll"))
    h, pitch, roll = (round(angle, 9) for angle in angles)
    pose = leaf.state.pose
    place: xml.PositionPart
    if pose is not None:
        pose = pose._replace(h=h, pitch=pitch, roll=roll)
        place = world_position(pose)
    else:
        turn = xml.Orientation(type="absolute", h=h, p=pitch or None, r=roll or None)
        place = xml.RelativeObjectPosition(turn, entityRef=leaf.member.name, dx=0.0, dy=0.0)
    after = replace(leaf.state, pose=pose)
    return Performance((Change(LATERAL, (_teleport(leaf, place),), 0.0, after, after),), "goal")


@action("change_position")
def _change_position(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    names = ("target_position", "target_xyz", "target_st", "target_odr")
    name = next(each for each in names if each in arguments)
    target = xml_position(leaf.ctx, arguments.get(name))
    joined, on_network = arguments.get("interpolation"), arguments.get("on_road_network")
    is_smooth = isinstance(joined, Member) and joined.name == "smooth"
    if leaf.duration is not None:
        raise Inexpressible("a duration beside that of the way")
    if on_network if on_network is not None else not leaf.member.walks:
        return _acquire(leaf, target)
    if is_smooth:
        raise Inexpressible("a curve from wherever it is then")
    return _straight_to(leaf, target)


def _acquire(leaf: Leaf, target: XmlPosition) -> Performance:
    """Return the way along lanes; it is over where the place is reached, not where the route is."""
    state = leaf.state
    position = xml.Position(target.element)
    acquire = xml.RoutingAction(xml.AcquirePositionAction(position))
    after = replace(state, lane=target.lane, offset=known(0.0)).finished(LATERAL)
    change = Change(LATERAL, (xml.PrivateAction(acquire),), None, replace(state, lane=None), after)
    name = leaf.member.name
    reached = at_place(leaf.ctx, leaf.arguments, name, target.element, target.lane)
    return to_goal(leaf, change, reached=reached)


def _straight_to(leaf: Leaf, target: XmlPosition) -> Performance:
    """Return a straight way off the lanes."""
    here, there = leaf.state.pose, target.pose
    if there is None:
        raise Inexpressible("where the point is needs the map, which is not at hand")
    start: xml.PositionPart
    start = xml.RelativeObjectPosition(entityRef=leaf.member.name, dx=0.0, dy=0.0)
    way, speed = None, leaf.state.known_speed
    sets_out = () if speed != 0.0 else (speed_action(CRUISE),)
    speed = CRUISE if speed == 0.0 else speed
    if here is not None:
        heading = math.atan2(there.y - here.y, there.x - here.x)
        start = world_position(here._replace(h=heading))
        there = Pose(there.x, there.y, there.z, heading)
        way = math.hypot(there.x - here.x, there.y - here.y)
        if way == 0.0:
            raise Inexpressible("the path has no length: it needs two different points")
    changes = apply_modifiers(leaf)
    length = None if way is None or speed is None else way / speed
    note_steering(leaf)
    vertices = [(0.0, start), (length or 1.0, world_position(there))]
    move = follow(leaf, vertices, length is not None and not changes, is_exact=False)
    after = ActorState(
        speed=leaf.state.speed if speed is None else known(speed),
        offset=None,
        pose=there,
        unfinished=leaf.state.unfinished,
    )
    moves = Change(LATERAL, (move,), length, replace(after, pose=None), after)
    begins = [Change(LONGITUDINAL, sets_out, 0.0, after, after)] if sets_out else []
    return Performance((moves, *begins, *changes), "goal")


@modifier("position")
def _position(leaf: Leaf, call: Arguments) -> Changes:
    if "at_point" in call:
        return _at_point(leaf, call)
    reference, is_behind = call.ahead_of()
    if reference is None:
        return _along_road(leaf, call, call.distance())
    for name in ("movement_mode", "track"):
        if name in call and call.member(name, "") not in ("other", "actual"):
            raise Inexpressible(f"`{name}` has no counterpart")
    distance, time = (call.size(name) for name in ("distance", "time"))
    if distance is None and time is None:
        raise Inexpressible("neither a distance nor a time is stated")
    size = distance if distance is not None else time
    assert size is not None
    side = "behind" if is_behind else "ahead"
    if size < 0.0:
        size, side = -size, "behind" if side == "ahead" else "ahead"
    gap = Gap(reference, side, size, distance is None, "points")
    if call.at == "end":
        return (_in_time(leaf, call, gap),)
    if not leaf.is_start:
        raise Inexpressible(
            "it holds from the start of the action on, and where both are then only the run shows",
            remedy=Remedy(
                instead="`at: end`, or `keep_space_gap` from the distance that is there then"
            ),
        )
    return (reach(leaf, gap, keeps=True),)


def _at_point(leaf: Leaf, call: Arguments) -> Changes:
    """End an invocation at a point that the way leads to."""
    point = xml_position(leaf.ctx, call.get("at_point"))
    call.get("project_on_route")
    if call.at != "end" or leaf.duration is not None:
        raise Inexpressible("a point that is not the end of the way")
    leaf.reached = at_place(leaf.ctx, call, leaf.member.name, point.element, point.lane)
    return ()


def _along_road(leaf: Leaf, call: Arguments, distance: float) -> Changes:
    """Be so far (m) along the road at the end of an invocation; it keeps its lane until then."""
    lane, roads = leaf.state.lane, leaf.ctx.roads
    if call.at != "end":
        raise Inexpressible("a distance from the start of the road that is not the end of the way")
    if lane is None or roads is None:
        raise Inexpressible("which road it is on is only known during the run")
    place = place_along_road(roads.map, lane, distance)
    if place is None:
        raise Inexpressible(f"the road ends before {distance:g} m")
    if leaf.duration is not None:
        way = roads.map.route_distance(lane, place) if leaf.is_start else None
        if way is None:
            raise Inexpressible("how far it is from its place is only known during the run")
        return (cover_in_time(leaf, call, way, leaf.duration),)
    leaf.reached = at_place(leaf.ctx, call, leaf.member.name, lane_place(roads, place), place)
    return ()


# --- to be somewhere in time --------------------------------------------------------------------


def arrival(start: float, missing: float, duration: float, end: float | None = None) -> Computed:
    """Return the speed with the least effort that covers a way in a time (s).

    Missing are metres that the first speed (m/s) would not cover; at a free end it is steady.
    """
    mean = missing / duration
    change = 1.5 * mean if end is None else end - start

    def value(t: float) -> float:
        share = t / duration
        return start + share * (change + (6.0 * mean - 3.0 * change) * (1.0 - share))

    return Computed(duration, value)


def _in_time(leaf: Leaf, call: Arguments, gap: Gap) -> Change:
    """Return the change of the speed that leads to a place beside another actor in time."""
    check_end_is_free(leaf, call, "speed")
    speed, time, told = leaf.state.known_speed, leaf.duration, leaf.modifier("speed")
    end = told.number("speed") if told is not None and told.at == "end" else None
    apart = leaf.starts_behind(gap.reference)
    theirs = leaf.state_of(gap.reference, always=True).known_speed
    if speed is None or apart is None or theirs is None or time is None or gap.is_time:
        call.approximate(
            "where both are by then is only known during the run",
            "the place is reached, but when is up to the tool",
        )
        return reach(leaf, gap, keeps=False)
    way = apart + (gap.size if gap.side == "ahead" else -gap.size)
    missing = way + (theirs - speed) * time
    course = arrival(speed, missing, time, end)
    # Without courses of the speed an even change leads to the same place in the same time.
    even = Linear(speed, speed + 2.0 * missing / time, time)
    faster, slower = steepest(course)
    if faster > leaf.limits.acceleration or slower > leaf.limits.deceleration:
        call.doubt("it takes a larger acceleration than the actor has: the world makes up for it")
    change = follow_course(leaf, course, even=even, told=call, count=points_for(course))
    if change.after.speed is None or change.after.speed.low < 0.0:
        raise Inexpressible("it would have to go backwards")
    return change
