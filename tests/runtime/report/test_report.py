"""The report as a file: what is in it, what can never be in it."""

import hashlib
import json
import re
from collections.abc import Sequence
from html.parser import HTMLParser
from pathlib import Path

import pytest

import osc2tx_runtime.report
from osc2tx_runtime.report.index_page import index_row, render_index
from osc2tx_runtime.report.page import Trace, render_report, render_runs
from osc2tx_runtime.report.tracks import MAX_SAMPLES, pack
from tests.runtime.report.conftest import TraceMaker, highway, wandering

DOCUMENT = Path(__file__).parents[3] / "docs" / "trace.md"
VENDOR = Path(osc2tx_runtime.report.__file__).parent / "vendor"
PUBLISHED = {
    "LICENSE": "8f989229699b4fe2f1a0432d0e9edc338a8a911e250e2d1b01ecd770a5f5b1bd",
    "uplot.css": "df630c6a8d6f8eeaff264b50f73ce5b114f646ffd9a0bb74f049b0a00135fa04",
    "uplot.js": "19c8d4c6ad88929a79f4ae49d6f7161566dfd0ba3d15cc495e974f787eb78f1f",
}


class Tags(HTMLParser):
    """Counts tags and collects the attributes that could load something."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.loads: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.loads += [f"{tag} {name}" for name, _ in attrs if name in ("src", "href", "srcset")]


def data_of(page: str):
    block = re.search(r'<script type="application/json" id="run-data">(.*?)</script>', page, re.S)
    assert block is not None
    return json.loads(block[1])


def run_of(lines, road_map=None):
    (run,) = data_of(render_report(lines, road_map))["runs"]
    return run


def unpacked(column, digits: int) -> list[float | None]:
    """A packed column as its numbers: sums of sums."""
    flat = [
        each
        for part in column
        for each in ([part[0]] * part[1] if isinstance(part, list) else [part])
    ]
    values, last, slope = [], 0, 0
    for difference in flat:
        if difference is not None:
            slope += difference
            last += slope
        values.append(None if difference is None else last / 10**digits)
    return values


def state(t: float, actor: str = "hero", **values: object) -> str:
    return json.dumps({"t": t, "kind": "state", "actor": actor, "x": t, "y": 0.0, **values})


def test_page_is_self_contained(overtaking, highway_map) -> None:
    page = render_report(overtaking, highway_map)
    assert "http:" not in page and "https:" not in page and "url(" not in page
    assert "@import" not in page and "import(" not in page and "fetch(" not in page
    assert Tags(page).loads == []
    assert "\r" not in page


def test_header_actors_and_result_round_trip(overtaking) -> None:
    data = run_of(overtaking)
    assert data["header"]["scenario"] == "overtake"
    assert data["header"]["parameters"] == {"v_hero": 9.722222}
    assert data["result"]["status"] == "failure"
    assert data["duration"] == 27.5
    assert [actor["id"] for actor in data["actors"]] == ["hero", "npc", "obstacle"]
    assert [actor["movable"] for actor in data["actors"]] == [True, True, False]
    assert data["actors"][1]["length"] == 12
    assert data["actors"][1]["rear"] == 2.4


def test_states_round_trip(overtaking) -> None:
    data = run_of(overtaking)
    track = data["actors"][0]["track"]
    recorded = [json.loads(line) for line in overtaking]
    wanted = [line for line in recorded if line.get("actor") == "hero" and line["kind"] == "state"]
    assert unpacked(track["t"], 4) == [line["t"] for line in wanted]
    assert unpacked(track["x"], 2) == pytest.approx([line["x"] for line in wanted], abs=0.0051)
    assert unpacked(track["v"], 3) == pytest.approx([line["v"] for line in wanted], abs=0.00051)
    assert track["places"][0] == [0, "16", "-3"]
    assert [place[2] for place in track["places"]] == ["-3", "-2", "-3"]


def test_actor_at_rest_needs_two_samples(overtaking) -> None:
    track = run_of(overtaking)["actors"][2]["track"]
    assert unpacked(track["t"], 4) == [0, 27.5]
    assert unpacked(track["x"], 2) == [500, 500]


def test_actions_are_paired(overtaking) -> None:
    actions = run_of(overtaking)["actions"]
    found = {(action["name"], action["start"]): action for action in actions}
    assert found["hero change_lane", 17]["end"] == 21
    assert found["hero change_speed", 21]["end"] is None
    assert found["hero change_speed", 21]["status"] == "running"
    assert found["npc keep_space_gap", 26]["status"] == "fail"
    assert found["npc keep_space_gap", 26]["reason"] == "leader lost"
    assert found["npc keep_space_gap", 26]["source"] == "overtake.osc:83"
    assert len(actions) == 9


def test_equal_actions_are_paired_in_order() -> None:
    line = {"kind": "action", "name": "a drive", "actor": "a", "source": "x.osc:1"}
    steps = [(0, "start"), (1, "start"), (2, "end"), (3, "fail"), (4, "end")]
    actions = run_of([json.dumps({"t": t, "status": status, **line}) for t, status in steps])[
        "actions"
    ]
    spans = [(action["start"], action["end"], action["status"]) for action in actions]
    assert spans == [(0, 2, "end"), (1, 3, "fail"), (4, 4, "end")]


def test_marks_have_names(overtaking) -> None:
    marks = run_of(overtaking)["marks"]
    names = [(mark["kind"], mark["name"]) for mark in marks]
    assert ("event", "CRASH_AVOIDED") in names
    assert ("lights", "high_beam") in names
    assert ("environment", "azimuth 4.71, elevation 0.2") in names


def test_marks_of_events_with_arguments_and_of_signals() -> None:
    lines = [
        {"t": 1.0, "kind": "event", "name": "seen", "arguments": {"gap": 3.5, "lane": -2}},
        {"t": 2.0, "kind": "signal", "signal": "7", "state": "red"},
    ]
    marks = run_of([json.dumps(line) for line in lines])["marks"]
    assert [mark["name"] for mark in marks] == ["seen (gap 3.5, lane -2)", "7: red"]


def test_collision_names_its_actors() -> None:
    line = json.dumps({"t": 1.0, "kind": "collision", "actors": ["a", "b"]})
    mark = run_of([line])["marks"][0]
    assert mark["name"] == "a and b"
    assert mark["actors"] == ["a", "b"]


def test_long_run_is_thinned_but_keeps_its_ends() -> None:
    count = 3 * MAX_SAMPLES
    track = run_of([state(k * 0.05) for k in range(count)])["actors"][0]["track"]
    times = unpacked(track["t"], 4)
    assert len(times) == MAX_SAMPLES
    assert times[0] == 0
    assert times[-1] == pytest.approx((count - 1) * 0.05)


def test_hostile_names_stay_data(hostile: Sequence[str], highway_map) -> None:
    page = render_report(hostile, highway_map)
    assert page.count("<img") == 0
    assert page.count("</script") == 2
    assert "\u2028" not in page
    tags = Tags(page).tags
    assert tags.count("script") == 2
    assert "img" not in tags
    assert "onerror" in data_of(page)["runs"][0]["header"]["scenario"]


def test_lone_surrogates_can_be_written() -> None:
    assert render_report(['{"kind": "header", "scenario": "\\ud800"}']).encode()


def test_same_trace_same_text(overtaking, highway_map) -> None:
    pages = [render_report(overtaking, highway_map) for _ in range(2)]
    assert pages[0] == pages[1]


@pytest.mark.parametrize(
    ("lines", "skipped"),
    [
        ([], 0),
        (["", "  "], 0),
        (["not json", "[1]", "3"], 3),
        ([state(0.0), state(0.05)], 0),
        (['{"t": 1, "kind": "weather balloon"}', '{"kind": "event"}', "{}"], 3),
        ([state(0.0, x=float("nan"))], 1),
        (['{"t": 0, "kind": "state"}', '{"t": null, "kind": "state"}'], 2),
        (['{"kind": "header", "actors": 3, "parameters": {"v": NaN}}'], 0),
        (['{"kind": "header", "actors": {"a": null, "b": {"length": "x"}}}'], 0),
    ],
)
def test_odd_traces_do_not_crash(lines: list[str], skipped: int, highway_map) -> None:
    assert run_of(lines, highway_map)["skipped"] == skipped


def test_without_map_and_without_result(overtaking) -> None:
    data = data_of(render_report(overtaking[:-1], None))
    assert data["lanes"] == []
    assert data["runs"][0]["result"] is None


@pytest.mark.slow
def test_a_minute_of_fifty_actors_is_below_two_megabytes() -> None:
    """Nobody moves steadily: speeds wander, lanes are not kept exactly."""
    maker = TraceMaker("many")
    for number in range(50):
        maker.car(f"car{number}", wandering(number))
    assert len(render_report(maker.text(1200), highway())) < 2_000_000


@pytest.mark.parametrize(
    "values", [[], [1.5], [0.0] * 9, [1.0, 2.0, 3.0, None, 4.0, None, None, 0.5]]
)
def test_packed_columns_lose_nothing(values: list[float | None]) -> None:
    assert unpacked(pack(values, 2), 2) == values


def test_nodes_of_the_tree_keep_their_times() -> None:
    node = {"depth": 1, "kind": "wait", "text": "@near", "source": "x.osc:3"}
    runs = [[0.5, 3.0, "success"], [4, None, "running"]]
    line = {"kind": "tree", "nodes": [{**node, "runs": runs}]}
    (found,) = run_of([json.dumps(line)])["nodes"]
    assert found == {**node, "label": "", "runs": runs}


def test_broken_nodes_are_left_out() -> None:
    nodes = [3, {"runs": 4, "depth": "x"}, {"runs": [[1], ["a", 2, "b"]]}]
    found = run_of([json.dumps({"kind": "tree", "nodes": nodes})])["nodes"]
    assert [each["runs"] for each in found] == [[], []]


def test_every_documented_kind_is_read() -> None:
    """The examples of the document, one of each kind of line."""
    lines = re.findall(r"^\{.*\}$", DOCUMENT.read_text(encoding="utf-8"), re.MULTILINE)
    kinds = {json.loads(line)["kind"] for line in lines}
    assert {"choice", "override", "variable", "cover", "criterion", "tree"} <= kinds
    run = run_of(sorted(lines, key=lambda line: json.loads(line).get("t", 0.0)))
    assert run["skipped"] == 0


def test_the_library_on_the_page_comes_from_its_package() -> None:
    """Fetched with `npm pack uplot@1.6.32`; these are the digests of what is in it."""
    digests = {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in VENDOR.iterdir()
    }
    assert digests == PUBLISHED


def test_two_runs_share_a_page(overtaking, highway_map) -> None:
    page = render_runs([Trace(overtaking, "before"), Trace(overtaking[:-1], "after")], highway_map)
    runs = data_of(page)["runs"]
    assert [(run["letter"], run["name"], run["result"] is None) for run in runs] == [
        ("A", "before", False),
        ("B", "after", True),
    ]


def test_the_index_has_a_row_for_each_run(overtaking, hostile) -> None:
    page = render_index(
        [index_row("a.html", Trace(overtaking, "a")), index_row("b.html", Trace(hostile, "b"))]
    )
    first, second = data_of(page)["runs"]
    assert (first["page"], first["status"], first["collisions"]) == ("a.html", "failure", 0)
    assert first["duration"] == 27.5 and first["parameters"] == {"v_hero": 9.722222}
    assert second["collisions"] == 1
    assert Tags(page).tags.count("script") == 2 and Tags(page).loads == []
