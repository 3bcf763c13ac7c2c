// A session of VS Code in headless Chromium; prints as JSON what its user sees.
// node session.js ADDRESS CHROMIUM: the folder that is open there has `wrong.osc` and `right.osc`.

const { join } = require("node:path");
const { chromium } = require(join(process.env.PACKAGES, "playwright-core"));

const [address, executablePath] = process.argv.slice(2);
const seen = {};

async function openFile(page, name) {
  await page.locator(".explorer-folders-view .label-name", { hasText: name }).dblclick();
  await page.waitForSelector(`.tab.active[data-resource-name="${name}"]`);
}

async function problems(page) {
  await openFile(page, "wrong.osc");
  await page.keyboard.press("Control+Shift+M");
  const rows = page.locator(".markers-panel .monaco-list-row");
  await rows.filter({ hasText: "OSC100" }).first().waitFor();
  seen.problems = await rows.allInnerTexts();
}

/** Applies the first fix at the place of the problem, as `Control+.` and Return do. */
async function fix(page) {
  await page.keyboard.press("F8");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+.");
  const offered = page.locator(".action-widget .action-item, .action-widget .monaco-list-row.action");
  await offered.first().waitFor();
  seen.fixes = await offered.allInnerTexts();
  await page.keyboard.press("Enter");
  await page.locator(".view-line", { hasText: "do parallel:" }).waitFor();
  await page.locator(".markers-panel .message-box-container, .markers-panel", { hasText: "No problems" }).first().waitFor();
}

async function completion(page) {
  await page.keyboard.press("Control+End");
  await page.keyboard.type("        other.cha");
  const offered = page.locator(".suggest-widget .monaco-list-row");
  await offered.filter({ hasText: "change_lane" }).first().waitFor();
  seen.completion = (await offered.allInnerTexts()).map((text) => text.split("\n")[0]);
  await page.keyboard.press("Escape");
}

async function lens(page, title, shown) {
  await page.locator(".codelens-decoration a", { hasText: new RegExp(`^${title}$`) }).first().click();
  await page.locator(".tab.active", { hasText: shown }).waitFor();
}

async function lenses(page) {
  await openFile(page, "right.osc");
  await page.waitForSelector(".codelens-decoration a");
  seen.lenses = await page.locator(".codelens-decoration a").allInnerTexts();
  const text = (part) => page.locator(".view-line", { hasText: part }).first().waitFor();
  await lens(page, "show module", ".py");
  await text("class CutInAtGap(Scenario)");
  await lens(page, "show XML", ".xosc");
  await text("<OpenSCENARIO>");
  await lens(page, "show tree", "tree.txt");
  await text("parallel");
  await lens(page, "show report", "Report of cut_in_at_gap");
  const report = page.frameLocator("iframe.webview").frameLocator("iframe");
  await report.getByText("Success").first().waitFor();
  await page.locator(".codelens-decoration a", { hasText: /^run$/ }).first().click();
  await page.locator(".terminal-wrapper.active, .terminal").first().waitFor();
  seen.shown = await page.locator(".tab .label-name").allInnerTexts();
}

async function main() {
  const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 1600, height: 1000 } });
  page.setDefaultTimeout(120000);
  try {
    await page.goto(address);
    await page.waitForSelector(".explorer-folders-view .label-name");
    for (const step of [problems, fix, completion, lenses]) await step(page);
  } catch (error) {
    seen.error = String(error);
    await page.screenshot({ path: "failed.png" });
  }
  console.log(JSON.stringify(seen));
  await browser.close();
}

main();
