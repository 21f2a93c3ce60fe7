# SPDX-License-Identifier: Apache-2.0
"""`make proof`: every run of proofs.yaml, and the report of it in docs/verification/proof.md.

`python -m tests.proof.prove [NAME …]` makes the runs of these proofs alone (`decode`, `decode-ppc_32`,
`decode-ppc_32-0`: a proof, a machine, a variant) and prints what it finds without writing the report.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tests.proof import proofs, report
from tests.proof.proofs import Proof, Run

WORKERS = 2


def main(names: Sequence[str]) -> int:
    """Run; 1 where something failed, an alarm is not justified, or a statement is not reached and not explained."""
    if not proofs.is_installed():
        print("frama-c is not installed (Debian: frama-c-base)")
        return 2
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(WORKERS) as pool:
        for proof in proofs.load():
            proofs.tree(proof.application, Path(folder))
        every = list(pool.map(lambda job: _run(job[0], job[1], job[2], Path(folder)), _chosen(names)))
    problems = [text for run in every for text in report.problems(run)]
    if not names:
        problems += report.unexplained(every)
        report.write(every)
    print("\n".join(problems) or f"{len(every)} runs, no alarm that is not justified")
    return 1 if problems else 0


def _run(proof: Proof, machdep: str, number: int, folder: Path) -> Run:
    run = proofs.run(proof, proofs.tree(proof.application, folder), machdep, number, folder)
    print(report.line(run), *report.problems(run), sep="\n  ", flush=True)
    return run


def _chosen(names: Sequence[str]) -> Iterator[tuple[Proof, str, int]]:
    for proof in proofs.load():
        for machdep, number in proofs.runs(proof):
            known = {proof.name, f"{proof.name}-{machdep}", f"{proof.name}-{machdep}-{number}"}
            if not names or known.intersection(names):
                yield proof, machdep, number


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
