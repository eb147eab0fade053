"""Random charts with a meaning: a tree of states first, then transitions, actions, junctions and sends."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from rovercheck.spec_model.lang.action import Action, assign, send
from rovercheck.spec_model.lang.chart import Chart, Junction, Path, State, Transition, to
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.wellformed import check_chart
from tests.random_formulas import Source


@dataclass
class Node:
    """A state being made; regions are the children of a parallel one."""

    name: str
    children: list["Node"] = field(default_factory=list)
    parallel: bool = False
    entry: list[Action] = field(default_factory=list)
    during: list[Action] = field(default_factory=list)
    exit: list[Action] = field(default_factory=list)
    transitions: list[Transition] = field(default_factory=list)
    default: list[Transition] = field(default_factory=list)
    junctions: dict[str, list[Transition]] = field(default_factory=dict)

    def state(self) -> State:
        return State(
            self.name, entry=self.entry, during=self.during, exit=self.exit, transitions=self.transitions,
            states=[c.state() for c in self.children], default=self.default, parallel=self.parallel,
            junctions=[Junction(n, ts) for n, ts in self.junctions.items()],
        )  # fmt: skip


@dataclass
class Draft:
    """A chart being made."""

    name: str
    root: Node
    source: Source
    data: Sequence[Var]
    local_to: list[tuple[Var, list[str]]] = field(default_factory=list)

    def chart(self) -> Chart:
        r = self.root
        return Chart(
            self.name, [c.state() for c in r.children], default=r.default, parallel=r.parallel,
            junctions=[Junction(n, ts) for n, ts in r.junctions.items()], local_to=self.local_to,
        )  # fmt: skip

    def meaningful(self) -> bool:
        try:
            check_chart(self.chart())
        except ModelError:
            return False
        return True

    def attempt(self, change: Callable[[], Callable[[], None]]) -> None:
        """Make a change and undo it if the chart has lost its meaning."""
        undo = change()
        if not self.meaningful():
            undo()


def skeleton(source: Source, name: str) -> Node:
    """A tree of states to depth 3; names repeat at different levels in some charts."""
    counter = iter(range(1, 100))
    repeated = source.chance(3)

    def grow(depth: int, index: int, region: bool) -> Node:
        node = Node("ABCDEFGH"[index] if repeated else f"S{next(counter)}")
        if depth < 3 and (not source.chance(4) if region else source.chance(3 + 2 * depth)):
            fill(node, depth, region)
        return node

    def fill(node: Node, depth: int, region: bool) -> None:
        node.parallel = source.chance(6 if region else 3)
        count = 2 + source.below(2) if node.parallel else 1 + source.below(4 - depth)
        node.children = [grow(depth + 1, i, node.parallel) for i in range(count)]

    root = Node(name)
    fill(root, 0, False)
    return root


def walk(node: Node, path: Path = ()) -> list[tuple[Path, Node]]:
    found = [(path, node)]
    for child in node.children:
        found += walk(child, (*path, child.name))
    return found


class Wiring:
    """Draws transitions between the states of a tree."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self.source = draft.source
        self.nodes = dict(walk(draft.root))
        self.bare = draft.chart()
        self.ends: dict[tuple[Path, str], set[Path]] = {}
        self.plain: set[tuple[Path, str]] = set()
        self.tame = self.source.chance(2)

    def scope(self, source: Path, target: Path) -> Path:
        depth = min(len(source), len(target)) - 1
        while source[:depth] != target[:depth]:
            depth -= 1
        return source[:depth]

    def below(self, path: Path) -> list[Path]:
        """The state and those inside it."""
        return [p for p in self.nodes if p[: len(path)] == path]

    def legal(self, source: Path, target: Path) -> bool:
        """Whether a transition may be drawn; in a tame chart none leaves a region."""
        scope = self.scope(source, target)
        leaves_region = any(self.nodes[source[:d]].parallel for d in range(len(scope), len(source)))
        return not self.nodes[scope].parallel and not (self.tame and leaves_region)

    def written(self, level: Path, target: Path) -> str | None:
        """How a transition drawn at ``level`` may name the target."""
        for length in (*range(1 + self.source.below(2), len(target) + 1), 1):
            text = ".".join(target[-length:])
            if self.bare.resolve(level, text) == target:
                return text
        return None

    def segment(
        self, level: Path, target: Path, *, words: bool = True, sure: bool = False
    ) -> Transition | None:
        """A transition to a state, with any label; ``sure`` leaves the guard out."""
        text = self.written(level, target)
        return None if text is None else self.label(text, words=words, sure=sure)

    def label(self, text: str, *, words: bool = True, sure: bool = False) -> Transition:
        s, data = self.source, self.draft.data
        guard = None if sure or s.chance(6) else s.guard(words)
        do = s.actions(data, 1) if s.chance(4) else []
        then = s.actions(data, 1) if s.chance(5) else []
        return to(text, guard, None, do, then)

    def junctions(self, level: Path) -> None:
        """Up to three junctions of a composite; each leads to states or to junctions made before."""
        node = self.nodes[level]
        for number in range(self.source.below(4) if self.source.chance(2) else 0):
            name, transitions, ends = f"J{number + 1}", [], set[Path]()
            plain = self.source.chance(2)
            for _ in range(1 + self.source.below(3)):
                before = [n for n in node.junctions if not plain or (level, n) in self.plain]
                if before and self.source.chance(3):
                    onward = self.source.pick(before)
                    transitions.append(self.label(onward, words=not plain))
                    ends |= self.ends[level, onward]
                    continue
                target = self.source.pick([p for p in self.nodes if p])
                made = self.segment(level, target, words=not plain)
                if made is not None:
                    transitions.append(made)
                    ends.add(target)
            if transitions:
                node.junctions[name] = transitions
                self.ends[level, name] = ends
                if plain:
                    self.plain.add((level, name))

    def default(self, path: Path) -> None:
        """Default transitions, the last of which always leads to the first child."""
        node = self.nodes[path]
        if not node.children or node.parallel:
            return
        first = (*path, node.children[0].name)
        inside = self.below(path)[1:]
        if self.source.chance(3):
            made = self.segment(path, self.source.pick(inside), words=False)
            node.default += [made] if made else []
        for level, name in sorted(self.plain) if self.source.chance(2) else ():
            ends = self.ends[level, name]
            if level == path and all(e in inside for e in ends):
                node.default.append(self.label(name, words=False))
        last = self.segment(path, first, words=False, sure=True)
        assert last is not None
        node.default.append(last)

    def transitions(self, path: Path) -> None:
        """Transitions of a state: random ones, and one to its right neighbour so that all are reachable."""
        node, parent = self.nodes[path], self.nodes[path[:-1]]
        if parent.parallel:
            return
        siblings = [(*path[:-1], c.name) for c in parent.children]
        targets = [p for p in self.nodes if p and self.legal(path, p)]
        chosen = [self.source.pick(targets) for _ in range(self.source.below(3))]
        position = siblings.index(path)
        chosen += siblings[position + 1 : position + 2] or siblings[:1]
        for target in chosen:
            made = self.segment(path[:-1], target)
            node.transitions += [made] if made else []
        for (level, name), ends in self.ends.items():
            near = level == path[:-1][: len(level)] and self.bare_junction(path[:-1], level, name)
            if near and all(self.legal(path, e) for e in ends) and self.source.chance(2):
                node.transitions.insert(self.source.below(len(node.transitions) + 1), self.label(name))

    def bare_junction(self, at: Path, level: Path, name: str) -> bool:
        """Whether the junction is the nearest of its name."""
        nearest = next(d for d in range(len(at), -1, -1) if name in self.nodes[at[:d]].junctions)
        return at[:nearest] == level

    def drop_unused_junctions(self) -> None:
        """Junctions that nothing leads to, last made first."""
        for path, node in self.nodes.items():
            for name in reversed(list(node.junctions)):
                used = {t.target for n in self.nodes.values() for t in (*n.transitions, *n.default)}
                used |= {t.target for ts in node.junctions.values() for t in ts}
                if name not in used or not self._leads(path, name):
                    del node.junctions[name]

    def _leads(self, path: Path, name: str) -> bool:
        node = self.nodes[path]
        inside = [t.target for ts in node.junctions.values() for t in ts] + [t.target for t in node.default]
        below = [(p, n) for p, n in self.nodes.items() if p[: len(path)] == path and p != path]
        return name in inside or any(
            name in [t.target for t in n.transitions] and self.bare_junction(p[:-1], path, name)
            for p, n in below
        )


def charts(source: Source, name: str, data: Sequence[Var], local: Sequence[Var]) -> Chart:
    """A chart that writes ``data``; ``local`` may become local to states of it."""
    draft = Draft(name, skeleton(source, name), source, data)
    wiring = Wiring(draft)
    source.places += [wiring.bare.active_path(p) for p in wiring.nodes if p]
    for path in wiring.nodes:
        if not wiring.nodes[path].parallel and wiring.nodes[path].children:
            wiring.junctions(path)
    for path, node in wiring.nodes.items():
        wiring.default(path)
        if path:
            wiring.transitions(path)
            node.entry, node.during, node.exit = (source.actions(data) for _ in range(3))
    wiring.drop_unused_junctions()
    for datum in local:
        _localise(draft, wiring, datum)
    if any(n.parallel for n in wiring.nodes.values()) or source.chance(5):
        for number in range(source.below(6)):
            draft.attempt(partial(_send, draft, wiring, f"e{number % 2 + 1}"))
    if source.chance(4):
        composites = [n for n in wiring.nodes.values() if n.default]
        draft.attempt(lambda: _drop_default(source.pick(composites)) if composites else lambda: None)
    return draft.chart()


def _localise(draft: Draft, wiring: Wiring, datum: Var) -> None:
    """Make the datum local to a state or two, which set it on entry and use it."""
    source = draft.source
    names = [p for p in wiring.nodes if p and not wiring.nodes[p[:-1]].parallel]
    if not names or not source.chance(3):
        return
    owners = {source.pick(names) for _ in range(1 + source.below(2))}
    draft.local_to.append((datum, [".".join(p) for p in sorted(owners)]))
    interpretation = Source(source.choices, [datum, *draft.data], source.steady)
    for path in sorted(owners):
        node = wiring.nodes[path]
        node.entry = [assign(datum, source.value(datum, source.scope)), *node.entry]
        node.during += [interpretation.assignment([datum, *draft.data])]
        node.exit += [interpretation.assignment(draft.data)]
        node.transitions = [
            replace(a, guard=interpretation.guard()) if source.chance(3) else a for a in node.transitions
        ]


def _drop_default(node: Node) -> Callable[[], None]:
    kept, node.default = node.default, []

    def undo() -> None:
        node.default = kept

    return undo


def _send(draft: Draft, wiring: Wiring, event: str) -> Callable[[], None]:
    """A send from one place, and a transition inside the receiver that waits for it."""
    source = draft.source
    sender, receiver = _ends_of_send(source, wiring)
    reacting = [p for p in wiring.below(receiver) if not wiring.nodes[p[:-1]].parallel]
    if not reacting:
        return lambda: None
    node, other = wiring.nodes[sender], wiring.nodes[source.pick(reacting)]
    saved = [(changed, replace(changed)) for changed in (node, other)]
    _put_send(source, node, send(event, ".".join(receiver)))
    if other.transitions:
        number = source.below(len(other.transitions))
        waiting = replace(other.transitions[number], event=event, guard=None)
        extra = [other.transitions[number]] if source.chance(2) else []
        other.transitions = [*other.transitions[:number], waiting, *extra, *other.transitions[number + 1 :]]

    def undo() -> None:
        for changed, kept in saved:
            changed.entry, changed.during = kept.entry, kept.during
            changed.exit, changed.transitions = kept.exit, kept.transitions

    return undo


def _ends_of_send(source: Source, wiring: Wiring) -> tuple[Path, Path]:
    """A sender and a receiver, mostly in two regions of one parallel composite."""
    parallel = [p for p, n in wiring.nodes.items() if n.parallel]
    if not parallel or source.chance(6):
        paths = [p for p in wiring.nodes if p]
        return source.pick(paths), source.pick(paths)
    composite = source.pick(parallel)
    regions = [(*composite, c.name) for c in wiring.nodes[composite].children]
    first = source.below(len(regions))
    other = (first + 1 + source.below(len(regions) - 1)) % len(regions)
    receiver = source.pick(wiring.below(regions[other])) if source.chance(3) else regions[other]
    return source.pick(wiring.below(regions[first])), receiver


def _put_send(source: Source, node: Node, action: Action) -> None:
    kind = source.below(8)
    if kind == 0:
        node.entry = [*node.entry, action]
    elif kind == 1:
        node.exit = [action, *node.exit]
    elif kind in (2, 3) or not node.transitions:
        node.during = [action, *node.during]
    else:
        number = source.below(len(node.transitions))
        transition = node.transitions[number]
        changed = (
            replace(transition, then=(*transition.then, action))
            if kind == 4
            else replace(transition, do=(*transition.do, action))
        )
        node.transitions = [*node.transitions[:number], changed, *node.transitions[number + 1 :]]
