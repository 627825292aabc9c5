"""The command line `mindc`: one command a file, found by looking, imported only when asked for."""

import os
import sys
from gc import set_threshold
from importlib import import_module
from inspect import cleandoc
from pkgutil import iter_modules
from threading import active_count

import click
from mindrun.errors import MindError, surroundings
from mindrun.terminal import standard_streams
from mindrun.terminal.arguments import emptiness

from mindlang.cli._terminal import FINDINGS, INTERRUPTED, MISUSE, OK, complain

EXAMPLES = "\n\nExamples:"  # what a command's text ends with
# Objects made before Python looks for garbage among them: a large mind is millions, and none of them garbage.
GARBAGE_COLLECTION_OBJECTS = 1_000_000
YOUNG_COLLECTIONS = 1  # before it looks among older ones, too


class Suggesting(click.Group):
    """A group of commands that suggests one for a name that is nearly right; `noun` is the word for one."""

    noun = "command"

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that is asked for; a name that is nearly right gets a suggestion."""
        if args and not args[0].startswith("-") and args[0] not in self.list_commands(ctx):
            from mindlang.compiler.diagnostic import did_you_mean

            hint = did_you_mean(args[0], self.list_commands(ctx)) or f"`{ctx.command_path} --help` lists them."
            raise click.UsageError(f"There is no {self.noun} called {args[0]!r}. {hint}", ctx)
        return super().resolve_command(ctx, args)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of that name; the examples with which its docstring ends stand below its options."""
        if cmd_name not in self.list_commands(ctx):
            return None
        command = self.load(cmd_name)
        text, examples, calls = cleandoc(command.help or "").partition(EXAMPLES)
        if examples:
            command.help, command.epilog = text, f"\b\n{examples.lstrip()}{calls}"
        return command

    def load(self, name: str) -> click.Command:
        """A command of the list."""
        return self.commands[name]


class Commands(Suggesting):
    """The modules of this package as commands, imported when asked for; each has a click command called `command`."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the words of a command line; ClickException where one is empty, which is no name, number or file."""
        if not ctx.resilient_parsing and (flaw := emptiness(args)):
            raise click.ClickException(f"{flaw[0].upper()}{flaw[1:]}.\n  Write something there, or leave it out.")
        return super().parse_args(ctx, args)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names of all commands; what they share has a name that begins with _."""
        return sorted(module.name for module in iter_modules(__path__) if not module.name.startswith("_"))

    def load(self, name: str) -> click.Command:
        """The command of a module, with the examples with which the module's docstring ends."""
        module = import_module(f"{__name__}.{name}")
        command: click.Command = module.command
        _, examples, calls = str(module.__doc__).partition(EXAMPLES)
        command.help = cleandoc(command.help or "") + examples + calls
        return command


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Try: mindc check examples/collect/collect.mind",
)
@click.version_option(package_name="mindlang", prog_name="mindc")
def commands() -> None:
    """Check, train and run behaviours declared in the mind language."""


def main() -> None:
    """Run one command; whatever happens ends in one message and an exit code, never in a traceback."""
    set_threshold(GARBAGE_COLLECTION_OBJECTS, YOUNG_COLLECTIONS)
    standard_streams.prepare()
    code = _run()
    if why := standard_streams.finish():
        complain(why)
        code = code or FINDINGS
    if code == INTERRUPTED and active_count() > 1:  # the simulator's threads would be waited for
        os._exit(code)
    sys.exit(code)


def _run() -> int:
    try:
        if "_MINDC_COMPLETE" in os.environ:  # a shell asks click what may come next
            import_module(f"{__name__}.completion")
        code = commands.main(prog_name="mindc", standalone_mode=False)
    except SystemExit as stop:
        code = stop.code
    except click.exceptions.Exit as stop:
        code = stop.exit_code
    except click.ClickException as misuse:
        misuse.show()
        code = misuse.exit_code if isinstance(misuse, click.UsageError) else MISUSE
    except (click.Abort, KeyboardInterrupt):
        code = INTERRUPTED
    except Exception as error:
        code = _unforeseen(error)
    return code if isinstance(code, int) else OK


def _unforeseen(error: Exception) -> int:
    if os.environ.get("MIND_DEBUG"):
        raise error
    if isinstance(error, MindError):  # a procedure that fails in the middle of a run, say
        complain(str(error), error.hint)
    elif why := surroundings(error):
        complain(why)
    else:
        complain(
            f"mindc failed: {type(error).__name__}: {error}", "Set MIND_DEBUG=1 to see where, and please report it."
        )
    return FINDINGS
