# SPDX-License-Identifier: Apache-2.0
"""clang-tidy, cppcheck, MISRA's rules, every warning of gcc and clang: the corpus (docs/verification/quality.md)."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pytest

from microros_gen.selection.find_components import load_catalogue
from tests.support.paths import ROOT
from tests.support.quality import analyzer, misra
from tests.support.quality.corpus import (
    Tree,
    Unit,
    analyze,
    configuration_flags,
    covered,
    ready_components,
    run,
    tree_key,
    units,
    width_flags,
)
from tests.support.quality.covering import conditions, covering_units

pytestmark = pytest.mark.builds

SUPPRESSIONS = ROOT / "tests" / "quality" / "cppcheck-suppressions.txt"
TIDY = ROOT / ".clang-tidy"
COMMON = ("-std=c99", "-Iinclude", "-fsyntax-only")
GCC = (
    *(
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Wconversion",
        "-Wsign-conversion",
        "-Wshadow",
        "-Wundef",
        "-Wcast-qual",
    ),
    *(
        "-Wstrict-prototypes",
        "-Wmissing-prototypes",
        "-Wold-style-definition",
        "-Wredundant-decls",
        "-Wwrite-strings",
    ),
    *(
        "-Wduplicated-cond",
        "-Wlogical-op",
        "-Wformat=2",
        "-Wvla",
    ),
    *("-Walloca", "-Wdouble-promotion", "-Wbad-function-cast", "-Wswitch-enum", "-Wfloat-conversion"),
)
CLANG = (
    "-Weverything",
    "-Wno-unknown-warning-option",  # newer versions know more of these
    "-Wno-covered-switch-default",  # a default stands in each switch, as MISRA 16.4 wants
    "-Wno-missing-noreturn",  # C99 cannot express it
    "-Wno-unreachable-code",  # CDR_IS_RUN: a constant of the target picks one copy or single fields
    "-Wno-padded",  # structs are ROS 2's, or ordered for reading; sizes are asserted
    "-Wno-declaration-after-statement",  # C99: a variable is declared where its value is known
    "-Wno-unsafe-buffer-usage",  # newer versions: wants C++'s containers
    "-Wno-switch-default",  # newer versions: contradicts -Wcovered-switch-default
    "-Wno-format-nonliteral",  # rcutils_vsnprintf hands its format on; the attribute that says so is an extension
    "-Wno-float-equal",  # are_equal of messages compares as ROS 2's does
    "-Wno-reserved-identifier",  # ROS 2's names have a double underscore between package and type
    "-Wno-reserved-macro-identifier",  # _POSIX_C_SOURCE, for POSIX to read
    "-Wno-unused-macros",  # macros of one file that only some plans use
    "-Wno-disabled-macro-expansion",  # macros of the C library that expand to their own name
    "-Wno-documentation",  # comments of interface files are carried over as they are
    "-Wno-documentation-unknown-command",
)


@pytest.mark.lint
def test_corpus_holds_every_source(trees: list[Tree]) -> None:
    """Every C file and every C template of a component that is ready is in some tree.

    Ports to kernels are not: their headers are no packages (tests/platform/test_kernels.py). Nor is what only AVR has,
    which avr-gcc compiles with the same warnings (tests/firmware/test_avr.py): it includes headers of avr-libc.
    """
    kernels = {f"port_{path.name}" for path in (ROOT / "tests" / "platform" / "kernels").iterdir()}
    wanted = set()
    for name in set(ready_components()) - kernels - {"port_avr"}:
        folder = load_catalogue()[name].folder / "src"
        wanted |= {f"{name}/{path.name.removesuffix('.j2')}" for path in folder.glob("*.c*")}
    narrow = {"port_bare/port_bare_serial_narrow.c", "port_bare/port_bare_time_narrow.c"}
    narrow |= {"support/error_text_flash.c"}
    assert sorted(wanted - covered(trees) - narrow) == []


@pytest.mark.lint
def test_corpus_holds_every_template_of_types(trees: list[Tree]) -> None:
    sources = covered(trees)
    for ending in ("functions", "type_support", "storage", "members"):
        assert f"quality_msgs/tree__{ending}.c" in sources


@pytest.mark.lint
def test_a_part_of_the_corpus_has_each_line(tmp_path: Path) -> None:
    """What `make lint` reads: files that differ in numbers and texts only count once, those with another line twice."""
    code = 'const char *f(int a)\n{\n    return (a > 1) ? "x" : "y";\n}\n'
    texts = {
        "src/read/a.c": [code, code.replace("1", "0x20").replace('"x"', '"\\""'), code.replace(">", "<")],
        "src/p_msgs/t__storage.c": [code, code.replace("f(", "g("), code.replace("int", "long")],
        "src/q_msgs/u__storage.c": [code.replace("f(", "h(")],
    }
    trees: list[Tree] = []
    for source, versions in texts.items():
        for number, text in enumerate(versions):
            path = tmp_path / f"{len(trees)}" / source
            path.parent.mkdir(parents=True)
            path.write_text(text, encoding="utf-8")
            trees.append(Tree(f"{source} {number}", tmp_path / f"{len(trees)}", (source,)))
    assert [unit.tree.name for unit in covering_units(trees)] == [
        *("src/read/a.c 0", "src/read/a.c 2"),
        *("src/p_msgs/t__storage.c 0", "src/p_msgs/t__storage.c 2"),
    ]


@pytest.mark.long
def test_corpus_holds_one_unit_a_difference(trees: list[Tree]) -> None:
    every = units(trees)
    assert len({unit.key for unit in every}) < len(every)


def complaints(answers: dict[str, str]) -> str:
    return "\n".join(text for text in answers.values() if text)


@pytest.mark.lint
@pytest.mark.skipif(not shutil.which("clang-tidy"), reason="no clang-tidy")
def test_clang_tidy(all_units: list[Unit]) -> None:
    """What is off, and why, stands in .clang-tidy."""
    version = run(["clang-tidy", "--version"], ROOT).stdout

    def check(unit: Unit) -> str:
        # One function encodes all fields of a message, one copies them, one adds all parameters, one returns each
        # counter, one of the generated example adds all handles of its executors: as long as these, step by step.
        is_generated = unit.source.startswith("examples/") or unit.source.endswith(
            (
                "__type_support.c",
                "/rmw_local_tables.c",
                "/rclc_parameter_declared.c",
                "/rcl_diagnosis_declared.c",
            )
        )
        lengths = ["--checks=-readability-function-cognitive-complexity,-readability-function-size"]
        options = ["--quiet", f"--config-file={TIDY}", *(lengths if is_generated else [])]
        flags = ["-std=c99", "-Iinclude", *width_flags(unit), *analyzer.limit(analyzer.NODES)]
        done = run(["clang-tidy", *options, unit.source, "--", *flags], unit.tree.out)
        return done.stdout + done.stderr if done.returncode else ""

    name = f"clang-tidy, {analyzer.NODES} nodes, long generated {version} {TIDY.read_text(encoding='utf-8')}"
    assert complaints(analyze(name, all_units, check)) == ""


@pytest.mark.lint
def test_each_condition_is_read_in_every_configuration_once(tmp_path: Path) -> None:
    """Of two files with one header that has a condition, the first; then one with its own; no guard counts."""
    header = "#ifndef H\n#define H\n#if A > 0u\nextern int a;\n#endif\n#endif\n"
    texts = {"src/read/a.c": "", "src/read/b.c": "int b;\n", "src/read/c.c": "#ifdef C\nint c;\n#endif\n"}
    (tmp_path / "include").mkdir()
    (tmp_path / "include" / "h.h").write_text(header)
    (tmp_path / "src" / "read").mkdir(parents=True)
    for source, text in texts.items():
        (tmp_path / source).write_text(f"#include <h.h>\n{text}")
    found = covering_units([Tree("one", tmp_path, tuple(texts))])
    assert [(unit.source[-3], unit.in_every_configuration) for unit in found] == [
        *(("a", True), ("b", False), ("c", True)),
    ]
    assert conditions(found[0].tree, "src/read/a.c") == {("include/h.h", "#if A > 0u")}


@pytest.mark.lint
@pytest.mark.skipif(not shutil.which("cppcheck"), reason="no cppcheck")
def test_cppcheck(trees: list[Tree], tree_units: list[Unit], is_every_unit: bool) -> None:
    """What is suppressed, and why, stands in cppcheck-suppressions.txt. The long run checks each tree as a whole."""
    checks = ("--enable=warning,style,performance,portability", "--inline-suppr", "--error-exitcode=1")
    options = ("-q", "--std=c99", *checks, f"--suppressions-list={SUPPRESSIONS}", "-Iinclude")

    def check(unit: Unit) -> str:
        sources = [unit.source] if unit.source else ["src", "examples"]
        done = run(["cppcheck", *options, *configuration_flags(unit), *sources], unit.tree.out)
        return f"{unit.tree.name}: {done.stdout}{done.stderr}" if done.returncode else ""

    version = run(["cppcheck", "--version"], ROOT).stdout
    name = f"cppcheck of files {version} {options} {SUPPRESSIONS.read_text(encoding='utf-8')}"
    every = [Unit(tree, "", tree_key(tree)) for tree in trees] if is_every_unit else tree_units
    assert complaints(analyze(name, every, check)) == ""


def compile_quietly(compiler: str, flags: Sequence[str], each: list[Unit]) -> str:
    """Return what `compiler` says of each different file."""

    def check(unit: Unit) -> str:
        done = run([compiler, *flags, *width_flags(unit), unit.source], unit.tree.out)
        return f"{unit.tree.name}: {done.stderr}" if done.stderr or done.returncode else ""

    version = run([compiler, "--version"], ROOT).stdout.splitlines()[0]
    return complaints(analyze(f"{version} {flags}, ports 32 bit", each, check))


@pytest.mark.lint
@pytest.mark.skipif(not shutil.which("gcc"), reason="no gcc")
@pytest.mark.parametrize(
    "level", ["-Os", *(pytest.param(level, marks=pytest.mark.long) for level in ("-O0", "-O3"))]
)
def test_gcc_optimizing(all_units: list[Unit], level: str) -> None:
    """All warnings, with those that need the flow of data at several levels; the analyzer once.

    -O0 warns where -Os does, in places with other words, and besides in functions that nothing calls.
    """
    flags = ("-std=c99", "-Iinclude", *GCC, level, "-c", "-o", "/dev/null")
    assert compile_quietly("gcc", (*flags, "-fanalyzer") if level == "-Os" else flags, all_units) == ""


@pytest.mark.lint
@pytest.mark.skipif(not shutil.which("clang"), reason="no clang")
def test_clang_everything(all_units: list[Unit]) -> None:
    assert compile_quietly("clang", (*COMMON, *CLANG), all_units) == ""


@pytest.fixture(scope="module")
def places(trees: list[Tree], tree_units: list[Unit], is_every_unit: bool) -> misra.Places:
    if misra.find_addon() is None:
        pytest.skip("no cppcheck with its addons")
    return misra.check(trees, tree_units, is_whole=is_every_unit)


@pytest.mark.lint
def test_misra_finds_nothing_undocumented(places: misra.Places) -> None:
    assert "\n".join(misra.undocumented(places, misra.load_deviations())) == ""


@pytest.mark.long
def test_misra_deviations_are_used(trees: list[Tree]) -> None:
    places = misra.check(trees, units(trees))
    assert misra.unused(places, misra.load_deviations()) == []


@pytest.mark.skipif(misra.find_addon() is None, reason="no cppcheck with its addons")
def test_misra_page_is_current() -> None:
    """docs/verification/quality.md is as `make misra` writes it, with the version of cppcheck that it names."""
    if misra.tool_version() not in misra.page_table():
        pytest.skip(
            f"docs/verification/quality.md was written with another cppcheck than {misra.tool_version()}"
        )
    assert misra.page_table() == misra.table(misra.load_deviations()), "run: make misra"


def test_misra_deviations_name_no_mandatory_rule() -> None:
    rules = [d.rule for d in misra.load_deviations()]
    assert not misra.MANDATORY.intersection(rules)
    assert [rule for rule, count in Counter(rules).items() if count > 1] == []
    assert all(d.where for d in misra.load_deviations())
    texts = [text for d in misra.load_deviations() for text in (d.why, d.risk)]
    assert [text for text in texts if not text.endswith(".")] == [], "YAML takes ` #` for a comment"


def test_misra_sees_a_finding_without_deviation() -> None:
    """The comparison itself: a new rule, a known rule elsewhere, and a deviation without a finding."""
    deviation = misra.Deviation("17.7", ("src/a/*",), "why", "risk")
    assert misra.undocumented({("17.7", "src/a/x.c"): 1}, [deviation]) == []
    assert misra.undocumented({("17.7", "src/b/x.c"): 2}, [deviation]) == ["17.7 src/b/x.c: 2"]
    assert misra.undocumented({("17.2", "src/a/x.c"): 1}, [deviation]) == ["17.2 src/a/x.c: 1"]
    assert misra.unused({("17.2", "src/a/x.c"): 1}, [deviation]) == ["17.7 src/a/*"]


@pytest.mark.skipif(misra.find_addon() is None, reason="no cppcheck with its addons")
def test_misra_addon_runs(tmp_path: Path) -> None:
    """A file that breaks a rule is told: the tool chain of the report works."""
    (tmp_path / "bad.c").write_text("int f(int a) { if (a) { goto end; } end: return 0; }\n")
    trees = [Tree("bad", tmp_path, ("bad.c",))]
    answer = misra.check(trees, units(trees))
    assert ("15.1", "bad.c") in answer
