"""A property as a test: it passes if its verdict is the one on record, else it shows why not."""

from pathlib import Path
from typing import Any

import pytest

from checker.commands.check.run import Compared, evidence
from checker.model import Model
from checker.pytest_plugin.deciding import Decider, NoVerdict
from checker.pytest_plugin.telling import on_record, shown
from properties.forms import Property
from rovercheck import own


class Different(Exception):
    """The verdict is not the one on record; the message shows why."""


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

    @own()
    def runtest(self) -> None:
        """Raises ``Different``, or ``NoVerdict`` if there is no verdict at all."""
        compared = self.decider.compared(self)
        for name, value in _properties(compared):
            self.user_properties.append((name, value))
        if not compared.as_expected:
            raise Different(shown(compared, self.model))
        if compared.verdict.word != "proved":
            self.add_report_section("call", "verdict", on_record(compared))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """What there is to read instead of a traceback of ours."""
        if isinstance(excinfo.value, Different | NoVerdict):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where the property is written, and its name."""
        place = self.prop.place
        where = (Path(place.file), place.line - 1) if place else (self.path, None)
        return *where, f"{self.prop.id} of {self.prop.on}"


def _properties(compared: Compared) -> list[tuple[str, str]]:
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
