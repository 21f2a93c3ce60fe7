# SPDX-License-Identifier: Apache-2.0
"""The parameter server of an agent whose first client with such parameters connects at once; its log is on stdout."""

from __future__ import annotations

import sys
import time
from pathlib import Path

from microros_gen.agent.log import EventLog
from microros_gen.cli.agent.parameters import ParametersOnDemand


def main() -> None:
    log = EventLog(sys.stdout)
    parameters = ParametersOnDemand(True, Path(sys.argv[1]), None, log)
    print("loaded", flush=True)
    sys.stdin.readline()  # several of them begin at one time
    with parameters.running():
        parameters.on_type("microros_parameter_msgs/msg/Notice")
        while True:
            time.sleep(1)


if __name__ == "__main__":
    main()
