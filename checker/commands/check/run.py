"""``rovercheck check``: verdicts against the baseline."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Protocol

from rovercheck.checker.commands.check.further import NOTHING_FURTHER, CheckExtras
from rovercheck.checker.commands.check.text import CheckText
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.failure import alarm, code_of, error_message
from rovercheck.checker.commands.shared.output import err
from rovercheck.checker.commands.shared.text_wrap import plain
from rovercheck.checker.commands.shared.told import ToldVerdict, told
from rovercheck.checker.commands.shared.verdicts import BY_DEFAULT, results
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.process.faults import Fault, has_listener, listening, report
from rovercheck.checker.results.verdict import StoredRun, Unknown
from rovercheck.checker.verify.checked import CheckedProperty, worst
from rovercheck.checker.verify.finding_order import FindingOrder
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import expected
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System


class ResultDelivery(Protocol):
    """Takes what was decided, how many properties were asked for, and the error that ended it early."""

    def __call__(self, found: Sequence[CheckedProperty], wanted: int, ended: str = "") -> None: ...


def undelivered(found: Sequence[CheckedProperty], wanted: int, ended: str = "") -> None:
    """No report beside what is printed."""


NO_ORDER = FindingOrder()
"""Of properties that are nobody's model."""


def unkept(found: Sequence[ToldVerdict]) -> None:
    """Nothing is kept of what was told."""


@dataclass(frozen=True)
class CheckRequest:
    """What is decided: properties of systems by name, and the verdict that each is expected to have.

    ``variant`` says how the charts differ from those specified.  What is asked ``further`` is asked of all
    that was found; with ``strict`` a proof is an error that speaks of a case that never occurs, or notices no
    fault.  ``keep`` is called with what was told, once all is decided; ``order`` says which findings are
    gravest.
    """

    properties: Sequence[Property]
    systems: Mapping[str, System]
    search: SearchSettings = BY_DEFAULT
    variant: str = ""
    expected: Callable[[str], Expected] = expected
    further: CheckExtras = NOTHING_FURTHER
    strict: bool = False
    keep: Callable[[Sequence[ToldVerdict]], None] = unkept
    order: FindingOrder = NO_ORDER

    def compared(self, result: Result) -> CheckedProperty:
        """A result beside the verdict that is expected; where they differ, a run that is kept is replayed."""
        one = CheckedProperty(result, self.expected(result.property.id), self.variant)
        if one.as_expected or isinstance(one.verdict, Unknown):
            return one
        if not isinstance(one.verdict.because, StoredRun):
            return one
        from rovercheck.checker.verify.stored import again

        return replace(one, result=again(result, self.systems))

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
class CheckOutput(CheckText):
    """How verdicts are told; ``deliver`` is called once at the end, however that comes."""

    deliver: ResultDelivery = undelivered


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
                found.append(request.compared(result))
                output.each(told(found[-1], request.order))
                request.further.on_result(found[-1])
        request.further.keep(found)
        found, chains = request.checked(found), request.further.chains(found)
    except BaseException as error:
        return _ended(error, found, faults, request, output)
    said = [told(c, request.order) for c in found]
    output.end(said, chains, bool(faults))
    if not faults:
        request.keep(said)
    output.deliver(found, wanted, _alarmed(faults))
    return Exit.INTERNAL if faults else worst(found)


def _ended(
    error: BaseException,
    found: Sequence[CheckedProperty],
    faults: Sequence[Fault],
    request: CheckRequest,
    output: CheckOutput,
) -> Exit:
    """What was decided when an error or Ctrl-C ended the check is delivered all the same.

    Raises the error again, unless it is Ctrl-C; as ``UsageError`` where no certificate can be written.
    """
    wanted, order = len(request.properties), request.order
    if output.as_json:
        from rovercheck.checker.commands.check.document import document

        gravest = bool(faults) and not isinstance(error, KeyboardInterrupt)
        said = [told(c, order) for c in found]
        print(json_text(document(said, code_of(error), gravest), ascii=True))
    output.deliver(found, wanted, " ".join(filter(None, (_why(error), _alarmed(faults)))))
    from rovercheck.checker.certify.file import Unwritable

    if isinstance(error, Unwritable):
        raise UsageError(str(error)) from error
    if not isinstance(error, KeyboardInterrupt):
        raise error
    err.print(f"Interrupted: {len(found)} of {wanted} properties decided.")
    return Exit.INTERRUPTED


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
