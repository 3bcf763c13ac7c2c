"use strict";
// Parallel coordinates: a line for each row, an axis for each parameter and measure that differs.

const MOST_AXES = 9;
const shown = { rows: "", columns: DATA.columns.slice(0, MOST_AXES).map(({ name }) => name) };

function drawRows() {
  const canvas = byId("parallel");
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = width * ratio; canvas.height = height * ratio;
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  const style = getComputedStyle(document.documentElement), color = (name) => style.getPropertyValue(name).trim();
  const columns = DATA.columns.filter(({ name }) => shown.columns.includes(name));
  if (columns.length < 2) return;
  const left = 60, right = width - 60, top = 34, bottom = height - 26;
  const x = (at) => left + (right - left) * at / (columns.length - 1);
  const scales = columns.map(({ values, labels }) => {
    if (labels) return (value) => bottom - (bottom - top) * (labels.length < 2 ? 0.5 : value / (labels.length - 1));
    let low = Infinity, high = -Infinity;
    for (const value of values) if (value !== null) { if (value < low) low = value; if (value > high) high = value; }
    const scale = (value) => (high > low ? bottom - (bottom - top) * (value - low) / (high - low) : (top + bottom) / 2);
    return Object.assign(scale, { low, high });
  });
  const order = [...DATA.good.keys()].sort((a, b) => DATA.good[b] - DATA.good[a]); // failures over all others
  const visible = order.filter((row) => !shown.rows || (shown.rows === "good") === Boolean(DATA.good[row]));
  pen.lineWidth = 1;
  for (const good of [1, 0]) {
    const rows = visible.filter((row) => DATA.good[row] === good);
    pen.globalAlpha = Math.min(1, Math.max(0.035, 60 / Math.max(1, rows.length)));
    if (!good) pen.globalAlpha = Math.min(1, pen.globalAlpha * 3);
    pen.strokeStyle = color(good ? "--good" : "--bad");
    for (const row of rows) {
      pen.beginPath();
      let drawn = false;
      columns.forEach(({ values }, at) => {
        const value = values[row];
        if (value === null) { drawn = false; return; }
        const y = scales[at](value);
        if (drawn) pen.lineTo(x(at), y); else pen.moveTo(x(at), y);
        drawn = true;
      });
      pen.stroke();
    }
  }
  pen.globalAlpha = 1;
  pen.font = "12px system-ui, 'Liberation Sans', Arial, sans-serif";
  pen.textAlign = "center";
  columns.forEach(({ name, labels }, at) => {
    pen.strokeStyle = color("--faint");
    pen.beginPath(); pen.moveTo(x(at), top); pen.lineTo(x(at), bottom); pen.stroke();
    pen.fillStyle = color("--text");
    const room = (right - left) / (columns.length - 1) - 8;
    let text = name;
    while (text.length > 4 && pen.measureText(text).width > room) text = text.slice(0, -2) + "…";
    pen.fillText(text, x(at), 14);
    pen.fillStyle = color("--soft");
    const ends = labels ? [labels[0], labels[labels.length - 1]] : [exact(scales[at].low), exact(scales[at].high)];
    pen.fillText(ends[1], x(at), top - 6);
    pen.fillText(ends[0], x(at), bottom + 16);
  });
}

function startRows() {
  byId("rows-card").hidden = DATA.columns.length < 2;
  const failed = DATA.good.filter((good) => !good).length;
  segments(byId("shown-rows"), [["", `all ${DATA.good.length}`], ["good", `passed ${DATA.good.length - failed}`], ["bad", `failed ${failed}`]],
    (chosen) => { shown.rows = chosen; drawRows(); });
  byId("rows-note").textContent = DATA.good.length < DATA.summary.rows.total ? `${DATA.good.length} of ${DATA.summary.rows.total} rows are drawn, all that failed among them` : "";
  for (const { name } of DATA.columns) {
    const box = element("input", { type: "checkbox", checked: shown.columns.includes(name) });
    box.addEventListener("change", () => {
      shown.columns = box.checked ? [...shown.columns, name] : shown.columns.filter((each) => each !== name);
      drawRows();
    });
    byId("axes").append(element("label", {}, box, ` ${name}`));
  }
  drawRows();
  window.addEventListener("resize", drawRows);
  document.documentElement.dataset.ready = "true";
}
startRows();
