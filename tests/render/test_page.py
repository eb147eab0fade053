"""The frame of a page: all is escaped, each script comes once and has its hash, data stays data."""

import json
import re
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser

import pytest
from markupsafe import Markup

from rovercheck.checker.render.page import Part, data, own, page

EVIL = "</script><script>alert(1)</script><!-- & \"'"


class Reader(HTMLParser):
    """The elements of a document with their attributes, and the text of each script."""

    def __init__(self, document: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: list[tuple[str, str]] = []
        self.feed(document)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag == "script":
            self.scripts.append((dict(attrs).get("type") or "", ""))

    def handle_data(self, data: str) -> None:
        if self.lasttag == "script" and self.scripts and data.strip():
            kind, text = self.scripts[-1]
            self.scripts[-1] = (kind, text + data)

    @property
    def policy(self) -> str:
        found = [a["content"] for tag, a in self.elements if a.get("http-equiv") == "Content-Security-Policy"]
        assert len(found) == 1 and found[0] is not None
        return found[0]


def test_the_title_is_escaped() -> None:
    shown = page(EVIL, [])
    assert "alert(1)" in shown
    assert Reader(shown).scripts == []


def test_without_scripts_none_may_run_and_nothing_is_fetched() -> None:
    policy = Reader(page("empty", [])).policy
    assert policy.startswith("default-src 'none';")
    assert "script-src 'none'" in policy
    assert "http" not in policy


def test_a_script_is_put_in_once_and_named_by_its_hash() -> None:
    first, second = "'use strict';console.log(1 < 2)", "console.log('é')"
    parts = [Part(Markup("<p>"), scripts=(first, second)), Part(Markup("<p>"), scripts=(second,))]
    shown = Reader(page("scripts", parts))
    assert [text for _, text in shown.scripts] == [first, second]
    hashes = [b64encode(sha256(text.encode()).digest()).decode() for text in (first, second)]
    assert re.findall(r"'sha256-([^']+)'", shown.policy) == hashes


def test_styles_are_put_in_once_after_the_common_ones() -> None:
    shown = page("styles", [Part(Markup(""), ("a{b:c}",)), Part(Markup(""), ("a{b:c}", "d{e:f}"))])
    assert re.findall(r"<style>(.*?)</style>", shown, re.DOTALL) == [own("base.css"), "a{b:c}", "d{e:f}"]


@pytest.mark.parametrize("text", ["x = '</script>'", "x = '</SCRIPT >'", "<!-- x"])
def test_a_script_that_would_end_itself_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="write"):
        page("broken", [Part(Markup(""), scripts=(text,))])


def test_a_style_that_would_end_itself_is_refused() -> None:
    with pytest.raises(ValueError, match="style"):
        page("broken", [Part(Markup(""), styles=("a{}</style><p>",))])


def test_data_cannot_end_its_block() -> None:
    value = {"text": EVIL, "more": ["é", 1, None]}
    shown = Reader(page("data", [Part(data(value, 'kind"><p'))]))
    [(kind, text)] = shown.scripts
    assert kind == "application/json"
    assert "<" not in text
    assert json.loads(text) == value
    assert ("p", {}) not in shown.elements


def test_a_page_is_the_same_every_time_and_ends_with_a_line_end() -> None:
    parts = [Part(Markup("<p>x</p>"), ("a{}",), ("b",))]
    assert page("same", parts) == page("same", parts)
    assert page("same", parts).endswith("</html>\n")


def luminance(colour: str) -> float:
    """Relative luminance as WCAG 2.2 defines it."""
    parts = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("scheme", [0, 1])
def test_every_colour_of_text_stands_out(scheme: int) -> None:
    """At least 4.5 to 1, on paper and panel, light and dark (WCAG 2.2, level AA)."""
    rules = re.findall(r":root\{(--ink[^}]*)\}", own("base.css"))
    colours = dict(re.findall(r"--(\w+):(#[0-9a-f]{6})", rules[scheme]))
    for name in ("ink", "soft", "link", "ok", "bad", "open", "input"):
        for behind in ("paper", "panel"):
            dark, light = sorted((luminance(colours[name]), luminance(colours[behind])))
            assert (light + 0.05) / (dark + 0.05) >= 4.5, (name, behind)
