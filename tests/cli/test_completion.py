"""What the shell completes: verbs, options and the names of the model; no solver is loaded for it."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.completion import BY_NAME, IN_VERB
from rovercheck.checker.engines import engines
from rovercheck.checker.render import renderers

LIFT = Path(__file__).parents[2] / "examples/models/lift"
SOLVERS = ("z3", "bitwuzla", "llvmlite", "oxidd", "pysat", "cvc5")


def offered(*words: str) -> list[str]:
    """What bash is offered for the last of the words."""
    asked = {"COMP_WORDS": " ".join(("rovercheck", *words)), "COMP_CWORD": str(len(words))}
    asked["_ROVERCHECK_COMPLETE"] = "bash_complete"
    done = subprocess.run(
        [sys.executable, "-m", "rovercheck"], env={**os.environ, **asked},
        capture_output=True, text=True, check=False, timeout=60,
    )  # fmt: skip
    assert done.stderr == ""
    return [line.partition(",")[2] for line in done.stdout.split()]


@pytest.mark.parametrize(
    ("words", "some"),
    [
        (("expl",), {"explore"}),
        (("trace", "PB1-1"), {"PB1-15", "PB1-11"}),
        (("check", "--system", "rel"), {"relay", "relay_links"}),
        (("explore", "Mon"), {"Monitor_battery", "Monitors_2"}),
        (("explore", "--model", str(LIFT), "Do"), {"Door"}),
        (("check", "--engine", "b"), {"bdd", "bmc"}),
        (("check", "--inter"), {"--interpret"}),
    ],
)
def test_names_that_begin_so_are_offered(words: tuple[str, ...], some: set[str]) -> None:
    found = offered(*words)
    assert some <= set(found)
    assert all(name.startswith(words[-1]) for name in found)


def test_formats_and_engines_are_named_as_their_files() -> None:
    """Completion reads the names of files, so that none of them need be imported."""
    import click

    context = click.Context(click.Command("any"))
    for kind in ("trace", "graph"):
        items = IN_VERB[(kind, "format")](context, click.Option(["--format"]), "")
        assert {item.value for item in items} == set(renderers(kind))
    items = BY_NAME["engine"](context, click.Option(["--engine"]), "")
    assert {item.value for item in items} == {*engines(), "auto"}


def test_a_model_of_your_own_that_cannot_be_read_offers_nothing() -> None:
    assert offered("check", "--model", "/nowhere/model.py", "PB") == []


def test_no_solver_is_loaded() -> None:
    program = (
        "import sys, click; from rovercheck.checker.cli import app\n"
        "from rovercheck.checker.commands.shared.completion import BY_NAME\n"
        "found = BY_NAME['id'](click.Context(app), click.Option(['--id']), 'PB1')\n"
        f"assert found; print([m for m in {SOLVERS} if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_names_the_program(shell: str, capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    assert run(["completion", shell]) is Exit.AS_EXPECTED
    script = capsysbinary.readouterr().out
    assert b"_ROVERCHECK_COMPLETE" in script and b"rovercheck" in script
    if shutil.which(shell):
        subprocess.run([shell, "-n"], input=script, check=True, timeout=60)
