"""``rovercheck import MACHINE.scxml`` or ``.json``: what stands in it, and whether it can be checked."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from rovercheck.checker.commands.import_.lines import say
from rovercheck.checker.commands.import_.machine_document import LoweredMachineReport, machine_document
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, write
from rovercheck.checker.drawn.lower.domains import domains_path, lines_of, read_domains
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.model.machine import compared, machine_in, machine_model
from rovercheck.checker.scxml.propose import proposed_ranges
from rovercheck.checker.scxml.records import StateMachine
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.lower import lower


def import_machine(path: Path, others: bool, *, as_json: bool) -> Exit:
    """Read a machine, and say what is in it.  Raises ``ModelError`` for one that cannot be read."""
    if others:
        raise UsageError(
            "--beside, --compare, --strict and --write are for models of Simulink. A machine is edited in "
            "its own file: `--model FILE` works with it."
        )
    machine = machine_in(path)
    report = _lowered(path, machine)
    code = Exit.INCONCLUSIVE if report.refused else Exit.AS_EXPECTED
    if as_json:
        print(json_text(machine_document(machine, report, code), ascii=True))
        return code
    for line in (*_head(machine), "", *_told(path, report)):
        say(line)
    return code


def _lowered(path: Path, machine: StateMachine) -> LoweredMachineReport:
    try:
        model = machine_model(path, machine)
        system = lower(model.system)
    except ModelError as error:
        return LoweredMachineReport(str(error))
    difference, _, steps = compared(model.lowered)
    notes = tuple(map(str, model.system.notes))
    inputs, variables = len(system.inputs), len(system.variables)
    return LoweredMachineReport("", inputs, variables, notes, 0 if difference else steps)


def _head(machine: StateMachine) -> Iterator[str]:
    kinds = [one.kind for one in machine.states]
    moves = sum(len(one.transitions) for one in machine.states)
    parts = [
        counted(sum(kind != "history" for kind in kinds), "state", "states"),
        counted(moves, "transition", "transitions"), counted(len(machine.data), "datum", "data"),
    ]  # fmt: skip
    yield f"{machine.name}: {machine.format}, {', '.join(parts)}."
    yield f"Events from outside: {', '.join(machine.offered) or 'none'}."
    if machine.carried:
        yield f"They carry: {', '.join(machine.carried)}."
    if machine.internal:
        yield f"Events of its own: {', '.join(machine.internal)}."
    if machine.guards:
        yield f"Guards without a binding, which are inputs: {', '.join(machine.guards)}."
    if machine.actions:
        yield f"Actions without a binding, which are seen when they run: {', '.join(machine.actions)}."


def _told(path: Path, report: LoweredMachineReport) -> Iterator[str]:
    if report.refused:
        yield f"✗ It cannot be checked: {report.refused}"
        return
    size = (
        f"{counted(report.inputs, 'input', 'inputs')}, {counted(report.variables, 'variable', 'variables')}"
    )
    yield f"✓ It can be checked, as a system with {size}: rovercheck check --model {path}"
    for note in report.notes:
        yield f"  • {note}"
    if report.steps:
        yield f"  in {report.steps:,} steps of random runs its algorithm gives the same"


def propose_ranges(path: Path, force: bool) -> Exit:
    """Write a domain for each datum that is computed.  Raises ``ModelError`` for a machine with a fault."""
    machine, target = machine_in(path), domains_path(path)
    said = read_domains(target)
    ranges = {name: ends for name, ends in proposed_ranges(machine).items() if name not in said.domains}
    if not ranges:
        out.print(f"{path.name} needs no domains: no datum without one is computed.", markup=False)
        return Exit.AS_EXPECTED
    found = list(lines_of({name: integer(low, high) for name, (low, high) in ranges.items()}))
    if target.exists() and not force:
        lines = "\n".join(found)
        raise UsageError(f"{target} is there; add to it, or write --force:\n{lines}")
    write("\n".join(_file(path, [*lines_of(said.domains), *found])) + "\n", target)
    out.print(f"wrote {target}: {counted(len(found), 'domain', 'domains')} to check.", markup=False)
    return Exit.AS_EXPECTED


def _file(path: Path, lines: Sequence[str]) -> Iterator[str]:
    yield f"# Values of the data of {path.name} that are computed: from what they are compared with and"
    yield "# assigned, and one beyond.  A run that leaves them is told in place of a verdict."
    yield ""
    yield "[domains]"
    yield from lines


__all__ = ["import_machine", "propose_ranges"]
