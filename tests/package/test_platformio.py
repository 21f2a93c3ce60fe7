# SPDX-License-Identifier: Apache-2.0
"""The package `platformio`: `pio run` of PlatformIO builds it without a network, and its programs reach ROS 2.

The platform is this computer; with `framework = arduino`, functions of Arduino for it (tests/support/package).
"""

from __future__ import annotations

import shutil
import time
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.package.render import describe, plan_package, render_package
from tests.support.agent.observer import Observer, observing
from tests.support.agent.process import own_domain, running_agent
from tests.support.package.pio import Pio, running
from tests.support.paths import ROOT
from tests.support.patience import deadline
from tests.support.slices import first

pytestmark = [pytest.mark.system, pytest.mark.builds]

EXAMPLE = ROOT / "examples" / "platformio"
NATIVE = """\
#include <micro_ros_platformio.h>
#include <rclc/executor.h>
#include <rclc/rclc.h>
#include <sensor_msgs/msg/range.h>
#include <stdlib.h>

#if MICRO_ROS_TRANSPORT_NATIVE_UDP != 1 || MICRO_ROS_DISTRO_JAZZY != 1
#error "no definitions"
#endif

int main(void)
{
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rclc_support_t support;
  rcl_node_t node;
  rcl_publisher_t publisher;
  sensor_msgs__msg__Range message = {.range = 1.5f};

  set_microros_udp_transports("127.0.0.1", (uint16_t)atoi(getenv("AGENT_PORT")));
  if (
    rclc_support_init(&support, 0, NULL, &allocator) != RCL_RET_OK ||
    rclc_node_init_default(&node, "pc", "", &support) != RCL_RET_OK ||
    rclc_publisher_init_default(
      &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Range), "distance") != RCL_RET_OK) {
    return 1;
  }
  while (rcl_publish(&publisher, &message, NULL) == RCL_RET_OK) {
    rclc_sleep_ms(50);
  }
  return 1;
}
"""


WIFI = """\
#include <Arduino.h>
#include <micro_ros_platformio.h>
#include <rclc/rclc.h>
#include <sensor_msgs/msg/range.h>

static char ssid[] = "network";
static char password[] = "password";
static rclc_support_t support;
static rcl_node_t node;
static rcl_publisher_t publisher;
static sensor_msgs__msg__Range message;

void setup()
{
  rcl_allocator_t allocator = rcl_get_default_allocator();

  set_microros_wifi_transports(ssid, password, IPAddress(127, 0, 0, 1), 8888);
  (void)rclc_support_init(&support, 0, NULL, &allocator);
  (void)rclc_node_init_default(&node, "board", "", &support);
  (void)rclc_publisher_init_default(
    &publisher, &node, ROSIDL_GET_MSG_TYPE_SUPPORT(sensor_msgs, msg, Range), "distance");
}

void loop()
{
  message.range = 1.5f;
  (void)rcl_publish(&publisher, &message, NULL);
  delay(50);
}
"""
SET_UP = {
    "ethernet": "IPAddress a; set_microros_ethernet_transports(a, a, a, IPAddress(10, 0, 0, 1), 8888);",
    "native_ethernet": "static byte mac[6]; IPAddress a; set_microros_native_ethernet_transports(mac, a, a, 8888);",
    "wifi_nina": 'static char n[] = "n"; set_microros_wifi_transports(n, n, IPAddress(10, 0, 0, 1), 8888);',
}


@pytest.fixture
def pio(tmp_path: Path) -> Pio:
    """A project with the library of the general plan in `lib`."""
    new = Pio(tmp_path)
    library = new.project / "lib" / "micro_ros_platformio"
    compiler.write(render_package(plan_package(describe("platformio"), None)), library)
    (new.project / "src").mkdir()
    return new


def wait_for(observer: Observer, topic: str, wanted: str) -> None:
    """Wait for a sample whose text (values by name, or hexadecimal) contains `wanted`."""
    end = deadline(30)
    while not any(name == topic and wanted in str(value) for name, value in observer.ask(do="samples")):
        assert time.monotonic() < end, f"no {wanted} at {topic}"
        time.sleep(0.05)


def compiled(lines: list[str]) -> set[str]:
    """Return the names of the objects that a build made."""
    return {Path(line.split()[1]).name for line in lines if line.startswith("Compiling ")}


def copy_example(pio: Pio) -> Path:
    """Copy the sketch of the page with its messages and its application file; return the message."""
    for name in ("src", "extra_packages"):
        shutil.copytree(EXAMPLE / name, pio.project / name, dirs_exist_ok=True)
    shutil.copy(EXAMPLE / "microros.yaml", pio.project)
    return pio.project / "extra_packages" / "robot_msgs" / "msg" / "WheelSpeeds.msg"


@pytest.mark.ros
def test_a_sketch_with_its_own_plan_and_messages(pio: Pio, tmp_path: Path) -> None:
    copy_example(pio)
    pio.settings("board_microros_transport = serial", arduino=True)
    pio.build()
    domain, link = own_domain(), tmp_path / "line"
    paths = ("--interface-path", str(pio.project / "extra_packages"))
    with (
        running_agent(domain, "--domain", str(domain), *paths, transport=("pty", "--link", str(link))),
        observing(domain) as observer,
        running(pio.program, ARDUINO_LINE=str(link)),
    ):
        observer.ask(do="subscribe_raw", topic="/wheel_speeds", type="robot_msgs/msg/WheelSpeeds", hash=None)
        observer.ask(do="publish", topic="/target", type="std_msgs/msg/Float32", values=[])
        wait_for(observer, "/wheel_speeds", "00" * 8)
        observer.ask(do="publish", topic="/target", type="std_msgs/msg/Float32", values=[{"data": 0.5}])
        wait_for(observer, "/wheel_speeds", "0000003f" * 2)


def test_a_changed_message_is_generated_again(pio: Pio) -> None:
    message = copy_example(pio)
    pio.settings(arduino=True)
    assert [line for line in pio.build() if line.startswith("files ")], "pio run prints the summary"
    assert compiled(again := pio.build()) == set()
    assert not [line for line in again if line.startswith("files ")]
    message.write_text(message.read_text() + "float32 FASTEST=1.5\n")
    types = {f"wheel_speeds__{name}.c.o" for name in ("functions", "type_support")}
    assert compiled(pio.build()) == {"main.cpp.o", "message_pools.c.o", *types}
    source = pio.project / "src" / "main.cpp"
    source.write_text(source.read_text().replace("target.data;", "robot_msgs__msg__WheelSpeeds__FASTEST;"))
    assert compiled(pio.build()) == {"main.cpp.o"}


@pytest.mark.ros
@pytest.mark.parametrize("program", first(["native", "wifi"]))
def test_the_general_plan_reaches_ros_by_udp(pio: Pio, program: str) -> None:
    sketch = program == "wifi"
    (pio.project / "src" / ("main.cpp" if sketch else "main.c")).write_text(WIFI if sketch else NATIVE)
    pio.settings(f"board_microros_transport = {'wifi' if sketch else 'udp'}", arduino=sketch)
    pio.build()
    domain = own_domain()
    with (
        running_agent(domain, "--domain", str(domain)) as agent,
        observing(domain) as observer,
        running(pio.program, AGENT_PORT=str(agent.port), ARDUINO_AGENT_PORT=str(agent.port)),
    ):
        observer.subscribe("/distance", "sensor_msgs/msg/Range")
        wait_for(observer, "/distance", "'range': 1.5")


@pytest.mark.parametrize("transport", first(["ethernet", "native_ethernet", "wifi_nina", "custom"]))
def test_each_transport_compiles(pio: Pio, transport: str) -> None:
    call = SET_UP.get(transport, "")
    (pio.project / "src" / "main.cpp").write_text(
        f"#include <Arduino.h>\n#include <micro_ros_platformio.h>\nvoid setup() {{ {call} }}\nvoid loop() {{}}\n"
        '#if MICRO_ROS_DISTRO_KILTED != 1\n#error "no definition"\n#endif\n'
    )
    pio.settings(f"board_microros_transport = {transport}", "board_microros_distro = kilted", arduino=True)
    pio.build()


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("board_microros_distro = humble", "Write board_microros_distro = jazzy, or remove the line."),
        ("board_microros_user_meta = my.meta", "microros-gen init settings --from-colcon-meta my.meta"),
        ("board_microros_transport = can", "native has custom, serial, udp."),
        ("board_microros_config = other.yaml", "board_microros_config = other.yaml: unknown file"),
    ],
)
def test_settings_without_effect_are_refused(pio: Pio, line: str, expected: str) -> None:
    (pio.project / "src" / "main.c").write_text("#include <micro_ros_platformio.h>\nint main(void) {}\n")
    pio.settings(line)
    done = pio.run()
    assert done.returncode != 0
    assert expected in done.stderr


def test_mistakes_in_the_application_file_stop_the_build(pio: Pio) -> None:
    (pio.project / "src" / "main.c").write_text("#include <micro_ros_platformio.h>\nint main(void) {}\n")
    (pio.project / "microros.yaml").write_text("version: 1\nprofiles: [pure_sander]\n")
    pio.settings("board_microros_transport = udp")
    done = pio.run()
    assert done.returncode != 0
    assert "microros.yaml:2:" in done.stderr
    assert "pure_sender" in done.stderr
