"""The command line: every verb, and the one place where errors become exit codes."""

import sys
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import click
import typer

from checker.commands.codes import Exit, UsageError
from checker.commands.output import err
from checker.decide import AUTO, Disagreement
from checker.engine import Limits
from checker.replay import ReplayError
from spec_model.lang.errors import ModelError

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    help="Check the rover's supervisors: charts, properties, verdicts with evidence.",
    epilog=(
        "Exit codes: 0 all as expected; 1 a violation, or an expected violation that is gone; "
        "2 inconclusive; 3 internal error or engines disagree; 4 usage or model error; "
        "5 nothing to check; 130 interrupted."
    ),
)


class Lists(StrEnum):
    """What ``list`` can show."""

    properties = "properties"
    systems = "systems"
    charts = "charts"
    requirements = "requirements"
    engines = "engines"


Engine = Annotated[str, typer.Option(help="explicit, bmc, auto or all.")]
Depth = Annotated[int | None, typer.Option(min=1, help="Ticks to look ahead at most.")]
Timeout = Annotated[float | None, typer.Option(min=0.001, help="Seconds per search.")]
Output = Annotated[Path | None, typer.Option("--output", "-o", help="File to write.")]


def limits(depth: int | None, timeout: float | None) -> Limits:
    """What the options allow each search."""
    return Limits(depth=depth, seconds=timeout)


@app.command()
def check(
    ids: Annotated[list[str] | None, typer.Argument(help="Property ids; all by default.")] = None,
    system: Annotated[str | None, typer.Option(help="Only properties about this system.")] = None,
    engine: Engine = AUTO,
    depth: Depth = None,
    timeout: Timeout = None,
    json: Annotated[bool, typer.Option("--json", help="Verdicts as JSON.")] = False,
) -> Exit:
    """Check properties and compare the verdicts with the baseline."""
    from checker.commands.check import check as run
    from checker.commands.select import pick_engine, pick_properties
    from spec_model.rover import systems

    chosen = pick_properties(ids or [], system)
    return run(chosen, systems(), pick_engine(engine), limits(depth, timeout), json)


@app.command("list")
def list_(what: Lists) -> Exit:
    """List properties, systems, charts, requirements or engines."""
    from checker.commands.listing import listing

    return listing(what.value)


@app.command()
def trace(
    id: Annotated[str, typer.Argument(help="A property id.")],
    format: Annotated[str, typer.Option(help="table, markdown, json or vcd.")] = "table",
    everything: Annotated[bool, typer.Option("--all", help="Also what the property ignores.")] = False,
    engine: Engine = AUTO,
    depth: Depth = None,
    timeout: Timeout = None,
    output: Output = None,
) -> Exit:
    """Show the counterexample of a violated property, or the witness of a reachable one."""
    from checker.commands.select import pick, pick_engine
    from checker.commands.tracing import trace as run
    from properties.catalogue import catalogue

    prop = pick("property", id, catalogue())
    return run(prop, pick_engine(engine), limits(depth, timeout), format, everything, output)


@app.command()
def graph(
    name: Annotated[str, typer.Argument(help="A chart, or a system with --project.")],
    project: Annotated[str | None, typer.Option(help="Variables of the state graph, VAR,VAR.")] = None,
    format: Annotated[str, typer.Option(help="svg, dot, mermaid, graphml or json.")] = "svg",
    output: Output = None,
) -> Exit:
    """Draw a chart, or the reachable graph of a system projected on some variables."""
    from checker.commands.graphing import graph as run

    return run(name, project, format, output)


@app.command()
def reports(
    output: Output = None,
    stale: Annotated[bool, typer.Option("--stale", help="Only say what is out of date.")] = False,
) -> Exit:
    """Write the evidence: verdict table, diagrams, a page per counterexample."""
    from checker.commands.reporting import reports as run

    return run(output or Path("reports"), stale)


def main() -> None:
    """Run the command line; every error becomes one message and a documented exit code."""
    sys.exit(int(run(sys.argv[1:])))


def run(arguments: list[str]) -> Exit:
    """The exit code of a command line; messages go to standard error."""
    try:
        code: object = app(arguments, standalone_mode=False, prog_name="rovercheck")
        return code if isinstance(code, Exit) else Exit.AS_EXPECTED
    except click.exceptions.NoArgsIsHelpError as error:
        err.print(error.format_message(), markup=False)
        return Exit.USAGE
    except click.ClickException as error:
        return _say(error.format_message(), Exit.USAGE)
    except (UsageError, ModelError) as error:
        return _say(str(error), Exit.USAGE)
    except (Disagreement, ReplayError) as error:
        return _say(f"INTERNAL: {error}", Exit.INTERNAL)
    except (KeyboardInterrupt, click.Abort):
        return _say("Interrupted; nothing was written.", Exit.INTERRUPTED)
    except BrokenPipeError:
        return Exit.AS_EXPECTED
    except MemoryError:
        return _say("Out of memory. Check fewer properties at once, or one --system.", Exit.INCONCLUSIVE)


def _say(message: str, code: Exit) -> Exit:
    err.print(message, markup=False)
    return code
