"""What a scenario may say, and the one message that everything else gets."""

from math import inf

import pytest

from rovercheck.supervisor.bench import ScenarioError, loads, parse
from rovercheck.supervisor.bench.conditions import CONDITIONS
from rovercheck.supervisor.bench.quantities import shown

HEAD = 'duration = "10 s"\n'


def event(text: str) -> str:
    return f'{HEAD}[[event]]\nat = "1 s"\n{text}'


def expect(text: str) -> str:
    return f'{HEAD}[[expect]]\nat = "1 s"\n{text}'


WRONG = [
    ("duration = ", "This is no TOML: Invalid value"),
    ("", "duration is missing; write duration = "),
    ("duration = 10", "duration: 10 is no time; write a number and its unit, as in "),
    ('duration = "10"', "duration: '10' is no time"),
    ('duration = "10 kg"', "duration: 'kg' is no unit of a time; write us, ms, s"),
    ('duration = "0 s"', "duration: 0 ms is no run; write 20 ms to 600 s."),
    ('duration = "9000 s"', "duration: 9000 s is no run"),
    ('duration = "0.0000001 s"', "is no time of a run; write whole microseconds"),
    (HEAD + "durration = 1", "durration: there is no such key. Did you mean 'duration'"),
    (HEAD + 'phase = "20 ms"', "phase: 20 ms is no phase of a task of 20 ms; write less than 20 ms."),
    (HEAD + 'phase = "-1 ms"', "phase: '-1 ms' is no time of a run"),
    (HEAD + 'drift = "20000 ppm"', "drift: write whole ppm from -10000 to 10000"),
    (HEAD + 'drift = "20 ms"', "drift: 'ms' is no unit of a drift of a clock; write ppm"),
    (HEAD + "seed = 1.5", "seed: 1.5 is no whole number"),
    (HEAD + "title = 3", "title: 3 is no text"),
    (HEAD + "initial = 3", "initial: 3 is no table"),
    (HEAD + "[initial]\nbatery = 3", "initial.batery: there is no such condition. Did you mean 'battery'"),
    (HEAD + '[phases]\ncontrol = "10 ms"', "phases.control: 10 ms is no phase of a task of 10 ms"),
    (HEAD + '[phases]\ncontroll = "1 ms"', "phases.controll: there is no such key. Did you mean 'control'"),
    (HEAD + '[periods]\ncontroll = "1 ms"', "periods.controll: there is no such key. Did you mean 'control'"),
    (HEAD + '[periods]\ncontrol = "0 ms"', "periods.control: 0 ms is no period; write 1 ms to 100 ms."),
    (HEAD + '[periods]\ncontrol = "1 s"', "periods.control: 1 s is no period; write 1 ms to 100 ms."),
    (HEAD + "[periods]\ncontrol = []", "periods.control: there is no period; write one"),
    (HEAD + "[periods]\ncontrol = [3]", "periods.control: 3 is no time"),
    (HEAD + '[event]\nat = "1 s"', "event: there may be several; write [[event]] before each."),
    (HEAD + "event = [3]", "event[1]: 3 is no table"),
    (HEAD + "[[event]]\nstick_y = 1", 'event[1]: at is missing; write at = "2.5 s".'),
    (event(""), "event[1]: sets nothing; write a condition and its value"),
    (event("stik_y = 1"), "event[1].stik_y: there is no such condition. Did you mean 'stick_y'"),
    (event("stick_y = 1.5"), "event[1].stick_y: 1.5 is out of range; write -1 to 1."),
    (event('stick_y = "1"'), "event[1].stick_y: '1' is no number; write one without a unit."),
    (event("stick_y = nan"), "event[1].stick_y: nan is no number"),
    (event("stick_y = true"), "event[1].stick_y: true is no number"),
    (event("btn1 = 1"), "event[1].btn1: 1 is neither true nor false"),
    (event("battery = 50"), 'event[1].battery: 50 is no charge; write a number and its unit, as in "80 %".'),
    (event('battery = "150 %"'), "event[1].battery: '150 %' is out of range; write 0 % to 100 %."),
    (event('temperature = "20 K"'), "'K' is no unit of a temperature; write °C, degC"),
    (event('obstacle_left = "far"'), "event[1].obstacle_left: 'far' is no distance"),
    (event('link = "broken"'), "event[1].link: 'broken' has no meaning here. Known: ok, cut."),
    (event('link = "cutt"'), "event[1].link: 'cutt' has no meaning here. Did you mean 'cut'"),
    (event('link = "cut"\nover = "1 s"'), "event[1].over: link_b1_b2 is no number and changes at once"),
    (event('stick_y = 1\nfor = "10 s"'), "event[1].at: it ends at 11 s, after the run, which lasts 10 s"),
    (event('obstacle_left = "1 m"\nover = "1 s"'), 'event[1].over: obstacle_left is "none" before or after'),
    (
        event('stick_y = 1\nover = "2 s"\n[[event]]\nat = "2 s"\nstick_y = 0'),
        "event[2].stick_y: event[1] changes it until 3 s; begin then, or let that end earlier.",
    ),
    (expect("value = 1"), 'expect[1]: signal is missing; write signal = "board1.current_action".'),
    (expect('signal = "board1.v_reff"\nvalue = 1'), "Did you mean 'board1.v_ref'"),
    (expect('signal = "speed"\nvalue = 1'), "there is no signal 'speed'. "),
    (expect("signal = 1\nvalue = 1"), "expect[1].signal: there is no signal 1. Write board1., board2. or"),
    (expect('signal = "board1.v_ref"'), "expect[1]: write value = ..., or a number as min = ..."),
    (expect('signal = "board1.v_ref"\nvalue = 1\nmin = 0'), "expect[1]: write value = ..., or a number"),
    (expect('signal = "board1.v_ref"\nvalue = true'), "expect[1].value: true is no number"),
    (expect('signal = "board1.v_ref"\nmin = "0"'), "expect[1].min: '0' is no number"),
    (expect('signal = "board1.rx_status"\nmin = 1'), "expect[1].min: the signal is no number"),
    (expect('signal = "board1.rx_status"\nvalue = "BAD"'), "Known: OK, DEGRADED, CRITICAL."),
    (expect('signal = "board1.btn1"\nvalue = 1'), "expect[1].value: 1 is neither true nor false"),
    (
        expect('signal = "board1.v_ref"\nvalu = 1'),
        "expect[1].valu: there is no such key. Did you mean",
    ),
    (
        expect('signal = "board1.v_ref"\nvalue = 1\nwithin = "1 s"\nduring = "1 s"'),
        "expect[1]: within and during exclude each other",
    ),
    (expect('signal = "board1.v_ref"\nvalue = 1\nwithin = "1 min"'), "expect[1].within: 'min' is no unit"),
    (expect('signal = "board1.v_ref"\nvalue = 1\nwithin = "10 s"'), "expect[1].at: 11 s is after the run"),
]


@pytest.mark.parametrize(("text", "message"), WRONG, ids=[m for _, m in WRONG])
def test_a_slip_gets_one_message_with_its_path(text: str, message: str) -> None:
    with pytest.raises(ScenarioError) as slip:
        loads(text)
    assert message in str(slip.value)
    assert "\n" not in str(slip.value)


def test_a_condition_keeps_what_it_was_before_an_event_for_a_time() -> None:
    made = loads(event('stick_y = 0.5\nfor = "2 s"'))
    assert [made.at("stick_y", t) for t in (0, 999_999, 1_000_000, 2_999_999, 3_000_000)] == [
        0.0,
        0.0,
        0.5,
        0.5,
        0.0,
    ]


def test_a_number_runs_evenly_to_its_new_value() -> None:
    made = loads(event('battery = "40 %"\nover = "2 s"\nfor = "1 s"'))
    assert [made.at("battery", t * 10**6) for t in (1, 2, 3, 4, 5)] == [80.0, 60.0, 40.0, 80.0, 80.0]


def test_a_short_name_sets_both_directions() -> None:
    made = loads(event('link = "cut"'))
    assert made.at("link_b1_b2", 10**6) == made.at("link_b2_b1", 10**6) == "cut"
    assert made.events[0].label == "link cut"


def test_no_obstacle_is_written_none() -> None:
    made = parse({"duration": "1 s", "initial": {"obstacle_left": "1.5 m", "obstacle_right": "none"}})
    assert [made.at(f"obstacle_{side}", 0) for side in ("left", "centre", "right")] == [150.0, inf, inf]


def test_texts_hold_nothing_that_a_terminal_or_a_picture_minds() -> None:
    made = parse({"duration": "1 s", "title": " a\x1b[2J\nb ", "about": "\x00"})
    assert (made.title, made.about) == ("a[2J b", "")


@pytest.mark.parametrize("name", CONDITIONS)
def test_every_condition_may_be_written_as_it_is_at_first(name: str) -> None:
    condition = CONDITIONS[name]
    units = {"°C": "25 °C", "%": "80 %", "cm": "none", "us": "0 ms"}
    written = units[next(iter(condition.dimension.units))] if condition.dimension else condition.initial
    assert parse({"duration": "1 s", "initial": {name: written}}).at(name, 0) == condition.initial


@pytest.mark.parametrize(("time", "text"), [(0, "0 ms"), (1, "0.001 ms"), (2_500_000, "2.5 s")])
def test_times_are_shown_as_people_write_them(time: int, text: str) -> None:
    assert shown(time) == text
