"""Files that are written: what stands in a cell of a table is what a person reads there, and no command."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.io.files import csv_cell, csv_plain


@pytest.mark.parametrize(
    "text", ["", "a", "-", "-0.5", "+3", "-1e-05", "-1/3", "true", "B2-B1", "a=b", "-inf", "1 + 1"]
)
def test_a_cell_stays_as_it_is(text: str) -> None:
    assert csv_cell(text) == text


@pytest.mark.parametrize(
    "text",
    [
        "=1",
        "+a",
        "-a",
        "@SUM(1)",
        "\t=1",
        "\r=1",
        "-1+cmd|' /C calc'!A0",
        "-1 =2",
        "--1",
        "＝1+1",
        "＋1",
        "－1",
        "＠1",
        "'",
        "'=1",
    ],
)
def test_a_cell_that_would_be_computed_is_quoted(text: str) -> None:
    assert csv_cell(text) == f"'{text}"


@given(st.text(st.sampled_from("=+-@'\t\r\uff1d1e./x"), max_size=5))
def test_every_text_is_found_again(text: str) -> None:
    assert csv_plain(csv_cell(text)) == text
