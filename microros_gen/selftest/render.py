# SPDX-License-Identifier: Apache-2.0
"""Renders OUT/selftest: plain C for each group of the port that the library has, and the tests of its types."""

from __future__ import annotations

from pathlib import Path

from jinja2 import Environment

from microros_gen.client.plan.project import Project
from microros_gen.records import dataclass
from microros_gen.selftest.checks import Skipped, chosen_checks, files_of, uses
from microros_gen.selftest.walks import Walk, has_long_double, parts_of, walk_of
from microros_gen.typesupport.plan.names import include_path
from microros_gen.typesupport.plan.types import TypePlan
from microros_gen.typesupport.views.text import string

FOLDER = "selftest"
MAIN = f"{FOLDER}/main.c"
_C_FILES = Path(__file__).resolve().parent / "c"
_LEAST_STACK = 1024
"""Bytes of the stack of a task of the checks, where the system does not need more."""
_ALWAYS = (
    "main.c",
    "selftest.h",
    "selftest_checks.h",
    "selftest_clock.c",
    "selftest_clock.h",
    "selftest_console.c",
    "selftest_report.c",
    "selftest_report.h",
    "selftest_time.c",
)
_TYPES = ("selftest_round_trip.c", "selftest_round_trip.h", "selftest_walk.c", "selftest_walk.h")


@dataclass(frozen=True)
class _Tested:
    """A type with a handle: its names, and whether a message has storage."""

    ros_name: str
    name: str
    storage: bool


@dataclass(frozen=True)
class _TypesView:
    includes: tuple[str, ...]
    walks: tuple[Walk, ...]
    tested: tuple[_Tested, ...]


@dataclass(frozen=True)
class _RunView:
    checks: tuple[str, ...]
    skipped: tuple[Skipped, ...]
    has_types: bool


@dataclass(frozen=True)
class _ConfigView:
    body: int
    mtu: int
    host: str
    port: int
    device: str
    baud: int
    stack: int
    plan_id: str


def render_selftest(project: Project, environment: Environment) -> dict[str, bytes]:
    """Return the bytes of every file of the self-test by its path below the output folder."""
    checks, skipped = chosen_checks(project)
    tested, untested = _tested(project)
    decodes = "selftest_decode.c" if any(plan.received for plan in tested) else "selftest_decode_none.c"
    names = {*_ALWAYS, *files_of(checks), *((*_TYPES, decodes) if tested else ())}
    files = {f"{FOLDER}/{name}": (_C_FILES / name).read_bytes() for name in names}
    run = _RunView(tuple(check.name for check in checks), (*skipped, *untested), bool(tested))
    views: dict[str, object] = {"selftest_run.c": run, "selftest_config.h": _config(project, tested)}
    views |= {"selftest_types.c": _types(project, tested)} if tested else {}
    for name, view in views.items():
        text = environment.get_template(f"selftest/{name}.j2").render(view=view)
        files[f"{FOLDER}/{name}"] = text.encode()
    sources = "".join(f"{name}\n" for name in sorted(files) if name.endswith(".c"))
    files[f"{FOLDER}/sources.txt"] = sources.encode()
    return dict(sorted(files.items()))


def _tested(project: Project) -> tuple[tuple[TypePlan, ...], tuple[Skipped, ...]]:
    """Return the types that are tested, and those that are not."""
    tested, skipped = [], []
    for plan in project.types:
        if not plan.root or plan.wire is None:
            continue
        parts = parts_of(plan.name, project.messages)
        if any(has_long_double(project.messages[part]) for part in parts):
            skipped.append(Skipped(str(plan.name), "it has a long double"))
        else:
            tested.append(plan)
    return tuple(tested), tuple(skipped)


def _types(project: Project, tested: tuple[TypePlan, ...]) -> _TypesView:
    parts = frozenset[object]().union(*(parts_of(plan.name, project.messages) for plan in tested))
    includes = {include_path(plan.files.struct) for plan in tested}
    includes |= {include_path(plan.files.type_support) for plan in tested}
    includes |= {include_path(plan.files.storage) for plan in tested if plan.storage}
    return _TypesView(
        includes=tuple(sorted(includes)),
        walks=tuple(walk_of(plan.message) for plan in project.types if plan.name in parts),
        tested=tuple(_Tested(str(plan.name), plan.c_name, bool(plan.storage)) for plan in tested),
    )


def _config(project: Project, tested: tuple[TypePlan, ...]) -> _ConfigView:
    runtime, os = project.runtime, project.target.os
    stack = max(_LEAST_STACK, os.task_stack_least) if uses(project, "tasks") else 0
    return _ConfigView(
        body=max((plan.max_encoded_size for plan in tested), default=1),
        mtu=runtime.streams.mtu,
        host=string(runtime.transport.agent_host),
        port=runtime.transport.agent_port,
        device=string(runtime.transport.device),
        baud=runtime.transport.baud,
        stack=stack,
        plan_id=runtime.plan_id,
    )


def lacks_image(project: Project) -> str:
    """Return why `build` does not link the self-test to an image; empty where it does."""
    if project.lacks_image:
        return project.lacks_image
    if not project.target.hosted and project.target.stdio is None:
        return f"target {project.target.name} has no `stdio` to print to: define selftest_line and link it yourself"
    return ""


def selftest_image(project: Project) -> str | None:
    """Return the file name of the self-test below bin/; None where there is the library alone."""
    return None if lacks_image(project) else f"{FOLDER}{project.target.image_suffix}"
