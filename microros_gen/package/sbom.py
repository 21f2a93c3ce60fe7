# SPDX-License-Identifier: Apache-2.0
"""The software bill of materials of a package: SPDX 2.3 as JSON, the same bytes for the same files."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any

from microros_gen.package.view import PackageView

SBOM = "sbom.spdx.json"
_CREATED = "1980-01-01T00:00:00Z"
"""SPDX 2.3, 6.9, demands a time; a true one would make each archive different."""
_LICENSE = "Apache-2.0"
_TAG = re.compile(rb"SPDX-License-Identifier: ([A-Za-z0-9.+-]+)")
_HEAD = 512
"""Bytes at the beginning of a file in which its license is looked for."""
_UNKNOWN = "NOASSERTION"
_SELF, _LIBRARY, _TOOL = "SPDXRef-DOCUMENT", "SPDXRef-library", "SPDXRef-generator"


def sbom(view: PackageView, files: Mapping[str, bytes]) -> bytes:
    """Return the document about `files`, which are all of the package but this one and the manifest."""
    entries = [_file(name, content) for name, content in sorted(files.items())]
    interfaces = sorted({name.partition("/")[0] for name in view.types})
    digest = hashlib.sha256("\n".join(e["checksums"][1]["checksumValue"] for e in entries).encode())
    document = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": _SELF,
        "name": f"{view.library}-{view.version}",
        "documentNamespace": f"urn:microros-gen:sbom:{digest.hexdigest()}",
        "creationInfo": {
            "created": _CREATED,
            "creators": [f"Tool: microros-gen-{view.version}"],
            "comment": "The time is fixed, so that the same inputs give the same document.",
        },
        "documentDescribes": [_LIBRARY],
        "packages": [
            _library(view, entries),
            _other(_TOOL, "microros-gen", view.version, _LICENSE),
            *(_other(_interface(name), name, "", _UNKNOWN) for name in interfaces),
        ],
        "files": entries,
        "relationships": [
            _relation(_SELF, "DESCRIBES", _LIBRARY),
            _relation(_TOOL, "BUILD_TOOL_OF", _LIBRARY),
            *(_relation(_LIBRARY, "GENERATED_FROM", _interface(name)) for name in interfaces),
            *(_relation(_LIBRARY, "CONTAINS", entry["SPDXID"]) for entry in entries),
        ],
    }
    return (json.dumps(document, indent=1, ensure_ascii=False) + "\n").encode()


def _library(view: PackageView, entries: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the package itself; SPDX 2.3, 7.9: the SHA-1 of the sorted SHA-1s of its files."""
    digests = sorted(entry["checksums"][0]["checksumValue"] for entry in entries)
    code = hashlib.sha1("".join(digests).encode(), usedforsecurity=False).hexdigest()
    found = sorted({name for entry in entries for name in entry["licenseInfoInFiles"]})
    return {
        **_other(_LIBRARY, view.library, view.version, _LICENSE),
        "summary": view.summary,
        "filesAnalyzed": True,
        "licenseInfoFromFiles": found,
        "packageVerificationCode": {
            "packageVerificationCodeValue": code,
            "packageVerificationCodeExcludedFiles": [f"./{SBOM}", "./manifest.json"],
        },
        "primaryPackagePurpose": "LIBRARY",
    }


def _other(identity: str, name: str, version: str, license_name: str) -> dict[str, Any]:
    return {
        "SPDXID": identity,
        "name": name,
        **({"versionInfo": version} if version else {}),
        "downloadLocation": _UNKNOWN,
        "filesAnalyzed": False,
        "licenseConcluded": license_name,
        "licenseDeclared": license_name,
        "copyrightText": _UNKNOWN,
    }


def _file(name: str, content: bytes) -> dict[str, Any]:
    tag = _TAG.search(content[:_HEAD])
    license_name = tag[1].decode() if tag else _UNKNOWN
    return {
        "SPDXID": f"SPDXRef-file-{hashlib.sha256(name.encode()).hexdigest()[:16]}",
        "fileName": f"./{name}",
        "checksums": [
            {
                "algorithm": "SHA1",
                "checksumValue": hashlib.sha1(content, usedforsecurity=False).hexdigest(),
            },
            {"algorithm": "SHA256", "checksumValue": hashlib.sha256(content).hexdigest()},
        ],
        "licenseConcluded": _LICENSE if license_name == _UNKNOWN else license_name,
        "licenseInfoInFiles": [license_name],
        "copyrightText": _UNKNOWN,
    }


def _interface(name: str) -> str:
    return f"SPDXRef-interfaces-{re.sub('[^A-Za-z0-9.-]', '-', name)}"


def _relation(first: str, kind: str, second: str) -> dict[str, str]:
    return {"spdxElementId": first, "relationshipType": kind, "relatedSpdxElement": second}
