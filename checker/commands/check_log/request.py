"""What is asked of logs, and how one of them is examined."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from rovercheck.checker.commands.check_log import LogOptions
from rovercheck.checker.commands.check_log.text import LogFault, Outcome
from rovercheck.checker.commands.shared.campaign_files import NO_FILES, CampaignFiles
from rovercheck.checker.commands.shared.codes import UsageError
from rovercheck.checker.commands.shared.failure import error_message
from rovercheck.checker.commands.shared.known import KnownBook
from rovercheck.checker.commands.shared.logs import column_map
from rovercheck.checker.compare.variants import boards_of
from rovercheck.checker.logs import ColumnMap, LogError, LogReference, LogResult, examine
from rovercheck.checker.model.variant import Variant
from rovercheck.spec_model.lang.system import TICK_MS


@dataclass(frozen=True)
class LogRequest:
    """What is asked of logs; ``against``: the charts, with ``charts`` in words where changed."""

    how: ColumnMap
    options: LogOptions
    charts: str = ""
    against: LogReference | None = None
    book: KnownBook = field(default_factory=lambda: KnownBook({}, ""))
    files: CampaignFiles = NO_FILES
    used: bool = False
    """Whether it matters what was put to the test: known deviations are judged."""

    @property
    def reports(self) -> bool:
        """Whether anything is written from the record of the campaign."""
        return self.options.as_json or self.files.wanted

    def examined(self, path: Path) -> LogResult:
        """What one log says.  Raises ``LogError``."""
        return examine(path, self.how, self.options.system or "", self.against, self.used)

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


def request_of(variant: Variant, options: LogOptions, used: bool = False) -> LogRequest:
    """What is asked of logs against the charts, changed or not.  Raises ``UsageError``."""
    changed = variant.board_name or variant.own is not None
    against = _against(variant, options.system) if changed else None
    return LogRequest(column_map(options.map_file), options, variant.board_name, against, used=used)


def _against(variant: Variant, name: str | None) -> LogReference:
    """The boards, properties and expected verdicts of a variant.

    Raises ``UsageError`` for a model whose steps are no rows of a log.
    """
    found = boards_of(variant, name)
    if variant.own is not None:
        for board in found.values():
            if board.tick_ms != TICK_MS:
                raise UsageError(
                    f"{board.name} has steps of {board.tick_ms} ms, and logs are read in steps of {TICK_MS}; "
                    "compare sets such a model beside its firmware."
                )
    stated = replace(variant, changes=None)  # a property says what must hold, whatever flies
    properties, systems = stated.properties(), stated.systems()
    return LogReference(found, properties, systems, lambda id: variant.expected(id).verdict)
