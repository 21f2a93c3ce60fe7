# SPDX-License-Identifier: Apache-2.0
"""board.yaml of a board part: keys of a target file that hold for the board, whatever else the target consists of."""

from __future__ import annotations

from pathlib import Path

from microros_gen.diagnostics import Diagnostics, Source, Span
from microros_gen.documents.files import is_file, read_text
from microros_gen.documents.yaml_tree import MappingNode, parse_yaml
from microros_gen.platform.part_file import read_part
from microros_gen.platform.target_file import SCHEMA
from microros_gen.selection.extension import Extensions

BOARD_FILE = "board.yaml"
BOARD_KEYS = (
    "clock_hz",
    "flash",
    "ram",
    "memories",
    "uart",
    "unique_id",
    "interrupts",
    "registers",
    "hooks",
    "stdio",
    "emulator",
)
"""Keys of a target file that belong to the board; compiler, flags and other parts do not."""


def board_facts(
    name: str, near: Path, span: Span | None, diagnostics: Diagnostics, extensions: Extensions
) -> MappingNode | None:
    """Return what the board.yaml of the board part `name` says; None: there is no such file.

    Errors in it go to `diagnostics`. A part that cannot be read is reported where the target's parts are read.
    """
    part = read_part("board", name, near, span, Diagnostics(), extensions)
    path = part.component.folder / BOARD_FILE if part is not None else None
    if path is None or not is_file(path):
        return None
    from microros_gen.documents.schema import load_schema, validate

    try:
        source = Source(str(path), read_text(path))
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        diagnostics.error(f"cannot read '{path}': {reason}", span, id="MG-6031")
        return None
    found = Diagnostics()
    tree = parse_yaml(source, found)
    if not found.has_errors():
        schema = load_schema(SCHEMA)
        properties = {key: schema["properties"][key] for key in BOARD_KEYS}
        validate(tree, source, {**schema, "properties": properties, "required": []}, found)
    diagnostics.extend(found)
    return tree if isinstance(tree, MappingNode) and not found.has_errors() else None
