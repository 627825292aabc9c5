"""What a rule tells of a text, for all tests of rules."""

from pathlib import Path

import pytest

from mindlang.compiler.compile import load
from mindlang.lint.lint import lint
from tests.lint.examples import Tell, Told, whole


@pytest.fixture
def told(tmp_path: Path) -> Tell:
    """What a rule, by its code, tells of a text."""

    def found(code: str, text: str) -> list[Told]:
        compiled = load(whole(text, tmp_path))
        assert compiled.graph, [diagnostic.message for diagnostic in compiled.diagnostics]
        return [
            (each.span.text if each.span else "", each.message, each.hint, *(label.span.text for label in each.labels))
            for each in lint(compiled, [code])
        ]

    return found
