"""A word of a command line that is empty, as a variable is that was never set, is refused whatever it stands for."""

import sys

import pytest
from mindrun.__main__ import main
from mindrun.terminal.arguments import emptiness

from tests.calling import Call


def test_which_word_is_empty_is_said() -> None:
    said = {
        (): "",
        ("run", "a.mind", "--task", "Go"): "",
        ("run", "a.mind", "--sensor", "eyes="): "",
        ("",): "the first word is empty",
        ("run", "\t"): "what stands behind run is empty",
        ("run", "--task= "): "what stands behind --task is empty",
    }
    assert {words: emptiness(words) for words in said} == said


def test_both_programs_refuse_it(
    mindc: Call, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    said = mindc("run", "a.mind", "--task", "")
    assert (said.code, said.out) == (2, "")
    assert said.err == "Error: What stands behind --task is empty.\n  Write something there, or leave it out.\n"
    monkeypatch.setattr(sys, "argv", ["mindrun", "a.bundle", "--master", " "])
    with pytest.raises(SystemExit) as stop:
        main()
    err = "mindrun: what stands behind --master is empty\n  write something there, or leave it out\n"
    assert (stop.value.code, *capsys.readouterr()) == (2, "", err)
