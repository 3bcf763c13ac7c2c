"use strict";
// Data, errors and small helpers of all pages. Texts of the trace reach a page through textContent
// only.

const byId = (id) => document.getElementById(id);
const DATA = JSON.parse(byId("run-data").textContent);

// ---- errors: shown on the page and readable in the DOM -----------------------------------------

function showError(message) {
  document.documentElement.dataset.error = message;
  byId("error").hidden = false;
  byId("error").textContent = "The page could not be drawn completely: " + message;
}
window.addEventListener("error", (event) => showError(String(event.message)));

// ---- small helpers -----------------------------------------------------------------------------

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
const mix = (a, b, share) => (a === null || b === null ? a : a + (b - a) * share);

/** Make an HTML element: element("td", {className: "x"}, "text", child...). */
function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** A number with fixed decimals and a true minus sign; a dash where there is none. */
function format(value, digits) {
  if (value === null || value === undefined) return "–";
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

/** Parameters in the units of the scenario: `v_hero = 60 kph`. A trace has nine digits, so seven hold. */
function parametersText({ parameters, units }) {
  const shown = ([name, value]) => {
    const unit = (units || {})[name];
    if (!unit || typeof value !== "number" || !unit.factor) return `${name} = ${value}`;
    return `${name} = ${Number(((value - unit.offset) / unit.factor).toPrecision(7))} ${unit.name}`;
  };
  return Object.entries(parameters || {}).map(shown).join(", ");
}

const seconds = (time) => format(time, 2) + " s";

/** Index of the last entry of a sorted list that is not after `value` (0 if all are). */
function lastIndex(list, value) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= value) low = middle + 1; else high = middle;
  }
  return Math.max(low - 1, 0);
}

/** A row of buttons of which one is pressed. */
function segments(host, choices, onPick, first = choices[0][0]) {
  const buttons = choices.map(([value, text]) => {
    const button = element("button", { type: "button", textContent: text });
    button.addEventListener("click", () => { press(value); onPick(value); });
    return [value, button];
  });
  const press = (chosen) =>
    buttons.forEach(([value, button]) => button.setAttribute("aria-pressed", value === chosen));
  host.append(...buttons.map(([, button]) => button));
  press(first);
}
