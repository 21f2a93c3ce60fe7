# SPDX-License-Identifier: Apache-2.0
"""The addresses of metrics and page, and the page in a browser while the agent restarts."""

from __future__ import annotations

import json
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from microros_gen.agent.configuration.model import NamedPath
from microros_gen.agent.monitoring.page import PAGE
from microros_gen.agent.monitoring.serving import page_routes
from microros_gen.agent.monitoring.status import AgentStatus
from microros_gen.cli.agent.monitoring import serve_pages
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.diagnostics import UserError
from microros_gen.web.places import Place
from microros_gen.web.server import served
from tests.support.agent.monitored import CLIENT, STATUS, running
from tests.support.browser import opened

SINCE = "document.getElementById('since').textContent"
ROW = "[...document.querySelectorAll('#client-A1B2C3D4 td')].map((c) => c.textContent)"


@contextmanager
def page_at(port: int, status: AgentStatus) -> Iterator[str]:
    with running(status) as loop, served(Place("127.0.0.1", port), page_routes(loop.board)) as address:
        yield address


def fetched(address: str) -> bytes:
    with urllib.request.urlopen(address) as response:
        content: bytes = response.read()
        return content


@pytest.mark.parametrize("text", ["x", ":80", "127.0.0.1", "127.0.0.1:70000", "http://127.0.0.1:80"])
def test_bad_addresses_are_reported_together(text: str) -> None:
    options = AgentOptions(metrics=NamedPath(text), page=NamedPath(text))
    with running() as loop, pytest.raises(UserError) as raised, serve_pages(options, loop.board):
        pass
    assert [(d.id, d.message) for d in raised.value.diagnostics] == [
        ("MG-9791", f"'{text}' is no address for the metrics"),
        ("MG-9791", f"'{text}' is no address for the page"),
    ]


def test_a_port_in_use(tmp_path: Path) -> None:
    with running() as loop, serve_pages(AgentOptions(metrics=NamedPath("0")), loop.board) as found:
        address = found["metrics"]
        assert address.startswith("http://127.0.0.1:")
        place = address.removeprefix("http://").removesuffix("/metrics")
        options = AgentOptions(page=NamedPath(place))
        with pytest.raises(UserError) as raised, serve_pages(options, loop.board):
            pass
        assert b"microros_agent_clients" in fetched(address)
        with pytest.raises(urllib.error.HTTPError, match="404"):
            fetched(address.removesuffix("metrics"))
    assert [d.id for d in raised.value.diagnostics] == ["MG-9792"]
    assert raised.value.diagnostics[0].message.startswith(f"the page cannot be served at '{place}': Address")


def test_metrics_and_page_share_a_server() -> None:
    options = AgentOptions(metrics=NamedPath("127.0.0.1:0"), page=NamedPath("0"))
    with running() as loop, serve_pages(options, loop.board) as found:
        metrics, page = found["metrics"], found["page"]
        assert metrics == f"{page}metrics"
        assert fetched(page).decode() == PAGE
        assert json.loads(fetched(f"{page}status.json"))["agent"]["pid"] == 77


def test_nothing_is_served_by_default() -> None:
    with running() as loop, serve_pages(AgentOptions(), loop.board) as found:
        assert found == {}


def test_the_page_loads_nothing_from_elsewhere() -> None:
    assert "http" not in PAGE
    assert "src=" not in PAGE
    assert "<link" not in PAGE


@pytest.mark.lint
def test_the_page_stays_open_while_the_agent_restarts(tmp_path: Path) -> None:
    hostile = replace(CLIENT, nodes=("<b id=evil>x</b>",))
    with ExitStack() as browser:
        with page_at(0, STATUS) as address:
            port = int(address.rstrip("/").rpartition(":")[2])
            page = browser.enter_context(opened(address, tmp_path))
            page.wait_for(SINCE, "Live")
            assert page.value(ROW) == [
                *("/arm", "A1B2C3D4", "connected", "udp4 127.0.0.1:8888", "127.0.0.1:40312", "1.5 ms"),
                *("100/s", "6.4 kB/s", "0/s", "0 B/s", "2", "3", "4", "50 %", "2", "late"),
            ]
            assert "Process 77" in page.value("document.getElementById('agent').textContent")
        page.wait_for(SINCE, "The agent does not answer")
        assert page.value("document.querySelectorAll('#clients tr').length") == 1
        with page_at(port, replace(STATUS, pid=78, clients=(hostile,))):
            page.wait_for(SINCE, "Live")
            assert page.value(ROW)[0] == "<b id=evil>x</b>"
            assert page.value("document.getElementById('evil')") is None
            assert "Process 78" in page.value("document.getElementById('agent').textContent")
