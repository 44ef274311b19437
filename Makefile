# Ringroad: what can be done here is told by `make help`.
# Everything is a real dependency: what is up to date is not built again.

SHELL := bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:
.NOTPARALLEL:                 # cargo and vite use all cores by themselves
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
.DEFAULT_GOAL := help

# Where `make run` serves; the next free port is taken when this one is busy.
HOST ?= localhost
PORT ?= 4173

# Debian's browser and its driver; only `make test` and `make bench-web` need them.
export CHROMIUM ?= /usr/bin/chromium
export CHROMEDRIVER ?= /usr/bin/chromedriver
# One place for what cargo builds, whatever the environment says.
export CARGO_TARGET_DIR := $(CURDIR)/target
# The command that the tests of the page and of the CSV hold against the browser and pandas.
export RINGROAD := $(CURDIR)/target/release/ringroad
# Seconds that a test in the browser may take (the runner's default is 20).
export WASM_BINDGEN_TEST_TIMEOUT := 300
# wasm-pack takes wasm-opt from here, not from the network.
export PATH := $(CURDIR)/www/node_modules/.bin:$(or $(CARGO_HOME),$(HOME)/.cargo)/bin:$(PATH)

PYTHON := .venv/bin/python
WASM := --target wasm32-unknown-unknown --no-default-features --features laboratory,figures
NPM := npm --prefix www
# A runner's output goes to the terminal and to a log, from which `make test` repeats the runner's own summary.
LOGS := target/log
LOG = 2>&1 | tee $(LOGS)/$@.log

# The version carries the commit, where a build script reads it: a new commit is a change of the source.
COMMIT := $(if $(wildcard build.rs),$(wildcard $(shell git rev-parse --git-path logs/HEAD 2>/dev/null)))
CORE := Cargo.toml Cargo.lock .cargo/config.toml $(wildcard build.rs) $(COMMIT) \
	$(shell find src -name '*.rs' -not -path src/main.rs -not -path 'src/command/*')
COMMAND := src/main.rs $(wildcard src/command/*.rs)
PAGE := $(wildcard www/*.html www/*.ts www/tsconfig.json) $(shell find www/src www/public -type f 2>/dev/null)

# ---- what people type ------------------------------------------------------------------------------------------

.PHONY: help run build test bench bench-web screenshot clean distclean

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /\1\t/' | expand -t 12

run: build ## build the page and serve it here
	@echo
	@echo "The page in one file: $(CURDIR)/dist/ringroad.html"
	@echo "The site, until Ctrl-C:"
	@cd www && exec vite preview --outDir ../dist --host '$(HOST)' --port '$(PORT)'

build: dist/ringroad.html ## build dist/ (the site) and dist/ringroad.html (the page in one file)

TESTS := setup format lint hashes lint-wasm documentation package rust csv types units size wasm browser
test: $(TESTS:%=test-%) ## run every test: core, command, CSV, WebAssembly and page
	@echo
	for name in $(TESTS); do \
		sed 's/\x1b\[[0-9;]*m//g' $(LOGS)/test-$$name.log 2>/dev/null | grep -hE '^(test result: |Ran [0-9]|OK|FAILED)|^ *(Tests|Test Files) |^ℹ (tests|pass|fail) |^[0-9]+ passed|\bkB\b' \
			| sed "s/^ */$$name: /" || true; \
	done

bench: | setup ## time the core and print ns per vehicle-update
	cargo bench

bench-web: www/pkg/ringroad_bg.wasm | setup-test ## the same in Chromium and in Node
	$(NPM) run bench

screenshot: build | setup-test ## take docs/lab.png anew
	$(NPM) run screenshot

clean: ## remove what was built
	rm -rf dist www/pkg www/pkg-figures www/test-results target

distclean: clean ## remove what was installed into this folder, too
	rm -rf www/node_modules .venv

# ---- what is built ---------------------------------------------------------------------------------------------

.PHONY: setup setup-test

setup:
	@scripts/setup.sh build

setup-test: | $(LOGS)/
	@scripts/setup.sh test

$(LOGS)/:
	@mkdir -p $@

www/node_modules/.package-lock.json: www/package.json www/package-lock.json | setup
	$(NPM) ci --no-audit --no-fund
	@touch $@

# Two WebAssembly modules from one core: the laboratory's, and the paper's figures', which the laboratory never loads.
MODULES := www/pkg/ringroad_bg.wasm www/pkg-figures/figures_bg.wasm
www/pkg/ringroad_bg.wasm: FEATURE := laboratory
www/pkg-figures/figures_bg.wasm: FEATURE := figures

# For size: it downloads faster. At level 3 the first is 12 kB larger, gzipped, and no faster: its kernels are vectors by name.
$(MODULES): $(CORE) | www/node_modules/.package-lock.json setup
	@command -v wasm-opt >/dev/null || { echo 'wasm-opt is missing: the package binaryen of www/package.json brings it' >&2; exit 1; }
	CARGO_PROFILE_RELEASE_OPT_LEVEL=s wasm-pack build --target web --out-dir $(@D) --out-name $(@F:_bg.wasm=) \
		-- --locked --no-default-features --features $(FEATURE)
	@touch $@

# One file last: when it is there, the whole of dist/ is.
dist/ringroad.html: $(MODULES) www/node_modules/.package-lock.json $(PAGE)
	$(NPM) run build
	@touch $@

target/release/ringroad: $(CORE) $(COMMAND) | setup
	cargo build --locked --release
	@touch $@

# The hashes of the tables that the native core computes, for the browser to compute again. The native test
# writes them to $RINGROAD_HASHES (.cargo/config.toml); tests/web.rs includes that file.
target/hashes.json: $(CORE) tests/hashes.rs $(wildcard tests/common/*.rs) | setup
	cargo test --test hashes
	@touch $@

.venv/.installed: tests/python/requirements.txt | setup-test
	test -x $(PYTHON) || python3 -m venv .venv
	$(PYTHON) -m pip install --quiet --disable-pip-version-check -r $<
	@touch $@

# ---- the tests, the quick ones first; each can be run alone ----------------------------------------------------

.PHONY: $(TESTS:%=test-%)
$(TESTS:%=test-%): | setup-test

test-setup: # with stand-ins for apt-get, rustup and cargo
	tests/setup.sh $(LOG)

test-format:
	cargo fmt --check

test-lint:
	cargo clippy --locked --all-targets -- -D warnings

test-hashes: target/hashes.json

test-lint-wasm: target/hashes.json
	cargo clippy --locked $(WASM) --lib --test web --test node -- -D warnings

test-documentation:
	RUSTDOCFLAGS='-D warnings' cargo doc --locked --no-deps --lib

test-package: # `tests/package.sh test` runs the tests of the unpacked crate, too
	tests/package.sh check $(LOG)

test-rust: # with the tests in the documentation and in the README
	cargo test $(LOG)

test-csv: target/release/ringroad .venv/.installed
	$(PYTHON) -m unittest discover --start-directory tests/python --pattern '*.py' $(LOG)

test-types: $(MODULES)
	$(NPM) run typecheck

test-units: $(MODULES)
	$(NPM) test $(LOG)

test-size: build
	$(NPM) run size $(LOG)

test-wasm: target/hashes.json | www/node_modules/.package-lock.json
	wasm-pack test --headless --chrome --chromedriver '$(CHROMEDRIVER)' -- --no-default-features --test web $(LOG)
	wasm-pack test --node -- --no-default-features --test node 2>&1 | tee -a $(LOGS)/$@.log

test-browser: build target/release/ringroad
	$(NPM) run test:browser $(LOG)
