"""Colours for the language on the site: a lexer for Pygments, with the words that the editor knows."""

from pygments.lexer import RegexLexer, bygroups, words
from pygments.token import Comment, Keyword, Name, Number, Operator, String, Text, Whitespace

from mindlang.explaining.kinds import words_of

NOUN = "|".join(words_of("Nouns"))
BEGINNINGS = rf"^([ \t]*)({'|'.join((*words_of('Settings'), *words_of('Verbs'), 'stop'))})\b"
DECLARATION = rf"^([ \t]*)({NOUN})([ \t]+)([\w.+]+)([ \t]+)(is|in)([ \t]+)([\w.]+)"
DECLARED = Keyword.Declaration, Name.Function, Keyword, Name.Class  # the words of a declaration
JOINING = sorted({word for phrase in words_of("Words") for word in phrase.split()})
UNIT = "|".join(unit for unit in words_of("Units") if unit != "%")


class MindLexer(RegexLexer):
    """A line begins with its noun or its verb; what is Capitalised is a skill, a task, a curriculum or a body."""

    name = "mind"
    aliases = ("mind",)
    filenames = ("*.mind", "*.break")
    tokens = {  # noqa: RUF012  (as Pygments has it)
        "root": [
            (r"#.*$", Comment.Single),
            (r'"[^"\n]*"', String.Double),
            (
                DECLARATION,
                bygroups(
                    Whitespace,
                    Keyword.Declaration,
                    Whitespace,
                    Name.Function,
                    Whitespace,
                    Keyword,
                    Whitespace,
                    Name.Class,
                ),
            ),
            (BEGINNINGS, bygroups(Whitespace, Keyword)),
            (rf"^([ \t]*)({NOUN})\b", bygroups(Whitespace, Keyword.Declaration)),
            (rf"(\d+(?:\.\d+)?(?:/\d+)?)([ \t]*)(%|(?:{UNIT})\b)", bygroups(Number, Whitespace, Keyword.Type)),
            (r"\d+(?:\.\d+)?(?:/\d+)?", Number),
            (words(JOINING, prefix=r"\b", suffix=r"\b"), Operator.Word),
            (r"(?:[a-z]\w*\.)?[A-Z]\w*(?:\+[A-Z]\w*)*", Name.Class),
            (r"[a-z]\w*(?:\.[a-z]\w*)*", Name.Variable),
            (r"[-+*/<>=()]", Operator),
            (r"\n|[ \t]+", Whitespace),  # the spaces of an indented line belong to its first word
            (r".", Text),
        ]
    }
