"""What files of Simulink have and the writer of this project does not write is read as it is meant."""

from collections.abc import Mapping
from pathlib import Path
from zipfile import ZipFile

import pytest

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.drawn.refused import notes_of
from rovercheck.checker.simulink.model import read_model
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.packages_by_hand import block, chart, datum, model, ports, refused, run, signal

ROWS = [{"a": 7, "b": 2}, {"a": -7, "b": 2}]


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("Logic", {}, [0, 0]), ("Logic", {"Operator": "OR"}, [1, 1]), ("Logic", {"Operator": "NOT"}, [0, 0]),
        ("Sum", {"Inputs": "|-+"}, [-7, 7]), ("Sum", {"Inputs": "3"}, [7, -7]),
        ("RelationalOperator", {}, [0, 1]), ("Product", {}, [0, 0]), ("Switch", {}, [7, -7]),
    ],
)  # fmt: skip
def test_an_input_that_is_not_connected_is_0(
    kind: str, values: Mapping[str, object], expected: list[int], tmp_path: Path
) -> None:
    """It was left out: a Logic block with one signal gave that signal, and a Sum an internal error."""
    read = model(ports(5, "a") + block(kind, "it", 5, "", **values), tmp_path)
    assert run(read, [{"a": one["a"]} for one in ROWS]) == [(one,) for one in expected]


def test_more_ports_than_signals_are_told_by_the_counts_of_either_layout(tmp_path: Path) -> None:
    for inside, values in (('<PortCounts in="3" out="1"/>', {}), ("", {"Ports": "[3, 1]"})):
        read = model(ports(5, "ab") + block("Logic", "it", 5, inside, **values), tmp_path)
        assert run(read, ROWS) == [(0,), (0,)]


def test_an_output_of_the_model_to_which_nothing_is_connected_is_0(tmp_path: Path) -> None:
    assert run(model(block("Outport", "y", 1), tmp_path), [{}, {}]) == [(0,), (0,)]


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("Product", {"Inputs": "*/"}, [3, -4]), ("Product", {"Inputs": "*/", "RndMeth": "Ceiling"}, [4, -3]),
        ("Product", {"Inputs": "*/", "RndMeth": "Zero"}, [3, -3]),
        ("Product", {"Inputs": "*/", "RndMeth": "Nearest"}, [4, -3]),
        ("Product", {"Inputs": "*/", "RndMeth": "Round"}, [4, -4]),
        ("Product", {"OutDataTypeStr": "int16"}, [14, -14]), ("Sum", {"OutDataTypeStr": "double"}, [9, -5]),
    ],
)  # fmt: skip
def test_a_block_rounds_as_it_says_and_down_if_it_says_nothing(
    kind: str, values: Mapping[str, object], expected: list[int], tmp_path: Path
) -> None:
    """Quotients of integers were rounded to the nearest."""
    read = model(ports(5) + block(kind, "it", 5, "", **values), tmp_path)
    assert run(read, ROWS) == [(one,) for one in expected]


@pytest.mark.parametrize(
    ("kind", "values", "a", "expected"),
    [
        ("Gain", {"Gain": "0.5", "OutDataTypeStr": "int8"}, -7, -4),
        ("Gain", {"Gain": "0.5", "OutDataTypeStr": "Inherit: Same as input", "RndMeth": "Zero"}, -7, -3),
        ("Gain", {"Gain": "3", "OutDataTypeStr": "int16"}, 100, 300), ("Gain", {"Gain": "3"}, 100, 44),
        ("DataTypeConversion", {"OutDataTypeStr": "uint8", "RndMeth": "Floor"}, -1, 255),
    ],
)  # fmt: skip
def test_the_output_type_of_a_block_is_that_of_its_exact_result(
    kind: str, values: Mapping[str, object], a: int, expected: int, tmp_path: Path
) -> None:
    assert run(model(ports(5, "a") + block(kind, "it", 5, "", **values), tmp_path), [{"a": a}]) == [
        (expected,)
    ]


@pytest.mark.parametrize(("kind", "expected"), [("Sum", 200), ("Product", 10_000)])
def test_a_result_in_a_wider_type_does_not_wrap_before(kind: str, expected: int, tmp_path: Path) -> None:
    """It wrapped in the type of the inputs."""
    read = model(ports(5) + block(kind, "it", 5, OutDataTypeStr="int16"), tmp_path)
    assert run(read, [{"a": 100, "b": 100}]) == [(expected,)]


def test_a_product_may_begin_with_a_division(tmp_path: Path) -> None:
    half = block("Constant", "half", 1, Value="0.5") + signal("1#out:1", "5#in:1")
    three = block("Constant", "three", 2, Value="3") + signal("2#out:1", "5#in:2")
    read = model(half + three + ports(5, "") + block("Product", "it", 5, Inputs="/*"), tmp_path)
    assert run(read, [{}]) == [(6,)]


def test_an_integer_times_a_fraction_is_refused_without_an_output_type(tmp_path: Path) -> None:
    """It was rounded to a whole number; in Simulink it is a fixed-point number."""
    for said in refused(model(ports(5, "a") + block("Gain", "it", 5, Gain="0.5"), tmp_path)):
        assert said.startswith("it: an integer times a fraction is a fixed-point number: give the block an")


def test_an_integer_beside_a_real_number_is_a_real_number(tmp_path: Path) -> None:
    """The sum was one of integers, as in MATLAB."""
    half = block("Constant", "half", 3, Value="0.5") + signal("3#out:1", "5#in:2")
    read = model(ports(5, "a") + half + block("Sum", "it", 5, Inputs="++"), tmp_path)
    assert run(read, [{"a": 7}]) == [(7.5,)]


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("Logic", {}, (1, 0)), ("Logic", {"Operator": "NOR"}, (0, 0)), ("MinMax", {"Inputs": "2"}, (1, 0)),
        ("MinMax", {"Function": "max"}, (1, 3)),
    ],
)  # fmt: skip
def test_vectors_are_combined_element_by_element(
    kind: str, values: Mapping[str, object], expected: tuple[int, ...], tmp_path: Path
) -> None:
    """All elements of all inputs gave one number."""
    text = "".join(
        block("Constant", f"c{n}", n, Value=value) + signal(f"{n}#out:1", f"5#in:{n}")
        for n, value in enumerate(("[1 0]", "[1 3]"), 1)
    )
    assert run(model(text + ports(5, "") + block(kind, "it", 5, "", **values), tmp_path), [{}]) == [expected]


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("Logic", {"Operator": "OR", "Inputs": "1"}, (1,)), ("Logic", {"Operator": "NOT"}, (0, 1)),
        ("Sum", {"Inputs": "1"}, (3,)), ("Sum", {"Inputs": "-"}, (-3,)), ("Product", {"Inputs": "*"}, (0,)),
        ("MinMax", {}, (0,)),
    ],
)  # fmt: skip
def test_the_elements_of_one_vector_are_combined(
    kind: str, values: Mapping[str, object], expected: tuple[int, ...], tmp_path: Path
) -> None:
    text = block("Constant", "c", 1, Value="[3 0]") + signal("1#out:1", "5#in:1")
    assert run(model(text + ports(5, "") + block(kind, "it", 5, "", **values), tmp_path), [{}]) == [expected]


def test_a_real_number_times_a_gain_of_integers_is_a_real_number(tmp_path: Path) -> None:
    """It was an integer, as in MATLAB."""
    half = block("Constant", "half", 1, Value="0.5") + signal("1#out:1", "5#in:1")
    read = model(half + ports(5, "") + block("Gain", "it", 5, Gain="int8(3)"), tmp_path)
    assert run(read, [{}]) == [(1.5,)]


# --- what is left out --------------------------------------------------------------------------------------

GAIN = signal("1#out:1", "6#in:1") + signal("6#out:1", "5#in:1")


def test_a_block_that_is_commented_out_gives_nothing(tmp_path: Path) -> None:
    """It was executed."""
    doubled = block("Gain", "twice", 6, Gain="2", Commented="on") + GAIN
    b = block("Inport", "b", 2, Port="2", OutDataTypeStr="int8") + signal("2#out:1", "5#in:2")
    a = block("Inport", "a", 1, OutDataTypeStr="int8")
    y = block("Outport", "y", 90) + signal("5#out:1", "90#in:1")
    assert run(model(a + b + y + doubled + block("Sum", "it", 5), tmp_path), ROWS) == [(2,), (2,)]


def test_a_block_that_is_commented_through_is_refused(tmp_path: Path) -> None:
    read = model(ports(5, "a") + block("Gain", "twice", 5, Gain="2", Commented="through"), tmp_path)
    assert [str(note) for note in notes_of(read)] == [
        "twice, Gain block 5: it is commented through. Delete it, and draw the signal past it."
    ]


def test_an_annotation_is_no_block(tmp_path: Path) -> None:
    note = '<Annotation SID="7"><P Name="Name">What it does&#xA;and why</P></Annotation>'
    assert run(model(ports(5, "a") + note + block("Gain", "it", 5), tmp_path), [{"a": 3}]) == [(3,)]


@pytest.mark.parametrize(("kind", "port"), [("EnablePort", "enable"), ("TriggerPort", "trigger")])
def test_a_control_port_to_which_nothing_is_connected_is_refused(
    kind: str, port: str, tmp_path: Path
) -> None:
    """The subsystem was executed in every step, and Simulink never executes it."""
    inside = f"<System>{block(kind, 'control', 7)}{block('Outport', 'o', 8)}</System>"
    read = model(ports(5, "") + block("SubSystem", "it", 5, inside), tmp_path)
    said = f"it, SubSystem block 5: nothing is connected to its port {port}. Connect a signal, or delete the"
    assert all(one.startswith(said) for one in [str(note) for note in notes_of(read)])
    assert refused(read)[0].startswith(said)


def test_a_subsystem_with_two_control_ports_is_refused(tmp_path: Path) -> None:
    """One of them was not looked at."""
    both = block("EnablePort", "e", 7) + block("TriggerPort", "t", 8)
    lines = signal("1#out:1", "5#enable") + signal("2#out:1", "5#trigger")
    read = model(ports(5) + lines + block("SubSystem", "it", 5, f"<System>{both}</System>"), tmp_path)
    assert [str(note) for note in notes_of(read)] == [
        "it, SubSystem block 5: it has the ports enable and trigger. Put what the second controls into a "
        "subsystem in it."
    ]


# --- defaults ----------------------------------------------------------------------------------------------

LISTED = '<Block BlockType="Sum"><P Name="Inputs">+-</P></Block><Block BlockType="Gain"/>'


def test_a_model_says_what_blocks_are_that_say_nothing(tmp_path: Path) -> None:
    """The defaults of the sheet were taken in place of those of the model."""
    more = f"<BlockParameterDefaults>{LISTED}</BlockParameterDefaults>"
    assert run(model(ports(5) + block("Sum", "it", 5), tmp_path, more), ROWS) == [(5,), (-9,)]
    assert run(model(ports(5) + block("Sum", "it", 5, Inputs="++"), tmp_path, more), ROWS) == [(9,), (-5,)]


def test_newer_releases_say_it_in_a_part_of_its_own(tmp_path: Path) -> None:
    model(ports(5) + block("Sum", "it", 5), tmp_path)
    with ZipFile(tmp_path / "hand.slx", "a") as package:
        listed = f"<BlockParameterDefaults>{LISTED}</BlockParameterDefaults>"
        package.writestr("simulink/bddefaults.xml", f"<BlockDiagramDefaults>{listed}</BlockDiagramDefaults>")
    assert run(read_model(tmp_path / "hand.slx"), ROWS) == [(5,), (-9,)]


# --- charts ------------------------------------------------------------------------------------------------

DATA = (
    datum(10, "q", "INPUT_DATA") + datum(11, "p", "INPUT_DATA") + datum(12, "y", "OUTPUT_DATA")
    + datum(13, "z", "OUTPUT_DATA")
)  # fmt: skip
INSIDE = "".join(
    block(kind, name, sid, "", **({"Port": port} if port > 1 else {}))
    for sid, (kind, name, port) in enumerate(
        [("Inport", "q", 2), ("Inport", "p", 1), ("Outport", "z", 1), ("Outport", "y", 2)], 20
    )
)
CHART = '<P Name="SFBlockType">Chart</P><System>{}</System>'


def test_data_have_the_ports_of_the_block_and_not_those_of_their_order(tmp_path: Path) -> None:
    """The first input in the file was the first port, whatever the block says."""
    block_ = block("SubSystem", "C", 5, CHART.format(INSIDE))
    label = chart("A&#xA;en, du: y = p - q; z = p;", DATA)
    read = model(ports(5, "ab", "zy") + block_, tmp_path, "", label)
    assert run(read, ROWS) == [(7, 5), (-7, -9)]


def test_a_chart_of_which_the_block_is_commented_out_is_none(tmp_path: Path) -> None:
    block_ = block("SubSystem", "C", 5, CHART.format(INSIDE), Commented="on")
    read = model(ports(5, "ab", "zy") + block_, tmp_path, "", chart("A", DATA))
    assert read.charts == ()
    assert run(read, ROWS) == [(0, 0), (0, 0)]


# --- links to the library of Simulink ----------------------------------------------------------------------


def linked(source: str, new: bool, **values: object) -> str:
    """A block of the library; newer releases put its values into an element of their own."""
    written = "".join(f'<P Name="{key}">{value}</P>' for key, value in values.items())
    inside = f"<InstanceData>{written}</InstanceData>" if new else written
    link = f"simulink/Logic and Bit&#xA;Operations/{source.replace(' ', '&#xA;')}"
    return block("Reference", "R", 5, inside, SourceBlock=link, SourceType=source)


@pytest.mark.parametrize("new", [False, True])
@pytest.mark.parametrize(
    ("source", "values", "expected"),
    [
        ("Compare To Constant", {"relop": "&gt;=", "const": "K + 1"}, [0, 1, 1]),
        ("Compare To Constant", {"relop": "==", "const": "4", "OutDataTypeStr": "uint8"}, [0, 1, 0]),
        ("Compare To Zero", {"relop": "~="}, [1, 1, 1]),
        ("Compare To Zero", {}, [1, 0, 0]),
    ],
)
def test_comparisons_of_the_library_are_blocks(
    source: str, values: Mapping[str, object], expected: list[int], new: bool, tmp_path: Path
) -> None:
    """A link to the library was refused, whatever it led to."""
    made = ports(5, "u", "y") + linked(source, new, **values)
    read = model(made, tmp_path, files={"values.m": "K = 3;"})
    assert run(read, [{"u": value} for value in (-1, 4, 5)]) == [(one,) for one in expected]


@pytest.mark.parametrize("constant", ["2.5", "200", "-129"])
def test_a_comparison_with_no_value_of_the_type_is_refused_by_both_readings(
    constant: str, tmp_path: Path
) -> None:
    made = ports(5, "u", "y") + linked("Compare To Constant", True, relop="&lt;", const=constant)
    assert all(f"it compares int8 with {constant}" in one for one in refused(model(made, tmp_path)))


def test_other_links_are_refused_by_name(tmp_path: Path) -> None:
    read = model(ports(5, "u", "y") + linked("Detect Change", True, vinit="0"), tmp_path)
    assert [str(note) for note in notes_of(read)] == [
        "R, Reference block 5: it is a link to a block of Simulink's library that is not known here. Draw "
        "what it does in its place. Or name it under `free` in the file of domains, to have any value."
    ]


# --- function calls ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "values", "said"),
    [
        ("Reference", {"SourceType": "Function-Call Generator"}, "a generator of function calls that is no"),
        ("S-Function", {"FunctionName": "fcncallgen"}, "a generator of function calls that is no link to"),
        ("FunctionCallFeedbackLatch", {}, "a latch of a function call. Put a Unit Delay in its place."),
        ("FunctionCaller", {}, "a call of a Simulink function. Call it in a chart."),
    ],
)
def test_blocks_of_function_calls_are_refused_by_name(
    kind: str, values: Mapping[str, object], said: str, tmp_path: Path
) -> None:
    read = model(block(kind, "it", 5, "", **values), tmp_path)
    assert [str(note).startswith(f"it, {kind} block 5: it is {said}") for note in notes_of(read)] == [True]


def event(ssid: int, name: str, scope: str) -> str:
    """An event of a chart that is a function call."""
    return (
        f'<event SSID="{ssid}"><P Name="name">{name}</P><P Name="scope">{scope}_EVENT</P>'
        '<P Name="trigger">FUNCTION_CALL_EVENT</P></event>'
    )


@pytest.mark.parametrize("through", ["", "Goto"])
def test_a_function_call_goes_to_the_port_of_its_event(through: str, tmp_path: Path) -> None:
    """Ports of events are behind those of data, by their numbers in the block; tags are wires."""
    text = chart(
        "A&#xA;en: y = int8(1);&#xA;du: y = p; F; G; G;",
        event(14, "F", "OUTPUT") + event(15, "G", "OUTPUT") + datum(11, "p", "INPUT_DATA")
        + datum(12, "y", "OUTPUT_DATA"),
    )  # fmt: skip
    outs = "".join(
        block("Outport", name, sid, "", Port=port)
        for sid, name, port in ((20, "y", 1), (21, "G()", 2), (22, "F()", 3))
    )
    inside = block("Inport", "p", 23) + outs
    counted = (
        block("TriggerPort", "call", 30, "", TriggerType="function-call") + block("Inport", "i", 31)
        + block("UnitDelay", "last", 32, InitialCondition="int8(0)") + block("Sum", "add", 33)
        + block("Outport", "o", 34)
        + signal("31#out:1", "33#in:1") + signal("32#out:1", "33#in:2") + signal("33#out:1", "32#in:1")
        + signal("33#out:1", "34#in:1")
    )  # fmt: skip
    wires = signal("5#out:1", "6#in:1") + signal("6#out:1", "91#in:1")
    if through:
        wires += signal("5#out:2", "7#in:1") + signal("8#out:1", "6#trigger")
        wires += block("Goto", "to", 7, GotoTag="call") + block("From", "from", 8, GotoTag="call")
    else:
        wires += signal("5#out:2", "6#trigger")
    read = model(
        ports(5, "a", "y") + block("Outport", "sum", 91, Port=2) + wires
        + block("SubSystem", "C", 5, CHART.format(inside))
        + block("SubSystem", "X", 6, f"<System>{counted}</System>"),
        tmp_path, "", text,
    )  # fmt: skip
    rows = [{"a": 3}, {"a": 3}, {"a": -1}]
    assert run(read, rows) == [(1, 0), (3, 6), (-1, 4)]


def indexed_from(first: str, folder: Path) -> DrawnModel:
    """A chart in C with an array of three numbers, whose second the index 1 may be."""
    data = (
        datum(3, "u", "INPUT_DATA")
        + datum(4, "y", "OUTPUT_DATA")
        + datum(5, "v", "LOCAL_DATA", "int8", "[4 5 6]")
    )
    array = f'<array><P Name="size">3</P><P Name="firstIndex">{first}</P></array><P Name="initialValue">[4'
    drawn = chart("A\ndu: y = v[1];", data.replace('<P Name="initialValue">[4', array))
    in_c = drawn.replace('<P Name="actionLanguage">2</P>', "")
    made = block("SubSystem", "C", 5, "", Ports="[1, 1]", SFBlockType="Chart")
    return model(made + ports(5, "u", "y"), folder, "", in_c)


@pytest.mark.parametrize(("first", "expected"), [("", 5), ("0", 5), ("1", 4)])
def test_an_array_in_c_has_the_first_index_that_the_file_says(
    first: str, expected: int, tmp_path: Path
) -> None:
    assert run(indexed_from(first, tmp_path), [{"u": 0}, {"u": 0}]) == [(0,), (expected,)]


@pytest.mark.parametrize("first", ["K", "1.5", "[1 1]"])
def test_a_first_index_that_is_no_whole_number_is_refused(first: str, tmp_path: Path) -> None:
    """It was an internal error."""
    with pytest.raises(ModelError, match=r"line \d+: firstIndex of <data> is '.*', and no whole number"):
        indexed_from(first, tmp_path)
