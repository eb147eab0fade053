"""``DETECTION.md``: what the cross-check finds, and everything that it does not find, by name."""

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import median

from benchmarks.faults.by_hand import Fault
from benchmarks.faults.hand_run import Caught
from benchmarks.faults.judged import EQUIVALENT, OUTSIDE, judgements
from benchmarks.faults.mutate import Mutant
from benchmarks.faults.recorded import Found
from benchmarks.faults.worker import Answer
from benchmarks.markdown import table
from benchmarks.measure import ROOT

FILE = ROOT / "benchmarks" / "DETECTION.md"
TARGET = 0.95
HEAD = """# Detection power

Written by `python -m benchmarks.mutants --write`, also with `--faults` and with `--link`.

A mutant is found when some output of the supervisor differs from what the charts require in a run of the
cross-check's CI profile, or when the supervisor raises. *Equivalent* and *outside* are judgements of a
person, one by one, with their reasons in `faults/judged.toml`; a judged mutant is replayed all the same, and
listed here if the judgement was wrong. Whatever is neither found nor judged counts as missed.
"""


@dataclass(frozen=True)
class Sorted:
    """The mutants of a campaign by what became of them."""

    run: Sequence[Mutant]
    unusable: Sequence[Mutant]
    found: Mapping[str, Found]
    judged: Mapping[str, str]
    missed: Sequence[Mutant]

    @property
    def share(self) -> float:
        """The share found of those that neither fail to start nor are judged."""
        return len(self.found) / max(1, len(self.found) + len(self.missed))

    @property
    def wrongly_judged(self) -> Sequence[str]:
        """Judged mutants that were found all the same."""
        return [name for name in self.judged if name in self.found]


def sort(mutants: Sequence[Mutant], answers: Mapping[str, Answer]) -> Sorted:
    """What became of each mutant that was run; one without answer could not be started."""
    known = judgements()
    return Sorted(
        run=mutants,
        unusable=[m for m in mutants if m.name not in answers],
        found={name: answer for name, answer in answers.items() if isinstance(answer, Found)},
        judged={m.name: known[m.name].kind for m in mutants if m.name in known and m.name in answers},
        missed=[m for m in mutants if m.name not in known and isinstance(answers.get(m.name), int)],
    )


def of_mutants(result: Sorted, of_all: int) -> str:
    """The part about the mutants of the boards."""
    kinds = Counter(result.judged.values())
    rows = [
        ("mutants made by Cosmic Ray", of_all),
        ("of these run", len(result.run)),
        ("do not start: a syntax error, or an exception while the package is imported", len(result.unusable)),
        ("equivalent: no input of a board tells them apart", kinds[EQUIVALENT]),
        ("outside: only what the charts give no meaning to tells them apart", kinds[OUTSIDE]),
        ("the others", len(result.found) + len(result.missed)),
        ("of these found", len(result.found)),
    ]
    steps = [f.steps for f in result.found.values()] or [0]
    early = median(steps), sorted(steps)[int(0.9 * (len(steps) - 1))]
    return "\n".join([
        table(("", "number"), [(text, str(number)) for text, number in rows]),
        f"Found: **{result.share:.1%}** (wanted: {TARGET:.0%}). "
        f"Half of them differ within {early[0]:.0f} replayed steps, nine in ten within {early[1]}.",
        "",
        table(("part of the supervisor", "found", "missed"), list(_by_module(result))),
        "### Missed",
        "",
        *_named(result.missed),
        "",
        _wrong(result),
    ])  # fmt: skip


def _named(mutants: Sequence[Mutant]) -> list[str]:
    return [f"- `{m.name}`" for m in mutants] or ["None."]


def _wrong(result: Sorted) -> str:
    names = [f"- `{name}`" for name in result.wrongly_judged]
    return "\n".join(["### Judged, yet found", "", *names]) if names else ""


def _by_module(result: Sorted) -> Iterator[tuple[str, str, str]]:
    module = {m.name: m.module.removeprefix("rovercheck.supervisor.") for m in result.run}
    found = Counter(module[name] for name in result.found if name in module)
    missed = Counter(module[m.name] for m in result.missed)
    for name in sorted(found.keys() | missed.keys()):
        yield name, str(found[name]), str(missed[name])


def of_own_tests(results: Sequence[tuple[Mutant, bool]], of_all: int) -> str:
    """The part about mutants that the supervisors' own tests meet."""
    missed = [m for m, found in results if not found]
    counts = f"{len(results) - len(missed)} of {len(results)} that were run, of {of_all} in all"
    return "\n".join(
        [f"Found: **{counts}**; those that do not start count as found. Missed:", "", *_named(missed)]
    )


def of_faults(results: Sequence[tuple[Fault, Caught | int]]) -> str:
    """The part about the faults put in by hand."""
    found = sum(isinstance(r, Caught) for _, r in results)
    rows = [
        (f.kind, f.board, f.part, f.text, r.origin, str(r.steps), r.output)
        if isinstance(r, Caught)
        else (f.kind, f.board, f.part, f.text, "**not found**", str(r), "")
        for f, r in results
    ]
    head = ("kind", "board", "part", "fault", "found in", "steps", "output")
    return f"Found: **{found} of {len(results)}**.\n\n{table(head, rows)}"


def write(key: str, title: str, text: str) -> None:
    """Replace the part of ``DETECTION.md`` between the marks of ``key``, or add it at the end."""
    start, end = f"<!-- {key} -->", f"<!-- end of {key} -->"
    part = f"{start}\n## {title}\n\n{text.rstrip()}\n{end}\n"
    old = FILE.read_text(encoding="utf-8") if FILE.exists() else HEAD
    marked = re.compile(re.escape(start) + ".*?" + re.escape(end) + r"\n", re.DOTALL)
    new = marked.sub(lambda _: part, old) if marked.search(old) else f"{old.rstrip()}\n\n{part}"
    FILE.write_text(new, encoding="utf-8")
