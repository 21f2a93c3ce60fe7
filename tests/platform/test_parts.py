# SPDX-License-Identifier: Apache-2.0
"""A platform of parts: who provides what, what the application must define, and parts of the user's own."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
import yaml
from jsonschema import Draft202012Validator

import microros_gen
from microros_gen.diagnostics import Diagnostics
from microros_gen.platform.board_file import BOARD_KEYS, board_schema
from microros_gen.platform.find import TARGETS, read_target
from microros_gen.platform.part import KINDS, Fraction
from microros_gen.platform.part_file import builtin_parts
from microros_gen.platform.provide import APPLICATION, Clash, provide
from microros_gen.platform.target import Target
from microros_gen.platform.target_file import SCHEMA
from microros_gen.selection.component import Ask, Component, Provision, SourceFile
from tests.support.command_line import Runner
from tests.support.ids import without_id

PACKAGE = Path(microros_gen.__file__).parent
PART = """\
component: port_demo
summary: "A made-up kernel"
layer: port
status: ready
needs: [support]
headers: [microros/port_demo.h]
provides:
  time: &time {sources: [port_demo_time.c], always: true}
  sleep: *time
  lock: {sources: [port_demo_lock.c.j2]}
  timer: {sources: [port_demo_timer.c]}
"""
FILES = {
    "component.yaml": PART,
    "include/microros/port_demo.h": "extern unsigned demo_ticks(void);\n",
    "src/port_demo_time.c": (
        '#include "microros/port.h"\n#include "microros/port_demo.h"\n\n'
        "uint32_t port_time_ms(void)\n{\n  return demo_ticks();\n}\n\n"
        "void port_sleep_ms(uint32_t duration_ms)\n{\n  (void)duration_ms;\n}\n"
    ),
    "src/port_demo_lock.c.j2": (
        '/* {{ target.name }} */\n#include "microros/port.h"\n\n'
        "void port_lock(void)\n{\n}\n\nvoid port_unlock(void)\n{\n}\n"
    ),
    "src/port_demo_timer.c": "#error nobody asks for timers here\n",
}
TARGET = "target: demo\nsummary: A board under a kernel\nextends: qemu-mps2-an385\nos: ./kernel\n"
APPLICATION_FILE = (
    "profiles: [pure_sender]\ncomponents: [+multithread]\ntarget: demo.yaml\nsession: {key: 1}\n"
)


@pytest.fixture
def demo(folder: Path) -> Path:
    """A folder with an application for a board under a kernel, and the kernel's part."""
    for name, text in FILES.items():
        path = folder / "kernel" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (folder / "demo.yaml").write_text(TARGET)
    (folder / "microros.yaml").write_text(APPLICATION_FILE)
    return folder


def declared(text: str) -> list[str]:
    """Return the declarations of functions in a text."""
    return [line for line in text.splitlines() if line.endswith(");") and " port_" in line]


SERIAL = [
    "bool port_serial_open(port_serial_t * serial, const char * device, uint32_t baud);",
    "void port_serial_close(port_serial_t * serial);",
    "size_t port_serial_room(port_serial_t * serial);",
    "bool port_serial_write(port_serial_t * serial, const uint8_t * data, size_t size);",
    "bool port_serial_is_idle(port_serial_t * serial);",
    "size_t port_serial_read(port_serial_t * serial, uint8_t * buffer, size_t capacity);",
]
MISSING = ["int64_t port_time_epoch_ns(void);", "int64_t port_time_steady_ns(void);", *SERIAL]


def test_functions_missing_from_a_kernel_are_named_and_can_be_pasted(demo: Path, run: Runner) -> None:
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    assert (
        "microros.yaml:3:9: warning: the target demo provides no epoch, steady, serial for support"
        in done.err
    )
    assert "`provides: [epoch, steady, serial]`" in done.err
    assert declared(done.err) == MISSING
    line = next(line for line in done.out.splitlines() if line.startswith("you define"))
    assert "port_time_epoch_ns, port_time_steady_ns, port_serial_open" in line
    assert declared((demo / "out" / "README.md").read_text()) == MISSING
    program = "#include <microros/port.h>\n" + "\n".join(MISSING)
    check = ["gcc", "-std=c99", "-Wall", "-Wredundant-decls", "-fsyntax-only", "-Iout/include", "-xc", "-"]
    subprocess.run(check, input=program, text=True, check=True)
    rows = json.loads(run("resolve", "--format", "json").out)["capabilities"]
    assert {name for name, row in rows.items() if row["provider"] is None} == {"epoch", "steady", "serial"}
    assert rows["lock"] == {"provider": "port_demo", "asked_by": ["multithread"], "functions": []}
    table = run("resolve").out
    assert "nobody: define port_time_steady_ns" in table


@pytest.mark.system
@pytest.mark.builds
@pytest.mark.skipif(not shutil.which("arm-none-eabi-gcc"), reason="tests/tools/system_packages.py names it")
def test_nothing_of_bare_metal_is_in_the_archive(demo: Path, run: Runner) -> None:
    done = run("build", "-o", "out")
    assert done.status == 0, done.err
    assert "none: start-up code and linker script belong to port_demo" in done.out
    archive = str(demo / "out" / "lib" / "libmicroros.a")
    listed = subprocess.run(["arm-none-eabi-nm", archive], capture_output=True, text=True, check=True).stdout
    symbols = {line.split()[-1] for line in listed.splitlines() if line.strip() and not line.endswith(":")}
    assert {"port_time_ms", "port_sleep_ms", "port_lock", "port_cortex_m_interrupt_enable"} <= symbols
    assert not {s for s in symbols if s.startswith(("port_bare", "port_board", "port_stdio", "port_uart"))}
    of_processor = {s for s in symbols if s.startswith("port_cortex_m")}
    assert of_processor == {"port_cortex_m_interrupt_enable", "port_cortex_m_barrier"}
    assert (demo / "out" / "src" / "port_demo" / "port_demo_lock.c").read_text().startswith("/* demo */")
    assert not (demo / "out" / "src" / "port_demo" / "port_demo_timer.c").exists()
    assert (demo / "out" / "include" / "microros" / "port_demo.h").is_file()
    readme = (demo / "out" / "README.md").read_text()
    assert "belong to the operating system (`port_demo`)" in readme
    assert "port_bare_tick" not in readme


def test_a_changed_file_of_an_own_part_is_rendered_again(demo: Path, run: Runner) -> None:
    assert run("generate", "-o", "out").status == 0
    path = demo / "kernel" / "src" / "port_demo_lock.c.j2"
    path.write_text(path.read_text().replace("{{ target.name }}", "changed"))
    assert run("generate", "-o", "out").status == 0
    assert (demo / "out" / "src" / "port_demo" / "port_demo_lock.c").read_text().startswith("/* changed */")


def test_what_the_target_file_leaves_to_the_application_is_no_warning(demo: Path, run: Runner) -> None:
    (demo / "demo.yaml").write_text(f"{TARGET}provides: [epoch, steady, serial, time, sleep]\n")
    done = run("generate", "-o", "out")
    assert done.status == 0, done.err
    assert "warning" not in done.err
    assert declared((demo / "out" / "README.md").read_text())[0] == "uint32_t port_time_ms(void);"
    assert not (demo / "out" / "src" / "port_demo" / "port_demo_time.c").exists()


def test_half_of_a_file_cannot_be_replaced(demo: Path, run: Runner) -> None:
    (demo / "demo.yaml").write_text(f"{TARGET}provides: [time]\n")
    done = run("generate", "-o", "out")
    assert done.status == 2
    assert (
        "port_demo_time.c of port_demo implements 'sleep' and 'time', but only 'time' is provided elsewhere"
        in done.err
    )
    assert "`provides: [time, sleep]`" in done.err


def test_a_board_precedes_network_system_and_processor(demo: Path, run: Runner) -> None:
    board = demo / "board"
    (board / "src").mkdir(parents=True)
    (board / "src" / "own_lock.c").write_text("extern int own_lock;\n")
    (board / "component.yaml").write_text(
        "component: port_my_board\nsummary: A board\nlayer: port\nstatus: ready\n"
        "provides: {lock: {sources: [own_lock.c]}}\n"
    )
    (demo / "demo.yaml").write_text(f"{TARGET}board: ./board\n")
    rows = json.loads(run("resolve", "--format", "json").out)["capabilities"]
    assert rows["lock"]["provider"] == "port_my_board"
    assert rows["time"]["provider"] == "port_demo"


BOARD_PART = """\
component: port_{name}
summary: "Made up"
layer: port
status: ready
needs: [support]
provides: {{}}
"""
TWO_BOARDS = {"hawk": ("8000000", "0x40001000", 1), "kite": ("16000000", "0x40002000", 2)}


def write_board(folder: Path, name: str, more: str = "") -> None:
    """Write a part with the facts of a board: clock, memories and serial line."""
    clock, base, irq = TWO_BOARDS[name]
    (folder / name).mkdir()
    (folder / name / "component.yaml").write_text(BOARD_PART.format(name=name))
    (folder / name / "board.yaml").write_text(
        f"clock_hz: {clock}\nflash: {{origin: 0, size: 64 KiB}}\nram: {{origin: 0x20000000, size: 16 KiB}}\n"
        f"uart: {{driver: cmsdk, base: {base}, irq: {irq}}}\n{more}"
    )
    (folder / f"{name}.yaml").write_text(
        f"target: {name}\nsummary: Made up\nextends: qemu-mps2-an385\nboard: ./{name}\n"
    )


def test_two_boards_share_everything_but_their_facts(folder: Path, run: Runner) -> None:
    """What differs in the output is what the two files board.yaml say: clock, address and interrupt."""
    outputs = []
    for name in TWO_BOARDS:
        write_board(folder, name)
        done = run("generate", "--profile", "pure_sender", "--target", f"{name}.yaml", "-o", f"out-{name}")
        assert done.status == 0, done.err
        out = folder / f"out-{name}"
        outputs.append({p.relative_to(out).as_posix(): p.read_text() for p in out.rglob("*") if p.is_file()})
    left, right = outputs
    assert left.keys() == right.keys()
    differ = {path for path in left if left[path].replace("hawk", "kite") != right[path]}
    assert sorted(differ) == [
        "include/microros/port_board.h",  # clock, address, divisor
        "include/microros_config.h",  # the plan id: libraries of two boards do not link
        "manifest.json",
        "src/port_cortex_m/port_cortex_m_vectors.c",  # the interrupt
    ]
    assert "0x40001000" in left["include/microros/port_board.h"]
    manifest = json.loads(left["manifest.json"])
    assert "part port_hawk/board.yaml" in manifest["inputs"]


def test_a_board_without_functions_is_one_file_and_extends_another(folder: Path, run: Runner) -> None:
    """Its files are inputs in the manifest, and changing the extended one changes the output."""
    for name, text in {"base": "extends: mps2\nclock_hz: 8000000\n", "kite": "extends: ../base\n"}.items():
        (folder / name).mkdir()
        (folder / name / "board.yaml").write_text(text)
    (folder / "kite.yaml").write_text("target: kite\nsummary: Made up\nextends: cortex-m3\nboard: ./kite\n")
    generate = ("generate", "--profile", "pure_sender", "--target", "kite.yaml", "-o", "out")
    assert run(*generate).status == 0
    header = folder / "out" / "include" / "microros" / "port_board.h"
    assert "8000000" in header.read_text()
    assert "0x40004000" in header.read_text()
    inputs = json.loads((folder / "out" / "manifest.json").read_text())["inputs"]
    assert {"board kite/board.yaml", "board base/board.yaml"} <= set(inputs)
    (folder / "base" / "board.yaml").write_text("extends: mps2\nclock_hz: 9000000\n")
    assert run(*generate).status == 0
    assert "9000000" in header.read_text()


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("extends: ./\n", "hawk/board.yaml:1:10: error: the board './' extends itself"),
        ("extends: mps3\n", "hawk/board.yaml:1:10: error: unknown board 'mps3'. Did you mean 'mps2'?"),
        ("extends: ../none\n", "hawk/board.yaml:1:10: error: cannot read"),
        ("extends: 1\n", "hawk/board.yaml:1:10: error: 'extends' must be the name of a board"),
    ],
)
def test_a_board_that_extends_the_wrong_one_is_refused(
    text: str, expected: str, folder: Path, run: Runner
) -> None:
    (folder / "hawk").mkdir()
    (folder / "hawk" / "board.yaml").write_text(text)
    (folder / "hawk.yaml").write_text("target: hawk\nsummary: Made up\nextends: cortex-m3\nboard: ./hawk\n")
    done = run("targets", "hawk.yaml")
    assert done.status == 2
    assert expected in without_id(done.err)


@pytest.mark.parametrize("path", sorted(TARGETS.glob("*.yaml")), ids=lambda path: path.stem)
def test_a_built_in_target_file_has_no_fact_about_a_board(path: Path) -> None:
    assert not set(yaml.safe_load(path.read_text())) & set(BOARD_KEYS)


def test_built_in_boards_hold_to_the_schema_and_repeat_nothing() -> None:
    schema = board_schema(json.loads(SCHEMA.read_text()))
    boards = {
        p.parent.name: yaml.safe_load(p.read_text())
        for p in (PACKAGE / "platform").glob("board/*/board.yaml")
    }
    assert set(boards) == set(builtin_parts("board")) != set()
    for name, facts in boards.items():
        assert not list(Draft202012Validator(schema).iter_errors(facts)), name
    facts = [
        json.dumps({**data, "emulator": 0}, sort_keys=True) for data in boards.values() if "uart" in data
    ]
    assert len(set(facts)) == len(facts)
    used = {yaml.safe_load(path.read_text()).get("board") for path in TARGETS.glob("*.yaml")}
    assert used | {data.get("extends") for data in boards.values()} >= set(boards)


def test_a_target_file_wins_over_its_board_and_that_over_what_it_extends(folder: Path, run: Runner) -> None:
    write_board(folder, "hawk")
    path = folder / "hawk.yaml"
    path.write_text(f"{path.read_text()}clock_hz: 12000000\ncycles_per_instruction: 2.5\n")
    (shown,) = json.loads(run("targets", "hawk.yaml", "--format", "json").out)
    assert (shown["clock_hz"], shown["uart"]["base"], shown["flash"]["size"]) == (12000000, 0x40001000, 65536)
    assert shown["cycles_per_instruction"] == 2.5
    assert re.search(r"cycles_per_instruction +2[.]5\n", run("targets", "hawk.yaml").out)


def test_a_board_says_nothing_of_the_compiler(folder: Path, run: Runner) -> None:
    write_board(folder, "hawk", "c_flags: [-mcpu=cortex-m4]\n")
    done = run("targets", "hawk.yaml")
    assert done.status == 2
    assert "hawk/board.yaml:5:1: error: unknown key 'c_flags' in the file" in without_id(done.err)


ERRORS = {
    "capability": (
        {"component.yaml": PART.replace("lock:", "lok:")},
        TARGET,
        "names an unknown capability 'lok'",
    ),
    "room": (
        {"component.yaml": PART.replace("[port_demo_timer.c]", "[port_demo_timer.c], waits_for_room: true")},
        TARGET,
        "demo.yaml:4:5: error: the os 'port_demo' has 'waits_for_room' at 'timer', which is not a transport",
    ),
    "file": (
        {"component.yaml": PART.replace("port_demo_timer.c", "x.c")},
        TARGET,
        "demo.yaml:4:5: error: the os 'port_demo' has no file 'src/x.c'",
    ),
    "folder": ({}, TARGET.replace("./kernel", "./kernal"), "demo.yaml:4:5: error: cannot read"),
    "name": (
        {},
        TARGET.replace("./kernel", "posx"),
        "demo.yaml:4:5: error: unknown os 'posx'. Did you mean 'posix'?",
    ),
    "layer": (
        {"component.yaml": PART.replace("layer: port", "layer: middleware")},
        TARGET,
        "is not a part of a platform",
    ),
    "facts": (
        {"os.yaml": "hosted: true\ntikc: f\n"},
        TARGET,
        "os.yaml:2:1: error: unknown key 'tikc'",
    ),
    "provides": (
        {},
        f"{TARGET}provides: [tim]\n",
        "demo.yaml:5:12: error: unknown capability 'tim'. Did you mean",
    ),
    "no image": (
        {"os.yaml": "linker_script: kernel.ld\n", "cpu/component.yaml": PART},
        f"{TARGET}cpu: ./kernel/cpu\n",
        "has no start-up code for an image",
    ),
    "port": (
        {},
        TARGET.replace("os: ./kernel", "port: port_posx"),
        "demo.yaml:4:7: error: unknown port 'port_posx'",
    ),
}


@pytest.mark.parametrize("case", ERRORS)
def test_a_faulty_part_is_refused(case: str, demo: Path, run: Runner) -> None:
    files, target, expected = ERRORS[case]
    for name, text in files.items():
        path = demo / "kernel" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (demo / "demo.yaml").write_text(target)
    done = run("generate", "-o", "out")
    assert done.status == 2, done.err
    assert expected in done.err.replace(f"{demo}/", "")


def target_of(folder: Path, text: str) -> Target:
    (folder / "t.yaml").write_text(text)
    diagnostics = Diagnostics()
    found = read_target("t.yaml", folder, None, diagnostics)
    assert found is not None, [without_id(d.headline()) for d in diagnostics]
    return found.target


@pytest.mark.parametrize(
    ("port", "parts"),
    [
        ("port_posix", {"os": "port_posix", "network": "port_posix_sockets"}),
        ("port_cortex_m", {"os": "port_bare", "cpu": "port_cortex_m"}),
        ("port_riscv", {"os": "port_bare", "cpu": "port_riscv"}),
    ],
)
def test_port_still_selects_processor_and_system(port: str, parts: dict[str, str], tmp_path: Path) -> None:
    """Target files of 2026-11 and before."""
    text = "target: t\nsummary: x\ncompilers: [cc]\narchivers: [ar]\npackage: gcc\n"
    target = target_of(tmp_path, f"{text}port: {port}\n")
    assert {part.kind: part.component.name for part in target.parts} == parts
    assert target.hosted == (port == "port_posix")
    nearer = target_of(tmp_path, f"target: t\nextends: riscv32\nport: {port}\n")
    assert {**parts, "cpu": "x"} == {**{p.kind: p.component.name for p in nearer.parts}, "cpu": "x"}


def test_a_fraction_is_rounded_to_the_bits_that_count() -> None:
    nrf51 = Fraction(16_000_000, 32, 12)
    assert [nrf51.register(baud) for baud in (1200, 9600, 115_200)] == [0x0004F000, 0x00275000, 0x01D7E000]


def part(name: str, *provides: Provision) -> Component:
    return Component(name, "", "port", True, provides=provides)


def test_the_first_part_provides_and_brings_what_it_asks_for() -> None:
    near = part("port_near", Provision("lock", (SourceFile("near.c"),), (Ask("idle"),)))
    far = part(
        "port_far",
        Provision("lock", (SourceFile("far.c"),)),
        Provision("idle", (SourceFile("idle.c"),)),
        Provision("time", (SourceFile("time.c", (("fast", True),)),), always=True),
        Provision("tcp", (SourceFile("tcp.c"),)),
    )
    asking = Component("x", "", "middleware", True, asks=(Ask("lock"), Ask("udp", (("fast", False),))))
    found = provide(
        (asking, far, near), ("port_near", "port_far"), (), lambda when: when != (("fast", False),)
    )
    assert [(r.capability.name, r.provider, r.asked_by) for r in found.rows] == [
        ("time", "port_far", ()),
        ("lock", "port_near", ("x",)),
        ("idle", "port_far", ("port_near",)),
    ]
    assert set(found.files) == {("port_near", "near.c"), ("port_far", "idle.c"), ("port_far", "time.c")}
    slow = provide((asking, far), ("port_far",), ("lock",), lambda when: when != (("fast", True),))
    assert [(r.capability.name, r.provider) for r in slow.rows] == [("lock", APPLICATION), ("udp", "")]
    assert slow.functions()[:2] == ("port_lock", "port_unlock")
    both = part(
        "port_both",
        Provision("time", (SourceFile("a.c"),), always=True),
        Provision("sleep", (SourceFile("a.c"),)),
    )
    clash = provide((both,), ("port_both",), ("sleep",), lambda _: True)
    assert clash.clashes == ()  # nobody asks for sleep
    sleeper = Component("y", "", "middleware", True, asks=(Ask("sleep"),))
    clash = provide((sleeper, both), ("port_both",), ("sleep",), lambda _: True)
    assert clash.clashes == (Clash("port_both", "a.c", "time", "sleep"),)


def test_no_python_module_names_a_part() -> None:
    """A port is its own folder: nothing about one stands in code that they share."""
    parts = {name for kind in KINDS for name in builtin_parts(kind)}
    assert {"bare", "cortex_m", "mps2", "posix", "posix_sockets", "riscv"} <= parts
    quoted = re.compile(rf"""["'/](port_)?({"|".join(sorted(parts))})["'/.]""")
    named = {path.name for path in PACKAGE.rglob("*.py") if quoted.search(path.read_text(encoding="utf-8"))}
    assert named == set()
