// The log: everything that happened, in order of time.

const MAX_LOG_ROWS = 2000;
const LOG_COLUMNS = [["Time", "84px", "s"], ["Kind", "92px"], ["Actor", "14%"], ["Name", ""], ["Source", "18%"], ["Status", "18%"]];

/** [time, kind, actor, name, source, status, failed]. */
function logEntries() {
  const letter = (run) => (COMPARED ? run.letter + ": " : "");
  const entries = MARKS.map((mark) => [mark.t, mark.kind, letter(mark.run) + mark.actor, mark.name, mark.source, "", false]);
  for (const action of ACTIONS) {
    const { actor, name, source, status, reason } = action, who = letter(action.run) + actor;
    entries.push([action.start, "action", who, name, source, "start", false]);
    const end = reason ? `${status}: ${reason}` : status;
    if (action.end !== null) entries.push([action.end, "action", who, name, source, end, status === "fail"]);
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
  byId("log").append(tableHead(LOG_COLUMNS), element("tbody", {}, ...rows.map(({ row }) => row)));
  byId("log-note").textContent =
    entries.length > rows.length ? `The first ${rows.length} of ${entries.length} entries.` : entries.length ? "" : "No entries.";
  byId("filter").addEventListener("input", () => {
    const wanted = byId("filter").value.toLowerCase();
    for (const { row, text } of rows) row.hidden = !text.includes(wanted);
  });
  byId("log-csv").addEventListener("click", () =>
    saveCsv("log", [["time (s)", "kind", "actor", "name", "source", "status"], ...entries.map((entry) => entry.slice(0, 6))]));
  const update = (time) => rows.forEach(({ row, time: at }) => row.classList.toggle("past", at <= time));
  clock.listeners.push(update);
  update(clock.now);
}
