# SPDX-License-Identifier: Apache-2.0
"""The peer of `generate`: the pipeline of the installed ROS 2 on packages of its share folder, C only.

The steps that `generate` does too: .msg, .srv and .action to .idl (rosidl_adapter), hashes and descriptions
(rosidl_generator_type_description), structs and functions (rosidl_generator_c), type support for Fast CDR
(rosidl_typesupport_fastrtps_c). They run in one process, where a colcon build starts one for each package and step.
Prints wall and processor seconds as JSON, by step and package. Introspection, C++ and Python, which a build makes
besides, are left out.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from rosidl_adapter.action import convert_action_to_idl
from rosidl_adapter.msg import convert_msg_to_idl
from rosidl_adapter.srv import convert_srv_to_idl
from rosidl_generator_c import generate_c
from rosidl_generator_type_description import generate_type_hash
from rosidl_typesupport_fastrtps_c import generate_typesupport_fastrtps_c

SHARE = Path(sys.prefix) / "share"
CONVERT = {"msg": convert_msg_to_idl, "srv": convert_srv_to_idl, "action": convert_action_to_idl}


class Package:
    """One package and what was made of it so far, below a folder of the output."""

    def __init__(self, name: str, out: Path) -> None:
        self.name = name
        self.folder = out / name
        self.idl: list[Path] = []

    def adapt(self) -> None:
        """Turn each interface file into .idl; an .idl file without one is taken as it is."""
        source = SHARE / self.name
        for kind, convert in CONVERT.items():
            written = set()
            for path in sorted((source / kind).glob(f"*.{kind}")):
                convert(source, self.name, path.relative_to(source), self.folder / kind)
                written.add(f"{path.stem}.idl")
            for path in sorted((source / kind).glob("*.idl")):
                if path.name not in written:
                    (self.folder / kind).mkdir(parents=True, exist_ok=True)
                    (self.folder / kind / path.name).write_bytes(path.read_bytes())
        self.idl = sorted(p.relative_to(self.folder) for p in self.folder.glob("*/*.idl"))

    def describe(self) -> None:
        """Write hash and description of each type; those of other packages are the installed ones."""
        paths = [f"{path.parents[1].name}:{path.parents[1]}" for path in SHARE.glob("*/*/*.idl")]
        generate_type_hash(
            self._arguments("rosidl_generator_type_description", include_paths=sorted(set(paths)))
        )

    def structs(self) -> None:
        """Write structs and functions."""
        described = [f"{path}:{self.folder / path.with_suffix('.json')}" for path in self.idl]
        sources = [str(self.folder / path) for path in self.idl]
        more = {"type_description_tuples": described, "ros_interface_files": sources}
        generate_c(self._arguments("rosidl_generator_c", **more))

    def support(self) -> None:
        """Write type support for Fast CDR."""
        generate_typesupport_fastrtps_c(self._arguments("rosidl_typesupport_fastrtps_c"))

    def _arguments(self, generator: str, **more: Sequence[str]) -> str:
        arguments = {
            "package_name": self.name,
            "output_dir": str(self.folder),
            "template_dir": str(SHARE / generator / "resource"),
            "idl_tuples": [f"{self.folder}:{path}" for path in self.idl],
            "ros_interface_dependencies": [],
            "target_dependencies": [],
            **more,
        }
        path = self.folder / f"{generator}.json"
        path.write_text(json.dumps(arguments))
        return str(path)


def main() -> None:
    """Generate the packages named after the output folder."""
    packages = [Package(name, Path(sys.argv[1])) for name in sys.argv[2:]]
    steps = {
        "rosidl_adapter": Package.adapt,
        "rosidl_generator_type_description": Package.describe,
        "rosidl_generator_c": Package.structs,
        "rosidl_typesupport_fastrtps_c": Package.support,
    }
    seconds: dict[str, dict[str, tuple[float, float]]] = {}
    for name, step in steps.items():
        seconds[name] = {package.name: timed(step, package) for package in packages}
    print(json.dumps(seconds))


def timed(step: Callable[[Package], None], package: Package) -> tuple[float, float]:
    """Return wall and processor seconds of one step of one package."""
    start, before = time.perf_counter(), time.process_time()
    with contextlib.redirect_stdout(io.StringIO()):  # they print what they read
        step(package)
    return time.perf_counter() - start, time.process_time() - before


if __name__ == "__main__":
    main()
