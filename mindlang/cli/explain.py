"""`mindc explain`: what is this, and what is to be done about it?

Examples:
  mindc explain
  mindc explain wheel
  mindc explain sensor light
  mindc explain ultrasonic
  mindc explain teaches
  mindc explain mindrun replay
  mindc explain influence-cycle
  mindc explain unread-sensor --json
"""

import click
from mindrun.files.printable import visible

from mindlang.cli._options import json_flag, one_of
from mindlang.cli._terminal import MISUSE, fail, print_result


def _names() -> dict[str, str]:
    """The names of all articles, with the sort of each."""
    from mindlang.cli._articles import command_articles
    from mindlang.explaining.collection import articles

    return {each.name: each.sort for each in (*command_articles(), *articles())}


@click.command
@click.argument("name", nargs=-1, shell_complete=one_of(_names))
@json_flag("One JSON document instead: mindc explain comma --json")
def command(name: tuple[str, ...]) -> None:
    """Say what NAME means; without NAME list all codes.

    NAME is a kind (wheel), a driver (ultrasonic), a word of the language (teaches), a command of mindc or mindrun
    (train, replay), or the code in brackets at the end of a message. Where several things have the name, all are said;
    a noun before it chooses one: sensor light, mindrun doctor. Ends with 0, or with 2 where there is nothing of that
    name.
    """
    from rich.text import Text

    from mindlang.cli._articles import command_articles
    from mindlang.explaining.collection import articles, codes, find_articles, unknown_hint
    from mindlang.explaining.terminal import article_data, article_text, code_list

    if not name:
        data = {"articles": [article_data(each) for each in codes().values()]}
        print_result(data, lambda: Text.assemble(*code_list(codes().values())), end="")
        return
    asked = " ".join(" ".join(name).strip("[]").split())
    known = find_articles(asked, articles()) or find_articles(asked, [*command_articles()])
    if not known:
        hint = unknown_hint(asked, [*articles(), *command_articles()])
        fail(f"There is nothing called {visible(asked)}.", hint, MISUSE)
    data = {"articles": [article_data(each) for each in known]}
    print_result(data, lambda: Text("\n").join(Text.assemble(*article_text(each)) for each in known), end="")
