"""What lets a shell complete the words of a program: a script for each shell, which asks the program at every tab.

The script runs the program with _PROGRAM_COMPLETE in the environment, which says the shell, and with the words so far.
It gets a line for each answer, its parts apart by tabs: what it is, what is to be written, and what that means.
"""

import shlex
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

WORD, BEGINNING, FILES = "word", "beginning", "files"  # what an answer is: behind a beginning stands no blank
BREAKS = ":="  # where bash begins a new word inside of one of ours


@dataclass(frozen=True, slots=True)
class Answer:
    """A word that fits; or FILES: `text` is how their names end, and `about` what stands before them in the word."""

    text: str
    about: str = ""
    kind: str = WORD


Answering = Callable[[list[str], str], Iterable[Answer]]  # the words before, and the word that is begun


def variable(program: str) -> str:
    """The variable of the environment in which a shell says that it asks."""
    return f"_{program.upper()}_COMPLETE"


def script(shell: str, program: str) -> str:
    """What one of SHELLS reads so that it completes the words of a program."""
    return SHELLS[shell].strip().replace("PROGRAM", program).replace("VARIABLE", variable(program)) + "\n"


def reply(shell: str, arguments: Sequence[str], answering: Answering) -> str:
    """The lines that a script gets for the arguments with which it has begun the program."""
    said, breaks = [*arguments], ""
    if shell == "bash":
        line, breaks = [*arguments, "", ""][:2]
        said = words_of(line)[1:]
    *before, begun = said or [""]
    option, equals, value = begun.partition("=")
    if equals and begun.startswith("--"):
        before, begun = [*before, option], value
        found = [_behind(f"{option}=", each) for each in answering(before, begun)]
    else:
        found = [*answering(before, begun)]
    word = said[-1] if said else ""
    cut = max((word.rfind(each) + 1 for each in BREAKS if each in breaks), default=0)
    lines = ("\t".join((each.kind, each.text, *each.about.split("\n")[:1])) for each in _without(word[:cut], found))
    return "".join(f"{line}\n" for line in lines)


def words_of(line: str) -> list[str]:
    """The words of a line as a shell has them; the last is where it ends, be it within quotation marks or empty."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars=False)
    lexer.whitespace_split, lexer.commenters = True, ""
    found: list[str] = []
    try:
        found += lexer
    except ValueError:  # a quotation that is not closed
        return [*found, lexer.token]
    return [*found, ""] if not found or line[-1].isspace() else found


def _behind(prefix: str, answer: Answer) -> Answer:
    if answer.kind == FILES:
        return replace(answer, about=prefix + answer.about)
    return replace(answer, text=prefix + answer.text)


def _without(prefix: str, answers: Iterable[Answer]) -> Iterable[Answer]:
    """Answers without what bash has for words of their own."""
    for each in answers:
        yield each if each.kind == FILES else replace(each, text=each.text.removeprefix(prefix))


BASH = r"""
_PROGRAM_completion() {
    local kind text about found
    COMPREPLY=()
    while IFS=$'\t' read -r kind text about; do
        case $kind in
            beginning) compopt -o nospace; COMPREPLY+=("$text") ;;
            word) COMPREPLY+=("$text") ;;
            files)
                compopt -o filenames
                mapfile -t found < <(compgen -f -X "!*$text" -- "$2")
                if [[ ${#found[@]} -eq 0 ]]; then
                    mapfile -t found < <(compgen -f -- "$2")
                elif [[ -n $text ]]; then
                    mapfile -t -O ${#found[@]} found < <(compgen -d -- "$2")
                fi
                COMPREPLY+=("${found[@]}")
                [[ ${#COMPREPLY[@]} -gt 0 ]] || compopt -o default ;;
        esac
    done < <(VARIABLE=bash "$1" "${COMP_LINE:0:COMP_POINT}" "$COMP_WORDBREAKS" 2>/dev/null)
}
complete -o nosort -F _PROGRAM_completion PROGRAM
"""

ZSH = r"""
#compdef PROGRAM
_PROGRAM_completion() {
    local kind text about
    local -a described plain beginnings
    while IFS=$'\t' read -r kind text about; do
        case $kind in
            beginning) beginnings+=("$text") ;;
            word)
                if [[ -n $about ]]; then described+=("${text//:/\\:}:$about"); else plain+=("$text"); fi ;;
            files)
                [[ -z $about ]] || compset -P "${(b)about}"
                if [[ -n $text ]]; then _files -g "*$text"; else _files; fi ;;
        esac
    done < <(VARIABLE=zsh "${(Q)words[1]}" "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)
    (( $#described )) && _describe -V unsorted described
    (( $#plain )) && compadd -V unsorted -a plain
    (( $#beginnings )) && compadd -S '' -V unsorted -a beginnings
}
compdef _PROGRAM_completion PROGRAM
"""

FISH = r"""
function _PROGRAM_completion
    set -l before (commandline -opc)
    set -l begun (commandline -ct)
    for line in (VARIABLE=fish $before[1] $before[2..-1] "$begun" 2>/dev/null)
        set -l parts (string split \t -- $line)
        if test $parts[1] = files -a -z "$parts[3]"
            __fish_complete_suffix "$parts[2]"
        else if test $parts[1] = files
            set -l path (string replace -- "$parts[3]" '' "$begun")
            for name in $path*$parts[2] $path*/
                echo $parts[3]$name
            end
        else
            string join -- \t $parts[2..-1]
        end
    end
end
complete --no-files --keep-order --command PROGRAM --arguments '(_PROGRAM_completion)'
"""

SHELLS: Mapping[str, str] = {"bash": BASH, "zsh": ZSH, "fish": FISH}
