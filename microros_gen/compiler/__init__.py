# SPDX-License-Identifier: Apache-2.0
"""The compiler as a Python API: read → resolve → plan → render → write → compile.

The command line, the CMake hook, the plugin of `rosidl generate`, `init` and the tests use it. Each step takes the
result of the previous one and returns frozen data; nothing is printed. A user mistake raises `UserError` with every
error `Diagnostic` of the step; warnings accumulate in `warnings` of the results. Functions are reentrant; only `write`,
`generate` and `compile` write files. Attributes are imported on first use, so importing this package costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from microros_gen.compiler.api import (
        Built,
        Generated,
        compile,
        differences,
        generate,
        output_folder,
        plan,
        read,
        read_source,
        render,
        resolve,
        toolchain,
        write,
    )
    from microros_gen.compiler.budgets import check_manifest, check_plan
    from microros_gen.compiler.options import Options
    from microros_gen.compiler.pipeline import DEFAULT_INTERFACE, Planned, Resolved, read_paths
    from microros_gen.compiler.request import Request
    from microros_gen.compiler.system import CheckedBoard, CheckedSystem, check_system
    from microros_gen.diagnostics import Diagnostic, UserError

__all__ = [
    "DEFAULT_INTERFACE",
    "Built",
    "CheckedBoard",
    "CheckedSystem",
    "Diagnostic",
    "Generated",
    "Options",
    "Planned",
    "Request",
    "Resolved",
    "UserError",
    "check_manifest",
    "check_plan",
    "check_system",
    "compile",
    "differences",
    "generate",
    "output_folder",
    "plan",
    "read",
    "read_paths",
    "read_source",
    "render",
    "resolve",
    "toolchain",
    "write",
]

_ELSEWHERE = {
    "DEFAULT_INTERFACE": "microros_gen.compiler.pipeline",
    "CheckedBoard": "microros_gen.compiler.system",
    "CheckedSystem": "microros_gen.compiler.system",
    "Diagnostic": "microros_gen.diagnostics",
    "Options": "microros_gen.compiler.options",
    "Planned": "microros_gen.compiler.pipeline",
    "Request": "microros_gen.compiler.request",
    "Resolved": "microros_gen.compiler.pipeline",
    "UserError": "microros_gen.diagnostics",
    "check_manifest": "microros_gen.compiler.budgets",
    "check_plan": "microros_gen.compiler.budgets",
    "check_system": "microros_gen.compiler.system",
    "read_paths": "microros_gen.compiler.pipeline",
}


def __getattr__(name: str) -> object:
    """Import the requested name on first use (PEP 562)."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_ELSEWHERE.get(name, "microros_gen.compiler.api")), name)
