# SPDX-License-Identifier: Apache-2.0
"""`init --from` on a program with a life cycle; tests/e2e/test_managed.py runs it."""

from __future__ import annotations

from pathlib import Path

from tests.support.migrate.proposals import Init, application_in, entities_of, undecided_in
from tests.support.paths import TESTS

SENSOR = TESTS / "migrate/c/lifecycle_sensor.c"


def test_a_life_cycle_is_proposed(init: Init, tmp_path: Path) -> None:
    """Its entities follow from the component; the program declares only its own."""
    status, _, err = init("app", "--from", str(SENSOR))
    assert (status, err) == (0, "")
    assert undecided_in(tmp_path / "app/microros.yaml") == []
    proposed = application_in(tmp_path / "app/microros.yaml")
    assert {component.name for component in proposed.components} == {"lifecycle", "timers"}
    assert [profile.name for profile in proposed.profiles] == ["pure_sender"]
    assert entities_of(proposed) == {
        ("node", "sensor", "/", "0"),
        ("publisher", "readings", "std_msgs/msg/Int32", "reliable"),
        ("timer", "20000", "", ""),
    }
    assert proposed.limits == ()
