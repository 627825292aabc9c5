// Starts `mindc lsp` and talks with it; asks for the arguments of an edit, and for the names of what it makes.
const fs = require("fs");
const os = require("os");
const vscode = require("vscode");
const { LanguageClient, TransportKind } = require("vscode-languageclient/node");
const { program } = require("./program");

let client;

async function activate(context) {
  context.subscriptions.push(
    vscode.commands.registerCommand("mind.editHierarchy", editHierarchy),
    vscode.commands.registerCommand("mind.restart", restart),
    vscode.workspace.onDidChangeConfiguration((event) => event.affectsConfiguration("mind.path") && restart()),
    vscode.workspace.onDidGrantWorkspaceTrust(restart),
  );
  await start();
}

async function deactivate() {
  await client?.stop();
}

async function restart() {
  await client?.dispose();
  await start();
}

async function start() {
  const command = program(vscode.workspace.getConfiguration("mind").get("path"), {
    folders: (vscode.workspace.workspaceFolders ?? []).map((folder) => folder.uri.fsPath),
    home: os.homedir(),
    isTrusted: vscode.workspace.isTrusted,
    exists: fs.existsSync,
  });
  const server = { command, args: ["lsp"], transport: TransportKind.stdio };
  client = new LanguageClient("mind", "mind", server, {
    documentSelector: [{ language: "mind", scheme: "file" }, { language: "mind", scheme: "untitled" }],
    middleware: { executeCommand: thenRename },
  });
  try {
    await client.start();
  } catch (error) {
    const help = "pip install 'mindlang[lsp]', or say where mindc is: mind.path";
    const choice = await vscode.window.showErrorMessage(`${command} lsp does not start. ${help}`, "Settings");
    if (choice) vscode.commands.executeCommand("workbench.action.openSettings", "mind.path");
  }
}

// An edit answers with the place of a name that it had to invent: let the user give a better one.
async function thenRename(command, args, next) {
  const place = await next(command, args);
  if (command === "mind.edit" && place?.range) {
    const location = client.protocol2CodeConverter.asLocation(place);
    const editor = await vscode.window.showTextDocument(location.uri);
    editor.selection = new vscode.Selection(location.range.start, location.range.start);
    editor.revealRange(location.range);
    await vscode.commands.executeCommand("editor.action.rename");
  }
  return place;
}

// Every edit of `mindc edit`, with all of its arguments and options.
async function editHierarchy() {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== "mind" || !client?.isRunning()) return;
  const edits = await vscode.commands.executeCommand("mind.edits");
  const picks = edits.map((edit) => ({ label: edit.name, detail: edit.text.split("\n")[0], edit }));
  const pick = await vscode.window.showQuickPick(picks, { title: "Edit the hierarchy", matchOnDetail: true });
  const said = pick && (await ask(pick.edit));
  if (said) await vscode.commands.executeCommand("mind.edit", document.uri.toString(), pick.edit.name, said, "");
}

async function ask(edit) {
  const said = {};
  const questions = [
    ...edit.arguments.map((each) => ({ ...each, help: each.many ? "one or more, a comma between" : "", needed: true })),
    ...edit.options,
  ];
  for (const question of questions) {
    const value = await answer(edit, question);
    if (value === undefined) return undefined;
    if (value !== "" && value !== false) said[question.name] = value;
  }
  return said;
}

async function answer(edit, question) {
  const name = question.name.replace(/_$/, "");
  if (typeof question.default === "boolean") {
    const choice = await vscode.window.showQuickPick(["no", "yes"], { title: `${edit.name}: ${question.help}?` });
    return choice && choice === "yes";
  }
  const text = await vscode.window.showInputBox({
    title: `${edit.name}: ${name}`,
    prompt: [question.help, question.needed ? "" : "may be left empty", edit.example].filter(Boolean).join(" · "),
    value: typeof question.default === "string" ? question.default : "",
    validateInput: (value) => (question.needed && !value.trim() ? `${name} is needed` : undefined),
  });
  if (text === undefined || !question.many) return text?.trim();
  const parts = text.split(",").map((part) => part.trim()).filter(Boolean);
  return parts.length ? parts : "";
}

module.exports = { activate, deactivate };
