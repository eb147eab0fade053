"""The examples in C: the sound one does what the firmware in Python does, the faulty twin does not."""

import re
import shlex
import sys
from contextlib import closing
from itertools import dropwhile, takewhile
from pathlib import Path
from textwrap import dedent

import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st

from rovercheck.checker.adapters import AdapterLimits, start
from rovercheck.checker.adapters.implementation import notes, run
from rovercheck.checker.adapters.python import start as start_python
from rovercheck.spec_model.abstraction import boards
from tests.profiles import examples

EXAMPLES = Path(__file__).parents[2] / "examples"
SOUND, FAULTY = EXAMPLES / "board1_c", EXAMPLES / "board1_c_faulty"
MAP = SOUND / "map.toml"
DOCS = EXAMPLES.parent / "docs" / "adapters.md"
BOARD = boards()["board1"]
AT_REST = BOARD.at_power_up()
STAMPS = ("last_valid_b2_ms", "b2_data_last_valid_ms", "temp_last_valid_ms", "batt_last_valid_ms")
STEP_MS = 20
FIRST_LIMIT_MS, LIMIT_MS = 4000, 5000
"""How long the temperature and the charge may stay critical."""
LIMITS = AdapterLimits(step=60, start=120)
pytestmark = pytest.mark.usefixtures("cc")


@pytest.fixture(scope="module")
def sound():
    with closing(start(f"c:{SOUND}", BOARD, LIMITS)) as started:
        yield started


@pytest.fixture(scope="module")
def faulty():
    with closing(start(f"c:{FAULTY},map={MAP}", BOARD, LIMITS)) as started:
        yield started


@pytest.fixture(scope="module")
def firmware():
    return start_python("rovercheck.supervisor.board1:Board1", BOARD, isolated=False)


levels = {
    "temperature_degC": st.sampled_from([-15.0, -14.9, -5.0, -4.9, 20.0, 54.9, 55.0, 59.9, 60.0, 64.5, 65.0]),
    "battery_pct": st.sampled_from([0.0, 14.9, 15.0, 15.1, 22.9, 23.0, 25.0, 25.1, 80.0]),
    "crit_mask_b2": st.sampled_from([0, 0, 0, 1, 2, 4, 8, 15]),
    "degr_mask_b2": st.sampled_from([0, 0, 1]),
    "isMotionConsistent": st.booleans(),
    **{f"hasNoFeedback_{wheel}": st.booleans() for wheel in ("FL", "FR", "RL", "RR")},
}
lengths = st.sampled_from([1, 2, 6, 7, 8, 25, 26, 149, 150, 151, 152, 199, 200, 201, 249, 250, 251, 252])
blocks = st.lists(
    st.tuples(lengths, st.fixed_dictionaries(levels), st.sets(st.sampled_from(STAMPS)), st.integers(1, 3)),
    min_size=1,
    max_size=12,
)


def held(blocks):
    """The inputs of blocks: so many steps of the same values, in which some sources are silent."""
    stamps, now, steps = dict.fromkeys(STAMPS, 0), 0, []
    for length, values, silent, period in blocks:
        for step in range(length):
            now += STEP_MS
            if step % period == 0:
                stamps |= {name: now for name in STAMPS if name not in silent}
            steps.append({**AT_REST, **values, **stamps, "now_ms": now})
    return steps


def differences(implementation, reference, steps):
    """The numbers of the steps in which they differ, each with what differs."""
    implementation.reset()
    reference.reset()
    pairs = zip(run(implementation, steps), run(reference, steps), strict=True)
    found = {
        number: {name for name, value in actual.items() if value != expected[name]}
        for number, (actual, expected) in enumerate(pairs, 1)
    }
    return {number: names for number, names in found.items() if names}


@examples(40)
@given(blocks=blocks)
def test_the_sound_one_does_what_the_firmware_does(sound, firmware, blocks):
    assert differences(sound, firmware, held(blocks)) == {}


def test_the_faulty_twin_is_found_by_held_inputs(faulty, firmware):
    def found(blocks):
        return bool(differences(faulty, firmware, held(blocks)))

    # It is not made shorter: that takes minutes.
    quick = settings(examples(60), derandomize=True, database=None, phases=[Phase.generate])
    first = min(differences(faulty, firmware, held(find(blocks, found, settings=quick))).items())
    assert first[0] > FIRST_LIMIT_MS // STEP_MS and first[1] & {"temp_status", "batt_status"}


def test_the_fault_is_one_step(sound, faulty, firmware):
    """A charge of 15 % is critical when it has been held for 5 s, not only after more than 5 s."""
    low = {**AT_REST, "battery_pct": 15.0, "temperature_degC": 20.0}
    steps = [{**low, **dict.fromkeys(("now_ms", *STAMPS), STEP_MS * k)} for k in range(1, 400)]
    assert differences(sound, firmware, steps) == {}
    late = LIMIT_MS // STEP_MS + 1
    found = differences(faulty, firmware, steps)
    assert found.pop(late) == {"batt_status", "critical_mask", "degraded_mask", "rover_safety_state"}
    assert found == {late + 1: {"rover_safety_state"}}  # it follows one step later


def test_the_examples_compile_without_a_warning(sound, faulty):
    for implementation in (sound, faulty):
        assert not [note for note in notes(implementation) if "warns" in note]


def test_the_twins_differ_in_one_line():
    sound, faulty = (folder / "sup_b1.c" for folder in (SOUND, FAULTY))
    pairs = zip(sound.read_text().splitlines(), faulty.read_text().splitlines(), strict=True)
    assert len([pair for pair in pairs if pair[0] != pair[1]]) == 1


def documented(after):
    """The first indented block of docs/adapters.md after some words."""
    lines = DOCS.read_text(encoding="utf-8").partition(after)[2].splitlines()
    block = takewhile(lambda line: line.startswith("    "), dropwhile(lambda line: line[:4] != "    ", lines))
    return dedent("\n".join(block))


def test_the_map_in_the_documentation_works(tmp_path):
    mapping = tmp_path / "map.toml"
    mapping.write_text(documented("## Your C supervisor in ten lines"), encoding="utf-8")
    for name in ("sup_b1.h", "sup_b1.c"):
        (tmp_path / name).write_text((SOUND / name).read_text())
    with closing(start(f"c:{tmp_path}", BOARD, LIMITS)) as started:
        assert started.step({**AT_REST, "battery_pct": 10.0}) == {"batt_status": 1}


def test_the_class_in_the_documentation_works(tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(documented("## Python classes"), encoding="utf-8")
    with closing(start(f"python:{file}:Supervisor", BOARD, LIMITS)) as started:
        assert started.step({**AT_REST, "now_ms": 120}) == {"give_b2_actuation": False}
        assert started.step({**AT_REST, "now_ms": 121}) == {"give_b2_actuation": True}


def test_the_command_in_the_documentation_works(tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(documented("The whole of a command:"), encoding="utf-8")
    with closing(start(f"command:{shlex.join([sys.executable, str(file)])}", BOARD, LIMITS)) as started:
        assert started.step({**AT_REST, "y_norm": 0.5}) == {"v_ref": 0.5}


@pytest.mark.parametrize("board", list(boards().values()), ids=lambda board: board.name)
def test_the_documentation_names_every_signal(board):
    text = DOCS.read_text(encoding="utf-8")
    for verb, names in {
        "reads": [s.name for s in board.inputs],
        "gives": [o.name for o in board.outputs],
    }.items():
        paragraph = text.partition(f"**{board.name} {verb}**")[2].partition("\n\n")[0]
        assert sorted(re.findall(r"`(\w+)`", paragraph)) == sorted(names)
