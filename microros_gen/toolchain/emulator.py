# SPDX-License-Identifier: Apache-2.0
"""Starts an image in QEMU, paused, with its serial line on a pseudo-terminal, and speaks QEMU's machine protocol.

QEMU owns the pseudo-terminal: whoever reads it may come and go (QEMU Machine Protocol Specification; monitor commands
`qmp_capabilities`, `query-chardev`, `cont`).
"""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.records import dataclass

_LINE = "line"


@dataclass(frozen=True)
class Machine:
    """The emulator of a target: `package` is Debian's, `arguments` name the machine."""

    program: str
    package: str
    arguments: tuple[str, ...]

    @classmethod
    def of(cls, data: Mapping[str, Any]) -> Machine:
        """Create it from the value in a manifest."""
        return cls(data["program"], data["package"], tuple(data["arguments"]))

    def find(self) -> str:
        """Return the path of the program. Raises UserError that names the package to install."""
        found = shutil.which(self.program)
        if found is None:
            message = f"the image runs in {self.program}, which is not on the PATH"
            hint = f"Install it (Debian, Ubuntu: apt-get install {self.package})"
            raise UserError([Diagnostic(message, hint=hint, id="MG-8204")])
        return found

    def command(self, image: Path, restarts: bool) -> list[str]:
        """Return the command that starts `image`, paused; `restarts`: a board that resets itself starts again."""
        line = ["-chardev", f"pty,id={_LINE}", "-serial", f"chardev:{_LINE}"]
        monitor = ["-chardev", "stdio,id=monitor,signal=off", "-mon", "chardev=monitor,mode=control"]
        once = [] if restarts else ["-no-reboot"]
        fixed = ["-display", "none", "-S"]
        return [self.find(), *self.arguments, *fixed, *line, *monitor, *once, "-kernel", str(image)]


class Emulator:
    """A running emulator with pipes for its standard input and output."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        """Negotiate the protocol. Raises UserError with the emulator's output if it ends at once."""
        self._process = process
        self.call("qmp_capabilities")

    def device(self) -> str:
        """Return the path of the pseudo-terminal that is the board's serial line."""
        for chardev in self.call("query-chardev"):
            if chardev["label"] == _LINE:
                return str(chardev["filename"]).removeprefix("pty:")
        raise AssertionError("the emulator does not know its own line")

    def go_on(self) -> None:
        """Let the processor run."""
        self.call("cont")

    def drain(self) -> None:
        """Read events until the emulator ends."""
        assert self._process.stdout is not None
        for _ in self._process.stdout:
            pass

    def call(self, name: str, **arguments: Any) -> Any:
        """Send a command of the machine protocol; return its result. Raises UserError if it is refused."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            self._process.stdin.write(json.dumps({"execute": name, "arguments": arguments}) + "\n")
            self._process.stdin.flush()
        except OSError:
            pass  # it has ended; what it said is read below
        for line in self._process.stdout:
            answer = _message(line)
            if "error" in answer:
                raise UserError(
                    [Diagnostic(f"the emulator refused '{name}': {answer['error']}", id="MG-8205")], status=1
                )
            if "return" in answer:
                return answer["return"]
        status = self._process.wait()
        raise UserError(
            [Diagnostic(f"the emulator ended with status {status} (see above)", id="MG-8206")], status=1
        )


def _message(line: str) -> dict[str, Any]:
    """Return one message of the protocol; empty if the line is none ("char device redirected to …")."""
    try:
        answer = json.loads(line)
    except ValueError:
        return {}
    return answer if isinstance(answer, dict) else {}
