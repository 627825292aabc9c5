"""Every driver is explained, in the docs and by mindc; what is published is what the drivers say."""

import os

import pytest

from mindlang.wiring.driver_page import all_pages, driver_names, driver_page
from mindlang.wiring.options import driver_options, drivers
from tests.calling import Call
from tests.project.sources import ROOT

PUBLISHED = ROOT / "docs" / "drivers.md"


def test_what_is_published_is_what_the_drivers_say() -> None:
    if os.environ.get("UPDATE"):
        PUBLISHED.write_text(all_pages(), encoding="utf-8")
    assert PUBLISHED.read_text(encoding="utf-8") == all_pages()


@pytest.mark.parametrize("name", driver_names())
def test_mindc_explains_a_driver_with_all_of_its_options(mindc: Call, name: str) -> None:
    said = mindc("explain", name)
    assert (said.code, said.out) == (0, driver_page(name) + "\n")
    for noun in ("sensor", "actuator"):
        for option in driver_options(drivers(noun)[name]) if name in drivers(noun) else ():
            assert f"`{option.key}`" in said.out


@pytest.mark.parametrize("name", driver_names())
def test_a_driver_speaks_of_options_that_there_are(name: str) -> None:
    """`low` and `high` are called `from` and `to` in a robot.yaml."""
    assert not {"`low`", "`high`"} & set(driver_page(name).split())
