"""What the report of a property says: the verdict, the one on record, and the run that shows it."""

from dataclasses import replace

from checker.commands.check.ci import finding
from checker.commands.check.run import Compared, recorded
from checker.commands.shared.failure import told
from checker.commands.trace.explain import Explaining
from checker.model import Model
from checker.render.ci import explained
from checker.results.trace import Trace
from checker.results.verdict import Violated


def on_record(compared: Compared) -> str:
    """One line on a verdict that is no proof and was expected."""
    prop, because = compared.result.property, compared.expected.because
    return f"{prop.id} is {compared.verdict.word}, as on record: {because}"


def shown(compared: Compared, model: Model) -> str:
    """A verdict that is not the one on record, with what forces it as far as that is found."""
    try:
        return _why(_with_reasons(compared, model), model)
    except Exception as error:  # the verdict stands
        id, expected = compared.result.property.id, recorded(compared.expected)
        return f"{id} is {compared.word}, on record is {expected}\n{told(error)}"


def _with_reasons(compared: Compared, model: Model) -> Compared:
    """A counterexample with what forces it, as far as that is found in the time that ``trace`` takes for it.

    Raises ``ReplayError`` if a run with the same needed inputs ends otherwise.
    """
    result = compared.result
    if not isinstance(result.verdict, Violated) or not isinstance(result.verdict.because, Trace):
        return compared
    trace = Explaining(quiet=True)(result.verdict.because, result.property, model.systems)
    return replace(compared, result=replace(result, verdict=replace(result.verdict, because=trace)))


def _why(compared: Compared, model: Model) -> str:
    """A verdict that is not the one on record: what it rests on, and what to do."""
    found = finding(compared, model.systems, model.options)
    lines = [found.headline, explained(found)]
    if compared.expected.because:
        lines += ["", f"On record because: {compared.expected.because}"]
    if compared.expected.because and compared.verdict.word == "proved":
        lines += ["If that is over, delete its entry in the baseline."]
    return "\n".join(lines)
