"""Renderers are found by being in the folder."""

import re
from pathlib import Path

import pytest

from rovercheck.checker.export import exporters
from rovercheck.checker.render import RENDERED, renderers


def test_every_promised_exit_is_there() -> None:
    assert list(renderers("statechart")) == ["dot", "graphml", "html", "mermaid", "svg"]
    assert list(renderers("graph")) == ["dot", "graphml", "html", "json", "mermaid", "svg"]
    assert list(renderers("trace")) == [
        "c", "csv", "github", "gtkw", "html", "itf", "json", "junit", "markdown", "play", "pytest", "sarif",
        "sequence", "svg", "table", "vcd",
    ]  # fmt: skip


def test_an_unknown_kind_names_the_known_ones() -> None:
    with pytest.raises(ValueError, match=", ".join(RENDERED)):
        renderers("picture")


def test_every_format_is_in_the_documents() -> None:
    docs = "".join(f.read_text(encoding="utf-8") for f in Path("docs").glob("*.md"))
    shown = [one.FORMAT for kind in RENDERED for one in renderers(kind).values()]
    shown += [one.FORMAT for one in exporters().values()]
    assert not [f.name for f in shown if not re.search(rf"\b{f.name}\b", docs)]
