"""Abstract, logical, concrete."""

import pytest

from osc2tx.analysis import analyse
from osc2tx.options import OneOfPolicy
from tests.unit.semantics.support import build_text

TEXT = """import osc.standard.all
namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    v: speed = 30kph
    do serial:
        ego.drive(duration: 3s) with:
            speed(v)
            position(10m, at: start)
        ego.change_speed(target: 0kph)
"""


def level(text: str, one_of: OneOfPolicy = "race") -> str:
    model, sink = build_text(text)
    assert not sink.has_errors, sink.sorted()
    analysis = analyse(model, sink, one_of)
    assert not sink.has_errors, sink.sorted()
    return str(analysis.levels[-1]).removeprefix("scenario top: ")


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("", "", "concrete"),
        (" = 30kph", "", "abstract (open: v)"),
        (" = 30kph", " with:\n        keep(it < 30kph)", "abstract (open: v < 30kph)"),
        (
            " = 30kph",
            " with:\n        keep(it in [25kph..30kph])",
            "logical (open: v in [25kph..30kph])",
        ),
        ("speed(v)", "speed([v..40kph])", "logical (open: speed in [v..40kph])"),
        ("duration: 3s", "duration: [2s..3s]", "logical (open: drive duration in [2s..3s])"),
        ("            position(10m, at: start)\n", "", "abstract (open: place of ego)"),
        ("            speed(v)\n", "", "abstract (open: speed of ego)"),
        ("highway.xodr", "highway.xodr", "concrete"),
        (' with:\n        keep(it.map_file == "highway.xodr")', "", "abstract (open: map file)"),
        ("do serial:", "do one_of:", "concrete"),
        ("do serial:", "do parallel(any):", "abstract (open: overlap `any` in line 9)"),
        ("        ego.change_speed(target: 0kph)\n", "        ego.drive()\n",
         "abstract (open: nothing ends it)"),
        ("speed(v)", "speed(faster_than: ego)",
         "abstract (open: amount of speed(faster_than: ego))"),
        ("serial:", "serial(duration: [5s..9s]):", "logical (open: duration in [5s..9s])"),
    ],
)  # fmt: skip
def test_level(old: str, new: str, expected: str) -> None:
    assert old in TEXT
    assert level(TEXT.replace(old, new, 1)) == expected


@pytest.mark.parametrize(
    ("policy", "expected"),
    [
        ("race", "concrete"),
        ("first", "concrete"),
        ("seeded", "logical (open: one_of in line 9)"),
    ],
)
def test_only_a_drawn_member_of_one_of_is_open(policy: OneOfPolicy, expected: str) -> None:
    assert level(TEXT.replace("do serial:", "do one_of:"), policy) == expected


def test_a_scenario_of_an_actor_leaves_the_actor_open() -> None:
    text = "scenario vehicle.cruise:\n    do actor.drive(duration: 3s)\n"
    head = TEXT.partition("scenario")[0]
    expected = "scenario vehicle.cruise: abstract (open: the vehicle that does it)"
    assert level(head + text) == expected


def test_long_lists_are_cut() -> None:
    parameters = "".join(f"    p{i}: speed\n" for i in range(8))
    text = TEXT.replace("    v: speed", parameters + "    v: speed", 1)
    assert level(text) == "abstract (open: p0; p1; p2; p3; p4; and 3 more)"
