"""Writing a trace in a format: what the format asks for beside the trace, and files that go together."""

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rovercheck.checker.commands.shared.output import table_width, write
from rovercheck.checker.render import Renderer, named, renderers
from rovercheck.checker.results.format import Need, Option
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

if TYPE_CHECKING:
    from rovercheck.spec_model.abstraction import Board


def exit_written(
    renderer: Renderer,
    trace: Trace,
    systems: Mapping[str, System],
    output: Path | None,
    everything: bool = False,
    boards: "Callable[[], Mapping[str, Board]] | None" = None,
) -> list[Path]:
    """Write the trace to a file or to standard output; the further files that this made, if any.

    ``boards`` are those of the charts of the run, where these are changed.  ``everything``: also what the
    property does not depend on, where the format would leave it out.  A format that needs it is given the
    run as the boards see it; one with another ``beside`` it writes a file of that under the same name.
    Raises ``ModelError`` for a run that the format cannot show.
    """
    if Need.BOARD_STEPS in renderer.FORMAT.needs:
        from rovercheck.checker.commands.trace.board_steps import concrete

        trace = concrete(trace, systems[trace.system.name], None if boards is None else boards())
    render = fitted(renderer, output)
    if Option.EVERYTHING in renderer.FORMAT.takes:
        render = partial(render, everything=everything)
    beside = renderer.FORMAT.beside
    other = named("trace", beside) if beside else None
    if other is None or output is None:
        write(render(trace), output)
        return []
    there = output.with_suffix(other.FORMAT.suffix)
    if there == output:
        there = output.with_name(output.name + other.FORMAT.suffix)
    contents = other.render(trace), render(trace, dump=there.name)
    for place, content in zip((there, output), contents, strict=True):
        write(content, place)
    return [there]


FIRST = {".html": "html", ".svg": "svg", ".txt": "table"}
"""Of several formats with one suffix the one that is meant by it."""


def format_of(file: str) -> str:
    """The format that the name of a file says: of suffixes that fit, the longest.

    Raises ``ModelError`` for a name that no format has.
    """
    suffixes = {one.FORMAT.suffix: name for name, one in reversed(renderers("trace").items())} | FIRST
    found = [suffix for suffix in suffixes if file.endswith(suffix)]
    if not found:
        known = ", *".join(sorted(suffixes))
        raise ModelError(f"No format has files like {file}; write one of *{known}.")
    return suffixes[max(found, key=len)]


def fitted(renderer: Renderer, output: Path | None) -> Any:
    """What renders; a text that is laid out in columns and goes to a terminal is as wide as that."""
    render: Any = renderer.render
    if output is None and Option.WIDTH in renderer.FORMAT.takes:
        render = partial(render, width=table_width())
    return render
