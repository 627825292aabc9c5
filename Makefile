# Everything here sets itself up in .venv; all it needs is Python 3.11 to 3.13. Another one: make test PYTHON=python3.12
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready

# Of `make paper`: where the weights lie, where the report goes, runs for each row of a table.
FOLDER ?= examples/collect
OUT ?= build/paper
RUNS ?= 1000
# Of `make paper-train`: attempts of the lessons of collect.mind and of the others, times the paper's generations.
# RUNGS: where attempts are compared early, and the worse half of them ends.
ATTEMPTS ?= 10
OTHERS ?= $(ATTEMPTS)
SCALE ?= 1
SEED ?= 1
RUNGS ?= 0
TO ?= runs/paper

.DEFAULT_GOAL := help
.PHONY: help demo test test-slow test-extras bench bench-learning paper paper-train docs playground wheel clean

help:  ## what there is to make
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(READY)  ## check, show, train and run a skill, in a few minutes
	@PATH="$(CURDIR)/$(BIN):$$PATH" sh examples/demo.sh build/demo

test: $(READY)  ## the whole test suite, with the same random cases each time
	$(BIN)/pytest --numprocesses auto

test-slow: $(READY)  ## the longer checks, too, with new random cases
	$(BIN)/pytest --numprocesses auto --hypothesis-profile explore -m "slow or not slow"

# What is tested where PyTorch, Stable-Baselines3, pandas and a browser are, which together are some gigabytes.
EXTRA_TESTS := tests/weights/test_torch.py tests/examples/test_ppo.py tests/environments/test_stable_baselines.py \
	tests/environments/test_parallel_task.py tests/api/test_notebook.py tests/view/test_page.py tests/site/test_site.py

test-extras: .venv/.extras  ## what is skipped where large packages are missing, after installing these
	$(BIN)/pytest --numprocesses auto -m "slow or not slow" $(EXTRA_TESTS)

.venv/.extras: $(READY)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[torch,sb3,browser]" pandas supersuit
	$(BIN)/playwright install chromium || echo "no Chromium was installed: tests of pages look for another one"
	@touch $@

bench: $(READY)  ## how fast it is, beside plain pymunk
	@for name in check engine rollout; do echo "$$name"; $(BIN)/python benchmarks/$$name.py || exit; done

bench-learning: $(READY)  ## how soon skills and the whole of Collect are learnt, over several seeds: half an hour
	@for name in learning curriculum; do echo "$$name"; $(BIN)/python benchmarks/$$name.py || exit; done

paper: $(READY)  ## tables 1 to 3 and figures 11 to 15 of the paper, from the shipped weights: FOLDER= OUT= RUNS=
	$(BIN)/python examples/collect/paper --folder $(FOLDER) --out $(OUT) --runs $(RUNS)

paper-train: $(READY)  ## the paper's whole protocol from nothing, goes on where it was stopped: ATTEMPTS= SCALE= SEED= RUNGS= TO=
	$(BIN)/python examples/collect/paper/teach.py --attempts $(ATTEMPTS) --others $(OTHERS) --scale $(SCALE) --seed $(SEED) --rungs $(RUNGS) --out $(TO)

docs: $(READY) $(filter playground,$(MAKECMDGOALS))  ## the site, in build/site: nothing of it comes from the network, and a dead link is an error
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going --conf-dir docs --doctree-dir build/doctrees . build/site

playground: $(READY)  ## the page on which minds are written in a browser, in build/site/playground; needs npm
	cd playground && npm ci --silent --no-audit --no-fund && npm run --silent check
	$(BIN)/python playground/pack.py build/playground
	cd playground && node build.mjs

wheel: $(READY)  ## a wheel with machine code for processors like this one, in dist/
	MIND_COMPILED=1 $(BIN)/python -m hatchling build -t wheel

clean:  ## remove what was built, with the environment; runs and weights stay
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis

$(READY): pyproject.toml
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[dev]"
	@touch $@
