"""A small editor: JSON-RPC over the streams of a server in a thread, documents, and edits applied to them.

It counts columns on its own, in UTF-16, and knows nothing of how the server does.
"""

import json
import logging
import os
import re
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from queue import Empty, Queue
from typing import Any

from mindlang.server.serve import serve

WAIT = 300
CAPABILITIES = {
    "workspace": {
        "applyEdit": True,
        "workspaceEdit": {"documentChanges": True, "resourceOperations": ["create", "rename", "delete"]},
        "didChangeWatchedFiles": {"dynamicRegistration": True},
    }
}


class ServerError(Exception):
    """An error that the server answers with."""


class Editor:
    """A client with open documents."""

    def __init__(self, folder: Path, capabilities: dict[str, Any] = CAPABILITIES) -> None:
        questions, answers = os.pipe(), os.pipe()
        self.output, self.input = os.fdopen(questions[1], "wb"), os.fdopen(answers[0], "rb")
        self.code: int | None = None
        self.server = self._begin(lambda: self._serve(questions[0], answers[1]))
        self.inbox: Queue[dict[str, Any]] = Queue()
        self.texts: dict[str, str] = {}
        self.versions: dict[str, int] = {}
        self.found: dict[str, dict[str, Any]] = {}
        self.messages: list[str] = []
        self.registered: list[str] = []
        self.number = 0
        self.reader = self._begin(self._read)
        self.capabilities = self.ask(
            "initialize", {"processId": None, "rootUri": uri(folder), "capabilities": capabilities}
        )["capabilities"]
        self.tell("initialized", {})

    @staticmethod
    def _begin(work: Callable[[], None]) -> threading.Thread:
        thread = threading.Thread(target=work, daemon=True)
        thread.start()
        return thread

    def _serve(self, questions: int, answers: int) -> None:
        with os.fdopen(questions, "rb") as read, os.fdopen(answers, "wb") as written:
            self.code = serve(read, written)

    # Messages.

    def tell(self, method: str, params: Any) -> None:
        """A notification."""
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: Any) -> Any:
        """A request; what the server sends meanwhile is taken care of."""
        self.number += 1
        number = self.number
        self._send({"id": number, "method": method, "params": params})
        message = self._until(lambda message: message.get("id") == number and "method" not in message)
        if "error" in message:
            raise ServerError(message["error"]["message"])
        return message["result"]

    def settle(self, path: Path) -> list[dict[str, Any]]:
        """The diagnostics of a file in its present version."""
        name, version = uri(path), self.versions[uri(path)]
        if self.found.get(name, {}).get("version") != version:
            self._until(lambda _: self.found.get(name, {}).get("version") == version)
        return self.found[name]["diagnostics"]

    def until_said(self, part: str) -> str:
        """The first message to the user that has this part."""
        while not any(part in message for message in self.messages):
            self._until(lambda _: True)
        return next(message for message in self.messages if part in message)

    def _until(self, is_it: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        while True:
            try:
                message = self.inbox.get(timeout=WAIT)
            except Empty:
                raise AssertionError("the server says nothing more") from None
            self._take(message)
            if is_it(message):
                return message

    def _take(self, message: dict[str, Any]) -> None:
        match message.get("method"):
            case "textDocument/publishDiagnostics":
                self.found[message["params"]["uri"]] = message["params"]
            case "window/showMessage":
                self.messages.append(message["params"]["message"])
            case "workspace/applyEdit":
                self.apply(message["params"]["edit"])
                self._send({"id": message["id"], "result": {"applied": True}})
            case "client/registerCapability":
                self.registered += [each["method"] for each in message["params"]["registrations"]]
                self._send({"id": message["id"], "result": None})
            case str() if "id" in message:
                self._send({"id": message["id"], "result": None})

    def _send(self, message: dict[str, Any]) -> None:
        self.output.write(framed(message))
        self.output.flush()

    def _read(self) -> None:
        while head := self.input.readline():
            length = int(head.split(b":")[1])
            while self.input.readline().strip():
                pass
            self.inbox.put(json.loads(self.input.read(length)))
        self.input.close()

    # Documents.

    def open(self, path: Path, text: str | None = None) -> str:
        """A file opened, with a text of its own where one is given."""
        self.texts[uri(path)] = path.read_bytes().decode() if text is None else text
        self.versions[uri(path)] = 1
        document = {"uri": uri(path), "languageId": "mind", "version": 1, "text": self.texts[uri(path)]}
        self.tell("textDocument/didOpen", {"textDocument": document})
        return self.texts[uri(path)]

    def change(self, path: Path, text: str) -> None:
        """Another text."""
        self.texts[uri(path)] = text
        self.versions[uri(path)] += 1
        document = {"uri": uri(path), "version": self.versions[uri(path)]}
        self.tell("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})

    def save(self, path: Path) -> None:
        """The text written to the disk."""
        path.write_bytes(self.texts[uri(path)].encode())
        self.tell("textDocument/didSave", {"textDocument": {"uri": uri(path)}})

    def close(self, path: Path) -> None:
        """No longer open."""
        self.texts.pop(uri(path))
        self.versions.pop(uri(path))
        self.tell("textDocument/didClose", {"textDocument": {"uri": uri(path)}})

    def apply(self, edit: dict[str, Any]) -> None:
        """An edit of the workspace made: open files stay open and unsaved, others are opened."""
        for name, edits in edit.get("changes", {}).items():
            self._edit(name, edits)
        for change in edit.get("documentChanges", []):
            if change.get("kind") == "create":
                path_of(change["uri"]).touch(exist_ok=False)
            else:
                document = change["textDocument"]
                assert document["version"] in (None, self.versions.get(document["uri"]))
                self._edit(document["uri"], change["edits"])

    def _edit(self, name: str, edits: list[dict[str, Any]]) -> None:
        path = path_of(name)
        if name not in self.texts:
            self.open(path)
        self.change(path, edited(self.texts[name], edits))

    # Questions.

    def at(self, path: Path, place: str, after: int = 0) -> dict[str, Any]:
        """Where a piece of text stands in a file, or so many characters behind its beginning."""
        text = self.texts[uri(path)]
        assert place in text, place
        return {"textDocument": {"uri": uri(path)}, "position": position(text, text.index(place) + after)}

    def actions(self, path: Path, place: str, length: int = 0, **context: Any) -> list[dict[str, Any]]:
        """The code actions at a selection."""
        text = self.texts[uri(path)]
        start = text.index(place)
        where = {"start": position(text, start), "end": position(text, start + length)}
        params = {"textDocument": {"uri": uri(path)}, "range": where, "context": {"diagnostics": [], **context}}
        return self.ask("textDocument/codeAction", params)

    def act(self, actions: list[dict[str, Any]], title: str) -> Any:
        """The action of a title, chosen."""
        action = next((each for each in actions if each["title"] == title), None)
        assert action, [each["title"] for each in actions]
        if "edit" in action:
            self.apply(action["edit"])
        if command := action.get("command"):
            return self.ask(
                "workspace/executeCommand", {"command": command["command"], "arguments": command["arguments"]}
            )
        return None

    def end(self) -> int | None:
        """The server told to stop; how it ends."""
        self.ask("shutdown", None)
        self.tell("exit", None)
        return self.ended()

    def ended(self) -> int | None:
        """How the server ends: its exit code."""
        self.server.join(WAIT)
        self.gone()
        self.reader.join(WAIT)
        return self.code

    def gone(self) -> None:
        """The editor is gone, as if it had crashed."""
        with suppress(BrokenPipeError):
            self.output.close()


def framed(message: dict[str, Any]) -> bytes:
    """A message as it is sent."""
    body = json.dumps({"jsonrpc": "2.0", **message}).encode()
    return b"Content-Length: %d\r\n\r\n" % len(body) + body


def uri(path: Path) -> str:
    return path.as_uri()


def path_of(name: str) -> Path:
    from urllib.parse import unquote, urlparse

    return Path(unquote(urlparse(name).path))


def position(text: str, offset: int) -> dict[str, int]:
    """An offset as the protocol says it, from the bytes of UTF-16."""
    lines = re.split(r"\r\n|\n|\r", text[:offset])
    return {"line": len(lines) - 1, "character": len(lines[-1].encode("utf-16-le")) // 2}


def offset(text: str, place: dict[str, int]) -> int:
    """The offset of a place of the protocol."""
    starts = [0, *(found.end() for found in re.finditer(r"\r\n|\n|\r", text))]
    start = starts[place["line"]]
    units = text[start:].encode("utf-16-le")[: 2 * place["character"]]
    return start + len(units.decode("utf-16-le"))


def edited(text: str, edits: list[dict[str, Any]]) -> str:
    """A text with edits made, none of which overlap."""
    spots = [(offset(text, e["range"]["start"]), offset(text, e["range"]["end"]), e["newText"]) for e in edits]
    for start, end, new in sorted(spots, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def said(text: str, place: dict[str, Any]) -> str:
    """What stands in a range."""
    return text[offset(text, place["start"]) : offset(text, place["end"])]


class Heard(logging.Handler):
    """Keeps what the server would write into the log of an editor."""

    def __init__(self) -> None:
        super().__init__(logging.ERROR)
        self.said: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a record."""
        self.said.append(self.format(record))


@contextmanager
def editing(folder: Path, **more: Any) -> Iterator[Editor]:
    """An editor at work, whose server finds no fault in itself and ends well."""
    heard, log = Heard(), logging.getLogger("pygls")
    log.addHandler(heard)
    editor = Editor(folder, **more)
    try:
        yield editor
        assert editor.end() == 0
        assert not heard.said
    finally:
        editor.gone()
        log.removeHandler(heard)
