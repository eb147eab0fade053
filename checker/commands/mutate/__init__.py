"""The verb ``mutate``: how strong the properties are."""

from dataclasses import dataclass
from pathlib import Path

import click

from checker.commands.shared.codes import Exit
from checker.commands.shared.options import GIB, SECONDS, gathered, modelling, quietly
from checker.engines import LOADED, Limits


@dataclass(frozen=True)
class FaultOptions:
    """Which faults are made, how many, and who is asked."""

    about: tuple[str, ...]
    part: tuple[str, ...]
    alone: bool
    jobs: int | None
    sample: int | None
    seed: int
    record_mutants: bool
    by_place: bool


@click.command(short_help="Put faults into the charts, and see whether the properties notice.")
@click.option(
    "--system",
    "about",
    multiple=True,
    metavar="NAME",
    help="Only charts and blocks of this system, or these.",
)
@click.option("--part", "part", multiple=True, metavar="NAME", help="Only this chart or block, or these.")
@click.option("--alone", is_flag=True, help="Ask only properties about the system that a fault is put into.")
@click.option(
    "--timeout", type=SECONDS, default=60.0, show_default=True, metavar="SEC", help="Seconds per mutant."
)
@click.option(
    "--memory", type=GIB, default=8.0, show_default=True, metavar="GIB", help="What each search may take."
)
@click.option(
    "--jobs", type=click.IntRange(min=1), metavar="N", help="Mutants at a time; by default one per processor."
)
@click.option("--sample", type=click.IntRange(min=1), metavar="N", help="Only so many, drawn at random.")
@click.option("--seed", type=int, default=0, show_default=True, metavar="N", help="Which ones are drawn.")
@click.option(
    "--record-kills", is_flag=True, help="Only find a fault that each property notices, and keep it."
)
@click.option(
    "--record-mutants",
    is_flag=True,
    help="Keep the runs that searches find, by which the next time needs none.",
)
@click.option("--by-place", is_flag=True, help="Also which properties constrain each arrow, action and wire.")
@click.option("--json", "as_json", is_flag=True, help="Every mutant as JSON (checker/schemas/mutate-1.json).")
@modelling
@quietly
@gathered(FaultOptions, "options")
def mutate(
    options: FaultOptions,
    timeout: float,
    memory: float,
    record_kills: bool,
    as_json: bool,
    model: Path | None,
) -> Exit:
    """Put one fault at a time into charts, blocks and wiring, and tell which property notices it.

    Whatever none of them notices is proved to change nothing, or shown with a run that it changes.
    """
    from checker.process.isolate import prepared

    with prepared(*LOADED):
        from checker.commands.mutate.run import MutateOptions
        from checker.commands.mutate.run import mutate as run
        from checker.commands.shared.variant import pick_variant

        if record_kills:
            from checker.commands.mutate.kills import record_kills as recorded

            limits = Limits(None, timeout, int(memory * 2**30))
            return recorded(pick_variant((), None, (), model).model, limits, options.jobs, options.about)
        wanted = MutateOptions(
            options.about,
            options.part,
            options.sample,
            options.seed,
            options.alone,
            options.by_place,
            options.jobs,
            options.record_mutants,
        )
        limits = Limits(None, timeout, int(memory * 2**30))
        return run(pick_variant((), None, (), model).model, wanted, limits, as_json)
