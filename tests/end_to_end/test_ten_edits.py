"""Ten typical edits of a repository of tests: each changes the lines of the outputs that say it.

The differences of all outputs, modules and XML, are files in `ten_edits/`, which
`pytest --update-golden` writes.
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import pytest

from osc2tx.building.build import build
from osc2tx.config import GivenOptions

HERE = Path(__file__).parent / "ten_edits"

SCENARIO = """\
# Two cars meet.
import osc.standard.all

namespace null use std, stdtypes

scenario meeting:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    lead: vehicle

    v_ego: speed with:
        keep(it in [60kph..80kph])
    v_lead: speed = 50kph

    do parallel:
        ego_part: serial:
            approach: ego.drive(duration: 4s) with:
                lane(2, at: start)
                position(50m, at: start)
                speed(v_ego)
            pass_by: ego.change_lane(num_of_lanes: 1, side: left)
            ego.drive(duration: 3s) with:
                speed(v_ego)
        lead_part: serial:
            lead.drive(duration: 5s) with:
                lane(2, at: start)
                position(60m, ahead_of: ego, at: start)
                speed(v_lead)
            one_of:
                lead.change_speed(target: 30kph)
                wait elapsed(9s)
"""


class Edit(NamedTuple):
    """What is replaced in the file, and how many lines of modules and of documents may differ."""

    old: str
    new: str
    python: int
    xml: int


BASE = """\
scenario on_the_road:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle

scenario meeting inherits on_the_road:
    lead: vehicle
"""
DECLARED = SCENARIO[SCENARIO.index("scenario meeting") : SCENARIO.index("\n    v_ego")]
LAST_DRIVE = """\
            ego.drive(duration: 3s) with:
                speed(v_ego)
"""
ALTERNATIVES = """\
            one_of:
                lead.change_speed(target: 30kph)
                wait elapsed(9s)
"""
LEAD = SCENARIO[SCENARIO.index("            lead.drive(") : SCENARIO.index("            one_of")]
SECOND = """\

scenario alone:
    road: map with:
        keep(it.map_file == "highway.xodr")
    car: vehicle
    do car.drive(duration: 2s) with:
        lane(1, at: start)
        position(10m, at: start)
        speed(20kph)
"""

EDITS: Mapping[str, Edit] = {
    "add_a_phase": Edit(
        LAST_DRIVE,
        LAST_DRIVE + "            brake: ego.change_speed(target: 20kph)\n",
        *(1, 60),
    ),
    "rename_a_label": Edit("pass_by:", "overtake:", 2, 12),
    "a_second_scenario": Edit(ALTERNATIVES, ALTERNATIVES + SECOND, 40, 0),
    "change_a_range": Edit("[60kph..80kph]", "[60kph..90kph]", 2, 4),
    "add_a_modifier": Edit(LAST_DRIVE, LAST_DRIVE + "                keep_lane()\n", *(4, 12)),
    "reorder": Edit(
        "    ego: vehicle\n    lead: vehicle\n", "    lead: vehicle\n    ego: vehicle\n", *(2, 20)
    ),
    "an_unlabelled_block": Edit(
        LAST_DRIVE,
        "            serial:\n"
        + LAST_DRIVE.replace("            ", "                ", 1).replace(
            "\n                speed", "\n                    speed"
        ),
        *(8, 12),
    ),
    "add_an_actor": Edit(
        "    lead: vehicle\n", "    lead: vehicle\n    walker: person\n", *(2, 30)
    ),
    "extract_a_base": Edit(DECLARED, BASE, 30, 10),
    "delete_a_branch": Edit(
        ALTERNATIVES, "            lead.change_speed(target: 30kph)\n", *(11, 90)
    ),
}


def outputs(text: str, folder: Path) -> dict[str, list[str]]:
    """Return the lines of all that is committed for a file, by name."""
    source = folder / "meeting.osc"
    folder.mkdir()
    source.write_text(text, encoding="utf-8")
    result = build([source], folder / "generated", GivenOptions())
    assert not result.bugs
    assert all(each.is_complete for each in result.results)
    made = sorted((folder / "generated").rglob("*"))
    return {
        path.name: path.read_text(encoding="utf-8").splitlines()
        for path in made
        if path.suffix in (".py", ".xosc") or path.name.endswith(".report.json")
    }


def differences(before: Mapping[str, list[str]], after: Mapping[str, list[str]]) -> str:
    lines: list[str] = []
    for name in sorted(before.keys() | after.keys()):
        lines += difflib.unified_diff(
            before.get(name, []), after.get(name, []), name, name, n=0, lineterm=""
        )
    return "\n".join(lines) + "\n"


def changed(diff: str) -> dict[str, int]:
    """Return how many lines differ, by kind of output; new files do not count."""
    found = {".py": 0, ".xosc": 0}
    kind, is_new = "", False
    for line in diff.splitlines():
        if line.startswith("+++ "):
            kind = ".py" if line.endswith(".py") else ".xosc"
        elif line.startswith("@@"):
            is_new = line.startswith("@@ -0,0")
        elif line[:1] in "+-" and not line.startswith("---") and not is_new:
            found[kind] += 1
    return found


@pytest.fixture(scope="module")
def before(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    return outputs(SCENARIO, tmp_path_factory.mktemp("ten_edits") / "before")


@pytest.mark.parametrize("name", EDITS)
def test_edit(
    name: str, before: dict[str, list[str]], tmp_path: Path, golden: Callable[[str, Path], None]
) -> None:
    edit = EDITS[name]
    assert SCENARIO.count(edit.old) == 1
    diff = differences(before, outputs(SCENARIO.replace(edit.old, edit.new), tmp_path / "after"))
    golden(diff, HERE / f"{name}.diff")
    found = changed(diff)
    assert found[".py"] <= edit.python, diff
    assert found[".xosc"] <= edit.xml, diff
