// Checks a scenario while it is typed; all files come from the folder of this page.

import { loadPyodide } from "./pyodide/pyodide.mjs";

const PAUSE = 300; // ms after the last key
const EXAMPLE = `import osc.standard

scenario follow:
    ego: vehicle
    leader: vehicle
    do paralel:
        leader.drive(duration: 5 s) with:
            speed(50kph)
        ego.drive(duration: 5s) with:
            position(20m, behind: leader, at: start)
`;

const element = (id) => document.getElementById(id);
const text = element("text");
text.value = EXAMPLE;

const python = await loadPyodide({ indexURL: "./pyodide/" });
const archive = await (await fetch("osc2tx.zip")).arrayBuffer();
python.unpackArchive(archive, "zip", { extractDir: "/osc2tx" });
const answers = python.runPython(`
import sys
sys.path.insert(0, "/osc2tx")
import playground
playground
`);

/** Shows what is wrong with the text. */
function check() {
  const found = JSON.parse(answers.check(text.value));
  const items = found.map((each) => {
    const item = document.createElement("li");
    item.className = each.severity;
    const help = each.help ? `\n  help: ${each.help}` : "";
    item.textContent = `${each.place}: ${each.severity}[${each.code}]: ${each.message}${help}`;
    return item;
  });
  element("found").replaceChildren(...items);
  element("status").textContent = found.length ? `${found.length} found` : "no errors";
}

/** Replaces the text by another one. */
function change(make) {
  text.value = make(text.value);
  check();
}

let pause;
text.addEventListener("input", () => {
  clearTimeout(pause);
  pause = setTimeout(check, PAUSE);
});
element("fix").addEventListener("click", () => change((t) => answers.fixed(t, false)));
element("fix-all").addEventListener("click", () => change((t) => answers.fixed(t, true)));
element("format").addEventListener("click", () => change((t) => answers.formatted(t)));
element("tree").addEventListener("click", () => {
  const svg = answers.tree(text.value);
  element("picture").src = svg ? `data:image/svg+xml,${encodeURIComponent(svg)}` : "";
});
element("run").addEventListener("click", () => {
  element("result").textContent = answers.run(text.value);
});
for (const button of document.querySelectorAll("button")) button.disabled = false;
check();
// `#fix-all,tree,run` presses these buttons.
for (const name of location.hash.slice(1).split(",").filter(Boolean)) element(name)?.click();
