"""Traffic light controllers (DSL 8.15.9): what each action shows, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Scenario,
    ScenarioError,
    Serial,
    TrafficLight,
    TrafficLightBulb,
    TrafficLightController,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
    Wait,
    elapsed,
)
from osc2tx_runtime.world.surroundings.traffic_light_lamps import (
    BOXES,
    MEANINGS,
    Lamp,
    lamps_that_mean,
    meaning_of,
)

RED = ["is_on", "is_off", "is_off"]
YELLOW = ["is_off", "is_on", "is_off"]
GREEN = ["is_off", "is_off", "is_on"]


class Crossing(Scenario):
    """Lights 101 and 103 are group 1, 102 and 104 group 2."""

    name = "crossing"
    source = "crossing.osc"

    def declare(self) -> None:
        self.road = Map(map_file="urban_crossing")
        self.boss = TrafficLightController()
        self.east = TrafficLight(map_id="101")
        self.north = TrafficLight(map_id="102")
        self.unknown = TrafficLight(map_id="7")
        self.first = TrafficLightGroup(map_id="1")
        self.second = TrafficLightGroup(map_id="2")


Body = Callable[[Any], Behaviour]


def crossing(body: Body, base: type[Scenario] = Crossing) -> type[Scenario]:
    class Made(base):  # type: ignore[valid-type, misc]
        def behavior(self) -> Behaviour:
            return body(self)

    return Made


def shown(run: Any) -> list[tuple[float, str, list[str]]]:
    return [(e["t"], e["signal"], e["bulbs"]) for e in run.lines if e["kind"] == "signal"]


@pytest.mark.parametrize(
    ("body", "lights"),
    [
        (lambda c: c.boss.set_state(traffic_light=c.east, state=YELLOW), {"101": YELLOW}),
        (lambda c: c.boss.set_semantic_state(traffic_light=c.east, state="go"), {"101": GREEN}),
        (
            lambda c: c.boss.set_bulb_state(
                traffic_light=c.east, bulb_color="red", bulb_kind="circle", bulb_state="is_on"
            ),
            {"101": RED},
        ),
        (lambda c: c.boss.set_group_state(group=c.second, state=RED), {"102": RED, "104": RED}),
        (
            lambda c: c.boss.set_group_semantic_state(traffic_light_group=c.first, state="stop"),
            {"101": RED, "103": RED},
        ),
        (
            lambda c: c.boss.set_group_bulb_state(
                traffic_light=c.north,
                bulb_color="yellow",
                bulb_kind="circle",
                bulb_state="is_flashing",
            ),
            {key: ["is_off", "is_flashing", "is_off"] for key in ("102", "104")},
        ),
    ],
)
def test_what_a_set_action_shows(
    run: Callable[..., Any], body: Body, lights: dict[str, list[str]]
) -> None:
    assert shown(run(crossing(body))) == [(0.0, *entry) for entry in sorted(lights.items())]


def test_lamps_of_one_instant_add_up(run: Callable[..., Any]) -> None:
    def body(c: Crossing) -> Behaviour:
        lamp = {"traffic_light": c.east, "bulb_kind": "circle", "bulb_state": "is_on"}
        return Serial(
            "all",
            c.boss.set_semantic_state(traffic_light=c.east, state="stop"),
            c.boss.set_bulb_state(bulb_color="yellow", **lamp),
        )

    done = run(crossing(body))
    assert shown(done) == [(0.0, "101", ["is_on", "is_on", "is_off"])]
    (line,) = [e for e in done.lines if e["kind"] == "signal"]
    assert line["state"] == "attention"


def test_conflicting_lamps_are_reported_equal_ones_are_not(run: Callable[..., Any]) -> None:
    def both(one: list[str], other: list[str]) -> Body:
        return lambda c: Parallel(
            "both",
            c.boss.set_state(traffic_light=c.east, state=one),
            c.boss.set_state(traffic_light=c.east, state=other),
        )

    assert run(crossing(both(RED, RED))).result.status == "success"
    with pytest.raises(ScenarioError, match="traffic light 101 lamp 0"):
        run(crossing(both(RED, GREEN)))


def test_what_a_light_shows_can_be_read_at_once(run: Callable[..., Any]) -> None:
    def body(c: Crossing) -> Behaviour:
        return Serial(
            "all",
            c.boss.set_semantic_state(traffic_light=c.east, state="go"),
            Wait(lambda: c.east.state_equal(c.east.semantic_state_to_state("go"))),
            Wait(lambda: c.east.bulbs[2].state == "is_on" and c.north.bulbs[0].state == "is_off"),
            Wait(lambda: c.east.state_to_semantic_state(c.east.bulbs) == "go"),
            Wait(lambda: not c.first.state_equal(c.first.bulbs[:3])),  # 103 is still off
            Wait(lambda: c.east.group.map_id == "1"),
        )

    assert run(crossing(body)).result.time == 0.0


def test_ignored_meanings_show_in_the_trace(run: Callable[..., Any]) -> None:
    """8.15.9.3: a state that the box cannot say is ignored; a plain box has no arrow."""
    body: Body = lambda c: Serial(  # noqa: E731
        "all",
        c.boss.set_semantic_state(traffic_light=c.east, state="stop"),
        Wait(elapsed(0.1)),
        c.boss.set_semantic_state(traffic_light=c.east, state="go_exclusive"),
    )
    lines = [e for e in run(crossing(body)).lines if e["kind"] == "signal"]
    assert [(e["state"], e.get("ignored")) for e in lines] == [
        ("stop", None),
        ("stop", "go_exclusive"),
    ]


def phase(c: Any, group: TrafficLightGroup, meaning: Any, duration: float) -> TrafficLightPhase:
    return TrafficLightPhase(group, c.east.semantic_state_to_state(meaning), duration)


class Cycles(Crossing):
    """Two groups with a period of 10 s; when one is green the other is red."""

    def declare(self) -> None:
        super().declare()
        one = [("go", 4.0), ("stop_attention", 1.0), ("stop", 4.0), ("attention", 1.0)]
        other = one[2:] + one[:2]
        self.one = TrafficLightCycle([phase(self, self.first, *each) for each in one], 1, 2.0)
        self.other = TrafficLightCycle([phase(self, self.second, *each) for each in other], 1, 2.0)
        self.road = Map(map_file="urban_crossing", traffic_light_control=[self.one, self.other])


def test_cycles_loop_and_begin_at_their_offset(run: Callable[..., Any]) -> None:
    """Before the offset runs the end of the cycle: a second of red, then red and yellow."""
    body: Body = lambda c: c.boss.play_cycles(cycles=[c.one], duration=13.0)  # noqa: E731
    done = run(crossing(body, Cycles))
    states = [(t, bulbs) for t, signal, bulbs in shown(done) if signal == "101"]
    attention = ["is_on", "is_on", "is_off"]
    assert states == [
        (0.0, RED),
        (1.0, attention),
        (2.0, GREEN),
        (6.0, YELLOW),
        (7.0, RED),
        (11.0, attention),
        (12.0, GREEN),
    ]
    assert done.result.time == pytest.approx(13.0)


def test_another_action_ends_the_cycles(run: Callable[..., Any]) -> None:
    """Whatever the order of the members; at 6.0 s both want to switch the light."""

    def body(order: int) -> Body:
        def made(c: Any) -> Behaviour:
            members = [
                Serial(
                    "end",
                    Wait(elapsed(6.0)),
                    c.boss.set_semantic_state(traffic_light=c.east, state="off"),
                    Wait(elapsed(10.0)),
                ),
                c.boss.play_cycles(cycles=[c.one]),
            ]
            return Parallel("both", *members[::order])

        return made

    runs = [run(crossing(body(order), Cycles)) for order in (1, -1)]
    for done in runs:
        (end,) = done.actions("boss play_cycles", "end")
        assert end["t"] == pytest.approx(6.0) and "reason" not in end
        assert shown(done)[-2:] == [(6.0, "101", ["is_off"] * 3), (6.0, "103", YELLOW)]
    events = [[line for line in each.lines if line["kind"] != "tree"] for each in runs]
    assert events[0] == events[1]


def test_sync_shows_what_the_other_groups_show_then(run: Callable[..., Any]) -> None:
    """When group 1 turns green, group 2 is in its first red phase."""
    body: Body = lambda c: c.boss.set_group_semantic_state(  # noqa: E731
        traffic_light_group=c.first, state="go", sync=True
    )
    assert shown(run(crossing(body, Cycles))) == [
        (0.0, "101", GREEN),
        (0.0, "102", RED),
        (0.0, "103", GREEN),
        (0.0, "104", RED),
    ]


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        (
            lambda c: c.boss.set_semantic_state(traffic_light=c.unknown, state="go"),
            "has no traffic light 7; those it has: 101, 102, 103, 104",
        ),
        (
            lambda c: c.boss.set_semantic_state(traffic_light=TrafficLight(), state="go"),
            "in no map without its id",
        ),
        (
            lambda c: c.boss.set_group_state(group=TrafficLightGroup(map_id="9"), state=RED),
            "has no group of traffic lights 9; those it has: 1, 2",
        ),
        (
            lambda c: c.boss.set_state(traffic_light=c.east, state=["is_on"]),
            "traffic light 101 has 3 lamps, not 1",
        ),
        (
            lambda c: c.boss.set_bulb_state(
                traffic_light=c.east, bulb_color="red", bulb_kind="tram", bulb_state="is_on"
            ),
            "has no lamp red tram; it has red circle, yellow circle, green circle",
        ),
        (
            lambda c: c.boss.set_state(traffic_light=c.east, state=RED, sync=True),
            "sync needs to know which lights keep in step",
        ),
        (lambda c: c.boss.play_cycles(cycles=[]), "there is no cycle to play"),
        (
            lambda c: c.boss.play_cycles(cycles=[TrafficLightCycle([])]),
            "without phases cannot be played",
        ),
        (
            lambda c: c.boss.play_cycles(
                cycles=[TrafficLightCycle([phase(c, c.first, "go", 0.0)])]
            ),
            "needs a duration of more than 0 s",
        ),
        (
            lambda c: c.boss.play_cycles(
                cycles=[TrafficLightCycle([phase(c, c.first, "go", 1.0)])] * 2
            ),
            "two cycles are about traffic light 101",
        ),
    ],
)
def test_refused_before_the_start(run: Callable[..., Any], body: Body, reason: str) -> None:
    with pytest.raises(ScenarioError, match=reason) as caught:
        run(crossing(body))
    assert caught.value.source == "crossing.osc"


def test_lamps_that_the_scenario_lists(run: Callable[..., Any]) -> None:
    """An arrow is green for its direction only: `go_exclusive`."""

    class Arrows(Crossing):
        def declare(self) -> None:
            super().declare()
            lamps = [TrafficLightBulb("red"), TrafficLightBulb("green", "arrow_left")]
            self.east = TrafficLight(map_id="101", bulbs=lamps)

    body: Body = lambda c: c.boss.set_semantic_state(  # noqa: E731
        traffic_light=c.east, state="go_exclusive"
    )
    assert shown(run(crossing(body, Arrows))) == [(0.0, "101", ["is_off", "is_on"])]


@pytest.mark.parametrize("lamps", [*BOXES.values(), (Lamp("green", "arrow_left"),)])
def test_what_lamps_mean_is_what_they_were_asked_to_say(lamps: tuple[Lamp, ...]) -> None:
    for meaning in MEANINGS:
        states = lamps_that_mean(lamps, meaning)
        assert states is None or meaning_of(lamps, states) == meaning
    assert meaning_of(lamps, ["is_flashing"] * len(lamps)) == "non_functional"
