# Everything a fresh machine needs is Python >= 3.11 and make: the first `make check` or `make test`
# makes a virtual environment in .venv and installs locked versions in it: requirements-core.lock for what
# checks the rover (check, check-repairs), and requirements.lock, which has all of it, for everything else.
#
#   PYTHON=python3.12       another interpreter
#   VENV=.venv-3.12         another place for the environment
#   JOBS=4                  processes for the tests; some of them wait for others, so more than processors
#   ARGS="--system rover"   further arguments of `check`, `test`, `test-full`, `reports` and `bench`

VENV ?= .venv
JOBS ?= $(shell echo $$(( $$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2) + 1 )))
ARGS ?=
packages = $(shell grep -c '^[a-z0-9].*==' $(1)) packages
NEW_ENOUGH := -c 'import sys; sys.exit(sys.version_info < (3, 11))'
ifndef PYTHON
PYTHON := $(or $(shell for p in python3 python3.13 python3.12 python3.11 python3.14 python; do \
	"$$p" $(NEW_ENOUGH) 2>/dev/null && echo $$p && break; done),python3)
endif

RUN     := $(VENV)/bin/python
# The stamp carries the version of the interpreter, so that another PYTHON makes a new environment.
VERSION := $(shell "$(PYTHON)" -c 'import sys; print("%d.%d.%d" % sys.version_info[:3])' 2>/dev/null)
STAMP   := $(VENV)/installed-for-$(VERSION)
TOOLS   := $(VENV)/tools-for-$(VERSION)
INSTALL := -m pip install --disable-pip-version-check

.DEFAULT_GOAL := help
.PHONY: help setup check check-full check-repairs test test-full lint types reports docs bench format lock clean
.DELETE_ON_ERROR:

help:
	@echo "make check          every property of the rover on the charts; exit code 0: all as expected"
	@echo "make check-full     also what takes long, and every proof certified"
	@echo "make check-repairs  every property that a proposed repair concerns (hours)"
	@echo "make test           lint, types, import contracts and the whole test suite"
	@echo "make test-full      the same with every random example and all evidence found anew"
	@echo "make reports        write the evidence in reports/ anew"
	@echo "make docs           build the documentation site in site/"
	@echo "make lint           ruff only            make types     mypy only"
	@echo "make format         lay the code out     make bench     time the engines"
	@echo "make lock           choose new versions of the dependencies, with hashes"
	@echo "make setup          install all of it, and check nothing"
	@echo "make clean          remove the environment and every cache"

check: $(STAMP)
	@$(RUN) -m rovercheck check --strict $(ARGS)

docs: $(TOOLS)
	@$(RUN) -m docs.reference
	@NO_MKDOCS_2_WARNING=1 $(RUN) -m mkdocs build --strict --quiet

check-full: $(TOOLS)
	@$(RUN) -m rovercheck check --strict --full --certify $(ARGS)

check-repairs: $(STAMP)
	@worst=0; for repair in $$($(RUN) -c 'from rovercheck.spec_model.repairs import proposals; print(*proposals())'); do \
		echo; echo "With $$repair:"; \
		$(RUN) -m rovercheck check --repair "$$repair" --timers free --timeout 600 $(ARGS) || worst=$$?; \
	done; exit $$worst

test: lint types
	@echo "Tests, in $(JOBS) processes ..."
	@$(RUN) -m pytest -q -n $(JOBS) --dist worksteal $(SUITE) $(ARGS)

test-full: SUITE := --hypothesis-profile=full
test-full: test

lint: $(TOOLS)
	@echo "Lint ..."
	@$(RUN) -m ruff check --quiet .

types: $(TOOLS)
	@echo "Types ..."
	@$(RUN) -m mypy

format: $(TOOLS)
	@$(RUN) -m ruff check --quiet --fix-only .
	@$(RUN) -m ruff format .

reports: $(TOOLS)
	@$(RUN) -m rovercheck reports $(ARGS)

bench: $(TOOLS)
	@$(RUN) -m benchmarks.compare $(ARGS)

setup: $(TOOLS)

# pip says what it fetches and how far it is, on a terminal with a bar, in a log with a line for each package.
$(STAMP): requirements-core.lock pyproject.toml
	@"$(PYTHON)" $(NEW_ENOUGH) 2>/dev/null || { \
		echo "rovercheck needs Python 3.11 or newer; '$(PYTHON)' $(if $(VERSION),is Python $(VERSION),does not run)."; \
		echo "Install one, or name it: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 1; } >&2
	@"$(PYTHON)" -c 'import venv, ensurepip' 2>/dev/null || { \
		echo "This Python $(VERSION) has no module 'venv' (on Debian and Ubuntu: apt install python3-venv)."; \
		exit 1; } >&2
	@test -x "$(RUN)" -a -n "$(wildcard $(STAMP))" || { \
		echo "Making a virtual environment in $(VENV) (Python $(VERSION)) ..."; \
		"$(PYTHON)" -m venv --clear "$(VENV)" && echo '*' > "$(VENV)/.gitignore"; }
	@echo "Installing what decides the properties ($(call packages,requirements-core.lock)) ..."
	@$(RUN) $(INSTALL) --require-hashes -r requirements-core.lock
	@$(RUN) $(INSTALL) -qq --no-deps --no-build-isolation --editable .
	@touch "$(STAMP)"

# `check` needs none of it, so that whoever only checks does not wait for it.
$(TOOLS): requirements.lock $(STAMP)
	@echo "Installing what tests, documents and certificates need besides ($(call packages,requirements.lock) in all) ..."
	@$(RUN) $(INSTALL) --require-hashes -r requirements.lock
	@touch "$(TOOLS)"

# uv, in an environment of its own, resolves for every platform and every Python from 3.11 on at once.
PIN := pip compile pyproject.toml --universal --python-version 3.11 --fork-strategy fewest --generate-hashes \
	--no-header --no-emit-index-url --quiet
lock:
	@"$(PYTHON)" -m venv "$(VENV)/lock"
	@"$(VENV)/lock/bin/python" -m pip install -qq --disable-pip-version-check uv
	@"$(VENV)/lock/bin/uv" $(PIN) --group dev --upgrade --output-file requirements.lock
	@"$(VENV)/lock/bin/uv" $(PIN) --group build --constraint requirements.lock --output-file requirements-core.lock

clean:
	rm -rf "$(VENV)" .pytest_cache .mypy_cache .ruff_cache .hypothesis build dist
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
