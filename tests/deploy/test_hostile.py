"""Names that would like to be options, paths or commands are names, or refused."""

import json
import shutil
from pathlib import Path

import pytest

from mindlang.robot.remote import parse_events, script
from tests.calling import Call
from tests.deploy.robot import HOST, FakeRobot

Bundles = tuple[Path, Path, Path]
HOSTS = [
    "a b",
    "pi@robot; touch pwned",
    "-oProxyCommand=touch pwned",
    "pi@-oX",
    "$(touch pwned)",
    "a:b",
    "pi@",
    "ö",
]
NAME = """-rf it's; "$(touch pwned)" `touch pwned`\n.bundle"""


@pytest.mark.parametrize("host", HOSTS)
def test_hosts(host: str, robot: FakeRobot, bundles: Bundles, mindc: Call) -> None:
    said = (
        mindc("deploy", bundles[0], "--", host) if not host.startswith("-") else mindc("deploy", "--", bundles[0], host)
    )
    assert said.code == 1
    assert "is not a host" in said.err
    assert robot.log("ssh.log") == []


def test_bundles(
    old: str, robot: FakeRobot, bundles: Bundles, mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copy(bundles[0], tmp_path / NAME)
    monkeypatch.chdir(tmp_path)
    assert mindc("deploy", "--watch", 0, "--", NAME, HOST).code == 0
    assert robot.current() != old
    assert not list(tmp_path.rglob("pwned"))
    listed = json.loads(mindc("deploy", HOST, "--list", "--json").out)
    assert listed["releases"][-1]["bundle"] == NAME
    assert len(mindc("deploy", HOST, "--list").out.splitlines()) == 2


def test_words_stay_words() -> None:
    last = script("accept", ["it's", "$(touch pwned)", ""]).decode().splitlines()[-1]
    assert last == """{ main accept 'it'"'"'s' '$(touch pwned)' ''; exit; }"""


def test_the_greeting_of_a_shell_is_no_event() -> None:
    assert list(parse_events(b"Welcome!\ncurrent\tone\n\xff\n")) == [("current", "one")]
