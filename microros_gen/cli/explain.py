# SPDX-License-Identifier: Apache-2.0
"""`microros-gen explain`: why something is in the image, or what a diagnostic means."""

from __future__ import annotations

import dataclasses
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from microros_gen.cli.offers import output_or_id
from microros_gen.cli.options import check_map, format_option, image_option, map_option
from microros_gen.diagnostics import Diagnostic, UserError
from microros_gen.diagnostics.explanations import explanations

if TYPE_CHECKING:
    from microros_gen.image.explain import Explanation


@click.command()
@click.argument("out", metavar="OUT|ID", type=click.Path(path_type=Path), shell_complete=output_or_id)
@click.argument("what", metavar="[SYMBOL|FILE|COMPONENT]", required=False)
@image_option("Your own image to explain, linked with the library of OUT. Default: the image that was built.")
@map_option
@format_option
def command(out: Path, what: str | None, image: Path | None, linker_map: Path | None, kind: str) -> None:
    """Show where SYMBOL, FILE or COMPONENT of OUT comes from and why it is there, or what the diagnostic ID means.

    OUT is a folder that `build` wrote, or a CMake build folder with its own image. A unique prefix of a symbol and the
    name of a file without its folder are sufficient; types (pkg/msg/Type) are accepted, too. For something that is
    not in the image, the answer says what would add it. An ID is at the end of the first line of each error or
    warning.

    \b
    microros-gen explain build/pure_sender rcl_publish
    microros-gen explain build/pure_sender xrce_stream_reliable.c
    microros-gen explain build/pure_sender ping
    microros-gen explain build/pure_sender rcl/timer.h
    microros-gen explain my_robot/build rclc_executor_spin
    microros-gen explain MG-5013
    """
    check_map(image, linker_map)
    if what is None:
        click.echo(_diagnostic(str(out), kind))
        return
    from microros_gen.image.explain import Explainer
    from microros_gen.image.report import measure
    from microros_gen.selection.find_components import load_catalogue

    catalogue = load_catalogue()

    def sources_of(component: str) -> Iterator[bytes]:
        folder = catalogue[component].folder if component in catalogue else Path(component)
        for path in sorted((folder / "src").glob("*.c*")):
            yield path.read_bytes()

    explanation = Explainer(measure(out, image, linker_map), catalogue, sources_of).explain(what)
    if kind == "json":
        data = dataclasses.asdict(explanation)
        data["holds"] = [{"name": name, "bytes": size} for name, size in explanation.holds]
        click.echo(json.dumps({"version": 1, **data}, indent=2, sort_keys=True, ensure_ascii=False))
    else:
        click.echo(_text(explanation), nl=False)


def _diagnostic(identity: str, kind: str) -> str:
    """Return the explanation of a diagnostic as text or JSON."""
    identity = identity.strip("[]").upper()
    if not re.fullmatch(r"MG-\d+", identity):
        raise click.UsageError("Missing argument 'SYMBOL|FILE|COMPONENT'.")
    known = explanations()
    if identity not in known:
        message = f"unknown diagnostic id '{identity}'"
        hint = "It ends the first line of an error or warning"
        raise UserError([Diagnostic(message, hint=hint, id="MG-9723")])
    if kind == "json":
        data = {"version": 1, "kind": "diagnostic", "name": identity, "explanation": known[identity]}
        return json.dumps(data, indent=2, sort_keys=True, ensure_ascii=False)
    return f"{identity}: {known[identity]}"


def _text(found: Explanation) -> str:
    sizes = (
        f"{found.flash} bytes of flash, {found.ram} of RAM" if found.present else "nothing of it in the image"
    )
    lines = [(found.kind, found.name)]
    lines += [("of", found.of)] if found.of and found.of != found.name else []
    lines += [("place", found.place)] if found.place and found.place != found.name else []
    lines += [("size", sizes)]
    lines += [("note", found.note)] if found.note else []
    for title, texts in (
        ("selected", found.reasons),
        ("needed for", found.entities),
        ("removed by" if len(found.removes) < 2 else "removed by all of", found.removes),
        ("or by", found.choices),
    ):
        lines += [(title if i == 0 else "", text) for i, text in enumerate(texts)]
    if len(found.chain) > 1:
        lines.append(("reached", " → ".join(found.chain)))
    lines += [("holds" if i == 0 else "", f"{size:>6}  {name}") for i, (name, size) in enumerate(found.holds)]
    return "".join(f"{title:<17} {text}".rstrip() + "\n" for title, text in lines)
