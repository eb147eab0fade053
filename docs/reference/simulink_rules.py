"""The rules by which models of Simulink are read, each with what pins it."""

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

TABLE = Path(__file__).parents[2] / "tests" / "simulink" / "rules.toml"
HEAD = """# Rules of Simulink and Stateflow

By these rules [models of Simulink](simulink.md) are read and executed. Each is pinned by packages that have a
simulation by hand, which the direct interpreter and the lowered system both give again, row by row, and by
tests; a test looks that each package has what its rule speaks of. Of {rules} rules {refused} are refusals.
The table is made from `tests/simulink/rules.toml`; packages are drawn in `tests/simulink/by_hand` and
`tests/simulink/known`, and those with a number in `examples/simulink`.
"""


def page() -> str:
    """The table as Markdown."""
    topics = tomllib.loads(TABLE.read_text(encoding="utf-8"))["topic"]
    rules = [rule for topic in topics for rule in topic["rule"]]
    refused = sum(rule.get("refused", False) for rule in rules)
    return HEAD.format(rules=len(rules), refused=refused) + "".join(map(_topic, topics))


def _topic(topic: Mapping[str, Any]) -> str:
    rows = "".join(_row(rule) for rule in topic["rule"])
    return f"\n## {topic['title']}\n\n| Rule | What it says | Pinned by |\n|---|---|---|\n{rows}"


def _row(rule: Mapping[str, Any]) -> str:
    return f"| {rule['id']} | {rule['says'].replace('|', chr(92) + '|')} | {', '.join(_pins(rule))} |\n"


def _pins(rule: Mapping[str, Any]) -> Iterator[str]:
    yield from rule.get("packages", [])
    yield from (f"`{test.partition('::')[2]}`" for test in rule.get("tests", []))


__all__ = ["TABLE", "page"]
