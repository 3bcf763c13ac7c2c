"""Open ranges: what stays a parameter, and that it is right for all its values."""

from pathlib import Path

import pytest
from lxml import etree

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, XmlOptions, XmlVersion
from osc2tx.xosc.arithmetic import evaluated
from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.numbers import Noted
from tests.unit.backends.xosc.checks import schema_errors, story_problems

SOURCE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario ranges:
    ego: vehicle
{values}
    do serial:
        ego.drive(duration: {duration}) with:
            speed({speed})
        ego.change_speed(target: {target}, rate_profile: {profile}, {course})
"""
RANGE = "    {}: {} with:\n        keep(it in {})\n"
V = RANGE.format("v", "speed", "[10mps..20mps]")


def emitted(
    folder: Path,
    values: str,
    version: XmlVersion = "1.3",
    *,
    duration: str = "3s",
    speed: str = "10mps",
    target: str = "15mps",
    course: str = "duration: 4s",
    profile: str = "constant",
):  # type: ignore[no-untyped-def]
    path = folder / "a.osc"
    text = SOURCE.format(
        values=values,
        duration=duration,
        speed=speed,
        target=target,
        course=course,
        profile=profile,
    )
    path.write_text(text, encoding="utf-8")
    options = XmlOptions(version=version, allow_approx=True)
    compilation = Compilation(path, path.name, CompileOptions(target="xosc", xml=options))
    assert compilation.ir is not None, compilation.diagnostics
    (scenario,) = compilation.xml
    assert scenario.xml is not None, scenario.report.obstacles
    assert schema_errors(scenario.xml, version) == []
    assert story_problems(scenario.xml) == []
    return scenario


def declared(scenario) -> list[tuple[str | None, ...]]:  # type: ignore[no-untyped-def]
    root = etree.fromstring(scenario.xml.encode())
    return [
        (node.get("name"), node.get("parameterType"), node.get("value"))
        for node in root.iter("ParameterDeclaration")
        if node.get("parameterType") == "double"
    ]


def grades(scenario) -> dict[str, str]:  # type: ignore[no-untyped-def]
    return {
        entry.construct: entry.grade.value
        for entry in scenario.report.entries
        if entry.construct.startswith("parameter")
    }


def test_a_range_is_declared_with_its_middle_and_its_limits(tmp_path: Path) -> None:
    found = emitted(tmp_path, V, speed="v", target="(v + 5mps) * 2 - v / 4")
    assert declared(found) == [("v", "double", "15")]
    root = etree.fromstring(found.xml.encode())
    limits = [(n.get("rule"), n.get("value")) for n in root.iter("ValueConstraint")]
    assert limits == [("greaterOrEqual", "10"), ("lessOrEqual", "20")]
    targets = [node.get("value") for node in root.iter("AbsoluteTargetSpeed")]
    assert targets == ["$v", "${1.75 * $v + 10}"]
    assert grades(found) == {"parameter v": "exact"}


def test_a_division_by_what_may_be_zero_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.osc"
    text = SOURCE.format(
        values=V + RANGE.format("w", "speed", "[10mps..20mps]"),
        duration="1s * (v / (v - w))",
        speed="v",
        target="15mps",
        course="duration: 4s",
        profile="constant",
    )
    path.write_text(text, encoding="utf-8")
    options = CompileOptions(target="xosc", xml=XmlOptions(allow_approx=True))
    (scenario,) = Compilation(path, path.name, options).xml
    reasons = [entry.reason for entry in scenario.report.obstacles]
    assert reasons == ["`v / (v - w)` divides by zero"]


def test_values_reach_both_ends(tmp_path: Path) -> None:
    kph = RANGE.format("v", "speed", "[80kph..95kph]")
    found = emitted(tmp_path, kph, speed="v")
    assert schema_errors(found.parameters, "1.3") == []
    root = etree.fromstring(found.parameters.encode())
    (range_,), (steps,) = root.iter("Range"), root.iter("DistributionRange")
    low, high = float(range_.get("lowerLimit")), float(range_.get("upperLimit"))
    assert (low, high) == pytest.approx((80 / 3.6, 95 / 3.6))
    last = low + 4 * float(steps.get("stepWidth"))
    assert last <= high and last == pytest.approx(high, abs=1e-7)


@pytest.mark.parametrize("version", ["1.1", "1.2", "1.3"])
def test_distributions_are_valid_in_every_version_that_has_them(
    version: XmlVersion, tmp_path: Path
) -> None:
    found = emitted(tmp_path, V, version, speed="v", target="v + 1mps")
    assert schema_errors(found.parameters, version) == []


def test_the_oldest_version_has_names_but_no_ranges(tmp_path: Path) -> None:
    found = emitted(tmp_path, V, "1.0", speed="v", target="18mps")
    assert declared(found) == [("v", "double", "15")]
    assert 'value="$v"' in found.xml and "ConstraintGroup" not in found.xml
    assert found.parameters is None
    assert grades(found) == {"parameter v": "approximated"}


def test_the_oldest_version_has_no_expressions(tmp_path: Path) -> None:
    found = emitted(tmp_path, V, "1.0", speed="v", target="v + 5mps")
    assert declared(found) == [] and "$" not in found.xml
    assert grades(found) == {"parameter v": "approximated"}


def test_elements_that_depend_on_it_leave_it_one_value(tmp_path: Path) -> None:
    """From 30 m/s the way to 15 m/s is a profile within limits of the jerk, or an even one."""
    profile = RANGE.format("p", "dynamic_profile", "[dynamic_profile!none, dynamic_profile!smooth]")
    found = emitted(tmp_path, profile + V, speed="v", course="rate_peak: 2mpss", profile="p")
    assert grades(found) == {"parameter p": "approximated", "parameter v": "exact"}
    assert next(name for name, _, _ in declared(found)) == "v"
    (loss,) = (entry for entry in found.report.entries if entry.construct == "parameter p")
    assert loss.bound.endswith("p is none of [none, smooth]")


def test_a_set_is_listed(tmp_path: Path) -> None:
    found = emitted(tmp_path, RANGE.format("v", "speed", "[10mps, 12mps, 20mps]"), speed="v")
    root = etree.fromstring(found.parameters.encode())
    assert [node.get("value") for node in root.iter("Element")] == ["10", "12", "20"]


def test_a_whole_number_has_the_type_of_whole_numbers(tmp_path: Path) -> None:
    both = V + RANGE.format("n", "int", "[1..2]")
    for version, type_ in (("1.1", "integer"), ("1.2", "int")):
        found = emitted(tmp_path, both, version, speed="v", target="v + n * 1mps")
        root = etree.fromstring(found.xml.encode())
        types = {n.get("name"): n.get("parameterType") for n in root.iter("ParameterDeclaration")}
        assert (types["v"], types["n"]) == ("double", type_)
        assert set(grades(found).values()) == {"exact"}
        assert 'value="${$v + $n}"' in found.xml


def test_a_range_that_nobody_looks_at_changes_nothing(tmp_path: Path) -> None:
    found = emitted(tmp_path, V)
    assert grades(found) == {"parameter v": "exact"}


# --- symbols ---


@pytest.mark.parametrize(
    "compute",
    [
        lambda x: x + 2.5,
        lambda x: 2.5 - x,
        lambda x: -x,
        lambda x: (x + 1) * (x - 1) / (2 - x),
        lambda x: 5 / x - (-2) / (x / 3 + 1),
        lambda x: (x + 1) / (x * (x + 2)) / 7 / (1 / x),
        lambda x: -(x * x) - 3 - x / 3.6,
        lambda x: x - (x - 1) - (2 - (x - 3)),
        lambda x: abs(-x) + round(x * 1.1, 3) + +x,
        lambda x: 1e-7 * x + 1e9,
        lambda x: max(x, 0.0) + min(100.0, x),
    ],
)
@pytest.mark.parametrize("value", [3.0, 4.5, 19.0])
def test_expressions_say_what_was_computed(compute, value: float) -> None:  # type: ignore[no-untyped-def]
    result = compute(Symbol(3.0, "$x"))
    assert isinstance(result, Symbol)
    assert evaluated(result.attribute, {"x": value}) == pytest.approx(compute(value), rel=1e-9)
    assert float(result) == pytest.approx(compute(3.0))


def test_symbols_are_plain_where_nothing_is_left_to_say() -> None:
    x = Symbol(3.0, "$x")
    assert x + 0.0 is x and x * 1 is x and 1 * x is x and x / 1 is x and x - 0 is x
    assert x - x == 0.0 and not isinstance(x - x, Symbol)
    assert x == Symbol(4.0, "$x") and x != 3.0 and x != Symbol(3.0, "$y")
    assert hash(x) == hash(Symbol(4.0, "$x"))


def test_what_is_the_same_for_all_values_is_a_number() -> None:
    x, y = Symbol(12.5, "$x"), Symbol(3.0, "$y")
    assert (12.5 - x) / ((12.5 - x) / 2.7) == pytest.approx(2.7)  # 0 / 0 for the nominal value
    assert x / (x / 3) == pytest.approx(3.0) and (x + y) - (y + x) == 0.0
    assert x + 2.0 - x == 2.0 and 0 * x == 0.0


@pytest.mark.parametrize(
    ("compute", "text"),
    [
        (lambda x, y: x + 2 + 3, "${$x + 5}"),
        (lambda x, y: 2 * (-1) * (5 - x) / 4, "${$x / 2 - 2.5}"),
        (lambda x, y: -x - 1, "${(-1) * $x - 1}"),
        (lambda x, y: x / 3.6, "${$x / 3.6}"),
        (lambda x, y: (x + y) / 2, "${($x + $y) / 2}"),
        (lambda x, y: y + (x - y), "$x"),
        (lambda x, y: (x + 1) / (2 * y), "${($x + 1) / (2 * $y)}"),
    ],
)
def test_constants_meet(compute, text: str) -> None:  # type: ignore[no-untyped-def]
    assert compute(Symbol(3.0, "$x"), Symbol(4.0, "$y")).attribute == text


def test_numbers_with_notes_meet_symbols() -> None:
    x, two = Symbol(3.0, "$x"), Noted(2.0, "two")
    found = [two + x, two - x, two * x, two / x, x + two, x - two, x * two, x / two]
    assert all(isinstance(each, Symbol) for each in found)
    assert [float(each) for each in found] == [5, -1, 6, 2 / 3, 5, 1, 6, 1.5]
    assert not any(isinstance(each, Noted) for each in (two + 1.0, 1.0 - two, two * two, -two))


def test_long_expressions_are_given_up() -> None:
    x: float = Symbol(3.0, "$x")
    for _ in range(8):
        x = (x + 1.5) * x
    assert not isinstance(x, Symbol)
