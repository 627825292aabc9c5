"""Every code has an explanation, every explanation a code, and every example is what it is said to be."""

import ast
import re
from pathlib import Path

import pytest

from mindlang.audit import findings
from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.compiler.compile import load
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.parse.explain import common_mistakes
from mindlang.compiler.resolve.curricula import SWITCHES
from mindlang.compiler.source import Source
from mindlang.explaining.article import Article
from mindlang.explaining.collection import ERROR, FINDING
from mindlang.explaining.collection import codes as all_codes
from tests.breakpoints.subjects import subject
from tests.explain.examples import ENVIRONMENTS, write
from tests.project.sources import COMPILER, RUNTIME, modules, nodes

ALL = [each for each in all_codes().values() if each.noun == ERROR]
EMITTERS = {
    "error",
    "refuse",
    "Diagnostic",
    "Flaw",
    "ThingMistake",
    "Misfit",
    "_refuse",
    "refuse_again",
    "refuse_circles",
}
# Codes that are made of words as they are emitted: how, and which these are.
MADE = {
    "f'unknown-{nouns[0]}'": {f"unknown-{noun}" for noun in ("sensor", "actuator", "skill", "task", "scene", "number")},
    "f'unknown-{noun_}'": {"unknown-axis", "unknown-direction", "unknown-side", "unknown-outcome"},
    "f'{word}-differs'": {"tick-differs", "unit-differs"},
    "said.replace(' ', '-')": {f"{key}-{word}" for key, (word, _) in SWITCHES.items()},
}
PASSED_ON = {"code", "mistake.code", "rule.code", "found.code"}  # codes that are made elsewhere
NEEDED = {"no-tick", "no-master", "no-body"}  # in a table of what every mind needs
# What no small mind shows: files that are not there or too many, locks and edits.
FILES = {"unreadable", "use-too-deep", "too-many-mistakes", "faulty-procedure"}
MAPS = {
    *("not-a-file", "unreadable-map", "unreadable-layouts", "ragged-map", "map-too-large", "map-without-floor"),
    *("unknown-letter", "ambiguous-letter", "placed-twice"),
}
SETTINGS = {"unreadable-settings", "unknown-setting", "wrong-setting", "unknown-rule"}
WITHOUT_EXAMPLES = FILES | MAPS | SETTINGS | {"impossible-edit", "damaged-lock", "too-many-things", "too-many-readings"}


def emitted() -> set[str]:
    """The codes of all diagnostics in the sources of the compiler, but for those of a robot.yaml."""
    found: set[str] = set()
    for node in (
        node
        for path in modules(COMPILER, RUNTIME / "kinds", RUNTIME / "sim" / "outside")
        if path.parent != COMPILER / "robot"
        for node in nodes(path)
    ):
        if isinstance(node, ast.Call) and _name(node.func) in EMITTERS and node.args:
            match node.args[0]:
                case ast.Constant(value=str(code)):
                    found |= {code} - {""}  # how many more there are
                case made if ast.unparse(made) in MADE:
                    found |= MADE[ast.unparse(made)]
                case other if isinstance(other, ast.JoinedStr):
                    pytest.fail(f"{ast.unparse(other)} makes codes that this test does not know")
    known = common_mistakes()
    return found | NEEDED | {each.code for each in (*known.openings, *known.lines, *known.stops)}


def _name(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def test_every_code_has_an_explanation_and_no_other_is_explained() -> None:
    codes = [explanation.name for explanation in ALL]
    assert sorted(set(codes)) == sorted(codes)
    assert set(codes) == emitted()


def test_an_explanation_begins_with_a_short_sentence_and_says_what_to_do() -> None:
    for name, explanation in all_codes().items():
        assert explanation.summary.endswith("."), name
        assert len(explanation.summary) <= 80, name
        assert explanation.text, name
        assert explanation.chapter, name
        assert bool(explanation.wrong and explanation.right) == (
            name not in WITHOUT_EXAMPLES and explanation.noun != FINDING
        ), name


def diagnostics(explanation: Article, text: str, folder: Path) -> tuple[Diagnostic, ...]:
    """What is said of an example: a mind, or breakpoints of the small one of tests/breakpoints."""
    if explanation.chapter == ENVIRONMENTS:
        pytest.importorskip("gymnasium")
    if explanation.chapter == "Breakpoints":
        master = "Seek" if explanation.name in ("skill-not-in-run", "unmeasured-reading") else "Go"
        return breakpoints_of(Source("example", text), subject(master)).diagnostics
    return load(write(explanation, text, folder)).diagnostics


@pytest.mark.parametrize("explanation", ALL, ids=lambda each: each.name)
def test_a_wrong_example_gives_just_its_code_and_a_right_one_is_right(explanation: Article, tmp_path: Path) -> None:
    for number, text in enumerate((*explanation.wrong, *explanation.right)):
        (folder := tmp_path / str(number)).mkdir()
        if explanation.name == "no-module" and text in explanation.right:
            (folder / "robot.py").write_text("def avoid():\n    return (0.5,)\n")
        said = [(each.code, each.message) for each in diagnostics(explanation, text, folder)]
        assert [code for code, _ in said] == [explanation.name] * (text in explanation.wrong), (text, said)


def test_every_finding_of_an_audit_is_explained() -> None:
    told = re.findall(r'_warning\("([^"]+)"', Path(findings.__file__).read_text())
    assert set(told) == {each.name for each in all_codes().values() if each.noun == FINDING}


def test_errors_come_before_lint_rules() -> None:
    sorts = [each.noun for each in all_codes().values()]
    assert sorts[: len(ALL)] == [ERROR] * len(ALL)
    assert ERROR not in sorts[len(ALL) :]
