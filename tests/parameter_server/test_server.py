# SPDX-License-Identifier: Apache-2.0
"""The parameter server as a process: six services in the name of a node whose board comes and goes."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from microros_gen.parameter_server.node import parameter
from microros_gen.parameter_server.served import HELD
from microros_gen.parameter_server.values import (
    BOOL,
    DOUBLE,
    INTEGER,
    NOT_SET,
    STRING,
    ParameterValue,
    value_of,
)
from microros_gen.ros.peer import Peer
from tests.support.agent.process import environment
from tests.support.parameter_server.asking import Asking, alive
from tests.support.parameter_server.board import Board
from tests.support.parameter_server.process import parameter_server
from tests.support.patience import seconds

pytestmark = [pytest.mark.ros, pytest.mark.usefixtures("domain")]
PATIENCE_S = seconds(20)
KIND = "rcl_interfaces/srv"


def test_six_services_while_the_board_is_there_and_away(domain: int, tmp_path: Path) -> None:
    file = tmp_path / "p.json"
    board = Board(time.monotonic)
    with parameter_server(domain, file) as server, Peer("asking") as peer:
        ask = Asking(peer)
        with alive(board):
            ask.until(lambda: file.exists() and "gain" in file.read_text(encoding="utf-8"))
            ask.until(lambda: not board.has_news)
            assert ask.get("gain", "count", "name", "fixed") == [1.0, 10, "arm", True]
            board.veto = lambda name, value: bool(value.value == 3.0)
            assert ask.set(
                gain=ParameterValue(DOUBLE, 2.0),
                count=ParameterValue(INTEGER, 11),
                name=ParameterValue(STRING, "much too long"),
                fixed=ParameterValue(BOOL, False),
                other=ParameterValue(BOOL, False),
            ) == [
                (True, ""),
                (False, "Parameter {count} doesn't comply with integer range."),
                (False, "the string for parameter 'name' is too long"),
                (False, "parameter 'fixed' cannot be set because it is read-only"),
                (False, "parameter 'other' cannot be set because it was not declared"),
            ]
            assert ask.set(gain=ParameterValue(DOUBLE, 3.0)) == [(False, "rejected by the callback")]
            assert board.value("gain") == 2.0
            board.set("name", "hand")
            ask.until(lambda: ask.get("name") == ["hand"])
        ask.until(lambda: ask.set(gain=ParameterValue(DOUBLE, 4.0)) == [(True, HELD)])
        wrong = ParameterValue(STRING, "fast")
        (refused,) = ask.set(gain=wrong)
        assert refused == (
            False,
            "Wrong parameter type, parameter {gain} is of type {double}, setting it to {string} is not allowed.",
        )
        assert ask.set(gain=ParameterValue(NOT_SET))[0][1] == "cannot undeclare a statically typed parameter"
        assert ask.get("gain", "unknown") == []
        assert ask.get("gain") == [4.0]
        server.send_signal(signal.SIGTERM)
        assert server.wait(seconds(10)) == 0
    changed = [
        (event["node"], p["name"], value_of(p["value"]).value)
        for event in ask.events
        for p in event["changed_parameters"]
    ]
    assert changed == [("/arm", "gain", 2.0), ("/arm", "name", "hand"), ("/arm", "gain", 4.0)]
    assert json.loads(file.read_text(encoding="utf-8"))["nodes"]["/arm"]["parameters"]["gain"]["pending"]
    board.start()
    with parameter_server(domain, file), Peer("asking") as peer:
        ask = Asking(peer)
        assert ask.get("gain") == [4.0]  # the board is away, and the server is another one
        with alive(board):
            ask.until(lambda: board.values == {"gain": 4.0, "count": 10, "name": "hand", "fixed": True})


def test_reading_services(domain: int, tmp_path: Path) -> None:
    board = Board(time.monotonic)
    with parameter_server(domain, tmp_path / "p.json"), Peer("asking") as peer, alive(board):
        ask = Asking(peer)
        ask.until(lambda: not board.has_news)
        listed = ask.call("list_parameters", "ListParameters", prefixes=["gain", "x"], depth=0)["result"]
        assert listed == {"names": ["gain"], "prefixes": []}
        types = ask.call("get_parameter_types", "GetParameterTypes", names=["gain", "name"])["types"]
        assert bytes(types) == bytes([DOUBLE, STRING])
        (gain,) = ask.call("describe_parameters", "DescribeParameters", names=["gain"])["descriptors"]
        assert gain["floating_point_range"] == [{"from_value": 0.0, "to_value": 10.0, "step": 0.0}]
        assert (gain["description"], gain["read_only"]) == ("How strong.", False)
        both = [
            parameter("gain", ParameterValue(DOUBLE, 5.0)),
            parameter("count", ParameterValue(INTEGER, 7)),
        ]
        result = ask.call("set_parameters_atomically", "SetParametersAtomically", parameters=both)["result"]
        assert result["reason"] == "Parameter {count} doesn't comply with integer range."
        assert board.value("gain") == 1.0
        both[1] = parameter("count", ParameterValue(INTEGER, 5))
        result = ask.call("set_parameters_atomically", "SetParametersAtomically", parameters=both)["result"]
        assert result == {"successful": True, "reason": ""}
        assert (board.value("gain"), board.value("count")) == (5.0, 5)
        empty = ask.call("set_parameters_atomically", "SetParametersAtomically", parameters=[])["result"]
        assert empty == {"successful": False, "reason": "parameter list cannot be empty"}


def test_a_damaged_file_is_reported_and_kept(domain: int, tmp_path: Path) -> None:
    file = tmp_path / "p.json"
    file.write_text("{", encoding="utf-8")
    with parameter_server(domain, file):
        pass
    assert (tmp_path / "p.json.damaged-1").read_text(encoding="utf-8") == "{"
    assert "it is kept as 'p.json.damaged-1'" in file.with_suffix(".log").read_text(encoding="utf-8")


def test_a_file_that_another_server_has(domain: int, tmp_path: Path) -> None:
    file = tmp_path / "p.json"
    with parameter_server(domain, file):
        second = subprocess.run(
            [sys.executable, "-m", "microros_gen", "parameter-server", "--file", str(file)],
            env=environment(domain),
            capture_output=True,
            text=True,
            check=False,
        )
    assert second.returncode == 2
    assert "another parameter server uses" in second.stderr
