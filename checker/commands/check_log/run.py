"""``rovercheck check-log``: logs checked against the properties and the charts."""

from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from rovercheck.checker.commands.check_log import LogOptions
from rovercheck.checker.commands.check_log.at_once import at_once, worth_it
from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.check_log.request import LogRequest, request_of
from rovercheck.checker.commands.check_log.text import LogFault, Outcome, page, summary
from rovercheck.checker.commands.shared.campaign_files import NO_FILES, CampaignFiles
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.known import KnownBook, known_book
from rovercheck.checker.commands.shared.logs import logs_in, no_logs
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.commands.shared.output import counted, err, out
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.compare.variants import boards_of
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.logs import LogError, LogResult
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.process.pool import cores
from rovercheck.checker.results.campaign import CampaignRecord
from rovercheck.spec_model.abstraction import boards

GRAVEST = (Exit.INTERNAL, Exit.FAILED, Exit.USAGE, Exit.INCONCLUSIVE)
"""Of a folder the first of these that applies to some log."""


def check_log(
    place: Path,
    options: LogOptions,
    variant: Variant,
    files: CampaignFiles = NO_FILES,
    charts: VariantOptions | None = None,
) -> Exit:
    """Check one log or all logs of a folder against the charts, changed or not.

    ``charts`` are the options that mean the variant: with them several processes share a large folder.
    Raises ``UsageError`` for a map without meaning, and for a single log that cannot be read.
    """
    files.possible()
    if options.scheduler is not None and not place.is_dir():
        raise UsageError("--scheduler has the logs of a folder examined elsewhere; leave it out for one log.")
    asked = request_of(variant, options)
    book = KnownBook({}, "")
    if options.known is not None or options.write_known is not None:
        every = asked.against.boards if asked.against else boards_of(variant)
        book = known_book(options.known, options.write_known, every, variant.board_name)
    asked = replace(asked, book=book, used=book.used, files=files)
    return _folder(place, asked, charts) if place.is_dir() else _log(place, asked)


def _log(place: Path, asked: LogRequest) -> Exit:
    try:
        found = asked.examined(place)
    except LogError as error:
        raise UsageError(f"{place}: {error}") from error
    campaign = LogCampaign([found], asked.book)
    _finish(campaign)
    _look_for_causes(campaign, place.absolute().parent, asked)
    record = _record({place.name: found}, campaign, place.absolute().parent, asked) if asked.reports else None
    code = _code_of(found, campaign)
    if asked.options.as_json and record is not None:
        from rovercheck.checker.commands.check_log.document import log_document

        print(json_text(log_document(found, asked.charts, code, campaign, record)))
    else:
        out.print(page(found, asked.options.verbose, asked.charts, campaign), markup=False)
    if record is not None:
        asked.files.write(record)
    return code


def _finish(campaign: LogCampaign) -> None:
    """Judge the deviations, and write the known ones where that was asked for.  Raises ``UsageError``."""
    if campaign.logs:
        campaign.book.concerning(list(campaign.judgements))
    for said in campaign.book.write():
        err.print(said, markup=False)


def _look_for_causes(campaign: LogCampaign, folder: Path, asked: LogRequest) -> None:
    """Where that was asked for."""
    if not asked.options.causes:
        return
    from rovercheck.checker.commands.check_log.causes import causes_in

    known = asked.against.boards if asked.against is not None else boards()
    with ProgressLine() as line:
        campaign.causes.update(
            causes_in(campaign, folder, asked.how, known, asked.options.seconds, line.show)
        )


def _record(
    found: Mapping[str, Outcome], campaign: LogCampaign, folder: Path, asked: LogRequest
) -> CampaignRecord:
    """What reports are written from."""
    from rovercheck.checker.commands.check_log.report import LogReport

    charts = asked.against.boards if asked.against is not None else None
    return LogReport(found, campaign, folder, asked.how, asked.charts, charts).record()


def _outcomes(
    logs: Sequence[Path], asked: LogRequest, charts: VariantOptions | None
) -> Generator[tuple[Path, Outcome], None, None]:
    """What each log says, as it is known."""
    jobs = asked.options.scheduler or asked.options.jobs or cores()
    if charts is not None and worth_it(logs, jobs):
        yield from at_once(logs, charts, asked.options, asked.used, jobs)
    else:
        yield from ((log, asked.outcome(log)) for log in logs)


def _folder(folder: Path, asked: LogRequest, charts: VariantOptions | None) -> Exit:
    """Every log of a folder; one that cannot be read or judged leaves the others' results."""
    logs = logs_in(folder)
    if not logs:
        err.print(no_logs(folder), markup=False)
        return Exit.NOTHING
    told: dict[Path, Outcome] = {}
    with ProgressLine() as line, closing(_outcomes(logs, asked, charts)) as outcomes:
        line.show(f"0 of {counted(len(logs), 'log', 'logs')}")
        for log, outcome in outcomes:
            told[log] = outcome
            line.show(f"{len(told)} of {counted(len(logs), 'log', 'logs')}: {log.name}")
    found = {log.name: told[log] for log in logs}
    campaign = LogCampaign([one for one in found.values() if isinstance(one, LogResult)], asked.book)
    _finish(campaign)
    _look_for_causes(campaign, folder.absolute(), asked)
    record = _record(found, campaign, folder.absolute(), asked) if asked.reports else None
    code = _code(list(found.values()), campaign)
    if asked.options.as_json and record is not None:
        from rovercheck.checker.commands.check_log.document import folder_document

        print(json_text(folder_document(found, asked.charts, code, campaign, record)))
    else:
        out.print(summary(found, asked.charts, campaign), markup=False)
    if record is not None:
        asked.files.write(record)
    return code


def _code(found: Sequence[Outcome], campaign: LogCampaign) -> Exit:
    """The gravest code of all logs."""
    codes = {_code_of(one, campaign) for one in found}
    return next((code for code in GRAVEST if code in codes), Exit.AS_EXPECTED)


def _code_of(found: Outcome, campaign: LogCampaign) -> Exit:
    match found:
        case LogFault():
            return Exit.INTERNAL
        case LogError():
            return Exit.USAGE
    if found.unexpected or campaign.unknown(found) or found.invalid:
        return Exit.FAILED
    return Exit.INCONCLUSIVE if found.behaviour.undecided or found.ended else Exit.AS_EXPECTED
