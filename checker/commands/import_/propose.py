"""``rovercheck import --propose-domains``: a file of domains beside a model, for a person to correct."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, out, write
from rovercheck.checker.drawn.lower.domains import DomainsFile, domains_path, lines_of, read_domains
from rovercheck.checker.drawn.lower.propose import ProposedDomain, proposed_domains, proposed_lines
from rovercheck.checker.drawn.lower.symbols import NotLowered
from rovercheck.checker.model.drawn import free_in
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.errors import ModelError


def propose_domains(path: Path, beside: Sequence[Path], force: bool) -> Exit:
    """Write a domain for all that needs one.  Raises ``ModelError`` for a model that has another fault."""
    target = domains_path(path)
    said = read_domains(target) if target.exists() else DomainsFile(target)
    model = free_in(read_model(path, [*said.beside, *beside]), said)
    try:
        found = proposed_domains(model, path.name, said.domains, said.step)
    except NotLowered as error:
        raise ModelError(f"{path.name}: {error}.") from error
    if not found:
        out.print(f"{path.name} needs no domains: all values follow from its types.", markup=False)
        return Exit.AS_EXPECTED
    if target.exists() and not force:
        lines = "\n".join(proposed_lines(found))
        raise UsageError(f"{target} is there; add to it, or write --force:\n{lines}")
    write("\n".join(_file(path, said, beside, found)) + "\n", target)
    unsure = sum(not one.sure for one in found)
    told = f"{counted(unsure, 'line', 'lines')} to check" if unsure else "none of them loses anything"
    out.print(f"wrote {target}: {counted(len(found), 'domain', 'domains')}, {told}.", markup=False)
    return Exit.AS_EXPECTED


def _file(
    path: Path, said: DomainsFile, beside: Sequence[Path], found: list[ProposedDomain]
) -> Iterator[str]:
    yield f"# Values of inputs and data of {path.name} that do not follow from the file."
    yield "# low and high are the ends, in steps of resolution (1 if it is left out); or values = [...]."
    if beside:
        yield f"beside = [{', '.join(repr(str(one)).replace(chr(39), chr(34)) for one in beside)}]"
    if said.free:
        yield f"free = {json.dumps(said.free, ensure_ascii=False)}"
    if said.step:
        yield f"step = {json.dumps(said.step)}"
    yield ""
    yield "[domains]"
    yield from lines_of(said.domains)
    yield from proposed_lines(found)


__all__ = ["propose_domains"]
