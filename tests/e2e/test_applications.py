# SPDX-License-Identifier: Apache-2.0
"""Applications that a user writes against a built library: undeclared entities, C++, the usual rclc code."""

from __future__ import annotations

import random
import re
import signal
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.agent.observer import Observer
from tests.support.agent.process import running_agent
from tests.support.e2e.images import C_FILES, Image, Images, started
from tests.support.e2e.live import Live
from tests.support.e2e.relay import Relay
from tests.support.e2e.udp_agent import serving
from tests.support.patience import seconds
from tests.support.runtime.fake_agent import FakeAgent
from tests.support.slices import first

STRICT_CPP = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror")


@pytest.fixture
def port() -> Iterator[int]:
    with serving(FakeAgent()) as port:
        yield port


@pytest.fixture
def declared(images: Images, declared_image: Image, port: int) -> Iterator[Live]:
    """A session of the declared application with its node open."""
    with Live(images.live(declared_image)) as live:
        live.ok(f"open 1 {port}")
        live.ok("node 0 imu_node /arm")
        yield live
        live.ok("close")


@pytest.fixture
def pooled(images: Images, pool_image: Image, port: int) -> Iterator[Live]:
    with Live(images.live(pool_image)) as live:
        live.ok(f"open 1 {port}")
        live.ok("node 0 talker -")
        yield live
        live.ok("close")


# What is not declared


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (
            "publisher 0 0 Int32 speed reliable",
            "publisher not declared: add to its node's publishers: in microros.yaml:"
            " {topic: speed, type: std_msgs/msg/Int32}",
        ),
        (
            "publisher 0 0 String count reliable",
            "publisher not declared: add to its node's publishers: in microros.yaml:"
            " {topic: count, type: std_msgs/msg/String}",
        ),
        (
            "node 1 camera /arm",
            "node not declared: add to nodes: in microros.yaml: {name: camera, namespace: '/arm'}",
        ),
        ("node 1 imu_node /arm", "node imu_node is open already"),
    ],
    ids=["topic", "type", "node", "node twice"],
)
def test_an_entity_that_is_not_declared(declared: Live, call: str, text: str) -> None:
    answer = declared.call(call)
    assert (answer.code, answer.text) == (1, text)
    declared.ok("publisher 0 0 Int32 count reliable")


def test_the_line_of_the_hint_fixes_the_error(
    declared: Live, declared_image: Image, images: Images, port: int
) -> None:
    """Put into the application file, it makes the same call succeed."""
    text = declared.call("publisher 0 0 Int32 speed reliable").text
    line = text.partition("microros.yaml: ")[2]
    application = (declared_image.out.parent / "microros.yaml").read_text()
    mended = application.replace("    publishers:\n", f"    publishers:\n      - {line}\n")
    assert mended != application
    image = images.build(1, mended, flags=declared_image.flags)
    with Live(images.live(image)) as live:
        live.ok(f"open 2 {port}")
        live.ok("node 0 imu_node /arm")
        live.ok("publisher 0 0 Int32 speed reliable")
        live.ok("close")


def test_the_same_publisher_twice(declared: Live) -> None:
    declared.ok("publisher 0 0 Int32 count reliable")
    answer = declared.call("publisher 1 0 Int32 /arm/count reliable")
    assert (answer.code, answer.text) == (1, "publisher /arm/count is open already")
    declared.ok("publisher_fini 0 0")
    declared.ok("publisher 1 0 Int32 /arm/count reliable")


def test_a_text_over_its_limit(declared: Live) -> None:
    declared.ok("publisher 0 0 String ~/state reliable")
    declared.ok("say 0 " + "x" * 16)
    answer = declared.call("say 0 " + "x" * 17)
    assert (answer.code, answer.text) == (
        1,
        "limit 16: set limits: {std_msgs/msg/String: {data: 17}} in microros.yaml",
    )


def test_pools_that_are_full(pooled: Live) -> None:
    for i in range(3):
        pooled.ok(f"publisher {i} 0 Int32 topic_{i} reliable")
    answer = pooled.call("publisher 3 0 Int32 topic_3 reliable")
    assert (answer.code, answer.text) == (
        1,
        "all 3 publishers are open: set pools: {publishers: 4} in microros.yaml",
    )
    pooled.ok("node 1 second -")
    answer = pooled.call("node 2 third -")
    assert (answer.code, answer.text) == (1, "all 2 nodes are open: set pools: {nodes: 3} in microros.yaml")
    pooled.ok("publisher_fini 1 0")
    pooled.ok("publisher 1 0 Int32 topic_3 reliable")


def test_names(pooled: Live) -> None:
    pooled.ok("publisher 0 0 Int32 " + "t" * 30 + " reliable")
    topic = "t" * 31
    answer = pooled.call(f"publisher 1 0 Int32 {topic} reliable")
    assert (answer.code, answer.text) == (
        1,
        f"name '{topic}' takes 32 bytes: set pools: {{name_size: 33}} in microros.yaml",
    )
    answer = pooled.call("publisher 1 0 Int32 9lives reliable")
    assert (answer.code, answer.text) == (103, "name '9lives': a part begins with a digit")


# Headers and linking


def headers(image: Image) -> list[str]:
    """Return the public headers of what is selected."""
    root = image.out / "include"
    return [
        path.relative_to(root).as_posix()
        for path in sorted(root.rglob("*.h"))
        if "#error" not in path.read_text()
    ]


@pytest.mark.parametrize("order", first(["shuffled", "sorted", "reversed"]))
def test_cpp_takes_all_headers_in_any_order(declared_image: Image, tmp_path: Path, order: str) -> None:
    names = headers(declared_image)
    assert len(names) > 60
    if order == "reversed":
        names.reverse()
    elif order == "shuffled":
        random.Random(2).shuffle(names)
    source = tmp_path / f"{order}.cpp"
    source.write_text("".join(f"#include <{name}>\n" for name in names) + CPP_APPLICATION)
    declared_image.application(source, tmp_path / "program", *STRICT_CPP, compiler="g++")


CPP_APPLICATION = """
static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;

int main()
{
  sensor_msgs__msg__Imu imu = sensor_msgs__msg__Imu();
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_ret_t result = rclc_support_init(&support, 0, nullptr, &allocator);
  result += rclc_node_init_default(&node, "imu_node", "arm", &support);
  result += rclc_publisher_init_best_effort(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Imu), "imu/data");
  result += rcl_publish(&publisher, &imu, nullptr);
  result += rmw_uros_ping_agent(1, 1);
  return result;
}
"""


def test_a_header_that_is_not_selected_names_its_key(pool_image: Image, tmp_path: Path) -> None:
    wanted = {
        "rclc/executor.h": r"components: \[\+executor\]",
        "rcl/service.h": r"components: \[\+services\]",
        "rcl/timer.h": r"components: \[\+timers\]",
        "rclc_lifecycle/rclc_lifecycle.h": r"components: \[\+lifecycle\]",
    }
    for name, key in wanted.items():
        source = tmp_path / "unselected.c"
        source.write_text(f"#include <rcl/rcl.h>\n#include <{name}>\nint main(void) {{ return 0; }}\n")
        with pytest.raises(AssertionError, match=f"#error .*{key}.*microros.yaml"):
            pool_image.application(source, tmp_path / "program")


def test_another_plan_does_not_link(acknack_image: Image, none_image: Image, tmp_path: Path) -> None:
    source = tmp_path / "mixed.c"
    source.write_text(
        "#include <rclc/rclc.h>\n"
        "int main(void)\n{\n  static rclc_support_t s;\n"
        "  rcl_allocator_t a = rcl_get_default_allocator();\n"
        "  return (int)rclc_support_init(&s, 0, NULL, &a);\n}\n"
    )
    none_image.application(source, tmp_path / "program")
    plan = re.search(r'MICROROS_PLAN_ID "(\w+)"', (none_image.out / "include/microros_config.h").read_text())
    assert plan is not None
    with pytest.raises(AssertionError, match=f"undefined .*.rclc_support_init__plan_{plan[1]}"):
        none_image.application(source, tmp_path / "program", against=acknack_image)


# The usual code


ROOMY = "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\npools: {history: 16}\n"
"""Room for what an agent on a busy machine acknowledges late; a full stream refuses samples."""


@pytest.mark.system
@pytest.mark.ros
def test_the_usual_reconnecting_sender(
    images: Images, relay: Relay, observer: Observer, domain: int, tmp_path: Path
) -> None:
    """Compiles as it is, waits for the agent, publishes, and reconnects to an agent that was killed."""
    program = images.build(relay.port, ROOMY).application(
        C_FILES / "reconnect.c", tmp_path / "usual", "-std=c11", "-Wall", "-Wextra", "-Werror"
    )
    observer.subscribe("/usual_count", "std_msgs/msg/Int32", reliable=False)
    observer.ask(do="samples")
    with started(program) as process:
        time.sleep(0.3)
        assert process.poll() is None
        last = 0
        for _ in range(2):
            with running_agent(domain, "--domain", str(domain)) as agent:
                relay.connect(agent.port)
                values = [value["data"] for _, value in observer.got(20, topic="/usual_count")]
                assert values[0] > last
                assert values == sorted(set(values))  # DDS may lose one on a busy machine: best effort
                last = values[-1]
                agent.process.send_signal(signal.SIGKILL)
                agent.process.wait(timeout=seconds(10))
            time.sleep(0.7)
            observer.ask(do="samples")  # the last of the killed agent
        process.kill()
        out, errors = process.communicate(timeout=seconds(10))
    assert out.split()[:3] == ["connected", "disconnected", "connected"]
    assert errors == ""
