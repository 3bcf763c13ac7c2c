// The runs of the page: actors, colours, time, and what all views draw with.

const RUNS = DATA.runs;
const COMPARED = RUNS.length > 1;
const SVG_SPACE = byId("timeline").namespaceURI;

/** Make an SVG element with attributes; children may be texts (they stay texts). */
function svg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG_SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const measure = document.createElement("canvas").getContext("2d");
const FONT = 'system-ui, -apple-system, "Segoe UI", "Liberation Sans", Arial, sans-serif';
function textWidth(text, style = "12px") {
  measure.font = style + " " + FONT;
  return measure.measureText(text).width;
}

/** Shorten a text with an ellipsis so that it fits. */
function fitText(text, width, style) {
  if (textWidth(text, style) <= width) return text;
  let length = text.length;
  while (length > 0 && textWidth(text.slice(0, length) + "…", style) > width) length -= 1;
  return length > 0 ? text.slice(0, length) + "…" : "";
}

// ---- packed columns ----------------------------------------------------------------------------

/** A column as it was before `columns.py` packed it: second differences, runs as [number, count]. */
function unpackColumn(packed, digits) {
  if (!packed) return null;
  const values = [], scale = 10 ** digits;
  let last = 0, slope = 0;
  for (const part of packed) {
    if (part === null) { values.push(null); continue; }
    const [difference, count] = typeof part === "number" ? [part, 1] : part;
    for (let i = 0; i < count; i += 1) {
      slope += difference;
      last += slope;
      values.push(last / scale);
    }
  }
  return values;
}

function unpackTrack(track) {
  const columns = Object.entries(DATA.digits).map(([name, digits]) => [name, unpackColumn(track[name], digits)]);
  return { ...track, ...Object.fromEntries(columns) };
}

// ---- actors and their colours ------------------------------------------------------------------

const IDS = [...new Set(RUNS.flatMap((run) => run.actors.map((actor) => actor.id)))];
const ACTORS = RUNS.flatMap((run, number) => run.actors.map((actor) => ({
  ...actor, run, number, hue: IDS.indexOf(actor.id), color: `var(--actor-${IDS.indexOf(actor.id)})`,
  name: COMPARED ? `${run.letter}: ${actor.id}` : actor.id, track: actor.track && unpackTrack(actor.track),
}))).map((actor, index) => ({ ...actor, index }));
for (const run of RUNS) run.byId = new Map(ACTORS.filter((actor) => actor.run === run).map((actor) => [actor.id, actor]));
const TRACKED = ACTORS.filter((actor) => actor.track);
const MOVABLE = TRACKED.filter((actor) => actor.movable);
const ACTIONS = RUNS.flatMap((run) => run.actions.map((action) => ({ ...action, run })));
const MARKS = RUNS.flatMap((run) => run.marks.map((mark) => ({ ...mark, run }))).sort((a, b) => a.t - b.t);

/** Which actors the views show: those that the filter leaves. */
const shown = { actors: new Set(ACTORS), listeners: [] };
const isShown = (actor) => shown.actors.has(actor);
function setShown(actors) {
  shown.actors = new Set(actors);
  for (const listener of shown.listeners) listener();
}

// Neighbours in the cast differ in hue and in lightness, so that fifty can be told apart.
const LIGHTNESS = { light: [0.42, 0.54, 0.66, 0.74], dark: [0.62, 0.71, 0.8, 0.88] };
const actorColor = (hue, levels) => `oklch(${levels[hue % levels.length]} 0.15 ${(262 + 104 * hue) % 360})`;

const theme = {};
const THEME_NAMES = ["text", "soft", "card", "line", "grid", "bad", "label", "land", "asphalt", "shoulder",
  "walk", "bike", "park", "green", "other", "mark", "arrow", "accent",
  "lamp-red", "lamp-amber", "lamp-green", "lamp-dark", "lamp-box", "beam"];

/** Canvas drawing needs the values of the style sheet's variables. */
function readTheme() {
  const root = document.documentElement, style = getComputedStyle(root);
  for (const name of THEME_NAMES) theme[name] = style.getPropertyValue("--" + name).trim();
  theme.colors = IDS.map((_, hue) => actorColor(hue, LIGHTNESS[style.colorScheme === "dark" ? "dark" : "light"]));
  theme.colors.forEach((color, hue) => root.style.setProperty("--actor-" + hue, color));
}
readTheme();

// Canvas paths hold single precision: everything is drawn relative to a point nearby.
const ORIGIN = TRACKED.length ? [TRACKED[0].track.x[0], TRACKED[0].track.y[0]] : [0, 0];
for (const { track } of TRACKED) {
  track.px = track.x.map((x) => x - ORIGIN[0]);
  track.py = track.y.map((y) => y - ORIGIN[1]);
  track.placeTimes = track.places.map((place) => place[0]);
}

/** The value of one column between its samples; held before the first and after the last. */
function columnAt(track, column, time) {
  if (!column) return null;
  const i = lastIndex(track.t, time);
  const next = Math.min(i + 1, track.t.length - 1);
  const span = track.t[next] - track.t[i];
  return mix(column[i], column[next], span > 0 ? clamp((time - track.t[i]) / span, 0, 1) : 0);
}

/** Heading between samples, the short way round. */
function headingAt(track, time) {
  if (!track.h) return 0;
  const i = lastIndex(track.t, time);
  const next = Math.min(i + 1, track.t.length - 1);
  const span = track.t[next] - track.t[i];
  const turn = track.h[next] - track.h[i];
  const short = Math.atan2(Math.sin(turn), Math.cos(turn));
  return track.h[i] + short * (span > 0 ? clamp((time - track.t[i]) / span, 0, 1) : 0);
}

/** Position (m, relative to ORIGIN) and heading (rad) of an actor. */
function poseAt(actor, time) {
  const track = actor.track;
  return { x: columnAt(track, track.px, time), y: columnAt(track, track.py, time), h: headingAt(track, time) };
}

/** Road and lane of an actor as [time, road, lane]. */
const placeAt = ({ track }, time) => track.places[lastIndex(track.placeTimes, time)];

/** Start and end of an action on the page; an open one lasts to the end of the run. */
const actionEnd = (action) => (action.end === null ? action.run.duration : action.end);

// ---- the one time of the page ------------------------------------------------------------------

const clock = {
  now: 0,
  end: Math.max(0, ...RUNS.map((run) => run.duration)),
  listeners: [],
  set(time) {
    this.now = clamp(time, 0, this.end);
    for (const listener of this.listeners) listener(this.now);
  },
};

/** The part of the run that charts and timeline show: all of it, or what was zoomed to. */
const span = {
  from: 0,
  to: clock.end || 1,
  listeners: [],
  set(from, to) {
    const whole = clock.end || 1;
    this.from = clamp(from, 0, whole);
    this.to = clamp(to, this.from + Math.min(0.2, whole), whole);
    this.from = Math.min(this.from, this.to - Math.min(0.2, whole));
    for (const listener of this.listeners) listener();
  },
  /** Zoom about the present time. */
  zoom(factor) {
    const about = clamp(clock.now, this.from, this.to);
    this.set(about - (about - this.from) * factor, about + (this.to - about) * factor);
  },
};

/** Let a pointer set the time on an element: `timeOf(x)` gives the time at a client coordinate. */
function scrub(host, timeOf) {
  const move = (event) => clock.set(timeOf(event.clientX - host.getBoundingClientRect().left));
  host.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    host.setPointerCapture(event.pointerId);
    move(event);
  });
  host.addEventListener("pointermove", (event) => {
    if (host.hasPointerCapture(event.pointerId)) move(event);
  });
}

/** Draw again whenever the width of an element changes. */
function drawOnResize(host, draw) {
  let width = host.clientWidth;
  const redraw = () => {
    if (host.clientWidth === width) return;
    width = host.clientWidth;
    draw();
  };
  // Drawing may change the height, which an observer must not do while it is told of a change.
  new ResizeObserver(() => requestAnimationFrame(redraw)).observe(host);
}

// ---- axes --------------------------------------------------------------------------------------

/** A step of 1, 2 or 5 times a power of ten that gives about `count` ticks. */
function niceStep(span, count) {
  const rough = Math.max(span, 1e-9) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= rough * 0.999);
}

/** Ticks that enclose [low, high] (or lie within it, for `inside`). */
function niceTicks(low, high, count, inside = false) {
  const step = niceStep(high - low, count);
  const first = (inside ? Math.ceil(low / step - 1e-9) : Math.floor(low / step + 1e-9));
  const last = (inside ? Math.floor(high / step + 1e-9) : Math.ceil(high / step - 1e-9));
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const values = Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
  return { values, digits, low: values[0], high: values[values.length - 1] };
}

/** The time axis of the timeline: vertical lines, numbers below, and the scale. */
function timeAxis(host, left, right, top, bottom) {
  const { from, to } = span;
  const toX = (time) => left + ((time - from) / (to - from)) * (right - left);
  const ticks = niceTicks(from, to, clamp((right - left) / 90, 3, 14), true);
  for (const value of ticks.values) {
    const x = toX(value);
    host.append(svg("line", { class: "grid", x1: x, x2: x, y1: top, y2: bottom }));
    const label = format(value, ticks.digits) + (value === ticks.values[0] ? " s" : "");
    host.append(svg("text", { x, y: bottom + 16, "text-anchor": "middle" }, label));
  }
  host.append(svg("line", { class: "axis", x1: left, x2: right, y1: bottom, y2: bottom }));
  return { toX, toTime: (x) => from + ((x - left) / (right - left)) * (to - from) };
}
