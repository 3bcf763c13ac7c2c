// Lanes as canvas paths: made once, drawn with any view.

const LANE_COLORS = {
  shoulder: "shoulder", stop: "shoulder", border: "green", median: "green", restricted: "green",
  sidewalk: "walk", walking: "walk", curb: "walk", biking: "bike", parking: "park",
};
const DRIVING = new Set(["driving", "HOV", "bidirectional", "bus", "connectingRamp", "entry", "exit",
  "mwyEntry", "mwyExit", "offRamp", "onRamp", "slipLane", "taxi"]);
const ARROW_EVERY = 40; // m
const STRIPE_EVERY = 1; // m, of which half is white

/** Points (m, relative to ORIGIN) from packed centimetres. */
function unpack(packed) {
  const points = [];
  let x = 0, y = 0;
  for (let i = 0; i < packed.length; i += 2) {
    x += packed[i];
    y += packed[i + 1];
    points.push([x / 100 - ORIGIN[0], y / 100 - ORIGIN[1]]);
  }
  return points;
}

function addLine(path, points) {
  points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
}

/** Chevrons along the middle of a lane, pointing the way it is driven. */
function addArrows(path, left, right, direction) {
  if (left.length !== right.length) return;
  const middle = left.map(([x, y], i) => [(x + right[i][0]) / 2, (y + right[i][1]) / 2]);
  if (direction < 0) middle.reverse();
  let next = ARROW_EVERY / 2, walked = 0;
  for (let i = 1; i < middle.length; i += 1) {
    const [ax, ay] = middle[i - 1], [bx, by] = middle[i];
    const length = Math.hypot(bx - ax, by - ay);
    const ux = (bx - ax) / (length || 1), uy = (by - ay) / (length || 1);
    for (; next <= walked + length; next += ARROW_EVERY) {
      const x = ax + ux * (next - walked), y = ay + uy * (next - walked);
      path.moveTo(x - ux * 0.6 - uy * 0.6, y - uy * 0.6 + ux * 0.6);
      path.lineTo(x, y);
      path.lineTo(x - ux * 0.6 + uy * 0.6, y - uy * 0.6 - ux * 0.6);
    }
    walked += length;
  }
}

/** Sort the edges of a driving lane into dashed and solid lines. */
function addEdges(paths, lane, left, right) {
  const [inner, outer] = lane.lane > 0 ? [right, left] : [left, right];
  const between = DRIVING.has(lane.inner) && Math.abs(lane.lane) > 1;
  addLine(between ? paths.dashed : paths.solid, inner);
  if (!DRIVING.has(lane.outer)) addLine(paths.solid, outer);
}

/** Stripes across the way of a crosswalk, as long as it is wide. */
function addStripes(path, [x, y, heading, length, width]) {
  const ux = Math.cos(heading), uy = Math.sin(heading);
  const number = Math.max(1, Math.floor(length / STRIPE_EVERY));
  const corner = (along, across) =>
    [x - ORIGIN[0] + ux * along - uy * across, y - ORIGIN[1] + uy * along + ux * across];
  for (let i = 0; i < number; i += 1) {
    const from = (i - number / 2 + 0.25) * STRIPE_EVERY, to = from + STRIPE_EVERY / 2;
    addLine(path, [corner(from, -width / 2), corner(to, -width / 2), corner(to, width / 2), corner(from, width / 2)]);
    path.closePath();
  }
}

function buildRoads(lanes, crosswalks) {
  const roads = { fills: new Map(), dashed: new Path2D(), solid: new Path2D(), arrows: new Path2D(), stripes: new Path2D() };
  crosswalks.forEach((crosswalk) => addStripes(roads.stripes, crosswalk));
  for (const lane of lanes) {
    const left = unpack(lane.left), right = unpack(lane.right);
    const driving = DRIVING.has(lane.type);
    const color = driving ? "asphalt" : LANE_COLORS[lane.type] || "other";
    if (!roads.fills.has(color)) roads.fills.set(color, new Path2D());
    addLine(roads.fills.get(color), left.concat([...right].reverse()));
    roads.fills.get(color).closePath();
    // Lanes in junctions lie on top of each other: lines would only confuse.
    if (!driving || lane.junction) continue;
    addEdges(roads, lane, left, right);
    addArrows(roads.arrows, left, right, lane.dir);
  }
  return roads;
}

/** Draw with a context whose unit is one metre; `pixel` is the size of a pixel in metres. */
function drawRoads(context, roads, pixel) {
  const order = [...roads.fills.keys()].sort((a, b) => (a === "asphalt") - (b === "asphalt"));
  for (const color of order) {
    context.fillStyle = context.strokeStyle = theme[color];
    context.lineWidth = pixel * 0.8; // closes the seams between neighbours
    context.fill(roads.fills.get(color));
    context.stroke(roads.fills.get(color));
  }
  if (pixel > 1.2) return;
  context.strokeStyle = theme.mark;
  context.lineWidth = Math.max(0.15, pixel);
  context.stroke(roads.solid);
  if (pixel > 0.5) return;
  context.setLineDash([3, 6]);
  context.stroke(roads.dashed);
  context.setLineDash([]);
  context.strokeStyle = theme.arrow;
  context.lineWidth = Math.max(0.18, pixel);
  context.stroke(roads.arrows);
  context.fillStyle = theme.mark;
  context.fill(roads.stripes);
}
