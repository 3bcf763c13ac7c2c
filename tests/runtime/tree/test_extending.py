"""Own actions in an own package: the examples of docs/extending.md, installed and run."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from tests.own_actions import DOCUMENT, install, run_module
from tests.processes import Ended

SCENARIO = """
from osc2tx_runtime import Behaviour, Map, Parallel, Scenario, Serial, Vehicle, main
from osc2tx_runtime import methods, user_action
from osc2tx_runtime.modifiers import lane, position, speed

creep = user_action("creep")


class Slow(Scenario):
    name = "slow"
    source = "slow.osc"

    def declare(self) -> None:
        self.road = Map(map_file="highway.xodr")
        self.ego = Vehicle()

    def placement(self) -> None:
        self.place(self.ego, lane(2), position(100.0), speed(2.0))

    def behavior(self) -> Behaviour:
        return BODY


if __name__ == "__main__":
    raise SystemExit(main(Slow))
"""


def run(folder: Path, body: str, *, actions: str | None = None) -> Ended:
    """Install the package of the document into a folder, and run a scenario with it on the path."""
    install(folder, actions)
    script = folder / "slow.py"
    script.write_text(SCENARIO.replace("BODY", body))
    return run_module(script, folder / "t.jsonl", folder)


def trace(folder: Path, kind: str) -> list[Any]:
    lines = map(json.loads, (folder / "t.jsonl").read_text().splitlines())
    return [line for line in lines if line["kind"] == kind]


def test_the_example_is_as_short_as_promised() -> None:
    text = DOCUMENT.read_text(encoding="utf-8")
    first = re.search(r"^@action.*?^```$", text, re.MULTILINE | re.DOTALL)
    assert first is not None
    assert len([line for line in first[0].splitlines()[:-1] if line.strip()]) <= 10


def test_own_actions_are_found_and_run(tmp_path: Path) -> None:
    roll_out = 'methods.bind(self.ego, "roll_out")()'
    body = f'Serial("slow", creep(self.ego, v=1.5, duration=2.0), {roll_out})'
    done = run(tmp_path, body)
    assert done.code == 0, done.err
    ends = [(a["t"], a["name"]) for a in trace(tmp_path, "action") if a["status"] == "end"]
    assert ends == [(2.0, "ego creep"), (5.0, "ego roll_out")]  # 1.5 m/s at 0.5 m/s2
    speeds = {line["t"]: line["v"] for line in trace(tmp_path, "state")}
    assert (speeds[1.0], speeds[4.0], speeds[5.0]) == pytest.approx((1.5, 0.5, 0.0))


def test_conflicts_of_own_actions_are_reported(tmp_path: Path) -> None:
    body = 'Parallel("both", creep(self.ego), self.ego.change_speed(target=5.0))'
    done = run(tmp_path, body)
    assert done.code == 5
    assert done.err == (
        "slow.osc: error[OSC803]: ego.change_speed(target=5.0) (slow.osc) and ego.creep()"
        " (slow.osc) control the longitudinal slot of ego at the same time; let them run one after"
        " the other (at 0.000 s)\n"
    )


def test_a_broken_package_is_named(tmp_path: Path) -> None:
    done = run(tmp_path, 'Serial("s", creep(self.ego))', actions="import no_such_module\n")
    assert done.code == 5
    assert done.err == (
        "slow.osc: error[OSC801]: the actions in my_actions of my-actions cannot be loaded:"
        " ModuleNotFoundError: No module named 'no_such_module'\n"
    )


def test_packages_are_only_read_for_unknown_actions(tmp_path: Path) -> None:
    actions = "raise ImportError('loaded')\n"
    done = run(tmp_path, 'Serial("s", self.ego.drive(duration=0.1))', actions=actions)
    assert done.code == 0, done.err


BROKEN = """
from osc2tx_runtime import Action, action


@action("vehicle", "creep", slots=("longitudinal",), ends="open")
class Creep(Action):
    def __init__(self, actor, *modifiers, **options):
        super().__init__(actor, *modifiers, **options)
        WHERE

    def on_start(self):
        THEN
"""


@pytest.mark.parametrize(("where", "then"), [("self.sped", "pass"), ("pass", "self.sped")])
def test_mistakes_of_own_actions_are_theirs(tmp_path: Path, where: str, then: str) -> None:
    text = BROKEN.replace("WHERE", where).replace("THEN", then)
    ended = run(tmp_path, "creep(self.ego)", actions=text)
    assert ended.code == 5
    assert "ego creep: my_actions.Creep raised AttributeError:" in ended.err
    assert "Traceback" not in ended.err
