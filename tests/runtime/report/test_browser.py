"""The report in a real browser: it starts, and its controls work, without an error."""

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx_runtime.report import write_report
from tests.processes import HANGING
from tests.runtime.report.test_surroundings import lit_highway, maker

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-sync",
    "--disable-background-networking",
    "--disable-component-update",
    "--window-size=1400,1600",
    "--virtual-time-budget=3000",
    "--dump-dom",
]

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed"),
]

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
found.curves = byId("motion").querySelectorAll(".curve").length;
const bars = [...byId("timeline").querySelectorAll(".bar")];
pointer(bars.find((bar) => bar.textContent.includes("keep_space_gap")), "pointerdown", 0, 0);
found.bar = clock.now;
enter("filter", "crash", "input");
found.rows = [...byId("log").tBodies[0].rows].filter((row) => !row.hidden).length;
byId("log").tBodies[0].rows[3].click(); found.row = clock.now;
window.dispatchEvent(new Event("beforeprint")); window.dispatchEvent(new Event("afterprint"));
byId("play").click(); found.playing = byId("play").textContent;
found.driven = "true";
</script>
"""


def attributes_of(path: Path, profile: Path, fragment: str = "") -> dict[str, str]:
    """Attributes of the document's root once the page has settled."""
    command = [str(CHROMIUM), *FLAGS, f"--user-data-dir={profile}", path.as_uri() + fragment]
    done = subprocess.run(command, capture_output=True, text=True, timeout=HANGING, check=True)
    root = re.search(r"<html([^>]*)>", done.stdout)
    assert root is not None, done.stderr
    return dict(re.findall(r'data-([a-z-]+)="([^"]*)"', root[1]))


@pytest.fixture
def open_report(tmp_path: Path) -> Callable[..., dict[str, str]]:
    def run(lines, road_map=None, fragment: str = "", driver: str = "") -> dict[str, str]:
        path = tmp_path / "report.html"
        write_report(path, lines, road_map)
        if driver:
            page = path.read_text(encoding="utf-8")
            # The policy allows only the report's own script: lifted for the test's script.
            page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
            path.write_text(page.replace("</body>", driver + "</body>"), encoding="utf-8")
        return attributes_of(path, tmp_path / "profile", fragment)

    return run


def test_report_starts_without_error(open_report, overtaking, highway_map) -> None:
    assert open_report(overtaking, highway_map, "#t=12.5&fit") == {"ready": "true"}


def test_hostile_names_do_nothing(open_report, hostile, highway_map) -> None:
    assert open_report(hostile, highway_map, "#t=3.5") == {"ready": "true"}


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
        "bar": "26",
        "rows": "1",
        "row": "0.05",
        "playing": "Pause",
    }


# What is drawn at two times: lamps, headlights (by asking the canvas for the colour), weather.
LOOK = """
<script>
const out = document.documentElement.dataset;
const lamps = (time) => lampsOf(changeAt(DATA.surroundings.signals[0].changes, time)).join("-");
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
