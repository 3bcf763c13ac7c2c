"""The report of a campaign: page, summary, JUnit, comparison."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as etree

import jsonschema
import pytest

from osc2tx.campaigns.junit import render_junit
from osc2tx.campaigns.report import render_report
from osc2tx.campaigns.store import Store
from osc2tx.campaigns.summary import Results, results_of, summary_of
from osc2tx.cli.campaign_run import summary
from osc2tx_shared.classes import replace
from tests.campaigns.kit import Here, plan_of, run
from tests.unit.cli.shell import Shell

SCHEMA = Path(__file__).parents[2] / "docs" / "campaign-summary.schema.json"

TEXT = """import osc.standard

scenario top:
    v: speed with:
        keep(it in [10mps..20mps])
    w: speed with:
        keep(it in [10mps..20mps])
    keep(v < w)
    ego: vehicle
    event never
    cover(v, unit: mps, range: [10..20], every: 5, text: "</script><b>bold</b>")
    cover(w, unit: mps, range: [10..20], every: 5)
    cover(both, items: [v, w])
    record(end_speed, expression: ego.speed, unit: kph)
    do serial:
        ego.drive(duration: 0.2s) with:
            speed(v)
        parallel(duration: 0.1s):
            wait v < 17mps
            ego.drive(duration: 0.1s)
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    store = tmp_path_factory.mktemp("report") / "top.campaign"
    run(plan_of(TEXT, "max_deceleration"), store, "sobol", 40, Here())
    return store


@pytest.fixture(scope="module")
def results(place: Path) -> Results:
    with Store(place) as store:
        return results_of(store)


def data_of(page: str) -> dict[str, Any]:
    found = re.search(r'<script type="application/json" id="run-data">(.*?)</script>', page, re.S)
    assert found is not None
    data: dict[str, Any] = json.loads(found[1])
    return data


def test_failures_are_grouped_with_their_shortest_row(results: Results) -> None:
    failing = [run for run in results.runs if run["parameters"]["v"] >= 17]
    assert failing
    (group,) = results.failures
    assert list(group.rows) == [run["number"] for run in failing]
    assert group.smallest["time"] == min(run["time"] for run in failing)
    assert not re.search(r"\d", group.reason)


def test_the_summary_says_what_the_store_has(results: Results) -> None:
    said = json.loads(json.dumps(summary_of(results)))
    jsonschema.validate(said, json.loads(SCHEMA.read_text(encoding="utf-8")))
    assert said["rows"]["total"] == sum(said["rows"]["by_status"].values()) == 40
    assert said["rows"]["accepted_percent"] == 100 * 40 / (40 + said["rows"]["left_out"])
    both = next(item for item in said["coverage"] if item["name"] == "both")
    assert (both["possible"], both["grade"]) == (3, 100.0)
    (group,) = said["failures"]
    assert group["replay"] == f"osc2tx campaign replay {results.place} {group['smallest']}"


def test_the_page_has_all_and_loads_nothing(results: Results) -> None:
    page = render_report(results)
    assert page == render_report(results)
    assert not re.search(r"(src|href)=", page.partition("<script>")[0])
    assert "<b>bold" not in page
    data = data_of(page)
    assert data["summary"]["rows"]["total"] == len(data["good"]) == 40
    assert {column["name"] for column in data["columns"]} >= {"v", "w"}
    assert all(len(column["values"]) == 40 for column in data["columns"])
    both = next(item for item in data["items"] if item["name"] == "both")
    assert both["impossible"] == ["1,0"]
    assert sum(both["hits"].values()) == 40


def test_recorded_numbers_have_a_distribution(results: Results) -> None:
    """In the unit of the item, and without buckets that they could be outside of."""
    speeds = [3.6 * run["parameters"]["v"] for run in results.runs]
    (shown,) = (i for i in data_of(render_report(results))["items"] if i["name"] == "end_speed")
    said = next(i for i in summary_of(results)["coverage"] if i["name"] == "end_speed")
    assert (said["grade"], said["outside"]) == (None, 0)
    assert said["values"]["count"] == said["samples"] == len(speeds)
    assert said["values"]["least"] == pytest.approx(min(speeds))
    assert said["values"]["greatest"] == pytest.approx(max(speeds))
    failed = sum(run["status"] != "success" for run in results.runs)
    assert sum(shown["values"]["bad"]) == failed > 0
    assert sum(shown["values"]["good"]) == len(speeds) - failed


def test_rounding_is_no_column(results: Results) -> None:
    runs = [
        {**each, "measures": {"max_jerk": 1.91818 + (1e-6 if each["number"] else 0.0)}}
        for each in results.runs
    ]
    names = [c["name"] for c in data_of(render_report(replace(results, runs=runs)))["columns"]]
    assert "max_jerk" not in names
    assert "v" in names


def test_junit_has_each_row_once(results: Results) -> None:
    root = etree.fromstring(render_junit([results]))
    cases = root.findall("testsuite/testcase")
    assert sorted(int(case.attrib["name"].split()[1]) for case in cases) == list(range_of(results))
    failures = root.findall("testsuite/testcase/failure")
    assert len(failures) == int(root.attrib["failures"]) == len(results.failures[0].rows)
    assert all("osc2tx campaign replay" in (each.text or "") for each in failures)
    assert [len(suite) for suite in root] == [int(suite.attrib["tests"]) for suite in root]


def range_of(results: Results) -> list[int]:
    return sorted(run["number"] for run in results.runs)


def test_compared_with_an_earlier_campaign(results: Results, tmp_path: Path) -> None:
    earlier = tmp_path / "earlier.campaign"
    run(plan_of(TEXT, "max_deceleration"), earlier, "sobol", 2, Here())
    with Store(earlier) as store:
        before = results_of(store)
    found = data_of(render_report(results, before))["against"]
    assert found["grade_before"] < found["grade_now"] == 100.0
    assert found["won"] and not found["lost"]
    turned = data_of(render_report(before, results))["against"]
    assert turned["lost"] == found["won"]


def test_the_command(place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = [tmp_path / name for name in ("page.html", "s.json", "j.xml")]
    options = [f"--output={files[0]}", f"--summary={files[1]}", f"--junit={files[2]}"]
    shell = Shell(capsys, tmp_path)
    ended = shell("campaign", "report", place, *options, "--fail-under", "90")
    assert ended.code == 0
    assert "40 rows" in ended.out
    assert all(file.stat().st_size for file in files)
    empty = tmp_path / "empty.campaign"
    Store(empty, is_new=True).__exit__(None, None, None)
    quiet = shell("campaign", "report", place, "-q")
    assert (quiet.code, quiet.out) == (0, "")
    ended = shell("campaign", "report", empty)
    assert ended.code == 2
    assert "no rows yet" in ended.err


def test_the_last_lines_of_a_run_state_why_rows_broke(tmp_path: Path) -> None:
    """A row that could not run says nothing of the scenario."""
    road = 'road: map with:\n        keep(it.map_file == "nowhere.xodr")\n    ego: vehicle'
    plan = plan_of(TEXT.replace("ego: vehicle", road))
    ended = run(plan, tmp_path / "broken.campaign", "random", 2, Here())
    with Store(tmp_path / "broken.campaign") as store:
        lines = list(summary("top", store, ended, None))
    assert lines[0].endswith("2 new: 2 error")
    assert lines[1].startswith("  row 0: error: map `nowhere.xodr` not found")


def test_several_campaigns(
    place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """An overview with a link to the page of each; figures and rows of all."""
    monkeypatch.chdir(tmp_path)
    other = tmp_path / "more" / "other.campaign"
    other.parent.mkdir()
    run(plan_of(TEXT), other, "sobol", 3, Here())
    options = ["--summary=s.json", "--junit=j.xml", "--fail-under=50"]
    ended = Shell(capsys, tmp_path)("campaign", "report", place, other, *options)
    assert ended.code == 0
    assert [line.split(": ")[1].split(",")[0] for line in ended.out.splitlines()] == [
        "40 rows",
        "3 rows",
    ]
    first, second = data_of((tmp_path / "campaigns.html").read_text("utf-8"))["campaigns"]
    assert (first["rows"], second["rows"]) == (40, 3)
    assert first["failed"] > 0 and first["reason"].startswith("failure: ")
    assert (second["page"], (tmp_path / second["page"]).exists()) == ("more/other.html", True)
    assert (tmp_path / first["page"]).resolve() == place.with_suffix(".html")
    said = json.loads((tmp_path / "s.json").read_text("utf-8"))
    jsonschema.validate(said, json.loads(SCHEMA.read_text(encoding="utf-8")))
    assert [each["rows"]["total"] for each in said["campaigns"]] == [40, 3]
    assert int(etree.parse(tmp_path / "j.xml").getroot().attrib["tests"]) == 43
    against = Shell(capsys, tmp_path)("campaign", "report", place, other, "--against", place)
    assert (against.code, "--against compares one" in against.err) == (2, True)


def test_a_grade_under_the_bar(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    store = tmp_path / "few.campaign"
    run(plan_of(TEXT), store, "random", 1, Here())
    ended = Shell(capsys, tmp_path)("campaign", "report", store, "--fail-under", "90")
    assert ended.code == 1
    assert "required were 90 %" in ended.err
