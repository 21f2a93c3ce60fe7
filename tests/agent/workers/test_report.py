# SPDX-License-Identifier: Apache-2.0
"""What workers report, joined; and how it is shown."""

from __future__ import annotations

import json
from dataclasses import replace

from microros_gen.agent.monitoring.document import text_of
from microros_gen.agent.monitoring.metrics import metrics_text
from microros_gen.agent.monitoring.shape import fault_of
from microros_gen.agent.monitoring.status import WorkerState
from microros_gen.agent.states import Presence
from microros_gen.agent.workers.report import Orphans, Report, Totals
from microros_gen.cli.agent.status import _not_ready
from microros_gen.cli.agent.status_table import status_table
from tests.support.agent.monitored import CLIENT, STATUS

OTHER = replace(CLIENT, key="00000002", worker=2)
SHOWN = replace(
    STATUS,
    clients=(replace(CLIENT, worker=1), OTHER),
    workers=(WorkerState(1, 4711, True, 2), WorkerState(2, 0, False, 0)),
)


def test_a_report_arrives_as_it_was_sent() -> None:
    report = Report(1, 2, {"truncated": 3}, (CLIENT, OTHER))
    assert Report.decode(report.encode()) == report


def test_counts_of_workers_that_ended_stay() -> None:
    totals = Totals()
    totals.add(Report(1, 2, {"truncated": 3}))
    totals.add(Report(10, 20, {"truncated": 30, "no_session": 1}))
    assert (totals.samples, totals.delivered) == (11, 22)
    assert totals.faults == {"truncated": 33, "no_session": 1}


def test_clients_without_a_worker_are_silent_until_one_knows_them() -> None:
    orphans = Orphans(8, 86_400.0)
    left = replace(CLIENT, key="00000003", presence=Presence.GONE)
    orphans.add([CLIENT, left], 1, 100.0)
    first, second = orphans.with_those_of([[OTHER]], 107.0)
    assert first == OTHER
    assert second == replace(
        CLIENT, presence=Presence.SILENT, last_error="worker 1 ended", silent_s=CLIENT.silent_s + 7
    )
    again = replace(CLIENT, worker=1)
    assert orphans.with_those_of([[OTHER], [again]], 108.0) == (OTHER, again)
    assert orphans.with_those_of([[OTHER]], 109.0) == (OTHER,), "it has left since"


def test_they_are_forgotten_after_their_time() -> None:
    orphans = Orphans(8, 60.0 + CLIENT.silent_s)
    orphans.add([CLIENT], 1, 100.0)
    assert len(orphans.with_those_of([], 160.0)) == 1
    assert orphans.with_those_of([], 161.0) == ()
    assert orphans.with_those_of([], 100.0) == (), "it is gone for good"


def test_they_do_not_grow_without_end() -> None:
    orphans = Orphans(8, 86_400.0)
    for number in range(20):
        orphans.add([replace(CLIENT, key=f"{number:08X}")], 1, 0.0)
    assert len(orphans.with_those_of([], 0.0)) == 8


def test_the_table_has_workers_only_where_there_are_some() -> None:
    document = json.loads(text_of(SHOWN))
    assert fault_of(document) == ""
    lines = status_table(document).splitlines()
    assert lines[3] == "workers: 1 (process 4711, started again 2 times), 2 (not ready)"
    assert [line.split()[-1] for line in lines[5:]] == ["WORKER", "1", "2"]
    assert "WORKER" not in status_table(json.loads(text_of(STATUS)))


def test_checks_and_metrics_name_a_worker_that_does_not_run() -> None:
    document = json.loads(text_of(SHOWN))
    assert _not_ready(document) == ["serial /dev/ttyUSB0 is not ready", "worker 2 is not ready"] == SHOWN.late
    metrics = metrics_text(SHOWN).splitlines()
    assert 'microros_agent_worker_ready{worker="1"} 1' in metrics
    assert 'microros_agent_worker_ready{worker="2"} 0' in metrics
    assert 'microros_agent_worker_restarts_total{worker="1"} 2' in metrics
    assert "worker_ready" not in metrics_text(STATUS)
