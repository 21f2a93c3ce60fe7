# SPDX-License-Identifier: Apache-2.0
"""The site: it builds strictly and offline, loads nothing from elsewhere, and each of its links leads somewhere."""

from __future__ import annotations

import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

pytestmark = [pytest.mark.builds, pytest.mark.system]

_TAGS = """
html head meta title link script body nav div section article main header footer form label input button a p span ul ol
li h1 h2 h3 h4 h5 table thead tbody tr th td pre code em strong br hr img blockquote noscript dl dt dd i
svg g path rect polygon text aside
"""
_LOADS = {"script": "src", "img": "src", "iframe": "src", "source": "src", "object": "data", "link": "href"}


class Document(HTMLParser):
    """What a page of the site has: anchors, where it links to, and what a browser loads with it."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.tags: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        attributes = {name: value or "" for name, value in attrs}
        self.anchors |= {attributes[name] for name in ("id", "name") if name in attributes}
        if tag == "a" and "href" in attributes:
            self.links.append(attributes["href"])
        if _LOADS.get(tag, "") in attributes and attributes.get("rel") != "canonical":
            self.loaded.append(attributes[_LOADS[tag]])


@pytest.fixture(scope="module")
def documents(site: Path) -> dict[Path, Document]:
    return {path: Document(path) for path in sorted(site.rglob("*.html"))}


def test_no_page_loads_anything_from_elsewhere(site: Path, documents: dict[Path, Document]) -> None:
    for path, document in documents.items():
        assert document.loaded
        for address in document.loaded:
            assert not urlsplit(address).netloc, f"{path.relative_to(site)} loads {address}"
    for path in site.rglob("*.css"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"url\(['\"]?(https?:)?//|@import", text), path
    for path in site.rglob("*.js"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(
            r"(fetch|importScripts|open)\(['\"][^'\"]*//|\.src ?= ?['\"](https?:)?//", text
        ), path


def test_every_link_inside_leads_to_a_page_and_a_place_of_it(
    site: Path, documents: dict[Path, Document]
) -> None:
    wrong = []
    for path, document in documents.items():
        for link in [*document.links, *document.loaded]:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or path.name == "404.html":
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            known = documents[target].anchors if target in documents else None
            if not target.is_file() or (parts.fragment and known is not None and parts.fragment not in known):
                wrong.append(f"{path.relative_to(site)}: {link}")
    assert wrong == []


def test_nothing_in_angle_brackets_is_lost(site: Path, documents: dict[Path, Document]) -> None:
    """Markdown takes `<component>` outside of code as a tag, and a browser shows nothing."""
    for path, document in documents.items():
        assert document.tags <= set(_TAGS.split()), f"{path.relative_to(site)}: {document.tags}"


def test_the_site_has_no_time_of_its_build(site: Path) -> None:
    assert not re.search(r"Build Date UTC : \d", (site / "index.html").read_text(encoding="utf-8"))


ORDER = (
    "Home", "Install", "Quick start", "Concepts", "Tutorial", "How-to", "Reference", "Explanation",
    "Verification", "Troubleshooting", "Contributing", "Changelog", "Security",
)  # fmt: skip
"""What a newcomer reads, from top to bottom."""


def test_the_site_has_the_order_of_a_newcomer(site: Path) -> None:
    text = (site / "index.html").read_text(encoding="utf-8")
    (navigation,) = re.findall(r'(?s)<nav class="md-nav md-nav--primary".*?</nav>\s*</div>', text)
    items = re.findall(
        r'(?s)<li class="md-nav__item.*?<span class="md-ellipsis">\s*(.*?)\s*</span>', navigation
    )
    assert [item for item in items if item in ORDER] == list(ORDER)


def test_code_can_be_copied_and_pages_searched(site: Path) -> None:
    text = (site / "index.html").read_text(encoding="utf-8")
    assert "content.code.copy" in text
    assert 'data-md-component="search-query"' in text
    assert "slate" in text, "dark mode"
    assert (site / "search/search_index.json").stat().st_size > 100_000


def test_pictures_are_drawn_from_the_tools_own_output(site: Path) -> None:
    text = (site / "concepts.html").read_text(encoding="utf-8")
    pictures = re.findall(r'(?s)<div class="picture">(.*?)</svg>', text)
    assert "<!-- picture" not in text
    flow, components, nodes, *treemap = pictures
    assert all(
        f">{step}</text>" in flow for step in ("read", "resolve", "plan", "render", "write", "compile")
    )
    assert {"publish", "session", "transport_udp"} <= set(re.findall(r">(\w+)</text>", components))
    assert re.findall(r">(/\w+)(?:  [\w/]+)?</text>", nodes) == ["/ping_pong", "/ping", "/pong"]
    assert nodes.count("<polygon") == 4, "published and subscribed"
    if shutil.which("arm-none-eabi-gcc"):
        assert len(re.findall(r"<title>\w+: \d+ bytes", treemap[0])) > 100
