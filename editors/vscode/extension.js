// Starts the language server, and runs or shows the scenario of a code lens.

const vscode = require("vscode");
const { execFile } = require("node:child_process");
const { mkdtemp, readFile, rm } = require("node:fs/promises");
const { tmpdir } = require("node:os");
const { join } = require("node:path");
const { promisify } = require("node:util");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

const LANGUAGE = "osc2";
const SHOWN = "osc2tx-shown"; // scheme of generated texts, which are not files

let client;
const shown = new Map();

/** Returns the command line of osc2tx with more arguments. */
function commandLine(...more) {
  const [program, ...first] = vscode.workspace.getConfiguration("osc2tx").get("command");
  return [program, [...first, ...more]];
}

function startServer() {
  const [command, args] = commandLine("lsp");
  client = new LanguageClient(
    "osc2tx",
    "osc2tx",
    { command, args, transport: TransportKind.stdio },
    { documentSelector: [{ language: LANGUAGE }], middleware: { executeCommand: onCommand } },
  );
  return client.start().catch((error) => {
    vscode.window.showErrorMessage(
      `osc2tx does not start: ${error.message}. Install it with: pip install "osc2tx[lsp]"`,
    );
  });
}

// The server has these commands too; the extension asks it by `ask`.
function onCommand(command, args, next) {
  return command.startsWith("osc2tx.show") ? show(command, args) : next(command, args);
}

function ask(command, args) {
  return client.sendRequest("workspace/executeCommand", { command, arguments: args });
}

/** Shows a text beside the editor. */
async function open(name, language, text) {
  const uri = vscode.Uri.from({ scheme: SHOWN, path: name });
  shown.set(uri.toString(), text);
  const document = await vscode.workspace.openTextDocument(uri);
  await vscode.languages.setTextDocumentLanguage(document, language);
  await vscode.window.showTextDocument(document, vscode.ViewColumn.Beside, true);
}

function here() {
  const editor = vscode.window.activeTextEditor;
  return editor ? [editor.document.uri.toString()] : [];
}

async function show(command, args) {
  const [uri, scenario] = args.length ? args : here();
  if (!uri) return;
  const stem = vscode.Uri.parse(uri).path.split("/").pop().replace(/\.osc$/, "");
  const name = scenario ? `${stem}-${scenario}` : stem;
  const isXml = command === "osc2tx.showXml";
  const text = await ask(command, [uri, scenario ?? ""]);
  if (text) await open(`${name}.${isXml ? "xosc" : "py"}`, isXml ? "xml" : "python", text);
  else vscode.window.showWarningMessage("There is none: see the problems of the file.");
}

function showTree(uri) {
  const path = vscode.Uri.parse(uri ?? here()[0]).fsPath;
  const [program, args] = commandLine("tree", path);
  execFile(program, args, (error, out, err) => open("tree.txt", "plaintext", out || err));
}

/** Runs a scenario and shows the report of the run; its charts are scripts of the page. */
async function showReport(uri, scenario) {
  const path = vscode.Uri.parse(uri ?? here()[0]).fsPath;
  const more = scenario ? ["--scenario", scenario] : [];
  const folder = await mkdtemp(join(tmpdir(), "osc2tx-"));
  const file = join(folder, "report.html");
  try {
    const [program, args] = commandLine("run", path, ...more, "--report", file);
    // A run that fails has a report too; one that does not start has none.
    const ended = await promisify(execFile)(program, args).catch((error) => error);
    const html = await readFile(file, "utf8").catch(() => undefined);
    if (html === undefined) {
      vscode.window.showErrorMessage(ended.stderr || String(ended));
      return;
    }
    const panel = vscode.window.createWebviewPanel(
      "osc2tx.report", `Report of ${scenario ?? path.split(/[\\/]/).pop()}`,
      vscode.ViewColumn.Beside, { enableScripts: true },
    );
    panel.webview.html = html;
  } finally {
    await rm(folder, { recursive: true });
  }
}

/** Runs a scenario in a terminal; its arguments are passed as they are, not through a shell. */
function run(uri, scenario) {
  const path = vscode.Uri.parse(uri ?? here()[0]).fsPath;
  const more = scenario ? ["--scenario", scenario] : [];
  const [program, args] = commandLine("run", path, ...more);
  const execution = new vscode.ProcessExecution(program, args);
  const task = new vscode.Task(
    { type: "osc2tx" }, vscode.TaskScope.Workspace, "run", "osc2tx", execution, "$osc2tx",
  );
  return vscode.tasks.executeTask(task);
}

// Others use the suffix as well: a text that begins like XML is one.
function giveBack(document) {
  if (document.languageId === LANGUAGE && /^\uFEFF?\s*</.test(document.getText())) {
    vscode.languages.setTextDocumentLanguage(document, "xml");
  }
}

function activate(context) {
  vscode.workspace.textDocuments.forEach(giveBack);
  context.subscriptions.push(
    vscode.workspace.onDidOpenTextDocument(giveBack),
    vscode.workspace.registerTextDocumentContentProvider(SHOWN, {
      provideTextDocumentContent: (uri) => shown.get(uri.toString()),
    }),
    vscode.commands.registerCommand("osc2tx.run", run),
    vscode.commands.registerCommand("osc2tx.showTree", showTree),
    vscode.commands.registerCommand("osc2tx.showReport", showReport),
    vscode.commands.registerCommand("osc2tx.restart", () => client.restart()),
  );
  return startServer();
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
