# SPDX-License-Identifier: Apache-2.0
"""Bytes against rosbags, an implementation of CDR that shares nothing with Fast CDR, in both byte orders."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.support.typesupport.build import Generated
from tests.support.typesupport.decoder import Decoder
from tests.support.typesupport.encoder import Encoder
from tests.support.typesupport.values import CStructs, Randomizer

if TYPE_CHECKING:
    from tests.support.typesupport.rosbags import Oracle

pytestmark = [pytest.mark.ros, pytest.mark.builds]

ENCAPSULATION = {True: b"\0\0\0\0", False: b"\0\1\0\0"}
SAMPLES = ("empty", "full", "random", "random")
LONG_SAMPLES = ("empty", "full", *("random",) * 200)


@pytest.fixture(scope="session")
def oracle(everything: Generated) -> Oracle:
    pytest.importorskip("rosbags.typesys")
    from tests.support.typesupport.rosbags import Oracle

    return Oracle(Path(sys.prefix) / "share")


def check_samples(
    generated: Generated, library: ctypes.CDLL, oracle: Oracle, samples: tuple[str, ...]
) -> list[str]:
    """Compare what both write and read of each type; return the types that rosbags has not."""
    structs = CStructs(generated.messages)
    unknown = []
    for seed, plan in enumerate(generated.plans):
        if not oracle.knows(generated.messages, plan.name):
            unknown.append(str(plan.name))
            continue
        source = Randomizer(generated.messages, 2000 + seed)
        encoder, decoder = Encoder(library, plan.c_name), Decoder(library, generated, plan)
        for mode in samples:
            tree = source.tree(plan.name, plan.limits, mode)
            body = encoder.encode(structs.fill(plan.name, tree))
            message = oracle.message(generated.messages, plan.name, tree)
            for big in (False, True):
                theirs = oracle.write(plan.name, message, big)
                assert theirs[:4] == ENCAPSULATION[big]
                assert decoder.decode(theirs[4:], swap=big) == tree, (plan.name, mode, big)
                if not big:
                    assert body == theirs[4:], (plan.name, mode)
            read = oracle.read(plan.name, ENCAPSULATION[False] + body)
            assert oracle.tree(generated.messages, plan.name, read) == tree, (plan.name, mode)
    return unknown


@pytest.mark.system
def test_rosbags_and_this_project_write_and_read_the_same(
    limits_case: Generated, library: ctypes.CDLL, oracle: Oracle
) -> None:
    """Every message of .msg, .srv and .action files, those that ROS 2 derives too; not those with wide strings."""
    unknown = check_samples(limits_case, library, oracle, SAMPLES)
    assert unknown == ["test_interface_files/msg/WStrings", "test_msgs/msg/WStrings"]
    assert len(limits_case.plans) > 300


@pytest.mark.long
def test_rosbags_writes_and_reads_the_same_200_times(
    limits_case: Generated, library: ctypes.CDLL, oracle: Oracle
) -> None:
    check_samples(limits_case, library, oracle, LONG_SAMPLES)
