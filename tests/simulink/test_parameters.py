"""Parameters, types and sample times are read in all the ways in which files write them."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.parameters import LONGEST, expanded
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.drawn.type_names import plain_type
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.packages_by_hand import block, chart, datum, model, ports, refused, run, signal


def constant(value: str, script: str, folder: Path) -> float:
    """The value of a Constant, beside a script."""
    text = block("Constant", "c", 5, Value=value) + ports(5, "")
    [[found]] = run(model(text, folder, files={"values.m": script}), [{}])
    return found


@pytest.mark.parametrize(
    ("value", "script", "expected"),
    [
        ("2*K + 1", "K = 3;", 7), ("K", "HALF = 0.5; K = 3*HALF;", 1.5), ("K", "A = 1; K = A; A = 2;", 1),
        ("K", "K = 2; K = K + 1;", 3), ("-K", "K = 1 - 3;", 2), ("K", "K = Simulink.Parameter(5);", 5),
        ("K", "K = Simulink.Parameter;\nK.Value = 300; K.DataType = 'uint8';", 255),
        ("K + 1", "K = Simulink.Parameter(255); K.DataType = 'fixdt(0,8,0)';", 255),
    ],
)  # fmt: skip
def test_a_parameter_may_stand_in_an_expression_and_have_a_type(
    value: str, script: str, expected: float, tmp_path: Path
) -> None:
    """Only a name alone was known, and its type was not looked at."""
    assert constant(value, script, tmp_path) == expected


@pytest.mark.parametrize(
    ("value", "script", "expected"),
    [
        ("K(2)", "K = [2 5 7];", 5), ("K(end) - K(N - 1)", "N = 2; K = single([2 5 7]);", 5),
        ("K(2) + 10*K(1, 2)", "K = [1 2; 3 4];", 23), ("2*K(1)", "K = 4;", 8),
        ("V(1)", "K = [2 -5]; V = [K(2), K(1)];", -5),
    ],
)  # fmt: skip
def test_a_parameter_may_be_an_element_of_a_vector(
    value: str, script: str, expected: float, tmp_path: Path
) -> None:
    """It could not be parsed."""
    assert constant(value, script, tmp_path) == expected


@pytest.mark.parametrize("value", ["K(4)", "K(0)", "K(1, 2, 3)", "K(0.5)", "K()"])
def test_an_element_that_there_is_not_is_refused(value: str, tmp_path: Path) -> None:
    text = block("Constant", "c", 5, Value=value) + ports(5, "")
    direct, lowered = refused(model(text, tmp_path, files={"values.m": "K = [2 5 7];"}))
    assert direct.startswith("c: the parameter '([2 5 7])(")
    assert lowered.startswith(f"c: the parameter '{value}'")


def test_initial_values_in_charts_of_c_are_expressions_of_matlab(tmp_path: Path) -> None:
    """A vector could not be indexed, and 3/2 was 1."""
    data = datum(10, "a", "INPUT_DATA", "double") + datum(11, "y", "OUTPUT_DATA", "int16", "3/2 + 3/2 + K(2)")
    inside = '<P Name="SFBlockType">Chart</P><System/>'
    label = chart("A&#xA;du: y = y + 1;", data).replace('<P Name="actionLanguage">2</P>', "")
    values = {"k.m": "K = [1 4];"}
    read = model(
        ports(5, "", "y") + block("SubSystem", "C", 5, inside), tmp_path, "", label, values
    )  # fmt: skip
    assert run(read, [{}, {}]) == [(7,), (8,)]


def test_a_value_that_doubles_in_each_line_does_not_grow_without_end() -> None:
    named, text = {"A": "1"}, "A"
    for _ in range(60):
        named["A"] = expanded("A + A", named)
    assert len(expanded(text, named)) <= LONGEST


def test_initial_values_in_charts_may_name_parameters(tmp_path: Path) -> None:
    """They were refused where the chart itself does not know the name; its own data come first."""
    data = datum(10, "a", "INPUT_DATA") + datum(11, "y", "OUTPUT_DATA", "int8", "2*K")
    inside = '<P Name="SFBlockType">Chart</P><System/>'
    label = chart("A&#xA;du: y = y + 1;", data)
    read = model(ports(5, "a") + block("SubSystem", "C", 5, inside), tmp_path, "", label, {"k.m": "K = 4;"})
    assert run(read, [{"a": 0}, {"a": 0}]) == [(8,), (9,)]


@pytest.mark.parametrize(
    ("written", "plain"),
    [
        ("fixdt(0,8,0)", "uint8"), ("fixdt(1, 16, 0)", "int16"), ("fixdt(true,32,0)", "int32"),
        ("fixdt(0,8,1,0)", "uint8"), ("fixdt(0,8,2^0,0)", "uint8"), ("fixdt('int8')", "int8"),
        ("ufix32", "uint32"), ("sfix8", "int8"), ("fixdt(0,8,3)", "fixdt(0,8,3)"),
        ("fixdt(1,16)", "fixdt(1,16)"),
        ("fixdt(0,8,0.5,0)", "fixdt(0,8,0.5,0)"), ("fixdt(0,12,0)", "fixdt(0,12,0)"),
        ("sfix16_En4", "sfix16_En4"), ("Enum: Gear", "Enum: Gear"),
    ],
)  # fmt: skip
def test_a_fixed_point_type_without_a_fraction_is_one_of_integers(written: str, plain: str) -> None:
    assert plain_type(written) == plain


def test_data_of_a_fixed_point_type_without_a_fraction_are_read(tmp_path: Path) -> None:
    """They were refused."""
    data = datum(10, "a", "INPUT_DATA", "fixdt(0,8,0)") + datum(11, "y", "OUTPUT_DATA", "ufix8")
    inside = '<P Name="SFBlockType">Chart</P><System/>'
    text = ports(5, "a", "y", "fixdt(0,8,0)") + block("SubSystem", "C", 5, inside)
    read = model(text, tmp_path, "", chart("A&#xA;en, du: y = a;", data))
    assert list(notes_of(read)) == []
    assert run(read, [{"a": 200}, {"a": 3}]) == [(200,), (3,)]


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ("Enum: Gear", "the type Gear is not there: name the file that defines it"),
        ("Bus: Cockpit", "the type Cockpit is not there: name the file that defines it"),
        ("type(u)", "the type 'type(u)' is not known"),
        ("Speed", "the type 'Speed' is not known"),
    ],
)
def test_a_type_that_no_file_defines_is_refused(kind: str, said: str, tmp_path: Path) -> None:
    text = chart("A&#xA;en: y = int8(1);", datum(3, "x", "LOCAL_DATA", kind) + datum(4, "y", "OUTPUT_DATA"))
    made = block("SubSystem", "C", 5, "", Ports="[0, 1]", SFBlockType="Chart") + ports(5, "")
    assert all(said in one for one in refused(model(made, tmp_path, "", text)))


@pytest.mark.parametrize("rate", ["-1", "[-1, 0]", "0.1", "[0.1 0]", "1/10", "Ts", "[Ts, 0]", "inf", "Inf"])
def test_a_sample_time_is_that_of_the_model_in_whatever_way_it_is_written(rate: str, tmp_path: Path) -> None:
    """Of these only -1, 0.1, 1/10 and inf were known."""
    solver = '<Object ClassName="Simulink.SolverCC"><P Name="FixedStep">Ts</P></Object>'
    text = ports(5, "a") + block("UnitDelay", "d", 5, SampleTime=rate)
    read = model(text, tmp_path, solver, files={"ts.m": "Ts = 0.1;"})
    assert read.step == "0.1"
    assert run(read, [{"a": 1}, {"a": 2}]) == [(0,), (1,)]


@pytest.mark.parametrize("rate", ["0.2", "[0.1 0.05]", "Tx", "2*Ts"])
def test_another_sample_time_is_refused(rate: str, tmp_path: Path) -> None:
    solver = '<Object ClassName="Simulink.SolverCC"><P Name="FixedStep">0.1</P></Object>'
    text = ports(5, "a") + block("UnitDelay", "d", 5, SampleTime=rate)
    read = model(text, tmp_path, solver, files={"ts.m": "Ts = 0.1;"})
    assert all("the model every 0.1 s: give them one rate" in said for said in refused(read))


# --- names -------------------------------------------------------------------------------------------------


def test_a_line_break_in_the_name_of_a_port_is_a_blank(tmp_path: Path) -> None:
    """The model could not be checked, and the message was about a file of this project."""
    text = block("Inport", "left&#xA;wheel", 1, OutDataTypeStr="int8") + block("Outport", "the&#xA;speed", 2)
    read = model(text + signal("1#out:1", "2#in:1"), tmp_path)
    assert run(read, [{"left wheel": 3}]) == [(3,)]


# --- masks -------------------------------------------------------------------------------------------------

GAIN = (
    "<System>" + block("Inport", "i", 21) + block("Gain", "g", 22, Gain="{gain}") + block("Outport", "o", 23)
    + signal("21#out:1", "22#in:1") + signal("22#out:1", "23#in:1") + "</System>"
)  # fmt: skip
MASKS = {
    "new": '<Mask><MaskParameter Name="K" Type="edit"><Value>{value}</Value></MaskParameter>{more}</Mask>',
    "object": '<Object PropName="MaskObject" ClassName="Simulink.Mask"><Array PropName="Parameters">'
    '<Object ClassName="Simulink.MaskParameter"><P Name="Name">K</P><P Name="Type">edit</P>'
    '<P Name="Value">{value}</P></Object></Array>{more}</Object>',
    "old": '<P Name="MaskVariables">K=@1;</P><P Name="MaskValueString">{value}</P>',
}


def masked(mask: str, folder: Path, gain: str = "K", script: str = "") -> list[float]:
    """What a Gain in a masked subsystem makes of 7."""
    text = ports(5, "a") + block("SubSystem", "S", 5, mask + GAIN.format(gain=gain))
    return [y for (y,) in run(model(text, folder, files={"values.m": script}), [{"a": 7}])]


@pytest.mark.parametrize("form", MASKS)
@pytest.mark.parametrize(
    ("value", "script", "expected"),
    [("5", "", 35), ("5", "K = 3;", 35), ("K", "K = 3;", 21), ("K - 1", "K = 3;", 14)],
)
def test_a_name_of_a_mask_has_its_value_there(
    form: str, value: str, script: str, expected: int, tmp_path: Path
) -> None:
    """It was refused, or had the value that the workspace gives the same name."""
    assert masked(MASKS[form].format(value=value, more=""), tmp_path, script=script) == [expected]


def test_a_mask_in_a_mask_has_the_names_of_both(tmp_path: Path) -> None:
    inner = MASKS["new"].format(value="K + 1", more="").replace('"K"', '"L"') + GAIN.format(gain="K * L")
    system = block("Inport", "i", 31) + block("SubSystem", "T", 32, inner) + block("Outport", "o", 33)
    lines = signal("31#out:1", "32#in:1") + signal("32#out:1", "33#in:1")
    outer = MASKS["new"].format(value="2", more="") + f"<System>{system}{lines}</System>"
    assert run(model(ports(5, "a") + block("SubSystem", "S", 5, outer), tmp_path), [{"a": 7}]) == [(42,)]


@pytest.mark.parametrize(
    "mask",
    [
        MASKS["new"].format(value="5", more="<Initialization>K = f(K);</Initialization>"),
        MASKS["new"].format(value="on", more="").replace("edit", "checkbox"),
        MASKS["old"].format(value="5").replace("@", "&amp;"),
        MASKS["old"].format(value="5").replace("1", "2"),
        MASKS["old"].format(value="5") + '<P Name="MaskInitialization">K = 2 * K;</P>',
    ],
)  # fmt: skip
def test_a_name_of_a_mask_without_a_value_that_can_be_read_is_refused(mask: str, tmp_path: Path) -> None:
    """The workspace may have another value of that name."""
    with pytest.raises(ModelError, match=r"line 1: K is a name of a mask, whose value the file does not say"):
        masked(mask, tmp_path, script="K = 3;")
    assert masked(mask, tmp_path, gain="2") == [14]


def test_a_parameter_of_a_chart_in_a_mask_has_the_value_of_the_mask(tmp_path: Path) -> None:
    """It was that of the workspace."""
    data = datum(10, "a", "INPUT_DATA") + datum(11, "y", "OUTPUT_DATA") + datum(12, "K", "PARAMETER_DATA")
    inside = MASKS["new"].format(value="5", more="") + '<P Name="SFBlockType">Chart</P><System/>'
    text = ports(5, "a") + block("SubSystem", "C", 5, inside)
    read = model(text, tmp_path, "", chart("A&#xA;en: y = a + K;", data), {"k.m": "K = 4;"})
    assert run(read, [{"a": 1}]) == [(6,)]
