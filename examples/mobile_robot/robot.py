# SPDX-License-Identifier: Apache-2.0
"""The mobile robot: builds four boards, starts them with two ROS nodes and the mode manager, and takes its lidar away.

    python examples/mobile_robot/robot.py

Two boards are images for a Cortex-M4 in QEMU, each with its own agent on its serial line; two run on this computer.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))  # for what examples share

from processes import (  # noqa: E402
    ROOT,
    TOOL,
    PartFailedError,
    agent,
    check_firmware_tools,
    domain,
    free_port,
    part,
    run_cmake,
)

from microros_gen.ros.peer import Peer  # noqa: E402

MODEL = FOLDER / "robot.yaml"
OUT = ROOT / "build" / "mobile_robot"
TOOLCHAIN = ROOT / "examples" / "cmake_app" / "qemu-mps2-an386.cmake"
WHEELS = ("left_wheel", "right_wheel")
LOCAL_BOARDS = ("lidar", "bumper")
BOARDS = (*LOCAL_BOARDS, *WHEELS)
ROS_NODES = (("localizer", "source", "odometry"), ("planner", "horizon", "1.0"))
TIMEOUT_S = 120.0
CALL_S = 5.0


def main() -> int:
    """Return 0 when the robot has reached its degraded mode."""
    raw = argparse.RawDescriptionHelpFormatter
    argparse.ArgumentParser(description=__doc__, formatter_class=raw).parse_args()
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    try:
        check_firmware_tools()
        check()
        port = free_port()
        build(port)
        with ExitStack() as stack:
            start(stack, port)
            operate(stack)
    except PartFailedError as error:
        print(f"robot: {error}", file=sys.stderr)
        return 1
    return 0


def check() -> None:
    """Prove the modes of the robot, with the parameters that the boards declare."""
    print("1. model: microros-gen modes check robot.yaml --application …")
    applications = [word for board in BOARDS for word in ("--application", str(FOLDER / f"{board}.yaml"))]
    if subprocess.run([*TOOL, "modes", "check", str(MODEL), *applications], check=False).returncode != 0:
        raise PartFailedError("model: a property does not hold (see above)")


def build(port: int) -> None:
    """Build the images of the boards."""
    print("2. boards: lidar and bumper for this computer, two wheels for a Cortex-M4")
    start_s = time.monotonic()
    run_cmake(FOLDER, OUT / "local", f"-DAGENT=127.0.0.1:{port}")
    run_cmake(FOLDER, OUT / "wheels", f"-DCMAKE_TOOLCHAIN_FILE={TOOLCHAIN}")
    print(f"   {time.monotonic() - start_s:.0f} s")


def start(stack: ExitStack, port: int) -> None:
    """Start agents, boards, ROS nodes and the mode manager."""
    print(f"3. robot: agents, boards, ROS nodes and the mode manager; logs in {OUT.relative_to(ROOT)}")

    def begin(name: str, command: list[str], ready: str | None) -> None:
        stack.enter_context(part(name, command, ready, OUT / f"{name}.log"))

    stack.enter_context(agent(port, OUT / "agent.log"))
    for board in LOCAL_BOARDS:
        begin(board, [str(OUT / "local" / board)], None)
    for wheel in WHEELS:
        image = OUT / "wheels" / f"{wheel}.elf"
        run = [*TOOL, "run", str(OUT / "wheels"), "--image", str(image), "--domain", domain()]
        begin(wheel, run, "agent ready")
    for name, parameter, value in ROS_NODES:
        begin(name, [sys.executable, str(FOLDER / "ros_node.py"), name, parameter, value], f"{name} ready")
    manage = [*TOOL, "modes", "manage", str(MODEL), "--domain", domain()]
    begin("manager", manage, "mode manager ready")


def operate(stack: ExitStack) -> None:
    """Request a mode, take the lidar away, and wait for the degraded mode."""
    operator = stack.enter_context(Peer("operator", domain=int(domain())))
    print("4. request: mode CRUISE of the robot")
    request_mode(operator, "CRUISE")
    show()
    print("5. fault: the lidar loses its sensor")
    call(
        operator,
        "/lidar/unplug",
        "std_srvs/srv/SetBool",
        {"data": True},
        lambda response: response["success"],
    )
    wait_for_mode(operator, "CAREFUL")
    show()
    print("6. robot: continues in mode CAREFUL")


def request_mode(operator: Peer, mode: str) -> None:
    """Request a mode of the robot until it is in it."""
    change = {"mode_name": mode}
    call(
        operator,
        "/robot/change_mode",
        "system_modes_msgs/srv/ChangeMode",
        change,
        lambda response: response["success"],
    )
    wait_for_mode(operator, mode)


def wait_for_mode(operator: Peer, mode: str) -> None:
    """Wait until the robot is in a mode."""
    call(
        operator,
        "/robot/get_mode",
        "system_modes_msgs/srv/GetMode",
        {},
        lambda response: response["current_mode"] == mode,
    )


def call(
    operator: Peer,
    service: str,
    type_name: str,
    request: Mapping[str, Any],
    accept: Callable[[Mapping[str, Any]], bool],
) -> None:
    """Repeat a request until `accept` is true for a response: parts are discovered one after another."""
    client = operator.client(service, type_name)
    end, response = time.monotonic() + TIMEOUT_S, None
    while time.monotonic() < end:
        response = client.call(request, CALL_S)
        if response is not None and accept(response):
            return
        time.sleep(0.1)
    raise PartFailedError(f"{service}: {response or 'no response'} after {TIMEOUT_S:.0f} s")


def show() -> None:
    """Print target and actual state of all parts."""
    command = [*TOOL, "modes", "monitor", str(MODEL), "--once", "--wait", "30", "--domain", domain()]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    print("".join(f"   {line}\n" for line in done.stdout.splitlines()), end="")


if __name__ == "__main__":
    sys.exit(main())
