"""A property as a test: it passes if its verdict is the expected one, else it shows why not."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.commands.check.ci import finding
from rovercheck.checker.commands.shared.failure import error_message
from rovercheck.checker.commands.trace.explain import ExplanationOptions
from rovercheck.checker.model import Model
from rovercheck.checker.pytest_plugin.decisions import Decider, NoVerdict
from rovercheck.checker.render.ci import explained
from rovercheck.checker.render.verdict_text import evidence, recorded
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.finding_order import order_of
from rovercheck.properties.forms import Property

# --- what the report of a property says ----------------------------------------------------------------


def on_record(compared: CheckedProperty) -> str:
    """One line on a verdict that is no proof and was expected."""
    prop, entry = compared.result.property, compared.expected
    because = entry.because or (entry.accepted.because if entry.accepted else "")
    return f"{prop.id} is {compared.verdict.word}, as expected: {because}"


def shown(compared: CheckedProperty, model: Model) -> str:
    """A verdict that is not the expected one, with its cause as far as that is found."""
    try:
        return _why(_with_reasons(compared, model), model)
    except Exception as error:  # the verdict stands
        id, expected = compared.result.property.id, recorded(compared.expected)
        return f"{id} is {compared.word}; expected: {expected}\n{error_message(error)}"


def _with_reasons(compared: CheckedProperty, model: Model) -> CheckedProperty:
    """A counterexample with its cause, as far as that is found in the time that ``trace`` takes for it.

    Raises ``ReplayError`` if a run with the same needed inputs ends otherwise.
    """
    result = compared.result
    if not isinstance(result.verdict, Violated) or not isinstance(result.verdict.because, Trace):
        return compared
    trace = ExplanationOptions(quiet=True)(result.verdict.because, result.property, model.systems)
    return replace(compared, result=replace(result, verdict=replace(result.verdict, because=trace)))


def _why(compared: CheckedProperty, model: Model) -> str:
    """A verdict that is not the expected one: what it rests on, and what to do."""
    found = finding(compared, order_of(model), model.options)
    lines = [found.headline, explained(found)]
    if compared.expected.because:
        lines += ["", f"Expected because: {compared.expected.because}"]
    if compared.expected.because and compared.verdict.word == "proved":
        lines += ["If that is over, delete its entry in the baseline."]
    return "\n".join(lines)


class VerdictMismatch(Exception):
    """The verdict is not the expected one; the message shows why."""


class PropertyItem(pytest.Item):
    """One property of a model."""

    def __init__(self, *, prop: Property, model: Model, decider: Decider, **rest: Any) -> None:
        super().__init__(**rest)
        self.prop, self.model, self.decider = prop, model, decider
        self.add_marker(pytest.mark.rovercheck(id=prop.id, system=prop.on, area=prop.area))
        self.extra_keyword_matches.update((prop.on, prop.area))
        if self.config.pluginmanager.hasplugin("xdist"):
            self.add_marker(pytest.mark.xdist_group(f"{model.name}:{prop.on}"))
        if prop.costly and not self.config.getoption("rovercheck_full"):
            self.add_marker(pytest.mark.skip(reason="it takes long; --rovercheck-full decides it"))

    def runtest(self) -> None:
        """Raises ``VerdictMismatch``, or ``NoVerdict`` if there is no verdict at all."""
        compared = self.decider.compared(self)
        for name, value in _properties(compared):
            self.user_properties.append((name, value))
        if not compared.as_expected:
            raise VerdictMismatch(shown(compared, self.model))
        if compared.verdict.word != "proved":
            self.add_report_section("call", "verdict", on_record(compared))
        if compared.lapsed is not None:
            self.warn(pytest.PytestWarning(f"{self.prop.id} was accepted only {compared.lapsed.term}"))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """What there is to read instead of a traceback of ours."""
        if isinstance(excinfo.value, VerdictMismatch | NoVerdict):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where the property is written, and its name."""
        place = self.prop.place
        where = (Path(place.file), place.line - 1) if place else (self.path, None)
        return *where, f"{self.prop.id} of {self.prop.on}"


def _properties(compared: CheckedProperty) -> list[tuple[str, str]]:
    """What a JUnit file says of the property."""
    prop, verdict = compared.result.property, compared.verdict
    said = {
        "property": prop.id,
        "text": prop.text,
        "system": compared.result.system,
        "requirements": ", ".join(prop.covers),
        "verdict": compared.word,
        "expected": compared.expected.verdict,
        "engine": verdict.engine,
        "evidence": evidence(compared.result),
        "because": compared.expected.because,
    }
    return [(name, value) for name, value in said.items() if value]
