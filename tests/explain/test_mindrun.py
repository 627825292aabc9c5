"""What can be said to mindrun is explained behind the doors of mindc: in the terminal, and on the page of commands."""

import json
from argparse import ArgumentParser

import pytest
from mindrun.cli import driving_parser, tool_parser, tools

from mindlang.cli.explain import mindrun_articles
from tests.calling import Call
from tests.project.sources import ROOT

PAGE = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8").partition("\n## mindrun\n")[2]
PARSERS = {"mindrun": driving_parser(), **{name: tool_parser(name) for name in tools()}}
COLUMNS = 80


def said(parser: ArgumentParser) -> list[str]:
    """The arguments and options, but those that every program has."""
    known = [action for action in parser._actions if action.dest not in ("help", "version")]
    return [
        action.option_strings[-1] if action.option_strings else str(action.metavar or action.dest) for action in known
    ]


def test_every_tool_has_an_article() -> None:
    assert [(each.noun, each.name) for each in mindrun_articles()] == [
        ("program", "mindrun"),
        *(("mindrun", name) for name in tools()),
    ]


@pytest.mark.parametrize("name", PARSERS)
def test_an_article_has_all_that_may_be_said_and_how(mindc: Call, name: str) -> None:
    asked = [name] if name == "mindrun" else ["mindrun", name]
    [article] = json.loads(mindc("explain", *asked, "--json").out)["articles"]
    text, section = mindc("explain", *asked).out, PAGE.partition(f"\n### `{name}`\n")[2].partition("\n### ")[0]
    usage, *calls = [line for line in article["right"][0].splitlines() if line]
    assert usage.startswith(f"{' '.join(['mindrun', *asked[1:]])} ")
    assert calls
    for word in said(PARSERS[name]):
        assert any(word.lower() in each["key"].lower() for each in article["arguments"]), word
    for part in (article["summary"], *(each["key"] for each in article["arguments"]), *calls):
        assert part.split("  ")[0] in " ".join(text.split(" ")).replace("\n", " ") or len(part) > COLUMNS
        assert part in section
    assert max(map(len, text.splitlines())) <= COLUMNS


@pytest.mark.parametrize("name", PARSERS)
def test_its_help_fits_a_terminal(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", str(COLUMNS))
    assert [line for line in PARSERS[name].format_help().splitlines() if len(line) > COLUMNS] == []


def test_a_name_that_both_programs_have_is_explained_for_each(mindc: Call) -> None:
    both = mindc("explain", "doctor").out
    assert mindc("explain", "mindc", "doctor").out + "\n" + mindc("explain", "mindrun", "doctor").out == both
