// Playback: play, pause, rates, loop, keys, and the zoom over time.

const player = { rate: 1, running: false, loop: false, last: 0 };

const RATES = [[0.1, "0.1×"], [0.25, "¼×"], [0.5, "½×"], [1, "1×"], [4, "4×"], [16, "16×"]];

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
  if (clock.now >= clock.end && player.loop) clock.set(0);
  if (clock.now >= clock.end) setRunning(false);
  else requestAnimationFrame(advance);
}

/** Arrows step by one step (with shift by a second), space plays, Home and End jump. */
function onKey(event) {
  const typing = event.target.matches("select, input[type=search]");
  if (typing || event.ctrlKey || event.altKey || event.metaKey) return;
  const step = event.shiftKey ? 1 : Number(RUNS[0].header.dt) || 0.05;
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
  segments(byId("rates"), RATES, (rate) => { player.rate = rate; }, 1);
  byId("loop").addEventListener("change", () => { player.loop = byId("loop").checked; });
  byId("zoom-in").addEventListener("click", () => span.zoom(0.5));
  byId("zoom-out").addEventListener("click", () => span.zoom(2));
  byId("zoom-all").addEventListener("click", () => span.set(0, clock.end));
  document.addEventListener("keydown", onKey);
  clock.listeners.push((time) => {
    slider.value = time;
    byId("time").textContent = format(time, 2) + " / " + seconds(clock.end);
  });
}
