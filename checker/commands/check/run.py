"""``rovercheck check``: verdicts against the baseline."""

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

from checker.certify.outcome import Rejected
from checker.commands.check.certificates import certificates, certified
from checker.commands.check.findings import (
    ALONE,
    Guide,
    about_cases,
    about_chains,
    about_faults,
    read_on,
    totals,
)
from checker.commands.check.further import NOTHING_FURTHER, Further
from checker.commands.shared.codes import Exit, UsageError
from checker.commands.shared.failure import alarm, code_of, told
from checker.commands.shared.output import err, out, wrapped
from checker.commands.shared.progress import Watch
from checker.commands.shared.wrapping import plain
from checker.engines import Limits
from checker.io.printable import json_text
from checker.model.kept_invariants import Recorded
from checker.process.faults import Fault, heard, listening, tell
from checker.render.story import repeating
from checker.results.trace import Trace, counted_ticks
from checker.results.verdict import Exhausted, Inductive, Proved, Unknown, Verdict, Violated
from checker.system.formula_json import Tree
from checker.verify.result import Result
from checker.verify.searches import Over, SearchDoing, Warned, searches
from checker.verify.tasks import Task, tasks
from properties.catalogue import Expected, expected
from properties.forms import Property, Reachable
from spec_model.lang.system import System

if TYPE_CHECKING:
    from checker.commands.check.premises import PremiseCase
    from checker.verify.certificates import Certifying

NONE_RECORDED: Recorded = {}
EVIDENCE = 33
"""The column in which the evidence of a verdict begins."""
SIGNS = {"proved": "✓", "violated": "✗", "unknown": "?"}


@dataclass(frozen=True)
class Compared:
    """A result beside the verdict on record; ``variant`` says how the charts differ from those specified.

    ``case``: whether the case occurs that a proof speaks of, ``noticed``: whether a fault is known that it
    notices, each if that was asked.  With ``strict``, a proof of a case that never occurs is not enough, nor
    one that notices no known fault.
    """

    result: Result
    expected: Expected
    variant: str = ""
    case: "PremiseCase | None" = None
    noticed: bool | None = None
    strict: bool = False

    @property
    def verdict(self) -> Verdict:
        return self.result.verdict

    @property
    def word(self) -> str:
        """The verdict for people; ``proved in part`` where only some of the runs were searched."""
        said = f"{self.verdict.word} in part" if self.result.in_part else self.verdict.word
        return f"{said}, of nothing" if self.empty else said

    @property
    def empty(self) -> bool:
        """Whether it is a proof of a case that never occurs."""
        return self.case is not None and self.case.occurs is False

    @property
    def idle(self) -> bool:
        """Whether it is a proof that notices no known fault, and the baseline does not say why."""
        return self.noticed is False and not self.expected.no_fault

    @property
    def as_expected(self) -> bool:
        """Same verdict, and for a counterexample on record the same length."""
        if self.verdict.word != self.expected.verdict:
            return False
        depth = None if self.variant else self.expected.depth
        return depth is None or not isinstance(self.verdict, Violated) or length(self.verdict) == depth

    @property
    def length(self) -> int | None:
        """The number of ticks of the run that the verdict rests on, if it rests on one."""
        return length(self.verdict)

    @property
    def code(self) -> Exit:
        if isinstance(self.result.certificate, Rejected):
            return Exit.INTERNAL
        if self.strict and self.case is not None and not self.case.occurs:
            return Exit.CHANGED if self.empty else Exit.INCONCLUSIVE
        if self.strict and self.idle and not self.variant:
            return Exit.INCONCLUSIVE
        if self.as_expected or (self.variant and isinstance(self.verdict, Proved)):
            return Exit.AS_EXPECTED
        return Exit.INCONCLUSIVE if isinstance(self.verdict, Unknown) else Exit.CHANGED


def length(verdict: Verdict) -> int | None:
    """The number of ticks of the trace a verdict rests on, if it rests on one."""
    because = None if isinstance(verdict, Unknown) else verdict.because
    return len(because) if isinstance(because, Trace) else None


def results(
    properties: Sequence[Property],
    systems: Mapping[str, System],
    engine: str,
    limits: Limits,
    jobs: int | None = None,
    certifying: "Certifying | None" = None,
    quiet: bool = False,
    invariants: Recorded = NONE_RECORDED,
) -> Generator[Result, None, None]:
    """Decide the properties, several searches at a time; results come as they are found.

    With ``quiet``, nothing is said meanwhile.  The ``invariants`` on record are tried first.

    On Ctrl-C the searches under way are ended and ``KeyboardInterrupt`` is raised.
    """
    # The largest first, so that no long search is left for the end; those of one system together.
    asked = (replace(task, recorded=on_record(task, invariants)) for task in tasks(properties, systems))
    todo = sorted(asked, key=lambda t: (-t.size, t.system.name, t.title))
    heard = searches(todo, systems, engine, limits, jobs, certifying)
    with Watch(err, len(todo), quiet) as watch, closing(heard):
        for one in heard:
            match one:
                case SearchDoing(task, line):
                    watch.say(task.title, line)
                case Over(task):
                    watch.finished(task.title)
                case Warned(text):
                    err.print(text, markup=False)
                case Result():
                    yield limited(one, systems)


def limited(one: Result, systems: Mapping[str, System]) -> Result:
    """The result with what it is limited to by the system that it is about."""
    system = systems.get(one.system, systems[one.property.on])
    return replace(one, in_part=_in_part(one, system), limited_to=_limited_to(one, system))


def on_record(task: Task, invariants: Recorded) -> tuple[Tree, ...] | None:
    """The conjuncts of all proofs on record of the properties of a task; None if there is none."""
    known = [invariants[p.id] for p in task.properties if p.id in invariants]
    return tuple(tree for trees in known for tree in trees) if known else None


def _in_part(result: Result, system: System) -> bool:
    """Whether a search of too few runs was exhausted; a run found in it is a run of the rover."""
    verdict = result.verdict
    return system.under and not isinstance(verdict, Unknown) and not isinstance(verdict.because, Trace)


def _limited_to(result: Result, system: System) -> str:
    """What is said of the system beside a proof; a run is one of the rover whatever was left out."""
    verdict = result.verdict
    rests_on_all = not isinstance(verdict, Unknown) and not isinstance(verdict.because, Trace)
    return system.limited_to if rests_on_all else ""


class Deliver(Protocol):
    """Takes what was decided, how many properties were asked for, and the error that ended it early."""

    def __call__(self, found: Sequence[Compared], wanted: int, ended: str = "") -> None: ...


def undelivered(found: Sequence[Compared], wanted: int, ended: str = "") -> None:
    """No report beside what is printed."""


def check(
    properties: Sequence[Property],
    systems: Mapping[str, System],
    engine: str,
    limits: Limits,
    as_json: bool,
    variant: str = "",
    expect: Callable[[str], Expected] = expected,
    jobs: int | None = None,
    certifying: "Certifying | None" = None,
    guide: Guide = ALONE,
    deliver: Deliver = undelivered,
    quiet: bool = False,
    further: Further = NOTHING_FURTHER,
    strict: bool = False,
    invariants: Recorded = NONE_RECORDED,
) -> Exit:
    """Print every verdict with its evidence and what the baseline says of it.

    ``guide`` is what helps to read on.  ``deliver`` is called once at the end, however that comes.  With
    ``quiet``, only what is not as expected is printed.  What is asked ``further`` is asked of all that was
    found; ``strict`` makes a proof an error that speaks of a case that never occurs, or notices no fault.
    """
    if not properties:
        err.print("Nothing to check: the selection holds no property.")
        deliver([], 0)
        return Exit.NOTHING
    found: list[Compared] = []
    faults: list[Fault] = []
    try:
        with (
            listening(faults.append),
            closing(
                results(properties, systems, engine, limits, jobs, certifying, quiet, invariants)
            ) as coming,
        ):
            for result in coming:
                found.append(Compared(result, expect(result.property.id), variant))
                if not as_json and not (quiet and found[-1].code is Exit.AS_EXPECTED):
                    out.print(wrapped(line(found[-1]), EVIDENCE), markup=False)
                further.heard(found[-1])
        further.keep(found)
        cases, chains = further.cases(found), further.chains(found)
        found = [
            replace(c, case=cases.get(c.result.property.id), noticed=further.noticed(c), strict=strict)
            for c in found
        ]
    except BaseException as error:
        if as_json:
            from checker.commands.check.document import document

            gravest = bool(faults) and not isinstance(error, KeyboardInterrupt)
            print(json_text(document(found, code_of(error), gravest), ascii=True))
        alarms = _alarmed(faults)
        deliver(found, len(properties), " ".join(filter(None, (_why(error), alarms))))
        from checker.certify.file import Unwritable

        if isinstance(error, Unwritable):
            raise UsageError(str(error)) from error
        if not isinstance(error, KeyboardInterrupt):
            raise
        err.print(f"Interrupted: {len(found)} of {len(properties)} properties decided.")
        return Exit.INTERRUPTED
    if as_json:
        from checker.commands.check.document import document

        print(json_text(document(found, chains=chains, faulty=bool(faults)), ascii=True))
    elif not quiet:
        out.print()
        summary(found, guide)
        said = (
            *about_cases(found),
            *about_faults(found),
            *about_chains(chains),
            *read_on(found, systems, guide),
        )
        for text in said:
            out.print(wrapped(text, 4), markup=False)
    elif strict:
        wrong = [c for c in found if c.code is not Exit.AS_EXPECTED]
        for text in (*about_cases(wrong), *about_faults(wrong)):
            out.print(wrapped(text, 4), markup=False)
    deliver(found, len(properties), _alarmed(faults))
    return Exit.INTERNAL if faults else worst(found)


def _alarmed(faults: Sequence[Fault]) -> str:
    """Pass on every error of ours that the search went on without; all of them in one text."""
    for fault in faults:
        if heard():
            tell(fault)
        else:
            err.print(alarm(fault), markup=False)
    return " ".join(dict.fromkeys(map(alarm, faults)))


def _why(error: BaseException) -> str:
    """What those are told who read no terminal; nothing of an interruption."""
    if not isinstance(error, Exception):
        return ""
    return plain(str(error)) if code_of(error) is Exit.USAGE else told(error)


def worst(found: Sequence[Compared]) -> Exit:
    """A bug of ours outweighs a change, and that an inconclusive search."""
    codes = {c.code for c in found}
    for code in (Exit.INTERNAL, Exit.CHANGED, Exit.INCONCLUSIVE):
        if code in codes:
            return code
    return Exit.AS_EXPECTED


def line(compared: Compared) -> str:
    """One verdict in one line of 80 columns: sign, id, verdict, evidence."""
    verdict = compared.verdict
    sign = "≈" if compared.result.in_part else SIGNS[verdict.word]
    word = "in part" if compared.result.in_part else verdict.word
    text = f"{sign} {compared.result.property.id:<21} {word:<8} {in_short(compared.result)}"
    text += certified(compared.result.certificate)
    if compared.as_expected:
        return text + (", as on record" if verdict.word != "proved" else "")
    return text + f"\n    {_other(compared)} is {recorded(compared.expected)}"


def _other(compared: Compared) -> str:
    """What the verdict is compared with, in front of the verdict on record."""
    return f"{compared.variant}; as specified it" if compared.variant else "CHANGED: on record"


def in_short(result: Result) -> str:
    """The evidence in half a line."""
    verdict, system = result.verdict, result.system
    match verdict:
        case Unknown(reason, depth):
            return f"after {counted_ticks(depth)} of {system}: {reason}"
        case Proved((Exhausted() | Inductive()) as evidence_, _, claim):
            return _joined(f"{evidence_.how} of {system}", claim, result.limited_to)
        case Violated((Exhausted() | Inductive()) as evidence_):
            return _joined(f"never: {evidence_.how} of {system}", result.limited_to)
        case Proved(Trace() as trace):
            return f"reached in {ticks(trace)} of {system}"
        case Violated(Trace() as trace):
            return f"{ticks(trace)} of {system}"
    raise AssertionError(verdict)


def _joined(*said: str) -> str:
    return ", ".join(filter(None, said))


def recorded(entry: Expected) -> str:
    depth = f" after {counted_ticks(entry.depth)}" if entry.depth is not None else ""
    return f"{entry.verdict}{depth}"


def evidence(result: Result) -> str:
    """What the verdict rests on, in a few words."""
    verdict = result.verdict
    match verdict:
        case Unknown(reason, depth, engine):
            none = "no run to it" if isinstance(result.property.form, Reachable) else "no counterexample"
            return f"{engine} on {result.system}, {none} within {counted_ticks(depth)}: {reason}"
        case Proved((Exhausted() | Inductive()) as shown, engine, claim):
            whole = f"{engine}: {shown.how} of {result.system}"
            whole += f", depth {shown.depth}" if isinstance(shown, Exhausted) else ""
            return _joined(whole, claim, result.limited_to)
        case Violated((Exhausted() | Inductive()) as shown, engine):
            return _joined(f"{engine}: in none of {shown.how} of {result.system}", result.limited_to)
        case Proved(Trace() as trace, engine):
            return f"{engine}: witness of {ticks(trace)} on {result.system}"
        case Violated(Trace() as trace, engine):
            return f"{engine}: counterexample of {ticks(trace)} on {result.system}"
    raise AssertionError(verdict)


def ticks(trace: Trace) -> str:
    """``155 ticks = 3.1 s``, and how many of them repeat for ever."""
    seconds = trace.ms(len(trace)) / 1000
    return f"{counted_ticks(len(trace))} = {seconds:g} s{repeating(trace)}"


def summary(found: Sequence[Compared], guide: Guide) -> None:
    """Counts, and for each change what to do next."""
    changed = [c for c in found if not c.as_expected]
    out.print(totals(found), markup=False)
    parts = sum(c.result.in_part for c in found)
    if parts:
        out.print(f"≈ {parts} of them for some runs only: see the notes of their systems.", markup=False)
    certificates([c.result for c in found])
    if not changed:
        out.print("Every verdict is as on record in the baseline.")
        return
    if changed[0].variant:
        out.print(f"{len(changed)} of them differ {changed[0].variant}.", markup=False)
        return
    for compared in changed:
        _explain(compared, guide)


def _explain(compared: Compared, guide: Guide) -> None:
    prop, verdict = compared.result.property, compared.verdict
    out.print(f"\n{prop.id} is {verdict.word}, on record is {recorded(compared.expected)}.", markup=False)
    out.print(f"  {prop.text}", markup=False)
    if isinstance(verdict, Violated) and isinstance(verdict.because, Trace):
        fired = [a for t in verdict.because.ticks for a in t.arrows if a.order]
        for arrow in fired[-3:]:
            out.print(f"  fired: {arrow}", markup=False)
        out.print(f"  See it whole: {guide.command('trace', prop.id)}", markup=False)


__all__ = ["Compared", "check", "evidence", "length", "limited", "on_record", "results", "ticks"]
