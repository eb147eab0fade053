"""The set of stored states as LLVM code: open addressing, linear probing, prefetched batches.

States lie in arrival order in ``words`` with their parents in ``parents``.  With one word the
table holds the word + 1 itself (0 marks an empty place).  With more it holds the number of the
state + 1 and, above it, 32 bits of its hash, so that most others are distinguished in place.

A breadth-first search finds states in the order of their parents, so two bits for each are enough
(P. Elias, "Efficient storage and retrieval by content and address of static files", 1974): bit
i + parent(i) is set for the i-th state.  Where parents come in any order they are plain numbers.
"""

from dataclasses import dataclass
from typing import Any

from llvmlite import ir

from rovercheck.checker.encode.native.expressions import BIT, INT

NUMBER = ir.IntType(32)
WORDS = INT.as_pointer()
NUMBERS = NUMBER.as_pointer()
BYTE = ir.IntType(8)
BYTES = BYTE.as_pointer()
_DOUBLE = ir.IntType(128)

CONTEXT = (
    "next",
    "last",
    "count",
    "room",
    "size",
    "transitions",
    "budget",
    "pending",
    "filled",
    "drained",
    "lines",
    "stop",
)
"""Numbers shared with Python, in this order, as signed 64-bit integers."""

_AHEAD = 16
_MULTIPLIER = 0xD6E8FEB86659FD93


def context(builder: Any, pointer: Any, name: str) -> Any:
    """The place of a number shared with Python."""
    return builder.gep(pointer, [INT(CONTEXT.index(name))])


class Loop:
    """``for i in first..last-1``; use as a context manager around the body."""

    def __init__(self, builder: Any, first: Any, last: Any) -> None:
        self.builder, self.last = builder, last
        self.place = _local(builder, INT)
        builder.store(first, self.place)
        self.head, self.body, self.after = (builder.append_basic_block(n) for n in ("head", "body", "after"))

    def __enter__(self) -> Any:
        build = self.builder
        build.branch(self.head)
        build.position_at_end(self.head)
        index = build.load(self.place)
        build.cbranch(build.icmp_signed("<", index, self.last), self.body, self.after)
        build.position_at_end(self.body)
        return index

    def __exit__(self, *_: object) -> None:
        build = self.builder
        build.store(build.add(build.load(self.place), INT(1)), self.place)
        build.branch(self.head)
        build.position_at_end(self.after)


def _local(builder: Any, type_: Any) -> Any:
    with builder.goto_entry_block():
        return builder.alloca(type_)


def function(
    module: Any, name: str, result: Any, arguments: dict[str, Any]
) -> tuple[Any, dict[str, Any], Any]:
    """A function whose pointers do not overlap: itself, its arguments by name, a builder."""
    made = ir.Function(module, ir.FunctionType(result, list(arguments.values())), name)
    for argument, own in zip(made.args, arguments, strict=True):
        argument.name = own
        if argument.type != INT:
            argument.add_attribute("noalias")
    builder = ir.IRBuilder(made.append_basic_block("entry"))
    start = made.append_basic_block("start")
    builder.branch(start)
    builder.position_at_end(start)
    return made, dict(zip(arguments, made.args, strict=True)), builder


@dataclass(frozen=True)
class _Found:
    """A place of the table, whether it is empty, and the hash that led there."""

    place: Any
    empty: Any
    hashed: Any


@dataclass(frozen=True)
class _Hashes:
    """A ring of hashes for states that will soon be looked for; the table is fetched meanwhile."""

    table: "StateTable"
    arrays: dict[str, Any]
    size: Any
    last: Any
    ring: Any

    def note(self, build: Any, i: Any) -> None:
        """Compute the hash of the i-th state and fetch the place to which it leads."""
        hashed = self.table.hash(build, self.table.load(build, self.arrays["buffer"], i))
        build.store(hashed, self._place(build, i))
        home = self.table.home(build, hashed, self.size)
        place = build.bitcast(build.gep(self.arrays["table"], [home]), BYTES)
        build.call(self.table.prefetch, [place, NUMBER(1), NUMBER(3), NUMBER(1)])

    def next(self, build: Any, i: Any) -> Any:
        """The hash of the i-th state, computed before; that of a later one takes its place."""
        hashed, later = build.load(self._place(build, i)), build.add(i, INT(_AHEAD))
        with build.if_then(build.icmp_signed("<", later, self.last), likely=True):
            self.note(build, later)
        return hashed

    def _place(self, build: Any, i: Any) -> Any:
        return build.gep(self.ring, [INT(0), build.and_(i, INT(_AHEAD - 1))])


def _least(build: Any, one: Any, two: Any) -> Any:
    return build.select(build.icmp_signed("<", one, two), one, two)


class StateTable:
    """Emits ``store`` (insert a batch of successors) and ``rehash`` (fill a larger table).

    ``ordered``: parents come in ascending order.
    """

    def __init__(self, module: Any, words: int, ordered: bool = True) -> None:
        self.module, self.words, self.ordered = module, words, ordered
        self.parents = BYTES if ordered else NUMBERS
        self.prefetch = module.declare_intrinsic(
            "llvm.prefetch", (BYTES,), ir.FunctionType(ir.VoidType(), [BYTES, NUMBER, NUMBER, NUMBER])
        )

    def store(self) -> Any:
        """``store(context, words, parents, table, buffer, origins)``: insert the successors in the
        buffer.  Returns 0, or 1 when there is no room for more; what is left stays in the buffer."""
        made, a, build = function(
            self.module,
            "store",
            INT,
            {
                "context": WORDS,
                "words": WORDS,
                "parents": self.parents,
                "table": WORDS,
                "buffer": WORDS,
                "origins": NUMBERS,
            },
        )
        made.attributes.add("noinline")
        places = {name: context(build, a["context"], name) for name in CONTEXT}
        size, room = build.load(places["size"]), build.load(places["room"])
        filled, drained = build.load(places["filled"]), build.load(places["drained"])
        count = _local(build, INT)
        build.store(build.load(places["count"]), count)
        hashes = self._hashes(build, a, size, drained, filled)
        with Loop(build, drained, filled) as i:
            hashed = hashes.next(build, i)
            key = self.load(build, a["buffer"], i)
            found = self._probe(build, a, key, hashed, size, new=False)
            with build.if_then(found.empty):
                full = build.icmp_signed(">=", build.load(count), room)
                with build.if_then(full, likely=False):
                    build.store(i, places["drained"])
                    build.store(build.load(count), places["count"])
                    build.ret(INT(1))
                index = self._append(build, a, key, found, count)
                self._note_parent(build, a["parents"], index, build.load(build.gep(a["origins"], [i])))
        for name, value in (("count", build.load(count)), ("filled", INT(0)), ("drained", INT(0))):
            build.store(value, places[name])
        build.ret(INT(0))
        return made

    def rehash(self) -> Any:
        """``rehash(table, size, words, count)``: enter the stored states into an empty table."""
        made, a, build = function(
            self.module,
            "rehash",
            ir.VoidType(),
            {
                "table": WORDS,
                "size": INT,
                "words": WORDS,
                "count": INT,
            },
        )
        hashes = self._hashes(build, {**a, "buffer": a["words"]}, a["size"], INT(0), a["count"])
        with Loop(build, INT(0), a["count"]) as i:
            hashed = hashes.next(build, i)
            key = self.load(build, a["words"], i)
            found = self._probe(build, a, key, hashed, a["size"], new=True)
            build.store(self._entry(build, key, found.hashed, i), found.place)
        build.ret_void()
        return made

    def known(self) -> Any:
        """``known(table, size, words, asked, count, found)``: which of the states are stored."""
        made, a, build = function(
            self.module,
            "known",
            ir.VoidType(),
            {
                "table": WORDS,
                "size": INT,
                "words": WORDS,
                "asked": WORDS,
                "count": INT,
                "found": WORDS,
            },
        )
        hashes = self._hashes(build, {**a, "buffer": a["asked"]}, a["size"], INT(0), a["count"])
        with Loop(build, INT(0), a["count"]) as i:
            hashed = hashes.next(build, i)
            place = self._probe(build, a, self.load(build, a["asked"], i), hashed, a["size"], new=False)
            build.store(build.zext(build.not_(place.empty), INT), build.gep(a["found"], [i]))
        build.ret_void()
        return made

    # --- parts -----------------------------------------------------------------------------------

    def load(self, build: Any, words: Any, index: Any) -> list[Any]:
        """The words of the index-th state."""
        first = build.mul(index, INT(self.words))
        return [build.load(build.gep(words, [build.add(first, INT(w))])) for w in range(self.words)]

    def save(self, build: Any, words: Any, index: Any, key: list[Any]) -> None:
        """Write the words of the index-th state."""
        first = build.mul(index, INT(self.words))
        for w, word in enumerate(key):
            build.store(word, build.gep(words, [build.add(first, INT(w))]))

    def hash(self, build: Any, key: list[Any]) -> Any:
        """Mix the words so that near states spread over the table."""
        mixed = key[0]
        for word in key[1:]:
            mixed = build.xor(self._mix(build, mixed), word)
        return self._mix(build, self._mix(build, mixed))

    def _mix(self, build: Any, x: Any) -> Any:
        return build.mul(build.xor(x, build.lshr(x, INT(32))), INT(_MULTIPLIER))

    def home(self, build: Any, hashed: Any, size: Any) -> Any:
        """Where to look first: the hash scaled down from 64 bits to a table of any size."""
        product = build.mul(build.zext(hashed, _DOUBLE), build.zext(size, _DOUBLE))
        return build.trunc(build.lshr(product, _DOUBLE(64)), INT)

    def _hashes(self, build: Any, a: dict[str, Any], size: Any, first: Any, last: Any) -> "_Hashes":
        """The hashes of the states first..last-1 of the buffer, each computed before it is needed."""
        kept = _Hashes(self, a, size, last, _local(build, ir.ArrayType(INT, _AHEAD)))
        with Loop(build, first, _least(build, build.add(first, INT(_AHEAD)), last)) as i:
            kept.note(build, i)
        return kept

    def _entry(self, build: Any, key: list[Any], hashed: Any, index: Any) -> Any:
        """What the table holds for a state."""
        if self.words == 1:
            return build.add(key[0], INT(1))
        mark = build.shl(hashed, INT(32))  # the low bits: the high ones say where to look
        return build.or_(mark, build.add(index, INT(1)))

    def _probe(
        self, build: Any, a: dict[str, Any], key: list[Any], hashed: Any, size: Any, new: bool
    ) -> _Found:
        """Where a state is in the table, or the empty place where it belongs.

        ``new``: it is known not to be there.
        """
        at = _local(build, INT)
        build.store(self.home(build, hashed, size), at)
        probe, taken, other, found = (
            build.append_basic_block(n) for n in ("probe", "taken", "other", "found")
        )
        build.branch(probe)
        build.position_at_end(probe)
        place = build.gep(a["table"], [build.load(at)])
        entry = build.load(place)
        empty = build.icmp_unsigned("==", entry, INT(0))
        build.cbranch(empty, found, taken)
        build.position_at_end(taken)
        build.cbranch(BIT(0) if new else self._same(build, a, entry, key, hashed), found, other)
        build.position_at_end(other)
        following = build.add(build.load(at), INT(1))
        build.store(build.select(build.icmp_unsigned("==", following, size), INT(0), following), at)
        build.branch(probe)
        build.position_at_end(found)
        return _Found(place, empty, hashed)

    def _same(self, build: Any, a: dict[str, Any], entry: Any, key: list[Any], hashed: Any) -> Any:
        if self.words == 1:
            return build.icmp_unsigned("==", entry, build.add(key[0], INT(1)))
        result = _local(build, BIT)
        build.store(BIT(0), result)
        mark = build.and_(hashed, INT((1 << 32) - 1))
        alike = build.icmp_unsigned("==", build.lshr(entry, INT(32)), mark)
        with build.if_then(alike):
            number = build.sub(build.and_(entry, INT((1 << 32) - 1)), INT(1))
            stored = self.load(build, a["words"], number)
            equal = BIT(1)
            for one, two in zip(stored, key, strict=True):
                equal = build.and_(equal, build.icmp_unsigned("==", one, two))
            build.store(equal, result)
        return build.load(result)

    def _append(self, build: Any, a: dict[str, Any], key: list[Any], found: _Found, count: Any) -> Any:
        """Store a state; the result is its number."""
        index = build.load(count)
        build.store(self._entry(build, key, found.hashed, index), found.place)
        self.save(build, a["words"], index, key)
        build.store(build.add(index, INT(1)), count)
        return index

    def _note_parent(self, build: Any, parents: Any, index: Any, origin: Any) -> None:
        if not self.ordered:
            build.store(origin, build.gep(parents, [index]))
            return
        at = build.add(index, build.zext(origin, INT))
        place = build.gep(parents, [build.lshr(at, INT(3))])
        bit = build.shl(BYTE(1), build.trunc(build.and_(at, INT(7)), BYTE))
        build.store(build.or_(build.load(place), bit), place)
