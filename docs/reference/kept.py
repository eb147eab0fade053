"""What is generated and kept: pages and pictures for whoever builds no site, schemas for whoever installs."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from docs.reference import commands, forms, language, pictures, schemas, simulink_rules

DOCS = Path(__file__).parents[1]
KEPT: Mapping[Path, Callable[[], str]] = {
    DOCS / "reference/commands.md": commands.page,
    DOCS / "reference/language.md": language.page,
    DOCS / "reference/properties.md": forms.page,
    DOCS / "simulink-rules.md": simulink_rules.page,
    DOCS / "pictures/pump.svg": pictures.of_tutorial,
    DOCS / "pictures/pump-repaired.svg": lambda: pictures.of_tutorial(changes=2),
    **schemas.FILES,
}


def stale() -> Iterator[tuple[Path, str]]:
    """The files that are not what is generated today, each with what it should hold."""
    for file, made in KEPT.items():
        content = made()
        if not file.is_file() or file.read_text(encoding="utf-8") != content:
            yield file, content
