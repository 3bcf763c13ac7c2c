"""`docs/coverage.md` is up to date, its codes are those of the compiler, and no row has a gap."""

import re
from pathlib import Path

import pytest

from osc2tx.catalogue import catalogue
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.coverage import reference
from tests.coverage.capabilities import rows
from tests.coverage.library import Item, Kind, declared_items
from tests.coverage.not_built import HEAD, NOT_BUILT, NotBuilt
from tests.coverage.page import PAGE, render
from tests.coverage.targets import PyTrees

CODE = re.compile(r"OSC\d{3}")

# A scenario that uses one thing of which the page speaks.
PROBE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario probe:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    a, b: lane
    c: crossing
    j: junction
    light: traffic_light with:
        keep(it.map_id == "1")
"""
DO = """
    do ego.drive(duration: 1s) with:
        speed(10mps)
"""


@pytest.mark.slow
def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == render(), "run `make coverage`"


@pytest.mark.slow
def test_the_reference_shows_what_the_scenarios_give() -> None:
    shown = reference.TABLE.read_text(encoding="utf-8")
    assert shown == reference.render(), "run `make coverage`"


@pytest.mark.slow
def test_there_are_38_rows_and_none_has_a_gap() -> None:
    found = rows()
    assert [row.id for row in found] == [f"C{number:02}" for number in range(1, 39)]
    assert {row.id: row.gaps for row in found if row.gaps} == {}


def of_kind(kind: Kind) -> list[Item]:
    return [i for i in declared_items() if i.kind == kind and "2.1" in i.standards]


ACTIONS = [item.name for item in of_kind("action")]
MODIFIERS = [item.name for item in of_kind("modifier")]


def test_every_action_and_modifier_runs() -> None:
    """All but what is only there to be inherited from; parameters may be refused."""
    found = {item.name: PyTrees().item(item) for item in declared_items()}
    said = {name: found[name].partition(";")[0] for name in (*ACTIONS, *MODIFIERS)}
    assert said == {
        **dict.fromkeys(ACTIONS, "runs"),
        **dict.fromkeys(MODIFIERS, "runs"),
        **dict.fromkeys(catalogue().abstract, "abstract"),
    }


@pytest.mark.parametrize(
    ("kind", "name", "use", "line"),
    [
        ("modifier", "map.crossing_connects", "runs", "road.crossing_connects(c, a, b)"),
        ("modifier", "map.end_lane", "runs", "road.end_lane(a)"),
        ("method", "route.start_point", "runs", "event e is rise(a.start_point().s > 1m)"),
        ("method", "route.end_point", "runs", "event e is rise(c.end_point().t > 1m)"),
        ("field", "crossing.width", "read", "event e is rise(c.width > 1m)"),
        ("field", "crossing.width", "fixed", "keep(c.width == 3m)"),
        ("field", "junction.roads", "read", "event e is rise(j.roads.size() > 1)"),
        ("field", "map.routes", "read", "event e is rise(road.routes.size() > 1)"),
        ("field", "map.routes", "fixed", "keep(road.routes == [a])"),
        ("field", "traffic_light.height", "read", "event e is rise(light.height > 1m)"),
        ("field", "traffic_light.height", "fixed", "keep(light.height == 1m)"),
        ("field", "vehicle.rear_overhang", "read", "event e is rise(ego.rear_overhang > 1m)"),
        ("field", "traffic_participant.role", "fixed", "keep(ego.role == police)"),
    ],
)
def test_the_page_says_what_the_compiler_does(
    tmp_path: Path, kind: Kind, name: str, use: str, line: str
) -> None:
    """What runs, is read or fixed makes a module; everything else is refused by a code it names."""
    (item,) = [each for each in of_kind(kind) if each.name == name]
    said = PyTrees().item(item)
    path = tmp_path / "probe.osc"
    path.write_text(f"{PROBE}    {line}\n{DO}", encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    if use in said.partition(";")[0]:
        assert compilation.check(), compilation.diagnostics
        assert compilation.is_supported, compilation.diagnostics
    else:
        assert not compilation.check()
        assert {report.code for report in compilation.diagnostics} & set(CODE.findall(said))


@pytest.mark.parametrize("use", NOT_BUILT, ids=lambda use: use.what[:40])
def test_what_is_not_built_is_refused_with_its_report(use: NotBuilt, tmp_path: Path) -> None:
    path = tmp_path / "top.osc"
    path.write_text(HEAD + use.text, encoding="utf-8")
    compilation = Compilation(path, "top.osc", CompileOptions(standard="2.2", target="py"))
    assert not compilation.is_supported
    errors = {d.code for d in compilation.diagnostics if d.severity.name == "ERROR"}
    assert errors == {use.code}
