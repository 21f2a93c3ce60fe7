# SPDX-License-Identifier: Apache-2.0
"""The Jinja2 environment of every template: strict, no escaping, no clean-up of the output afterwards."""

from __future__ import annotations

import marshal
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from itertools import chain
from pathlib import Path

from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined, TemplateError
from jinja2.bccache import Bucket

from microros_gen.documents.ahead import Ahead, compute_ahead

_PACKAGE = Path(__file__).resolve().parent.parent
TEMPLATE_FOLDERS = (_PACKAGE / "templates", _PACKAGE / "components", _PACKAGE / "platform")
"""Where templates are found: `types/struct.h.j2`, `publish/src/rcl_publisher.c.j2`, `os/NAME/src/image.ld.j2`."""

COMMON = (
    "types/steps.j2",
    "types/struct.h.j2",
    "types/functions.h.j2",
    "types/functions.c.j2",
    "types/type_support.h.j2",
    "types/type_support.c.j2",
    "types/message.h.j2",
    "example/main.c.j2",
    "project/README.md.j2",
    "project/CMakeLists.txt.j2",
    "project/sources.txt.j2",
    "project/unselected.h.j2",
    "project/microros_image.cmake",
)
"""Templates that every project prints."""

_COMMON_COMPONENT = re.compile(rb"^common: true$", re.MULTILINE)
"""Its line in a component.yaml, which the second process looks for while the first one still parses these files."""


def make_environment(folders: Sequence[Path] = TEMPLATE_FOLDERS) -> Environment:
    """Return a new environment that finds templates below `folders`.

    A name that a template uses and its view lacks is an error. The files of an installed package do not change during
    a run, so they are not looked at again once compiled.
    """
    return Environment(
        loader=FileSystemLoader([str(folder) for folder in folders]),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        optimized=False,  # folding constants takes longer than it saves: most templates are printed once
        auto_reload=False,
    )


@cache
def shared_environment() -> Environment:
    """Return the environment over TEMPLATE_FOLDERS, made once: compiled templates are kept in it."""
    environment = make_environment()
    environment.bytecode_cache = _compiled_templates()
    return environment


@cache
def _compiled_templates() -> _CompiledTemplates:
    """Return what the shared environment keeps of compiled templates."""
    return _CompiledTemplates()


def compile_ahead(path: Path) -> None:
    """Let another process compile what every project prints, where no earlier run has left it in the file `path`.

    Compiling takes a third of such a run; `compiled_before` takes the result. An early call leaves it
    more time, and less memory to copy.
    """
    if not path.exists():
        _compiled_templates().ahead = compute_ahead(_compile_common)


def compile_also(names: Iterable[str]) -> None:
    """Let the process of `compile_ahead`, if there is one, compile these templates, too."""
    ahead = _compiled_templates().ahead
    if ahead is not None:
        ahead.ask(names)


def templates_below(*folders: str, top: Path = TEMPLATE_FOLDERS[0]) -> Iterator[str]:
    """Yield the names of the templates below these folders of `top`, in order."""
    for folder in folders:
        yield from (path.relative_to(top).as_posix() for path in sorted((top / folder).rglob("*.j2")))


def common_templates(components: Path = TEMPLATE_FOLDERS[1]) -> Iterator[str]:
    """Yield the names of the templates of the components below a folder that nearly every project has."""
    for path in sorted(components.glob("*/component.yaml")):
        if _COMMON_COMPONENT.search(path.read_bytes()):
            yield from templates_below(path.parent.name, top=components)


def _compile_common(requested: Iterable[str]) -> Mapping[str, bytes]:
    environment = shared_environment()
    for name in chain(COMMON, common_templates(), requested):
        with suppress(TemplateError):  # this process stops at what is wrong in it, if it uses the template
            environment.get_template(name)
    return _compiled_templates().known


@contextmanager
def compiled_before(path: Path) -> Iterator[Environment]:
    """Yield the shared environment, which takes from the file `path` what earlier runs have compiled.

    What the file lacks is added to it afterwards; a failure loses only time.
    """
    compiled = _compiled_templates()
    names = compiled.read(path)
    yield shared_environment()
    compiled.write(path, names)


class _CompiledTemplates(BytecodeCache):
    """Compiled templates by name, all in one file: Jinja's own cache writes one for each, as slow as compiling."""

    def __init__(self) -> None:
        self.known: dict[str, bytes] = {}
        self.ahead: Ahead | None = None
        """The process that compiles some of them."""

    def load_bytecode(self, bucket: Bucket) -> None:
        """Give `bucket` what is known; it checks the text of the template and the version of Python itself."""
        known = self.known.get(bucket.key)
        if isinstance(known, bytes):
            with suppress(ValueError, EOFError, TypeError):
                bucket.bytecode_from_string(known)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Take over what was compiled now."""
        self.known[bucket.key] = bucket.bytecode_to_string()

    def read(self, path: Path) -> dict[str, bytes]:
        """Take over what a file has, and return it; what this process has compiled is newer."""
        found: dict[str, bytes] = {}
        with suppress(OSError, ValueError, EOFError, TypeError):
            found = dict(marshal.loads(path.read_bytes()))
        if self.ahead is not None:
            self.known |= self.ahead.take()
            self.ahead = None
        self.known = found | self.known
        return found

    def write(self, path: Path, found: Mapping[str, bytes]) -> None:
        """Replace a file that had `found` where there is more than that."""
        if found == self.known:
            return
        temporary = path.with_suffix(f".{os.getpid()}.tmp")
        with suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            temporary.write_bytes(marshal.dumps(self.known))
            temporary.replace(path)
