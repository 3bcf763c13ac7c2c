"""The pages that the hooks of the site make."""

import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path, PurePosixPath
from runpy import run_path
from types import SimpleNamespace
from typing import Any

import pytest
from lxml.etree import fromstring

from osc2tx.diagnostics import CODES
from osc2tx.reference import entries, find

TOOLS = Path(__file__).parents[2] / "tools"
PAGES: dict[str, Any] = run_path(str(TOOLS / "site_pages.py"))
PICTURES: dict[str, Any] = run_path(str(TOOLS / "site_pictures.py"))
LLMS: dict[str, Any] = run_path(str(TOOLS / "site_llms.py"))
SPLITS: dict[str, Any] = run_path(str(TOOLS / "site_splits.py"))


def test_links_between_pages_lead_somewhere() -> None:
    place: Callable[..., str] = PAGES["_place"]
    known = {place(entry) for entry in entries()}
    for entry in entries():
        folder = PurePosixPath(place(entry)).parent
        for target in re.findall(r"\]\(\.\./([^)]+)\)", PAGES["page_of"](entry)):
            assert str(folder.parent / target) in known, (entry.key, target)


def test_types_and_modifiers_are_linked() -> None:
    (entry,) = find("action vehicle.change_lane")
    page = PAGES["page_of"](entry)
    assert "[`lane_change_side`](../enum/lane_change_side.md)" in page
    assert "[`speed`](../type/speed.md)" in page
    assert "[`speed`](../modifier/speed.md)" in page


def test_what_the_runtime_carries_out_has_an_example() -> None:
    """From scenarios that the tests run; some modifiers of the map are in none of them."""
    acting = [e for e in entries() if e.shown.xml and e.declaration.kind in ("action", "modifier")]
    acting = [entry for entry in acting if not entry.declaration.name.startswith("map.")]
    without = [entry.key for entry in acting if not entry.shown.example]
    assert without == []


def test_every_code_has_a_page_with_its_remedy() -> None:
    pages = SPLITS["_codes"]()
    assert set(pages) == {code.lower() for code in CODES}
    for code, text in pages.items():
        explanation = CODES[code.upper()].explanation
        assert explanation is None or explanation.faulty.strip() in text


def test_the_chapters_of_the_coverage_page_lose_nothing() -> None:
    whole = (SPLITS["DOCS"] / "coverage.md").read_text(encoding="utf-8")
    kept = "".join(text for _, _, text in SPLITS["_chapters"]())
    rows = [line for line in whole.splitlines() if line.startswith("|")]
    assert rows == [line for line in kept.splitlines() if line.startswith("|")]


def test_old_anchors_lead_to_the_new_pages() -> None:
    lead = SPLITS["_TO_CHAPTER"].sub
    text = "[a](../coverage.md#in-carla) [b](coverage.md#openscenario-xml)"
    assert lead(SPLITS["_lead_to_chapter"], text) == (
        "[a](../coverage-capabilities.md#in-carla) [b](coverage-openscenario-xml.md)"
    )


def test_the_list_for_language_models_has_a_sentence_for_each_page() -> None:
    page = "# Lanes\n\n```\nlane(1)\n```\n\nThe [lane](lane.md) of an actor. More of it.\n"
    line = LLMS["line_of"]("Lanes", "lanes.html", page)
    assert line == "- [Lanes](lanes.html): The lane of an actor"
    assert LLMS["line_of"]("Empty", "empty.html", "# Empty\n") == "- [Empty](empty.html)"
    text = LLMS["document"]("osc2tx", "Compiles.", {"Reference": [line]})
    assert text.startswith("# osc2tx\n\n> Compiles.\n\n")
    assert text.endswith(f"\n\n## Reference\n\n{line}\n")
    documented = sorted((TOOLS.parent / "docs").rglob("*.md"))
    without = [p.name for p in documented if ": " not in LLMS["line_of"]("t", "u", p.read_text())]
    assert without == []


def test_the_list_for_language_models_has_every_page() -> None:
    def file(place: str, text: str) -> SimpleNamespace:
        url = place.replace(".md", ".html")
        return SimpleNamespace(src_uri=place, url=url, name=place, content_string=text)

    start, code = file("index.md", "# Start\n\nIt compiles.\n"), "diagnostics/osc100.md"
    files = [start, file(code, "# OSC100: syntax\n\nA text is wrong.\n")]
    page = SimpleNamespace(is_section=False, is_page=True, title="Start", file=start)
    LLMS["on_nav"](
        SimpleNamespace(items=[page]),
        SimpleNamespace(site_name="osc2tx", site_description="Compiles."),
        SimpleNamespace(documentation_pages=lambda: files),
    )
    text = LLMS["on_nav"].__globals__["_text"]
    assert "## Start\n\n- [Start](index.html): It compiles\n" in text
    assert "- [OSC100: syntax](diagnostics/osc100.html): A text is wrong\n" in text


@pytest.mark.slow
def test_a_picture_shows_what_the_run_does() -> None:
    """One lane to the right within 3 s, from the second lane of the highway, 3.5 m away."""
    (entry,) = find("modifier keep_speed")
    chart = PICTURES["_across_lanes"](PICTURES["_run"]("scenarios/cut_in_and_evade.osc"), entry)
    times = [t for t, _ in chart.curves["hero"]]
    ways = [way for _, way in chart.curves["hero"]]
    assert times[0] == 0 and ways[0] == 0
    assert abs(abs(ways[-1]) - 3.5) < 0.01
    assert max(abs(b - a) for a, b in pairwise(ways)) < 0.15  # no jump between lanes


@pytest.mark.slow
def test_pictures_are_made_where_something_changes() -> None:
    (gap,) = find("action vehicle.change_time_gap")
    svg = PICTURES["picture"](gap)
    root = fromstring(svg)
    names = [node.text for node in root.iter("{*}text")]
    assert {"leader", "follower", "time (s)", "speed (km/h)"} <= set(names)
    assert len(list(root.iter("{*}polyline"))) == 2
    assert PICTURES["picture"](find("action environment.rain")[0]) is None
    assert svg == PICTURES["picture"](gap)


@pytest.mark.parametrize("is_there", [True, False])
def test_the_playground_is_in_the_navigation_where_pyodide_is(
    tmp_path: Path, is_there: bool
) -> None:
    hook = run_path(str(TOOLS / "site_playground.py"))
    config = SimpleNamespace(nav=[{"Start": "index.md"}, {"Tutorial": "tutorial.md"}])
    place = tmp_path if is_there else tmp_path / "nothing"
    hook["on_config"].__globals__["PYODIDE"] = place
    hook["on_config"](config)
    titles = [title for entry in config.nav for title in entry]
    assert titles == ["Start", *["Playground"] * is_there, "Tutorial"]
