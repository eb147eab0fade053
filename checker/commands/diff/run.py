"""``rovercheck diff``: both revisions are checked, each by a process of its own, and what differs is told.

What is the same in both is in the store of verdicts after the first check, and not decided twice.
"""

import json
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rovercheck.checker.commands.diff.document import DiffDocument, VerdictChange, changes, code
from rovercheck.checker.commands.diff.text import markdown, text
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.output import err, possible, write, wrote
from rovercheck.checker.commands.shared.revisions import RevisionTree, commit, exported, repository, tree_of
from rovercheck.checker.commands.shared.silence import silent
from rovercheck.checker.commands.shared.text_wrap import whole
from rovercheck.checker.io.printable import json_text


@dataclass(frozen=True)
class DiffRequest:
    """Which revisions are compared, of the rover or of a ``model``; ``after`` None: the working tree."""

    before: str
    after: str | None = None
    full: bool = False
    model: Path | None = None

    @property
    def root(self) -> Path:
        """The repository.  Raises ``UsageError``."""
        if self.model is not None and not self.model.exists():
            raise UsageError(f"There is no {whole(self.model)}; write a Python file, or a folder of them.")
        return repository(self.model)


def diff(asked: DiffRequest, form: str, output: Path | None = None) -> Exit:
    """Compare, and print or write what changed.  Raises ``UsageError``."""
    possible(output)
    root = asked.root
    names = [commit(root, asked.before), "" if asked.after is None else commit(root, asked.after)]
    with ExitStack() as folders:
        trees = [_tree(asked, root, folders.enter_context(exported(root, names[0])))]
        there = folders.enter_context(exported(root, names[1])) if names[1] else root
        trees.append(_tree(asked, root, there))
        rows = [_checked(tree, name, asked.full) for tree, name in zip(trees, names, strict=True)]
        found = changes(*rows)
        same = len(rows[1]) - sum(one["after"] is not None for one in found)
        run = _run(trees[1], found, form)
    document: DiffDocument = {
        "schema": "rovercheck/diff/1",
        "before": names[0],
        "after": names[1],
        "same": same,
        "changes": found,
        "run": run,
        "exit": code(found),
    }
    if form == "json":
        said = json_text(document, ascii=True) + "\n"
    else:
        said = markdown(document) if form == "markdown" else text(document)
    write(said, output)
    if output is not None:
        wrote(output)
    return code(found)


def _tree(asked: DiffRequest, root: Path, folder: Path) -> RevisionTree:
    """Raises ``UsageError`` where the files hold neither the rover nor the model that is asked for."""
    found = tree_of(asked.model, root, folder)
    if found is None and asked.model is None:
        raise UsageError(f"{whole(folder)} holds no rovercheck; for a model of your own write --model.")
    if found is None:
        raise UsageError(f"{asked.before} has no {whole(str(asked.model))}; write a revision that has it.")
    return found


def _said(tree: RevisionTree, *words: str) -> str:
    """What a command about the files prints.  Raises ``UsageError`` where it could not do what it should."""
    done = tree.run("rovercheck", *words, *(["--model", tree.model] if tree.model else []))
    if done.returncode == Exit.INTERRUPTED:
        raise KeyboardInterrupt
    if done.returncode >= Exit.INTERNAL:
        raise UsageError(f"These files cannot be compared: `rovercheck {' '.join(words)}` fails, see above.")
    return done.stdout


def _checked(tree: RevisionTree, name: str, full: bool) -> list[Any]:
    """The rows of a check."""
    if not silent():
        err.print(f"Checking {name or 'the working tree'} ...", markup=False)
    options = [*(["--full"] if full else []), *(["--quiet"] if silent() else [])]
    said = _said(tree, "check", "--json", *options)
    try:
        found: Mapping[str, Any] = json.loads(said)
        return list(found["results"])
    except (ValueError, KeyError, TypeError) as error:
        raise UsageError(f"{name} speaks another JSON: {type(error).__name__}; write a later one.") from error


def _run(tree: RevisionTree, found: Sequence[VerdictChange], form: str) -> str:
    """The shortest run that was not there before."""
    new = [one for one in found if one["after"] == "violated" and one["before"] != "violated"]
    runs = [one for one in new if one["ticks_after"] is not None]
    if not runs:
        return ""
    shortest = min(runs, key=lambda one: (one["ticks_after"] or 0, one["id"]))
    written = "markdown" if form == "markdown" else "table"
    return _said(tree, "trace", shortest["id"], "--no-explain", "--format", written).rstrip()
