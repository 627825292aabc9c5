"""What lets a shell complete the words of mindrun: a script for each shell, made of the parsers."""

from argparse import ArgumentParser
from collections.abc import Callable, Mapping
from shlex import quote

Words = Mapping[str, list[str]]  # the options of each tool, and of driving under ""


def script(shell: str, parsers: Mapping[str, ArgumentParser]) -> str:
    """The script for one of SHELLS; `parsers` are those of the tools by their names, and of driving under ""."""
    return SHELLS[shell]({name: _options(parser) for name, parser in parsers.items()})


def _options(parser: ArgumentParser) -> list[str]:
    """The options of a parser by their long names."""
    return [action.option_strings[-1] for action in parser._actions if action.option_strings]


def _tools(words: Words) -> str:
    return " ".join(name for name in words if name)


def _bash(words: Words) -> str:
    cases = "".join(f"        {name or '*'}) options={quote(' '.join(each))} ;;\n" for name, each in words.items())
    return f"""_mindrun() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} options
    case "${{COMP_WORDS[1]}}" in
{cases}    esac
    if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
    elif [[ $COMP_CWORD -eq 1 ]]; then
        compopt -o filenames
        COMPREPLY=($(compgen -W {quote(_tools(words))} -- "$word") $(compgen -f -- "$word"))
    fi
}}
complete -o default -F _mindrun mindrun
"""


def _zsh(words: Words) -> str:
    cases = "".join(f"        {name or '*'}) options=({' '.join(each)}) ;;\n" for name, each in words.items())
    return f"""#compdef mindrun
_mindrun() {{
    local -a options
    case "$words[2]" in
{cases}    esac
    if [[ $PREFIX == -* ]]; then
        compadd -- $options
    else
        (( CURRENT == 2 )) && compadd -- {_tools(words)}
        _files
    fi
}}
compdef _mindrun mindrun
"""


def _fish(words: Words) -> str:
    lines = [f"complete -c mindrun -n __fish_use_subcommand -a {quote(_tools(words))}"]
    for name, options in words.items():
        when = f"__fish_seen_subcommand_from {name or _tools(words)}"
        condition = quote(when if name else f"not {when}")
        lines += [f"complete -c mindrun -n {condition} -l {each[2:]}" for each in options if each.startswith("--")]
    return "\n".join([*lines, ""])


SHELLS: Mapping[str, Callable[[Words], str]] = {"bash": _bash, "zsh": _zsh, "fish": _fish}
