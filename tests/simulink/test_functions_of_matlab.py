"""What functions of MATLAB give, and texts of C, in both readings."""

from pathlib import Path

import pytest

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.diagram import ModelRunner
from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.spec_model.lang.domain import fixed
from tests.drawn.two_readings import compared
from tests.simulink.known.packages import ChartText

GIVEN = (0, 1, 2, 3, -1)
HELPER = "\nfunction z = g(x)\nz = x + 1;\nend\n"


def script_of(body: str, folder: Path) -> DrawnModel:
    """A chart with the output y and a function that gives its own y: they are two."""
    script = f"function y = f(u)\n{body}\nend\n{HELPER}".replace("\n", "\\n")
    text = f"""
        in u int8
        out y double
        function y = f(u)
            takes u Inherit: Same as Simulink
            gives y Inherit: Same as Simulink
            script {script}
        -> A
        state A: en, du: y = f(double(u));
    """
    return ChartText("one", text, "MATLAB").read(folder)


def in_c(text: str, folder: Path, language: str = "C bits") -> DrawnModel:
    text = text.replace("\n", "\\n")
    return ChartText("one", f"in u int8\nout y int32\n-> A\nstate A: en, du: {text}", language).read(folder)


def given_by(read: DrawnModel) -> list[float]:
    """The output for each input, the same in both readings."""
    rows = [{"u": u} for u in GIVEN]
    runner = ModelRunner(read)
    found = [next(iter(runner.step(row).values())) for row in rows]
    both = compared(read, rows, domains={"y": fixed(-1000, 1000, "0.125")})
    assert (both.rows, both.refused, both.fault) == (len(rows), "", "")
    return found


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("y = u;", [0, 1, 2, 3, -1]), ("y = u; y(1) = y(1) + 1;", [1, 2, 3, 4, 0]),
        ("y = g(u) + g(2);", [4, 5, 6, 7, 3]), ("y = nargin + u;", [1, 2, 3, 4, 0]),
    ],
)  # fmt: skip
def test_what_a_function_gives_is_not_the_datum_of_the_chart_with_its_name(
    tmp_path: Path, body: str, expected: list[float]
) -> None:
    """It was written to the datum, and the function gave nothing."""
    assert given_by(script_of(body, tmp_path)) == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("y = sum(uint8([200 100])) + u;", [300, 301, 302, 303, 299]),
        ("y = sum(int8([1 2 u])) / 2;", [1.5, 2, 2.5, 3, 1]),
        ("y = prod(int8([100 2])) + u;", [200, 201, 202, 203, 199]),
        ("y = mean(int32([1 2])) + u;", [1.5, 2.5, 3.5, 4.5, 0.5]),
        ("y = double(dot(int8([1 2]), int8([u 3])));", [6, 7, 8, 9, 5]),
    ],
)  # fmt: skip
def test_sums_and_products_of_integers_are_double(tmp_path: Path, body: str, expected: list[float]) -> None:
    """They stopped at the ends of the type, and a quotient of a sum was rounded."""
    assert given_by(script_of(body, tmp_path)) == expected


@pytest.mark.parametrize(
    ("call", "said"),
    [("pow(u - 10, 0.5)", "no real number"), ("pow(10, 200.0 * u)", ""), ("ldexp(1, 1000.0 * u)", "")],
)
def test_numbers_of_c_without_a_value_are_no_internal_error(tmp_path: Path, call: str, said: str) -> None:
    runner = ModelRunner(in_c(f"y = {call} > 5;", tmp_path))
    if said:
        with pytest.raises(DrawnFault, match=said):
            runner.step({"u": 2})
    else:
        assert runner.step({"u": 2}) == {"y": 1}


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("A = [1 2; 3 u]; v = sum(A); y = v(2);", [2, 3, 4, 5, 1]),
        ("A = [1 2; 3 u]; v = sum(A, 2); y = v(2);", [3, 4, 5, 6, 2]),
        ("A = [1 2; 3 u]; v = max(A, [], 1); y = v(2);", [2, 2, 2, 3, 2]),
        ("A = [1 2; 3 u]; y = max(max(A)) + all(any(A));", [4] * 5),
        ("y = min([u, 2], [], 2);", [0, 1, 2, 2, -1]), ("y = mean([u 1; 3 2]) * [2; 0];", [3, 4, 5, 6, 2]),
    ],
)  # fmt: skip
def test_matrices_are_reduced_along_their_columns(tmp_path: Path, body: str, expected: list[float]) -> None:
    """All of a matrix made one value."""
    assert given_by(script_of(body, tmp_path)) == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("b = [u; 2; 3]; b = [u; b(1:end-1)]; y = b(3);", [2] * 5),
        ("b = [u; 2; 3]; B = [b b]; y = B(1,2) + numel(B);", [6, 7, 8, 9, 5]),
        ("b = [1 2 3]; B = [b; b]; y = B(2,3) + u;", [3, 4, 5, 6, 2]),
        ("x = [u > 0, 5]; y = x(2);", [5] * 5),
        ("x = [single(1) int8(2) u]; y = double(x(3));", [0, 1, 2, 3, -1]),
        ("a = true(1,3); a(2) = u > 1; y = sum(a);", [2, 2, 3, 3, 2]),
        ("a = false(3,1); a(2) = u > 0; y = double(any(a));", [0, 1, 1, 1, 0]),
        ("a = repmat([u 1], 2, 2); y = a(2,3) + numel(a);", [8, 9, 10, 11, 7]),
        ("a = eye(2) * [u; 7]; y = a(1);", [0, 1, 2, 3, -1]),
        ("b = circshift([u 2 3], [0 1]); y = b(2);", [0, 1, 2, 3, -1]),
        ("b = circshift([u; 2; 3], -1); y = b(3);", [0, 1, 2, 3, -1]),
        ("s = sort([3 u 1], 'descend'); t = sort([2; u]); y = s(3) + 10 * t(2);", [20, 21, 21, 31, 19]),
        ("b = fliplr([u 2]); c = flip([u; 3]); y = b(2) + c(1);", [3, 4, 5, 6, 2]),
        ("y = dot([1 2], [u 1]) + nnz([u 0 1]);", [3, 5, 6, 7, 3]),
        ("v = cumsum([u 1 1]); y = v(3);", [2, 3, 4, 5, 1]),
    ],
)  # fmt: skip
def test_matrices_stand_beside_and_below_each_other(tmp_path: Path, body: str, expected: list[float]) -> None:
    assert given_by(script_of(body, tmp_path)) == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("y = double(xor(u > 0, u > 1)) + not(u) + and(u, 1);", [1, 2, 1, 1, 1]),
        ("y = double(idivide(int32(7), int32(u + 2)));", [3, 2, 1, 1, 7]),
        ("y = double(intmax('int8')) - double(intmin('uint8')) - 127 + u;", [0, 1, 2, 3, -1]),
        ("[m, i] = max([u 2 1]); y = m * 10 + i;", [22, 22, 21, 31, 22]),
        ("[~, i] = min([u; 2]); y = i;", [1, 1, 1, 2, 1]),
        ("[r, c] = size([1 2 3]); y = r * 10 + c + u;", [13, 14, 15, 16, 12]),
        ("y = double(isa(int8(1), 'int8')) + ismember(u, [1 3]);", [1, 2, 1, 2, 1]),
        ("x = zeros(1, 2, 'like', int8(1)); x(1) = u; y = double(cast(x(1), 'like', 1));", [0, 1, 2, 3, -1]),
        ("coder.inline('never'); coder.extrinsic('disp'); K = coder.const(3); y = K * u;", [0, 3, 6, 9, -3]),
        ("if u > 5, error('Too:large', 'u is %d', u); end\ny = u;", [0, 1, 2, 3, -1]),
        ("y = power(u, 2) + minus(u, 1);", [-1, 1, 5, 11, -1]),
    ],
)  # fmt: skip
def test_functions_that_were_not_known(tmp_path: Path, body: str, expected: list[float]) -> None:
    assert given_by(script_of(body, tmp_path)) == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("s = struct('a', 1, 'b', u); s.a = s.a + 2; y = s.a + s.b;", [3, 4, 5, 6, 2]),
        ("a.b.c = u; a.d = 1; y = a.b.c + a.d;", [1, 2, 3, 4, 0]),
        ("s = struct('v', [1 2 3]); s.v(2) = u; t = s; t.v(1) = 5; y = sum(s.v);", [4, 5, 6, 7, 3]),
        ("s = struct('n', 0); if u > 1, s.n = u; else, s.n = 5; end\ny = s.n;", [5, 5, 2, 3, 5]),
        (
            "persistent s\nif isempty(s), s = struct('n', 0, 'ok', false); end\nif u > 2, s.n = 0; end\n"
            "s.n = mod(s.n + u, 7); s.ok = s.n > 2; y = s.n + double(s.ok) * 10;",
            [0, 1, 13, 13, 2],
        ),
    ],
)  # fmt: skip
def test_scripts_make_structures_and_keep_them(tmp_path: Path, body: str, expected: list[float]) -> None:
    assert given_by(script_of(body, tmp_path)) == expected


def test_an_error_of_a_function_has_no_step_after_it(tmp_path: Path) -> None:
    read = script_of("if u > 2, error('Too:large', 'u is %d', u); end\ny = u;", tmp_path)
    found = compared(read, [{"u": u} for u in GIVEN], domains={"y": fixed(-10, 10, 1)})
    assert (found.rows, found.fault) == (3, "C: error(...) is called: Too:large u is %d")


def test_a_text_is_not_left_out_of_the_arguments(tmp_path: Path) -> None:
    """`sum(x, 'native')` was `sum(x)`, and `numel('abc')` an internal error."""
    for number, body in enumerate(("y = sum([u 1], 'native');", "y = numel('abc');")):
        (tmp_path / str(number)).mkdir()
        with pytest.raises(DrawnFault, match="takes no text here"):
            ModelRunner(script_of(body, tmp_path / str(number))).step({"u": 1})


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("y = fabs(u - 2.0) + labs(u);", [2, 2, 2, 4, 4]), ("y = fmod(u, 2) + pow(u, 2);", [0, 2, 4, 10, 0]),
        ("y = ldexp(u, 2);", [0, 4, 8, 12, -4]), ("y = u & ~1;", [0, 0, 2, 2, -2]),
        ("y = ~0x10 & 0xFF;", [0xEF] * 5), ("y = uint16(7) & (u - 2);", [6, 7, 0, 1, 5]),
    ],
)  # fmt: skip
def test_functions_and_bits_of_c(tmp_path: Path, text: str, expected: list[float]) -> None:
    assert given_by(in_c(text, tmp_path)) == expected


@pytest.mark.parametrize("language", ["C", "MATLAB"])
@pytest.mark.parametrize(
    ("word", "expected"),
    [("tick", [0, 1, 2, 3, 4]), ("wakeup", [0, 1, 2, 3, 4]), ("after(2, wakeup)", [0, 0, 1, 2, 3])],
)
def test_a_step_is_an_event(tmp_path: Path, language: str, word: str, expected: list[float]) -> None:
    """`on tick` never was."""
    text = f"in u int8\nout y int32\n-> A\nstate A: on {word}: y = y + 1;"
    assert given_by(ChartText("one", text, language).read(tmp_path)) == expected
