"""The length of the steps does not matter: 0.01 s and 0.05 s agree at their common times.

Stated tolerances: closed forms agree in the speed to rounding, and in the place to what the
trapezoid rule leaves of an acceleration that changes, dt^2 / 12 of its change: 2 mm. Feedback on
others is first order in the step: 10 cm and 10 cm/s.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    OdrPoint,
    Orientation,
    Parallel,
    Person,
    Point,
    Pose,
    Serial,
    methods,
)
from osc2tx_runtime.domain.actors import Trailer
from osc2tx_runtime.domain.paths.path_values import Path, Trajectory
from osc2tx_runtime.modifiers import (
    acceleration,
    along,
    along_trajectory,
    avoid_collisions,
    change_lane,
    change_speed,
    distance,
    keep_lane,
    keep_position,
    keep_speed,
    lane,
    lateral,
    orientation,
    position,
    speed,
    tow_trailer,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars

Run = Callable[..., Any]
EXACT, FEEDBACK = (2e-3, 1e-6), (0.1, 0.1)  # m, m/s
JUMPY = (2e-3, 2e-6)

BEND = Path((Pose(60.0, -8.75), Pose(90.0, -8.75), Pose(140.0, -4.0), Pose(180.0, 0.0)), "smooth")
TIMED = Trajectory(
    (Pose(50.0, -8.75), Pose(80.0, -8.75), Pose(110.0, -6.0), Pose(150.0, -5.25)),
    (0.0, 3.0, 6.0, 9.0),
    "smooth",
)


class Cast(TwoCars):
    """Two cars, the first with a trailer, and somebody on foot beside the road."""

    def declare(self) -> None:
        super().declare()
        self.walker = Person()
        self.trailer = Trailer()

    def placement(self) -> None:
        self.place(self.a, lane(2), position(distance=50.0), speed(10.0), tow_trailer(self.trailer))
        self.place(
            self.b, lane(same_as=self.a), position(distance=40.0, ahead_of=self.a), speed(12.0)
        )
        point = Point(100.0, -25.0)
        self.place(self.walker, position(at_point=point, project_on_route=False), yaw(0.3))


Act = Callable[[Any], Behaviour]


def _building_up(s: Any) -> Behaviour:
    """Reach an acceleration with a constant jerk."""
    changed: Behaviour = s.a.change_acceleration(target=1.5, rate_profile="constant", rate_peak=1.0)
    return changed


def driving(modifiers: Callable[[Any], list[Any]]) -> Act:
    return lambda s: s.a.drive(*modifiers(s), duration=6.0)


CASES: dict[str, list[tuple[Act, tuple[float, float]]]] = {
    "assign_speed": [(lambda s: s.a.assign_speed(speed=5.0), EXACT)],
    "assign_acceleration": [(lambda s: s.a.assign_acceleration(acceleration=2.0), (0.05, 0.1))],
    "assign_position": [
        (lambda s: s.a.assign_position(odr_point=OdrPoint("1", "-2", 500.0)), EXACT)
    ],
    "assign_orientation": [
        (lambda s: s.walker.assign_orientation(orientation=Orientation(yaw=1.0)), EXACT)
    ],
    "change_speed": [
        (lambda s: s.a.change_speed(target=20.0, rate_profile="smooth", duration=5.0), EXACT),
        (lambda s: s.a.change_speed(target=20.0, rate_profile="asap"), EXACT),
        (lambda s: s.a.change_speed(target=2.0), EXACT),
    ],
    "keep_speed": [(lambda s: s.a.keep_speed(duration=2.0), EXACT)],
    "change_acceleration": [
        (lambda s: s.a.change_acceleration(target=2.0, rate_profile="smooth", duration=3.0), EXACT)
    ],
    "keep_acceleration": [
        (lambda s: s.a.keep_acceleration(duration=2.0), EXACT),
        (lambda s: Serial("both", _building_up(s), s.a.keep_acceleration(duration=2.0)), EXACT),
    ],
    "remain_stationary": [(lambda s: s.a.remain_stationary(duration=3.0), EXACT)],
    "follow_lane": [(lambda s: s.a.follow_lane(offset=0.5, duration=4.0), EXACT)],
    "change_lane": [
        (lambda s: s.a.change_lane(side="left"), EXACT),
        (lambda s: s.a.change_lane(side="left", rate_profile="constant", duration=4.0), JUMPY),
        (lambda s: s.a.change_lane(speed(16.0), side="right", duration=5.0), EXACT),
    ],
    "change_space_gap": [
        (lambda s: s.a.change_space_gap(target=20.0, direction="behind", reference=s.b), FEEDBACK),
        (lambda s: s.a.change_space_gap(target=1.0, direction="left", reference=s.b), FEEDBACK),
    ],
    "change_time_gap": [
        (lambda s: s.a.change_time_gap(target=2.0, direction="behind", reference=s.b), FEEDBACK)
    ],
    "change_space_headway": [
        (
            lambda s: s.a.change_space_headway(target=30.0, direction="behind", reference=s.b),
            FEEDBACK,
        )
    ],
    "change_time_headway": [
        (
            lambda s: s.a.change_time_headway(target=2.0, direction="behind", reference=s.b),
            FEEDBACK,
        )
    ],
    "keep_space_gap": [(lambda s: braking(s, s.a.keep_space_gap), FEEDBACK)],
    "keep_time_gap": [(lambda s: braking(s, s.a.keep_time_gap), FEEDBACK)],
    "keep_space_headway": [(lambda s: braking(s, s.a.keep_space_headway), FEEDBACK)],
    "keep_time_headway": [(lambda s: braking(s, s.a.keep_time_headway), FEEDBACK)],
    "follow_path": [(lambda s: s.a.follow_path(absolute=BEND), FEEDBACK)],
    "replay_path": [(lambda s: s.a.replay_path(speed(10.0), absolute=BEND), EXACT)],
    "follow_trajectory": [(lambda s: s.a.follow_trajectory(absolute=TIMED), FEEDBACK)],
    "replay_trajectory": [(lambda s: s.a.replay_trajectory(absolute=TIMED), EXACT)],
    "change_position": [
        (lambda s: s.a.change_position(target_odr=OdrPoint("1", "-2", 200.0)), FEEDBACK),
        (lambda s: s.walker.change_position(target_xyz=Point(110.0, -22.0)), FEEDBACK),
    ],
    "disconnect_trailer": [(lambda s: s.a.disconnect_trailer(), EXACT)],
    "connect_trailer": [],  # a single step at which nothing moves
    "walk": [
        (lambda s: s.walker.walk(speed(1.4), duration=4.0), EXACT),
        (lambda s: s.walker.walk(orientation(yaw=1.0), speed(1.4), duration=4.0), FEEDBACK),
        (lambda s: s.walker.walk(keep_position(), duration=2.0), EXACT),
    ],
    "move": [(lambda s: s.a.move(change_speed(4.0), duration=4.0), EXACT)],
    "drive": [
        (lambda s: s.a.drive(along(BEND)), FEEDBACK),
        (lambda s: s.a.drive(along_trajectory(TIMED)), FEEDBACK),
    ]
    + [
        (driving(modifiers), tolerance)
        for modifiers, tolerance in (
            (lambda s: [speed(20.0, at="end"), lane(3, at="end")], EXACT),
            (lambda s: [speed(4.0, at="end"), keep_lane()], EXACT),
            (lambda s: [speed(2.0, faster_than=s.b)], FEEDBACK),
            (lambda s: [acceleration(1.0)], EXACT),
            (lambda s: [acceleration(2.0, at="end")], EXACT),
            (lambda s: [change_speed(6.0), change_lane(1, side="right")], EXACT),
            (lambda s: [keep_speed(), lateral(0.5, at="end")], EXACT),
            (lambda s: [lateral(3.0, side_of=s.b, at="end")], FEEDBACK),
            (lambda s: [lateral(3.0, side_of=s.b)], FEEDBACK),
            (lambda s: [speed(0.4, direction="lateral")], JUMPY),
            (lambda s: [position(20.0, behind=s.b, at="end")], (2e-3, 2e-3)),
            (lambda s: [position(20.0, behind=s.b, at="end"), speed(12.0, at="end")], (2e-3, 2e-3)),
            (lambda s: [position(20.0, behind=s.b)], FEEDBACK),
            (lambda s: [distance(80.0)], EXACT),
            (lambda s: [speed(25.0), avoid_collisions(True)], FEEDBACK),
            (lambda s: [yaw(0.1)], JUMPY),
        )
    ],
}


def braking(s: Any, keep: Callable[..., Behaviour]) -> Behaviour:
    """The other one brakes gently meanwhile."""
    return Parallel(
        "both",
        keep(reference=s.b, duration=6.0),
        s.b.change_speed(target=8.0, rate_profile="smooth", duration=6.0),
    )


def test_all_actions_on_motion_are_here() -> None:
    kinds = {"movable_object", "vehicle", "person", "animal"}
    on_motion = {m.name for m in methods.all() if m.kind in kinds} - {"set_lights"}
    assert on_motion == set(CASES)


@pytest.mark.parametrize(
    ("act", "tolerance"),
    [
        pytest.param(act, tolerance, id=f"{name}-{i}")
        for name, cases in CASES.items()
        for i, (act, tolerance) in enumerate(cases)
    ],
)
@pytest.mark.slow
def test_both_steps_agree(run: Run, act: Act, tolerance: tuple[float, float]) -> None:
    class Acting(Cast):
        def behavior(self) -> Behaviour:
            return act(self)

    fine, coarse = run(Acting, dt=0.01), run(Acting, dt=0.05)
    assert fine.result.status == coarse.result.status == "success"
    # An action ends at the first step at or behind its goal.
    assert abs(fine.result.time - coarse.result.time) <= 0.05 + (tolerance == FEEDBACK) * 0.3
    # Where the heading of a car jumps, the speed of its trailer does for one step.
    jumps = tolerance is JUMPY
    for actor in ("a", "b", "walker", *(() if jumps else ("trailer",))):
        known = {round(state["t"], 3): state for state in fine.states(actor)}
        common = [state for state in coarse.states(actor) if round(state["t"], 3) in known]
        for state in common:
            other = known[round(state["t"], 3)]
            place, rate = max(FEEDBACK, tolerance) if actor == "trailer" else tolerance
            assert state["x"] == pytest.approx(other["x"], abs=place)
            assert state["y"] == pytest.approx(other["y"], abs=place)
            assert state["v"] == pytest.approx(other["v"], abs=rate + 1e-9)
