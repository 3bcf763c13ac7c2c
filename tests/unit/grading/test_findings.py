"""Findings of earlier builds: a document is played again only if another run is due."""

import json
import shutil
from pathlib import Path

import pytest

from osc2tx.building import build as module
from osc2tx.building.build import BuildOptions
from osc2tx.config import GivenOptions
from osc2tx.grading.findings import _without_lines
from osc2tx.grading.measuring import Finding, Measuring
from osc2tx.support.records import Records
from osc2tx_shared.map_files import SHIPPED
from tests.unit.building.projects import contents, write
from tests.unit.grading.test_grading import TEXT, brakes_harder, grade

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"
BASE = f"""{HEAD}scenario town:
    road: map with:
        keep(it.map_file == "own.xodr")
    ego: vehicle
    v: speed with:
        keep(it in [20kph..40kph])
"""
DERIVED = f"""import base
{HEAD}scenario fixed inherits town:
    keep(v == 30kph)
    do ego.drive(duration: 2s) with:
        lane(2, at: start)
        position(100m, at: start)
        speed(v)
"""
OPEN = DERIVED.replace("fixed", "open").replace("    keep(v == 30kph)\n", "")


class Sources:
    """A base and scenarios that inherit it, with a record of the played documents."""

    def __init__(self, folder: Path, played: list[str]) -> None:
        self.folder = folder
        self.played = played
        self.map = folder / "in" / "own.xodr"
        self.map.parent.mkdir(parents=True)
        shutil.copy(SHIPPED / "highway.xodr", self.map)
        write(folder / "in" / "base.osc", BASE)
        write(folder / "in" / "fixed.osc", DERIVED)
        write(folder / "in" / "open.osc", OPEN)

    def edit(self, name: str, old: str, new: str) -> None:
        path = self.folder / "in" / name
        text = path.read_text(encoding="utf-8")
        assert old in text
        path.write_text(text.replace(old, new), encoding="utf-8")

    def build(self) -> list[str]:
        """Return the scenarios whose documents a build plays."""
        self.played.clear()
        result = module.build(
            [self.folder / "in"], self.folder / "out", GivenOptions(), BuildOptions()
        )
        assert not result.bugs
        return sorted(self.played)

    def record_files(self) -> list[Path]:
        cache = self.folder.with_name("cache")
        return [each for each in cache.rglob("findings/*/*") if each.is_file()]

    def records(self) -> list[dict[str, object]]:
        return [json.loads(each.read_bytes()) for each in self.record_files()]

    def check_outputs(self) -> None:
        """Compare the outputs with those of a build that knows no findings."""
        found = {k: v for k, v in contents(self.folder / "out").items() if "osc2tx" not in k}
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("OSC2TX_NO_CACHE", "1")
            fresh = self.folder / "fresh"
            module.build([self.folder / "in"], fresh, GivenOptions(), BuildOptions())
        expected = {k: v for k, v in contents(fresh).items() if "osc2tx" not in k}
        shutil.rmtree(fresh)
        assert found == expected


@pytest.fixture
def sources(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Sources:
    monkeypatch.setenv("OSC2TX_CACHE_DIR", "")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    played: list[str] = []
    run = Measuring.run

    def watched(self: Measuring) -> Finding:
        played.append(self._scenario.name)
        return run(self)

    monkeypatch.setattr(Measuring, "run", watched)
    return Sources(tmp_path / "project", played)


def test_a_range_of_the_base_plays_what_it_leaves_open(sources: Sources) -> None:
    assert sources.build() == ["fixed", "open"]
    sources.edit("base.osc", "[20kph..40kph]", "[20kph..45kph]")
    assert sources.build() == ["open"]
    sources.check_outputs()


def test_comments_and_lines_that_move_play_nothing(sources: Sources) -> None:
    sources.build()
    sources.edit("base.osc", "scenario town", "# In the town\n\nscenario town")
    sources.edit("base.osc", "[20kph..40kph]", "[20kph..45kph]")
    assert sources.build() == ["open"]
    sources.edit("fixed.osc", "    do ego", "    # Slowly\n    do ego")
    assert sources.build() == []
    sources.check_outputs()


def test_a_deviation_is_at_the_line_of_now(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was found about a document that brakes too slowly names the lines where it is now."""
    records = Records(tmp_path / "findings", "stamp")
    first, compilation = grade(tmp_path, brakes_harder, findings=records)
    (before,) = compilation.diagnostics

    def unmeasured(self: Measuring) -> Finding:
        raise AssertionError("it is known")

    monkeypatch.setattr(Measuring, "run", unmeasured)
    moved = TEXT.replace("scenario top", "# It brakes\n\nscenario top")
    second, compilation = grade(tmp_path, brakes_harder, text=moved, findings=records)
    (after,) = compilation.diagnostics
    assert before.primary is not None and after.primary is not None
    assert after.primary.line == before.primary.line + 2
    assert first.report.measured == second.report.measured
    assert [after.message, after.help] == [before.message, before.help]
    assert after.notes == before.notes


def test_sentences_keep_their_lines() -> None:
    lines = ["a.osc:1", "b a.osc:1", "a.osc:12"]
    sentence = "a.osc:12 starts before b a.osc:1, and a.osc:1 at 3 s"
    parts = _without_lines(sentence, lines)
    assert [each for each in parts if isinstance(each, int)] == [2, 1, 0]
    assert "".join(lines[each] if isinstance(each, int) else each for each in parts) == sentence


@pytest.mark.parametrize(
    "name, old, new",
    [
        ("fixed.osc", "v == 30kph", "v == 31kph"),
        ("fixed.osc", "duration: 2s", "duration: 3s"),
        (
            "base.osc",
            "    ego: vehicle\n",
            "    ego: vehicle\n    keep(ego.bounding_box.width == 2m)\n",
        ),
    ],
)
def test_what_changes_the_run_plays_it(sources: Sources, name: str, old: str, new: str) -> None:
    sources.build()
    sources.edit(name, old, new)
    assert "fixed" in sources.build()
    sources.check_outputs()


def test_another_map_plays_all(sources: Sources) -> None:
    sources.build()
    sources.map.write_bytes((SHIPPED / "curve.xodr").read_bytes())
    assert sources.build() == ["fixed", "open"]


def test_that_there_is_no_evidence_is_a_finding(sources: Sources) -> None:
    """In the run of the world an actor comes to the end of its lane."""
    sources.edit("fixed.osc", "duration: 2s", "duration: 280s")
    sources.edit("fixed.osc", "v == 30kph", "v == 40kph")
    assert sources.build() == ["fixed", "open"]
    assert ["reason" in each for each in sources.records()].count(True) == 1
    sources.edit("base.osc", "[20kph..40kph]", "[20kph..45kph]")
    assert sources.build() == ["open"]
    sources.check_outputs()


@pytest.mark.parametrize("text", [b"", b"[1]", b'{"measured": 1}', b"\xff"])
def test_damaged_records_are_as_missing(sources: Sources, text: bytes) -> None:
    sources.build()
    assert [each["is_faithful"] for each in sources.records()] == [True, True]
    for each in sources.record_files():
        each.write_bytes(text)
    sources.edit("base.osc", "[20kph..40kph]", "[20kph..45kph]")
    assert sources.build() == ["fixed", "open"]
