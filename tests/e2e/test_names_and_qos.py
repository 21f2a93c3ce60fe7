# SPDX-License-Identifier: Apache-2.0
"""What a node, its topics and their quality of service are in ROS 2's graph: as the application file says."""

from __future__ import annotations

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import AgentProcess
from tests.support.e2e.images import QUICK, Images, started

pytestmark = pytest.mark.ros

APPLICATION = """\
version: 1
profiles: [pure_sender, pure_reader]
nodes:
  - name: source
    namespace: /bench
    domain_id: DOMAIN
    remap: {__ns: /left, __node: timed, raw: /robot/raw}
    publishers:
      - {topic: raw, type: std_msgs/msg/Int32, qos: {deadline: 250 ms, lifespan: 1500 ms, depth: 3}}
      - {topic: ~/plain, type: std_msgs/msg/Int32, qos: {reliability: best_effort, durability: transient_local}}
    subscriptions:
      - {topic: heard, type: std_msgs/msg/Int32, qos: {deadline: 2 s}}
"""
FOREVER = 2**63 - 1


def endpoint(observer: Observer, topic: str) -> tuple[object, ...]:
    """Return what ROS 2 says of the one endpoint of a topic, as soon as there is one with a named node."""
    (only,) = observer.named_endpoints(topic)
    assert only["liveliness"] == "AUTOMATIC"
    return tuple(only[key] for key in ("node", "reliability", "durability", "deadline_ns", "lifespan_ns"))


def test_the_graph_shows_names_and_policies(
    images: Images, shared_agent: AgentProcess, observer: Observer, domain: int
) -> None:
    """The source has other names, which the generated example passes: /bench/source, raw."""
    image = images.build(shared_agent.port, APPLICATION.replace("DOMAIN", str(domain)), flags=QUICK)
    with started(image.out / "bin" / "pure_sender+pure_reader"):
        node = "/left/timed"
        assert endpoint(observer, "/robot/raw") == (node, "RELIABLE", "VOLATILE", 250_000_000, 1_500_000_000)
        plain = (node, "BEST_EFFORT", "TRANSIENT_LOCAL", FOREVER, FOREVER)
        assert endpoint(observer, f"{node}/plain") == plain
        assert endpoint(observer, "/left/heard") == (node, "RELIABLE", "VOLATILE", 2_000_000_000, FOREVER)
