# SPDX-License-Identifier: Apache-2.0
"""What mkdocs does for this site besides Markdown: generated pages and pictures, files that pages link to.

A page says `../examples/…`, as it has to where the repository is browsed; the site gets a copy of such a file below
`files/`, or, for a page of OUTSIDE, its own page.
"""

from __future__ import annotations

import posixpath
import re
from functools import cache
from pathlib import Path
from typing import Any

from generators import c_api, command_line, diagnostics, error_texts, pictures, python_api, schemas
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from microros_gen.agent.configuration import parser as agent_parser
from microros_gen.agent.policy import parser as policy_parser
from microros_gen.application import parser as application_parser
from microros_gen.application import system_file
from microros_gen.platform import target_file
from microros_gen.selection import profile_file

ROOT = Path(__file__).resolve().parents[1]
OUTSIDE = {"README.md": "overview.md", "examples/README.md": "examples.md"}
"""Markdown outside of docs/ that is part of the site, and its page."""

_LINK = re.compile(r"(?<=\]\()(?!https?:|#|mailto:)([^)#\s]+)(#[^)\s]*)?(?=\))")
_SCHEMAS = {
    "application": (
        "microros.yaml",
        "The application file: what is selected, declared, and what it may cost.",
    ),
    "system": ("System file", "Boards that exchange messages without an agent ([how](../howto/peer.md))."),
    "profile": ("Profile file", "A profile of your own ([how](../howto/profile.md)), or one of profiles/."),
    "target": ("Target file", "A processor or a board of your own ([how](../howto/port.md))."),
    "agent": (
        "Configuration of the agent",
        "What `microros-gen agent --config FILE` takes ([more](../howto/agent.md)).",
    ),
    "policy": ("Policy file", "What clients of the agent may do ([how](../howto/access_control.md))."),
}

SCHEMA_FILES = {
    "application": application_parser.SCHEMA,
    "system": system_file.SCHEMA,
    "profile": profile_file.SCHEMA,
    "target": target_file.SCHEMA,
    "agent": agent_parser.SCHEMA,
    "policy": policy_parser.SCHEMA,
}


@cache
def generated() -> dict[str, str]:
    """Return the pages that are made from the code: path below docs/ → Markdown."""
    pages = {
        "reference/command_line.md": command_line.page(),
        "reference/diagnostics.md": diagnostics.page(),
        "reference/error_texts.md": error_texts.page(),
        "reference/python_api.md": python_api.page(),
    }
    for name, (title, introduction) in _SCHEMAS.items():
        pages[f"reference/{name}_file.md"] = schemas.page(title, introduction, SCHEMA_FILES[name])
    return pages | {f"reference/c/{name}.md": text for name, text in c_api.pages().items()}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the generated pages, those of OUTSIDE, and what pages link to."""
    for path, text in generated().items():
        files.append(File.generated(config, path, content=text))
    for origin, path in OUTSIDE.items():
        files.append(File.generated(config, path, content=(ROOT / origin).read_text(encoding="utf-8")))
    for file in [file for file in files if file.is_documentation_page()]:
        for link, _ in _LINK.findall(file.content_string):
            target = _target(link, _origin(file.src_uri))
            if target and target.startswith("files/") and files.get_file_from_path(target) is None:
                files.append(File.generated(config, target, abs_src_path=str(ROOT / target[len("files/") :])))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Let links to files of the repository lead to their copies in the site."""
    here = page.file.src_uri
    origin = _origin(here)

    def moved(found: re.Match[str]) -> str:
        target = _target(found[1], origin)
        if target is None:
            return found[0]
        return posixpath.relpath(target, posixpath.dirname(here) or ".") + (found[2] or "")

    return _LINK.sub(moved, markdown)


def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Put in the pictures."""
    return pictures.insert(html)


def on_page_context(context: dict[str, Any], page: Page, config: MkDocsConfig, nav: Any) -> None:
    """Leave out the time of the build, which would make two builds differ."""
    context["build_date_utc"] = "left out"


def on_post_build(config: MkDocsConfig) -> None:
    """Write the index of the search as a script, too: a page opened from disk may load no other file."""
    folder = Path(config.site_dir) / "search"
    index = (folder / "search_index.json").read_text(encoding="utf-8")
    (folder / "search_index.js").write_text(f"var __index = {index}", encoding="utf-8", newline="\n")


def _origin(path: str) -> str:
    """Return where a page of the site lies in the repository."""
    return next((origin for origin, page in OUTSIDE.items() if page == path), f"docs/{path}")


def _target(link: str, origin: str) -> str | None:
    """Return the path in the site that a link leads to, or None where it is mkdocs' own matter."""
    path = posixpath.normpath(posixpath.join(posixpath.dirname(origin), link))
    if path in OUTSIDE:
        return OUTSIDE[path]
    if path.startswith("docs/"):
        return path.removeprefix("docs/") if origin in OUTSIDE else None
    return f"files/{path}" if (ROOT / path).is_file() else None
