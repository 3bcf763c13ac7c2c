"""Cost of the embedded world: per actor and step, and as a multiple of real time.

The last line is a whole scenario of 60 s: 5 actors, 20 active leaves, tree and world, no trace.

    python benchmarks/world.py [MAP.xodr]

Times are given in U as well: one `next()` of a trivial generator on the same machine.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import osc2tx_runtime
from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    RunSettings,
    Scenario,
    Vehicle,
    Wait,
    rise,
    run_scenario,
)
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.catalogue import limits_of, shape_of
from osc2tx_runtime.world.commands import LaneChange, SpeedChange

DT = 0.05


def best_of(runs: int, work: Callable[[], int]) -> float:
    """Seconds of processor time per unit of work, the best of some runs."""
    best = float("inf")
    for _ in range(runs):
        begin = time.process_time()
        count = work()
        best = min(best, (time.process_time() - begin) / count)
    return best


def trivial() -> Iterator[int]:
    while True:
        yield 0


def unit() -> float:
    generator = trivial()

    def work() -> int:
        for _ in range(200_000):
            next(generator)
        return 200_000

    return best_of(5, work)


def places(road_map: RoadMap) -> list[LanePosition]:
    """Start places with a long way to go."""
    return [p for p in road_map.spawn_points() if road_map.advance(p, 400.0).travelled > 399.0]


def make_world(road_map: RoadMap, actors: int) -> EmbeddedWorld:
    world = EmbeddedWorld(road_map, DT)
    starts = places(road_map)
    for i in range(actors):
        spec = ActorSpec(
            f"v{i}", "vehicle", shape_of("vehicle"), limits_of("vehicle"), lane_bound=True
        )
        world.add(spec)
        world.place(spec.id, starts[i * len(starts) // actors], 8.0 + i % 5)
    return world


def drive(world: EmbeddedWorld, steps: int) -> None:
    """Every 5 s each actor gets a new speed, every 10 s some change lane."""
    ids = world.actors()
    for step in range(steps):
        if step % 100 == 0:
            for i, actor in enumerate(ids):
                speed = 8.0 + (i + step // 100) % 7
                world.command(actor, "longitudinal", SpeedChange(speed, "smooth"))
                if step % 200 == 0 and i % 3 == 0:
                    world.command(actor, "lateral", LaneChange(1 if step % 400 else -1))
        world.step()


class Traffic(Scenario):
    """Five cars, each with four leaves at work all the time."""

    name = source = "traffic"

    def declare(self) -> None:
        self.road = Map(map_file="highway")
        self.cars = [Vehicle(name=f"c{i}") for i in range(5)]
        self.c0, self.c1, self.c2, self.c3, self.c4 = self.cars

    def placement(self) -> None:
        for i, car in enumerate(self.cars):
            self.place(car, lane(1 + i % 3), position(distance=50.0 + 60.0 * i), speed(15.0))

    def behavior(self) -> Behaviour:
        return Parallel("traffic", *(self._car(i) for i in range(5)), duration=60.0)

    def _car(self, i: int) -> Behaviour:
        car, other = self.cars[i], self.cars[(i + 1) % 5]
        return Parallel(
            f"car {i}",
            car.drive(speed(15.0)),
            car.follow_lane(),
            Wait(rise(lambda: other.position.ahead_of(car) > 1e6)),
            Wait(lambda: car.speed > 1e3),
        )


def scenario() -> int:
    run_scenario(Traffic, RunSettings(dt=DT), keep_trace=False)
    return 1


def main() -> None:
    default = Path(osc2tx_runtime.__file__).parent / "maps" / "highway.xodr"
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else default
    road_map = read_map(path)
    one = unit()
    print(f"map {road_map.name}; U = {one * 1e9:.1f} ns")
    for actors in (1, 5, 20, 100):
        steps = 4000 // actors + 100

        worlds = [make_world(road_map, actors) for _ in range(3)]

        def work(steps: int = steps, worlds: list[EmbeddedWorld] = worlds) -> int:
            world = worlds.pop()
            drive(world, steps)
            return steps * len(world.actors())

        cost = best_of(3, work)
        factor = DT / (cost * actors)
        print(
            f"{actors:4d} actors: {cost * 1e6:6.2f} us per actor and step = {cost / one:5.0f} U;"
            f" {factor:7.0f} x real time"
        )
    cost = best_of(3, scenario)
    print(f"5 actors, 20 leaves, 60 s: {cost * 1e3:.0f} ms; {60.0 / cost:.0f} x real time")


if __name__ == "__main__":
    main()
