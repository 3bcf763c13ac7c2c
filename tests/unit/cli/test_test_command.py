"""`osc2tx test`, and `pytest` by itself: scenarios of a project are tests."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from osc2tx.testing.conditions import ValueCondition
from tests.unit.building.test_revision import git
from tests.unit.cli.shell import Shell

BASE = """import osc.standard.all

namespace null use std, stdtypes

enum priority: [low, medium, high]

struct test_case:
    priority: priority = medium
    requirement: string = "none"

scenario straight_road:
    ego: vehicle
    about: test_case
    v_ego: speed
"""
SCENARIO = """import lib.base

namespace null use std, stdtypes

scenario {name} inherits straight_road:
    keep(about.requirement == "REQ-{number}")
    keep(about.priority == priority!{priority})
    keep(v_ego == {speed}kph)

    do serial:
        ego.drive(duration: 1s) with:
            speed(v_ego)
            {more}
"""
IMPOSSIBLE = "until fall(ego.speed > 500kph)"
SETTINGS = """sources = ["scenarios"]
[files."refused/**"]
verdict = "failure"
[files."drafts/**"]
verdict = "skip"
[files."refused/**".run]
max-time = 5
fail-on = ["off_road"]
"""


@pytest.fixture
def project(shell: Shell) -> Shell:
    """Four scenarios, of which one is expected to fail, and a draft."""
    shell.write("osc2tx.toml", SETTINGS)
    shell.write("scenarios/lib/base.osc", BASE)
    for place, number, priority, speed, more in (
        ("urban/slow", 1, "high", 30, ""),
        ("urban/slower", 2, "low", 20, ""),
        ("rural/fast", 3, "high", 90, ""),
        ("refused/never", 4, "medium", 30, IMPOSSIBLE),
        ("drafts/later", 5, "high", 30, IMPOSSIBLE),
    ):
        text = SCENARIO.format(
            name=place.split("/")[1], number=number, priority=priority, speed=speed, more=more
        )
        shell.write(f"scenarios/{place}.osc", text)
    shell.write("tests/data.osc", BASE)  # is no source
    return shell


def start(project: Shell, *arguments: str) -> "subprocess.CompletedProcess[str]":
    found = subprocess.run(
        [sys.executable, "-m", *arguments],
        cwd=project.folder,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert "Traceback" not in found.stderr + found.stdout, found.stdout + found.stderr
    return found


def names(junit: Path) -> list[str]:
    cases = ElementTree.parse(junit).getroot().iter("testcase")
    return sorted(case.attrib["name"] for case in cases)


def test_all_scenarios_are_tests_with_their_results(project: Shell) -> None:
    options = ("--traces", "traces", "--junit", "junit.xml", "-j", "1")
    ended = start(project, "osc2tx", "test", *options)
    assert (ended.returncode, ended.stderr) == (0, ""), ended.stdout
    assert names(project.folder / "junit.xml") == ["fast", "never", "slow", "slower"]
    traces = {
        path.relative_to(project.folder / "traces").as_posix()
        for path in project.folder.glob("traces/**/*.jsonl")
    }
    assert traces == {
        "rural/fast.jsonl",
        "refused/never.jsonl",
        "urban/slow.jsonl",
        "urban/slower.jsonl",
    }
    assert (project.folder / "traces/urban/slow.html").is_file()
    assert "rural/fast.html" in (project.folder / "traces/index.html").read_text("utf-8")
    cases = ElementTree.parse(project.folder / "junit.xml").getroot().iter("testcase")
    found = {
        case.attrib["name"]: {
            each.attrib["name"]: each.attrib["value"] for each in case.iter("property")
        }
        for case in cases
    }
    assert found["never"]["osc2tx.verdict"] == "failure"
    assert found["slow"]["osc2tx.verdict"] == "success"
    assert found["slow"]["about.requirement"] == "REQ-1"
    assert found["slow"]["v_ego"] == "30kph"


def test_a_failure_is_told_in_a_table(project: Shell) -> None:
    project.write("osc2tx.toml", SETTINGS.replace('"failure"', '"success"'))
    ended = start(project, "osc2tx", "test", "-j", "1", "-q")
    assert ended.returncode == 5
    (row,) = (line for line in ended.stdout.splitlines() if line.startswith("scenarios/refused"))
    assert row.split()[:4] == ["scenarios/refused/never.osc", "never", "failure", "success"]
    assert "never occurred" in row


def test_errors_of_a_source_fail_its_test(project: Shell) -> None:
    project.write("scenarios/urban/slow.osc", "scenario slow:\n    ego: vehicel\n")
    ended = start(project, "osc2tx", "test", "scenarios/urban", "-j", "1", "-q")
    assert ended.returncode == 5
    (row,) = (line for line in ended.stdout.splitlines() if line.startswith("scenarios/"))
    assert row.split()[:3] == ["scenarios/urban/slow.osc", "slow", "error"]
    assert "OSC202" in row


def page_data(project: Shell) -> dict[str, Any]:
    text = (project.folder / "out/project.html").read_text(encoding="utf-8")
    found = re.search(r'<script type="application/json" id="run-data">(.*?)</script>', text, re.S)
    assert found is not None
    data: dict[str, Any] = json.loads(found[1])
    return data


def test_the_page_of_a_project(project: Shell) -> None:
    """Verdicts with the values that scenarios fix, and XML by reason."""
    project.write("osc2tx.toml", SETTINGS.replace('"failure"', '"timeout"'))
    options = ("--page", "out/project.html", "--traces", "out/traces")
    ended = start(project, "osc2tx", "test", *options, "-j", "1")
    assert ended.returncode == 5
    data = page_data(project)
    found = {each["name"]: each for each in data["scenarios"]}
    assert list(found) == ["never", "fast", "slow", "slower"]  # by file
    assert found["slow"]["values"] == {
        "about.priority": "high",
        "about.requirement": "REQ-1",
        "v_ego": "30kph",
    }
    assert (found["slow"]["verdict"], found["slow"]["expected"]) == ("success", "success")
    assert (found["never"]["verdict"], found["never"]["expected"]) == ("failure", "timeout")
    assert "never occurred" in found["never"]["reason"]
    assert found["slow"]["page"] == "traces/urban/slow.html"
    assert (project.folder / "out" / found["slow"]["page"]).is_file()
    xml = data["xml"]
    assert xml["scenarios"] == xml["written"] + len(
        {n for r in xml["reasons"] for n in r["scenarios"]}
    )
    assert xml["scenarios"] >= 4
    assert start(project, "osc2tx", "test", *options, "-j", "1").returncode == 5  # written again
    project.write("out/project.html", "mine")
    ended = start(project, "osc2tx", "test", *options, "-j", "1")
    assert (ended.returncode, "it is no page" in ended.stderr) == (2, True)


def test_campaigns_are_for_the_page(project: Shell) -> None:
    ended = start(project, "osc2tx", "test", "--campaign", "a.campaign")
    assert (ended.returncode, "give --page as well" in ended.stderr) == (2, True)
    ended = start(project, "osc2tx", "test", "--campaign", "a.campaign", "--page", "p.html")
    assert (ended.returncode, "a.campaign" in ended.stderr) == (2, True)


@pytest.mark.parametrize(
    ("options", "wanted"),
    [
        (["--osc-where", "about.priority == high"], ["fast", "slow"]),
        (["--osc-where", "about.priority == high", "--osc-where", "v_ego > 40kph"], ["fast"]),
        (["--osc-where", "about.requirement == 'REQ-2'"], ["slower"]),
        (["-k", "slow", "--osc-shard", "2/2"], ["slower"]),
        (["scenarios/urban/slow.osc"], ["slow"]),
    ],
)
def test_pytest_alone_selects_them(project: Shell, options: list[str], wanted: list[str]) -> None:
    paths = [] if options[0].endswith(".osc") else ["scenarios"]
    ended = start(project, "pytest", *paths, *options, "-q", "--collect-only", "-p", "no:xdist")
    assert ended.returncode == 0, ended.stdout
    found = [line.rpartition("::")[2] for line in ended.stdout.splitlines() if "::" in line]
    assert sorted(found) == wanted


def test_wrong_options_say_what_to_write(project: Shell) -> None:
    ended = start(project, "osc2tx", "test", "--where", "about.priority")
    assert ended.returncode == 2
    assert "'about.priority' is no condition: write NAME == VALUE" in ended.stderr
    ended = start(project, "osc2tx", "test", "--shard", "5/4")
    assert ended.returncode == 2
    assert "'5/4' is no shard: write K/N, as in 1/4" in ended.stderr


def test_nothing_selected_is_no_success(project: Shell) -> None:
    ended = start(project, "osc2tx", "test", "--where", "v_ego == 1kph", "-j", "1")
    assert ended.returncode == 2
    assert "no scenario to run" in ended.stderr


def test_jobs_of_ci_may_have_nothing_to_do(project: Shell) -> None:
    """An empty shard, or a change that concerns no selected scenario, fails no job."""
    ended = start(project, "osc2tx", "test", "--shard", "9/9", "-j", "1")
    assert (ended.returncode, "no scenario is in this shard" in ended.stderr) == (0, True)
    ended = start(project, "osc2tx", "test", "--shard", "9/9", "-k", "nothing", "-j", "1")
    assert ended.returncode == 2
    for arguments in (("init", "-q"), ("add", "."), ("commit", "-qm", "one")):
        git(project.folder, *arguments)
    fast = project.folder / "scenarios/rural/fast.osc"
    fast.write_text(fast.read_text().replace("1s", "2s"))
    since = ("--affected-since", "HEAD")
    assert start(project, "osc2tx", "test", *since, "-j", "1").stdout.count("1 passed") == 1
    ended = start(project, "osc2tx", "test", *since, "-k", "slow", "-j", "1")
    assert (ended.returncode, "changes since HEAD" in ended.stderr) == (0, True)


def test_a_value_that_no_scenario_fixes_is_said(project: Shell) -> None:
    ended = start(project, "osc2tx", "test", "--where", "about.prioriti == high", "-j", "1")
    assert ended.returncode == 2
    meant = "no scenario fixes `about.prioriti`; did you mean `about.priority`?"
    assert meant in ended.stderr


def test_a_warning_made_an_error_stops_test_and_run(project: Shell) -> None:
    """One rule for both; a baseline that knows the warning lets both go on."""
    fast = project.folder / "scenarios/rural/fast.osc"
    text = fast.read_text(encoding="utf-8")
    fast.write_text(text.replace("    do serial", "    spare: vehicle\n\n    do serial"))
    strict = '[files."rural/**"]\nerrors = ["OSC433"]\n'
    project.write("osc2tx.toml", f'baseline = "known.json"\n{SETTINGS}{strict}')
    run = ("osc2tx", "run", "scenarios/rural/fast.osc")
    test = ("osc2tx", "test", "-k", "fast", "-j", "1")
    for command, code in ((run, 3), (test, 5)):
        ended = start(project, *command)
        assert ended.returncode == code
        assert "error[OSC433]" in ended.stdout + ended.stderr
    assert start(project, "osc2tx", "check", "--write-baseline").returncode == 0
    for command in (run, test):
        assert start(project, *command).returncode == 0


# `osc2tx test`, interrupted when the first file is compiled.
INTERRUPTED = """
import sys
from osc2tx.building.results import compile_job
from osc2tx.testing import compiled_sources

def interrupted(jobs, workers, memory, known, progress):
    memory.keep(compile_job(jobs[0]))
    progress(1, len(jobs))
    raise KeyboardInterrupt

compiled_sources.compile_jobs = interrupted
sys.argv[1:] = ["test", "-j", "1"]
from osc2tx.start import main
main()
"""


def test_an_interruption_says_what_is_kept(
    project: Shell, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """As of a build: results that are there count for the next call."""
    monkeypatch.setenv("OSC2TX_CACHE_DIR", str(tmp_path_factory.mktemp("cache")))
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    program = [sys.executable, "-c", INTERRUPTED]
    ended = subprocess.run(program, cwd=project.folder, capture_output=True, text=True, check=False)
    assert ended.returncode == 130
    assert "1 of 6 files are done and kept" in ended.stderr


@pytest.mark.slow
def test_processes_of_xdist_give_the_same(project: Shell) -> None:
    pytest.importorskip("xdist")
    for number in range(6, 14):
        text = SCENARIO.format(
            name=f"more_{number}", number=number, priority="low", speed=30, more=""
        )
        project.write(f"scenarios/more/more_{number}.osc", text)
    results = []
    for processes in ("1", "2"):
        ended = start(project, "osc2tx", "test", "-j", processes, "--junit", "junit.xml")
        assert ended.returncode == 0, ended.stdout
        results.append(names(project.folder / "junit.xml"))
    assert results[0] == results[1]
    assert len(results[0]) == 12


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("v == 60kph", True),
        ("v == 16.6666666667mps", True),
        ("v >= 16mps", True),
        ("v < 60kph", False),
        ("v == 16.6666666667", True),  # SI
        ("kind == priority!high", True),
        ("kind != low", True),
        ("kind < low", False),  # texts have no order
        ("count > 2", True),
        ("flag == true", True),
        ('name == "a b"', True),
        ("missing != 1", False),  # not fixed: meets nothing
        ("own == 3furlong", True),
        ("own < 4furlong", True),
        ("own < 4m", False),
    ],
)
def test_conditions_compare_values(text: str, holds: bool) -> None:
    values = {
        "v": "60kph",
        "kind": "high",
        "count": "3",
        "flag": "true",
        "name": "a b",
        "own": "3furlong",
    }
    assert ValueCondition.parse(text).holds(values) is holds


def test_check_tells_what_scenarios_fix(project: Shell) -> None:
    ended = project("check", "--output-format", "json")
    found = {each["name"]: each for each in json.loads(ended.out)["scenarios"]}
    assert not found["straight_road"]["runnable"]
    assert found["fast"]["runnable"]
    assert found["fast"]["values"] == {
        "about.priority": "high",
        "about.requirement": "REQ-3",
        "v_ego": "90kph",
    }


def test_a_member_that_implications_fix_is_not_open(shell: Shell) -> None:
    """Of a struct of a derived actor: what `check` calls concrete, `run` can run."""
    shell.write(
        "styles.osc",
        """import osc.standard.all

namespace null use std, stdtypes

enum mood: [calm, brisk]

struct style:
    mood: mood = calm
    peak: acceleration
    keep(mood == mood!calm => peak == 1.5mpss)
    keep(mood == mood!brisk => peak == 2.5mpss)

actor test_car inherits vehicle:
    style: style

scenario go:
    ego: test_car
    brisk: test_car with:
        keep(it.style.mood == mood!brisk)
    do parallel:
        ego.drive(duration: 1s) with:
            speed(30kph)
        brisk.change_speed(target: 30kph, rate_profile: constant, rate_peak: brisk.style.peak)
""",
    )
    module = shell("build", "styles.osc", "--emit", "py").out
    assert "TestCar(style=Style(peak=1.5 * mpss))" in module
    assert 'Style(mood="brisk", peak=2.5 * mpss)' in module
    assert shell("run", "styles.osc", "--max-time", "20").code == 0
