"""What every renderer promises; the test of a renderer inherits the suite of its kind."""

from inspect import signature
from typing import Any, ClassVar

import pytest

from rovercheck.checker.render import Renderer, renderers
from rovercheck.checker.results.format import Option
from rovercheck.spec_model.lang.errors import ModelError


class Suite:
    """Renders the whole zoo of a kind, twice; ``parse`` reads a document back or fails."""

    KIND: ClassVar[str]
    NAME: ClassVar[str]
    ZOO: ClassVar[dict[str, Any]]
    REFUSED: ClassVar[frozenset[str]] = frozenset()

    @property
    def renderer(self) -> Renderer:
        return renderers(self.KIND)[self.NAME]

    def shown(self, name: str) -> str:
        found = self.renderer.render(self.ZOO[name])
        return found if isinstance(found, str) else found.decode()

    def parse(self, document: str) -> Any:
        raise NotImplementedError

    def test_describes_itself(self) -> None:
        shown = self.renderer.FORMAT
        assert (shown.kind, shown.name) == (self.KIND, self.NAME)
        assert shown.suffix.startswith(".")
        assert shown.summary and "\n" not in shown.summary
        parameters = signature(self.renderer.render).parameters
        assert shown.takes == {o for o in Option if o.value in parameters}
        assert bool(shown.beside) == ("dump" in parameters)

    def test_reads_back(self, name: str) -> None:
        self.parse(self.shown(name))

    def test_is_the_same_every_time(self, name: str) -> None:
        assert self.shown(name) == self.shown(name)

    def test_ends_with_a_line_end(self, name: str) -> None:
        assert self.shown(name).endswith("\n")

    def test_refusals_say_what_to_do(self) -> None:
        for name in self.REFUSED:
            with pytest.raises(ModelError, match=r"[Uu]se|[Pp]roject"):
                self.renderer.render(self.ZOO[name])

    def __init_subclass__(cls) -> None:
        if hasattr(cls, "ZOO"):
            names = pytest.mark.parametrize("name", [n for n in cls.ZOO if n not in cls.REFUSED])
            for test in ("test_reads_back", "test_is_the_same_every_time", "test_ends_with_a_line_end"):
                setattr(cls, test, names(_copied(getattr(Suite, test))))


def _copied(function: Any) -> Any:
    """A function of its own for each suite, as marks are kept on functions."""

    def test(self: Any, name: str) -> None:
        function(self, name)

    return test
