# SPDX-License-Identifier: Apache-2.0
"""Packages: the sources of a plan in the form that another build system takes, as a folder or an archive.

A package is a folder, `platform/package/<name>/`: package.yaml, microros.yaml (the general plan), target.yaml (what
the library stands on; without it the application chooses) and files/ (its own files; `.j2` are templates).
"""
