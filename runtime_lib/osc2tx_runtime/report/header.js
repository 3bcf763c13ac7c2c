// What is known of the runs: verdicts, criteria, settings, collisions, warnings.

const BADGES = { success: "Success", failure: "Failure", timeout: "Timeout", error: "Error" };

const asText = (value) =>
  value === null || value === undefined ? "" : typeof value === "object" ? JSON.stringify(value) : String(value);

function fillHeader() {
  const title = RUNS.map(({ header }) => asText(header.scenario) || "Run without a header");
  document.title = [...new Set(title)].join(" and ") + " – run report";
  byId("title").textContent = [...new Set(title)].join(" and ");
  byId("runs").append(...RUNS.map(runHead));
}

function runHead(run) {
  const { header, result } = run;
  const status = result ? asText(result.status) : "";
  const badge = element("span", { className: "badge", textContent: BADGES[status] || status || "No result" });
  badge.dataset.status = status;
  const reason = result ? asText(result.reason) : "The trace ends before the run has a verdict.";
  const name = COMPARED ? [element("strong", { textContent: `${run.letter}: ${run.name}` })] : [];
  const rows = facts(run).map(([term, value]) =>
    element("div", {}, element("dt", { textContent: term }), element("dd", { textContent: value })));
  return element("section", {},
    element("div", { className: "title-row" }, ...name, badge, element("span", { className: "reason", textContent: reason })),
    element("dl", { className: "facts" }, ...rows), ...notices(run));
}

/** Name and value of what is known about a run. */
function facts(run) {
  const { header, result } = run;
  const dt = Number(header.dt) || 0;
  const steps = result && typeof result.steps === "number" ? result.steps : null;
  const listed = (values) => Object.entries(values || {}).map(([name, value]) => `${name} = ${asText(value)}`).join(", ");
  return [
    ["Source", asText(header.source)],
    ["Map", asText(header.map)],
    ["World", asText(header.world) || "embedded"],
    ["Control", listed(header.control) || "exact"],
    ["Simulated time", seconds(steps !== null && dt ? steps * dt : run.duration)],
    ["Steps", steps === null ? "" : `${steps} of ${dt} s`],
    ["Seed", asText(header.seed)],
    ["one_of", asText(header.one_of)],
    ["Conduct", asText(header.conduct)],
    ["Physics", asText(header.physics)],
    ["Criteria", criteria(run)],
    ["Parameters", parametersText(header)],
  ].filter(([, value]) => value !== "");
}

/** What the verdict rests on: the tree, and what `--fail-on` forbids. */
function criteria(run) {
  const forbidden = Array.isArray(run.header.fail_on) ? run.header.fail_on : [];
  const broken = (name) => run.marks.filter((mark) => mark.kind === "criterion" && mark.about === name);
  const verdict = (name) => {
    const found = broken(asText(name));
    return `no ${asText(name).replaceAll("_", " ")} ` + (found.length ? `✗ (at ${seconds(found[0].t)})` : "✓");
  };
  return ["the behavior tree", ...forbidden.map(verdict)].join(", ");
}

/** Conditions that do not hold and collisions, with buttons that go there, and warnings, such as motions that tyres cannot do. */
function notices(run) {
  const collisions = run.marks.filter((mark) => mark.kind === "collision").map((mark) => [mark.name, mark.t]);
  const warnings = run.result && Array.isArray(run.result.warnings) ? run.result.warnings.map((text) => [asText(text), null]) : [];
  const unmet = (severity) => run.violations.filter((each) => each.severity === severity).map((each) => [`${each.place}: ${each.name}: ${each.what}`, each.worst]);
  const failures = unmet("failure"), shortfalls = unmet("warning");
  return [
    notice("collisions", failures.length === 1 ? "1 condition fails its phase:" : `${failures.length} conditions fail their phases:`, failures),
    notice("warnings", shortfalls.length === 1 ? "1 condition holds only in part:" : `${shortfalls.length} conditions hold only in part:`, shortfalls),
    notice("collisions", collisions.length === 1 ? "1 collision:" : `${collisions.length} collisions:`, collisions),
    notice("warnings", warnings.length === 1 ? "1 warning:" : `${warnings.length} warnings:`, warnings),
  ].filter(Boolean);
}

function notice(className, head, entries) {
  if (!entries.length) return null;
  const buttons = entries.slice(0, 10).map(([text, time]) => {
    if (time === null) return element("p", { textContent: text });
    const button = element("button", { type: "button", textContent: `${text} at ${seconds(time)}` });
    button.addEventListener("click", () => clock.set(time));
    return button;
  });
  const more = entries.length > 10 ? [` and ${entries.length - 10} more`] : [];
  return element("div", { className }, element("strong", { textContent: head }), ...buttons, ...more);
}
