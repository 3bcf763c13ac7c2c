"""What the player refuses, and what it makes of parameters: with a place and a reason."""

from pathlib import Path

import pytest

from osc2tx.xosc import read
from osc2tx.xosc.arithmetic import evaluated
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player import Evaluator, Unplayable, map_of
from osc2tx_runtime.opendrive import read_map
from osc2tx_shared.map_files import SHIPPED

GENERATED = Path(__file__).parents[2] / "generated"
TEXT = (GENERATED / "cut_in.xosc").read_text(encoding="utf-8")
MAP = read_map(map_of(TEXT, (SHIPPED,)))
CYCLE = (
    '<TrafficSignals><TrafficSignalController name="c"><Phase name="p" duration="0"/>'
    "</TrafficSignalController></TrafficSignals></RoadNetwork>"
)


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ('maximumExecutionCount="1">', 'maximumExecutionCount="2">', "repeated is not played"),
        ("</RoadNetwork>", CYCLE, "cycle that takes no time"),
        ("LanePosition", "RoutePosition", "<RoutePosition> is not played"),
    ],
)
def test_what_is_not_played_is_refused_with_a_reason(before: str, after: str, reason: str) -> None:
    assert before in TEXT
    with pytest.raises(Unplayable, match=reason):
        Evaluator(TEXT.replace(before, after), MAP, 0.05).play(5.0)


def test_what_is_missing_has_a_place() -> None:
    text = TEXT.replace(' conditionEdge="none"', "")
    with pytest.raises(Unresolved, match=r"^\d+:\d+: <Condition> without conditionEdge"):
        Evaluator(text, MAP, 0.05).play(5.0)


def test_a_map_that_is_not_there_has_a_place() -> None:
    with pytest.raises(Unplayable, match=r"^\d+:\d+: there is no map"):
        map_of(TEXT, (GENERATED,))


def test_equal_elements_are_two() -> None:
    """Two equal conditions in two places remember on their own what they have seen."""
    root = read(TEXT)
    assert Evaluator(root, MAP, 0.05).play(300.0) == Evaluator(TEXT, MAP, 0.05).play(300.0)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2.5", 2.5),
        ("$a", 3.0),
        ("${$a * ($b - 1)}", 12.0),
        ("${-$a / 2 + 1}", -0.5),
        ("${pow($a, 2) % 5 + max(round(2.5), 1)}", 7.0),
        ("${1e1 - .5}", 9.5),
        ("${$a / 0}", None),
        ("${sqrt(-1)}", None),
        ("${pow(9e99, 9e99)}", None),
        ("fast", None),
        ("$c", None),
    ],
)
def test_expressions_are_computed_not_run(text: str, value: float | None) -> None:
    assert evaluated(text, {"a": 3.0, "b": 5.0}) == value


@pytest.mark.parametrize(
    "text",
    [
        "${__import__('os')}",
        "${$c + 1}",
        "${1 +}",
        "${(1}",
        "${}",
        "${inf}",
        "${1 2}",
        f"${{{'(' * 999}1{')' * 999}}}",
    ],
)
def test_what_is_no_expression_has_no_value(text: str) -> None:
    assert evaluated(text, {"a": 3.0}) is None
