# Every target does its own set-up, once: what is there already is left alone.
SHELL := bash
.DEFAULT_GOAL := help
.PHONY: help demo lab test coverage fuzz bench validate tour build wheel clean gl chromium

# make test PYTHON=python3.13: a .venv of another Python is made anew.
PYTHON ?=
export PYTHON
ifneq ($(PYTHON),)
$(shell PYTHON='$(PYTHON)' scripts/setup.sh other-python)
endif
PY := .venv/bin/python
# A stamp lies inside what it vouches for, so that removing the one removes the other.
VENV := .venv/made-venv
LAB := .venv/made-lab
TEST := .venv/made-test
NODE_MODULES := js/node_modules/.made
STATIC := sunwidget/static/.made
FRONT_END := $(shell find js sunwidget/shaders -path js/node_modules -prune -o -type f -print 2>/dev/null)
say = @printf '\033[1m==> %s\033[0m\n'

help:
	@echo 'make demo    maps, a still and a sunset film of the bundled photo'
	@echo 'make lab     open the quickstart notebook in JupyterLab'
	@echo 'make test    every check: lint, types, JavaScript, Python, browser, notebooks'
	@echo 'make coverage  which lines the tests run; pages in build/coverage'
	@echo 'make fuzz HOURS=1  look for files that break the readers or the whole way; goes on in .fuzz'
	@echo 'make bench   measure speed beside other ways of doing it; table, plot and build/bench.json'
	@echo 'make validate  the sky against measurements and other models; table and build/validation.json'
	@echo 'make tour    pictures of a walk through the editor in JupyterLab, in build/tour'
	@echo 'make build   build the front end into sunwidget/static'
	@echo 'make wheel   a wheel in dist/, front end inside'
	@echo 'make clean   remove everything that was built (not .venv, not node_modules)'

demo: $(LAB) gl
	@if scripts/setup.sh node; then $(MAKE) --no-print-directory build; \
	  else echo 'The notebook front end is left out; maps, stills and films need none.'; fi
	@.venv/bin/sunwidget demo -o build/demo
	@echo 'Open the notebook: make lab'

lab: $(LAB) $(STATIC) gl
	@.venv/bin/jupyter lab $(if $(filter 0,$(shell id -u)),--allow-root) notebooks/01_quickstart.ipynb

# PYTEST="-k camera" passes arguments on.
test: $(TEST) $(STATIC) gl chromium
	@scripts/check.sh -- $(PYTEST)

# Without the browser: what Chromium runs of JavaScript and what its kernels run are not counted.
coverage: $(TEST) $(STATIC) gl
	@scripts/coverage.sh $(PYTEST)

# Half of the time for the readers of files, half for the whole way to a page; ends at a finding,
# which lies in .fuzz and is tried again by naming it instead of the folder.
HOURS ?= 1
fuzz: $(TEST) $(STATIC) gl
	@mkdir -p .fuzz
	@for part in photo_readers whole_way; do \
	  nice -n 19 $(PY) tests/fuzz/$$part.py .fuzz/$$part -print_final_stats=1 \
	    -max_total_time=$$($(PY) -c 'print(round(1800 * $(HOURS)))') || exit 1; done

bench: $(TEST) $(STATIC) gl chromium
	@$(PY) bench/bench.py $(BENCH)

validate: $(TEST) $(STATIC) gl chromium
	@$(PY) bench/validate.py $(VALIDATE)

tour: $(TEST) $(STATIC) gl chromium
	@$(PY) scripts/tour.py $(TOUR)

build: $(STATIC)

wheel: $(TEST) $(STATIC)
	@$(PY) -m build --wheel

clean:
	rm -rf build dist sunwidget/static .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . \( -name .venv -o -name node_modules -o -name .git \) -prune -o -name __pycache__ -print0 | xargs -0 rm -rf

gl: $(VENV)
	@scripts/setup.sh gl

chromium:
	@scripts/setup.sh chromium

$(VENV): pyproject.toml
	@scripts/setup.sh venv
	$(say) 'Python packages of sunwidget'
	@$(PY) -m pip install --quiet --editable .
	@touch $@

$(LAB): $(VENV)
	$(say) 'Python packages for the notebook and films'
	@$(PY) -m pip install --quiet --editable '.[lab,video]'
	@touch $@

$(TEST): $(VENV)
	$(say) 'Python packages for the tests'
	@$(PY) -m pip install --quiet --editable '.[test]'
	@touch $@ $(LAB)

# Not `npm ci`: it refuses a lock file that lacks the optional packages of other platforms.
$(NODE_MODULES): js/package.json js/package-lock.json
	@scripts/setup.sh node
	$(say) 'JavaScript packages'
	@npm --prefix js install --no-save --no-audit --no-fund --loglevel=error
	@touch $@

$(STATIC): $(NODE_MODULES) $(FRONT_END)
	$(say) 'Front end'
	@npm --prefix js run --silent build
	@touch $@
