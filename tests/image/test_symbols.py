# SPDX-License-Identifier: Apache-2.0
"""What `nm` shows: no heap, no stdio, no constructor, no symbol of what is not selected, no name of others."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from microros_gen.interfaces.find import shipped_folder
from microros_gen.selection.find_components import load_catalogue
from microros_gen.toolchain.compile import object_name
from tests.support.matrix import ALSO, FIRST, VARIANTS, Tree, check, compile_tree, has
from tests.support.slices import spread

pytestmark = [
    pytest.mark.skipif(not has("gcc") or not has("nm"), reason="no gcc or no nm"),
    pytest.mark.builds,
]
TreeOf = Callable[[str], Tree]


IN_CI = ("pool",)
"""That of FIRST which `make check` has; CI looks at those of `make lint` besides."""


def _marks(name: str) -> list[pytest.MarkDecorator]:
    """`make test` looks at symbols in tests/runtime, of the C components without a generated application."""
    if name in IN_CI:
        return [pytest.mark.system]
    if name in FIRST:
        return [pytest.mark.system, pytest.mark.variant]
    return [pytest.mark.long if name in ALSO else pytest.mark.lint]


HEAP_AND_STDIO = re.compile(
    r"^_*(malloc|calloc|realloc|reallocarray|free|aligned_alloc|posix_memalign|memalign|alloca|strn?dup|asprintf"
    r"|\w*printf(_chk)?|\w*scanf|f?put[cs]|putchar|f?puts|perror|f(open|close|read|write|flush)"
    r"|std(in|out|err)|abort|exit|atexit|__cxa_\w+|_Znw\w*|_ZdlPv)$"
)
# A freestanding C compiler may call these four whatever the source says (GCC manual, "Standards"); strlen besides.
LIBRARY_MAY_CALL = {
    "memcpy",
    "memmove",
    "memset",
    "memcmp",
    "strlen",
    "strcmp",
    "strncmp",
    "strchr",
    "strcspn",
}
APPLICATION_GIVES = {"stop_motors", "port_watchdog_feed"}
"""What the application defines: what its file names, and the watchdog of a platform whose port has none."""
COMPILER_BRINGS = {"_GLOBAL_OFFSET_TABLE_"}
PREFIXES = (
    "rcl_",
    "rclc_",
    "rcutils_",
    "g_rcutils_",  # variables of ROS 2's logging
    "rmw_",
    "rosidl_",
    "xrce_",
    "ucdr_",
    "uxr_",
    "cdr_",
    "port_",
    "microros_",
    "micro_ros_",
    "utilities_",
)
_DEFINITION = re.compile(
    r"^(?!static\b|typedef\b|extern\b|#|/|\*|\s)[A-Za-z_][\w \t*]*?\b([a-z]\w*)\((?:[^;{}]*)\)\s*\n\{",
    re.MULTILINE,
)


@dataclass(frozen=True)
class Symbols:
    """What each object defines for others, defines for itself, and needs."""

    defined: Mapping[str, frozenset[str]]
    local: Mapping[str, frozenset[str]]
    needed: Mapping[str, frozenset[str]]

    @property
    def all_defined(self) -> frozenset[str]:
        return frozenset().union(*self.defined.values())

    @property
    def everything(self) -> frozenset[str]:
        return self.all_defined.union(*self.local.values())


def symbols_of(objects: Mapping[str, Path]) -> Symbols:
    """Return the symbols of `objects`, by the source that each was made from."""
    output = check(["nm", "-A", "-P", *map(str, objects.values())], Path("/"))
    by_object = {str(path): source for source, path in objects.items()}
    found: dict[str, dict[str, set[str]]] = {kind: {s: set() for s in objects} for kind in ("T", "t", "U")}
    for line in output.splitlines():
        where, name, kind = line.split()[:3]
        source = by_object[where.removesuffix(":")]
        group = "U" if kind in "Uw" else "T" if kind.isupper() else "t"
        # The linker matches a library and an application by their plan: a suffix of some names.
        found[group][source].add(re.sub(r"__plan_[0-9a-f]{16}$", "", name))
    frozen = {k: {s: frozenset(v) for s, v in by_source.items()} for k, by_source in found.items()}
    return Symbols(frozen["T"], frozen["t"], frozen["U"])


OF_A_NODE = re.compile(r"\w+_parameters_(declare|update)|\w+_modes")
"""Functions for the parameters that a node declares, and the table of its modes; they begin with its name."""


@cache
def catalogue() -> Mapping[str, frozenset[str]]:
    """Return the functions that each C file of each component gives to others, read from its text."""
    found = {}
    for component in load_catalogue().values():
        for path in sorted((component.folder / "src").glob("*.c")):
            found[f"src/{component.name}/{path.name}"] = _functions(path)
    return found


def _functions(path: Path) -> frozenset[str]:
    text = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    return frozenset(m.group(1) for m in _DEFINITION.finditer(text))


def _conditional(path: Path) -> frozenset[str]:
    """Return the functions between `#if MICROROS_` and its `#endif`: the plan may leave them out."""
    kept, depths, depth = [], list[int](), 0
    for line in path.read_text(encoding="utf-8").splitlines():
        depth += line.startswith("#if")
        if line.startswith("#if MICROROS_"):
            depths.append(depth)
        if depths:
            kept.append(line)
        if line.startswith("#endif"):
            if depths and depths[-1] == depth:
                depths.pop()
            depth -= 1
    return frozenset(m.group(1) for m in _DEFINITION.finditer("\n".join(kept)))


def unselected(tree: Tree) -> frozenset[str]:
    """Return the symbols that only files give that `tree` did not select; of a template what it became counts."""
    names_of = catalogue()
    own = frozenset().union(
        *(names_of.get(source) or _functions(tree.out / source) for source in tree.sources)
    )
    others = frozenset().union(*(names for source, names in names_of.items() if source not in tree.sources))
    return others - own


@pytest.fixture(scope="module")
def symbols(tree_of: TreeOf, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Symbols]:
    base = tmp_path_factory.mktemp("symbols")

    @cache
    def get(name: str) -> Symbols:
        tree = tree_of(name)
        flags = ("-m64", "-Os", "-ffunction-sections", "-fdata-sections")
        compiled = compile_tree(tree, "gcc", flags, tree.sources, base / name)
        sections = check(["objdump", "-h", *map(str, compiled.objects.values())], base)
        assert not re.search(r"\.(init_array|fini_array|ctors|dtors|preinit_array)", sections)
        return symbols_of(compiled.objects)

    return get


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=_marks(n)) for n in VARIANTS],
)
def test_symbols(tree_of: TreeOf, symbols: Callable[[str], Symbols], name: str) -> None:
    """Everything about one variant in one test: it is compiled only once."""
    tree, found = tree_of(name), symbols(name)
    _needs_nothing_but_memory_functions(found)
    _gives_what_its_sources_say(tree, found)
    assert not found.all_defined & unselected(tree)
    _has_known_prefixes(tree, found)
    if not any("/read/" in source for source in tree.sources):
        _has_no_read_side(found, "creation: reliable" in VARIANTS[name])
    _has_what_the_axes_say(VARIANTS[name], found.everything)
    _creates_as_the_application_says(VARIANTS[name], found.everything)


def _needs_nothing_but_memory_functions(found: Symbols) -> None:
    for source, needed in found.needed.items():
        assert not [n for n in needed if HEAP_AND_STDIO.match(n)], source
        outside = needed - found.all_defined - COMPILER_BRINGS
        if not source.startswith("src/port_posix"):
            assert outside <= LIBRARY_MAY_CALL | APPLICATION_GIVES, source


def _gives_what_its_sources_say(tree: Tree, found: Symbols) -> None:
    """The catalogue, which is read from text, agrees with the compiler; so `unselected` can be believed."""
    for source, names in catalogue().items():
        if source in tree.sources:
            assert names - _conditional(tree.out / source) <= found.defined[source], source
    assert sum(len(names & found.all_defined) for names in catalogue().values()) > 100


def _has_known_prefixes(tree: Tree, found: Symbols) -> None:
    packages = {source.split("/")[1] for source in tree.sources if re.search(r"__\w+\.c$", source)}
    own_prefixes = (*PREFIXES, *(f"{package}__" for package in packages))
    others = [n for n in found.all_defined if not n.startswith(own_prefixes)]
    assert not [n for n in others if not OF_A_NODE.fullmatch(n)]


def _has_no_read_side(found: Symbols, reliable_answers: bool) -> None:
    """Nothing of a pure sender decodes a message, reads, or takes; STATUS alone may come reliably."""
    read = re.compile(r"decode|deserialize|_take_message|datareader|subscri|read_data|cdr_get")
    assert not [n for n in found.everything if read.search(n)]
    assert any("reliable_input" in n for n in found.everything) == reliable_answers


def _creates_as_the_application_says(application: str, names: frozenset[str]) -> None:
    """A preconfigured client has no code for CREATE, DELETE and STATUS; the others have one way to describe."""
    creates = "entities: preconfigured" not in application
    wanted = {"xrce_describe", "xrce_entities_on_status", "xrce_session_leave"}
    assert names & wanted == (wanted if creates else set())
    statics = re.compile(r"^(xrce_creation_|entities_(put|send|begin|refuse|renew)|leave_|session_leave)")
    assert bool([n for n in names if statics.search(n)]) == creates


def _has_what_the_axes_say(application: str, names: frozenset[str]) -> None:
    has_reliable = "best_effort" not in application or "Int32" in application
    has_reliable = has_reliable or "creation: reliable" in application
    assert any("ping" in n for n in names) == ("liveliness:" not in application)
    assert any("liveliness_acknack" in n for n in names) == ("acknack" in application)
    assert any("stream_reliable" in n for n in names) == has_reliable
    assert ("microros_error_state" in names) or "errors: code" in application
    assert any("error_text" in n for n in names) <= ("errors: code" not in application)


_WORDS_OF = {"xml": {b"<dds>", b"KEEP_", b"</name>"}, "reference": {b"participant_profile", b"__dw"}}


@pytest.mark.lint
def test_words_of_other_ways_to_create_are_not_in_an_image(tree_of: TreeOf, tmp_path: Path) -> None:
    """`strings` of a linked image, not only of the library."""
    for name in (
        "pool",
        "pool-acknack-block-xml-reliable",
        "best-effort-reference-reliable-held",
        "best-effort-none-code",
    ):
        tree, application = tree_of(name), VARIANTS[name]
        sources = (*tree.sources, tree.example)
        compiled = compile_tree(tree, "gcc", ("-Os", "-ffunction-sections"), sources, tmp_path / name)
        image = tmp_path / f"{name}.elf"
        objects = map(str, compiled.objects.values())
        check(["gcc", "-Wl,--gc-sections", *objects, "-o", str(image)], tmp_path)
        linked = {word for words in _WORDS_OF.values() for word in words if word in image.read_bytes()}
        wanted = next((words for way, words in _WORDS_OF.items() if f"entities: {way}" in application), set())
        assert linked == wanted, name


@pytest.mark.parametrize("name", spread(VARIANTS, 12))
def test_an_error_text_is_there_only_where_it_is_asked_for(tree_of: TreeOf, name: str) -> None:
    texts = {"src/support/error_text.c", "src/support/error_code.c"}
    wanted = "src/support/error_code.c" if "errors: code" in VARIANTS[name] else "src/support/error_text.c"
    assert texts & set(tree_of(name).sources) == {wanted}


def test_the_catalogue_knows_what_is_optional() -> None:
    names_of = catalogue()
    assert "xrce_ping_step" in names_of["src/ping/xrce_ping.c"]
    assert "rcl_publish" in names_of["src/publish/rcl_publisher.c"]
    assert any(
        n.startswith("xrce_stream_reliable") for n in names_of["src/stream_reliable/xrce_stream_reliable.c"]
    )


@pytest.mark.system
def test_the_built_library_and_image(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What `build` makes, with its own flags: the archive holds exactly sources.txt, the image only what it calls."""
    for variable in ("CC", "AR", "CFLAGS"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.chdir(tmp_path)
    arguments = ["build", "--profile", "pure_sender", "--interface-path", str(shipped_folder()), "-o", "out"]
    with pytest.raises(SystemExit) as end:
        cli.main(arguments)
    assert end.value.code == 0
    tree = Tree("built", tmp_path / "out")
    members = check(["ar", "t", "lib/libmicroros.a"], tree.out).split()
    assert sorted(members) == sorted(Path(object_name(source)).name for source in tree.sources)
    needed = check(["nm", "-u", "lib/libmicroros.a"], tree.out).split()
    assert not [n for n in needed if HEAP_AND_STDIO.match(n)]
    _image_holds_only_what_is_selected(tree)


def _image_holds_only_what_is_selected(tree: Tree) -> None:
    lines = check(["nm", "-P", "bin/pure_sender"], tree.out).splitlines()
    defined = {line.split()[0] for line in lines if line.split()[1] not in "Uw"}
    imported = {line.split()[0].split("@")[0] for line in lines if line.split()[1] == "U"}
    assert "rcl_publish" in defined
    assert not defined & unselected(tree)
    main = check(["nm", "-u", ".build/examples/pure_sender/main.o"], tree.out).split()
    assert not [n for n in imported if HEAP_AND_STDIO.match(n) and n not in main], "main.c alone may print"
    unused = {"rcl_publish_serialized_message", "rmw_serialize", "rcutils_uint8_array_resize"}
    assert not defined & unused, "the linker drops what is not called"
