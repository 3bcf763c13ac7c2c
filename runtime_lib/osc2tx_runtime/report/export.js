// Files that the page offers: CSV of numbers, PNG of pictures.

/** Name of a file: scenario and what is in it. */
const fileName = (what, ending) =>
  `${document.title}-${what}`.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "").toLowerCase() + ending;

function saveBlob(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** A field of CSV (RFC 4180); what a spreadsheet would take for a formula is kept as text. */
function csvField(value) {
  if (typeof value === "number") return String(value);
  const text = value === null || value === undefined ? "" : String(value);
  const safe = /^[=+\-@\t\r]/.test(text) ? "'" + text : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

const csv = (rows) => rows.map((row) => row.map(csvField).join(",") + "\r\n").join("");
const saveCsv = (what, rows) => saveBlob(fileName(what, ".csv"), new Blob([csv(rows)], { type: "text/csv" }));

const savePng = (what, picture) => picture.toBlob((blob) => saveBlob(fileName(what, ".png"), blob));

function saveChartCsv(chart) {
  const series = chart.series.filter(({ name }) => !chart.hidden.has(name));
  const head = ["time (s)", ...series.map(({ name }) => `${name} (${chart.unit})`)];
  saveCsv(chart.title, [head, ...TIMES.map((time, i) => [time, ...series.map(({ y }) => y[i])])]);
}

/** A chart with its title and legend, as one picture. */
function chartPicture(chart) {
  const ratio = window.devicePixelRatio || 1, source = chart.plot.ctx.canvas;
  const series = chart.series.filter(({ name }) => !chart.hidden.has(name));
  const width = source.width / ratio, columns = Math.max(1, Math.floor(width / 200));
  const head = 34 + 18 * Math.ceil(series.length / columns);
  const picture = element("canvas", { width: source.width, height: source.height + head * ratio });
  const context = picture.getContext("2d");
  context.scale(ratio, ratio);
  context.fillStyle = theme.card;
  context.fillRect(0, 0, width, head + source.height / ratio);
  context.fillStyle = theme.text;
  context.font = "600 14px " + FONT;
  context.fillText(`${chart.title} (${chart.unit})`, 10, 20);
  context.font = "12px " + FONT;
  series.forEach(({ name, hue }, i) => {
    const x = 10 + (i % columns) * 200, y = 40 + 18 * Math.floor(i / columns);
    context.fillStyle = theme.colors[hue];
    context.fillRect(x, y - 9, 10, 10);
    context.fillStyle = theme.text;
    context.fillText(fitText(name, 170), x + 16, y);
  });
  context.drawImage(source, 0, head, width, source.height / ratio);
  return picture;
}
