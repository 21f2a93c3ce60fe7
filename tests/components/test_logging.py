# SPDX-License-Identifier: Apache-2.0
"""Log messages: what the image has of them, formats, macros, levels and writers."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from microros_gen import compiler
from microros_gen.components.logging.plan import LoggingPlan
from microros_gen.components.logging_rosout.plan import RosoutPlan
from microros_gen.diagnostics import UserError
from microros_gen.interfaces.find import shipped_folder
from microros_gen.output.tree import MANIFEST
from microros_gen.platform.find import builtin_targets
from microros_gen.toolchain.toolchain import WARNINGS
from tests.support.components.rendered import SANITIZE, planned, program_of, rendered, run
from tests.support.ids import without_id
from tests.support.paths import ROOT

BARE = "version: 1\nprofiles: [pure_sender]\ninterfaces: [std_msgs/msg/Int32]\n"
BOARDS = [name for name in builtin_targets() if name.startswith("qemu-")]


def slice_of(found: compiler.Planned) -> LoggingPlan:
    part = found.project.runtime.features.of("logging")
    assert isinstance(part, LoggingPlan)
    return part


@pytest.fixture(scope="module")
def verbose(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the output folder of an application whose console gets everything."""
    return rendered(tmp_path_factory.mktemp("verbose"), BARE + "logging: [{to: console, level: debug}]\n")


def unit(out: Path, name: str, *flags: str) -> str:
    return run(program_of(out, name, by=("gcc", (*SANITIZE, *flags))))


@pytest.mark.system
def test_formats_are_those_of_the_c_library(verbose: Path) -> None:
    assert int(run(program_of(verbose, "unit_log_format.c")).split()[0]) > 100_000


@pytest.mark.system
def test_floating_point_where_it_is_selected(tmp_path: Path) -> None:
    out = rendered(tmp_path, BARE + "logging: console\ncomponents: [+logging_float]\n")
    assert int(unit(out, "unit_log_float.c", "-O1").split()[0]) > 90_000


@pytest.mark.system
def test_wide_characters_where_they_are_selected(tmp_path: Path) -> None:
    """Against vsnprintf in a locale of UTF-8."""
    out = rendered(tmp_path, BARE + "logging: console\ncomponents: [+logging_wide]\n")
    assert int(unit(out, "unit_log_wide.c").split()[0]) > 700


def test_an_image_has_floating_point_only_where_it_is_selected(verbose: Path, tmp_path: Path) -> None:
    """Without it, not even a conversion of a double is linked (Arm, numbers in software)."""
    chosen = rendered(tmp_path, BARE + "logging: console\ncomponents: [+logging_float]\n")
    folder = Path("src/logging/rcutils_format.c")
    needed = {}
    for name, out in (("without", verbose), ("with", chosen)):
        compiled = tmp_path / f"{name}.o"
        run(
            "arm-none-eabi-gcc",
            "-mcpu=cortex-m0plus",
            "-c",
            f"-I{out / 'include'}",
            out / folder,
            "-o",
            compiled,
        )
        needed[name] = set(run("arm-none-eabi-nm", "-u", compiled).split()) - {"U"}
    assert needed["with"] - needed["without"] == {"microros_format_floating"}
    assert not [name for name in needed["without"] if re.match("__aeabi_[df]", name)]
    assert not (verbose / "src/logging_float").exists()


def test_names_of_loggers_have_room_for_those_of_nodes(tmp_path: Path) -> None:
    nodes = "nodes: [{name: a_long_name_of_a_node, namespace: /in/a_namespace}, {name: b}]\n"
    found = planned(tmp_path, f"version: 1\nprofiles: [pure_sender]\nlogging: rosout\n{nodes}")
    size = len("in.a_namespace.a_long_name_of_a_node") + 1
    assert slice_of(found).name_size == size
    assert found.project.runtime.entities.logger_name_size == size
    rosout = found.project.runtime.features.of("logging_rosout")
    assert isinstance(rosout, RosoutPlan)
    assert rosout.name == size - 1


def test_macros_levels_and_the_console(verbose: Path) -> None:
    run(program_of(verbose, "unit_logging.c"))


_LEVELS = ("debug", "info", "warn", "error", "fatal")
_VARIANTS = {
    "": "",
    "_NAMED": "name, ",
    "_ONCE": "",
    "_ONCE_NAMED": "name, ",
    "_EXPRESSION": "limit > 2, ",
    "_EXPRESSION_NAMED": "++limit > 2, name, ",
    "_FUNCTION": "filter, ",
    "_FUNCTION_NAMED": "&filter, name, ",
    "_SKIPFIRST": "",
    "_SKIPFIRST_NAMED": "name, ",
    "_THROTTLE": "now, 100, ",
    "_SKIPFIRST_THROTTLE": "now, 100, ",
    "_THROTTLE_NAMED": "RCUTILS_STEADY_TIME, 100, name, ",
    "_SKIPFIRST_THROTTLE_NAMED": "now, PERIOD, name, ",
}
"""The arguments before the format; what they use is used nowhere else."""
_STATEMENT = """\
  if (number == 1)
    RCUTILS_LOG_{level}{variant}({before}"text of {text}");
  else
    RCUTILS_LOG_{level}{variant}({before}"text of {text} %d", number);
"""
_BEGIN = """\
#include <rcutils/logging_macros.h>

enum { PERIOD = 100 };

static rcutils_ret_t now(rcutils_time_point_value_t * time)
{
  *time = 0;
  return RCUTILS_RET_OK;
}

static bool filter(void)
{
  return true;
}

void application(int number, const char * name);
void application(int number, const char * name)
{
  int limit = number * 3;

"""
MACROS = (
    _BEGIN
    + "".join(
        _STATEMENT.format(level=level.upper(), variant=variant, before=before, text=level)
        for level in _LEVELS
        for variant, before in _VARIANTS.items()
    )
    + "}\n"
)


def texts(out: Path, *flags: str) -> set[str]:
    """Return which levels have their text in the object of a program that logs with each."""
    source, target = out / "macros.c", out / "macros.o"
    source.write_text(MACROS)
    run("gcc", "-std=c99", *WARNINGS, *flags, f"-I{out / 'include'}", "-c", source, "-o", target)
    found = run("strings", target)
    return {level for level in ("debug", "info", "warn", "error", "fatal") if f"text of {level}" in found}


@pytest.mark.parametrize("optimized", ["-O0", "-Os"])
def test_levels_below_those_of_the_build_are_not_in_the_image(tmp_path: Path, optimized: str) -> None:
    out = rendered(tmp_path, BARE + "logging: [{to: callback, level: error}, {to: console, level: warn}]\n")
    assert texts(out, optimized) == {"warn", "error", "fatal"}
    raised = "-DRCUTILS_LOG_MIN_SEVERITY=RCUTILS_LOG_MIN_SEVERITY_FATAL"
    assert texts(out, optimized, raised) == {"fatal"}
    assert texts(out, optimized, "-DRCUTILS_LOG_MIN_SEVERITY=RCUTILS_LOG_MIN_SEVERITY_NONE") == set()


@pytest.mark.parametrize("optimized", ["-O0", "-Os"])
def test_without_logging_the_macros_are_nothing(tmp_path: Path, optimized: str) -> None:
    """The compiler still checks format and arguments."""
    out = rendered(tmp_path, BARE)
    assert texts(out, optimized) == set()
    assert "macros.c" not in run("nm", "--undefined-only", out / "macros.o")
    assert not [line for line in run("nm", out / "macros.o").splitlines() if " U " in line or " b " in line]
    wrong = out / "wrong.c"
    wrong.write_text(
        '#include <rcutils/logging_macros.h>\nvoid f(void);\nvoid f(void) { RCUTILS_LOG_INFO("%s", 3); }\n'
    )
    command = ["gcc", "-std=c99", *WARNINGS, "-Werror", f"-I{out / 'include'}", "-fsyntax-only", str(wrong)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert "format" in done.stderr


@pytest.mark.parametrize("logging", ["", "logging: [{to: console, level: debug}]\n"], ids=["without", "with"])
def test_the_macros_in_cpp(tmp_path: Path, logging: str) -> None:
    out = rendered(tmp_path, BARE + logging)
    source = out / "macros.cpp"
    source.write_text(MACROS)
    flags = ("-Wall", "-Wextra", "-Wold-style-cast", "-Wunreachable-code", "-Werror", f"-I{out / 'include'}")
    for compiler_name in ("g++", "clang++"):
        run(compiler_name, *flags, "-fsyntax-only", source)


def test_both_headers_have_the_same_macros() -> None:
    folder = ROOT / "microros_gen" / "components"
    heads = [
        {line for line in text.splitlines() if line.startswith("#define RCUTILS_LOG_") and "(" in line}
        for part in ("support", "logging")
        if (text := (folder / part / "include" / "rcutils" / "logging_macros.h").read_text())
    ]
    without, selected = ({line.partition("(")[0].split()[1] for line in found} for found in heads)
    levels = ("DEBUG", "INFO", "WARN", "ERROR", "FATAL")
    assert {name for name in selected if name.split("_")[2] in levels} == without
    assert len(without) == 5 * 14


@pytest.mark.ros
def test_ros_has_the_same_macros() -> None:
    (path,) = Path(sys.prefix, "include").rglob("rcutils/logging_macros.h")
    heads = set(re.findall(r"define (RCUTILS_LOG_(?:DEBUG|INFO|WARN|ERROR|FATAL)\w*)\(", path.read_text()))
    folder = ROOT / "microros_gen" / "components" / "support" / "include" / "rcutils"
    own = set(re.findall(r"#define (RCUTILS_LOG_\w+)\(", (folder / "logging_macros.h").read_text()))
    assert own == heads


def test_the_console_of_a_board_is_its_standard_output(tmp_path: Path) -> None:
    found = planned(tmp_path, BARE + "logging: console\ntarget: qemu-mps2-an386\n")
    files = compiler.render(found)
    assert "src/port_bare/port_bare_console.c" in files
    assert not any("port_posix_console" in name for name in files)


@pytest.mark.parametrize(
    ("text", "levels"),
    [
        ("components: [+logging]\n", (20, 60, 20)),
        ("components: [+logging_console]\n", (20, 20, 60)),
        ("logging: console\n", (20, 20, 60)),
        ("logging: [{to: console, level: debug}, {to: callback, level: error}]\n", (10, 10, 40)),
        ("logging: {console}\n".replace("{console}", "[{to: callback, level: fatal}]"), (50, 60, 50)),
    ],
)
def test_the_lowest_level_is_that_of_the_build(
    tmp_path: Path, text: str, levels: tuple[int, int, int]
) -> None:
    part = slice_of(planned(tmp_path, BARE + text))
    assert (part.level, part.console_level, part.callback_level) == levels
    assert part.min_severity == levels[0] // 10 - 1


def test_the_profile_with_log_messages_has_a_node_without_an_application_file() -> None:
    options = compiler.Options(
        profiles=("configurable_sender_with_diagnostics",), interface_paths=(shipped_folder(),)
    )
    found = compiler.plan(compiler.resolve(compiler.read_source(None, Path(), options)))
    assert [n.name for n in found.project.runtime.entities.nodes.declared] == ["device"]
    assert {p.topic for p in found.project.runtime.entities.publishers.declared} == {
        "/diagnostics",
        "/parameter_events",
    }


def test_another_level_makes_another_plan_id(tmp_path: Path) -> None:
    texts = ("logging: console\n", "logging: callback\n", "logging: [{to: console, level: warn}]\n")
    assert len({planned(tmp_path, BARE + text).project.runtime.plan_id for text in texts}) == 3


def test_another_size_for_loggers_makes_another_plan_id(tmp_path: Path) -> None:
    pools = ("", "pools: {loggers: 5}\n", "pools: {logger_name_size: 40}\n")
    ids = {planned(tmp_path, BARE + "logging: console\n" + text).project.runtime.plan_id for text in pools}
    assert len(ids) == len(pools)


def test_a_writer_is_named_once(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, BARE + "logging: [console, {to: console, level: debug}]\n")
    (reported,) = caught.value.diagnostics
    assert "4:20: error: duplicate writer 'console' in 'logging'" in without_id(reported.headline())


@pytest.mark.parametrize(
    ("text", "ending"),
    [
        ("rsout", "it is the text 'rsout'. Did you mean 'rosout'?"),
        ("none", "it is the text 'none'. Write `components: [-logging]` instead of this line"),
        ("false", "it is false. Write `components: [-logging]` instead of this line"),
        ("true", "it is true. Write console"),
        ("{to: console}", "it is a mapping. Write [{to: console}]"),
    ],
)
def test_a_word_that_is_no_writer_gets_a_hint_that_helps(tmp_path: Path, text: str, ending: str) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, BARE + f"logging: {text}\n")
    (reported,) = caught.value.diagnostics
    expected = "'logging' must be console, callback, rosout or ring, or a list of such writers; "
    assert without_id(reported.headline()).endswith(f"4:10: error: {expected}{ending}")


def test_what_the_hint_says_leaves_logging_out(tmp_path: Path) -> None:
    """Also where a profile selects it; where none does, it is a warning."""
    nodes = "version: 1\nprofiles: [configurable_sender_with_diagnostics]\nnodes: [{name: device}]\n"
    for text, warned in (
        (nodes, []),
        (BARE, ["'-logging' drops nothing: no selected profile has 'logging'"]),
    ):
        found = planned(tmp_path, f"{text}components: [-logging]\n")
        assert [d.message for d in found.warnings if "logging" in d.message] == warned
        assert "LoggingPlan" not in str(found.project.runtime.features)
    assert "LoggingPlan" in str(planned(tmp_path, f"{BARE}logging: console\n").project.runtime.features)


def test_a_console_that_goes_nowhere_is_reported(tmp_path: Path) -> None:
    board = tmp_path / "silent.yaml"
    board.write_text("target: silent\nextends: qemu-mps2-an386\nstdio: {to: none}\n")
    found = planned(tmp_path, BARE + f"logging: console\ntarget: ./{board.name}\n")
    reported = [without_id(d.headline()) for d in found.warnings]
    assert any("the log writer 'console' writes nowhere: the target silent" in text for text in reported)


WAITS = "the log writer 'console' waits until mine has output each byte"
FEW = "the log writer 'console' has 191 bytes, and a line takes up to 192"
USELESS = "'size' of the log writer 'console' has no effect: mine keeps no lines for it"


@pytest.mark.parametrize(
    ("target", "size", "messages"),
    [
        ("stdio: {to: uart, driver: cmsdk, base: 0x40005000, irq: 2}\n", "", []),
        ("provides: [console_send]\n", "", []),
        ("provides: [console]\n", "", []),
        ("stdio: {to: uart, driver: cmsdk, base: 0x40005000}\n", "", [WAITS]),
        ("stdio: {to: semihosting}\n", "", [WAITS]),
        ("stdio: {to: application}\n", ", size: 512", [USELESS, WAITS]),
        ("provides: [console_send]\n", ", size: 192", []),
        ("provides: [console_send]\n", ", size: 191", [FEW]),
        ("provides: [console_send]\n", ", size: 0", [FEW.replace("191", "0")]),
    ],
)
def test_a_console_that_waits_is_reported(
    tmp_path: Path, target: str, size: str, messages: list[str]
) -> None:
    (tmp_path / "mine.yaml").write_text(f"target: mine\nextends: qemu-mps2-an386\n{target}")
    text = BARE + f"logging: [{{to: console{size}}}]\nsession: {{key: 7}}\ntarget: ./mine.yaml\n"
    try:
        reported = planned(tmp_path, text).warnings
    except UserError as refused:
        reported = tuple(refused.diagnostics)
    assert [found.message for found in reported] == messages


@pytest.mark.parametrize("name", BOARDS)
@pytest.mark.parametrize("selects", ["logging: console\n", "components: [+logging_console]\n"])
def test_an_emulated_board_has_a_console(tmp_path: Path, name: str, selects: str) -> None:
    """QEMU prints it, and nothing is left to the application; without it the image is as before."""
    base = f"version: 1\nprofiles: [pure_sender]\ntarget: {{name: {name}}}\n"
    found = planned(tmp_path, base + selects)
    assert not [warning for warning in found.warnings if "stdio_put" in warning.message]
    files = compiler.render(found)
    assert "-semihosting-config" in json.loads(files[MANIFEST])["emulator"]["arguments"]
    assert any(path.endswith("/port_bare_stdio_semihosting.c") for path in files)
    plain = compiler.render(planned(tmp_path, base))
    assert "-semihosting-config" not in json.loads(plain[MANIFEST])["emulator"]["arguments"]
    assert not any("stdio" in path for path in plain if path.startswith("src/"))


@pytest.mark.parametrize(
    "keys", ["stdio: {to: application}\n", "provides: [stdio_put]\n", "provides: [console]\n"]
)
def test_a_console_of_the_application_stays(tmp_path: Path, keys: str) -> None:
    (tmp_path / "mine.yaml").write_text(f"target: mine\nextends: qemu-mps2-an386\n{keys}")
    found = planned(tmp_path, BARE + "logging: console\ntarget: ./mine.yaml\n")
    assert not any("semihosting" in path for path in compiler.render(found))


NODE = "version: 1\nprofiles: [pure_sender]\nnodes: [{name: device}]\n"


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        (
            "logging: [{to: callback, size: 512}]\n",
            "4:11",
            "the log writer 'callback' keeps no lines, so it has no size",
        ),
        (
            "logging: [{to: rosout, size: 100}]\n",
            "4:11",
            "the log writer 'rosout' has room for 100 bytes, and a line takes up to 290",
        ),
        (
            "logging: [{to: rosout, size: 0}]\n",
            "4:11",
            "the log writer 'rosout' has room for 0 bytes, and a line takes up to 290",
        ),
        (
            "logging: rosout\nendpoints: {/rosout: {limits: {msg: 9}}}\n",
            "5:13",
            "the limits of '/rosout' cannot differ from those of its type",
        ),
    ],
)
def test_sizes_that_do_not_fit_are_reported(tmp_path: Path, text: str, place: str, message: str) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, NODE + text)
    (reported,) = caught.value.diagnostics
    assert reported.span is not None
    assert (f"{reported.span.line}:{reported.span.column}", reported.message) == (place, message)


def test_rosout_needs_a_node(tmp_path: Path) -> None:
    with pytest.raises(UserError) as caught:
        planned(tmp_path, BARE + "logging: rosout\n")
    (reported,) = caught.value.diagnostics
    assert reported.span is not None
    assert reported.span.line == 4
    assert "'/rosout', which a component opens by itself, needs a declared node" in reported.message


def test_limits_of_the_type_are_those_of_lines(tmp_path: Path) -> None:
    found = rendered(tmp_path, NODE + "logging: rosout\nlimits: {rcl_interfaces/msg/Log: {msg: 300}}\n")
    config = (found / "include" / "microros_config.h").read_text()
    assert "MICROROS_LOG_ROSOUT_TEXT 300u" in config
    assert "MICROROS_LOG_ROSOUT_FILE 48u" in config


def test_without_rosout_nothing_of_it_is_in_the_output(tmp_path: Path) -> None:
    files = compiler.render(planned(tmp_path, NODE + "logging: console\n"))
    assert not [name for name in files if "rcl_interfaces" in name or name.startswith("src/logging_rosout")]


@pytest.mark.parametrize(
    ("limits", "most"), [("", 4), ("{rcl_interfaces/srv/SetLoggerLevels_Request: {levels: 7}}", 7)]
)
def test_a_request_of_the_logger_services_fits_their_memory(tmp_path: Path, limits: str, most: int) -> None:
    text = (
        NODE
        + "components: [+logger_services]\nlogging: callback\n"
        + (f"limits: {limits}\n" if limits else "")
    )
    config = (rendered(tmp_path, text) / "include" / "microros_config.h").read_text()
    assert f"MICROROS_LOGGER_REQUEST_MAX {most}u" in config
