// Line charts over time, drawn by uPlot: what the actors do, and what is between them.

const MAX_PAIRS = 8; // more curves than this are not readable: the nearest ones

/** Times at which all curves have values: those of the longest track of each run. */
const TIMES = [...new Set(RUNS.flatMap((run) => MOVABLE.filter((actor) => actor.run === run)
  .reduce((longest, { track }) => (track.t.length > longest.length ? track.t : longest), [])))].sort((a, b) => a - b);

const within = (actor, time) =>
  time >= actor.track.t[0] - 1e-6 && time <= actor.track.t[actor.track.t.length - 1] + 1e-6;

/** A column of an actor at `TIMES`; null outside of its samples. */
const sampled = (actor, column, factor) => TIMES.map((time) => {
  const value = within(actor, time) ? columnAt(actor.track, column, time) : null;
  return value === null ? null : value * factor;
});

// ---- one chart ---------------------------------------------------------------------------------

/**
 * A chart below the element `id` with its legend. `show({title, unit, digits, series})` draws; a
 * series is {name, color, dash, y}, with null in y where there is no value.
 */
function makeChart(id) {
  const chart = { id, host: byId(id), legend: byId(id + "-legend"), series: [], hidden: new Set(), plot: null };
  chart.show = (content) => {
    Object.assign(chart, content);
    buildLegend(chart);
    plotChart(chart);
  };
  clock.listeners.push(() => moveCursor(chart));
  span.listeners.push(() => chart.plot && chart.plot.setScale("x", { min: span.from, max: span.to }));
  new ResizeObserver(() => requestAnimationFrame(() => fitChart(chart))).observe(chart.host);
  byId(id + "-csv").addEventListener("click", () => saveChartCsv(chart));
  byId(id + "-png").addEventListener("click", () => savePng(chart.title, chartPicture(chart)));
  return chart;
}

const chartSize = ({ host }) => ({ width: Math.max(host.clientWidth, 120), height: 250 });

function fitChart(chart) {
  const { plot } = chart, { width, height } = chartSize(chart);
  if (plot && plot.width !== width) plot.setSize({ width, height });
}

function buildLegend(chart) {
  chart.values = chart.series.map(() => element("span", { className: "value" }));
  chart.legend.replaceChildren(...chart.series.map((series, i) => {
    const swatch = element("span", { className: series.dash ? "swatch dashed" : "swatch" });
    swatch.style.background = `var(--actor-${series.hue})`;
    const name = element("span", { className: "name", textContent: series.name, title: series.name });
    const button = element("button", { type: "button", title: "Show or hide" }, swatch, name, chart.values[i]);
    button.setAttribute("aria-pressed", !chart.hidden.has(series.name));
    button.addEventListener("click", () => {
      if (!chart.hidden.delete(series.name)) chart.hidden.add(series.name);
      button.setAttribute("aria-pressed", !chart.hidden.has(series.name));
      chart.plot.setSeries(i + 1, { show: !chart.hidden.has(series.name) });
    });
    return button;
  }));
}

const axis = (more) => ({
  stroke: () => theme.soft, font: "12px " + FONT, grid: { stroke: () => theme.grid, width: 1 },
  ticks: { stroke: () => theme.grid, width: 1, size: 4 }, ...more,
});

/** Zero belongs to the range, and a flat curve gets one of its own. */
function valueRange(plot, low, high) {
  if (low === null || low === undefined) return [0, 1];
  const [least, most] = [Math.min(low, 0), Math.max(high, 0)];
  return most - least < 1e-6 ? [least, least + 1] : [least < 0 ? least * 1.05 : 0, most > 0 ? most * 1.05 : 0];
}

function plotChart(chart) {
  if (chart.plot) chart.plot.destroy();
  const options = {
    ...chartSize(chart),
    legend: { show: false },
    cursor: { drag: { x: true, y: false, setScale: false }, y: false, points: { show: false } },
    scales: { x: { time: false, min: span.from, max: span.to }, y: { range: valueRange } },
    axes: [
      axis({ size: 30, values: (_, ticks) => ticks.map((tick) => String(tick) + (tick === ticks[0] ? " s" : "")) }),
      axis({ size: 52, values: (_, ticks) => ticks.map((tick) => String(tick).replace("-", "−")) }),
    ],
    series: [{}, ...chart.series.map((series) => ({
      show: !chart.hidden.has(series.name), stroke: () => theme.colors[series.hue], width: 1.8,
      dash: series.dash ? [6, 4] : undefined, points: { show: false },
    }))],
    hooks: { setSelect: [zoomToSelection], setSize: [() => moveCursor(chart)], setScale: [() => moveCursor(chart)] },
  };
  chart.plot = new uPlot(options, [TIMES, ...chart.series.map((series) => series.y)], chart.host);
  chart.plot.setScale("x", { min: span.from, max: span.to });
  chart.now = element("div", { className: "now-line" });
  chart.plot.over.append(chart.now);
  listenToChart(chart.plot);
  moveCursor(chart);
}

function zoomToSelection(plot) {
  const { left, width } = plot.select;
  if (width < 4) return;
  const [from, to] = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  span.set(from, to);
}

/** A press moves the time, a drag zooms, two presses show the whole run. */
function listenToChart(plot) {
  let pressed = 0;
  plot.over.addEventListener("pointerdown", (event) => { pressed = event.clientX; });
  plot.over.addEventListener("click", (event) => {
    if (Math.abs(event.clientX - pressed) > 3) return;
    clock.set(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
  });
  plot.over.addEventListener("dblclick", () => span.set(0, clock.end));
}

/** Value of a series at a time, null outside of its samples. */
function seriesAt({ y }, time) {
  const i = lastIndex(TIMES, time + 1e-9), next = Math.min(i + 1, TIMES.length - 1);
  if (!TIMES.length || y[i] === null || y[next] === null) return TIMES.length ? y[i] : null;
  const step = TIMES[next] - TIMES[i];
  return mix(y[i], y[next], step > 0 ? clamp((time - TIMES[i]) / step, 0, 1) : 0);
}

function moveCursor(chart) {
  if (!chart.plot || !chart.now) return;
  const inside = clock.now >= span.from - 1e-9 && clock.now <= span.to + 1e-9;
  chart.now.hidden = !inside;
  if (inside) chart.now.style.transform = `translateX(${chart.plot.valToPos(clock.now, "x")}px)`;
  chart.series.forEach((series, i) => {
    const value = seriesAt(series, clock.now);
    chart.values[i].textContent = value === null ? "–" : format(value, chart.digits) + " " + chart.unit;
  });
}

function redrawCharts() {
  for (const chart of charts) if (chart.plot) chart.plot.redraw(false);
}

// ---- the two charts ----------------------------------------------------------------------------

const charts = [];

const MOTION = {
  v: { title: "Speed", unit: "km/h", digits: 1, factor: 3.6 },
  a: { title: "Acceleration", unit: "m/s²", digits: 2, factor: 1 },
  offset: { title: "Offset from the lane's centre", unit: "m", digits: 2, factor: 1 },
};

const curve = (actor) => ({ name: actor.name, hue: actor.hue, dash: actor.number > 0 });

function motionSeries(column) {
  return MOVABLE.filter((actor) => isShown(actor) && actor.track[column]).map((actor) => (
    { ...curve(actor), y: sampled(actor, actor.track[column], MOTION[column].factor) }));
}

function startMotionChart() {
  const chart = makeChart("motion");
  let column = "v";
  charts.push(chart);
  const show = () => {
    byId("motion-title").textContent = MOTION[column].title;
    chart.show({ ...MOTION[column], series: motionSeries(column) });
  };
  const pick = (chosen) => { column = chosen; show(); };
  segments(byId("motion-kind"), [["v", "Speed"], ["a", "Acceleration"], ["offset", "Lateral"]], pick);
  shown.listeners.push(show);
  show();
}

const BETWEEN = {
  bumper: { title: "Bumper gap", unit: "m", digits: 1, of: bumperGap },
  ttc: { title: "Time to collision", unit: "s", digits: 2, of: timeToCollision },
  box: { title: "Distance between boxes", unit: "m", digits: 1, of: boxDistance },
};

const allPairs = () => MOVABLE.filter(isShown).flatMap((a, i, all) =>
  all.slice(i + 1).filter((b) => b.run === a.run).map((b) => [a, b]));
const pairsOf = (actor) =>
  MOVABLE.filter((other) => other !== actor && other.run === actor.run && isShown(other)).map((other) => [actor, other]);

/** Where the actors are at some twenty times: enough to find the pairs that come near. */
const SPOTS = new Map(MOVABLE.map((actor) => (
  [actor, Array.from({ length: 21 }, (_, i) => poseAt(actor, (clock.end * i) / 20))])));

/** How near two actors come. */
function nearest([a, b]) {
  const others = SPOTS.get(b);
  return Math.min(...SPOTS.get(a).map((p, i) => Math.hypot(p.x - others[i].x, p.y - others[i].y)));
}

function pairSeries([a, b], of, hue) {
  const y = TIMES.map((time) => (within(a, time) && within(b, time) ? of(boxAt(a, time), boxAt(b, time)) : null));
  return { name: `${a.name} – ${b.name}`, hue, dash: a.number > 0, y };
}

function startGapChart() {
  const select = byId("gap-of");
  if (allPairs().length === 0) {
    byId("gap").closest(".card").hidden = true;
    return;
  }
  const chart = makeChart("gap");
  let kind = "bumper";
  charts.push(chart);
  select.append(element("option", { value: "all", textContent: "nearest" }));
  for (const actor of MOVABLE) select.append(element("option", { value: actor.index, textContent: "of " + actor.name }));
  select.parentElement.hidden = MOVABLE.length < 3;
  const show = () => {
    const actor = select.value === "all" ? null : ACTORS[Number(select.value)];
    const pairs = (actor ? pairsOf(actor) : allPairs()).map((pair) => [nearest(pair), pair])
      .sort((one, other) => one[0] - other[0]).slice(0, MAX_PAIRS).map(([, pair]) => pair);
    byId("gap-title").textContent = BETWEEN[kind].title;
    const hueOf = ([, b], i) => (actor ? b.hue : i % Math.max(IDS.length, 1));
    chart.show({ ...BETWEEN[kind], series: pairs.map((pair, i) => pairSeries(pair, BETWEEN[kind].of, hueOf(pair, i))) });
  };
  const pick = (chosen) => { kind = chosen; show(); };
  segments(byId("gap-kind"), [["bumper", "Bumper gap"], ["ttc", "Time to collision"], ["box", "Distance"]], pick);
  select.addEventListener("change", show);
  shown.listeners.push(show);
  show();
}
