"""Models as collectors of pytest: a node for each file with properties, an item for each property."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.commands.shared.failure import error_message
from rovercheck.checker.model import Model
from rovercheck.checker.model.execute import files_of
from rovercheck.checker.model.load import load
from rovercheck.checker.model.rover import rover
from rovercheck.checker.pytest_plugin.decisions import Decider
from rovercheck.checker.pytest_plugin.item import PropertyItem
from rovercheck.properties.forms import Property
from rovercheck.pytest_plugin import whole
from rovercheck.spec_model.lang.errors import ModelError

ROVER = "rover"


@dataclass
class ModelSource:
    """Where a model comes from (None: the rover); it is read when first asked for."""

    path: Path | None
    decider: Decider

    @cached_property
    def read(self) -> Model | ModelError:
        """The model, or what is wrong with it."""
        try:
            model = rover() if self.path is None else load(self.path)
            model.stated()
        except Exception as error:
            return error if isinstance(error, ModelError) else ModelError(error_message(error))
        return model

    @cached_property
    def by_file(self) -> dict[Path, list[Property]]:
        """The properties by the file of the model they are written in, else by the last one.

        Raises ``CollectError`` for a model that has no meaning.
        """
        if isinstance(self.read, ModelError):
            raise pytest.Collector.CollectError(str(self.read)) from self.read
        files = {file.resolve(): file for file in self.files}
        found: dict[Path, list[Property]] = {file: [] for file in files.values()}
        for prop in self.read.properties.values():
            written = Path(prop.place.file).resolve() if prop.place else None
            found[files[written] if written in files else self.files[-1]].append(prop)
        return found

    @property
    def files(self) -> list[Path]:
        """The files of the model; only its path if it has no meaning."""
        assert self.path is not None
        return [self.path] if isinstance(self.read, ModelError) else files_of(self.path)


@dataclass
class Models:
    """The models of a session: those that are configured, and with ``patterns`` those met on the way."""

    configured: Sequence[ModelSource]
    patterns: Sequence[str]
    decider: Decider
    _met: dict[Path, ModelSource] = field(default_factory=dict)

    def met(self, file: Path, parent: pytest.Collector) -> pytest.Collector | None:
        """The node of a file that pytest comes across, if it belongs to a model that is wanted."""
        for source in self.configured:
            if source.path is not None and source.path in (file, file.parent):
                mine = not whole(parent.config) and file in source.files
                return _node(parent, file, source) if mine else None
        if any(map(file.match, self.patterns)):
            source = self._met.setdefault(file, ModelSource(file, self.decider))
            return _node(parent, file, source)
        return None

    def meant(self, session: pytest.Session) -> Iterator[pytest.Collector]:
        """A node for each file of the configured models, unless the command line names what is meant."""
        for source in self.configured if whole(session.config) else ():
            if source.path is None:
                yield RoverNode.from_parent(session, name=ROVER, nodeid=ROVER, source=source)
            else:
                yield from (_node(session, file, source) for file in source.files)


def models_of(config: pytest.Config, named: Sequence[str], patterns: Sequence[str]) -> Models:
    """The models that the configuration names, relative to its file.

    Raises ``UsageError`` for options without meaning.
    """
    decider = Decider.of(config)
    base = config.inipath.parent if config.inipath else config.invocation_params.dir
    paths = [None if name == ROVER else base / name for name in dict.fromkeys(named)]
    return Models([ModelSource(path, decider) for path in paths], patterns, decider)


def _node(parent: pytest.Collector, file: Path, source: ModelSource) -> pytest.Collector:
    return ModelNode.from_parent(parent, path=file, source=source)


class ModelNode(pytest.File):
    """A file of a model."""

    def __init__(self, *, source: ModelSource, **rest: Any) -> None:
        super().__init__(**rest)
        self.source = source

    def collect(self) -> list[pytest.Item]:
        """An item for each property written there."""
        return _items(self, self.source, self.source.by_file.get(self.path, []))


class RoverNode(pytest.Collector):
    """The rover."""

    def __init__(self, *, source: ModelSource, **rest: Any) -> None:
        super().__init__(**rest)
        self.source = source

    def collect(self) -> list[pytest.Item]:
        """An item for each property."""
        assert isinstance(self.source.read, Model)
        return _items(self, self.source, list(self.source.read.properties.values()))


def _items(
    parent: pytest.Collector, source: ModelSource, properties: Sequence[Property]
) -> list[pytest.Item]:
    assert isinstance(source.read, Model)
    return [
        PropertyItem.from_parent(parent, name=p.id, prop=p, model=source.read, decider=source.decider)
        for p in properties
    ]
