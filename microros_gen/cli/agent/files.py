# SPDX-License-Identifier: Apache-2.0
"""The files of an agent."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from microros_gen.agent.configuration.entities_file import parse_preconfigured
from microros_gen.agent.policy.model import Policy
from microros_gen.agent.preconfigured import Preconfigured
from microros_gen.agent.representation import References
from microros_gen.agent.representation.reference_file import read_references
from microros_gen.cli.agent.options import AgentOptions, read_sources
from microros_gen.cli.agent.policy import read_policy
from microros_gen.cli.agent.seal import read_psk_file
from microros_gen.cli.agent.types import ClientTypes, HashOf, TypeHashes, read_manifests
from microros_gen.diagnostics import Diagnostic, Diagnostics, UserError
from microros_gen.interfaces.type_hashes import type_hashes
from microros_gen.records import dataclass


@dataclass(frozen=True)
class AgentFiles:
    """What the files say."""

    references: References
    preconfigured: Preconfigured
    clients: ClientTypes
    hashes: TypeHashes
    policy: Policy | None
    keys: Mapping[int, bytes] | None
    warnings: tuple[Diagnostic, ...]


def read_files(options: AgentOptions) -> AgentFiles:
    """Return what the files say; UserError with the faults of all of them. Warnings are in it."""
    diagnostics = Diagnostics()
    references, preconfigured = References(), Preconfigured()
    places = options.places
    profiles = read_sources(options.references, diagnostics, places)
    entities = read_sources(options.entities, diagnostics, places)
    policy, keys = read_policy(options, diagnostics), read_psk_file(options, diagnostics)
    clients = read_manifests(options.manifests, diagnostics)
    of_files: HashOf = _no_hash
    try:
        of_files = type_hashes(options.interface_paths)
    except UserError as error:
        missing = next((path for path in options.interface_paths if not path.exists()), Path())
        span = places.get(missing)
        diagnostics.extend(replace(d, span=d.span or span) for d in error.diagnostics)
    try:
        references = read_references(profiles)
    except UserError as error:
        diagnostics.extend(error.diagnostics)
    try:
        preconfigured = Preconfigured(parse_preconfigured(entities, diagnostics))
    except UserError as error:
        diagnostics.extend(error.diagnostics)
    diagnostics.check()
    hashes = TypeHashes(of_files, clients.common)
    return AgentFiles(references, preconfigured, clients, hashes, policy, keys, tuple(diagnostics))


def without_types(files: AgentFiles) -> AgentFiles:
    """Return the part of `files` that can be given to another process: all but the types."""
    return replace(files, hashes=TypeHashes(_no_hash, files.clients.common))


def with_types(files: AgentFiles, options: AgentOptions) -> AgentFiles:
    """Return `files` from another process, with the types of this machine. Raises UserError."""
    return replace(files, hashes=TypeHashes(type_hashes(options.interface_paths), files.clients.common))


def _no_hash(_type_name: str) -> None:
    """Know no type."""
