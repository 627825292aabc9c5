"""`mindc explain`: what does this code mean, and what is to be done?"""

import click

EXAMPLES = """\b
Examples:
  mindc explain
  mindc explain influence-cycle
  mindc explain unread-sensor --json
  mindc explain ultrasonic
"""


@click.command(epilog=EXAMPLES)
@click.argument("code", required=False)
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc explain comma --json")
def command(code: str | None, as_json: bool) -> None:
    """Say what a code of a diagnostic means; without CODE list all.

    With a wrong example and a right one. The code stands in brackets at the end of a message. CODE can be a driver of
    a robot.yaml, too: what it is, and what it can be told. Ends with 0, or with 2 where there is no such code.
    """
    from mindrun.printable import visible
    from rich.text import Text

    from mindlang.cli._terminal import MISUSE, console, fail, print_json
    from mindlang.compiler.diagnostic import did_you_mean
    from mindlang.explaining.explanation import explanations
    from mindlang.explaining.show import as_data, contents, describe_explanation
    from mindlang.wiring.driver_page import driver_names, driver_page

    known = explanations()
    word = None if code is None else code.strip("[]")
    if word is not None and word in driver_names():
        if as_json:
            print_json({"driver": word, "page": driver_page(word)})
        else:
            click.echo(driver_page(word))
        return
    if word is not None and word not in known:
        fail(
            f"There is no code called {visible(word)}.",
            did_you_mean(word, [*known, *driver_names()])
            or "mindc explain lists them; those of a robot.yaml are in docs/robot-yaml.md.",
            MISUSE,
        )
    if as_json:
        print_json(as_data(known[word]) if word else {"codes": [as_data(each) for each in known.values()]})
        return
    console().print(Text.assemble(*(describe_explanation(known[word]) if word else contents(known.values()))), end="")
