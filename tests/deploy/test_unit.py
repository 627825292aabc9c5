"""The service: what runs, and what never does unasked."""

import configparser

from mindlang.deploying.unit import unit


def read(text: str) -> configparser.ConfigParser:
    """A unit as sections of settings."""
    parser = configparser.ConfigParser(interpolation=None, delimiters=("=",))
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    parser.read_string(text)
    return parser


def test_not_armed_it_moves_nothing() -> None:
    service = read(unit())["Service"]
    assert service["ExecStart"].endswith("-m mindrun mind.bundle")
    assert "ExecStopPost" not in service


def test_armed_it_ends_in_neutral() -> None:
    service = read(unit(arm=True))["Service"]
    assert service["ExecStart"].endswith("-m mindrun mind.bundle --arm")
    assert service["ExecStopPost"].endswith("-m mindrun.robot.guardian --neutral mind.bundle")


def test_both_go_on_after_a_failure() -> None:
    for arm in (False, True):
        parser = read(unit(arm))
        assert parser["Service"]["Restart"] == "on-failure"
        assert parser["Install"]["WantedBy"] == "default.target"
