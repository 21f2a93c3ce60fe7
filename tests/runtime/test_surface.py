# SPDX-License-Identifier: Apache-2.0
"""The generated headers against `surface.yaml`: names, prototypes, members, constants, and that all of it links.

The same facts are held against the headers of ROS 2's wheels, so that neither side can be wrong alone.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest
import yaml

from tests.support.runtime.harness import compile_merged, compile_objects, link
from tests.support.runtime.surface import PLANNED, SERVICES, generate
from tests.support.slices import first

SURFACE = yaml.safe_load((Path(__file__).parent / "surface.yaml").read_text(encoding="utf-8"))
ELSEWHERE = {
    "udp": {"rmw_uros_options_set_udp_address"},
    "serial": {"rmw_uros_options_set_serial_device"},
    "custom": set[str](),
}
"""Functions that only one transport has; everything else is there with each."""


def prototypes(*sources: str) -> dict[str, list[tuple[str, str]]]:
    """Return name and prototype of each function, by header; planned components left out."""
    found: dict[str, list[tuple[str, str]]] = {}
    for source in sources:
        for header, lines in SURFACE[source].items():
            named = [(re.search(r"(\w+)\(", line.replace("(*", "("))[1], line) for line in lines]  # type: ignore[index]
            kept = [(n, p) for n, p in named if SERVICES or not re.search(r"_(client|service)", n)]
            if header not in PLANNED and kept:
                found[header] = kept
    return found


def declared(functions: dict[str, list[tuple[str, str]]]) -> str:
    """Return C that compiles where every header declares its functions so; the table is what a linker must find."""
    each = [pair for pairs in functions.values() for pair in pairs]
    lines = [f"#include <{header}>" for header in functions] + ["#include <stdarg.h>"]
    lines += ["typedef void (*any_t)(void);", "extern const any_t surface[];", "const any_t surface[] = {"]
    lines += [f"  (any_t){name}," for name, _ in each] + ["};"]
    lines += [
        f"extern {prototype};" for _, prototype in each
    ]  # a second declaration must have the first one's type
    return "\n".join(lines) + "\n"


def known(members: bool, headers: Iterable[str]) -> str:
    """Return C that compiles where members, names and constants are what the file says."""
    generated = set(headers)
    lines = ["#include <stdint.h>", *(f"#include <{h}>" for h in sorted(generated))]
    if members:
        for header, structs in SURFACE["members"].items():
            for struct, declarations in structs.items() if header in generated else ():
                for index, declaration in enumerate(declarations):
                    name = re.search(r"\(\*(\w+)\)|(\w+)(?:\[\d+\])?$", declaration)
                    assert name, declaration
                    member = name[1] or name[2]
                    probe = re.sub(rf"\b{member}\b(?=\)|(\[\d+\])?$)", "(*probe)", declaration)
                    lines.append(
                        f"void is_{struct}_{index}({struct} * s); void is_{struct}_{index}({struct} * s) "
                        f"{{ {probe} = &s->{member}; (void)probe; }}"
                    )
    texts = [
        c
        for c in SURFACE["constants"]
        if not re.match(r"(RCLC_|ON_NEW|ALWAYS)", c) or "rclc/executor.h" in generated
    ]
    lines += [f"typedef char constant_{i}[({text}) ? 1 : -1];" for i, text in enumerate(texts)]
    lines += ["int main(void) {"]
    lines += [f"  (void)({e});" for h, es in SURFACE["names"].items() if h in generated for e in es] + [
        "  return 0;",
        "}",
    ]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("transport", first(["custom", "udp", "serial"], 2))
def test_every_function_has_its_prototype_and_links(tmp_path: Path, transport: str) -> None:
    tree = generate(tmp_path / transport, transport)
    absent = set.union(*(names for which, names in ELSEWHERE.items() if which != transport))
    functions = {
        header: kept
        for header, pairs in prototypes("ros", "micro_ros").items()
        if (kept := [pair for pair in pairs if pair[0] not in absent])
        and (header != "rmw_microros/discovery.h" or transport == "udp")
        and (header != "rmw_microros/custom_transport.h" or transport == "custom")
    }
    uses, facts = tree.folder / "uses.c", tree.folder / "facts.c"
    uses.write_text(declared(functions), encoding="utf-8")
    headers = {*functions, *SURFACE["members"], *SURFACE["names"]} - PLANNED
    if transport != "custom":
        headers -= {"uxr/client/transport.h"}
    facts.write_text(known(True, headers), encoding="utf-8")
    flags = ("-O0", "-Wno-redundant-decls", "-Wno-cast-function-type")
    objects = compile_objects(tree, [uses, facts], "gcc", flags)
    if transport == "custom":
        library = compile_merged(tree, tree.sources, (), "gcc", flags)
        link([*objects, *library], "gcc", (), tree.folder / "surface")


def test_every_counted_symbol_is_covered() -> None:
    text = (Path(__file__).parent / "surface.yaml").read_text(encoding="utf-8").split("\ntiers:")[0]
    words = set(re.findall(r"\w+", text))
    # Selected in #ifdef, or declared by a component that is planned.
    words |= {"RMW_UXRCE_TRANSPORT_CUSTOM", "ROSIDL_GET_SRV_TYPE_SUPPORT", "rosidl_service_type_support_t"}
    missing = {tier: sorted(set(names.split()) - words) for tier, names in SURFACE["tiers"].items()}
    assert not any(missing.values()), missing


@pytest.mark.ros
def test_the_file_says_what_jazzy_declares(tmp_path: Path) -> None:
    include = Path(sys.prefix) / "include"
    functions = prototypes("ros")
    source = tmp_path / "jazzy.c"
    headers = [h for h in (*functions, *SURFACE["names"]) if h.split("/")[0] in ("rcl", "rmw", "rcutils")]
    source.write_text(
        declared(functions) + known(True, {h for h in headers if h != "std_msgs"}), encoding="utf-8"
    )
    folders = [f"-I{p}" for p in sorted(include.iterdir()) if p.is_dir()]
    done = subprocess.run(
        [
            "gcc",
            *folders,
            "-fsyntax-only",
            "-Werror",
            "-Wno-cast-function-type",
            "-Wno-deprecated-declarations",
            str(source),
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
