"""The seed's story on Town06: every phase of it, measured in the trace."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Emit,
    Environment,
    Event,
    Map,
    OneOf,
    Parallel,
    Scenario,
    Serial,
    StationaryObject,
    Vehicle,
    Wait,
    elapsed,
    fall,
    rise,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.units import deg, kph, m, mph, rad, s


class HelloWorld(Scenario):
    """As generated, but in few methods."""

    name = "hello_world"
    source = "hello_world.osc"

    def declare(self) -> None:
        self.carla_map = Map(map_file="Town06")
        self.env = Environment()
        self.hero = Vehicle(model="vehicle.tesla.model3", name="hero")
        self.npc = Vehicle(model="vehicle.carlamotors.european_hgv", name="npc", color="0,128,0")
        self.obstacle = StationaryObject(name="obstacle", model="static.prop.trafficwarning")
        self.v_hero = 35 * kph
        self.v_npc_fast = self.v_hero + 12.42 * mph
        self.v_npc_slow = self.v_hero - 10 * kph
        self.v_npc_catchup = self.v_hero * (10 * kph)
        self.lag = 5 * m
        self.safety_gap = self.lag * 3 - 3 * m
        self.go_signal = Event()
        self.CRASH_AVOIDED = Event()
        self.OBSTACLE_DETECTED = Event()

    def placement(self) -> None:
        self.place(self.hero, lane(1, from_="left"), speed(0 * kph))
        self.place(
            self.npc,
            lane(side="right", side_of=self.hero),
            position(distance=self.lag, behind=self.hero),
            speed(0 * kph),
        )
        self.place(self.obstacle, position(x=478.93, y=-14.07, z=0.0, h=-1.57 * rad, frame="carla"))

    def behavior(self) -> Behaviour:
        return Serial(
            "hello_world",
            self.env.assign_celestial_position(azimuth=270 * deg, elevation=12 * deg),
            self.hero.set_lights(mode="auto"),
            Parallel("story", self.hero_serial(), self.npc_serial()),
        )

    def hero_serial(self) -> Behaviour:
        gap = fall(lambda: self.npc.position.ahead_of(self.hero) > self.safety_gap)
        alongside = rise(lambda: self.hero.position.ahead_of(self.npc) >= -1 * m)
        flash = Serial(
            "flash",
            self.hero.set_lights(mode="high_beam"),
            Wait(elapsed(0.5 * s)),
            self.hero.set_lights(mode="auto"),
        )
        swerve = Serial(
            "swerve",
            self.hero.change_lane(num_of_lanes=1, side="right"),
            Emit(self.CRASH_AVOIDED),
        )
        return Serial(
            "hero",
            Wait(self.go_signal),
            OneOf("cruise", self.hero.drive(speed(self.v_hero)), Wait(gap)),
            Parallel("swerve and flash", swerve, flash),
            OneOf("on", self.hero.drive(speed(self.v_hero)), Wait(self.OBSTACLE_DETECTED)),
            self.hero.change_speed(target=25 * kph, rate_profile="smooth"),
            OneOf("approach", self.hero.drive(speed(25 * kph)), Wait(alongside)),
            self.hero.change_speed(target=0 * kph, rate_profile="asap"),
            Wait(lambda: self.hero.speed < 0.1 * kph),
            Wait(elapsed(5 * s)),
        )

    def npc_serial(self) -> Behaviour:
        ahead = rise(lambda: self.npc.position.ahead_of(self.hero) >= self.lag * 2)
        near = rise(
            lambda: (
                self.npc.object_distance(reference=self.obstacle, direction="euclidean") < 45 * m
            )
        )
        catch_up = speed(self.v_npc_catchup, rate_profile="smooth")
        return Serial(
            "npc",
            Wait(self.go_signal),
            OneOf("overtake", self.npc.drive(speed(self.v_npc_fast)), Wait(ahead)),
            self.npc.change_lane(num_of_lanes=1, side="left"),
            OneOf("brake check", self.npc.drive(speed(self.v_npc_slow)), Wait(self.CRASH_AVOIDED)),
            OneOf("recover", self.npc.drive(catch_up), Wait(near)),
            self.npc.change_speed(target=0 * kph, rate_profile="asap"),
            Emit(self.OBSTACLE_DETECTED),
            Wait(elapsed(10 * s)),
        )


def apart(a: dict[str, Any], b: dict[str, Any]) -> float:
    return math.hypot(a["x"] - b["x"], a["y"] - b["y"])


@pytest.mark.parametrize("start", [5.0, 10.0, 25.0, 40.0])
def test_story(run: Callable[..., Any], test_data: Path, start: float) -> None:
    done = run(
        HelloWorld,
        map_path=(test_data / "maps/carla-2020",),
        signal={"go_signal": 1.0},
        spawn={"hero": ("16", -3, start)},
        destination={"hero": "obstacle", "npc": "obstacle"},
        max_time=200.0,
    )
    assert done.result.status == "success"
    assert not done.result.collisions
    events = {e["name"]: e["t"] for e in done.lines if e["kind"] == "event"}
    obstacle = done.states("obstacle")[0]
    assert (obstacle["road"], obstacle["lane"]) == ("48", -4)

    # The NPC passes, cuts in before the hero and is slower.
    cut_in = done.actions("npc change_lane", "end")[0]["t"]
    hero, npc = done.at("hero", cut_in), done.at("npc", cut_in)
    assert (hero["road"], hero["lane"]) == (npc["road"], npc["lane"])
    swerve = done.actions("hero change_lane", "start")[0]["t"]
    assert done.at("npc", swerve)["v"] < done.at("hero", swerve)["v"]
    assert 11.5 < apart(done.at("npc", swerve), done.at("hero", swerve)) <= 12.5

    # The hero is one lane to the right of it afterwards.
    hero, npc = (done.at(name, events["CRASH_AVOIDED"]) for name in ("hero", "npc"))
    assert hero["lane"] == npc["lane"] - 1

    # The NPC brakes within 45 m and stands before the obstacle, the hero stops beside it.
    brake = done.actions("npc change_speed", "start")[0]["t"]
    assert 44.0 < apart(done.at("npc", brake), obstacle) < 45.0
    stopped = done.at("npc", events["OBSTACLE_DETECTED"])
    assert stopped["v"] == 0.0 and stopped["lane"] == -4
    assert apart(stopped, obstacle) > 7.0
    last = done.states("hero")[-1]
    assert last["v"] == 0.0 and last["lane"] == -5
    assert apart(last, done.states("npc")[-1]) < 7.0
