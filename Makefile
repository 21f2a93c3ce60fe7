# SPDX-License-Identifier: Apache-2.0
# make demo | test | quick | system | check | lint | misra | proof | bench | golden | footprint | docs | release. Each sets up its own virtual environment in .venv first.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

.PHONY: demo test quick system check lint misra proof bench golden footprint docs release clean

demo: $(VENV)/ros.stamp
	@$(BIN)/python examples/demo/demo.py

test: $(VENV)/dev.stamp
	@$(PYTHON) tests/tools/system_packages.py
	@$(BIN)/python -m tests.tools.run_suite test

quick: $(VENV)/dev.stamp
	@$(BIN)/python -m tests.tools.run_suite quick

system: $(VENV)/dev.stamp
	@$(PYTHON) tests/tools/system_packages.py
	@$(BIN)/python -m tests.tools.run_suite system

check: $(VENV)/dev.stamp
	@$(PYTHON) tests/tools/system_packages.py
	@$(BIN)/python -m tests.tools.run_suite check

lint: $(VENV)/dev.stamp
	@$(PYTHON) tests/tools/system_packages.py
	@$(BIN)/python -m tests.tools.run_suite lint

misra: $(VENV)/dev.stamp
	@$(BIN)/python -m tests.tools.misra $(FILES)

proof: $(VENV)/dev.stamp
	@$(PYTHON) tests/tools/system_packages.py
	@$(BIN)/python -m tests.proof.prove

bench: $(VENV)/dev.stamp
	@$(PYTHON) tests/tools/system_packages.py
	@$(BIN)/python -m tests.bench.bench

golden: $(VENV)/dev.stamp
	@$(BIN)/python -m tests.tools.update_golden
	@$(BIN)/python -m tests.tools.update_exchanges

footprint: $(VENV)/dev.stamp
	@$(BIN)/python -m tests.tools.update_footprint

docs: $(VENV)/dev.stamp
	@NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict
	@echo "build/site/index.html"

release: $(VENV)/dev.stamp
	@$(BIN)/python -m tests.tools.release

$(VENV)/bin/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' \
	  || { echo "microros-gen needs Python 3.10 or newer: make PYTHON=/path/to/python3 $(MAKECMDGOALS)"; exit 2; }
	@$(PYTHON) -m venv $(VENV) \
	  || { rm -rf $(VENV); echo "Install what makes virtual environments: apt-get install python3-venv"; exit 2; }

$(VENV)/ros.stamp: $(VENV)/bin/python pyproject.toml
	@echo "Setting up $(VENV) with ROS 2 Jazzy from PyPI (once) ..."
	@$(BIN)/python -m pip install -q --disable-pip-version-check -e '.[ros]'
	@touch $@

$(VENV)/dev.stamp: $(VENV)/bin/python pyproject.toml
	@echo "Setting up $(VENV) with ROS 2 Jazzy and the test tools from PyPI (once) ..."
	@$(BIN)/python -m pip install -q --disable-pip-version-check -e '.[ros,dev]'
	@touch $@ $(VENV)/ros.stamp

clean:
	rm -rf build $(VENV)
