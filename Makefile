# Every target makes what it needs from nothing; a second run does only what changed.

VENV   := .venv
BIN    := $(VENV)/bin
# The first interpreter that is new enough; choose another with `make PYTHON=/path/to/python3.12 ...`.
PYTHON ?= $(shell for p in python3 python3.13 python3.12 python3.11; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && { echo $$p; break; }; done)
# Options for pytest, for example `make test PYTEST_ARGS="-k sources -x"`.
PYTEST_ARGS ?= -n 2 --dist loadfile -q

# What the tests need; CI also runs those of training, with one pinned PyTorch, and of the pages in a browser (elsewhere they run
# where PyTorch, or Playwright and Chromium, are installed).
EXTRAS ?= dev,synthetic
ifdef CI
EXTRAS := browser,cluster,dev,evaluation,synthetic,train
TORCH  ?= torch==2.13.0
endif

WEB := clients/web
BUF := npx -y -p @bufbuild/buf@1.75.0 buf

# The hand networks are made while the package is installed; when they are gone, install again.
HANDS := egotouch_sdk/models/hands/manifest.json
AGAIN := $(if $(wildcard $(HANDS)),,FORCE)
PARTS := pyproject.toml hatch_build.py $(wildcard egotouch_sdk/hands/convert/*.py)

.PHONY: help demo test lint web proto schema bench model clean FORCE
.DEFAULT_GOAL := help

help: ## list the targets
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## /  make \1\t/' | expand -t 14

demo: $(VENV)/.run ## set everything up and show touches on skin, live, without a camera
	$(BIN)/egotouch demo $(ARGS)

test: lint web ## ruff, mypy and all tests, those of the web client too
	$(BIN)/python -m pytest $(PYTEST_ARGS)

lint: $(VENV)/.dev ## ruff and mypy --strict
	$(BIN)/ruff check .
	$(BIN)/mypy

# Without npm only CI complains: whoever changes nothing of the web client needs none.
ifneq ($(shell command -v npm 2>/dev/null),)
web: $(VENV)/.dev $(WEB)/node_modules/.installed ## build, check and test the web client and the served pages (needs npm)
	cd $(WEB) && npm run --silent generate -- --check && npm run --silent check && npm run --silent pages -- --check
	cd $(WEB) && EGOTOUCH_PYTHON=$(abspath $(BIN)/python) npm test --silent
else
web:
	@echo "There is no npm here, so the web client is not tested. Install Node.js 20 or newer to change it."$(if $(CI), && exit 1)
endif

$(WEB)/node_modules/.installed: $(WEB)/package.json $(WEB)/package-lock.json
	cd $(WEB) && npm ci --silent --no-audit --no-fund --ignore-scripts
	@touch $@

proto: $(VENV)/.dev ## make the Python classes of the schema again
	$(BIN)/python proto/generate.py

schema: ## lint the schema and compare it with the last release (needs npm)
	$(BUF) lint proto
	$(BUF) breaking proto --against proto/egotouch/v1/baseline.binpb

bench: $(VENV)/.run ## milliseconds per stage and frames per second on this machine
	$(BIN)/egotouch bench $(ARGS)

# As the shipped model was made: two stages on single patches and two on films, each with other people, light and poses; then a mean of
# the last two, calibrated on people who are in none. Pictures differ by their random numbers, so this gives its like, not its bits.
# Stop and start it as you like. `make model SHRINK=100` runs all of it with a hundredth of the scenes, to try it out.
SHRINK ?= 1
MODEL  := out/model$(if $(filter-out 1,$(SHRINK)),-$(SHRINK))
scenes = $(shell echo $$(($(1) / $(SHRINK) > 12 ? $(1) / $(SHRINK) : 12)))
people = $(shell echo $$(($(1) / $(SHRINK) > 3 ? $(1) / $(SHRINK) : 3)))
TRAIN  := OPENBLAS_NUM_THREADS=1 $(BIN)/egotouch train --workers 8
model: $(BIN)/python ## render and train the like of the shipped touch model (a GPU: half an hour; two cores: two days)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[synthetic,train]' $(TORCH)
	$(BIN)/egotouch synth patches --out $(MODEL)/data/a --series $(call scenes,1192) --participants $(call people,48) --seed 7
	$(BIN)/egotouch synth patches --out $(MODEL)/data/b --series $(call scenes,640) --participants $(call people,16) \
		--first-participant 100 --seed 11
	$(BIN)/egotouch synth films --out $(MODEL)/data/c --scenes $(call scenes,528) --participants $(call people,16) --seed 41
	$(BIN)/egotouch synth films --out $(MODEL)/data/d --scenes $(call scenes,968) --participants $(call people,72) \
		--first-participant 16 --seed 61
	$(BIN)/egotouch synth films --out $(MODEL)/data/e --scenes $(call scenes,120) --participants $(call people,10) \
		--first-participant 200 --seed 51
	test -f $(MODEL)/a/touch.onnx || $(TRAIN) --recipe stills --data $(MODEL)/data/a --out $(MODEL)/a
	test -f $(MODEL)/b/touch.onnx || $(TRAIN) --recipe stills --data $(MODEL)/data/b --out $(MODEL)/b \
		--start-from $(MODEL)/a/last.ckpt --epochs 12 --learning-rate 0.001
	test -f $(MODEL)/c/touch.onnx || $(TRAIN) --recipe films --data $(MODEL)/data/c --out $(MODEL)/c --start-from $(MODEL)/b/last.ckpt
	test -f $(MODEL)/d/touch.onnx || $(TRAIN) --recipe films --data $(MODEL)/data/d --out $(MODEL)/d --start-from $(MODEL)/c/last.ckpt \
		--learning-rate 0.0008
	$(BIN)/egotouch train --average $(MODEL)/c/last.ckpt $(MODEL)/d/last.ckpt $(MODEL)/d/last.ckpt --data $(MODEL)/data/e \
		--fit-force $(MODEL)/data/d --out $(MODEL)/mean

clean: ## remove the virtual environment, caches and the converted hand models
	rm -rf $(VENV) .mypy_cache .pytest_cache .ruff_cache .hypothesis build dist $(WEB)/node_modules $(WEB)/dist
	rm -f egotouch_sdk/models/hands/*.onnx egotouch_sdk/models/hands/manifest.json

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "No Python >= 3.11 found. Install one, or run: make PYTHON=/path/to/python3.11 $(MAKECMDGOALS)" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.run: $(BIN)/python $(PARTS) $(AGAIN)
	@echo "Installing the package and its hand tracking networks into $(VENV) (about a minute) ..."
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/.dev: $(BIN)/python $(PARTS) $(AGAIN)
	@echo "Installing the package with its development tools into $(VENV) (a minute or two) ..."
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[$(EXTRAS)]' $(TORCH)
	@touch $@ $(VENV)/.run
