"""Proposed mapping files: what is right, that nothing is wrong without a remark, and hostile sources."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

from rovercheck.checker.adapters.c_map import read
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare import check, recorded_runs
from rovercheck.checker.mapping.entry_points import entry_points
from rovercheck.checker.mapping.map_text import MapProposal
from rovercheck.checker.mapping.match import matched
from rovercheck.checker.mapping.places import CLeaves
from rovercheck.checker.mapping.source import declarations
from rovercheck.checker.mapping.words import likeness, words
from rovercheck.spec_model.abstraction import boards

pytest.importorskip("tree_sitter_c")
ROOT = Path(__file__).parents[2]

KNOWN = {
    "examples/board1_c": ("board1", 1.0),
    "benchmarks/twins/firmware/board1_c": ("board1", 1.0),
    "benchmarks/twins/firmware/board2_c": ("board2", 0.9),
}
"""Folders with a map that a person wrote: of which board, and which part of its names is found at least."""
GIVEN_OTHERWISE = {"last_valid_b1_ms": "sensors.b1_alive", "last_valid_b2_ms": "task_in.heartbeat_counter"}
"""Counters, which the maps count by declarations of their own and a proposal by ``counter``."""


@dataclass(frozen=True)
class Said:
    code: Exit
    out: str
    err: str


@pytest.fixture
def said(capsys):
    """A command line that is run, and what it says without line breaks."""

    def said(*arguments):
        code = run(list(arguments))
        heard = capsys.readouterr()
        return Said(code, " ".join(heard.out.split()), " ".join(heard.err.split()))

    return said


def proposed(folder, board):
    found = declarations(folder)
    entry = entry_points(found)
    return MapProposal(board, found, entry, *matched(boards()[board], CLeaves(found, tuple(entry.own))))


def place(written):
    return written if isinstance(written, str) else written.get("at", written.get("counter"))


@pytest.mark.parametrize("folder", KNOWN)
def test_names_are_matched_rightly_and_none_wrongly_without_a_remark(folder):
    board, share = KNOWN[folder]
    proposal = proposed(ROOT / folder, board)
    by_hand = tomllib.loads((ROOT / folder / "map.toml").read_text(encoding="utf-8"))
    right = wanted = 0
    for section, matches in (("inputs", proposal.inputs), ("outputs", proposal.outputs)):
        for one in matches:
            if one.signal.name not in by_hand[section]:
                assert one.leaf is None or not one.sure, one.signal.name
                continue
            wanted += 1
            found = one.leaf.at if one.leaf else None
            good = found in (place(by_hand[section][one.signal.name]), GIVEN_OTHERWISE.get(one.signal.name))
            right += good
            assert good or not one.sure, f"{one.signal.name} is not {found}, and nothing is said"
    assert right >= share * wanted, f"{right} of {wanted}"


@pytest.mark.usefixtures("cc")
def test_the_twin_of_board_1_conforms_with_the_map_as_it_is_proposed(tmp_path, monkeypatch, said):
    monkeypatch.setattr(check, "_known", lambda env, folder: recorded_runs.counterexamples(env.board))
    monkeypatch.chdir(tmp_path)
    folder, map_file = ROOT / "benchmarks/twins/firmware/board1_c", tmp_path / "map.toml"
    found = said("map", "init", str(folder), "-o", str(map_file))
    assert found.code is Exit.AS_EXPECTED and "takes it as it is" in found.err
    assert "The names fit board1 best" in found.err
    address = f"c:{folder},map={map_file}"
    found = said("compare", "--system", "board1", "--impl", address, "--examples", "2")
    assert found.code is Exit.AS_EXPECTED and "board1 conforms" in found.out


STYLES: dict[str, tuple[str, str, dict[str, str | None]]] = {
    "pointers": (
        """
        #include "platform_that_is_not_here.h"
        typedef struct { uint32_t now_ms; float temperature_degC; uint8_t buttons[2]; } in_t;
        typedef struct { bool give_b2_actuation; int16_t v_ref; /* LSB = 0.01 */ } out_t;
        void relay_init(void);
        void relay_step(const in_t *in, out_t *out);
        """,
        '#include "f.h"\nvoid relay_init(void) {}\n'
        "void relay_step(const in_t *in, out_t *out) { out->give_b2_actuation = in->now_ms > 3; }\n",
        {
            "now_ms": "map_in.now_ms",
            "temperature_degC": "map_in.temperature_degC",
            "give_b2_actuation": "map_out.give_b2_actuation",
        },
    ),
    "result": (
        """
        struct result { int critical_mask; };
        struct result board_cycle(double battery_pct, double temperature_degC);
        void setup(void);
        """,
        '#include "f.h"\nvoid setup(void) {}\nstruct result board_cycle(double battery_pct, '
        "double temperature_degC) { struct result r = { battery_pct > temperature_degC }; return r; }\n"
        "int main(void) { setup(); for (;;) board_cycle(1, 2); }\n",
        {"battery_pct": "map_battery_pct", "critical_mask": "map_result.critical_mask"},
    ),
    "globals without a header": (
        "",
        "double temperature_degC; static double battery_pct; unsigned char critical_mask;\n"
        "void init(void) {}\nvoid step(void) { critical_mask = temperature_degC > battery_pct; }\n",
        {"temperature_degC": "temperature_degC", "battery_pct": None, "critical_mask": "critical_mask"},
    ),
}


@pytest.mark.parametrize("style", STYLES)
def test_firmware_of_other_styles(style, tmp_path):
    header, source, wanted = STYLES[style]
    (tmp_path / "f.h").write_text(header, encoding="utf-8")
    (tmp_path / "f.c").write_text(source, encoding="utf-8")
    proposal = proposed(tmp_path, "board1")
    found = {one.signal.name: one.leaf.at if one.leaf else None for one in proposal.signals}
    assert {name: found[name] for name in wanted} == wanted
    text = proposal.text("map init")
    (tmp_path / "map.toml").write_text(text, encoding="utf-8")
    assert read(tmp_path / "map.toml", boards()["board1"]).step
    if style == "pointers":
        assert 'v_ref = { at = "map_out.v_ref", scale = 0.01 }' in text and "scale 0.01 by its words" in text
    if style == "result":
        assert 'step = "map_result = board_cycle(map_battery_pct, map_temperature_degC)"' in text


@pytest.mark.parametrize(
    "source",
    [
        "",
        "\xff\xfe\x00",
        "}}}} struct { int",
        "#define X(a) a\nX(int) y X() 3 = ;",
        "typedef a b; typedef b a; extern a now_ms; void step(void);",
        "struct s { struct s s; int a[99999999999999999999]; int b[N]; } v;\nvoid step(struct s *p) {}",
        "void step(void) { a.b->c[d(1)].e = (f) + -g; (*h)->i++; memcpy(&j, k); }",
        "int (*step)(void), *a[3], (*b)[4]; __attribute__((x)) void init(__packed struct q *r);",
        "void step(" + "(" * 300 + ")" * 300,
    ],
)
def test_sources_that_are_odd_or_no_c(source, tmp_path):
    (tmp_path / "f.c").write_bytes(source.encode("latin-1"))
    proposal = proposed(tmp_path, "board2")
    assert tomllib.loads(proposal.text("map init")) is not None
    assert list(proposal.remarks())


def test_what_cannot_be_read_or_is_there_is_one_message(tmp_path, said):
    (tmp_path / "f.c").write_text("void step(void) {}", encoding="utf-8")
    (tmp_path / "map.toml").write_text("mine", encoding="utf-8")
    for arguments, message in (
        (["nowhere"], "is no folder"),
        ([str(tmp_path)], "is there already; write --force"),
        ([str(tmp_path), "--system", "board3", "--force"], "No board 'board3'"),
    ):
        found = said("map", "init", *arguments)
        assert found.code is Exit.USAGE and message in found.err
    assert (tmp_path / "map.toml").read_text(encoding="utf-8") == "mine"
    (tmp_path / "empty").mkdir()
    found = said("map", "init", str(tmp_path / "empty"))
    assert found.code is Exit.USAGE and "has no C file" in found.err


def test_words_of_names():
    assert words("hasNoFeedback_FL") == ("has", "no", "feedback", "fl")
    assert words("B2Dec") == ("b2", "dec") and words("crit_mask_b2") == ("crit", "mask", "b2")
    assert likeness("batt", "battery") > 0.8 and likeness("left", "right") == 0
