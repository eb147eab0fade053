"""``rovercheck check-log``: logs checked against the properties and the charts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rovercheck.checker.commands.check_log import LogOptions
from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.check_log.text import LogFault, Outcome, page, summary
from rovercheck.checker.commands.shared.campaign_files import NO_FILES, CampaignFiles
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.failure import error_message
from rovercheck.checker.commands.shared.known import KnownBook, known_book
from rovercheck.checker.commands.shared.logs import column_map, logs_in, no_logs
from rovercheck.checker.commands.shared.output import err, out
from rovercheck.checker.commands.shared.progress import ProgressLine
from rovercheck.checker.compare.variants import boards_of_model, varied
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.logs import ColumnMap, LogError, LogReference, LogResult, examine
from rovercheck.checker.model.variant import Variant
from rovercheck.checker.results.campaign import CampaignRecord
from rovercheck.spec_model.lang.system import TICK_MS

GRAVEST = (Exit.INTERNAL, Exit.FAILED, Exit.USAGE, Exit.INCONCLUSIVE)
"""Of a folder the first of these that applies to some log."""


@dataclass(frozen=True)
class LogRequest:
    """What is asked of logs; ``against``: the charts, with ``charts`` in words where changed."""

    how: ColumnMap
    options: LogOptions
    charts: str = ""
    against: LogReference | None = None
    book: KnownBook = field(default_factory=lambda: KnownBook({}, ""))
    files: CampaignFiles = NO_FILES

    @property
    def reports(self) -> bool:
        """Whether anything is written from the record of the campaign."""
        return self.options.as_json or self.files.wanted

    def examined(self, path: Path) -> LogResult:
        """What one log says.  Raises ``LogError``."""
        return examine(path, self.how, self.options.system or "", self.against, self.book.used)

    def outcome(self, path: Path) -> Outcome:
        """What one of many logs says, or why it says nothing, whatever that is: the others are judged."""
        try:
            return self.examined(path)
        except LogError as error:
            return error
        except MemoryError:
            return LogError("takes more memory than there is; cut it into several logs.")
        except Exception as error:
            return LogFault(error_message(error))


def check_log(place: Path, options: LogOptions, variant: Variant, files: CampaignFiles = NO_FILES) -> Exit:
    """Check one log or all logs of a folder against the charts, changed or not.

    Raises ``UsageError`` for a map without meaning, and for a single log that cannot be read.
    """
    files.possible()
    changed = variant.name or variant.own is not None
    against = _against(variant, options.system) if changed else None
    book = KnownBook({}, "")
    if options.known is not None or options.write_known is not None:
        every = against.boards if against else varied(variant.choices, variant.repair)
        book = known_book(options.known, options.write_known, every, variant.name)
    asked = LogRequest(column_map(options.map_file), options, variant.name, against, book, files)
    return _folder(place, asked) if place.is_dir() else _log(place, asked)


def _log(place: Path, asked: LogRequest) -> Exit:
    try:
        found = asked.examined(place)
    except LogError as error:
        raise UsageError(f"{place}: {error}") from error
    campaign = LogCampaign([found], asked.book)
    _finish(campaign)
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


def _record(
    found: Mapping[str, Outcome], campaign: LogCampaign, folder: Path, asked: LogRequest
) -> CampaignRecord:
    """What reports are written from."""
    from rovercheck.checker.commands.check_log.report import LogReport

    charts = asked.against.boards if asked.against is not None else None
    return LogReport(found, campaign, folder, asked.how, asked.charts, charts).record()


def _against(variant: Variant, name: str | None) -> LogReference:
    """The boards, properties and expected verdicts of a variant.

    Raises ``UsageError`` for a model whose steps are no rows of a log.
    """
    if variant.own is None:
        found = varied(variant.choices, variant.repair)
    else:
        found = boards_of_model(variant.own, name)
        for board in found.values():
            if board.tick_ms != TICK_MS:
                raise UsageError(
                    f"{board.name} has steps of {board.tick_ms} ms, and logs are read in steps of {TICK_MS}; "
                    "compare sets such a model beside its firmware."
                )
    properties, systems = variant.properties(), variant.systems()
    return LogReference(found, properties, systems, lambda id: variant.expected(id).verdict)


def _folder(folder: Path, asked: LogRequest) -> Exit:
    """Every log of a folder; one that cannot be read or judged leaves the others' results."""
    logs = logs_in(folder)
    if not logs:
        err.print(no_logs(folder), markup=False)
        return Exit.NOTHING
    found: dict[str, Outcome] = {}
    with ProgressLine() as line:
        for number, log in enumerate(logs, 1):
            line.show(f"{number} of {len(logs)}: {log.name}")
            found[log.name] = asked.outcome(log)
    campaign = LogCampaign([one for one in found.values() if isinstance(one, LogResult)], asked.book)
    _finish(campaign)
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
