"""Random edits of random minds: what they may change, what they must keep, and that their reverse brings it back."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, event, given, settings
from hypothesis import strategies as st

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source
from mindlang.compiler.syntax import Influences
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits import edit, names
from mindlang.editing.project import EditError, Project
from tests.edits.sensors import SENSORS
from tests.edits.sources import ACTUATORS, LIKE, MAIN, PARTS, SKILLS, Texts, minds

OFTEN, SELDOM = 5000, 15  # cases of each test in the slow suite, and in the other
FREE = ("New", "Go+New", "Roam", "Over")
WORDS = (
    *SKILLS,
    LIKE,
    *FREE,
    *ACTUATORS,
    *SENSORS,
    "fresh",
    "ball",
    "rock",
    "p",
    "forward",
    "School",
    "Robot",
    "9",
    "Ä b",
    "",
)
NOUNS = ("", "skill", "task", "sensor", "actuator", "memory", "thing", "curriculum", "body")
FACTS = (
    "reads charge",
    "reads eye",
    "drives claw at 1",
    "influences Go at 1/2",
    "counts collision",
    "stays frozen",
    "x y",
)
DECLARED = (
    ("sensor fresh is battery",), ("skill New is rule", "drives claw at 1"), ("task Roam in plain", "lasts 9 s"),
    ("actuator fresh is servo neutral 0",), ("skill New is mlp", "reads no", "drives claw"), ("memory fresh is cell",),
    ("task Roam in plain", "contains ball is item", "lasts 9 s", "rewards forward per tick"),
)  # fmt: skip
KEEPING = ("add", "connect", "encapsulate", "freeze", "integrate", "rename", "replace")  # take no line away


@dataclass(frozen=True, slots=True)
class Asked:
    """An edit as it is asked for."""

    name: str
    said: dict[str, Any]


def done(texts: Texts, asked: Asked) -> Texts:
    """The texts after an edit; EditError where it is refused."""
    project = texts.project()
    change = edit(asked.name).function(project, **asked.said)
    return texts.changed(dict(apply_edit(project, change, keep_weights=False).texts))


def done_or_refused(texts: Texts, asked: Asked) -> Texts | EditError:
    """The texts after an edit, or why it is impossible."""
    try:
        return done(texts, asked)
    except EditError as error:
        return error


@st.composite
def anything(draw: st.DrawFn) -> Asked:
    """Any edit of any names, most of which are none."""
    word, several = st.sampled_from(WORDS), st.lists(st.sampled_from(WORDS), max_size=2).map(tuple)
    skill = st.sampled_from((*SKILLS, *SKILLS, *WORDS))
    some = st.lists(skill, min_size=1, max_size=3).map(tuple)
    fact, value = st.sampled_from(FACTS), st.sampled_from(["", "", "1", "charge", "1 +"])
    said: dict[str, dict[str, st.SearchStrategy[Any]]] = {
        "add": {"lines": st.sampled_from(DECLARED) | st.tuples(fact), "to": skill | st.just("")},
        "connect": {"skill": skill, "target": word, "at": value, "drives": st.booleans()},
        "disconnect": {"skill": skill, "target": word},
        "encapsulate": {"skill": skill, "new": st.sampled_from(FREE) | word, "with_": several, "reads": several},
        "extract": {"parent": skill, "new": st.sampled_from(FREE) | word, "subskills": some},
        "fold": {},
        "freeze": {"skill": skill},
        "grow": {"skill": skill},
        "inline": {"skill": skill},
        "integrate": {"skill": skill, "with_": several, "reads": several},
        "prune": {"skill": skill},
        "remove": {"what": st.tuples(st.just("skill"), word) | st.tuples(fact), "from_": skill | st.just("")},
        "rename": {"old": word, "new": word, "noun": st.sampled_from(NOUNS)},
        "replace": {"skill": skill, "new": skill},
        "rewards": {"task": st.just("Roam") | word},
        "split": {"to": st.sampled_from(["apart.mind", "parts.mind", "../x.mind", "x"]), "names": some},
        "unfold": {},
        "unfreeze": {"skill": skill},
        "unshare": {"skill": st.just(LIKE) | skill},
    }  # fmt: skip
    assert set(said) == set(names())
    name = draw(st.sampled_from(sorted(said)))
    return Asked(name, draw(st.fixed_dictionaries(said[name])))


def holds(texts: Texts, asked: Asked) -> None:
    """An edit either is refused with a reason, or leaves what it should."""
    after = done_or_refused(texts, asked)
    if isinstance(after, EditError):
        event(f"{asked.name} refused")
        assert str(after).endswith((".", "?")), str(after)
        assert after.diagnostic.span or after.hint, f"neither a place nor a hint: {after}"
        return
    event(f"{asked.name} done")
    assert after.compiled().graph is not None
    for path, text in texts.files.items():
        _line_ends(text, after.files[path])
        _lines(asked, text, after.files[path])
    _comments(asked, texts, after)


def _line_ends(old: str, new: str) -> None:
    ends = {"\r\n"} if "\r\n" in old else {"\n"}
    assert set(re.findall(r"\r?\n", new)) <= ends
    assert new.endswith("\n") == old.endswith("\n") or not new


def _lines(asked: Asked, old: str, new: str) -> None:
    """Edits that add take no line away and change none; a name changes where it stands and nothing around it."""
    before, after = old.splitlines(), new.splitlines()
    operations = [
        tag for tag, *_ in SequenceMatcher(None, before, after, autojunk=False).get_opcodes() if tag != "equal"
    ]
    match asked.name:
        case "add" | "connect" | "freeze" | "integrate":
            assert set(operations) <= {"insert"}
        case "remove" | "disconnect" | "unfreeze":
            assert set(operations) <= {"delete"}
        case "rename" | "replace":
            assert len(before) == len(after)
            name, new_name = (
                asked.said[key] for key in (("old", "new") if asked.name == "rename" else ("skill", "new"))
            )
            changed = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
            # as a word of its own, before the comment
            assert all(
                _words(b) == [new_name if w == name else w for w in _words(a)] or name in _words(b) for a, b in changed
            )


def _words(line: str) -> list[str]:
    return re.findall(r"[\w+]+|[^\w\s]", line.partition("#")[0])


def _comments(asked: Asked, old: Texts, new: Texts) -> None:
    before, after = (sorted(_said(texts.files.values())) for texts in (old, new))
    if asked.name in (*KEEPING, "split"):
        assert before == after
    else:
        assert set(after) <= set(before)
        assert len(after) == len(set(after))


def _said(texts: Iterable[str]) -> list[str]:
    """All comments: each begins with a number of its own."""
    return [comment for text in texts for comment in re.findall(r"# \d+:[^\r\n]*", text)]


Reversible = Callable[[st.DrawFn, Project], tuple[Asked, list[Asked]]]


def _rename(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    noun = draw(st.sampled_from(["skill", "task", "sensor", "actuator", "memory", "thing", "curriculum", "body"]))
    known = [*project.names.of(noun)] if noun != "thing" else ["ball"]
    old, new = (
        draw(st.sampled_from(known or ["?"])),
        "Fresh+New" if noun in ("skill", "task", "curriculum", "body") else "fresh",
    )
    return Asked("rename", _names(old, new, noun)), [Asked("rename", _names(new, old, noun))]


def _names(old: str, new: str, noun: str) -> dict[str, str]:
    return {"old": old, "new": new, "noun": noun}


def _connect(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    skill, target = (
        _skill(draw, project),
        draw(st.sampled_from(project.names.of("skill", "sensor", "actuator", "memory"))),
    )
    at = draw(st.sampled_from(["", "1/2"])) if project.names.noun_of(target, ("skill", "actuator")) else ""
    ends = {"skill": skill, "target": target}
    if target in project.names.of("memory"):  # which the skill may drive as well
        back = Asked("remove", {"what": (f"reads {target}",), "from_": skill, "noun": "skill"})
    else:
        back = Asked("disconnect", ends)
    return Asked("connect", {**ends, "at": at}), [back]


def _add(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    if draw(st.booleans()):
        lines = draw(st.sampled_from(DECLARED))
        return Asked("add", {"lines": lines}), [Asked("remove", {"what": tuple(lines[0].split()[:2])})]
    to, fact = _skill(draw, project), draw(st.sampled_from(FACTS))
    asked = Asked("add", {"lines": (fact,), "to": to, "noun": "skill"})
    return asked, [Asked("remove", {"what": (fact,), "from_": to, "noun": "skill"})]


def _freeze(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    said = {"skill": _skill(draw, project)}
    return Asked("freeze", said), [Asked("unfreeze", said)]


def _integrate(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    skill, other = _skill(draw, project), _skill(draw, project)
    reading = draw(st.sampled_from(project.names.of("sensor")))
    back = [Asked("disconnect", {"skill": skill, "target": target}) for target in (other, reading)]
    return Asked("integrate", {"skill": skill, "with_": (other,), "reads": (reading,)}), back


def _extract(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    """Subskills that stand one below the other."""
    runs = [run for declaration in project.names.table["skill"].values() for run in _runs(declaration.facts)]
    assume(runs)
    parent, subskills = draw(st.sampled_from(runs))
    name = next(name for name, declaration in project.names.table["skill"].items() if parent in declaration.facts)
    subskills = draw(st.permutations(subskills))
    return Asked("extract", {"parent": name, "new": "New", "subskills": tuple(subskills)}), [
        Asked("inline", {"skill": "New"})
    ]


def _runs(facts: Iterable[Any]) -> list[tuple[Any, list[str]]]:
    found: list[list[Any]] = []
    for fact in facts:
        if isinstance(fact, Influences):
            if found and fact.span.line == found[-1][-1].span.line + 1:
                found[-1].append(fact)
            else:
                found.append([fact])
    return [(run[0], [fact.name.text for fact in run]) for run in found]


def _replace(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    """By a skill that has no place yet."""
    below = {name for skill in project.mind.skills for name in skill.subskills}
    free = [
        skill.name for skill in project.mind.skills if skill.name not in below and skill.name != project.mind.master
    ]
    assume(free)
    old, new = _skill(draw, project), draw(st.sampled_from(free))
    return Asked("replace", {"skill": old, "new": new}), [Asked("replace", {"skill": new, "new": old})]


def _encapsulate(draw: st.DrawFn, project: Project) -> tuple[Asked, list[Asked]]:
    skill = _skill(draw, project)
    reads = (draw(st.sampled_from(project.names.of("sensor"))),)
    has_place = skill == project.mind.master or project.parents(skill)
    back = [Asked("replace", {"skill": "New", "new": skill})] if has_place else []
    back.append(Asked("remove", {"what": ("skill", "New")}))
    return Asked("encapsulate", {"skill": skill, "new": "New", "reads": reads}), back


def _skill(draw: st.DrawFn, project: Project) -> str:
    return draw(st.sampled_from(project.names.of("skill")))


REVERSIBLE: tuple[Reversible, ...] = (
    _rename, _connect, _add, _freeze, _integrate, _extract, _replace, _encapsulate,
)  # fmt: skip


def comes_back(texts: Texts, data: st.DataObject) -> None:
    """An edit that is not refused, then its reverse: the very same text."""
    how = data.draw(st.sampled_from(REVERSIBLE))
    there, back = how(data.draw, texts.project())
    after = done_or_refused(texts, there)
    if isinstance(after, EditError):
        event(f"{how.__name__} refused")
        return
    event(f"{how.__name__} and back")
    for asked in back:
        after = done(after, asked)
    if texts.airy:
        assert after.files == texts.files
    else:  # a declaration brings a blank line with it, which may stay
        assert list(map(_dense, after.files.values())) == list(map(_dense, texts.files.values()))


def _dense(text: str) -> list[str]:
    return [line for line in text.splitlines(keepends=True) if line.strip()]


@given(minds(), anything())
@settings(max_examples=SELDOM, suppress_health_check=[HealthCheck.too_slow])
def test_an_edit_keeps_everything_but_its_own_lines(texts: Texts, asked: Asked) -> None:
    holds(texts, asked)


def test_a_file_that_is_not_saved_yet_is_there() -> None:
    main = 'tick 1/60 s\nbody Robot is disc size 2\nmaster Go\nuse "parts.mind"\nskill Go is rule\n  drives claw at 1\n'
    texts = Texts({MAIN: main, PARTS: "actuator claw is gripper neutral 0\n"}, airy=False)
    with pytest.raises(EditError, match=r"parts\.mind exists already"):
        done(texts, Asked("split", {"to": "parts.mind", "names": ("Go",)}))


@given(minds(), st.data())
@settings(max_examples=SELDOM, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
def test_an_edit_and_its_reverse_give_back_the_text(texts: Texts, data: st.DataObject) -> None:
    comes_back(texts, data)


@given(minds())
@settings(max_examples=10, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
def test_families_mean_what_they_mean_written_out(texts: Texts) -> None:
    assume(" where N is " in texts.files[MAIN])
    graph = texts.compiled().graph
    unfolded = done_or_refused(texts, Asked("unfold", {}))
    assume(isinstance(unfolded, Texts))
    assert unfolded.compiled().graph == graph
    assert done(unfolded, Asked("fold", {})).compiled().graph == graph


@pytest.mark.slow
@given(minds(), anything())
@settings(max_examples=OFTEN, suppress_health_check=[HealthCheck.too_slow])
def test_edits_often(texts: Texts, asked: Asked) -> None:
    holds(texts, asked)


@pytest.mark.slow
@given(minds(), st.data())
@settings(max_examples=OFTEN, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
def test_edits_and_their_reverse_often(texts: Texts, data: st.DataObject) -> None:
    comes_back(texts, data)


def test_every_text_of_the_strategy_can_be_read() -> None:
    """The comments of the strategy are no facts: a text without them means the same."""
    text = "tick 1/60 s  # 1: why?\n# 2: skill Go is rule\n"
    findings = Findings()
    parse(Source("text", text), findings)
    assert findings.diagnostics == []
