// The table of the index: filter by words and verdict, sort by a press on a column's head.

const NUMBERS = new Set(["duration", "collisions", "warnings"]);
const COLUMNS = [
  ["scenario", "Scenario"], ["name", "Run"], ["status", "Verdict"], ["reason", "Reason"], ["duration", "Time (s)"],
  ["collisions", "Collisions"], ["warnings", "Warnings"], ["seed", "Seed"], ["parameters", "Parameters"], ["world", "World"],
].filter(([name]) => name === "scenario" || new Set(DATA.runs.map((run) => JSON.stringify(run[name]))).size > 1
  || ["name", "status", "duration"].includes(name));
const sorting = { by: "", down: false };

const shownValue = (run, name) => {
  if (name === "duration") return format(run.duration, 2);
  return name === "parameters" ? parametersText(run) : String(run[name]);
};

function indexCell(run, name) {
  const text = shownValue(run, name);
  const cell = element("td", { className: NUMBERS.has(name) ? "number" : "" });
  if (name === "name") cell.append(element("a", { href: run.page.split("/").map(encodeURIComponent).join("/"), textContent: text }));
  else if (name === "status") {
    const badge = element("span", { className: "badge", textContent: text || "none" });
    badge.dataset.status = text;
    cell.append(badge);
  } else cell.textContent = text;
  return cell;
}

const rows = DATA.runs.map((run) => ({
  run, row: element("tr", {}, ...COLUMNS.map(([name]) => indexCell(run, name))),
  text: COLUMNS.map(([name]) => shownValue(run, name)).join(" ").toLowerCase(),
}));
const body = element("tbody", {}, ...rows.map(({ row }) => row));

function sortBy(name) {
  sorting.down = sorting.by === name && !sorting.down;
  sorting.by = name;
  const key = ({ run }) => (NUMBERS.has(name) || typeof run[name] === "string" ? run[name] : shownValue(run, name));
  const order = (a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0);
  const sorted = [...rows].sort((a, b) => (sorting.down ? order(b, a) : order(a, b)));
  body.append(...sorted.map(({ row }) => row));
}

let verdict = "";
function filterRows() {
  const words = byId("filter").value.toLowerCase().split(/\s+/);
  for (const { run, row, text } of rows) {
    row.hidden = (verdict && run.status !== verdict) || !words.every((word) => text.includes(word));
  }
  const left = rows.filter(({ row }) => !row.hidden).length;
  byId("note").textContent = left === rows.length ? "" : `${left} of ${rows.length} runs`;
}

function startIndex() {
  const heads = COLUMNS.map(([name, title]) => {
    const button = element("button", { type: "button", textContent: title, title: "Sort by this" });
    button.addEventListener("click", () => sortBy(name));
    return element("th", { className: NUMBERS.has(name) ? "number" : "" }, button);
  });
  byId("runs").append(element("thead", {}, element("tr", {}, ...heads)), body);
  const statuses = [...new Set(DATA.runs.map((run) => run.status))].sort();
  const count = (status) => DATA.runs.filter((run) => run.status === status).length;
  segments(byId("statuses"), [["", `all ${rows.length}`], ...statuses.map((status) => [status, `${status || "none"} ${count(status)}`])],
    (chosen) => { verdict = chosen; filterRows(); });
  byId("filter").addEventListener("input", filterRows);
  document.documentElement.dataset.ready = "true";
}
startIndex();
