"""C supervisors: every way to hold signals, and what is said of code and mapping files that do not fit."""

from contextlib import closing

import pytest

from rovercheck.checker.adapters import AdapterLimits, start
from rovercheck.checker.adapters.implementation import ImplementationError, notes
from rovercheck.spec_model.abstraction import boards

BOARD = boards()["board1"]
AT_REST = BOARD.at_power_up()
LIMITS = AdapterLimits(step=60, start=120)
HEADER = """
#include <stdint.h>
typedef enum { LEVEL_OK, LEVEL_BAD = 9 } level_t;
struct wheel { float rpm; _Bool silent; };
struct sensors {
    struct wheel wheel[4]; double degc; uint8_t percent; uint16_t decipercent; int32_t clock : 20;
    const int fixed; int *pointer; level_t command;
};
extern struct sensors rtU;
extern float rtY_v; extern double rtY_omega; extern uint8_t rtY_mask; extern level_t rtY_level;
void sup_init(void);
void sup_step(void);
"""
SOURCE = """
#include "sup.h"
struct sensors rtU;
float rtY_v; double rtY_omega; uint8_t rtY_mask; level_t rtY_level;
void sup_init(void) { rtY_mask = 5; }
void sup_step(void) { rtY_v = rtU.wheel[2].rpm; rtY_omega = rtU.degc; rtY_level = rtU.command; }
"""
HEAD = 'header = "sup.h"\ninitialize = "sup_init"\nstep = "sup_step"\n'
INPUTS = '[inputs]\ntemperature_degC = "rtU.degc"\n'
OUTPUTS = '[outputs]\nomega_ref = "rtY_omega"\n'

pytestmark = pytest.mark.usefixtures("cc")


@pytest.fixture
def opened(tmp_path):
    """Compile and start sources with a mapping file."""

    def opened(mapping, source=SOURCE, header=HEADER):
        (tmp_path / "sup.h").write_text(header, encoding="utf-8")
        (tmp_path / "sup.c").write_text(source, encoding="utf-8")
        (tmp_path / "map.toml").write_text(mapping, encoding="utf-8")
        return closing(start(f"c:{tmp_path}", BOARD, LIMITS))

    return opened


def stepped(opened, mapping, source=SOURCE, **inputs):
    """The outputs of one step with these inputs."""
    with opened(mapping, source) as started:
        return started.step({**AT_REST, **inputs})


def refused(opened, mapping, source=SOURCE, **inputs):
    """What is said of code or a map, or of the first step."""
    with pytest.raises(ImplementationError) as caught:
        stepped(opened, mapping, source, **inputs)
    return str(caught.value)


def test_an_array_of_structs_in_single_precision(opened):
    """0.1 is not what a float holds, but what was meant."""
    mapping = HEAD + '[inputs]\nwheel_speed_rpm_RL = "rtU.wheel[2].rpm"\n[outputs]\nv_ref = "rtY_v"\n'
    assert stepped(opened, mapping, wheel_speed_rpm_RL=0.1) == {"v_ref": 0.1}


def test_scale_and_offset_are_exact_in_decimal(opened):
    mapping = f"""{HEAD}
[inputs]
battery_pct = {{ at = "rtU.decipercent", scale = 0.1 }}
temperature_degC = {{ at = "rtU.degc", offset = -273.15 }}
[outputs]
critical_mask = "rtU.decipercent"
v_ref = {{ at = "rtU.decipercent", scale = 0.1 }}
omega_ref = {{ at = "rtU.degc", scale = 0.5, offset = 1 }}
"""
    found = stepped(opened, mapping, battery_pct=15.1, temperature_degC=60)
    assert found == {"critical_mask": 151, "v_ref": 15.1, "omega_ref": 333.15 / 2 + 1}


@pytest.mark.parametrize(
    ("rounding", "value", "held"),
    [("nearest", 14.5, 15), ("nearest", 14.4, 14), ("floor", 14.9, 14), ("truncate", 14.9, 14)],
)
def test_a_reading_is_rounded_as_the_map_says(opened, rounding, value, held):
    place = f'{{ at = "rtU.percent", rounding = "{rounding}" }}'
    mapping = f'{HEAD}[inputs]\nbattery_pct = {place}\n[outputs]\ncritical_mask = "rtU.percent"\n'
    assert stepped(opened, mapping, battery_pct=value) == {"critical_mask": held}


def test_enumerations_by_the_names_of_both_sides(opened):
    mapping = f"""{HEAD}
[inputs]
cmd = {{ at = "rtU.command", values = {{ CMD_NORMAL = "LEVEL_OK", CMD_ESTOP = "LEVEL_BAD" }} }}
[outputs]
temp_status = {{ at = "rtY_level", values = {{ TEMP_HEALTH_OK = 0, TEMP_HEALTH_CRITICAL = "LEVEL_BAD" }} }}
"""
    assert stepped(opened, mapping, cmd=7) == {"temp_status": 2}
    assert stepped(opened, mapping, cmd=0) == {"temp_status": 0}
    assert "cmd = 3: the mapping file gives no C value for it" in refused(opened, mapping, cmd=3)
    unexplained = mapping.replace('TEMP_HEALTH_CRITICAL = "LEVEL_BAD"', "TEMP_HEALTH_CRITICAL = 8")
    assert "rtY_level is 9, which the mapping file does not explain" in refused(opened, unexplained, cmd=7)


def test_what_a_generator_emits_besides_globals(opened):
    """A model of its own memory, pointers handed to the functions, constants, several calls, expressions."""
    source = """
#include <stdlib.h>
#include "sup.h"
struct model { double gain; int ends; };
struct model *create(void) { return calloc(1, sizeof(struct model)); }
void read_inputs(struct model *m, const struct sensors *u) { rtY_omega = m->gain * u->degc; }
int level(struct model *m) { return m->gain > 1; }
struct sensors rtU; float rtY_v; double rtY_omega; uint8_t rtY_mask; level_t rtY_level;
"""
    mapping = """
header = ["sup.h", "<stdlib.h>"]
declarations = '''
struct model { double gain; int ends; };
struct model *create(void); int level(struct model *);
void read_inputs(struct model *, const struct sensors *);
static struct model *model; static struct sensors inputs; static int result;
'''
initialize = "model = create()"
step = ["read_inputs(model, &inputs);", "result = level(model)"]
terminate = "free(model)"
[constants]
"model->gain" = 2.5
"inputs.wheel[1].silent" = true
[inputs]
temperature_degC = "inputs.degc"
[outputs]
omega_ref = "rtY_omega"
critical_mask = "result + 2 * inputs.wheel[1].silent"
give_b2_actuation = "!!(result & 1)"
"""
    found = stepped(opened, mapping, source, temperature_degC=4)
    assert found == {"omega_ref": 10.0, "critical_mask": 3, "give_b2_actuation": True}
    assert found["give_b2_actuation"] is True


def test_a_project_in_several_folders(tmp_path):
    for name, text in {
        "code/sup.c": SOURCE.replace("rtY_mask = 5", "rtY_mask = MASK"),
        "code/unused.c": "this is not compiled",
        "headers/sup.h": HEADER,
        "maps/sup.toml": f"""
sources = ["sup.c"]
include = ["../headers"]
flags = ["-DMASK=6"]
{HEAD}{INPUTS}[outputs]
critical_mask = "rtY_mask"
""",
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    address = f"c:{tmp_path / 'code'},map={tmp_path / 'maps' / 'sup.toml'}"
    with closing(start(address, BOARD, LIMITS)) as started:
        assert started.step(AT_REST) == {"critical_mask": 6}


def test_terminate_is_called_before_the_next_power_up_and_at_the_end(opened, tmp_path):
    ends = tmp_path / "ends"
    mapping = f"""
header = ["sup.h", "<stdio.h>"]
declarations = 'static FILE *file;'
step = "sup_step"
terminate = ['file = fopen("{ends}", "a");', "fputc('.', file)", "fclose(file)"]
{INPUTS}{OUTPUTS}"""
    with opened(mapping) as started:
        assert not ends.exists()
        started.reset()
        assert ends.read_text() == "."
    assert ends.read_text() == ".."


def test_a_symbol_of_the_supervisor_is_its_own(opened):
    """Even if the C library has one of that name."""
    source = SOURCE.replace("void sup_init", "int rand(void) { return 9; }\nvoid sup_init")
    source = source.replace("rtY_omega = rtU.degc", "rtY_omega = rand()")
    assert stepped(opened, HEAD + INPUTS + OUTPUTS, source) == {"omega_ref": 9.0}


def test_warnings_and_inputs_that_are_not_given_are_noted(opened):
    source = SOURCE.replace("rtY_mask = 5;", "int unused; rtY_mask = 5;")
    with opened(HEAD + INPUTS + OUTPUTS, source) as started:
        said = "\n".join(notes(started))
    assert "unused variable 'unused'" in said
    assert "inputs without a place, which it is not given: now_ms, " in said


def test_what_was_compiled_is_deleted(opened, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with opened(HEAD + INPUTS + OUTPUTS):
        assert list(tmp_path.glob("rovercheck-*"))
    assert not list(tmp_path.glob("rovercheck-*"))
    refused(opened, HEAD + INPUTS + OUTPUTS, "int x = ;")
    assert not list(tmp_path.glob("rovercheck-*"))


@pytest.mark.parametrize(
    ("place", "value", "said"),
    [
        ("rtU.percent", 300, "battery_pct = 300 does not fit rtU.percent, which is of type unsigned char."),
        ("rtU.percent", -1, "battery_pct = -1 does not fit"),
        ("rtU.percent", 15.1, "which is of type unsigned char; give the entry a rounding, or a scale."),
        ("rtU.percent", float("nan"), "battery_pct = nan does not fit"),
        ("rtU.percent", float("-inf"), "battery_pct = -inf does not fit"),
        ("rtU.clock", 1 << 19, "battery_pct = 524288 does not fit rtU.clock"),
        ("rtU.wheel[0].silent", 2, "does not fit rtU.wheel[0].silent, which is of type bool."),
        ("rtU.wheel[0].rpm", 1e39, "does not fit rtU.wheel[0].rpm, which is of type float."),
    ],
)  # fmt: skip
def test_a_value_out_of_the_range_of_its_type(opened, place, value, said):
    mapping = f'{HEAD}[inputs]\nbattery_pct = "{place}"\n{OUTPUTS}'
    found = refused(opened, mapping, battery_pct=value)
    assert said in found and "step 1: " in found


@pytest.mark.parametrize(
    ("old", "new", "entry"),
    [
        ("rtU.degc", "rtU.deg", "[inputs] temperature_degC"),  # no such member
        ("rtU.degc", "rtU.fixed", "[inputs] temperature_degC"),  # constant
        ("rtU.degc", "rtU.degc + 1", "[inputs] temperature_degC"),  # no place
        ("rtU.degc", "rtU.pointer", "[inputs] temperature_degC"),
        ("rtU.degc", "rtU.wheel", "[inputs] temperature_degC"),
        ("rtU.degc", "rtX.degc", "[inputs] temperature_degC"),  # undeclared
        ('"rtY_omega"', '"rtU"', "[outputs] omega_ref"),
        ('"rtY_omega"', '"rtU.pointer"', "[outputs] omega_ref"),
        ("sup_step", "sup_stop", "step"),
        ("sup_init", "sup_start", "initialize"),
    ],
)
def test_a_name_that_the_code_does_not_have(opened, tmp_path, old, new, entry):
    """The compiler says so, of the entry of the mapping file and of nothing else."""
    found = refused(opened, (HEAD + INPUTS + OUTPUTS).replace(old, new))
    assert f"{tmp_path / 'map.toml'}, {entry}: error: " in found
    assert "rovercheck.c" not in found


def test_near_names_are_offered(opened):
    found = refused(opened, (HEAD + INPUTS + OUTPUTS).replace("rtU.degc", "rtU.dgc"))
    assert "did you mean 'degc'" in found
    assert len(found.splitlines()) == 2


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [("void sup_step(void) {", "void other(void) {", "sup_step"), ("= 5;", "= ;", "sup.c:5:34: error: ")],
)
def test_code_that_does_not_compile_or_link(opened, old, new, said):
    found = refused(opened, HEAD + INPUTS + OUTPUTS, SOURCE.replace(old, new))
    assert "cannot be compiled" in found and said in found


@pytest.mark.parametrize(
    ("mapping", "said"),
    [
        ("header = 3", "header = 3; write a text, or several in brackets."),
        ('header = "sup.h', "the mapping file is no TOML: "),
        (HEAD + "initialise = 'x'", "'initialise' has no meaning here. Did you mean 'initialize'?"),
        (INPUTS + OUTPUTS, "step is missing"),
        (HEAD + OUTPUTS, "[inputs] is missing"),
        (HEAD + INPUTS, "[outputs] is missing"),
        (HEAD + "inputs = 3\n" + OUTPUTS, "[inputs] = 3 has no meaning here; write a table."),
        (HEAD + INPUTS.replace("temp", "tmp") + OUTPUTS, "Did you mean 'temperature_degC'?"),
        (HEAD + INPUTS + '[outputs]\ncmd = "x"', "[outputs] cmd: board1 has no output of this name."),
        (HEAD + INPUTS.replace("rtU.degc", "a; b") + OUTPUTS, "'a; b' is no place in C"),
        (HEAD + INPUTS.replace("rtU.degc", "") + OUTPUTS, "'' is no place in C"),
        (HEAD + INPUTS + '[outputs]\nv_ref = { att = "x" }', "'att' has no meaning here. Did you mean 'at'?"),
        (HEAD + INPUTS + '[outputs]\nv_ref = { at = "x", scale = 0 }', "scale = 0 is no number but 0."),
        (HEAD + '[inputs]\ncmd = { at = "x", rounding = "up" }\n' + OUTPUTS, "rounding is one of nearest, "),
        (HEAD + '[inputs]\ncmd = { at = "x", values = { CMD_STOPP = 1 } }\n' + OUTPUTS, "mean 'CMD_STOP'"),
        (HEAD + '[inputs]\ncmd = { at = "x", scale = 2, values = {} }\n' + OUTPUTS, "leave scale"),
        (HEAD.replace("sup.h", "spu.h") + INPUTS + OUTPUTS, "there is no file spu.h. Did you mean 'sup.h'?"),
        ('sources = "a.c"\n' + HEAD + INPUTS + OUTPUTS, "sources: there is no file"),
    ],
)  # fmt: skip
def test_a_mapping_file_without_meaning(opened, tmp_path, mapping, said):
    found = refused(opened, mapping)
    assert said in found and found.startswith(str(tmp_path / "map.toml"))


def test_paths_without_meaning(tmp_path):
    empty = tmp_path / "empty"
    empty.mkdir()
    (empty / "map.toml").write_text("step = 'f'\n" + INPUTS + OUTPUTS, encoding="utf-8")
    (tmp_path / "sup.so").write_text("no library", encoding="utf-8")
    for address, said in {
        f"c:{tmp_path / 'nowhere'}": "write a C file, a folder or a shared object",
        f"c:{empty / 'map.toml'}": "is neither a C file (.c), a folder nor a shared object",
        f"c:{tmp_path}": f"{tmp_path / 'map.toml'}: the mapping file cannot be read",
        f"c:{tmp_path},map=other.toml": "other.toml: the mapping file cannot be read",
        f"c:{empty}": "there is no C file (*.c) in this folder",
        f"c:{tmp_path / 'sup.so'},map={empty / 'map.toml'}": "cannot be compiled",
    }.items():
        with pytest.raises(ImplementationError) as caught:
            start(address, BOARD, LIMITS)
        assert said in str(caught.value)


def test_without_a_compiler_that_is_said(opened, monkeypatch):
    monkeypatch.setenv("PATH", "")
    monkeypatch.setenv("CC", "")
    assert "there is no C compiler" in refused(opened, HEAD + INPUTS + OUTPUTS)
