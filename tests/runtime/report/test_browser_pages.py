"""Pages of many actors and of several runs in a real browser, their words and what they export."""

from pathlib import Path

from osc2tx_runtime.report.index_page import index_row, render_index
from osc2tx_runtime.report.page import Trace, render_runs
from tests.runtime.report.browser import IN_A_BROWSER, looked_at, shown_page
from tests.runtime.report.conftest import TraceMaker, wandering

pytestmark = IN_A_BROWSER

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
    # Pictures are made beside the clock of the page, which runs ahead on a busy machine.
    patient = ["--virtual-time-budget=3000000"]
    found = looked_at(tmp_path, [Trace(made.text(40))], EXPORTS, patient)
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
    runs = [index_row("a.html", Trace(overtaking, "a")), index_row("b.html", Trace(hostile, "b"))]
    assert shown_page(tmp_path, render_index(runs), driver) == {
        "ready": "true",
        "left": "1",
        "first": "b",
    }
