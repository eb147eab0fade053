"""The review page: all that was found is there, every link leads somewhere, no text breaks out."""

import json
import pickle
import re
import zlib
from base64 import b64decode
from collections import Counter
from dataclasses import replace
from urllib.parse import unquote

import pytest

from rovercheck.checker.render.review import grouped, inside, render, title_of
from rovercheck.checker.render.review.fragments import TOGETHER, PackedFragments
from rovercheck.checker.render.review.model import HazardRow
from rovercheck.checker.render.review.traces import shared
from tests.render.test_page import Reader
from tests.render.toy_review import (
    ALL,
    BROKEN,
    CHANGED,
    EVIL,
    FINE,
    GRAPH,
    OPEN,
    PART,
    RUN,
    SAME,
    checked,
    review,
)

DRAWN = ("chart Relay", "chart Nested")


@pytest.fixture(scope="module")
def document() -> str:
    return render(review())


@pytest.fixture(scope="module")
def page(document: str) -> Reader:
    return Reader(document)


def test_the_same_data_give_the_same_page(document: str) -> None:
    assert render(review()) == document


def test_every_thing_has_an_address_of_its_own(page: Reader) -> None:
    ids = [a["id"] for _, a in page.elements if "id" in a]
    assert [id for id, count in Counter(ids).items() if count > 1] == []
    kinds = {
        "requirement-R-0",
        "reading-S1",
        "repair-mend",
        "chart-Nested",
        "system-toy",
        "assumption-A1",
        "graph-toy",
    }
    assert {*kinds, *(p.id for p in ALL)} <= set(ids)


def test_every_link_leads_to_something_on_the_page(page: Reader) -> None:
    ids = {a["id"] for _, a in page.elements if "id" in a}
    links = [a["href"] or "" for tag, a in page.elements if tag == "a"]
    assert len(links) > 20
    assert [x for x in links if not x.startswith("#") or unquote(x[1:]) not in ids] == []


def test_no_text_of_a_model_becomes_markup(page: Reader, document: str) -> None:
    assert "document.title='broken into'" not in "".join(t for k, t in page.scripts if not k)
    assert all("onerror" not in attributes for _, attributes in page.elements)
    assert [tag for tag, _ in page.elements if tag == "img"] == []
    pictures = [a for name in DRAWN for tag, a in Reader(unpacked(document)[name]).elements if tag == "img"]
    assert {(a["src"] or "")[:19] for a in pictures} == {"data:image/svg+xml,"} and len(pictures) == 2


def test_nothing_is_fetched(page: Reader, document: str) -> None:
    sources = [a[name] for _, a in page.elements for name in ("src", "href", "action", "data") if a.get(name)]
    assert [s for s in sources if s and not s.startswith(("#", "data:"))] == []
    assert "url(" not in document and "@import" not in document


def test_findings_come_first_and_with_the_same_cause_together() -> None:
    assert grouped(review().findings, {}) == [
        ("Not as expected", "", [("", [CHANGED])]),
        ("Relay", "", [("T-1", [BROKEN, SAME])]),
        ("Link", "", [("T-4", [OPEN])]),
    ]


def test_findings_are_grouped_by_hazard_the_gravest_first() -> None:
    worse, small = replace(OPEN, hazard="H-1", place=0), replace(BROKEN, hazard="H-2", place=1)
    nothing = replace(SAME, place=2)
    hazards = {
        "H-1": HazardRow("H-1", "It bites.", "critical", "§1 says so."),
        "H-2": HazardRow("H-2", EVIL, "negligible", EVIL),
    }
    one = replace(review((small, nothing, worse)), hazards=hazards)
    groups = grouped(one.findings, hazards)
    assert [(g.title, g.says, [p.id for _, of in g.causes for p in of]) for g in groups] == [
        ("Critical: It bites.", "H-1, critical. §1 says so.", ["T-4"]),
        (f"Negligible: {EVIL}", f"H-2, negligible. {EVIL}", ["T-1"]),
        ("Unrated", "No hazard names what is broken.", ["T-2"]),
    ]
    shown = render(one)
    assert shown.index("Critical: It bites.") < shown.index("Unrated") and "<script>document" not in shown


def test_a_finding_stands_alone() -> None:
    told = replace(
        BROKEN, effect=f"It bites {EVIL}", since="2026-03-01",
        decision=f"accepted by {EVIL} until 2026-04-01",
        lapsed=True, hazard="H-1", assumptions=("A1",),
    )  # fmt: skip
    hazard = HazardRow("H-1", "Teeth.", "critical", "§1 says so.")
    shown = render(replace(review((told,)), hazards={"H-1": hazard}))
    start = shown.index('id="T-1"')
    section = shown[start : shown.index("</details>", start)]
    wanted = [
        "What goes wrong",
        "How bad",
        "Why it happens",
        "Known since",
        "Decision",
        "Demanded",
        "Depends on",
    ]
    places = [section.index(f"<dt>{name}</dt>") for name in wanted]
    assert places == sorted(places)
    assert "It bites &lt;/script&gt;" in section and "#assumption-A1" in section and "2026-03-01" in section
    assert "<script>document" not in shown


def test_of_a_finding_the_story_is_there_to_read_without_scripts(document: str) -> None:
    start = document.index('id="T-1"')
    section = document[start : document.index("</details>", start)]
    assert "duration(level &lt; 5) &gt; 3 s" in section
    assert "False after tick 153" in section
    assert "Proposed repair" in section and "bdd: all 4 reachable states" in section


def test_a_finding_without_a_repair_says_why(document: str) -> None:
    assert "There is none." in document[document.index('id="T-2"') :]


def test_what_is_missing_is_said_or_left_out() -> None:
    bare = replace(
        review((FINE,)),
        demands=(),
        interpretations=(),
        repairs=(),
        charts={},
        assumptions=(),
        coverage=(),
        graphs=(),
    )
    shown = render(bare)
    ids = {a.get("id") for _, a in Reader(shown).elements}
    assert ids.isdisjoint(
        {f"section-{s}" for s in ("findings", "requirements", "repairs", "readings", "graphs")}
    )
    assert "no generated tests" in shown and "Open points</h3>\n<p>None.</p>" in shown
    assert "not checked whether" not in shown
    assert "not checked whether" in render(replace(bare, properties=(replace(FINE, premise=""),)))


def test_headings_are_written_as_people_write_them() -> None:
    assert title_of("board2_motion") == "Board 2 motion"


def unpacked(document: str) -> dict[str, str]:
    """The fragments that the page keeps, as the browser unpacks them."""
    [block] = re.findall(r'<script type="application/json" class="packed">(.*?)</script>', document)
    found: dict[str, str] = {}
    for parcel in json.loads(block):
        columns = json.loads(zlib.decompress(b64decode(parcel["parts"]), -zlib.MAX_WBITS))
        found |= {name: "".join(c[i] for c in columns) for i, name in enumerate(parcel["names"])}
    return found


def test_moving_pictures_are_kept_for_every_trace_and_each_chart_once(document: str) -> None:
    fragments = unpacked(document)
    proofs = {inside(one.id) for one in ALL if not one.finding}
    assert set(fragments) == {"T-1", "T-2", "T-7", "*", "graph toy", *proofs, *DRAWN}
    assert all(fragments[id].count('<section class="player') == 1 for id in ("T-1", "T-2", "T-7"))
    assert not any("<noscript" in one for one in fragments.values()), "a script unpacks them: none is shown"
    assert fragments["*"].count("<template") == 1
    assert "told" in fragments["T-7"] and "told" not in fragments["T-1"]


def test_what_proofs_rest_on_is_packed_and_findings_are_not(document: str) -> None:
    fragments = unpacked(document)
    assert "accepted: 4 obligations" in fragments[inside("T-5")]
    assert "accepted: 4 obligations" not in document and inside("T-1") not in fragments
    assert "&lt;img src=x" in fragments[inside(PART.id)] and "<img" not in fragments[inside(PART.id)]


def test_many_fragments_are_kept_in_several_parcels() -> None:
    many = tuple(checked(f"T-{i}", "proved", trace=RUN) for i in range(TOGETHER + 2))
    document = render(review(many))
    fragments = set(unpacked(document))
    assert fragments == {"*", "graph toy", *DRAWN, *(p.id for p in many), *(inside(p.id) for p in many)}
    assert len(PackedFragments().parts()) == 0


def test_a_state_graph_says_how_far_to_trust_it_without_scripts(document: str) -> None:
    start = document.index('id="graph-toy"')
    section = document[start : document.index("</section>", start)]
    for told in (
        GRAPH.size,
        str(GRAPH.kind),
        f"because {GRAPH.because[0]}.",
        "T-1 is broken in",
        'href="#T-1"',
    ):
        assert told in section
    assert "Without a graph here" in section and "stategraph-data" not in section
    picture = unpacked(document)["graph toy"]
    assert picture.count('data-node="') == len(GRAPH.nodes) and "<h1>" not in picture


def test_a_page_with_graphs_and_no_run_needs_no_gallery() -> None:
    shown = render(review((FINE,)))
    assert set(unpacked(shown)) == {"graph toy", inside(FINE.id), *DRAWN} and 'class="gallery"' not in shown


def test_equal_charts_become_one_object() -> None:
    other = pickle.loads(pickle.dumps(RUN))
    assert other.system.statecharts["Relay"] is not RUN.system.statecharts["Relay"]
    runs = shared({"a": other, "b": pickle.loads(pickle.dumps(other))})
    assert runs["a"].system.statecharts["Relay"] is runs["b"].system.statecharts["Relay"]


def test_the_page_escapes_what_it_shows(document: str) -> None:
    assert EVIL not in document
    assert "&lt;img src=x onerror=alert(1)&gt;" in document
