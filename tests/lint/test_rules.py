"""Every rule has nothing to say of the right examples that explain it; of the wrong ones: test_rule_fixes."""

from pathlib import Path

import pytest

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.lint.lint import lint
from mindlang.lint.rules import all_rules
from tests.lint.examples import whole
from tests.lint.more_examples import RULES, good_examples

GOOD = good_examples()


def codes(code: str, text: str, folder: Path) -> list[str]:
    """What a rule finds in an example."""
    main = whole(text, folder)
    compiled = compile_source(Source(str(main), main.read_text(), folder), main)
    assert compiled.graph, [diagnostic.message for diagnostic in compiled.diagnostics]
    return [diagnostic.code for diagnostic in lint(compiled, [code])]


@pytest.mark.parametrize(("code", "text"), GOOD, ids=[code for code, _ in GOOD])
def test_good_examples(code: str, text: str, tmp_path: Path) -> None:
    assert codes(code, text, tmp_path) == []


def test_each_rule_is_explained_by_examples() -> None:
    assert [*RULES] == [*all_rules()]
    for each in RULES.values():
        assert each.right, each.name
        assert each.wrong, each.name
        assert each.summary.endswith(".")
        assert len(each.summary) <= 80
