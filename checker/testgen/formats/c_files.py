"""A C99 program that runs the tests against a supervisor in C, through four functions of its user."""

from collections.abc import Callable, Iterator, Mapping, Sequence

from rovercheck.checker.results.board_steps import Changes
from rovercheck.checker.testgen.formats.expected_outputs import ExpectedTest, rows
from rovercheck.spec_model.abstraction import Board, BoardSignal, Value
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.domain import Bool, Num
from rovercheck.spec_model.lang.system import TICK_MS


def c_files(board: Board, tests: Sequence[ExpectedTest]) -> Mapping[str, str]:
    """The program ``cover_<board>.c`` and the header with the functions that it calls."""
    return {f"cover_{board.name}.h": _header(board), f"cover_{board.name}.c": _program(board, tests)}


def _header(board: Board) -> str:
    inputs = "".join(_member(s) for s in board.inputs)
    outputs = "".join(_member(o.signal) for o in board.outputs)
    return (
        f"/* What the covering tests of {board.name} call; made by `rovercheck generate-tests`. */\n"
        f"#ifndef COVER_{board.name.upper()}_H\n#define COVER_{board.name.upper()}_H\n\n"
        "#include <stdbool.h>\n#include <stdint.h>\n\n"
        f"struct inputs {{\n{inputs}}};\n\nstruct outputs {{\n{outputs}}};\n\n"
        "/* Write these four: back to power-up; the inputs of a step; the step; what it put out. */\n"
        "void reset(void);\nvoid set_inputs(const struct inputs *in);\n"
        "void step(void);\nvoid get_outputs(struct outputs *out);\n\n#endif\n"
    )


def _member(signal: BoardSignal) -> str:
    return f"    {_type(signal)} {signal.name}; /* {signal.doc or signal.domain.sort} */\n"


def _type(signal: BoardSignal) -> str:
    if signal.stamp:
        return "uint32_t"
    match signal.domain.sort:
        case Bool():
            return "bool"
        case Num(resolution, _) if not (signal.whole and resolution == 1):
            return "double"
    return "int32_t"


def _program(board: Board, tests: Sequence[ExpectedTest]) -> str:
    parts = (_start(board), *_tables(board, tests), _apply(board), _compare(board), MAIN)
    return "\n".join(parts)


def _start(board: Board) -> str:
    return (
        f"/* Covering tests of {board.name}, made by `rovercheck generate-tests`.\n"
        f"   Compile with your supervisor and the functions of cover_{board.name}.h:\n"
        f"   cc -std=c99 cover_{board.name}.c your_supervisor.c -lm */\n"
        f'#include "cover_{board.name}.h"\n\n#include <math.h>\n#include <stdio.h>\n\n'
        f"#define STEP_MS {TICK_MS}u\n#define NEAR 1e-6\n"
        f"#define INPUTS {len(board.inputs)}\n#define OUTPUTS {len(board.outputs)}\n\n"
        "struct change { int what; double value; }; /* an input, or INPUTS + an output */\n"
        "struct row { int held; int changes; };     /* steps with equal values; what changes before them */\n"
        "struct test { const char *name; int rows; };\n"
    )


def _tables(board: Board, tests: Sequence[ExpectedTest]) -> Iterator[str]:
    """The changes of all rows of all tests, one after the other."""
    names = [s.name for s in board.inputs] + [o.name for o in board.outputs]
    numbers = {name: number for number, name in enumerate(names)}
    shown = {test.name: rows(board, test) for test in tests}
    changes = "".join(f"    /* {n} */\n" + "".join(map(_changes(numbers), r)) for n, r in shown.items())
    counts = "".join(f"    {_counts(r)}\n" for r in shown.values())
    named = "".join(f'    {{"{name}", {len(r)}}},\n' for name, r in shown.items())
    yield (
        f"/* a stamp: 1, the datum is new in each of these steps; an output: NAN, any value will do */\n"
        f"static const struct change changes[] = {{\n{changes}}};\n"
    )
    yield f"static const struct row rows[] = {{\n{counts}}};\n"
    yield f"static const struct test tests[] = {{\n{named}}};\n"


def _changes(numbers: Mapping[str, int]) -> Callable[[Changes], str]:
    def shown(row: Changes) -> str:
        _, inputs, outputs = row
        both = {**inputs, **outputs}
        cells = ", ".join(f"{{{numbers[name]}, {_number(value)}}}" for name, value in both.items())
        return f"    {cells},\n" if cells else ""

    return shown


def _counts(found: Sequence[Changes]) -> str:
    return " ".join(f"{{{held}, {len(inputs) + len(outputs)}}}," for held, inputs, outputs in found)


def _number(value: Value | None) -> str:
    if value is None:
        return "NAN"
    return repr(int(value) if isinstance(value, bool) else value)


def _apply(board: Board) -> str:
    """C that makes the inputs of a step from the table."""
    lines = []
    for number, signal in enumerate(board.inputs):
        if signal.name == NOW:
            lines.append(f"    in->{signal.name} = now;")
        elif signal.stamp:
            lines.append(f"    if (at[{number}] != 0.0) in->{signal.name} = now;")
        elif _type(signal) == "bool":
            lines.append(f"    in->{signal.name} = at[{number}] != 0.0;")
        else:
            lines.append(f"    in->{signal.name} = ({_type(signal)})at[{number}];")
    rest = ", ".join("0.0" if s.stamp else f"{float(s.initial)!r}" for s in board.inputs)
    return (
        f"static const double at_rest[INPUTS] = {{{rest}}};\n\n"
        "static void apply(const double *at, uint32_t now, struct inputs *in)\n{\n"
        + "\n".join(lines)
        + "\n}\n"
    )


def _compare(board: Board) -> str:
    """C that compares the outputs of a step with the table."""
    calls = "\n".join(
        f'    wrong += differs("{o.name}", at[INPUTS + {n}], (double)out->{o.name});'
        for n, o in enumerate(board.outputs)
    )
    return (
        "static int differs(const char *name, double required, double actual)\n{\n"
        "    if (isnan(required) || fabs(required - actual) <= NEAR * fmax(1.0, fabs(required))) return 0;\n"
        '    printf("    %s: required %.9g, actual %.9g\\n", name, required, actual);\n'
        "    return 1;\n}\n\n"
        "static int compare(const double *at, const struct outputs *out)\n{\n    int wrong = 0;\n"
        f"{calls}\n    return wrong;\n}}\n"
    )


MAIN = """static int run(const struct test *test, const struct row **row, const struct change **change)
{
    double at[INPUTS + OUTPUTS];
    struct inputs in = {0};
    struct outputs out = {0};
    uint32_t now = 0;
    int wrong = 0;
    for (int i = 0; i < INPUTS + OUTPUTS; i++) at[i] = i < INPUTS ? at_rest[i] : NAN;
    reset();
    for (int r = 0; r < test->rows; r++, (*row)++) {
        for (int c = 0; c < (*row)->changes; c++, (*change)++) at[(*change)->what] = (*change)->value;
        for (int k = 0; k < (*row)->held; k++) {
            now += STEP_MS;
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
    printf("%d of %d tests passed\\n", all - failed, all);
    return failed != 0;
}
"""
