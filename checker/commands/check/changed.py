"""Which properties depend on what has changed since a git revision: those whose slices are written otherwise.

The names under which verdicts are kept stand for what is asked (``checker.store.verdicts``).  A process of
its own says the names of the earlier revision; as a program this module prints those of properties whose ids
it reads, or of all.
"""

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.commands.shared.revisions import RevisionTree, exported, repository, tree_of

if TYPE_CHECKING:
    from rovercheck.checker.model.variant import Variant
    from rovercheck.checker.store.verdicts import VerdictStore

Names = Mapping[str, str | None]
"""By property a name that stands for what is asked; None where there is none."""
MODULE = "rovercheck.checker.commands.check.changed"


def changed_since(revision: str, variant: "Variant") -> set[str]:
    """The ids of the properties whose verdicts may be other ones than at a revision.  Raises ``UsageError``.

    Where the code that decides has changed, these are all.
    """
    model = variant.own.path if variant.own is not None else None
    root = repository(model)
    with exported(root, revision) as folder:
        tree = tree_of(model, root, folder)
        if tree is None:
            return set(variant.properties())
        before = _said(tree, revision, ())
        now = questions(variant)
        otherwise = [id for id, name in now.items() if name is None or before.get(id) != name]
        known = [id for id in otherwise if before.get(id) is not None]
        before = _said(tree, revision, known) if known else {}
    now = slices(variant, known)
    same = {id for id in known if now[id] is not None and now[id] == before.get(id)}
    return set(otherwise) - same


def questions(variant: "Variant") -> Names:
    """The names of what is asked of systems as they are written."""
    store, systems = _store(), variant.systems()
    return {id: store.question(prop, systems) for id, prop in variant.properties().items()}


def slices(variant: "Variant", ids: Iterable[str]) -> Names:
    """The names of the slices that some properties depend on."""
    store, systems, stated = _store(), variant.systems(), variant.properties()
    by_system = sorted((stated[id].on, id) for id in ids if id in stated)
    return {id: store.slice(stated[id], systems) for _, id in by_system}


def _store() -> "VerdictStore":
    from rovercheck.checker.store.verdicts import VerdictStore

    return VerdictStore("any engine")


def _said(tree: RevisionTree, revision: str, ids: Iterable[str]) -> Names:
    """The names that the files of a revision have.  Raises ``UsageError``."""
    done = tree.run(MODULE, *filter(None, [tree.model]), given=json.dumps(list(ids)))
    try:
        found: Names = json.loads(done.stdout)
    except ValueError as error:
        raise UsageError(
            f"The properties of {revision} cannot be read, see above; write a later revision, or leave "
            "--changed out."
        ) from error
    return found


def main() -> None:
    """Print the names of the rover's properties, or of those of the model at a path, as JSON."""
    from rovercheck.checker.commands.shared.variant import pick_variant
    from rovercheck.spec_model.lang.errors import ModelError

    ids = json.load(sys.stdin)
    try:
        variant = pick_variant((), None, (), Path(sys.argv[1]) if len(sys.argv) > 1 else None)
        print(json.dumps(slices(variant, ids) if ids else questions(variant)))
    except (ModelError, UsageError) as error:
        print(error, file=sys.stderr)
        sys.exit(int(Exit.USAGE))


if __name__ == "__main__":
    main()
