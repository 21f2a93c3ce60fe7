# SPDX-License-Identifier: Apache-2.0
"""Errors between this process and ROS 2."""

from __future__ import annotations


class RosError(Exception):
    """ROS 2 refused an operation; the text is the reason that rcl or rmw gives."""


class RosUnusableError(RosError):
    """No usable ROS 2 installation. `reason` completes a sentence that starts with the program's name."""

    def __init__(self, reason: str, hint: str) -> None:
        super().__init__(f"this program {reason}. {hint}")
        self.reason = reason
        self.hint = hint


class TypeLimitError(RosError):
    """More than `limit` types were used since the process started; each needs memory until it ends."""

    def __init__(self, limit: int) -> None:
        super().__init__(f"{limit} types were used since this program started: no further ones")
        self.limit = limit


class CodecError(Exception):
    """A value or encoding that is invalid for its type. `path` names the member: `header.stamp.sec`, `points[3].x`."""

    def __init__(self, reason: str, path: str = "", type_name: str = "") -> None:
        super().__init__(": ".join(part for part in (type_name, path, reason) if part))
        self.reason = reason
        self.path = path

    def within(self, outer: str) -> CodecError:
        """Return the same error with `outer` prepended to its path."""
        dot = "." if self.path and not self.path.startswith("[") else ""
        return CodecError(self.reason, f"{outer}{dot}{self.path}")

    def of_type(self, type_name: object) -> CodecError:
        """Return the same error with the name of the message's type."""
        return CodecError(self.reason, self.path, str(type_name))
