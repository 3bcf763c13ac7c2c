"""The report in a real browser: it starts, and its controls work, without an error."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx_runtime.report import render_report
from tests.runtime.report.browser import COMPLETE, IN_A_BROWSER, attributes_of
from tests.runtime.report.test_surroundings import lit_highway, maker

pytestmark = IN_A_BROWSER

# Uses every control once; what it finds is left in attributes of the document.
DRIVER = """
<script>
const found = document.documentElement.dataset;
const view = byId("view"), frame = view.getBoundingClientRect();
const pointer = (target, kind, x, y) => target.dispatchEvent(new PointerEvent(kind,
  {pointerId: 1, button: 0, clientX: x, clientY: y, bubbles: true}));
const enter = (id, value, kind) => {
  byId(id).value = value;
  byId(id).dispatchEvent(new Event(kind));
};
const key = (name, shiftKey) => document.body.dispatchEvent(
  new KeyboardEvent("keydown", {key: name, shiftKey, bubbles: true}));

found.start = clock.now;
key("ArrowRight"); found.step = clock.now.toFixed(2);
key("ArrowLeft", true); found.back = clock.now.toFixed(2);
key("End"); found.end = clock.now;
enter("slider", 5, "input"); found.slider = clock.now;

const scale = camera.scale;
view.dispatchEvent(new WheelEvent("wheel",
  {deltaY: -200, clientX: frame.left + 50, clientY: frame.top + 50, cancelable: true}));
found.zoomed = camera.scale > scale;
byId("fit-all").click(); found.fitted = camera.scale < scale && byId("follow").value === "none";
enter("follow", "0", "change"); found.followed = camera.target.id;
byId("turn").click(); found.turned = camera.turn;

[...byId("motion-kind").children][1].click(); found.title = byId("motion-title").textContent;
byId("motion-legend").firstChild.click();
found.curves = charts[0].plot.series.filter((series, i) => i > 0 && series.show).length;
clock.set(20); byId("zoom-in").click(); found.span = [span.from, span.to].join("-");
byId("zoom-all").click(); found.whole = span.to;
enter("actor-filter", "npc", "input");
found.shown = [...shown.actors].map((actor) => actor.id).join();
found.filtered = charts[0].series.map((series) => series.name).join();
enter("actor-filter", "", "input");
const bars = [...byId("timeline").querySelectorAll(".bar")];
pointer(bars.find((bar) => bar.textContent.includes("keep_space_gap")), "pointerdown", 0, 0);
found.bar = clock.now;
enter("filter", "crash", "input");
found.rows = [...byId("log").tBodies[0].rows].filter((row) => !row.hidden).length;
byId("log").tBodies[0].rows[3].click(); found.row = clock.now;
found.state = [9, 12, 30].map((time) => nodeState(RUNS[0].nodes[1], time)).join();
clock.set(12); byId("running-only").click();
found.tree = [...byId("tree").children].filter((row) => !row.hidden).length;
window.dispatchEvent(new Event("beforeprint")); window.dispatchEvent(new Event("afterprint"));
span.set(5, 10);
queueMicrotask(() => {
  const { min, max } = charts[1].plot.scales.x;
  found.axis = `${min}-${max}`;
});
byId("play").click(); found.playing = byId("play").textContent;
found.driven = "true";
</script>
"""


@pytest.fixture
def open_report(tmp_path: Path) -> Callable[..., dict[str, str]]:
    def run(lines, road_map=None, fragment: str = "", driver: str = "") -> dict[str, str]:
        path = tmp_path / "report.html"
        path.write_text(render_report(lines, road_map), encoding="utf-8", newline="\n")
        if driver:
            page = path.read_text(encoding="utf-8")
            # The policy allows only the report's own script: lifted for the test's script.
            page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
            page = page.replace("</body>", COMPLETE + driver + "</body>")
            path.write_text(page, encoding="utf-8")
        return attributes_of(path, tmp_path / "profile", fragment)

    return run


def test_report_starts_without_error(open_report, overtaking, highway_map) -> None:
    assert open_report(overtaking, highway_map, "#t=12.5&fit") == {"ready": "true"}


def test_hostile_names_do_nothing(open_report, hostile, highway_map) -> None:
    assert open_report(hostile, highway_map, "#t=3.5") == {"ready": "true"}


def test_parameters_have_the_units_of_the_scenario(open_report) -> None:
    """Also where the nine digits of a trace are a little off: 16.6666667 m/s are 60 kph."""
    values = '{"v": 16.6666667, "warm": 293.15, "count": 2, "odd": 3}'
    kph, celsius = '{"name": "kph", "factor": 0.277777778, "offset": 0}', '"C", "factor": 1'
    units = f'{{"v": {kph}, "warm": {{"name": {celsius}, "offset": 273.15}}, "odd": 1}}'
    header = f'{{"kind": "header", "parameters": {values}, "units": {units}}}'
    shown = "document.documentElement.dataset.shown = parametersText(RUNS[0].header)"
    found = open_report([header], driver=f"<script>{shown}</script>")
    assert found == {"ready": "true", "shown": "v = 60 kph, warm = 20 C, count = 2, odd = 3"}


@pytest.mark.parametrize(
    "lines",
    [
        [],
        ['{"t": 1, "kind": "event", "name": "e"}'],
        ['{"t": 0, "kind": "state", "actor": "a", "x": 1, "y": 2}'],
        ['{"kind": "header", "actors": {"a": {"kind": "vehicle"}}}', '{"kind": "result"}'],
    ],
)
def test_odd_traces_start(open_report, lines: list[str]) -> None:
    assert open_report(lines) == {"ready": "true"}


def test_controls(open_report, overtaking, highway_map) -> None:
    found = open_report(overtaking, highway_map, "#t=12.5", DRIVER)
    assert "error" not in found
    assert found == {
        "ready": "true",
        "driven": "true",
        "start": "12.5",
        "step": "12.55",
        "back": "11.55",
        "end": "27.5",
        "slider": "5",
        "zoomed": "true",
        "fitted": "true",
        "followed": "hero",
        "turned": "true",
        "title": "Acceleration",
        "curves": "1",
        "span": "10-23.75",
        "axis": "5-10",
        "whole": "27.5",
        "shown": "npc",
        "filtered": "npc",
        "state": ",running,success",
        "tree": "2",
        "bar": "26",
        "rows": "1",
        "row": "0.05",
        "playing": "Pause",
    }


# What is drawn at two times: lamps, headlights (by asking the canvas for the colour), weather.
LOOK = """
<script>
const out = document.documentElement.dataset;
const lamps = (time) => lampsOf(changeAt(SIGNALS[0].changes, time)).join("-");
out.before = lamps(1.9); out.after = lamps(2.0);
clock.set(0.5); out.early = byId("weather").textContent;
clock.set(3.0); out.late = byId("weather").textContent;
out.gap = byId("gap").closest(".card").hidden;
const beamsAt = (time) => {
  let cones = 0;
  drawBeams({beginPath() {}, moveTo() {}, lineTo() {}, fill() { cones += 1; }}, TRACKED[0], time);
  return cones;
};
out.dark = beamsAt(0.5); out.lit = beamsAt(1.5);
</script>
"""


def test_surroundings_are_those_of_the_time(open_report) -> None:
    found = open_report(maker().text(80), lit_highway(), "", LOOK)
    assert found == {
        "ready": "true",
        "before": "red--",
        "after": "--green",
        "early": "\u22123.0 °C · sun 29° high",
        "late": "rain 7.2 mm/h · \u22123.0 °C · sun 6° below the horizon",
        "gap": "true",
        "dark": "0",
        "lit": "2",
    }
