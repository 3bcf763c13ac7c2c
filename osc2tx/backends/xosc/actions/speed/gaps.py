"""Gaps and headways to another actor (§8.8.3.4 to §8.8.3.11).

A gap counts between facing ends or sides, as a distance with free space does in the XML; a headway
counts between fronts, the XML between reference points. A gap that is to be kept is the one that
there is, which the XML cannot ask for: it has to be known from what stands before.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from math import inf
from typing import Literal, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.lateral.lanes import lateral
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, to_goal
from osc2tx.backends.xosc.actions.speed.courses import longitudinal, speed_action, speed_of
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import TOP_SPEED
from osc2tx.backends.xosc.state import LATERAL
from osc2tx.losses.bounds import Bound, Metres, UpToTool
from osc2tx.losses.entries import GENERIC, Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import LateralDisplacement, LongitudinalDisplacement
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.steps import DEFAULT_STEP

SURE = 1e-6
"""Metres by which a gap may be another one and still counts as there."""

LATERAL_SPEED = 3.0
"""m/s across the road; the DSL says none."""

ALONG: Mapping[str, LongitudinalDisplacement] = {
    "ahead": "leadingReferencedEntity",
    "behind": "trailingReferencedEntity",
}
ACROSS: Mapping[str, LateralDisplacement] = {
    "left": "leftToReferencedEntity",
    "right": "rightToReferencedEntity",
}
OPPOSITE = {"ahead": "behind", "behind": "ahead", "left": "right", "right": "left"}

Between: TypeAlias = Literal["ends", "fronts", "points"]


@dataclass(frozen=True, slots=True)
class Gap:
    """A distance to another actor.

    Attributes:
        reference: The other one.
        side: On which side of it the actor is: `ahead`, `behind`, `left` or `right`.
        size: Metres, or seconds.
        is_time: It is in seconds.
        between: What it counts between: facing `ends`, `fronts`, or reference `points`.
    """

    reference: CastMember
    side: str
    size: float
    is_time: bool = False
    between: Between = "ends"

    @property
    def is_lateral(self) -> bool:
        """Whether it counts across the road."""
        return self.side in ACROSS

    def beyond_points(self, member: CastMember) -> float:
        """Return by how much (m) a gap of an actor is larger than between reference points."""
        behind, ahead = member.shape, self.reference.shape
        if self.side == "ahead":
            behind, ahead = ahead, behind
        match self.between:
            case "points":
                return 0.0
            case "fronts":
                return ahead.front - behind.front
            case "ends":
                return -ahead.rear - behind.front


ARRIVING = Remedy(
    instead="`drive(duration: …)` with `position(…, at: end)`, while the other one keeps its speed,"
    " is exact",
    asks=("SpeedActionDynamics",),
)


def reach(leaf: Leaf, gap: Gap, *, keeps: bool, missing: float | None = None) -> Change:
    """Return the control that reaches a gap, or keeps it when it is reached.

    Without limits a tool keeps it rigid: so it is said where it is there already. What is missing
    (m) at the start may be unknown.
    """
    if gap.is_lateral:
        return _reach_lateral_gap(leaf, gap, keeps=keeps, missing=missing)
    size, freespace = _measured(leaf, gap)
    if missing is None and not (keeps and gap.is_time):
        missing = _missing(leaf, gap)
    is_rigid = keeps and missing is not None and missing <= SURE
    tool, newer = leaf.ctx.profile, leaf.ctx.version >= "1.1"
    if is_rigid and not gap.is_time and "LongitudinalDistanceAction" in tool.unsupported:
        name = gap.reference.name
        leaf.arguments.approximate(
            f"{tool.name} controls no gap; it gets the speed of {name} in each step",
            "off by the way that it takes to change its speed",
            GENERIC,
        )
        leaf.ctx.followed.setdefault(leaf.member.name, set()).add(name)
        return leaf.at_open_speed(speed_action(speed_of(name)), inf)
    if not is_rigid:
        _note_control(leaf, missing)
    leaf.follow(gap.reference, rigid=is_rigid)
    limits = leaf.limits
    constraints = xml.DynamicConstraints(
        maxAcceleration=limits.acceleration,
        maxDeceleration=limits.deceleration,
        maxSpeed=None if newer else TOP_SPEED,
    )
    action = xml.LongitudinalDistanceAction(
        None if is_rigid else constraints,
        entityRef=gap.reference.name,
        distance=None if gap.is_time else size,
        timeGap=size if gap.is_time else None,
        freespace=freespace,
        continuous=keeps,
        displacement=ALONG[gap.side] if newer else None,
        coordinateSystem="lane" if newer else None,
    )
    if is_rigid and (gap.is_time or tool.fits_gaps):
        leaf.arguments.doubt("it fits at once to each change of a speed, and to boxes that turn")
    return leaf.at_open_speed(longitudinal(action), inf if keeps else None)


def _reach_lateral_gap(leaf: Leaf, gap: Gap, *, keeps: bool, missing: float | None) -> Change:
    if gap.is_time:
        raise Inexpressible("there is no time across the road in OpenSCENARIO XML")
    newer = leaf.ctx.version >= "1.1"
    if not newer:
        leaf.arguments.doubt(
            "OpenSCENARIO XML 1.0 counts a lateral distance across the actor, not across the road",
            Remedy(version="1.1"),
        )
    is_rigid = keeps and missing is not None and missing <= SURE
    if not is_rigid:
        _note_control(leaf, missing)
    most = leaf.limits.lateral
    # Between reference points: the free space of the XML shrinks where boxes turn.
    sides = 0.5 * (leaf.member.shape.width + gap.reference.shape.width)
    constraints = xml.DynamicConstraints(
        maxAcceleration=most, maxDeceleration=most, maxSpeed=LATERAL_SPEED
    )
    action = xml.LateralDistanceAction(
        None if is_rigid else constraints,
        entityRef=gap.reference.name,
        distance=round(gap.size + sides, 6),
        freespace=False,
        continuous=keeps,
        displacement=ACROSS[gap.side] if newer else None,
        coordinateSystem="road" if newer else None,
    )
    after = replace(leaf.state, offset=None, lane=None).finished(LATERAL)
    return Change(LATERAL, (lateral(action),), inf if keeps else None, after, after)


def _present_gap(leaf: Leaf, gap: Gap) -> float | None:
    """Return how far (m) an actor is from another one, if that is known, counted as a gap."""
    apart = leaf.starts_behind(gap.reference)
    if apart is None:
        return None
    return (apart if gap.side == "behind" else -apart) + gap.beyond_points(leaf.member)


def _missing(leaf: Leaf, gap: Gap) -> float | None:
    """Return how far (m) an actor is from a gap, if that is known."""
    present = _present_gap(leaf, gap)
    speed = leaf.state_of(gap.reference, always=True).known_speed if gap.is_time else 1.0
    return None if present is None or speed is None else abs(present - gap.size * speed)


def _note_control(leaf: Leaf, missing: float | None) -> None:
    """Report that a tool has a law of its own for a gap; what is missing (m) may be unknown."""
    bound: Bound = UpToTool("until it is there, at most by what was missing at its start")
    if missing is not None:
        bound = Metres(missing + _overshoot(leaf, missing), "until it is there")
    # The standard has no law for the control of gaps.
    how = "how it closes the gap, and when it is there, is up to the tool"
    leaf.arguments.approximate(how, bound, ARRIVING)


def _overshoot(leaf: Leaf, missing: float) -> float:
    """Return how far (m) a tool that moves in steps gets beyond, within the limits of the actor.

    It has looked one step before, and is at most as fast as after half of what is missing (m).
    """
    rate = max(leaf.limits.acceleration, leaf.limits.deceleration)
    return DEFAULT_STEP * math.sqrt(rate * missing)


def _measured(leaf: Leaf, gap: Gap) -> tuple[float, bool]:
    """Return the size as the XML counts it, and whether it counts between the facing ends."""
    if gap.between == "ends":
        return round(gap.size, 6), True
    if gap.between == "points":
        return gap.size, False
    beyond = 0.0 if gap.is_time else gap.beyond_points(leaf.member)
    return round(gap.size - beyond, 6), False


@action("change_space_gap", "change_time_gap", "change_space_headway", "change_time_headway")
def _change_gap(leaf: Leaf) -> Performance:
    gap = _asked_for(leaf, leaf.node, leaf.arguments)
    change = reach(leaf, gap, keeps=False)
    if leaf.node.duration is not None:
        leaf.ctx.report.approximate(
            leaf.arguments.construct,
            leaf.node.duration.span,
            "an action on a distance takes as long as the tool wants",
            "the distance is reached, but not at that time",
        )
    return to_goal(leaf, change)


@action("keep_space_gap", "keep_time_gap", "keep_space_headway", "keep_time_headway")
def _keep_gap(leaf: Leaf) -> Performance:
    reference = leaf.arguments.required_entity("reference")
    direction = leaf.arguments.member("direction", "longitudinal")
    found = _reached_before(leaf, reference, direction)
    missing: float | None = 0.0
    if found is None and direction == "longitudinal":
        found = _as_at_start(leaf, reference)
        same = leaf.state.speed == leaf.ctx.at_start[reference.name].speed
        missing = 0.0 if same else None
    if found is None:
        raise Inexpressible(
            "the present gap is not known before the run, and the XML has no action that keeps it",
        )
    change = reach(leaf, found, keeps=True, missing=missing)
    return Performance((change, *apply_modifiers(leaf)), "open")


def _asked_for(leaf: Leaf, node: ir.Invoke, arguments: Arguments) -> Gap:
    """Return the gap that a `change_…` asks for; a negative one is on the other side."""
    target, reference = arguments.required("target"), arguments.required_entity("reference")
    side = arguments.member("direction", "")
    if side in ("inside", "outside"):
        side = "left" if leaf.is_left(side) else "right"
    if target < 0.0:
        target, side = -target, OPPOSITE[side]
    return Gap(reference, side, target, *_counted(node))


def _counted(node: ir.Invoke) -> tuple[bool, Between]:
    """Return whether an action is about a time, and between what the gap of it counts."""
    return "_time_" in node.action, "fronts" if node.action.endswith("headway") else "ends"


def _reached_before(leaf: Leaf, reference: CastMember, direction: str) -> Gap | None:
    """Return the gap that the invocation before has made, counted as this one counts."""
    is_time, between = _counted(leaf.node)
    before = ir.predecessor(leaf.ctx.scenario.body, leaf.node)
    if before is None or before.until or before.actor is None:
        return None
    if not before.action.startswith(("change_space_", "change_time_")):
        return None
    if leaf.ctx.values.actor(before.actor) != leaf.member.actor.name:
        return None
    gap = _asked_for(leaf, before, Arguments(leaf.ctx, before))
    same = (gap.reference.name, gap.is_time, gap.is_lateral)
    if same != (reference.name, is_time, direction == "lateral"):
        return None
    if gap.between == between:
        return gap
    if is_time:
        return None
    wanted = replace(gap, between=between)
    size = gap.size - gap.beyond_points(leaf.member) + wanted.beyond_points(leaf.member)
    return replace(wanted, size=size)


def _as_at_start(leaf: Leaf, reference: CastMember) -> Gap | None:
    """Return the gap of the initial placement, if it is still the same."""
    apart = leaf.starts_behind(reference)
    if apart is None:
        return None
    side = "behind" if apart > 0.0 else "ahead"
    gap = Gap(reference, side, 0.0, *_counted(leaf.node))
    size = _present_gap(leaf, gap)
    assert size is not None
    if gap.is_time:
        trailing = leaf.state if gap.side == "behind" else leaf.ctx.at_start[reference.name]
        if not trailing.known_speed or trailing.known_speed < 0.0:
            return None
        size /= trailing.known_speed
    return replace(gap, size=max(size, 0.0))
