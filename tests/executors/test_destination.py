"""What stands behind `dask:`: an address or a scheduler file, to which there is a safe way, or one sentence."""

from pathlib import Path

import pytest
from mindrun.errors import MindError

from mindlang.executors.dask import Destination, destination, flaw_of
from mindlang.executors.jobs import WorkError

FILES = {
    "open.json": b'{"address": "tcp://10.1.2.3:8786"}',
    "near.json": b'{"address": "tcp://127.0.0.1:8786", "workers": {}}',
    "tls.json": b'{"address": "tls://10.1.2.3:8786"}',
    "garbage.json": b"\xff\x00{",
    "list.json": b"[1, 2]",
    "deep.json": b"[" * 100_000,
    "number.json": b'{"address": 8786}',
    "other.json": b'{"address": "inproc://10.1.2.3/1/1"}',
    "nowhere.json": b'{"address": "tcp://10.1.2.3:99999"}',
}


@pytest.fixture(autouse=True)
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, data in FILES.items():
        Path(name).write_bytes(data)


@pytest.mark.parametrize(
    ("argument", "address"),
    [
        ("127.0.0.1:8786", "tcp://127.0.0.1:8786"),
        ("localhost:8786", "tcp://localhost:8786"),
        ("tcp://[::1]:8786", "tcp://[::1]:8786"),
        ("tls://head.cluster:8786", "tls://head.cluster:8786"),
        ("10.0.0.1:8786,trusted", "tcp://10.0.0.1:8786"),
        ("open.json,trusted", "tcp://10.1.2.3:8786"),
        ("near.json", "tcp://127.0.0.1:8786"),
        ("tls.json,tls.pem", "tls://10.1.2.3:8786"),
    ],
)
def test_an_address_to_which_there_is_a_safe_way(argument: str, address: str) -> None:
    assert flaw_of(argument) == ""
    assert destination(argument).address() == address


def test_behind_the_comma_stands_how_it_is_reached() -> None:
    assert destination("a:1,keys/tls.pem") == Destination("a:1", "keys/tls.pem")
    assert destination("a:1,trusted") == Destination("a:1", is_trusted=True)


@pytest.mark.parametrize(
    ("argument", "words"),
    [
        ("", "it says no scheduler"),
        (",tls.pem", "it says no scheduler"),
        ("127.0.0.1:9,", "it says no scheduler"),
        ("ucx://a:1", "'ucx://a:1' is no address"),
        ("tcp://a:123456", "is no address"),
        ("tcp://a b:1", "is no address"),
    ],
)
def test_what_is_no_address_is_refused(argument: str, words: str) -> None:
    assert words in flaw_of(argument)


@pytest.mark.parametrize(
    ("argument", "words"),
    [
        ("tcp://10.0.0.1:8786", "what goes to tcp://10.0.0.1:8786 is not encrypted"),
        ("tcp://10.0.0.1:8786,tls.pem", "is not encrypted"),
        ("head:8786", "is not encrypted"),
        ("localhost.evil.org:8786", "is not encrypted"),
        ("0.0.0.0:8786", "is not encrypted"),
        ("open.json", "what goes to tcp://10.1.2.3:8786 is not encrypted"),
        ("moon.json", "there is no scheduler file moon.json"),
        ("garbage.json", "garbage.json is no scheduler file"),
        ("list.json", "is no scheduler file"),
        ("deep.json", "is no scheduler file"),
        ("number.json", "is no scheduler file"),
        ("other.json", "is no scheduler file"),
        ("nowhere.json", "is no scheduler file"),
        ("/dev/zero", "/dev/zero cannot be read: it is a device"),
        (".", "it is a folder"),
    ],
)
def test_where_there_is_no_safe_way_it_is_said(argument: str, words: str) -> None:
    assert flaw_of(argument) == ""
    with pytest.raises(WorkError) as error:
        destination(argument).address()
    assert words in str(error.value)
    assert isinstance(error.value, MindError)
    assert error.value.hint
