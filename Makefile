# make assure   prove the kernel, check the sample layouts, ride trains, live days, reproduce the papers, drop guards,
#               fuzz briefly; write the records and the report under out/
# make mutants  drop every guard, condition and update, one after the other
# make joints   is each guarantee between machines, and each assumption below the theorem, needed and right?
# make record   all of it at the size of the record, for a night: every mutant, certificate, five seeds, 10,000 days
# make days     whole days of crossing, trams and track workers; DAYS=10000 for the record
# make fuzz     a campaign on the sample layouts; BATCHES=1000 for more, heisoku fuzz --hours for a night
# make lines    240 hours of lines with 20 trains on three networks, every fault on; HOURS=24 for fewer, and
#               LINES="a.json b.json" for other layouts
# make ride     trains with faulty sensors through the machines on board; RIDES=112000 for the record
# make beyond   the same with one fault after the other beyond its declared range
# make malformed  ten thousand malformed layout files; FILES=1000 for fewer
# make interruptions   500 commands interrupted, ended, their pipes closed, their disks full; RUNS=100 for fewer
# make papers   the papers' figures beside ours, with pictures
# make test     ruff, mypy, pytest; make slow: tests that take longer, of which these have samples
# make bench    print the measured figures
# make kept     how long a daily proof takes with answers kept, after 30 changes of one line; CHANGES=10 for fewer
#
# Needs Python 3.11 or later and make; everything else is installed into .venv, once.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
PIP    := $(BIN)/python -m pip --disable-pip-version-check
LAYOUTS := $(sort $(wildcard layouts/*.toml))
SOLVER ?= both
# Every obligation is asked at so many seeds.
SEEDS  ?= 1
TESTS  ?= tests
CONTRACTS := $(sort $(wildcard tests/contracts_*.py tests/*/contracts_*.py))
# Tests run on this many processes.
JOBS   ?= auto
RIDES  ?= 512
DAYS   ?= 50
SYSTEMS := crossing tram alarm
PAPERS := 000 001 002 003 004
# So many mutants are tried by make assure; make mutants tries all.
MUTANTS ?= 100
# The same of obligations with certificates; make certificates makes all.
CERTIFICATES ?= 150
BEYOND ?= 128
FILES  ?= 10000
RUNS   ?= 500
CHANGES ?= 30
BATCHES ?= 8
# So many simulated hours in all, on these layouts.
HOURS ?= 240
LINES ?= $(foreach seed,1 2 3,out/networks/$(seed).toml)

# Thousands of processes are begun here: each would compile every source anew.
unexport PYTHONDONTWRITEBYTECODE

.DELETE_ON_ERROR:
.PHONY: help interruptions assure record prove certify certificates check ride days fuzz lines beyond papers kept mutate mutants joints cores pdf malformed report test slow lint types format pages bench crosshair setup lock clean distclean

help:
	@sed -n '/^#/!q;s/^# \{0,1\}//p' Makefile

# ---- what it is for

assure: prove certify check ride days papers mutate fuzz report

# The parts one after the other, each at its whole size; the report last.
record:
	$(MAKE) prove SEEDS=5
	$(MAKE) certificates cores check
	$(MAKE) ride RIDES=112000
	$(MAKE) beyond BEYOND=1024
	rm -f $(SYSTEMS:%=out/%.days)
	$(MAKE) days DAYS=10000
	rm -f out/mutants.json
	$(MAKE) papers mutants joints
	$(MAKE) fuzz BATCHES=1000
	$(MAKE) crosshair test slow
	$(MAKE) pdf

prove: setup
	@mkdir -p out
	rm -rf out/obligations
	$(BIN)/heisoku prove --solver $(SOLVER) --seeds $(SEEDS) --json out/prove.json --junit out/prove.xml --keep out/obligations

check: setup
	@mkdir -p out
	@test -n "$(LAYOUTS)" || { echo "make check: no layouts/*.toml to check" >&2; exit 2; }
	$(BIN)/heisoku check $(LAYOUTS) --json out/check.json

ride: setup
	@mkdir -p out
	$(BIN)/heisoku ride --rides $(RIDES) --json out/ride.json

fuzz: setup
	@mkdir -p out
	rm -rf out/fuzz
	$(BIN)/heisoku fuzz layouts/passing_station.toml $(foreach target,interlocking jolted lines walks link,--target $(target)) \
		--batches $(BATCHES) --out out/fuzz --json out/fuzz.json

# A network of 53 blocks and 36 points: a single line of passing stations, drawn by its seed.
out/networks/%.toml: | setup
	@mkdir -p $(@D)
	$(BIN)/python -c "from models.layouts.generate import as_toml, network; print(as_toml(network(100, seed=$*)), end='')" > $@

# A batch is an hour of a line; the same command goes on where it was ended.
lines: setup $(LINES)
	$(BIN)/heisoku fuzz $(LINES) --target lines --out out/lines --json out/lines.json \
		--batches $$(( ($(HOURS) + $(words $(LINES)) - 1) / $(words $(LINES)) ))

beyond: setup
	@mkdir -p out
	$(BIN)/heisoku ride --rides $(BEYOND) --beyond each --json out/beyond.json

days: setup
	@mkdir -p out
	set -e; for system in $(SYSTEMS); do \
		$(BIN)/heisoku days $$system --days $(DAYS) --keep out/$$system.days --json out/days-$$system.json; done

# A paper's figure that ours does not meet is told in the report and ends nothing here.
papers: setup
	@mkdir -p out
	set -e; for paper in $(PAPERS); do \
		$(BIN)/heisoku reproduce $$paper -o out/$$paper --json out/$$paper.json || test $$? -eq 1; done

certify: setup
	@mkdir -p out
	$(BIN)/heisoku certify --sample $(CERTIFICATES) --json out/certificates.json

certificates: setup
	@mkdir -p out
	$(BIN)/heisoku certify --json out/certificates.json

mutate: setup
	@mkdir -p out
	$(BIN)/heisoku mutate --sample $(MUTANTS) --json out/mutate.json

malformed: setup
	$(BIN)/python -m tests.layouts.malformed --files $(FILES) --keep out/malformed

interruptions: setup
	$(BIN)/python -m tests.interruptions --runs $(RUNS)

mutants: setup
	@mkdir -p out
	$(BIN)/heisoku mutate --json out/mutate.json

joints: setup
	@mkdir -p out
	$(BIN)/heisoku mutate --joints --json out/joints.json

# Which hypotheses, guards and updates each proof uses; the report tells it both ways.
cores: setup
	@mkdir -p out
	$(BIN)/python -m proofs.cores --json out/cores.json

# The report to be filed; it needs Pango (Debian: libpango-1.0-0, libpangoft2-1.0-0, libharfbuzz-subset0).
pdf: setup
	$(BIN)/heisoku report -o out/report.html -o out/report.pdf
	$(BIN)/heisoku manifest out

report: setup
	$(BIN)/heisoku report -o out/report.html
	$(BIN)/heisoku manifest out

# ---- checks on ourselves

test: lint types
	@mkdir -p out
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile -m "not slow" --junit-xml=out/test.xml $(TESTS)

# What takes longer; each has a sample of itself among the tests.
slow: setup
	$(BIN)/python -m pytest -n $(JOBS) -m slow $(TESTS)

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: setup
	$(BIN)/mypy

format: setup
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

# Pages under docs/ that are written from code and data.
pages: setup
	$(BIN)/python -m proofs.pages

bench: setup
	$(BIN)/python -m tests.bench

kept: setup
	$(BIN)/python -m tests.bench_kept_proofs --changes $(CHANGES)

# A second opinion on the lifter: contracts checked on the real bytecode.
crosshair: $(VENV)/.crosshair $(VENV)/.project
	@mkdir -p out
	@$(BIN)/python -m evidence.records.stamping make crosshair > out/crosshair.txt
	$(BIN)/crosshair check --analysis_kind=asserts --report_all --per_condition_timeout=60 $(CONTRACTS) \
		>> out/crosshair.txt || { cat out/crosshair.txt; exit 1; }
	@cat out/crosshair.txt

# ---- set-up, once: a stamp for each step

setup: $(VENV)/.project

$(VENV)/.dependencies: requirements.txt
	@$(PYTHON) -c 'import sys; sys.exit(0 if sys.version_info >= (3, 11) else "heisoku needs Python 3.11 or later, and $(PYTHON) is %d.%d: say which with make PYTHON=python3.11" % sys.version_info[:2])'
	rm -rf $(VENV)
	@$(PYTHON) -m venv $(VENV) || { rm -rf $(VENV); echo "make: $(PYTHON) cannot make a virtual environment; on Debian: apt-get install python3-venv" >&2; exit 2; }
	$(PIP) install --quiet --require-hashes --requirement requirements.txt
	@touch $@

$(VENV)/.project: $(VENV)/.dependencies pyproject.toml
	$(PIP) install --quiet --no-deps --no-index --no-build-isolation --config-settings editable_mode=compat --editable .
	@touch $@

$(VENV)/.crosshair: $(VENV)/.dependencies requirements-crosshair.txt
	$(PIP) install --quiet --require-hashes --requirement requirements-crosshair.txt
	@touch $@

# ---- upkeep

COMPILE = out/lock/bin/uv pip compile --quiet --upgrade --universal --fork-strategy fewest --generate-hashes \
	--python-version 3.11 --no-emit-index-url --custom-compile-command "make lock"

lock:
	@mkdir -p out
	$(PYTHON) -m venv out/lock
	out/lock/bin/python -m pip install --quiet uv
	$(COMPILE) requirements.in --output-file requirements.txt
	$(COMPILE) --constraint requirements.txt requirements-crosshair.in --output-file requirements-crosshair.txt

clean:
	rm -rf out build *.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -not -path './$(VENV)/*' -type d -prune -exec rm -rf {} +

distclean: clean
	rm -rf $(VENV)
