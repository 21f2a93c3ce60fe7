# SPDX-License-Identifier: Apache-2.0
"""Python classes of an interface package that ships with this tool, as colcon would build them.

The generators are those of the ROS 2 wheels, and all that they write becomes one extension module.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

from microros_gen.interfaces.find import shipped_folder
from tests.support.runtime.merged import merged, text_of

PREFIX = Path(sys.prefix)
"""Of the wheels."""
TYPE_SUPPORTS = ("rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c")
"""Those that rmw_fastrtps_cpp asks for: bytes, and the description of a type."""
_GENERATE = """\
import sys
from pathlib import Path
from rosidl_generator_c.cli import GenerateC
from rosidl_generator_py.cli import GeneratePython
from rosidl_typesupport_c.cli import GenerateCTypesupport
from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport
from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport

package, source, share, out = sys.argv[1], Path(sys.argv[2]), sys.argv[3], Path(sys.argv[4])
files = [f"{source}:{file.relative_to(source)}" for file in sorted(source.glob("*/*"))]
for generator in (
    GenerateC("c"),
    GenerateFastRTPSCTypesupport("fastrtps_c"),
    GenerateIntrospectionCTypesupport("introspection_c"),
    GenerateCTypesupport("c", typesupport_implementations=sys.argv[5:]),
    GeneratePython(".", typesupport_implementations=["rosidl_typesupport_c"]),
):
    generator.generate(package, files, [share], out / generator.name / package)
"""


def python_messages(package: str, dependencies: tuple[str, ...], folder: Path) -> None:
    """Build the package below `folder`, which goes on the paths of Python and of libraries.

    `dependencies` are packages of wheels.
    """
    folder.mkdir(parents=True)
    generate = (
        *(sys.executable, "-c", _GENERATE, package),
        *map(str, (shipped_folder() / package, PREFIX / "share", folder)),
        *TYPE_SUPPORTS,
    )
    environment = {**os.environ, "AMENT_PREFIX_PATH": str(PREFIX)}
    subprocess.run(generate, env=environment, check=True, capture_output=True)
    kinds = ("rosidl_generator_c", "rosidl_generator_py", *TYPE_SUPPORTS)
    libraries = (
        *(f"{dependency}__{kind}" for dependency in dependencies for kind in kinds),
        *("rosidl_runtime_c", "rosidl_typesupport_c", *TYPE_SUPPORTS, "rosidl_typesupport_fastrtps_cpp"),
        *("fastcdr", "rcpputils", "rmw"),
    )
    module = folder / package / f"{package}_s__rosidl_typesupport_c{sysconfig.get_config_var('EXT_SUFFIX')}"
    _compile(folder, module, libraries)
    for kind in TYPE_SUPPORTS:  # found by name when the first endpoint asks
        (folder / f"lib{package}__{kind}.so").symlink_to(module)


def _units(folder: Path) -> list[Path]:
    """Return the sources, those in C as few files that include them: most of their time goes into headers of Python."""
    units = []
    for number, parts in enumerate(merged(sorted(folder.rglob("*.c")))):
        units.append(folder / f"unit{number}.c")
        units[-1].write_text(text_of(parts))
    return [*units, *sorted(folder.rglob("*.cpp"))]


def _compile(folder: Path, module: Path, libraries: tuple[str, ...]) -> None:
    """Link every source below `folder` as one module."""
    import numpy

    headers = PREFIX / "include"
    generated = [path for path in folder.iterdir() if path.is_dir() and path.name != module.parent.name]
    places = (
        *generated,
        sysconfig.get_path("include"),
        numpy.get_include(),
        headers,
        *sorted(headers.iterdir()),
    )
    included = [f"-I{place}" for place in places]
    objects = []
    for source in _units(folder):
        output = source.with_name(f"{source.name}.o")
        compiler = ["g++", "-std=c++17"] if source.suffix == ".cpp" else ["gcc"]
        command = [*compiler, "-O0", "-fPIC", "-w", *included, "-c", str(source), "-o", str(output)]
        subprocess.run(command, check=True, capture_output=True)
        objects.append(str(output))
    found = [f"-L{PREFIX / 'lib'}", f"-Wl,-rpath,{PREFIX / 'lib'}", *(f"-l{name}" for name in libraries)]
    subprocess.run(["g++", "-shared", *objects, "-o", str(module), *found], check=True, capture_output=True)
