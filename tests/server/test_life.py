"""The server as a program: how it begins and ends, and that no text and no place bring it down."""

import asyncio
import random
import subprocess
import sys
from pathlib import Path

import pytest

from mindlang.server.server import TYPING_PAUSE_SECONDS, MindServer
from tests.calling import Call
from tests.language.examples import EXAMPLES
from tests.server.client import WAIT, Editor, ServerError, editing, framed, uri

PIECES = (
    " ", "\n", "\r\n", "#", '"', "(", ")", "é", "😀", "\u2028", "skill ", "reads ", "influences ", "use ", " at ",
    " is ", "A+", "1/0", "%", "task ", "teaches ", "rewards ", "when ", " on ", "master ", "for each p in ", "\t",
)  # fmt: skip
QUESTIONS = ("hover", "completion", "definition", "references", "documentHighlight", "prepareRename", "codeAction")


def test_it_ends_as_it_is_told() -> None:
    """The one test of the program: streams, exit codes and a quiet standard error."""
    command = [sys.executable, "-c", "from mindlang.cli import main; main()", "lsp", "--stdio"]
    begin = {"id": 1, "method": "initialize", "params": {"processId": None, "rootUri": None, "capabilities": {}}}
    said = b"".join(map(framed, (begin, {"id": 2, "method": "shutdown"}, {"method": "exit"})))
    polite = subprocess.run(command, input=said, capture_output=True, timeout=WAIT)
    assert (polite.returncode, polite.stderr) == (0, b"")
    assert polite.stdout.count(b"Content-Length: ") == 2
    assert b'"serverInfo"' in polite.stdout


def test_it_ends_when_the_editor_is_rude_or_gone(tmp_path: Path) -> None:
    rude, lost = Editor(tmp_path), Editor(tmp_path)
    rude.tell("exit", None)
    lost.gone()
    assert (rude.ended(), lost.ended()) == (1, 1)


def test_without_pygls_it_says_what_to_do(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindlang.cli._terminal.find_spec", lambda name: None)
    said = mindc("lsp")
    assert said.code == 2
    assert "pip install 'mindlang[lsp]'" in said.err
    assert "Traceback" not in said.err


def test_help_does_not_wait_for_it() -> None:
    code = "import sys, mindlang.cli.lsp; sys.exit('pygls' in sys.modules or 'mindlang.server' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_no_procedure_is_run(tmp_path: Path) -> None:
    tour = next(path for path in EXAMPLES if path.stem == "tour")
    for path in tour.parent.glob("*.mind"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    ran = tmp_path / "ran"
    (tmp_path / "tour.py").write_text(f"open({str(ran)!r}, 'w')\ndef toward(x): return x, x\n")
    path = tmp_path.resolve() / "tour.mind"
    with editing(tmp_path) as editor:
        editor.open(path)
        editor.settle(path)
        editor.ask("textDocument/hover", editor.at(path, "skill Deliver", 7))
        editor.act(editor.actions(path, "skill Deliver"), "Freeze Deliver")
    assert not ran.exists()


def test_who_types_fast_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    server, checked = MindServer(), asyncio.Event()
    checks: list[None] = []

    def check() -> None:
        checks.append(None)
        checked.set()

    async def type_fast() -> None:
        for _ in range(40):
            server.check_soon()
        assert not checks
        await checked.wait()
        await asyncio.sleep(2 * TYPING_PAUSE_SECONDS)

    monkeypatch.setattr(server, "check", check)
    asyncio.run(type_fast())
    assert len(checks) == 1


def test_what_was_typed_fast_is_checked_as_it_is_in_the_end(tmp_path: Path) -> None:
    path = tmp_path.resolve() / "collect.mind"
    text = next(each for each in EXAMPLES if each.stem == "collect").read_text(encoding="utf-8")
    with editing(tmp_path) as editor:
        editor.open(path, text)
        for length in range(1, 41):
            editor.change(path, text + "# " + "x" * length)
        editor.change(path, text + "x")
        assert [each["range"]["start"]["line"] for each in editor.settle(path)] == [text.count("\n")]


def test_no_text_and_no_place_bring_it_down(tmp_path: Path) -> None:
    random_ = random.Random(0)
    for path in EXAMPLES:
        (tmp_path / path.name).write_bytes(path.read_bytes())
    paths = sorted(tmp_path.resolve().glob("*.mind"))
    with editing(tmp_path) as editor:
        for path in random_.sample(paths, 3):
            text = editor.open(path)
            for _ in range(8):
                text = mangled(random_, text)
                editor.change(path, text)
                for question in random_.sample(QUESTIONS, 3):
                    ask(editor, path, question, random_)
                editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri(path)}})
            editor.settle(path)
            shape = {"textDocument": {"uri": uri(path)}, "options": {"tabSize": 2, "insertSpaces": True}}
            editor.apply({"changes": {uri(path): editor.ask("textDocument/formatting", shape)}})


def mangled(random_: random.Random, text: str) -> str:
    """A text with a piece taken out, put in, or said twice."""
    start = random_.randrange(len(text) + 1)
    end = min(len(text), start + random_.choice((0, 1, 5, 40)))
    return text[:start] + random_.choice((*PIECES, "", text[start:end] * 2)) + text[end:]


def ask(editor: Editor, path: Path, question: str, random_: random.Random) -> None:
    """A request at a place that may not be there; only a refusal in words is an error."""
    place = {"line": random_.randrange(200), "character": random_.randrange(60)}
    params = {"textDocument": {"uri": uri(path)}, "position": place, "context": {"includeDeclaration": True}}
    if question == "codeAction":
        end = {"line": place["line"] + random_.randrange(3), "character": random_.randrange(60)}
        params = {**params, "range": {"start": place, "end": end}, "context": {"diagnostics": []}}
    if question == "completion":
        params["context"] = {"triggerKind": 1}
    try:
        editor.ask(f"textDocument/{question}", params)
    except ServerError as error:
        if "has to compile first" not in str(error):
            raise
