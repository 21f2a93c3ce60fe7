# SPDX-License-Identifier: Apache-2.0
"""What a transport brings into the library, what it leaves out, and what it takes on a Cortex-M4."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from microros_gen.client.plan.runtime import RuntimePlan
from tests.support.plans import DECLARED, POOL, changed
from tests.support.runtime.harness import (
    FIXTURES,
    compile_merged,
    compile_objects,
    components,
    link,
    render,
)
from tests.support.slices import only

UNWARNED = ("-Os", "-Wno-error")
"""Warnings of gcc that inline what is in other files are no matter of symbols."""

PLANS = {
    "udp": POOL,
    "serial": changed(POOL, transport__kind="serial", transport__device="/dev/ttyUSB0"),
    "serial-board": changed(POOL, transport__kind="serial"),
    "custom-on": changed(POOL, transport__kind="custom", transport__framing="on"),
    "custom-off": changed(POOL, transport__kind="custom", transport__framing="off"),
    "custom-either": changed(POOL, transport__kind="custom", transport__framing="either"),
}
QUICK = ("serial", "custom-on")
"""What `make test` looks at; test_symbols.py has UDP."""
OWN = {
    "udp": re.compile("udp"),
    "serial": re.compile("serial(?!iz)|framing"),
    "custom": re.compile("custom|framing"),
}


@pytest.mark.parametrize("name", only(QUICK, PLANS))
def test_one_transport_and_no_other(name: str, tmp_path: Path) -> None:
    plan = PLANS[name]
    tree = render(tmp_path, plan, components(plan))
    objects = compile_merged(tree, tree.sources, (), "gcc", UNWARNED)
    out = subprocess.run(["nm", *map(str, objects)], capture_output=True, text=True, check=True).stdout
    names = {line.split()[-1] for line in out.splitlines() if len(line.split()) >= 2}
    names = {n for n in names if not n.startswith("microros_error_")}  # texts: each its own object
    for transport, pattern in OWN.items():
        found = {n for n in names if pattern.search(n)}
        if transport == plan.transport.kind:
            assert found
        else:
            assert {n for n in found if "framing" not in n} == set()
    framed = name in ("serial", "serial-board", "custom-on", "custom-either")
    assert any("framing" in n for n in names) == framed
    assert ("rmw_uros_options_set_serial_device" in names) == (name == "serial")
    strings = b"".join(o.read_bytes() for o in objects)
    assert (b"127.0.0.1" in strings) == (name == "udp")
    assert (b"/dev/ttyUSB0" in strings) == (name == "serial")


@pytest.mark.parametrize("name", ["serial", "custom-on"])
def test_functions_of_other_transports_say_what_to_set(name: str, tmp_path: Path) -> None:
    tree = render(tmp_path, PLANS[name], components(PLANS[name]))
    application = tmp_path / "application.c"
    application.write_text(
        "#include <rmw_microros/rmw_microros.h>\nrmw_ret_t set(rmw_init_options_t * o);\n"
        'rmw_ret_t set(rmw_init_options_t * o) { return rmw_uros_options_set_udp_address("h", "1", o); }\n'
    )
    with pytest.raises(AssertionError, match="rmw_uros_options_set_udp_address__needs__transport_type_udp"):
        compile_objects(tree, [application], "gcc", ("-Werror=implicit-function-declaration",))


OPTIONS = {
    "udp": "rmw_uros_options_set_udp_address",
    "tcp": "rmw_uros_options_set_tcp_address",
    "serial": "rmw_uros_options_set_serial_device",
    "canfd": "rmw_uros_options_set_can_device",
}
MISSING = re.compile(r"^#define (\w+) \w+?__(\w+)$", re.MULTILINE)


@pytest.mark.parametrize("name", [*PLANS, "tcp"])
def test_each_transport_declares_its_options(name: str, tmp_path: Path) -> None:
    """What a plan's transport does not have is a name that says what to change."""
    plan = PLANS.get(name) or changed(POOL, transport__kind="tcp")
    tree = render(tmp_path, plan, components(plan))
    text = (tree.folder / "include/rmw_microros/init_options.h").read_text(encoding="utf-8")
    missing = dict(MISSING.findall(text))
    expected = {f: f"needs__transport_type_{kind}" for kind, f in OPTIONS.items() if kind != name}
    if name == "serial-board":
        expected[OPTIONS["serial"]] = "the_board_has_one"
    assert missing == expected
    for function in OPTIONS.values():
        assert (f"rmw_ret_t {function}(" in text) == (function not in missing)


ARM = ("-mcpu=cortex-m4", "-mthumb", "-Os")


def _text(plan: RuntimePlan, folder: Path) -> int:
    """Return the bytes of the library in a pure sender; the port is left open."""
    tree = render(folder, plan, [n for n in components(plan) if n != "port_posix"])
    sources = [*tree.sources, FIXTURES / "types.c", FIXTURES / "sender.c"]
    objects = compile_objects(tree, sources, "arm-none-eabi-gcc", ARM)
    flags = ("-nostartfiles", "-Wl,-e,main", "--specs=nano.specs", "-Wl,--unresolved-symbols=ignore-all")
    program = link(objects, "arm-none-eabi-gcc", (*ARM, *flags), folder / "a")
    out = subprocess.run(["arm-none-eabi-size", program], capture_output=True, text=True, check=True).stdout
    return int(out.splitlines()[1].split()[0])


@pytest.mark.system
@pytest.mark.skipif(not shutil.which("arm-none-eabi-gcc"), reason="no cross compiler")
@pytest.mark.parametrize(
    ("transport", "framing", "most"),
    [
        ("serial", "either", 544),
        ("custom", "on", 860),
        pytest.param("custom", "off", 280, marks=pytest.mark.variant),
    ],
)
def test_size_with_udp(transport: str, framing: str, most: int, tmp_path: Path) -> None:
    udp = changed(DECLARED, streams__best_effort_size=92, streams__reliable_slot_size=16)
    other = changed(udp, transport__kind=transport, transport__framing=framing)
    assert _text(other, tmp_path / "other") - _text(udp, tmp_path / "udp") <= most
