# SPDX-License-Identifier: Apache-2.0
"""The request to `init`, and the proposal that it derives from it."""

from __future__ import annotations

import os
import re
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen import compiler
from microros_gen.compiler import DEFAULT_INTERFACE
from microros_gen.diagnostics import Diagnostics, Source, UserError
from microros_gen.documents.files import read_text
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import InterfaceSet, resolve_interfaces
from microros_gen.interfaces.derived import parts_of
from microros_gen.interfaces.find import InterfaceFinder
from microros_gen.interfaces.types import Declaration, Message
from microros_gen.migrate.code import code_files, code_folder, read_code, text_of
from microros_gen.migrate.colcon_meta import MetaSetting, read_settings
from microros_gen.migrate.draft import Draft, DraftValue, Flow, Remark, report_remarks
from microros_gen.migrate.first import AGENT, first_draft
from microros_gen.migrate.included import included_types
from microros_gen.migrate.limits import DEFAULT_LIMITS, limits_of
from microros_gen.migrate.meta_draft import meta_draft
from microros_gen.migrate.profiles import first_profile
from microros_gen.migrate.rclc_draft import Adopted, rclc_draft
from microros_gen.package.description import PackageDescription
from microros_gen.package.project import Project
from microros_gen.platform.capabilities import capabilities
from microros_gen.records import dataclass
from microros_gen.selection.find_components import declared_functions, load_catalogue
from microros_gen.selection.find_profiles import load_builtin_profiles
from microros_gen.selection.outside import with_installed
from microros_gen.selection.resolve import check_ready

_ADDRESSED = ("udp", "tcp")
DEFAULT_SERVICE = "example_interfaces/srv/AddTwoInts"


@dataclass(frozen=True)
class InitOptions:
    """The arguments of `init`; `checked`: with a golden copy and the workflow that compares it.

    `package`: the folder becomes a project with this package.
    """

    folder: Path
    profiles: tuple[str, ...]
    target: str | None
    sources: Path | None
    metas: tuple[Path, ...]
    interface_paths: tuple[Path, ...]
    checked: bool = False
    package: PackageDescription | None = None

    @property
    def name(self) -> str:
        """The name of the application: that of the folder, as CMake targets and ROS nodes can have it."""
        words = re.findall(r"[a-z0-9]+", self.folder.resolve().name.lower())
        name = "_".join(words)
        return name if name[:1].isalpha() else f"app_{name}".rstrip("_")

    def seen_from_folder(self, name: str) -> str:
        """Return the name of a profile or target; a file of the user's as a path relative to the new folder."""
        is_file = name.endswith((".yaml", ".yml"))
        return Path(os.path.relpath(name, self.folder)).as_posix() if is_file else name

    @property
    def adopts(self) -> bool:
        """Whether there is something to be read."""
        return self.code is not None or bool(self.metas)

    @property
    def code(self) -> Path | None:
        """The sources to read: those of the user, else the example of the package."""
        if self.sources is not None or self.package is None:
            return self.sources
        return self.package.example

    def compiler_options(self) -> compiler.Options:
        """Return the options of the other commands for this."""
        return compiler.Options(interface_paths=self.interface_paths)


def draft_of(options: InitOptions, warnings: Diagnostics) -> Draft:
    """Return the proposal; what is no error is added to `warnings`. Raises UserError where a file cannot be read."""
    if not options.adopts:
        return _of_profiles(options)
    diagnostics = Diagnostics()
    settings = [setting for path in options.metas for setting in _settings_of(path, diagnostics)]
    adopted = _of_code(options, diagnostics) if options.code is not None else None
    if diagnostics.has_errors() and adopted is not None:
        remarks = (*adopted.draft.all_remarks, *_included(options, adopted)[1])
        report_remarks((remark for remark in remarks if remark.refused), diagnostics)
    diagnostics.check()
    warnings.extend(diagnostics)
    draft = meta_draft(settings, declared=adopted is not None)
    return _with_defaults(options, draft if adopted is None else _joined(options, draft, adopted))


def _of_code(options: InitOptions, diagnostics: Diagnostics) -> Adopted | None:
    """Return what the sources propose that can be read; None where none can."""
    assert options.code is not None
    found = Diagnostics()  # of these sources alone: what cannot be read may have the calls that are missing
    sources = read_code(options.code, found)
    adopted = _of_sources(options, sources, found) if sources else None
    diagnostics.extend(found)
    return adopted


def _of_sources(options: InitOptions, sources: tuple[Source, ...], diagnostics: Diagnostics) -> Adopted:
    if options.sources is None:
        places = source_places(options)
        sources = tuple(replace(s, name=places[Path(s.name)]) for s in sources)
    catalogue = with_installed(load_catalogue(), capabilities())
    provided = _provided(options.package) if options.package is not None else frozenset()
    return rclc_draft(sources, declared_functions(catalogue), catalogue, diagnostics, provided)


def source_places(options: InitOptions) -> Mapping[Path, str]:
    """Return where the project has each C and C++ file of the sources."""
    assert options.package is not None
    assert options.code is not None
    project, folder = options.package.project, code_folder(options.code)
    assert project is not None
    files = code_files(options.code)
    mains = {
        suffix: _main_of(project, [f for f in files if f.suffix == suffix]) for suffix, _ in project.renamed
    }
    return {
        path: project.place_of_source(
            path.relative_to(folder).as_posix(), options.name, path == mains.get(path.suffix)
        )
        for path in files
    }


def _main_of(project: Project, files: list[Path]) -> Path | None:
    """Return the file in which the program begins: the one with the entry function, else the first."""
    begins = (path for path in files if project.entry.is_met([text_of(path)]))
    return next(begins, files[0] if files else None)


def _provided(package: PackageDescription) -> frozenset[str]:
    """Return the names in the headers of a package, which its functions are among."""
    headers = [path for path in package.own_files().values() if path.suffix == ".h"]
    return frozenset(name for path in headers for name in re.findall(r"\w+", read_text(path)))


def _joined(options: InitOptions, meta: Draft, adopted: Adopted) -> Draft:
    """Return what sources and settings say together; the sources have the last word."""
    code, remarks = _with_included(options, adopted)
    groups = {name: dict(values) for name, values in meta.groups.items()}
    for name, values in code.groups.items():
        groups[name] = {**groups.get(name, {}), **values}
    return replace(
        code,
        components=tuple(sorted({*meta.components, *code.components})),
        settings=meta.settings,
        groups=groups,
        limits={**_limits(options, adopted, code.interfaces), **code.limits},
        remarks=(*code.remarks, *remarks, *meta.remarks),
    )


def _with_included(options: InitOptions, adopted: Adopted) -> tuple[Draft, tuple[Remark, ...]]:
    """Return the proposal with the types whose headers are included and that no entity brings, and what is unknown."""
    finder = InterfaceFinder.from_environment(options.interface_paths)
    included, remarks = _included(options, adopted)
    draft = adopted.draft
    if not draft.nodes:
        return draft, remarks
    needed = _closure((*_types(draft), *draft.interfaces, *adopted.implied), finder)
    types = needed.messages.keys() | set(needed.roots) if needed is not None else ()
    more = set(included) - {str(name) for name in types}
    # That the package of an entity is unknown is reported when the proposal is planned
    reported = {package for package in map(package_of, _types(draft)) if finder.package(package) is None}
    remarks = tuple(remark for remark in remarks if package_of(remark.text) not in reported)
    return replace(draft, interfaces=tuple(sorted({*draft.interfaces, *more}))), remarks


def _included(options: InitOptions, adopted: Adopted) -> tuple[tuple[str, ...], tuple[Remark, ...]]:
    """Return the types whose headers are included, and what is unknown."""
    own = [path.as_posix() for path in code_files(options.code)] if options.code is not None else []
    return included_types(adopted.includes, own, InterfaceFinder.from_environment(options.interface_paths))


def _types(draft: Draft) -> list[str]:
    types = [e.type for node in draft.nodes for e in node.endpoints if e.type]
    return types + [action.type for node in draft.nodes for action in node.actions if action.type]


def package_of(name: str) -> str:
    """Return the package of a type or header."""
    return name.split("/", 1)[0]


def _closure(types: Iterable[str], finder: InterfaceFinder) -> InterfaceSet | None:
    """Return the types with all that they contain; None where one is unknown, which planning reports."""
    try:
        return resolve_interfaces(tuple(Named(t) for t in dict.fromkeys(types)), finder, Diagnostics())
    except UserError:
        return None


def _limits(options: InitOptions, adopted: Adopted, more: tuple[str, ...]) -> Mapping[str, DraftValue]:
    """Return the limits; `more` are types without entities."""
    finder = InterfaceFinder.from_environment(options.interface_paths)
    interfaces = _closure((*_types(adopted.draft), *more), finder)
    if interfaces is None:
        return {"*": DEFAULT_LIMITS}
    exchanged = [message.name for root in interfaces.roots for message in _own(interfaces.declaration(root))]
    return limits_of(adopted.capacities, exchanged, interfaces.messages)


def _own(declaration: Declaration) -> tuple[Message, ...]:
    """Return what is exchanged: the message, or the request and response of a service."""
    if isinstance(declaration, Message):
        return (declaration,)
    return tuple(message for _, message in parts_of(declaration))


def _settings_of(path: Path, diagnostics: Diagnostics) -> tuple[MetaSetting, ...]:
    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is not UTF-8 text"
        diagnostics.error(
            f"cannot read '{path}': {reason}", hint="Give the path of a colcon.meta", id="MG-9010"
        )
        return ()
    return read_settings(source, diagnostics)


def _with_defaults(options: InitOptions, draft: Draft) -> Draft:
    """Return the proposal with what every application file has: what it does, and with which types."""
    remarks = list(draft.remarks)
    profiles = options.profiles or draft.profiles
    if not profiles and not draft.nodes:
        profiles = (first_profile(),)
        remarks.append(Remark(f"what the application does is unknown: `profiles` has {profiles[0]}"))
    interfaces = draft.interfaces
    if not draft.nodes:
        interfaces = (DEFAULT_INTERFACE, *((DEFAULT_SERVICE,) if "+services" in draft.components else ()))
        text = f"which types it uses is unknown: `interfaces` has {' and '.join(interfaces)}"
        more = "With `nodes`, as `init --from SRC_DIR` proposes them, everything has its exact size"
        remarks.append(Remark(f"{text}. {more}"))
    settings = dict(draft.settings)
    if any(endpoint.kind != "subscription" for node in draft.nodes for endpoint in node.endpoints):
        settings.setdefault("on_full", DraftValue(Flow("block 1 s"), "as rmw_microxrcedds does by itself"))
    groups = dict(draft.groups)
    transport = groups.pop("transport", {})
    if options.package is not None and options.package.project is not None and options.package.project.keyed:
        key = DraftValue(
            zlib.crc32(options.name.encode()) | 1, "boards that share an agent need different ones"
        )
        groups["session"] = {"key": key, **groups.get("session", {})}
    if "type" not in transport and options.package is None and options.target in (None, "host"):
        agent = "discover" if "+discovery" in draft.components else AGENT
        transport = {"type": DraftValue("udp"), "agent": DraftValue(agent), **transport}
    if "type" in transport and transport["type"].value in _ADDRESSED and "agent" not in transport:
        transport = {**transport, "agent": DraftValue(AGENT, "unless the program sets another one")}
    if transport:
        groups = {"transport": transport, **groups}
    target = DraftValue(
        options.seen_from_folder(options.target or "host"), "`microros-gen targets` lists them"
    )
    limits = draft.limits if draft.nodes else {"*": DEFAULT_LIMITS}
    return replace(
        draft,
        components=_needed_components(options, draft),
        profiles=tuple(options.seen_from_folder(profile) for profile in profiles),
        interfaces=interfaces,
        settings=settings if options.package is not None else {"target": target, **settings},
        groups=groups,
        limits=limits,
        remarks=tuple(remarks),
    )


def _needed_components(options: InitOptions, draft: Draft) -> tuple[str, ...]:
    """Return the components of the proposal, with those of its profiles that the user's profiles do not have."""
    if not options.profiles or not draft.profiles:
        return draft.components
    compiled = compiler.Options(profiles=options.profiles, interface_paths=options.interface_paths)
    selection = compiler.resolve(compiler.read_source(None, Path(), compiled)).selection
    builtin = load_builtin_profiles()
    wanted = {change.name for name in draft.profiles for change in builtin[name].components}
    return tuple(sorted({*draft.components, *(f"+{name}" for name in wanted if not selection.has(name))}))


def _of_profiles(options: InitOptions) -> Draft:
    diagnostics = Diagnostics()
    profiles = options.profiles or (first_profile(),)
    compiled = compiler.Options(
        profiles=profiles, interface_paths=options.interface_paths, target=options.target
    )
    resolved = compiler.resolve(compiler.read_source(None, Path(), compiled))
    check_ready(resolved.selection, diagnostics)
    diagnostics.check()
    named = tuple(options.seen_from_folder(profile) for profile in profiles)
    return first_draft(
        resolved.selection, named, options.name, options.seen_from_folder(options.target or "host")
    )
