# SPDX-License-Identifier: Apache-2.0
"""PlatformIO without a network: its core package SCons from PyPI, and a platform that compiles for this computer."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import SCons
from platformio.dependencies import get_core_dependencies

from tests.support.patience import seconds

HERE = Path(__file__).parent
START = "import sys; from SCons.Script.Main import main; sys.exit(main())\n"


class Pio:
    """A project, and a home of PlatformIO next to it."""

    def __init__(self, folder: Path) -> None:
        self.project = folder / "project"
        self.home = folder / "home"
        self.platform = folder / "thiscomputer"
        self.project.mkdir(parents=True)
        _core_package(self.home / "packages" / "tool-scons")
        shutil.copytree(HERE / "pio_platform", self.platform)

    @property
    def program(self) -> Path:
        """The program that a build makes."""
        return self.project / ".pio" / "build" / "pc" / "program"

    def settings(self, *lines: str, arduino: bool = False) -> None:
        """Write platformio.ini for this computer, with further lines."""
        framework = ("framework = arduino",) if arduino else ()
        first = ("[env:pc]", f"platform = symlink://{self.platform}", "board = pc")
        (self.project / "platformio.ini").write_text("\n".join((*first, *framework, *lines)) + "\n")

    def run(self) -> subprocess.CompletedProcess[str]:
        """Call `pio run`, without a network."""
        environment = {
            **os.environ,
            "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
            "PLATFORMIO_CORE_DIR": str(self.home),
            "PLATFORMIO_SETTING_ENABLE_TELEMETRY": "no",
            "PLATFORMIO_SETTING_CHECK_PLATFORMIO_INTERVAL": "9999",
            "MICROROS_ARDUINO_HOST": str(HERE / "arduino_host"),
            "HTTPS_PROXY": "http://127.0.0.1:9",
            "HTTP_PROXY": "http://127.0.0.1:9",
        }
        call = [sys.executable, "-m", "platformio", "run", "-d", str(self.project), "-j", "2"]
        return subprocess.run(
            call, env=environment, capture_output=True, text=True, timeout=seconds(240), check=False
        )

    def build(self) -> list[str]:
        """Call `pio run`, which must succeed; return the lines of its output."""
        done = self.run()
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.splitlines()


@contextmanager
def running(program: Path, **variables: str) -> Iterator[subprocess.Popen[str]]:
    """Run a program with environment variables until the block ends."""
    process = subprocess.Popen(
        [str(program)], env={**os.environ, **variables}, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    threading.Thread(target=process.stdout.read, daemon=True).start()
    try:
        yield process
        assert process.poll() is None, "the program has ended"
    finally:
        process.kill()
        process.wait()


def _core_package(folder: Path) -> None:
    """Unpack SCons as PlatformIO's core package, with the version that it asks for."""
    version = get_core_dependencies()["tool-scons"].lstrip("~^")
    shutil.copytree(Path(SCons.__file__).parent, folder / "SCons")
    (folder / "scons.py").write_text(START)
    package = {"name": "tool-scons", "version": version}
    (folder / "package.json").write_text(json.dumps({**package, "description": "SCons", "system": "*"}))
    spec = {"owner": "platformio", "id": None, "name": "tool-scons", "requirements": None, "uri": None}
    (folder / ".piopm").write_text(json.dumps({"type": "tool", **package, "spec": spec}))
