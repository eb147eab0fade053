"""What a map says of values that are not held as charts have them: codes, bits, counters, units."""

from contextlib import closing

import pytest

from rovercheck.checker.adapters import AdapterLimits, start
from rovercheck.checker.adapters.implementation import ImplementationError, notes
from rovercheck.spec_model.abstraction import boards

BOARD = boards()["board1"]
AT_REST = BOARD.at_power_up()
SOURCE = """
#include <stdint.h>
#define RAW_SCALE 0.1
#define RAW_OFFSET (-40)
#define FLAG_STOP 0x10u
enum raw { RAW_OK = 3, RAW_WARN = 4, RAW_BAD = 40, RAW_NONE = 99 };
union word { uint32_t whole; struct { uint8_t low, high; } part; };
struct { int16_t raw; uint16_t ticks; uint8_t seq; uint8_t flags; unsigned key : 1, mode : 3;
         union word word; uint8_t faults[4]; float kelvin; uint32_t stamp; } in;
struct { enum raw level; uint8_t flags; double v; float nan; uint16_t ticks; uint8_t seq, bits; } out;
static int steps;
void init(void) { out.level = RAW_NONE; in.flags = 0x81; }
void step(void) {
    steps++;
    if (steps > 1) out.level = in.raw == 0 ? RAW_OK : in.raw < 0 ? RAW_WARN : RAW_BAD;
    if (steps > 4) out.level = RAW_NONE;
    out.v = in.raw; out.nan = steps > 1 ? 0.5f : __builtin_nanf(""); out.flags = in.flags;
    out.ticks = in.ticks; out.seq = in.seq;
    out.bits = (uint8_t)(in.key | in.mode << 1 | in.faults[2] << 4);
}
"""
HEAD = 'initialize = "init"\nstep = "step"\nheader = "all.c"\nsources = ["none.c"]\n'
INPUT = '[inputs]\ntemperature_degC = { at = "in.raw", scale = "RAW_SCALE", offset = "RAW_OFFSET" }\n'
LEVELS = '{ at = "out.level", values = { TEMP_HEALTH_OK = ["RAW_OK", "RAW_WARN"], TEMP_HEALTH_CRITICAL = 40 }'

pytestmark = pytest.mark.usefixtures("cc")


@pytest.fixture
def opened(tmp_path):
    """Compile and start the source with a mapping file."""

    def opened(mapping, source=SOURCE, none="typedef int none;\n"):
        (tmp_path / "all.c").write_text(source, encoding="utf-8")
        (tmp_path / "none.c").write_text(none, encoding="utf-8")
        (tmp_path / "map.toml").write_text(HEAD + mapping, encoding="utf-8")
        return closing(start(f"c:{tmp_path}", BOARD, AdapterLimits(step=60, start=120)))

    return opened


def stepped(opened, mapping, *steps):
    """The outputs of steps with these inputs."""
    with opened(mapping) as started:
        return [started.step({**AT_REST, **one}) for one in steps]


def refused(opened, mapping, *steps):
    with pytest.raises(ImplementationError) as error:
        stepped(opened, mapping, *steps)
    return " ".join(str(error.value).split())


def test_several_codes_of_one_member_and_those_of_no_value_yet(opened):
    mapping = INPUT + "[outputs]\ntemp_status = " + LEVELS + ', not_yet = ["RAW_NONE"] }\nv_ref = "out.v"\n'
    degrees = [{"temperature_degC": t} for t in (-40, -40, -40.1, 0, 0)]
    found = stepped(opened, mapping, *degrees)
    assert [one.get("temp_status") for one in found] == [None, 0, 0, 2, None]
    assert [one["v_ref"] for one in found[:4]] == [0, 0, -1, 400]


def test_without_not_yet_such_a_code_is_no_answer(opened):
    assert "out.level is 99, which the mapping file does not explain" in refused(
        opened, INPUT + "[outputs]\ntemp_status = " + LEVELS + " }\n", {"temperature_degC": -40}
    )


def test_no_number_is_no_value_yet(opened):
    mapping = (
        INPUT + '[outputs]\nv_ref = { at = "out.nan", not_yet = "__builtin_nan(\\"\\")" }\nv_user = "out.v"\n'
    )
    first, second = stepped(opened, mapping.replace('\\"', '\\"'), *[{"temperature_degC": -40}] * 2)
    assert "v_ref" not in first and second["v_ref"] == 0.5


def test_bits_of_a_word_keep_the_others(opened):
    mapping = (
        '[inputs]\nbtn1 = { at = "in.flags", mask = "FLAG_STOP" }\nbtn2 = { at = "in.flags", mask = 2 }\n'
        '[outputs]\ncritical_mask = "out.flags"\nb2_critical = { at = "out.flags", mask = "FLAG_STOP" }\n'
    )
    found = stepped(opened, mapping, {"btn1": True}, {"btn2": True}, {"btn1": True, "btn2": True})
    assert [one["critical_mask"] for one in found] == [0x91, 0x83, 0x93]
    assert [one["b2_critical"] for one in found] == [True, False, True]


def test_bit_fields_elements_and_members_of_unions(opened):
    mapping = (
        '[inputs]\nbtn1 = "in.key"\ncmd = "in.mode"\ncrit_mask_b2 = "in.faults[2]"\n'
        'degr_mask_b2 = "in.word.part.low"\n[outputs]\ncritical_mask = "out.bits"\n'
        'degraded_mask = "in.word.whole"\n'
    )
    [found] = stepped(opened, mapping, {"btn1": True, "cmd": 5, "crit_mask_b2": 9, "degr_mask_b2": 7})
    assert found["critical_mask"] == 1 | 5 << 1 | 9 << 4 and found["degraded_mask"] == 7


def test_a_clock_of_16_bits_and_an_alive_counter_of_8(opened):
    mapping = (
        '[inputs]\nnow_ms = { at = "in.ticks", scale = 20, wraps = true }\n'
        'last_valid_b2_ms = { at = "in.stamp", counter = "in.seq" }\n'
        'b2_data_last_valid_ms = { counter = "in.faults[0]" }\n'
        '[outputs]\ncritical_mask = "out.seq"\nv_ref = "out.ticks"\ndegraded_mask = "in.faults[0]"\n'
    )
    stamps = [0, 7, 7, *range(8, 8 + 300)]
    found = stepped(
        opened, mapping, *({"now_ms": 20 * (65534 + n), "last_valid_b2_ms": s} for n, s in enumerate(stamps))
    )
    assert [one["v_ref"] for one in found[:4]] == [65534, 65535, 0, 1]
    assert [one["critical_mask"] for one in found[:4]] == [0, 1, 1, 2]
    assert found[-1]["critical_mask"] == 301 % 256 and found[-1]["degraded_mask"] == 0


def test_units_of_the_code(opened):
    mapping = (
        '[inputs]\ntemperature_degC = { at = "in.kelvin", unit = "K" }\n[outputs]\nv_ref = "in.kelvin"\n'
    )
    assert stepped(opened, mapping, {"temperature_degC": 20})[0]["v_ref"] == 293.15
    millis = '[inputs]\nnow_ms = { at = "in.stamp", unit = "us" }\n[outputs]\nv_ref = "in.stamp"\n'
    assert stepped(opened, millis, {"now_ms": 40})[0]["v_ref"] == 40_000


@pytest.mark.parametrize(
    ("mapping", "said"),
    [
        ('temperature_degC = { at = "in.raw", unit = "rpm" }', "unit = 'rpm' does not become °C; write one"),
        ('temperature_degC = { at = "in.raw", scale = "ZERO" }', "ZERO"),
        ('temperature_degC = { at = "in.raw", scale = "RAW_OFFSET + 40" }', "scale RAW_OFFSET + 40 is 0"),
        ('temperature_degC = { at = "in.raw", mask = 1 }', "mask is of a truth value alone"),
        ('temperature_degC = { at = "in.raw", counter = "in.seq" }', "temperature_degC is none"),
        ('temperature_degC = { at = "in.raw", wraps = true }', "wraps = true is of a time stamp"),
        ('btn1 = { at = "in.key", not_yet = 1 }', "not_yet has a meaning in [outputs] only"),
        ('cmd = { at = "in.mode", values = { CMD_STOP = [] } }', "CMD_STOP = [] holds no constant"),
        ('cmd = { at = "in.mode", values = { CMD_STOP = [1, 2], CMD_ESTOP = 2 } }', "gives 2 for two"),
    ],
)  # fmt: skip
def test_keys_without_meaning(opened, mapping, said):
    assert said in refused(opened, f'[inputs]\n{mapping}\n[outputs]\nv_ref = "out.v"\n', {})


def test_warnings_are_one_line_and_all_of_them_below(opened):
    none = "static int idle(void) { return 1; }\nstatic int more(void) { int unused; return 2; }\n"
    with opened(INPUT + '[outputs]\nv_ref = "out.v"\n', none=none) as started:
        [said] = [note for note in notes(started) if "warning" in note.splitlines()[0] and "-v" in note]
    first, *lines = said.splitlines()
    assert "3 warnings, first: none.c:" in first and first.endswith("; all that it says with -v")
    assert sum("warning:" in line for line in lines) == 3
