"""``rovercheck generate-tests``: short tests that cover the charts, with the outputs that they require."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, write
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.text_wrap import filled, whole
from rovercheck.checker.compare.variants import boards_of
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.system.instrument.goals import KEPT, CoverGoal, GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen import kept_text
from rovercheck.checker.testgen.coverage import GenerationEffort, GoalCoverage, cover
from rovercheck.checker.testgen.fingerprint import fingerprint
from rovercheck.checker.testgen.generate import Aim, aims, files, only
from rovercheck.checker.testgen.keep import KeptTests, kept_of, written
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

SHOWN = 10
"""Goals without a test that are named; the others are counted, and all are in the JSON."""


@dataclass(frozen=True)
class CoveringRequest:
    """What the command line asks for."""

    names: tuple[str, ...]
    kinds: tuple[GoalKind, ...]
    format: str
    effort: GenerationEffort
    kept: bool
    charts: Variant
    keep: Path | None = None
    """The folder in which a set goes on from the tests it has."""


@dataclass(frozen=True)
class Generated:
    """What came of one board: the goals, what is known of them, and the files written."""

    aim: Aim
    kept: KeptTests
    files: tuple[str, ...]
    interrupted: bool = False


def generate_tests(asked: CoveringRequest, output: Path, as_json: bool) -> Exit:
    """Generate tests, write them, and say exactly what they cover.

    Raises ``ModelError`` for a name of no board or chart, ``UsageError`` where nothing can be written.
    """
    own, changed = asked.charts.own, asked.charts.name
    if own is not None and asked.kept:
        raise UsageError(f"No tests of {own.name} come with rovercheck; leave --kept out.")
    if changed and (asked.kept or asked.keep):
        option = "--kept" if asked.kept else "--keep"
        raise UsageError(f"Tests are kept of the charts as they are, and not {changed}; leave {option} out.")
    if asked.kept and asked.keep:
        raise UsageError("--kept writes tests without a search, --keep searches for more; leave one out.")
    if (asked.kept or asked.keep) and not set(asked.kinds) <= set(KEPT):
        raise UsageError(
            "Kept tests are about transitions, boundaries and pairs; leave --cover conditions out, or write "
            "such tests without --keep and --kept."
        )
    found: list[Generated] = []
    for aim in aims(asked.names, asked.kinds, boards_of(asked.charts)):
        found.append(_kept(aim, asked, asked.keep) if asked.keep else _generated(aim, asked, output))
        if not as_json:
            out.print("\n".join(report(found[-1], asked, output)), markup=False)
        if found[-1].interrupted:
            break
    if as_json:
        from rovercheck.checker.commands.generate_tests.document import document

        print(json_text(document(found, _code(found)), ascii=True))
    return _code(found)


def _generated(aim: Aim, asked: CoveringRequest, output: Path) -> Generated:
    if asked.kept:
        known, interrupted = only(_set_of(aim.board, None), aim.goals), False
    else:
        coverage = GoalCoverage(aim.board, aim.goals)
        interrupted = _searched(coverage, aim, asked)
        known = coverage.kept()
    contents = files(aim, known, asked.format) if known.tests else {}
    for name, content in contents.items():
        _write(content, output / name)
    return Generated(aim, known, tuple(contents), interrupted)


def _kept(aim: Aim, asked: CoveringRequest, folder: Path) -> Generated:
    """Go on from the set of a folder, or from that of the project, and keep all that is covered.

    A set is always one of all goals of a board; only those of ``aim`` are searched for.
    """
    board, charts = aim.board, fingerprint(aim.board, _model(aim.board, asked.charts))
    coverage = GoalCoverage(board, watched(board.system).goals)
    coverage.go_on(_set_of(board, folder), charts)
    interrupted = _searched(coverage, aim, asked)
    known = coverage.kept(charts)
    name = f"{board.name}.json"
    _write(written(board, known), folder / name)
    return Generated(aim, only(known, aim.goals), (name,), interrupted)


def _set_of(board: Board, folder: Path | None) -> KeptTests:
    """The set kept in a folder; where there is none, that of the project."""
    place = folder and folder / f"{board.name}.json"
    if board.model and (place is None or not place.exists()):
        return KeptTests(())
    if place is None or not place.exists():
        return kept_of(board, kept_text(board.name))
    try:
        return kept_of(board, place.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, ModelError) as error:
        raise UsageError(f"Cannot go on from {whole(place)}: {error}") from error


def _write(content: str, place: Path) -> None:
    """Write a file, and the folder that holds it.  Raises ``UsageError``."""
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"Cannot make the folder {place.parent}: {error.strerror}.") from error
    write(content, place)


def _model(board: Board, charts: Variant) -> System:
    """The board with its environment; a model of one's own is what it says itself."""
    return board.system if board.model else charts.systems()[board.name]


def _searched(coverage: GoalCoverage, aim: Aim, asked: CoveringRequest) -> bool:
    """Search until all is known or the user has seen enough; whether that was so."""
    wanted = {g.id for g in aim.goals}
    with ProgressLine() as line:
        try:
            model = _model(aim.board, asked.charts)
            cover(coverage, model, asked.effort, GenerationProgress(line, coverage), wanted)
        except KeyboardInterrupt:
            return True
    return False


@dataclass
class GenerationProgress:
    """Tells how many goals are decided, and what is being done."""

    line: ProgressLine
    coverage: GoalCoverage
    _decided: int = field(default=0)
    _at: float = field(default=0.0)

    def __call__(self, doing: str) -> None:
        if monotonic() - self._at > 0.5:
            self._decided, self._at = len(self.coverage.goals) - len(self.coverage.unknown), monotonic()
        self.line.show(f"{self._decided}/{len(self.coverage.goals)} goals decided | {doing}")


# --- what is said --------------------------------------------------------------------------------------


def report(found: Generated, asked: CoveringRequest, output: Path) -> Iterator[str]:
    """The counts of each kind, the goals without a test, and what was written, in 80 columns."""
    kept, goals = found.kept, found.aim.goals
    yield found.aim.board.name
    for kind in GoalKind:
        mine = [g for g in goals if g.kind is kind]
        if mine:
            yield from _wrapped(counts(kept, kind, mine), "  ", "      ")
    yield from _listed("≈", "uncoverable", kept.uncoverable, goals)
    yield from _listed("?", "unknown", kept.unknown, goals)
    yield from _wrapped(_tests(found, asked, output), "  ", "  ")
    if found.interrupted:
        yield "  Interrupted: this is what was found so far."


def _tests(found: Generated, asked: CoveringRequest, output: Path) -> str:
    tests = found.kept.tests
    steps = sum(len(script) for _, _, script in tests)
    number = f"{counted(len(tests), 'test', 'tests')} of {counted(steps, 'step', 'steps')} together"
    if not found.files:
        return "no test was written"
    place = f"in the set of {whole(asked.keep)}" if asked.keep else f"as {asked.format} in {whole(output)}"
    return f"{number}, {place}"


def counts(kept: KeptTests, kind: GoalKind, goals: Sequence[CoverGoal]) -> str:
    """``transitions 111: 104 covered (98 by a shortest run), 7 proved uncoverable, 0 unknown``."""
    ids = {g.id for g in goals}
    covered = ids & {g for _, reached, _ in kept.tests for g in reached}
    shortest = ids & set(kept.shortest)
    proved, unknown = ids & kept.uncoverable.keys(), ids & kept.unknown.keys()
    by = f" ({len(shortest)} by a shortest run)" if shortest else ""
    left = len(ids) - len(covered) - len(proved) - len(unknown)
    more = f", {left} not in these tests" if left else ""
    rest = f"{len(proved)} proved uncoverable, {len(unknown)} unknown{more}"
    return f"{kind.word} {len(ids)}: {len(covered)} covered{by}, {rest}"


def _listed(sign: str, word: str, why: Mapping[str, str], goals: Sequence[CoverGoal]) -> Iterator[str]:
    texts = {g.id: g.text for g in goals}
    for id, reason in list(why.items())[:SHOWN]:
        yield from _wrapped(f"{sign} {word}: {id}: {texts[id]}", "  ", "      ")
        yield from _wrapped(reason, "      ", "      ")
    if len(why) > SHOWN:
        yield f"  {sign} and {len(why) - SHOWN} more {word}; all of them with --json"


def _wrapped(text: str, first: str, then: str) -> list[str]:
    return filled(text, out.width, first, then).split("\n")


def _code(found: Sequence[Generated]) -> Exit:
    """Interrupted, or something is not known, or all is."""
    if any(one.interrupted for one in found):
        return Exit.INTERRUPTED
    known = all(_known(one) >= {g.id for g in one.aim.goals} for one in found)
    return Exit.AS_EXPECTED if known else Exit.INCONCLUSIVE


def _known(one: Generated) -> set[str]:
    """The goals that a test reaches or that are proved uncoverable."""
    return {goal for _, reached, _ in one.kept.tests for goal in reached} | one.kept.uncoverable.keys()
