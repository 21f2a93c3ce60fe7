# SPDX-License-Identifier: Apache-2.0
"""Access control: which clients may connect from where, what each may use, and how much of it."""
