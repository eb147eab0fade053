"""The verb ``doctor``: whether everything is there that rovercheck needs, and what more there could be."""

import click

from rovercheck.checker.commands.shared.codes import Exit

EXAMPLES = """\b
Examples:
  rovercheck doctor
  rovercheck doctor --json
"""


@click.command(short_help="Report what is installed, what is missing, and whether it works.", epilog=EXAMPLES)
@click.option("--json", "as_json", is_flag=True, help="The findings as JSON.")
@click.option("--quiet", "-q", is_flag=True, help="Only what is missing or does not work.")
def doctor(as_json: bool, quiet: bool) -> Exit:
    """Report what is installed, what is missing and what it would add, and try every engine.

    Exit code 1 if something required is missing or does not work.
    """
    from rovercheck.checker.commands.doctor.run import doctor as run

    return run(as_json, quiet)
