"""What the playground says of a text: what mindc says of it, in the places of a browser, without numpy."""

import json
import subprocess
import sys
from typing import Any

import pytest

from tests.project.sources import ROOT

PROGRAM = """
import json, sys
sys.path.insert(0, "playground")

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {"numpy", "numba", "click", "rich", "yaml", "cv2", "PIL", "pymunk"}:
            raise ImportError(f"there is no {name} here")

sys.meta_path.insert(0, Refuse())
from looking import look
print(json.dumps([json.loads(look(text)) for text in json.load(sys.stdin)]))
"""
RULES = (ROOT / "examples" / "braitenberg.mind").read_text(encoding="utf-8")
WRONG = f"{RULES}\nskill Lost is rule  # 🤖\n  drives left_whel at 1\n"
CIRCLE = RULES.replace("skill Turn is rule\n", "skill Turn is rule\n  influences Wander at 1\n")


@pytest.fixture(scope="module")
def looked() -> dict[str, Any]:
    """What is said of several texts, by name."""
    texts = {
        "rules": RULES,
        "wrong": WRONG,
        "untidy": RULES.replace("  drives", "     drives"),
        "unread": f"{RULES}\nsensor spare is range_finder\n",
        "broken": "skill A is rule\n  raeds x\n",
        "circle": CIRCLE,
        "empty": "",
        "uses": f'use "other.mind"\n{RULES}',
    }
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=json.dumps([*texts.values()]),
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=True,
    )
    return dict(zip(texts, json.loads(done.stdout), strict=True))


def test_the_hierarchy_is_that_of_the_text(looked: dict[str, Any]) -> None:
    found = looked["rules"]["hierarchy"]
    assert found["master"] == "skill Wander"
    assert {node["name"] for node in found["nodes"] if node["noun"] == "skill"} == {
        "Wander",
        "MoveForward",
        "Shy",
        "Turn",
    }
    known = {node["id"] for node in found["nodes"]}
    assert all({edge["from"], edge["to"]} <= known for edge in found["edges"])
    said = {"from": "skill Wander", "to": "skill Turn", "verb": "influences", "said": "at 2 * (1 - front_feeler)"}
    assert said in found["edges"]


def test_a_mistake_stands_where_it_stands_in_utf_16(looked: dict[str, Any]) -> None:
    [finding] = looked["wrong"]["findings"]
    units = WRONG.encode("utf-16-le")
    assert units[2 * finding["from"] : 2 * finding["to"]].decode("utf-16-le") == "left_whel"
    assert (finding["severity"], finding["hint"]) == ("error", "Did you mean left_wheel?")
    assert looked["wrong"]["hierarchy"] is None


def test_tidy_text_is_that_of_fmt(looked: dict[str, Any]) -> None:
    assert looked["untidy"]["tidy"] == looked["rules"]["tidy"] == RULES
    assert looked["broken"]["tidy"] is None


def test_lint_is_held_but_for_what_was_never_taught(looked: dict[str, Any]) -> None:
    assert [finding["code"] for finding in looked["unread"]["findings"]] == ["unread-sensor"]
    assert looked["rules"]["findings"] == []


@pytest.mark.parametrize("name", ["circle", "empty", "uses", "broken"])
def test_whatever_is_wrong_is_said(looked: dict[str, Any], name: str) -> None:
    assert looked[name]["findings"]
    assert looked[name]["findings"][0]["message"]


def test_every_example_is_whole() -> None:
    listing = "import sys; sys.path.insert(0, 'playground'); import json, pack; print(json.dumps(pack.EXAMPLES))"
    found = subprocess.run(
        [sys.executable, "-c", listing],
        capture_output=True,
        text=True,
        cwd=ROOT,
        check=True,
    )
    texts = [(ROOT / "examples" / name).read_text(encoding="utf-8") for name in json.loads(found.stdout).values()]
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], input=json.dumps(texts), capture_output=True, text=True, cwd=ROOT, check=True
    )
    assert [each["findings"] for each in json.loads(done.stdout)] == [[]] * len(texts)
