"""A good trace has no violation; perturbed beyond its tolerance, it has the one of the modifier."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx_runtime.domain.modifiers import MODIFIERS
from osc2tx_runtime.domain.monitoring.registry import CLARIFIED, MONITORS, UNMONITORED
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.modifier import Modifier
from tests.runtime.world.two_cars import scenario

from .action_cases import ACTION_CASES
from .cases import ALL, END, START, Case
from .kit import Body, found, lanes_left, tilted, turned
from .modifier_cases import MODIFIER_CASES

CASES = [*MODIFIER_CASES, *ACTION_CASES]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_good_trace_has_none(case: Case) -> None:
    assert found(case.body) == []


@settings(max_examples=8, deadline=None)
@given(step=st.integers(1, 39), by=st.floats(-3.0, 3.0))
@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_perturbed_one_has_that_of_the_modifier(case: Case, step: int, by: float) -> None:
    size = math.copysign(1.0, by) if case.change is lanes_left else by
    if case.change in (turned, tilted):
        size = 0.1 * by
    if abs(abs(size) - case.tolerance) < 1e-3 + case.slack:
        return
    steps = {ALL: (step,), START: (case.first,), END: range(-case.last, 0)}[case.at]
    violations = found(case.body, [(case.actor, each, case.change, size) for each in steps])
    names = {(each.action, each.modifier) for each in violations}
    assert ((f"a {case.action}", case.name) in names) == (abs(size) > case.tolerance)


def test_every_modifier_has_a_monitor_or_a_reason() -> None:
    of_the_map = {name for name, kind in MODIFIERS.items() if ".map." in kind.__module__}
    assert MODIFIERS.keys() - of_the_map == MONITORS.keys() | (
        UNMONITORED.keys() & MODIFIERS.keys()
    )
    assert not MONITORS.keys() & UNMONITORED.keys()
    assert not CLARIFIED.keys() & UNMONITORED.keys()


ABSOLUTE = ("acceleration", "along", "along_trajectory", "change_lane", "change_speed", "distance")
WITHOUT_CONDITION: dict[str, tuple[str, ...]] = {
    "movement_mode": tuple(MONITORS),
    "track": ABSOLUTE,  # they have no reference
    "at": ("along", "along_trajectory", "change_lane", "change_speed", "distance"),  # one meaning
    "shape": ("along", "change_lane", "distance", "yaw", "orientation"),
    "h": ("position",),  # what placement alone reads
    "z": ("position",),
    "frame": ("position",),
}
"""Parameters that state nothing to be perturbed, or only how it is reached, by modifier."""


def modifiers_of(body: Body) -> Iterator[Modifier]:
    """The modifiers in a scenario."""
    for node in scenario(body)().create_tree().iterate():
        if isinstance(node, Action):
            yield from node.modifiers


def test_every_kind_is_perturbed() -> None:
    """Each monitor, each action that stands for modifiers, each parameter of a modifier."""
    assert {case.name for case in MODIFIER_CASES} == MONITORS.keys()
    assert {case.action for case in ACTION_CASES} == CLARIFIED.keys()
    given = {
        (modifier.name, name)
        for case in MODIFIER_CASES
        for modifier in modifiers_of(case.body)
        if modifier.name == case.name
        for name in modifier.given()
    }
    missing = {
        (name, parameter.name)
        for name in MONITORS
        for parameter in fields(MODIFIERS[name])
        if (name, parameter.name) not in given
        and name not in WITHOUT_CONDITION.get(parameter.name, ())
    }
    assert not missing
