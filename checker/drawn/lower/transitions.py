"""Leaving and entering states along a path."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from rovercheck.checker.drawn.grammar.labels import SectionKind
from rovercheck.checker.drawn.lower.chart_functions import FunctionWriter
from rovercheck.checker.drawn.lower.chart_paths import TransitionPath
from rovercheck.checker.drawn.lower.symbols import folded
from rovercheck.checker.drawn.parsed import JunctionNode, StateNode, TransitionNode
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Const, Expr, all_of


class TransitionWriter(FunctionWriter):
    """How the states of one chart are left and entered."""

    def _take(self, path: TransitionPath, source: StateNode) -> None:
        """Leave, act and enter along a path; what an early return drops is dropped."""
        self._fired(path, source)
        around = around_all(self.chart.root, path)
        with self._dropping():
            self._exit_children(around)
            for one in path:
                with self._told(one):
                    scope = replace(self._scope(source), alive=partial(self._may_go_on, around))
                    self.run(one.label.transition_actions, scope)
            target = path[-1].target
            assert target is not None
            self._enter_children(around, _chain(around, target))

    def _may_go_on(self, around: StateNode) -> Expr:
        """Whether a transition may still be ended: what is around it is active, and no state in it."""
        inside = [folded(~self.active(child)) for child in around.children]
        return folded(all_of(self.active(around), *inside))

    # --- leaving -------------------------------------------------------------------------------------------

    def _exit_children(self, node: StateNode) -> None:
        if node.parallel:
            for region in reversed(node.children):
                self._exit(region)
        else:
            self._for_active_child(node, node.children, self._exit)

    def _exit(self, node: StateNode) -> None:
        """Inner states first; it is active while its exit action runs.

        A region may not be active where an event has its parent left before it is entered.
        """
        self._exit_children(node)
        self.writer.choose(self.active(node) if self.sends else TRUE, lambda: self._exit_itself(node))

    def _exit_itself(self, node: StateNode) -> None:
        assert node.parent is not None
        self.run(node.sections.get(SectionKind.EXIT, ()), self._scope(node, node))
        if node.parent.ssid in self._last:
            last = self._last[node.parent.ssid]
            self.writer.assign(last, Const(last.domain.raw(self.view.name(node)), last.sort))
        if node.ssid in self._regions:
            self.writer.assign(self._regions[node.ssid], FALSE)
        elif not node.parent.parallel:
            self._place(node.parent, None)

    # --- entering ------------------------------------------------------------------------------------------

    def _enter(self, node: StateNode, chain: Sequence[StateNode]) -> None:
        """A state becomes active, then its entry action runs, then what is in it is entered."""
        assert node.parent is not None
        if node.ssid in self._regions:
            self.writer.assign(self._regions[node.ssid], TRUE)
        elif not node.parent.parallel:
            self._place(node.parent, node)
        self.times.entered(node)
        self.run(node.sections.get(SectionKind.ENTRY, ()), self._scope(node, node))
        self._enter_children(node, chain)

    def _enter_children(self, node: StateNode, chain: Sequence[StateNode]) -> None:
        if self.writer.dead:
            return
        if node.parallel:
            for region in node.children:
                if self.sends:
                    assert self._dropped is not None
                    self.writer.end(self._dropped, folded(~self.active(node)))
                further = chain[1:] if chain and chain[0] is region else []
                already = self.active(region) if region.ssid in self._regions else FALSE
                self.writer.choose(already, lambda: None, partial(self._enter, region, further))
        elif chain:
            self._enter(chain[0], chain[1:])
        elif node.ssid in self._last:
            last = self.writer.read(self._last[node.ssid])
            self._enter_last(node, last, node.children)
        elif node.children:
            self._enter_default(node)

    def _enter_last(self, node: StateNode, last: Expr, children: Sequence[StateNode]) -> None:
        if not children:
            self._enter_default(node)
            return
        first, *others = children
        raw = self._last[node.ssid].domain.raw(self.view.name(first))
        self.writer.choose(
            folded(last == Const(raw, last.sort)),
            lambda: self._enter(first, []),
            lambda: self._enter_last(node, last, others),
        )

    def _enter_default(self, node: StateNode) -> None:
        with self.writer.until("default_taken") as taken:

            def complete(path: TransitionPath) -> None:
                self._fired(path, None)
                for one in path:
                    with self._told(one):
                        scope = replace(self._scope(node), alive=partial(self._may_go_on, node))
                        self.run(one.label.transition_actions, scope)
                target = path[-1].target
                assert target is not None
                self._enter_children(node, _chain(node, target))
                self.writer.end(taken)

            self._search(node.defaults, self._scope(node, node), complete)
            if not self.writer.dead:
                self.writer.fault(f"no default transition of {node.path} may lead to a state")


def around_all(root: StateNode, path: Sequence[TransitionNode]) -> StateNode:
    """The innermost state that holds all of a path: an outer transition is drawn outside its source."""
    chains = [list(one.holder.lineage())[::-1] for one in path]
    found = root
    for level in zip(*chains, strict=False):
        if len({node.ssid for node in level}) > 1:
            break
        found = level[0]
    return found


def _chain(around: StateNode, target: StateNode | JunctionNode) -> list[StateNode]:
    """The states from below one down to a target; a history junction stands for its state."""
    node = target.holder if isinstance(target, JunctionNode) else target
    chain = list(node.lineage())
    at = next(index for index, one in enumerate(chain) if one is around)
    return chain[:at][::-1]


__all__ = ["TransitionWriter", "around_all"]
