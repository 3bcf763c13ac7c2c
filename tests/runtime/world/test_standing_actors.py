"""Actors that stand cost next to nothing, and are hit all the same. Work is counted, not timed."""

from collections.abc import Callable
from itertools import combinations
from random import Random

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.measuring.collision import box_of
from osc2tx_runtime.world.measuring.contacts import Contacts
from osc2tx_runtime.world.state import ActorState
from tests.runtime.world.pairs_of_boxes import swept_contacts
from tests.work import calls

DRIVING, STANDING = 5, 100


def world_with(road_map: RoadMap, driving: int, standing: int) -> EmbeddedWorld:
    """A world with those who drive in lane -1 and those who stand in the other lanes."""
    world = EmbeddedWorld(road_map)
    for i in range(driving + standing):
        spec = ActorSpec(f"v{i}", "vehicle", shape_of("vehicle"), limits_of("vehicle"), True)
        world.add(spec)
        lane, s = (-1, 10.0 + 20.0 * i) if i < driving else (-2 - i % 2, 10.0 + 15.0 * i)
        world.place(spec.id, LanePosition("1", lane, s), 10.0 if i < driving else 0.0)
    for _ in range(3):
        world.step()
        world.changed()
    return world


def drives_on(world: EmbeddedWorld) -> Callable[[], None]:
    def steps() -> None:
        for _ in range(10):
            world.step()
            world.changed()

    return steps


def stopped_at_once(world: EmbeddedWorld) -> None:
    for actor in world.actors()[DRIVING:]:
        world.assign(actor, speed=0.0)


def stopped_by_command(world: EmbeddedWorld) -> None:
    for actor in world.actors()[DRIVING:]:
        world.command(actor, "longitudinal", SpeedChange(0.0, "asap"))


@pytest.mark.parametrize("park", [None, stopped_at_once, stopped_by_command])
def test_a_hundred_who_stand_cost_less_than_one_who_drives(
    highway: RoadMap, park: Callable[[EmbeddedWorld], None] | None
) -> None:
    alone = calls(drives_on(world_with(highway, DRIVING, 0)))
    world = world_with(highway, DRIVING, STANDING)
    if park is not None:
        park(world)
        drives_on(world)()
    assert calls(drives_on(world)) - alone < alone / DRIVING


def touching(before: list[ActorState], after: list[ActorState]) -> set[tuple[str, str]]:
    """Who touches whom in a step, each pair by itself."""
    found = set()
    for i, j in combinations(range(len(before)), 2):
        pair = [box_of(before[i]), box_of(before[j])], [box_of(after[i]), box_of(after[j])]
        if swept_contacts(*pair):
            found.add((f"{i:02}", f"{j:02}"))
    return found


@pytest.mark.parametrize("seed", range(5))
def test_contacts_are_those_of_all_pairs_whoever_stands(seed: int) -> None:
    random, shape = Random(seed), shape_of("vehicle")

    def somewhere() -> ActorState:
        x, y, h = random.uniform(0, 60), random.uniform(0, 20), random.uniform(-3, 3)
        return ActorState(x, y, 0.0, h, 0.0, 0.0, None, 0.0, shape)

    states, contacts = [somewhere() for _ in range(12)], Contacts()
    ids = [f"{i:02}" for i in range(len(states))]
    known: set[tuple[str, str]] = set()
    for _ in range(60):
        before, jumped = states.copy(), set()
        if random.random() < 0.2:
            put = random.randrange(len(ids))
            states[put] = before[put] = somewhere()
            contacts.put(put, states[put])
        after, begin = states.copy(), states.copy()
        for i in range(random.choice([0, 0, 1, 2])):
            moved = random.randrange(len(ids))
            step = random.uniform(-2, 2)
            after[moved] = after[moved]._replace(x=after[moved].x + step, h=after[moved].h + 0.1)
            if i:
                jumped.add(ids[moved])
        for i, actor in enumerate(ids):
            if actor in jumped:
                begin[i] = after[i]
        contacts.step(ids, before, after, [-1.0] * len(ids), jumped, ())
        found = touching(begin, after)
        assert set(contacts.new) == found - known
        known, states = found, after
