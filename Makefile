# pigment: build it, test it, run its studies. `make help` says what there is.
SHELL := /bin/bash
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
.DEFAULT_GOAL := all

BUILD ?= build
PREFIX ?= /usr/local
TOP := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
# make -j N bounds the compilation and the tests too; without -j they take every core.
JOBS = $(or $(patsubst -j%,%,$(filter -j%,$(MAKEFLAGS))),$(shell nproc))
STUDIES := $(patsubst workflows/%/Makefile,%,$(wildcard workflows/*/Makefile))

.PHONY: all build test bench bench-peers speed hindered-drag brownian brownian-cost accuracy studies studies-page claims cost install clean format page-libraries deb help dependencies configure FORCE

all: study-first
	@echo "The report of the first study: $(BUILD)/studies/first/report.html"

help:
	@echo 'make                 install what is missing, build, run one layer (workflows/first)'
	@echo 'make build           install what is missing, build the tools into $(BUILD)/bin'
	@echo 'make test            build, run all tests'
	@echo 'make bench           build, run the benchmarks'
	@echo 'make bench-peers     one solve beside LAMMPS (package lammps) on the same positions'
	@echo 'make speed           study-accuracy and the time of the measuring tools, write docs/speed.md'
	@echo 'make study-NAME      run one study; SIZE=quick or SIZE=full, -j N, LAUNCH="srun -n1"'
	@echo '                     studies: $(STUDIES)'
	@echo 'make studies         run all of them; one report of their claims and figures: $(BUILD)/studies/report.html'
	@echo 'make studies-page    the same report from the studies that have been run so far'
	@echo 'make claims          write docs/claims.md from the studies that have been run'
	@echo 'make figures-NAME    write docs/studies/NAME.md, the figures of that study as it was run last'
	@echo 'make cost            write docs/cost.md, what their runs took'
	@echo 'make $(BUILD)/studies/STUDY/CASE/FILE.h5   run one up to this file'
	@echo 'make hindered-drag   measure what hindered drag changes in a draining layer, write docs/hindered-drag.md'
	@echo 'make brownian        errors of Brownian motion against the step (study-brownian), write docs/brownian.md'
	@echo 'make brownian-cost   what long runs with the full noise cost, into $(BUILD)/brownian-cost.md; PART=0.02 measures a part, ROWS="thousand long-coarse" some'
	@echo 'make accuracy        measure errors and cost of the resistance models, write docs/accuracy.md'
	@echo 'make install         into $$DESTDIR$$PREFIX (PREFIX=$(PREFIX)); run as the user who built'
	@echo 'make deb             a Debian package of the same, in $(BUILD)'
	@echo 'make format          clang-format over lib, tools and tests'
	@echo 'make page-libraries  rebuild the JavaScript libraries inside the report from npm'
	@echo 'make clean           remove $(BUILD), results of studies included'

# ---- build
dependencies:
	@cmake/install-dependencies.sh

# Configures where it has not been done; then the build does so by itself when a CMake file changes. Continuous
# integration (CI set) turns warnings into errors.
CONFIGURE = cmake -S . -B $(BUILD) $(if $(CI),-DPIGMENT_WERROR=ON) $(if $(wildcard $(BUILD)/CMakeCache.txt),,-G Ninja)
configure: dependencies
	$(if $(CI)$(if $(wildcard $(BUILD)/build.ninja $(BUILD)/Makefile),,new),$(CONFIGURE))

build: configure
	cmake --build $(BUILD) --parallel $(JOBS)

test: configure
	cmake --build $(BUILD) --parallel $(JOBS) --target all tests
	ctest --test-dir $(BUILD) --output-on-failure --parallel $(JOBS)

bench: configure
	cmake --build $(BUILD) --parallel $(JOBS) --target all benchmarks
	cd $(BUILD)/bench && for program in ./bench_*; do "$$program" || exit 1; done

# One solve beside LAMMPS's on the same positions.
bench-peers: configure
	cmake --build $(BUILD) --parallel $(JOBS) --target all bench_peers
	workflows/peers/compare.sh '$(abspath $(BUILD))/bin' '$(abspath $(BUILD))/bench' '$(BUILD)/peers'

# Wall time against error (study-accuracy), of the measuring tools and, where study-layer-speed has been run, of whole layers, as docs/speed.md. Nothing else should run beside it.
speed: study-accuracy
	workflows/replace_if_changed.sh $(BUILD)/studies/accuracy/analyses.md workflows/accuracy/analyses.sh '$(abspath $(BUILD))/bin' '$(BUILD)/studies/accuracy/analyses'
	workflows/replace_if_changed.sh docs/speed.md /usr/bin/python3 workflows/accuracy/speed_page.py '$(BUILD)/studies/accuracy' '$(BUILD)/studies/layer-speed'

# What hindered drag changes in a draining layer, as docs/hindered-drag.md.
hindered-drag: build
	workflows/replace_if_changed.sh docs/hindered-drag.md workflows/hindered-drag/measure.sh '$(abspath $(BUILD))/bin' '$(BUILD)/hindered-drag'

# Errors of Brownian motion against the step, as docs/brownian.md.
brownian: study-brownian
	workflows/replace_if_changed.sh docs/brownian.md /usr/bin/python3 workflows/brownian/page.py '$(BUILD)/studies/brownian' '$(BUILD)/brownian-cost.md'

# Wall time of long runs with the full noise. Nothing else should run beside it.
PART ?= 1
ROWS ?= all
brownian-cost: build
	workflows/brownian/cost.sh '$(abspath $(BUILD))/bin' '$(BUILD)/brownian-cost' '$(PART)' '$(ROWS)' | tee '$(BUILD)/brownian-cost.md'

# Errors of the resistance models (study-hydrodynamics) and what a pair costs, as docs/accuracy.md. Nothing else should run beside it.
accuracy: study-hydrodynamics
	cmake --build $(BUILD) --parallel $(JOBS) --target bench_resistance
	cd $(BUILD)/bench && ./bench_resistance --benchmark_repetitions=10 --benchmark_out=resistance.json --benchmark_out_format=json
	workflows/replace_if_changed.sh docs/accuracy.md /usr/bin/python3 workflows/hydrodynamics/accuracy_page.py '$(BUILD)/studies/hydrodynamics' '$(BUILD)/bench/resistance.json'

install: build
	DESTDIR='$(DESTDIR)' cmake --install $(BUILD) --prefix '$(PREFIX)'

# A Debian package of what install puts in place: $(BUILD)/pigment_VERSION_ARCHITECTURE.deb
deb: build
	cd $(BUILD) && cpack -G DEB

# ---- studies
# Results live in $(BUILD)/studies/STUDY/CASE; workflows/rules.mk says how each file is made.
STUDY_OPTIONS = --no-print-directory -C workflows/$(1) BUILD='$(abspath $(BUILD))'

# One page of what all studies found.
studies: $(STUDIES:%=study-%)
	@$(MAKE) --no-print-directory studies-page BUILD='$(BUILD)'

# The same page from the studies that have been run so far, the others named in its title. One that was stopped halfway counts as not run.
JUDGED := $(patsubst workflows/%/claims.py,%,$(wildcard workflows/*/claims.py))
studies-page: build
	@shopt -s nullglob; found=(); missing=(); \
	for study in $(JUDGED); do folder=$(BUILD)/studies/$$study; \
	  if [ ! -e $$folder/claims.csv ]; then missing+=($$study); continue; fi; \
	  found+=(--claims $$folder/claims.csv); for figure in $$folder/figures/*.svg; do found+=(--figure $$figure); done; done; \
	if [ $${#found[@]} = 0 ]; then echo 'no study has been run: make study-NAME first' >&2; exit 1; fi; \
	title=Studies; if [ $${#missing[@]} != 0 ]; then list="$${missing[*]}"; title="Studies (not run: $${list// /, })"; fi; \
	set -x; $(BUILD)/bin/pigment-report "$${found[@]}" --title "$$title" -o $(BUILD)/studies/report.html
	@echo 'The report of all studies: $(BUILD)/studies/report.html'

claims:
	workflows/replace_if_changed.sh docs/claims.md /usr/bin/python3 workflows/claims_page.py '$(BUILD)/studies' $(JUDGED)

# docs/studies/NAME.md: the verdicts and figures of a study's last run.
figures-%:
	/usr/bin/python3 workflows/figures_page.py '$(BUILD)/studies' $* docs

# What the runs took beside what pigment-scene forecast, as docs/cost.md. Nothing else should have run beside them.
cost:
	workflows/replace_if_changed.sh docs/cost.md /usr/bin/python3 workflows/cost_page.py '$(BUILD)/studies' $(STUDIES)

.PHONY: $(STUDIES:%=study-%)
$(STUDIES:%=study-%): study-%: build
	$(MAKE) $(call STUDY_OPTIONS,$*)
# Studies that measure the runs of another.
study-mobility study-clustering: study-drying
study-clustering: study-colloidal
files-of-mobility files-of-clustering: study-drying
files-of-clustering: study-colloidal

# Files of a study as goals: one call for all that belong to it, so that -j never runs a stage twice.
WANTED := $(patsubst $(TOP)/%,%,$(filter $(BUILD)/studies/% $(abspath $(BUILD))/studies/%,$(MAKECMDGOALS)))
study_of = $(word 2,$(subst /, ,$(patsubst $(BUILD)/%,%,$(1))))
define study_files
.PHONY: files-of-$(1)
files-of-$(1): build
	$$(MAKE) $$(call STUDY_OPTIONS,$(1)) $(abspath $(foreach f,$(WANTED),$(if $(filter $(1),$(call study_of,$f)),$f)))
endef
$(foreach s,$(sort $(foreach f,$(WANTED),$(call study_of,$f))),$(eval $(call study_files,$s)))
$(foreach f,$(filter $(BUILD)/studies/% $(abspath $(BUILD))/studies/%,$(MAKECMDGOALS)),\
  $(eval $f: files-of-$(call study_of,$(patsubst $(TOP)/%,%,$f)) FORCE ; @:))

# ---- the source tree
format:
	@command -v clang-format > /dev/null || { echo 'make format needs clang-format: apt install clang-format' >&2; exit 1; }
	clang-format -i $$(git ls-files 'lib/*.h' 'lib/*.cpp' 'tools/*.cpp' 'tests/*.h' 'tests/*.cpp')

# The outside JavaScript that the report's page carries (THIRD-PARTY.md); needs Node.js, npm and a network.
page-libraries:
	cd lib/report/page && npm ci --no-audit --no-fund && npm run build

clean:
	rm -rf $(BUILD)
