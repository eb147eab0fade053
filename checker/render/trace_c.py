"""A trace as a C99 program that gives the same run to a supervisor through four functions of its user.

The functions and structures are those of ``rovercheck generate-tests --format c``.  It needs the run as the
boards see it (``Trace.concrete``); of a run of several boards, each is compiled by itself.
"""

from collections.abc import Iterable

from rovercheck.checker.render.trace_pytest import required
from rovercheck.checker.results.board_steps import BoardRun, SignalKind, StepSignal, Value, held
from rovercheck.checker.results.format import Format, Need
from rovercheck.checker.results.trace import Trace

FORMAT = Format(
    "c",
    "trace",
    ".c",
    "C99 program: the run given to your board functions, outputs compared",
    needs=frozenset({Need.BOARD_STEPS}),
)
"""Shows the run as the boards see it."""

_TYPES = {
    SignalKind.BOOL: "bool", SignalKind.WHOLE: "int32_t", SignalKind.NUMBER: "double",
    SignalKind.CLOCK: "uint32_t", SignalKind.STAMP: "uint32_t",
}  # fmt: skip


def render(trace: Trace) -> str:
    """The text of the program.  Raises ``ModelError`` for a run that is not known as a board sees it."""
    runs = required(trace)
    parts = [
        _about(trace, runs),
        "#include <math.h>\n#include <stdbool.h>\n#include <stdint.h>\n#include <stdio.h>\n",
    ]
    if len(runs) > 1:
        parts += ["#ifndef BOARD\n#define BOARD 1\n#endif\n"]
    for number, run in enumerate(runs, start=1):
        both = len(runs) > 1
        parts += [f"#if BOARD == {number} /* {_plain(run.board)} */\n"] if both else []
        parts += [_interface(run), _tables(run), _apply(run), _compare(run), _main(trace, run)]
        parts += ["#endif\n"] if both else []
    return "\n".join(parts)


def _about(trace: Trace, runs: tuple[BoardRun, ...]) -> str:
    other = "".join(f"   -DBOARD={n} for {_plain(r.board)}\n" for n, r in enumerate(runs, 1) if len(runs) > 1)
    return (
        f"/* {_plain(trace.property.id or trace.system.name)}: {_plain(trace.property.text)}\n"
        f"   A run of {_plain(trace.system.name)}, written by `rovercheck trace`.\n"
        "   The outputs required are those of the charts.\n"
        "   Compile with your supervisor and the four functions below:\n"
        f"   cc -std=c99 THIS.c your_supervisor.c -lm\n{other}*/\n"
    )


def _interface(run: BoardRun) -> str:
    guard = f"COVER_{run.board.upper()}_H"
    members = ["".join(map(_member, signals)) for signals in (run.inputs, run.outputs)]
    return (
        f"#ifndef {guard}\n#define {guard}\n\n"
        f"struct inputs {{\n{members[0]}}};\n\nstruct outputs {{\n{members[1]}}};\n\n"
        "/* Write these four: back to power-up; the inputs of a step; the step; what it put out. */\n"
        "void reset(void);\nvoid set_inputs(const struct inputs *in);\n"
        "void step(void);\nvoid get_outputs(struct outputs *out);\n\n#endif\n\n"
        f"#define STEP_MS {run.tick_ms}u\n#define NEAR 1e-6\n"
        f"#define INPUTS {len(run.inputs)}\n#define OUTPUTS {len(run.outputs)}\n"
    )


def _member(signal: StepSignal) -> str:
    return f"    {_TYPES[signal.kind]} {signal.name}; /* {_plain(signal.doc)} */\n"


def _tables(run: BoardRun) -> str:
    """The rows, and the changes of all rows one after the other."""
    numbers = {s.name: n for n, s in enumerate((*run.inputs, *run.outputs))}
    rows = held(run)
    changes = "".join(
        "    "
        + " ".join(f"{{{numbers[n]}, {_number(v)}}}," for n, v in (*given.items(), *wanted.items()))
        + "\n"
        for _, given, wanted in rows
        if given or wanted
    )
    counts = "".join(f"    {{{count}, {len(given) + len(wanted)}}},\n" for count, given, wanted in rows)
    return (
        "struct change { int what; double value; }; /* an input, or INPUTS + an output */\n"
        "struct row { int held; int changes; };     /* equal steps, and what changes before them */\n\n"
        "/* a stamp: how many ms before the step its datum came, NAN: none comes;\n"
        "   an output: NAN, any value will do */\n"
        f"static const struct change changes[] = {{\n{changes or '    {0, 0},' + chr(10)}}};\n\n"
        f"static const struct row rows[] = {{\n{counts}}};\n"
    )


def _number(value: Value | None) -> str:
    return "NAN" if value is None else repr(int(value) if isinstance(value, bool) else value)


def _apply(run: BoardRun) -> str:
    """C that makes the inputs of a step from the table."""
    lines = []
    for number, signal in enumerate(run.inputs):
        match signal.kind:
            case SignalKind.CLOCK:
                lines.append(f"in->{signal.name} = now;")
            case SignalKind.STAMP:
                lines.append(f"if (!isnan(at[{number}])) in->{signal.name} = now - (uint32_t)at[{number}];")
            case SignalKind.BOOL:
                lines.append(f"in->{signal.name} = at[{number}] != 0.0;")
            case kind:
                lines.append(f"in->{signal.name} = ({_TYPES[kind]})at[{number}];")
    rest = ", ".join("NAN" if s.kind is SignalKind.STAMP else f"{float(s.initial)!r}" for s in run.inputs)
    return (
        f"static const double at_rest[INPUTS] = {{{rest}}};\n\n"
        "static void apply(const double *at, uint32_t now, struct inputs *in)\n{\n" + _indented(lines) + "}\n"
    )


def _compare(run: BoardRun) -> str:
    """C that compares the outputs of a step with the table."""
    calls = _indented(
        f'wrong += differs("{o.name}", at[INPUTS + {n}], (double)out->{o.name});'
        for n, o in enumerate(run.outputs)
    )
    return (
        "static int differs(const char *name, double required, double actual)\n{\n"
        "    if (isnan(required) || fabs(required - actual) <= NEAR * fmax(1.0, fabs(required))) return 0;\n"
        '    printf("    %s: required %.9g, actual %.9g\\n", name, required, actual);\n'
        "    return 1;\n}\n\n"
        "static int compare(const double *at, const struct outputs *out)\n{\n    int wrong = 0;\n"
        f"{calls}    return wrong;\n}}\n"
    )


def _main(trace: Trace, run: BoardRun) -> str:
    title = (
        _plain(trace.property.id or trace.system.name).replace("\\", "/").replace('"', "'").replace("%", "%%")
    )
    return MAIN.replace("TITLE", f"{title} on {run.board}")


def _indented(lines: Iterable[str]) -> str:
    return "".join(f"    {line}\n" for line in lines)


def _plain(text: str) -> str:
    """Text that can stand in a comment."""
    return " ".join(text.split()).replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?").rstrip("\\")


MAIN = """int main(void)
{
    const struct change *change = changes;
    double at[INPUTS + OUTPUTS];
    struct inputs in = {0};
    struct outputs out = {0};
    uint32_t now = 0;
    for (int i = 0; i < INPUTS + OUTPUTS; i++) at[i] = i < INPUTS ? at_rest[i] : NAN;
    reset();
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        for (int c = 0; c < rows[r].changes; c++, change++) at[change->what] = change->value;
        for (int k = 0; k < rows[r].held; k++) {
            now += STEP_MS;
            apply(at, now, &in);
            set_inputs(&in);
            step();
            get_outputs(&out);
            if (compare(at, &out)) {
                printf("TITLE: differs at %lu ms\\n", (unsigned long)now);
                return 1;
            }
        }
    }
    printf("TITLE: all %lu steps as required\\n", (unsigned long)(now / STEP_MS));
    return 0;
}
"""
