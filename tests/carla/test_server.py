"""For those who have a server: `OSC2TX_CARLA=localhost:2000 pytest tests/carla/test_server.py`.

Without one this runs against the stand-in. The bounds are those that a real server has to keep.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import RunResult, RunSettings
from osc2tx_runtime.simulators.carla.client_process import ClientProcess

from .runs import GENERATED, happenings, in_carla, run_all

ADDRESS = "OSC2TX_CARLA"
Run = Callable[[str], RunResult]


@pytest.fixture
def address(request: pytest.FixtureRequest) -> tuple[str, int]:
    """Where the server is."""
    given = os.environ.get(ADDRESS)
    if given is None:
        return "127.0.0.1", request.getfixturevalue("stand_in").port
    host, _, port = given.partition(":")
    return host, int(port or 2000)


@pytest.fixture
def run(address: tuple[str, int]) -> Run:
    """Run a cut-in under one control."""

    def in_mode(mode: str) -> RunResult:
        options: dict[str, Any] = {"carla": address, "carla_timeout": 60.0}
        settings = in_carla(RunSettings(), 0, control={"": mode}, **options)
        (result,) = run_all(GENERATED / "cut_in.py", settings).values()
        assert isinstance(result, RunResult), result
        return result

    return in_mode


def expected() -> RunResult:
    """The run in the embedded world."""
    (result,) = run_all(GENERATED / "cut_in.py", RunSettings()).values()
    assert isinstance(result, RunResult)
    return result


def test_exact_is_the_embedded_world(run: Run) -> None:
    assert run("exact").trace_lines[1:] == expected().trace_lines[1:]


def test_driven_tells_the_same_story(run: Run) -> None:
    found, wanted = happenings(run("driven")), happenings(expected())
    assert [what for what, _ in found] == [what for what, _ in wanted]
    assert all(abs(a - b) <= 1.0 for (_, a), (_, b) in zip(found, wanted, strict=True))


def test_driven_keeps_near(run: Run) -> None:
    """Speeds within 1 m/s, and 0.5 m across the lane, once 5 s are over."""
    states = [json.loads(line) for line in run("driven").trace_lines]
    wanted = {
        (line["t"], line["actor"]): line
        for line in map(json.loads, expected().trace_lines)
        if line["kind"] == "state"
    }
    for line in states:
        other = wanted.get((line.get("t"), line.get("actor")))
        if line["kind"] == "state" and other is not None and line["t"] > 5.0:
            assert abs(line["v"] - other["v"]) < 1.0
            assert abs(line["y"] - other["y"]) < 0.5


def test_nothing_is_left(run: Run, address: tuple[str, int]) -> None:
    run("driven")
    client = ClientProcess(60.0)
    try:
        assert not client.ask("connect", *address, 60.0)["synchronous"]
        for role in ("ego", "other"):
            assert client.ask("find", role, 0.0) == []
    finally:
        client.close()
