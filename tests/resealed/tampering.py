"""Content changed in ways that somebody who can compute every hash would try: types, sizes, depth, names, shapes."""

import json
from copy import deepcopy
from io import BytesIO
from random import Random
from typing import Any

import numpy as np

Place = tuple[dict[str, Any] | list[Any], Any]
MARK = "@nest@"  # stands where the text is to be nested deep

SCALARS: tuple[Any, ...] = (
    None, True, False, 0, 1, -1, 2, 15, 1000, 2**31, 2**53, 2**63, 2**64, 10**30, -(10**30), 10**400, "9" * 5000,
    0.0, -0.0, 0.5, 1.0, 1e-9, 1e-300, 5e-324, 1e9, 1e300, 1.7e308, float("inf"), float("-inf"), float("nan"),
    "", " ", "a", "A", "Go", "left_wheel", "ball", "left wheel", "a.b", "..", "/etc/passwd", "../../x", "x" * 3000,
    "\0", "\x1b[2J\x1b]0;title\a", "\u202egnp", "\ud800", "é", "٣", "NaN", "-", "rule", "mlp", "procedure", "wheel",
    [], {}, [[]], [{}], [None], {"is": []}, {"is": "mlp"}, {"is": "wheel", "more": 1}, MARK,
)  # fmt: skip


def document(data: bytes, rng: Random) -> bytes:
    """A JSON text with one to three of its places changed; a few times another text altogether."""
    if rng.random() < 0.03:
        return rng.choice((b"", b"[]", b"{}", b"null", b"7", b'"', b"\xff\xfe", b"[" * 50_000, b"\0" * 99, b"{" * 999))
    tree = [json.loads(data)]
    for _ in range(rng.randint(1, 3)):
        change(tree, rng)
    deep = rng.choice(("[" * 3000 + "]" * 3000, '{"a":' * 900 + "1" + "}" * 900))
    text = json.dumps(tree[0] if tree else None, ensure_ascii=rng.random() < 0.5)
    return text.replace(f'"{MARK}"', deep).encode("utf-8", "surrogatepass")


def change(tree: list[Any], rng: Random) -> None:
    """One change in a tree, which stands in a list of its own."""
    places = list(_places(tree))
    if not places:
        return
    holder, key = rng.choice(places)
    match rng.randrange(9):
        case 0:
            del holder[key]
        case 1 if isinstance(holder, dict):
            holder[rng.choice(("more", "is", "", "name", "\x1b[2J"))] = deepcopy(rng.choice(SCALARS))
        case 2 if isinstance(holder, dict):
            holder[f"{key}_"] = holder.pop(key)
        case 3 if isinstance(holder, list):
            holder[key:key] = [holder[key]] * rng.choice((1, 2, 1000))
        case 4:
            other, at = rng.choice(places)
            holder[key] = deepcopy(other[at])
        case _:
            holder[key] = deepcopy(rng.choice(SCALARS))


def _places(tree: Any) -> Any:
    keys = list(tree) if isinstance(tree, dict) else range(len(tree)) if isinstance(tree, list) else ()
    for key in keys:
        yield tree, key
        yield from _places(tree[key])


def vector(data: bytes, rng: Random) -> bytes:
    """A .npy file with another header, or other numbers."""
    start = 10 + int.from_bytes(data[8:10], "little")
    values = np.frombuffer(data[start:], "<f4").copy()
    match rng.randrange(6):
        case 0:
            return _saved(values, rng)
        case 1 if len(values):
            values[rng.randrange(len(values))] = rng.choice((np.nan, np.inf, -np.inf, 3e38, 1e-45, -0.0))
            return data[:start] + values.tobytes()
        case 2:
            return data[: rng.randrange(len(data))]
        case 3:
            return data + rng.randbytes(rng.choice((1, 4, 4096)))
        case 4:
            return _headed(rng.choice(HEADERS), values.tobytes())
    changed = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        changed[rng.randrange(start)] = rng.randrange(256)
    return bytes(changed)


def _saved(values: np.ndarray, rng: Random) -> bytes:
    """As numpy would write it, of another type or shape."""
    kinds = ("<f4", ">f4", "<f8", "<f2", "<i4", "<u8", "?", "<c8", "S4", "U2", [("a", "<f4"), ("b", "<f4")])
    array = np.zeros(len(values), rng.choice(kinds))
    shaped = rng.choice((array, array[None], array[:0], array[:1].reshape(()), np.asfortranarray(np.ones((3, 3)))))
    file = BytesIO()
    np.lib.format.write_array(file, shaped, version=rng.choice(((1, 0), (2, 0), (3, 0))))
    return file.getvalue()


SHAPED = b"{'descr': '<f4', 'fortran_order': False, 'shape': "
HEADERS = (
    b"", b"{", b"}", b"{}", b"(" * 9000, b"[" * 200 + b"]" * 200, b"\xff" * 70, b"1" * 9000, b"\0" * 64, SHAPED[:16],
    b"{1: 2, 'a': 3, 'shape': ()}", b"__import__('os')", b"{'descr': [], 'fortran_order': False, 'shape': (1,)}",
    b"{'descr': '|O', 'fortran_order': False, 'shape': (1,), }", SHAPED + b"(-1,), }", SHAPED + b"(1,), 'more': [], }",
    b"{'descr': '<f4', 'fortran_order': 1, 'shape': (1,), }", SHAPED + b"(" + b"9" * 4000 + b",), }",
)  # fmt: skip


def _headed(text: bytes, values: bytes) -> bytes:
    text = text[:65534] + b"\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text + values


def lines(data: bytes, rng: Random) -> bytes:
    """A text with words and lines of it changed, doubled, moved or gone."""
    found = data.split(b"\n")
    for _ in range(rng.randint(1, 3)):
        number = rng.randrange(len(found))
        words = found[number].split(b" ")
        match rng.randrange(5):
            case 0:
                del found[number]
            case 1:
                found.insert(rng.randrange(len(found) + 1), found[number])
            case 2:
                found[number] = found[number][: rng.randrange(len(found[number]) + 1)]
            case _:
                words[rng.randrange(len(words))] = rng.choice(WORDS)
                found[number] = b" ".join(words)
        if not found:
            return b""
    return b"\n".join(found)


WORDS = (
    b"", b"|", b"=", b":", b"0" * 64, b"9" * 5000, b"1e999", b"-1e400", b"nan", b"-0", b"\x1b[2J", b"\xff", b"\0",
    b"\r", b"[" * 5000, b'{"is": []}', b"null", b"true", b"world", b"with", b"taught", b"../..", b"a" * 70_000,
)  # fmt: skip
