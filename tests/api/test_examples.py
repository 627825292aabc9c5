"""Every public name has an example in its docstring, and does what stands there."""

import inspect
from collections.abc import Iterator
from doctest import ELLIPSIS, DocTestFinder, DocTestRunner
from pathlib import Path

import mindrun
import numpy as np
import pytest

import mindlang

networkx = pytest.importorskip("networkx")


def documented() -> Iterator[tuple[str, object]]:
    """The public names, and those of their methods and properties that are their own."""
    for name in mindlang.__all__:
        value = getattr(mindlang, name)
        yield name, value
        if value.__module__ == "mindlang.api" and inspect.isclass(value):
            own = ((each, of) for each, of in vars(value).items() if not each.startswith("_"))
            yield from (
                (f"{name}.{each}", of) for each, of in own if inspect.isfunction(of) or isinstance(of, property)
            )


NAMES = dict(documented())


@pytest.mark.parametrize("name", NAMES)
def test_its_example_is_true(name: str, collect: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    if name == "plot_training":
        pytest.importorskip("matplotlib")
    monkeypatch.chdir(collect)
    known = {"mindlang": mindlang, "mindrun": mindrun, "networkx": networkx, "numpy": np}
    known["mind"] = mindlang.load("collect.mind")
    [example] = DocTestFinder(recurse=False).find(NAMES[name], name, globs=known)
    assert example.examples, "it has none"
    said: list[str] = []
    DocTestRunner(optionflags=ELLIPSIS).run(example, out=said.append)
    assert not said, "".join(said)
