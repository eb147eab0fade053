"""Renderers are found by being in the folder."""

import pytest

from rovercheck.checker.render import KINDS, renderers


def test_every_promised_exit_is_there() -> None:
    assert list(renderers("statechart")) == ["dot", "graphml", "html", "mermaid", "svg"]
    assert list(renderers("graph")) == ["dot", "graphml", "html", "json", "mermaid", "svg"]
    assert list(renderers("trace")) == [
        "c", "csv", "github", "gtkw", "html", "itf", "json", "junit", "markdown", "play", "pytest", "sarif",
        "sequence", "svg", "table", "vcd",
    ]  # fmt: skip


def test_an_unknown_kind_names_the_known_ones() -> None:
    with pytest.raises(ValueError, match=", ".join(KINDS)):
        renderers("picture")
