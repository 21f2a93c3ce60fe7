# SPDX-License-Identifier: Apache-2.0
"""A target file → Target."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.model.target import Target
from microros_gen.parse.tree_read import check_keys, expect_mapping, read_names, read_text
from microros_gen.parse.tree_values import bool_of
from microros_gen.parse.yaml_tree import MappingNode, parse_yaml

_REQUIRED = ("target", "summary", "port", "compilers", "archivers", "package")
_OPTIONAL = ("c_flags", "link_flags", "libraries", "image_suffix", "hosted")


def parse_target(source: Source, diagnostics: Diagnostics) -> Target | None:
    """Return the target that `source` describes; None and errors in `diagnostics` where it is not one."""
    node = expect_mapping(parse_yaml(source, diagnostics), "a target file", diagnostics)
    if node is None:
        return None
    check_keys(node, (*_REQUIRED, *_OPTIONAL), _REQUIRED, diagnostics)
    return Target(
        name=read_text(node, "target", diagnostics),
        summary=read_text(node, "summary", diagnostics),
        port=read_text(node, "port", diagnostics),
        compilers=_list(node, "compilers", diagnostics),
        archivers=_list(node, "archivers", diagnostics),
        package=read_text(node, "package", diagnostics),
        c_flags=_list(node, "c_flags", diagnostics),
        link_flags=_list(node, "link_flags", diagnostics),
        libraries=_list(node, "libraries", diagnostics),
        image_suffix=read_text(node, "image_suffix", diagnostics),
        hosted=bool_of(node.get("hosted")) or False,
    )


def _list(node: MappingNode, key: str, diagnostics: Diagnostics) -> tuple[str, ...]:
    return tuple(item.name for item in read_names(node, key, diagnostics))
