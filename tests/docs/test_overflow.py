# SPDX-License-Identifier: Apache-2.0
"""The site in Chromium: no page is wider than the window, on a desk and on a phone; the search works from disk."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

from tests.support.patience import seconds

pytestmark = pytest.mark.lint

WIDTHS = (390, 1280)
_CHROMIUM = ("chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage")
_MEASURE = """<!doctype html><body><script>
const pages = PAGES, widths = WIDTHS, found = [];
function measured(page) {
  return new Promise(done => {
    const frame = document.createElement("iframe");
    frame.style = `width:${widths[0]}px;height:800px;border:0`;
    frame.onload = () => {
      const text = frame.contentDocument, whole = text.documentElement;
      const styled = text.styleSheets.length;
      // From one width to the next, no drawer slides for a while: what is measured is where all ends up.
      text.head.append(Object.assign(text.createElement("style"), {textContent: "* {transition: none !important}"}));
      const codes = [...text.querySelectorAll("pre > code")];
      for (const width of widths) {
        frame.style.width = `${width}px`;  // the next width that is read is of a new layout
        const cut = codes.filter(
          code => code.scrollWidth > code.clientWidth + 1 && getComputedStyle(code).overflowX === "hidden");
        found.push({page, width, wide: whole.scrollWidth, cut: cut.length, styled,
                    text: text.body.innerText.length});
      }
      frame.remove();
      done();
    };
    frame.src = page;
    document.body.append(frame);
  });
}
async function all() {
  for (const page of pages) await measured(page);
  await fetch("/measured", {method: "POST", body: JSON.stringify(found)});
}
all();
</script>"""


class _Handler(SimpleHTTPRequestHandler):
    """Serves the site and the page that measures it, and takes its result."""

    def __init__(
        self, measure: str, results: list[Any], done: threading.Event, *rest: Any, **more: Any
    ) -> None:
        self.measure, self.results, self.done = measure, results, done
        super().__init__(*rest, **more)

    def do_GET(self) -> None:
        if self.path != "/measure.html":
            super().do_GET()
            return
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(self.measure.encode())

    def do_POST(self) -> None:
        self.results += json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        self.done.set()

    def log_message(self, *_: Any) -> None:
        pass


@contextmanager
def _chromium(address: str, folder: Path) -> Iterator[None]:
    command = [*_CHROMIUM, f"--user-data-dir={folder}", "--remote-debugging-port=0", address]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.kill()
        process.wait(20)


def measure(folder: Path, pages: list[str], profile: Path) -> list[dict[str, Any]]:
    """Return how wide each page of `folder` is in windows of each width."""
    text = _MEASURE.replace("PAGES", json.dumps(pages)).replace("WIDTHS", json.dumps(WIDTHS))
    results: list[dict[str, Any]] = []
    done = threading.Event()
    handler = partial(_Handler, text, results, done, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        with _chromium(f"http://127.0.0.1:{server.server_port}/measure.html", profile):
            ended = done.wait(300)
        server.shutdown()
    assert ended, "Chromium sent no result"
    return results


@pytest.fixture(scope="module", autouse=True)
def _needs_chromium() -> None:
    if shutil.which("chromium") is None:
        pytest.skip("no chromium: apt-get install chromium")


def test_no_page_is_wider_than_its_window(site: Path, tmp_path: Path) -> None:
    pages = [
        str(path.relative_to(site)) for path in sorted(site.rglob("*.html")) if "files" not in path.parts
    ]
    results = measure(site, pages, tmp_path)
    assert len(results) == len(pages) * len(WIDTHS) > 80
    assert all(each["styled"] > 0 and each["text"] > 40 for each in results), "each page was loaded"
    assert [each for each in results if each["wide"] > each["width"] or each["cut"]] == []


def test_a_wide_page_is_found(tmp_path: Path) -> None:
    (tmp_path / "wide.html").write_text(
        "<style>pre{margin:0}code{display:block;overflow:hidden;width:100px}</style>"
        f'<body style="margin:0"><div style="width:900px">x</div><pre><code>{"y" * 99}</code></pre>'
    )
    narrow, desk = sorted(
        measure(tmp_path, ["wide.html"], tmp_path / "profile"), key=lambda each: each["width"]
    )
    assert narrow["wide"] == 900
    assert desk["wide"] <= 1280
    assert narrow["cut"] == desk["cut"] == 1


def test_the_search_works_on_pages_opened_from_disk(site: Path, tmp_path: Path) -> None:
    """`make docs` names a file; a browser starts no worker for its pages, and fetches nothing."""
    address = f"{(site / 'index.html').as_uri()}?q=treemap"
    command = [
        *_CHROMIUM,
        f"--user-data-dir={tmp_path}",
        "--virtual-time-budget=20000",
        "--dump-dom",
        address,
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=seconds(120))
    assert re.search(r"\b[1-9]\d* matching document", done.stdout)
    assert 'href="howto/size.html' in done.stdout.partition("matching document")[2]
