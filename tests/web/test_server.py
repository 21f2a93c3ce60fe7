# SPDX-License-Identifier: Apache-2.0
"""The HTTP server: addresses, answers, and requests from pages of others."""

from __future__ import annotations

import http.client
import socket
import urllib.request

import pytest

from microros_gen.web.places import Place, is_loopback, read_place
from microros_gen.web.server import CONNECTIONS, Answer, Routes, served
from tests.support.patience import seconds

ROUTES: Routes = {
    "/": lambda: Answer("text/plain", b"page"),
    "/late": lambda: Answer("text/plain", b"late", 503),
}
FREE = Place("127.0.0.1", 0)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("9464", Place("127.0.0.1", 9464)),
        ("127.0.0.1:0", FREE),
        ("0.0.0.0:80", Place("0.0.0.0", 80)),
        ("robot.local:80", Place("robot.local", 80)),
        ("[::1]:65535", Place("::1", 65535)),
        *(
            (text, None)
            for text in ("", ":80", "a", "a:", "a:b", "a:-1", "a:65536", "a:1.0", "::1:80", "[a]:80")
        ),
        *((text, None) for text in ("http://a:80", "a/b:80", "a b:80", "a:٣")),
    ],
)
def test_places(text: str, place: Place | None) -> None:
    assert read_place(text) == place
    if place is not None:
        assert read_place(place.address) == place


def test_loopback_addresses() -> None:
    assert [
        h for h in ("localhost", "127.1.2.3", "::1", "[::1]", "192.0.2.1", "", "a") if is_loopback(h)
    ] == [*("localhost", "127.1.2.3", "::1", "[::1]")]


def asked(address: str, path: str, method: str = "GET", host: str = "localhost:1") -> tuple[int, bytes]:
    connection = http.client.HTTPConnection("127.0.0.1", int(address.rstrip("/").rpartition(":")[2]))
    connection.request(method, path, headers={"Host": host})
    response = connection.getresponse()
    content = response.read()
    connection.close()
    return response.status, content


def test_answers() -> None:
    with served(FREE, ROUTES) as address:
        with urllib.request.urlopen(address) as response:
            assert response.read() == b"page"
            assert response.headers["Content-Security-Policy"].startswith("default-src 'none'")
            assert response.headers["Cache-Control"] == "no-store"
        assert asked(address, "/?a=b") == (200, b"page")
        assert asked(address, "/late") == (503, b"late")
        assert asked(address, "/", "HEAD") == (200, b"")
        assert asked(address, "/other")[0] == 404
        assert asked(address, "/", "POST")[0] == 501
        assert asked(address, "/", host="example.org:80")[0] == 403


def test_another_host_is_accepted_where_the_network_may_ask() -> None:
    with served(Place("0.0.0.0", 0), ROUTES) as address:
        assert asked(address, "/", host="robot.example:80") == (200, b"page")


def test_a_port_in_use_is_an_error() -> None:
    with served(FREE, ROUTES) as address:
        port = int(address.rstrip("/").rpartition(":")[2])
        with pytest.raises(OSError, match="in use"), served(Place("127.0.0.1", port), ROUTES):
            pass


def test_connections_that_say_nothing_are_limited_and_do_not_last() -> None:
    with served(FREE, ROUTES) as address:
        place = ("127.0.0.1", int(address.rstrip("/").rpartition(":")[2]))
        silent = [socket.create_connection(place) for _ in range(CONNECTIONS)]
        with socket.create_connection(place) as further:
            further.settimeout(seconds(30))
            assert further.recv(1) == b""
        for connection in silent:
            connection.close()
    with pytest.raises(OSError, match="refused"):
        socket.create_connection(place)
