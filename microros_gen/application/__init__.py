# SPDX-License-Identifier: Apache-2.0
"""The application file (`microros.yaml`): model, parser and schema."""
