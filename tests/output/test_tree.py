# SPDX-License-Identifier: Apache-2.0
"""Writing the output folder: atomic, only what changed, only what is ours, right again after any interruption."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import threading
from pathlib import Path

import pytest

from microros_gen.diagnostics import UserError
from microros_gen.output import tree
from microros_gen.output.tree import JOURNAL, MANIFEST, write_tree


def digests(content: dict[str, bytes]) -> dict[str, str]:
    return {name: hashlib.sha256(data).hexdigest() for name, data in content.items()}


def tree_of(**files: str) -> dict[str, bytes]:
    content = {name.replace("__", "/").replace("_c", ".c"): text.encode() for name, text in files.items()}
    manifest = {"generator": {"name": "microros-gen"}, "outputs": digests(content)}
    return content | {MANIFEST: json.dumps(manifest).encode()}


def held(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_writes_every_file_and_no_other(tmp_path: Path) -> None:
    files = tree_of(src__a_c="a", src__b_c="b")
    report = write_tree(tmp_path / "out", files)
    assert held(tmp_path / "out") == files
    assert set(report.written) == set(files)


def test_an_unchanged_file_keeps_its_time(tmp_path: Path) -> None:
    write_tree(tmp_path, tree_of(src__a_c="a", src__b_c="b"))
    os.utime(tmp_path / "src/a.c", (1, 1))
    report = write_tree(tmp_path, tree_of(src__a_c="a", src__b_c="changed"))
    assert (tmp_path / "src/a.c").stat().st_mtime == 1
    assert report.written == ("manifest.json", "src/b.c")


def test_files_no_longer_selected_are_removed_with_their_folders(tmp_path: Path) -> None:
    write_tree(tmp_path, tree_of(src__x__a_c="a", src__b_c="b"))
    report = write_tree(tmp_path, tree_of(src__b_c="b"))
    assert report.removed == ("src/x/a.c",)
    assert not (tmp_path / "src/x").exists()


def test_a_folder_that_holds_something_else_is_refused_and_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("mine")
    with pytest.raises(UserError, match=r"thesis\.tex.*Choose an empty or a new folder with -o"):
        write_tree(tmp_path, tree_of(src__a_c="a"))
    assert held(tmp_path) == {"thesis.tex": b"mine"}


def test_a_manifest_of_another_tool_is_no_licence_to_overwrite(tmp_path: Path) -> None:
    (tmp_path / MANIFEST).write_text('{"name": "a web extension", "outputs": {"x": 1}}')
    with pytest.raises(UserError):
        write_tree(tmp_path, tree_of(src__a_c="a"))


def test_a_manifest_cannot_make_us_delete_outside(tmp_path: Path) -> None:
    victim = tmp_path / "victim.txt"
    victim.write_text("keep")
    out = tmp_path / "out"
    out.mkdir()
    manifest = {"generator": {"name": "microros-gen"}, "outputs": {"../victim.txt": "", str(victim): ""}}
    (out / MANIFEST).write_text(json.dumps(manifest))
    (out / JOURNAL).write_text(json.dumps({"generator": {"name": "microros-gen"}, "files": []}))
    write_tree(out, tree_of(src__a_c="a"))
    assert victim.read_text() == "keep"


def owning(out: Path, name: str, content: bytes = b"mine") -> None:
    """Make `out` a folder whose manifest lists `name`."""
    out.mkdir(exist_ok=True)
    manifest = {"generator": {"name": "microros-gen"}, "outputs": digests({name: content})}
    (out / MANIFEST).write_text(json.dumps(manifest))


@pytest.mark.parametrize("digest", [b"mine", b"other"], ids=["known content", "other content"])
def test_a_link_in_the_folder_does_not_lead_a_removal_outside(tmp_path: Path, digest: bytes) -> None:
    documents, out = tmp_path / "documents", tmp_path / "out"
    documents.mkdir()
    (documents / "x").write_bytes(b"mine")
    owning(out, "docs/x", digest)
    (out / "docs").symlink_to(documents)
    write_tree(out, tree_of(src__a_c="a"))
    assert (documents / "x").read_bytes() == b"mine"


def test_a_folder_that_is_a_link_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    out = tmp_path / "out"
    owning(out, "old.c")
    (out / "src").symlink_to(tmp_path / "elsewhere")
    before = held(out)
    with pytest.raises(UserError, match=r"src is a symbolic link\. Remove it"):
        write_tree(out, tree_of(src__a_c="a"))
    assert held(out) == before
    assert not list((tmp_path / "elsewhere").iterdir())


@pytest.mark.parametrize("content", ["same", "different"])
def test_a_file_that_is_a_link_is_replaced_and_its_aim_is_left_alone(tmp_path: Path, content: str) -> None:
    victim, out = tmp_path / "victim", tmp_path / "out"
    victim.write_text(content)
    write_tree(out, tree_of(src__a_c="old"))
    (out / "src/a.c").unlink()
    (out / "src/a.c").symlink_to(victim)
    write_tree(out, tree_of(src__a_c="same"))
    assert not (out / "src/a.c").is_symlink()
    assert (out / "src/a.c").read_text() == "same"
    assert victim.read_text() == content


def test_a_manifest_or_journal_that_is_a_link_is_not_read(tmp_path: Path) -> None:
    out = tmp_path / "out"
    owning(tmp_path / "elsewhere", "src/a.c")
    out.mkdir()
    (out / "mine").write_text("mine")
    (out / MANIFEST).symlink_to(tmp_path / "elsewhere" / MANIFEST)
    with pytest.raises(UserError, match="files that microros-gen did not write"):
        write_tree(out, tree_of(src__a_c="a"))


def test_a_file_that_somebody_changed_is_kept_and_named(tmp_path: Path) -> None:
    write_tree(tmp_path, tree_of(src__a_c="a", src__b_c="b"))
    (tmp_path / "src/a.c").write_text("an hour of work")
    report = write_tree(tmp_path, tree_of(src__b_c="b"))
    assert (report.removed, report.kept) == ((), ("src/a.c",))
    assert (tmp_path / "src/a.c").read_text() == "an hour of work"


@pytest.mark.parametrize("name", ["C:/x", "..\\x", "a/../../x", "/x", ".", "x\0y"])
def test_names_that_lead_elsewhere_are_not_ours(tmp_path: Path, name: str) -> None:
    owning(tmp_path, name)
    write_tree(tmp_path, tree_of(src__a_c="a"))
    assert set(held(tmp_path)) == {MANIFEST, "src/a.c"}


def test_a_manifest_nested_100000_deep_is_no_manifest(tmp_path: Path) -> None:
    (tmp_path / MANIFEST).write_text('{"generator": {"name": "microros-gen"}, "outputs": ' + "[" * 100_000)
    with pytest.raises(UserError, match="files that microros-gen did not write"):
        write_tree(tmp_path, tree_of(src__a_c="a"))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are FIFOs on POSIX alone")
@pytest.mark.parametrize("name", [MANIFEST, "src/a.c", "src/b.c"])
def test_a_pipe_in_the_folder_is_no_reason_to_wait(tmp_path: Path, name: str) -> None:
    write_tree(tmp_path, tree_of(src__a_c="", src__b_c="b"))
    (tmp_path / name).unlink()
    os.mkfifo(tmp_path / name)
    if name == MANIFEST:
        with pytest.raises(UserError):
            write_tree(tmp_path, tree_of(src__a_c=""))
    else:
        write_tree(tmp_path, tree_of(src__a_c=""))
        assert (tmp_path / "src/a.c").read_bytes() == b""


@pytest.mark.parametrize("name", ["lib", "bin", ".build", ".build/src", ".build/src/x.o"])
def test_compiling_does_not_write_through_a_link(tmp_path: Path, name: str) -> None:
    (tmp_path / "elsewhere").mkdir()
    out = tmp_path / "out"
    (out / name).parent.mkdir(parents=True)
    tree.check_build_folders(out)
    (out / name).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(UserError, match=f"{name} is a symbolic link"):
        tree.check_build_folders(out)


def test_a_file_in_place_of_the_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("")
    with pytest.raises(UserError, match="is not a folder"):
        write_tree(tmp_path / "out", tree_of(src__a_c="a"))


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may write everywhere")
def test_an_unwritable_folder_is_reported(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir(mode=0o555)
    with pytest.raises(UserError, match="cannot write the output folder"):
        write_tree(tmp_path / "out", tree_of(src__a_c="a"))


def test_a_path_below_a_file_is_reported(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UserError, match="cannot write the output folder"):
        write_tree(tmp_path / "file" / "out", tree_of(src__a_c="a"))


class Interrupted(BaseException):
    pass


@pytest.mark.parametrize("after", range(6))
def test_an_interrupted_run_leaves_old_or_new_files_and_the_next_run_repairs_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, after: int
) -> None:
    old = tree_of(src__a_c="old a", src__b_c="old b", src__gone_c="gone")
    new = tree_of(src__a_c="new a", src__b_c="new b", src__new_c="new")
    write_tree(tmp_path, old)
    calls = 0
    real = tree._replace

    def replace(path: str, content: bytes) -> None:
        nonlocal calls
        if calls == after:
            (Path(path).parent / f".half{tree.TEMPORARY_SUFFIX}").write_bytes(b"half")
            raise Interrupted
        calls += 1
        real(path, content)

    monkeypatch.setattr(tree, "_replace", replace)
    if after < 5:
        with pytest.raises(Interrupted):
            write_tree(tmp_path, new)
    for name, content in held(tmp_path).items():
        if not name.endswith(tree.TEMPORARY_SUFFIX) and name != JOURNAL:
            assert content in (old.get(name), new.get(name)), name
    monkeypatch.undo()
    third = tree_of(src__b_c="third b")
    write_tree(tmp_path, third)
    assert held(tmp_path) == third


@pytest.mark.parametrize("fails", ["", "src/1.c", "src/98.c"])
def test_many_files_are_written_by_two_threads(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fails: str
) -> None:
    """A file that one of them cannot write ends the run as in one thread; the next run writes the rest."""
    files = tree_of(**{f"src__{index}_c": f"{index}" for index in range(100)})
    real, threads = tree._replace, set()

    def replace(path: str, content: bytes) -> None:
        threads.add(threading.get_ident())
        if fails and path.endswith(fails):
            raise OSError(errno.ENOSPC, "no space", path)
        real(path, content)

    monkeypatch.setattr(tree, "_replace", replace)
    if fails:
        with pytest.raises(UserError, match="no space"):
            write_tree(tmp_path, files)
        assert (tmp_path / JOURNAL).exists()
        assert not (tmp_path / MANIFEST).exists()
    else:
        assert write_tree(tmp_path, files).written == tuple(sorted(files))
    assert len(threads) == 2
    monkeypatch.undo()
    write_tree(tmp_path, files)
    assert held(tmp_path) == files


def test_a_first_run_that_was_interrupted_can_be_taken_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    files = tree_of(src__a_c="a", src__b_c="b")
    real = tree._replace

    def replace(path: str, content: bytes) -> None:
        if Path(path).name == "b.c":
            raise Interrupted
        real(path, content)

    monkeypatch.setattr(tree, "_replace", replace)
    with pytest.raises(Interrupted):
        write_tree(out, files)
    monkeypatch.undo()
    write_tree(out, files)
    assert held(out) == files


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are FIFOs on POSIX alone")
@pytest.mark.parametrize("name", ["tools.json", "stamps.json"])
def test_a_build_does_not_write_into_a_fifo(tmp_path: Path, name: str) -> None:
    """Opening it would wait for a reader without end."""
    (tmp_path / ".build").mkdir()
    os.mkfifo(tmp_path / ".build" / name)
    with pytest.raises(UserError, match="is not a regular file"):
        tree.check_build_folders(tmp_path)
