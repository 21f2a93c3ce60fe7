# SPDX-License-Identifier: Apache-2.0
"""Advice that can be pasted: what a message proposes is put into the file, and then it works."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.support.command_line import Outcome, Runner
from tests.support.ids import without_id

pytestmark = pytest.mark.builds

HEAD = """version: 1
profiles: [pure_sender, pure_reader]
nodes:
  - name: n
    publishers: [{topic: js, type: sensor_msgs/msg/JointState}, {topic: s, type: std_msgs/msg/String}]
    subscriptions: [{topic: tf, type: tf2_msgs/msg/TFMessage}, {topic: odo, type: nav_msgs/msg/Odometry}]
"""
JOINTS = "  sensor_msgs/msg/JointState: {name: {sequence: 6}, position: 6}\n"


def generate(run: Runner, folder: Path, text: str) -> Outcome:
    (folder / "microros.yaml").write_text(text)
    return run("generate", "-o", "out")


def proposed_block(err: str) -> str:
    """Return the lines after `Or for each of them`."""
    return err.split("Or for each of them", 1)[1].split("\n", 1)[1]


def test_one_line_sets_every_limit(run: Runner, folder: Path) -> None:
    refused = generate(run, folder, HEAD)
    assert refused.status == 2
    (line,) = set(re.findall(r"Add `(limits: .*)`$", without_id(refused.err), re.MULTILINE))
    assert line == 'limits: {"*": {string: 32, sequence: 8}}'
    assert generate(run, folder, f"{HEAD}{line}\n").status == 0


def test_the_block_sets_every_limit_by_itself(run: Runner, folder: Path) -> None:
    refused = generate(run, folder, HEAD)
    assert refused.err.count("error:") == 4, "one for each endpoint"
    assert refused.err.count("\nlimits:\n") == 1
    assert generate(run, folder, HEAD + proposed_block(refused.err)).status == 0


def test_what_is_said_already_stays(run: Runner, folder: Path) -> None:
    """The block goes below the `limits:` that is there, and a type's new line says both."""
    text = f"{HEAD}limits:\n{JOINTS}"
    refused = generate(run, folder, text)
    assert 'Add `"*": {string: 32, sequence: 8}` to `limits:`' in refused.err
    block = proposed_block(refused.err)
    assert "limits:\n" not in block
    assert "name: {sequence: 6, string: 32}" in block
    assert "position: 6" in block
    assert "# instead of line 8" in block
    assert generate(run, folder, text.replace(JOINTS, "") + block).status == 0
    assert generate(run, folder, text + '  "*": {string: 32, sequence: 8}\n').status == 0


def test_a_rule_for_everything_that_says_half(run: Runner, folder: Path) -> None:
    text = HEAD + 'limits:\n  "*": {sequence: 3}\n'
    refused = generate(run, folder, text)
    assert 'Add `string: 32` to the rule for "*"' in refused.err
    assert generate(run, folder, text.replace("{sequence: 3}", "{sequence: 3, string: 32}")).status == 0


def test_numbers_shrink_until_every_message_fits_its_stream(run: Runner, folder: Path) -> None:
    text = HEAD + "transport: {type: udp, mtu: 512}\n"
    refused = generate(
        run, folder, text.replace("JointState}", "JointState, qos: {reliability: best_effort}}")
    )
    line = re.findall(r"Add `(limits: .*)`$", without_id(refused.err), re.MULTILINE)[0]
    assert line != 'limits: {"*": {string: 32, sequence: 8}}'
    assert generate(run, folder, f"{text}{line}\n").status == 0


def test_a_topic_has_one_type(run: Runner, folder: Path) -> None:
    text = HEAD.replace("topic: s, type: std_msgs/msg/String", "topic: /tf, type: std_msgs/msg/Int32")
    refused = generate(run, folder, text + 'limits: {"*": {string: 32, sequence: 8}}\n')
    assert refused.status == 2
    assert "/tf has the type tf2_msgs/msg/TFMessage here and std_msgs/msg/Int32 in line 5" in refused.err
    apart = text.replace("subscriptions:", "services: []\n  - name: m\n    domain_id: 5\n    subscriptions:")
    assert generate(run, folder, apart + 'limits: {"*": {string: 32, sequence: 8}}\n').status == 0, (
        "another domain"
    )


def test_interface_paths_of_the_file_are_relative_to_it(run: Runner, folder: Path) -> None:
    (folder / "msgs/own_msgs/msg").mkdir(parents=True)
    (folder / "msgs/own_msgs/msg/Count.msg").write_text("int64 count\n")
    (folder / "app").mkdir()
    text = "version: 1\nprofiles: [pure_sender]\ninterface_paths: [../msgs]\ninterfaces: [own_msgs]\n"
    (folder / "app/microros.yaml").write_text(text)
    assert run("generate", "-c", "app/microros.yaml", "-o", "out").status == 0
    assert "own_msgs/msg/Count" in json.loads((folder / "out/manifest.json").read_text())["types"]
    (folder / "msgs/own_msgs/msg/Count.msg").write_text("int64 count\nint64 more\n")
    assert "0 written" not in run("generate", "-c", "app/microros.yaml", "-o", "out").out, "it is watched"
    (folder / "app/microros.yaml").write_text(text.replace("../msgs", "../none"))
    refused = run("generate", "-c", "app/microros.yaml", "-o", "out")
    assert "app/microros.yaml:3:19: error: the interface path 'app/../none' does not exist" in refused.err


def test_an_empty_folder_says_how_to_begin(run: Runner, folder: Path) -> None:
    refused = run("build")
    assert refused.status == 2
    assert "no application file microros.yaml in this folder, and no profile" in refused.err
    assert "--profile pure_sender" in refused.err


@pytest.mark.parametrize("name", ["esp32", "stm32"])
def test_a_target_that_is_not_there_is_no_other_one(run: Runner, folder: Path, name: str) -> None:
    refused = run("build", "--profile", "pure_sender", "--target", name)
    assert "Did you mean" not in refused.err
    assert "Available: arduino-mega" in refused.err
    assert "or give the path of a target file" in refused.err


def test_a_header_of_what_is_not_selected_says_what_to_add(run: Runner, folder: Path) -> None:
    assert run("generate", "--profile", "pure_sender", "-o", "out").status == 0
    texts = [path.read_text() for path in (folder / "out/include").rglob("*.h")]
    errors = [text for text in texts if text.startswith("#error")]
    for name in ("executor", "lifecycle"):
        assert any(f"'{name}' is not selected: add `components: [+{name}]`" in text for text in errors)


SMALL = """version: 1
profiles: [pure_reader]
nodes:
  - name: n
    subscriptions:
      - {topic: scan, type: sensor_msgs/msg/LaserScan}
      - {topic: tf, type: tf2_msgs/msg/TFMessage}
"""
STAR = 'limits:\n  "*": {string: 32, sequence: 64}\n'


def pasted(text: str, err: str) -> str:
    """Return the file with the lines of a diagnostic where their remarks say that they go."""
    lines = text.splitlines()
    for line, place in re.findall(r"^( *\S.*?)  # (.*)(?:then|saves) \d+ bytes$", err, re.MULTILINE):
        if instead := re.fullmatch(r"instead of (?:`pools:` in )?line (\d+), ", place):
            lines[int(instead[1]) - 1] = line
        elif at := re.fullmatch(r"at the \w+ (\S+), line (\d+), (?:instead of `(.*)`, )?", place):
            number, topic = int(at[2]) - 1, f"topic: {at[1]},"
            former, new = (at[3], line) if at[3] else (topic, f"{topic} {line},")
            lines[number] = lines[number].replace(former, new)
        else:
            assert place in ("", "below `limits:`, ")
            lines.append(line)
    under = [line for line in lines if re.match("  [a-z0-9_]+/", line)]
    lines = [line for line in lines if line not in under]
    at_limits = lines.index("limits:") + 1
    return "\n".join([*lines[:at_limits], *under, *lines[at_limits:]]) + "\n"


def taken(err: str) -> list[int]:
    return [int(size) for size in re.findall(r"then (\d+) bytes$", err, re.MULTILINE)]


@pytest.mark.parametrize(
    ("text", "budget"),
    [
        (SMALL.replace("- {topic: scan, type: sensor_msgs/msg/LaserScan}", "") + STAR, 12_000),
        pytest.param(
            SMALL.replace("pure_reader", "simulation_node") + STAR, 22_000, marks=pytest.mark.variant
        ),
        pytest.param(HEAD + "pools: {history: 8}\n" + STAR, 60_000, marks=pytest.mark.variant),
        pytest.param(HEAD + STAR, 4_000, marks=pytest.mark.variant),
        pytest.param(
            HEAD.replace("type: std_msgs/msg/String", "type: std_msgs/msg/Int32") + f"{STAR}{JOINTS}",
            4_000,
            marks=pytest.mark.variant,
        ),
        ("version: 1\nprofiles: [pure_sender]\ninterfaces: [sensor_msgs/msg/Imu]\n" + STAR, 900),
        ("version: 1\nprofiles: [pure_reader]\ninterfaces: [sensor_msgs/msg/Imu]\n" + STAR, 1_600),
    ],
    ids=["queue", "behind /clock", "pools stay", "together", "type stays", "history", "pool of queues"],
)
def test_streams_over_the_budget_are_refused_with_lines_that_fit(
    run: Runner, folder: Path, text: str, budget: int
) -> None:
    """Each alternative, or all lines together, bring the streams to the size that they name."""
    memory = f"memory: {{ram_budget: {budget}}}\n"
    refused = generate(run, folder, text + memory)
    assert refused.status == 2
    assert f"bytes of RAM and memory.ram_budget is {budget}" in refused.err
    headline, *block = refused.err.split("\n")
    remarks = [line for line in block if re.search("then \\d+ bytes$", line)]
    groups = [remarks] if "Set all of these" in headline else [[line] for line in remarks]
    assert all(groups)
    assert groups, refused.err
    for group in groups:
        lines = "\n".join(group)
        (size,) = set(taken(lines))
        assert size <= budget
        assert generate(run, folder, pasted(text, lines) + memory).status == 0
        below = generate(run, folder, pasted(text, lines) + f"memory: {{ram_budget: {size - 1}}}\n")
        assert f"the streams alone take {size} bytes" in below.err, "the size is exact"


def test_a_limit_is_lowered_no_more_than_it_takes(run: Runner, folder: Path) -> None:
    text = SMALL.replace("- {topic: tf, type: tf2_msgs/msg/TFMessage}", "").replace("}", ", queue: 1}")
    text += "limits:\n  sensor_msgs/msg/LaserScan: {header: {frame_id: 16}, ranges: 720, intensities: 8}\n"
    budget = "memory: {ram_budget: 2 KiB}\n"
    refused = generate(run, folder, text + budget)
    number = re.search(r"ranges: \{sequence: (\d+)\}", refused.err)
    assert number is not None
    one_more = pasted(text, refused.err).replace(number[0], f"ranges: {int(number[1]) + 1}")
    assert generate(run, folder, pasted(text, refused.err) + budget).status == 0
    assert "the streams alone take" in generate(run, folder, one_more + budget).err


def test_a_rule_of_two_equal_numbers_keeps_both(run: Runner, folder: Path) -> None:
    """One number for a sequence of strings would be refused, so the proposed line names both kinds."""
    joints = "  sensor_msgs/msg/JointState: {name: {sequence: 6, string: 6}}\n"
    text = f"{HEAD}limits:\n{joints}"
    block = proposed_block(generate(run, folder, text).err)
    assert "name: {string: 6, sequence: 6}" in block
    assert generate(run, folder, text.replace(joints, "") + block).status == 0


@pytest.mark.system
def test_advice_about_memory_is_exact_and_the_largest_saving_is_first(run: Runner, folder: Path) -> None:
    """What each line promises is what a build takes less with it pasted; keys that exist are replaced."""
    text = HEAD.replace("tf2_msgs/msg/TFMessage", "tf2_msgs/msg/TFMessage, queue: 4")
    text += 'limits:\n  "*": {string: 32, sequence: 16}\nerrors: text\n'

    def ram(application: str) -> int:
        (folder / "microros.yaml").write_text(f"{application}memory: {{ram_budget: 64 KiB}}\n")
        assert run("build", "-o", "out").status == 0
        lines = json.loads(run("size", "out", "--format", "json").out)["budgets"]
        return next(int(line["used"]) for line in lines if line["key"] == "memory.ram_budget")

    before = ram(text)
    (folder / "microros.yaml").write_text(f"{text}memory: {{ram_budget: {before - 1}}}\n")
    refused = run("build", "-o", "out")
    assert refused.status == 1
    promised = {
        line: int(saves)
        for line, saves in re.findall(r"^( *\S.* saves (\d+) bytes)$", refused.err, re.MULTILINE)
    }
    assert list(promised.values()) == sorted(promised.values(), reverse=True)
    starts = (
        "queue: 1  # at the subscription tf, line 6, instead of `queue: 4`, ",
        "queue_bytes: ",
        "  sensor_msgs/msg/JointState: {name:",
    )
    for start in starts:
        (line,) = (line for line in promised if line.startswith(start))
        assert before - ram(pasted(text, line)) == promised[line], line
    assert re.search(r"^errors: code  # instead of line 9, saves up to \d+ bytes$", refused.err, re.MULTILINE)
