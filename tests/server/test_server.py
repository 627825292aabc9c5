"""What the server says of files, asked by an editor over stdio."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.edits.taught import MIND, teach, write_mind
from tests.language.examples import ROOT
from tests.server.client import Editor, ServerError, editing, offset, position, said, uri

PARTS = """tick 1/60 s
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eye is range_finder at 0 30 330 deg
"""
MAIN = """use "parts.mind"
master Go

skill Go is rule
  reads eye
  drives left_wheel at 1
  drives right_wheel at 1

task Roam in plain
  lasts 60 s
  rewards 0.01 * forward per tick
"""


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Editor, Path]]:
    """One server for all questions, with the example tour, and a taught hierarchy."""
    folder = tmp_path_factory.mktemp("minds").resolve()
    shutil.copytree(ROOT / "examples" / "tour", folder / "tour")
    (folder / "tour" / "tour.py").write_text((folder / "tour" / "tour.py").read_text() + "\nraise SystemExit(3)\n")
    (folder / "split").mkdir()
    (folder / "split" / "parts.mind").write_text(PARTS, encoding="utf-8")
    (folder / "split" / "main.mind").write_text(MAIN, encoding="utf-8")
    teach(write_mind(folder), "Go", "Drive")
    with editing(folder) as editor:
        yield editor, folder


@pytest.fixture
def drive(shared: tuple[Editor, Path]) -> Iterator[tuple[Editor, Path]]:
    """The taught hierarchy, open."""
    editor, folder = shared
    editor.open(folder / "drive.mind")
    editor.settle(folder / "drive.mind")
    yield editor, folder / "drive.mind"
    editor.close(folder / "drive.mind")


def codes(found: list[dict]) -> list[str]:
    return [each["code"] for each in found]


def hover(editor: Editor, path: Path, place: str, after: int = 0) -> str:
    found = editor.ask("textDocument/hover", editor.at(path, place, after))
    return found["contents"]["value"] if found else ""


def labels(editor: Editor, path: Path, place: str, after: int) -> list[str]:
    found = editor.ask("textDocument/completion", editor.at(path, place, after))
    return [item["label"] for item in found["items"]]


def test_mistakes_come_and_go_as_one_types(drive) -> None:
    editor, path = drive
    editor.change(path, MIND.replace("reads ball_bearing", "reads ball_baering", 1))
    (found,) = editor.settle(path)
    assert (found["code"], found["severity"], found["source"]) == ("unknown-sensor", 1, "mindc")
    assert said(editor.texts[uri(path)], found["range"]) == "ball_baering"
    assert "Did you mean ball_bearing?" in found["message"]
    editor.change(path, MIND + "skill Go is rule\n")
    assert codes(editor.settle(path)) == ["duplicate-name"]
    (related,) = editor.settle(path)[0]["relatedInformation"]
    assert said(editor.texts[uri(path)], related["location"]["range"]) == "Go"
    editor.change(path, MIND)
    assert "duplicate-name" not in codes(editor.settle(path))


def test_what_is_hardly_meant_is_a_warning_that_fades(drive) -> None:
    editor, path = drive
    found = {each["code"]: each for each in editor.settle(path)}
    assert found["unread-sensor"]["severity"] == 2
    assert found["unread-sensor"]["tags"] == [1]


def test_hover(drive) -> None:
    editor, path = drive
    card = hover(editor, path, "skill Drive", 7)
    for line in ("reads ball_bearing, eye (3)", "influences Go, Avoid, Grab at 1", "the master"):
        assert line in card
    assert "taught elsewhere" in card
    assert "School: teaches Drive on Roam for 3 generations" in card
    assert "place: Drive → Go" in hover(editor, path, "influences Go", 12)
    assert "to the ball" in hover(editor, path, "influences Go", 12)
    assert "untaught" in hover(editor, path, "influences Avoid", 12)
    assert "perceptron" in hover(editor, path, "mlp hidden 1", 1)
    assert "0 to 16" in hover(editor, path, "hidden 1", 1)
    assert "3 readings" in hover(editor, path, "sensor eye", 8)
    assert "read by Avoid, Drive" in hover(editor, path, "sensor eye", 8)
    assert "Distance to" not in hover(editor, path, "reach of ball", 2)
    assert "or robot comes into" in hover(editor, path, "reach of ball", 2)
    assert "in Roam" in hover(editor, path, "contains ball", 10)
    assert "at least 4" in hover(editor, path, "population 8", 3)
    assert "An input" in hover(editor, path, "  reads eye", 4)
    assert hover(editor, path, "# Two skills", 5) == ""


def test_a_second_declaration_of_a_name_has_nothing_to_say(drive) -> None:
    editor, path = drive
    editor.change(path, f"{MIND}\nmemory eye is cell\nskill Go is rule\n  reads eye\n")
    assert [*codes(editor.settle(path))] == ["duplicate-name", "duplicate-name"]
    assert hover(editor, path, "memory eye", 8) == ""
    assert hover(editor, path, "skill Go is rule\n  reads eye", 28)


def test_completion_in_a_line_that_is_being_written(drive) -> None:
    editor, path = drive
    text = MIND.replace("  influences Go\n", "  influences Go\n  reads m\n", 1)
    editor.change(path, text)
    found = editor.ask("textDocument/completion", editor.at(path, "  reads m", 9))["items"]
    mood = next(item for item in found if item["label"] == "mood")
    assert mood["textEdit"]["newText"] == "mood"
    assert said(text, mood["textEdit"]["range"]) == "m"
    editor.change(path, MIND.replace("influences Avoid\n", "influences \n", 1))
    assert len(editor.settle(path)) == 1
    assert labels(editor, path, "influences \n", 11) == ["Avoid"]
    assert "cell" in labels(editor, path, "memory mood is cell", 15)


def test_definition_references_highlights(drive) -> None:
    editor, path = drive
    text = editor.texts[uri(path)]
    (place,) = editor.ask("textDocument/definition", editor.at(path, "influences Avoid", 12))
    assert offset(text, place["range"]["start"]) == text.index("Avoid is mlp")
    where = {**editor.at(path, "skill Go", 6), "context": {"includeDeclaration": True}}
    assert len(editor.ask("textDocument/references", where)) == 3
    where["context"]["includeDeclaration"] = False
    assert len(editor.ask("textDocument/references", where)) == 2
    assert len(editor.ask("textDocument/documentHighlight", editor.at(path, "sensor eye", 8))) == 3
    assert editor.ask("textDocument/definition", editor.at(path, "tick 1/60", 1)) == []


def test_definition_in_other_files(shared) -> None:
    editor, folder = shared
    tour = folder / "tour" / "tour.mind"
    editor.open(tour)
    (place,) = editor.ask("textDocument/definition", editor.at(tour, "tour.toward", 3))
    assert place["uri"] == uri(folder / "tour" / "tour.py")
    assert said((folder / "tour" / "tour.py").read_text(), place["range"]) == "toward"
    (place,) = editor.ask("textDocument/definition", editor.at(tour, '"parts.mind"', 3))
    assert place["uri"] == uri(folder / "tour" / "parts.mind")
    (place,) = editor.ask("textDocument/definition", editor.at(tour, "drives neck", 8))
    assert place["uri"] == uri(folder / "tour" / "parts.mind")
    assert "default: 40" in hover(editor, tour, "patience 30", 2)
    editor.close(tour)


def test_symbols(drive) -> None:
    editor, path = drive
    found = editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri(path)}})
    assert [each["name"] for each in found if each["detail"].startswith("skill")] == ["Go", "Avoid", "Drive", "Grab"]
    roam = next(each for each in found if each["name"] == "Roam")
    assert [each["name"] for each in roam["children"]] == ["ball"]
    assert said(editor.texts[uri(path)], roam["range"]).endswith("reach of ball")
    everywhere = editor.ask("workspace/symbol", {"query": "avd"})
    assert {each["location"]["uri"].rsplit("/", 1)[1] for each in everywhere} == {"drive.mind", "tour.mind"}


def test_formatting(drive) -> None:
    editor, path = drive
    shape = {"textDocument": {"uri": uri(path)}, "options": {"tabSize": 2, "insertSpaces": True}}
    editor.apply({"changes": {uri(path): editor.ask("textDocument/formatting", shape)}})
    tidy = editor.texts[uri(path)]
    editor.change(path, tidy.replace("  reads eye", "reads    eye   #  é😀 ").replace("\n", "\r\n"))
    edits = editor.ask("textDocument/formatting", shape)
    assert len(edits) == 2
    editor.apply({"changes": {uri(path): edits}})
    assert editor.texts[uri(path)] == tidy.replace("  reads eye", "  reads eye  #  é😀").replace("\n", "\r\n")
    assert editor.ask("textDocument/formatting", shape) == []


def test_columns_are_of_utf_16_and_lines_may_end_in_crlf(drive) -> None:
    editor, path = drive
    text = MIND.replace("skill Go is", "skill Go  is").replace("\n", "\r\n").replace("# Two", "# 😀 é Two")
    text = text.replace("tick 1/60 s", "# 😀😀\r\ntick 1/60 s # 😀")
    text = text.replace("  reads eye\r\n", "  reads eyes # 😀 a\r\n", 1)
    editor.change(path, text)
    (found,) = editor.settle(path)
    assert said(text, found["range"]) == "eyes"
    # Nothing but a comment may stand before a word on its line, so columns count in what is not code.
    bad = text.replace("reads eyes # 😀 a", "reads eye 😀 eyes")
    editor.change(path, bad)
    assert said(bad, editor.settle(path)[0]["range"]) == "😀"
    quoted = text.replace("tick", 'use "😀.mind" # 😀\r\ntick', 1)
    editor.change(path, quoted)
    missing = next(each for each in editor.settle(path) if each["code"] == "unreadable-use")
    assert said(quoted, missing["range"]) == '"😀.mind"'


def test_a_used_file_that_is_not_saved_counts_and_alone_it_says_no_nonsense(shared) -> None:
    editor, folder = shared
    main, parts = folder / "split" / "main.mind", folder / "split" / "parts.mind"
    editor.open(parts)
    assert not [each for each in editor.settle(parts) if each["severity"] == 1]
    editor.open(main)
    assert not [each for each in editor.settle(main) if each["severity"] == 1]
    editor.change(parts, PARTS.replace("sensor eye", "sensor look"))
    editor.settle(parts)
    while "unknown-sensor" not in codes(editor.found[uri(main)]["diagnostics"]):
        editor._until(lambda _: True)
    editor.change(parts, PARTS.replace("neutral 0.5", "neutral 5"))
    assert codes(editor.settle(parts)) == ["out-of-range"] * 2
    editor.close(main)
    assert labels(editor, parts, "body Robot is", 14) == ["box", "car", "disc", "holonomic"]
    editor.close(parts)
    while editor.found[uri(parts)]["diagnostics"]:
        editor._until(lambda _: True)


def test_a_file_that_was_never_saved(shared) -> None:
    editor, _ = shared
    document = {"uri": "untitled:Untitled-1", "languageId": "mind", "version": 1, "text": MIND + "reads\n"}
    editor.tell("textDocument/didOpen", {"textDocument": document})
    where = {"textDocument": {"uri": "untitled:Untitled-1"}, "position": position(MIND, MIND.index("Avoid is"))}
    assert "mlp hidden 2" in editor.ask("textDocument/hover", where)["contents"]["value"]
    editor.tell("textDocument/didClose", {"textDocument": {"uri": "untitled:Untitled-1"}})


def test_files_that_change_outside(shared) -> None:
    editor, folder = shared
    main, parts = folder / "split" / "main.mind", folder / "split" / "parts.mind"
    while "workspace/didChangeWatchedFiles" not in editor.registered:
        editor._until(lambda _: True)
    editor.open(main)
    editor.settle(main)
    parts.write_text(PARTS.replace("sensor eye", "sensor look"), encoding="utf-8")
    editor.tell("workspace/didChangeWatchedFiles", {"changes": [{"uri": uri(parts), "type": 2}]})
    while "unknown-sensor" not in codes(editor.found[uri(main)]["diagnostics"]):
        editor._until(lambda _: True)
    parts.write_text(PARTS, encoding="utf-8")
    editor.close(main)


def test_a_procedure_that_cannot_be_what_the_skill_needs_is_a_finding(tmp_path: Path, shared) -> None:
    editor, path = shared[0], tmp_path / "main.mind"
    text = PARTS + MAIN.partition("\n")[2].replace("is rule", "is procedure from turn.by").replace(" at 1", "")
    path.write_text(text)
    (tmp_path / "turn.py").write_text("def by(a, b):\n    return a, b\n")
    editor.open(path)
    found = [each for each in editor.settle(path) if each["code"] == "faulty-procedure"]
    assert len(found) == 1
    assert said(text, found[0]["range"]) == "procedure from turn.by"
    editor.close(path)


def test_a_damaged_lock_is_a_finding(tmp_path: Path, shared) -> None:
    editor, _ = shared
    path = write_mind(tmp_path)
    path.with_suffix(".lock").write_text("rubbish\n", encoding="utf-8")
    editor.open(path)
    (found,) = editor.settle(path)
    assert found["code"] == "damaged-lock"
    assert "damaged" in hover(editor, path, "skill Go", 7)
    with pytest.raises(ServerError, match="damaged"):
        editor.ask("textDocument/rename", {**editor.at(path, "skill Go", 7), "newName": "Come"})
    editor.close(path)


def test_a_broken_file_is_still_of_use(drive) -> None:
    editor, path = drive
    editor.change(path, MIND.replace("skill Avoid is mlp hidden 2", "skill Avoid is blp hidden (", 1) + "\nuse nothing")
    assert set(codes(editor.settle(path))) >= {"quoted-path"}
    assert "reads eye" in hover(editor, path, "skill Avoid", 7)
    assert "range_finder" in hover(editor, path, "range_finder", 3)
    assert len(editor.ask("textDocument/definition", editor.at(path, "influences Avoid", 12))) == 1
    assert labels(editor, path, "influences Grab", 11)
    assert editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri(path)}})
    with pytest.raises(ServerError, match="has to compile first"):
        editor.ask("textDocument/prepareRename", editor.at(path, "skill Go", 7))
    assert [each["title"] for each in editor.actions(path, "skill Go")] == []


def test_an_empty_file(shared) -> None:
    editor, folder = shared
    path = folder / "empty.mind"
    editor.open(path, "")
    assert codes(editor.settle(path)) == ["empty-file"]
    assert "skill" in labels(editor, path, "", 0)
    assert editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri(path)}}) == []
    editor.close(path)


def test_an_editor_may_count_in_bytes(tmp_path: Path) -> None:
    path = tmp_path.resolve() / "a.mind"
    with editing(tmp_path, capabilities={"general": {"positionEncodings": ["utf-8"]}}) as editor:
        assert editor.capabilities["positionEncoding"] == "utf-8"
        editor.open(path, 'use "é😀.mind" é\n')
        (found,) = editor.settle(path)
        assert found["range"]["start"]["character"] == len('use "é😀.mind" '.encode())
