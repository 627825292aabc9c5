"""The shipped minds say nothing that is hardly meant."""

from pathlib import Path

import pytest

from mindlang.compiler.compile import load
from mindlang.lint.lint import lint

FOLDER = Path(__file__).parents[2] / "examples"
MAINS = [*sorted((FOLDER / "collect").glob("*.mind")), FOLDER / "tour/tour.mind", FOLDER / "braitenberg.mind"]


@pytest.mark.parametrize("path", MAINS, ids=lambda path: path.name)
def test_shipped_minds_are_clean(path: Path) -> None:
    compiled = load(path)
    assert compiled.graph
    assert [f"{each.code}: {each.message}" for each in lint(compiled)] == []
