"""The compiler and the runtime agree on which modifiers go together in one action."""

from itertools import combinations
from typing import Any

import pytest

from osc2tx import ir
from osc2tx.diagnostics import DiagnosticSink, SourceFile, Span
from osc2tx.rules.combinations import CombinationCheck
from osc2tx_runtime import Vehicle
from osc2tx_runtime.domain import modifiers as runtime
from osc2tx_runtime.domain.actions.movement.drive import Drive
from osc2tx_runtime.domain.actions.movement.modifier_checks import check_modifiers
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.shapes import CommonPositionShape
from osc2tx_runtime.errors import ScenarioError

SPAN = Span(SourceFile("x.osc", "x"), 0, 1)
OTHER, WAY = Vehicle(name="other"), Path(())
COURSE = CommonPositionShape("smooth")

# name, arguments, at
CALLS: tuple[tuple[str, dict[str, Any], str], ...] = (
    ("speed", {"speed": 3.0}, "all"),
    ("speed", {"speed": 3.0}, "end"),
    ("speed", {"speed": 3.0, "direction": "lateral"}, "all"),
    ("change_speed", {"speed": 3.0}, "all"),
    ("keep_speed", {}, "all"),
    ("acceleration", {"acceleration": 1.0}, "all"),
    ("position", {"distance": 5.0, "behind": OTHER}, "all"),
    ("position", {"distance": 5.0, "behind": OTHER}, "end"),
    ("position", {"distance": 5.0, "behind": OTHER, "shape": COURSE}, "end"),
    ("position", {"distance": 5.0}, "end"),
    ("keep_position", {}, "all"),
    ("distance", {"distance": 5.0, "shape": COURSE}, "all"),
    ("lane", {"lane": 2}, "all"),
    ("keep_lane", {}, "all"),
    ("change_lane", {"side": "left"}, "all"),
    ("lateral", {"distance": 1.0}, "all"),
    ("lateral", {"distance": 1.0, "side_of": OTHER}, "all"),
    ("yaw", {"angle": 0.1}, "all"),
    ("orientation", {"yaw": 0.1}, "all"),
    ("along", {"route": WAY}, "all"),
    ("along", {"route": WAY, "shape": COURSE}, "all"),
    ("speed", {"speed": 3.0, "movement_mode": "monotonous"}, "all"),
    ("physical_movement", {"option": "prefer_non_physical"}, "all"),
)


def call(name: str, arguments: dict[str, Any], at: str) -> ir.ModifierCall:
    """A modifier as the lowering makes it."""
    given = []
    for parameter, value in arguments.items():
        expression: ir.Expression = ir.Literal(
            span=SPAN, type=ir.ValueType(ir.Kind.FLOAT, "float"), value=1.0
        )
        if value is WAY:
            type_ = ir.ValueType(ir.Kind.STRUCT, "path")
            expression = ir.FieldRef(span=SPAN, type=type_, name=parameter)
        if isinstance(value, str):
            type_ = ir.ValueType(ir.Kind.ENUM, "enum")
            expression = ir.EnumValue(span=SPAN, type=type_, member=value, value=0)
        given.append(
            ir.Argument(parameter=parameter, value=expression, is_positional=False, span=SPAN)
        )
    return ir.ModifierCall(span=SPAN, name=name, arguments=tuple(given), at=at)


def compiler_refuses(*calls: tuple[str, dict[str, Any], str]) -> bool:
    sink = DiagnosticSink()
    ego = ir.FieldRef(span=SPAN, type=ir.ValueType(ir.Kind.ACTOR, "vehicle"), name="ego")
    second = ir.Literal(span=SPAN, type=ir.ValueType(ir.Kind.FLOAT, "float"), value=2.0)
    node = ir.Invoke(
        span=SPAN,
        label=None,
        name="ego drives",
        actor=ego,
        owner="vehicle",
        action="drive",
        arguments=(),
        modifiers=tuple(call(*each) for each in calls),
        duration=second,
    )
    check = CombinationCheck(sink, {"ego": ("vehicle",)})
    check.check(node, ends_unknown=False, physical=False)
    check.twice(node)
    return sink.has_errors


def runtime_refuses(*calls: tuple[str, dict[str, Any], str]) -> bool:
    made = []
    for name, arguments, at in calls:
        more = {} if at == "all" else {"at": at}
        made.append(runtime.MODIFIERS[name](**arguments, **more))
    try:
        check_modifiers(Drive(Vehicle(name="ego"), *made, duration=2.0))
    except ScenarioError:
        return True
    return False


@pytest.mark.parametrize("index", range(len(CALLS)))
def test_both_find_the_same(index: int) -> None:
    for other in CALLS[index + 1 :]:
        pair = (CALLS[index], other)
        found = compiler_refuses(*pair), runtime_refuses(*pair)
        assert found[0] == found[1], pair
        turned = compiler_refuses(*pair[::-1]), runtime_refuses(*pair[::-1])
        assert turned == found, pair


def test_some_go_together_and_some_do_not() -> None:
    verdicts = [compiler_refuses(*pair) for pair in combinations(CALLS, 2)]
    assert 60 < sum(verdicts) < len(verdicts) - 60
