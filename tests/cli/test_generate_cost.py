# SPDX-License-Identifier: Apache-2.0
"""What a whole run of `generate` costs, counted: the modules that it imports, and its work for each message."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from types import CodeType, FrameType

import microros_gen
from microros_gen import compiler
from microros_gen.diagnostics import Diagnostics
from microros_gen.documents.named import Named
from microros_gen.interfaces.closure import resolve_interfaces
from microros_gen.interfaces.find import InterfaceFinder
from tests.support.command_line import Runner

MESSAGE = "std_msgs/Header header\nstring name\nfloat64[9] matrix\nint32[] counts\nbool valid\n"
APPLICATION = (
    "version: 1\nprofiles: [pure_sender]\ninterfaces: [robot]\npools: {publishers: 2}\n"
    "transport: {type: udp, mtu: 60000}\nlimits: {'*': {string: 12, sequence: 3}}\n"
)
NOT_NEEDED = (
    "asyncio",
    "attr",
    "concurrent.futures",
    "jsonschema",
    "subprocess",
    "microros_gen.agent",
    "microros_gen.image",
    "microros_gen.interfaces.omg_idl",
    "microros_gen.migrate",
    "microros_gen.output.golden",
    "microros_gen.toolchain",
)


def application(folder: Path, messages: int) -> compiler.Options:
    """Write an application with a package of so many messages, each of which has its neighbor as a member."""
    package = folder / f"of_{messages}" / "robot"
    (package / "msg").mkdir(parents=True)
    for index in range(messages):
        neighbor = f"Type{index - 1} neighbor\n" if index % 10 else ""
        (package / "msg" / f"Type{index}.msg").write_text(MESSAGE + neighbor)
    config = package / "microros.yaml"
    config.write_text(APPLICATION)
    return compiler.Options(config=config, interface_paths=(package,))


def calls(work: Callable[[], object]) -> Counter[str]:
    """Return how often each function of Python is called during `work`."""
    counts: Counter[CodeType] = Counter()

    def note(frame: FrameType, event: str, argument: object) -> None:
        if event == "call":
            counts[frame.f_code] += 1

    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(None)
    named: Counter[str] = Counter()
    for code, count in counts.items():
        named[f"{Path(code.co_filename).name}: {getattr(code, 'co_qualname', code.co_name)}"] += count
    return named


def grown(few: Counter[str], many: Counter[str], messages: int) -> dict[str, tuple[int, int]]:
    """Return what is called much more than twice as often for twice as many messages; sorting may be."""
    return {name: (few[name], n) for name, n in many.items() if n > 4 * messages and n > 3.2 * few[name]}


def test_the_work_grows_as_the_number_of_messages(tmp_path: Path) -> None:
    def run(messages: int) -> Counter[str]:
        options, out = application(tmp_path, messages), tmp_path / f"out_{messages}"
        return calls(lambda: compiler.generate(options, out))

    compiler.generate(application(tmp_path, 1), tmp_path / "first")  # what is done once in a process
    few, many = run(10), run(20)
    assert grown(few, many, 20) == {}
    assert (many.total() - few.total()) / 10 < 14_000


def test_finding_interfaces_grows_as_their_number(tmp_path: Path) -> None:
    def run(messages: int) -> Counter[str]:
        finder = InterfaceFinder.from_environment(application(tmp_path, messages).interface_paths)
        return calls(lambda: resolve_interfaces((Named("robot"),), finder, Diagnostics()))

    run(1)
    few, many = run(100), run(200)
    assert many["parser.py: parse_msg"] + many["parser.py: parse_part"] > 200
    assert grown(few, many, 200) == {}


def test_a_search_in_a_list_is_noticed() -> None:
    class Name:
        def __init__(self, text: str) -> None:
            self.text = text

        def __hash__(self) -> int:
            return hash(self.text)

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Name) and self.text == other.text

    def search(count: int) -> list[bool]:
        existing = [Name(str(i)) for i in range(count)]
        return [Name(str(i)) in existing for i in range(count)]

    assert grown(calls(lambda: search(20)), calls(lambda: search(40)), 40) != {}


def test_a_whole_run_imports_what_it_uses(tmp_path: Path) -> None:
    options = application(tmp_path, 1)
    call = [sys.executable, "-X", "importtime", "-m", "microros_gen", "generate", "-c", str(options.config)]
    call += ["-o", str(tmp_path / "out"), "--interface-path", str(options.interface_paths[0])]
    environment = {
        **os.environ,
        "PYTHONPATH": str(Path(microros_gen.__file__).parents[1]),
        "XDG_CACHE_HOME": str(tmp_path / "cache"),
    }
    done = subprocess.run(call, env=environment, text=True, capture_output=True, check=True)
    imported = {line.rsplit("|", 1)[-1].strip() for line in done.stderr.splitlines()}
    assert {"jinja2", "yaml", "microros_gen.output.tree"} <= imported
    found = {name for name in imported if f"{name}.".startswith(tuple(f"{n}." for n in NOT_NEEDED))}
    assert found == set()


def test_only_commands_that_end_soon_collect_no_cycles() -> None:
    code = "import atexit, gc, sys; from microros_gen.cli.main import main\n"
    code += "atexit.register(lambda: print(gc.isenabled())); main()"
    environment = {**os.environ, "PYTHONPATH": str(Path(microros_gen.__file__).parents[1])}
    output = {}
    for command in ("generate", "build", "agent"):
        call = [sys.executable, "-c", code, command, "--help"]
        done = subprocess.run(call, env=environment, text=True, capture_output=True, check=True)
        output[command] = done.stdout.splitlines()[-1]
    assert output == {"generate": "False", "build": "False", "agent": "True"}


def test_a_caller_in_the_same_process_keeps_its_garbage_collection(run: Runner) -> None:
    """It was off for the rest of a process that had called `generate` once: test runs grew to 2.4 GB."""
    assert run("generate", "--profile", "pure_sender", "-o", "out").status == 0
    assert gc.isenabled()
