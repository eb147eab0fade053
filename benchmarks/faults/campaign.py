"""All mutants of the boards against the recorded runs of the cross-check; what is known is not done again."""

import hashlib
import json
import pickle
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from benchmarks.faults.judged import judgements
from benchmarks.faults.mutate import Mutant, mutants
from benchmarks.faults.package import modules
from benchmarks.faults.recorded import Found, Run, prepared
from benchmarks.faults.worker import Answer, Runs, examine_all, loads
from benchmarks.measure import ROOT
from rovercheck.checker.cache import opened, sealed, secret
from rovercheck.checker.compare.check import recorded_suite

BOARDS = ("board1", "board2")
READ = ("supervisor", "spec_model", "checker/adapters", "checker/compare", "checker/testgen")
"""What the answers depend on."""
LOOK = 20
"""Runs of a board on which a judged mutant is tried all the same: the judgement might be wrong."""


@dataclass(frozen=True)
class State:
    """Where a campaign keeps its runs and answers: those of other sources or efforts are apart."""

    folder: Path
    examples: int | None

    @cached_property
    def here(self) -> Path:
        """The folder of these sources and this effort."""
        digest = hashlib.sha256(str(self.examples).encode())
        for part in READ:
            for file in sorted((ROOT / part).rglob("*")):
                if file.suffix in (".py", ".json"):
                    digest.update(file.read_bytes())
        here = self.folder / digest.hexdigest()[:16]
        here.mkdir(parents=True, exist_ok=True)
        return here

    def runs(self, board: str) -> list[Run]:
        """The recorded runs of a board, ready for replay; kept ones only if this user has written them."""
        file = self.here / f"{board}.pickle"
        name = f"{self.here.name}/{file.name} of the faults"
        with suppress(OSError):
            whole = opened(name, file.read_bytes(), secret(self.folder, make=False))
            if whole is not None:
                kept: list[Run] = pickle.loads(whole)
                return kept
        suite = recorded_suite(board, "ci", self.examples)
        plain = ((r.origin, [(dict(i), dict(e)) for i, e in r.steps(suite.board)]) for r in suite.runs)
        made = list(prepared(board, plain))
        with suppress(OSError):  # without a secret they are made every time
            file.write_bytes(sealed(name, pickle.dumps(made), secret(self.folder, make=True)))
        return made

    def answers(self) -> dict[str, Answer]:
        """What is known, by the name of the mutant."""
        file = self.here / "answers.jsonl"
        lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
        return {name: _decoded(answer) for name, answer in map(json.loads, lines)}

    def keep(self, mutant: Mutant, answer: Answer) -> None:
        """Note an answer."""
        plain = [answer.phase, answer.steps, answer.what] if isinstance(answer, Found) else answer
        with (self.here / "answers.jsonl").open("a", encoding="utf-8") as file:
            print(json.dumps([mutant.name, plain]), file=file)


def _decoded(answer: list[str | int] | int) -> Answer:
    if isinstance(answer, int):
        return answer
    phase, steps, what = answer
    return Found(str(phase), int(steps), str(what))


def of_the_boards() -> Iterator[Mutant]:
    """The mutants of everything that the boards are made of, the link left out."""
    return (
        m for name in modules() if not name.startswith("rovercheck.supervisor.link") for m in mutants(name)
    )


def campaign(
    state: State, todo: Sequence[Mutant], progress: Callable[[int, int], None]
) -> Mapping[str, Answer]:
    """The answer to each mutant that can be started, in the order given; ``progress``: done, of how many."""
    known = state.answers()
    left = [m for m in todo if m.name not in known]
    if left:
        runs = {board: state.runs(board) for board in BOARDS}
        short: Runs = {board: runs[board][:LOOK] for board in BOARDS}
        usable = [m for m in left if loads(m)]
        judged = [m for m in usable if m.name in judgements()]
        others = [m for m in usable if m.name not in judgements()]
        done = len(todo) - len(left)
        for part, with_runs in ((judged, short), (others, runs)):
            for mutant, answer in examine_all(part, with_runs):
                state.keep(mutant, answer)
                known[mutant.name] = answer
                done += 1
                progress(done, len(todo))
    return {m.name: known[m.name] for m in todo if m.name in known}
