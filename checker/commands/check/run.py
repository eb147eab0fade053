"""``rovercheck check``: verdicts against the baseline."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Protocol

from rovercheck.checker.commands.check.certificates import certificates, certified
from rovercheck.checker.commands.check.findings import (
    ALONE,
    Guide,
    about_acceptances,
    about_cases,
    about_chains,
    about_faults,
    read_on,
    totals,
)
from rovercheck.checker.commands.check.further import NOTHING_FURTHER, CheckExtras
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.failure import alarm, code_of, error_message
from rovercheck.checker.commands.shared.output import err, out, wrapped
from rovercheck.checker.commands.shared.text_wrap import plain
from rovercheck.checker.commands.shared.verdicts import BY_DEFAULT, results
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.process.faults import Fault, has_listener, listening, report
from rovercheck.checker.render.verdict_text import in_short, recorded
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.verify.checked import CheckedProperty, worst
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import expected
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System

EVIDENCE = 33
"""The column in which the evidence of a verdict begins."""
SIGNS = {"proved": "✓", "violated": "✗", "unknown": "?"}


class ResultDelivery(Protocol):
    """Takes what was decided, how many properties were asked for, and the error that ended it early."""

    def __call__(self, found: Sequence[CheckedProperty], wanted: int, ended: str = "") -> None: ...


def undelivered(found: Sequence[CheckedProperty], wanted: int, ended: str = "") -> None:
    """No report beside what is printed."""


@dataclass(frozen=True)
class CheckRequest:
    """What is decided: properties of systems by name, and the verdict that each is expected to have.

    ``variant`` says how the charts differ from those specified.  What is asked ``further`` is asked of all
    that was found; with ``strict`` a proof is an error that speaks of a case that never occurs, or notices no
    fault.
    """

    properties: Sequence[Property]
    systems: Mapping[str, System]
    search: SearchSettings = BY_DEFAULT
    variant: str = ""
    expected: Callable[[str], Expected] = expected
    further: CheckExtras = NOTHING_FURTHER
    strict: bool = False

    def checked(self, found: Sequence[CheckedProperty]) -> list[CheckedProperty]:
        """The same with what was asked further."""
        cases = self.further.cases(found)
        return [
            replace(
                c,
                case=cases.get(c.result.property.id),
                noticed=self.further.noticed(c),
                strict=self.strict,
            )
            for c in found
        ]


@dataclass(frozen=True)
class CheckOutput:
    """How verdicts are told: with ``quiet`` only what is not as expected is printed.

    ``guide`` is what helps to read on.  ``deliver`` is called once at the end, however that comes.
    """

    as_json: bool = False
    quiet: bool = False
    guide: Guide = ALONE
    deliver: ResultDelivery = undelivered

    def each(self, one: CheckedProperty) -> None:
        """Print a verdict as soon as it is there."""
        if not self.as_json and not (self.quiet and one.code is Exit.AS_EXPECTED):
            out.print(wrapped(line(one), EVIDENCE), markup=False)


PRINTED = CheckOutput()


def check(request: CheckRequest, output: CheckOutput = PRINTED) -> Exit:
    """Print every verdict with its evidence and what the baseline says of it."""
    wanted = len(request.properties)
    if not wanted:
        err.print("Nothing to check: the selection holds no property.")
        output.deliver([], 0)
        return Exit.NOTHING
    found: list[CheckedProperty] = []
    faults: list[Fault] = []
    try:
        with (
            listening(faults.append),
            closing(results(request.properties, request.systems, request.search, output.quiet)) as coming,
        ):
            for result in coming:
                found.append(CheckedProperty(result, request.expected(result.property.id), request.variant))
                output.each(found[-1])
                request.further.on_result(found[-1])
        request.further.keep(found)
        found, chains = request.checked(found), request.further.chains(found)
    except BaseException as error:
        return _ended(error, found, faults, wanted, output)
    if output.as_json:
        from rovercheck.checker.commands.check.document import document

        order = output.guide.order
        print(json_text(document(found, chains=chains, faulty=bool(faults), order=order), ascii=True))
    elif not output.quiet:
        out.print()
        summary(found, output.guide)
        about = *about_acceptances(found), *about_cases(found), *about_faults(found), *about_chains(chains)
        _say(*about, *read_on(found, output.guide))
    else:
        wrong = [c for c in found if request.strict and c.code is not Exit.AS_EXPECTED]
        _say(*about_acceptances(found), *about_cases(wrong), *about_faults(wrong))
    output.deliver(found, wanted, _alarmed(faults))
    return Exit.INTERNAL if faults else worst(found)


def _ended(
    error: BaseException,
    found: Sequence[CheckedProperty],
    faults: Sequence[Fault],
    wanted: int,
    output: CheckOutput,
) -> Exit:
    """What was decided when an error or Ctrl-C ended the check is delivered all the same.

    Raises the error again, unless it is Ctrl-C; as ``UsageError`` where no certificate can be written.
    """
    if output.as_json:
        from rovercheck.checker.commands.check.document import document

        gravest = bool(faults) and not isinstance(error, KeyboardInterrupt)
        print(json_text(document(found, code_of(error), gravest, order=output.guide.order), ascii=True))
    output.deliver(found, wanted, " ".join(filter(None, (_why(error), _alarmed(faults)))))
    from rovercheck.checker.certify.file import Unwritable

    if isinstance(error, Unwritable):
        raise UsageError(str(error)) from error
    if not isinstance(error, KeyboardInterrupt):
        raise error
    err.print(f"Interrupted: {len(found)} of {wanted} properties decided.")
    return Exit.INTERRUPTED


def _say(*texts: str) -> None:
    for text in texts:
        out.print(wrapped(text, 6), markup=False)


def _alarmed(faults: Sequence[Fault]) -> str:
    """Pass on every internal error that the search went on without; all of them in one text."""
    for fault in faults:
        if has_listener():
            report(fault)
        else:
            err.print(alarm(fault), markup=False)
    return " ".join(dict.fromkeys(map(alarm, faults)))


def _why(error: BaseException) -> str:
    """What those are told who read no terminal; nothing of an interruption."""
    if not isinstance(error, Exception):
        return ""
    return plain(str(error)) if code_of(error) is Exit.USAGE else error_message(error)


def line(compared: CheckedProperty) -> str:
    """One verdict in one line of 80 columns: sign, id, verdict, evidence."""
    verdict = compared.verdict
    sign = "≈" if compared.result.in_part else SIGNS[verdict.word]
    model = "for a restricted model: " if compared.result.in_part else ""
    text = f"{sign} {compared.result.property.id:<21} {verdict.word:<8} {model}{in_short(compared.result)}"
    text += certified(compared.result.certificate)
    if compared.as_expected:
        return text + (", as expected" if verdict.word != "proved" else "")
    return text + f"\n    {_other(compared)} {recorded(compared.expected)}"


def _other(compared: CheckedProperty) -> str:
    """What the verdict is compared with, in front of the expected verdict."""
    return f"{compared.variant}; as specified it is" if compared.variant else "CHANGED: expected"


def summary(found: Sequence[CheckedProperty], guide: Guide) -> None:
    """Counts, and for each change what to do next."""
    changed = [c for c in found if not c.as_expected]
    out.print(totals(found), markup=False)
    parts = sum(c.result.in_part for c in found)
    if parts:
        out.print(f"≈ {parts} of them for a restricted model: see the notes of their systems.", markup=False)
    certificates([c.result for c in found])
    if not changed:
        out.print("Every verdict is as expected.")
        return
    if changed[0].variant:
        out.print(f"{len(changed)} of them differ {changed[0].variant}.", markup=False)
        return
    for compared in changed:
        _explain(compared, guide)


def _explain(compared: CheckedProperty, guide: Guide) -> None:
    prop, verdict = compared.result.property, compared.verdict
    out.print(f"\n{prop.id} is {verdict.word}; expected: {recorded(compared.expected)}.", markup=False)
    out.print(f"  {prop.text}", markup=False)
    if isinstance(verdict, Violated) and isinstance(verdict.because, Trace):
        fired = [a for t in verdict.because.ticks for a in t.transitions if a.order]
        for transition in fired[-3:]:
            out.print(f"  fired: {transition}", markup=False)
        out.print(f"  See it whole: {guide.command('trace', prop.id)}", markup=False)
