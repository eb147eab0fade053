"""Labels, and the words of both action languages: models by hand."""

from collections.abc import Iterator

from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.simulink.by_hand.models import ByHand, Given, Told, one_chart, tell


def _sections(c: WrittenChart) -> None:
    """Sections in every form: without a keyword, of two kinds, behind a semicolon, and twice."""
    a = c.state(
        f"A % en: a comment\n{tell(1)}\nen, du: {tell(2)} exit: {tell(3)}\n"
        f"/* ex: {tell(9)} */ during:\n  {tell(4)}\nex: {tell(5)}\nentry: {tell(6)}"
    )
    b = c.state(f"B/{tell(7)}")
    c.transition(None, a)
    c.transition(a, b, f"[u == 1] ... a comment goes on\n {{{tell(8)}}} {{{tell(10)}}} / {{{tell(11)}}}")
    c.transition(b, a, "?")


def _sections_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state = Told(), ""
    for u in given:
        if state == "A" and u != 1:
            say(2, 4)
        elif state == "A":
            say(8, 10, 3, 5, 11, 7)
            state = "B"
        else:
            say(1, 2, 6)
            state = "A"
        yield (say.t,)


def _on_times(c: WrittenChart) -> None:
    """Sections at times come after the during action, wherever they are written."""
    a = c.state(
        f"A\non after(3, tick): {tell(1)}\non every(2, tick): {tell(2)}\ndu: {tell(3)}\n"
        f"on before(2, tick): {tell(4)}\non at(3, tick): {tell(5)}"
    )
    c.transition(None, a)
    c.transition(a, a, "[u == 3]")


def _on_times_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, count = Told(), -1
    for u in given:
        count += 1
        if count and u == 3:
            count = 0
        elif count:
            say(3)
            at = {1: count >= 3, 2: count % 2 == 0, 4: count < 2, 5: count == 3}
            say(*(digit for digit, true in at.items() if true))
        yield (say.t,)


def _alternatives(c: WrittenChart) -> None:
    """Of several events one is enough; a time may stand in their place."""
    c.parallel = True
    for name in "EFG":
        c.event(name)
    sends = "if u == 1, send(E, T); elseif u == 2, send(F, T); elseif u == 3, T.G; end"
    sender = c.state(f"S\ndu: {sends}", order=1)
    other = c.state("T", order=2)
    assert sender
    a, b = c.state(f"A\non E, on F: {tell(1)}", other), c.state(f"B\nen: {tell(2)}\nex: {tell(3)}", other)
    c.transition(None, a)
    c.transition(a, b, f"E | F{{{tell(4)}}}{{{tell(5)}}}/{tell(6)}", 1)
    c.transition(a, b, f"G[u > 5 || true]/{tell(7)}", 2)
    c.transition(b, a, f"F | after(2, tick)[u ~= 1]{{{tell(8)}}}/{{{tell(9)}}}")


def _alternatives_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    say, state, count = Told(), "", 0
    for u in given:
        count += 1
        if not state:
            state, count = "A", 0
            yield (say.t,)
            continue
        for event in (*({1: "E", 2: "F", 3: "G"}.get(u, ""),), "") if u in (1, 2, 3) else ("",):
            if state == "A" and event:
                say(*((7, 2) if event == "G" else (4, 5, 6, 2)))
                state, count = "B", 0
            elif state == "B" and (event == "F" or count >= 2) and u != 1:
                say(8, 3, 9)
                state, count = "A", 0
        yield (say.t,)


_SCRIPT = """function [y, z] = f(x) %#codegen
%{
  a comment of a block
%}
persistent k m
if isempty(k), k = 0; m = 1; end
a = [x -2 3];   % three numbers
b = [x - 2, 3]; % and two
y = 0;
for i = 1:numel(a)
  if a(i) == 2, continue
  elseif a(i) < -5
    break
  else
    y = y + a(i) * i; // what it is
  end
end
n = 0;
while n < 3 && y < 20
  y = y + n; n = n + 1;
end
switch x
  case {0, 1}
    y = y + 100;
  case 2
    y = y + 200;
  otherwise
    y = y - 300;
end
c = b';
[big, ~] = both(c(end), ...
  b(1));
k = mod(k + 1, 4); m = -m;
z = big + k * m;
if ~(x ~= 3), return, end
z = z + 1000; fprintf('%d\\n', z); disp(z);

function [p, q] = both(r, s)
p = r - s; q = r + s;
"""


def _matlab(c: WrittenChart) -> None:
    """Statements of MATLAB, in a function with two results and a local function."""
    c.function("[y, z] = f(x)", script=_SCRIPT)
    c.transition(None, c.state("A\nen, du: [p, q] = f(double(u)); y = p; z = q;"))
    c.data("p", "local", "int16")
    c.data("q", "local", "int16")


def _matlab_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    k, m = 0, 1
    for x in given:
        a, y = [x, -2, 3], 0
        for place, one in enumerate(a, 1):
            if one == 2:
                continue
            if one < -5:
                break
            y += one * place
        n = 0
        while n < 3 and y < 20:
            y, n = y + n, n + 1
        y += {0: 100, 1: 100, 2: 200}.get(x, -300)
        k, m = (k + 1) % 4, -m
        z = 3 - (x - 2) + k * m
        yield y, z if x == 3 else z + 1000


def _words_of_c(c: WrittenChart) -> None:
    """Operators of C with bit operations, an array that is indexed from 0, and what begins a comment."""
    c.language, c.saturates = "C with bit operations", False
    c.data("v", "local", "uint8", "[1 2 3]", "[1 3]")
    text = (
        "y++; y += 0x1F; y &= 0x7F; // y = 0\nz -= 2; z--; /* y = 1; */\n"
        "v[0] = v[2] | 4; v[1] ^= uint8(u) & 6; v[2] = v[0] + 1; % y = 2\n"
        "y = y + v[1] %% 4; z |= 1; z = (z >> 1) + (!u || u != 5 && u <= 2) - ~v[2];"
    )
    c.transition(None, c.state(f"A\nen: {text}\ndu: {text}"))


def _words_of_c_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    y, z, v = 0, 0, [1, 2, 3]
    for u in given:
        y = (y + 1 + 0x1F) & 0x7F
        z -= 3
        v[0] = v[2] | 4
        v[1] ^= u & 6
        v[2] = (v[0] + 1) % 256
        y += v[1] % 4
        z = ((z | 1) >> 1) + (u == 0 or (u != 5 and u <= 2)) - (255 - v[2])
        z = (z + 2**15) % 2**16 - 2**15
        yield y, z


def _plain_c(c: WrittenChart) -> None:
    """Without bit operations ``^`` is a power, and ``&`` and ``|`` are of truths."""
    c.language = "C"
    a, b = c.state("A\nen, du: y = u ^ 2;"), c.state("B\nen: y = (u & 2) + 10;")
    c.transition(None, a)
    c.transition(a, b, "[u > 1 | u < 0]")
    c.transition(b, a, "[u & 4 && !(u == 3)]")


def _plain_c_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state, y = "", 0
    for u in given:
        if state == "A" and (u > 1 or u < 0):
            state, y = "B", 11 if u else 10
        elif state == "B" and (not u or u == 3):
            pass
        else:
            state, y = "A", u * u
        yield (y,)


LABELS = (
    ByHand("sections", one_chart(_sections), _sections_by_hand),
    ByHand("on_times", one_chart(_on_times), _on_times_by_hand, (0, 1, 2, 0, 1, 3)),
    ByHand("alternatives", one_chart(_alternatives), _alternatives_by_hand),
    ByHand(
        "matlab", one_chart(_matlab, {"y": "int16", "z": "int16"}), _matlab_by_hand, (-9, -1, 0, 1, 2, 3, 4)
    ),
    ByHand(
        "words_of_c", one_chart(_words_of_c, {"y": "uint8", "z": "int16"}), _words_of_c_by_hand,
        (0, 1, 2, 3, 5, 6),
    ),
    ByHand("plain_c", one_chart(_plain_c, {"y": "int16"}), _plain_c_by_hand, (-3, -1, 0, 1, 2, 3, 4)),
)  # fmt: skip

__all__ = ["LABELS"]
