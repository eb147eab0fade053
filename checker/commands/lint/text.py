"""What ``rovercheck lint`` tells people."""

from collections.abc import Iterator, Sequence

from rovercheck.checker.commands.lint.document import NUMBERS, LintRow, LintSummary
from rovercheck.checker.commands.shared.output import counted, text_width
from rovercheck.checker.commands.shared.text_wrap import filled

MOST_TICKS = 4
"""Lines of a run that are shown, those of its end; --json has them all."""


def told_lines(rows: Sequence[LintRow], summaries: Sequence[LintSummary], interrupted: bool) -> Iterator[str]:
    """What people read: a line or more for each row, and one for each system."""
    for row in rows:
        mark, said = _sentence(row)
        kind = _CALLED.get(row["kind"], f"{row['kind']} ")
        yield _wrapped(f"{mark} {row['system']}, {row['chart']}: {kind}{row['what']}{said}")
        yield _wrapped(row["evidence"], "    ")
        yield from (_wrapped(line, "      ") for line in row["run"][-MOST_TICKS:])
    for one in summaries:
        own = [row for row in rows if row["system"] == one["system"]]
        asked = [row for row in own if row["kind"] in ("state", "transition")]
        many = counted(one["transitions"], "transition", "transitions")
        said = f"{counted(one['states'], 'state', 'states')}, {many}"
        rest = "all of them can happen" if not asked else f"{len(asked)} of them as above"
        rest = rest if one["asked"] else "not asked about as long as a run has no meaning"
        if interrupted and one["questions"]:
            rest = f"interrupted: {one['answered']} of {one['questions']} questions about them are answered"
        elif interrupted:
            rest = "interrupted before they were asked about"
        fine = not interrupted and all(row["kind"] in NUMBERS and row["found"] == "never" for row in own)
        yield _wrapped(f"{'✓' if fine else '•'} {one['system']}: {said}, {rest}.")


_CALLED = {
    "way out": "state ", "condition": "the condition of ", "order": "transitions ",
    **dict.fromkeys(NUMBERS, ""),
}  # fmt: skip


def _sentence(row: LintRow) -> tuple[str, str]:
    """The mark of a row, and what is said of it."""
    verb = "active" if row["kind"] == "state" else "taken"
    match row["kind"], row["found"]:
        case ("range" | "step" | "overflow") as kind, "happens":
            return ("•" if kind == "overflow" else "✗"), ": this happens."
        case (("range" | "step" | "overflow"), "never"):
            return "✓", ": this never happens."
        case (("range" | "step" | "overflow"), _):
            return "?", ": whether this happens was not decided."
        case "way out", _:
            return "•", " is never left once it is active."
        case "condition", "never":
            return "✗", " always holds where it is tested."
        case "order", "happens":
            return "•", " hold at the same time in some run: their order decides."
        case (("condition" | "order"), _):
            asked = "always holds" if row["kind"] == "condition" else "ever hold at the same time"
            return "?", f": whether it {asked} was not decided."
        case _, "never":
            return "✗", f" is never {verb}."
    return "?", f": whether it is ever {verb} was not decided."


def _wrapped(text: str, indent: str = "") -> str:
    return filled(" ".join(text.split()), text_width(), indent, f"{indent}  ")


__all__ = ["told_lines"]
