"""What no editor should send: every request is answered all the same, nothing is said on standard error."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.draws import cases
from tests.language.examples import RIGHT
from tests.server.client import Editor, editing, uri

FAR = (-1, -(2**31), 2**31 - 1, 2**31, 2**64, 1e300, 0.5, True, None, "1", [], {})
URIS = (
    *("", "file://", "file:///%00", "file:///a%00b.mind", "file:///dev/zero", "file:///proc/self/mem", "http://x/y"),
    *("untitled:Untitled-1", "file://[::1", "file:///" + "a" * 5000, "\ud800", "file:///%ff%fe", "file:///..", "é"),
)
AT = ("hover", "completion", "definition", "references", "documentHighlight", "prepareRename", "rename")
WHOLE = ("documentSymbol", "formatting")
RAW = (
    (b"{}", -32600),
    (b"[]", -32600),
    (b"null", -32600),
    (b'"a"', -32600),
    (b"1", -32600),
    (b"{", -32700),
    (b"\xff\xfe", -32700),
    (b"[" * 100_000, -32700),
    (b'{"jsonrpc":"1.0","id":1,"method":"shutdown"}', -32600),
    (b'{"jsonrpc":"2.0","id":null,"method":"shutdown"}', -32600),
    (b'{"jsonrpc":"2.0","id":{},"method":"shutdown"}', -32600),
    (b'{"jsonrpc":"2.0","id":7,"method":5}', -32600),
    (b'{"jsonrpc":"2.0"}', -32600),
)


def answered(editor: Editor, message: dict[str, Any]) -> dict[str, Any]:
    """The answer to a request."""
    editor.number += 1
    number = editor.number
    editor._send({"id": number, **message})
    return editor._until(lambda found: found.get("id") == number and "method" not in found)


def asked(question: str, name: object, line: object, character: object) -> dict[str, Any]:
    """A request about a place, with all that any request may have."""
    place = {"line": line, "character": character}
    said = {"textDocument": {"uri": name}, "position": place, "range": {"start": place, "end": place}, "newName": "x"}
    context = {"includeDeclaration": True, "diagnostics": [], "triggerKind": 1}
    options = {"tabSize": 2, "insertSpaces": True}
    return {"method": f"textDocument/{question}", "params": {**said, "context": context, "options": options}}


@pytest.fixture(scope="module")
def editor(tmp_path_factory: pytest.TempPathFactory) -> Any:
    folder = tmp_path_factory.mktemp("malformed").resolve()
    (folder / "right.mind").write_bytes(RIGHT.read_bytes())
    with editing(folder) as found:
        found.open(folder / "right.mind")
        yield found
        assert found.ask("workspace/symbol", {"query": "Seek"})


@pytest.mark.parametrize("question", [*AT, "codeAction"])
def test_any_place_is_answered(editor: Editor, question: str) -> None:
    name = next(iter(editor.texts))
    for line in FAR:
        answer = answered(editor, asked(question, name, line, 0)), answered(editor, asked(question, name, 0, line))
        for each in answer:
            assert each.get("error", {}).get("code") in (None, -32602, -32803), each


@pytest.mark.parametrize("question", [*AT, *WHOLE, "codeAction"])
def test_any_uri_is_answered(editor: Editor, question: str) -> None:
    for name in URIS:
        answer = answered(editor, asked(question, name, 0, 0))
        assert answer.get("error", {}).get("code") != -32603, (name, answer)


@pytest.mark.parametrize(("body", "code"), RAW, ids=lambda value: str(value)[:20])
def test_what_is_no_message_is_refused(editor: Editor, body: bytes, code: int) -> None:
    assert editor.process.stdin
    editor.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
    editor.process.stdin.flush()
    assert editor._until(lambda found: "error" in found)["error"]["code"] == code


@pytest.mark.parametrize(
    "head", [b"Content-Length: -5", b"Content-Length: x", b"Content-Length:", b"Hello: 1", b"x" * 200_000, b"\0"]
)
def test_what_has_no_length_is_refused(editor: Editor, head: bytes) -> None:
    assert editor.process.stdin
    editor.process.stdin.write(head + b'\r\n\r\n{"jsonrpc":"2.0","id":1,"method":"shutdown"}')
    editor.process.stdin.flush()
    assert editor._until(lambda found: "error" in found)["error"]["code"] == -32600


def test_any_writing_of_a_length_is_read(editor: Editor) -> None:
    assert editor.process.stdin
    body = b'{"jsonrpc":"2.0","id":"mine","method":"workspace/symbol","params":{"query":"Seek"}}'
    editor.process.stdin.write(b"\r\nContent-Type: x\r\ncontent-length:%d\r\n\r\n" % len(body) + body)
    editor.process.stdin.flush()
    assert editor._until(lambda found: found.get("id") == "mine")["result"]


def test_what_comes_too_early_or_too_late_is_refused(tmp_path: Path) -> None:
    editor = Editor(tmp_path)
    assert answered(editor, {"method": "initialize", "params": {"capabilities": {}}})["error"]["code"] == -32600
    editor.ask("shutdown", None)
    assert answered(editor, {"method": "workspace/symbol", "params": {"query": ""}})["error"]["code"] == -32600
    editor.tell("exit", None)
    assert editor.process.wait(30) == 0


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=9), inner, max_size=3),
    max_leaves=6,
)
METHODS = (
    *(f"textDocument/{name}" for name in (*AT, *WHOLE, "codeAction", "implementation", "semanticTokens/full")),
    *("workspace/symbol", "workspace/executeCommand", "workspace/diagnostic", "nothing", "", "initialize", "$/x"),
)
KEYS = ("textDocument", "position", "range", "context", "options", "query", "command", "arguments", "jsonrpc")


@settings(
    max_examples=cases(150),
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(st.sampled_from(METHODS), VALUES | st.dictionaries(st.sampled_from(KEYS), VALUES))
def test_any_parameters_are_answered(editor: Editor, method: str, params: Any) -> None:
    assert "Traceback" not in json.dumps(answered(editor, {"method": method, "params": params}))


@pytest.mark.parametrize("arguments", [None, [], [1], [None, "rename", 5], ["file:///x", "rename", {"old": "x"}], {}])
def test_commands_with_any_arguments_are_answered(editor: Editor, arguments: Any) -> None:
    params = {"command": "mind.edit", "arguments": arguments}
    answer = answered(editor, {"method": "workspace/executeCommand", "params": params})
    assert answer.get("error", {}).get("code") != -32603, answer


@pytest.mark.parametrize("method", ["didOpen", "didChange", "didSave", "didClose"])
def test_notifications_of_any_form_end_nothing(editor: Editor, method: str) -> None:
    for name in (*URIS, 5, None):
        document = {"uri": name, "version": 1, "languageId": "mind", "text": "\0\ud800"}
        for changes in ([], [{"text": "x"}], [{"text": 5}], None):
            editor.tell(f"textDocument/{method}", {"textDocument": document, "contentChanges": changes})
    editor.tell(f"textDocument/{method}", [])
    assert editor.ask("workspace/symbol", {"query": "Seek"})


def test_a_text_is_no_larger_than_a_file(tmp_path: Path) -> None:
    path = tmp_path.resolve() / "large.mind"
    with editing(tmp_path) as found:
        found.open(path, "# é\n" * 300_000)
        [one] = found.settle(path)
        assert "is larger than 1 MiB" in one["message"]
        shape = {"textDocument": {"uri": uri(path)}, "options": {"tabSize": 2, "insertSpaces": True}}
        assert found.ask("textDocument/formatting", shape) == []
        found.change(path, RIGHT.read_text(encoding="utf-8"))
        assert all(each["severity"] > 1 for each in found.settle(path))
