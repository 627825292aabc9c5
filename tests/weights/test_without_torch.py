"""Where PyTorch is not installed, one sentence says what to install."""

import sys

import pytest
from mindrun.errors import MindError

import mindlang.torch


def test_a_sentence_says_which_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [
        each for each in sys.modules if each.split(".")[0] == "torch" or each == "mindlang.weights.torch_skill"
    ]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "torch", None)
    with pytest.raises(MindError, match="needs PyTorch") as error:
        _ = mindlang.torch.Skill
    assert error.value.hint == "pip install 'mindlang[torch]'"
