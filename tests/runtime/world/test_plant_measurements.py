"""What a plant measures beside places: notes, contacts, motion, signals, trailers, friction."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.grip.friction import GRAVITY
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.measuring.velocities import OrientationRate, TranslationalAcceleration
from osc2tx_runtime.world.motion.towing import coupling_gap, pose_behind
from osc2tx_runtime.world.protocol import LONGITUDINAL
from tests.runtime.world.following_plant import FollowingPlant
from tests.runtime.world.plant_runs import DT, Run, Spec, driving, steps
from tests.runtime.world.two_cars import scenario


def test_notes_of_the_simulator_are_lines_of_the_trace(highway: RoadMap) -> None:
    class Bumping(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            if scene.step == 3:
                scene.note("impact", actor="a", other="static.wall", impulse=12.5)
            return super().moved(scene)

    done = Run(scenario(lambda s: s.a.drive(duration=1.0)), highway, Bumping())
    (impact,) = [line for line in done.lines if line["kind"] == "impact"]
    assert impact == {
        **{"t": 0.2, "kind": "impact", "actor": "a", "other": "static.wall", "impulse": 12.5}
    }


def test_contacts_are_those_of_the_measured_boxes(highway: RoadMap) -> None:
    """The one in front is pushed back by nobody; the reference alone would pass it by."""

    class Stuck(FollowingPlant):
        def follow(self, actor: str, setpoint: Any, dt: float) -> Measurement:
            self.most = 2.0 if actor == "b" else math.inf
            return super().follow(actor, setpoint, dt)

    done = Run(scenario(lambda s: s.a.drive(duration=6.0)), highway, Stuck(lag=0.05))
    assert [(one, two) for _, one, two in done.result.collisions] == [("a", "b")]
    assert not Run(
        scenario(lambda s: s.a.drive(duration=6.0)), highway, FollowingPlant()
    ).result.collisions


class Kind(FollowingPlant):
    """Measures turning and acceleration as well."""

    def measurement(self, pose: Any, speed: float) -> Measurement:
        return Measurement(pose, (speed, 0.2, 0.0), (1.5, -0.5, 0.25), (0.01, 0.02, 0.03))


def test_the_motion_is_what_the_simulator_says(highway: RoadMap, make_spec: Spec) -> None:
    world = driving(highway, make_spec, Kind())
    steps(world, 0.2)
    motion = world.motion("a")
    assert (motion.velocity.translational.x, motion.velocity.translational.y) == (15.0, 0.2)
    assert motion.velocity.angular == OrientationRate(0.01, 0.02, 0.03)
    assert motion.acceleration.translational == TranslationalAcceleration(1.5, -0.5, 0.25)
    assert world.state("a").a == 1.5


def test_without_that_noise_is_smoothed(highway: RoadMap, make_spec: Spec) -> None:
    """2 cm/s of noise, from step to step, are 0.8 m/s^2 of a difference."""
    noise = random.Random(1)

    class Noisy(FollowingPlant):
        def measurement(self, pose: Any, speed: float) -> Measurement:
            return Measurement(pose, (speed + noise.uniform(-0.02, 0.02), 0.0, 0.0))

    world = driving(highway, make_spec, Noisy())
    found = []
    for _ in range(200):
        world.step()
        found.append(world.state("a").a)
    assert max(map(abs, found)) < 0.35
    assert sum(found) / len(found) == pytest.approx(0.0, abs=0.02)


def test_signals_come_from_the_simulator_until_the_scenario_switches_one(
    load_map: Callable[[str], RoadMap], make_spec: Spec
) -> None:
    """What the simulator shows can be read; a light that was switched shows that alone."""

    class Lit(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            for signal in ("101", "102"):
                lamps = scene.signals.lamps(signal)
                scene.signals.observe(signal, ("is_on",) + ("is_off",) * (len(lamps) - 1))
            return super().moved(scene)

    world = EmbeddedWorld(load_map("urban_crossing"), DT, Lit())
    world.begin()
    world.signals.show("102", 1, "is_on", self_made := object())
    world.step()
    assert world.signals.meaning("101") == "stop"
    assert world.signals.states("102")[0] == "is_off"
    assert world.signals.shown_by("102") is self_made
    assert set(world.signals.lit()) == {"101", "102"}


def test_trailers_follow_where_their_tow_was_measured(highway: RoadMap, make_spec: Spec) -> None:
    """The coupling stays closed, whatever the tow does; nobody drives the trailer itself."""

    class Watching(FollowingPlant):
        def moved(self, scene: Any) -> Any:
            assert scene.setpoints["t"].towed
            return super().moved(scene)

    world = EmbeddedWorld(highway, DT, Watching(gain=0.8, drift=0.2))
    world.add(make_spec("a"))
    world.add(replace(make_spec("t", "trailer"), lane_bound=False))
    world.place("a", LanePosition("1", -2, 100.0), 15.0)
    world.place("t", pose_behind(world.state("a"), world._specs["t"].shape), 15.0)
    world.attach("a", "t")
    world.begin()
    for _ in range(200):
        world.step()
        assert coupling_gap(world.state("a"), world.state("t")) < 1e-9
    assert world.state("t").v == pytest.approx(12.0, abs=0.1)


def test_on_ice_the_reference_asks_for_what_can_be(highway: RoadMap, make_spec: Spec) -> None:
    """0.1 g is all there is, also for a car that somebody measures."""
    world = driving(highway, make_spec, FollowingPlant(lag=0.05), v=10.0)
    world.set_environment({"rain_intensity": 1e-6, "temperature": 260.0})
    world.step()
    world.command("a", LONGITUDINAL, SpeedChange(20.0, "asap"))
    speeds = []
    for _ in range(60):
        world.step()
        speeds.append(world.reference("a").v)
    rates = [(b - a) / DT for a, b in pairwise(speeds)]
    assert max(rates) <= 0.1 * GRAVITY + 1e-9
    assert not world.progress("a", LONGITUDINAL).done
