# SPDX-License-Identifier: Apache-2.0
"""What the files of an agent say reaches another process whole, also after the files have changed."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

from microros_gen.cli.agent.files import AgentFiles, read_files, with_types, without_types
from microros_gen.cli.agent.options import AgentOptions
from microros_gen.cli.agent.types import ManifestOf
from tests.support.agent.entities_file import content

GOLDEN = Path(__file__).parents[2] / "golden" / "preconfigured"
POLICY = """\
version: 1
clients:
  - name: arm
    keys: [0x10-0x1F]
    addresses: [192.168.10.0/24, fd00::/8]
    devices: [/dev/ttyS*]
    publish: [/arm/**]
    limits: {objects: 8}
"""


def test_files_reach_a_worker(tmp_path: Path) -> None:
    policy, entities = tmp_path / "policy.yaml", tmp_path / "entities.json"
    policy.write_text(POLICY)
    entities.write_text(json.dumps(content()))
    options = AgentOptions(
        policy=policy,
        entities=(entities,),
        references=(GOLDEN / "agent" / "references.xml",),
        manifests=(ManifestOf(GOLDEN / "manifest.json", "0x1"),),
    )
    read = read_files(options)
    start = pickle.dumps(without_types(read))
    policy.unlink()
    entities.unlink()
    received: AgentFiles = with_types(pickle.loads(start), options)
    assert received.policy == read.policy
    assert received.references == read.references
    assert vars(received.preconfigured) == vars(read.preconfigured)
    assert received.clients == read.clients
    hash_of = read.hashes("std_msgs/msg/Int32")
    assert hash_of is not None
    assert received.hashes("std_msgs/msg/Int32") == hash_of
