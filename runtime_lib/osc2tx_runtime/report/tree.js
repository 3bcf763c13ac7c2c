// The behavior tree with the state of each node at the time of the page.

const MAX_NODES = 1500;

/** State of a node at a time: "" before its first run, else running, success, failure or stopped. */
function nodeState(node, time) {
  let state = "";
  for (const [start, end, how] of node.runs) {
    if (start > time + 1e-9) break;
    state = end === null || end > time + 1e-9 ? "running" : how;
  }
  return state;
}

const STATE_SIGNS = { "": "·", running: "▶", success: "✓", failure: "✗", stopped: "■" };

function nodeRow(node) {
  const sign = element("span", { className: "sign" });
  const words = element("span", { className: "words" }, element("i", { textContent: node.kind }), " " + node.text);
  const row = element("li", { title: `${node.kind} ${node.text}\n${node.source}`.trim() }, sign, words,
    element("span", { className: "place", textContent: node.source }));
  row.style.paddingLeft = 6 + 14 * Math.min(node.depth, 24) + "px";
  row.addEventListener("click", () => {
    if (!node.runs.length) return;
    const next = node.runs.find(([start]) => start > clock.now + 1e-9) || node.runs[0];
    clock.set(next[0]);
  });
  return { node, row, sign, state: null };
}

function startTree() {
  const nodes = RUNS.flatMap((run) => run.nodes);
  if (!nodes.length) {
    byId("tree").closest(".card").hidden = true;
    return;
  }
  const only = byId("running-only");
  const rows = nodes.slice(0, MAX_NODES).map(nodeRow);
  byId("tree").append(...rows.map(({ row }) => row));
  byId("tree-note").textContent = nodes.length > MAX_NODES ? `The first ${MAX_NODES} of ${nodes.length} nodes.` : "";
  const update = (time) => {
    for (const entry of rows) {
      const state = nodeState(entry.node, time);
      if (state !== entry.state) {
        entry.state = entry.row.dataset.state = state;
        entry.sign.textContent = STATE_SIGNS[state];
      }
      entry.row.hidden = only.checked && state !== "running";
    }
  };
  only.addEventListener("change", () => update(clock.now));
  clock.listeners.push(update);
  update(clock.now);
}
