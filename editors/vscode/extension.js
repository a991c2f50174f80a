// The client: starts `garment lsp`, adds the way to the seam partner, and shows the long text of a diagnostic's code.
"use strict";

const vscode = require("vscode");
const { execFile } = require("node:child_process");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");

/** @type {LanguageClient | undefined} */
let client;

/** @returns {string} */
function program() {
  return vscode.workspace.getConfiguration("garment").get("path") || "garment";
}

async function start() {
  const library = vscode.workspace.getConfiguration("garment").get("library");
  const args = library ? ["lsp", "--library", String(library)] : ["lsp"];
  /** @type {import("vscode-languageclient/node").ServerOptions} */
  const server = { command: program(), args, transport: TransportKind.stdio };
  client = new LanguageClient("garment", "Garment", server, {
    documentSelector: [{ language: "garment", scheme: "file" }, { language: "garment", scheme: "untitled" }],
  });
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    const choice = await vscode.window.showErrorMessage(`Cannot start \`${program()} lsp\`: ${error}`, "Settings");
    if (choice) await vscode.commands.executeCommand("workbench.action.openSettings", "garment.path");
  }
}

async function stop() {
  const running = client;
  client = undefined;
  if (running) await running.stop();
}

async function goToSeamPartner() {
  const editor = vscode.window.activeTextEditor;
  if (!editor || !client) return;
  const places = await client.sendRequest("garment/seamPartners", {
    textDocument: { uri: editor.document.uri.toString() },
    position: client.code2ProtocolConverter.asPosition(editor.selection.active),
  });
  const converter = client.protocol2CodeConverter;
  const found = /** @type {import("vscode-languageclient/node").Location[]} */ (places).map((p) => converter.asLocation(p));
  if (found.length === 0) {
    vscode.window.setStatusBarMessage("This edge is sewn to nothing.", 4000);
    return;
  }
  await vscode.commands.executeCommand("editor.action.goToLocations", editor.document.uri, editor.selection.active, found, "goto");
}

/** `garment:explain/G0312`, where a diagnostic's code leads. */
const explanations = {
  /** @param {vscode.Uri} uri @returns {Promise<string>} */
  provideTextDocumentContent(uri) {
    const code = uri.path.replace(/^.*\//, "");
    return new Promise((resolve) => {
      execFile(program(), ["explain", code], (error, out) => resolve(error ? `Cannot explain ${code}: ${error.message}` : out));
    });
  },
};

/** @param {vscode.ExtensionContext} context */
async function activate(context) {
  context.subscriptions.push(
    vscode.workspace.registerTextDocumentContentProvider("garment", explanations),
    vscode.commands.registerCommand("garment.goToSeamPartner", goToSeamPartner),
    vscode.commands.registerCommand("garment.restartServer", async () => {
      await stop();
      await start();
    }),
    vscode.workspace.onDidChangeConfiguration(async (event) => {
      if (!event.affectsConfiguration("garment")) return;
      await stop();
      await start();
    }),
  );
  await start();
}

module.exports = { activate, deactivate: stop };
