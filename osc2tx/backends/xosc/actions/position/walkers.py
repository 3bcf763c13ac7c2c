"""Walkers off the lanes: trajectories straight on.

Most tools move a pedestrian along the lane when they are told a speed, whatever its heading; only
a trajectory takes it across the road.
"""

from __future__ import annotations

import math
from itertools import pairwise

from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf
from osc2tx.backends.xosc.actions.position.paths import follow
from osc2tx.backends.xosc.actions.position.xml_positions import world_position
from osc2tx.backends.xosc.actions.speed.courses import speed_action
from osc2tx.backends.xosc.actions.speed.speed_changes import jump_to
from osc2tx.backends.xosc.entities.cast import PEDESTRIAN
from osc2tx.backends.xosc.facts.actors import FASTEST, Profile, course_of_speed, simpson
from osc2tx.backends.xosc.facts.curves import Waypoint, thinned
from osc2tx.backends.xosc.facts.maps import Pose
from osc2tx.backends.xosc.state import WAY, known
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsShape
from osc2tx_shared.classes import replace

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
    pose = state.pose if passed == known(0.0) else None  # who stands stays there
    during = after = replace(state, speed=passed, pose=pose)
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


def walk_on(leaf: Leaf, changes: Changes) -> xml.PrivateAction | None:
    """Return how a walker goes on where its way ends: tools would send it along the lane."""
    state = leaf.ctx.states[leaf.member.name]
    pose, speed = state.pose, state.known_speed
    actions = [each for change in changes if change.domain != WAY for each in change.actions]
    is_on_its_way = leaf.member.walks and any(a.find(xml.RoutingAction) for a in actions)
    if not (pose and speed and is_on_its_way):
        return None
    return _straight_on(leaf, pose, course_of_speed(speed, speed, FASTEST, leaf.limits))


def _straight_on(leaf: Leaf, start: Pose, course: Profile) -> xml.PrivateAction:
    """Return the action with which a walker goes on along its heading until something else."""
    if not (leaf.ctx.profile.walkers_keep_heading and leaf.member.kind == PEDESTRIAN):
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
    kept = points if is_read else thinned(points, is_timed=True)
    vertices = [(p.time, world_position(Pose(p.x, p.y, p.z, start.h))) for p in kept]
    return follow(leaf, vertices, is_timed=True, is_exact=True)


def _ahead(pose: Pose, way: float) -> Pose:
    """Return the pose so far (m) straight on."""
    x, y = pose.x + way * math.cos(pose.h), pose.y + way * math.sin(pose.h)
    return Pose(x, y, pose.z, pose.h)


def _covered(course: Profile, time: float) -> float:
    """Return the way (m) covered after a time: a sum over the change, then the speed at the end."""
    changing = min(time, course.duration)
    ends = [changing * index / PIECES for index in range(PIECES + 1)]
    way = sum(simpson(course, left, right) for left, right in pairwise(ends))
    return way + (time - changing) * course.value(course.duration)
