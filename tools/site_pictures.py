"""Pictures of what actions and modifiers do, from runs of the examples of the reference.

Along the road: the speed over time. Across lanes: the way to the left over time. Paths: from above.
The picture of an action over time has a bar below it for each time that it runs. Nothing is drawn
where nothing changes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import hypot
from pathlib import Path

from lxml import etree

from osc2tx.catalogue import catalogue
from osc2tx.reference import Entry
from osc2tx.testing import Run, run_scenario
from osc2tx_runtime.opendrive import read_map
from osc2tx_shared.map_files import SHIPPED

REPOSITORY = Path(__file__).parent.parent
WIDTH, HEIGHT = 720, 260
LEFT, RIGHT, TOP, BOTTOM = 64, 16, 34, 64
COLORS = ("#1f4fa8", "#b03060", "#2e7d32", "#8a5a00", "#6a3d9a")
ASPHALT, BESIDE, MARKING = "#e4e8ec", "#f4f6f8", "#ffffff"  # lanes to drive on, others, edges
STANDS, BEGINS = 6, 4  # radius of the dot where something stands, or a path begins
AROUND = 2.0  # m that are shown beside paths
MANY = len(COLORS)  # actors in a picture, the first that move
MOVED = 0.5  # m, from which on an actor counts as moving
CHANGED = 0.3  # m or km/h, from which on something is to be seen
KPH = 3.6
TICKS = (1, 2, 2.5, 5, 10)
GOAL_OF_TICKS = 6

Points = list[tuple[float, float]]


@dataclass(frozen=True)
class Chart:
    """Curves over two axes.

    Attributes:
        across: Quantity on the horizontal axis.
        up: Quantity on the vertical axis.
        curves: Points by actor.
        spans: Times of the action, on the horizontal axis.
        shown: Values that the vertical axis has in any case.
        ground: Map on which the curves lie, if they are paths.
    """

    across: str
    up: str
    curves: Mapping[str, Points]
    spans: Sequence[tuple[float, float]] = ()
    shown: Sequence[float] = ()
    ground: Path | None = None


def picture(entry: Entry) -> str | None:
    """Return the picture as SVG; None if it would not say more than words."""
    controls = _controls(entry)
    if not entry.shown.file or not controls:
        return None
    run = _run(entry.shown.file)
    if "lanes" in controls and "lateral" in controls:
        chart = _across_lanes(run, entry)
    else:
        chart = _from_above(run) if "lateral" in controls else _speeds(run, entry)
    heights = [[y for _, y in curve] for curve in chart.curves.values()]
    is_seen = any(max(curve) - min(curve) > CHANGED for curve in heights)
    return _svg(chart) if is_seen else None


def chart_of_run(file: Path, kind: str) -> str:
    """Return the picture of a run as SVG.

    Args:
        file: The scenario.
        kind: `above`, `lanes` or `speeds`.
    """
    run = _run(str(file))
    if kind == "above":
        return _svg(_from_above(run, _actors(run)))
    return _svg(_across_lanes(run) if kind == "lanes" else _speeds(run))


def _controls(entry: Entry) -> tuple[str, ...]:
    """The slots that it controls of an actor, and `lanes` if it needs them."""
    known, name = catalogue(), entry.declaration.name
    if entry.declaration.kind == "action":
        action = known.actions.get(name)
        if action is None:
            return ()
        slots = action.slots or (("longitudinal",) if action.moves else ())
        return (*slots, *action.needs) if slots else ()
    modifier = known.modifiers.get(entry.own_name)
    if modifier is None or entry.declaration.kind != "modifier" or not modifier.slots:
        return ()
    return (*modifier.slots, *modifier.needs)


@cache
def _run(file: str) -> Run:
    return run_scenario(REPOSITORY / file)


def _actors(run: Run) -> list[str]:
    return list(dict.fromkeys(str(line["actor"]) for line in run.of_kind("state")))[:MANY]


def _moving(run: Run) -> list[str]:
    actors = dict.fromkeys(str(line["actor"]) for line in run.of_kind("state"))
    return [actor for actor in actors if _way(_places(run, actor)) > MOVED][:MANY]


def _places(run: Run, actor: str) -> Points:
    return [(line["x"], line["y"]) for line in run.states(actor)]


def _way(points: Points) -> float:
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points))


def _from_above(run: Run, actors: Sequence[str] = ()) -> Chart:
    curves = {actor: _places(run, actor) for actor in actors or _moving(run)}
    heights = [y for curve in curves.values() for _, y in curve]
    shown = (min(heights) - AROUND, max(heights) + AROUND) if heights else ()
    (header,) = run.of_kind("header")
    ground = SHIPPED / f"{header['map']}.xodr"
    return Chart("x (m)", "y (m), on its own scale", curves, shown=shown, ground=ground)


def _across_lanes(run: Run, entry: Entry | None = None) -> Chart:
    curves = {actor: _to_the_left(run, actor) for actor in _moving(run)}
    spans = _spans(run, entry.own_name) if entry is not None else ()
    return Chart("time (s)", "to the left (m)", curves, spans)


def _to_the_left(run: Run, actor: str) -> Points:
    """How far it is from the line that it started on, lanes after each other."""
    way = moved = 0.0
    points = []
    states = run.states(actor)
    for before, line in pairwise([states[0], *states]):
        if before.get("lane") == line.get("lane"):  # in another one the offset counts anew
            moved = (line.get("offset") or 0.0) - (before.get("offset") or 0.0)
        way += moved
        points.append((line["t"], way))
    return points


def _speeds(run: Run, entry: Entry | None = None) -> Chart:
    curves = {
        actor: [(line["t"], line["v"] * KPH) for line in run.states(actor)]
        for actor in _moving(run)
    }
    spans = _spans(run, entry.own_name) if entry is not None else ()
    return Chart("time (s)", "speed (km/h)", curves, spans, shown=(0.0,))


def _spans(run: Run, name: str) -> list[tuple[float, float]]:
    """When the action runs: from its start to whatever ends it, the end of the run at last."""
    begun: dict[tuple[str, str], list[float]] = {}
    spans = []
    for line in run.of_kind("action"):
        key = (line["name"], line["source"])
        if str(line["name"]).rpartition(" ")[2] != name:
            continue
        if line["status"] == "start":
            begun.setdefault(key, []).append(line["t"])
        elif begun.get(key):
            spans.append((begun[key].pop(0), line["t"]))
    spans += [(start, run.time) for starts in begun.values() for start in starts]
    return sorted(spans)


# --- drawing -------------------------------------------------------------------------------------


class _Axis:
    """From values to places in the picture."""

    def __init__(self, values: Sequence[float], start: float, end: float) -> None:
        low, high = min(values, default=0.0), max(values, default=1.0)
        if high - low < 1.0:
            low, high = (low + high) / 2 - 0.5, (low + high) / 2 + 0.5
        self.step = _step((high - low) / GOAL_OF_TICKS)
        self.low = low // self.step * self.step
        self.high = -(-high // self.step) * self.step
        self._start, self._end = start, end

    def __call__(self, value: float) -> float:
        share = (value - self.low) / (self.high - self.low)
        return self._start + share * (self._end - self._start)

    def ticks(self) -> list[float]:
        """The values that have a line."""
        count = round((self.high - self.low) / self.step)
        return [self.low + i * self.step for i in range(count + 1)]


def _step(least: float) -> float:
    power = 1.0
    while power * 10 <= least:
        power *= 10
    while power > least:
        power /= 10
    return next(power * each for each in TICKS if power * each >= least)


def _svg(chart: Chart) -> str:
    points = [point for curve in chart.curves.values() for point in curve]
    across = _Axis([x for x, _ in points], LEFT, WIDTH - RIGHT)
    up = _Axis([y for _, y in points] + [*chart.shown], HEIGHT - BOTTOM, TOP)
    root = etree.Element("svg", xmlns="http://www.w3.org/2000/svg", viewBox=f"0 0 {WIDTH} {HEIGHT}")
    root.set("font-family", "sans-serif")
    root.set("font-size", "12")
    _add(root, "rect", width=WIDTH, height=HEIGHT, fill="#ffffff")
    if chart.ground is not None:
        _lanes(root, chart.ground, across, up)
    _grid(root, chart, across, up)
    for number, (actor, curve) in enumerate(chart.curves.items()):
        shown = " ".join(f"{across(x):.1f},{up(y):.1f}" for x, y in _fewer(curve))
        color = COLORS[number]
        _add(root, "polyline", points=shown, fill="none", stroke=color, stroke_width=2)
        if chart.ground is not None:  # where it begins, or stands
            x, y = curve[0]
            size = STANDS if _way(curve) < MOVED else BEGINS
            _add(root, "circle", cx=f"{across(x):.1f}", cy=f"{up(y):.1f}", r=size, fill=color)
        _add(root, "text", actor, x=LEFT + 110 * number, y=18, fill=color, font_weight="bold")
    for start, end in chart.spans:
        wide = max(across(end) - across(start), 3)
        place = {"x": f"{across(start):.1f}", "y": HEIGHT - 14, "width": f"{wide:.1f}"}
        _add(root, "rect", **place, height=6, fill="#d08700")
    return etree.tostring(root, encoding="unicode") + "\n"


def _lanes(root: etree._Element, ground: Path, across: _Axis, up: _Axis) -> None:
    """Draw the lanes of a map within the picture."""
    clip = etree.SubElement(etree.SubElement(root, "defs"), "clipPath", id="plot")
    size = {"width": WIDTH - RIGHT - LEFT, "height": HEIGHT - BOTTOM - TOP}
    _add(clip, "rect", x=LEFT, y=TOP, **size)
    lanes = etree.SubElement(root, "g")
    lanes.set("clip-path", "url(#plot)")
    bounds = (across.low, up.low, across.high, up.high)
    for lane in read_map(ground).lane_outlines(bounds):
        edge = [*lane.left, *reversed(lane.right)]
        points = " ".join(f"{across(x):.1f},{up(y):.1f}" for x, y in edge)
        fill = ASPHALT if lane.type == "driving" else BESIDE
        _add(lanes, "polygon", points=points, fill=fill, stroke=MARKING, stroke_width=2)


def _grid(root: etree._Element, chart: Chart, across: _Axis, up: _Axis) -> None:
    for value in up.ticks():
        y = f"{up(value):.1f}"
        _add(root, "line", x1=LEFT, x2=WIDTH - RIGHT, y1=y, y2=y, stroke="#e3e6ea")
        _add(root, "text", f"{value:g}", x=LEFT - 6, y=y, dy=4, text_anchor="end", fill="#5c6670")
    for value in across.ticks():
        x = f"{across(value):.1f}"
        _add(root, "line", x1=x, x2=x, y1=TOP, y2=HEIGHT - BOTTOM, stroke="#e3e6ea")
        y = HEIGHT - BOTTOM + 16
        _add(root, "text", f"{value:g}", x=x, y=y, text_anchor="middle", fill="#5c6670")
    middle = (LEFT + WIDTH - RIGHT) / 2
    names = {"text_anchor": "middle", "fill": "#1f2933"}
    _add(root, "text", chart.across, x=middle, y=HEIGHT - 28, **names)
    center = (TOP + HEIGHT - BOTTOM) / 2
    _add(root, "text", chart.up, x=14, y=center, transform=f"rotate(-90 14 {center})", **names)


def _fewer(curve: Points) -> Points:
    """Every n-th point, and the last one."""
    every = max(len(curve) // 300, 1)
    return [*curve[:-1:every], curve[-1]]


def _add(root: etree._Element, kind: str, text: str = "", **attributes: object) -> None:
    item = etree.SubElement(root, kind)
    for key, value in attributes.items():
        item.set(key.replace("_", "-"), str(value))
    if text:
        item.text = text
