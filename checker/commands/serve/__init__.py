"""The verb ``serve``: a live page of the charts, with verdicts, findings and an explorer."""

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import VariantOptions, modelling, quietly, varying

PORT = 8642
"""Where the page is unless somebody says otherwise."""

EXAMPLES = """\b
Examples:
  rovercheck serve
  rovercheck serve --model heater.py
  rovercheck serve --port 0 --open
"""


@click.command(short_help="A live page: explore the charts, with verdicts and findings.", epilog=EXAMPLES)
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=PORT,
    show_default=True,
    metavar="N",
    help="The port of the page; 0 takes a free one.",
)
@click.option(
    "--host",
    default="127.0.0.1",
    show_default=True,
    metavar="ADDRESS",
    help="Where it can be reached: by default from this machine only.",
)
@click.option("--open", "opening", is_flag=True, help="Open the page in the browser.")
@modelling
@varying
@quietly
def serve(port: int, host: str, opening: bool, charts: VariantOptions) -> Exit:
    """A live page of the charts: what can happen next, runs to a condition, verdicts, findings.

    Its address, with a token that is new each time, is printed; Ctrl-C ends it. A model of your own is read
    again whenever it is saved. The page fetches nothing from anywhere else.
    """
    from rovercheck.checker.commands.serve.run import serve as run

    return run(host, port, charts, opening=opening)
