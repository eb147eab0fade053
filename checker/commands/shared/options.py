"""The options that several verbs share, and the numbers that may be written for them."""

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import wraps
from math import isnan
from pathlib import Path
from shlex import join
from typing import TYPE_CHECKING, Any

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.silence import silence
from rovercheck.checker.engines import AUTO, Engine, Limits, Timers

if TYPE_CHECKING:
    from rovercheck.checker.model.variant import Variant
    from rovercheck.checker.process.pool import Cluster
    from rovercheck.checker.store.verdicts import VerdictStore
    from rovercheck.properties.forms import Property


class Amount(click.FloatRange):
    """A number within bounds; nan, which is neither more nor less than anything, is none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if isnan(number := super().convert(value, param, ctx)):
            self.fail(f"{value!r} is not a number.", param, ctx)
        return number


SECONDS = Amount(min=0, min_open=True, max=100_000_000)
GIB = Amount(min=0.25, max=1_000_000)


@dataclass(frozen=True)
class VariantOptions:
    """Which charts are meant: a user's own model, interpretations, a repair, fewer assumptions, changes.

    ``changes`` is the file of a variant: how some implementation differs from the charts.
    """

    chosen: tuple[str, ...] = ()
    repair: str | None = None
    dropped: tuple[str, ...] = ()
    model: Path | None = None
    changes: Path | None = None

    def variant(self) -> "Variant":
        """The charts so meant.  Raises ``UsageError`` or ``ModelError``."""
        from rovercheck.checker.commands.shared.variant import pick_variant

        return pick_variant(self.chosen, self.repair, self.dropped, self.model, self.changes)


@dataclass(frozen=True)
class SelectionOptions:
    """Which properties are asked for: by id, about some systems, those that take long too."""

    ids: tuple[str, ...] = ()
    about: tuple[str, ...] = ()
    full: bool = False

    @property
    def whole(self) -> bool:
        """Whether nothing is selected."""
        return not self.ids and not self.about

    def properties(self, variant: "Variant") -> "list[Property]":
        """The properties so chosen; with no id given, only those that the variant concerns.

        Raises ``UsageError`` for a name that there is not.
        """
        from rovercheck.checker.commands.shared.select import pick_properties

        found = pick_properties(self.ids, self.about, variant.properties(), self.full, variant.unchanged())
        return list(filter(variant.concerns(), found)) if variant.name and not self.ids else found

    @property
    def again(self) -> str:
        """The words that choose the same properties again."""
        systems = (word for name in self.about for word in ("--system", name))
        return join([*self.ids, *systems, *(("--full",) if self.full else ())])


@dataclass(frozen=True)
class SearchOptions:
    """Who searches, what a search may take (ticks, seconds), and whether earlier verdicts are believed."""

    engine: str
    depth: int | None
    timeout: float | None
    timers: str
    no_store: bool = False

    def limits(self, memory: float | None = None) -> Limits:
        """The same as limits, with so many GiB of memory."""
        limits = Limits(self.depth, self.timeout, timers=Timers(self.timers))
        return limits if memory is None else replace(limits, memory=int(memory * 2**30))

    def store(self, engine: "str | Engine", recheck: bool = False) -> "VerdictStore | None":
        """Where verdicts of that engine are kept; None where they are not.

        With ``recheck`` none is believed before its run is replayed, or its certificate checked.
        """
        from rovercheck.checker.store.verdicts import store

        return None if self.no_store else store(engine, self.limits(), recheck)


def _cluster(_: click.Context, __: click.Parameter, address: str | None) -> "Cluster | None":
    from rovercheck.checker.process.pool import Cluster
    from rovercheck.checker.store.versions import deciding

    return None if address is None else Cluster(address, deciding)


def _cluster_of_all(_: click.Context, __: click.Parameter, address: str | None) -> "Cluster | None":
    from rovercheck.checker.process.pool import Cluster
    from rovercheck.checker.store.versions import everything

    return None if address is None else Cluster(address, everything)


elsewhere = click.option(
    "--scheduler",
    metavar="ADDRESS",
    callback=_cluster,
    help="Search on the workers of this scheduler of dask, in place of --jobs here (docs/cluster.md).",
)
"""The option for searches on other machines."""
comparing_elsewhere = click.option(
    "--scheduler",
    metavar="ADDRESS",
    callback=_cluster_of_all,
    help="Work on the workers of this scheduler of dask, in place of processes here (docs/cluster.md).",
)
"""The option for work on other machines that reads the rover's charts there."""

Verb = Callable[..., Exit]


def gathered(record: type[Any], name: str) -> Callable[[Verb], Verb]:
    """Hands a verb the options named as the fields of a record as this record, under one name.

    Fields that no option is named as keep their defaults.
    """
    names = [field.name for field in fields(record)]

    def around(command: Verb) -> Verb:
        @wraps(command)
        def called(*args: object, **given: object) -> Exit:
            of = {n: given.pop(n) for n in names if n in given}
            return command(*args, **given, **{name: record(**of)})

        return called

    return around


def selecting(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The argument and the options of a verb that decides some properties."""
    return _with(
        gathered(SelectionOptions, "selection")(command),
        click.argument("ids", nargs=-1, metavar="[ID]..."),
        click.option(
            "--system",
            "about",
            multiple=True,
            metavar="NAME",
            help="Only properties about this system, or these.",
        ),
        click.option("--full", is_flag=True, help="Also the properties that take long."),
    )


def searching(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The options of every verb that searches."""
    return _with(
        gathered(SearchOptions, "search")(command),
        click.option(
            "--engine",
            default=AUTO,
            show_default=True,
            metavar="NAME",
            help="With this engine; see list engines.",
        ),
        click.option(
            "--depth", type=click.IntRange(min=1), metavar="N", help="Bound on the length of runs, in ticks."
        ),
        click.option(
            "--timeout",
            type=SECONDS,
            metavar="SEC",
            help="Seconds per search. One that ignores them is killed when a tenth more and 2 s are over.",
        ),
        click.option(
            "--timers",
            type=click.Choice([t.value for t in Timers]),
            default=Timers.EXACT.value,
            show_default=True,
            help="Count every tick, skip quiet ones, or try first with timers that may expire at any time.",
        ),
        click.option(
            "--no-store", is_flag=True, help="Decide all anew: neither use nor keep verdicts of other runs."
        ),
    )


def quietly(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The option of every verb that says meanwhile what it does."""
    return click.option(
        "--quiet",
        "-q",
        is_flag=True,
        expose_value=False,
        callback=silence,
        help="Only what is found, and no progress.",
    )(command)


class ModelPath(click.Path):
    """Where a model is; an empty text, as of a variable that is not set, is no path."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            how = "write a Python file, a folder of them, or a model of Simulink."
            self.fail(f"the path is empty; {how}", param, ctx)
        return super().convert(value, param, ctx)


def modelling(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The option of every verb that a user's own model can be given to."""
    return click.option(
        "--model",
        type=ModelPath(path_type=Path),
        metavar="PATH",
        help="Your own model instead of the rover: a Python file, a folder of them, or a model of Simulink "
        "(.slx).",
    )(command)


def varying(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The options of every verb that looks at the charts: other interpretations, a proposed repair."""
    return _with(
        gathered(VariantOptions, "charts")(command),
        _interpretation(
            "Choose another interpretation of an ambiguous requirement: S43=AND; S43=any leaves it open."
        ),
        REPAIR,
        click.option(
            "--without",
            "dropped",
            multiple=True,
            metavar="ID",
            help="Drop an assumption about the environment; see list assumptions.",
        ),
        CHANGES,
    )


def writing(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The option of every verb that writes."""
    where = click.Path(path_type=Path)
    return click.option("--output", "-o", type=where, help="Where to write.")(command)


def changing(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The options that change the charts compared with; assumptions about the environment play no part."""
    return _with(
        gathered(VariantOptions, "charts")(command),
        _interpretation("Choose another interpretation of an ambiguous requirement: S43=AND."),
        REPAIR,
        CHANGES,
    )


def seeking_causes(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """How long causes are looked for, of every verb that does."""
    return _with(
        command,
        click.option(
            "--seconds",
            type=click.FloatRange(min=0, min_open=True),
            default=300.0,
            show_default=True,
            metavar="S",
            help="How long the causes of a part are looked for, in seconds of the processor.",
        ),
    )


def reading_logs(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The argument of every verb about logs, and how they are read."""
    return _with(
        command,
        click.argument("place", type=click.Path(exists=True, path_type=Path), metavar="LOG|DIR"),
        click.option(
            "--map",
            "map_file",
            type=click.Path(path_type=Path),
            metavar="MAP.toml",
            help="What the columns are (docs/logs.md).",
        ),
        click.option(
            "--system",
            metavar="NAME",
            help="The board: board1 or board2; by default found from the columns.",
        ),
    )


def knowing(command: Verb) -> Verb:
    """The options of every verb that compares what was recorded with the charts: known deviations."""
    writes = click.option(
        "--write-known",
        type=click.Path(dir_okay=False, path_type=Path),
        metavar="FILE",
        help="Write the deviations found there, for --known.",
    )
    reads = click.option(
        "--known",
        type=click.Path(dir_okay=False, path_type=Path),
        metavar="FILE",
        help="Deviations that are expected, and checked on.",
    )
    return reads(writes(command))


REPAIR = click.option("--repair", metavar="NAME", help="With a proposed repair; see list repairs.")
CHANGES = click.option(
    "--variant",
    "changes",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="With the changes of this file, as compare and diagnose write it.",
)


def _interpretation(help: str) -> Callable[[Verb], Verb]:
    return click.option("--interpret", "chosen", multiple=True, metavar="ID=CHOICE", help=help)


def _with(command: Verb, *options: Callable[[Verb], Verb]) -> Verb:
    """The command with some options, in the order in which its help shows them."""
    for option in reversed(options):
        command = option(command)
    return command
