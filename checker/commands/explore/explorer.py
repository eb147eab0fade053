"""Who steps through a system in ``rovercheck explore``, and what is said to them whatever they do."""

from collections.abc import Callable

from rich.console import Console

from rovercheck.checker.commands.explore.text import changes
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.explore.by_hand.session import ExecutedTicks, Session
from rovercheck.checker.model.variant import Variant


class Explorer:
    """Somebody who steps through a system: a session, and the terminal that it is shown on."""

    def __init__(self, session: Session, variant: Variant, console: Console) -> None:
        self.session = session
        self.variant = variant
        self.console = console

    @property
    def prompt(self) -> str:
        """``tick 12, 240 ms> ``."""
        sim = self.session.simulation
        return f"tick {sim.at}, {sim.ms} ms> "

    def say(self, sentence: str, style: str = "") -> None:
        """A sentence in the width of the terminal."""
        self.console.print(filled(sentence, self.console.width), markup=False, style=style)

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

    def moved(self, ran: ExecutedTicks) -> None:
        """What an advance did."""
        if ran.forgotten:
            ticks = counted(ran.forgotten, "tick", "ticks")
            self.say(f"A new branch: {ticks} after tick {ran.first - 1} forgotten.", "dim")
        changes(self.console, self.session, ran.first)
        if ran.stopped:
            self.say(ran.stopped, "bold")


Command = Callable[[Explorer, str], None]
"""What a command does with the words behind it.  Raises ``Refused`` for what is not possible."""
Commands = dict[str, tuple[str, Command, str]]
"""By name: how a command is written, what does it, and what that is."""
