"""The published JSON Schema: made from the drivers, and of one mind with the compiler about what it can know."""

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft202012Validator

from mindlang.compiler.compile import load
from mindlang.robot.options import drivers, own_options, schema
from mindlang.robot.wire import load_wiring
from tests.calling import Call
from tests.project.sources import ROOT

HERE = Path(__file__).parent
PUBLISHED = ROOT / "docs" / "robot.schema.json"
EXAMPLES = sorted((ROOT / "examples" / "collect").glob("*.yaml"))
SEEN = (  # mistakes that the schema finds, too
    "boolean_name", "null", "exponent", "clock", "infinite", "unknown_top", "no_robot", "sensors_is_a_list",
    "sensor_is_a_word", "unknown_driver", "driver_of_the_other_noun", "two_drivers", "no_driver", "unknown_option",
    "missing_list", "no_unit", "out_of_range", "not_whole", "quoted_number", "comma", "list_for_a_number",
    "number_for_a_list", "empty_list", "wrong_pin", "three_limits", "quoted_switch", "unknown_reaction", "no_value",
    "wrong_unit",
)  # fmt: skip


def errors(text: str) -> list[Any]:
    return list(Draft202012Validator(schema()).iter_errors(yaml.safe_load(text)))


def test_it_is_a_schema() -> None:
    Draft202012Validator.check_schema(schema())


def test_what_is_published_is_what_the_drivers_say(mindc: Call) -> None:
    """After a change of drivers: mindc schema > docs/robot.schema.json."""
    said = mindc("schema")
    assert said.code == 0
    assert said.out == PUBLISHED.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", [*EXAMPLES, HERE / "right.yaml"], ids=lambda path: path.stem)
def test_right_files_are_valid(path: Path) -> None:
    assert errors(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("name", SEEN)
def test_wrong_files_are_not(name: str) -> None:
    assert errors((HERE / "wrong" / f"{name}.yaml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_examples_are_for_their_mind_and_name_the_schema(path: Path) -> None:
    graph = load(path.with_name("ball.mind")).graph
    assert graph
    assert load_wiring(path, graph).diagnostics == ()
    first = path.read_text(encoding="utf-8").splitlines()[0]
    assert (path.parent / first.removeprefix("# yaml-language-server: $schema=")).resolve() == PUBLISHED


@pytest.mark.parametrize("noun", ["sensor", "actuator"])
def test_no_driver_has_an_option_that_every_wire_has(noun: str) -> None:
    own = {option.key for option in own_options(noun)} | {"driver"}
    known = drivers(noun)
    assert known
    assert {name: own & set(cls.__dataclass_fields__) for name, cls in known.items()} == {name: set() for name in known}


def test_the_schema_is_one_json_document() -> None:
    assert json.loads(PUBLISHED.read_text(encoding="utf-8"))["$schema"].endswith("2020-12/schema")
