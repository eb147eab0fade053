"""What is told of the causes of a cross-check: how often, in which ways, where nobody looked."""

from collections.abc import Iterator

from rovercheck.checker.commands.shared.cause_text import also, cut_short, says, untold
from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.compare.result import CompareResult
from rovercheck.checker.diagnosis.causes import CauseGroups, DeviationCause

RUNS = "run", "runs"


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
    if told := untold(one, RUNS[1]):
        yield wrapped(f"or: {told}.", indent)
    if len(one.deviations) > 1:
        others = counted(len(one.deviations) - 1, "other way", "other ways")
        yield wrapped(f"it shows in {others}, in all in {in_all(one, result)}:", indent)
    for other in one.deviations[1:]:
        yield wrapped(f"- {also(other, one, RUNS)}", f"{indent}  ")


def searched(groups: CauseGroups) -> Iterator[str]:
    """Where causes were not looked for to the end."""
    yield from cut_short(groups)
    if groups.left_out:
        runs = counted(groups.left_out, "run that deviates", "runs that deviate")
        yield f"Causes were looked for without {runs}, of which others show the deviations, too."
    for part in groups.unfit:
        yield (
            f"{part}: runs that were tried for the causes found show more than these explain: what they "
            "say is not exact. Compare with --write-variant, then with --variant, to see what is left."
        )


def wrapped(text: str, indent: str = "") -> str:
    """A text in lines as wide as the terminal, those after the first of each two further in."""
    width, then = text_width(), indent + "  "
    return "\n".join(filled(line, width, indent, then) for line in text.splitlines())
