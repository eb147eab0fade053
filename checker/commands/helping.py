"""The examples at the end of ``--help`` of the verbs that bring none of their own."""

import click

EXAMPLES: dict[str, tuple[str, ...]] = {
    "certify": (
        "rovercheck certify proofs",
        "rovercheck certify proofs --solver bitwuzla --smt2 obligations",
    ),
    "check": (
        "rovercheck check PB1-15 PB2-01",
        "rovercheck check --system relay --certify",
        "rovercheck check --model heater.py --junit verdicts.xml",
        "rovercheck check --quiet --json > verdicts.json",
    ),
    "conform": (
        "rovercheck conform examples/logs/good.csv",
        "rovercheck conform examples/logs --map examples/logs/map.toml --json",
    ),
    "crosscheck": (
        "rovercheck crosscheck --system board1",
        "rovercheck crosscheck --system board1 --impl c:examples/board1_c",
    ),
    "export": (
        "rovercheck export PB1-15 --format btor2 -o PB1-15.btor2",
        "rovercheck export --system relay --format smv -o relay",
    ),
    "init": ("rovercheck init heater", "rovercheck check --model heater/heater.py"),
    "list": ("rovercheck list properties PB1-15 --english", "rovercheck list systems"),
    "report": (
        "rovercheck report -o review.html",
        "rovercheck report --system relay --certify -o relay.html",
    ),
    "reports": ("rovercheck reports", "rovercheck reports --stale"),
    "requirements": ("rovercheck requirements", "rovercheck requirements --check --json"),
    "simulate": ("rovercheck simulate examples/scenarios/link_loss.toml --log steps",),
    "testgen": (
        "rovercheck testgen --kept --system board1",
        "rovercheck testgen --cover boundaries --format pytest -o tests",
    ),
}
"""By verb: command lines that can be typed as they are."""


def helped(verb: click.Command) -> click.Command:
    """The verb, with its examples at the end of its help."""
    lines = EXAMPLES.get(verb.name or "", ())
    if lines and not verb.epilog:
        verb.epilog = "\n".join(["\b", "Examples:", *(f"  {line}" for line in lines)])
    return verb
