"""``rovercheck compare``: an implementation and the charts side by side, under the same inputs."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

from rovercheck.checker.adapters import start
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.checker.commands.compare.grouping import CauseGrouping
from rovercheck.checker.commands.compare.text import CrosscheckReport, report, shown
from rovercheck.checker.commands.shared.campaign_files import NO_FILES, CampaignFiles
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.known import KnownBook, known_book
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.commands.shared.output import counted, err, out, write
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.variant_file import FoundVariant, write_variant
from rovercheck.checker.compare import Allowance, CompareResult, cross_check, effort
from rovercheck.checker.compare.reproduce import file_name, reproduction
from rovercheck.checker.compare.result import ALLOWED, DECIDING, RANDOM
from rovercheck.checker.compare.search import CompareSearch, Elsewhere
from rovercheck.checker.compare.variants import board_named, boards_of
from rovercheck.checker.conformance.known import KnownDeviation, KnownJudgement, shows
from rovercheck.checker.diagnosis.search import SECONDS
from rovercheck.checker.diagnosis.variant import WrittenChange
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.process.pool import Jobs
from rovercheck.spec_model.abstraction import Board

AS_DRAWN = VariantOptions()


@dataclass(frozen=True)
class CrosscheckOptions:
    """What the command line asks for."""

    system: str | None
    address: str | None
    profile: str
    examples: int | None
    seed: int | None
    tests: Path | None
    allowance: Allowance = ALLOWED
    charts: VariantOptions = AS_DRAWN
    known: Path | None = None
    write_known: Path | None = None
    write_variant: Path | None = None
    seconds: float = SECONDS
    """How long the causes of a part are looked for."""
    causes: bool | None = None
    """Whether in every part that deviates, or in none; ``None``: where one does in several ways."""
    jobs: Jobs = 1
    """Processes that try the random runs."""

    @cached_property
    def variant(self) -> Variant:
        """How the charts are changed.  Raises ``UsageError`` or ``ModelError``."""
        return self.charts.variant()


def compare(
    asked: CrosscheckOptions, output: Path | None, as_json: bool, wanted: CampaignFiles = NO_FILES
) -> Exit:
    """Compare one board, or both, and write a test for every mismatch and failure that is shown in full.

    Raises ``UsageError`` for a board that does not exist and an implementation that cannot be started.
    """
    wanted.possible()
    named = _boards(asked)
    own = asked.variant.own is not None
    every = {b.name: b for b in named} if own else boards_of(asked.variant)
    book = known_book(asked.known, asked.write_known, every, asked.variant.board_name)
    book.concerning([board.name for board in named])
    seed = effort(asked.profile, asked.examples, asked.seed).seed  # one for all boards
    reports: list[CrosscheckReport] = []
    variants: list[FoundVariant] = []
    for board in named:
        address = asked.address or board.supervisor
        if not as_json:
            _announce(asked, board, address, seed)
        writes = asked.write_known is not None or asked.write_variant is not None
        causes = True if asked.causes is None and writes else asked.causes
        knows, explained = partial(book.knows, board.name), book.causes(board.name)
        grouping = CauseGrouping(board, asked.seconds, causes, knows, book.known.deviations, explained)
        result = _checked(asked, board, address, seed, book.used, grouping)
        files = _write_tests(result, address, asked.variant, output or Path())
        groups = grouping.of(result)
        judgement = _judged(book, result, grouping)
        variants.append(_variant(result, grouping, address, asked.variant))
        reports.append(
            CrosscheckReport(result, address, files, asked.variant.board_name, judgement, book.used, groups)
        )
        if not as_json:
            out.print(report(reports[-1]), markup=False)
        if result.interrupted:
            err.print(f"Interrupted: {counted(len(reports), 'board', 'boards')} of {len(named)} begun.")
            break
    for said in book.write():
        err.print(said, markup=False)
    if asked.write_variant is not None:
        err.print(write_variant(asked.write_variant, variants), markup=False)
    code = worst(reports)
    if as_json or wanted.wanted:
        from rovercheck.checker.commands.compare.report import campaign_record

        record = campaign_record(reports)
        if as_json:
            from rovercheck.checker.commands.compare.document import document

            print(json_text(document(reports, code, record), ascii=True))
        wanted.write(record)
    return code


def _judged(book: KnownBook, result: CompareResult, grouping: CauseGrouping) -> KnownJudgement:
    compared = {o.name for o in result.board.outputs} - set(result.uncompared)

    def shown_by(known: KnownDeviation) -> bool:
        changed = grouping.charts.situations if grouping.charts is not None else frozenset()
        met = changed if known.scope.on_top else result.situations
        return result.complete and shows(result.board, known.scope, met, compared)

    found = () if grouping.groups is None else grouping.groups.parts
    return book.judged(
        result.board.name, result.deviations, shown_by, grouping.unexplained, found, grouping.on_top
    )


def _variant(result: CompareResult, grouping: CauseGrouping, address: str, variant: Variant) -> FoundVariant:
    """The changes that explain the implementation, with what was compared with them.

    They are those that the charts are compared with, those of known deviations, then those found now.
    """
    name, found = result.board.name, () if grouping.groups is None else grouping.groups.parts
    [board, *_], *rows = variant.changes.rows if variant.changes else (("",),)
    searched = {one.part for one in found}
    kept = (key for one in grouping.causes if one.part not in searched for key in one.changes)
    before = [WrittenChange(*key) for key in (*(rows if board == name else ()), *kept)]
    explained = {one.scope for part in found for one in part.deviations}
    of_kept = {id for one in grouping.causes if one.part not in searched for id in one.deviations}
    explained |= {one.scope for one in result.deviations if one.scope.id(name) in of_kept}
    every = {one.scope for one in result.deviations}
    steps = f"{result.compared:,} steps from seed {result.seed}"
    rest = counted(len(every), "deviation", "deviations")
    evidence = f"compare, {address}, {steps}: the changes explain {len(explained & every)} of {rest}."
    evidence += "".join(_of_deciding(result, grouping, every <= explained))
    return FoundVariant(name, [*before, *(change for part in found for change in part.changes)], evidence)


def _of_deciding(result: CompareResult, grouping: CauseGrouping, in_all: bool) -> Iterator[str]:
    """What the runs showed that were tried for the causes; ``in_all``: they were looked at in all parts."""
    for stage in result.stages:
        if stage.kind == DECIDING and grouping.unfit:
            yield f" More shows in runs that were tried for them, in {', '.join(grouping.unfit)}."
        elif stage.kind == DECIDING and in_all and not stage.because:
            yield f" Nothing else shows in {counted(stage.tried, 'run', 'runs')} tried for them."


def _announce(asked: CrosscheckOptions, board: Board, address: str, seed: int) -> None:
    runs = effort(asked.profile, asked.examples, seed).examples
    out.print(
        f"{board.name}: {address}\n"
        f"  beside {counted(len(board.system.charts), 'chart', 'charts')}"
        f"{f' {asked.variant.board_name}' if asked.variant.board_name else ''}; "
        f"{counted(runs, 'random run', 'random runs')} from seed {seed}.",
        markup=False,
    )


def _boards(asked: CrosscheckOptions) -> list[Board]:
    if asked.variant.own is not None:
        if asked.address is None:
            raise UsageError(
                f"{asked.variant.own.name} comes with no implementation; write --impl KIND:WHAT, as in "
                "--impl c:firmware."
            )
        return [board_named(asked.variant, asked.system)]
    if asked.system is None:
        if asked.address is not None:
            raise UsageError(
                f"--impl {asked.address} is the supervisor of one board; write --system board1 or board2 too."
            )
        return list(boards_of(asked.variant).values())
    return [board_named(asked.variant, asked.system)]


def _checked(
    asked: CrosscheckOptions,
    board: Board,
    address: str,
    seed: int,
    watched: bool,
    grouping: CauseGrouping,
) -> CompareResult:
    if asked.tests is not None and not asked.tests.is_dir():
        raise UsageError(f"{asked.tests} is no folder; write one with tests as CSV or JSON.")
    elsewhere = _elsewhere(asked, board, address, watched)
    try:
        implementation = start(address, board)
    except ImplementationError as error:
        raise UsageError(str(error)) from error
    try:
        with ProgressLine() as line:
            return cross_check(
                board if asked.variant.board_name or board.model else board.name,
                implementation,
                effort(asked.profile, asked.examples, seed),
                folder=asked.tests,
                allowance=asked.allowance,
                progress=lambda search: line.show(_doing(board, search)),
                watched=watched,
                leading=lambda found, runs: grouping.leading(found, runs, line.show),
                known=grouping,
                elsewhere=elsewhere,
            )
    finally:
        implementation.close()


def _elsewhere(asked: CrosscheckOptions, board: Board, address: str, watched: bool) -> Elsewhere | None:
    if asked.jobs == 1:
        return None
    from rovercheck.checker.commands.compare.elsewhere import RunsOf, elsewhere

    name = asked.system if board.model else board.name
    runs = RunsOf(asked.charts, name, address, asked.allowance.failures, watched)
    return elsewhere(runs, asked.jobs)


def _doing(board: Board, search: CompareSearch) -> str:
    """One line on what a cross-check is doing."""
    of = f" {search.tried[RANDOM]} of {search.effort.examples}" if search.doing == RANDOM else ""
    found = counted(len(search.tally.groups), "deviation", "deviations")
    return (
        f"{board.name}: {search.doing}{of} | {found}, {search.coverage.steps:,} steps, "
        f"{len(search.coverage.taken)} transitions"
    )


def _write_tests(result: CompareResult, address: str, variant: Variant, folder: Path) -> list[Path]:
    """A test for each mismatch and failure that is shown."""
    written = []
    for found in shown(result):
        place = folder / file_name(found)
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(
                f"Cannot make {whole(folder)}: {error.strerror}. Choose another --output."
            ) from error
        write(reproduction(found, address, variant.board_name), place)
        written.append(place)
    return written


def worst(reports: Sequence[CrosscheckReport]) -> Exit:
    """What differs, and is not known, outweighs a search that is not finished."""
    if any(r.differs for r in reports):
        return Exit.FAILED
    if any(r.result.interrupted for r in reports):
        return Exit.INTERRUPTED
    return Exit.AS_EXPECTED if all(r.as_expected for r in reports) else Exit.INCONCLUSIVE
