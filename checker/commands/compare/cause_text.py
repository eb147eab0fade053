"""What is told of the cause of a finding: what explains it, in which ways it shows, where nobody looked."""

from collections.abc import Iterator

from rovercheck.checker.commands.shared.deviation_text import headline
from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.compare.result import CompareResult
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.diagnosis.causes import CauseGroups, DeviationCause
from rovercheck.checker.diagnosis.sentences import behaves_like


def says(cause: DeviationCause) -> str:
    """What explains the deviations of a cause; empty where nothing does."""
    if cause.change is not None:
        return behaves_like(cause.change)
    return f"{cause.part} behaves as if it had other values of {cause.input}" if cause.input else ""


def in_all(cause: DeviationCause, result: CompareResult) -> str:
    """How often some deviation of a cause was met."""
    return times(cause.runs, cause.ticks, result)


def times(runs: int, ticks: int, result: CompareResult) -> str:
    """How often something was met: in how many of all runs, in how many steps."""
    return f"{runs:,} of {counted(result.coverage.runs, 'run', 'runs')}, {counted(ticks, 'step', 'steps')}"


def cause_lines(one: DeviationCause, result: CompareResult, indent: str) -> Iterator[str]:
    """What explains a finding, and in which other ways it shows."""
    if told := says(one):
        yield wrapped(f"cause: {told}.", indent)
    if len(one.deviations) > 1:
        others = counted(len(one.deviations) - 1, "other way", "other ways")
        yield wrapped(f"it shows in {others}, in all in {in_all(one, result)}:", indent)
    for other in one.deviations[1:]:
        yield wrapped(f"- {also(other, one)}", f"{indent}  ")


def also(other: Deviation, one: DeviationCause) -> str:
    """Another way in which a finding shows: what differs, where the charts are, in how many runs."""
    moves = [move.removeprefix(f"{one.part}: ") for move in other.scope.charts]
    told = headline(other).removeprefix(f"{one.part}: ")
    where = f" ({'; '.join(moves)})" if moves else ""
    return f"{told}{where}, in {counted(other.runs, 'run', 'runs')}"


def searched(groups: CauseGroups) -> Iterator[str]:
    """Where causes were not looked for to the end."""
    for cut in groups.cut:
        yield (
            f"Causes in {cut.part}: {cut.tried:,} changes tried in {cut.seconds:.0f} s, not all; more with "
            "--seconds S. Deviations of one cause may be told as several there."
        )
    if groups.left_out:
        runs = counted(groups.left_out, "run that deviates", "runs that deviate")
        yield f"Causes were looked for without {runs}, of which others show the deviations, too."


def wrapped(text: str, indent: str = "") -> str:
    """A text in lines as wide as the terminal, those after the first of each two further in."""
    width, then = text_width(), indent + "  "
    return "\n".join(filled(line, width, indent, then) for line in text.splitlines())
