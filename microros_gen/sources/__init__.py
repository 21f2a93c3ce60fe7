# SPDX-License-Identifier: Apache-2.0
"""Finds and reads what a run is made from: interfaces, profiles, components, targets, the application file."""
