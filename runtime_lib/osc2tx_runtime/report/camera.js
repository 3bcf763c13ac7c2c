// The camera of the bird's-eye view: what it follows, how it is turned, how wide it sees.

const START_WIDTH = 120; // m
const GROUP_WIDTH = 300; // m: a group wider than this is not followed as a whole
const canvas = byId("view");

// The camera looks at `base` (moving when something is followed) plus `offset`, which is measured
// along the screen: u to the right, w upwards (m).
const camera = { scale: 8, rotation: 0, base: [0, 0], offset: [0, 0], target: null, turn: false };

// ---- directions and extents --------------------------------------------------------------------

/** Mean heading of an actor over some seconds: calm in lane changes, turns with the road. */
function meanHeading(actor, from, to) {
  let x = 0, y = 0;
  for (let i = 0; i <= 12; i += 1) {
    const heading = headingAt(actor.track, from + ((to - from) * i) / 12);
    x += Math.cos(heading);
    y += Math.sin(heading);
  }
  return Math.atan2(y, x);
}

/** Does the road bend along the actor's path (more than about 17 degrees)? */
function bends(actor) {
  const mean = meanHeading(actor, 0, clock.end);
  for (let i = 0; i <= 24; i += 1) {
    const part = meanHeading(actor, (clock.end * i) / 24 - 2, (clock.end * i) / 24 + 2);
    if (Math.cos(part - mean) < Math.cos(0.3)) return true;
  }
  return false;
}

/** Middle and extent of some points: [x, y, width, height]. */
function extentOf(points) {
  const xs = points.map((point) => point[0]), ys = points.map((point) => point[1]);
  const low = [Math.min(...xs), Math.min(...ys)], high = [Math.max(...xs), Math.max(...ys)];
  return [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, high[0] - low[0], high[1] - low[1]];
}

const group = () => MOVABLE.filter(isShown);
const groupExtent = (time) =>
  extentOf((group().length ? group() : MOVABLE).map((actor) => poseAt(actor, time)).map(({ x, y }) => [x, y]));

/** The largest extent of the group of movable actors over the run (m). */
function groupSpread() {
  const times = Array.from({ length: 41 }, (_, i) => (clock.end * i) / 40);
  return Math.max(...times.map((time) => Math.hypot(...groupExtent(time).slice(2))));
}

/** A few hundred points of all paths. */
function pathPoints() {
  return TRACKED.flatMap(({ track }) => {
    const stride = Math.ceil(track.t.length / 200);
    return track.px.map((x, i) => [x, track.py[i]]).filter((_, i, all) => i % stride === 0 || i === all.length - 1);
  });
}

/** Direction in which the points are spread most, pointing roughly along `heading`. */
function mainDirection(points, heading) {
  const [mx, my] = points.reduce(([a, b], [x, y]) => [a + x / points.length, b + y / points.length], [0, 0]);
  let xx = 0, yy = 0, xy = 0;
  for (const [x, y] of points) {
    xx += (x - mx) ** 2;
    yy += (y - my) ** 2;
    xy += (x - mx) * (y - my);
  }
  if (xx + yy < 1) return heading;
  const angle = 0.5 * Math.atan2(2 * xy, xx - yy);
  return Math.cos(angle - heading) < 0 ? angle + Math.PI : angle;
}

// ---- camera ------------------------------------------------------------------------------------

function aim(time) {
  const { target } = camera;
  if (target === null) return;
  const pose = target === "all" ? null : poseAt(target, time);
  camera.base = pose ? [pose.x, pose.y] : groupExtent(time).slice(0, 2);
  const leader = target === "all" ? MOVABLE[0] : target;
  const [from, to] = camera.turn ? [time - 2, time + 2] : [0, clock.end];
  camera.rotation = meanHeading(leader, from, to);
}

function follow(target) {
  camera.target = target;
  camera.offset = [0, 0];
}

/** Follow with the width that suits the target. */
function followAt(target) {
  follow(target);
  const spread = target === "all" ? groupSpread() * 1.35 : 0;
  camera.scale = canvas.clientWidth / Math.max(START_WIDTH, spread);
}

/** Show all paths, lying as flat as they can. */
function fitAll() {
  follow(null);
  const points = pathPoints();
  if (!points.length) return;
  const leader = MOVABLE[0] || TRACKED[0];
  camera.rotation = mainDirection(points, meanHeading(leader, 0, clock.end));
  const c = Math.cos(camera.rotation), s = Math.sin(camera.rotation);
  const [u, w, width, height] = extentOf(points.map(([x, y]) => [c * x + s * y, c * y - s * x]));
  camera.base = [c * u - s * w, s * u + c * w];
  camera.scale = Math.min(
    canvas.clientWidth / Math.max(width * 1.12, 60), canvas.clientHeight / Math.max(height * 1.25, 30));
}

/** Position on the screen (CSS pixels) of a point of the world. */
function project(x, y) {
  const dx = x - camera.base[0], dy = y - camera.base[1];
  const c = Math.cos(camera.rotation), s = Math.sin(camera.rotation);
  return [
    canvas.clientWidth / 2 + (c * dx + s * dy - camera.offset[0]) * camera.scale,
    canvas.clientHeight / 2 - (c * dy - s * dx - camera.offset[1]) * camera.scale,
  ];
}

/** Let the context's unit be one metre of the world. */
function worldTransform(context) {
  const ratio = canvas.width / canvas.clientWidth;
  const k = ratio * camera.scale;
  const [x, y] = project(0, 0);
  const c = k * Math.cos(camera.rotation), s = k * Math.sin(camera.rotation);
  context.setTransform(c, s, s, -c, x * ratio, y * ratio);
}

function pixelTransform(context) {
  const ratio = canvas.width / canvas.clientWidth;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
}
