// What is not needed for the first answer of the page is drawn after it, piece by piece.

const waiting = [];
const BETWEEN_PARTS = 30; // ms: longer than a frame, so that the page shows and answers in between

/** Draw parts of the page after the first frame, in this order. */
function drawLater(...parts) {
  waiting.push(...parts);
  setTimeout(drawNext, BETWEEN_PARTS);
}

function drawNext() {
  if (waiting.length) waiting.shift()();
  if (waiting.length) setTimeout(drawNext, BETWEEN_PARTS);
  else document.documentElement.dataset.ready = "true";
}

/** All that is left, at once: a printed page is complete. */
function drawWaiting() {
  while (waiting.length) drawNext();
}
