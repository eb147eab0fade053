"""Every adapter keeps the contract, whatever the implementation does: one suite, inherited."""

import math
import os
import shlex
import signal
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.adapters import AdapterLimits, adapters, start
from rovercheck.checker.adapters.implementation import ImplementationError, notes, run
from rovercheck.checker.adapters.python import start as start_python
from rovercheck.spec_model.abstraction import boards
from tests.adapters.adapters_counter import TELL
from tests.profiles import examples

HERE = Path(__file__).parent
COUNTER = HERE / "adapters_counter.py"
BOARD = boards()["board1"]
AT_REST = BOARD.at_power_up()
ACTIONS = (0, 6, 7)
PATIENT = AdapterLimits(step=60, start=120, memory=1 << 28)
IMPATIENT = AdapterLimits(step=3, start=120, memory=1 << 28)
OUTPUTS = {"critical_mask", "v_ref", "v_user", "give_b2_actuation", "current_action", "omega_user"}
single = st.floats(width=32, allow_nan=False)
inputs = st.builds(
    lambda x, battery, button, action: {
        **AT_REST, "x_norm": x, "battery_pct": battery, "btn1": button, "cmd": action
    },
    st.floats(allow_nan=False), single, st.booleans(), st.sampled_from(ACTIONS),
)  # fmt: skip


def trapped(number):
    return {**AT_REST, "temperature_degC": 1000 + number}


def alive(pid):
    """Whether a process still runs; one that only waits to be collected does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def soon(condition, seconds=30):
    """Whether something becomes true: killing is not instantaneous."""
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    return condition()


def ended(pid):
    return soon(lambda: not alive(pid))


@pytest.fixture(scope="class")
def counter(request):
    """One that the tests of a class share."""
    with request.cls.open() as started:
        yield started


@pytest.fixture(scope="class")
def shared_object(request, cc, tmp_path_factory):
    """A library whose name for the loader says nothing about where it is."""
    made = tmp_path_factory.mktemp("library") / "libcounter.so"
    source, name = HERE / "adapters_counter.c", "-Wl,-soname,libother.so.1"
    subprocess.run([cc, "-shared", "-fPIC", "-o", made, source, name], check=True)
    request.cls.address = f"c:{made},map={source.with_suffix('.toml')}"


class Contract:
    """What every implementation does that was started by an adapter."""

    address: str

    @classmethod
    def open(cls, limits=PATIENT):
        return closing(start(cls.address, BOARD, limits))

    def test_it_starts_at_power_up_and_returns_there(self, counter):
        counter.reset()
        assert [counter.step(AT_REST)["critical_mask"] for _ in range(3)] == [1, 2, 3]
        counter.reset()
        counter.reset()
        assert counter.step(AT_REST)["critical_mask"] == 1

    def test_outputs_may_be_missing(self, counter):
        counter.reset()
        assert set(counter.step(AT_REST)) == OUTPUTS < {o.name for o in BOARD.outputs}

    def test_values_pass_unchanged_one_by_one_and_in_a_row(self, counter):
        @examples(15)
        @given(steps=st.lists(inputs, max_size=20))
        def unchanged(steps):
            counter.reset()
            one_by_one = [dict(counter.step(step)) for step in steps]
            counter.reset()
            in_a_row = [dict(found) for found in run(counter, steps)]
            for found in (*one_by_one, *in_a_row):
                found.pop("omega_user")  # the process
            assert one_by_one == in_a_row == [self.repeated(n, step) for n, step in enumerate(steps, 1)]

        unchanged()

    def repeated(self, number, step):
        return {
            "critical_mask": number,
            "v_ref": step["x_norm"],
            "v_user": step["battery_pct"],
            "give_b2_actuation": step["btn1"],
            "current_action": step["cmd"],
        }

    @pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -0.0, 5e-324])
    def test_floats_that_json_may_not_have(self, counter, value):
        counter.reset()
        [found] = run(counter, [{**AT_REST, "x_norm": value}])
        assert repr(found["v_ref"]) == repr(value)

    def test_it_can_be_closed_twice(self):
        with self.open() as started:
            started.close()


class Isolated(Contract):
    """What else is true of an implementation in a process of its own."""

    crash, abort, leave = "SIGSEGV", "SIGABRT", "ended with status 0"

    @pytest.mark.parametrize(("trap", "cause"), list(enumerate(("crash", "abort", "leave"))))
    def test_an_end_is_one_error_and_a_reset_starts_afresh(self, counter, trap, cause):
        counter.reset()
        pid = int(counter.step(AT_REST)["omega_user"])
        with pytest.raises(ImplementationError) as caught:
            run(counter, [AT_REST, trapped(trap), AT_REST])
        assert str(caught.value).startswith(f"{self.address}: step 3: ")
        assert getattr(self, cause) in str(caught.value)
        assert ended(pid)
        with pytest.raises(ImplementationError, match="reset it first"):
            counter.step(AT_REST)
        counter.reset()
        assert counter.step(AT_REST)["critical_mask"] == 1

    def test_a_step_without_end_is_ended(self):
        with self.open(IMPATIENT) as started:
            pid = int(started.step(AT_REST)["omega_user"])
            with pytest.raises(ImplementationError, match="step 2: the process did not answer within 3 s"):
                started.step(trapped(3))
            assert ended(pid)

    def test_memory_is_limited(self):
        with self.open() as started, pytest.raises(ImplementationError, match="step 1: ") as caught:
            started.step(trapped(4))
        assert "did not answer" not in str(caught.value)

    def test_nothing_is_left_when_it_is_closed(self):
        with self.open() as started:
            pid = int(started.step(AT_REST)["omega_user"])
            assert alive(pid)
        assert ended(pid)
        for use in (started.reset, lambda: started.step(AT_REST)):
            with pytest.raises(ImplementationError):
                use()

    @pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
    def test_nothing_is_left_when_we_are_ended(self, how, tmp_path):
        """Ctrl-C in the middle of a step without end; or no time to do anything."""
        program = (
            "from tests.adapters.test_adapters import *\n"
            f"started = start({self.address!r}, BOARD, PATIENT)\n"
            "print(int(started.step(AT_REST)['omega_user']), flush=True)\n"
            "started.step(trapped(3))\n"
        )
        hangs, root = tmp_path / "hangs", HERE.parents[1]
        environment = {**os.environ, TELL: str(hangs), "PYTHONPATH": str(root), "TMPDIR": str(tmp_path)}
        with subprocess.Popen(
            [sys.executable, "-c", program],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=root,
            env=environment,
            text=True,
        ) as parent:
            assert parent.stdout is not None
            pid = int(parent.stdout.readline())
            assert soon(hangs.exists) and alive(pid)
            parent.send_signal(how)
        assert parent.returncode == -how
        assert ended(pid)


class TestPython(Isolated):
    address = f"python:{COUNTER}:Counter"


class TestPythonInThisProcess(Contract):
    @classmethod
    def open(cls, limits=PATIENT):
        return closing(start_python(f"{COUNTER}:Counter", BOARD, limits, isolated=False))


class TestCommand(Isolated):
    address = f"command:{shlex.join([sys.executable, str(COUNTER)])}"


@pytest.mark.usefixtures("cc")
class TestC(Isolated):
    address = f"c:{HERE / 'adapters_counter.c'}"


@pytest.mark.usefixtures("shared_object")
class TestSharedObject(Isolated):
    pass


def test_adapters_are_found_and_describe_themselves():
    found = adapters()
    assert {"python", "c", "command"} <= set(found)
    for kind, adapter in found.items():
        assert adapter.KIND == kind and adapter.FORM.startswith(f"{kind}:")
        assert adapter.SUMMARY and "\n" not in adapter.SUMMARY


@pytest.mark.parametrize("address", ["", "c", "python:", "pyhton:x:Y", "rovercheck.supervisor.board1:Board1"])
def test_an_address_without_meaning_shows_what_to_write(address):
    with pytest.raises(ImplementationError) as caught:
        start(address, BOARD)
    for adapter in adapters().values():
        assert adapter.FORM in str(caught.value) and adapter.SUMMARY in str(caught.value)
    assert ("Did you mean 'python'?" in str(caught.value)) == (address == "pyhton:x:Y")


def test_most_implementations_have_nothing_to_note():
    with closing(start_python(f"{COUNTER}:Counter", BOARD, PATIENT, isolated=False)) as started:
        assert notes(started) == ()
