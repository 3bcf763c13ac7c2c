// Header, controls, tables, and the start of everything.

const MAX_LOG_ROWS = 2000;

// ---- header ------------------------------------------------------------------------------------

const BADGES = { success: "Success", failure: "Failure", timeout: "Timeout", error: "Error" };

const asText = (value) =>
  value === null || value === undefined ? "" : typeof value === "object" ? JSON.stringify(value) : String(value);

function fillHeader() {
  const { header, result } = DATA;
  const title = asText(header.scenario) || "Run without a header";
  document.title = title + " – run report";
  byId("title").textContent = title;
  const status = result ? asText(result.status) : "";
  byId("badge").textContent = BADGES[status] || status || "No result";
  byId("badge").dataset.status = status;
  byId("reason").textContent = result ? asText(result.reason) : "The trace ends before the run has a verdict.";
  byId("facts").append(...facts(header, result).map(([name, value]) =>
    element("div", {}, element("dt", { textContent: name }), element("dd", { textContent: value }))));
}

/** Name and value of what is known about the run. */
function facts(header, result) {
  const dt = Number(header.dt) || 0;
  const steps = result && typeof result.steps === "number" ? result.steps : null;
  const parameters = Object.entries(header.parameters || {}).map(([name, value]) => `${name} = ${asText(value)}`);
  return [
    ["Source", asText(header.source)],
    ["Map", asText(header.map)],
    ["Simulated time", seconds(steps !== null && dt ? steps * dt : DATA.duration)],
    ["Steps", steps === null ? "" : String(steps)],
    ["Step length", dt ? dt + " s" : ""],
    ["Seed", asText(header.seed)],
    ["Parameters", parameters.join(", ")],
  ].filter(([, value]) => value !== "");
}

function fillCollisions() {
  const collisions = DATA.marks.filter((mark) => mark.kind === "collision");
  byId("collisions").hidden = collisions.length === 0;
  const count = collisions.length === 1 ? "1 collision:" : collisions.length + " collisions:";
  byId("collisions").append(element("strong", { textContent: count }));
  for (const mark of collisions.slice(0, 10)) {
    const button = element("button", { type: "button", textContent: `${mark.name} at ${seconds(mark.t)}` });
    button.addEventListener("click", () => clock.set(mark.t));
    byId("collisions").append(button);
  }
}

// ---- playback ----------------------------------------------------------------------------------

const player = { rate: 1, running: false, last: 0 };

function setRunning(running) {
  player.running = running;
  byId("play").textContent = running ? "Pause" : "Play";
  if (!running) return;
  if (clock.now >= clock.end) clock.set(0);
  player.last = performance.now();
  requestAnimationFrame(advance);
}

function advance(now) {
  if (!player.running) return;
  clock.set(clock.now + ((now - player.last) / 1000) * player.rate);
  player.last = now;
  if (clock.now >= clock.end) setRunning(false);
  else requestAnimationFrame(advance);
}

/** Arrows step by one step (with shift by a second), space plays, Home and End jump. */
function onKey(event) {
  const typing = event.target.matches("select, input[type=search]");
  if (typing || event.ctrlKey || event.altKey || event.metaKey) return;
  const step = event.shiftKey ? 1 : Number(DATA.header.dt) || 0.05;
  const targets = { ArrowLeft: clock.now - step, ArrowRight: clock.now + step, Home: 0, End: clock.end };
  if (event.key in targets) clock.set(targets[event.key]);
  else if (event.key === " " && !event.target.matches("button, input")) setRunning(!player.running);
  else return;
  event.preventDefault();
}

function startTransport() {
  const slider = byId("slider");
  slider.max = clock.end;
  slider.addEventListener("input", () => clock.set(Number(slider.value)));
  byId("play").addEventListener("click", () => setRunning(!player.running));
  segments(byId("rates"), [[1, "1×"], [4, "4×"], [16, "16×"]], (rate) => { player.rate = rate; });
  document.addEventListener("keydown", onKey);
  clock.listeners.push((time) => {
    slider.value = time;
    byId("time").textContent = format(time, 2) + " / " + seconds(clock.end);
  });
}

// ---- the actors now ----------------------------------------------------------------------------

const STATE_COLUMNS = [
  ["Actor", "15%"], ["Kind", "12%"], ["Speed", "9%", "km/h"], ["Acceleration", "13%", "m/s²"],
  ["Road", "6%"], ["Lane", "5%"], ["s", "8%", "m"], ["Offset", "9%", "m"], ["Running actions", ""],
];

function tableHead(columns) {
  const cells = columns.map(([name, width, unit]) => {
    const cell = element("th", { textContent: unit ? `${name} (${unit})` : name, className: unit ? "number" : "" });
    if (width) cell.style.width = width;
    return cell;
  });
  return element("thead", {}, element("tr", {}, ...cells));
}

function stateRow(actor) {
  const swatch = element("span", { className: "swatch" });
  swatch.style.background = actor.color;
  const cells = STATE_COLUMNS.map(([, , unit]) => element("td", { className: unit ? "number" : "" }));
  cells[0].append(swatch, " " + actor.id);
  cells[0].title = actor.id;
  cells[1].textContent = actor.kind;
  return { actor, cells, row: element("tr", {}, ...cells) };
}

function updateState({ actor, cells }, time) {
  const { track } = actor;
  const [, road, lane] = placeAt(actor, time);
  const speed = columnAt(track, track.v, time);
  const running = DATA.actions.filter((action) =>
    action.actor === actor.id && action.start <= time && (action.end === null || action.end > time));
  const values = [
    format(speed === null ? null : speed * 3.6, 1), format(columnAt(track, track.a, time), 2), road || "–", lane || "–",
    format(columnAt(track, track.s, time), 1), format(columnAt(track, track.offset, time), 2),
    running.map(shortName).join(", ") || "–",
  ];
  values.forEach((value, i) => { cells[i + 2].textContent = value; });
  cells[8].title = values[6];
}

function startStates() {
  const rows = TRACKED.map(stateRow);
  if (!rows.length) return;
  byId("states").append(tableHead(STATE_COLUMNS), element("tbody", {}, ...rows.map(({ row }) => row)));
  clock.listeners.push((time) => rows.forEach((row) => updateState(row, time)));
}

// ---- log ---------------------------------------------------------------------------------------

/** Everything that happened: [time, kind, actor, name, source, status, failed]. */
function logEntries() {
  const entries = DATA.marks.map((mark) => [mark.t, mark.kind, mark.actor, mark.name, "", "", false]);
  for (const action of DATA.actions) {
    const { actor, name, source, status, reason } = action;
    entries.push([action.start, "action", actor, name, source, "start", false]);
    const end = reason ? `${status}: ${reason}` : status;
    if (action.end !== null) entries.push([action.end, "action", actor, name, source, end, status === "fail"]);
  }
  return entries.sort((a, b) => a[0] - b[0]);
}

function logRow(entry) {
  const classes = ["number", "nowrap", "", "", "", entry[6] ? "status-fail" : ""];
  const cells = classes.map((className, i) =>
    element("td", { className, textContent: i === 0 ? format(entry[0], 2) : entry[i] }));
  const row = element("tr", {}, ...cells);
  row.addEventListener("click", () => clock.set(entry[0]));
  return { row, time: entry[0], text: entry.slice(1, 6).join(" ").toLowerCase() };
}

function startLog() {
  const entries = logEntries();
  const rows = entries.slice(0, MAX_LOG_ROWS).map(logRow);
  const columns = [["Time", "90px", "s"], ["Kind", "110px"], ["Actor", "14%"], ["Name", ""], ["Source", "20%"], ["Status", "20%"]];
  byId("log").append(tableHead(columns), element("tbody", {}, ...rows.map(({ row }) => row)));
  byId("log-note").textContent =
    entries.length > rows.length ? `The first ${rows.length} of ${entries.length} entries.` : entries.length ? "" : "No entries.";
  byId("filter").addEventListener("input", () => {
    const wanted = byId("filter").value.toLowerCase();
    for (const { row, text } of rows) row.hidden = !text.includes(wanted);
  });
  clock.listeners.push((time) => rows.forEach(({ row, time: at }) => row.classList.toggle("past", at <= time)));
}

// ---- start -------------------------------------------------------------------------------------

/** Options in the address: #t=12.5 sets the time, #fit shows all paths; joined with "&". */
function readOptions() {
  const parts = location.hash.slice(1).split("&");
  const time = parts.find((part) => part.startsWith("t="));
  return { time: time ? Number(time.slice(2)) || 0 : 0, fit: parts.includes("fit") };
}

/** Colours of the canvas change with the scheme and for printing, which is always light. */
function listenToTheme() {
  const refresh = () => { readTheme(); drawView(); };
  const setPrint = (print) => { document.documentElement.toggleAttribute("data-print", print); refresh(); };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);
  window.addEventListener("beforeprint", () => setPrint(true));
  window.addEventListener("afterprint", () => setPrint(false));
}

function fillFooter() {
  const notes = ["Distances are between reference points (rear axle of vehicles). Drag to move the view, wheel to zoom; arrow keys step, space plays."];
  if (!DATA.lanes.length) notes.push("Drawn without a road map.");
  if (DATA.skipped) notes.push(`${DATA.skipped} trace lines could not be read or are of unknown kind.`);
  byId("footer").textContent = notes.join(" ");
}

function start() {
  const options = readOptions();
  fillHeader();
  fillCollisions();
  startTransport();
  startWeather();
  startView(options.fit);
  startStates();
  startMotionChart();
  startGapChart();
  startTimeline();
  startLog();
  fillFooter();
  listenToTheme();
  clock.set(options.time);
  document.documentElement.dataset.ready = "true";
}
start();
