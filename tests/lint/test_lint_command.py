"""`mindc lint`, as its users call it: formats, choice of rules, silence, fixes."""

import json
import os
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from tests.calling import RULES, Call

UNREAD = RULES.replace("sensor feeler", "sensor pulse is sine period 2 s\nsensor feeler")
SCHEMA = Path(__file__).with_name("sarif.json")  # the part of SARIF 2.1.0 that mindc says; more is an error


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("a b.mind").write_text(UNREAD)
    return Path("a b.mind")


def test_what_is_hardly_meant(mindc: Call, file: Path) -> None:
    said = mindc("lint", file, "--select", "unread-sensor")
    assert said.code == 1
    assert said.out == (
        "a b.mind:7:8: warning: Nobody reads pulse. [unread-sensor]\n"
        "  7 | sensor pulse is sine period 2 s\n"
        "    |        ^^^^^\n"
        "  Add reads pulse to a skill, or take the sensor out.\n\n"
    )
    assert said.err == "1 finding, 1 can be mended with --fix\n"


def test_nothing(mindc: Call, file: Path) -> None:
    said = mindc("lint", file, "--ignore", "unread-sensor,untaught-skill", "--select", "unread-sensor")
    assert (said.code, said.out, said.err) == (0, "", "nothing found\n")


def test_no_rule(mindc: Call, file: Path) -> None:
    said = mindc("lint", file, "--select", "unread-sensors")
    assert (said.code, said.out) == (2, "")
    assert "There is no rule called unread-sensors." in said.err
    assert "Did you mean unread-sensor?" in said.err


@pytest.mark.parametrize(
    ("comment", "found"),
    [
        ("# noqa", 0),
        ("# noqa: unread-sensor", 0),
        ("# later # noqa: idle-skill, unread-sensor", 0),
        ("# noqa: idle-skill", 1),
        ("# NOQA", 0),
        ("# noqa : unread-sensor", 0),
        ("# do not write noqa here", 1),
        ("# nothing", 1),
    ],
)
def test_silence(mindc: Call, file: Path, comment: str, found: int) -> None:
    file.write_text(UNREAD.replace("period 2 s", f"period 2 s  {comment}"))
    said = mindc("lint", file, "--select", "unread-sensor", "--format", "json")
    assert len(json.loads(said.out)["diagnostics"]) == found


def test_errors_come_first_and_alone(mindc: Call, file: Path) -> None:
    file.write_text(UNREAD.replace("drives left_wheel", "drives left_weel", 1))
    said = mindc("lint", file, "--format", "json")
    assert [each["code"] for each in json.loads(said.out)["diagnostics"]] == ["unknown-actuator"]
    assert said.code == 1


def test_fixes(mindc: Call, file: Path) -> None:
    file.write_bytes(b"\xef\xbb\xbf" + UNREAD.replace("\n", "\r\n").encode())
    said = mindc("lint", file, "--select", "unread-sensor", "--fix")
    assert (said.code, said.out, said.err) == (0, "", "nothing found, 1 fixed\n")
    assert file.read_bytes() == b"\xef\xbb\xbf" + RULES.replace("\n", "\r\n").encode()


def test_a_fix_makes_room_for_the_next(mindc: Call, file: Path) -> None:
    file.write_text(UNREAD.replace("sensor feeler", "sensor slope is derivative of pulse\nsensor feeler"))
    said = mindc("lint", file, "--select", "unread-sensor", "--fix")
    assert said.err == "nothing found, 2 fixed\n"
    assert file.read_text() == RULES


BATTERY = UNREAD.replace("sensor pulse is sine period 2 s", "sensor charge is battery").replace(
    "ends on collision", "ends on exhaustion"
)


def test_a_battery_is_used_where_it_can_be_exhausted(mindc: Call, file: Path) -> None:
    file.write_text(BATTERY)
    assert mindc("lint", file, "--select", "unread-sensor", "--fix").code == 0
    assert file.read_text() == BATTERY


def test_what_another_mind_reads_is_of_use(mindc: Call, file: Path) -> None:
    user = 'use "a b.mind"\nmaster Look\nskill Look is rule\n  reads pulse\n  drives left_wheel at pulse\n'
    Path("user.mind").write_text(user)
    assert mindc("check", "user.mind").code == 0
    assert mindc("lint", file, "--select", "unread-sensor", "--fix").code == 0
    assert file.read_text() == UNREAD


def test_what_minds_beside_declare_for_themselves_says_nothing_of_this_one(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("body.mind").write_text("".join(line for line in RULES.splitlines(True)[2:5]))
    own = "".join(line for line in UNREAD.splitlines(True) if not line.startswith(("body", "actuator")))
    Path("a.mind").write_text(f'use "body.mind"\n{own}')
    alone = mindc("lint", "a.mind")
    assert "Nobody reads pulse" in alone.out
    Path("copy.mind").write_text(Path("a.mind").read_text())  # a variant, as everybody makes one
    Path("c.mind").write_text(Path("a.mind").read_text().replace("  reads ball_bearing", "  reads pulse", 1))
    assert mindc("lint", "a.mind").out == alone.out
    Path("d.mind").write_text('use "a.mind"\nmaster Roam\n# pulse is read by nobody here\n')
    assert mindc("check", "d.mind").code == 0
    assert mindc("lint", "a.mind").out == alone.out


def test_a_fix_that_would_break_another_mind_is_not_made(mindc: Call, file: Path) -> None:
    Path("parts.mind").write_text("sensor extra is sine period 1 s\n")
    file.write_text(f'use "parts.mind"\n{RULES}')
    Path("user.mind").write_text(
        'use "a b.mind"\nmaster Look\nskill Look is rule\n  reads extra\n  drives left_wheel at extra\n'
    )
    assert mindc("check", "user.mind").code == 0
    said = mindc("lint", file, "--select", "unused-use", "--fix")
    assert said.code == 1
    assert mindc("check", "user.mind").code == 0


def test_a_damaged_lock_is_a_finding_and_the_others_are_linted(mindc: Call, file: Path) -> None:
    Path("b.mind").write_text(RULES)
    Path("b.lock").write_text("junk")
    said = mindc("lint", "b.mind", file, "--select", "unread-sensor", "--format", "json")
    assert [each["code"] for each in json.loads(said.out)["diagnostics"]] == ["damaged-lock", "unread-sensor"]


def test_one_file_by_two_names_is_one(mindc: Call, file: Path) -> None:
    said = mindc("lint", file, f"./{file}", "--select", "unread-sensor", "--format", "json")
    assert len(json.loads(said.out)["diagnostics"]) == 1


@pytest.mark.parametrize("words", [("--select", ""), ("--select", ","), ("--ignore", "comma"), ("-", "--fix")])
def test_what_makes_no_sense(mindc: Call, file: Path, words: tuple[str, ...]) -> None:
    assert mindc("lint", file, *words).code == 2


def test_a_file_with_errors_is_not_fixed(mindc: Call, file: Path) -> None:
    text = UNREAD.replace("drives left_wheel", "drives left_weel", 1)
    file.write_text(text)
    assert mindc("lint", file, "--fix").code == 1
    assert file.read_text() == text


def test_what_is_no_mind_by_itself_is_read_with_who_uses_it(mindc: Call, file: Path) -> None:
    head, rest = UNREAD.split("sensor pulse")
    Path("parts.mind").write_text("body Robot is disc\n" + "".join(head.partition("body Robot is disc\n")[2:]))
    file.write_text(f'use "parts.mind"\ntick 1/60 s\nmaster Roam\nsensor pulse{rest}')
    for command in ("lint", "check"):
        assert mindc(command, "parts.mind").code == 0, "a b.mind, beside it, is a whole mind with it"
    assert mindc("check", "parts.mind", file).code == 0
    said = mindc("lint", "parts.mind", file, "--format", "json")
    assert {each["file"] for each in json.loads(said.out)["diagnostics"]} == {"a b.mind"}


def test_github(mindc: Call, file: Path) -> None:
    said = mindc("lint", file, "--select", "unread-sensor", "--format", "github")
    place = "file=a b.mind,line=7,col=8,endLine=7,endColumn=13"
    message = "Nobody reads pulse. Add reads pulse to a skill, or take the sensor out."
    assert said.out == f"::warning {place},title=unread-sensor::{message}\n"


def sarif(mindc: Call, *files: object) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(mindc("lint", *files, "--format", "sarif").out)
    return found


def test_sarif(mindc: Call, file: Path) -> None:
    Path("bad.mind").write_text(RULES.replace("sensor feeler", "sensor feeler is battery\nsensor feeler"))
    found = sarif(mindc, file, "bad.mind", "nowhere.mind")
    jsonschema.validate(found, json.loads(SCHEMA.read_text()))
    run = found["runs"][0]
    results = {result["ruleId"]: result for result in run["results"]}
    assert {"unread-sensor", "unreadable"} <= set(results)
    place = results["unread-sensor"]["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"] == "a%20b.mind"
    assert place["region"] == {"startLine": 7, "startColumn": 8, "endLine": 7, "endColumn": 13}
    assert {rule["id"] for rule in run["tool"]["driver"]["rules"]} == set(results)


def test_the_fingerprint_of_a_finding_stays_where_lines_are_added(mindc: Call, file: Path) -> None:
    def fingerprint() -> str:
        result: str = sarif(mindc, file)["runs"][0]["results"][0]["partialFingerprints"]["line/v1"]
        return result

    before = fingerprint()
    file.write_text(f"# above\n\n{UNREAD}")
    assert fingerprint() == before


@pytest.mark.slow
@pytest.mark.skipif("SARIF_SCHEMA" not in os.environ, reason="needs SARIF_SCHEMA=sarif-schema-2.1.0.json of OASIS")
def test_sarif_against_its_own_schema(mindc: Call) -> None:
    wrong = sorted((Path(__file__).parents[1] / "language" / "wrong").glob("*.mind"))
    jsonschema.validate(sarif(mindc, *wrong), json.loads(Path(os.environ["SARIF_SCHEMA"]).read_text()))


ODD = "\u202e\u2066\x1b[31m\x07\u200b\ufeff\x85"


@pytest.mark.parametrize("as_", ["text", "github"])
def test_no_character_of_a_source_does_something_to_a_terminal(mindc: Call, file: Path, as_: str) -> None:
    file.write_text(RULES.replace("reads feeler", f"reads feeler{ODD}\n  reads x{ODD}y  # {ODD}"))
    said = mindc("lint", file, "--format", as_)
    assert said.code == 1
    assert not set(ODD) - set("[31m") & set(said.out + said.err)
    odd_name = Path(f"x{ODD.replace(chr(0x85), '')}.mind")
    odd_name.write_text("reads\n")
    said = mindc("lint", odd_name, "--format", as_)
    assert not set(ODD) - set("[31m") & set(said.out + said.err)
