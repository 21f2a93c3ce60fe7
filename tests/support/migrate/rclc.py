# SPDX-License-Identifier: Apache-2.0
"""What is proposed for sources of rclc."""

from __future__ import annotations

from functools import cache

from microros_gen.diagnostics import Diagnostics, Source
from microros_gen.migrate.rclc_draft import Adopted, rclc_draft
from microros_gen.selection.component import Catalogue
from microros_gen.selection.find_components import declared_functions, load_catalogue

NODE = 'rclc_node_init_default(&node, "n", "", &support);'


@cache
def catalogue() -> Catalogue:
    return load_catalogue()


def adopted(*texts: str) -> Adopted:
    diagnostics = Diagnostics()
    sources = [Source(f"{index}.c", text) for index, text in enumerate(texts)]
    found = rclc_draft(sources, declared_functions(catalogue()), catalogue(), diagnostics)
    diagnostics.check()
    return found


def program(body: str, before: str = "") -> str:
    return f"{before}\nint main(void)\n{{\n  {NODE}\n  {body}\n}}\n"


def reasons(*texts: str) -> list[str]:
    return [f"{r.span}: {r.text}" for r in adopted(*texts).draft.all_remarks if r.undecided]
