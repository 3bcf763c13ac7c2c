"""Modifiers of lane and lateral position (§8.9.9, §8.9.14 to §8.9.16)."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.lateral.lanes import drawn_side, lane_change, lanes_to
from osc2tx.backends.xosc.actions.lateral.lateral_offsets import offset_change, offset_in_lane
from osc2tx.backends.xosc.actions.leaf import Arguments, Change, Leaf
from osc2tx.backends.xosc.actions.registry import modifier
from osc2tx.backends.xosc.actions.speed.gap_elements import Gap, reach
from osc2tx.backends.xosc.actions.speed.speed_changes import may_jump
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.state import known
from osc2tx.backends.xosc.values.constants import Member, Named


@modifier("change_lane")
def _change_lane(leaf: Leaf, call: ir.ModifierCall, arguments: Arguments) -> tuple[Change, ...]:
    number = arguments.number("lane")
    count = 1 if number is None else round(number)
    side = arguments.member("side", "") or drawn_side(leaf, call, count)
    lanes = count if side == "left" else -count
    return (_to(leaf, call, arguments, lanes, None, None),)


@modifier("lane")
def _lane(leaf: Leaf, call: ir.ModifierCall, arguments: Arguments) -> tuple[Change, ...]:
    reference = arguments.entity("same_as") or arguments.entity("side_of")
    if reference is None:
        return _numbered(leaf, call, arguments)
    lanes = 0
    if "side_of" in arguments:
        number = arguments.number("lane")
        count = 1 if number is None else round(number)
        lanes = count if arguments.member("side", "left") == "left" else -count
    own = lanes_to(leaf, reference, lanes)
    if own == 0:
        return ()
    return (_to(leaf, call, arguments, lanes, reference.name, own),)


def _numbered(leaf: Leaf, call: ir.ModifierCall, arguments: Arguments) -> tuple[Change, ...]:
    """Return the change to a lane with a number, counted from an edge of the road."""
    number, edge = arguments.number("lane"), arguments.member("from", "right")
    roads, here = leaf.ctx.roads, leaf.state.lane
    if roads is None or here is None:
        raise Inexpressible("which lane it is in is only known during the run", call.span)
    target = roads.with_number(here, 1 if number is None else round(number), edge)
    lanes = None if target is None else roads.lanes_between(here, target)
    if lanes is None:
        raise Inexpressible(f"there is no such lane beside lane {here.lane}", call.span)
    if lanes == 0:
        return ()
    return (_to(leaf, call, arguments, lanes, None, None),)


def _to(
    leaf: Leaf,
    call: ir.ModifierCall,
    arguments: Arguments,
    lanes: int,
    reference: str | None,
    own_lanes: int | None,
) -> Change:
    """Return the change to a lane beside that of the actor or of a reference."""
    if any(other.name == "lateral" and other.at != "start" for other in leaf.node.modifiers):
        instead = "the action `change_lane` with its `offset` is exact"
        remedy = Remedy(instead=instead, asks=("LaneChangeActionDynamics",))
        raise Inexpressible(
            "a lane change and an offset are two lateral actions", call.span, remedy
        )
    profile, peak = _shape(leaf, arguments)
    in_time = call.at == "end" and profile != "asap" and peak is None
    return lane_change(
        leaf,
        lanes,
        0.0,
        profile,
        peak,
        reference,
        duration=leaf.duration if in_time else None,
        own_lanes=own_lanes,
        jumps=may_jump(leaf),
    )


def _shape(leaf: Leaf, arguments: Arguments) -> tuple[str, float | None]:
    """Return profile and peak of a `shape`."""
    shape = arguments.get("shape")
    if shape is None:
        return "none", None
    values = leaf.ctx.values
    if not isinstance(shape, Named) or not values.is_library_shape(shape.name):
        raise Inexpressible("a user-defined shape is computed during the run")
    profile = values.field(shape.name, ("rate_profile",))
    peak = values.field(shape.name, ("rate_peak",))
    return (
        profile.name if isinstance(profile, Member) else "none",
        float(peak) if isinstance(peak, (int, float)) else None,
    )


@modifier("lateral")
def _lateral(leaf: Leaf, call: ir.ModifierCall, arguments: Arguments) -> tuple[Change, ...]:
    reference = arguments.entity("side_of")
    if reference is not None:
        return _beside_another(leaf, call, arguments, reference)
    offset = offset_in_lane(leaf.ctx, arguments, leaf.member, leaf.state.lane)
    profile, peak = _shape(leaf, arguments)
    if leaf.state.offset == known(offset):
        return ()
    in_time = call.at == "end" and profile != "asap" and peak is None
    return (offset_change(leaf, offset, profile, peak, leaf.duration if in_time else None),)


def _beside_another(
    leaf: Leaf, call: ir.ModifierCall, arguments: Arguments, reference: CastMember
) -> tuple[Change, ...]:
    distance = arguments.number("distance")
    if distance is None:
        distance = arguments.number("distance_range")
    if distance is None:
        raise Inexpressible("no distance is stated", call.span)
    side = "left" if arguments.member("side", "left") == "left" else "right"
    gap = Gap(reference, side, distance, is_time=False, is_headway=False)
    return _beside(leaf, call, arguments, gap)


def _beside(
    leaf: Leaf, call: ir.ModifierCall, arguments: Arguments, gap: Gap
) -> tuple[Change, ...]:
    """Return the control of the distance across the road from another actor."""
    measured = arguments.member("measure_by", "center_to_center")
    facing = ("left_to_right", "closest") if gap.side == "right" else ("right_to_left", "closest")
    half = 0.5 * (leaf.member.shape.width + gap.reference.shape.width)
    size = gap.size
    if measured == "center_to_center":
        size -= half
    elif measured not in facing:
        raise Inexpressible(f"a distance from `{measured}` across the road", call.span)
    if size < 0.0:
        raise Inexpressible("they would overlap, and the XML counts between their sides", call.span)
    gap = Gap(gap.reference, gap.side, size, is_time=False, is_headway=False)
    return (reach(leaf, gap, keeps=call.at != "end"),)
