# SPDX-License-Identifier: Apache-2.0
"""Read, resolve, plan, render, write and compile an application."""
