"""What the constraint analysis says about parameters."""

import sys

import pytest

from osc2tx.analysis import ConstraintAnalysis, ParameterDomain, State
from osc2tx.analysis.constraints.domains import Choice, Interval
from osc2tx.analysis.constraints.propagation import analyse_constraints
from osc2tx.semantics import symbols as sym
from tests.unit.semantics.support import build_text
from tests.work import calls

HEAD = "import osc.standard.all\nnamespace null use std, stdtypes\n"


def analyse(body: str, head: str = HEAD) -> tuple[ConstraintAnalysis, sym.TypeSymbol]:
    text = head + "struct s:\n" + "".join(f"    {line}\n" for line in body.splitlines())
    model, sink = build_text(text)
    assert not sink.has_errors, sink.sorted()
    analysis = analyse_constraints(model)
    return analysis, list(analysis.types)[-1]


def parameters(body: str) -> dict[str, ParameterDomain]:
    analysis, owner = analyse(body)
    return {found.name: found for found in analysis.parameters(owner)}


def conflicts(body: str, head: str = HEAD) -> list[list[str]]:
    analysis, owner = analyse(body, head)
    return [[c.span.text for c in group] for group in analysis.types[owner].conflicts]


def test_states() -> None:
    found = parameters(
        "a: speed = 36kph\n"
        "b: speed with:\n    keep(it in [10kph..20kph])\n"
        "c: speed\n"
        "d: speed = c + b\n"
        "e: bool\n"
        "f: vehicle_category with:\n    keep(it in [car, truck])\n"
        "g: string = 'x'\n"
        "h: vehicle_category = bus"
    )
    assert {name: p.state.value for name, p in found.items()} == {
        "a": "fixed", "b": "bounded", "c": "free", "d": "defined",
        "e": "free", "f": "bounded", "g": "fixed", "h": "fixed",
    }  # fmt: skip
    assert found["a"].value == pytest.approx(10.0)
    assert found["g"].value == "x"
    category = found["h"].value
    assert isinstance(category, sym.EnumMemberSymbol)
    assert category.name == "bus"
    assert found["b"].range is not None
    assert found["b"].range.span.text == "[10kph..20kph]"
    assert found["d"].definition is not None
    assert found["d"].definition.span.text == "c + b"
    assert isinstance(found["f"].domain, Choice)
    assert len(found["f"].domain.values) == 2


def test_values_are_folded_and_propagated_both_ways() -> None:
    found = parameters(
        "v: speed\nfast: speed\nkeep(fast == v + 10kph)\nkeep(fast == 46kph)\n"
        "n: uint = 3\nm: uint = n * 4 + 1\ngap: length = v * 2s"
    )
    assert found["v"].value == pytest.approx(10.0)
    assert found["m"].value == 13
    assert found["gap"].value == pytest.approx(20.0)


def test_overriding_keeps_what_was_replaced() -> None:
    found = parameters("x: int = 2\nkeep(x in [3..7])\ny: int = 1\nremove_default(y)")
    assert found["x"].domain == Interval(3, 7)
    assert [c.span.text for c in found["x"].replaced] == ["2"]
    assert found["y"].state is State.FREE
    assert [c.span.text for c in found["y"].replaced] == ["1"]


def test_paths_below_a_field() -> None:
    analysis, owner = analyse("p: position_3d with:\n    keep(it.x == 3m)\n    keep(it.y > 1m)")
    (field,) = (m for m in owner.members.values() if isinstance(m, sym.FieldSymbol))
    assert isinstance(field.type.symbol, sym.StructSymbol)  # type: ignore[union-attr]
    x, y = (field.type.symbol.members[n] for n in "xy")  # type: ignore[union-attr]
    assert isinstance(x, sym.FieldSymbol)
    assert isinstance(y, sym.FieldSymbol)
    assert analysis.parameter(owner, field, x).value == 3.0
    assert analysis.parameter(owner, field, y).state is State.FREE


@pytest.mark.parametrize(
    "body",
    [
        "x: speed = 36kph\nkeep(x <= 10mps)\nkeep(x >= 10mps)",
        "x: float\nkeep(x == 0.1 + 0.2)\nkeep(0.3 == x)",
        "x: float = nan\nkeep(x != 1.0)",
        "x: float\nkeep(not (x < 5.0))\nkeep(not (x > 3.0))",  # NaN
        "x: float\ny: float\nkeep(x / y > 1.0)\nkeep(y == 0.0)",
        "x: float\nkeep(x > 1e308)\nkeep(x * 10.0 == inf)",
        "x: int\nkeep(x + 1 < x)",  # wraps round
        "x: uint\nkeep(x - 1 > x)",
        "x: int\nkeep(x / 2 == 1)\nkeep(x == 3)",
        "x: int\nkeep(x % 3 == -1)",
        "x: int\nkeep(x in [7..3])\nkeep(x == 5)",
        "x: speed\nkeep(x == 36kph)\nkeep(x in [10mps..10mps])",
        "x: temperature = 0celsius\nkeep(x > 273K)",
        "a: vehicle\nb: vehicle\nkeep(a == b)\nkeep(a.vehicle_category != b.vehicle_category)",
        "l: list of int = [1, 2]\nkeep(l.size() == 3)",
        "x: float\nkeep((x > 1.0 ? x : 2.0) == 2.0)\nkeep(x == 0.0)",
    ],
)
def test_no_contradiction(body: str) -> None:
    assert conflicts(body) == []


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("x: speed\nkeep(x < 10mps)\nkeep(x == 10mps)", [["x < 10mps", "x == 10mps"]]),
        ("x: uint\nkeep(x <= 3)\nkeep(not (x in [0..4]))", [["x <= 3", "not (x in [0..4])"]]),
        ("x: int\nkeep(x != 3)\nkeep(x in [3..3])", [["x != 3", "x in [3..3]"]]),
        ("b: bool\nkeep(b)\nkeep(b => false)", [["b", "b => false"]]),
        ("x: float\nkeep(x > 2.0)\nkeep(x * x < 3.0)", [["x > 2.0", "x * x < 3.0"]]),
        ("x: float\nkeep(x > 5.0 or x < 1.0)\nkeep(x in [2.0..3.0])",
         [["x > 5.0 or x < 1.0", "x in [2.0..3.0]"]]),
        ("x: string\nkeep(x in ['a', 'b'])\nkeep(x == 'c')", [["x in ['a', 'b']", "x == 'c'"]]),
        ("a: int\nb: int\nkeep(a == 1)\nkeep(a == 2)\nkeep(b == 1)\nkeep(b == 2)",
         [["a == 1", "a == 2"], ["b == 1", "b == 2"]]),
    ],
)  # fmt: skip
def test_contradiction(body: str, expected: list[list[str]]) -> None:
    assert sorted(conflicts(body)) == sorted(expected)


def test_global_parameters_count() -> None:
    head = HEAD + "global top: speed = 50kph\n"
    assert conflicts("v: speed\nkeep(v > top)\nkeep(v < 40kph)", head)
    assert not conflicts("v: speed\nkeep(v > top)\nkeep(v < 60kph)", head)


def look_at_chain(length: int) -> None:
    lines = ["x0: speed = 1mps"]
    lines += [f"x{i}: speed = x{i - 1} + 0.1mps" for i in range(1, length)]
    assert parameters("\n".join(lines))[f"x{length - 1}"].state is State.FIXED


def test_long_chains_take_no_recursion() -> None:
    look_at_chain(3 * sys.getrecursionlimit())


def test_long_chains_take_linear_work() -> None:
    look_at_chain(10)  # what is loaded once does not count
    assert calls(lambda: look_at_chain(500)) < 6 * calls(lambda: look_at_chain(100))


def test_series_that_creep_to_a_limit_end() -> None:
    body = "x: float\ny: float\nkeep(x in [0.0..1.0])\nkeep(y in [0.0..1.0])\n"
    assert conflicts(body + "keep(x == 0.999999 * y)\nkeep(y == 0.999999 * x)") == []


def test_types_of_fields_may_be_cyclic() -> None:
    text = "struct a:\n    b: b\n    keep(b.n > 1)\nstruct b:\n    a: a\n    n: int\n"
    model, sink = build_text(text)
    assert not sink.has_errors
    analyse_constraints(model)
