"""Two back ends for one source: what goes wrong in one costs nothing of the other."""

import shutil
from pathlib import Path

import pytest

from osc2tx.backends.py_trees import emitter as module_emitter
from osc2tx.backends.xosc import emitter as xml_emitter
from osc2tx.building.build import build
from osc2tx.config import GivenOptions
from osc2tx.diagnostics import InternalCompilerError

SOURCE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario s:
    road: map with:
        keep(it.map_file == "road.xodr")
    ego: vehicle

    do ego.drive(duration: 1s) with:
        lane(1, at: start)
        position(5m, at: start)
"""
MAPS = Path(xml_emitter.__file__).parents[3] / "runtime_lib/osc2tx_runtime/maps"


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "src" / "s.osc"
    path.parent.mkdir()
    path.write_text(SOURCE, encoding="utf-8")
    shutil.copy(MAPS / "highway.xodr", path.parent / "road.xodr")
    return path


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.name[0] != "."}


def broken(*_: object) -> None:
    raise InternalCompilerError("a sentence without verb")


def test_a_bug_of_the_xml_leaves_the_module(source: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = source.parent.parent / "out"
    build([source], out, GivenOptions())
    before = files(out)
    assert {"s.py", "s.xosc"} <= set(before)
    monkeypatch.setattr(xml_emitter, "make_document", broken)
    source.write_text(SOURCE.replace("1s", "2s"), encoding="utf-8")
    result = build([source], out, GivenOptions())
    told = f"{source}: internal error in OpenSCENARIO XML: a sentence without verb"
    assert result.bugs == (told,)
    after = files(out)
    assert after["s.py"] != before["s.py"] and b"2 * s" in after["s.py"]
    assert after["s.xosc"] == before["s.xosc"]  # it is no orphan, only old
    monkeypatch.undo()
    assert build([source], out, GivenOptions()).bugs == ()  # a bug is not remembered
    assert files(out)["s.xosc"] != before["s.xosc"]


def test_a_bug_of_the_module_leaves_the_xml(source: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = source.parent.parent / "out"
    monkeypatch.setattr(module_emitter, "render_source_map", broken)
    result = build([source], out, GivenOptions())
    assert result.bugs == (f"{source}: internal error in the module: a sentence without verb",)
    assert files(out).keys() == {"s.xosc", "s.xosc.report.json"}  # which says: not measured


def test_a_map_that_changes_is_read_again(source: Path) -> None:
    """As with `--watch`, in one process: another map of the same name has other lanes."""
    out = source.parent.parent / "out"
    build([source], out, GivenOptions(target="xosc"))
    before = files(out)["s.xosc"]
    shutil.copy(MAPS / "left_hand.xodr", source.parent / "road.xodr")
    build([source], out, GivenOptions(target="xosc"))
    after = files(out)["s.xosc"]
    assert b"<LanePosition" in before and b"<LanePosition" in after
    assert before != after
