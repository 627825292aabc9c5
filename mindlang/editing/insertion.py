"""Splices of whole lines: facts and declarations below others of their kind, with the comments that belong to them."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile

from mindlang.compiler.source import Source, Span, Splice
from mindlang.compiler.syntax import PARTS, VERBS, VERBS_OF, Declaration, Fact, File, Setting, Use, verb_of

INDENT = "  "
NOUNS = ("body", "actuator", "sensor", "memory", "skill", "scene", "task", "curriculum")  # in the order of a file
FACTS = tuple(dict.fromkeys(("draws", *VERBS)))  # in the order of a declaration: what is drawn before what it places


class SourceLine(Span):
    """A line of a source, comment and indentation included, without its line end."""

    __slots__ = ()

    @property
    def indent(self) -> str:
        """The blanks with which it begins."""
        return self.text[: len(self.text) - len(self.text.lstrip())]

    @property
    def is_blank(self) -> bool:
        """True if nothing but white space stands on the line."""
        return not self.text.strip()

    @property
    def is_comment(self) -> bool:
        """True if only a comment stands on the line."""
        return self.text.lstrip().startswith("#")

    def above(self) -> Iterator["SourceLine"]:
        """The lines above, from this one up."""
        line = self
        while line.start:
            line = _line_at(self.source, line.start - 1)
            yield line

    def below(self) -> Iterator["SourceLine"]:
        """The lines below, from this one down."""
        line = self
        while (start := self.source.text.find("\n", line.end) + 1) and start < len(self.source.text):
            line = _line_at(self.source, start)
            yield line


def first_line(span: Span) -> SourceLine:
    return _line_at(span.source, span.start)


def newline(source: Source) -> str:
    """The line end of a source."""
    return "\r\n" if "\r\n" in source.text else "\n"


def insert_below(line: SourceLine, texts: Iterable[str]) -> Splice:
    """Lines below a line; where that is the last one and has no line end, the new last one has none."""
    return Splice(line.source, line.end, line.end, newline(line.source).join(["", *texts]))


def remove_lines(first: SourceLine, last: SourceLine) -> Splice:
    """Lines taken out with the line end before them; the first of a source with what is blank below them."""
    if above := next(first.above(), None):
        return Splice(first.source, above.end, last.end, "")
    below = next((line for line in last.below() if not line.is_blank), None)
    return Splice(first.source, 0, below.start if below else len(first.source.text), "")


def _line_at(source: Source, offset: int) -> SourceLine:
    text = source.text
    start, end = text.rfind("\n", 0, offset) + 1, text.find("\n", offset)
    end = len(text) if end < 0 else end
    return SourceLine(source, start, end - text[start:end].endswith("\r"))


Extent = tuple[SourceLine, SourceLine]  # the first and the last line


def owners(fact: str) -> tuple[str, ...]:
    """The nouns below which a fact of this verb may stand; none where it begins with no verb."""
    verb = fact.partition(" ")[0]
    return tuple(noun for noun, verbs in VERBS_OF.items() if verb in verbs)


def replace_span(span: Span, text: str) -> Splice:
    """Replace the text of a span, with a space where it would join a neighbouring word: `at-eye` becomes `at 0`."""
    is_glued = span.source.text[span.start - 1 : span.start].isalnum() and text[:1].isalnum()
    return Splice(span.source, span.start, span.end, f" {text}" if is_glued else text)


def replace_line(fact: Fact, texts: Iterable[str]) -> Splice:
    """Replace the line of a fact, with its comment, by other lines."""
    line = first_line(fact.span)
    return Splice(line.source, line.start, line.end, newline(line.source).join(texts))


def line_of(fact: Fact) -> str:
    """The line of a fact with its comment, from its verb on."""
    return first_line(fact.span).text.strip()


def commented(fact: Fact) -> list[str]:
    """The line of a fact below the comments that lead it, none of them indented."""
    line = first_line(fact.span)
    return [above.text.strip() for above in reversed(_leading(line))] + [line_of(fact)]


def without_line(what: Fact | Setting) -> Splice:
    """The line of a fact or a setting taken out, and its comment with it."""
    line = first_line(what.span)
    return remove_lines(line, line)


def below_siblings(declaration: Declaration, verb: str, texts: Iterable[str]) -> Splice:
    """Insert facts of one verb below the last one of that verb, or where the usual order puts them; indented."""
    earlier = FACTS[: FACTS.index(verb) + 1]
    above = [fact for fact in declaration.facts if verb_of(fact) in earlier]
    nearest = max(above, key=lambda fact: (earlier.index(verb_of(fact)), fact.span.start), default=None)
    indent = first_line(nearest.span).indent if nearest else indentation(declaration)
    return insert_below(first_line((nearest or declaration.header).span), [f"{indent}{text}" for text in texts])


def indentation(declaration: Declaration) -> str:
    """The white space before the facts of a declaration."""
    if declaration.facts:
        return first_line(declaration.facts[-1].span).indent
    return first_line(declaration.header.span).indent + INDENT


def declare(file: File, noun: str, *declarations: Sequence[str]) -> Splice:
    """Insert declarations below the last one of their noun, or of the noun that usually comes before it."""
    gap = [] if noun in PARTS else [""]
    first, *others = declarations
    texts = [*first, *(text for other in others for text in (*gap, *other))]
    siblings = [known for known in file.declarations if known.header.noun.text == noun]
    if siblings:
        last = _extent(siblings[-1])[1]
        set_off = gap or [""] * last.is_comment  # a comment right above would lead what is new
        return insert_below(last, [*set_off, *texts])
    earlier = NOUNS[: NOUNS.index(noun)]
    above = [known for known in file.declarations if known.header.noun.text in earlier]
    if above:
        nearest = max(above, key=lambda known: (earlier.index(known.header.noun.text), _start(known)))
        return declare_below(nearest, texts)
    return insert_below(first_line(file.settings[-1].span), ["", *texts])


def declare_below(declaration: Declaration, texts: Sequence[str]) -> Splice:
    """A declaration below another one."""
    return insert_below(_extent(declaration)[1], ["", *texts])


def use_line(file: File, path: str) -> Splice:
    """A line that uses a file, below the last such line, or above the first setting: what leads that leads the file."""
    line = f'use "{path}"'
    if used := [setting for setting in file.settings if isinstance(setting, Use)]:
        return insert_below(first_line(used[-1].span), [line])
    first = first_line(file.settings[0].span)
    return Splice(first.source, first.start, first.start, line + newline(first.source))


def without_declarations(declarations: Iterable[Declaration]) -> tuple[Splice, ...]:
    """Declarations taken out, with the comments that belong to them and the blank lines that set them off."""
    splices = []
    for first, last in _paragraphs(declarations):
        below = next(last.below(), None)
        if below is None or below.is_blank:  # else they set off what is said right below
            first = [first, *takewhile(lambda line: line.is_blank, first.above())][-1]
        splices.append(remove_lines(first, last))
    return tuple(splices)


def text_of(declarations: Sequence[Declaration]) -> str:
    """Declarations as a text of their own, with the comments that belong to them."""
    source = declarations[0].header.span.source
    end = newline(source)
    texts = (source.text[first.start : last.end] for first, last in _paragraphs(declarations))
    return (end * 2).join(texts) + end


def _paragraphs(declarations: Iterable[Declaration]) -> list[Extent]:
    """The extents of declarations of one file; those that follow one another are one extent."""
    found: list[Extent] = []
    for first, last in map(_extent, sorted(declarations, key=_start)):
        above = next((line for line in first.above() if not line.is_blank), None)
        if found and above == found[-1][1]:
            found[-1] = found[-1][0], last
        else:
            found.append((first, last))
    return found


def _extent(declaration: Declaration) -> Extent:
    """From the first comment that leads a declaration to its last line, or the last comment that belongs to it."""
    header = first_line(declaration.header.span)
    spans = [declaration.header.span, *(fact.span for fact in declaration.facts)]
    last = first_line(max(spans, key=lambda span: span.end))
    return [header, *_leading(header)][-1], [last, *_closing(last, len(header.indent))][-1]


def _leading(line: SourceLine) -> list[SourceLine]:
    """The comments that lead what a line says, from the lowest up: those right above that close nothing else."""
    comments = list(takewhile(lambda above: above.is_comment, line.above()))
    indented = [place for place, comment in enumerate(comments) if len(comment.indent) > len(line.indent)]
    above = next([line, *comments][-1].above(), None)
    if above is not None and not above.is_blank:
        return comments[: indented[0]] if indented else comments
    while comments and len(comments[-1].indent) > len(line.indent):
        comments.pop()
    return comments


def _closing(last: SourceLine, margin: int) -> list[SourceLine]:
    """The lines below the last fact of a declaration, down to the last comment that belongs to it.

    Such a comment stands right below or, after blank lines, farther in than the header, and does not lead what follows.
    """
    unsaid = list(takewhile(lambda line: line.is_blank or line.is_comment, last.below()))
    following = next([last, *unsaid][-1].below(), None)
    free = unsaid[: len(unsaid) - len(_leading(following))] if following else unsaid
    right_below = sum(1 for _ in takewhile(lambda line: line.is_comment, free))
    farther_in = [place for place, line in enumerate(free, 1) if line.is_comment and len(line.indent) > margin]
    return free[: max([right_below, *farther_in])]


def _start(declaration: Declaration) -> int:
    return declaration.header.span.start
