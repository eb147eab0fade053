"""Measures what is found of the differences that are planted in four firmwares.

    python -m benchmarks.twins [FIRMWARE...] [--stage STAGE]... [--examples N] [--logs N] [--seconds S]

Stages: ``base`` (does each firmware conform before anything is planted), ``twin`` (which differences are
told), ``causes`` (the same, with deviations merged by cause), ``further`` (are faults on top of what is known
reported as new), ``variant`` (do the charts with the causes written as changes do the same), ``logs`` (what
is said of logs of the twins), and ``alone``, which runs every difference by itself and keeps where it shows.
Without one: all but ``alone``.
"""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import click

from benchmarks.twins import measure
from benchmarks.twins.firmware import FIRMWARES, Firmware
from benchmarks.twins.measure import TwinEffort

Stage = Callable[[Firmware, Path, TwinEffort], Iterator[str]]
STAGES: Mapping[str, Stage] = {
    "base": measure.base,
    "twin": measure.twin,
    "causes": measure.causes,
    "further": measure.further,
    "variant": measure.variant,
    "logs": measure.folder_of_logs,
    "alone": lambda firmware, folder, effort: measure.alone(firmware, effort.examples),
}


@click.command(help=(__doc__ or "").replace("\n\n    ", "\n\n\b\n    "))
@click.argument("firmwares", nargs=-1, type=click.Choice(list(FIRMWARES)), metavar="[FIRMWARE]...")
@click.option("--stage", "stages", multiple=True, type=click.Choice(list(STAGES)), help="Only this stage.")
@click.option("--examples", default=60, show_default=True, help="Random runs beside the fixed ones.")
@click.option("--logs", default=50, show_default=True, help="Logs of each firmware.")
@click.option("--seconds", default=20.0, show_default=True, help="For the causes of one part.")
@click.option("--further", default=15, show_default=True, help="Faults planted on top of each firmware.")
def main(
    firmwares: tuple[str, ...],
    stages: tuple[str, ...],
    examples: int,
    logs: int,
    seconds: float,
    further: int,
) -> None:
    """Measure the firmwares one after the other."""
    effort = TwinEffort(examples, logs, seconds, further)
    for name in firmwares or FIRMWARES:
        for stage in stages or [stage for stage in STAGES if stage != "alone"]:
            with TemporaryDirectory() as folder:
                for line in STAGES[stage](FIRMWARES[name], Path(folder), effort):
                    print(f"{name}: {line}" if not line.startswith(" ") else line, flush=True)


if __name__ == "__main__":
    main()
