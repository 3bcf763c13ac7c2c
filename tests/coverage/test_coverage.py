"""`docs/coverage.md` is up to date, its codes are those of the compiler, and no row has a gap."""

from pathlib import Path

import pytest

from osc2tx.driver import Compilation
from osc2tx.options import CompileOptions
from tests.coverage.capabilities import rows
from tests.coverage.library import Item, Kind, items
from tests.coverage.page import PAGE, render
from tests.coverage.targets import PyTrees

# A scenario that uses one thing which the page says is refused.
PROBE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario probe:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
"""
DO = """
    do ego.drive(duration: 1s) with:
        speed(10mps)
"""


@pytest.mark.slow
def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == render(), "run `make coverage`"


@pytest.mark.slow
def test_there_are_38_rows_and_none_has_a_gap() -> None:
    found = rows()
    assert [row.id for row in found] == [f"C{number:02}" for number in range(1, 39)]
    assert {row.id: row.gaps for row in found if row.gaps} == {}


def of_kind(kind: Kind) -> list[Item]:
    return [item for item in items() if item.kind == kind and "2.1" in item.standards]


def test_the_library_has_what_the_standard_has() -> None:
    """2.1 has 48 actions, five of which are only there to be inherited from, and 31 modifiers."""
    actions = [item.name.rpartition(".")[2] for item in of_kind("action")]
    roots = [name for name in actions if name.startswith(("osc_action", "action_for_"))]
    assert (len(actions), len(roots), len(of_kind("modifier"))) == (48, 5, 31)


def test_every_action_that_one_can_invoke_runs() -> None:
    refused = [i.name for i in of_kind("action") if PyTrees().item(i) == "OSC507"]
    assert all(
        name.rpartition(".")[2].startswith(("osc_action", "action_for_")) for name in refused
    )


@pytest.mark.parametrize(
    ("kind", "code", "owners", "line"),
    [
        ("modifier", "OSC508", "map", "    road.{name}()"),
        ("method", "OSC503", "route", "    r: road\n    event e is rise(r.{name}().s > 1m)"),
        ("field", "OSC501", "weather", "    x: {owner}"),
        ("field", "OSC503", "vehicle", "    event e is rise(ego.{name} == ego.{name})"),
        ("field", "OSC502", "traffic_participant", "    keep(ego.{name} == police)"),
    ],
)
def test_codes_are_those_of_the_compiler(
    tmp_path: Path, kind: Kind, code: str, owners: str, line: str
) -> None:
    target = PyTrees()
    refused = [
        i for i in of_kind(kind) if i.name.startswith(f"{owners}.") and code in target.item(i)
    ]
    if not refused:
        pytest.skip(f"no {kind} of {owners} is refused by {code} any more")
    owner, _, name = refused[-1].name.partition(".")
    path = tmp_path / "probe.osc"
    path.write_text(PROBE + line.format(owner=owner, name=name) + DO, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert not compilation.check()
    assert code in {report.code for report in compilation.diagnostics}
