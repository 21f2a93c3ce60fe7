# SPDX-License-Identifier: Apache-2.0
"""The budgets of the application file against what an image takes, and what would bring it down.

Advice is made of sizes of this image, or of the plan made again with one value changed (`build` stores those).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from microros_gen.documents.files import read_json
from microros_gen.image.attribution import Chunk
from microros_gen.image.entities import MESSAGE_STORAGE, RamPart
from microros_gen.image.folder import Folder
from microros_gen.image.stack import Bound, StackReport
from microros_gen.records import dataclass
from microros_gen.toolchain.compile import OBJECTS

ADVICE = f"{OBJECTS}/advice.json"
_LIBRARY = ("component", "type support")
_MOST = 3
_MEMORY = "in `memory:`"


@dataclass(frozen=True)
class Advice:
    """Lines of the application file, where they go (empty: at the top level), and what they save at most, bytes.

    `exact`: built again with them.
    """

    change: str
    place: str
    saves: int
    exact: bool


@dataclass(frozen=True)
class BudgetLine:
    """A budget: bytes used and allowed; `what` says what is counted, `place` where the budget is set.

    `largest` are the contributors, `advice` what would help; both only where the budget is exceeded.
    """

    key: str
    what: str
    used: int
    budget: int
    place: str | None
    largest: tuple[tuple[str, int], ...] = ()
    advice: tuple[Advice, ...] = ()

    @property
    def exceeded(self) -> bool:
        """Whether more is used than allowed."""
        return self.used > self.budget

    @property
    def percent(self) -> float:
        """Part of the budget that is used."""
        return round(100 * self.used / self.budget, 1) if self.budget else 100.0


def budget_lines(
    folder: Folder, chunks: Sequence[Chunk], parts: Sequence[RamPart], stack: StackReport
) -> tuple[BudgetLine, ...]:
    """Return a line for each budget of the application; that of the stack only where a bound is known.

    Storage of messages that are sent counts in an image: a library alone has it for functions that may never be called.
    """
    budgets = folder.manifest["memory"]
    where = "in the image" if folder.image is not None else "of the library, before unused parts are dropped"
    found = []
    if "ram_budget" in budgets:
        counted = [p for p in parts if p.group in _LIBRARY and (folder.image or p.use != MESSAGE_STORAGE)]
        uses = _sum((p.use, p.size) for p in counted)
        advice = (*planned_advice(folder), *_ram_advice(folder, parts))
        found.append(_line(budgets, "ram_budget", f"static RAM {where}", uses, advice))
    if "flash_budget" in budgets:
        sizes = _sum((p.owner.name, p.flash) for p in chunks if p.owner.group in _LIBRARY)
        found.append(_line(budgets, "flash_budget", f"flash {where}", sizes, _flash_advice(folder, chunks)))
    if "stack" in budgets and stack.known:
        found.append(_stack_line(budgets, stack))
    return tuple(found)


def store_advice(folder: Folder, advice: Iterable[Advice]) -> None:
    """Keep what `build` planned, for `size`."""
    data = {"plan": folder.manifest["plan"], "advice": [asdict(a) for a in advice]}
    (folder.path / ADVICE).parent.mkdir(exist_ok=True)
    (folder.path / ADVICE).write_text(json.dumps(data, sort_keys=True), encoding="utf-8", newline="\n")


def planned_advice(folder: Folder) -> tuple[Advice, ...]:
    """Return what `build` stored for this plan."""
    try:
        data = read_json(folder.path / ADVICE, follow=False)
        if data["plan"] != folder.manifest["plan"]:
            return ()
        return tuple(
            Advice(str(a["change"]), str(a["place"]), int(a["saves"]), bool(a["exact"]))
            for a in data["advice"]
        )
    except (OSError, ValueError, KeyError, TypeError):
        return ()


def exceeded_message(line: BudgetLine) -> str:
    """Return what a diagnostic says of an exceeded budget."""
    names = ", ".join(f"{name} {size}" for name, size in line.largest)
    joined = "largest" if line.key != "stack" else "worst chain"
    return f"{line.what}: {line.used} bytes, and memory.{line.key} is {line.budget} ({joined}: {names})"


def advice_hint(line: BudgetLine) -> str:
    """Return the hint of an exceeded budget, which precedes the lines of advice."""
    if line.key == "stack":
        name, most = max(line.largest, key=lambda part: part[1], default=("", 0))
        return f"Set memory.stack: {line.used}, or shorten the chain: {name} alone takes {most}"
    if not line.advice:
        return "Raise the budget, or declare less"
    return f"Set {'this' if len(line.advice) == 1 else 'some of these'}, or raise the budget:"


def advice_lines(line: BudgetLine, keys: Mapping[str, int]) -> tuple[str, ...]:
    """Return the lines to paste, each with its place and what it saves.

    `keys` are the lines of the application file's top-level keys, which its advice replaces.
    """
    return tuple(text for advice in line.advice for text in _pasted(advice, keys).splitlines())


def _pasted(advice: Advice, keys: Mapping[str, int]) -> str:
    key = advice.change.partition(":")[0]
    place = advice.place or (f"instead of line {keys[key]}" if key in keys else "")
    saves = f"saves {'' if advice.exact else 'up to '}{advice.saves} bytes"
    return f"{advice.change}  # {place}{', ' if place else ''}{saves}"


def _line(
    budgets: Mapping[str, Any], key: str, what: str, sizes: Mapping[str, int], advice: Iterable[Advice]
) -> BudgetLine:
    used, allowed = sum(sizes.values()), int(budgets[key]["bytes"])
    line = BudgetLine(key, what, used, allowed, budgets[key]["place"])
    if not line.exceeded:
        return line
    largest = tuple(sorted(sizes.items(), key=lambda s: (-s[1], s[0]))[:_MOST])
    useful = tuple(sorted((a for a in advice if a.saves > 0), key=lambda a: (-a.saves, a.change, a.place)))
    return BudgetLine(key, what, used, allowed, line.place, largest, useful)


def _stack_line(budgets: Mapping[str, Any], stack: StackReport) -> BudgetLine:
    heaviest: Bound | None = stack.main or (stack.functions[0] if stack.functions else None)
    allowed, place = int(budgets["stack"]["bytes"]), budgets["stack"]["place"]
    what = f"worst stack from {heaviest.name}" if heaviest else "worst stack"
    if stack.handlers:
        what += f" with {len(stack.handlers)} interrupt handler(s) on top"
    line = BudgetLine("stack", what, stack.total, allowed, place)
    if not line.exceeded or heaviest is None:
        return line
    chain = tuple((link.name, link.frame) for link in heaviest.chain)
    chain += tuple((f"interrupt {b.name}", b.bytes) for b in stack.handlers)
    chain += (("hardware", stack.hardware),) if stack.hardware else ()
    return BudgetLine("stack", what, stack.total, allowed, place, chain)


def _ram_advice(folder: Folder, parts: Iterable[RamPart]) -> tuple[Advice, ...]:
    uses = _sum((p.use, p.size) for p in parts if p.group == "component")
    pools, found = folder.manifest["pools"], []
    if pools["error_text"]:
        found.append(Advice("errors: code", "", uses.get("error text", 0), False))
    kept = int(folder.manifest.get("message_storage", {}).get("messages", 0))
    if kept and MESSAGE_STORAGE in uses:
        saves = uses[MESSAGE_STORAGE] // kept
        found.append(Advice(f"messages: {kept - 1}", _MEMORY, saves, False))
    if pools["arena"]:
        found.append(Advice("arena: 0", _MEMORY, int(pools["arena"]), False))
    return (
        *found,
        *_component_advice(folder, _sum((p.owner, p.size) for p in parts if p.group == "component")),
    )


def _flash_advice(folder: Folder, chunks: Sequence[Chunk]) -> tuple[Advice, ...]:
    found = []
    if folder.manifest["pools"]["error_text"]:
        text = sum(p.flash for p in chunks if p.source == "src/support/error_text.c")
        found.append(Advice("errors: code", "", text, False))
    sizes = _sum((p.owner.name, p.flash) for p in chunks if p.owner.group == "component")
    return (*found, *_component_advice(folder, sizes))


def _component_advice(folder: Folder, sizes: Mapping[str, int]) -> tuple[Advice, ...]:
    """Return the choices of axes that would leave a component out, with what it takes now."""
    created = {n: s for n, s in sizes.items() if n.startswith("entities")}
    selection, found = folder.manifest["selection"], []
    if selection["liveliness"] == "ping" and selection["entities"] != "preconfigured":
        found.append(Advice("liveliness: none", "", sizes.get("ping", 0), False))
    if selection["liveliness"] == "acknack":
        found.append(Advice("liveliness: none", "", sizes.get("liveliness_acknack", 0), False))
    if selection["entities"] != "preconfigured":
        found.append(Advice("entities: preconfigured", "", sum(created.values()), False))
    publishers = folder.manifest["entities"]["publishers"]
    if any(p["reliable"] for p in publishers):
        take = sizes.get("stream_reliable", 0)
        found.append(Advice("qos: {reliability: best_effort}", "at every publisher", take, False))
    return tuple(found)


def _sum(items: Iterable[tuple[str, int]]) -> dict[str, int]:
    found: dict[str, int] = {}
    for name, size in items:
        found[name] = found.get(name, 0) + size
    return found
