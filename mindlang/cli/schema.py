"""`mindc schema`: the JSON Schema of `robot.yaml`.

Examples:
  mindc schema > robot.schema.json
Then an editor that knows YAML completes and checks a file that begins with:
  # yaml-language-server: $schema=robot.schema.json
"""

import click

from mindlang.cli._terminal import print_json


@click.command
def command() -> None:
    """Print the JSON Schema of robot.yaml.

    With every driver that is installed, and its options.
    """
    from mindlang.robot.options import schema

    print_json(schema())
