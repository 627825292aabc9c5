"""Standard streams that are closed, full, broken or of another encoding: no command ends by them."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from mindrun import __main__ as mindrun_main
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy

from mindlang.cli import main as mindc_main
from mindlang.compiler.compile import load
from tests.calling import write_rules
from tests.surroundings.streams import CLOSED, FULL, GONE, Ended, ended

COMMANDS = ["mindc show F", "mindc lint F", "mindrun B --readings R", "mindrun doctor"]
LOG = "attempt,generation,best\n1,1,0.5\n1,2,0.7\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the commands are about."""
    folder = tmp_path_factory.mktemp("streams")
    path = write_rules(folder)
    text = path.read_text().replace("Roam", "Röam").replace(" is rule", "  is rule", 1)
    path.write_text(text.replace("Röam", "Roam"))
    graph = load(path).graph
    assert graph
    write_bundle(folder / "b.bundle", Bundle(Policy(graph, {}), {}))
    (folder / "log.csv").write_text(LOG)
    (folder / "readings").write_text('{"ball_bearing": 0.5, "feeler": [1, 1, 1]}\n' * 300)
    return folder


def called(command: str, folder: Path, **streams: str) -> Ended:
    program, *words = command.split()
    names = {"F": "rules.mind", "L": "log.csv", "B": "b.bundle", "R": "readings"}
    for short, name in names.items():
        words = [word.replace(short, str(folder / name)) if word.startswith(short) else word for word in words]
    main = mindc_main if program == "mindc" else mindrun_main.main
    return ended(main, words, **streams)


@pytest.mark.parametrize("command", COMMANDS)
def test_no_stream_ends_a_command(folder: Path, command: str) -> None:
    fine = called(command, folder)
    assert fine.code in (0, 1, 2)
    assert b"Traceback" not in fine.err
    assert b"failed:" not in fine.err
    for stderr in (CLOSED, FULL, GONE):
        assert called(command, folder, stderr=stderr)[:2] == fine[:2]
    for stdout in (CLOSED, FULL):
        said = called(command, folder, stdout=stdout)
        assert said.code == (fine.code or 1 if fine.out else fine.code)
        assert said.err.startswith(fine.err)
        assert (b"standard output cannot be written: " in said.err) == bool(fine.out)
        assert said.err.count(b"\n") == fine.err.count(b"\n") + bool(fine.out)
    said = called(command, folder, stdout=GONE)
    assert (said.code, said.err) == (fine.code, fine.err), "who has read enough is no reason to fail"
    assert called(command, folder, stdin=CLOSED) == fine
    assert called(command, folder, stdin=CLOSED, stdout=CLOSED, stderr=CLOSED).code in (1, 2, fine.code)


@pytest.mark.parametrize("command", ["mindc show F", "mindrun B --readings R"])
def test_every_encoding_will_do(folder: Path, command: str) -> None:
    fine, said = called(command, folder), called(command, folder, encoding="ascii")
    assert said.code == fine.code
    assert b"Traceback" not in said.err
    assert len(said.err.splitlines()) == len(fine.err.splitlines())
    if "--readings" in command:
        assert said.out == fine.out, "what programs read is UTF-8"
    assert len(said.out.splitlines()) == len(fine.out.splitlines())


def test_json_of_a_name_that_is_no_text_is_json(folder: Path) -> None:
    for encoding in ("utf-8", "ascii"):
        said = ended(mindc_main, ["check", "--json", "caf\udce9.mind"], encoding=encoding)
        assert said.code == 2
        assert json.loads(said.out)["files"][0]["file"] == "caf\udce9.mind"


def test_what_nobody_reads_any_more_is_not_computed(folder: Path) -> None:
    said = called("mindrun B --readings R", folder, stdout=GONE)
    assert (said.code, said.err) == (0, b"")


@pytest.mark.parametrize("redirected", [">&-", ">/dev/full", "2>&-", ">&- 2>&- <&-"])
def test_as_a_shell_does_it(folder: Path, redirected: str) -> None:
    program = "from mindlang.cli import main; main()"
    line = f"exec {sys.executable} -c '{program}' show {folder}/rules.mind {redirected}"
    done = subprocess.run(line, shell=True, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    lost = redirected.startswith(">")
    assert done.returncode == (1 if lost else 0)
    assert done.stderr.count("\n") == (lost and "2>" not in redirected)


def test_the_folder_that_is_gone_is_told(folder: Path, tmp_path: Path) -> None:
    def vanish() -> None:
        here = tmp_path / "here"
        here.mkdir()
        __import__("os").chdir(here)
        here.rmdir()

    for words in (["check", folder / "rules.mind"], ["show", folder / "rules.mind"], ["--help"]):
        assert ended(mindc_main, words, first=vanish).code == 0
        (tmp_path / "here").mkdir(exist_ok=True)
        (tmp_path / "here").rmdir()
    said = ended(mindc_main, ["check", "rules.mind"], first=vanish)
    assert said.code in (1, 2)
    assert said.err == b"the folder in which this was started is gone\n"
