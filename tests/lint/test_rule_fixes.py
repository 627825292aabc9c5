"""What a rule offers to do: the mind compiles afterwards, and the rule has one finding less."""

from pathlib import Path

import pytest

from mindlang.compiler.compile import load
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import spliced
from mindlang.lint.lint import lint
from tests.lint.examples import whole
from tests.lint.more_examples import bad_examples

BAD = bad_examples()


def found(code: str, main: Path) -> list[Diagnostic]:
    compiled = load(main)
    assert compiled.graph, [diagnostic.message for diagnostic in compiled.diagnostics]
    return lint(compiled, [code])


@pytest.mark.parametrize(("code", "text"), BAD, ids=[code for code, _ in BAD])
def test_a_fix_mends_its_finding(code: str, text: str, tmp_path: Path) -> None:
    main = whole(text, tmp_path)
    before = main.read_text()
    diagnostics = found(code, main)
    for fix in (each.fix for each in diagnostics if each.fix):
        main.write_text(spliced(fix.splices[0].source, fix.splices))
        assert len(found(code, main)) < len(diagnostics)
        main.write_text(before)


@pytest.mark.parametrize(("code", "text"), BAD, ids=[code for code, _ in BAD])
def test_findings_are_sentences(code: str, text: str, tmp_path: Path) -> None:
    for each in found(code, whole(text, tmp_path)):
        assert each.message.endswith(".")
        assert each.hint.endswith(".") or ": mindc edit " in each.hint, "a command ends where it is pasted"
