"""``rovercheck trace ID``: the counterexample (or witness) of one property, in one of several forms."""

from collections.abc import Mapping
from pathlib import Path

from checker.commands.check import evidence, results
from checker.commands.codes import Exit
from checker.commands.output import err, out, write
from checker.commands.select import pick
from checker.engine import Limits
from checker.render import renderers
from checker.trace import Trace
from checker.verdict import Unknown
from properties.catalogue import expected
from properties.forms import Property
from spec_model.lang.system import System

FOR_READERS = ("table", "markdown")


def trace(
    prop: Property,
    systems: Mapping[str, System],
    engine: str,
    limits: Limits,
    format: str,
    everything: bool,
    output: Path | None,
) -> Exit:
    """Decide the property and show its trace; say so when its verdict rests on none.

    What people read shows only what the property depends on, unless ``everything`` is wanted.
    """
    renderer = pick("trace format", format, renderers("trace"))
    [result] = results([prop], systems, engine, limits)
    verdict = result.verdict
    if isinstance(verdict, Unknown):
        err.print(f"{prop.id} is unknown: {evidence(result)}", markup=False)
        return Exit.INCONCLUSIVE
    if not isinstance(verdict.because, Trace):
        err.print(f"{prop.id} is {verdict.word} and has no trace: {evidence(result)}", markup=False)
        return Exit.AS_EXPECTED
    if output is None and format == "table":
        on_record = expected(prop.id)
        reason = on_record.because if on_record.verdict == verdict.word else ""
        out.print(f"{prop.id} is {verdict.word}: {prop.text}", markup=False, soft_wrap=False)
        if reason:
            out.print(f"Why: {reason}", markup=False, soft_wrap=False)
    shown = verdict.because if everything or format not in FOR_READERS else verdict.because.focused()
    write(renderer.render(shown), output)
    return Exit.AS_EXPECTED
