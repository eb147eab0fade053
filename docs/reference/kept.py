"""What is generated and kept with the documents, so that links lead to it where no site was built, too."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from docs.reference import forms, language, pictures

DOCS = Path(__file__).parents[1]
KEPT: Mapping[str, Callable[[], str]] = {
    "reference/language.md": language.page,
    "reference/properties.md": forms.page,
    "pictures/pump.svg": pictures.of_tutorial,
    "pictures/pump-repaired.svg": lambda: pictures.of_tutorial(changes=2),
}


def stale() -> Iterator[tuple[Path, str]]:
    """The files that are not what is generated today, each with what it should hold."""
    for place, made in KEPT.items():
        file, content = DOCS / place, made()
        if not file.is_file() or file.read_text(encoding="utf-8") != content:
            yield file, content
