"""What the command line says of itself: whole words in 80 columns, every verb and every engine named."""

import re
import shlex
import textwrap
from importlib.metadata import version
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from rovercheck.checker.cli import app, run
from rovercheck.checker.commands.list import LISTS
from rovercheck.checker.commands.list.run import LISTS as LISTED
from rovercheck.checker.commands.list.run import OTHERS
from rovercheck.checker.commands.shared.help_examples import EXAMPLES
from rovercheck.checker.commands.shared.output import counted
from rovercheck.checker.engines import engines

ROOT = Path(__file__).parents[2]
WRITTEN = "".join(p.read_text(encoding="utf-8") for p in (ROOT / "README.md", *(ROOT / "docs").glob("*.md")))
HELP = {"": app, **app.commands}


def shown(option: str) -> bool:
    """Whether the documents have the option as a whole word."""
    return re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", WRITTEN) is not None


def said(verb: str) -> str:
    result = CliRunner().invoke(app, [*verb.split(), "--help"], terminal_width=80)
    assert result.exit_code == 0
    return result.output


@pytest.mark.parametrize("verb", HELP)
def test_help_fits_in_80_columns_and_cuts_nothing(verb: str) -> None:
    _usage, *lines = said(verb).splitlines()
    assert max(map(len, lines)) <= 80
    assert not [line for line in lines if line.endswith("...")]


@pytest.mark.parametrize("verb", HELP)
def test_help_explains_every_option(verb: str) -> None:
    options = [p for p in HELP[verb].params if isinstance(p, click.Option)]
    assert [o.name for o in options if not o.help] == []


@pytest.mark.parametrize("verb", app.commands)
def test_the_documents_show_every_verb_and_its_options(verb: str) -> None:
    assert f"rovercheck {verb}" in WRITTEN
    options = [p for p in app.commands[verb].params if isinstance(p, click.Option)]
    assert [o.name for o in options if not any(map(shown, o.opts))] == []


def examples(verb: str) -> list[list[str]]:
    """The command lines below "Examples" in the help of a verb, without what the shell does with them."""
    _, found, text = said(verb).partition("Examples:\n")
    assert found, "the help shows no example"
    block = text.partition("\n\n")[0]
    return [shlex.split(line) for line in re.findall(r"rovercheck ((?:'[^'\n]*'|[^'\n()<>|])+)", block)]


@pytest.mark.parametrize("verb", app.commands)
def test_help_shows_examples_that_can_be_typed(verb: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    found = examples(verb)
    assert found and verb in {words[0] for words in found}
    for name, *rest in found:
        with app.commands[name].make_context(name, rest):
            pass


def test_no_example_is_left_of_a_verb_that_is_gone() -> None:
    assert EXAMPLES.keys() <= app.commands.keys()


def test_list_names_its_lists_and_every_engine(capsys: pytest.CaptureFixture[str]) -> None:
    assert set(LISTS) == {*LISTED, *OTHERS, "properties"}
    assert all(name in textwrap.fill(said("list")) for name in LISTS)
    run(["list", "engines"])
    names = [line.split()[0] for line in capsys.readouterr().out.splitlines() if line[0] != " "]
    assert names == ["name", *engines(), "auto", "all"]


def test_one_is_no_plural() -> None:
    counts = [counted(n, "property", "properties") for n in (0, 1, 1386)]
    assert counts == ["0 properties", "1 property", "1,386 properties"]


def test_it_says_which_version_it_is() -> None:
    result = CliRunner().invoke(app, ["--version"], prog_name="rovercheck")
    assert result.output == f"rovercheck {version('rovercheck')}\n"
