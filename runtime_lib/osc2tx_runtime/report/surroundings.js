// Traffic lights, headlights and the weather at the time of the page.

/** The last of some changes [{t, ...}] that is not after a time; undefined before the first. */
function changeAt(changes, time) {
  const index = lastIndex(changes.map((change) => change.t), time + 1e-9);
  return changes[index].t <= time + 1e-9 ? changes[index] : undefined;
}

// Of two runs that are compared, lights and weather are those of the first.
const SURROUNDINGS = RUNS[0].surroundings;
const SIGNALS = SURROUNDINGS.signals;

// ---- traffic lights ----------------------------------------------------------------------------

// From top to bottom, by the number of lamps; boxes with others have one lamp by what they say.
const LAMP_COLORS = { 2: ["red", "green"], 3: ["red", "amber", "green"] };
const STATE_COLORS = new Map([
  ["stop", "red"], ["stop_attention", "amber"], ["attention", "amber"], ["caution", "amber"],
  ["go", "green"], ["go_exclusive", "green"],
]);
const LAMP = { size: 5, gap: 2 };

/** Colours of the lamps that shine; null for a lamp that is dark. */
function lampsOf({ state, lamps }) {
  const colors = LAMP_COLORS[lamps.length];
  if (!colors) return [STATE_COLORS.get(state) || null];
  return lamps.map((lamp, i) => (lamp === "is_off" || lamp === "no_state" ? null : colors[i]));
}

/** Foot on the screen. */
const footOf = (signal) => project(signal.x - ORIGIN[0], signal.y - ORIGIN[1]);

/** The rectangle on the screen that the lamps of a light cover: [left, top, right, bottom]. */
function signalBox(signal) {
  const [x, y] = footOf(signal), half = LAMP.size + LAMP.gap;
  const lamps = lampsOf(signal.changes[0]).length;
  return [x - half, y - 6 - lamps * (2 * LAMP.size + LAMP.gap) - LAMP.gap, x + half, y - 6];
}

/** Boxes of lamps on a stem at their places, of one size however far one looks from. */
function drawSignals(context, time) {
  for (const signal of SIGNALS) {
    const [x, y] = footOf(signal), [left, top, right, bottom] = signalBox(signal);
    const change = changeAt(signal.changes, time);
    const lamps = change ? lampsOf(change) : lampsOf(signal.changes[0]).map(() => null);
    context.strokeStyle = theme.text;
    context.lineWidth = 1.5;
    context.stroke(new Path2D(`M${x} ${y}V${y - 6}M${x - 3} ${y}h6`));
    context.fillStyle = theme["lamp-box"];
    context.beginPath();
    context.roundRect(left, top, right - left, bottom - top, 3);
    context.fill();
    lamps.forEach((color, i) => {
      context.fillStyle = theme["lamp-" + (color || "dark")];
      context.beginPath();
      context.arc(x, top + LAMP.gap + LAMP.size + i * (2 * LAMP.size + LAMP.gap), LAMP.size, 0, 2 * Math.PI);
      context.fill();
    });
    context.font = "11px " + FONT;
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.fillStyle = theme.soft;
    context.fillText(signal.id, right + 3, (top + bottom) / 2);
  }
}

// ---- headlights --------------------------------------------------------------------------------

const BEAMS = new Map([["low_beam", 14], ["high_beam", 30], ["fog", 9]]); // m
const LIGHTS = RUNS.map((run) => new Map(Object.entries(run.surroundings.lights)));

/** Two cones before a box whose lights shine; the context's origin is the reference point. */
function drawBeams(context, actor, time) {
  const changes = LIGHTS[actor.number].get(actor.id);
  const change = changes && changeAt(changes, time);
  const reach = change && BEAMS.get(change.lit);
  if (!reach) return;
  const front = actor.length - actor.rear, half = 0.35 * actor.width;
  context.fillStyle = theme.beam;
  for (const side of [-half, half]) {
    context.beginPath();
    context.moveTo(front, side);
    context.lineTo(front + reach, side - 0.16 * reach);
    context.lineTo(front + reach, side + 0.16 * reach);
    context.fill();
  }
}

// ---- weather -----------------------------------------------------------------------------------

const PER_HOUR = 3600 * 1000; // m/s to mm/h
const degrees = (angle) => format((angle * 180) / Math.PI, 0) + "°";

// Value of the trace to what is written of it; null where it is not worth a word.
const WEATHER = [
  ["rain_intensity", (v) => (v > 0 ? `rain ${format(v * PER_HOUR, 1)} mm/h` : null)],
  ["snow_intensity", (v) => (v > 0 ? `snow ${format(v * PER_HOUR, 1)} mm/h` : null)],
  ["visual_range", (v) => (v < 10000 ? `sight ${format(v, 0)} m` : null)],
  ["cloudiness", (v) => `clouds ${format(v, 0)}/8`],
  ["temperature", (v) => `${format(v - 273.15, 1)} °C`],
  ["wind_speed", (v) => `wind ${format(v * 3.6, 0)} km/h`],
  ["sun_elevation", (v) => (v < 0 ? `sun ${degrees(-v)} below the horizon` : `sun ${degrees(v)} high`)],
  ["moon_elevation", (v) => (v < 0 ? null : `moon ${degrees(v)} high`)],
];

/** All values that hold at a time. */
function weatherAt(time) {
  const past = SURROUNDINGS.weather.filter((change) => change.t <= time + 1e-9);
  return Object.assign({}, ...past.map((change) => change.values));
}

function startWeather() {
  if (!SURROUNDINGS.weather.length) return;
  byId("weather").hidden = false;
  clock.listeners.push((time) => {
    const values = weatherAt(time);
    const texts = WEATHER.flatMap(([name, write]) => (typeof values[name] === "number" ? [write(values[name])] : []));
    byId("weather").textContent = texts.filter((text) => text).join(" · ");
  });
}
