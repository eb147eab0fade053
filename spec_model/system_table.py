"""Systems listed by name, of which each is built when it is first asked for."""

from collections.abc import Callable, Iterable, Iterator, Mapping

from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import System

Builder = Callable[[], System]


class SystemTable(Mapping[str, System]):
    """Systems by name, in the order in which they are listed.

    One that takes a while to build is listed by its name and by what builds it, which is called once, when
    the system is first asked for.  Raises ``ModelError`` for a name used twice, and then for a system that
    has another name than it is listed by.

    >>> table = SystemTable(("door", lambda: System("door", ())))
    >>> list(table), table["door"].name
    (['door'], 'door')
    """

    def __init__(self, *listed: System | tuple[str, Builder]) -> None:
        self._built = {one.name: one for one in listed if isinstance(one, System)}
        self._builders = {one[0]: one[1] for one in listed if not isinstance(one, System)}
        self._names = unlike(one.name if isinstance(one, System) else one[0] for one in listed)

    def __getitem__(self, name: str) -> System:
        if name not in self._built:
            system = self._builders[name]()
            if system.name != name:
                raise ModelError(f"The system listed as {name!r} is named {system.name!r}; list it by that.")
            self._built[name] = system
        return self._built[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __contains__(self, name: object) -> bool:
        return name in self._built or name in self._builders


def unlike(names: Iterable[str]) -> tuple[str, ...]:
    """The names of some systems.  Raises ``ModelError`` for one used twice."""
    found: dict[str, None] = {}
    for name in names:
        if name in found:
            raise ModelError(f"Two systems are named {name!r}; rename one of them.")
        found[name] = None
    return tuple(found)
