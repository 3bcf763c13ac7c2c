"""`exact-physics` against closed forms: bodies that only velocities move are where formulas say.

The server alone is asked, by its snapshots: no trace of ours takes part.
"""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from osc2tx_runtime import RunResult, RunSettings

from .runs import in_carla, run_all
from .stand_in.process import StandInProcess
from .test_exact_physics import DT, Looks, generated, looks

assert looks  # a fixture

HEAD = """
import osc.standard.all
namespace null use std, stdtypes
scenario formula:
    road: map with:
        keep(it.map_file == "{map}.xodr")
    ego: vehicle
"""
PLACE_OFF, SPEED_OFF = 2e-3, 0.01  # m, m/s: poses travel in single precision
AXLE = 4.514 / 2.0 - 0.92  # m from the rear axle of a car to the middle of its box


def seen(text: str, folder: Path, server: StandInProcess, looks: Looks) -> list[list[float]]:
    """Run a scenario; return the states of its actor in the steps of the run."""
    settings = in_carla(RunSettings(), server.port, control={"": "exact-physics"})
    (result,) = run_all(generated(text, folder), settings).values()
    assert isinstance(result, RunResult), result
    assert result.status == "success"
    return [state for look in looks[-result.steps :] for state in look.values()]


def test_a_constant_acceleration(stand_in: StandInProcess, looks: Looks, tmp_path: Path) -> None:
    """x = x0 + v0 t + a t^2 / 2; others see the mean speed of each step."""
    v0, a, end = 10.0, 2.0, 5.0
    text = HEAD.format(map="highway") + f"""
    do serial:
        ego.change_speed(target: {v0 + a * end}mps, rate_profile: constant,
            rate_peak: {a}mpss) with:
            lane(2, at: start)
            position(100m, at: start)
            speed({v0}mps, at: start)
"""
    states = seen(text, tmp_path, stand_in, looks)
    assert len(states) == round(end / DT)
    for number, state in enumerate(states, 1):
        t = number * DT
        x, mean = 100.0 + AXLE + v0 * t + 0.5 * a * t * t, v0 + a * (t - 0.5 * DT)
        assert state[0] == pytest.approx(x, abs=PLACE_OFF), t
        assert state[6] == pytest.approx(mean, abs=SPEED_OFF), t
        assert state[7] == pytest.approx(0.0, abs=SPEED_OFF)


def test_a_circle(stand_in: StandInProcess, looks: Looks, tmp_path: Path) -> None:
    """The rear axle stays on its circle; it turns by v / r, and moves along the chord."""
    v, number_of_steps = 12.0, 80
    text = HEAD.format(map="left_hand") + f"""
    do serial:
        ego.drive(duration: {number_of_steps * DT}s) with:
            lane(1, at: start)
            position(165m, at: start)
            speed({v}mps)
"""
    states = seen(text, tmp_path, stand_in, looks)
    assert len(states) == number_of_steps
    radius = math.dist(axle_of(states[0]), MIDDLE)
    assert abs(radius - 1.0 / abs(CURVATURE)) < 10.0  # of its lane
    for state in states:
        assert math.dist(axle_of(state), MIDDLE) == pytest.approx(radius, abs=PLACE_OFF)
        assert math.radians(state[11]) == pytest.approx(-v / radius, abs=5e-4)  # to the left
        far = math.dist(state[:2], MIDDLE)
        chord = 2.0 * far * math.sin(0.5 * v / radius * DT) / DT
        assert math.hypot(*state[6:8]) == pytest.approx(chord, abs=SPEED_OFF)
    turned = math.atan2(*direction_of(states[-1])) - math.atan2(*direction_of(states[0]))
    assert abs(turned) == pytest.approx((number_of_steps - 1) * DT * v / radius, abs=1e-4)


CURVATURE = -0.0066666667
"""1/m of the arc of `left_hand`, as its file has it."""

START, HEADING = (359.7604440341, -3.9885859637), -0.2
"""Where that begins, so, too."""

MIDDLE = (
    START[0] - math.sin(HEADING) / CURVATURE,
    -(START[1] + math.cos(HEADING) / CURVATURE),
)
"""Of its circle, in the axes of CARLA."""


def axle_of(state: list[float]) -> tuple[float, float]:
    """Return the place of the rear axle."""
    yaw = math.radians(state[4])
    return state[0] - AXLE * math.cos(yaw), state[1] - AXLE * math.sin(yaw)


def direction_of(state: list[float]) -> tuple[float, float]:
    """Return the way from the middle of the circle to the rear axle."""
    x, y = axle_of(state)
    return x - MIDDLE[0], y - MIDDLE[1]
