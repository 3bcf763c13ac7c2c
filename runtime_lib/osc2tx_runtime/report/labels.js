// Labels of the actors in the bird's-eye view, scale bar, compass, recent events, collisions.

// ---- labels ------------------------------------------------------------------------------------

const overlap = (a, b) =>
  Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) *
  Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));

/** Places to try around a box: above, below, the sides, then the same further away. */
function* labelPlaces([left, top, right, bottom], width, height) {
  const mx = (left + right) / 2, my = (top + bottom) / 2;
  for (const gap of [6, 30, 54, 78, 102, 126]) {
    for (const [x, y] of [
      [mx - width / 2, top - gap - height], [mx - width / 2, bottom + gap],
      [right + gap, my - height / 2], [left - gap - width, my - height / 2],
      [right, top - gap - height], [left - width, top - gap - height],
      [right, bottom + gap], [left - width, bottom + gap],
    ]) yield [x, y, x + width, y + height];
  }
}

/** The first free place, or the one that covers least. */
function placeLabel(box, width, height, taken, area) {
  let best = null, least = Infinity;
  for (const place of labelPlaces(box, width, height)) {
    const padded = [place[0] - 2, place[1] - 2, place[2] + 2, place[3] + 2];
    const outside = width * height - overlap(place, area);
    const covered = taken.reduce((sum, other) => sum + overlap(padded, other), outside);
    if (covered < least) [best, least] = [place, covered];
    if (least < 0.01) break;
  }
  return best;
}

/** Name and speed of an actor; name and distance from the middle if it is out of sight. */
function labelTexts(actor, time, visible) {
  const name = fitText(actor.name, 150, "600 12px");
  if (!visible) {
    const { x, y } = poseAt(actor, time);
    const [sx, sy] = project(x, y);
    const pixels = Math.hypot(sx - canvas.clientWidth / 2, sy - canvas.clientHeight / 2);
    return [name, format(pixels / camera.scale, 0) + " m"];
  }
  const speed = actor.movable ? columnAt(actor.track, actor.track.v, time) : null;
  return [name, speed === null ? "" : format(speed * 3.6, 0) + " km/h"];
}

/** The point at the edge of the area in the direction of a box outside of it. */
function edgeBox(box, area) {
  const half = [(area[2] - area[0]) / 2, (area[3] - area[1]) / 2];
  const middle = [area[0] + half[0], area[1] + half[1]];
  const dx = (box[0] + box[2]) / 2 - middle[0], dy = (box[1] + box[3]) / 2 - middle[1];
  const share = Math.min(half[0] / Math.max(Math.abs(dx), 1e-9), half[1] / Math.max(Math.abs(dy), 1e-9), 1);
  const x = middle[0] + dx * share, y = middle[1] + dy * share;
  return { box: [x - 2, y - 2, x + 2, y + 2], angle: Math.atan2(dy, dx) };
}

const MAX_POINTED = 12; // in a larger cast, arrows to everything out of sight would only clutter

/** A place for every actor's label, in order of the cast. */
function layoutLabels(time) {
  const area = [4, 4, canvas.clientWidth - 4, canvas.clientHeight - 4];
  const actors = DRAWN();
  const boxes = actors.map((actor) => screenBox(actor, time));
  const crosses = collisionPoints(time).map(([x, y]) => [x - 8, y - 8, x + 8, y + 8]);
  const taken = [...boxes, ...crosses, ...ornaments(time)];
  return actors.flatMap((actor, i) => {
    const visible = overlap(boxes[i], area) > 0;
    if (!visible && actors.length > MAX_POINTED) return [];
    const edge = visible ? null : edgeBox(boxes[i], [12, 12, area[2] - 8, area[3] - 8]);
    const [name, detail] = labelTexts(actor, time, visible);
    const nameWidth = textWidth(name, "600 12px");
    const width = nameWidth + (detail ? textWidth(detail) + 6 : 0) + 14;
    const anchor = visible ? boxes[i] : edge.box;
    const place = placeLabel(anchor, width, 20, taken, area);
    taken.push(place);
    return [{ actor, visible, anchor, edge, place, texts: [name, detail, nameWidth] }];
  });
}

/** Lines first, so that none crosses a label. */
function drawLabels(context, time) {
  const labels = layoutLabels(time);
  for (const { actor, visible, anchor, edge, place } of labels) {
    if (visible) drawLeader(context, actor, anchor, place);
    else drawPointer(context, actor, edge);
  }
  for (const { actor, place, texts } of labels) drawLabel(context, actor, place, texts);
}

/** A small arrow at the edge of the view towards an actor that is out of sight. */
function drawPointer(context, actor, { box, angle }) {
  context.save();
  context.translate(box[0] + 2, box[1] + 2);
  context.rotate(angle);
  context.fillStyle = canvasColor(actor);
  context.fill(new Path2D("M8 0L-4 6L-4 -6Z"));
  context.restore();
}

/** A thin line from a box to a label that is not right beside it. */
function drawLeader(context, actor, box, place) {
  const from = [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
  const to = [clamp(from[0], place[0] + 6, place[2] - 6), place[1] > from[1] ? place[1] : place[3]];
  context.strokeStyle = canvasColor(actor);
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

function drawLabel(context, actor, [left, top, right, bottom], [name, speed, nameWidth]) {
  context.fillStyle = theme.label;
  context.strokeStyle = canvasColor(actor);
  context.lineWidth = 1;
  context.beginPath();
  context.roundRect(left, top, right - left, bottom - top, 5);
  context.fill();
  context.stroke();
  context.textAlign = "left";
  context.textBaseline = "middle";
  const middle = (top + bottom) / 2 + 0.5;
  context.fillStyle = canvasColor(actor);
  context.font = "600 12px " + FONT;
  context.fillText(name, left + 7, middle);
  context.fillStyle = theme.text;
  context.font = "12px " + FONT;
  context.fillText(speed, left + 13 + nameWidth, middle);
}

// ---- ornaments: scale bar, compass, recent events, collisions -----------------------------------

/** What labels must not cover. */
function ornaments(time) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const recent = recentMarks(time).length;
  const fixed = [[0, height - 34, 190, height], [width - 44, height - 50, width, height]];
  return [...fixed, [0, 0, recent ? 330 : 0, 10 + 26 * recent], ...SIGNALS.map(signalBox)];
}

function drawScaleBar(context) {
  const step = niceStep(140 / camera.scale, 1.4);
  const y = canvas.clientHeight - 14, right = 14 + step * camera.scale;
  context.strokeStyle = context.fillStyle = theme.soft;
  context.lineWidth = 1.5;
  context.stroke(new Path2D(`M14 ${y - 5}V${y}H${right}V${y - 5}`));
  context.font = "12px " + FONT;
  context.textAlign = "left";
  context.textBaseline = "alphabetic";
  context.fillText(step + " m", 20, y - 5);
}

/** An arrow along the map's y axis. */
function drawCompass(context) {
  context.save();
  context.translate(canvas.clientWidth - 24, canvas.clientHeight - 26);
  context.rotate(camera.rotation);
  context.fillStyle = theme.soft;
  context.fill(new Path2D("M0 -8L5 6L0 3L-5 6Z"));
  context.font = "600 11px " + FONT;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.translate(0, -15);
  context.rotate(-camera.rotation);
  context.fillText("N", 0, 0);
  context.restore();
}

/** Events and collisions within the last two seconds, at most four. */
const recentMarks = (time) => MARKS.filter((mark) =>
  (mark.kind === "event" || mark.kind === "collision") && mark.t <= time && mark.t > time - 2).slice(-4);

function drawRecent(context, time) {
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.font = "12px " + FONT;
  recentMarks(time).forEach((mark, i) => {
    const name = fitText(mark.name, 220) + "  " + seconds(mark.t), top = 10 + 26 * i;
    context.fillStyle = theme.label;
    context.beginPath();
    context.roundRect(10, top, textWidth(name) + 30, 22, 5);
    context.fill();
    context.fillStyle = mark.kind === "collision" ? theme.bad : theme.accent;
    context.fill(new Path2D(`M21 ${top + 6}l5 5l-5 5l-5 -5Z`));
    context.fillStyle = theme.text;
    context.fillText(name, 32, top + 11.5);
  });
}

/** Where on the screen collisions have happened: between the reference points of the actors. */
function collisionPoints(time) {
  return MARKS.filter((mark) => mark.kind === "collision" && mark.t <= time).flatMap((mark) => {
    const actors = mark.actors.map((id) => mark.run.byId.get(id)).filter((actor) => actor && actor.track);
    const points = actors.map((actor) => poseAt(actor, mark.t)).map(({ x, y }) => [x, y]);
    return points.length ? [project(...extentOf(points).slice(0, 2))] : [];
  });
}

function drawCollisions(context, time) {
  context.strokeStyle = theme.bad;
  context.lineWidth = 3;
  for (const [x, y] of collisionPoints(time)) {
    context.stroke(new Path2D(`M${x - 7} ${y - 7}l14 14m0 -14l-14 14`));
  }
}
