"""What is not installed is said in a sentence, with what to do."""

import sys

import pytest
from mindrun.errors import MindError

from mindlang import environments


@pytest.mark.parametrize(
    ("name", "module", "package"),
    [
        ("register", "registration", "gymnasium"),
        ("ParallelTask", "parallel_task", "pettingzoo"),
        ("StableBaselinesEnv", "stable_baselines", "stable_baselines3"),
    ],
)
def test_an_extra_that_is_missing(monkeypatch: pytest.MonkeyPatch, name: str, module: str, package: str) -> None:
    if package != "gymnasium":
        pytest.importorskip("gymnasium")
    for inner in [each for each in sys.modules if each.startswith(f"{package}.")]:
        monkeypatch.delitem(sys.modules, inner)
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.delitem(sys.modules, f"mindlang.environments.{module}", raising=False)
    with pytest.raises(MindError, match=f"{name} needs {package}") as raised:
        getattr(environments, name)
    assert raised.value.hint.startswith("pip install 'mindlang[")


def test_what_is_no_part_of_it() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'Nothing'"):
        environments.Nothing  # noqa: B018


def test_what_is_missing_of_our_own_is_no_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("gymnasium")
    monkeypatch.setitem(sys.modules, "mindlang.environments.episodes", None)
    monkeypatch.delitem(sys.modules, "mindlang.environments.task_env", raising=False)
    with pytest.raises(ModuleNotFoundError, match=r"mindlang\.environments\.episodes"):
        environments.TaskEnv  # noqa: B018
