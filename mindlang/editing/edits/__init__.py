"""The edits of a hierarchy, one a file: a function of a project that says what to splice.

What the signatures say of the command line is read from them here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from inspect import Parameter, getdoc, signature
from pkgutil import iter_modules
from typing import Annotated, Any, get_args, get_origin, get_type_hints

Function = Callable[..., Any]


@dataclass(frozen=True, slots=True)
class EditOption:
    """An option of an edit; `many` may be said several times."""

    name: str
    many: bool
    default: Any
    help: str


@dataclass(frozen=True, slots=True)
class Edit:
    """An edit as a command: its arguments in their order (`many`: one or more), its options, its explanation."""

    name: str
    function: Function
    arguments: tuple[tuple[str, bool], ...]
    options: tuple[EditOption, ...]
    text: str
    example: str


def names() -> list[str]:
    """The names of all edits."""
    return sorted(module.name for module in iter_modules(__path__))


def edit(name: str) -> Edit:
    """The edit of that name: the function `NAME` in the module `mindlang.editing.edits.NAME`."""
    function = getattr(import_module(f"{__name__}.{name}"), name)
    hints = get_type_hints(function, include_extras=True)
    parameters = list(signature(function).parameters.values())[1:]  # the first is the project
    text, _, example = (getdoc(function) or "").partition("Example: ")
    return Edit(
        name,
        function,
        tuple((p.name, _is_repeatable(hints[p.name])) for p in parameters if p.kind is not Parameter.KEYWORD_ONLY),
        tuple(
            EditOption(p.name, _is_repeatable(hints[p.name]), p.default, get_args(hints[p.name])[1])
            for p in parameters
            if p.kind is Parameter.KEYWORD_ONLY
        ),
        text.strip(),
        f"Example: {example.strip()}",
    )


def _is_repeatable(hint: Any) -> bool:
    plain = get_args(hint)[0] if get_origin(hint) is Annotated else hint
    return get_origin(plain) is tuple
