// The actors at the time of the page, and the filter that says which of them the views show.

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
  const swatch = element("span", { className: actor.number ? "swatch dashed" : "swatch" });
  swatch.style.background = actor.color;
  const cells = STATE_COLUMNS.map(([, , unit]) => element("td", { className: unit ? "number" : "" }));
  const box = element("input", { type: "checkbox", checked: true, title: "Show " + actor.name });
  box.addEventListener("change", applyFilter);
  cells[0].append(element("label", {}, box, " ", swatch, " " + actor.name));
  cells[0].title = actor.name;
  cells[1].textContent = actor.kind;
  return { actor, box, cells, row: element("tr", {}, ...cells) };
}

function updateState({ actor, cells }, time) {
  const { track } = actor;
  const [, road, lane] = placeAt(actor, time);
  const speed = columnAt(track, track.v, time);
  const running = actor.actions.filter((action) => action.start <= time && (action.end === null || action.end > time));
  const values = [
    format(speed === null ? null : speed * 3.6, 1), format(columnAt(track, track.a, time), 2), road || "–", lane || "–",
    format(columnAt(track, track.s, time), 1), format(columnAt(track, track.offset, time), 2),
    running.map(shortName).join(", ") || "–",
  ];
  values.forEach((value, i) => { cells[i + 2].textContent = value; });
  cells[8].title = values[6];
}

const stateRows = [];

/** Show the actors whose names have the words of the filter, and whose boxes are ticked. */
function applyFilter() {
  const words = byId("actor-filter").value.toLowerCase().split(/\s+/);
  for (const { actor, row } of stateRows) {
    row.hidden = !words.every((word) => `${actor.name} ${actor.kind}`.toLowerCase().includes(word));
  }
  const kept = stateRows.filter(({ row, box }) => !row.hidden && box.checked);
  const count = `${kept.length} of ${stateRows.length}`;
  byId("actor-count").textContent = kept.length === stateRows.length ? String(stateRows.length) : count;
  setShown(kept.map(({ actor }) => actor));
}

/** All samples of all actors. */
function stateCsv() {
  const columns = ["x", "y", "h", "v", "a", "s", "offset"];
  const head = ["time (s)", "actor", "x (m)", "y (m)", "heading (rad)", "speed (m/s)", "acceleration (m/s²)", "s (m)", "offset (m)", "road", "lane"];
  const rows = TRACKED.filter(isShown).flatMap((actor) => actor.track.t.map((time, i) => [
    time, actor.name, ...columns.map((name) => actor.track[name] && actor.track[name][i]), ...placeAt(actor, time).slice(1)]));
  saveCsv("states", [head, ...rows]);
}

function startStates() {
  for (const actor of TRACKED) {
    actor.actions = ACTIONS.filter((action) => action.run === actor.run && action.actor === actor.id);
    stateRows.push(stateRow(actor));
  }
  if (!stateRows.length) {
    byId("states").closest(".card").hidden = true;
    return;
  }
  byId("states").append(tableHead(STATE_COLUMNS), element("tbody", {}, ...stateRows.map(({ row }) => row)));
  byId("actor-count").textContent = String(stateRows.length);
  byId("actor-filter").addEventListener("input", applyFilter);
  byId("all-actors").addEventListener("click", () => {
    byId("actor-filter").value = "";
    const ticked = stateRows.every(({ box }) => box.checked);
    for (const { box } of stateRows) box.checked = !ticked;
    applyFilter();
  });
  byId("states-csv").addEventListener("click", stateCsv);
  clock.listeners.push((time) => stateRows.forEach((row) => { if (!row.row.hidden) updateState(row, time); }));
  shown.listeners.push(() => stateRows.forEach((row) => updateState(row, clock.now)));
}
