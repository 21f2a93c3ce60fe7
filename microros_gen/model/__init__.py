# SPDX-License-Identifier: Apache-2.0
"""The data that the steps hand on: interfaces, application, profiles, components. Immutable, no input or output."""
