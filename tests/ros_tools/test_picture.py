# SPDX-License-Identifier: Apache-2.0
"""The picture of a graph: everything is in it, and messages flow from left to right."""

from __future__ import annotations

import random
from xml.etree import ElementTree

import pytest

from microros_gen.ros_tools.graph_data import GraphView, NodeView, graph_view
from microros_gen.ros_tools.picture import draw

SVG = "{http://www.w3.org/2000/svg}"
INT32 = ("std_msgs/msg/Int32",)
LOG = ("rcl_interfaces/msg/Log",)


def names(*found: str) -> tuple[tuple[str, tuple[str, ...]], ...]:
    return tuple((name, INT32) for name in found)


CHAIN = (
    NodeView("/camera", publishers=(*names("/image"), ("/rosout", LOG))),
    NodeView("/detector", subscriptions=names("/image"), publishers=names("/objects")),
    NodeView(
        "/planner",
        subscriptions=names("/objects"),
        service_clients=names("/map/load", "/go/_action/send_goal"),
    ),
    NodeView("/map", service_servers=names("/map/load")),
    NodeView("/base", service_servers=names("/go/_action/send_goal", "/base/get_parameters")),
)


def boxes(picture: str) -> dict[str, tuple[float, float]]:
    """Return the left edge and width of each box by its title."""
    found = {}
    for group in ElementTree.fromstring(picture).iter(f"{SVG}g"):
        title, frame = group.find(f"{SVG}title"), group.find(f"{SVG}rect")
        assert title is not None
        assert title.text is not None
        assert frame is not None
        found[title.text] = (float(frame.attrib["x"]), float(frame.attrib["width"]))
    return found


def test_every_vertex_is_a_box_right_of_what_leads_to_it() -> None:
    view = graph_view(CHAIN)
    found = boxes(draw(view))
    assert sorted(found) == sorted(f"{kind} {name}" for kind, name in view.vertices)
    assert "action /go" in found
    for (kind, name), (end_kind, end_name) in view.edges:
        x, width = found[f"{kind} {name}"]
        assert x + width < found[f"{end_kind} {end_name}"][0]


def test_what_nearly_every_node_has_is_left_out() -> None:
    assert not [name for _, name in graph_view(CHAIN).vertices if name in ("/rosout", "/base/get_parameters")]
    assert ("topic", "/rosout") in graph_view(CHAIN, usual=True).vertices


def test_a_cycle_is_drawn() -> None:
    loop = (
        NodeView("/a", publishers=names("/x"), subscriptions=names("/y")),
        NodeView("/b", publishers=names("/y"), subscriptions=names("/x")),
    )
    picture = draw(graph_view(loop))
    assert len(boxes(picture)) == 4
    assert picture.count("marker-end") == 4


def test_no_graph_is_a_picture() -> None:
    assert boxes(draw(graph_view(()))) == {}


@pytest.mark.parametrize("seed", range(20))
def test_the_order_of_nodes_changes_nothing(seed: int) -> None:
    shuffled = list(CHAIN)
    random.Random(seed).shuffle(shuffled)
    assert draw(graph_view(shuffled)) == draw(graph_view(CHAIN))


def test_boxes_do_not_overlap() -> None:
    source = random.Random(3)
    vertices = tuple(
        sorted([("node", f"/n{i}") for i in range(12)] + [("topic", f"/t{i}") for i in range(15)])
    )
    edges = tuple(sorted({(source.choice(vertices), source.choice(vertices)) for _ in range(40)}))
    edges = tuple((a, b) for a, b in edges if a[0] != b[0])
    root = ElementTree.fromstring(draw(GraphView(vertices, edges)))
    frames = [
        tuple(float(r.attrib[key]) for key in ("x", "y", "width", "height")) for r in root.iter(f"{SVG}rect")
    ]
    for i, (x, y, w, h) in enumerate(frames):
        for x2, y2, w2, h2 in frames[i + 1 :]:
            assert x + w <= x2 or x2 + w2 <= x or y + h <= y2 or y2 + h2 <= y
