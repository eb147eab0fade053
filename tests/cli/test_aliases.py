"""Old words of the command line: they do what the new ones do, and name them on standard error only."""

import click
import pytest

from rovercheck.checker.cli import app, run
from rovercheck.checker.commands.shared.aliases import ALIASES, current
from rovercheck.checker.commands.shared.codes import Exit

TRANSITION = "Relay: B1_actuating -> B2_actuating"


@pytest.mark.parametrize("old", ALIASES)
def test_an_alias_leads_to_a_word_that_exists(old: str) -> None:
    verb, *rest = ALIASES[old].split()
    command = app.commands[verb]
    assert not {old, old.partition(" ")[0]} - {verb} & app.commands.keys()
    if rest and not rest[0].startswith("-"):
        [first, *_] = (p for p in command.params if isinstance(p, click.Argument))
        assert isinstance(first.type, click.Choice) and rest[0] in first.type.choices
        return
    for option, *values in [rest] if rest else []:
        [found] = [p for p in command.params if option in p.opts]
        if values:
            assert isinstance(found.type, click.Choice) and values[0] in found.type.choices


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("conform --help", "check-log --help", "conform is now check-log."),
        ("trace --arrow=X", "trace --transition=X", "trace --arrow is now trace --transition."),
        ("list readings --json", "list interpretations --json", "list readings is now list interpretations."),
        ("trace -- --arrow", "trace -- --arrow", ""),
        ("trace --by=arrows", "trace --by=transitions", "trace --by arrows is now trace --by transitions."),
        ("trace --by reason", "trace --by reason", ""),
        ("check --arrow X", "check --arrow X", ""),
        (
            "testgen --cover pairs --cover arrows",
            "generate-tests --cover pairs --cover transitions",
            "testgen is now generate-tests; "
            "generate-tests --cover arrows is now generate-tests --cover transitions.",
        ),
    ],
)
def test_old_words_become_new_ones(old: str, new: str, said: str) -> None:
    assert current(old.split()) == (new.split(), said)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (["trace", "--arrow", TRANSITION], ["trace", "--transition", TRANSITION]),
        (["crosscheck", "--system", "nothing"], ["compare", "--system", "nothing"]),
        (["trace", "PB1-15", "--by", "arrows"], ["trace", "PB1-15", "--by", "transitions"]),
        (
            ["trace", "--arrow", TRANSITION, "--no-explain", "--format", "json"],
            ["trace", "--transition", TRANSITION, "--no-explain", "--format", "json"],
        ),
    ],
)
def test_an_old_command_line_does_the_same_and_says_so(
    old: list[str], new: list[str], capsysbinary: pytest.CaptureFixture[bytes]
) -> None:
    codes, streams = [], []
    for arguments in (old, new):
        codes.append(run([*arguments]))
        streams.append(capsysbinary.readouterr())
    assert codes[0] is codes[1] is not Exit.INTERNAL
    assert streams[0].out == streams[1].out
    note, *rest = streams[0].err.decode().splitlines()
    assert " is now " in note and rest == streams[1].err.decode().splitlines()
