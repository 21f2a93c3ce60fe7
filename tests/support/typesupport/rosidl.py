# SPDX-License-Identifier: Apache-2.0
"""ROS 2's own C and Fast CDR type support for interfaces that no wheel has: generated, compiled, loaded."""

from __future__ import annotations

import ctypes
import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from microros_gen.typesupport.plan.names import snake_case

PREFIX = Path(sys.prefix)
ROOM = 4096
HEADER = 4

GENERATE = """
import sys
from rosidl_generator_c import generate_c
from rosidl_generator_type_description import generate_type_hash
from rosidl_typesupport_fastrtps_c import generate_typesupport_fastrtps_c
first, second = sys.argv[1:]
generate_type_hash(first)
generate_c(first, disable_description_codegen=True)
generate_typesupport_fastrtps_c(second)
"""

WRAPPER = """
#include <cstring>
#include <fastcdr/Cdr.h>
using eprosima::fastcdr::Cdr;
"""

CALLS = """
extern "C" size_t {name}__write(const {name} * message, char * bytes, size_t room) {{
  std::memset(bytes, 0, room);
  eprosima::fastcdr::FastBuffer buffer(bytes, room);
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, eprosima::fastcdr::CdrVersion::XCDRv1);
  cdr.set_encoding_flag(eprosima::fastcdr::EncodingAlgorithmFlag::PLAIN_CDR);
  cdr.serialize_encapsulation();
  return cdr_serialize_{name}(message, cdr) ? cdr.get_serialized_data_length() : 0u;
}}
extern "C" bool {name}__read(char * bytes, size_t size, {name} * message) {{
  eprosima::fastcdr::FastBuffer buffer(bytes, size);
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN);
  cdr.read_encapsulation();
  return cdr_deserialize_{name}(cdr, message);
}}
"""


@dataclass(frozen=True)
class RosPackage:
    """What ROS 2 made of a package: headers, hashes, and functions on its messages."""

    folder: Path
    package: str
    library: ctypes.CDLL

    @property
    def includes(self) -> list[str]:
        """Compiler options for its headers and those that they include."""
        return include_options(self.folder)

    def type_hash(self, name: str) -> str:
        """Return the RIHS01 hash of a message."""
        found = json.loads((self.folder / self.package / "msg" / f"{name}.json").read_text())
        hashes = {h["type_name"]: h["hash_string"] for h in found["type_hashes"]}
        return str(hashes[f"{self.package}/msg/{name}"])

    def write(self, name: str, message: ctypes.Structure) -> bytes:
        """Return the body that Fast CDR writes, padding zero."""
        room = ctypes.create_string_buffer(ROOM)
        write = self.library[f"{self.package}__msg__{name}__write"]
        write.restype = ctypes.c_size_t
        size = write(ctypes.byref(message), room, ctypes.c_size_t(ROOM))
        assert size > HEADER
        return room.raw[HEADER:size]

    def read(self, name: str, body: bytes, big: bool, message: ctypes.Structure) -> None:
        """Read a body with Fast CDR into a message, which is initialized."""
        room = ctypes.create_string_buffer(bytes((0, 0 if big else 1, 0, 0)) + body)
        read = self.library[f"{self.package}__msg__{name}__read"]
        read.restype = ctypes.c_bool
        assert read(room, ctypes.c_size_t(HEADER + len(body)), ctypes.byref(message))

    def init(self, name: str, message: ctypes.Structure) -> None:
        """Set a message to its default values, as ROS 2 does."""
        init = self.library[f"{self.package}__msg__{name}__init"]
        init.restype = ctypes.c_bool
        assert init(ctypes.byref(message))


def include_options(folder: Path) -> list[str]:
    """Return compiler options for generated headers in `folder` and those of the wheels."""
    return [f"-I{f}" for f in (folder, PREFIX / "include", *sorted((PREFIX / "include").glob("*")))]


def make_ros_package(source: Path, package: str, names: Sequence[str], folder: Path) -> RosPackage:
    """Generate and compile the messages `names` (in dependency order) of the .idl files in source/msg."""
    out = folder / package
    (out / "msg").mkdir(parents=True)
    _generate(source, package, names, out)
    for kind in ("generator_c", "typesupport_fastrtps_c"):
        macro = f"ROSIDL_{kind.upper()}"
        text = "".join(f"#define {macro}_{word}_{package}\n" for word in ("PUBLIC", "IMPORT", "EXPORT"))
        (out / "msg" / f"rosidl_{kind}__visibility_control.h").write_text(text)
    stems = [snake_case(name) for name in names]
    functions, support = folder / "functions.c", folder / "support.cpp"
    parts = [f"{out}/msg/detail/{s}__{part}.c" for s in stems for part in ("functions", "description")]
    functions.write_text("".join(f'#include "{part}"\n' for part in parts))
    sources = "".join(f'#include "{out}/msg/detail/{s}__type_support_c.cpp"\n' for s in stems)
    calls = "".join(CALLS.format(name=f"{package}__msg__{name}") for name in names)
    support.write_text(WRAPPER + sources + calls)
    library = folder / "libros.so"
    common = ["-fPIC", "-O0", *include_options(folder)]
    _run(["gcc", *common, "-c", functions, "-o", folder / "functions.o"])
    link = ["-shared", f"-L{PREFIX / 'lib'}", f"-Wl,-rpath,{PREFIX / 'lib'}", "-l:libfastcdr.so.2"]
    link += ["-lrosidl_typesupport_fastrtps_c", "-lrosidl_runtime_c", "-lrcutils"]
    _run(["g++", "-std=c++17", *common, support, folder / "functions.o", *link, "-o", library])
    return RosPackage(folder, package, ctypes.CDLL(str(library)))


def _generate(source: Path, package: str, names: Sequence[str], out: Path) -> None:
    files = []
    for generator in ("rosidl_generator_c", "rosidl_typesupport_fastrtps_c"):
        arguments = {
            "package_name": package,
            "output_dir": str(out),
            "template_dir": str(PREFIX / "share" / generator / "resource"),
            "idl_tuples": [f"{source}:msg/{name}.idl" for name in names],
            "ros_interface_dependencies": [],
            "target_dependencies": [],
            "type_description_tuples": [f"msg/{n}.idl:{out / 'msg' / n}.json" for n in names],
            "include_paths": [],
        }
        files.append(out / f"{generator}.json")
        files[-1].write_text(json.dumps(arguments))
    _run([sys.executable, "-c", GENERATE, *files])


def _run(command: Sequence[str | Path]) -> None:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
