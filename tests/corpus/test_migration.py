"""Scenarios written for ScenarioRunner: those whose map is public run to their end."""

from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

import pytest

from osc2tx_runtime import main
from tests.corpus.report import compilation_of, manifest
from tests.corpus.test_run import EXTERNAL, MAPS, load, own_scenarios

UNREADABLE = 4  # exit code of `main` without its map

# What asks for something impossible, by the end of the file's name, and what is said then.
IMPOSSIBLE = {
    "simdaas_keep_lane.osc": "never ends by itself",
    # 30 km/h all the time, and 20 m behind somebody slower at the end.
    "simdaas_slow_lead.osc": "at its end its distance behind npc is",
    "simdaas_stationary_lead.osc": "at its end its distance behind npc is",
    # Waits for an event that ScenarioRunner raises by itself, and of which `check` warns.
    "examples/wait.osc": "drive_distance",
}


@pytest.mark.slow
def test_scenarios_of_public_maps_run(test_data: Path, tmp_path: Path) -> None:
    corpus, ended = test_data / "corpus", {}
    maps = [f"--map-path={test_data / 'maps' / name}" for name in MAPS]
    for number, row in enumerate(manifest(corpus)):
        if (row["dialect"], row["kind"]) != ("carla-sr", "scenario"):
            continue
        module = compilation_of(corpus, row).module
        if module is None:
            continue
        path = tmp_path / f"migrated_{number}.py"
        path.write_text(module.python, encoding="utf-8")
        for scenario in own_scenarios(load(path, path.stem)):
            said = StringIO()
            with redirect_stdout(said), redirect_stderr(said):
                code = main(scenario, argv=[f"--allow-external={EXTERNAL}", "--max-time=80", *maps])
            if code != UNREADABLE:
                ended[row["file"]] = (code, said.getvalue())
    failed = {file: said for file, (code, said) in ended.items() if code != 0}
    assert len(ended) - len(failed) >= 11
    for file, said in failed.items():
        expected = next((text for end, text in IMPOSSIBLE.items() if file.endswith(end)), None)
        assert expected is not None and expected in said, (file, said)
    assert len(failed) == len(IMPOSSIBLE)
