// The bird's-eye view: roads, paths and boxes, and how the pointer moves the camera.

// ---- drawing -----------------------------------------------------------------------------------

const ROADS = buildRoads(DATA.lanes, DATA.crosswalks);
for (const { track } of TRACKED) {
  track.path = new Path2D();
  addLine(track.path, track.px.map((x, i) => [x, track.py[i]]));
}
const canvasColor = (actor) => theme.colors[actor.hue];
const DRAWN = () => TRACKED.filter(isShown);

/** The whole path pale, the part driven so far strong. */
function drawPath(context, actor, time) {
  const { track } = actor;
  context.strokeStyle = canvasColor(actor);
  context.lineJoin = "round";
  context.lineWidth = 1.6 / camera.scale;
  context.setLineDash(actor.number ? [6 / camera.scale, 4 / camera.scale] : []);
  context.globalAlpha = 0.35;
  context.stroke(track.path);
  context.globalAlpha = 0.9;
  const driven = new Path2D();
  const last = lastIndex(track.t, time);
  addLine(driven, track.px.slice(0, last + 1).map((x, i) => [x, track.py[i]]));
  const pose = poseAt(actor, time);
  driven.lineTo(pose.x, pose.y);
  context.stroke(driven);
  context.setLineDash([]);
  context.globalAlpha = 1;
}

/** The box of an actor with a windscreen that shows where its front is. */
function drawBox(context, actor, time) {
  const { x, y, h } = poseAt(actor, time);
  const { length, width, rear } = actor;
  context.save();
  context.translate(x, y);
  context.rotate(h);
  const pixel = 1 / camera.scale;
  drawBeams(context, actor, time);
  context.fillStyle = canvasColor(actor);
  context.strokeStyle = theme.card;
  context.lineWidth = pixel * 1.2;
  context.beginPath();
  if (Math.max(length, width) < 8 * pixel) context.arc(length / 2 - rear, 0, 4.5 * pixel, 0, 2 * Math.PI);
  else context.roundRect(-rear, -width / 2, length, width, Math.min(length, width) * (actor.movable ? 0.22 : 0.08));
  context.globalAlpha = actor.number ? 0.45 : 1; // the second run shows through
  context.fill();
  context.globalAlpha = 1;
  context.stroke();
  if (actor.movable && length > 14 * pixel) drawScreen(context, actor);
  context.restore();
}

function drawScreen(context, { length, width, rear }) {
  const front = length - rear - Math.min(0.26 * length, 1.3);
  const depth = Math.min(0.14 * length, 0.7);
  context.fillStyle = theme.card;
  context.globalAlpha = 0.75;
  context.beginPath();
  context.moveTo(front, -0.4 * width);
  context.lineTo(front, 0.4 * width);
  context.lineTo(front - depth, 0.33 * width);
  context.lineTo(front - depth, -0.33 * width);
  context.fill();
  context.globalAlpha = 1;
}

/** The rectangle on the screen which an actor's box covers: [left, top, right, bottom]. */
function screenBox(actor, time) {
  const { x, y, h } = poseAt(actor, time);
  const c = Math.cos(h), s = Math.sin(h);
  const corners = [-actor.rear, actor.length - actor.rear].flatMap((u) =>
    [-actor.width / 2, actor.width / 2].map((w) => project(x + c * u - s * w, y + s * u + c * w)));
  const [mx, my, width, height] = extentOf(corners);
  const halfWidth = Math.max(width / 2, 5), halfHeight = Math.max(height / 2, 5);
  return [mx - halfWidth, my - halfHeight, mx + halfWidth, my + halfHeight];
}

// ---- the whole view ----------------------------------------------------------------------------

function drawView() {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  if (!width || !height) return;
  const context = canvas.getContext("2d"), time = clock.now;
  aim(time);
  pixelTransform(context);
  context.fillStyle = theme.land;
  context.fillRect(0, 0, width, height);
  worldTransform(context);
  drawRoads(context, ROADS, 1 / camera.scale);
  for (const actor of DRAWN()) drawPath(context, actor, time);
  for (const actor of DRAWN()) drawBox(context, actor, time);
  pixelTransform(context);
  drawSignals(context, time);
  drawCollisions(context, time);
  drawLabels(context, time);
  drawScaleBar(context);
  drawCompass(context);
  drawRecent(context, time);
}

/** Move the camera by pixels of the screen. */
function pan(dx, dy) {
  camera.offset[0] -= dx / camera.scale;
  camera.offset[1] += dy / camera.scale;
}

/** Zoom about a point of the screen, measured from its middle. */
function zoom(factor, x, y) {
  const scale = clamp(camera.scale * factor, 0.02, 120);
  camera.offset[0] += x / camera.scale - x / scale;
  camera.offset[1] -= y / camera.scale - y / scale;
  camera.scale = scale;
}

function listenToPointer() {
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    pan(event.movementX, event.movementY);
    drawView();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const bounds = canvas.getBoundingClientRect();
    const x = event.clientX - bounds.left - bounds.width / 2, y = event.clientY - bounds.top - bounds.height / 2;
    zoom(Math.exp(-event.deltaY * 0.0015), x, y);
    drawView();
  }, { passive: false });
}

/** Fill the list of what can be followed; the choice "nothing" keeps the camera where it is. */
function listTargets() {
  const targets = new Map([["none", null]]);
  const select = byId("follow");
  select.append(element("option", { value: "none", textContent: "nothing" }));
  if (MOVABLE.length > 1) {
    targets.set("all", "all");
    select.append(element("option", { value: "all", textContent: "all actors" }));
  }
  for (const actor of TRACKED) {
    targets.set(String(actor.index), actor);
    select.append(element("option", { value: actor.index, textContent: actor.name }));
  }
  return targets;
}

/** What is worth following from the start: the group if it stays together, else one actor. */
function firstTarget() {
  if (MOVABLE.length > 1 && groupSpread() * 1.35 <= GROUP_WIDTH) return "all";
  return String((MOVABLE[0] || TRACKED[0]).index);
}

function startView(fit) {
  const select = byId("follow"), targets = listTargets();
  const showFit = () => { select.value = "none"; fitAll(); drawView(); };
  select.addEventListener("change", () => {
    if (targets.get(select.value) === null) camera.target = null;
    else followAt(targets.get(select.value));
    drawView();
  });
  byId("fit-all").addEventListener("click", showFit);
  byId("turn").addEventListener("change", () => { camera.turn = byId("turn").checked; drawView(); });
  listenToPointer();
  if (TRACKED.length) {
    camera.turn = byId("turn").checked = bends(MOVABLE[0] || TRACKED[0]);
    select.value = firstTarget();
    followAt(targets.get(select.value));
    if (fit) showFit();
  }
  byId("view-png").addEventListener("click", () => savePng("view", canvas));
  clock.listeners.push(drawView);
  shown.listeners.push(drawView);
  drawOnResize(canvas, drawView);
}
