"""Sees that the files of a model are saved, and survives that their folder comes and goes."""

from collections.abc import Callable
from pathlib import Path
from threading import Event, Thread

from watchfiles import Change, watch

from rovercheck.checker.model import shown

PAUSE = 1.0
"""Seconds until a folder that is not there is looked for again."""


class ModelWatch:
    """A thread that calls ``saved`` after a Python or TOML file of a model has changed.

    ``trouble`` is told what keeps it from seeing that; once the folder is there again, ``saved`` is called.
    """

    def __init__(self, path: Path, saved: Callable[[], None], trouble: Callable[[str], None]) -> None:
        self._folder = path if path.is_dir() else path.parent
        self._folder = self._folder.absolute()
        self._saved, self._trouble = saved, trouble
        self._stop = Event()
        self._thread = Thread(target=self._watch, name="watch", daemon=True)

    def start(self) -> None:
        """Begin to watch."""
        self._thread.start()

    def stop(self) -> None:
        """Watch no longer."""
        self._stop.set()
        self._thread.join()

    def _watch(self) -> None:
        there = True
        while not self._stop.is_set():
            if not self._folder.is_dir():
                there = False
                where = shown(self._folder)
                self._trouble(
                    f"The folder {where} is gone; what was read from it last stays here until it is back."
                )
                self._stop.wait(PAUSE)
                continue
            if not there:
                self._saved()
            there = True
            self._until_gone()

    def _until_gone(self) -> None:
        """Watch the folder as long as it is there."""
        node = self._folder.stat().st_ino
        try:
            for changes in watch(
                self._folder,
                watch_filter=_concerns,
                stop_event=self._stop,
                rust_timeout=1000,
                yield_on_timeout=True,
                recursive=False,
                raise_interrupt=False,
            ):
                if not self._folder.is_dir() or self._folder.stat().st_ino != node:
                    if self._folder.is_dir():  # replaced by another of the same name
                        self._saved()
                    return
                if changes:
                    self._saved()
        except (OSError, RuntimeError) as error:
            if self._folder.is_dir():
                self._trouble(f"Changes of {shown(self._folder)} cannot be seen: {error}")
            self._stop.wait(PAUSE)


def _concerns(_: Change, path: str) -> bool:
    return path.endswith((".py", ".toml"))
