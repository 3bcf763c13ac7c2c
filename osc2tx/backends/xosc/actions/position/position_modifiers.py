"""Modifiers of the position along the road (§8.9.8, §8.9.12)."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf
from osc2tx.backends.xosc.actions.position.points_and_lines import xml_position
from osc2tx.backends.xosc.actions.position.xml_positions import at_place, lane_place
from osc2tx.backends.xosc.actions.registry import modifier
from osc2tx.backends.xosc.actions.speed.courses import Computed, follow_course
from osc2tx.backends.xosc.actions.speed.gaps import Gap, reach
from osc2tx.backends.xosc.actions.speed.speed_modifiers import cover_in_time
from osc2tx.backends.xosc.facts.actors import Linear
from osc2tx.backends.xosc.facts.maps import place_along_road
from osc2tx.backends.xosc.report import Inexpressible, Remedy


@modifier("position")
def _position(leaf: Leaf, call: Arguments) -> Changes:
    if "at_point" in call:
        return _at_point(leaf, call)
    reference, is_behind = call.ahead_of()
    if reference is None:
        along = call.size("distance")
        if along is None:
            raise Inexpressible("no distance is stated")
        return _along_road(leaf, call, along)
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
    goal = lane_place(roads, place)
    leaf.reached = at_place(leaf.ctx, call, leaf.member.name, goal, place)
    return ()


# --- to be somewhere in time --------------------------------------------------------------------


def arrival(start: float, missing: float, duration: float) -> Computed:
    """Return the speed with the least effort that covers a way in a time (s), free at the end.

    The acceleration falls evenly to zero: a(t) = 3 m (T - t) / T^3 for what is missing: the metres
    m that the speed at the start (m/s) would not cover.
    """

    def value(t: float) -> float:
        share = t / duration
        return start + 3.0 * missing / duration * share * (1.0 - 0.5 * share)

    return Computed(duration, value)


def _in_time(leaf: Leaf, call: Arguments, gap: Gap) -> Change:
    """Return the change of the speed that leads to a place beside another actor in time."""
    speed, time = leaf.state.known_speed, leaf.duration
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
    course = arrival(speed, missing, time)
    # Without courses of the speed an even change leads to the same place in the same time.
    even = Linear(speed, speed + 2.0 * missing / time, time)
    change = follow_course(leaf, course, even=even, told=call)
    if change.after.speed is None or change.after.speed.low < 0.0:
        raise Inexpressible("it would have to go backwards")
    return change
