"""Scenarios of the repository, exported and imported again, do what their documents do.

These are the scenarios with an exact document. `DIFFERENT` says which do not, and what is seen.
"""

from pathlib import Path

import pytest

from osc2tx.cli.import_ import import_all
from osc2tx.importing.document import Folders
from osc2tx_shared.map_files import SHIPPED
from tests.xosc.parity import Given, is_exact, scenarios

SCENARIOS = Path(__file__).parents[2] / "scenarios"
OWN = [path for path in sorted(SCENARIOS.rglob("*.osc")) if path.stem != "hello_world"]

PROFILE = "speeds change at other rates than on a wet road"
DIFFERENT = {  # by names of scenarios
    "durations": "an act that is stopped goes on",
    "towing": "trailers are not coupled",
    "driving_with_a_trailer": "trailers are not coupled",
    "braking_distances": PROFILE,
    "road_conditions": PROFILE,
    "signal_conditions": "traffic lights are not imported",
    "overtaking": "the lane change back finds no lane",
    "relative_coordinates": "distances to places are straight ones, so it ends later",
    "route_coordinates": "distances to places are straight ones",
    "motion_readings": "an edge that is waited for never comes",
    "overriding": "what ends it never comes",
}


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
        is_same = report.measured is not None and report.measured.is_exact
        said = report.measured or report.unmeasured
        assert is_same == (document.name not in DIFFERENT), f"{document.name}: {said}"


def test_the_table_has_no_other_scenarios() -> None:
    names = {each.stem for each in OWN} | {
        line.split()[1].rstrip(":")
        for path in OWN
        for line in path.read_text(encoding="utf-8").splitlines()
        if line.startswith("scenario ")
    }
    assert not DIFFERENT.keys() - names
