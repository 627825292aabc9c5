"""`mindc prove`, as its users call it."""

import json
from pathlib import Path
from typing import Any

import pytest

from benchmarks.edits import tree
from tests.calling import RULES, Call
from tests.edits.taught import MIND, teach, write_mind

COLLECT = """\
Collect in charge, for any readings from 0 to 1

Paths, and the worst that leaks of 0.01 can do  rests on the declaration alone
actuator paths leaks take worst path most of it leaks from
left_wheel 4 2.9% Collect → GoToDropZone+Avoid → GoToDropZone Collect 1.9%, into GoToObject+Avoid
right_wheel 4 2.9% Collect → GoToDropZone+Avoid → GoToDropZone Collect 1.9%, into GoToObject+Avoid
claw 1 0.0% Collect → Grab

What each actuator can be sent  rests on the weights that are named, and the declaration
actuator command seen neutral, where nothing influences it rests on
left_wheel 0 to 1 0 to 1 0.5 where GoToObject+Avoid keeps still the weights of 6 skills
right_wheel 0 to 1 0 to 1 0.5 where GoToObject+Avoid keeps still the weights of 6 skills
claw 0 to 1 0 to 1 never the declaration alone
  keeps still: there are readings for which it has influence, and passes none on
"""
POWER = """\
CollectWithPower in charge, for any readings from 0 to 1

Paths, and the worst that leaks of 0.01 can do  rests on the declaration alone
actuator paths leaks take worst path most of it leaks from
left_wheel 6 4.8% CollectWithPower → Collect → GoToDropZone+Avoid → GoToDropZone CollectWithPower 1.9%, into GoToPower+Avoid
right_wheel 6 4.8% CollectWithPower → Collect → GoToDropZone+Avoid → GoToDropZone CollectWithPower 1.9%, into GoToPower+Avoid
claw 1 0.0% CollectWithPower → Collect → Grab

What each actuator can be sent  rests on the weights that are named, and the declaration
actuator command seen neutral, where nothing influences it rests on
left_wheel 0 to 1 0 to 1 0.5 where GoToObject+Avoid keeps still the weights of 9 skills
right_wheel 0 to 1 0 to 1 0.5 where GoToObject+Avoid keeps still the weights of 9 skills
claw 0 to 1 0 to 1 0 where CollectWithPower keeps still the weights of 9 skills
  keeps still: there are readings for which it has influence, and passes none on

Lines and skills
  CollectAndPower: not below CollectWithPower  rests on the declaration alone
"""  # noqa: E501


def squeezed(text: str) -> str:
    """A table without the spaces that align it."""
    lines = [line.rstrip() for line in text.splitlines()]
    return "\n".join(
        line
        if line.startswith("  ") or ("  rests on the " in line and not line.startswith("actuator"))
        else " ".join(line.split())
        for line in lines
    )


def proved(mindc: Call, *arguments: object) -> Any:
    """The JSON document."""
    said = mindc("prove", *arguments, "--json")
    assert said.code == 0
    return json.loads(said.out)


@pytest.mark.parametrize(("name", "table"), [("collect", COLLECT), ("power", POWER)])
def test_the_shipped_minds(mindc: Call, name: str, table: str) -> None:
    said = mindc("prove", f"examples/collect/{name}.mind")
    assert (said.code, said.err) == (0, "")
    assert squeezed(said.out) == table.rstrip("\n")


def test_what_is_dead_is_told(mindc: Call) -> None:
    said = mindc("prove", "examples/collect/constant_skills.mind")
    assert "Gather always influences SeekObject+Dodge fully  rests on the weights e667… of Gather" in said.out
    assert "SeekDropZone never influences MoveForward  rests on the weights 4282… of SeekDropZone" in said.out


def test_the_document(mindc: Call) -> None:
    found = proved(mindc, "examples/collect/collect.mind")
    assert list(found) == [
        "master", "assumes", "delta", "weights", "unknown", "not_below_master", "actuators", "edges", "dead_skills",
        "run",
    ]  # fmt: skip
    assert (found["master"], found["delta"], found["run"], found["unknown"]) == ("Collect", 0.01, None, {})
    left, _, claw = found["actuators"]
    assert left["paths"] == {
        "count": 4,
        "first": [
            ["Collect", "GoToObject+Avoid", "GoToObject"],
            ["Collect", "GoToObject+Avoid", "Avoid"],
            ["Collect", "GoToDropZone+Avoid", "GoToDropZone"],
            ["Collect", "GoToDropZone+Avoid", "Avoid"],
        ],
        "rests_on": ["the declaration alone"],
    }
    assert left["leak"]["share"] == pytest.approx(0.03 / 1.03)
    assert left["leak"]["worst"] == "Collect"
    assert [level["into"] for level in left["leak"]["levels"]] == [["GoToObject+Avoid"], ["Avoid"], []]
    assert left["neutral"]["sent"] == "can be"
    assert len(left["neutral"]["example"]["readings"]["proximity"]) == 10
    assert left["neutral"]["rests_on"] == [f"the weights {sha[:4]}… of {s}" for s, sha in found["weights"].items()]
    assert claw["neutral"] == {
        "value": 0.0, "sent": "never", "influence": [1.0, 1.0], "example": None,
        "rests_on": ["the declaration alone"],
    }  # fmt: skip
    assert found["edges"][2] == {
        "skill": "Collect", "target": "Grab", "low": 1.0, "high": 1.0, "seen": [1.0, 1.0],
        "rests_on": ["the declaration alone"],
    }  # fmt: skip


def test_another_leak_and_another_master(mindc: Call) -> None:
    found = proved(mindc, "examples/collect/collect.mind", "--leak", 0.05, "--master", "GoToObject+Avoid")
    assert found["master"] == "GoToObject+Avoid"
    assert found["actuators"][0]["leak"]["share"] == pytest.approx(0.05 / 1.05)
    assert found["actuators"][2]["neutral"]["sent"] == "always"
    assert found["actuators"][2]["leak"] is None


def test_an_untaught_mind(mindc: Call, tmp_path: Path) -> None:
    path = write_mind(tmp_path)
    teach(path, "Go")
    found = proved(mindc, path)
    assert found["unknown"] == dict.fromkeys(["Drive", "Avoid"], "has no weights that fit")
    assert list(found["weights"]) == ["Go"]
    assert len(found["weights"]["Go"]) == 64
    left, right, claw = found["actuators"]
    assert left["neutral"]["sent"] == right["neutral"]["sent"] == "not excluded"
    assert left["command"]["seen"] is None
    assert (claw["neutral"]["sent"], claw["command"]["low"]) == ("never", 1.0)
    assert "have no weights that fit: what they send is taken to be from 0 to 1" in mindc("prove", path).out


def test_stale_weights_prove_nothing(mindc: Call, tmp_path: Path) -> None:
    path = write_mind(tmp_path)
    teach(path)
    assert proved(mindc, path)["unknown"] == {}
    path.write_text(MIND.replace("skill Go is mlp hidden 1", "skill Go is mlp hidden 2"))
    assert proved(mindc, path)["unknown"] == {"Go": "has no weights that fit"}


def test_procedures_are_not_run(mindc: Call, tmp_path: Path) -> None:
    (tmp_path / "turning.py").write_text("raise SystemExit('this was run')\n")
    text = RULES.replace("skill Turn is rule", "skill Turn is procedure from turning.turn\n  reads feeler")
    text = text.replace("drives left_wheel at 0.9", "drives left_wheel")
    path = tmp_path / "calling.mind"
    path.write_text(text)
    said = mindc("prove", path)
    assert said.code == 0
    assert "Turn is Python code: what it sends is taken to be from 0 to 1" in said.out
    said = mindc("prove", path, "--run")
    assert said.code == 2
    assert said.err.startswith("--run: ")


def test_the_tour(mindc: Call) -> None:
    assert proved(mindc, "examples/tour/tour.mind")["unknown"]["Deliver"] == "is Python code"


def test_what_cannot_be_proved(mindc: Call, rules: Path, tmp_path: Path) -> None:
    assert mindc("prove", tmp_path / "none.mind").code == 2
    (tmp_path / "bad.mind").write_text("reads x\n")
    assert mindc("prove", tmp_path / "bad.mind").code == 1
    said = mindc("prove", rules, "--master", "Raom")
    assert (said.code, said.err) == (2, "there is no skill called Raom\n  Did you mean Roam?\n")
    assert mindc("prove", rules, "--leak", 0).code == 2
    assert mindc("prove", rules, "--leak", "nan").code == 2
    assert mindc("prove", rules, "--task", "Roam").code == 2
    said = mindc("prove", rules, "--run", "--task", "Roma")
    assert (said.code, said.err) == (2, "--run: there is no task called Roma\n  Did you mean Roam?\n")
    untaught = write_mind(tmp_path)
    said = mindc("prove", untaught, "--run")
    assert said.code == 1
    assert said.err.startswith("--run: ")
    assert f"mindc train {untaught} " in said.err


def test_a_thousand_skills(mindc: Call, tmp_path: Path) -> None:
    path = tmp_path / "tree.mind"
    path.write_text(tree(1000))
    left = proved(mindc, path)["actuators"][0]
    assert left["paths"]["count"] == 500
    # whatever is not on the path, 499 leaves, or 9 levels of which the deepest leaks least
    assert left["leak"]["share"] == pytest.approx(4.99 / 5.99)
    assert left["leak"]["worst"] == "S0"


def test_words_that_a_table_uses_are_explained_below_it(mindc: Call) -> None:
    said = mindc("prove", "examples/collect/ball.mind").out
    assert "0.5, not ruled out" in said
    assert "\n  not ruled out: not proved to be impossible, and seen for no readings that were tried\n" in said
    assert "  keeps still: " not in said
