"""The commands of ``rovercheck explore``: what each does, with a sentence of help."""

import shlex
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from textwrap import fill

from rich.console import Console
from rich.table import Table
from rich.text import Text

from checker.commands.exploring_text import changes, show, why
from checker.commands.output import counted, trimmed, write
from checker.commands.select import pick
from checker.commands.variant import Variant
from checker.exploring.session import MOST_TICKS, Ran, Session
from checker.exploring.simulation import Refused, variable
from checker.trace import Trace
from properties.forms import Property
from spec_model.lang.chart import Chart
from spec_model.lang.errors import did_you_mean
from spec_model.lang.expr import Expr

Command = Callable[["Commands", str], None]


class Quit(Exception):
    """The session is over."""


class Commands:
    """A session with what it prints to."""

    def __init__(self, session: Session, variant: Variant, console: Console) -> None:
        self.session = session
        self.variant = variant
        self.console = console

    @property
    def prompt(self) -> str:
        """``tick 12, 240 ms> ``."""
        sim = self.session.simulation
        return f"tick {sim.at}, {sim.at * sim.lowered.tick_ms} ms> "

    def obey(self, line: str) -> None:
        """Do what a line says.  Raises ``Refused`` for what is not possible, and ``Quit``."""
        word, _, rest = line.partition("#")[0].strip().partition(" ")
        if word:
            named(word)(self, rest.strip())

    def say(self, sentence: str, style: str = "") -> None:
        """A sentence in the width of the terminal."""
        self.console.print(fill(sentence, self.console.width), markup=False, style=style)

    def introduce(self) -> None:
        """What is explored, and how to get on."""
        sim = self.session.simulation
        self.say(f"{sim.system.name}: {sim.system.text}".rstrip(": "), "bold")
        for note in sim.system.notes:
            self.say(note, "dim")
        for sentence in self.session.requires():
            self.say(sentence[0].upper() + sentence[1:], "dim")
        frozen = ", ".join(sim.frozen)
        inputs = counted(len(sim.inputs), "input", "inputs")
        first = f" Frozen: {frozen} (see help fixed)." if frozen else ""
        self.say(f"{inputs}, ticks of {sim.lowered.tick_ms} ms.{first} Write help for commands.")

    def moved(self, ran: Ran) -> None:
        """What an advance did."""
        if ran.forgotten:
            ticks = counted(ran.forgotten, "tick", "ticks")
            self.say(f"A new branch: {ticks} after tick {ran.first - 1} forgotten.", "dim")
        changes(self.console, self.session, ran.first)
        if ran.stopped:
            self.say(ran.stopped, "bold")

    def completions(self, begun: str) -> list[str]:
        """What a word that was begun may become."""
        sim = self.session.simulation
        states = [f"{c.name}.{'.'.join(p)}" for c in sim.system.charts for p in c.states if p]
        return [w for w in (*COMMANDS, *sim.variables, *states) if w.startswith(begun)]


def named(word: str) -> Command:
    """The command meant by a name or the beginning of one.  Raises ``Refused``."""
    found = [word] if word in COMMANDS else [name for name in COMMANDS if name.startswith(word)]
    if len(found) == 1:
        return COMMANDS[found[0]][1]
    if found:
        raise Refused(f"{word!r} may be {' or '.join(found)}; write more of it.")
    raise Refused(f"There is no command {word!r}. {did_you_mean(word, COMMANDS)} Write help for all of them.")


def _count(rest: str, default: int) -> int:
    if not rest:
        return default
    if not rest.isdecimal() or int(rest) < 1:
        raise Refused(f"{rest!r} is no number of ticks; write a whole number from 1.")
    return int(rest)


def _split(rest: str) -> list[str]:
    try:
        return shlex.split(rest)
    except ValueError:
        raise Refused(f"A quotation mark is not closed in {rest!r}.") from None


def _pairs(rest: str) -> list[tuple[str, str]]:
    pairs = [word.partition("=") for word in _split(rest)]
    if not pairs:
        raise Refused("Write NAME=VALUE, without blanks around the equals sign.")
    for name, equals, written in pairs:
        if not (name and equals and written):
            raise Refused(
                f"{name + equals + written!r} is no NAME=VALUE; write no blanks around the equals sign."
            )
    return [(name, written) for name, _, written in pairs]


# --- the commands ---


def _step(commands: Commands, rest: str) -> None:
    commands.moved(commands.session.advance(_count(rest, 1)))


def _until(commands: Commands, rest: str) -> None:
    if not rest:
        raise Refused("Write a condition: until Relay.B2_actuating")
    formula = commands.session.condition(rest)
    ran = commands.session.advance(MOST_TICKS, formula)
    commands.moved(ran)
    if not ran.met and not ran.stopped:
        commands.say(
            f"Not true within {MOST_TICKS:,} ticks with these inputs; that it never is, is not shown."
        )


def _break(commands: Commands, rest: str) -> None:
    breaks: list[tuple[str, Expr]] = commands.session.breaks
    if rest:
        breaks.append((rest, commands.session.condition(rest)))
    for number, (text, _) in enumerate(breaks, start=1):
        commands.say(f"break {number}: {text}")
    if not breaks:
        commands.say("There are no breaks.")


def _clear(commands: Commands, rest: str) -> None:
    commands.session.breaks.clear()
    commands.session.watched.clear()


def _back(commands: Commands, rest: str) -> None:
    commands.session.goto(max(0, commands.session.simulation.at - _count(rest, 1)))
    show(commands.console, commands.session)


def _forward(commands: Commands, rest: str) -> None:
    sim = commands.session.simulation
    first, last = sim.at + 1, min(len(sim), sim.at + _count(rest, 1))
    if first > last:
        raise Refused("This is the last tick executed; write step to go on.")
    commands.session.goto(last)
    changes(commands.console, commands.session, first)


def _goto(commands: Commands, rest: str) -> None:
    if not rest.isdecimal():
        raise Refused("Write the number of a tick: goto 7")
    commands.session.goto(int(rest))
    show(commands.console, commands.session)


def _set(commands: Commands, rest: str) -> None:
    commands.session.set(_pairs(rest))


def _free(commands: Commands, rest: str) -> None:
    session = commands.session
    session.let_run(_split(rest))
    commands.say(f"Free: {', '.join(sorted(session.free)) or 'none; write free NAME, or random'}")


def _random(commands: Commands, rest: str) -> None:
    if rest and not rest.isdecimal():
        raise Refused(f"{rest!r} is no seed; write a whole number, or none for 0.")
    session = commands.session
    session.let_run(session.simulation.inputs, int(rest or "0"))
    commands.say(f"All inputs run free, seed {session.seed}; set NAME=VALUE holds one, hold all.")


def _hold(commands: Commands, rest: str) -> None:
    commands.session.hold()


def _fixed(commands: Commands, rest: str) -> None:
    for name, written in _pairs(rest):
        commands.session.fix(name, written)


def _show(commands: Commands, rest: str) -> None:
    if rest not in ("", "all"):
        for name in _split(rest):
            _told(commands, name)
        return
    show(commands.console, commands.session, rest == "all")


def _told(commands: Commands, name: str) -> None:
    sim = commands.session.simulation
    var = variable(name, sim.variables, "variable")
    at = {**commands.session.standing, **sim.state(), **sim.given()}
    doc = f"; {var.doc}" if var.doc else ""
    commands.say(f"{name} = {var.domain.show(at[name])}, {var.domain}{doc}")


def _watch(commands: Commands, rest: str) -> None:
    session = commands.session
    for name in _split(rest):
        variable(name, session.simulation.variables, "variable")
        session.watched += [name] if name not in session.watched else []
    commands.say(f"Watched: {', '.join(session.watched) or 'nothing'}")


def _why(commands: Commands, rest: str) -> None:
    charts = commands.session.names.charts
    why(commands.console, commands.session, [_chart(name, charts) for name in _split(rest)] or list(charts))


def _chart(name: str, charts: Mapping[str, Chart]) -> str:
    if name not in charts:
        raise Refused(f"There is no chart {name!r}. {did_you_mean(name, charts)}")
    return name


def _trace(commands: Commands, rest: str) -> None:
    prop = pick("property", rest, commands.variant.properties())
    systems = commands.variant.systems()
    trace = _decided(prop, commands.variant)
    if trace.system != commands.session.simulation.system.name:
        commands.session = Session(systems[trace.system])
        commands.introduce()
    commands.session.play(trace.before, [tick.inputs for tick in trace.ticks])
    commands.say(f"{prop.id}: {prop.text}", "bold")
    commands.say(f"Its run of {len(trace)} ticks is loaded, and this is its end; goto TICK looks at another.")
    show(commands.console, commands.session)


def _decided(prop: Property, variant: Variant) -> Trace:
    """The run that the verdict on a property rests on.  Raises ``Refused`` if there is none."""
    from checker.commands.check import evidence, results
    from checker.decide import AUTO
    from checker.engine import Limits
    from checker.verdict import Unknown

    [result] = results([prop], variant.systems(), AUTO, Limits())
    if isinstance(result.verdict, Unknown) or not isinstance(result.verdict.because, Trace):
        raise Refused(f"{prop.id} is {result.verdict.word} and has no run to load: {evidence(result)}")
    return result.verdict.because


def _save(commands: Commands, rest: str) -> None:
    words = _split(rest)
    if not 1 <= len(words) <= 2:
        raise Refused("Write save FILE, or save FILE FORMAT: save run.vcd, save run.html play")
    target, session = Path(words[0]), commands.session
    if target.suffix == ".txt" and len(words) == 1:
        write(session.script(), target)
        commands.say(f"{target} holds the commands that make this run again.")
        return
    from checker.commands.exits import exit_written
    from checker.render import renderers

    known = renderers("trace")
    exits = {e.SUFFIX: name for name, e in reversed(known.items())} | {".html": "html", ".svg": "svg"}
    found = [name for suffix, name in exits.items() if target.name.endswith(suffix) and suffix != ".txt"]
    format = words[1] if len(words) == 2 else max(found, key=lambda n: len(known[n].SUFFIX), default="")
    if not format:
        raise Refused(f"No format has files like {target.name}; write one of *{', *'.join(sorted(exits))}.")
    systems = {**commands.variant.systems(), session.simulation.system.name: session.simulation.system}
    trace = session.simulation.trace()
    for path in (target, *exit_written(pick("trace format", format, known), trace, systems, target)):
        commands.say(f"{path} is written ({format}).")


def _help(commands: Commands, rest: str) -> None:
    chosen: Sequence[str] = [rest] if rest in COMMANDS else list(COMMANDS)
    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True)
    table.add_column(ratio=1)
    for name in chosen:
        usage, _, meaning = COMMANDS[name]
        table.add_row(Text(usage, style="bold"), meaning)
    trimmed(commands.console, table)
    if len(chosen) > 1:
        commands.say(
            "The beginning of a command will do. Ctrl-C clears the line or ends a run, Ctrl-D quits."
        )


def _quit(commands: Commands, rest: str) -> None:
    raise Quit


COMMANDS: dict[str, tuple[str, Command, str]] = {
    "step": ("step [N]", _step, "execute a tick, or N, with the inputs as they stand"),
    "run": ("run N", _step, "the same: N ticks, or up to a break"),
    "until": ("until CONDITION", _until, "execute ticks until the condition is true"),
    "break": ("break [CONDITION]", _break, "stop wherever the condition becomes true; list the breaks"),
    "clear": ("clear", _clear, "forget all breaks and what is watched"),
    "set": ("set NAME=VALUE ...", _set, "let inputs stand at these values, from the next tick on"),
    "free": ("free NAME ...", _free, "draw these inputs at random, as the assumptions allow"),
    "random": ("random [SEED]", _random, "draw all inputs at random; the same seed, the same run"),
    "hold": ("hold", _hold, "let all inputs stand as they are"),
    "fixed": ("fixed NAME=VALUE", _fixed, "choose a frozen value, before the first tick"),
    "back": ("back [N]", _back, "look at an earlier tick; step then begins a new branch"),
    "forward": ("forward [N]", _forward, "look at a later tick that was executed"),
    "goto": ("goto TICK", _goto, "look at this tick"),
    "show": ("show [all|NAME ...]", _show, "states, arrows, inputs, values and timers of this tick"),
    "why": ("why [CHART ...]", _why, "which guards were true and which false in this tick"),
    "watch": ("watch NAME ...", _watch, "show these values after every command that moves"),
    "trace": ("trace PROPERTY", _trace, "load the counterexample or witness of a property"),
    "save": ("save FILE [FORMAT]", _save, "the run as .vcd, .json, .csv, .html, .py ...; .txt as a script"),
    "help": ("help [COMMAND]", _help, "this list"),
    "quit": ("quit", _quit, "end the session"),
}
