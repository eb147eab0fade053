"""The C file between us and a C supervisor: the compiler checks every name and type of the mapping file."""

from collections.abc import Iterator

from rovercheck.checker.adapters.c_map import CMap, CPlace

OWN = "rovercheck.c"
"""What the compiler calls the lines that are not of the mapping file."""
PRELUDE = """\
#define ROVERCHECK_FLOATING(place) _Generic((place), float: 1, double: 1, long double: 1, default: 0)
#define ROVERCHECK_TYPE(place) _Generic((place), _Bool: "bool", char: "char", signed char: "signed char", \\
    unsigned char: "unsigned char", short: "short", unsigned short: "unsigned short", int: "int", \\
    unsigned int: "unsigned int", long: "long", unsigned long: "unsigned long", long long: "long long", \\
    unsigned long long: "unsigned long long", float: "float", double: "double", \\
    long double: "long double", default: "integer")
#define ROVERCHECK_FINITE(value) ((value) - (value) == 0)
/* A place that does not hold the value afterwards cannot hold it. */
#define ROVERCHECK_SET(place, number) do { \\
        const double rovercheck_value = rovercheck_in[number]; \\
        if (ROVERCHECK_FLOATING(place)) { \\
            (place) = rovercheck_value; \\
            if (ROVERCHECK_FINITE(rovercheck_value) && !ROVERCHECK_FINITE((double)(place))) \\
                return number + 1; \\
        } else { \\
            if (!(rovercheck_value > -9.2e18 && rovercheck_value < 9.2e18)) return number + 1; \\
            (place) = (long long)rovercheck_value; \\
            if ((double)(place) != rovercheck_value) return number + 1; \\
        } \\
    } while (0)
"""


def shim(c: CMap) -> str:
    """The source, in C11."""
    return "\n".join(_lines(c)) + "\n"


def constants(c: CMap) -> list[tuple[CPlace, str]]:
    """Every expression whose value the compiler is asked for, place by place: ``asked`` of each."""
    return [(place, text) for place in (*c.inputs, *c.outputs) for text in asked(place)]


def asked(place: CPlace) -> list[str]:
    """Scale and offset where they are no numbers, then the constants of values, then those of no value."""
    named = [text for text in (place.scale, place.offset) if isinstance(text, str)]
    return [*named, *(text for texts in place.values.values() for text in texts), *place.not_yet]


def _lines(c: CMap) -> Iterator[str]:
    yield f"/* Written by rovercheck from {c.file.name}. */"
    for header in c.header:
        yield from (
            _at(c, "header"),
            f"#include {header}" if header.startswith("<") else f'#include "{header}"',
        )
    yield from (_at(c, "declarations"), c.declarations, f'#line 1 "{OWN}"', PRELUDE)
    yield from _types(c, "input", c.inputs)
    yield from _types(c, "output", c.outputs)
    yield from _constants(c)
    yield from _function(c, "rovercheck_initialize", "initialize", c.initialize)
    yield from _function(c, "rovercheck_terminate", "terminate", c.terminate)
    yield "int rovercheck_step(const double *rovercheck_in, double *rovercheck_out) {"
    for at, value in c.constants.items():
        yield from (_at(c, f"[constants] {at}"), f"({at}) = ({value});")
    for number, place in enumerate(c.inputs):
        yield from (_at(c, f"[inputs] {place.signal}"), _assigned(place, number))
    for call in c.step:
        yield from (_at(c, "step"), _statement(call))
    for number, place in enumerate(c.outputs):
        held = f"(({place.at}) & ({place.mask})) != 0" if place.mask else place.at
        yield from (_at(c, f"[outputs] {place.signal}"), f"rovercheck_out[{number}] = (double)({held});")
    yield "return 0; }"


def _types(c: CMap, what: str, places: tuple[CPlace, ...]) -> Iterator[str]:
    """The type of each place; one that cannot be assigned to, or is no number, is refused here."""
    yield f"const char *rovercheck_{what}_type(int number) {{ switch (number) {{"
    for number, place in enumerate(places):
        tried = f"{place.at} = 1.0" if what == "input" else f"(void)(double)({place.at})"
        yield _at(c, f"[{what}s] {place.signal}")
        yield f"case {number}: if (0) {{ {tried}; }} return ROVERCHECK_TYPE({place.at});"
    yield 'default: return ""; } }'


def _assigned(place: CPlace, number: int) -> str:
    """What gives an input to the supervisor."""
    value = f"rovercheck_in[{number}]"
    if place.mask:
        return (
            f"{place.at} = {value} != 0 ? (({place.at}) | ({place.mask})) : (({place.at}) & ~({place.mask}));"
        )
    if place.wraps or place.counts:
        return f"{place.at} = (unsigned long long){value};"
    return f"ROVERCHECK_SET({place.at}, {number});"


def _constants(c: CMap) -> Iterator[str]:
    yield "double rovercheck_constant(int number) { switch (number) {"
    for number, (place, value) in enumerate(constants(c)):
        yield from (_at(c, f"constants of {place.signal}"), f"case {number}: return (double)({value});")
    yield "default: return 0; } }"


def _function(c: CMap, name: str, key: str, calls: tuple[str, ...]) -> Iterator[str]:
    yield f"void {name}(void) {{"
    for call in calls:
        yield from (_at(c, key), _statement(call))
    yield "}"


def _statement(call: str) -> str:
    """A function by its name, or a statement."""
    call = call.strip().rstrip(";")
    return f"{call}();" if call.isidentifier() else f"{call};"


def _at(c: CMap, where: str) -> str:
    """Have the compiler name the entry of the mapping file."""
    file = str(c.file).replace("\\", "/").replace('"', "'")
    return f'#line 1 "{file}, {where}"'
