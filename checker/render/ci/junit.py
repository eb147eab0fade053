"""Verdicts as JUnit XML, as Jenkins, GitLab and others read it: a suite per system, a case per property."""

import re
from collections.abc import Callable, Iterator
from io import BytesIO

from junitparser import Error, Failure, JUnitXml, Skipped, TestCase, TestSuite
from junitparser.junitparser import FinalResult

from rovercheck.checker.render.ci import CiFinding, CiReport, FindingLevel, counts, explained

FIRST = "rovercheck"
_EXPECTED = (FindingLevel.KNOWN, FindingLevel.EXPIRED)
_CONTROL = re.compile(r"[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML cannot hold."""


def junit(report: CiReport) -> str:
    """The report as XML text.

    Suites and their cases stand in the order of ``worst_first``.  A violation that is expected has passed and
    says so, also where the time is over for which it was accepted; what is not decided is an error, or
    skipped where just that is expected, and never a pass.  That not all was decided is an error of its own.
    """
    xml = JUnitXml(FIRST)
    by_system: dict[str, list[CiFinding]] = {}
    for finding in report.worst_first():
        by_system.setdefault(finding.system, []).append(finding)
    for system, findings in by_system.items():
        xml.add_testsuite(_suite(system, findings, report.variant))
    if not report.complete:
        xml.add_testsuite(_interrupted(report))
    count: Callable[[], None] = xml.update_statistics
    count()
    for element in (xml._elem, *xml._elem.iter("testsuite")):
        element.attrib.pop("time", None)  # nothing was timed
    xml._elem.attrib.pop("skipped", None)  # the schema of Jenkins has it for suites only
    out = BytesIO()
    xml.write(out, pretty=True)
    return out.getvalue().decode() + "\n"


def _suite(system: str, findings: list[CiFinding], variant: str) -> TestSuite:
    suite = TestSuite(_clean(system))
    suite.add_property("verdicts", counts(findings))
    engines = sorted({f.details["engine"] for f in findings if f.details.get("engine")})
    for name, value in (("engines", ", ".join(engines)), ("variant", variant)):
        if value:
            suite.add_property(name, _clean(value))
    suite.add_testcases([_case(f) for f in findings])
    return suite


def _case(finding: CiFinding) -> TestCase:
    case = TestCase(_clean(finding.id), classname=_clean(f"{FIRST}.{finding.system}"))
    case.result = list(_results(finding))
    lines = [
        finding.headline,
        explained(finding) if finding.level in _EXPECTED else finding.evidence,
    ]
    lines += [f"{name}: {value}" for name, value in finding.details.items()]
    case.system_out = _clean("\n".join(lines))
    return case


def _results(finding: CiFinding) -> Iterator[FinalResult]:
    """What makes a case no pass; nothing for one that passed."""
    kinds = {FindingLevel.FAILED: Failure, FindingLevel.REJECTED: Error, FindingLevel.OPEN: Error}
    kind = kinds.get(finding.level)
    if kind is None and finding.level in _EXPECTED and finding.word == "unknown":
        kind = Skipped
    if kind is not None:
        result = kind(_clean(finding.headline), finding.level.value)
        result.text = _clean(explained(finding))
        yield result


def _interrupted(report: CiReport) -> TestSuite:
    suite, case = TestSuite("not decided"), TestCase(report.end, classname=FIRST)
    case.result = [Error(_clean(report.missing), "incomplete")]
    suite.add_testcase(case)
    return suite


def _clean(text: str) -> str:
    return _CONTROL.sub("\ufffd", text)
