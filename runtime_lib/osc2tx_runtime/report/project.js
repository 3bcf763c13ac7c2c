// The page of a project. DATA: scenarios with verdicts and values, XML by reason, campaigns.

const MOST_NAMED = 6;
const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
const percent = (value) => (value === null ? "–" : format(value, value === 100 ? 0 : 1) + " %");
const passed = (scenario) => scenario.verdict === scenario.expected;

function tableOf(host, heads, rows) {
  const cell = (tag) => ([value, className = ""]) =>
    value instanceof Node ? element(tag, { className }, value) : element(tag, { className, textContent: String(value) });
  host.replaceChildren(element("thead", {}, element("tr", {}, ...heads.map(cell("th")))),
    element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell("td"))))));
}

function badgeOf(text, status) {
  const badge = element("span", { className: "badge", textContent: text });
  badge.dataset.status = status;
  return badge;
}

const linked = (text, page) => (page ? element("a", { href: page.split("/").map(encodeURIComponent).join("/"), textContent: text }) : text);

function toldVerdict({ verdict, expected }) {
  if (expected === "success") return verdict;
  return verdict === expected ? `${verdict}, as expected` : `${verdict}, not ${expected}`;
}

function verdictOf(scenario) {
  return badgeOf(toldVerdict(scenario), passed(scenario) ? "success" : "failure");
}

function fillHead() {
  const { scenarios, campaigns } = DATA;
  const failed = scenarios.filter((each) => !passed(each)).length + campaigns.filter((each) => each.failed).length;
  Object.assign(byId("badge"), { textContent: failed ? `${failed} failed` : "all passed" });
  byId("badge").dataset.status = failed ? "failure" : "success";
  byId("verdict").textContent = [scenarios.length && counted(scenarios.length, "scenario"),
    campaigns.length && counted(campaigns.length, "campaign")].filter(Boolean).join(", ");
}

// ---- a value of the scenarios, such as a requirement: its scenarios and their verdicts ------------

function fillValues(name) {
  const groups = new Map();
  for (const scenario of DATA.scenarios) {
    const value = scenario.values[name];
    if (value !== undefined) groups.set(value, [...(groups.get(value) || []), scenario]);
  }
  const open = DATA.scenarios.length - [...groups.values()].flat().length;
  byId("values-note").textContent = counted(groups.size, "value") + (open ? `; ${counted(open, "scenario")} without one` : "");
  tableOf(byId("values"), [[name], ["Passed", "number"], ["Failed", "number"], ["Scenarios"]],
    [...groups].sort(([a], [b]) => a.localeCompare(b, undefined, { numeric: true })).map(([value, all]) => {
      const bad = all.filter((each) => !passed(each));
      const shown = [...bad, ...all.filter(passed)].slice(0, MOST_NAMED);
      const names = element("span", {});
      shown.forEach((each, index) => names.append(index ? ", " : "", linked(each.name, each.page), passed(each) ? "" : ` (${toldVerdict(each)})`));
      if (all.length > shown.length) names.append(` and ${all.length - shown.length} more`);
      return [[value], [all.length - bad.length, "number"], [bad.length ? badgeOf(bad.length, "failure") : 0, "number"], [names]];
    }));
}

function startValues() {
  const counts = new Map();
  for (const { values } of DATA.scenarios) for (const name of Object.keys(values)) counts.set(name, (counts.get(name) || 0) + 1);
  byId("values-card").hidden = !counts.size;
  const names = [...counts.keys()].sort();
  const first = names.find((name) => /requirement/i.test(name)) || names[0];
  byId("by").append(...names.map((name) => element("option", { value: name, textContent: name, selected: name === first })));
  byId("by").addEventListener("change", () => fillValues(byId("by").value));
  if (first) fillValues(first);
}

// ---- campaigns, XML -----------------------------------------------------------------------------

function fillCampaigns() {
  byId("campaigns-card").hidden = !DATA.campaigns.length;
  byId("campaigns-note").textContent = counted(DATA.campaigns.reduce((sum, each) => sum + each.rows, 0), "row");
  tableOf(byId("campaigns"), [["Campaign"], ["Scenario"], ["Rows", "number"], ["Failed", "number"], ["Coverage", "number"], ["Holes", "number"], ["Most frequent failure"]],
    DATA.campaigns.map((each) => [[linked(each.name, each.page)], [each.scenario], [each.rows, "number"],
      [each.failed ? badgeOf(each.failed, "failure") : 0, "number"], [percent(each.grade), "number"], [each.holes, "number"], [each.reason]]));
}

function fillXml() {
  const { xml } = DATA;
  byId("xml-card").hidden = !xml.scenarios;
  byId("xml-note").textContent = `${xml.written} of ${counted(xml.scenarios, "scenario")} have XML`;
  byId("xml").hidden = !xml.reasons.length;
  tableOf(byId("xml"), [["Scenarios", "number"], ["Why there is none"], ["Where"]],
    xml.reasons.map((each) => [[each.scenarios.length, "number"], [each.reason],
      [each.scenarios.slice(0, MOST_NAMED).join(", ") + (each.scenarios.length > MOST_NAMED ? ` and ${each.scenarios.length - MOST_NAMED} more` : "")]]));
}

// ---- all scenarios ------------------------------------------------------------------------------

let chosen = "";
function fillScenarios() {
  const words = byId("filter").value.toLowerCase().split(/\s+/);
  const rows = DATA.scenarios.filter((each) => {
    const text = [each.name, each.file, each.verdict, each.reason, ...Object.values(each.values)].join(" ").toLowerCase();
    return (!chosen || each.verdict === chosen) && words.every((word) => text.includes(word));
  });
  byId("scenarios-note").textContent = rows.length === DATA.scenarios.length ? "" : `${rows.length} of ${DATA.scenarios.length}`;
  tableOf(byId("scenarios"), [["Scenario"], ["File"], ["Verdict"], ["Reason"]],
    rows.map((each) => [[linked(each.name, each.page)], [each.file], [verdictOf(each)], [each.reason]]));
}

function startProject() {
  fillHead();
  startValues();
  fillCampaigns();
  fillXml();
  byId("scenarios-card").hidden = !DATA.scenarios.length;
  const verdicts = [...new Set(DATA.scenarios.map((each) => each.verdict))].sort();
  const count = (verdict) => DATA.scenarios.filter((each) => each.verdict === verdict).length;
  segments(byId("verdicts"), [["", `all ${DATA.scenarios.length}`], ...verdicts.map((each) => [each, `${each} ${count(each)}`])],
    (verdict) => { chosen = verdict; fillScenarios(); });
  byId("filter").addEventListener("input", fillScenarios);
  fillScenarios();
  document.documentElement.dataset.ready = "true";
}
startProject();
