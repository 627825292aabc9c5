"""What stands above a line in an editor: words that are commands of mindc, which know what they are given."""

from pathlib import Path

import pytest

from mindlang.server.questions import lenses
from mindlang.server.workspace import Workspace
from tests.calling import RULES, Call
from tests.language.examples import EXAMPLES, TOUR
from tests.server.client import editing, uri

LESSONS = """
curriculum School is genetic population 4
  teaches Chase on Chase for 2 generations
  teaches Turn on Chase for 2 generations
  teaches Chase on Roam under Roam for 2 generations
"""
LEARNING = RULES.replace("skill Chase is rule", "skill Chase is mlp hidden 1").replace(" at 3 * ball_bearing - 0.7", "")
MIND = LEARNING.replace(" at 2.3 - 3 * ball_bearing", "") + LESSONS


def seen(path: Path, texts: dict[Path, str] | None = None) -> list[str]:
    """The words above the lines of a file: the line, the title, the words."""
    workspace = Workspace()
    workspace.texts |= texts or {}
    found = lenses(workspace.view(path), path)
    return [f"{lens.span.text} | {lens.title} | {' '.join(lens.words)}" for lens in found]


def test_a_master_a_task_and_a_curriculum(tmp_path: Path) -> None:
    path = tmp_path / "a.mind"
    path.write_text(MIND)
    assert seen(path) == [
        "master Roam | Train what is due | train a.mind",
        "master Roam | Run | run a.mind",
        "master Roam | Bench | bench a.mind",
        "master Roam | View | view a.mind",
        "task Chase in plain | Train Chase | train a.mind Chase",
        "task Chase in plain | Train Turn | train a.mind Turn",
        "task Chase in plain | Run | run a.mind --task Chase",
        "task Chase in plain | Bench | bench a.mind --task Chase",
        "task Chase in plain | View | view a.mind --task Chase",
        "task Roam in arena size 40 | Train Chase | train a.mind Chase",
        "task Roam in arena size 40 | Run | run a.mind --task Roam",
        "task Roam in arena size 40 | Bench | bench a.mind --task Roam",
        "task Roam in arena size 40 | View | view a.mind --task Roam",
        "curriculum School is genetic population 4 | Train what is due | train a.mind --curriculum School",
    ]


def test_what_another_file_uses_is_about_the_mind(tmp_path: Path) -> None:
    """The names are those that the mind knows; the used file's master is ignored."""
    parts, main = tmp_path / "parts.mind", tmp_path / "main.mind"
    head, tasks = RULES[: RULES.index("task Chase")], RULES[RULES.index("task Chase") :]
    main.write_text(f'use "parts.mind" as its\n{head}'.replace("bearing of ball", "bearing of its.ball"))
    parts.write_text(tasks)
    assert seen(parts)[0].endswith("run main.mind --task its.Chase")
    assert [line.rpartition(" | ")[2] for line in seen(main)] == ["run main.mind", "bench main.mind", "view main.mind"]


def test_without_a_task_nothing_can_be_run(tmp_path: Path) -> None:
    path = tmp_path / "a.mind"
    path.write_text(RULES[: RULES.index("task Chase")])
    assert seen(path) == []


def test_what_no_disk_has_is_not_run(tmp_path: Path) -> None:
    path = tmp_path / "a.mind"
    assert seen(path, {path: MIND}) == []


def test_a_mind_with_mistakes_has_them_as_well(tmp_path: Path) -> None:
    path = tmp_path / "a.mind"
    path.write_text(MIND.replace("reads feeler", "reads feelr").replace("lasts 600 ticks", "lasts long"))
    assert "task Roam in arena size 40 | Run | run a.mind --task Roam" in seen(path)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_command_is_one(path: Path) -> None:
    """Its options are known, and its skills, tasks and curricula are the mind's."""
    view = Workspace().view(path.resolve())
    for lens in lenses(view, path.resolve()):
        command, file, *rest = lens.words
        assert command in ("train", "run", "bench", "view")
        assert file == view.main.name
        match rest:
            case ["--task", name]:
                assert name in view.names.of("task")
            case ["--curriculum", name]:
                assert name in view.names.of("curriculum")
            case [name]:
                assert name in view.names.of("skill")
            case more:
                assert not more


@pytest.mark.parametrize("command", ["train", "run", "bench", "view"])
def test_the_options_are_there(command: str, mindc: Call) -> None:
    option = "--curriculum" if command == "train" else "--task"
    assert option in mindc(command, "--help").out


def test_an_editor_gets_them(tmp_path: Path) -> None:
    path = tmp_path.resolve() / "tour.mind"
    for each in TOUR.parent.glob("*"):
        if each.is_file():
            (tmp_path / each.name).write_bytes(each.read_bytes())
    with editing(tmp_path) as editor:
        assert "codeLensProvider" in editor.capabilities
        editor.open(path)
        found = editor.ask("textDocument/codeLens", {"textDocument": {"uri": uri(path)}})
        (run,) = [each for each in found if each["command"]["arguments"][0]["words"][-1:] == ["Avoid"]][1:2]
        assert run["command"]["command"] == "mind.terminal"
        assert run["command"]["arguments"] == [
            {"folder": str(path.parent), "words": ["run", "tour.mind", "--task", "Avoid"]}
        ]
        assert editor.texts[uri(path)].splitlines()[run["range"]["start"]["line"]].startswith("task Avoid")
        assert editor.ask("textDocument/codeLens", {"textDocument": {"uri": "untitled:Untitled-1"}}) == []
