# SPDX-License-Identifier: Apache-2.0
"""A ROS graph as a picture (SVG): messages flow from left to right wherever the graph has no cycle.

The picture needs no font or program, follows the reader's light or dark theme, and is the same for the same graph.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from microros_gen.ros_tools.graph_data import GraphView, Vertex

_CHAR, _HEIGHT, _PAD, _GAP_X, _GAP_Y, _MARGIN = 7.3, 26, 12, 70, 14, 14
_LONGEST = 48
"""Characters of a name."""
_SWEEPS = 4
"""Passes in which each column is ordered by its neighbors, forward and back."""
_STYLE = """\
.graph text { font: 12px monospace; fill: #1c2733; }
.graph rect { fill: #f6f8fb; stroke: #5b6b80; }
.graph .node { fill: #e7edf9; }
.graph .service { stroke-dasharray: 5 3; }
.graph .action { stroke-dasharray: 2 2; }
.graph path { fill: none; stroke: #5b6b80; }
.graph marker path { fill: #5b6b80; }
@media (prefers-color-scheme: dark) {
.graph text { fill: #e2e8f0; }
.graph rect { fill: #1d2630; stroke: #8fa0b5; }
.graph .node { fill: #24324a; }
.graph path { stroke: #8fa0b5; }
.graph marker path { fill: #8fa0b5; }
}"""
_ARROW = (
    '<marker id="arrow" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
    '<path d="M 0 0 L 8 4 L 0 8 z"/></marker>'
)
Place = tuple[float, float, float]
"""Left edge, middle, width."""


def draw(graph: GraphView, title: str = "ROS graph") -> str:
    """Return the picture: rounded boxes are nodes, others topics, services (dashed) and actions (dotted)."""
    columns = _ordered(_columns(graph), graph)
    places = _places(columns)
    width = max((x + w for x, _, w in places.values()), default=0.0) + _MARGIN
    height = max((y for _, y, _ in places.values()), default=0.0) + _HEIGHT / 2 + _MARGIN
    size = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" class="graph" role="img" {size}>'
    lines = [
        head,
        f"<title>{escape(title)}</title>",
        f"<style>\n{_STYLE}\n</style>",
        f"<defs>{_ARROW}</defs>",
    ]
    lines += [_edge(places[start], places[end]) for start, end in graph.edges]
    lines += [_box(vertex, places[vertex]) for vertex in graph.vertices]
    return "\n".join([*lines, "</svg>"]) + "\n"


def _columns(graph: GraphView) -> list[list[Vertex]]:
    """Return the vertices by column: each right of what leads to it, except for arrows that close a cycle."""
    following: dict[Vertex, list[Vertex]] = {vertex: [] for vertex in graph.vertices}
    for start, end in graph.edges:
        following[start].append(end)
    order = _topological(graph.vertices, following)
    position = {vertex: i for i, vertex in enumerate(order)}
    column = dict.fromkeys(order, 0)
    for vertex in order:
        for after in following[vertex]:
            if position[after] > position[vertex]:
                column[after] = max(column[after], column[vertex] + 1)
    columns: list[list[Vertex]] = [[] for _ in range(max(column.values(), default=-1) + 1)]
    for vertex in graph.vertices:
        columns[column[vertex]].append(vertex)
    return columns


def _topological(vertices: Sequence[Vertex], following: Mapping[Vertex, Sequence[Vertex]]) -> list[Vertex]:
    """Return the vertices, each before what follows it, as far as cycles allow: by depth-first search."""
    finished: list[Vertex] = []
    seen: set[Vertex] = set()
    ends = {after for lists in following.values() for after in lists}
    for first in sorted(vertices, key=lambda vertex: (vertex in ends, vertex)):
        stack = [(first, iter(following[first]))] if first not in seen else []
        seen.add(first)
        while stack:
            vertex, rest = stack[-1]
            after = next((vertex for vertex in rest if vertex not in seen), None)
            if after is None:
                finished.append(vertex)
                stack.pop()
            else:
                seen.add(after)
                stack.append((after, iter(following[after])))
    return finished[::-1]


def _ordered(columns: list[list[Vertex]], graph: GraphView) -> list[list[Vertex]]:
    """Return the columns with each vertex near the middle of its neighbors, so that few arrows cross."""
    neighbors: dict[Vertex, list[Vertex]] = {vertex: [] for vertex in graph.vertices}
    for start, end in graph.edges:
        neighbors[start].append(end)
        neighbors[end].append(start)
    row = {vertex: float(i) for column in columns for i, vertex in enumerate(column)}
    for sweep in range(_SWEEPS):
        for column in columns if sweep % 2 == 0 else columns[::-1]:
            middles = {
                vertex: sum(row[other] for other in neighbors[vertex]) / max(1, len(neighbors[vertex]))
                for vertex in column
            }
            column.sort(key=lambda vertex: (middles[vertex], vertex))
            row.update((vertex, float(i)) for i, vertex in enumerate(column))
    return columns


def _places(columns: list[list[Vertex]]) -> dict[Vertex, Place]:
    """Return the place of each vertex; shorter columns are centered."""
    tallest = max(map(len, columns), default=0)
    places: dict[Vertex, Place] = {}
    x = float(_MARGIN)
    for column in columns:
        widths = [len(_label(vertex)) * _CHAR + 2 * _PAD for vertex in column]
        y = _MARGIN + _HEIGHT / 2 + (tallest - len(column)) * (_HEIGHT + _GAP_Y) / 2
        for vertex, width in zip(column, widths, strict=True):
            places[vertex] = (x, y, width)
            y += _HEIGHT + _GAP_Y
        x += max(widths) + _GAP_X
    return places


def _label(vertex: Vertex) -> str:
    name = vertex[1]
    return name if len(name) <= _LONGEST else f"{name[: _LONGEST - 1]}…"


def _box(vertex: Vertex, place: Place) -> str:
    x, y, width = place
    kind = vertex[0]
    radius = _HEIGHT // 2 if kind == "node" else 3
    frame = f'x="{x:.1f}" y="{y - _HEIGHT / 2:.1f}" width="{width:.1f}" height="{_HEIGHT}" rx="{radius}"'
    text = f'<text x="{x + _PAD:.1f}" y="{y + 4:.1f}">{escape(_label(vertex))}</text>'
    return f'<g><title>{kind} {escape(vertex[1])}</title><rect class="{kind}" {frame}/>{text}</g>'


def _edge(start: Place, end: Place) -> str:
    """Return an arrow; one that goes back leaves and arrives at the same sides as the others."""
    x1, y1 = start[0] + start[2], start[1]
    x2, y2 = end[0], end[1]
    bend = max(_GAP_X / 2, abs(x2 - x1) / 2)
    curve = f"M {x1:.1f} {y1:.1f} C {x1 + bend:.1f} {y1:.1f} {x2 - bend:.1f} {y2:.1f} {x2:.1f} {y2:.1f}"
    return f'<path d="{curve}" marker-end="url(#arrow)"/>'
