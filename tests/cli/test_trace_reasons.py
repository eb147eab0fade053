"""Why a property is violated, and which inputs determine it, is in every format in which a run is written."""

import csv
import html
import re
from dataclasses import replace
from io import StringIO
from pathlib import Path

import pytest

from rovercheck.checker.cli import run as cli
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.trace.board_steps import concrete
from rovercheck.checker.render import renderers
from rovercheck.checker.results.format import Need
from rovercheck.checker.results.trace import NecessaryInputs, Needed, Trace
from rovercheck.properties.catalogue import expected
from rovercheck.spec_model.rover import systems
from tests.cli.test_trace_exits import pb1_15
from tests.cli.test_widths import at_terminal, too_long

WHY = 'A <b>cable</b> & "|" */ """ ::error:: that nobody | asked for, 3 s; $end of it'
WORDS = ("cable", "that nobody", "asked for")
"""What is the same in whatever way a format escapes the rest."""
WITHOUT = {"csv": "comments are not part of RFC 4180, and readers take each line for a tick"}


def run() -> Trace:
    """With a reason that means something else in many a format, and an input that determines the end."""
    inputs = NecessaryInputs((Needed(8, "heartbeat_update", frozenset({1})),), minimal=True)
    return replace(pb1_15(), necessary=inputs).with_reason(WHY)


def plain(text: str) -> str:
    """Without escapes, line ends and margins."""
    text = html.unescape(text).replace("\\n", " ").replace("%0A", " ").replace("\\", "")
    text = re.sub(r"</?(text|tspan|p|b|br|code)\b[^>]*>", " ", text)
    return " ".join(re.sub(r"^\s*(#|\*|//|\[\*\])", " ", text, flags=re.MULTILINE).split())


def rendered(trace: Trace, name: str) -> str:
    renderer = renderers("trace")[name]
    if Need.BOARD_STEPS in renderer.FORMAT.needs:
        trace = concrete(trace, systems()["board1"])
    told = renderer.render(trace)
    return told.decode() if isinstance(told, bytes) else told


@pytest.mark.parametrize("name", sorted(renderers("trace")))
def test_every_format_says_why(name: str) -> None:
    told = rendered(run(), name)
    if name in WITHOUT:
        rows = list(csv.reader(StringIO(told)))
        assert "cable" not in told and {len(row) for row in rows} == {len(rows[0])}, WITHOUT[name]
        return
    assert all(word in plain(told) for word in WORDS)
    assert plain(told).count("cable") == (2 if name in ("github", "html") else 1), "twice in some"
    bare = replace(pb1_15(), necessary=None)
    assert not re.search(r"\bWhy\b", plain(rendered(bare, name))), "nothing is said where nothing is known"


@pytest.mark.parametrize("name", sorted(renderers("trace")))
def test_every_format_names_the_inputs_that_determine_the_end(name: str) -> None:
    if name in WITHOUT:
        return
    told = plain(rendered(run(), name))
    assert re.search(r"etermine the violation|etermined by|is needed|needed\W", told, re.IGNORECASE)
    assert "heartbeat_update" in told.replace("_ ", "_").replace("<wbr>", "")


def test_the_terminal_says_it_once_and_a_file_too(tmp_path: Path) -> None:
    because = expected("PB1-15").because
    file = tmp_path / "run.txt"
    assert cli(["trace", "PB1-15", "--no-explain", "-o", str(file)]) == Exit.AS_EXPECTED
    assert " ".join(file.read_text().split()).startswith(f"Why: {because} board1: 8 ticks")
    for columns in (60, 80, 120):
        seen = at_terminal(columns, "trace", "PB1-15", "--no-explain").seen
        assert " ".join(seen.split()).count(f"Why: {because}") == 1
        assert not too_long(seen, columns)
        assert max(map(len, seen.splitlines())) > columns - 12, "it takes the width there is"
