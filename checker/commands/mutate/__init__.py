"""The verb ``mutate``: how strong the properties are."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.options import GIB, SECONDS, elsewhere, gathered, modelling, quietly
from rovercheck.checker.engines import LOADED, Limits

if TYPE_CHECKING:
    from rovercheck.checker.process.pool import Cluster


@dataclass(frozen=True)
class MutateOptions:
    """Which faults are made, how many, and who is asked.

    ``about`` are systems, ``part`` charts and blocks; without any, all are meant.  ``alone``: only properties
    about the systems named count; ``by_place``: also which properties constrain each place;
    ``record_mutants``: the runs that searches find are kept.
    """

    about: tuple[str, ...]
    part: tuple[str, ...]
    alone: bool
    jobs: int | None
    scheduler: "Cluster | None"
    sample: int | None
    seed: int
    record_mutants: bool
    by_place: bool


@click.command(short_help="Put faults into the charts, and see whether the properties kill them.")
@click.option(
    "--system",
    "about",
    multiple=True,
    metavar="NAME",
    help="Only charts and blocks of this system, or these.",
)
@click.option("--part", "part", multiple=True, metavar="NAME", help="Only this chart or block, or these.")
@click.option("--alone", is_flag=True, help="Check only properties about the system of the mutant.")
@click.option(
    "--timeout", type=SECONDS, default=60.0, show_default=True, metavar="SEC", help="Seconds per mutant."
)
@click.option(
    "--memory", type=GIB, default=8.0, show_default=True, metavar="GIB", help="Memory of each search, in GiB."
)
@click.option(
    "--jobs", type=click.IntRange(min=1), metavar="N", help="Mutants at a time; by default one per processor."
)
@elsewhere
@click.option("--sample", type=click.IntRange(min=1), metavar="N", help="Only so many, drawn at random.")
@click.option("--seed", type=int, default=0, show_default=True, metavar="N", help="Which ones are drawn.")
@click.option(
    "--record-kills", is_flag=True, help="Only find a mutant that each property kills, and record it."
)
@click.option(
    "--record-mutants",
    is_flag=True,
    help="Record the runs that searches find: the next time they are tried first.",
)
@click.option(
    "--by-place", is_flag=True, help="Also which properties constrain each transition, action and wire."
)
@click.option("--json", "as_json", is_flag=True, help="Every mutant as JSON (checker/schemas/mutate-1.json).")
@modelling
@quietly
@gathered(MutateOptions, "options")
def mutate(
    options: MutateOptions,
    timeout: float,
    memory: float,
    record_kills: bool,
    as_json: bool,
    model: Path | None,
) -> Exit:
    """Put one fault at a time into charts, blocks and wiring, and report which property kills it.

    A mutant that no property kills is proved equivalent, or shown with a run in which it differs.
    """
    from rovercheck.checker.process.isolate import prepared

    with prepared(*LOADED):
        from rovercheck.checker.commands.mutate.run import mutate as run
        from rovercheck.checker.commands.shared.variant import pick_variant

        limits = Limits(None, timeout, int(memory * 2**30))
        if record_kills and options.record_mutants:
            raise UsageError("--record-kills and --record-mutants keep different runs; write one of them.")
        if record_kills:
            from rovercheck.checker.commands.mutate.kills import record_kills as recorded

            return recorded(
                pick_variant((), None, (), model).model,
                limits,
                options.scheduler or options.jobs,
                options.about,
            )
        return run(pick_variant((), None, (), model).model, options, limits, as_json)
