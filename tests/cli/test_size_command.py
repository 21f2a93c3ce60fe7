# SPDX-License-Identifier: Apache-2.0
"""`size` and `explain`: tables, JSON by its schema, a page that needs nothing else, budgets, why things are there."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import jsonschema
import pytest

import microros_gen
from microros_gen.cli import main as cli
from microros_gen.cli.size.html import HEIGHT, WIDTH, treemap
from microros_gen.image.report import measure
from tests.support.command_line import Runner

pytestmark = [pytest.mark.skipif(not shutil.which("gcc"), reason="no gcc"), pytest.mark.builds]
SCHEMA = json.loads(
    (Path(microros_gen.__file__).parent / "cli" / "size" / "size.schema.json").read_text(encoding="utf-8")
)
APPLICATION = """\
version: 1
profiles: [pure_sender]
nodes:
  - name: imu_node
    publishers:
      - {topic: imu/data, type: sensor_msgs/msg/Imu, qos: {reliability: best_effort, depth: 1}}
      - {topic: count, type: std_msgs/msg/Int32}
limits:
  sensor_msgs/msg/Imu: {header: {frame_id: 64}}
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("size")
    (folder / "microros.yaml").write_text(APPLICATION, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        for name in ("CC", "AR", "CFLAGS"):
            patch.delenv(name, raising=False)
        with pytest.raises(SystemExit) as end:
            cli.main(["build", "-c", str(folder / "microros.yaml"), "-o", str(folder / "out")])
    assert end.value.code == 0
    return folder / "out"


@pytest.fixture(scope="module")
def report(built: Path, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """What `size` says of the image, asked once."""
    file = tmp_path_factory.mktemp("said") / "size.json"
    with pytest.raises(SystemExit) as end:
        cli.main(["size", str(built), "--format", "json", "-o", str(file)])
    assert end.value.code == 0
    return json.loads(file.read_text(encoding="utf-8"))


@pytest.fixture(scope="module", autouse=True)
def measured_once() -> Iterator[None]:
    """Let `explain` of a folder and an image that stay as they are find what was measured of them before."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("microros_gen.image.report.measure", cache(measure))
        yield


def sized(run: Runner, out: Path) -> Any:
    outcome = run("size", str(out), "--format", "json")
    assert (outcome.status, outcome.err) == (0, "")
    return json.loads(outcome.out)


def explained(run: Runner, out: Path, what: str) -> Any:
    outcome = run("explain", str(out), what, "--format", "json")
    assert (outcome.status, outcome.err) == (0, "")
    return json.loads(outcome.out)


def test_the_json_follows_its_schema_and_adds_up(run: Runner, built: Path) -> None:
    data = sized(run, built)
    jsonschema.validate(data, SCHEMA)
    for kind in ("flash", "ram"):
        total = data["totals"][kind]
        assert total == sum(o[kind] for o in data["owners"]) == sum(s[kind] for s in data["symbols"])
    assert data["totals"]["ram"] == sum(p["bytes"] for p in data["ram"])
    names = {o["name"] for o in data["owners"] if o["group"] == "component"}
    manifest = json.loads((built / "manifest.json").read_text(encoding="utf-8"))
    assert {"publish", "session", "support"} <= names <= set(manifest["selection"]["components"])
    chains = [data["stack"]["main"], *data["stack"]["functions"]]
    assert all(b["bytes"] == sum(link["frame"] for link in b["chain"]) for b in chains)
    assert {"rcl_publish", "rclc_support_init"} <= {b["function"] for b in data["stack"]["functions"]}


def test_the_schema_describes_every_key() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def undescribed(node: Any, where: str) -> Iterator[str]:
        for key, value in node.get("properties", {}).items():
            keywords = {"const", "description", "enum"} & set(value)
            if not keywords and value.get("type") not in ("number", "boolean", "array"):
                yield f"{where}/{key}"
            yield from undescribed(value, f"{where}/{key}")
            yield from undescribed(value.get("items", {}), f"{where}/{key}")

    assert list(undescribed(SCHEMA, "")) == []


def test_the_table_is_short_and_all_lists_every_symbol(run: Runner, built: Path, report: Any) -> None:
    short, long = run("size", str(built)), run("size", str(built), "--all")
    assert short.status == long.status == 0
    assert long.out.startswith(short.out)
    assert not [line for line in long.out.splitlines() if line != line.rstrip()]
    assert len(short.out.splitlines()) < 130
    assert re.search(
        rf"^total +{report['totals']['flash']} +{report['totals']['ram']}$", short.out, re.MULTILINE
    )
    assert len(long.out.splitlines()) - len(short.out.splitlines()) >= len(report["symbols"])
    assert re.search(r"^publisher +/count +std_msgs/msg/Int32", short.out, re.MULTILINE)
    assert "rcl_publish " in long.out


@pytest.mark.system
def test_the_same_folder_gives_the_same_text(run: Runner, built: Path, folder: Path) -> None:
    for kind in ("table", "json", "html"):
        once = run("size", str(built), "--format", kind).out
        assert once
        assert run("size", str(built), "--format", kind, "-o", "file").out == ""
        assert (folder / "file").read_text(encoding="utf-8") == once


class Page(HTMLParser):
    """Collects what a page consists of; what is opened is closed."""

    VOID = frozenset({"meta", "br", "link", "img", "hr"})

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.titles: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attributes)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "title" and "svg" in self.open:
            self.titles.append(data)


def test_the_page_needs_nothing_else(run: Runner, built: Path, report: Any) -> None:
    text = run("size", str(built), "--format", "html").out
    page = Page(text)
    assert page.open == []
    names = {tag for tag, _ in page.tags}
    assert not names & {"script", "link", "img", "iframe", "object"}
    assert not re.search(r"https?://|url\(|@import", text)
    ids = {a["id"] for _, a in page.tags if "id" in a}
    assert {a["href"] for tag, a in page.tags if tag == "a"} <= {f"#{name}" for name in ids}
    assert {"flash", "ram", "stack", "entities"} <= ids
    assert "prefers-color-scheme: dark" in text
    assert "@media print" in text
    owner = next(o for o in report["owners"] if o["name"] == "publish")
    in_flash, *in_ram = (t for t in page.titles if t.startswith("publish (component): "))
    assert in_flash == f"publish (component): {owner['flash']} bytes"
    assert len(in_ram) <= 1


def test_boxes_of_the_treemap_have_areas_in_proportion_and_do_not_overlap() -> None:
    leaves = [("component", f"c{i}", "x", size) for i, size in enumerate((600, 300, 200, 70, 25, 5))]
    boxes = [b for b in treemap(leaves) if b.outer]
    total = sum(leaf[3] for leaf in leaves)
    for box, leaf in zip(boxes, leaves, strict=True):
        assert box.width * box.height == pytest.approx(WIDTH * HEIGHT * leaf[3] / total, rel=0.02)
        assert 0 <= box.x <= box.x + box.width <= WIDTH + 0.1
        assert 0 <= box.y <= box.y + box.height <= HEIGHT + 0.1
    for i, first in enumerate(boxes):
        for other in boxes[i + 1 :]:
            wide = min(first.x + first.width, other.x + other.width) - max(first.x, other.x)
            high = min(first.y + first.height, other.y + other.height) - max(first.y, other.y)
            assert wide <= 0.1 or high <= 0.1


def put(folder: Path, memory: str) -> None:
    (folder / "microros.yaml").write_text(f"{APPLICATION}memory: {{{memory}}}\n", encoding="utf-8")


@pytest.mark.system
def test_exceeded_budgets_name_places_contributors_and_what_would_help(run: Runner, folder: Path) -> None:
    put(folder, "ram_budget: 1200, flash_budget: 10 KiB, stack: 512")
    outcome = run("build", "-o", "out")
    assert outcome.status == 1
    place = r"microros\.yaml:10:\d+: error: "
    assert re.search(
        place + r"static RAM .* memory\.ram_budget is 1200 \(largest: best-effort stream \d+", outcome.err
    )
    assert re.search(place + r"flash .* memory\.flash_budget is 10240 \(largest: \w+ \d+, ", outcome.err)
    assert re.search(
        place + r"worst stack from main: \d+ bytes.* memory\.stack is 512 \(worst chain: main \d+, rclc?_",
        outcome.err,
    )
    again = run("size", "out", "--format", "json")
    assert again.status == 1
    assert again.err.count(" error: ") == 3, "the same three, said by size"
    data = json.loads(again.out)
    jsonschema.validate(data, SCHEMA)
    lines = {line["key"]: line for line in data["budgets"]}
    assert all(line["exceeded"] and line["used"] > line["budget"] for line in lines.values())
    advice = {a["change"]: a for a in lines["memory.ram_budget"]["advice"]}
    assert advice["pools: {history: 3}"]["saves"] == 16 + 2, "a slot and its size"
    limit = next(a for line, a in advice.items() if line.startswith("  sensor_msgs/msg/Imu: {"))
    change = "  sensor_msgs/msg/Imu: {header: {frame_id: {string: 16}}}"
    assert limit == {"change": change, "place": "instead of line 9", "saves": 48, "exact": True}


@pytest.mark.system
def test_what_is_advised_helps(run: Runner, folder: Path) -> None:
    """Follow the advice and measure: each promised byte comes."""
    put(folder, "ram_budget: 1200, flash_budget: 10 KiB, stack: 512")
    assert run("build", "-o", "out").status == 1
    before = {line["key"]: line for line in json.loads(run("size", "out", "--format", "json").out)["budgets"]}
    text = APPLICATION.replace("frame_id: 64", "frame_id: 16") + "pools: {history: 3}\nerrors: code\n"
    (folder / "microros.yaml").write_text(f"{text}memory: {{ram_budget: 16 KiB, flash_budget: 64 KiB}}\n")
    assert run("build", "-o", "out").status == 0
    after = {line["key"]: line for line in sized(run, Path("out"))["budgets"]}
    ram, flash = "memory.ram_budget", "memory.flash_budget"
    assert before[ram]["used"] - after[ram]["used"] >= 48 + 16 + 2
    promised = next(a["saves"] for a in before[flash]["advice"] if a["change"] == "errors: code")
    saved = before[flash]["used"] - after[flash]["used"]
    assert promised / 2 < saved, "most of what the text takes"
    assert after[ram]["largest"] == after[ram]["advice"] == []


@pytest.mark.system
def test_budgets_that_hold_are_lines_of_the_table(run: Runner, folder: Path) -> None:
    put(folder, "ram_budget: 64 KiB, flash_budget: 1 MiB, stack: 1 MiB")
    assert run("build", "-o", "out").status == 0
    outcome = run("size", "out")
    assert (outcome.status, outcome.err) == (0, "")
    for key, budget in (("ram_budget", 65536), ("flash_budget", 1048576), ("stack", 1048576)):
        assert re.search(rf"^memory\.{key} +\d+ +{budget} +\d+\.\d %  ", outcome.out, re.MULTILINE)
    assert "EXCEEDED" not in outcome.out


def test_explain_a_symbol(run: Runner, built: Path, report: Any) -> None:
    found = explained(run, built, "rcl_publish")
    assert (found["kind"], found["of"], found["present"]) == ("symbol", "publish", True)
    assert re.fullmatch(r"src/publish/rcl_publisher\.c:\d+", found["place"])
    line = (
        (built / found["place"].split(":")[0]).read_text().splitlines()[int(found["place"].split(":")[1]) - 1]
    )
    assert "rcl_publish(" in line
    assert found["chain"][0] == "main"
    assert found["chain"][-1] == "rcl_publish"
    assert found["reasons"] == ["profile pure_sender"]
    assert found["entities"] == [
        "publisher /imu/data (sensor_msgs/msg/Imu)",
        "publisher /count (std_msgs/msg/Int32)",
    ]
    assert found["flash"] == next(s["flash"] for s in report["symbols"] if s["name"] == "rcl_publish")


def test_explain_what_is_reached_only_through_a_pointer(run: Runner, built: Path) -> None:
    chain = explained(run, built, "sensor_msgs__msg__Imu__encode")["chain"]
    assert chain[0] == "main"
    assert chain[-2:] == ["sensor_msgs__msg__Imu__message_type", "sensor_msgs__msg__Imu__encode"]


@pytest.mark.system
def test_explain_a_beginning_that_fits_one_symbol_only(run: Runner, built: Path) -> None:
    assert explained(run, built, "rclc_support_in")["name"] == "rclc_support_init"
    outcome = run("explain", str(built), "rcl_publis")
    assert outcome.status == 2
    assert "rcl_publish, rcl_publisher_fini" in outcome.err


@pytest.mark.system
def test_explain_files(run: Runner, built: Path) -> None:
    by_name, by_path = (
        explained(run, built, name)
        for name in ("xrce_stream_reliable.c", "src/stream_reliable/xrce_stream_reliable.c")
    )
    assert by_name == by_path
    assert by_name["of"] == "stream_reliable"
    assert by_name["entities"] == ["publisher /count (std_msgs/msg/Int32)"]
    assert any("reliability: best_effort" in text for text in by_name["removes"])
    header = explained(run, built, "rcl/timer.h")
    assert not header["present"]
    assert "components: [+timers]" in header["note"]


@pytest.mark.system
def test_explain_components_and_types(run: Runner, built: Path, report: Any) -> None:
    ping = explained(run, built, "ping")
    assert ping["reasons"] == ["liveliness: ping (default)"]
    assert any("acknack" in text for text in ping["removes"])
    assert ping["flash"] == next(o["flash"] for o in report["owners"] if o["name"] == "ping")
    header = explained(run, built, "std_msgs/msg/Header")
    assert header["entities"] == ["publisher /imu/data (sensor_msgs/msg/Imu)"]
    text = run("explain", str(built), "ping").out
    assert re.search(r"^removed by +liveliness: acknack, or none", text, re.MULTILINE)
    assert re.search(r"^reached +main → ", text, re.MULTILINE)


def test_explain_what_is_not_in_the_image(run: Runner, built: Path) -> None:
    assert "the linker left it out" in explained(run, built, "rmw_serialize")["note"]
    assert "components: [+executor]" in explained(run, built, "executor")["note"]
    assert "components: [+liveliness_acknack]" in explained(run, built, "liveliness_acknack")["note"]
    outcome = run("explain", str(built), "rcl_publsh")
    assert outcome.status == 2
    assert "Did you mean 'rcl_publish'?" in outcome.err


def test_a_missing_folder(run: Runner, folder: Path) -> None:
    for command in (("size", "."), ("explain", ".", "main")):
        outcome = run(*command)
        assert outcome.status == 2
        assert "not an output folder of microros-gen" in outcome.err
