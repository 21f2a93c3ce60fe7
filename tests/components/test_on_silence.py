# SPDX-License-Identifier: Apache-2.0
"""`on_silence` of a subscription: its table, its declarations, what is refused, and who has to define the function."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.on_silence.plan import SilencePlan, SilenceRow
from microros_gen.diagnostics import UserError
from tests.support.components.rendered import planned, rendered, run

BASE = "version: 1\nprofiles: [pure_reader]\nlimits: {'*': {string: 20}}\n"
NODE = """\
nodes:
  - name: arm
    namespace: /left
    subscriptions:
      - {topic: /map, type: std_msgs/msg/String}
      - {topic: speed, type: std_msgs/msg/Int32, on_silence: {after: 500 ms, call: stop_motors}}
      - {topic: "~/light", type: std_msgs/msg/Int32, on_silence: {after: 2 s, call: stop_motors}}
      - {topic: "~/horn", type: std_msgs/msg/Int32, on_silence: {after: 1 ms, call: be_quiet}}
"""


def part_of(found: compiler.Planned) -> SilencePlan:
    part = found.project.runtime.features.of("on_silence")
    assert isinstance(part, SilencePlan)
    return part


def test_the_key_selects_the_component_and_names_each_subscription(tmp_path: Path) -> None:
    part = part_of(planned(tmp_path, BASE + NODE))
    assert part.rows == (
        SilenceRow(1, "/left/speed", 500, "stop_motors"),
        SilenceRow(2, "/left/arm/light", 2000, "stop_motors"),
        SilenceRow(3, "/left/arm/horn", 1, "be_quiet"),
    )
    assert part.functions == ("void stop_motors(void);", "void be_quiet(void);")


def test_subscriptions_of_the_library_precede(tmp_path: Path) -> None:
    rows = part_of(planned(tmp_path, f"{BASE}clock: ros\n{NODE}")).rows
    assert [row.receiver for row in rows] == [2, 3, 4]


def test_nothing_of_it_without_the_key(tmp_path: Path) -> None:
    text = "\n".join(line.replace(", on_silence:", "}\n#") for line in NODE.splitlines())
    assert "#" in text
    out = rendered(tmp_path, f"{BASE}{text}\n")
    assert not (out / "src" / "on_silence").exists()
    assert "silence" not in (out / "include" / "microros" / "xrce_client.h").read_text(encoding="utf-8")


def test_an_undefined_function_is_named(tmp_path: Path) -> None:
    """The library calls it by its name, so a linker says which one is missing; the example defines each once."""
    out = rendered(tmp_path, BASE + NODE)
    table = tmp_path / "table.o"
    source = out / "src" / "on_silence" / "xrce_silence_table.c"
    run("gcc", "-std=c99", "-c", f"-I{out / 'include'}", source, "-o", table)
    missing = run("nm", "--undefined-only", table).split()[1::2]
    assert sorted(missing) == ["be_quiet", "stop_motors"]
    example = next(out.glob("examples/*/main.c")).read_text(encoding="utf-8")
    assert example.count("void stop_motors(void)\n") == 1
    assert example.count("void be_quiet(void)\n") == 1


@pytest.mark.parametrize(
    ("old", "new", "identifier", "hint"),
    [
        ("after: 1 ms", "after: 1 us", "MG-3212", "Write after: 500 ms"),
        ("after: 1 ms", "after: 86401 s", "MG-3212", "Write after: 500 ms"),
        ("call: be_quiet", "call: switch", "MG-3213", "Write call: stop_motors"),
        ("call: be_quiet", "call: main", "MG-3213", "Write call: stop_motors"),
        ("call: be_quiet", "call: rcl_publish", "MG-3213", "Write call: stop_motors"),
        ("call: be_quiet}", "call: be_quiet}, local: also", "MG-3214", "Remove on_silence, or local: also"),
        ("after: 1 ms", "aftr: 1 ms", "MG-1002", "Did you mean 'after'?"),
    ],
)
def test_mistakes_have_place_and_hint(tmp_path: Path, old: str, new: str, identifier: str, hint: str) -> None:
    head, _, tail = NODE.rpartition(old)
    with pytest.raises(UserError) as error:
        planned(tmp_path, f"{BASE}{head}{new}{tail}")
    found = [d for d in error.value.diagnostics if d.id == identifier]
    assert found, str(error.value)
    assert found[0].span is not None
    assert hint in (found[0].hint or "")


def test_the_component_needs_a_subscription(tmp_path: Path) -> None:
    text = f"{BASE}components: [+on_silence]\nnodes: [{{name: n}}]\n"
    with pytest.raises(UserError, match="none has one"):
        planned(tmp_path, text)
