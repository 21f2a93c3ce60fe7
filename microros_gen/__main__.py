# SPDX-License-Identifier: Apache-2.0
"""`python -m microros_gen` is `microros-gen`."""

from microros_gen.cli.main import main

if __name__ == "__main__":
    main()
