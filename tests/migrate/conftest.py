# SPDX-License-Identifier: Apache-2.0
"""`init`, run in this process."""

from __future__ import annotations

from pathlib import Path

import pytest

from microros_gen.cli import main as cli
from tests.support.migrate.proposals import Init


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache of compiled templates for all tests of a process."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def init(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Init:
    """Run `microros-gen` in a separate folder: exit status, standard output, standard error."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)

    def call(*arguments: str) -> tuple[int, str, str]:
        capfd.readouterr()
        with pytest.raises(SystemExit) as end:
            cli.main(["init", *arguments])
        captured = capfd.readouterr()
        assert "Traceback" not in captured.err
        assert isinstance(end.value.code, int)
        return end.value.code, captured.out, captured.err

    return call
