"""Faults of one chart: of its transitions with guards, targets and priorities, its actions, its regions."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rovercheck.checker.mutate.formulas import BESIDE, other, slips
from rovercheck.spec_model.lang.action import Action, Assign, If, each_action, reads, writes
from rovercheck.spec_model.lang.chart import Block, Chart, Junction, Path, State, Transition
from rovercheck.spec_model.lang.domain import Bool
from rovercheck.spec_model.lang.edit import edit_at
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Apply, Const, Expr, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.place import Place
from rovercheck.spec_model.lang.walk import plain, variables

# --- slips in lists of actions -------------------------------------------------------------------------

Actions = tuple[Action, ...]


@dataclass(frozen=True)
class ActionSlip:
    """Actions with a fault in one of them: the operator, the fault in words, and all the actions."""

    operator: str
    text: str
    whole: Actions


def paired(actions: Sequence[Action]) -> dict[int, Var]:
    """For assignments of a variable to a variable, by ``id``, what the next such one of their domain assigns.

    These are fields of frames that may be taken for each other.
    """
    copies = [
        (a, value)
        for a in each_action(actions)
        if isinstance(a, Assign) and isinstance(value := plain(a.value), Var)
    ]
    found: dict[int, Var] = {}
    for place, (action, value) in enumerate(copies):
        for _, candidate in (*copies[place + 1 :], *copies[:place]):
            if candidate.name != value.name and candidate.domain == value.domain:
                found[id(action)] = candidate
                break
    return found


def action_slips(actions: Sequence[Action], step_ms: int, fields: Mapping[int, Var]) -> Iterator[ActionSlip]:
    """Every slip in actions; ``fields`` as ``paired`` tells them."""
    for place, action in enumerate(actions):
        before, after = tuple(actions[:place]), tuple(actions[place + 1 :])
        yield ActionSlip("action-missing", f"`{action}` is missing", (*before, *after))
        for operator, text, changed in _of_one(action, step_ms, fields):
            yield ActionSlip(operator, text, (*before, changed, *after))


def _of_one(action: Action, step_ms: int, fields: Mapping[int, Var]) -> Iterator[tuple[str, str, Action]]:
    if isinstance(action, Assign):
        for value in _values(action, fields):
            operator, new = value
            changed = replace(action, value=new)
            yield operator, f"`{action}` is `{changed}`", changed
        for slip in slips(action.value, step_ms):
            yield slip.operator, f"in `{action}`, {slip.text}", replace(action, value=slip.whole)
    elif isinstance(action, If):
        negated = Apply(Op.NOT, (action.condition,), Bool())
        yield "condition-negated", f"`if {action.condition}` is negated", replace(action, condition=negated)
        for slip in slips(action.condition, step_ms):
            yield slip.operator, f"in an `if`, {slip.text}", replace(action, condition=slip.whole)
        for inner in action_slips(action.then, step_ms, fields):
            yield inner.operator, inner.text, replace(action, then=inner.whole)
        for inner in action_slips(action.otherwise, step_ms, fields):
            yield inner.operator, inner.text, replace(action, otherwise=inner.whole)


def _values(action: Assign, fields: Mapping[int, Var]) -> Iterator[tuple[str, Expr]]:
    value = plain(action.value)
    if isinstance(value, Const):
        changed = other(value)
        if changed is not None and changed.value not in action.var.domain:
            changed = Const(value.value - 1, value.sort)
        if changed is not None and changed.value in action.var.domain:
            yield "value", changed
    elif isinstance(value.sort, Bool):
        yield "value", Apply(Op.NOT, (value,), Bool())
    if id(action) in fields:
        yield "field", fields[id(action)]


@dataclass(frozen=True)
class ChartFault:
    """A chart or block with one fault: where, by which operator, in words, and what the place was to say."""

    site: str
    operator: str
    text: str
    place: Place | None
    part: Chart | Block
    meant: str = ""


@dataclass(frozen=True)
class TransitionList:
    """The transitions of a state or junction, or the default ones of a level, and how to change them."""

    site: str
    level: Path
    segments: tuple[Transition, ...]
    changed: Callable[[Sequence[Transition]], Chart]
    default: bool = False


def block_faults(block: Block, step_ms: int) -> Iterator[ChartFault]:
    """Every fault of a function block."""
    for slip in action_slips(block.do, step_ms, paired(block.do)):
        changed = Block(block.name, slip.whole, text=block.text, place=block.place)
        yield ChartFault("block", slip.operator, slip.text, block.place, changed)


def chart_faults(chart: Chart, step_ms: int) -> Iterator[ChartFault]:
    """Every fault of a chart."""
    fields = paired(chart.all_actions)
    for transitions in transition_lists(chart):
        for number, segment in enumerate(transitions.segments):
            put = _putter(transitions, number)
            site = f"{transitions.site}.{number + 1}"
            meant = "" if segment.guard is None else str(segment.guard)
            for operator, text, new in _segment(chart, transitions, segment, step_ms):
                yield ChartFault(site, operator, text, segment.place, put(new), meant)
            for kind in ("do", "then"):
                actions: tuple[Action, ...] = getattr(segment, kind)
                for slip in action_slips(actions, step_ms, fields):
                    new = (
                        replace(segment, do=slip.whole) if kind == "do" else replace(segment, then=slip.whole)
                    )
                    yield ChartFault(site, slip.operator, slip.text, segment.place, put(new), meant)
        yield from _priorities(transitions)
    for path, state in chart.states.items():
        yield from _in_state(chart, path, state, step_ms)
        if state.parallel:
            yield from _regions(chart, path, state)


def transition_lists(chart: Chart) -> Iterator[TransitionList]:
    """Every list of transitions of the chart."""
    for path, state in chart.states.items():
        of = ".".join(path)

        def default(new: Sequence[Transition], path: Path = path) -> Chart:
            return edit_at(chart, path, lambda s: replace(s, default=tuple(new)))

        def drawn(new: Sequence[Transition], path: Path = path) -> Chart:
            return edit_at(chart, path, lambda s: replace(s, transitions=tuple(new)))

        yield TransitionList(f"default/{of}" if of else "default", path, state.default, default, True)
        yield TransitionList(f"arrow/{of}", path[:-1], state.transitions, drawn)
        for junction in state.junctions:
            name = ".".join((*path, junction.name))
            yield TransitionList(
                f"arrow/{name}", path, junction.transitions, _of_junction(chart, path, junction)
            )


def _of_junction(chart: Chart, path: Path, junction: Junction) -> Callable[[Sequence[Transition]], Chart]:
    def changed(new: Sequence[Transition]) -> Chart:
        def put(state: State) -> State:
            junctions = [Junction(j.name, new) if j.name == junction.name else j for j in state.junctions]
            return replace(state, junctions=tuple(junctions))

        return edit_at(chart, path, put)

    return changed


def _putter(transitions: TransitionList, number: int) -> Callable[[Transition], Chart]:
    def put(new: Transition) -> Chart:
        return transitions.changed([new if i == number else s for i, s in enumerate(transitions.segments)])

    return put


def _segment(
    chart: Chart, transitions: TransitionList, segment: Transition, step_ms: int
) -> Iterator[tuple[str, str, Transition]]:
    """Faults of the guard and the target of a transition."""
    if segment.guard is not None:
        yield from _guard(segment, segment.guard, step_ms)
    elif not transitions.default:
        yield "arrow-missing", f"the transition to {segment.target} is missing", replace(segment, guard=FALSE)
    sibling = _sibling(chart, transitions.level, segment.target)
    if sibling is not None:
        text = f"the transition to {segment.target} leads to {sibling}"
        yield "target", text, replace(segment, target=sibling)


def _guard(segment: Transition, guard: Expr, step_ms: int) -> Iterator[tuple[str, str, Transition]]:
    negated = Apply(Op.NOT, (guard,), Bool())
    yield "guard-negated", f"`[{guard}]` is negated", replace(segment, guard=negated)
    yield "guard-true", f"`[{guard}]` is always true", replace(segment, guard=TRUE)
    yield (
        "guard-false",
        f"`[{guard}]` is never true: the transition is missing",
        replace(segment, guard=FALSE),
    )
    whole = plain(guard)
    opposite = BESIDE[whole.op] if isinstance(whole, Apply) and whole.op in (Op.EQ, Op.NE) else None
    for slip in slips(guard, step_ms):
        if not (isinstance(slip.whole, Apply) and slip.whole.op is opposite):  # the same as negating it
            yield slip.operator, slip.text, replace(segment, guard=slip.whole)


def _sibling(chart: Chart, level: Path, target: str) -> str | None:
    """The next state beside the target, as it can be written there; None where there is no other."""
    path = chart.resolve(level, target)
    if path is None or not path or path not in chart.states:
        return None
    beside = [s.name for s in chart.states[path[:-1]].states]
    wanted = (*path[:-1], beside[(beside.index(path[-1]) + 1) % len(beside)])
    names = [".".join(wanted[depth:]) for depth in range(len(wanted) - 1, -1, -1)]
    return next((n for n in names if wanted != path and chart.resolve(level, n) == wanted), None)


def _priorities(transitions: TransitionList) -> Iterator[ChartFault]:
    """Two transitions that follow each other, tested in the other order."""
    for number, (one, two) in enumerate(zip(transitions.segments, transitions.segments[1:], strict=False)):
        new = [*transitions.segments[:number], two, one, *transitions.segments[number + 2 :]]
        text = f"the transitions {number + 1} and {number + 2} are tested in the other order"
        yield ChartFault(
            f"{transitions.site}.{number + 1}", "priority", text, one.place, transitions.changed(new)
        )


def _in_state(chart: Chart, path: Path, state: State, step_ms: int) -> Iterator[ChartFault]:
    for kind in ("entry", "during", "exit"):
        actions: tuple[Action, ...] = getattr(state, kind)
        for slip in action_slips(actions, step_ms, paired(chart.all_actions)):

            def put(old: State, kind: str = kind, new: tuple[Action, ...] = slip.whole) -> State:
                match kind:
                    case "entry":
                        return replace(old, entry=new)
                    case "during":
                        return replace(old, during=new)
                    case _:
                        return replace(old, exit=new)

            site = f"state/{'.'.join(path)}/{kind}"
            yield ChartFault(site, slip.operator, slip.text, state.place, edit_at(chart, path, put))


def _regions(chart: Chart, path: Path, state: State) -> Iterator[ChartFault]:
    """Two regions that follow each other and share data, executed in the other order."""
    for number, (one, two) in enumerate(zip(state.states, state.states[1:], strict=False)):
        if not _shared(one, two):
            continue
        order = (*state.states[:number], two, one, *state.states[number + 2 :])

        def put(old: State, order: tuple[State, ...] = order) -> State:
            return replace(old, states=order)

        text = f"the regions {one.name} and {two.name} are executed in the other order"
        site = "/".join(filter(None, ("regions", ".".join(path))))
        yield ChartFault(f"{site}.{number + 1}", "order", text, two.place, edit_at(chart, path, put))


def _shared(one: State, two: State) -> bool:
    (read, written), (also_read, also_written) = _data(one), _data(two)
    return bool(written & (also_read | also_written) or also_written & read)


def _data(region: State) -> tuple[set[str], set[str]]:
    """What a region reads and writes."""
    actions: list[Action] = []
    guards: list[Expr] = []
    for _, state in region.walk():
        transitions = (
            *state.default,
            *state.transitions,
            *(t for j in state.junctions for t in j.transitions),
        )
        actions += [
            *state.entry,
            *state.during,
            *state.exit,
            *(a for t in transitions for a in (*t.do, *t.then)),
        ]
        guards += [t.guard for t in transitions if t.guard is not None]
    return set(reads(actions)) | set(variables(*guards)), set(writes(actions))


__all__ = ["ChartFault", "TransitionList", "block_faults", "chart_faults", "transition_lists"]
