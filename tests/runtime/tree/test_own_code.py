"""Code defined by the user ends no run as if all was well: it is named, with its line; exit 5."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from osc2tx_runtime import (
    Action,
    Behaviour,
    Map,
    RunSettings,
    Scenario,
    ScenarioError,
    Serial,
    Status,
    Vehicle,
    run_scenario,
)
from osc2tx_runtime.language.actions.method import Method
from osc2tx_runtime.modifiers import lane, position, speed
from osc2tx_runtime.opendrive import LanePosition, Pose
from osc2tx_runtime.running.main import main
from osc2tx_runtime.world.commands import (
    Arrive,
    Careful,
    Command,
    FollowSpeed,
    KeepGap,
    KeepLane,
    LaneChange,
    SpeedChange,
    Turn,
)
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.world.plant.plant import Identity, Measurement
from osc2tx_runtime.worlds import EMBEDDED, WorldRequest

Hook = Callable[[Any], Any]


class Hooked(Action):
    """Runs the functions of a test in its methods."""

    method = Method("vehicle", "hooked", ("longitudinal",), "open")

    def __init__(self, actor: Any, hooks: dict[str, Hook]) -> None:
        super().__init__(actor)
        self.hooks = hooks

    def setup(self, **kwargs: Any) -> None:
        self.source = "own.osc:7"  # as the source map has it
        super().setup(**kwargs)

    def hook(self, name: str, otherwise: Any = None) -> Any:
        return self.hooks[name](self) if name in self.hooks else otherwise

    def on_start(self) -> None:
        self.hook("on_start")

    def on_update(self) -> Status:
        status: Status = self.hook("on_update", Status.RUNNING)
        return status

    def on_stop(self) -> None:
        self.hook("on_stop")


def scenario(**hooks: Hook) -> type[Scenario]:
    class Own(Scenario):
        name = "own"
        source = "own.osc"

        def declare(self) -> None:
            self.road = Map(map_file="highway.xodr")
            self.ego = Vehicle()

        def placement(self) -> None:
            self.place(self.ego, lane(2), position(100.0), speed(2.0))

        def behavior(self) -> Behaviour:
            return Serial("s", Hooked(self.ego, hooks))

    return Own


def ended(capsys: pytest.CaptureFixture[str], **hooks: Hook) -> str:
    """Run to the end of the process; return what it complains about."""
    assert main(scenario(**hooks), argv=["--max-time", "0.2"]) == 5
    out, err = capsys.readouterr()
    assert (out, err.count("\n"), err[-1]) == ("", 1, "\n")
    return err


class Silent(Exception):
    def __str__(self) -> str:
        raise RuntimeError("no words")


def raiser(error: BaseException) -> Hook:
    def hook(_: Any) -> Any:
        raise error

    return hook


RAISED = [
    *(SystemExit(0), SystemExit("bye"), GeneratorExit(), BaseException("all"), MemoryError()),
    *(RuntimeError("a\n::error::b"), StopIteration(), RecursionError(), ZeroDivisionError()),
    Silent(),
]


@pytest.mark.parametrize("error", RAISED, ids=lambda error: type(error).__name__)
@pytest.mark.parametrize("where", ["on_start", "on_update", "on_stop", "effect"])
def test_whatever_it_raises_is_an_error_of_the_scenario(
    capsys: pytest.CaptureFixture[str], where: str, error: BaseException
) -> None:
    def effect(action: Any) -> None:
        action.effect("mood", 1, lambda: raiser(error)(action))

    hooks = {"on_start": effect} if where == "effect" else {where: raiser(error)}
    told = ended(capsys, **hooks)
    assert told.startswith(f"own.osc:7: error[OSC801]: ego hooked: {__name__}.Hooked raised ")
    assert type(error).__name__ in told


@pytest.mark.parametrize(
    "status", [None, True, "SUCCESS", 1, Status.INVALID, object()], ids=lambda s: type(s).__name__
)
def test_a_status_that_is_none(capsys: pytest.CaptureFixture[str], status: Any) -> None:
    told = ended(capsys, on_update=lambda _: status)
    assert told.startswith("own.osc:7: error[OSC801]: ego hooked returns ")
    assert "not a status of a node" in told


def test_a_reason_that_is_no_text(capsys: pytest.CaptureFixture[str]) -> None:
    assert "a reason that is not a string" in ended(
        capsys, on_update=lambda action: action.fail(b"x")
    )


def test_what_it_raises_that_means_ctrl_c_is_ctrl_c(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(scenario(on_start=raiser(KeyboardInterrupt())), argv=[]) == 130


class Own(Command):
    """No world knows it."""


GARBAGE = [
    (SpeedChange(math.nan), "SpeedChange: target is nan"),
    (SpeedChange(math.inf), "SpeedChange: target is inf"),
    (SpeedChange(10**400), "SpeedChange: target is a int"),
    (SpeedChange(1e300), "SpeedChange: target is 1e+300"),
    (SpeedChange("5"), "SpeedChange: target is '5', not a number"),  # type: ignore[arg-type]
    (SpeedChange(True), "SpeedChange: target is True, not a number"),
    (SpeedChange(1.0, "fast"), "SpeedChange: profile is 'fast', no one of"),  # type: ignore[arg-type]
    (SpeedChange(1.0, duration=-math.inf), "SpeedChange: duration is -inf"),
    (SpeedChange(1.0, course=3), "SpeedChange: course is 3, no Profile"),  # type: ignore[arg-type]
    (Careful(SpeedChange(math.nan)), "Careful: course.target is nan"),
    (Careful(KeepGap("npc", True)), "Careful: there is no actor 'npc'"),
    (Arrive(1.0, speed=FollowSpeed("npc")), "Arrive: there is no actor 'npc'"),
    (KeepGap("npc", True), "KeepGap: there is no actor 'npc'"),
    (KeepLane(), "KeepLane is not a command of the longitudinal slot"),
    (LaneChange(1), "LaneChange is not a command of the longitudinal slot"),
    (Turn(0.1), "Turn is not a command of the longitudinal slot"),
    (Command(), "a Command is not a command"),
    (Own(), "Own is not a command of the longitudinal slot"),
    (None, "a NoneType is not a command"),
    (5.0, "a float is not a command"),
]


@pytest.mark.parametrize(("command", "problem"), GARBAGE, ids=lambda each: str(each)[:40])
def test_commands_are_checked_when_they_are_handed_in(
    capsys: pytest.CaptureFixture[str], command: Any, problem: str
) -> None:
    told = ended(capsys, on_start=lambda action: action.command("longitudinal", command))
    assert told.startswith(f"own.osc:7: error[OSC801]: ego hooked: {problem}")


@pytest.mark.parametrize("number", [3, np.float64(3), np.float32(3), np.int64(3)], ids=repr)
def test_numbers_of_any_kind_are_taken(number: Any) -> None:
    own = scenario(on_start=lambda action: action.command("longitudinal", SpeedChange(number)))
    assert run_scenario(own, RunSettings(max_time=0.1)).status == "timeout"


@pytest.mark.parametrize(
    "assigned",
    [{"speed": math.nan}, {"at": LanePosition("1", 1, math.inf)}, {"heading": "north"}],
    ids=str,
)
def test_what_an_effect_assigns_is_checked(
    capsys: pytest.CaptureFixture[str], assigned: dict[str, Any]
) -> None:
    def start(action: Any) -> None:
        action.effect("place", 1, lambda: action.context.world.assign("ego", **assigned))

    told = ended(capsys, on_start=start)
    assert told.startswith("own.osc:7: error[OSC801]: ego: invalid assignment: ")


# --- worlds ---


def run_in(world: Any) -> None:
    run_scenario(scenario(), RunSettings(max_time=0.1), world=world)


def world_of(plant: Any = None) -> EmbeddedWorld:
    own = scenario()(RunSettings())
    from osc2tx_runtime.domain.map.search import find_map

    request = WorldRequest("highway.xodr", lambda: find_map(own.map_file(), ()))
    if plant is None:
        return EMBEDDED.make(request)  # type: ignore[return-value]
    return EmbeddedWorld(request.road_map(), plant=plant)


PLACE = Pose(1.0, 2.0, 0.0, 0.0)
STILL = (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("answer", "problem"),
    [
        (None, "moved: is None, no Mapping"),
        ({"npc": Measurement(PLACE, STILL)}, "measures 'npc', which is not an actor"),
        ({"ego": PLACE}, "ego: is a Pose, no Measurement"),
        ({"ego": Measurement(Pose(math.nan, 0, 0, 0), STILL)}, "ego: pose.x is nan"),
        ({"ego": Measurement(PLACE, (0.0, 0.0))}, "ego: velocity has 2 members"),  # type: ignore
        ({"ego": Measurement(PLACE, (0.0, math.inf, 0.0))}, "ego: velocity a member is inf"),
    ],
    ids=str,
)
def test_a_plant_that_measures_garbage_is_named(answer: Any, problem: str) -> None:
    class Broken(Identity):
        def moved(self, scene: Any) -> Any:
            return answer

    with pytest.raises(ScenarioError, match=f"the plant {__name__}.*Broken: ") as caught:
        run_in(world_of(Broken()))
    assert problem in str(caught.value)


@pytest.mark.parametrize("method", ["begin", "moved", "shape", "close"])
def test_a_plant_that_fails_is_named(method: str) -> None:
    broken = type("Broken", (Identity,), {method: lambda *_: raiser(SystemExit(0))(None)})
    with pytest.raises(ScenarioError, match="Broken raised SystemExit: 0"):
        run_in(world_of(broken()))


@pytest.mark.parametrize(
    ("method", "answer"),
    [
        ("state", None),
        ("collisions", [("ego",)]),
        ("actors", 5),
        ("environment", {"fog": math.nan}),
        ("take_notes", [1]),
        ("control", b"exact"),
    ],
)
def test_a_world_that_returns_garbage_is_named(method: str, answer: Any) -> None:
    broken = type("Broken", (EmbeddedWorld,), {method: lambda *_: answer})
    sound = world_of()
    with pytest.raises(ScenarioError, match=f"Broken: {method}: "):
        world = broken(sound.map)
        if method == "environment":
            from osc2tx_runtime.running.checked_world import checked_world

            checked_world(world).environment()
        run_in(world)


def test_a_world_that_fails_is_named() -> None:
    broken = type("Broken", (EmbeddedWorld,), {"step": raiser(SystemExit(0))})
    with pytest.raises(ScenarioError, match="Broken raised SystemExit: 0"):
        run_in(broken(world_of().map))


def test_a_world_of_ones_own_may_be_sound() -> None:
    own = type("Own", (EmbeddedWorld,), {})
    run_in(own(world_of().map))
