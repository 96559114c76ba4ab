# One word a task. serve and test do everything by themselves in a fresh clone; the first run takes about a minute.
PYTHON ?= python3
BIN = .venv/bin
BUNDLED = pyproject.toml hatch_build.py app/frontend/package.json app/frontend/package-lock.json $(wildcard app/frontend/src/*.js)

.PHONY: serve test validation docs bench image browser proxy

serve: .venv/serve
	TIPPE_ADDRESS=localhost TIPPE_SHOW=1 $(BIN)/python -m app

test: .venv/test browser proxy
	$(BIN)/ruff check .
	$(BIN)/lint-imports
	$(BIN)/pytest

# Writes docs/validation.md from the results of the tests, with the whole accuracy map: some ten minutes.
validation: .venv/test
	$(BIN)/python tests/validation.py

docs: .venv/docs
	$(BIN)/sphinx-build -W -q docs docs/_build
	@echo "docs/_build/index.html"

bench: .venv/bench .venv/test browser
	OPENBLAS_NUM_THREADS=1 $(BIN)/python benchmarks/bench.py

image:
	docker build -t tippe-top-explorer .

# Chromium for the tests: what is there, else Debian's or Ubuntu's where we may install it, else playwright's own.
browser: .venv/test
	@command -v chromium >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && apt-get update -qq && apt-get install -y -qq chromium; } \
	|| $(BIN)/playwright install chromium

# HAProxy for its test, which skips where there is none.
proxy:
	@command -v haproxy >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && apt-get update -qq && apt-get install -y -qq haproxy; } \
	|| echo "haproxy is not installed: the test of deploy/haproxy.cfg will skip"

.venv/serve: $(BUNDLED)
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --editable .
	touch $@

.venv/test .venv/docs .venv/bench: .venv/%: .venv/serve
	$(BIN)/pip install --quiet --editable '.[$*]'
	touch $@
