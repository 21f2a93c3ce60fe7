# SPDX-License-Identifier: Apache-2.0
"""package.yaml → PackageDescription, checked against its JSON Schema with places."""

from __future__ import annotations

from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.files import is_file
from microros_gen.documents.schema import load_schema, validate
from microros_gen.documents.tree_values import child, child_text, entries, items, text_of
from microros_gen.documents.yaml_tree import MappingNode, YamlNode, parse_yaml
from microros_gen.package.project import Project, parse_project
from microros_gen.records import dataclass
from microros_gen.selection.contribution import Conditions
from microros_gen.selection.contribution_file import conditions_of

PACKAGE_FILE = "package.yaml"
PLAN_FILE = "microros.yaml"
TARGET_FILE = "target.yaml"
FILES_FOLDER = "files"
PROJECT_FOLDER = "project"
SCHEMA = Path(__file__).with_name("package.schema.json")
ARCHIVES = ("tar.gz", "zip")


@dataclass(frozen=True)
class Place:
    """Files of an output folder whose paths begin with `prefix` have `to` instead; None: they are left out."""

    prefix: str
    to: str | None


@dataclass(frozen=True)
class Tool:
    """What the other build system needs of a machine: one of `programs`, or a folder that `variable` names.

    `debian` are the packages that have it, otherwise `remedy` is a command or a sentence that brings it.
    """

    programs: tuple[str, ...]
    variable: str
    debian: tuple[str, ...]
    remedy: str


@dataclass(frozen=True)
class PackageDescription:
    """What a package.yaml says, and where its folder is.

    `origin` says who brings it where it does not ship with the tool. `conditions` are those of files below files/,
    by the beginning of their paths. `transports`: empty means all. `defines` are capabilities whose functions files/
    has. `project` says what a new project with the package consists of; None: nothing. `next_folder` and `next_archive`
    say what the user does with the result, `{out}`. `tools` is what `doctor` looks for. `files_of` is the package whose
    files/ this one has, too; own files replace those of the same path.
    """

    name: str
    summary: str
    library: str
    folder: Path
    archive: str
    next_folder: str
    next_archive: str
    transports: tuple[str, ...]
    defines: tuple[str, ...]
    layout: tuple[Place, ...]
    conditions: tuple[tuple[str, Conditions], ...]
    project: Project | None = None
    origin: str = ""
    files_of: PackageDescription | None = None
    tools: tuple[Tool, ...] = ()

    @property
    def general_plan(self) -> Path:
        """The application file of the general plan."""
        return self.folder / PLAN_FILE

    @property
    def example(self) -> Path | None:
        """The program of a project without sources, of `files_of` if the package has none there; None: no project."""
        if self.project is None:
            return None
        folders = [self.folder] if self.files_of is None else [self.folder, self.files_of.folder]
        found = (folder / self.project.example for folder in folders)
        return next((path for path in found if path.exists()), self.folder / self.project.example)

    @property
    def target(self) -> Path | None:
        """The target file of the package; None: the application chooses a target."""
        path = self.folder / TARGET_FILE
        return path if is_file(path) else None

    def place_of(self, path: str) -> tuple[str, ...] | None:
        """Return where a file of the output folder goes: (), if it is left out; None: no item of `layout` fits."""
        for place in self.layout:
            if path.startswith(place.prefix):
                return () if place.to is None else (f"{place.to}{path.removeprefix(place.prefix)}",)
        return None

    def conditions_of(self, path: str) -> Conditions:
        """Return the conditions of a file below files/."""
        own = tuple(each for prefix, when in self.conditions if path.startswith(prefix) for each in when)
        return own if self.files_of is None else self.files_of.conditions_of(path) + own

    def own_files(self) -> dict[str, Path]:
        """Return the files below files/ by their paths there, those of `files_of` included."""
        folder = self.folder / FILES_FOLDER
        own = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}
        replaced = {name.removesuffix(".j2") for name in own}
        taken = {} if self.files_of is None else self.files_of.own_files()
        files = {name: path for name, path in taken.items() if name.removesuffix(".j2") not in replaced}
        files |= own
        return files


def files_of(source: Source) -> tuple[str, Span | None]:
    """Return what `files_of` of a package.yaml says, and where: the name of a package, or an empty text."""
    tree = parse_yaml(source, Diagnostics())
    node = tree.get("files_of") if isinstance(tree, MappingNode) else None
    return (text_of(node) or "", node.span) if node is not None else ("", None)


def parse_package(
    source: Source,
    folder: Path,
    origin: str,
    diagnostics: Diagnostics,
    base: PackageDescription | None = None,
) -> PackageDescription | None:
    """Return the package that `source`, in `folder`, describes; None and errors in `diagnostics` if it is wrong.

    `base` is the package that its `files_of` names.
    """
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not found.has_errors():
        validate(tree, source, load_schema(SCHEMA), found)
    diagnostics.extend(found)
    if found.has_errors() or not isinstance(tree, MappingNode):
        return None
    name = child_text(tree, "package")
    if name != folder.resolve().name:
        node = tree.entries["package"].value
        hint = f"Write `package: {folder.resolve().name}`, or rename the folder"
        diagnostics.error(
            f"the folder of the package '{name}' has another name", node.span, hint, id="MG-9202"
        )
        return None
    layout = items(tree.get("layout"))
    return PackageDescription(
        name=name,
        summary=child_text(tree, "summary"),
        library=child_text(tree, "library"),
        folder=folder,
        archive=child_text(tree, "archive") or ARCHIVES[0],
        next_folder=child_text(tree.get("next"), "folder"),
        next_archive=child_text(tree.get("next"), "archive"),
        transports=tuple(text_of(item) or "" for item in items(tree.get("transports"))),
        defines=tuple(text_of(item) or "" for item in items(tree.get("defines"))),
        layout=tuple(Place(child_text(item, "from"), _to(item)) for item in layout),
        conditions=tuple((e.key, conditions_of(e.value)) for e in entries(tree.get("files"))),
        project=parse_project(tree.get("project")),
        origin=origin,
        files_of=base,
        tools=tuple(map(_tool, items(tree.get("tools")))),
    )


def _tool(node: YamlNode) -> Tool:
    programs, debian = (
        tuple(text_of(item) or "" for item in items(child(node, key))) for key in ("programs", "debian")
    )
    return Tool(programs, child_text(node, "variable"), debian, child_text(node, "remedy"))


def _to(item: object) -> str | None:
    return text_of(item.get("to")) if isinstance(item, MappingNode) else None
