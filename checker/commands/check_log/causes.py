"""Causes of the deviations of a campaign: its logs are read again, those alone that deviate."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.shared.cause_text import cut_short
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.conformance.deviations import Deviation
from rovercheck.checker.conformance.recording import Recording
from rovercheck.checker.diagnosis.causes import CauseGroups, by_itself, cause_groups, followed, split
from rovercheck.checker.diagnosis.logs import logged_run
from rovercheck.checker.logs import ColumnMap, LogError
from rovercheck.spec_model.abstraction import Board


def causes_in(
    campaign: LogCampaign,
    folder: Path,
    how: ColumnMap,
    boards: Mapping[str, Board],
    seconds: float,
    progress: Callable[[str], None],
) -> dict[str, CauseGroups]:
    """The deviations of each board by cause; known ones are told apart from the others of their cause.

    A log that cannot be read again is left out, and counted.
    """
    found: dict[str, CauseGroups] = {}
    for name, deviations in campaign.deviations.items():
        if not deviations:
            continue
        runs, left_out = list[Recording](), 0
        for log in campaign.logs:
            if log.layout.board == name and log.behaviour.deviations:
                try:
                    runs.append(logged_run(folder / log.name, how, name, boards).run)
                except (LogError, OSError):
                    left_out += 1
        try:
            evidence = followed(boards[name], runs, lambda said: progress(f"{said}, logs"))
        except (LogError, OSError):  # one has changed meanwhile
            found[name] = replace(by_itself(deviations), left_out=left_out + len(runs))
            continue
        parts = {one.scope.part for one in deviations if one.scope.part}
        groups = cause_groups(evidence, deviations, parts, seconds, progress)

        def known(one: Deviation, board: str = name) -> object:
            return campaign.judgements[board].of(one).word

        found[name] = replace(groups, causes=split(groups.causes, known), left_out=left_out)
    return found


LOGS = "log", "logs"


def not_searched(groups: CauseGroups) -> Iterator[str]:
    """Where causes were not looked for to the end, and in which logs not at all."""
    yield from cut_short(groups)
    if groups.left_out:
        logs = counted(groups.left_out, *LOGS)
        yield f"Causes were looked for without {logs}, as not all that deviate could be read again."
