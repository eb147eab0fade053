"""Imports between the files of one model, which no other model and no installed package gets to see.

The files of a folder are the modules of a package with a name of its own.  They may import each other
as `from .signals import x` or `from signals import x`; what is installed keeps its name.
"""

import importlib
import os
import site
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import spec_from_file_location
from itertools import count
from pathlib import Path
from types import CodeType, ModuleType

from rovercheck.checker.io.printable import PrintableStream

_TAKEN = (*sys.stdlib_module_names, "rovercheck", "__main__")
_numbers = count(1)


class _Source(SourceFileLoader):
    """Compiles a file each time: bytecode kept on disk may be older than an edit of the same second."""

    def get_code(self, fullname: str) -> CodeType:
        path = self.get_filename(fullname)
        source = self.get_data(path)
        if b"\0" in source:  # a ValueError before Python 3.11.4
            raise SyntaxError("source code string cannot contain null bytes", (path, None, None, None))
        code: CodeType = self.source_to_code(source, path)
        return code


class _Alias(Loader):
    """Loads under a plain name what is a module of the package."""

    def __init__(self, real: str) -> None:
        self._real = real

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        sys.modules[module.__name__] = importlib.import_module(self._real)


class Neighbours(MetaPathFinder):
    """Finds the modules of one folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.absolute()
        self.package = f"<rovercheck model {next(_numbers)}>"  # what nobody can import by chance

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        head, _, rest = fullname.partition(".")
        if head == self.package:
            return self._spec(fullname, rest.split("."))
        if self._file(fullname.split(".")) is None or installed(head):
            return None
        return ModuleSpec(fullname, _Alias(f"{self.package}.{fullname}"))

    def _spec(self, fullname: str, parts: Sequence[str]) -> ModuleSpec | None:
        file = self._file(parts)
        if file is None:
            return None
        below = [str(file.parent)] if file.name == "__init__.py" else None
        loader = _Source(fullname, str(file))
        return spec_from_file_location(fullname, file, loader=loader, submodule_search_locations=below)

    def _file(self, parts: Sequence[str]) -> Path | None:
        place = self.folder.joinpath(*parts)
        options = (place.with_name(f"{place.name}.py"), place / "__init__.py")
        return next((file for file in options if file.is_file()), None)

    def module(self, file: Path) -> ModuleType:
        """Run a file of the folder, unless another has imported it, and return its module."""
        return importlib.import_module(f"{self.package}.{file.stem}")

    def hidden(self) -> set[str]:
        """The names of installed modules that files of this folder bear too."""
        return {f.stem for f in self.folder.glob("*.py") if installed(f.stem)}

    @contextmanager
    def importing(self) -> Iterator[None]:
        """Make the modules known inside; what they print goes to standard error, escaped."""
        root = ModuleType(self.package)
        root.__path__ = [str(self.folder)]
        before = {n: sys.modules.pop(n) for n in list(sys.modules) if self._alias(n)}
        sys.modules[self.package] = root
        sys.meta_path.insert(0, self)
        try:
            said = None if sys.stderr is None else PrintableStream(sys.stderr)
            with redirect_stdout(said), redirect_stderr(said), _no_results():
                yield
        finally:
            sys.meta_path.remove(self)
            for name in [n for n in sys.modules if self._alias(n)]:
                del sys.modules[name]
            sys.modules.update(before)

    def _alias(self, name: str) -> bool:
        """Whether inside the name means, or is below, a file of this folder."""
        head = name.partition(".")[0]
        return head != self.package and self._file([head]) is not None and not installed(head)


@contextmanager
def _no_results() -> Iterator[None]:
    """What programs print that a model starts goes to standard error: programs read our results."""
    try:
        results = os.dup(1)
    except OSError:  # there is no standard output
        yield
        return
    try:
        with suppress(OSError):
            os.dup2(2, 1)
        yield
    finally:
        os.dup2(results, 1)
        os.close(results)


def installed(name: str) -> bool:
    """Whether a plain name belongs to Python, to rovercheck or to an installed package."""
    if name in _TAKEN:
        return True
    places = [*site.getsitepackages(), site.getusersitepackages()]
    return PathFinder.find_spec(name, places) is not None
