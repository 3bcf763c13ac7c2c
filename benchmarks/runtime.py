"""Costs of a run: one pass over the tree, one step of the world, and whole scenarios.

    python benchmarks/runtime.py [--map MAP.xodr] [--largest N]

Prints

- trees: one pass over the runtime's compositions beside py_trees' own (the floor), and how the cost
  grows with the number of leaves and with depth;
- the world: one step for 1 to 500 actors, and how the cost grows with them, on a road that they
  crowd (more and more of them drive into each other) and on one that is as long as they need;
- whole scenarios, tree and world together, as multiples of real time, against the budget, and how
  many times as much they cost as without monitors of their conditions (1.15 at the most).

Times are CPU seconds, the least of a few runs. Ratios count, not seconds: U is one `next()` of a
trivial generator on the same machine.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from costs import growth, spent, unit, upto
from trees import print_trees

import osc2tx_runtime
from osc2tx_runtime import Map, RunSettings, Scenario, Vehicle, rise, run_scenario
from osc2tx_runtime.language.tree import Behaviour, OneOf, Parallel, Wait, elapsed
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map, read_map_text
from osc2tx_runtime.running import preparation
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of
from osc2tx_runtime.world.commands import LaneChange, SpeedChange

DT = 0.05  # s, 20 Hz
ROOM = 20.0  # m of road for each actor, where the road is as long as they need
ACTORS = (1, 5, 20, 100, 500)


# --- The world ------------------------------------------------------------------------------------


def starts(road_map: RoadMap) -> list[LanePosition]:
    """Places with a long way to go."""
    return [p for p in road_map.spawn_points() if road_map.advance(p, 400.0).travelled > 399.0]


def filled_world(road_map: RoadMap, actors: int) -> EmbeddedWorld:
    world = EmbeddedWorld(road_map, DT)
    places = starts(road_map)
    limits = limits_of("vehicle")
    for i in range(actors):
        spec = ActorSpec(f"v{i}", "vehicle", shape_of("vehicle"), limits, lane_bound=True)
        world.add(spec)
        world.place(spec.id, places[i * len(places) // actors], 8.0 + i % 5)
    return world


def drive(world: EmbeddedWorld, steps: int) -> None:
    """Every 5 s each actor gets a new speed, every 10 s some change lane."""
    ids = world.actors()
    for step in range(steps):
        if step % 100 == 0:
            for i, actor in enumerate(ids):
                target = 8.0 + (i + step // 100) % 7
                world.command(actor, "longitudinal", SpeedChange(target, "smooth"))
                if step % 200 == 0 and i % 3 == 0:
                    world.command(actor, "lateral", LaneChange(1 if step % 400 else -1))
        world.step()


def straight_road(length: float) -> RoadMap:
    """A road with four lanes and nothing else."""
    width = '<width sOffset="0" a="3.5" b="0" c="0" d="0"/>'
    lanes = "".join(f'<lane id="{-i}" type="driving">{width}</lane>' for i in range(1, 5))
    return read_map_text(
        f'<OpenDRIVE><header/><road id="1" length="{length}" junction="-1"><planView>'
        f'<geometry s="0" x="0" y="0" hdg="0" length="{length}"><line/></geometry></planView>'
        '<lanes><laneSection s="0"><center><lane id="0" type="none"/></center>'
        f"<right>{lanes}</right></laneSection></lanes></road></OpenDRIVE>",
        "straight",
    )


def print_world(where: str, map_of: Callable[[int], RoadMap], u: float, largest: int) -> None:
    sizes = upto(largest, ACTORS)
    print(f"\n{where:24}{'us':>10}{'us/actor':>10}{'U/actor':>10}{'x real time':>14}")
    costs = []
    for actors in sizes:
        steps = 2000 // actors + 100
        worlds = [filled_world(map_of(actors), actors) for _ in range(3)]
        cost = min(spent(lambda w=world, n=steps: drive(w, n), 1) for world in worlds) / steps
        costs.append(cost)
        print(
            f"{actors:4d} actors{'':13}{cost * 1e6:10.1f}{cost * 1e6 / actors:10.2f}"
            f"{cost / actors / u:10.0f}{DT / cost:14.0f}"
        )
    print(f"growth exponents with actors: {growth(sizes, costs)}")


# --- Whole scenarios ------------------------------------------------------------------------------


class Traffic(Scenario):
    """Cars with leaves that are at work all the time."""

    name = source = "traffic"
    count = 5
    leaves = 4  # of each car
    length = 60.0  # s

    def declare(self) -> None:
        self.road = Map(map_file="highway")
        self.cars = [Vehicle(name=f"c{i}") for i in range(self.count)]
        for i, car in enumerate(self.cars):
            setattr(self, f"c{i}", car)

    def placement(self) -> None:
        for i, car in enumerate(self.cars):
            at = position(distance=20.0 + 35.0 * (i // 4))
            self.place(car, lane(1 + i % 4), at, speed(15.0))

    def behavior(self) -> Behaviour:
        cars = Parallel("cars", *(self._car(i) for i in range(self.count)))
        return OneOf("traffic", cars, Wait(elapsed(self.length)))

    def _car(self, i: int) -> Behaviour:
        car, other = self.cars[i], self.cars[(i + 1) % self.count]
        leaves = (
            car.drive(speed(15.0)),
            car.follow_lane(),
            Wait(rise(lambda: other.position.ahead_of(car) > 1e6)),
            Wait(lambda: car.speed > 1e3),
        )
        return Parallel(f"car {i}", *leaves[: self.leaves])


class Crowd(Traffic):
    """Many cars that drive."""

    count, leaves, length = 100, 2, 20.0


@dataclass(frozen=True)
class Budget:
    """How many times faster than real time a scenario has to be."""

    text: str
    scenario: type[Traffic]
    factor: float


BUDGETS = (
    Budget("5 actors, 20 leaves, 20 Hz, 60 s", Traffic, 300.0),
    Budget("100 actors, 200 leaves, 20 Hz, 20 s", Crowd, 20.0),
)


class Unwatched:
    """Stands for the monitors of a run without checks."""

    violations = ()

    def __init__(self, context: object) -> None: ...

    def begins(self, action: object) -> None: ...

    def ends(self, action: object) -> None: ...

    def leaves(self, action: object) -> None: ...

    def observe(self) -> None: ...


def print_scenarios(largest: int) -> None:
    head = f"{'us/tick':>10}{'x real time':>14}{'budget':>10}{'monitors':>17}"
    print(f"\n{'whole scenarios':40}{head}")
    for budget in BUDGETS:
        if budget.scenario.count > largest:
            continue

        def run(kind: type[Traffic] = budget.scenario) -> None:
            done = run_scenario(kind, RunSettings(dt=DT), keep_trace=False)
            assert done.status == "success", done.reason

        cost = min(spent(run, 1) for _ in range(3))
        with patch.object(preparation, "make_monitors", Unwatched):
            unwatched = min(spent(run, 1) for _ in range(3))
        length = budget.scenario.length
        factor = length / cost
        verdict = "kept" if factor >= budget.factor else "MISSED"
        print(
            f"{budget.text:40}{cost / (length / DT) * 1e6:10.0f}{factor:14.0f}"
            f"{budget.factor:10.0f} {verdict:6}{cost / unwatched:10.2f}"
        )


def main() -> None:
    default = Path(osc2tx_runtime.__file__).parent / "maps" / "highway.xodr"
    parser = argparse.ArgumentParser(description="Costs of a run.")
    parser.add_argument("--map", type=Path, default=default, help="OpenDRIVE file for the world")
    parser.add_argument(
        "--largest", type=int, default=1000, help="leave out what has more leaves, levels or actors"
    )
    arguments = parser.parse_args()
    road_map = read_map(arguments.map)
    u = unit()
    print(f"map {road_map.name}; U = {u * 1e9:.1f} ns (one next() on a trivial generator)")
    print_trees(u, arguments.largest)
    print_world("world: one step", lambda _: road_map, u, arguments.largest)
    roads = {actors: straight_road(500.0 + ROOM * actors) for actors in ACTORS}
    print_world("as dense, longer road", roads.__getitem__, u, arguments.largest)
    print_scenarios(arguments.largest)


if __name__ == "__main__":
    main()
