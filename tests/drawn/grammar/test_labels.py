"""Labels of states and transitions: where each part begins and ends."""

import pytest

from rovercheck.checker.drawn.grammar.labels import (
    LabelSection,
    SectionKind,
    StateLabel,
    TransitionLabel,
    parse_state_label,
    parse_transition_label,
)
from rovercheck.checker.drawn.grammar.syntax import ActionLanguage
from tests.drawn.grammar.shapes import state, transition

MATLAB, C, C_BITS = ActionLanguage.MATLAB, ActionLanguage.C, ActionLanguage.C_BITS

STATES = [
    ("Idle", ["Idle"]),
    ("Idle/", ["Idle"]),
    ("\n Idle \n", ["Idle"]),
    ("Idle % rests\n", ["Idle"]),
    ("Off\nen: level = 0;", ["Off", "entry: level = 0"]),
    ("Off/\nen: level = 0;", ["Off", "entry: level = 0"]),
    ("Off/en: level = 0;", ["Off", "entry: level = 0"]),
    ("Off\n\n  entry:\n  level = 0;\n", ["Off", "entry: level = 0"]),
    ("Heat/heating = true;", ["Heat", "implied: heating = true"]),
    ("Heat\na = 1; b = 2\ndu: c", ["Heat", "implied: a = 1 | b = 2", "during: c"]),
    ("A/en, du: x = 1; ex: y = 2;", ["A", "entry,during: x = 1", "exit: y = 2"]),
    ("A\nentry,during,exit:x=1", ["A", "entry,during,exit: x = 1"]),
    ("A\nen: a\nen: b", ["A", "entry: a", "entry: b"]),
    ("A\nen: a % one\ndu: b // two\nex: c /* three: */", ["A", "entry: a", "during: b", "exit: c"]),
    ("A\non HIT: n = n + 1;", ["A", "on HIT: n = (+ n 1)"]),
    ("A\non S.E: n", ["A", "on S.E: n"]),
    ("A\non E | F: n", ["A", "on E F: n"]),
    ("A\non after(3, sec): a\non every(2, E): b", ["A", "on after(3, sec): a", "on every(2, E): b"]),
    ("A\nen, on before(2, tick): a; du:", ["A", "entry,on before(2, tick): a", "during: "]),
    ("A\non at(f(1), tick), ex: a", ["A", "on,exit at(f(1), tick): a"]),
    ("A\nbind: x, E;\nen: x = 1", ["A", "bind: x | E", "entry: x = 1"]),
    ("A\nen: x = y(1:3); on = 1; ex = 2", ["A", "entry: x = y((: 1 3)) | on = 1 | ex = 2"]),
    ("A\nen:\nif x\n y = 1;\nend\ndu: z", ["A", "entry: if x <y = 1>", "during: z"]),
    ("A\nen: x = 1; % du: y\nex: z", ["A", "entry: x = 1", "exit: z"]),
    ("A\nen: x = 'du: y'; du: z", ["A", "entry: x = 'du: y'", "during: z"]),
    ("A\nen: x = a / b / c;", ["A", "entry: x = (/ (/ a b) c)"]),
]
STATES_IN_C = [
    ("Busy/\nduring: mean = quot(mean + raw, 2); /* to 0 */\nflags = mode / 2", [
        "Busy", "during: mean = quot((+ mean raw), 2i) | flags = (/ mode 2i)"
    ]),
    ("A\nen: x = 1\ndu: x++; ex: E", ["A", "entry: x = 1i", "during: x +1", "exit: E"]),
    ("A/ x = 1;", ["A", "implied: x = 1i"]),
]  # fmt: skip

TRANSITIONS: list[tuple[str, tuple[list[str], str, str, str]]] = [
    ("", ([], "", "", "")),
    ("?", ([], "", "", "")),
    (" \n", ([], "", "", "")),
    ("% nothing", ([], "", "", "")),
    ("[]", ([], "", "", "")),
    ("E", (["E"], "", "", "")),
    ("A | B", (["A", "B"], "", "", "")),
    ("A\n| B\n[c]", (["A", "B"], "c", "", "")),
    ("S.E[x]", (["S.E"], "x", "", "")),
    ("after(3, sec)", (["after(3, sec)"], "", "", "")),
    ("after(10, tick)[c]", (["after(10, tick)"], "c", "", "")),
    ("every(2, E) | at(4, F)", (["every(2, E)", "at(4, F)"], "", "", "")),
    ("enter(S) | exit(S.T) | change(u)", (["enter(S)", "exit(S.T)", "change(u)"], "", "", "")),
    ("[button]", ([], "button", "", "")),
    ("[start && ~door]", ([], "(&& start (! door))", "", "")),
    ("[~button && after(0.5, sec) || ...\n after(5, sec)]", (
        [], "(|| (&& (! button) after(1/2, sec)) after(5, sec))", "", ""
    )),
    ("[a ...\n&& b\n&& c]", ([], "(&& (&& a b) c)", "", "")),
    ("[a -1 > 0]", ([], "(> (- a 1) 0)", "", "")),
    ("{x = 1;}", ([], "", "x = 1", "")),
    ("{eML_blk_kernel();}", ([], "", "eML_blk_kernel()", "")),
    ("/x = 1; y = 2", ([], "", "", "x = 1 | y = 2")),
    ("/{x = 1;}", ([], "", "", "x = 1")),
    ("{a}{b}/{c}{d}", ([], "", "a | b", "c | d")),
    ("{a};\n/\nb;", ([], "", "a", "b")),
    ("START[speed > 0]{n = 0;}/go = true;", (["START"], "(> speed 0)", "n = 0", "go = true")),
    ("START % begin\n[speed > 0] // fast\n{\nn = 0;\nm = 1\n}\n/ go = true;", (
        ["START"], "(> speed 0)", "n = 0 | m = 1", "go = true"
    )),
    ("[a / b > 1 / 2] / x = a / b;", ([], "(> (/ a b) (/ 1 2))", "", "x = (/ a b)")),
    ("[a] /* why */ / b // done / x", ([], "a", "", "b")),
    ("[x == ']'] {y = '}';}", ([], "(== x ']')", "y = '}'", "")),
    ("{y = x';} / z = [1 2]';", ([], "", "y = (' x)", "z = (' [1 2])")),
    ("{if a\n b = 1;\nend}", ([], "", "if a <b = 1>", "")),
    ("[isLost(clock_ms, taken_ms)]", ([], "isLost(clock_ms, taken_ms)", "", "")),
    ("[duration(level >= 12.5) > 0.5]", ([], "(> duration((>= level 25/2)) 1/2)", "", "")),
    ("[hasChanged(request) && request]\n{\ncount = count + 1;\n}", (
        [], "(&& hasChanged(request) request)", "count = (+ count 1)", ""
    )),
]  # fmt: skip
TRANSITIONS_IN_C: list[tuple[str, tuple[list[str], str, str, str]]] = [
    ("E[a[1] > 0]{x[2]++;}", (["E"], "(> a[1i] 0i)", "x[2i] +1", "")),
    ("[raw < 0] {trace += 10;} / trace += 100;", ([], "(< raw 0i)", "trace += 10i", "trace += 100i")),
    ("[!(mode & 0x01)]", ([], "(! (bit& mode 1b))", "", "")),
    ("after(3, E)[x]", (["after(3i, E)"], "x", "", "")),
    ("{x = 1\n y = 2}", ([], "", "x = 1i | y = 2i", "")),
]


@pytest.mark.parametrize(("text", "parts"), STATES)
def test_state(text: str, parts: list[str]) -> None:
    assert state(parse_state_label(text, MATLAB)) == parts


@pytest.mark.parametrize(("text", "parts"), STATES_IN_C)
def test_state_in_c(text: str, parts: list[str]) -> None:
    assert state(parse_state_label(text, C)) == parts


@pytest.mark.parametrize(("text", "parts"), TRANSITIONS)
def test_transition(text: str, parts: tuple[list[str], str, str, str]) -> None:
    assert transition(parse_transition_label(text, MATLAB)) == parts


@pytest.mark.parametrize(("text", "parts"), TRANSITIONS_IN_C)
def test_transition_in_c(text: str, parts: tuple[list[str], str, str, str]) -> None:
    assert transition(parse_transition_label(text, C_BITS)) == parts


def test_records() -> None:
    assert parse_transition_label("?", C) == TransitionLabel()
    assert parse_state_label("A\nen:", C) == StateLabel("A", (LabelSection((SectionKind.ENTRY,), (), ()),))


def test_places_of_sections() -> None:
    label = parse_state_label("A\n a;\n du: b", MATLAB)
    assert [part.at for part in label.sections] == [3, 7]
