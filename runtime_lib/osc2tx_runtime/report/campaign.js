"use strict";
// The page of a campaign. DATA: summary, items, failures, columns of rows, and what is compared.

const percent = (value) => (value === null || value === undefined ? "–" : format(value, value === 100 ? 0 : 1) + " %");
const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
const exact = (value) => (value === null || value === undefined ? "–" : String(Number(value.toPrecision(5))).replace("-", "−"));
const gradeClass = (grade) => (grade === 100 ? "full" : grade > 0 ? "part" : "none");
const SHOWN_HOLES = 30;

function fillHead() {
  const { summary } = DATA;
  document.title = `${summary.scenario} – campaign`;
  byId("title").textContent = summary.scenario;
  const failed = summary.rows.total - (summary.rows.by_status.success || 0);
  const badge = byId("badge");
  badge.textContent = failed ? `${failed} failed` : "all passed";
  badge.dataset.status = failed ? "failure" : "success";
  const statuses = Object.entries(summary.rows.by_status).map(([status, count]) => `${count} ${status}`);
  byId("verdict").textContent = `${counted(summary.rows.total, "row")}: ${statuses.join(", ")}`
    + (summary.coverage_grade === null ? "" : `; coverage ${percent(summary.coverage_grade)}`);
  const facts = [
    ["Sampler", summary.sampler], ["Seed", summary.seed], ["Points that break a constraint", summary.rows.left_out],
    ["Accepted", percent(summary.rows.accepted_percent)], ["Simulated", seconds(summary.simulated_seconds)],
    ["Computed", `${seconds(summary.computed_seconds)} (${format(summary.rows_per_second, 1)} rows/s of one worker)`],
    ["Map", summary.map], ["osc2tx", summary.osc2tx], ["Row fails if", summary.fail_if.join(", ")],
  ].filter(([, value]) => value !== "" && value !== null && value !== undefined);
  byId("facts").append(...facts.map(([term, value]) =>
    element("div", {}, element("dt", { textContent: term }), element("dd", { textContent: String(value) }))));
}

function tableOf(host, heads, rows) {
  const cell = (tag) => ([value, className = ""]) =>
    value instanceof Node ? element(tag, { className }, value) : element(tag, { className, textContent: String(value) });
  host.append(element("thead", {}, element("tr", {}, ...heads.map(cell("th")))),
    element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell("td"))))));
}

function fillFailures() {
  const { failures } = DATA;
  byId("failures-card").hidden = !failures.length;
  byId("failures-note").textContent = counted(failures.length, "group");
  tableOf(byId("failures"), [["Rows", "number"], ["Status"], ["Why"], ["Where"], ["Shortest", "number"], ["Repeat it"]],
    failures.map((group) => {
      const badge = element("span", { className: "badge", textContent: group.status });
      badge.dataset.status = group.status;
      return [[group.count, "number"], [badge], [group.reason], [group.source || ""],
        [`row ${group.row}, ${seconds(group.time)}`, "number"], [element("code", { textContent: group.replay })]];
    }));
}

function fillHoles() {
  const holed = DATA.items.filter((item) => item.holes.length);
  const graded = DATA.items.filter((item) => item.grade !== null);
  byId("holes-card").hidden = !graded.length;
  const impossible = graded.reduce((sum, item) => sum + item.impossible.length, 0);
  byId("holes-note").textContent = `${counted(holed.reduce((sum, item) => sum + item.holes.length, 0), "hole")}`
    + (impossible ? `; ${impossible} more buckets have no values that the constraints allow, and count for nothing` : "");
  if (!holed.length) byId("holes").append(element("p", { className: "quiet", textContent: "Each bucket that a run can hit was hit often enough." }));
  for (const item of holed) {
    const few = item.holes.map((cell) => ({ cell, hits: item.hits[cell] || 0 })).sort((a, b) => a.hits - b.hits);
    const chips = few.slice(0, SHOWN_HOLES).map(({ cell, hits }) => element("span", { className: "chip",
      textContent: cellName(item, cell) + (hits || item.target > 1 ? ` (${hits} of ${item.target})` : "") }));
    const more = few.length - chips.length;
    byId("holes").append(element("div", { className: "hole" }, element("strong", { textContent: item.name }),
      element("span", { className: `grade ${gradeClass(item.grade)}`, textContent: percent(item.grade) }), ...chips,
      element("span", { className: "quiet", textContent: more > 0 ? `and ${more} more` : "" })));
  }
}

/** A cell is "3", of a cross "3,0": positions of buckets. */
const cellName = (item, cell) => {
  const positions = cell.split(",").map(Number);
  if (!item.parts.length) return [item.buckets[positions[0]], item.unit].filter(Boolean).join(" ");
  return positions.map((at, part) => { const of = partOf(item, part); return `${of.short} ${of.buckets[at]}`; }).join(" × ");
};
const partOf = (item, part) => DATA.items.find(({ name }) => name === item.parts[part]);

function fillCoverage() {
  byId("coverage-card").hidden = !DATA.items.length;
  byId("coverage-note").textContent = DATA.summary.coverage_grade === null ? "" : `mean grade ${percent(DATA.summary.coverage_grade)}`;
  const groups = new Map();
  for (const item of DATA.items) {
    const title = [item.scope, `at ${item.group || "?"}`].filter(Boolean).join(", ");
    groups.set(title, [...(groups.get(title) || []), item]);
  }
  for (const [title, items] of groups) {
    byId("coverage").append(element("h3", { textContent: title }), element("div", { className: "items" }, ...items.map(itemBox)));
  }
}

function itemBox(item) {
  const box = element("div", { className: "item" + (item.parts.length ? " wide" : "") });
  const kind = item.kind === "record" ? "record" : percent(item.grade);
  box.append(element("div", { className: "item-head" }, element("strong", { textContent: item.short + (item.unit ? ` (${item.unit})` : "") }),
    element("span", { className: item.grade === null ? "quiet" : `grade ${gradeClass(item.grade)}`, textContent: item.grade === null && item.kind === "cover" ? "not graded" : kind })));
  const notes = [item.text, item.target > 1 ? `target ${item.target}` : "", item.outside && item.buckets.length ? `${item.outside} outside` : "",
    item.illegal.length ? `illegal in ${counted(item.illegal.length, "row")}: ${item.illegal.slice(0, 5).join(", ")}` : "",
    item.grade === null && item.kind === "cover" ? "nobody says where its values end: give a range" : "",
    item.samples ? "" : "never sampled"].filter(Boolean);
  if (notes.length) box.append(element("div", { className: "quiet", textContent: notes.join("; ") }));
  if (item.parts.length === 2) box.append(heatMap(item));
  else if (!item.parts.length && item.buckets.length) box.append(...bucketRows(item));
  else if (item.values) {
    const { least, least_row: row, mean, greatest } = item.values;
    box.append(element("div", { textContent: `${exact(least)} (row ${row}) to ${exact(greatest)}, mean ${exact(mean)}` }), histogram(item.values));
  }
  return box;
}

function bucketRows(item) {
  const most = Math.max(1, ...Object.values(item.hits));
  return item.buckets.map((name, at) => {
    const hits = item.hits[at] || 0, impossible = item.impossible.includes(String(at));
    const fill = element("i");
    fill.style.width = `${100 * hits / most}%`;
    const hole = item.holes.includes(String(at));
    return element("div", { className: "bucket" + (impossible ? " impossible" : hole ? " hole-row" : "") },
      element("span", { textContent: name }), element("span", { className: "bar" }, fill),
      element("span", { className: "count", textContent: impossible && !hits ? "no value" : String(hits) }));
  });
}

function heatMap(item) {
  const [one, other] = [partOf(item, 0), partOf(item, 1)];
  const most = Math.max(1, ...Object.values(item.hits));
  const head = element("tr", {}, element("th", { textContent: `${one.short} ↓  ${other.short} →` }),
    ...other.buckets.map((name) => element("th", { textContent: name })));
  const rows = one.buckets.map((name, row) => element("tr", {}, element("th", { textContent: name }), ...other.buckets.map((_, column) => {
    const cell = `${row},${column}`, hits = item.hits[cell] || 0;
    const impossible = item.impossible.includes(cell), hole = item.holes.includes(cell);
    const made = element("td", { textContent: impossible && !hits ? "" : String(hits), title: cellName(item, cell) + (impossible ? ": the constraints allow no value" : `: ${counted(hits, "hit")}`),
      className: impossible && !hits ? "impossible" : hole ? "hole-cell" : "" });
    if (!hole && hits) {
      made.style.background = `color-mix(in srgb, var(--accent) ${Math.round(12 + 70 * Math.sqrt(hits / most))}%, var(--card))`;
      if (hits / most > 0.4) made.style.color = "var(--card)";
    }
    return made;
  })));
  return element("table", { className: "heat" }, head, ...rows);
}

/** The distribution of a measure or recorded value; rows that failed are apart. */
function histogram(each) {
  const most = Math.max(1, ...each.good.map((count, at) => count + each.bad[at]));
  const bars = each.good.map((count, at) => {
    const parts = [["not", each.bad[at]], ["ok", count]].filter(([, size]) => size).map(([className, size]) => {
      const bar = element("i", { className });
      bar.style.height = `${100 * size / most}%`;
      return bar;
    });
    return element("span", {}, ...parts);
  });
  return element("div", { className: "histogram", title: `${exact(each.least)} to ${exact(each.greatest)}` }, ...bars);
}

function fillMeasures() {
  const { measures } = DATA;
  byId("measures-card").hidden = !measures.length;
  tableOf(byId("measures"), [["Measure (SI units)"], ["Least", "number"], ["Mean", "number"], ["Greatest", "number"], ["Rows", "number"], ["Row of the least", "number"], ["Distribution"]],
    measures.map((each) => [[each.name], [exact(each.least), "number"], [exact(each.mean), "number"], [exact(each.greatest), "number"],
        [each.count, "number"], [each.least_row, "number"], [histogram(each)]]));
}

function fillAgainst() {
  const { against } = DATA;
  byId("against-card").hidden = !against;
  if (!against) return;
  byId("against-name").textContent = against.name;
  const list = (title, names) => names.length
    ? [element("h3", { textContent: `${title} (${names.length})` }), ...names.slice(0, 40).map((name) => element("div", { textContent: name }))] : [];
  const change = (text, now, before, better) => {
    const moved = now === null || before === null ? 0 : now - before;
    return element("div", { className: moved * better > 1e-9 ? "up" : moved * better < -1e-9 ? "down" : "", textContent: `${text}: ${percent(before)} → ${percent(now)}` });
  };
  byId("against").append(
    change("Rows that passed", against.passed_now, against.passed_before, 1),
    change("Mean grade of coverage", against.grade_now, against.grade_before, 1),
    ...list("New failures", against.new_failures), ...list("Failures that are gone", against.gone_failures),
    ...list("Buckets hit before, not now", against.lost), ...list("Buckets hit now, not before", against.won));
}

fillHead(); fillAgainst(); fillFailures(); fillHoles(); fillCoverage(); fillMeasures();
