"""Every rule holds its own examples: nothing to say of GOOD, something of BAD."""

from pathlib import Path

import pytest

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.lint.lint import lint
from mindlang.lint.rules import Rule, all_rules
from tests.lint.examples import whole
from tests.lint.more_examples import bad_examples, good_examples

GOOD = good_examples()
BAD = bad_examples()


def codes(rule: Rule, text: str, folder: Path) -> list[str]:
    """What a rule finds in an example."""
    main = whole(text, folder)
    compiled = compile_source(Source(str(main), main.read_text(), folder), main)
    assert compiled.graph, [diagnostic.message for diagnostic in compiled.diagnostics]
    return [diagnostic.code for diagnostic in lint(compiled, [rule.code])]


@pytest.mark.parametrize(("rule", "text"), GOOD, ids=lambda each: getattr(each, "code", ""))
def test_good_examples(rule: Rule, text: str, tmp_path: Path) -> None:
    assert codes(rule, text, tmp_path) == []


@pytest.mark.parametrize(("rule", "text"), BAD, ids=lambda each: getattr(each, "code", ""))
def test_bad_examples(rule: Rule, text: str, tmp_path: Path) -> None:
    assert rule.code in codes(rule, text, tmp_path)


@pytest.mark.parametrize("rule", all_rules().values(), ids=lambda rule: rule.code)
def test_a_rule_explains_itself(rule: Rule) -> None:
    assert rule.good
    assert rule.bad
    title, empty, *_ = [*rule.text.splitlines(), "", ""]
    assert title.endswith(".")
    assert len(title) <= 80
    assert empty == ""
