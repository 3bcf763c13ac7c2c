// The start of everything.

/** Options in the address: #t=12.5 sets the time, #fit shows all paths; joined with "&". */
function readOptions() {
  const parts = location.hash.slice(1).split("&");
  const time = parts.find((part) => part.startsWith("t="));
  return { time: time ? Number(time.slice(2)) || 0 : 0, fit: parts.includes("fit") };
}

/** Colours of the canvas change with the scheme and for printing, which is always light. */
function listenToTheme() {
  const refresh = () => { readTheme(); drawView(); redrawCharts(); };
  const setPrint = (print) => { document.documentElement.toggleAttribute("data-print", print); refresh(); };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);
  window.addEventListener("beforeprint", () => { drawWaiting(); setPrint(true); });
  window.addEventListener("afterprint", () => setPrint(false));
}

function fillFooter() {
  const notes = ["Bumper gap: along the heading of the first actor. Time to collision: if both go on as they move. View: drag to move, wheel to zoom. Charts: press to go there, drag to zoom, press twice for the whole run. Arrow keys step, space plays."];
  if (!DATA.lanes.length) notes.push("Drawn without a road map.");
  const skipped = RUNS.reduce((sum, run) => sum + run.skipped, 0);
  if (skipped) notes.push(`${skipped} trace lines could not be read or are of unknown kind.`);
  byId("footer").textContent = notes.join(" ");
}

function start() {
  const options = readOptions();
  fillHeader();
  startTransport();
  startWeather();
  startView(options.fit);
  startStates();
  fillFooter();
  listenToTheme();
  clock.set(options.time);
  drawLater(startMotionChart, startGapChart, startTimeline, startTree, startLog);
}
start();
