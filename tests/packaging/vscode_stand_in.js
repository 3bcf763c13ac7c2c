// Activates the bundled extension with a stand-in of the module `vscode`, which exists only in VS Code.
//
//     node vscode_stand_in.js EXTENSION SCENARIO COMMAND...
//
// COMMAND starts osc2tx. Prints what the extension registered and showed, as JSON.

const Module = require("node:module");
const { readFileSync } = require("node:fs");
const { pathToFileURL, fileURLToPath } = require("node:url");

const [extension, scenario, ...command] = process.argv.slice(2);
const seen = { commands: [], diagnostics: {}, shown: {}, reports: [], errors: [], tasks: [] };
const commands = new Map();
const providers = new Map();
const disposable = { dispose() {} };
const event = () => disposable;

/** Anything else of the interface: a class, a function and an object with such members. */
function anything() {
  const known = new Map();
  const made = class {
    constructor(...args) {
      this.args = args;
    }
  };
  return new Proxy(made, {
    get(target, name) {
      if (name in target || typeof name === "symbol" || name === "then") return target[name];
      if (/^on[A-Z]/.test(name)) return event;
      if (/^register|^create/.test(name)) return () => partly(disposable);
      if (!known.has(name)) known.set(name, anything());
      return known.get(name);
    },
    apply: () => undefined,
  });
}

/** An object with some real members. */
function partly(members) {
  return new Proxy(anything(), {
    get: (target, name) => (name in members ? members[name] : target[name]),
  });
}

class Uri {
  constructor(scheme, path) {
    Object.assign(this, { scheme, path, authority: "", query: "", fragment: "" });
  }
  get fsPath() {
    return this.scheme === "file" ? fileURLToPath(this.toString()) : this.path;
  }
  static parse(text) {
    const url = new URL(text);
    return new Uri(url.protocol.slice(0, -1), decodeURIComponent(url.pathname));
  }
  static file(path) {
    return new Uri("file", path);
  }
  static from({ scheme, path }) {
    return new Uri(scheme, path);
  }
  toString() {
    return this.scheme === "file" ? pathToFileURL(this.path).href : `${this.scheme}:${this.path}`;
  }
}

class EventEmitter {
  constructor() {
    this.listeners = [];
    this.event = (listener, self) => {
      this.listeners.push(listener.bind(self));
      return disposable;
    };
  }
  fire(value) {
    this.listeners.forEach((listener) => listener(value));
  }
  dispose() {}
}

class CancellationTokenSource {
  constructor() {
    this.token = { isCancellationRequested: false, onCancellationRequested: event };
  }
  cancel() {}
  dispose() {}
}

class Disposable {
  constructor(work) {
    this.dispose = work;
  }
  static from(...all) {
    return new Disposable(() => all.forEach((each) => each.dispose()));
  }
}

class CodeActionKind {
  constructor(value) {
    this.value = value;
  }
  append(part) {
    return new CodeActionKind(this.value ? `${this.value}.${part}` : part);
  }
}
CodeActionKind.Empty = new CodeActionKind("");

class Position {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
}

class Range {
  constructor(start, end) {
    Object.assign(this, { start, end });
  }
}

class Diagnostic {
  constructor(range, message, severity) {
    Object.assign(this, { range, message, severity });
  }
}

const document = {
  uri: Uri.file(scenario),
  fileName: scenario,
  languageId: "osc2",
  version: 1,
  lineCount: readFileSync(scenario, "utf8").split("\n").length,
  isClosed: false,
  getText: () => readFileSync(scenario, "utf8"),
};

const vscode = partly({
  version: "1.99.0",
  Uri,
  Disposable,
  CodeActionKind,
  EventEmitter,
  CancellationTokenSource,
  Position,
  Range,
  Diagnostic,
  env: partly({ appName: "stand-in", language: "en" }),
  commands: partly({
    registerCommand(name, work) {
      commands.set(name, work);
      seen.commands.push(name);
      return disposable;
    },
  }),
  languages: partly({
    match: (selector, text) => (text.languageId === "osc2" ? 10 : 0),
    setTextDocumentLanguage: async (text) => text,
    createDiagnosticCollection: () => ({
      set(uri, found) {
        seen.diagnostics[uri.toString()] = found.map((each) => each.message.split("\n")[0]);
      },
      dispose() {},
      clear() {},
      delete() {},
    }),
  }),
  workspace: partly({
    workspaceFolders: undefined,
    textDocuments: [document],
    notebookDocuments: [],
    isTrusted: true,
    getConfiguration: () => ({ get: (name, other) => (name === "command" ? command : other) }),
    registerTextDocumentContentProvider(scheme, provider) {
      providers.set(scheme, provider);
      return disposable;
    },
    openTextDocument: async (uri) => {
      const text = providers.get(uri.scheme).provideTextDocumentContent(uri);
      seen.shown[uri.path] = text;
      return { uri, languageId: "plaintext", getText: () => text };
    },
  }),
  tasks: partly({ executeTask: async (task) => seen.tasks.push(task.args[4].args) }),
  window: partly({
    activeTextEditor: { document },
    visibleTextEditors: [],
    tabGroups: { all: [], onDidChangeTabs: event, onDidChangeTabGroups: event },
    createOutputChannel: () => ({ append() {}, appendLine() {}, show() {}, dispose() {} }),
    showTextDocument: async () => undefined,
    showErrorMessage: async (text) => seen.errors.push(text),
    showWarningMessage: async (text) => seen.errors.push(text),
    createWebviewPanel(kind, title) {
      const panel = { title, webview: { html: "" } };
      seen.reports.push(panel);
      return panel;
    },
  }),
});

const load = Module._load;
Module._load = (name, ...more) => (name === "vscode" ? vscode : load(name, ...more));

async function main() {
  const { activate, deactivate } = require(extension);
  await activate({ subscriptions: [] });
  const uri = document.uri.toString();
  for (const name of ["showModule", "showXml", "showTree", "showReport", "run"]) {
    const work = commands.get(`osc2tx.${name}`);
    if (work) await work(uri, undefined);
    else seen.errors.push(`no command osc2tx.${name}`);
  }
  const until = Date.now() + 60_000;
  const wanted = () => uri in seen.diagnostics && "tree.txt" in seen.shown;
  while (!wanted() && Date.now() < until) await new Promise((done) => setTimeout(done, 50));
  await deactivate();
  seen.reports = seen.reports.map((panel) => [panel.title, panel.webview.html.slice(0, 15)]);
  console.log(JSON.stringify(seen));
  process.exit(0);
}

main().catch((error) => {
  console.error(error);
  process.exit(1);
});
