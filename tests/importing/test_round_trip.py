"""Scenarios of the repository, exported and imported again, do what their documents do.

These are the scenarios with an exact document. `WITHOUT_SECOND` says of which imports no exact
document exists again, and why.
"""

import math
from pathlib import Path

import pytest

from osc2tx.cli.import_ import import_all
from osc2tx.grading.comparison import Recording
from osc2tx.grading.runs import cached_map, run_in_player
from osc2tx.importing.document import Folders
from osc2tx.xosc import read
from osc2tx.xosc.player import BY_THE_STANDARD, map_of
from osc2tx_shared.map_files import SHIPPED
from tests.xosc.parity import Given, is_exact, scenarios

SCENARIOS = Path(__file__).parents[2] / "scenarios"
OWN = [path for path in sorted(SCENARIOS.rglob("*.osc")) if path.stem != "hello_world"]


@pytest.mark.slow
@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_a_scenario_comes_back(path: Path, tmp_path: Path) -> None:
    for document in scenarios(Given(path)):
        if document.xml is None or not is_exact(document):
            continue
        source = tmp_path / f"{document.name}.xosc"
        source.write_text(document.xml, encoding="utf-8")
        (result,), refused = import_all([source], tmp_path / "out", Folders((SHIPPED,)), force=True)
        report = result.imported.report
        assert not refused
        assert not result.faults
        said = report.measured or report.unmeasured
        assert report.measured is not None, f"{document.name}: {said}"
        assert report.measured.is_exact, f"{document.name}: {said}"


TRAJECTORY = "a walker begins on a trajectory in time, for which `Init` has no form"
RELATIVE = "how fast a relative speed is taken up is one rate in XML, two in the world"
HELD = "the speed that is held is only known during the run"
WITHOUT_SECOND = {  # what is imported has no document again, by names of scenarios
    "assign_orientation": TRAJECTORY,
    "follow_leader": "how a gap is closed is a matter of the tool",
    "move_drive_walk": TRAJECTORY,
    "orientation_modifiers": TRAJECTORY,
    "overriding": "that an event has come before is no comparison with a constant",
    "semantic_validation": HELD,
    "speed_modifier": RELATIVE,
}
STEP, LATE = 0.05, 6  # s; steps: events follow each other one step later, here up to six
NEAR = 0.1  # m


def played(xml: str) -> Recording:
    road_map = cached_map(map_of(xml, (SHIPPED,)))
    return run_in_player(read(xml), road_map, STEP, reading=BY_THE_STANDARD, given={}, most=400.0)


@pytest.mark.slow
@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_a_second_document_plays_the_same(path: Path, tmp_path: Path) -> None:
    """Exported, imported, exported: places within 0.1 m and the way of a step.

    What begins a step later, in an act of its own, brakes that way farther at the speed before.
    """
    for document in scenarios(Given(path)):
        if document.xml is None or not is_exact(document):
            continue
        source = tmp_path / f"{document.name}.xosc"
        source.write_text(document.xml, encoding="utf-8")
        (result,), _ = import_all([source], tmp_path / "out", Folders((SHIPPED,)), force=True)
        name = result.imported.name
        again = scenarios(Given(tmp_path / "out" / f"{name}.osc"))
        second = next(each.xml for each in again if each.name == name)
        assert (second is None) == (document.name in WITHOUT_SECOND), document.name
        if second is None:
            continue
        before, after = played(document.xml), played(second)
        assert abs(before.end - after.end) <= LATE * STEP + 1e-9, document.name
        for said, rows in before.track.items():
            fastest = 0.0
            there = {round(row[0] / STEP): row for row in after.track[result.imported.actors[said]]}
            for row in rows:
                step = round(row[0] / STEP)
                steps = range(step - LATE, step + LATE + 1)
                places = [there[each][1:3] for each in steps if each in there]
                fastest = max(fastest, abs(row[3]))
                way = fastest * STEP
                assert min(math.dist(row[1:3], each) for each in places) <= NEAR + way, said


def test_the_table_has_no_other_scenarios() -> None:
    names = {each.stem for each in OWN} | {
        line.split()[1].rstrip(":")
        for path in OWN
        for line in path.read_text(encoding="utf-8").splitlines()
        if line.startswith("scenario ")
    }
    assert not WITHOUT_SECOND.keys() - names
