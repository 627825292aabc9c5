"""`mindc kinds`: which kinds and drivers are there?

Examples:
  mindc kinds
  mindc kinds sensor
  mindc kinds driver
  mindc kinds thing --json
"""

import click
from mindrun.files.printable import visible

from mindlang.cli._options import json_flag, one_of
from mindlang.cli._terminal import MISUSE, fail, print_result
from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.explaining.article import Article


def _known() -> tuple[Article, ...]:
    from mindlang.explaining.collection import driver_articles
    from mindlang.explaining.kinds import kind_articles

    return (*kind_articles(), *driver_articles())


@click.command
@click.argument("noun", required=False, shell_complete=one_of(lambda: {each.noun: "" for each in _known()}))
@json_flag("One JSON document instead: mindc kinds sensor --json")
def command(noun: str | None) -> None:
    """List the kinds of the language and the drivers.

    NOUN chooses some: body, actuator, sensor, memory, skill, scene, thing, event, measure, curriculum or driver.
    mindc explain says more of each. Ends with 0, or with 2 where there is no such noun.
    """
    from rich.text import Text

    from mindlang.explaining.collection import ALSO_CALLED
    from mindlang.explaining.terminal import article_data, kind_list

    known = _known()
    chosen = [each for each in known if noun is None or each.noun == ALSO_CALLED.get(noun, noun)]
    if not chosen:
        nouns = {each.noun: "" for each in known}
        near = did_you_mean(str(noun), nouns)
        fail(f"There are no kinds of {visible(str(noun))}.", near or f"Write {listed(nouns)}.", MISUSE)
    data = {"kinds": [article_data(each) for each in chosen]}
    print_result(data, lambda: Text.assemble(*kind_list(chosen)), end="")
