"""What `check` tells machines: JUnit and SARIF files, annotations of a pull request."""

import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING

from rovercheck.checker.certify.outcome import Rejected
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import possible, write
from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.render.ci import CiFinding, CiReport, FindingLevel
from rovercheck.checker.render.ci.github import annotations, summary
from rovercheck.checker.render.ci.junit import junit
from rovercheck.checker.render.ci.sarif import sarif
from rovercheck.checker.render.verdict_text import evidence, recorded
from rovercheck.checker.results.trace import Trace, counted_ticks
from rovercheck.checker.results.verdict import Exhausted, Unknown, Violated
from rovercheck.checker.verify.checked import CheckedProperty, length
from rovercheck.checker.verify.finding_order import FindingOrder, order_of
from rovercheck.properties.forms import Reachable

if TYPE_CHECKING:
    from rovercheck.checker.commands.check import CheckOptions
    from rovercheck.checker.commands.check.run import ResultDelivery
    from rovercheck.checker.model.variant import Variant

SUMMARY = "GITHUB_STEP_SUMMARY"
"""The file, named by GitHub, to which a step adds its summary."""


@dataclass(frozen=True)
class Reports:
    """The files and annotations that were asked for.

    They are written whole, also when a run was interrupted: then they say so.
    """

    order: FindingOrder
    junit: Path | None = None
    sarif: Path | None = None
    annotations: str = ""
    variant: str = ""
    options: str = ""
    as_json: bool = False
    _token: str = field(default_factory=token_hex, init=False)
    """What makes the runner of GitHub look for commands again; nobody who writes a model knows it."""

    @property
    def _in_log(self) -> bool:
        """Whether annotations stand in the log behind what people read."""
        return bool(self.annotations) and not self.as_json

    def possible(self) -> None:
        """Raises ``UsageError`` when a file cannot be written, before anything is decided.

        What is printed from now on, until the annotations, commands nothing on GitHub, whatever a model says.
        """
        possible(self.junit)
        possible(self.sarif)
        if self._in_log:
            print(f"::stop-commands::{self._token}", flush=True)

    def write(self, found: Sequence[CheckedProperty], wanted: int, ended: str = "") -> None:
        """Write all of them.  Raises ``UsageError`` for a place that cannot be written."""
        findings = tuple(finding(c, self.order, self.options) for c in self.order.ordered(found))
        report = CiReport(findings, wanted, self.variant, ended)
        if self.annotations:
            text = annotations(report)  # the runner reads both streams
            if self._in_log:
                write(f"::{self._token}::\n{text}", None)
            else:
                print(text, end="", file=sys.stderr)
            _summarised(report)
        if self.junit:
            write(junit(report), self.junit)
        if self.sarif:
            write(sarif(report), self.sarif)


def _summarised(report: CiReport) -> None:
    """Add the summary to that of the job, if this runs in one."""
    file = os.environ.get(SUMMARY)
    if file:
        try:
            with Path(file).open("a", encoding="utf-8") as stream:
                stream.write(summary(report))
        except OSError as error:
            raise UsageError(f"Cannot write {whole(file)}: {error.strerror}. Unset {SUMMARY}.") from error


def reporting(options: "CheckOptions", variant: "Variant") -> "ResultDelivery":
    """Writes the reports that are asked for.  Raises ``UsageError`` where one cannot be written."""
    reports = Reports(
        order_of(variant.model, variant.systems()),
        options.junit,
        options.sarif,
        options.annotations or "",
        variant.name,
        variant.options,
        options.as_json,
    )
    reports.possible()
    return reports.write


def finding(compared: CheckedProperty, order: FindingOrder, options: str = "") -> CiFinding:
    """A verdict as every report shows it."""
    systems, hazard = order.systems, order.hazard(compared)
    prop, verdict = compared.result.property, compared.verdict
    because = verdict.reason if isinstance(verdict, Unknown) else verdict.because
    on_record = compared.verdict.word == compared.expected.verdict
    system = systems.get(compared.result.system, systems.get(prop.on))
    return CiFinding(
        id=prop.id,
        text=prop.text,
        system=compared.result.system,
        word=compared.word,
        level=level(compared),
        evidence=_rejected(compared) or evidence(compared.result),
        recorded=recorded(compared.expected),
        because=compared.expected.because if on_record else "",
        effect=compared.expected.effect if on_record else "",
        severity=hazard.severity,
        hazard=" ".join(filter(None, (hazard.id, hazard.text))) if hazard.id else "",
        accepted=compared.expected.accepted if on_record else None,
        since=compared.expected.since if on_record else None,
        lapsed=compared.lapsed is not None,
        help="\n".join(formally(prop, system, "")) if system is not None else prop.text,
        tags=prop.covers,
        place=prop.place,
        trace=because if isinstance(because, Trace) else None,
        details=_details(compared),
        options=f" {options}" if options else "",
        variant=compared.variant,
    )


def _rejected(compared: CheckedProperty) -> str:
    found = compared.result.certificate
    return f"{found.obligation}: {found.shown}" if isinstance(found, Rejected) else ""


def level(compared: CheckedProperty) -> FindingLevel:
    """How the verdict counts: as the exit code has it."""
    if isinstance(compared.result.certificate, Rejected):
        return FindingLevel.REJECTED
    match compared.code:
        case Exit.AS_EXPECTED if compared.lapsed is not None:
            return FindingLevel.EXPIRED
        case Exit.AS_EXPECTED:
            return (
                FindingLevel.KNOWN
                if isinstance(compared.verdict, Violated | Unknown)
                else FindingLevel.PASSED
            )
        case Exit.INCONCLUSIVE:
            return FindingLevel.OPEN
    return FindingLevel.FAILED


def _details(compared: CheckedProperty) -> dict[str, str]:
    """Engine, states and bound."""
    verdict, found = compared.verdict, {"engine": compared.verdict.engine}
    if isinstance(verdict, Unknown):
        none = "no run to it" if isinstance(compared.result.property.form, Reachable) else "no counterexample"
        return {**found, "bound": f"{none} within {counted_ticks(verdict.depth)}"}
    if isinstance(verdict.because, Exhausted):
        found["states"] = str(verdict.because.states)
    ticks = length(verdict)
    return {**found, "ticks": str(ticks)} if ticks is not None else found
