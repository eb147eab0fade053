"""``rovercheck import MACHINE.scxml``: what stands in it, and whether it can be checked."""

from pathlib import Path

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, text_width
from rovercheck.checker.commands.shared.text_wrap import filled
from rovercheck.checker.model.machine import compared, lowered_scxml
from rovercheck.checker.scxml.reader import read_scxml
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower


def import_machine(path: Path, others: bool) -> Exit:
    """Read a machine, and say what is in it.  Raises ``ModelError`` for one that cannot be read."""
    if others:
        raise UsageError(
            "--beside, --compare, --propose-domains, --strict, --write and --json are for Simulink. "
            "A machine is edited in its own file: `--model MACHINE.scxml` works with it."
        )
    machine = read_scxml(path)
    kinds = [one.kind for one in machine.states]
    moves = sum(len(one.transitions) for one in machine.states)
    parts = [
        counted(sum(kind != "history" for kind in kinds), "state", "states"),
        counted(moves, "transition", "transitions"), counted(len(machine.data), "datum", "data"),
    ]  # fmt: skip
    _say(f"{machine.name}: SCXML, {', '.join(parts)}.")
    _say(f"Events from outside: {', '.join(machine.offered) or 'none'}.")
    if machine.internal:
        _say(f"Events of its own: {', '.join(machine.internal)}.")
    out.print()
    try:
        model = lowered_scxml(path, machine)
        system = lower(model.system)
    except ModelError as error:
        _say(f"✗ It cannot be checked: {error}")
        return Exit.INCONCLUSIVE
    inputs = counted(len(system.inputs), "input", "inputs")
    size = f"{inputs}, {counted(len(system.variables), 'variable', 'variables')}"
    _say(f"✓ It can be checked, as a system with {size}: rovercheck check --model {path}")
    for note in model.system.notes:
        _say(f"  • {note}")
    difference, _, steps = compared(model.lowered)
    if not difference:
        _say(f"  in {steps:,} steps of random runs the algorithm of the standard gives the same")
    return Exit.AS_EXPECTED


def _say(text: str) -> None:
    indent = " " * (len(text) - len(text.lstrip()))
    out.print(filled(" ".join(text.split()), text_width(), indent, f"{indent}  "), markup=False)


__all__ = ["import_machine"]
