# SPDX-License-Identifier: Apache-2.0
"""The peer of `generate`: rosidl_generator_c of the installed ROS 2, on packages of its own share folder.

It does one of the five steps of the existing pipeline: C structs and functions, without type support and
without reading .msg files.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from rosidl_generator_c import generate_c


def main() -> None:
    """Generate the packages named after the output folder."""
    share, out = Path(sys.prefix) / "share", Path(sys.argv[1])
    for package in sys.argv[2:]:
        files = sorted((share / package / "msg").glob("*.idl"))
        folder = out / package
        folder.mkdir(parents=True)
        arguments = {
            "package_name": package,
            "output_dir": str(folder),
            "template_dir": str(share / "rosidl_generator_c" / "resource"),
            "idl_tuples": [f"{share / package}:msg/{f.name}" for f in files],
            "ros_interface_dependencies": [],
            "target_dependencies": [],
            "type_description_tuples": [f"msg/{f.name}:{f.with_suffix('.json')}" for f in files],
        }
        path = folder / "arguments.json"
        path.write_text(json.dumps(arguments))
        generate_c(str(path), [])


if __name__ == "__main__":
    main()
