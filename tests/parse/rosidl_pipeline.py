# SPDX-License-Identifier: Apache-2.0
"""ROS 2's own pipeline for one .msg file, as an oracle: rosidl_adapter, rosidl_parser, type description."""

from __future__ import annotations

import contextlib
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class RosConstant:
    """A constant as rosidl_parser has it."""

    name: str
    value: Any


@dataclass(frozen=True)
class RosMessage:
    """What ROS 2 makes of a file; `description` is its individual type description."""

    description: dict[str, Any]
    constants: tuple[RosConstant, ...]


def ros_message(text: str, folder: Path, package: str = "pkg_a", name: str = "Foo") -> RosMessage | None:
    """Return what Jazzy makes of the text of a .msg file, or None when it refuses it."""
    from rosidl_adapter.msg import convert_msg_to_idl
    from rosidl_generator_type_description import serialize_individual_type_description
    from rosidl_parser.definition import IdlLocator, Message
    from rosidl_parser.parser import parse_idl_file

    (folder / "msg").mkdir(exist_ok=True)
    source = folder / "msg" / f"{name}.msg"
    source.write_bytes(text.encode("utf-8"))
    source.with_suffix(".idl").unlink(missing_ok=True)
    quiet = io.StringIO()
    with contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(quiet):
        try:
            convert_msg_to_idl(folder, package, Path("msg") / f"{name}.msg", folder / "msg")
            idl = parse_idl_file(IdlLocator(folder, Path("msg") / f"{name}.idl"))
        except (Exception, SystemExit):
            return None
    (message,) = idl.content.get_elements_of_type(Message)
    structure = message.structure
    return RosMessage(
        serialize_individual_type_description(structure.namespaced_type, structure.members),
        tuple(RosConstant(constant.name, constant.value) for constant in message.constants),
    )


def adapter_message(text: str, package: str = "pkg_a", name: str = "Foo") -> Any:
    """Return rosidl_adapter's specification of the text (comments are in its `annotations`); it may raise."""
    from rosidl_adapter.parser import parse_message_string

    with contextlib.redirect_stderr(io.StringIO()):
        return parse_message_string(package, name, text)
