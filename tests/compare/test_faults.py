"""A few of the faults of ``benchmarks/faults``: the cross-check finds each; the whole list is run there."""

from collections.abc import Sequence

import pytest

from benchmarks.faults.by_hand import Fault, faults
from benchmarks.faults.hand_run import InProcess
from benchmarks.faults.judged import KINDS, judgements
from benchmarks.faults.mutate import path
from benchmarks.faults.package import importers, replaced
from benchmarks.faults.recorded import Found, Run, prepared, search
from rovercheck.checker.compare.beside import ComparedStep, compared, played
from rovercheck.checker.compare.stimulus import SILENT, Change, Every, InputBlock, Stimulus
from rovercheck.checker.compare.strategy import ENVIRONMENTS
from rovercheck.spec_model.abstraction import boards
from tests.faults import FaultSuite

Changes = dict[str, Change]


def calm(board: str, *blocks: tuple[int, Changes]) -> Stimulus:
    """Blocks of steps and changes after two calm steps."""
    made = (InputBlock(steps, tuple(changes.items())) for steps, changes in blocks)
    return Stimulus((InputBlock(2, ENVIRONMENTS[board].at_rest), *made))


FORWARD: Changes = {"y_norm": 1.0}
LOST: Changes = {"last_valid_b2_ms": SILENT}
BACK: Changes = {"last_valid_b2_ms": Every()}
RUNS: dict[str, Stimulus] = {
    "battery": calm(
        "board1", (2, {"battery_pct": 23.0}), (260, {"battery_pct": 10.0}), (2, {"battery_pct": 30.0}),
        (2, {"battery_pct": 22.75}),
    ),
    "relay": calm("board1", (10, LOST), (160, BACK)),
    "avoid": calm("board1", (2, FORWARD), (3, {"cmd": 4, "x_norm": -0.5}), (3, {"cmd": 0})),
    "half turn": calm(
        "board1", (3, {"y_norm": -1.0}), (3, {"current_yaw": 90.0}), (5, {"current_yaw": 175.0})
    ),
    "wheels": calm("board1", (2, {"hasNoFeedback_FL": True}), (2, {"isMotionConsistent": False})),
    "near": calm("board2", (3, {"d1": 71}), (3, {"d1": 70}), (3, {"d1": 301})),
    "driving": calm(
        "board2", (5, {"crit_mask_b1": 4, "ay_norm": 0.7}), (9, {"bx_norm": 0.3}), (4, {"crit_mask_b1": 5}),
        (9, {"crit_mask_b1": 4, "ay_norm": 0.0}),
    ),
}  # fmt: skip
BY_HAND = {
    "boundary, board1, Monitor_battery: < 23 becomes <= 23": "battery",
    "latch, board1, Monitor_battery: critical is never left": "battery",
    "rounding, board1, BatteryMonitor: the charge in whole percent": "battery",
    "timer, board1, Relay: > 3 s becomes >= 3 s": "relay",
    "missing return, board1, Motion_Supervision: an avoidance does not end": "avoid",
    "stale data, board1, MotionSupervision: the heading of the step before": "half turn",
    "swapped signals, board1, Fault_masks: front left and front right wheel": "wheels",
    "boundary, board2, Obstacles: 70 becomes 71": "near",
    "swapped signals, board2, Actuation: each side is ramped from the other": "driving",
    "stale data, board2, Board2: the payload of the step before": "driving",
    "rounding, board2, Actuation: speeds cut to whole rpm": "driving",
}
"""Some faults, and a run that must show them."""


def steps_of(board: str, name: str) -> list[ComparedStep]:
    return played(boards()[board], ENVIRONMENTS[board].fields, RUNS[name])


@pytest.fixture(scope="module")
def recorded() -> dict[str, Sequence[Run]]:
    """All runs above, as the real supervisors go through them; so they conform."""
    of_board: dict[str, list[str]] = {"board1": [], "board2": []}
    for name in RUNS:
        of_board["board2" if name in ("near", "driving") else "board1"].append(name)
    return {
        board: list(
            prepared(board, ((n, [(s.inputs, s.expected) for s in steps_of(board, n)]) for n in names))
        )
        for board, names in of_board.items()
    }


def test_there_are_forty_faults_of_ten_kinds_on_both_boards() -> None:
    assert len({str(fault) for fault in faults()}) == 40
    assert len({fault.kind for fault in faults()}) == 10
    assert {fault.board for fault in faults()} == {"board1", "board2"}


class TestByHand(FaultSuite):
    """The run beside the fault shows it."""

    FAULTS = tuple(BY_HAND)

    def killed(self, fault: str, patch: pytest.MonkeyPatch) -> bool:
        [found] = [f for f in faults() if str(f) == fault]
        return _differs(found, RUNS[BY_HAND[fault]])


def _differs(fault: Fault, run: Stimulus) -> bool:
    board = fault.varied()
    return compared(board, played(board, ENVIRONMENTS[board.name].fields, run), InProcess(fault)) is not None


# Module, the board on which it is found, and what is replaced by what.
MUTANTS = [
    ("rovercheck.supervisor.board1.relay", "board1", "steps(3)", "steps(4)"),
    ("rovercheck.supervisor.board1.monitors", "board1", "pct < 23", "pct <= 23"),
    (
        "rovercheck.supervisor.board1.laws",
        "board1",
        "max(user.omega_user, 0.0)",
        "max(user.omega_user, -1.0)",
    ),
    (
        "rovercheck.supervisor.board1.states",
        "board1",
        "Motion.EVITA_DESTRA: SupervisorCommand.CMD_AVOID_RIGHT",
        "0: 0",
    ),
    ("rovercheck.supervisor.board2.distances", "board2", "STOP_CM = 70", "STOP_CM = 71"),
    ("rovercheck.supervisor.board2.actuation", "board2", "v_ref - omega_ref", "v_ref + omega_ref"),
    (
        "rovercheck.supervisor.board2.classify",
        "board2",
        "b1_critical_mask & ~switch",
        "b1_critical_mask & switch",
    ),
    ("rovercheck.supervisor.types", "board1", "CRITICAL = 2", "CRITICAL = 3"),
]


@pytest.mark.parametrize(("module", "board", "old", "new"), MUTANTS)
def test_a_mutant_is_found(
    recorded: dict[str, Sequence[Run]], module: str, board: str, old: str, new: str
) -> None:
    source = path(module).read_text(encoding="utf-8")
    assert old in source
    with replaced(module, source.replace(old, new)):
        assert isinstance(search(board, recorded[board]), Found)


def test_the_supervisor_itself_is_not(recorded: dict[str, Sequence[Run]]) -> None:
    source = path("rovercheck.supervisor.types").read_text(encoding="utf-8")
    with replaced("rovercheck.supervisor.types", source):
        for board, runs in recorded.items():
            assert search(board, runs) == sum(len(run.steps) for run in runs)


def test_what_imports_a_module_is_loaded_anew_and_the_rest_is_not() -> None:
    anew = importers("rovercheck.supervisor.board1.relay")
    assert {
        "rovercheck.supervisor.board1.board",
        "rovercheck.supervisor.board1",
        "rovercheck.supervisor",
    } <= anew
    assert not any(name.startswith("rovercheck.supervisor.board2") for name in anew)


def test_every_judgement_names_a_line_that_exists() -> None:
    sources: dict[str, str] = {}
    for name, judgement in judgements().items():
        assert judgement.kind in KINDS and judgement.reason
        place, _, change = name.partition(": ")
        module = f"supervisor.{place.split()[0]}"
        if module not in sources:
            sources[module] = " ".join(path(module).read_text(encoding="utf-8").split())
        assert change.rsplit(" => ", 1)[0] in sources[module], name
