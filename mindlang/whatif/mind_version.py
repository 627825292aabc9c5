"""A mind that takes the place of another: out of a bundle, or out of a source with the weights of its lock."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from mindrun.graph.bundle import read_bundle
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy

from mindlang.compiler.compile import Compiled
from mindlang.lock.ready import make_ready
from mindlang.run.setup import SetupError, train_command

BUNDLE_SUFFIX = ".bundle"


@dataclass(frozen=True, slots=True)
class MindVersion:
    """A mind that can act, under a master; `procedures` is their folder, or their texts by dotted name."""

    name: str
    policy: Policy
    procedures: Path | Mapping[str, str]
    master: str

    @property
    def graph(self) -> Graph:
        """Its hierarchy."""
        return self.policy.graph


def from_bundle(path: Path) -> MindVersion:
    """The mind of a bundle; BundleError where it is none."""
    found = read_bundle(path)
    return MindVersion(path.name, found.policy, found.procedures, found.graph.master)


def from_source(file: str, compiled: Compiled) -> MindVersion:
    """The mind of a source that compiled; SetupError where a skill has no weights that fit."""
    assert compiled.graph is not None
    ready = make_ready(compiled.graph, compiled.sources)
    if ready.refusals:
        raise SetupError("\n".join(ready.refusals), train_command(Path(file), ready))
    return MindVersion(Path(file).name, ready.policy, compiled.sources[0].folder, ready.policy.graph.master)
