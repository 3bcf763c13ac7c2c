"""Cost of the embedded world: per actor and step, and as a multiple of real time.

    python benchmarks/world.py [MAP.xodr]

Times are given in U as well: one `next()` of a trivial generator on the same machine.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import osc2tx_runtime
from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.catalogue import limits_of, shape_of
from osc2tx_runtime.world.commands import LaneChange, SpeedChange

DT = 0.05


def best_of(runs: int, work: Callable[[], int]) -> float:
    """Seconds per unit of work, the best of some runs."""
    best = float("inf")
    for _ in range(runs):
        begin = time.perf_counter()
        count = work()
        best = min(best, (time.perf_counter() - begin) / count)
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


if __name__ == "__main__":
    main()
