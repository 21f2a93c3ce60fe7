# SPDX-License-Identifier: Apache-2.0
"""Renders a project: every file of the output folder but the manifest, as bytes by relative path."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from jinja2 import Environment

from microros_gen.application.kinds import KINDS
from microros_gen.application.model import Application
from microros_gen.client.plan.project import Project
from microros_gen.client.plan.runtime_entities import PublisherPlan, SubscriptionPlan
from microros_gen.client.plan.services import ServicePlan
from microros_gen.client.views.agent_files import render_agent_files
from microros_gen.client.views.board import BoardView, board_view, render_toolchain
from microros_gen.client.views.components import render_components
from microros_gen.client.views.example_file import render_example
from microros_gen.client.views.memory import buffer_sizes
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.platform.capabilities import declarations
from microros_gen.records import dataclass
from microros_gen.selection.component import Component
from microros_gen.selection.component_sources import ComponentFile
from microros_gen.typesupport.views.decode import render_decoders
from microros_gen.typesupport.views.members import render_members
from microros_gen.typesupport.views.types import render_types

IMAGE_CMAKE = "microros_image.cmake"


@dataclass(frozen=True)
class _Row:
    name: str
    reasons: str


@dataclass(frozen=True)
class _Bytes:
    name: str
    bytes: int


@dataclass(frozen=True)
class _ProjectView:
    title: str
    image: str
    example: str
    sources: tuple[str, ...]
    components: tuple[_Row, ...]
    entities: tuple[str, ...]
    agent: str
    agent_file: str
    declared: bool
    memory: tuple[_Bytes, ...]
    board: BoardView | None
    functions: tuple[str, ...]
    declarations: tuple[str, ...]
    has_image: bool
    budgets: str


@dataclass(frozen=True)
class _UnselectedView:
    message: str


def render_project(
    project: Project,
    files: Iterable[ComponentFile],
    unselected: Iterable[Component],
    environment: Environment,
    fork: bool = False,
) -> dict[str, bytes]:
    """Return the bytes of every file by its path below the output folder.

    `files` are those of the selected components; `unselected` are the others, whose public headers become one
    `#error` each. `fork`: another process may print some of them.
    """
    values = project.values
    others = tuple(unselected)
    functions = (*project.provisions.functions(), *project.board.hooks)
    rendered = render_components(files, values, environment, functions, others)
    of_components = frozenset(rendered)
    pools = frozenset(pool.kind for pool in project.runtime.memory.message_pools)
    services = project.selection.has("services")
    rendered |= _free(of_components, render_types(project.types, environment, services, pools, fork))
    rendered |= render_decoders(project.types, environment)
    if project.selection.has("micro_ros_utilities"):
        rendered |= render_members(project.types, environment, pools)
    rendered |= render_agent_files(project)
    for path, content in _unselected_headers(others, environment):
        rendered.setdefault(path, content)
    rendered[project.example] = render_example(project, environment)
    view = _project_view(project, rendered)
    for name in ("CMakeLists.txt", "sources.txt", "README.md"):
        rendered[name] = environment.get_template(f"project/{name}.j2").render(view=view).encode()
    rendered[IMAGE_CMAKE] = environment.get_template(f"project/{IMAGE_CMAKE}").render().encode()
    if view.board is not None:
        rendered["toolchain.cmake"] = render_toolchain(project.target, environment)
    return rendered


def _free(taken: frozenset[str], files: dict[str, bytes]) -> dict[str, bytes]:
    """Return the files of types. UserError: a component from outside has a file with the name of one."""
    clashes = sorted(taken & files.keys())
    if clashes:
        message = f"a component has the file '{clashes[0]}', which belongs to a type"
        hint = "Choose a separate folder below include/ for its headers, and a name that no interface package has"
        raise UserError([Diagnostic(message, hint=hint, id="MG-7160")])
    return files


def _budgets(application: Application) -> str:
    """Return what an image is compared with as one text: it is linked again, and checked, when that changes."""
    memory = application.memory
    budgets = (("ram", memory.ram_budget), ("flash", memory.flash_budget), ("stack", memory.stack))
    texts = [f"{name} {size}" for name, size in budgets if size is not None]
    automatic = [f"stack of {task.name} {task.stack or 0}" for task in application.tasks if task.stack_auto]
    automatic += [f"lock of {t.name} {t.lock_instructions}" for t in application.tasks if t.lock_auto]
    return ", ".join([*texts, *automatic])


def library_sources(files: Iterable[str]) -> tuple[str, ...]:
    """Return the C and assembly files of the library among `files`, sorted."""
    return tuple(sorted(f for f in files if f.startswith("src/") and f.endswith((".c", ".S"))))


def _unselected_headers(
    components: Iterable[Component], environment: Environment
) -> Iterable[tuple[str, bytes]]:
    template = environment.get_template("project/unselected.h.j2")
    for component in components:
        advice = f"is not selected: add `{_key(component)}` to microros.yaml and generate again"
        message = (
            f"The component '{component.name}' {advice if component.ready else 'is not in this version yet'}"
        )
        content = template.render(view=_UnselectedView(message)).encode()
        yield from ((f"include/{header}", content) for header in component.headers)


def _key(component: Component) -> str:
    """Return what selects a component in the application file."""
    if component.layer == "port":
        return "target: {name: …}"
    transport = component.name.removeprefix("transport_")
    is_transport = transport != component.name
    return f"transport: {{type: {transport}}}" if is_transport else f"components: [+{component.name}]"


def without_folder(reason: str) -> str:
    """Return `… (microros.yaml:9)` for `… (some/folder/microros.yaml:9)`: output depends on content alone."""
    return re.sub(r"\((?:[^()]*[/\\])?([^()/\\]+:\d+)\)", r"(\1)", reason)


def _shown(project: Project, entity: PublisherPlan | SubscriptionPlan | ServicePlan) -> str:
    if isinstance(entity, ServicePlan):
        return f"`{entity.name}` of {entity.type}"
    text = f"`{entity.topic}` of {entity.type}, {'reliable' if entity.reliable else 'best effort'}"
    return f"{text}{_own_limits(project, entity)}" if isinstance(entity, PublisherPlan) else text


def _own_limits(project: Project, publisher: PublisherPlan) -> str:
    own = project.own_limits(publisher)
    return f", its own limits: at most {own.max_encoded_size} bytes" if own else ""


def _declarations(project: Project) -> tuple[str, ...]:
    """Return the declarations of what the application provides, and of its hooks."""
    declared = [line for row in project.provisions.of_application for line in declarations(row.capability)]
    return (*declared, *(f"void {name}(void);" for name in project.board.hooks))


def _project_view(project: Project, rendered: Mapping[str, bytes]) -> _ProjectView:
    runtime = project.runtime
    declared = [f"node `{n.name}` in `{n.namespace}`" for n in runtime.entities.nodes.declared]
    declared += [
        f"{kind.name} {_shown(project, entity)}"
        for kind in KINDS
        for entity in runtime.entities.places(kind.name).declared
    ]
    pools = [
        f"up to {runtime.entities.nodes.max} node(s), named by the application",
    ]
    pools += [f"subscription `{e.topic}` of {e.type}" for e in project.application.implied]
    of_roots = ", ".join(str(root) for root in project.roots)
    for kind in KINDS:
        places = runtime.entities.places(kind.name).application
        of_types = "" if kind.service_type else f" of {of_roots}"
        pools += [f"up to {places} {kind.name}(s){of_types}"] if places else []
    return _ProjectView(
        title=project.name,
        image=project.name,
        example=project.example,
        sources=library_sources(rendered),
        components=tuple(
            _Row(c.component.name, ", ".join(without_folder(r) for r in c.reasons))
            for c in project.selection.components
        ),
        entities=tuple(declared or pools),
        board=board_view(project),
        functions=(*project.provisions.functions(), *project.board.hooks),
        declarations=_declarations(project),
        has_image=not project.lacks_image,
        budgets=_budgets(project.application),
        agent=project.selection.entities,
        declared=runtime.entities.declared,
        agent_file=next((path for path in rendered if path.startswith("agent/")), ""),
        memory=tuple(_Bytes(name, size) for name, size in buffer_sizes(project)),
    )
