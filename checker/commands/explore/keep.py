"""The commands of ``rovercheck explore`` that load the run of a property, and write the run at hand."""

from pathlib import Path

from rovercheck.checker.commands.explore.explorer import Commands, Explorer
from rovercheck.checker.commands.explore.text import show
from rovercheck.checker.commands.explore.words import split
from rovercheck.checker.commands.shared.output import write
from rovercheck.checker.commands.shared.select import pick
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.explore.by_hand.session import Session
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.results.trace import Trace
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.errors import ModelError


def _trace(explorer: Explorer, rest: str) -> None:
    known = explorer.variant.properties()
    if not known:
        raise RefusedInput("The model states no properties, so there is no run to load.")
    if not rest:
        raise RefusedInput(f"Write the ID of a property: trace {next(iter(known))}")
    prop = explorer.variant.asked(pick("property", rest, known))
    systems = explorer.variant.systems()
    trace = _decided(prop, explorer.variant)
    if trace.system.name != explorer.session.simulation.system.name:
        explorer.session = Session(systems[trace.system.name])
        explorer.introduce()
    explorer.session.play(trace.before, [tick.inputs for tick in trace.ticks])
    explorer.say(f"{prop.id}: {prop.text}", "bold")
    explorer.say(f"Its run of {len(trace)} ticks is loaded, and this is its end; goto TICK looks at another.")
    show(explorer.console, explorer.session)


def _decided(prop: Property, variant: Variant) -> Trace:
    """The run that the verdict on a property rests on.  Raises ``RefusedInput`` if there is none."""
    from rovercheck.checker.commands.shared.verdicts import results
    from rovercheck.checker.render.verdict_text import evidence
    from rovercheck.checker.results.verdict import Unknown

    [result] = results([prop], variant.systems())
    if isinstance(result.verdict, Unknown) or not isinstance(result.verdict.because, Trace):
        raise RefusedInput(f"{prop.id} is {result.verdict.word} and has no run to load: {evidence(result)}")
    return result.verdict.because


def _save(explorer: Explorer, rest: str) -> None:
    words = split(rest)
    if not 1 <= len(words) <= 2:
        raise RefusedInput("Write save FILE, or save FILE FORMAT: save run.vcd, save run.html play")
    target, session = Path(words[0]), explorer.session
    if not session.simulation.at:
        raise RefusedInput("There is no run before the first tick; write step first.")
    if target.suffix == ".txt" and len(words) == 1:
        write(session.script(), target)
        explorer.say(f"{whole(target)} holds the commands that make this run again.")
        return
    from rovercheck.checker.commands.trace.formats import exit_written, format_of
    from rovercheck.checker.render import renderers

    known = renderers("trace")
    try:
        format = words[1] if len(words) == 2 else format_of(words[0])
    except ModelError as error:
        raise RefusedInput(str(error)) from error
    systems = {**explorer.variant.systems(), session.simulation.system.name: session.simulation.system}
    trace = session.simulation.trace()
    for path in (target, *exit_written(pick("trace format", format, known), trace, systems, target)):
        explorer.say(f"{whole(path)} is written ({format}).")


COMMANDS: Commands = {
    "trace": ("trace PROPERTY", _trace, "load the counterexample or witness of a property"),
    "save": ("save FILE [FORMAT]", _save, "the run as .vcd, .json, .csv, .html, .py ...; .txt as a script"),
}
