"""Same bytes and messages wherever, however and in whatever order the sources are built."""

import os
import random
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.unit.building.projects import Project, contents, write

ROOT = Path(__file__).parents[3]


def osc2tx(folder: Path, seed: int, *arguments: str) -> tuple[int, str, str]:
    folders = os.pathsep.join([str(ROOT), str(ROOT / "runtime_lib")])
    environment = {**os.environ, "PYTHONPATH": folders, "OSC2TX_NO_CACHE": "1"}
    ended = subprocess.run(
        [sys.executable, "-m", "osc2tx", "build", *arguments],
        cwd=folder,
        env={**environment, "PYTHONHASHSEED": str(seed), "TZ": f"UTC{seed}", "LC_ALL": "C"},
        capture_output=True,
        text=True,
        check=False,
    )
    return ended.returncode, ended.stdout, ended.stderr


@pytest.fixture(scope="module")
def original(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """Sources of every kind: the repository's own, some with warnings, errors, and collisions."""
    folder = tmp_path_factory.mktemp("original")
    shutil.copytree(ROOT / "scenarios", folder / "in")
    project = Project(folder)
    project.drive("two-lanes.osc")
    project.drive("two_lanes.osc")
    project.drive("\u00fcber/stra\u00dfe.osc")
    for number in range(4):
        project.drive(f"warn{number}.osc", head="use std.stdtypes\n")
        write(project.sources / f"bad{number}.osc", "scenario top:\n  x: vehicel\n  y: lenght\n")
    return project


# Each is another than the first in all that must not count.
DEEPER = "some where/else/deeper"
WAYS = [("here", 0, 1), (DEEPER, 1, 2), (DEEPER, 2, 2)]


@pytest.mark.slow
def test_same_bytes_and_messages(original: Project, tmp_path: Path) -> None:
    outcomes = []
    for number, (folder, seed, workers) in enumerate(WAYS):
        place = tmp_path / str(number) / folder
        shutil.copytree(original.folder, place)
        files = sorted(path.relative_to(place) for path in (place / "in").rglob("*.osc"))
        chance = random.Random(number)
        chance.shuffle(files)
        for path in files:  # the order in which the folder has them
            text = (place / path).read_bytes()
            (place / path).unlink()
            (place / path).write_bytes(text)
        ended = osc2tx(place, seed, "in", "-o", "out", "-j", str(workers))
        outcomes.append((ended, contents(place / "out")))
    (code, out, err), files = outcomes[0]
    assert code == 3
    assert len(files) > 20
    assert err.count("error[") >= 8
    assert out.count("\n") == 2  # the summary, and how many have XML
    assert all(outcome == outcomes[0] for outcome in outcomes)
    assert str(tmp_path).encode() not in b"".join(files.values())


@pytest.mark.slow
def test_the_order_on_the_command_line_does_not_count(original: Project, tmp_path: Path) -> None:
    outcomes = []
    for number in range(3):
        place = tmp_path / str(number)
        shutil.copytree(original.folder, place)
        files = [str(path.relative_to(place)) for path in (place / "in").glob("*.osc")]
        random.Random(number).shuffle(files)
        code, out, err = osc2tx(place, number, *files, "-o", "out", "-j", str(1 + number % 2))
        outcomes.append((code, out, err, contents(place / "out")))
    assert all(outcome == outcomes[0] for outcome in outcomes)
