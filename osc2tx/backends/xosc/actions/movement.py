"""Actions of vehicles and walkers (§8.8), and the modifiers of their movement (§8.9).

One entry of `ACTIONS` for each action, one of `MODIFIERS` for each modifier; environment, lights
and the like add theirs in files of their own (`registry`).
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Change, Ending, Leaf, Performance
from osc2tx.backends.xosc.actions.position.walkers import UNKNOWN, stand, walk
from osc2tx.backends.xosc.actions.registry import action, apply_modifiers, to_goal
from osc2tx.backends.xosc.actions.speed.courses import hold_speed
from osc2tx.backends.xosc.actions.speed.speed_changes import change_speed, jump_to
from osc2tx.backends.xosc.actions.speed.speed_modifiers import time_to_cover
from osc2tx.backends.xosc.facts.actors import FASTEST, Pace, course_of_speed
from osc2tx.backends.xosc.state import LONGITUDINAL, known
from osc2tx.losses.entries import Inexpressible

WAYS = {"along", "along_trajectory"}
"""Modifiers that say where to go."""


@action("drive", "move")
def _drive(leaf: Leaf) -> Performance:
    if leaf.state.pose is not None and leaf.member.walks:
        return _walk(leaf)
    changes = apply_modifiers(leaf)
    goals = [name for name in ir.goals_of(leaf.node) if name != "distance"]
    ends: Ending = "goal" if leaf.duration is None and goals else "open"
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
