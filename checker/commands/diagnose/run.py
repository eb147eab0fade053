"""``rovercheck diagnose``: the changes of the charts that explain how logs deviate."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rovercheck.checker.commands.diagnose import DiagnoseOptions
from rovercheck.checker.commands.diagnose.text import page
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.logs import column_map, logs_in, no_logs
from rovercheck.checker.commands.shared.output import counted, err, out
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.commands.shared.variant_file import FoundVariant, write_variant
from rovercheck.checker.diagnosis.logs import LoggedRun, logged_run
from rovercheck.checker.diagnosis.result import BoardDiagnosis, diagnose_board
from rovercheck.checker.diagnosis.variant import VariantError, applied, read_variant
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.logs import ColumnMap, LogError
from rovercheck.spec_model.abstraction import Board, boards


@dataclass
class FoundCauses:
    """What was found of each board, and the logs that could not be read, each with the reason.

    Those that are ``ended`` could not be read any further, and count as far as they were.
    """

    boards: list[BoardDiagnosis] = field(default_factory=list)
    unread: dict[str, str] = field(default_factory=dict)
    ended: dict[str, str] = field(default_factory=dict)

    @property
    def code(self) -> Exit:
        """1 if anything deviates, 4 if a log was not read, 2 if not all could be decided."""
        if any(b.parts for b in self.boards):
            return Exit.FAILED
        if self.unread:
            return Exit.USAGE
        open_ = self.ended or any(b.undecided for b in self.boards)
        return Exit.INCONCLUSIVE if open_ else Exit.AS_EXPECTED


def diagnose(place: Path, options: DiagnoseOptions) -> Exit:
    """Diagnose one log or all logs of a folder.

    Raises ``UsageError`` for a map or a variant without meaning, and for a single log that cannot be read.
    """
    how, charts = column_map(options.map_file), _boards(options.variant)
    logs = logs_in(place) if place.is_dir() else [place]
    if not logs:
        err.print(no_logs(place), markup=False)
        return Exit.NOTHING
    found = FoundCauses()
    with ProgressLine() as line:
        runs = _read(logs, how, options.system or "", found)
        for name, of_board in runs.items():
            recordings = [one.run for one in of_board]
            found.boards.append(diagnose_board(charts[name], recordings, options.seconds, line.show))
            found.ended |= {one.run.name: one.ended[0] for one in of_board if one.ended}
    if not place.is_dir() and found.unread:
        raise UsageError(f"{place}: {found.unread[place.name]}")
    said = "" if options.write is None else write_variant(options.write, [*map(_variant, found.boards)])
    if options.as_json:
        from rovercheck.checker.commands.diagnose.document import diagnose_document

        print(json_text(diagnose_document(found.boards, found.unread, found.ended, found.code)))
    else:
        out.print(page(found.boards, found.unread, found.ended), markup=False)
        if said:
            out.print(f"\n{said}", markup=False)
    return found.code


def _boards(file: Path | None) -> Mapping[str, Board]:
    """The boards, one of them with the changes of a variant."""
    found = boards()
    if file is None:
        return found
    try:
        variant = read_variant(file)
        if variant.board not in found:
            raise VariantError(f"{file}: there is no board {variant.board!r}; write {' or '.join(found)}.")
        return {**found, variant.board: applied(found[variant.board], variant, str(file))}
    except VariantError as error:
        raise UsageError(str(error)) from error


def _read(
    logs: Sequence[Path], how: ColumnMap, system: str, found: FoundCauses
) -> Mapping[str, list[LoggedRun]]:
    """The logs of each board that can be read."""
    runs: dict[str, list[LoggedRun]] = {}
    for log in logs:
        try:
            one = logged_run(log, how, system)
        except LogError as error:
            found.unread[log.name] = str(error)
        except MemoryError:
            found.unread[log.name] = "takes more memory than there is; cut it into several logs."
        else:
            runs.setdefault(one.board, []).append(one)
    return runs


def _variant(found: BoardDiagnosis) -> FoundVariant:
    """The causes that were found on a board, with how much they explain."""
    changes = [change for cause in found.causes for change in cause.changes]
    cases = sum(part.cases for part in found.parts)
    explained = sum(part.told.trial.explained for part in found.parts if part.told is not None)
    runs = counted(len(found.runs), "recording", "recordings")
    evidence = f"diagnose, {runs}: the changes explain {explained} of {counted(cases, 'case', 'cases')}."
    return FoundVariant(found.board.name, changes, evidence)
