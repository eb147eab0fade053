"""Mutants run one after the other in a child process, which is killed when one of them does not end."""

import gc
import multiprocessing
import resource
import signal
import warnings
from collections.abc import Iterator, Mapping, Sequence
from multiprocessing.connection import Connection

from benchmarks.faults.mutate import Mutant
from benchmarks.faults.package import modules, replaced
from benchmarks.faults.recorded import Found, Run, search
from rovercheck.checker.adapters.launch import end_with_parent

MEMORY = 6 << 30
START, STEP = 20.0, 0.002
"""Seconds of the processor that a mutant gets, and more for each step: 50 times what it takes on the average.

One that takes longer is found by that, as by the time limit of an adapter.
"""
SILENCE = 1800.0
"""Seconds without an answer after which a child is given up."""
BATCH = 100
"""Mutants for one child; each leaves its classes behind."""
Runs = Mapping[str, Sequence[Run]]
Answer = Found | int
"""How the mutant was found, or the steps after which it was not."""


def boards_of(module: str) -> tuple[str, ...]:
    """The boards that a module of the supervisors belongs to."""
    part = module.split(".")[1]
    return (part,) if part in ("board1", "board2") else ("board1", "board2")


def loads(mutant: Mutant) -> bool:
    """Whether the package can be imported with the mutant in it, and both boards started."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            with replaced(mutant.module, mutant.source):
                from rovercheck.supervisor import Board1, Board2

                Board1(), Board2()
        except Exception:
            return False
    return True


def examine(mutant: Mutant, runs: Runs) -> Answer:
    """Runs a mutant on the boards that it belongs to."""
    done = 0
    for board in boards_of(mutant.module):
        with replaced(mutant.module, mutant.source):
            answer = search(board, runs[board])
        if isinstance(answer, Found):
            return Found(answer.phase, done + answer.steps, f"{board}: {answer.what}")
        done += answer
    return done


def examine_all(todo: Sequence[Mutant], runs: Runs) -> Iterator[tuple[Mutant, Answer]]:
    """Every mutant with its answer."""
    modules()
    gc.collect()
    gc.freeze()  # the recorded runs stay for good; the children share their memory
    left = list(todo)
    while left:
        receive, child = _start(left[:BATCH], runs)
        for mutant in left[:BATCH]:
            answer = _next(receive)
            left.pop(0)
            yield mutant, answer or Found("any", 0, "does not end, or exhausts memory")
            if answer is None:
                break
        child.kill()
        child.join()
        receive.close()


def _next(receive: Connection) -> Answer | None:
    try:
        if receive.poll(SILENCE):
            answer: Answer = receive.recv()
            return answer
    except EOFError:
        pass
    return None


def _start(batch: Sequence[Mutant], runs: Runs) -> tuple[Connection, multiprocessing.process.BaseProcess]:
    context = multiprocessing.get_context("fork")
    receive, send = context.Pipe(duplex=False)
    child = context.Process(target=_serve, args=(send, batch, runs), daemon=True)
    child.start()
    send.close()
    return receive, child


def _serve(send: Connection, batch: Sequence[Mutant], runs: Runs) -> None:
    end_with_parent()
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    warnings.simplefilter("ignore")
    patience = START + STEP * sum(len(run.steps) for of_board in runs.values() for run in of_board)
    for mutant in batch:
        signal.setitimer(signal.ITIMER_PROF, patience)  # its signal ends the process
        send.send(examine(mutant, runs))
