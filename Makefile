# Everything here sets itself up in .venv; all it needs is Python 3.11 to 3.13. Another one: make test PYTHON=python3.12
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

.DEFAULT_GOAL := help
.PHONY: help demo test test-slow bench clean

help:  ## what there is to make
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(READY)  ## check, show, train and run a skill, in a few minutes
	@PATH="$(CURDIR)/$(BIN):$$PATH" sh examples/demo.sh build/demo

test: $(READY)  ## the whole test suite
	$(BIN)/pytest --numprocesses auto

test-slow: $(READY)  ## the longer checks, too
	$(BIN)/pytest --numprocesses auto -m "slow or not slow"

bench: $(READY)  ## how fast it is, beside plain pymunk
	@for file in benchmarks/*.py; do echo "$$file"; $(BIN)/python $$file || exit; done

clean:  ## remove what was built, with the environment; runs and weights stay
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(READY): pyproject.toml
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[dev]"
	@touch $@
