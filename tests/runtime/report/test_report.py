"""The report as a file: what is in it, what can never be in it."""

import json
import re
from collections.abc import Sequence
from html.parser import HTMLParser
from pathlib import Path

import pytest

from osc2tx_runtime.report import write_report
from osc2tx_runtime.report.page import render_report
from osc2tx_runtime.report.tracks import MAX_SAMPLES


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


def state(t: float, actor: str = "hero", **values: object) -> str:
    return json.dumps({"t": t, "kind": "state", "actor": actor, "x": t, "y": 0.0, **values})


def test_file_is_self_contained(tmp_path: Path, overtaking, highway_map) -> None:
    path = tmp_path / "report.html"
    write_report(path, overtaking, highway_map)
    page = path.read_text(encoding="utf-8")
    assert "http:" not in page and "https:" not in page and "url(" not in page
    assert "@import" not in page and "import(" not in page and "fetch(" not in page
    assert Tags(page).loads == []
    assert b"\r" not in path.read_bytes()


def test_header_actors_and_result_round_trip(overtaking) -> None:
    data = data_of(render_report(overtaking))
    assert data["header"]["scenario"] == "overtake"
    assert data["header"]["parameters"] == {"v_hero": 9.722222}
    assert data["result"]["status"] == "failure"
    assert data["duration"] == 27.5
    assert [actor["id"] for actor in data["actors"]] == ["hero", "npc", "obstacle"]
    assert [actor["movable"] for actor in data["actors"]] == [True, True, False]
    assert data["actors"][1]["length"] == 12
    assert data["actors"][1]["rear"] == 2.4


def test_states_round_trip(overtaking) -> None:
    data = data_of(render_report(overtaking))
    track = data["actors"][0]["track"]
    recorded = [json.loads(line) for line in overtaking]
    wanted = [line for line in recorded if line.get("actor") == "hero" and line["kind"] == "state"]
    assert track["t"] == [line["t"] for line in wanted]
    assert track["x"] == pytest.approx([line["x"] for line in wanted], abs=0.0051)
    assert track["v"] == pytest.approx([line["v"] for line in wanted], abs=0.00051)
    assert track["places"][0] == [0, "16", "-3"]
    assert [place[2] for place in track["places"]] == ["-3", "-2", "-3"]


def test_actor_at_rest_needs_two_samples(overtaking) -> None:
    track = data_of(render_report(overtaking))["actors"][2]["track"]
    assert track["t"] == [0, 27.5]
    assert track["x"] == [500, 500]


def test_actions_are_paired(overtaking) -> None:
    actions = data_of(render_report(overtaking))["actions"]
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
    actions = data_of(
        render_report([json.dumps({"t": t, "status": status, **line}) for t, status in steps])
    )["actions"]
    spans = [(action["start"], action["end"], action["status"]) for action in actions]
    assert spans == [(0, 2, "end"), (1, 3, "fail"), (4, 4, "end")]


def test_marks_have_names(overtaking) -> None:
    marks = data_of(render_report(overtaking))["marks"]
    names = [(mark["kind"], mark["name"]) for mark in marks]
    assert ("event", "CRASH_AVOIDED") in names
    assert ("lights", "high_beam") in names
    assert ("environment", "azimuth 4.71, elevation 0.2") in names


def test_marks_of_events_with_arguments_and_of_signals() -> None:
    lines = [
        {"t": 1.0, "kind": "event", "name": "seen", "arguments": {"gap": 3.5, "lane": -2}},
        {"t": 2.0, "kind": "signal", "signal": "7", "state": "red"},
    ]
    marks = data_of(render_report([json.dumps(line) for line in lines]))["marks"]
    assert [mark["name"] for mark in marks] == ["seen (gap 3.5, lane -2)", "7: red"]


def test_collision_names_its_actors() -> None:
    line = json.dumps({"t": 1.0, "kind": "collision", "actors": ["a", "b"]})
    mark = data_of(render_report([line]))["marks"][0]
    assert mark["name"] == "a and b"
    assert mark["actors"] == ["a", "b"]


def test_long_run_is_thinned_but_keeps_its_ends() -> None:
    count = 3 * MAX_SAMPLES
    track = data_of(render_report([state(k * 0.05) for k in range(count)]))["actors"][0]["track"]
    assert len(track["t"]) == MAX_SAMPLES
    assert track["t"][0] == 0
    assert track["t"][-1] == pytest.approx((count - 1) * 0.05)


def test_hostile_names_stay_data(hostile: Sequence[str], highway_map) -> None:
    page = render_report(hostile, highway_map)
    assert page.count("<img") == 0
    assert page.count("</script") == 2
    assert "\u2028" not in page
    tags = Tags(page).tags
    assert tags.count("script") == 2
    assert "img" not in tags
    assert "onerror" in data_of(page)["header"]["scenario"]


def test_lone_surrogates_can_be_written(tmp_path: Path) -> None:
    write_report(tmp_path / "r.html", ['{"kind": "header", "scenario": "\\ud800"}'], None)


def test_same_trace_same_bytes(tmp_path: Path, overtaking, highway_map) -> None:
    for name in ("a.html", "b.html"):
        write_report(tmp_path / name, overtaking, highway_map)
    assert (tmp_path / "a.html").read_bytes() == (tmp_path / "b.html").read_bytes()


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
    assert data_of(render_report(lines, highway_map))["skipped"] == skipped


def test_without_map_and_without_result(overtaking) -> None:
    data = data_of(render_report(overtaking[:-1], None))
    assert data["lanes"] == []
    assert data["result"] is None


def test_size_of_a_minute_with_three_actors() -> None:
    lines = [
        state(k * 0.05, name, v=k / 7, a=k / 77, h=k / 777, s=k / 7, offset=k / 7777)
        for k in range(1200)
        for name in "abc"
    ]
    assert len(render_report(lines)) < 400_000
