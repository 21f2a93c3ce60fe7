# SPDX-License-Identifier: Apache-2.0
"""The key `stdio` of a target file: where printf and the log writer `console` go."""

from __future__ import annotations

from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.tree_values import bool_of, child, int_of, text_of
from microros_gen.documents.yaml_tree import MappingNode, YamlNode
from microros_gen.platform.part import Part
from microros_gen.platform.target import Stdio, Target


def read_stdio(node: YamlNode | None, parts: tuple[Part, ...]) -> Stdio | None:
    """Return where standard output goes; None: the application provides what its C library needs."""
    if node is None:
        return None
    base, baud, irq = (int_of(child(node, key)) for key in ("base", "baud", "irq"))
    driver = text_of(child(node, "driver")) or Stdio.driver
    floats = bool_of(child(node, "floats")) or False
    interrupt = None if irq is None else irq + tx_offset(driver, parts)
    return Stdio(text_of(child(node, "to")) or "", driver, base or 0, baud or Stdio.baud, floats, interrupt)


def tx_offset(driver: str, parts: tuple[Part, ...]) -> int:
    """Return the number of a driver's transmit interrupt after the one that receives."""
    known = (part.cpu.driver(driver) for part in parts if part.cpu is not None)
    return next((found.tx_irq for found in known if found is not None), 0)


def check_stdio(node: MappingNode, target: Target, diagnostics: Diagnostics) -> None:
    """Report keys that do not belong together, and what the processor does not have."""
    stdio = node.get("stdio")
    to = text_of(child(stdio, "to"))
    for key in ("driver", "base", "baud", "irq"):
        found = child(stdio, key)
        if found is not None and to != "uart":
            diagnostics.error(
                f"stdio: {to} has no `{key}`", found.span, f"Remove `{key}`, or use to: uart", id="MG-6026"
            )
        if found is None and to == "uart" and key in ("driver", "base"):
            diagnostics.error(
                f"missing key '{key}' in 'stdio'", (stdio or node).span, f"Add `{key}: …`", id="MG-6027"
            )
    irq = child(stdio, "irq")
    if irq is not None and target.cpu.image is not None and not target.cpu.image.console_handler:
        text = f"'stdio.irq' has no effect: {target.cpu_name} sends standard output without interrupts"
        hint = "Remove `irq`, or add `console_handler: …` to `image` in its cpu.yaml"
        diagnostics.error(text, irq.span, hint, id="MG-6033")
    floats = child(stdio, "floats")
    if floats is not None and not target.cpu.stdio_heap:
        name = target.cpu_name
        text = f"'stdio.floats' has no effect with {name}: its C library, picolibc, always formats %f"
        diagnostics.error(text, floats.span, "Remove `floats`", id="MG-6028")
    driver = child(stdio, "driver")
    drivers = [item.name for item in target.cpu.drivers if item.stdio]
    if driver is not None and to == "uart" and text_of(driver) not in drivers:
        hint = f"Its drivers for output are: {', '.join(drivers) or 'none'}. With `to: application` the program has one"
        diagnostics.error(
            f"{target.cpu_name} has no driver '{text_of(driver)}'", driver.span, hint, id="MG-6029"
        )
