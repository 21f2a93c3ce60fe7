# SPDX-License-Identifier: Apache-2.0
"""Pictures of the pages, drawn when the site is built: from the list of packages and from what the tool prints.

A page has `<!-- picture: NAME -->` where a picture belongs. Each picture is an SVG inside the page, so that its
colors follow the theme, and it is the same in every run.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import tempfile
from functools import cache
from html import escape
from pathlib import Path

from generators.graph import arrange

ROOT = Path(__file__).resolve().parents[2]
BOARD = "qemu-mps2-an386"
COMPILER = "arm-none-eabi-gcc"
_MARK = re.compile(r"<!-- picture: (\w+) -->")
_STEPS = re.compile(r"(?m)^\| `compiler/` \| (read → [\w → ]+) \|")
_EDGE = re.compile(r'^  "([^":]+)" -> "([^":]+)"', re.MULTILINE)
_KEYS = re.compile(r'<h2 id="flash">.*?(<p>.*?</p>)\s*(<svg.*?</svg>)', re.DOTALL)


def insert(page: str) -> str:
    """Return a page with its pictures; an unknown name is an error of the build."""
    return _MARK.sub(lambda found: f'<div class="picture">{_PICTURES[found[1]]()}</div>', page)


def data_flow() -> str:
    """Draw how files become firmware, and how firmware reaches ROS 2."""
    (steps,) = _STEPS.findall((ROOT / "docs" / "architecture.md").read_text(encoding="utf-8"))
    names = steps.split(" → ")
    parts = []
    for y, text in ((10, "Interface files"), (60, "microros.yaml"), (110, "Profiles, target")):
        parts += [_box(10, y, 150, 36, text), _arrow(160, y + 18, 206, 78)]
    width = 560 / len(names)
    for i, name in enumerate(names):
        parts.append(_box(210 + i * width, 58, width - 22, 40, name, "accent"))
        if i:
            parts.append(_arrow(210 + i * width - 22, 78, 210 + i * width - 3, 78))
    parts.append(_arrow(748, 78, 806, 28) + _arrow(748, 78, 806, 78) + _arrow(748, 78, 806, 128))
    for y, text in ((10, "C99 sources"), (60, "libmicroros.a"), (110, "Firmware image")):
        parts.append(_box(810, y, 180, 36, text))
    parts.append(_arrow(900, 146, 900, 205))
    chain = ((770, 220, "Device: application + client"), (390, 170, "Agent"), (10, 170, "ROS 2 nodes"))
    parts += [_box(x, 210, w, 44, text, "accent" if text == "Agent" else "") for x, w, text in chain]
    for (right, _, _), (left, w, _), text in zip(
        chain, chain[1:], ("DDS-XRCE: UDP, TCP, serial", "DDS"), strict=False
    ):
        parts += [_arrow(right - 4, 224, left + w + 4, 224), _arrow(left + w + 4, 242, right - 4, 242)]
        parts.append(f'<text x="{(right + left + w) / 2}" y="272" text-anchor="middle">{text}</text>')
    return _svg(1010, 285, "Interface files and YAML become firmware; an agent connects it to ROS 2", parts)


def components() -> str:
    """Draw the components of the demo and what each needs, as `resolve --format dot` lists them."""
    dot = _tool("resolve", "-c", "examples/demo/microros.yaml", "--format", "dot")
    edges = sorted({(a, b) for a, b in _EDGE.findall(dot) if not a.startswith("xrce")})
    places = arrange(edges)
    width, height = 158, 66
    columns = max(x for x, _ in places.values()) + 1
    center = {name: (10 + x * width + 74, 8 + y * height + 15) for name, (x, y) in places.items()}
    parts = [_curve(*center[source], *center[successor]) for source, successor in places.edges]
    parts += [_box(x - 70, y - 15, 140, 30, name) for name, (x, y) in sorted(center.items())]
    rows = max(y for _, y in places.values()) + 1
    return _svg(columns * width + 10, rows * height - 18, "Components of the demo application", parts)


def node_graph() -> str:
    """Draw the nodes of an application and its topics and services, from the manifest that `generate` writes."""
    with tempfile.TemporaryDirectory() as folder:
        _tool("generate", "-c", "examples/ping_pong/microros.yaml", "-o", f"{folder}/out")
        entities = json.loads(Path(folder, "out", "manifest.json").read_text(encoding="utf-8"))["entities"]
    ends = [
        (kind, end["node"], end.get("topic") or end["name"], end["type"])
        for kind in ("publishers", "subscriptions", "services", "clients")
        for end in entities.get(kind, ())
    ]
    names = sorted({(name, type_) for _, _, name, type_ in ends})
    height = 70 * max(len(names), len(entities["nodes"]))
    parts = []
    for i, node in enumerate(entities["nodes"]):
        y = height * (2 * i + 1) / (2 * len(entities["nodes"]))
        parts.append(_box(10, y - 22, 240, 44, f"{node['namespace'].rstrip('/')}/{node['name']}", "accent"))
        for kind, number, name, type_ in ends:
            if number == i:
                end = height * (2 * names.index((name, type_)) + 1) / (2 * len(names))
                sends = kind in ("publishers", "clients")
                left, right = (254, y - 8), (516, end - 8)
                ways = (*left, *right) if sends else (right[0], right[1] + 16, left[0], left[1] + 16)
                parts.append(_arrow(*ways))
    for i, (name, type_) in enumerate(names):
        y = height * (2 * i + 1) / (2 * len(names))
        parts.append(_box(520, y - 22, 380, 44, f"{name}  {type_}"))
    return _svg(910, height, "Node graph of the example ping_pong", parts)


def modes() -> str:
    """Draw the mobile robot as `modes graph` does; the colors are those of the page."""
    with tempfile.TemporaryDirectory() as folder:
        _tool("modes", "graph", "examples/mobile_robot/robot.yaml", "-o", f"{folder}/robot.svg")
        drawing = Path(folder, "robot.svg").read_text(encoding="utf-8").replace("\n", "")
    return re.sub(r"<style>.*?</style>", "", drawing)


@cache
def treemap() -> str:
    """Draw the flash of pure_sender on a Cortex-M4 as `size --format html` does, or say which compiler is missing."""
    if shutil.which(COMPILER) is None:
        return f"<p>(Not drawn: {COMPILER} was not installed when this site was built.)</p>"
    with tempfile.TemporaryDirectory() as folder:
        _tool("build", "--profile", "pure_sender", "--target", BOARD, "-o", f"{folder}/out")
        _tool("size", f"{folder}/out", "--format", "html", "-o", f"{folder}/size.html")
        page = Path(folder, "size.html").read_text(encoding="utf-8")
    found = _KEYS.search(page)
    assert found, "size --format html has no drawing of the flash"
    return f'<div class="keys">{found[1][3:-4]}</div>{found[2]}'.replace("\n", "")


_PICTURES = {
    "data_flow": data_flow,
    "components": components,
    "modes": modes,
    "node_graph": node_graph,
    "treemap": treemap,
}


def _tool(*arguments: str) -> str:
    command = [sys.executable, "-m", "microros_gen", *arguments]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{arguments}: {done.stderr}"
    return done.stdout


def _svg(width: float, height: float, title: str, parts: list[str]) -> str:
    head = f'<svg viewBox="0 0 {width:g} {height:g}" role="img" aria-label="{escape(title)}">'
    return head + "".join(parts) + "</svg>"


def _box(x: float, y: float, width: float, height: float, text: str, kind: str = "") -> str:
    box, label = ("accent", "on-accent") if kind else ("box", "label")
    place = f'x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}"'
    middle = f'x="{x + width / 2:g}" y="{y + height / 2 + 5:g}" text-anchor="middle"'
    return f'<rect class="{box}" {place} rx="5"/><text class="{label}" {middle}>{escape(text)}</text>'


def _curve(x1: float, y1: float, x2: float, y2: float) -> str:
    """Return an arrow from the middle of one box down to the top edge of another."""
    line = f"M{x1:g} {y1:g}C{x1:g} {y1 + 40:g} {x2:g} {y2 - 45:g} {x2:g} {y2 - 20:g}"
    return f'<path class="edge" d="{line}"/><path class="tip" d="M{x2:g} {y2 - 15:g}l-4 -8h8z"/>'


def _arrow(x1: float, y1: float, x2: float, y2: float) -> str:
    length = ((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5
    dx, dy = (x2 - x1) / length * 8, (y2 - y1) / length * 8
    corners = ((x2, y2), (x2 - dx - dy / 2, y2 - dy + dx / 2), (x2 - dx + dy / 2, y2 - dy - dx / 2))
    tip = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
    line = f'<path class="edge" d="M{x1:g} {y1:g}L{x2 - dx:.1f} {y2 - dy:.1f}"/>'
    return f'{line}<polygon class="tip" points="{tip}"/>'
