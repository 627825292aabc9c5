"""What changes files: renames, quick fixes, every edit; and the locks, which follow."""

import re
from contextlib import suppress
from pathlib import Path

import pytest

from mindlang.editing.edits import names
from mindlang.editing.project import EditError
from mindlang.lock import read_lock
from mindlang.lock.status import Trained
from mindlang.server.changing import perform, project
from mindlang.server.proposals import Proposal, Selection, proposals
from mindlang.server.workspace import Workspace
from tests.edits.taught import MIND, statuses, teach, write_mind
from tests.language.examples import EXAMPLES
from tests.server.client import Editor, ServerError, editing, uri

OTHER = 'use "drive.mind"\nmaster Look\n\nskill Look is mlp hidden 1\n  reads eye\n  influences Go\n'


def trained(path: Path) -> set[str]:
    return {skill for skill, state in statuses(path).items() if isinstance(state, Trained)}


def rename(editor: Editor, path: Path, place: str, after: int, new: str) -> None:
    editor.apply(editor.ask("textDocument/rename", {**editor.at(path, place, after), "newName": new}))


def test_a_rename_goes_through_all_files_and_the_locks_follow_when_they_are_saved(tmp_path: Path) -> None:
    path, other = write_mind(tmp_path.resolve()), tmp_path.resolve() / "other.mind"
    other.write_text(OTHER, encoding="utf-8")
    teach(path)
    teach(other, "Look")
    before = path.with_suffix(".lock").read_bytes()
    with editing(tmp_path) as editor:
        editor.open(path)
        where = editor.ask("textDocument/prepareRename", editor.at(path, "skill Go", 7))
        assert where["placeholder"] == "Go"
        rename(editor, path, "skill Go", 7, "Come")
        assert "influences Come" in editor.texts[uri(other)]
        assert editor.texts[uri(path)] == MIND.replace("Go", "Come")
        assert "drive.lock" in editor.until_said("follow when the files are saved")
        assert path.with_suffix(".lock").read_bytes() == before
        editor.save(path)
        editor.until_said("has followed")
        editor.save(other)
        editor.settle(path)
        assert trained(path) == {"Come", "Avoid", "Drive"}
        assert trained(other) >= {"Come", "Look"}
        # Taken back and saved, the locks are as they were.
        editor.messages.clear()
        editor.change(path, MIND)
        editor.change(other, OTHER)
        editor.save(path)
        editor.until_said("has followed")
        editor.save(other)
        editor.settle(other)
        assert path.with_suffix(".lock").read_bytes() == before


def test_a_rename_of_what_is_read_and_what_is_typed_besides(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())
    teach(path)
    with editing(tmp_path) as editor:
        editor.open(path)
        rename(editor, path, "sensor eye", 8, "feeler")
        editor.change(path, editor.texts[uri(path)] + "# more\n")
        editor.save(path)
        editor.until_said("has followed")
        assert trained(path) == {"Go", "Avoid", "Drive"}
        assert any("feeler:3" in entry.signature.reads for entry in read_lock(path.with_suffix(".lock")).values())


def test_what_cannot_be_renamed(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())
    with editing(tmp_path) as editor:
        editor.open(path)
        assert editor.ask("textDocument/prepareRename", editor.at(path, "tick 1/60", 1)) is None
        for new, why in (("Avoid", "already a skill"), ("come", "cannot be the name"), ("A b", "cannot be the name")):
            with pytest.raises(ServerError, match=why):
                rename(editor, path, "skill Go", 7, new)


def test_quick_fixes(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())
    with editing(tmp_path) as editor:
        editor.open(path, MIND.replace("reads ball_bearing", "reads ball_baering", 1))
        actions = editor.actions(path, "ball_baering", 3)
        action = next(each for each in actions if each["title"] == "Write ball_bearing")
        assert action["isPreferred"]
        assert action["diagnostics"][0]["code"] == "unknown-sensor"
        editor.apply(action["edit"])
        assert editor.texts[uri(path)] == MIND
        (action,) = editor.actions(path, "sensor charge", 9, only=["quickfix"])
        assert action["title"] == "Remove charge"
        (action,) = editor.actions(path, "tick", only=["source.fixAll"])
        editor.apply(action["edit"])
        assert "sensor charge" not in editor.texts[uri(path)]
        assert editor.actions(path, "tick", only=["source.fixAll"]) == []
        assert editor.actions(path, "tick", only=["source.organizeImports"]) == []


def test_edits_are_made_and_say_what_becomes_of_weights(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())
    teach(path)
    with editing(tmp_path) as editor:
        editor.open(path)
        editor.act(editor.actions(path, "skill Avoid"), "Freeze Avoid")
        assert "  stays frozen\n" in editor.texts[uri(path)]
        editor.act(editor.actions(path, "  stays frozen"), "Let Avoid be taught again")
        assert editor.texts[uri(path)] == MIND
        editor.act(editor.actions(path, "  influences Go"), "Let Drive no longer influence Go")
        assert "Drive is stale" in editor.until_said("Drive is stale")
        editor.change(path, MIND)
        place = editor.act(editor.actions(path, "skill Drive"), "Put a new skill over Drive")
        assert "master NewDrive" in editor.texts[uri(path)]
        line = editor.texts[uri(path)].split("\n")[place["range"]["start"]["line"]]
        assert "NewDrive" in line
        chosen = MIND.index("  influences Grab") - MIND.index("  influences Go")
        editor.change(path, MIND)
        editor.act(editor.actions(path, "  influences Go", chosen - 1), "Put Go and Avoid under a new skill")
        assert "skill NewGo+Avoid is mlp" in editor.texts[uri(path)]


def test_declarations_moved_to_a_new_file(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())
    with editing(tmp_path) as editor:
        editor.open(path)
        length = len(
            "actuator left_wheel is wheel side left neutral 0.5\nactuator right_wheel is wheel side right neutral 0.5"
        )
        editor.act(editor.actions(path, "actuator left_wheel", length), "Move left_wheel and right_wheel to a new file")
        new = path.with_name("actuators.mind")
        assert editor.texts[uri(new)].startswith("actuator left_wheel")
        assert 'use "actuators.mind"' in editor.texts[uri(path)]
        assert not [each for each in editor.settle(path) if each["severity"] == 1]


def test_every_edit_by_its_command(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())

    def command(name: str, *arguments: object) -> object:
        return editor.ask("workspace/executeCommand", {"command": name, "arguments": list(arguments)})

    with editing(tmp_path) as editor:
        editor.open(path)
        known = command("mind.edits")
        assert isinstance(known, list)
        assert [each["name"] for each in known] == names()
        command("mind.edit", uri(path), "integrate", {"skill": "Drive", "reads": ["charge", "mood"]})
        assert "  reads charge\n  reads mood\n" in editor.texts[uri(path)]
        command("mind.edit", uri(path), "connect", {"skill": "Grab", "target": "mood", "at": "0.5"})
        assert "  drives mood at 0.5\n" in editor.texts[uri(path)]
        for wrong in (
            ["explode", {}],
            ["connect", {"skill": "Grab"}],
            ["freeze", {"skill": "No"}],
            ["freeze", {"no": 1}],
        ):
            editor.messages.clear()
            text = editor.texts[uri(path)]
            command("mind.edit", uri(path), *wrong)
            assert editor.messages
            assert editor.texts[uri(path)] == text


def test_an_editor_that_knows_no_more_than_texts(tmp_path: Path) -> None:
    path = write_mind(tmp_path.resolve())
    with editing(tmp_path, capabilities={}) as editor:
        assert not editor.registered
        editor.open(path)
        edit = editor.ask("textDocument/rename", {**editor.at(path, "skill Go", 7), "newName": "Come"})
        assert set(edit) == {"changes"}
        arguments = [uri(path), "split", {"to": "w.mind", "names": ["claw"]}]
        editor.ask("workspace/executeCommand", {"command": "mind.edit", "arguments": arguments})
        assert "cannot make files" in editor.messages[-1]


def test_neighbours_count_as_they_are_in_the_editor(tmp_path: Path) -> None:
    path, other = write_mind(tmp_path.resolve()), tmp_path.resolve() / "other.mind"
    other.write_text(OTHER, encoding="utf-8")
    workspace = Workspace({path: MIND, other: "# above\n" + OTHER.replace("influences Go", "influences Avoid")})
    outcome = perform(workspace, path, "rename", {"old": "Go", "new": "Come", "noun": "skill"})
    assert {splice.source.path for splice in outcome.change.splices} == {path}
    outcome = perform(workspace, path, "rename", {"old": "Avoid", "new": "Dodge", "noun": "skill"})
    (splice,) = (splice for splice in outcome.change.splices if splice.source.path == other)
    assert workspace.texts[other][splice.start : splice.end] == "Avoid"
    workspace.texts[other] += "\nskill Come is rule\n  drives claw at 1\n"
    with pytest.raises(EditError, match="already a skill called Come"):
        perform(workspace, path, "rename", {"old": "Go", "new": "Come", "noun": "skill"})


def test_what_would_break_a_neighbour_is_refused(tmp_path: Path) -> None:
    path, other = write_mind(tmp_path.resolve()), tmp_path.resolve() / "other.mind"
    other.write_text(OTHER, encoding="utf-8")
    text = MIND.replace("  influences Go\n", "").replace("  teaches Go on Roam for 3 generations\n", "")
    workspace = Workspace({path: text})
    sentence = "After this edit other.mind no longer compiles by itself: There is no skill called Go."
    with pytest.raises(EditError, match=re.escape(sentence)):
        perform(workspace, path, "remove", {"what": ["skill", "Go"]})
    workspace.texts[other] = OTHER.replace("influences Go", "influences Avoid")
    assert perform(workspace, path, "remove", {"what": ["skill", "Go"]}).change.splices


def everywhere(path: Path, text: str) -> tuple[Workspace, list[Proposal]]:
    """The proposals on every line, and for every declaration as a whole, each once."""
    workspace = Workspace({path: text})
    on = project(workspace, workspace.view(path))
    starts = [0, *(place + 1 for place, letter in enumerate(text) if letter == "\n")]
    places = [(start, start) for start in starts]
    places += [(d.header.span.start, d.facts[-1].span.end) for d in on.main.declarations if d.facts]
    found = [each for place in places for each in proposals(Selection(on, path, *place))]
    return workspace, list({(each.edit, repr(each.arguments)): each for each in found}.values())


def test_every_edit_is_proposed_somewhere_and_comes_to_what_compiles(tmp_path: Path) -> None:
    path = tmp_path.resolve() / "drive.mind"
    text = MIND.replace("  influences Grab at 1", "  influences Both at 1\n  influences Grab at 1")
    text += "\nskill Both is mlp hidden 1\n  reads eye\n  influences Go\n  influences Avoid\n\n"
    text += "skill Still is rule\n  drives claw at 0\n  stays frozen\n\nskill Twin is like Go\n"
    text += "sensor beatN is clock period 2 s where N is 7 to 9\n"
    text += "".join(f"sensor pulse{number} is clock period 2 s\n" for number in range(3))
    text += "task Fetch in arena size 40\n  contains ball is item\n  lasts 60 s\n  wants 2 reach of ball\n"
    workspace, found = everywhere(path, text)
    assert {each.edit for each in found} == set(names()) - {"rename", "prune"}  # of what was taught: test_growing.py
    for each in found:
        if each.edit in ("remove", "disconnect"):  # the compiler says why a line is needed
            with suppress(EditError):
                perform(workspace, path, each.edit, each.arguments)
        else:
            perform(workspace, path, each.edit, each.arguments)


@pytest.mark.parametrize("name", ["tour", "like", "lander"])
def test_proposals_for_examples(name: str) -> None:
    """Minds with several files, with skills like others, and without a world of their own."""
    path = next(path for path in EXAMPLES if path.stem == name)
    _, found = everywhere(path, path.read_text(encoding="utf-8"))
    assert "split" in {each.edit for each in found}
