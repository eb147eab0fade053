"""``rovercheck testgen``: short tests that cover the charts, with the outputs that they require."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from rich.status import Status

from checker.commands.codes import Exit
from checker.commands.output import counted, err, out, write
from checker.commands.progress import PAUSE
from checker.conform.cover import kept_text
from checker.conform.cover.coverage import Coverage, Effort, cover
from checker.conform.cover.generate import Aim, aims, files, only
from checker.conform.cover.goals import Goal, Kind
from checker.conform.cover.keep import Kept, kept_of
from spec_model.rover import systems

SCHEMA = 1
SHOWN = 10
"""Goals without a test that are named; the others are counted, and all are in the JSON."""


@dataclass(frozen=True)
class Asked:
    """What the command line asks for."""

    names: tuple[str, ...]
    kinds: tuple[Kind, ...]
    format: str
    effort: Effort
    kept: bool


@dataclass(frozen=True)
class Generated:
    """What came of one board: the goals, what is known of them, and the files written."""

    aim: Aim
    kept: Kept
    files: tuple[str, ...]
    interrupted: bool = False


def testgen(asked: Asked, output: Path, as_json: bool) -> Exit:
    """Generate tests, write them, and say exactly what they cover.

    Raises ``ModelError`` for a name of no board or chart, ``UsageError`` where nothing can be written.
    """
    found: list[Generated] = []
    for aim in aims(asked.names, asked.kinds):
        found.append(_generated(aim, asked, output))
        if not as_json:
            out.print("\n".join(report(found[-1], asked.format, output)), markup=False, soft_wrap=False)
        if found[-1].interrupted:
            break
    if as_json:
        print(json.dumps(document(found), indent=2))
    return _code(found)


def _generated(aim: Aim, asked: Asked, output: Path) -> Generated:
    known, interrupted = _as_kept(aim) if asked.kept else _searched(aim, asked.effort)
    contents = files(aim, known, asked.format) if known.tests else {}
    for name, content in contents.items():
        output.mkdir(parents=True, exist_ok=True)
        write(content, output / name)
    return Generated(aim, known, tuple(contents), interrupted)


def _as_kept(aim: Aim) -> tuple[Kept, bool]:
    return only(kept_of(aim.board, kept_text(aim.board.name)), aim.goals), False


def _searched(aim: Aim, effort: Effort) -> tuple[Kept, bool]:
    """Search until all is known or the user has seen enough."""
    coverage = Coverage(aim.board, aim.goals)
    with Line() as line:
        try:
            cover(coverage, systems()[aim.board.name], effort, line.say(coverage))
        except KeyboardInterrupt:
            return coverage.kept(), True
    return coverage.kept(), False


class Line:
    """One line on a terminal, a line every ten seconds in a log."""

    def __init__(self) -> None:
        self._status = Status("starting", console=err) if err.is_terminal else None
        self._last = monotonic()

    def __enter__(self) -> "Line":
        if self._status:
            self._status.start()
        return self

    def __exit__(self, *_: object) -> None:
        if self._status:
            self._status.stop()

    def say(self, coverage: Coverage) -> "Saying":
        return Saying(self, coverage)

    def show(self, line: str) -> None:
        if self._status:
            self._status.update(line[: err.width - 4])
        elif monotonic() - self._last >= PAUSE:
            self._last = monotonic()
            err.print(line, markup=False)


@dataclass
class Saying:
    """Tells how many goals are decided, and what is being done."""

    line: Line
    coverage: Coverage
    _decided: int = field(default=0)
    _at: float = field(default=0.0)

    def __call__(self, doing: str) -> None:
        if monotonic() - self._at > 0.5:
            self._decided, self._at = len(self.coverage.goals) - len(self.coverage.unknown), monotonic()
        self.line.show(f"{self._decided}/{len(self.coverage.goals)} goals decided | {doing}")


# --- what is said --------------------------------------------------------------------------------------


def report(found: Generated, format: str, output: Path) -> Iterator[str]:
    """The counts of each kind, the goals without a test, and what was written, in 80 columns."""
    kept, goals = found.kept, found.aim.goals
    yield found.aim.board.name
    for kind in Kind:
        mine = [g for g in goals if g.kind is kind]
        if mine:
            yield f"  {counts(kept, kind, mine)}"
    yield from _listed("≈", "uncoverable", kept.uncoverable, goals)
    yield from _listed("?", "unknown", kept.unknown, goals)
    steps = sum(len(script) for _, _, script in kept.tests)
    tests = f"{counted(len(kept.tests), 'test', 'tests')} of {counted(steps, 'step', 'steps')} together"
    yield f"  {tests}, as {format} in {output}" if found.files else "  no test was written"
    if found.interrupted:
        yield "  Interrupted: this is what was found so far."


def counts(kept: Kept, kind: Kind, goals: Sequence[Goal]) -> str:
    """``arrows 111: 104 covered (98 by a shortest run), 7 proved uncoverable, 0 unknown``."""
    ids = {g.id for g in goals}
    covered = ids & {g for _, reached, _ in kept.tests for g in reached}
    shortest = ids & set(kept.shortest)
    proved, unknown = ids & kept.uncoverable.keys(), ids & kept.unknown.keys()
    by = f" ({len(shortest)} by a shortest run)" if shortest else ""
    left = len(ids) - len(covered) - len(proved) - len(unknown)
    more = f", {left} not in these tests" if left else ""
    rest = f"{len(proved)} proved uncoverable, {len(unknown)} unknown{more}"
    return f"{kind} {len(ids)}: {len(covered)} covered{by}, {rest}"


def _listed(sign: str, word: str, why: Mapping[str, str], goals: Sequence[Goal]) -> Iterator[str]:
    texts = {g.id: g.text for g in goals}
    for id, reason in list(why.items())[:SHOWN]:
        yield f"  {sign} {word}: {id}: {texts[id]}"
        yield f"      {reason}"
    if len(why) > SHOWN:
        yield f"  {sign} and {len(why) - SHOWN} more {word}; all of them with --json"


def document(found: Sequence[Generated]) -> dict[str, object]:
    """All of it for machines."""
    complete = not any(one.interrupted for one in found)
    return {"schema": SCHEMA, "complete": complete, "boards": [_board(one) for one in found]}


def _board(one: Generated) -> dict[str, object]:
    kept = one.kept
    test_of = {goal: name for name, reached, _ in kept.tests for goal in reached}
    goals = [
        {
            "id": g.id,
            "kind": g.kind,
            "text": g.text,
            "verdict": _verdict(g.id, test_of, kept),
            "test": test_of.get(g.id),
            "shortest": g.id in kept.shortest,
            "because": kept.uncoverable.get(g.id) or kept.unknown.get(g.id),
        }
        for g in one.aim.goals
    ]
    tests = [{"name": n, "steps": len(script), "goals": reached} for n, reached, script in kept.tests]
    return {"board": one.aim.board.name, "goals": goals, "tests": tests, "files": one.files}


def _verdict(id: str, test_of: Mapping[str, str], kept: Kept) -> str:
    if id in test_of:
        return "covered"
    return "uncoverable" if id in kept.uncoverable else "unknown"


def _code(found: Sequence[Generated]) -> Exit:
    """Interrupted, or something is not known, or all is."""
    if any(one.interrupted for one in found):
        return Exit.INTERRUPTED
    known = all(_known(one) >= {g.id for g in one.aim.goals} for one in found)
    return Exit.AS_EXPECTED if known else Exit.INCONCLUSIVE


def _known(one: Generated) -> set[str]:
    """The goals that a test reaches or that are proved uncoverable."""
    return {goal for _, reached, _ in one.kept.tests for goal in reached} | one.kept.uncoverable.keys()
