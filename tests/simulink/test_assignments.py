"""Scripts of MATLAB say values in assignments, whatever stands around them."""

from contextlib import suppress
from pathlib import Path

import pytest

from rovercheck.checker.simulink.assignments import assignments
from rovercheck.checker.simulink.dictionary import Definitions
from rovercheck.spec_model.lang.errors import ModelError


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("A = 5;", {"A": "5"}),
        ("A=5; B = 6, C = 7\nD = uint8(5)", {"A": "5", "B": "6", "C": "7", "D": "uint8(5)"}),
        ("A = [1, 2; 3 4]; % two rows\r\nB = 1;", {"A": "[1, 2; 3 4]", "B": "1"}),
        ("A = [1 2\n     3 4];", {"A": "[1 2;     3 4]"}),
        ("A = 1 + ... and\n  2;", {"A": "1 +    2"}),
        ("S = '50 % of it; all'; T = \"it's\";", {"S": "'50 % of it; all'", "T": '"it\'s"'}),
        ("A = [1 2]'; B = A'; C = x.';", {"A": "[1 2]'", "B": "A'", "C": "x.'"}),
        ("%{\nA = 1;\n%}\nB = 2; % C = 3;", {"B": "2"}),
        ("P = Simulink.Parameter(5);\nP.Value = 6;", {"P": "Simulink.Parameter(5)", "P.Value": "6"}),
        ("if A == 1\n  B = 2;\nend\nA == 3;\nf(x)\n[a, b] = g(1);", {"B": "2"}),
        ("A = 1;\nA = 2;", {"A": "2"}),
        ("A = ;\n = 5;\n5 = A", {}),
        ("A = (1; B = 2", {"A": "(1; B = 2"}),
        ("A = 1) ; B = 2", {"A": "1)", "B": "2"}),
        ("A = 'open; B = 2\nC = 3", {"A": "'open", "B": "2", "C": "3"}),
        ("", {}),
    ],
)
def test_a_script_says_values(script: str, said: dict[str, str]) -> None:
    assert dict(assignments(script)) == said


@pytest.mark.parametrize(
    "piece", ["%{\n", "'", '"', "(", "...", "%", "=", "a", "\n%{", "''", "a'", "%}\n", " ", "\n", "'a", '""']
)
def test_a_script_of_one_thing_many_times_is_read_at_once(piece: str) -> None:
    """No search in it begins anew at each of them."""
    assert len(list(assignments(piece * 20_000))) <= 1
    assert len(list(assignments(f"A = 1{piece * 20_000}B"))) <= 1


START = "classdef Gear < int8\n"


@pytest.mark.parametrize(
    "text",
    [
        "\n" * 300_000, " " * 300_000, "classdef " * 50_000, "classdef\n" * 50_000,
        f"{START}enumeration\n{'a' * 300_000}",
        f"{START}enumeration\n{'a ' * 300_000}",
        f"{START}enumeration\nA{' ' * 300_000}", f"{START}{'%' * 300_000}",
        f"{START}enumeration\nA(0)\nend\n{'function a = getDefaultValue ' * 10_000}",
        f"{START}enumeration\nA(0)\nend\nfunction a = getDefaultValue{chr(10) * 300_000}",
    ],
    ids=range(10),
)  # fmt: skip
def test_a_class_of_one_thing_many_times_is_read_at_once(text: str, tmp_path: Path) -> None:
    (tmp_path / "Gear.m").write_text(text, encoding="utf-8")
    definitions = Definitions()
    with suppress(ModelError):
        definitions.read_text(tmp_path / "Gear.m")
    assert len(definitions.enumerations) <= 1
