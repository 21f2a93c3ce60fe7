# SPDX-License-Identifier: Apache-2.0
"""What can go wrong between this process and ROS 2."""

from __future__ import annotations


class RosError(Exception):
    """ROS 2, or its replacement here, refused something; the text says what."""


class RosUnusableError(RosError):
    """No usable ROS 2: `reason` follows the name of the program that needs it."""

    def __init__(self, reason: str, hint: str) -> None:
        super().__init__(f"this program {reason}. {hint}")
        self.reason = reason
        self.hint = hint


class TypeLimitError(RosError):
    """More than `limit` types were used since the process began."""

    def __init__(self, limit: int) -> None:
        super().__init__(f"{limit} types were used since this program started: no further ones")
        self.limit = limit


class CodecError(Exception):
    """A message that is none of its type; `path` is the member: `header.stamp.sec`, `points[3].x`."""

    def __init__(self, reason: str, path: str = "", type_name: str = "") -> None:
        super().__init__(": ".join(part for part in (type_name, path, reason) if part))
        self.reason = reason
        self.path = path

    def within(self, outer: str) -> CodecError:
        """Return the same error of a part of `outer`."""
        dot = "." if self.path and not self.path.startswith("[") else ""
        return CodecError(self.reason, f"{outer}{dot}{self.path}")

    def of_type(self, type_name: object) -> CodecError:
        """Return the same error of a message of that type."""
        return CodecError(self.reason, self.path, str(type_name))
