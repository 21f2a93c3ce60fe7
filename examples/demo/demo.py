# SPDX-License-Identifier: Apache-2.0
"""`make demo`: builds the image, starts the agent, runs the image, and shows what a ROS 2 subscriber gets."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))  # for what examples share

from processes import (  # noqa: E402
    ROOT,
    TOOL,
    PartFailedError,
    agent,
    domain,
    free_port,
    missing_firmware_packages,
    part,
    run_build,
)

OUT = ROOT / "build" / "demo"
LAMP = FOLDER.parent / "parameters"
BOARD = "qemu-mps2-an386"


def main() -> int:
    """Run the parts in turn; print which one failed."""
    sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]
    try:
        port = free_port()
        build(port)
        show(port)
        show_parameters(port)
        show_firmware()
    except PartFailedError as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    return 0


def build(port: int) -> None:
    """Generate and compile the application for the host."""
    start = time.monotonic()
    config = FOLDER / "microros.yaml"
    print(f"1. build: microros-gen build -c {config.relative_to(ROOT)}")
    run_build("build", config, OUT, "--agent", f"127.0.0.1:{port}")
    print(f"   {time.monotonic() - start:.1f} s")


def show(port: int) -> None:
    """Run agent, listener and image together until the listener has enough."""
    with ExitStack() as stack:
        print(f"2. agent: microros-gen agent udp4 --port {port}")
        stack.enter_context(agent(port))
        print("3. listener: an rclpy node in a separate process")
        listener_command = [sys.executable, str(FOLDER / "subscriber.py")]
        listener = stack.enter_context(part("listener", listener_command, "listener ready"))
        print(f"4. image: {(OUT / 'bin/pure_sender').relative_to(ROOT)}")
        image = stack.enter_context(part("image", [str(OUT / "bin/pure_sender")], None))
        assert listener.stdout is not None
        for line in listener.stdout:
            print(f"   {line}", end="")
        if listener.wait() != 0:
            state = (
                f"ended with status {image.returncode}" if image.poll() is not None else "was still running"
            )
            raise PartFailedError(f"listener: it did not get its samples; the image {state}")


def show_parameters(port: int) -> None:
    """Set a parameter of an image from ROS: what it sends changes."""
    out = OUT.with_name("demo_parameters")
    program = out / "lamp"
    print(f"5. parameters: {LAMP.relative_to(ROOT)}, whose gain an rclpy node sets")
    run_build("parameters", LAMP / "microros.yaml", out, "--agent", f"127.0.0.1:{port}")
    compiler = os.environ.get("CC") or "cc"
    command = [compiler, "-std=c99", f"-I{out / 'include'}", str(LAMP / "main.c")]
    command += [str(out / "lib" / "libmicroros.a"), "-o", str(program)]
    if subprocess.run(command, check=False).returncode != 0:
        raise PartFailedError("parameters: the program could not be compiled (see above)")
    with ExitStack() as stack:
        stack.enter_context(agent(port))
        node = [sys.executable, str(FOLDER / "set_gain.py")]
        operator = stack.enter_context(part("operator", node, "operator ready"))
        stack.enter_context(part("lamp", [str(program)], None))
        assert operator.stdout is not None
        for line in operator.stdout:
            print(f"   {line}", end="")
        if operator.wait() != 0:
            raise PartFailedError("parameters: the new gain was not seen")


def show_firmware() -> None:
    """Build a board's image, run it in QEMU, and let rclpy hear it; say what to install where something lacks."""
    print(f"6. firmware: the first node for {BOARD}")
    if missing := missing_firmware_packages():
        print(f"   left out; to see it: apt-get install {' '.join(missing)}")
        return
    out = OUT.with_name("demo_firmware")
    run_build("firmware", FOLDER / "firmware.yaml", out)
    listen = [sys.executable, str(FOLDER / "subscriber.py"), "--samples", "5"]
    with ExitStack() as stack:
        listener = stack.enter_context(part("listener", listen, "listener ready"))
        run = [*TOOL, "run", str(out), "--domain", domain()]
        stack.enter_context(part("firmware", run, "agent ready"))
        assert listener.stdout is not None
        for line in listener.stdout:
            if not line.startswith("latency"):  # a board without a clock stamps from 0 on
                print(f"   {line}", end="")
        if listener.wait() != 0:
            raise PartFailedError("firmware: the listener did not get its samples")


if __name__ == "__main__":
    sys.exit(main())
