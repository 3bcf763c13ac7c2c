"""Imported scenarios, run in the embedded world, do what their documents do in esmini.

So does the player, the reference of the measured grades of imports. What differs stands in
`imports.toml`, with the law of the tool that explains it. Actors that controllers drive are the
matter of the tool.
"""

import json
import math
import os
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import pytest

from osc2tx.cli.import_ import Result, import_all
from osc2tx.compilation.driver import Compilation
from osc2tx.grading.comparison import hops
from osc2tx.grading.plain import plain
from osc2tx.grading.runs import cached_map, run_in_player, run_in_world
from osc2tx.importing.document import Folders
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx.xosc.player import BY_THE_STANDARD
from osc2tx_runtime import RunSettings
from tests.processes import HANGING

LIBRARY = os.environ.get("OSC2TX_ESMINI", "")
DATA = os.environ.get("OSC2TX_TEST_DATA", "")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not LIBRARY, reason="OSC2TX_ESMINI does not name a library of esmini"),
]

HERE = Path(__file__).parent
DIFFERENT = tomllib.loads((HERE / "imports.toml").read_text(encoding="utf-8"))
TEMPLATES = "alks/logical_scenarios/concrete_scenarios"
PROTOCOLS = ("ncap/OpenSCENARIO/NCAP/AEB_C2C_2023", "ncap/OpenSCENARIO/NCAP/AEB_VRU_2023")
DT, LONGEST = 0.02, 70.0  # s
NEAR = 0.1  # m

Rows = Sequence[Sequence[float]]  # time, x, y, speed


def documents() -> list[Path]:
    """Return the templates of UN R157 and the documents of Euro NCAP."""
    folders = [Path(DATA) / "xosc" / each for each in (TEMPLATES, *PROTOCOLS)] if DATA else []
    return [path for folder in folders for path in sorted(folder.glob("*.xosc"))]


def in_esmini(document: Path, maps: Path, result: Path) -> dict[str, Rows]:
    """Return the rows of each entity in esmini."""
    told = [LIBRARY, str(document), str(maps), str(DT), str(LONGEST), str(result)]
    script = [sys.executable, str(HERE / "headless.py"), *told]
    subprocess.run(script, check=True, capture_output=True, timeout=HANGING)
    data = json.loads(result.read_text(encoding="utf-8"))
    assert "error" not in data, data["error"]
    return dict(data["rows"])


def in_world(found: Result, folder: Path) -> dict[str, Rows]:
    """Return the rows of each actor of an imported scenario."""
    imported = found.imported
    place = folder / f"{imported.name}.osc"
    compilation = Compilation(place, place.name, CompileOptions(), text=found.text)
    assert imported.document.map_file is not None
    settings = RunSettings(
        map_path=(imported.document.map_file,), dt=DT, max_time=LONGEST, spawn=imported.starts
    )
    with scenarios_of_module(compilation.whole_module()) as scenarios:
        run = run_in_world(scenarios[imported.name], settings).recording
    return {said: run.track[name] for said, name in imported.actors.items()}


def apart(rows: Rows, others: Rows, reach: int) -> float:
    """Return the longest distance (m) of an actor from where it is within some steps elsewhere.

    Args:
        rows: Its rows.
        others: Those elsewhere.
        reach: How many steps an event may come later or earlier.
    """
    there = {round(row[0] / DT): row for row in others}
    worst = 0.0
    for row in rows:
        step = round(row[0] / DT)
        if step in there:
            near = (there.get(each) for each in range(step - reach, step + reach + 1))
            worst = max(worst, min(math.dist(row[1:3], each[1:3]) for each in near if each))
    return worst


def bound(document: str, entity: str) -> float:
    """Return how far (m) an entity may be from where esmini has it."""
    told = DIFFERENT.get(document, {}).get(entity)
    return NEAR if told is None else float(told.get("metres", math.inf))


@cache
def names() -> list[str]:
    return [path.stem for path in documents()]


@pytest.mark.parametrize("document", documents(), ids=names())
def test_places_are_those_of_esmini(document: Path, tmp_path: Path) -> None:
    results, _ = import_all([document], tmp_path / "out", Folders())
    (found,) = (each for each in results if each.imported.source == document)
    assert not found.faults
    map_file = found.imported.document.map_file
    assert map_file is not None
    played = plain(found.imported.document.resolved)
    reach = 1 + max(hops(played).values(), default=0)
    expected = in_esmini(document, map_file.parent, tmp_path / "result.json")
    world = in_world(found, tmp_path / "out")
    player = run_in_player(
        played, cached_map(map_file), DT, reading=BY_THE_STANDARD, given={}, most=LONGEST
    ).track
    driven = found.imported.report.under_test
    entities = [said for said, name in found.imported.actors.items() if name not in driven]
    if not entities:
        pytest.skip("controllers drive all of its actors")
    off = {
        said: (here, there)
        for said in entities
        if max(
            here := apart(world[said], expected[said], reach),
            # what the player puts elsewhere in `Init` by a gap it shows a step later
            there := apart(player[said][1:], expected[said], reach),
        )
        > bound(document.stem, said)
    }
    assert off == {}, "metres in the world and in the player"


def test_differences_are_of_documents() -> None:
    if DATA:
        assert set(DIFFERENT) <= set(names())
    assert all(each["reason"] for of in DIFFERENT.values() for each in of.values())
