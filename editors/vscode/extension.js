// Starts `mindc lsp` and talks with it; runs mindc in terminals; asks for the arguments of an edit, and for the names of
// what it makes.
const fs = require("fs");
const os = require("os");
const vscode = require("vscode");
const { CloseAction, ErrorAction, LanguageClient, TransportKind } = require("vscode-languageclient/node");
const { notFound, program } = require("./program");
const { COMMANDS, choices, invocation } = require("./terminal");

const HELP = "pip install 'mindlang[lsp]', in the environment of that mindc";
let client;
let mindc;

// Until it has begun it says nothing itself, so that a user gets one message.
class Client extends LanguageClient {
  begun = false;

  error(message, data, shown) {
    super.error(message, data, this.begun && shown);
  }
}

async function activate(context) {
  context.subscriptions.push(
    vscode.commands.registerCommand("mind.editHierarchy", editHierarchy),
    vscode.commands.registerCommand("mind.restart", restart),
    vscode.commands.registerCommand("mind.terminal", inTerminal),
    vscode.commands.registerCommand("mind.train", () => chosen("mind.train")),
    vscode.commands.registerCommand("mind.run", () => chosen("mind.run")),
    vscode.commands.registerCommand("mind.bench", () => chosen("mind.bench")),
    vscode.commands.registerCommand("mind.view", () => chosen("mind.view")),
    vscode.tasks.registerTaskProvider("mind", { provideTasks: () => [], resolveTask: (task) => mindc && taskOf(task.definition) }),
    vscode.workspace.onDidChangeConfiguration((event) => event.affectsConfiguration("mind.path") && restart()),
    vscode.workspace.onDidGrantWorkspaceTrust(restart),
  );
  const environments = (await pythonExtension())?.environments;
  const changed = environments?.onDidChangeActiveEnvironmentPath?.(restart);
  if (changed) context.subscriptions.push(changed);
  await start();
}

async function deactivate() {
  await client?.stop();
}

async function restart() {
  await client?.dispose().catch(() => undefined); // one that never began has nothing to end
  client = undefined;
  await start();
}

async function start() {
  const found = program(vscode.workspace.getConfiguration("mind").get("path"), await world());
  mindc = found.command;
  if (!mindc) return complain(notFound(found.looked));
  const server = { command: mindc, args: ["lsp"], transport: TransportKind.stdio };
  const starting = new Client("mind", "mind", server, {
    documentSelector: [{ language: "mind", scheme: "file" }, { language: "mind", scheme: "untitled" }],
    middleware: { executeCommand: thenRename },
    initializationFailedHandler: () => false,
    errorHandler: {
      error: (...said) => (starting.begun ? usual.error(...said) : { action: ErrorAction.Continue, handled: true }),
      closed: () => (starting.begun ? usual.closed() : { action: CloseAction.DoNotRestart, handled: true }),
    },
  });
  const usual = starting.createDefaultErrorHandler();
  client = starting;
  try {
    await starting.start();
    starting.begun = true;
  } catch {
    await complain(`${mindc} lsp does not start. ${HELP}`);
  }
}

// The one message where nothing serves the editor.
async function complain(message) {
  const choice = await vscode.window.showErrorMessage(message, "Settings", "Try again");
  if (choice === "Settings") await vscode.commands.executeCommand("workbench.action.openSettings", "mind.path");
  if (choice === "Try again") await restart();
}

// All that the search for mindc depends on.
async function world() {
  const folders = (vscode.workspace.workspaceFolders ?? []).map(({ name, uri }) => ({ name, path: uri.fsPath }));
  return {
    folders,
    home: os.homedir(),
    env: process.env,
    isTrusted: vscode.workspace.isTrusted,
    python: (await pythonExtension())?.environments?.getActiveEnvironmentPath?.(vscode.workspace.workspaceFolders?.[0]?.uri)?.path,
    exists: isProgram,
  };
}

function isProgram(file) {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}

// The Python extension, where it is there and works.
async function pythonExtension() {
  try {
    return await vscode.extensions.getExtension("ms-python.python")?.activate();
  } catch {
    return undefined;
  }
}

// A word above a line: mindc in a terminal, on the files as they are in the editor.
async function inTerminal(what) {
  if (!mindc) return start();
  const documents = vscode.workspace.textDocuments.filter((each) => each.languageId === "mind" && !each.isUntitled);
  await Promise.all(documents.filter((each) => each.isDirty).map((each) => each.save()));
  await vscode.tasks.executeTask(taskOf({ type: "mind", ...what }));
}

// Also one that stands in tasks.json.
function taskOf(definition) {
  const { name, command, args, options } = invocation(mindc, definition);
  const task = new vscode.Task(definition, vscode.TaskScope.Workspace, name, "mind", new vscode.ProcessExecution(command, args, options));
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Always, panel: vscode.TaskPanelKind.Dedicated };
  return task;
}

// A command of the palette: which of the words above the lines of this file.
async function chosen(command) {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== "mind" || !client?.isRunning()) return;
  const lenses = await client.sendRequest("textDocument/codeLens", { textDocument: { uri: document.uri.toString() } });
  const picks = choices(lenses, command);
  if (!picks.length) {
    await vscode.window.showInformationMessage(`There is nothing to ${COMMANDS[command]} in this file.`);
    return;
  }
  const pick = picks.length === 1 ? picks[0] : await vscode.window.showQuickPick(picks, { title: `mindc ${COMMANDS[command]}` });
  if (pick) await inTerminal(pick.what);
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
