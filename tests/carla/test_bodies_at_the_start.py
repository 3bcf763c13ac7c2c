"""Where and how bodies begin: streamed or not, at their speed, on the ground that a level has."""

from __future__ import annotations

from typing import Any

import pytest

from osc2tx_runtime import RunSettings

from .conftest import OWN_MAPS
from .contact import client_of, message_of, run, states
from .runs import in_carla
from .stand_in.process import StandInProcess

# --- large levels ----------------------------------------------------------------------------


def test_actors_that_a_large_level_does_not_stream() -> None:
    """Without a camera or a `hero` near them they would stand still, and nobody would know why."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "large-level") as server:
        said = message_of(in_carla(RunSettings(), server.port))
        assert "ego is dormant in CARLA" in said and "--carla-view ego" in said
        assert run(in_carla(RunSettings(), server.port, carla_view="ego")).status == "success"


def test_actors_that_leave_what_a_large_level_streams() -> None:
    """They are found out in the step in which they fall asleep, whatever they did before."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "large-level") as server:
        script = """
            place = carla.Transform(carla.Location(200.0, 9.0, 5.0))
            world.get_spectator().set_transform(place)
            world.wait_for_tick()
            print("there", flush=True)
        """
        client_of(server.port, script).wait()
        server.calls()
        assert "is dormant in CARLA" in message_of(in_carla(RunSettings(), server.port))
        steps = [name for name, _ in server.calls()].count("tick_cue")
    assert 60 < steps < 140  # 100 m at 19 to 26 m/s


# --- speeds at the start ---------------------------------------------------------------------


@pytest.mark.parametrize("control", ["driven", "external"])
def test_actors_start_at_their_speed(control: str) -> None:
    """A speed that is given once sags; given for half a second it stays.

    An external actor is given it before the run, and is where it starts all the same.
    """
    with StandInProcess([OWN_MAPS], "highway", "--fault", "sagging") as server:
        settings = RunSettings(expect=True, max_time=1.0)
        found = states(run(in_carla(settings, server.port, control={"ego": control})), "ego")
    assert (found[0]["x"], found[0]["y"]) == pytest.approx((200.0, -8.75), abs=0.01)
    settled = [each["v"] for each in found[6:]]  # 0.3 s
    assert settled == pytest.approx([found[0]["v"]] * len(settled), abs=0.5)


# --- bodies that fall -----------------------------------------------------------------------


@pytest.mark.parametrize("dt", [0.001, 0.05])
def test_steps_do_not_decide_how_long_a_body_falls(dt: float) -> None:
    """It stands on its wheels when the run begins, however short the steps are."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "falling") as server:
        settings = RunSettings(max_time=2.0 * dt, dt=dt)
        result = run(in_carla(settings, server.port, control={"": "driven"}))
    heights = [each["z"] for each in (*states(result, "ego"), *states(result, "other"))]
    assert heights == pytest.approx([0.0] * len(heights), abs=1e-3)


# --- heights ---------------------------------------------------------------------------------


def test_a_mesh_that_is_not_where_the_lanes_are() -> None:
    """Exact actors are where the scenario says; the run says that they float."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "sunk-mesh") as server:
        said = run(in_carla(RunSettings(max_time=0.5), server.port)).warnings
        driven = in_carla(RunSettings(max_time=0.5), server.port, control={"": "driven"})
        assert not [each for each in run(driven).warnings if "ground of CARLA" in each]
    assert "ego floats: the ground of CARLA is 0.50 m below the lane where it starts" in said, said


def test_a_mesh_of_which_nobody_tells() -> None:
    with StandInProcess([OWN_MAPS], "highway", "--fault", "unknown-mesh") as server:
        result = run(in_carla(RunSettings(max_time=0.5), server.port))
    assert [each for each in result.warnings if each.startswith("whether actors float is unknown")]


def test_a_mesh_that_rises_above_the_lanes() -> None:
    """Who falls on its feet is spawned higher, unless somebody stands there."""
    with StandInProcess([OWN_MAPS], "highway", "--fault", "rising-mesh") as server:
        settings = in_carla(RunSettings(max_time=0.5), server.port, control={"": "driven"})
        assert run(settings).status == "timeout"
        heights = [pose[0][2] for name, (_, pose, *_) in spawns(server)]
    assert heights == pytest.approx([0.3, 0.6, 0.3, 0.6], abs=1e-3)


def spawns(server: StandInProcess) -> list[tuple[str, list[Any]]]:
    return [(name, given) for name, given in server.calls() if name == "spawn_actor"]
