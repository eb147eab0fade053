"""The files that ``check-log`` and ``compare`` write of what they found: a page, Markdown, SARIF."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.options import gathered

if TYPE_CHECKING:
    from rovercheck.checker.results.campaign import CampaignRecord


@dataclass(frozen=True)
class CampaignFiles:
    """The files that were asked for."""

    html: Path | None = None
    markdown: Path | None = None
    sarif: Path | None = None

    @property
    def wanted(self) -> bool:
        """Whether any is."""
        return any((self.html, self.markdown, self.sarif))

    def possible(self) -> None:
        """Raises ``UsageError`` for one that cannot be written anyway, before long work is done for it."""
        from rovercheck.checker.commands.shared.output import possible

        for file in (self.html, self.markdown, self.sarif):
            possible(file)

    def write(self, record: "CampaignRecord") -> None:
        """Write them, each all of it or nothing.  Raises ``UsageError``."""
        from rovercheck.checker.commands.shared.output import write

        for file, text in list(self._texts(record)):
            write(text, file)

    def _texts(self, record: "CampaignRecord") -> Iterator[tuple[Path, str]]:
        from rovercheck.checker.render.campaign import campaign_page
        from rovercheck.checker.render.campaign.markdown import campaign_markdown
        from rovercheck.checker.render.campaign.sarif import campaign_sarif

        if self.html is not None:
            yield self.html, campaign_page(record)
        if self.markdown is not None:
            yield self.markdown, campaign_markdown(record)
        if self.sarif is not None:
            yield self.sarif, campaign_sarif(record)


NO_FILES = CampaignFiles()


def reporting(command: Callable[..., Exit]) -> Callable[..., Exit]:
    """The options of every verb that compares what was recorded with the charts: files of what was found."""
    command = gathered(CampaignFiles, "files")(command)
    for name, help in (
        ("--sarif", "The same as SARIF, for code scanning and editors."),
        ("--markdown", "The same as Markdown, for a pull request or an issue."),
        ("--html", "Write what was found there, as one page."),
    ):
        path = click.Path(dir_okay=False, path_type=Path)
        command = click.option(name, type=path, metavar="FILE", help=help)(command)
    return command


__all__ = ["NO_FILES", "CampaignFiles", "reporting"]
