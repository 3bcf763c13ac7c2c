"""Modifiers of the position along the road (§8.9.8, §8.9.12)."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Arguments, Change, Leaf
from osc2tx.backends.xosc.actions.position.points_and_lines import xml_position
from osc2tx.backends.xosc.actions.position.xml_positions import at_place
from osc2tx.backends.xosc.actions.registry import modifier
from osc2tx.backends.xosc.actions.speed.gap_elements import Gap, hold, missing_at_start
from osc2tx.backends.xosc.actions.speed.speed_changes import through_points
from osc2tx.backends.xosc.actions.speed.speed_elements import speed_action
from osc2tx.backends.xosc.actions.speed.speed_notes import NEAR, PROFILE_ACTION, with_profiles
from osc2tx.backends.xosc.actions.speed.steady_speeds import steady_speed
from osc2tx.backends.xosc.facts.actors import Linear, way_between
from osc2tx.backends.xosc.report import Inexpressible, Metres, Remedy
from osc2tx.backends.xosc.state import LONGITUDINAL, known
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import dataclass, replace


@modifier("position")
def _position(leaf: Leaf, call: ir.ModifierCall, arguments: Arguments) -> tuple[Change, ...]:
    if "at_point" in arguments:
        return _at_point(leaf, call, arguments)
    ahead, behind = arguments.entity("ahead_of"), arguments.entity("behind")
    reference = ahead or behind
    if reference is None:
        along = _size(arguments, "distance")
        if along is None:
            raise Inexpressible("no distance is stated", call.span)
        return _along_road(leaf, call, along)
    for name in ("movement_mode", "track"):
        if name in arguments and arguments.member(name, "") not in ("other", "actual"):
            raise Inexpressible(f"`{name}` has no counterpart", call.span)
    distance, time = (_size(arguments, name) for name in ("distance", "time"))
    if distance is None and time is None:
        raise Inexpressible("neither a distance nor a time is stated", call.span)
    size = distance if distance is not None else time
    assert size is not None
    side = "ahead" if ahead is not None else "behind"
    if size < 0.0:
        size, side = -size, "behind" if side == "ahead" else "ahead"
    gap = Gap(reference, side, size, is_time=distance is None, is_headway=False)
    if call.at == "end":
        return (_in_time(leaf, call, gap),)
    if not leaf.is_start:
        raise Inexpressible(
            "it holds from the start of the action on, and where both are then only the run shows",
            call.span,
            Remedy(instead="`at: end`, or `keep_space_gap` from the distance that is there then"),
        )
    return (_held(leaf, gap, keeps=True),)


def _size(arguments: Arguments, name: str) -> float | None:
    given = arguments.number(name)
    return arguments.number(f"{name}_range") if given is None else given


def _held(leaf: Leaf, gap: Gap, *, keeps: bool) -> Change:
    distance, time = (None, gap.size) if gap.is_time else (gap.size, None)
    missing = None if distance is None else missing_at_start(leaf, gap, distance, freespace=False)
    return hold(leaf, gap, distance, time, freespace=False, keeps=keeps, missing=missing)


def _at_point(leaf: Leaf, call: ir.ModifierCall, arguments: Arguments) -> tuple[Change, ...]:
    """End an invocation at a point that the way leads to."""
    point = xml_position(leaf.ctx, arguments.get("at_point"))
    arguments.get("project_on_route")
    if call.at != "end" or leaf.duration is not None:
        raise Inexpressible("a point that is not the end of the way", call.span)
    there = at_place(leaf.ctx, point.element, point.lane, f"modifier {call.name}", call.span)
    leaf.reached = tuple(map(leaf.on_me, there))
    return ()


def _along_road(leaf: Leaf, call: ir.ModifierCall, distance: float) -> tuple[Change, ...]:
    """End an invocation so far (m) along the road; it keeps its lane until then."""
    lane, roads = leaf.state.lane, leaf.ctx.roads
    if call.at != "end" or leaf.duration is not None:
        raise Inexpressible("a distance from the start of the road that is not the end of the way")
    if lane is None or roads is None:
        raise Inexpressible("which road it is on is only known during the run", call.span)
    place = roads.from_entry(lane, distance)
    if place is None:
        raise Inexpressible(f"the road ends before {distance:g} m", call.span)
    goal = xml.LanePosition(
        roadId=place.road,
        laneId=place.lane,
        s=round(place.s, 6),
        offset=round(place.offset * (roads.leftwards(place) or 1), 6) or 0.0,
    )
    there = at_place(leaf.ctx, goal, place, f"modifier {call.name}", call.span)
    leaf.reached = tuple(map(leaf.on_me, there))
    return ()


# --- to be somewhere in time --------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Arrival:
    """The speed with the least effort that covers a way in a time, with a free speed at the end.

    The acceleration falls evenly to zero: a(t) = 3 m (T - t) / T^3 for what is missing, m.

    Attributes:
        start: m/s.
        missing: Metres that the speed at the start would not cover.
        duration: Seconds.
    """

    start: float
    missing: float
    duration: float

    def value(self, t: float) -> float:
        """Return the speed (m/s) after some seconds."""
        share = t / self.duration
        return self.start + 3.0 * self.missing / self.duration * share * (1.0 - 0.5 * share)


def _in_time(leaf: Leaf, call: ir.ModifierCall, gap: Gap) -> Change:
    """Return the change of the speed that leads to a place beside another actor in time."""
    ctx, speed = leaf.ctx, leaf.state.speed
    apart = ctx.init_gaps.get((leaf.member.name, gap.reference.name)) if leaf.is_start else None
    theirs = steady_speed(leaf, gap.reference)
    is_known = speed is not None and speed.is_known and apart is not None and theirs is not None
    if not (is_known and leaf.duration is not None and not gap.is_time):
        ctx.report.approximate(
            f"modifier {call.name}",
            call.span,
            "where both are by then is only known during the run",
            "the place is reached, but when is up to the tool",
        )
        return _held(leaf, gap, keeps=False)
    assert speed is not None and apart is not None and theirs is not None
    time = leaf.duration
    assert time is not None
    way = apart + (gap.size if gap.side == "ahead" else -gap.size)
    arrival = Arrival(speed.low, way + (theirs - speed.low) * time, time)
    can_draw = ctx.can(PROFILE_ACTION, "1.2")
    # Without courses of the speed an even change leads to the same place in the same time.
    end = arrival.value(time) if can_draw else speed.low + 2.0 * arrival.missing / time
    if end < 0.0:
        raise Inexpressible("it would have to go backwards", call.span)
    after = replace(leaf.state, speed=known(end)).finished(LONGITUDINAL)
    during = replace(after, speed=speed.over(known(end)))
    even = Linear(speed.low, end, time)
    leaf.course = arrival if can_draw else even
    if not can_draw:
        _note_even_arrival(leaf, call, arrival, even)
    action = (
        through_points(arrival) if can_draw else speed_action(round(end, 9), "linear", "time", time)
    )
    return Change(LONGITUDINAL, (action,), time, during, after)


def _note_even_arrival(leaf: Leaf, call: ir.ModifierCall, arrival: Arrival, even: Linear) -> None:
    """Report that an even change leads to the same place in time, with another speed there."""
    apart = way_between(arrival, even)
    if apart <= NEAR:
        return
    faster = even.end - arrival.value(arrival.duration)
    leaf.ctx.report.approximate(
        f"modifier {call.name}",
        call.span,
        "a speed that changes unevenly needs SpeedProfileAction; it changes evenly instead",
        f"{Metres(apart, 'on the way')}; it arrives {abs(faster):.2g} m/s too"
        f" {'fast' if faster > 0.0 else 'slow'}",
        with_profiles(leaf.ctx),
    )
