# SPDX-License-Identifier: Apache-2.0
"""Ways to clients: `base` says what a transport is; one module each."""
