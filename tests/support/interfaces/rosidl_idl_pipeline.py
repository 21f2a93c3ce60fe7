# SPDX-License-Identifier: Apache-2.0
"""ROS 2's own pipeline for one .idl file, as an oracle: rosidl_parser, type description, generators, gcc."""

from __future__ import annotations

import ast
import contextlib
import io
import json
import multiprocessing
import os
import subprocess
import sys
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class RosMessage:
    """What ROS 2 makes of one struct: type description, constants, comments of it, of constants, of members."""

    description: dict[str, Any]
    constants: tuple[tuple[str, Any], ...]
    comments: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class RosIdl:
    """What ROS 2 makes of a file: its own messages and those derived from them, and the includes."""

    messages: tuple[RosMessage, ...]
    includes: tuple[str, ...]


def ros_idl(text: str, folder: Path, kind: str = "msg", name: str = "Foo") -> RosIdl | None:
    """Return what Jazzy makes of the text of an .idl file, or None when it refuses it."""
    from rosidl_parser.definition import IdlLocator, Include
    from rosidl_parser.parser import parse_idl_file

    path = Path(kind) / f"{name}.idl"
    (folder / kind).mkdir(exist_ok=True)
    (folder / path).write_bytes(text.encode("utf-8"))
    quiet = io.StringIO()
    with contextlib.redirect_stdout(quiet), contextlib.redirect_stderr(quiet), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            content = parse_idl_file(IdlLocator(folder, path)).content
            messages = tuple(_message(message) for message in _messages(content))
        except Exception:
            return None
    implicit = {"builtin_interfaces/msg/Time.idl", "unique_identifier_msgs/msg/UUID.idl"}
    includes = [include.locator for include in content.get_elements_of_type(Include)]
    if kind == "action":
        includes = [include for include in includes if include not in implicit]
    return RosIdl(messages, tuple(includes))


C_GENERATORS = ("rosidl_generator_c", "rosidl_typesupport_fastrtps_c")


def ros_c_compiles(folder: Path, output: Path) -> bool:
    """Return whether the C that rosidl_generator_c makes of the `msg/Foo.idl` in `folder` compiles with gcc, and
    whether there is type support for it."""
    if not all(_generated(folder, output, generator) for generator in C_GENERATORS):
        return False
    headers = output.parent / "headers"
    headers.mkdir(exist_ok=True)
    with contextlib.suppress(FileExistsError):
        (headers / "pkg_a").symlink_to(output)
    (output / "msg").mkdir(exist_ok=True)
    (output / "msg" / "rosidl_generator_c__visibility_control.h").write_text(
        "#define ROSIDL_GENERATOR_C_PUBLIC_pkg_a\n"
    )
    include = [f"-I{headers}", *(f"-I{p}" for p in sorted((Path(sys.prefix) / "include").glob("*")))]
    sources = [output / "msg" / "detail" / "foo__functions.c"]
    command = ["gcc", "-std=c99", "-fsyntax-only", *include, *map(str, sources)]
    found = subprocess.run(command, capture_output=True, check=False, text=True)
    return found.returncode == 0


def ros_makes_python(folder: Path, output: Path) -> bool:
    """Return whether rosidl_generator_py makes a module of the `msg/Foo.idl` in `folder`."""
    if not _generated(folder, output, "rosidl_generator_py"):
        return False
    try:
        ast.parse((output / "msg" / "_foo.py").read_text())
    except SyntaxError:
        return False
    return True


def ros_cpp_compiles(folder: Path, output: Path) -> bool:
    """Return whether the C++ that rosidl_generator_cpp makes of the `msg/Foo.idl` in `folder` compiles with g++."""
    if not _generated(folder, output, "rosidl_generator_cpp"):
        return False
    headers = output.parent / "headers"
    headers.mkdir(exist_ok=True)
    (headers / "pkg_a").symlink_to(output)
    (output / "msg" / "rosidl_generator_cpp__visibility_control.hpp").write_text(
        "#define ROSIDL_GENERATOR_CPP_PUBLIC_pkg_a\n"
    )
    include = [f"-I{headers}", *(f"-I{p}" for p in sorted((Path(sys.prefix) / "include").glob("*")))]
    command = ["g++", "-std=gnu++17", "-fsyntax-only", "-x", "c++", *include, str(output / "msg" / "foo.hpp")]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def _generated(folder: Path, output: Path, generator: str) -> bool:
    """Run one generator in a separate process: after an exception the template engine is not usable again."""
    share = Path(sys.prefix) / "share"
    arguments: dict[str, Any] = {
        "package_name": "pkg_a",
        "output_dir": str(output),
        "template_dir": str(share / generator / "resource"),
        "idl_tuples": [f"{folder}:msg/Foo.idl"],
        "ros_interface_dependencies": [],
        "target_dependencies": [],
        "type_description_tuples": [f"msg/Foo.idl:{output / 'msg' / 'Foo.json'}"],
        "include_paths": [f"{p}:{share / p}" for p in ("std_msgs", "builtin_interfaces")],
    }
    output.mkdir(exist_ok=True)
    file = output / "arguments.json"
    file.write_text(json.dumps(arguments))
    process = multiprocessing.get_context("fork").Process(target=_generate, args=(str(file), generator))
    process.start()
    process.join()
    return process.exitcode == 0


def _generate(arguments: str, generator: str) -> None:
    from rosidl_generator_c import generate_c
    from rosidl_generator_cpp import generate_cpp
    from rosidl_generator_py import generate_py
    from rosidl_generator_type_description import generate_type_hash
    from rosidl_typesupport_fastrtps_c import generate_typesupport_fastrtps_c

    with Path(os.devnull).open("w", encoding="utf-8") as quiet:
        sys.stdout = sys.stderr = quiet
        status = 1
        with contextlib.suppress(Exception):
            generate_type_hash(arguments)
            if generator == "rosidl_generator_c":
                generate_c(arguments, disable_description_codegen=True)
            elif generator == "rosidl_generator_cpp":
                generate_cpp(arguments)
            elif generator == "rosidl_generator_py":
                generate_py(arguments, ["rosidl_typesupport_fastrtps_c"])
            else:
                generate_typesupport_fastrtps_c(arguments)
            status = 0
    os._exit(status)


def _messages(content: Any) -> list[Any]:
    from rosidl_parser.definition import Action, Message, Service

    found = list(content.get_elements_of_type(Message))
    for service in content.get_elements_of_type(Service):
        found += [service.request_message, service.response_message, service.event_message]
    for action in content.get_elements_of_type(Action):
        found += [action.goal, action.result, action.feedback]
        for service in (action.send_goal_service, action.get_result_service):
            found += [service.request_message, service.response_message, service.event_message]
        found.append(action.feedback_message)
    return found


def _message(message: Any) -> RosMessage:
    from rosidl_generator_type_description import serialize_individual_type_description

    structure = message.structure
    documented = [structure, *message.constants, *structure.members]
    return RosMessage(
        serialize_individual_type_description(structure.namespaced_type, structure.members),
        tuple((constant.name, constant.value) for constant in message.constants),
        tuple(tuple(element.get_comment_lines()) for element in documented),
    )
