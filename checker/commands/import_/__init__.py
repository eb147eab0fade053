"""The verb ``import``: what is drawn in a file of Simulink, or stands in a machine of SCXML or XState."""

from pathlib import Path

import click

from rovercheck.checker.commands.shared.codes import Exit, UsageError

EXAMPLES = """\b
Examples:
  rovercheck import supervisor.slx
  rovercheck import supervisor.slx --beside parameters.m --beside types.sldd
  rovercheck import supervisor.slx --compare run.csv
  rovercheck import supervisor.slx --propose-domains
  rovercheck import supervisor.slx --write supervisor
  rovercheck import supervisor.slx --json
  rovercheck import door.scxml
  rovercheck import machine.json
"""

FILE = click.Path(path_type=Path)


@click.command("import", short_help="Say what is drawn in a file of Simulink.", epilog=EXAMPLES)
@click.argument("model", type=FILE, metavar="MODEL.slx")
@click.option(
    "--beside", type=FILE, multiple=True, metavar="FILE",
    help="A data dictionary (.sldd), a library (.slx), a class of an enumeration or a script of values (.m) "
    "that the model uses.  The dictionary that the model names, and libraries and classes in its folder, are "
    "found.",
)  # fmt: skip
@click.option(
    "--compare", "log", type=FILE, metavar="LOG.csv",
    help="Run the model on the inputs of a log, a row a step, and compare its outputs: columns are named as "
    "the ports, elements as in probe.level and force(2).",
)  # fmt: skip
@click.option(
    "--propose-domains", "propose", is_flag=True,
    help="Write MODEL.domains.toml beside the model: a domain for each input and datum whose values do not "
    "follow from the file, to be corrected.",
)  # fmt: skip
@click.option("--force", is_flag=True, help="With --propose-domains: also where that file is there.")
@click.option(
    "--strict", is_flag=True,
    help="Exit code 2 also where something is read only with a note, or needs a domain; what the file of "
    "domains lets be free is refused.",
)  # fmt: skip
@click.option(
    "--write", "folder", type=FILE, metavar="FOLDER",
    help="Write the model into a new folder as an ordinary model in Python, which may be read and "
    "edited, once it is compared with what is drawn.",
)  # fmt: skip
@click.option("--json", "as_json", is_flag=True, help="All that was read, as JSON.")
def import_(
    model: Path,
    beside: tuple[Path, ...],
    log: Path | None,
    propose: bool,
    force: bool,
    strict: bool,
    folder: Path | None,
    as_json: bool,
) -> Exit:
    """Say what is drawn in a file of Simulink: charts, blocks, types, events, timers; without MATLAB.

    A machine in SCXML (.scxml) or of XState (.json) is read in the same way.

    Exit code 2 if something in it has no meaning here, 1 if a log differs from the model.
    """
    if model.suffix in (".scxml", ".json"):  # what reads either is loaded only then
        from rovercheck.checker.commands.import_.machine import import_machine, propose_ranges

        if propose:
            return propose_ranges(model, force)
        return import_machine(model, bool(beside or log or strict or folder), as_json=as_json)
    from rovercheck.checker.commands.import_.propose import propose_domains
    from rovercheck.checker.commands.import_.run import import_model

    if folder is not None:
        if log or propose or as_json or strict or force:
            raise UsageError("--write goes with --beside alone; leave out the other options, or --write.")
        from rovercheck.checker.commands.import_.written import write_model

        return write_model(model, beside, folder)
    if propose:
        return propose_domains(model, beside, force)
    return import_model(model, beside, log, strict=strict, as_json=as_json)
