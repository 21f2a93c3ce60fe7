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


@dataclass(frozen=True)
class RosDeclaration:
    """What ROS 2 makes of an .srv or .action file: descriptions by type name, constants of each part."""

    descriptions: dict[str, Any]
    constants: list[list[tuple[str, Any]]]


def ros_declaration(
    text: str, kind: str, folder: Path, package: str = "pkg_a", name: str = "Foo"
) -> RosDeclaration | None:
    """Return what Jazzy makes of the text of an .srv or .action file, or None when it refuses it."""
    from rosidl_adapter.action import convert_action_to_idl
    from rosidl_adapter.srv import convert_srv_to_idl
    from rosidl_parser.definition import Action, IdlLocator, Service
    from rosidl_parser.parser import parse_idl_file

    (folder / kind).mkdir(exist_ok=True)
    source = folder / kind / f"{name}.{kind}"
    source.write_bytes(text.encode("utf-8"))
    source.with_suffix(".idl").unlink(missing_ok=True)
    convert = convert_srv_to_idl if kind == "srv" else convert_action_to_idl
    quiet = io.StringIO()
    with contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(quiet):
        try:
            convert(folder, package, Path(kind) / f"{name}.{kind}", folder / kind)
            idl = parse_idl_file(IdlLocator(folder, Path(kind) / f"{name}.idl"))
            (declared,) = idl.content.get_elements_of_type(Service if kind == "srv" else Action)
        except (Exception, SystemExit):
            return None
    described = _describe_service(declared) if kind == "srv" else _describe_action(declared)
    parts = ("request", "response") if kind == "srv" else ("goal", "result", "feedback")
    messages = [getattr(declared, f"{part}_message" if kind == "srv" else part) for part in parts]
    constants = [[(constant.name, constant.value) for constant in message.constants] for message in messages]
    return RosDeclaration({entry["type_name"]: entry for entry in described}, constants)


def _describe_service(service: Any) -> list[dict[str, Any]]:
    from rosidl_generator_type_description import serialize_individual_type_description as describe

    messages = (service.request_message, service.response_message, service.event_message)
    found = [describe(m.structure.namespaced_type, m.structure.members) for m in messages]
    members = [
        _member(f"{part}_message", m)
        for part, m in zip(("request", "response", "event"), messages, strict=True)
    ]
    return [*found, describe(service.namespaced_type, members)]


def _describe_action(action: Any) -> list[dict[str, Any]]:
    from rosidl_generator_type_description import serialize_individual_type_description as describe

    messages = (action.goal, action.result, action.feedback, action.feedback_message)
    found = [describe(m.structure.namespaced_type, m.structure.members) for m in messages]
    found += [*_describe_service(action.send_goal_service), *_describe_service(action.get_result_service)]
    names = ("goal", "result", "feedback", "send_goal_service", "get_result_service", "feedback_message")
    members = [_member(name, getattr(action, name)) for name in names]
    return [*found, describe(action.namespaced_type, members)]


def _member(name: str, declared: Any) -> Any:
    from rosidl_parser.definition import Member

    structure = getattr(declared, "structure", declared)
    return Member(structure.namespaced_type, name)


def adapter_parts(text: str, kind: str) -> list[tuple[tuple[str, ...], list[tuple[str, ...]]]]:
    """Return rosidl_adapter's comments of each part: its own, and those of its fields."""
    from rosidl_adapter.parser import parse_action_string, parse_service_string

    parse, names = (
        (parse_service_string, ("request", "response"))
        if kind == "srv"
        else (parse_action_string, ("goal", "result", "feedback"))
    )
    parsed = parse("pkg_a", "Foo", text)
    parts = [getattr(parsed, name) for name in names]
    return [
        (
            tuple(part.annotations.get("comment", ())),
            [tuple(field.annotations.get("comment", ())) for field in part.fields],
        )
        for part in parts
    ]
