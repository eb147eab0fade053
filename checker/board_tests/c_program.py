"""Tests as a C99 program that runs a supervisor in C through four functions of its user."""

import re
import textwrap
from collections.abc import Iterable, Iterator, Sequence

from rovercheck.checker.board_tests.rows import Row, by_board, rows, start_ms
from rovercheck.checker.results.board_test import BoardTest, BoardUnderTest, SignalKind, StepSignal, Value

_TYPES = {
    SignalKind.BOOL: "bool", SignalKind.WHOLE: "int32_t", SignalKind.NUMBER: "double",
    SignalKind.CLOCK: "uint32_t", SignalKind.STAMP: "uint32_t",
}  # fmt: skip
WIDTH = 106
NEXT = "\n   "
"""Between the lines of a comment."""


def c_program(about: Sequence[str], tests: Sequence[BoardTest], header: str = "") -> str:
    """The text of the program; ``about`` are the paragraphs with which it begins.

    Of tests of several boards, each board is compiled by itself.  ``header`` names a file with the
    ``interface`` of the board; without it the program holds that itself.
    """
    of_board = by_board(tests)
    several = len(of_board) > 1
    parts = [_about(about, of_board if several else ()), "#include <math.h>\n#include <stdio.h>\n"]
    parts += ["#ifndef BOARD\n#define BOARD 1\n#endif\n"] if several else []
    for number, (board, found) in enumerate(of_board.items(), start=1):
        parts += [f"#if BOARD == {number} /* {_plain(board.name)} */\n"] if several else []
        parts += [f'#include "{header}"\n' if header else interface(board)]
        parts += [_tables(board, found), _apply(board), _compare(board), MAIN.replace("BOARD", board.name)]
        parts += ["#endif\n"] if several else []
    return "\n".join(parts)


def interface(board: BoardUnderTest) -> str:
    """What a header has: the inputs and outputs of a board, and the functions that a program calls."""
    guard = f"COVER_{board.name.upper()}_H"
    inputs, outputs = ("".join(map(_member, signals)) for signals in (board.inputs, board.outputs))
    return (
        f"/* {_plain(board.name)}, as its tests call it. */\n#ifndef {guard}\n#define {guard}\n\n"
        "#include <stdbool.h>\n#include <stdint.h>\n\n"
        f"struct inputs {{\n{inputs}}};\n\nstruct outputs {{\n{outputs}}};\n\n"
        "/* Write these four: back to power-up; the inputs of a step; the step; what it put out. */\n"
        "void reset(void);\nvoid set_inputs(const struct inputs *in);\n"
        "void step(void);\nvoid get_outputs(struct outputs *out);\n\n#endif\n"
    )


def _about(paragraphs: Sequence[str], several: Iterable[BoardUnderTest]) -> str:
    boards = [f"-DBOARD={number} for {_plain(board.name)}" for number, board in enumerate(several, start=1)]
    compile_with = "Compile with your supervisor and the four functions that are declared:"
    lines = [*paragraphs, compile_with, "cc -std=c99 THIS_FILE.c your_supervisor.c -lm", *boards]
    wrapped = (line for text in lines for line in textwrap.wrap(_plain(text), WIDTH))
    return f"/* {NEXT.join(wrapped)} */\n"


def _member(signal: StepSignal) -> str:
    return f"    {_TYPES[signal.kind]} {signal.name}; /* {_plain(signal.doc)} */\n"


def _tables(board: BoardUnderTest, tests: Sequence[BoardTest]) -> str:
    """The tests, their rows, and the changes of all rows, one after the other."""
    numbers = {s.name: n for n, s in enumerate((*board.inputs, *board.outputs))}
    shown = [(test, rows(test)) for test in tests]
    changes = "".join(_title(t) + "".join(_changes(numbers, row) for row in found) for t, found in shown)
    counts = "".join(f"    {_counts(found)}\n" for _, found in shown)
    named = "".join(f'    {{"{_word(t.name)}", {len(found)}, {start_ms(t)}u}},\n' for t, found in shown)
    return (
        f"#define STEP_MS {board.tick_ms}u\n#define NEAR 1e-6\n"
        f"#define INPUTS {len(board.inputs)}\n#define OUTPUTS {len(board.outputs)}\n\n"
        "struct change { int what; double value; }; /* an input, or INPUTS + an output */\n"
        "struct row { int held; int changes; };     /* equal steps, and what changes before them */\n"
        "struct test { const char *name; int rows; uint32_t start_ms; };\n\n"
        "/* a stamp: how many ms before the step its datum came, NAN: none comes;\n"
        "   an output: NAN, any value will do */\n"
        f"static const struct change changes[] = {{\n{changes}    {{0, 0}}\n}};\n\n"
        f"static const struct row rows[] = {{\n{counts}}};\n\n"
        f"static const struct test tests[] = {{\n{named}}};\n"
    )


def _title(test: BoardTest) -> str:
    return f"    /* {NEXT.join(map(_plain, (test.name, *test.goals)))} */\n"


def _changes(numbers: dict[str, int], row: Row) -> str:
    _, inputs, outputs = row
    cells = [f"{{{numbers[n]}, {_number(v)}}}," for n, v in (*inputs.items(), *outputs.items())]
    return f"    {' '.join(cells)}\n" if cells else ""


def _counts(found: Sequence[Row]) -> str:
    return " ".join(f"{{{held}, {len(inputs) + len(outputs)}}}," for held, inputs, outputs in found)


def _number(value: Value | None) -> str:
    return "NAN" if value is None else repr(int(value) if isinstance(value, bool) else value)


def _apply(board: BoardUnderTest) -> str:
    """C that makes the inputs of a step from the table."""
    rest = ", ".join("NAN" if s.kind is SignalKind.STAMP else f"{float(s.initial)!r}" for s in board.inputs)
    return (
        f"static const double at_rest[INPUTS] = {{{rest}}};\n\n"
        "static void apply(const double *at, uint32_t now, struct inputs *in)\n{\n"
        f"{_indented(_inputs(board))}}}\n"
    )


def _inputs(board: BoardUnderTest) -> Iterator[str]:
    for number, signal in enumerate(board.inputs):
        match signal.kind:
            case SignalKind.CLOCK:
                yield f"in->{signal.name} = now;"
            case SignalKind.STAMP:
                yield f"if (!isnan(at[{number}])) in->{signal.name} = now - (uint32_t)at[{number}];"
            case SignalKind.BOOL:
                yield f"in->{signal.name} = at[{number}] != 0.0;"
            case kind:
                yield f"in->{signal.name} = ({_TYPES[kind]})at[{number}];"


def _compare(board: BoardUnderTest) -> str:
    """C that compares the outputs of a step with the table."""
    calls = _indented(
        f'wrong += differs("{o.name}", at[INPUTS + {n}], (double)out->{o.name});'
        for n, o in enumerate(board.outputs)
    )
    return (
        "static int differs(const char *name, double required, double actual)\n{\n"
        "    if (isnan(required) || fabs(required - actual) <= NEAR * fmax(1.0, fabs(required))) return 0;\n"
        '    printf("    %s: required %.9g, actual %.9g\\n", name, required, actual);\n'
        "    return 1;\n}\n\n"
        "static int compare(const double *at, const struct outputs *out)\n{\n    int wrong = 0;\n"
        f"{calls}    return wrong;\n}}\n"
    )


def _indented(lines: Iterable[str]) -> str:
    return "".join(f"    {line}\n" for line in lines)


def _plain(text: str) -> str:
    """Text that can stand in a comment."""
    shown = " ".join(text.split()).replace("*/", "* /").replace("/*", "/ *")
    return re.sub(r"\?(?=\?)", "? ", shown).rstrip("\\")


def _word(text: str) -> str:
    """Text that can stand in a string."""
    return _plain(text).replace("\\", "/").replace('"', "'")


MAIN = """static int run(const struct test *test, const struct row **row, const struct change **change)
{
    double at[INPUTS + OUTPUTS];
    struct inputs in = {0};
    struct outputs out = {0};
    uint32_t now = test->start_ms;
    int wrong = 0;
    for (int i = 0; i < INPUTS + OUTPUTS; i++) at[i] = i < INPUTS ? at_rest[i] : NAN;
    reset();
    for (int r = 0; r < test->rows; r++, (*row)++) {
        for (int c = 0; c < (*row)->changes; c++, (*change)++) at[(*change)->what] = (*change)->value;
        for (int k = 0; k < (*row)->held; k++, now += STEP_MS) {
            if (wrong) continue; /* only the first step that differs is shown */
            apply(at, now, &in);
            set_inputs(&in);
            step();
            get_outputs(&out);
            wrong = compare(at, &out);
            if (wrong) printf("  in %s at %lu ms\\n", test->name, (unsigned long)now);
        }
    }
    return wrong != 0;
}

int main(void)
{
    const struct row *row = rows;
    const struct change *change = changes;
    const int all = (int)(sizeof tests / sizeof tests[0]);
    int failed = 0;
    for (int t = 0; t < all; t++) failed += run(&tests[t], &row, &change);
    printf("BOARD: %d of %d tests passed\\n", all - failed, all);
    return failed != 0;
}
"""
