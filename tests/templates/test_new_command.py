"""`mindc new`, as its users call it: what is said, asked, refused, and what lies there afterwards."""

import json
import os
import pty
import subprocess
import sys
from pathlib import Path

import jsonschema
import pytest

from mindlang.templates import robots, tasks
from tests.calling import Call

PROGRAM = (sys.executable, "-c", "from mindlang.cli import main; main()")
NAMES = {"type": "array", "items": {"type": "string"}, "minItems": 1}
LIST_SCHEMA = {
    "type": "object",
    "additionalProperties": False,
    "required": ["robots", "tasks"],
    "properties": {
        noun: {
            "type": "array",
            "minItems": 1,
            "items": {
                "type": "object",
                "additionalProperties": False,
                "required": ["name", "about", other],
                "properties": {"name": {"type": "string"}, "about": {"type": "string"}, other: NAMES},
            },
        }
        for noun, other in (("robots", "tasks"), ("tasks", "robots"))
    },
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder, empty."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def lying(folder: Path) -> list[str]:
    """All that is in a folder and below it, hidden files too."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))


def test_a_folder_is_made(mindc: Call, folder: Path) -> None:
    said = mindc("new", "rover", "--robot", "differential", "--task", "patrol")
    assert (said.code, said.out) == (0, "")
    assert said.err == (
        "rover: a differential robot, and how it learns to patrol\n"
        "  cd rover\n"
        "  mindc train rover.mind --seed 1     # in about a minute\n"
        "  mindc run rover.mind --seed 1 --picture rover.png\n"
        "README.md says how to go on.\n"
    )
    files = [".gitignore", "README.md", "robot.yaml", "rover.mind", "test_rover.py"]
    assert lying(folder) == ["rover", *(f"rover/{name}" for name in files)]


def test_what_is_not_said_goes_together_with_what_is(mindc: Call) -> None:
    assert mindc("new", "a").err.startswith("a: a differential robot, and how it learns to patrol\n")
    assert mindc("new", "b", "--task", "fetch").err.startswith("b: a gripper robot, and how it learns to fetch\n")
    assert mindc("new", "c", "--robot", "photocell").err.startswith("c: a photocell robot, and how it learns to light")


def test_nothing_is_overwritten(mindc: Call, folder: Path) -> None:
    (folder / "rover").mkdir()
    (folder / "rover" / "mine.txt").write_text("mine")
    said = mindc("new", "rover")
    assert (said.code, said.err) == (
        2,
        "rover is there, and not empty: nothing is overwritten.\n  Take another name.\n",
    )
    assert lying(folder) == ["rover", "rover/mine.txt"]


def test_an_empty_folder_is_filled(mindc: Call, folder: Path) -> None:
    (folder / "rover").mkdir()
    assert mindc("new", "rover").code == 0
    assert (folder / "rover" / "rover.mind").is_file()


@pytest.mark.parametrize("what", ["file", "link", "link to nothing"])
def test_what_is_no_folder_stays(mindc: Call, folder: Path, what: str) -> None:
    path = folder / "rover"
    if what == "file":
        path.write_text("mine")
    else:
        (folder / "elsewhere").mkdir()
        path.symlink_to("elsewhere" if what == "link" else "nowhere")
    before = lying(folder)
    said = mindc("new", "rover")
    assert (said.code, said.err) == (2, "rover is there, and is no folder.\n  Take another name.\n")
    assert lying(folder) == before


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("my rover", "Write my_rover instead."),
        ("my-rover", "Write my_rover instead."),
        ("../rover", "Write rover instead."),
        ("/tmp/rover", "Write tmp_rover instead."),
        ("2fast", "Write fast instead."),
        ("rover.mind", "Write rover_mind instead."),
        ("räuber", "Write r_uber instead."),
        ("..", "Write rover, for example."),
        ("机器人", "Write rover, for example."),
        ("_x", "Write x instead."),
    ],
)
def test_a_name_that_is_none(mindc: Call, folder: Path, name: str, hint: str) -> None:
    said = mindc("new", name)
    assert said.code == 2
    assert said.err == (
        f"A project cannot be called {name!r}: a name is letters, digits and _, and begins with a letter.\n  {hint}\n"
    )
    assert lying(folder) == []


def test_a_name_that_is_too_long(mindc: Call) -> None:
    said = mindc("new", "r" * 41)
    assert (said.code, said.err) == (2, "A name has at most 40 characters, this one 41.\n")


def test_no_name(mindc: Call) -> None:
    said = mindc("new")
    assert (said.code, said.err) == (2, "The project has no name.\n  mindc new rover\n")


def test_what_does_not_go_together(mindc: Call, folder: Path) -> None:
    said = mindc("new", "rover", "--robot", "photocell", "--task", "patrol")
    assert said.code == 2
    assert said.err == (
        "patrol needs ranges and bearing, which the robot photocell has not.\n"
        "  patrol goes with --robot differential or car, photocell with --task light.\n"
    )
    assert lying(folder) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--robot", "diferential"), "There is no robot called diferential.\n  Did you mean differential?\n"),
        (("--task", "petrol"), "There is no task called petrol.\n  Did you mean patrol?\n"),
    ],
)
def test_what_there_is_not(mindc: Call, words: tuple[str, ...], message: str) -> None:
    said = mindc("new", "rover", *words)
    assert (said.code, said.err) == (2, message)


def test_a_folder_in_which_nobody_may_write(mindc: Call, monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    def refused(path: Path, *_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "mkdir", refused)
    said = mindc("new", "rover")
    assert (said.code, said.err) == (2, "rover cannot be made: Permission denied.\n")
    assert lying(folder) == []


def test_the_list(mindc: Call) -> None:
    said = mindc("new", "--list")
    assert said.code == 0
    assert max(map(len, said.out.splitlines())) <= 80
    assert all(f"  {name}" in said.out for name in [*robots(), *tasks()])


def test_the_list_as_data(mindc: Call) -> None:
    said = mindc("new", "--list", "--json")
    data = json.loads(said.out)
    jsonschema.validate(data, LIST_SCHEMA)
    assert [robot["name"] for robot in data["robots"]] == [*robots()]
    assert [task["name"] for task in data["tasks"]] == [*tasks()]


def test_json_without_a_list(mindc: Call) -> None:
    said = mindc("new", "rover", "--json")
    assert (said.code, said.err) == (2, "--json goes with --list.\n  mindc new --list --json\n")


def asked(folder: Path, typed: str, *words: str) -> tuple[int, str]:
    """What is said on a terminal on which somebody types, and how it ends."""
    ours, theirs = pty.openpty()
    running = subprocess.Popen([*PROGRAM, "new", *words], stdin=theirs, stdout=theirs, stderr=theirs, cwd=folder)
    os.write(ours, typed.encode())
    code = running.wait()
    os.close(theirs)
    said = b""
    try:
        while part := os.read(ours, 4096):
            said += part
    except OSError:  # nobody has the other end any more
        pass
    os.close(ours)
    return code, said.decode().replace("\r\n", "\n")


def test_on_a_terminal_what_is_not_said_is_asked(folder: Path) -> None:
    code, said = asked(folder, "gripper\ncarrier\n")
    assert code == 0, said
    assert "Which robot?" in said
    assert "carrier: a gripper robot, and how it learns to fetch" in said
    assert (folder / "carrier" / "carrier.mind").is_file()


def test_a_number_and_nothing_answer_as_well(folder: Path) -> None:
    code, said = asked(folder, "9\n1\n\n\n")
    assert code == 0, said
    assert "'9' is not one of" in said
    assert "rover: a differential robot, and how it learns to patrol" in said


def test_what_is_said_is_not_asked(folder: Path) -> None:
    code, said = asked(folder, "", "rover", "--robot", "car", "--task", "follow")
    assert code == 0, said
    assert "?" not in said
