"""Verdicts that are kept between commands: under what was asked, and under the slice that it depends on.

An entry is what one found out who asked the same question of the same code: a run as its inputs, which can be
replayed, or what a proof rests on.  It is sealed as compiled code is (``checker.cache.entries``): what others
wrote or changed counts as missing.  What is unknown is never kept.
"""

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from hashlib import sha256
from typing import TYPE_CHECKING, Any

from rovercheck.checker.cache import entries
from rovercheck.checker.cache.places import STORE
from rovercheck.checker.engines import Limits
from rovercheck.checker.results.trace import NecessaryInputs, Trace
from rovercheck.checker.results.verdict import StoredRun, Unknown, Verdict, Violated
from rovercheck.checker.store.content import ContentKeys, NoKey
from rovercheck.checker.store.verdict_json import Definite, entry, necessary_inputs, necessary_row, verdict
from rovercheck.checker.store.versions import as_loaded, deciding
from rovercheck.properties.forms import Property, Reachable, Unbounded
from rovercheck.spec_model.lang.system import FREE, System

if TYPE_CHECKING:
    from rovercheck.checker.store.slices import SliceTexts

SCHEMA = "rovercheck/stored-verdict/1"
_LARGEST = 4 << 20
"""Bytes of an entry."""


@dataclass(frozen=True)
class StoredVerdict:
    """A verdict that is kept, the name of the system that it is about, and what was searched with it."""

    verdict: Definite
    system: str
    together: tuple[str, ...] = ()

    def fits(self, prop: Property, systems: Mapping[str, System]) -> bool:
        """Whether it can be a verdict on that property: on its system, resting on what its form rests on.

        A proof may also be one of the system whose timers may expire at any time.
        """
        run = isinstance(self.verdict.because, StoredRun)
        about = self.system if run else self.system.removesuffix(FREE)
        if about not in (prop.on, systems[prop.on].concrete) or about not in systems:
            return False
        if run and systems[self.system].over:
            return False
        if isinstance(prop.form, Unbounded):
            return isinstance(self.verdict, Violated) or not run
        return run == (isinstance(self.verdict, Violated) != isinstance(prop.form, Reachable))


class StoredNames:
    """The names of the entries about a property, each made when it is asked for; None where there is none."""

    def __init__(self, store: "VerdictStore", prop: Property, systems: Mapping[str, System]) -> None:
        self._store, self._prop, self._systems = store, prop, systems

    @cached_property
    def question(self) -> str | None:
        """Of systems as they are written."""
        return self._store.question(self._prop, self._systems)

    @cached_property
    def slice(self) -> str | None:
        """Of the slices that the verdict depends on, which take a while to make."""
        return self._store.of_texts(self._prop, self._texts)

    @cached_property
    def own(self) -> str | None:
        """Of a system that has more runs than the one it stands for: of its slice alone.

        That is all that a proof depends on.
        """
        concrete = self._systems[self._prop.on].concrete
        return self._store.of_texts(self._prop, self._texts[:1]) if concrete else None

    @cached_property
    def before(self) -> str | None:
        """Of the latest run that was found, whatever the charts were."""
        return self._store.about("before", self._prop)

    @cached_property
    def _texts(self) -> list[str | None]:
        return self._store.texts(self._prop, self._systems)

    def fitting(self, found: Verdict, about_own: bool) -> tuple[str, ...]:
        """The names to keep a verdict under; ``about_own``: it is about the property's own system."""
        if isinstance(found, Unknown):
            return ()
        on_run = isinstance(found.because, Trace | StoredRun)
        own, before = about_own and not on_run, on_run
        names = self.question, self.slice, self.own if own else None, self.before if before else None
        return tuple(name for name in names if name is not None)


@dataclass
class VerdictStore:
    """What is kept of verdicts that one engine, or engines in turn, found within a depth.

    ``recheck``: what is kept is not believed before its run is replayed, or its certificate checked.
    """

    asked: str
    recheck: bool = False
    _keys: ContentKeys = field(default_factory=ContentKeys, repr=False)

    def __reduce__(self) -> tuple[object, ...]:
        return VerdictStore, (self.asked, self.recheck)

    def question(self, prop: Property, systems: Mapping[str, System]) -> str | None:
        """The name of the entry about a property of systems as they are written; None where there is none."""
        return self.about("question", prop, *(systems[name] for name in self._systems(prop, systems)))

    def about(self, kind: str, *values: object) -> str | None:
        """The name of an entry of some kind about some values; None where there is none."""
        try:
            return self._name(kind, self._keys.key(*values))
        except (NoKey, RecursionError, OSError):
            return None

    def slice(self, prop: Property, systems: Mapping[str, System]) -> str | None:
        """The name of the entry about the slices that the verdict depends on; None where there is none.

        Of a system that may leave a domain, what decides that belongs to it.
        """
        return self.of_texts(prop, self.texts(prop, systems))

    def texts(self, prop: Property, systems: Mapping[str, System]) -> list[str | None]:
        """The keys of the slices of the systems; one that cannot be read has none."""
        if isinstance(prop.form, Unbounded):
            return [None]
        try:
            named = self._systems(prop, systems)
            return [self._slices(replace(prop, on=name), systems[name]) for name in named]
        except (NoKey, RecursionError, OSError):
            return [None]

    @cached_property
    def _slices(self) -> "SliceTexts":
        from rovercheck.checker.store.slices import SliceTexts

        return SliceTexts(lambda system: self.about("values", system))

    def of_texts(self, prop: Property, texts: Sequence[str | None]) -> str | None:
        """The name of the entry about slices with these keys; None where one has none."""
        if None in texts:  # what cannot be read would not be part of the key
            return None
        return self.about("slice", replace(prop, on=""), *texts)

    @staticmethod
    def _systems(prop: Property, systems: Mapping[str, System]) -> list[str]:
        concrete = systems[prop.on].concrete
        return [prop.on, concrete] if concrete else [prop.on]

    def _name(self, kind: str, key: str) -> str:
        whole = "\n".join((SCHEMA, deciding(), self.asked, kind, key))
        return f"{sha256(whole.encode()).hexdigest()}-verdict-json"

    def read(self, name: str | None) -> StoredVerdict | None:
        """What is kept under a name; None where there is nothing that has a meaning."""
        if name is None:
            return None
        whole = entries.read(name, code=False)
        if whole is None:
            return None
        try:
            found: Any = json.loads(whole)
            return StoredVerdict(verdict(found), str(found["system"]), tuple(map(str, found["together"])))
        except entries.MEANINGLESS:
            return None

    def write(self, name: str | None, found: Verdict, system: str, together: Sequence[str] = ()) -> None:
        """Keep a verdict, if it is one and not too large."""
        if name is not None:
            self.write_under((name,), found, system, together)

    def write_under(
        self, names: Sequence[str], found: Verdict, system: str, together: Sequence[str] = ()
    ) -> None:
        """The same under several names."""
        if not names or not isinstance(found, Definite) or not as_loaded():
            return
        whole = json.dumps(entry(found, system, together), separators=(",", ":")).encode()
        for name in names if len(whole) <= _LARGEST else ():
            entries.write(name, whole)

    def necessary(self, name: str | None) -> NecessaryInputs | None:
        """The inputs that force the end of a run, as they are kept under a name."""
        whole = None if name is None or self.recheck else entries.read(name, code=False)
        try:
            return None if whole is None else necessary_inputs(json.loads(whole))
        except entries.MEANINGLESS:
            return None

    def write_necessary(self, name: str | None, found: NecessaryInputs) -> None:
        """Keep the inputs that force the end of a run."""
        if name is not None:
            entries.write(name, json.dumps(necessary_row(found), separators=(",", ":")).encode())

    def read_proof(self, name: str | None) -> bytes | None:
        """The certificates that are kept under a name."""
        return None if name is None else entries.read(name, code=False)

    def write_proof(self, name: str | None, certificates: bytes) -> None:
        """Keep certificates, unless they are too large."""
        if name is not None and len(certificates) <= _LARGEST:
            entries.write(name, certificates)

    def remove(self, name: str | None) -> None:
        """Keep nothing under a name."""
        if name is not None:
            entries.remove(name)


def store(engine: object, limits: Limits, recheck: bool = False) -> VerdictStore | None:
    """The store of what such searches find; None where verdicts are not kept, and for an engine of a user's.

    Seconds and memory do not matter: what they end is unknown.
    """
    if not isinstance(engine, str) or os.environ.get(STORE) == "":
        return None
    return VerdictStore(f"{engine} {limits.timers} {limits.depth} {limits.transitions}", recheck)
