"""What we offer to tests of scenarios."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy  # noqa: F401  # loads once per process: `pytester` unloads what its tests import
import pytest

from osc2tx.cli import main
from osc2tx.testing import Run, assert_build_fresh, run_scenario

pytest_plugins = ["pytester"]
SCENARIOS = Path(__file__).parents[2] / "scenarios"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "scenarios").mkdir()
    shutil.copy(SCENARIOS / "cut_in.osc", tmp_path / "scenarios")
    build(tmp_path)
    return tmp_path


def build(project: Path) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["build", str(project / "scenarios"), "-o", str(project / "generated")])
    assert ended.value.code == 0


def assert_fresh(project: Path) -> None:
    assert_build_fresh(project / "scenarios", project / "generated")


def test_a_fresh_build_passes(project: Path) -> None:
    assert_fresh(project)


def test_a_changed_source_is_shown_as_a_diff(project: Path) -> None:
    source = project / "scenarios" / "cut_in.osc"
    source.write_text(source.read_text().replace("5s", "6s"))
    with pytest.raises(AssertionError) as caught:
        assert_fresh(project)
    message = str(caught.value)
    assert "cut_in.py: is stale" in message
    assert "duration=5 * s" in message and "duration=6 * s" in message


def test_a_missing_and_an_orphaned_output_fail(project: Path) -> None:
    source = project / "scenarios" / "cut_in.osc"
    source.rename(source.with_name("overtake.osc"))
    with pytest.raises(
        AssertionError, match=r"(?s)cut_in\.py: is orphaned.*overtake\.py: is missing"
    ):
        assert_fresh(project)


def test_an_edit_by_hand_fails(project: Path) -> None:
    with (project / "generated" / "cut_in.py").open("a") as file:
        file.write("# by hand\n")
    with pytest.raises(AssertionError, match=r"cut_in\.py: was edited"):
        assert_fresh(project)


def test_errors_in_a_source_fail(project: Path) -> None:
    (project / "scenarios" / "wrong.osc").write_text("actor (\n")
    with pytest.raises(AssertionError, match=r"wrong\.osc:1: OSC\d+: "):
        assert_fresh(project)


def test_update_writes_instead_of_failing(project: Path) -> None:
    shutil.rmtree(project / "generated")
    assert_build_fresh(project / "scenarios", project / "generated", update=True)
    assert_fresh(project)


def test_a_run_answers_questions() -> None:
    run = run_scenario(SCENARIOS / "cut_in.osc", set={"v_other": 25.0}, seed=3)
    assert (run.status, run.reason, run.collisions) == ("success", "", [])
    assert run.lines[0]["seed"] == 3
    assert max(state["v"] for state in run.states("other")) == pytest.approx(25.0)
    assert run.state("ego", 1.0)["t"] == pytest.approx(1.0)
    assert len(run.actions("cut_in.osc:30", "end")) == 1


def test_a_module_runs_like_its_source(project: Path) -> None:
    source = run_scenario(project / "scenarios" / "cut_in.osc")
    assert run_scenario(project / "generated" / "cut_in.py").lines == source.lines


def test_a_source_with_errors_does_not_run(project: Path) -> None:
    wrong = project / "scenarios" / "wrong.osc"
    wrong.write_text("scenario s:\n    do nothing()\n")
    with pytest.raises(AssertionError, match=r"wrong\.osc:2"):
        run_scenario(wrong)


def test_pytest_finds_the_plugin(pytester: pytest.Pytester, project: Path) -> None:
    """The option updates what the same test finds to differ without it."""
    pytester.makepyfile(
        f"from osc2tx.testing import assert_build_fresh\n"
        f"def test_fresh(): assert_build_fresh({str(project / 'scenarios')!r}, 'new')\n"
    )
    assert pytester.runpytest().ret == 1
    assert pytester.runpytest("--update-generated").ret == 0
    assert pytester.runpytest().ret == 0


def test_a_run_is_one_line_in_messages() -> None:
    lines = tuple({"kind": "state", "t": float(step)} for step in range(1000))
    run = Run("failure", "too close", 12.5, lines, ("a warning",))
    assert repr(run) == "<Run: failure after 12.50 s: too close>"
