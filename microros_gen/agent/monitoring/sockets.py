# SPDX-License-Identifier: Apache-2.0
"""The local sockets at which agents answer questions about their status: where they are, and who has one."""

from __future__ import annotations

import errno
import os
import re
import socket
import stat
from collections.abc import Callable, Mapping
from pathlib import Path

from microros_gen.web.server import CONNECTIONS

NAME = re.compile(r"microros-agent-(\d+)\.sock")
"""File name of the socket of an agent, with the number of its process."""
LISTED = Path("/proc/net/unix")
LONGEST = 107
"""Maximum bytes of a path of a socket (unix(7): sun_path of 108 bytes with the final zero)."""


class SocketError(Exception):
    """A socket that cannot be made; the text says why."""


def own_folder(environ: Mapping[str, str] = os.environ) -> Path:
    """Return the folder of the sockets of this user's agents.

    That of the service (systemd.exec(5), RuntimeDirectory=), else below XDG_RUNTIME_DIR (XDG base directories 0.8),
    else one in /tmp that only this user may enter.
    """
    service = environ.get("RUNTIME_DIRECTORY", "").partition(":")[0]
    if service:
        return Path(service)
    session = environ.get("XDG_RUNTIME_DIR", "")
    if session and Path(session).is_dir():
        return Path(session) / "microros-gen"
    return Path(f"/tmp/microros-gen-{os.getuid()}")


def default_path(environ: Mapping[str, str] = os.environ) -> Path:
    """Return the path of this process's socket, in a folder that is created when needed. Raises SocketError."""
    folder = own_folder(environ)
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        if folder.stat().st_uid != os.getuid() or folder.is_symlink():
            raise SocketError(f"{folder} belongs to another user")
        remove_stale(folder, _has_ended)
    except OSError as error:
        raise SocketError(f"{folder}: {error.strerror}") from error
    return folder / f"microros-agent-{os.getpid()}.sock"


def listen(path: Path) -> socket.socket:
    """Return a socket that listens at `path`, for this user alone; a stale one is replaced. Raises SocketError."""
    if len(os.fsencode(path)) > LONGEST:
        raise SocketError(f"the path has more than {LONGEST} bytes")
    try:
        _make_free(path)
        listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            os.fchmod(listener.fileno(), 0o600)  # Linux gives the file this mode when it is made
            listener.bind(str(path))
            path.chmod(0o600)
            listener.listen(CONNECTIONS)
        except OSError:
            listener.close()
            raise
    except OSError as error:
        raise SocketError(error.strerror or str(error)) from error
    return listener


def _make_free(path: Path) -> None:
    try:
        kind = path.lstat().st_mode
    except FileNotFoundError:
        return
    if not stat.S_ISSOCK(kind):
        raise SocketError("another file has this name")
    if not is_stale(path):
        raise SocketError("another process listens there")
    path.unlink()


def is_stale(path: Path) -> bool:
    """Return whether nobody listens at a socket any more: its process was killed."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as probe:
        probe.setblocking(False)
        return probe.connect_ex(str(path)) == errno.ECONNREFUSED


def remove_stale(folder: Path, is_suspect: Callable[[Path], bool]) -> None:
    """Remove the sockets of killed agents among those in `folder` that are suspect. Raises OSError."""
    for path in folder.glob("microros-agent-*.sock"):
        if NAME.fullmatch(path.name) and is_suspect(path) and is_stale(path):
            path.unlink(missing_ok=True)


def known_sockets(environ: Mapping[str, str] = os.environ, pid: int | None = None) -> list[Path]:
    """Return the sockets of this user's agents, in order; without any, those that the system lists for all users.

    Stale ones in the folder of this user are removed. `pid`: only that of this process.
    """
    found: list[Path] = []
    folder = own_folder(environ)
    try:
        remove_stale(folder, lambda _: True)
        found = [path for path in folder.iterdir() if NAME.fullmatch(path.name)]
    except OSError:
        pass  # no agent of this user has had a socket there
    found = [path for path in found if pid in (None, pid_of(path))] or [
        path for path in _listed() if pid in (None, pid_of(path))
    ]
    return sorted(found, key=lambda path: (pid_of(path), str(path)))


def _listed() -> list[Path]:
    """Return the sockets of all users' agents in the table of proc(5); empty on a system without it."""
    try:
        lines = LISTED.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []
    paths = {Path(line.split(maxsplit=7)[-1]) for line in lines if "/microros-agent-" in line}
    return [path for path in paths if NAME.fullmatch(path.name)]


def _has_ended(path: Path) -> bool:
    """Return whether the process in the name of a socket does not exist, or not where this one sees it."""
    try:
        os.kill(pid_of(path), 0)
    except ProcessLookupError:
        return True
    except PermissionError:
        pass
    return False


def pid_of(path: Path) -> int:
    """Return the number of the process in the name of a socket; 0: none."""
    match = NAME.fullmatch(path.name)
    return int(match[1]) if match else 0
