"""The report in a real browser: it starts, and its controls work, without an error."""

import re
import shutil
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from osc2tx_runtime.report import write_report
from osc2tx_runtime.report.index_page import RunRow, render_index
from osc2tx_runtime.report.page import Trace, render_runs
from tests.processes import HANGING
from tests.runtime.report.conftest import TraceMaker, wandering
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

# What is drawn after the first frame is drawn at once, for a script that looks at all of it.
COMPLETE = "<script>drawWaiting()</script>"

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


def attributes_of(
    path: Path, profile: Path, fragment: str = "", flags: Sequence[str] = ()
) -> dict[str, str]:
    """Attributes of the document's root once the page has settled."""
    command = [
        str(CHROMIUM),
        *FLAGS,
        *flags,
        f"--user-data-dir={profile}",
        path.as_uri() + fragment,
    ]
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


# Widths of what sticks out, and how far apart the colours of the actors are (in OKLab).
FACTS = """
<script>
const found = document.documentElement.dataset;
const lab = (color) => {
  const [l, c, h] = color.match(/[\\d.]+/g).map(Number), angle = (h * Math.PI) / 180;
  return [l, c * Math.cos(angle), c * Math.sin(angle)];
};
const labs = theme.colors.map(lab);
const distance = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));
const apart = labs.flatMap((a, i) => labs.slice(0, i).map((b) => distance(a, b)));
found.apart = apart.every((each) => each > 0.025);
found.colors = new Set(theme.colors).size;
found.wide = document.documentElement.scrollWidth > innerWidth;
</script>
"""


def test_fifty_actors_on_a_phone(tmp_path: Path) -> None:
    made = TraceMaker("many")
    for number in range(50):
        made.car(f"car{number}", wandering(number))
    found = looked_at(tmp_path, [Trace(made.text(100))], FACTS, ["--window-size=390,800"])
    assert found == {"ready": "true", "apart": "true", "colors": "50", "wide": "false"}


# Counts the points of all lines; before the first frame, and when the page is complete.
COUNTING = """<body><script>
let points = 0;
const { lineTo } = Path2D.prototype;
Path2D.prototype.lineTo = function (x, y) { points += 1; lineTo.call(this, x, y); };
</script>"""
COUNTED = """<script>
const out = document.documentElement.dataset;
const drawn = () => [charts.filter((chart) => chart.plot).length,
  document.querySelectorAll("#timeline .bar, #tree li, #log tbody tr").length].join();
out.first = points; out.parts = drawn();
window.dispatchEvent(new Event("beforeprint")); window.dispatchEvent(new Event("afterprint"));
queueMicrotask(() => { out.printed = `${drawn()},${points > 2 * out.first}`; });
</script>"""


def test_a_page_answers_before_it_is_complete(tmp_path: Path) -> None:
    """First the paths alone: charts, timeline, tree and log come after the first frame."""
    made = TraceMaker("many")
    for number in range(50):
        made.car(f"car{number}", wandering(number))
        made.action(f"car{number}", "drive", 0.0, 5.0)
    made.node(0, "parallel", "many", (0.0, 5.0, "success"))
    page = render_runs([Trace(made.text(100))]).replace("<body>", COUNTING)
    found = shown_page(tmp_path, page, COUNTED)
    assert int(found.pop("first")) <= 50 * (101 + 2)  # each sample once, the part driven once
    whole = f"2,{50 + 1 + 2 * 50},true"  # bars and nodes, starts and ends
    assert found == {"ready": "true", "parts": "0,0", "printed": whole}


# Two cars in one lane, 50 m between their bumpers, closing at 10 m/s; one far beside them.
MEASURED = """
<script>
const out = document.documentElement.dataset;
const [rear, front, beside] = MOVABLE.map((actor) => boxAt(actor, 1));
out.gap = bumperGap(rear, front).toFixed(3);
out.box = boxDistance(rear, front).toFixed(3);
out.ttc = timeToCollision(rear, front).toFixed(3);
out.apart = timeToCollision(front, rear) === timeToCollision(rear, front);
out.never = String(timeToCollision(rear, beside));
out.corner = boxDistance(rear, beside).toFixed(3);
out.abreast = bumperGap(rear, beside).toFixed(3);
</script>
"""


def test_distances_by_hand(tmp_path: Path) -> None:
    """At 1 s: middles 54 m apart, boxes 4 m long and 2 m wide, 20 and 10 m/s."""
    made = TraceMaker("gaps")
    made.car("rear", lambda t: (20 * t, 0.0, 0.0, 20.0, 0.0), 4.0, 2.0)
    made.car("front", lambda t: (64 + 10 * t, 0.0, 0.0, 10.0, 0.0), 4.0, 2.0)
    made.car("beside", lambda t: (7 + 20 * t, 6.0, 0.0, 20.0, 0.0), 4.0, 2.0)
    assert looked_at(tmp_path, [Trace(made.text(40))], MEASURED) == {
        "ready": "true",
        "gap": "50.000",
        "box": "50.000",
        "ttc": "5.000",
        "apart": "true",
        "never": "null",
        "corner": "5.000",  # 3 m ahead and 4 m beside
        "abreast": "3.000",
    }


def test_bars_have_the_labels_of_the_scenario(tmp_path: Path) -> None:
    """A label stands before what the action does; the text of an action without one is no label."""
    made = TraceMaker("labels")
    made.car("hero", wandering(1))
    made.action("hero", "change_lane", 0.5, 1.0, line=1)
    made.action("hero", "drive", 1.0, 2.0, line=2)
    words = "evade: hero change_lane"
    made.node(0, "action", words, (0.5, 1.0, "success"), label="evade")
    made.node(0, "action", "hero: drive", (1.0, 2.0, "success"), source="labels.osc:2")
    driver = """<script>
    const bars = [...byId("timeline").querySelectorAll(".bar text")].map((bar) => bar.textContent);
    document.documentElement.dataset.bars = bars.slice(0, 2).join();
    </script>"""
    found = looked_at(tmp_path, [Trace(made.text(60))], driver)
    assert found == {"ready": "true", "bars": "evade: change_lane,drive"}


EXPORTS = """<script>
const files = [];
saveBlob = (name, blob) => files.push([name, blob]);
["states-csv", "motion-csv", "log-csv", "motion-png", "view-png"].forEach((id) => byId(id).click());
const look = async () => {
  if (files.length < 5) return setTimeout(look, 50);  // pictures take a while
  const out = document.documentElement.dataset;
  const text = async (what) => files.find(([name]) => name === what)[1].text();
  out.names = files.map(([name]) => name).sort().join();
  out.motion = (await text("exports-run-report-speed.csv")).split("\\r\\n").slice(0, 3).join("|");
  out.states = (await text("exports-run-report-states.csv")).split("\\r\\n").length;
  const pictures = files.filter(([name]) => name.endsWith(".png"));
  out.pictures = pictures.map(([, blob]) => `${blob.type}:${blob.size > 1000}`).join();
  byId("loop").click();
  clock.set(clock.end - 0.01);
  player.running = true; player.last = 0;
  advance(50);  // 0.05 s later: beyond the end
  out.loop = `${clock.now},${player.running}`;
  byId("loop").click();
  clock.set(clock.end - 0.01);
  player.last = 0;
  advance(50);
  out.stop = `${clock.now === clock.end},${player.running}`;
};
look();
</script>"""


def test_exports_and_the_loop(tmp_path: Path) -> None:
    """Numbers and pictures are files; playing begins again at the end only if it is asked to."""
    made = TraceMaker("exports")
    made.car("rear", lambda t: (20 * t, 0.0, 0.0, 20.0, 0.0), 4.0, 2.0)
    made.car("front", lambda t: (64 + 10 * t, 0.0, 0.0, 10.0, 0.0), 4.0, 2.0)
    found = looked_at(tmp_path, [Trace(made.text(40))], EXPORTS)
    names = ["log.csv", "speed.csv", "speed.png", "states.csv", "view.png"]
    assert found == {
        "ready": "true",
        "names": ",".join(f"exports-run-report-{name}" for name in names),
        "motion": "time (s),rear (km/h),front (km/h)|0,72,36|0.05,72,36",
        "states": str(1 + 2 * 41 + 1),  # a head, two cars at 41 times, the end of the last line
        "pictures": "image/png:true,image/png:true",
        "loop": "0,true",
        "stop": "true,false",
    }


def test_two_runs_over_each_other(tmp_path: Path, overtaking) -> None:
    driver = """<script>
    const out = document.documentElement.dataset;
    out.names = MOVABLE.map((actor) => actor.name).join();
    out.colors = MOVABLE[0].hue === MOVABLE[2].hue;
    out.dashed = charts[0].series.map((series) => series.dash).join();
    </script>"""
    found = looked_at(tmp_path, [Trace(overtaking, "one"), Trace(overtaking, "two")], driver)
    assert found == {
        "ready": "true",
        "names": "A: hero,A: npc,B: hero,B: npc",
        "colors": "true",
        "dashed": "false,false,true,true",
    }


def test_index_of_runs(tmp_path: Path, overtaking, hostile) -> None:
    driver = """<script>
    const out = document.documentElement.dataset;
    byId("filter").value = "overtake leader"; byId("filter").dispatchEvent(new Event("input"));
    out.left = rows.filter(({ row }) => !row.hidden).length;
    sortBy("duration"); out.first = body.rows[0].querySelector("a").textContent;
    </script>"""
    runs = [RunRow("a.html", Trace(overtaking, "a")), RunRow("b.html", Trace(hostile, "b"))]
    assert shown_page(tmp_path, render_index(runs), driver) == {
        "ready": "true",
        "left": "1",
        "first": "b",
    }


def looked_at(
    folder: Path, traces: Sequence[Trace], driver: str, flags: Sequence[str] = ()
) -> dict[str, str]:
    return shown_page(folder, render_runs(traces), COMPLETE + driver, flags)


def shown_page(folder: Path, page: str, driver: str, flags: Sequence[str] = ()) -> dict[str, str]:
    """Attributes of a page with a script of the test at its end, which its policy forbids."""
    page = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*>', "", page)
    path = folder / "page.html"
    path.write_text(page.replace("</body>", driver + "</body>"), encoding="utf-8")
    return attributes_of(path, folder / "profile", flags=flags)
