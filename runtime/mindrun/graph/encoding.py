"""A graph or a wiring from outside, as `codec.encode` made it: each of its parts, and what holds them together."""

from importlib import import_module
from typing import TypeVar

from mindrun.errors import BundleError
from mindrun.graph import codec
from mindrun.graph.codec import CodecError
from mindrun.graph.graph import Graph
from mindrun.graph.validate import graph_flaw
from mindrun.graph.wiring import Wiring, flaws

T = TypeVar("T")


def decode(data: object, is_older: bool = False) -> Graph:
    """The graph that `encode` made this data of; BundleError where anything is missing, unknown or out of range.

    Data that `is_older` may lack what there was no word for.
    """
    graph = decode_part(Graph, data, "graph", is_older)
    found = graph_flaw(graph)
    if found:
        raise BundleError(f"this graph is damaged: {found}")
    return graph


def decode_wiring(data: object, graph: Graph) -> Wiring:
    """The wiring that `encode` made this data of; BundleError where it is damaged, or one for another mind."""
    import_module("mindrun.robot.drivers")  # registers them all; a mind without a robot needs none

    wiring = decode_part(Wiring, data, "wiring")
    for found in flaws(wiring, graph):
        raise BundleError(f"this wiring does not fit its mind: {found}")
    return wiring


def decode_part(hint: type[T], data: object, where: str, is_older: bool = False) -> T:
    """A part of a graph that `encode` made this data of; BundleError where it is not a `hint`."""
    try:
        part: T = codec.decode(hint, data, where, is_older=is_older)
    except CodecError as error:
        raise BundleError(str(error) if error.unknown else f"this is damaged: {error}") from error
    return part
