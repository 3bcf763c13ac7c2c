// Distances between the boxes of two actors, and the time until they touch.

const LONGEST = 30; // s: a time to collision beyond it says nothing

/** The box of an actor: middle, half sides, direction, velocity (m, m/s). */
function boxAt(actor, time) {
  const { x, y, h } = poseAt(actor, time);
  const c = Math.cos(h), s = Math.sin(h), ahead = actor.length / 2 - actor.rear;
  const v = columnAt(actor.track, actor.track.v, time) || 0;
  return { x: x + c * ahead, y: y + s * ahead, c, s, l: actor.length / 2, w: actor.width / 2, vx: v * c, vy: v * s };
}

/** Half the extent of a box along a direction. */
const extent = (box, nx, ny) =>
  box.l * Math.abs(box.c * nx + box.s * ny) + box.w * Math.abs(-box.s * nx + box.c * ny);

/** From bumper to bumper along the heading of the first; zero where they are beside each other. */
function bumperGap(a, b) {
  const along = (b.x - a.x) * a.c + (b.y - a.y) * a.s;
  return Math.max(0, Math.abs(along) - a.l - extent(b, a.c, a.s));
}

/** The directions of the sides of two boxes: what does not overlap along one of them is apart. */
const sideDirections = (a, b) => [[a.c, a.s], [-a.s, a.c], [b.c, b.s], [-b.s, b.c]];

/** Shortest way from a box to the other; zero where they touch. */
function boxDistance(a, b) {
  const apart = sideDirections(a, b).some(([nx, ny]) =>
    Math.abs((b.x - a.x) * nx + (b.y - a.y) * ny) > extent(a, nx, ny) + extent(b, nx, ny));
  return apart ? Math.min(cornerDistance(a, b), cornerDistance(b, a)) : 0;
}

/** Shortest way from a corner of `a` to `b`. */
function cornerDistance(a, b) {
  let least = Infinity;
  for (const [i, j] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
    const x = a.x + i * a.l * a.c - j * a.w * a.s - b.x, y = a.y + i * a.l * a.s + j * a.w * a.c - b.y;
    const u = Math.max(Math.abs(x * b.c + y * b.s) - b.l, 0), v = Math.max(Math.abs(y * b.c - x * b.s) - b.w, 0);
    least = Math.min(least, Math.hypot(u, v));
  }
  return least;
}

/** Seconds until the boxes touch if both go on as they move now; null if they do not. */
function timeToCollision(a, b) {
  let enter = 0, leave = Infinity;
  for (const [nx, ny] of sideDirections(a, b)) {
    const p = (b.x - a.x) * nx + (b.y - a.y) * ny, q = (b.vx - a.vx) * nx + (b.vy - a.vy) * ny;
    const r = extent(a, nx, ny) + extent(b, nx, ny);
    if (Math.abs(q) < 1e-9) {
      if (Math.abs(p) > r) return null;
      continue;
    }
    const [first, last] = [(-r - p) / q, (r - p) / q].sort((one, other) => one - other);
    enter = Math.max(enter, first);
    leave = Math.min(leave, last);
  }
  return enter > leave || enter > LONGEST ? null : enter;
}
