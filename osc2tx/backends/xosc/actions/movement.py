"""Actions of vehicles and walkers (§8.8), and the modifiers of their movement (§8.9).

One entry of `ACTIONS` for each action, one of `MODIFIERS` for each modifier; environment, lights
and the like add theirs in files of their own (`registry`).
"""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.leaf import Change, Ending, Leaf, Performance
from osc2tx.backends.xosc.actions.position.paths import follow
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, to_goal
from osc2tx.backends.xosc.actions.speed.courses import hold_speed, speed_action
from osc2tx.backends.xosc.actions.speed.speed_changes import change_speed, jump_to
from osc2tx.backends.xosc.actions.speed.speed_modifiers import time_to_cover
from osc2tx.backends.xosc.entities.cast import PEDESTRIAN
from osc2tx.backends.xosc.facts.actors import FASTEST, TOP_SPEED, Pace, Profile, course_of_speed
from osc2tx.backends.xosc.facts.curves import Waypoint, thinned
from osc2tx.backends.xosc.facts.maps import Pose
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.state import LONGITUDINAL, WAY, known
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsShape
from osc2tx_shared.classes import replace

WAYS = {"along", "along_trajectory"}
"""Modifiers that say where to go."""


@action("drive", "move")
def _drive(leaf: Leaf) -> Performance:
    if leaf.state.pose is not None and leaf.member.walks:
        return _walk(leaf)
    changes = apply_modifiers(leaf)
    _note_open_speed(leaf)
    goals = (m for m in leaf.node.modifiers if m.at == "end" or m.name.startswith("along"))
    ends: Ending = "goal" if leaf.duration is None and any(goals) else "open"
    return Performance(changes, ends, time_to_cover(leaf), leaf.reached)


@action("walk")
def _walk(leaf: Leaf) -> Performance:
    if leaf.state.pose is None:
        return _drive(leaf)
    names = {call.name for call in leaf.node.modifiers}
    if names & WAYS and names <= WAYS | {"physical_movement", "speed"}:
        return Performance(apply_modifiers(leaf), "goal")
    if names == {"keep_position"}:
        leaf.ctx.report.exact("modifier keep_position", leaf.node.modifiers[0].span)
        is_still = leaf.state.speed == known(0.0)
        return Performance(() if is_still else (stand(leaf),), "open")
    for call in leaf.node.modifiers:
        if call.name != "speed" or call.at == "end":
            raise Inexpressible(f"`{call.name}` of a walker off the lanes", call.span)
    start = leaf.known_speed(UNKNOWN)
    told, speed = leaf.modifier("speed"), None
    if told is not None:
        with leaf.ctx.report_as(told.construct, told.span):
            speed = told.number("speed")
            told.finish()
    course = course_of_speed(start, start if speed is None else speed, Pace(), leaf.limits)
    return Performance((walk(leaf, course, leaf.duration),), "open")


@action("change_speed")
def _change_speed(leaf: Leaf) -> Performance:
    target = leaf.arguments.required("target")
    pace = leaf.arguments.pace(leaf.duration)
    if leaf.member.walks and leaf.state.pose is not None:
        start = leaf.known_speed("how fast it walks is not known")
        course = course_of_speed(start, target, pace, leaf.limits)
        change = walk(leaf, course, course.duration)
        return Performance((change, *apply_modifiers(leaf)), "goal", course.duration)
    change = change_speed(leaf, target, pace)
    if not change.actions:  # it has that speed, which stays for the duration
        return Performance((change, *apply_modifiers(leaf)), "goal", leaf.duration)
    return to_goal(leaf, change)


@action("assign_speed")
def _assign_speed(leaf: Leaf) -> Performance:
    target = leaf.arguments.required("speed")
    if leaf.member.walks and leaf.state.pose is not None:
        course = course_of_speed(target, target, Pace(), leaf.limits)
        return Performance((walk(leaf, course, 0.0),), "goal", 0.0)
    return Performance((jump_to(leaf, target),), "goal")


@action("keep_speed")
def _keep_speed(leaf: Leaf) -> Performance:
    changes = apply_modifiers(leaf)
    if leaf.state.is_changing_speed:
        after = leaf.state.finished(LONGITUDINAL)
        held = Change(LONGITUDINAL, (hold_speed(leaf.member.name),), 0.0, after, after)
        changes = (held, *changes)
    return Performance(changes, "open")


@action("remain_stationary", takes=(LONGITUDINAL,))
def _remain_stationary(leaf: Leaf) -> Performance:
    if leaf.state.speed == known(0.0):
        return Performance(apply_modifiers(leaf), "open")
    if leaf.member.walks:
        return Performance((stand(leaf),), "open")
    return Performance((change_speed(leaf, 0.0, FASTEST), *apply_modifiers(leaf)), "open")


_BESIDE_SPEED = ("keep_lane", "lane", "lateral", "change_lane")
"""Modifiers that say nothing of the speed."""


def _note_open_speed(leaf: Leaf) -> None:
    """Report that a driver who is told no speed slows down for bends, which no XML says."""
    roads, speed = leaf.ctx.roads, leaf.state.speed
    is_told = any(call.name not in _BESIDE_SPEED for call in leaf.node.modifiers)
    if roads is None or leaf.member.walks or is_told:
        return
    fastest = TOP_SPEED if speed is None else max(map(abs, speed))
    if fastest**2 * roads.sharpest_bend > leaf.limits.lateral:
        leaf.arguments.doubt(
            "no speed is stated: it slows down for bends in the world, but not in the XML",
            Remedy(instead="`keep_speed()` holds the speed in both"),
        )


# --- walkers off the lanes ------------------------------------------------------------------------
# Most tools move a pedestrian along the lane when they are told a speed, whatever its heading; only
# a trajectory takes it across the road.

UNKNOWN = "where and how fast it walks is not known"

SAMPLES = 20
"""Points of a change of the speed, before those that are not needed are left out."""

READ = 0.02
"""Seconds between the points of a change of a speed at which a condition looks."""

LONG = 3600.0
"""Seconds of the last stretch of a trajectory; something else ends it."""

PIECES = 64
"""Pieces of a change of the speed for the sum of its way."""


def walk(leaf: Leaf, course: Profile, time: float | None) -> Change:
    """Return the walk straight on in a course of the speed.

    It is over after a time (s), or when something else ends it.
    """
    state, end = leaf.state, known(course.value(course.duration))
    if state.pose is None:
        raise Inexpressible(UNKNOWN)
    action = _straight_on(leaf, state.pose, course)
    passed = end if state.speed is None else state.speed.over(end)
    during = after = replace(state, speed=passed, pose=None)
    if time is not None:
        pose = _ahead(state.pose, _covered(course, time))
        after = replace(state, speed=known(course.value(time)), pose=pose)
    return Change(WAY, (action,), time, during, after)


def stand(leaf: Leaf) -> Change:
    """Return the stop of a walker."""
    state, speed = leaf.state, leaf.state.known_speed
    if state.pose is None or speed is None:
        change = jump_to(leaf, 0.0)
        leaf.arguments.doubt("where it stops is only known during the run, so it stops at once")
        return change
    course = course_of_speed(speed, 0.0, FASTEST, leaf.limits)
    return walk(leaf, course, course.duration)


def _straight_on(leaf: Leaf, start: Pose, course: Profile) -> xml.PrivateAction:
    """Return the action with which a walker goes on along its heading until something else."""
    keeps_heading = leaf.ctx.profile.walkers_keep_heading and leaf.member.kind == PEDESTRIAN
    if not keeps_heading:
        return _trajectory(leaf, start, course)
    goal = course.value(course.duration)
    shape: DynamicsShape = "linear" if course.duration else "step"
    return speed_action(goal, shape, "time", course.duration)


def _trajectory(leaf: Leaf, start: Pose, course: Profile) -> xml.PrivateAction:
    """Return the way of a walker; its last stretch is long.

    Its speed is even between two points, so those of a speed that is read are close together.
    """
    is_read = leaf.ctx.is_speed_read(leaf.member.name)
    samples = max(SAMPLES, math.ceil(course.duration / READ)) if is_read else SAMPLES
    times = [0.0]
    if course.duration > 0.0:
        times += [course.duration * index / samples for index in range(1, samples + 1)]
    times.append(times[-1] + LONG)
    places = ((time, _ahead(start, _covered(course, time))) for time in times)
    points = [Waypoint(time, place.x, place.y, place.z, place.h) for time, place in places]
    vertices = [
        (
            point.time,
            xml.WorldPosition(
                x=round(point.x, 6), y=round(point.y, 6), z=point.z, h=round(start.h, 9)
            ),
        )
        for point in (points if is_read else thinned(points, is_timed=True))
    ]
    return follow(leaf, vertices, is_timed=True, is_exact=True)


def _ahead(pose: Pose, way: float) -> Pose:
    """Return the pose so far (m) straight on."""
    x, y = pose.x + way * math.cos(pose.h), pose.y + way * math.sin(pose.h)
    return Pose(x, y, pose.z, pose.h)


def _covered(course: Profile, time: float) -> float:
    """Return the way (m) covered after a time: Simpson's rule, then the speed at the end."""
    changing = min(time, course.duration)
    step = changing / PIECES
    way = (time - changing) * course.value(course.duration)
    if changing <= 0.0:
        return way
    speed = course.value(0.0)
    for index in range(PIECES):
        left, right = index * step, (index + 1) * step
        before, speed = speed, course.value(right)
        way += (before + 4.0 * course.value(0.5 * (left + right)) + speed) / 6.0 * step
    return way
