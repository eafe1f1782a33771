# make serve: the page.  make check: what is quick, without a browser.  make test: everything.  make docs: the documentation.
# make tables: what the library has measured and stored, where code has changed since.
# Each sets up all it needs on a fresh machine.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
SUDO := $(shell [ "$$(id -u)" = 0 ] || command -v sudo)
PIP_INSTALL := $(BIN)/pip install --quiet --no-compile --disable-pip-version-check --constraint constraints.txt
PYTEST := $(BIN)/python -m pytest -n auto --dist worksteal --durations=25

# Bytecode is written at the first import, of what is imported: else each of the many processes of tests makes its own.
export PYTHONDONTWRITEBYTECODE =

.PHONY: serve check coverage test machines docs bench tables wasm package peers screenshot clean chromium haproxy

# The page is packed where Node and esbuild are there already; else its plain modules are sent.
serve: $(VENV)/.installed
	-@[ ! -d node_modules/esbuild ] || node pack.js
	$(BIN)/impact serve

check: $(VENV)/.installed-test
	$(PYTEST) -m "not browser and not slow"

# Which lines and branches `make check` runs through; kernels and other processes are not seen.
coverage: $(VENV)/.installed-test
	$(PYTEST) -m "not browser and not slow" --cov --cov-report=term

test: $(VENV)/.installed-test chromium haproxy package
	$(BIN)/impact warm  # else each of the servers that tests start would compile the same
	$(PYTEST) -n $$(($$(nproc) + 1))  # tests of the page wait half of their time

# Other processors, as far as libraries choose by them, other versions and other Pythons; each by the quick tests.
# The kernels for browsers, built again, give what those give that are stored.
machines: $(VENV)/.installed-test node_modules/.installed
	$(BIN)/python -m app.wasm.build build/kernels.wasm
	MODULE=build/kernels.wasm $(PYTEST) tests/app/wasm
	$(BIN)/python -m tests.machines

# Needs no network once installed, neither to build nor to read.
docs: $(VENV)/.installed-test package
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --quiet --strict
	@$(BIN)/impact export-static build/site/impact
	@echo "Built: build/site/index.html"

bench: $(VENV)/.installed-test chromium
	$(BIN)/python -m bench

# Minutes; stopped half-way it goes on where it was. `make test` refuses a release whose tables are out of date.
tables: $(VENV)/.installed-test
	$(BIN)/python -m bench.tables

# The kernels for browsers; `make test` refuses them where their sources have changed since.
wasm: $(VENV)/.installed-test
	$(BIN)/python -m app.wasm.build

# The page in a few files, less than half as large: before a wheel is built, or a class comes.
package: node_modules/.installed
	@node pack.js

# Other programs on the same impacts, on one thread; `make bench` runs them too once they are installed.
peers: $(VENV)/.installed-test
	$(PIP_INSTALL) --editable '.[test,peers]'
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m bench --only peers
	OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 $(BIN)/python -m bench --only peer-mechanisms

screenshot: $(VENV)/.installed-test chromium
	$(BIN)/python -m bench.screenshot docs/page.png

$(VENV)/.created:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "Python 3.11 or newer is needed."; exit 1; }
	@$(PYTHON) -m venv $(VENV) 2>/dev/null || { rm -rf $(VENV); echo "Installing python3-venv"; \
		$(SUDO) apt-get update -qq && $(SUDO) apt-get install -qq -y python3-venv && $(PYTHON) -m venv $(VENV); }
	@touch $@

$(VENV)/.installed: $(VENV)/.created pyproject.toml constraints.txt
	@echo "Installing (once, a minute or two)"
	@$(PIP_INSTALL) --editable .
	@touch $@

$(VENV)/.installed-test: $(VENV)/.created pyproject.toml constraints.txt
	@echo "Installing, with what tests need (once, a minute or two)"
	@$(PIP_INSTALL) --editable '.[test,docs]'
	@touch $(VENV)/.installed $@

# One that is there; else Debian's own, without windows; else the build that Playwright brings.
chromium: $(VENV)/.installed-test
	@command -v chromium-headless-shell >/dev/null || command -v chromium >/dev/null || [ -n "$$CHROMIUM" ] || { echo "Installing Chromium"; \
		{ grep -qs '^ID=debian' /etc/os-release && $(SUDO) apt-get update -qq && \
		$(SUDO) apt-get install -qq -y --no-install-recommends chromium-headless-shell fonts-dejavu-core >/dev/null; } || \
		$(BIN)/playwright install --with-deps chromium; }

# The proxy whose configuration docs/hosting has; its tests are skipped where it cannot be installed.
haproxy:
	@command -v haproxy >/dev/null || [ -x /usr/sbin/haproxy ] || { echo "Installing HAProxy"; \
		{ $(SUDO) apt-get update -qq && $(SUDO) apt-get install -qq -y --no-install-recommends haproxy >/dev/null; } || true; }

# Checks and packing of the browser code; its modules run without them.
node_modules/.installed: package.json
	@command -v npm >/dev/null 2>&1 || { echo "Installing Node"; \
		$(SUDO) apt-get update -qq && $(SUDO) apt-get install -qq -y --no-install-recommends nodejs npm >/dev/null; }
	@npm install --silent --no-audit --no-fund
	@touch $@

clean:
	rm -rf $(VENV) node_modules build app/packed *.egg-info .pytest_cache .ruff_cache .hypothesis .import_linter_cache
