"""Which functions of a firmware begin, execute a step and end, and what has to be declared to call them."""

from dataclasses import dataclass, field

from rovercheck.checker.mapping.declarations import CDeclarations, CDeclared, CFunction
from rovercheck.checker.mapping.words import words

INITIALIZE = ("initialize", "initialise", "init", "setup", "reset", "start", "begin", "powerup", "boot")
STEP = (
    "step",
    "task",
    "run",
    "cycle",
    "update",
    "tick",
    "execute",
    "exec",
    "periodic",
    "loop",
    "main",
    "process",
)
TERMINATE = ("terminate", "deinit", "shutdown", "end", "stop", "close", "exit", "finish")
CALLED_BY_SYSTEMS = frozenset({"main", "app_main"})


@dataclass
class EntryPoints:
    """What a map calls; ``remarks`` say what was chosen, and what else could have been."""

    initialize: list[str] = field(default_factory=list)
    step: list[str] = field(default_factory=list)
    terminate: list[str] = field(default_factory=list)
    declarations: list[str] = field(default_factory=list)
    own: list[tuple[CDeclared, str]] = field(default_factory=list)
    """Variables of the map itself for parameters and results, and whether they are input or output."""
    headers: list[str] = field(default_factory=list)
    remarks: dict[str, str] = field(default_factory=dict)
    mains: list[str] = field(default_factory=list)
    """Files with the main program of the firmware, which is not called."""


def entry_points(found: CDeclarations) -> EntryPoints:
    """The functions of a firmware that a map calls."""
    entry = EntryPoints()
    entry.mains = sorted({f.file.name for f in found.functions if f.defined and f.name in CALLED_BY_SYSTEMS})
    callers = _callers(found)
    for key, wanted in (("initialize", INITIALIZE), ("step", STEP), ("terminate", TERMINATE)):
        _choose(entry, found, key, wanted, callers)
    return entry


def _callers(found: CDeclarations) -> dict[str, set[str]]:
    """Who calls a function, main programs left out: they are what calls the step on the target."""
    callers: dict[str, set[str]] = {}
    for one in found.functions:
        if one.name not in CALLED_BY_SYSTEMS:
            for called in one.calls:
                callers.setdefault(called, set()).add(one.name)
    return callers


def _choose(
    entry: EntryPoints, found: CDeclarations, key: str, wanted: tuple[str, ...], callers: dict[str, set[str]]
) -> None:
    candidates: dict[str, CFunction] = {}
    for one in found.functions:
        fits = not one.static and one.name not in CALLED_BY_SYSTEMS and _fits(one, key, wanted)
        if fits and (one.name not in candidates or one.in_header):
            candidates[one.name] = one
    defined = {f.name for f in found.functions if f.defined}
    here = {name: f for name, f in candidates.items() if name in defined} or candidates
    roots = [f for name, f in here.items() if not callers.get(name, set()) & here.keys()] or [*here.values()]
    roots.sort(key=lambda f: (not f.in_header, _rank(f, wanted), f.file.name, f.line))
    if not roots:
        if key != "terminate":
            entry.remarks[key] = f"? no function looks like {key} (names with {', '.join(wanted[:5])})"
        return
    first = roots[0]
    others = [f.name for f in roots[1:]]
    inner = sorted(set(here) - {f.name for f in roots})
    why = f"{first.file.name}, line {first.line}"
    why += f"; it calls {', '.join(inner)}" if inner else ""
    entry.remarks[key] = f"check: also {', '.join(others)} could be meant; {why}" if others else why
    getattr(entry, key).append(_call(entry, first, key))
    if first.in_header:
        entry.headers.append(first.file.name)
    else:
        _declared(entry, first)


def _fits(one: CFunction, key: str, wanted: tuple[str, ...]) -> bool:
    own = words(one.name)
    if key == "step" and set(own) & {*INITIALIZE[:4], *TERMINATE[:3]}:
        return False
    return bool(set(own) & set(wanted)) or (key == "step" and any(w.endswith("ms") for w in own))


def _rank(one: CFunction, wanted: tuple[str, ...]) -> int:
    own = words(one.name)
    return min((wanted.index(word) for word in own if word in wanted), default=len(wanted))


def _call(entry: EntryPoints, one: CFunction, key: str) -> str:
    """The call, with a variable of the map for each parameter and for the result."""
    given = []
    for number, parameter in enumerate(one.parameters, 1):
        name = f"map_{parameter.name or f'argument{number}'}"
        if not any(own.name == name for own, _ in entry.own):
            pointed = parameter.pointer or bool(parameter.dimensions)
            role = "input" if parameter.const or not pointed else "output" if _out(parameter) else ""
            own = CDeclared(name, parameter.type, parameter.dimensions)
            entry.own.append((own, role))
            sizes = "".join(f"[{size}]" for size in parameter.dimensions)
            entry.declarations.append(f"static {_written(entry, parameter.type)} {name}{sizes};")
        given.append(f"&{name}" if parameter.pointer else name)
    call = f"{one.name}({', '.join(given)})"
    if key == "step" and one.declared.type != "void" and not one.declared.pointer:
        own = CDeclared("map_result", one.declared.type)
        entry.own.append((own, "output"))
        entry.declarations.append(f"static {one.declared.type} map_result;")
        return f"map_result = {call}"
    return call if given else one.name


def _out(parameter: CDeclared) -> bool:
    return bool(
        {*words(parameter.name), *words(parameter.type)} & {"out", "output", "outputs", "y", "result"}
    )


def _written(entry: EntryPoints, type: str) -> str:
    return type.replace("@", "unnamed ")


def _declared(entry: EntryPoints, one: CFunction) -> None:
    """A function that no header declares."""
    parameters = ", ".join(f"{'const ' * p.const}{p.type} {'*' * p.pointer}{p.name}" for p in one.parameters)
    entry.declarations.append(f"extern {one.declared.type} {one.name}({parameters or 'void'});")
