// The timeline: actions as bars in a row per actor, instants as marks in rows of their own.

const LINE_HEIGHT = 24;
const BAR_HEIGHT = 18;
const MAX_MARK_LINES = 4;

const timeline = { host: byId("timeline"), axis: null, cursor: null };

// Marks of these kinds have rows of their own; what else happened is in the log.
const MARK_ROWS = [
  ["events", ["event", "collision", "criterion"]], ["lights", ["lights"]], ["signals", ["signal"]],
  ["environment", ["environment"]],
];
const COMPOSITIONS = new Set(["serial", "parallel", "one_of", "action", "emit"]);

/** Rows of marks that exist, then a row for every actor with actions, then what is waited for. */
function buildTimelineRows() {
  const markRows = MARK_ROWS.map(([name, kinds]) => (
    { name, marks: MARKS.filter((mark) => kinds.includes(mark.kind)) })).filter((row) => row.marks.length);
  const bars = RUNS.flatMap((run) => [...actionRows(run), ...waitRows(run), ...conditionRows(run)]);
  return [...markRows.filter((row) => row.name === "events"), ...bars, ...markRows.filter((row) => row.name !== "events")];
}

function actionRows(run) {
  const actors = new Map(run.actors.map((actor) => [actor.id, []]));
  for (const action of ACTIONS.filter((each) => each.run === run)) {
    if (!actors.has(action.actor)) actors.set(action.actor, []);
    actors.get(action.actor).push(action);
  }
  return [...actors].filter(([, actions]) => actions.length).map(([id, actions]) => {
    const actor = run.byId.get(id);
    return { name: actor ? actor.name : id || "(no actor)", actor, actions };
  });
}

/** Waits, conditions and deadlines: why a run goes on. */
function waitRows(run) {
  const actions = run.nodes.filter((node) => !COMPOSITIONS.has(node.kind)).flatMap((node) =>
    node.runs.map(([start, end, status]) => ({
      run, actor: "", name: `${node.kind} ${node.text}`.trim(), source: node.source, start, end,
      status: status === "failure" ? "fail" : status, reason: "",
    })));
  return actions.length ? [{ name: COMPARED ? `${run.letter}: waits` : "waits", actions, waits: true }] : [];
}

/** Conditions that do not hold, from the first to the last state at which they do not. */
function conditionRows(run) {
  const actions = run.violations.map(({ severity, name, source, place, start, end, what, code }) => (
    { run, actor: "", name, source, start, end, status: severity === "failure" ? "fail" : "warn", reason: `${code} at ${place}: ${what}` }));
  return actions.length ? [{ name: COMPARED ? `${run.letter}: not met` : "not met", actions }] : [];
}

const TIMELINE_ROWS = buildTimelineRows();

/** Labels of actions by run and place. */
const ACTION_LABELS = new Map(RUNS.map((run) => [run, new Map(run.nodes
  .filter((node) => node.kind === "action" && node.label).map((node) => [node.source, node.label]))]));

/** Without the actor's name in front, which the row already says. */
const shortName = (action) =>
  action.name.startsWith(action.actor + " ") ? action.name.slice(action.actor.length + 1) : action.name;

/** What a bar says: the label of the scenario, then what it does. */
function barName(action) {
  const label = action.source && ACTION_LABELS.get(action.run).get(action.source);
  return label && action.actor ? `${label}: ${shortName(action)}` : shortName(action);
}

/** The first line on which [from, to] is free; a new one if none is; `limit` if there are enough. */
function freeLine(lines, from, to, limit) {
  let index = lines.findIndex((spans) => spans.every(([a, b]) => to <= a || from >= b));
  if (index < 0 && lines.length === limit) return limit;
  if (index < 0) index = lines.push([]) - 1;
  lines[index].push([from, to]);
  return index;
}

/** Where a bar and its text go: inside if it fits, else beside it. */
function layoutBar(action, toX, left, right) {
  const x0 = Math.max(toX(action.start), left), x1 = Math.max(Math.min(toX(actionEnd(action)), right), x0 + 5);
  const style = action.status === "fail" ? "600 12px" : "12px";
  const name = fitText(barName(action), 260, style);
  const textSpan = textWidth(name, style) + 12;
  if (textSpan <= x1 - x0) return { action, x0, x1, name, textX: x0 + 6, from: x0, to: x1 };
  if (x1 + textSpan <= right) return { action, x0, x1, name, textX: x1 + 5, from: x0, to: x1 + textSpan };
  if (x0 - textSpan >= left) return { action, x0, x1, name, textX: x0 - textSpan + 6, from: x0 - textSpan, to: x1 };
  const cut = fitText(name, right - x0 - 8, style); // no side has room: over the bar and beyond
  return { action, x0, x1, name: cut, textX: x0 + 6, from: x0, to: right };
}

function layoutMark(mark, toX, right) {
  const x = toX(mark.t);
  const label = mark.kind === "lights" ? `${mark.actor}: ${mark.name}` : mark.name;
  const name = fitText(mark.kind === "collision" ? "collision " + label : label, 240);
  const width = textWidth(name) + 8;
  return x + 8 + width <= right + 8
    ? { mark, label, x, name, textX: x + 8, from: x - 6, to: x + 8 + width }
    : { mark, label, x, name, textX: x - width, from: x - 8 - width, to: x + 6 };
}

const inSpan = (item) =>
  (item.t === undefined ? item.start <= span.to && actionEnd(item) >= span.from : item.t >= span.from && item.t <= span.to);

/** Places the contents of a row on lines; gives the number of lines. */
function layoutRow(row, toX, left, right) {
  const lines = [], limit = row.marks ? MAX_MARK_LINES : Infinity;
  row.items = (row.actions || row.marks).filter(inSpan).map((item) =>
    row.actions ? layoutBar(item, toX, left, right) : layoutMark(item, toX, right));
  for (const item of row.items) item.line = freeLine(lines, item.from, item.to + 4, limit);
  // Marks beyond the limit share one more line, without names.
  row.lines = lines.length + (row.items.some((item) => item.line === limit) ? 1 : 0);
}

function barTitle(action) {
  const end = action.end === null ? "not ended" : seconds(action.end);
  const lines = [`${barName(action)} (${action.status})`, `${seconds(action.start)} to ${end}`];
  return [...lines, action.source, action.reason].filter(Boolean).join("\n");
}

/** A press on a bar or mark moves the time to its start, not to where the pointer is. */
function jumpOnPress(group, time) {
  group.addEventListener("pointerdown", (event) => {
    event.stopPropagation();
    clock.set(time);
  });
}

function drawBar(item, y) {
  const { action, x0, x1, name, textX } = item;
  const failed = action.status === "fail";
  const actor = action.run.byId.get(action.actor);
  const warns = action.status === "warn";
  const kind = failed ? " bar-fail" : warns ? " bar-warn" : action.end === null ? " bar-open" : "";
  const box = svg("rect", { class: "bar-box" + kind, x: x0, y: y + 3, width: x1 - x0, height: BAR_HEIGHT, rx: Math.min(4, (x1 - x0) / 2) });
  if (!failed && !warns) box.style.fill = box.style.stroke = actor ? actor.color : "var(--soft)";
  const text = svg("text", { class: failed ? "bar-text fail" : "bar-text", x: textX, y: y + 16 }, name);
  const group = svg("g", { class: "bar" }, svg("title", {}, barTitle(action)), box, text);
  jumpOnPress(group, action.start);
  return group;
}

function drawMark(item, y, bottom) {
  const { mark, x, name, textX, line, label } = item;
  const labelled = line < MAX_MARK_LINES;
  const middle = y + 12;
  const group = svg("g", { class: "mark " + mark.kind }, svg("title", {}, `${label}\n${seconds(mark.t)}`));
  if (bottom) group.append(svg("line", { x1: x, x2: x, y1: middle, y2: bottom }));
  group.append(svg("path", { d: `M${x} ${middle - 5}l5 5l-5 5l-5 -5Z` }));
  if (labelled) group.append(svg("text", { x: textX, y: middle + 4 }, name));
  jumpOnPress(group, mark.t);
  return group;
}

/** Width of the column with the names of the rows. */
const namesWidth = () =>
  clamp(Math.max(0, ...TIMELINE_ROWS.map((row) => textWidth(row.name, "600 12px"))) + 20, 70, 170);

function drawTimeline() {
  const { host } = timeline;
  const width = host.clientWidth, left = namesWidth(), right = width - 14;
  if (!width) return;
  const toX = (time) => left + ((time - span.from) / (span.to - span.from)) * (right - left);
  const rows = TIMELINE_ROWS.filter((row) => !row.actor || isShown(row.actor));
  rows.forEach((row) => layoutRow(row, toX, left, right));
  const rowHeights = rows.map((row) => row.lines * LINE_HEIGHT + 8);
  const bottom = rowHeights.reduce((sum, height) => sum + height, 0) || 30;
  host.style.height = bottom + 26 + "px";
  host.setAttribute("viewBox", `0 0 ${width} ${bottom + 26}`); // so that printing can scale it
  host.replaceChildren();
  drawBands(rowHeights, width);
  timeline.axis = timeAxis(host, left, right, 0, bottom);
  let y = 0;
  rows.forEach((row, i) => {
    drawRow(row, y, left, row.name === "events" ? bottom : 0);
    y += rowHeights[i];
  });
  if (!rows.length) host.append(svg("text", { x: left + 12, y: 20 }, "No actions or events"));
  timeline.cursor = svg("line", { class: "cursor", y1: 0, y2: bottom });
  host.append(timeline.cursor);
  moveTimelineCursor();
}

function drawBands(rowHeights, width) {
  let y = 0;
  rowHeights.forEach((height, i) => {
    if (i % 2) timeline.host.append(svg("rect", { class: "band", x: 0, y, width, height }));
    y += height;
  });
}

function drawRow(row, y, left, markBottom) {
  const name = fitText(row.name, left - 16, "600 12px");
  timeline.host.append(svg("text", { class: "row-name", x: 4, y: y + 20 }, svg("title", {}, row.name), name));
  for (const item of row.items) {
    const top = y + 4 + item.line * LINE_HEIGHT;
    timeline.host.append(row.actions ? drawBar(item, top) : drawMark(item, top, markBottom));
  }
}

function moveTimelineCursor() {
  if (!timeline.axis) return;
  const x = timeline.axis.toX(clamp(clock.now, span.from, span.to));
  timeline.cursor.setAttribute("x1", x);
  timeline.cursor.setAttribute("x2", x);
}

function startTimeline() {
  scrub(timeline.host, (x) => timeline.axis.toTime(x));
  clock.listeners.push(moveTimelineCursor);
  span.listeners.push(drawTimeline);
  shown.listeners.push(drawTimeline);
  drawOnResize(timeline.host, drawTimeline);
  drawTimeline();
}
