"""Each case is a folder `STAGE/NAME/` with `input.osc` and `expected/`; nothing else is left over.

The tests of the stages compare the expected files and fail when one is missing.
"""

from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
EXPECTED = {
    "ast": {"ast.txt"},
    "diagnostics": {"diagnostics.txt"},
    "end_to_end": {"story.txt"},
    "ir": {"ir.txt"},
    "py_trees": {"input.py", "verdict.txt"},
    "semantics": {"model.txt"},
    "xosc": {"scenario.xosc", "parameters.xosc", "report.json", "versions.txt"},
}
"""What the stages write, by folder."""
OTHERS = {
    "semantics/hello_world_asam": {"diagnostics.txt"},
    "semantics/hello_world_carla": {"diagnostics.txt", "model.txt"},
    "semantics/scenario_runner": {"asam.txt", "carla.txt", "model.txt"},
}
"""What tests write whose input is not called `input.osc`, or is one of `scenarios/`."""
OPTIONAL = {"scenario.xosc", "parameters.xosc", "report.json"}
"""What not every case has: the tests of the stage say which."""
CASES = [case for stage in EXPECTED for case in sorted((HERE / stage).iterdir()) if case.is_dir()]


def name(case: Path) -> str:
    return case.relative_to(HERE).as_posix()


def problems(case: Path) -> Iterator[str]:
    """Yield what a case has too much, and what it lacks."""
    expected = OTHERS.get(name(case), EXPECTED[case.parent.name])
    found = {path.relative_to(case / "expected").as_posix() for path in case.glob("expected/**/*")}
    yield from (f"{file} is left over" for file in found - expected)
    yield from (f"{file} is missing" for file in expected - found - OPTIONAL)
    is_input_elsewhere = case.parent.name == "end_to_end" or name(case) in OTHERS
    if not is_input_elsewhere and not (case / "input.osc").is_file():
        yield "input.osc is missing"


def test_a_case_has_its_files_and_no_others() -> None:
    assert len(CASES) > len(EXPECTED)
    assert {name(case): found for case in CASES if (found := sorted(problems(case)))} == {}


def test_every_folder_is_a_stage() -> None:
    folders = {path.name for path in HERE.iterdir() if path.is_dir()}
    assert folders - {"__pycache__"} == EXPECTED.keys()
