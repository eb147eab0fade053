"""The one name that is ours alone: through it our packages are found where others bear their names, too.

A repository may have folders called ``checker``, ``properties`` or ``supervisor`` of its own, which Python
finds before what is installed when it is started there.
"""

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from types import ModuleType

HOME = str(Path(__file__).resolve().parents[1])
"""The folder that holds this package and the others."""
NAMES = ("checker", "properties", "spec_model", "supervisor")


class _Finder(MetaPathFinder):
    """Finds our packages beside this one, wherever else modules are looked for."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        return PathFinder.find_spec(fullname, [HOME]) if fullname in NAMES else None


_finder = _Finder()
_ours: dict[str, ModuleType] = {}
"""Our packages, as they were imported first."""
_aside: dict[str, ModuleType] = {}
"""Our modules while their names belong to others."""


def claim() -> None:
    """Make the names ours in the whole process, which is one of ours."""
    if _finder not in sys.meta_path:
        sys.meta_path.insert(0, _finder)


@contextmanager
def own() -> Iterator[None]:
    """Make the names ours inside; for a process of others, such as a session of pytest.

    Afterwards they mean what they meant before; our modules are kept for the next time.
    """
    if _finder in sys.meta_path:
        yield
        return
    swapped = [name for name in NAMES if not _is_ours(name)]
    theirs = _taken(swapped)
    sys.modules.update(_aside)
    sys.meta_path.insert(0, _finder)
    try:
        yield
    finally:
        sys.meta_path.remove(_finder)
        _ours.update({name: sys.modules[name] for name in NAMES if name in sys.modules})
        _aside.clear()
        _aside.update(_taken(swapped))
        sys.modules.update(theirs)


def _is_ours(name: str) -> bool:
    """Whether the name now means our package, the same as ever."""
    found = sys.modules.get(name)
    if found is None or name in _ours:
        return found is not None and found is _ours.get(name)
    return HOME in (str(Path(place).resolve().parent) for place in getattr(found, "__path__", ()))


def _taken(heads: Sequence[str]) -> dict[str, ModuleType]:
    """The modules of these packages, which are taken out of those imported."""
    names = [n for n in sys.modules if n.partition(".")[0] in heads]
    return {n: sys.modules.pop(n) for n in names}
