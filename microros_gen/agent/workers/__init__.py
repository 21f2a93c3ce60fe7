# SPDX-License-Identifier: Apache-2.0
"""Several worker processes of one agent: the front has all that exists once, and each client has a worker."""
