"""Every mistake gets one message: `wrong/NAME.yaml` has one mistake, `wrong/NAME.txt` is what mindc says of it.

After a change of words: UPDATE=1 pytest tests/wiring/test_messages.py, and read the difference.
"""

import os
import re
from pathlib import Path

import pytest
from mindrun.graph.graph import Graph

from mindlang.cli._diagnostic_printer import plain
from mindlang.compiler.compile import load
from mindlang.robot.wire import Checked, load_wiring
from tests.project.sources import COMPILER, ROOT

HERE = Path(__file__).parent
CASES = sorted((HERE / "wrong").glob("*.yaml"))


@pytest.fixture(scope="module")
def graph() -> Graph:
    """The mind that all cases are for."""
    found = load(HERE / "right.mind").graph
    assert found
    return found


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_one_message_for_one_mistake(path: Path, graph: Graph, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(path.parent)
    checked = load_wiring(Path(path.name), graph)
    said = "\n".join(plain(diagnostic) for diagnostic in checked.diagnostics)
    expected = path.with_suffix(".txt")
    if os.environ.get("UPDATE"):
        expected.write_text(said, encoding="utf-8")
    assert said == expected.read_text(encoding="utf-8")
    assert checked.wiring is None
    assert len(checked.diagnostics) == 1
    assert checked.diagnostics[0].hint
    assert checked.diagnostics[0].span


def test_the_wiring_that_the_cases_change_is_right(graph: Graph) -> None:
    assert load_wiring(HERE / "right.yaml", graph).diagnostics == ()


def codes() -> set[str]:
    """The codes of all cases."""
    texts = [path.read_text(encoding="utf-8") for path in (HERE / "wrong").glob("*.txt")]
    return {code for text in texts for code in re.findall(r"\[([a-z-]+)\]$", text, re.MULTILINE)}


def test_every_code_of_the_sources_has_a_case() -> None:
    texts = [path.read_text(encoding="utf-8") for path in (COMPILER / "robot").glob("*.py")]
    told = {code for text in texts for code in re.findall(r'"((?:yaml|no|not|wrong|missing|unknown)-[a-z-]+)"', text)}
    assert told - {"yaml-large"} <= codes()


def test_every_code_is_in_the_documentation() -> None:
    page = (ROOT / "docs" / "robot-yaml.md").read_text(encoding="utf-8")
    assert {code for code in codes() if f"`{code}`" not in page} == set()


def whole(checked: Checked) -> list[tuple[str, int]]:
    """The codes and lines of all that is told."""
    return [(each.code, each.span.line) for each in checked.diagnostics if each.span]


def test_all_mistakes_are_told_in_one_go_and_without_echoes(graph: Graph, tmp_path: Path) -> None:
    text = (HERE / "right.yaml").read_text(encoding="utf-8")
    text = text.replace("  feelers:", "  feeler:").replace("driver: mock", "driver: mok").replace("true", "yes")
    (tmp_path / "robot.yaml").write_text(text.replace("motor: 1", "motor: 3"), encoding="utf-8")
    assert whole(load_wiring(tmp_path / "robot.yaml", graph)) == [
        ("unknown-sensor", 4),
        ("unknown-driver", 16),
        ("out-of-range", 29),
        ("yaml-boolean", 37),
    ]
