"""What a transition leaves and enters: the state that holds all of its path, and those down to its end."""

from collections.abc import Sequence

from rovercheck.checker.drawn.parsed import JunctionNode, StateNode, TransitionNode


def scope_of(root: StateNode, path: Sequence[TransitionNode]) -> StateNode:
    """The innermost state that holds all of a path: an outer transition is drawn outside its source."""
    holders = [list(one.holder.lineage())[::-1] for one in path]
    scope = root
    for nodes in zip(*holders, strict=False):
        if any(node is not nodes[0] for node in nodes):
            break
        scope = nodes[0]
    return scope


def chain_to(scope: StateNode, target: StateNode | JunctionNode) -> list[StateNode]:
    """The states from below a scope down to a target; a history junction stands for its state."""
    node = target.holder if isinstance(target, JunctionNode) else target
    chain: list[StateNode] = []
    for one in node.lineage():
        if one is scope:
            break
        chain.insert(0, one)
    return chain


__all__ = ["chain_to", "scope_of"]
