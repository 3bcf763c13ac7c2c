// Line charts over time: speed or acceleration of the actors, distances between them.

const MAX_PAIRS = 6; // more curves than this are not readable: pairs of one actor instead

/**
 * A chart in an <svg> with a legend. `show({unit, digits, series})` draws; a series is
 * {name, color, t, y} with y null where there is no value.
 */
function makeChart(host, legend) {
  const chart = { host, legend, series: [], unit: "", digits: 1, hidden: new Set(), axis: null };
  chart.show = (content) => {
    Object.assign(chart, content);
    buildLegend(chart);
    drawChart(chart);
  };
  scrub(host, (x) => chart.axis.toTime(x));
  clock.listeners.push(() => moveCursor(chart));
  drawOnResize(host, () => drawChart(chart));
  return chart;
}

function buildLegend(chart) {
  chart.values = chart.series.map(() => element("span", { className: "value" }));
  chart.legend.replaceChildren(...chart.series.map((series, i) => {
    const swatch = element("span", { className: "swatch" });
    swatch.style.background = series.color;
    const name = element("span", { className: "name", textContent: series.name, title: series.name });
    const button = element("button", { type: "button", title: "Show or hide" }, swatch, name, chart.values[i]);
    button.setAttribute("aria-pressed", !chart.hidden.has(series.name));
    button.addEventListener("click", () => {
      if (!chart.hidden.delete(series.name)) chart.hidden.add(series.name);
      button.setAttribute("aria-pressed", !chart.hidden.has(series.name));
      drawChart(chart);
    });
    return button;
  }));
}

const visibleSeries = (chart) => chart.series.filter((series) => !chart.hidden.has(series.name));

/** Smallest and largest value, zero included. */
function valueRange(seriesList) {
  let low = 0, high = 0;
  for (const { y } of seriesList) {
    for (const value of y) {
      if (value === null) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return high - low < 1e-6 ? [low, low + 1] : [low, high];
}

function drawChart(chart) {
  const { host } = chart;
  const width = host.clientWidth, height = host.clientHeight;
  if (!width) return;
  host.replaceChildren();
  host.setAttribute("viewBox", `0 0 ${width} ${height}`); // so that printing can scale it
  const [left, right, top, bottom] = [52, width - 14, 22, height - 24];
  const shown = visibleSeries(chart);
  const ticks = niceTicks(...valueRange(shown), 5);
  const toY = (value) => bottom - ((value - ticks.low) / (ticks.high - ticks.low)) * (bottom - top);
  chart.axis = { ...timeAxis(host, left, right, top, bottom), toY, top, bottom };
  drawValueAxis(chart, ticks, left, right);
  for (const series of shown) {
    const curve = svg("path", { class: "curve", d: curvePath(series, chart.axis) });
    curve.style.stroke = series.color;
    host.append(curve);
  }
  if (!chart.series.length) host.append(svg("text", { x: left + 12, y: top + 24 }, "Nothing to show"));
  chart.cursor = svg("line", { class: "cursor", y1: top - 4, y2: bottom });
  chart.dots = shown.map((series) => {
    const dot = svg("circle", { class: "dot", r: 4 });
    dot.style.fill = series.color;
    return dot;
  });
  host.append(chart.cursor, ...chart.dots);
  moveCursor(chart);
}

function drawValueAxis(chart, ticks, left, right) {
  for (const value of ticks.values) {
    const y = chart.axis.toY(value);
    const zero = Math.abs(value) < 1e-9 && ticks.low < 0;
    chart.host.append(svg("line", { class: zero ? "zero" : "grid", x1: left, x2: right, y1: y, y2: y }));
    chart.host.append(svg("text", { x: left - 8, y: y + 4, "text-anchor": "end" }, format(value, ticks.digits)));
  }
  chart.host.append(svg("text", { x: 4, y: 11 }, chart.unit));
}

function curvePath({ t, y }, { toX, toY }) {
  const parts = [];
  let pen = "M";
  t.forEach((time, i) => {
    if (y[i] === null) { pen = "M"; return; }
    parts.push(pen, toX(time).toFixed(1), " ", toY(y[i]).toFixed(1));
    pen = "L";
  });
  return parts.join("");
}

/** Value of a series at a time, null outside of its samples. */
function seriesAt({ t, y }, time) {
  if (!t.length || time < t[0] - 1e-6 || time > t[t.length - 1] + 1e-6) return null;
  return columnAt({ t }, y, time);
}

function moveCursor(chart) {
  if (!chart.axis) return;
  const x = chart.axis.toX(clock.now);
  chart.cursor.setAttribute("x1", x);
  chart.cursor.setAttribute("x2", x);
  chart.series.forEach((series, i) => {
    const value = seriesAt(series, clock.now);
    chart.values[i].textContent = value === null ? "–" : format(value, chart.digits) + " " + chart.unit;
  });
  visibleSeries(chart).forEach((series, i) => {
    const value = seriesAt(series, clock.now);
    chart.dots[i].setAttribute("visibility", value === null ? "hidden" : "visible");
    chart.dots[i].setAttribute("cx", x);
    chart.dots[i].setAttribute("cy", chart.axis.toY(value === null ? 0 : value));
  });
}

// ---- the two charts ----------------------------------------------------------------------------

const QUANTITIES = {
  v: { title: "Speed", unit: "km/h", digits: 1, factor: 3.6 },
  a: { title: "Acceleration", unit: "m/s²", digits: 2, factor: 1 },
};

function motionSeries(column) {
  const factor = QUANTITIES[column].factor;
  return MOVABLE.filter((actor) => actor.track[column]).map((actor) => ({
    name: actor.id, color: actor.color, t: actor.track.t,
    y: actor.track[column].map((value) => (value === null ? null : value * factor)),
  }));
}

function startMotionChart() {
  const chart = makeChart(byId("motion"), byId("motion-legend"));
  const show = (column) => {
    byId("motion-title").textContent = QUANTITIES[column].title;
    chart.show({ ...QUANTITIES[column], series: motionSeries(column) });
  };
  segments(byId("motion-kind"), [["v", "Speed"], ["a", "Acceleration"]], show);
  show("v");
}

/** Distance of the reference points of two actors at the sample times of the first. */
function gapSeries(a, b, color) {
  const from = b.track.t[0], to = b.track.t[b.track.t.length - 1];
  const t = a.track.t.filter((time) => time >= from && time <= to);
  const y = t.map((time) => {
    const p = poseAt(a, time), q = poseAt(b, time);
    return Math.hypot(p.x - q.x, p.y - q.y);
  });
  return { name: a.id + " – " + b.id, color, t, y };
}

const allPairs = () => MOVABLE.flatMap((a, i) => MOVABLE.slice(i + 1).map((b) => [a, b]));
const pairsOf = (actor) => MOVABLE.filter((other) => other !== actor).map((other) => [actor, other]);

function startGapChart() {
  const select = byId("gap-of"), pairs = allPairs();
  if (!pairs.length) {
    byId("gap").closest(".card").hidden = true;
    return;
  }
  const chart = makeChart(byId("gap"), byId("gap-legend"));
  const showAll = () => pairs.map(([a, b], i) => gapSeries(a, b, paletteColor(pairs.length === 1 ? 5 : i + 4)));
  const showOne = (actor) => pairsOf(actor).map(([a, b]) => gapSeries(a, b, b.color));
  const show = () => {
    const actor = select.value === "all" ? null : ACTORS[Number(select.value)];
    chart.show({ unit: "m", digits: 1, series: actor ? showOne(actor) : showAll() });
  };
  if (pairs.length <= MAX_PAIRS) select.append(element("option", { value: "all", textContent: "all" }));
  if (MOVABLE.length > 2) {
    for (const actor of MOVABLE) {
      select.append(element("option", { value: actor.index, textContent: "of " + actor.id }));
    }
  }
  select.addEventListener("change", show);
  select.parentElement.hidden = MOVABLE.length < 3;
  show();
}
