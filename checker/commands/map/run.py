"""``rovercheck map init``: a proposed mapping file, tried with the compiler."""

import tempfile
from pathlib import Path
from shlex import quote

from rovercheck.checker.adapters.c_build import built, compiler
from rovercheck.checker.adapters.c_map import read
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import counted, err, possible, write, wrote
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.commands.shared.variant import pick_variant
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.extras import FIRMWARE
from rovercheck.checker.mapping.declarations import CDeclarations
from rovercheck.checker.mapping.entry_points import entry_points
from rovercheck.checker.mapping.map_text import MapProposal
from rovercheck.checker.mapping.match import matched
from rovercheck.checker.mapping.places import CLeaves
from rovercheck.spec_model.abstraction import Board, boards
from rovercheck.spec_model.lang.errors import did_you_mean


def map_init(folder: Path, system: str | None, output: Path | None, force: bool, model: Path | None) -> Exit:
    """Write a proposed mapping file.

    Raises ``UsageError`` for a folder without C, a board that does not exist, and a file that is there.
    """
    if not FIRMWARE.installed:
        raise UsageError(f"{FIRMWARE.needed('map init')}.")
    target = output or folder / "map.toml"
    if not folder.is_dir():
        raise UsageError(f"{whole(folder)} is no folder; name the one with the C sources.")
    if target.exists() and not force:
        raise UsageError(f"{whole(target)} is there already; write --force, or another file with --output.")
    possible(target)
    candidates = _boards(system, model)
    found = _declared(folder)
    proposals = [_proposal(board, found) for board in candidates]
    best = max(proposals, key=_weight)
    if len(proposals) > 1:
        others = ", ".join(f"{p.board} {_counts(p)}" for p in proposals if p is not best)
        err.print(f"The names fit {best.board} best ({_counts(best)}; {others}).", markup=False)
    command = f"rovercheck map init {quote(str(folder))}" + (
        f" --model {quote(str(model))}" if model else f" --system {best.board}"
    )
    write(best.text(command), target)
    board = next(board for board in candidates if board.name == best.board)
    for remark in best.remarks():
        err.print(f"  {remark}", markup=False)
    err.print(_summary(best), markup=False)
    _tried(target, folder, board)
    wrote(target)
    return Exit.AS_EXPECTED


def _boards(system: str | None, model: Path | None) -> list[Board]:
    if model is not None:
        own = pick_variant((), None, (), model).own
        assert own is not None
        return [of_model(own, system)]
    known = boards()
    if system is None:
        return list(known.values())
    if system not in known:
        raise UsageError(f"No board {system!r}. {did_you_mean(system, known)}")
    return [known[system]]


def _declared(folder: Path) -> CDeclarations:
    from rovercheck.checker.mapping.source import declarations

    try:
        found = declarations(folder)
    except OSError as error:
        raise UsageError(f"{whole(str(error.filename))} cannot be read: {error.strerror}.") from None
    if not found.sources:
        raise UsageError(f"{whole(folder)} has no C file (*.c); name the folder with the sources.")
    return found


def _proposal(board: Board, found: CDeclarations) -> MapProposal:
    entry = entry_points(found)
    inputs, outputs = matched(board, CLeaves(found, tuple(entry.own)))
    return MapProposal(board.name, found, entry, inputs, outputs)


def _weight(proposal: MapProposal) -> float:
    """The part of the signals that have a place, what is sure counting twice."""
    return sum((one.leaf is not None) + one.sure for one in proposal.signals) / len(proposal.signals)


def _counts(proposal: MapProposal) -> str:
    placed = sum(one.leaf is not None for one in proposal.signals)
    return f"{placed} of {len(proposal.signals)} signals"


def _summary(proposal: MapProposal) -> str:
    every = proposal.signals
    guessed = sum(one.leaf is not None and not one.sure for one in every)
    missing = sum(one.leaf is None for one in every)
    placed = counted(len(every) - missing, "signal has a place", "signals have places")
    return f"{proposal.board}: {placed}, {guessed} of them to check; {missing} without one."


def _tried(target: Path, folder: Path, board: Board) -> None:
    """Say whether the compiler takes the proposal as it is."""
    if compiler() is None:
        err.print("There is no C compiler here to try it with.", markup=False)
        return
    try:
        with tempfile.TemporaryDirectory(prefix="rovercheck-") as place:
            built(folder, read(target, board), Path(place))
    except ImplementationError as error:
        err.print(f"Not yet complete: {error}", markup=False)
        return
    err.print(f"{Path(compiler() or '').name} takes it as it is.", markup=False)
