"""What a rule says of the wrong examples that explain it, and offers to do: it has one finding less afterwards."""

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
def test_a_wrong_example_is_told_in_sentences_and_mended_by_each_fix(code: str, text: str, tmp_path: Path) -> None:
    main = whole(text, tmp_path)
    before = main.read_text()
    diagnostics = found(code, main)
    assert code in {each.code for each in diagnostics}
    for each in diagnostics:
        assert each.message.endswith(".")
        assert each.hint.endswith(".") or ": mindc edit " in each.hint, "a command ends where it is pasted"
    for fix in (each.fix for each in diagnostics if each.fix):
        main.write_text(spliced(fix.splices[0].source, fix.splices))
        assert len(found(code, main)) < len(diagnostics)
        main.write_text(before)
