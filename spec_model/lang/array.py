"""Arrays of data: several variables of one domain under one name, known by an index."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import cast

from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.domain import Domain, Enum, Num, Number, exact
from rovercheck.spec_model.lang.errors import ModelError, brief, several
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Operand, Var, ite, lift, var
from rovercheck.spec_model.lang.operators import Op

Key = int | str


@dataclass(frozen=True)
class Array:
    """Variables in the order of their keys: numbers, or names such as those of wheels.

    ``gap[3]`` is one of them; ``gap[i]``, with a variable ``i``, that which ``i`` says in each tick.
    """

    name: str
    keys: tuple[Key, ...]
    variables: tuple[Var, ...]

    def __len__(self) -> int:
        return len(self.variables)

    def __iter__(self) -> Iterator[Var]:
        return iter(self.variables)

    def __getitem__(self, index: Key | Expr) -> Expr:
        """One of the variables.  Raises ``ModelError`` for an index that the array does not have."""
        if not isinstance(index, Expr) or isinstance(index, Const):
            return self.one(index)
        *some, last = self._chosen(index)
        chosen: Expr = last[1]
        for condition, variable in reversed(some):
            chosen = ite(condition, variable, chosen)
        return chosen

    def one(self, index: "Key | Const") -> Var:
        """The variable of a constant index.  Raises ``ModelError`` for one that the array does not have."""
        key: object = index
        if isinstance(index, Const):
            sort = index.sort
            key = sort.member(index.value) if isinstance(sort, Enum) else index.value
            key = exact(index.value) * sort.resolution if isinstance(sort, Num) else key
        if isinstance(key, bool) or key not in self.keys:
            raise ModelError(f"{self.name} has no element {_shown(key)}; it has {self._range}.")
        return self.variables[self.keys.index(key)]

    def set(self, index: Key | Expr, value: Operand | str) -> Action:
        """The assignment to one element, which a variable may choose in each tick."""
        if not isinstance(index, Expr) or isinstance(index, Const):
            return assign(self.one(index), value)
        *some, last = self._chosen(index)
        chosen: Action = assign(last[1], value)
        for condition, variable in reversed(some):
            chosen = when(condition, [assign(variable, value)], [chosen])
        return chosen

    def push(self, value: Operand | str) -> tuple[Action, ...]:
        """A step of a shift register: each element takes the value of the one before, the first ``value``."""
        shift = [
            assign(after, before) for before, after in zip(self.variables, self.variables[1:], strict=False)
        ]
        return (*reversed(shift), assign(self.variables[0], value))

    def sum(self) -> Expr:
        """The sum of all elements."""
        return reduce(add, self.variables[1:], cast(Expr, self.variables[0]))

    def _chosen(self, index: Expr) -> list[tuple[Expr, Var]]:
        """The variables that an index may mean, each with the condition that it does."""
        outside = [value for value in _values(index, self.name) if value not in self.keys]
        if outside:
            raise ModelError(
                f"`{self.name}[{index}]`: `{index}` may be {_shown(outside[0])}; {self.name} has "
                f"{self._range}."
            )
        wanted = _values(index, self.name)
        pairs = [(key, v) for key, v in zip(self.keys, self.variables, strict=True) if key in wanted]
        return [(index == lift(key, index.sort), variable) for key, variable in pairs]

    @property
    def _range(self) -> str:
        names = [f"{self.name}[{_shown(key)}]" for key in self.keys]
        return ", ".join(names) if len(names) <= 4 else f"{names[0]} to {names[-1]}"


def _shown(key: object) -> str:
    return key if isinstance(key, str) else str(key)


def _values(index: Expr, of: str) -> list[object]:
    """The values that an index may have: those of a variable's domain, or the remainders of a division."""
    match index:
        case Var(_, Domain(Enum() as names, values)):
            return [names.member(raw) for raw in values]
        case Var(_, Domain(Num(resolution, _), values)):
            return [exact(raw) * resolution for raw in values]
        case Apply(Op.MOD, (_, Const(divisor)), Num(resolution, _)) if resolution == 1:
            return list(range(divisor))
    raise ModelError(
        f"`{of}[{index}]`: an index is a number, a name, a variable of such, or `modulo(..., n)`."
    )


def array(
    name: str,
    keys: int | Sequence[Key],
    domain: Domain,
    init: Number | bool | None = None,
    doc: str = "",
    hidden: bool = False,
) -> Array:
    """An array of variables of one domain; a number of them counts from 0.

    Their names are that of the array and the number, or ``_`` and the name of the key: ``gap1``,
    ``speed_FL``.  ``{key}`` in ``doc`` stands for the key.  Raises ``ModelError`` for no keys, and for one
    that occurs twice.
    """
    if isinstance(keys, bool) or (isinstance(keys, int) and keys < 1):
        raise ModelError(f"array({name!r}, {keys!r}) has no elements; write how many, at least 1.")
    given = tuple(range(keys)) if isinstance(keys, int) else several(f"array({name!r}, ...)", "keys", keys)
    if not given or len(set(given)) < len(given) or any(not isinstance(k, int | str) for k in given):
        raise ModelError(f"array({name!r}, {brief(keys)}): write its keys, numbers or names, each once.")
    names = [f"{name}{key}" if isinstance(key, int) else f"{name}_{key}" for key in given]
    docs = [doc.replace("{key}", str(key)) for key in given]
    made = tuple(var(one, domain, init, said, hidden) for one, said in zip(names, docs, strict=True))
    return Array(name, given, made)
