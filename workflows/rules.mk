# How every file of a study is made: the one place that spells the tools' command lines.
#
# A study is a folder with a scene.yaml and a Makefile that sets the following and includes this file:
#   STUDY         its name
#   CASES         its cases; the results of one stand in $(BUILD)/studies/$(STUDY)/CASE
#   set-CASE      what the case changes in the scene, --set KEY.PATH=VALUE ...; may be absent
#   scene-CASE    its scene where it is not scene.yaml; may be absent
#   without-CASE  files of the chain that its scene has no block for: kbrown, dewatering; may be absent
#   run-CASE      STUDY/CASE whose trajectory it measures, in place of a run of its own; may be absent
#   FILES         what each case gets; absent: packing kbrown dewatering trajectory solids cluster separation mobility;
#                 interactions is the other there is
#   EXTRA, USES   further files of the study (below its results) that its Makefile has rules for, and the tools they need
#                 beyond those of the chain: a rule depends on $(call tool,NAME) and runs $(BIN)/pigment-NAME
#   FIGURES       figures that claims.py draws, figures/NAME.svg
#   REPORT_CASES  cases whose runs the report shows in full; absent: all
# Each case gets scene.yaml (all defaults filled in) and FILE.h5 for each of FILES; the study gets claims.csv and its figures
# where its folder has a claims.py (docs/making-a-study.md), and report.html. From the command line:
#   SIZE=quick|full    for the study's Makefile to read
#   LAUNCH="srun -n1"  stands before every heavy stage, to spread a study over a cluster
#   -j N               runs N stages at once, one thread each
#
# What is rebuilt. A stage depends on its slice of the scene, .made/STAGE.yaml, and on checksums of what it reads and of its
# tool, .made/NAME.sum and ../.tools/TOOL.sum; all of these are replaced only when their bytes change. So an edited comment
# reruns the scene stage and stops there, and a deleted file is remade while what was made from it stays, since the same
# inputs give the same bytes. NAME.seen dates the last look at NAME.
#
# make -n has no side effects and tells what will run: it looks ahead (FORESEEN) at which slices and checksums change. Where
# a new version of a tool may or may not change a result, the stages after that one are not announced.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.SUFFIXES:
.DELETE_ON_ERROR:
.SECONDEXPANSION:
# Whether this is make -n: the first word of MAKEFLAGS holds the one-letter options, if there are any.
DRY := $(findstring n,$(filter-out -%,$(firstword $(MAKEFLAGS))))
MAKEFLAGS += --no-builtin-rules --no-print-directory
.DEFAULT_GOAL := study

SIZE ?= quick
ifeq ($(filter quick full,$(SIZE)),)
  $(error SIZE=$(SIZE): quick or full)
endif
WORKFLOWS := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
BUILD ?= $(abspath $(WORKFLOWS)/../build)
BIN ?= $(BUILD)/bin
SCENE ?= scene.yaml
RESULTS := $(BUILD)/studies/$(STUDY)
SUMS := $(BUILD)/studies/.tools

FILES ?= packing kbrown dewatering trajectory solids cluster separation mobility
ANALYSES := $(filter solids cluster separation mobility,$(FILES))
# The stage that makes a file, which is as well the name of its tool and of its slice of the scene.
stage_of = $(patsubst packing,pack,$(patsubst dewatering,dewater,$(patsubst trajectory,consolidate,$(1))))
SLICES := $(call stage_of,$(FILES))
TOOLS := $(sort scene $(SLICES) $(USES) report)
REPORT_CASES ?= $(CASES)
scene_of = $(or $(scene-$(1)),$(SCENE))

files_of = $(filter-out $(without-$(1)) $(if $(run-$(1)),packing kbrown dewatering),$(FILES))
has = $(filter $(1),$(call files_of,$(2)))
# $(call each,FILE,ENDING): FILE.ENDING of every case that has FILE; $(call made,...): its companion in .made.
each = $(foreach c,$(CASES),$(if $(call has,$(1),$c),$(RESULTS)/$c/$(1).$(2)))
made = $(foreach c,$(CASES),$(if $(call has,$(1),$c),$(RESULTS)/$c/.made/$(1).$(2)))
slices = $(CASES:%=$(RESULTS)/%/.made/$(1).yaml)
tool = $(SUMS)/$(1).sum
# What a heavy stage took stands in .made/STAGE.took (timed.py), for cost_page.py.
timed = $(LAUNCH) /usr/bin/python3 $(WORKFLOWS)/timed.py $(@D)/.made/$(1).took $(BIN)/pigment-$(1)
# For a measured run (measured.py), whose record is the target: what is made again begins anew; what was stopped before it had a record
# goes on from its checkpoint.
anew = if [ -e $@ ]; then rm -f $(@D)/*.h5 $@; fi
threads = $(if $(filter-out -j1,$(filter -j%,$(MAKEFLAGS))), --threads 1)
replace_if_changed = $(WORKFLOWS)/replace_if_changed.sh

# The recipe of a file that another recipe may have replaced: nothing to run, not even under make -n, where an empty recipe
# would count as a change; the + makes it look at the file's time again.
look_again =

.PHONY: study FORCE
study: $(RESULTS)/report.html

# ---- looking ahead, under make -n only; nothing is written
slice = $(BIN)/pigment-scene $(call scene_of,$(1)) $(set-$(1)) --for $(2) --folder $(RESULTS)/$(1)/.made
ifneq ($(DRY),)
  # $(call if_new,COMMAND,FILE): FILE, where it is there and COMMAND would write something else.
  if_new = [ ! -e $(2) ] || $(1) 2> /dev/null | cmp -s - $(2) || echo $(2);
  if_touched = [ ! $(1) -nt $(basename $(2)).seen ] || $(call if_new,sha256sum < $(1),$(2))
  FORESEEN := $(shell $(foreach t,$(TOOLS),$(call if_touched,$(BIN)/pigment-$t,$(call tool,$t)))) \
    $(foreach c,$(CASES),\
      $(if $(wildcard $(BIN)/pigment-scene),$(shell $(foreach s,$(SLICES),$(call if_new,$(call slice,$c,$s),$(RESULTS)/$c/.made/$s.yaml)))) \
      $(shell $(foreach f,$(FILES),$(call if_touched,$(RESULTS)/$c/$f.h5,$(RESULTS)/$c/.made/$f.sum))))
endif
ifneq ($(strip $(FORESEEN)),)
$(FORESEEN): FORCE
	@# $@ changes
endif
as_it_is = $(filter-out $(FORESEEN),$(1))
# What must be looked at although no time says so: its record is gone, or (slices) was made with other settings.
gone = $(if $(wildcard $(1)),,FORCE)

# ---- tools
$(TOOLS:%=$(BIN)/pigment-%) &:
	$(MAKE) -C $(WORKFLOWS)/.. build BUILD='$(BUILD)'

$(TOOLS:%=$(SUMS)/%.seen): $(SUMS)/%.seen: $(BIN)/pigment-% $$(call gone,$$(call tool,$$*))
	@mkdir -p $(@D)
	@$(replace_if_changed) $(call tool,$*) sha256sum < $<
	@touch $@
$(call as_it_is,$(TOOLS:%=$(SUMS)/%.sum)): %.sum: %.seen ; +$(look_again)

# ---- scene: the case's scene with its defaults, and a slice of it for each stage
settings = $(call scene_of,$(1)) $(subst ",,$(subst ',,$(set-$(1))))
differ = $(subst x$(strip $(1)),,x$(strip $(2)))$(subst x$(strip $(2)),,x$(strip $(1)))
other = $(if $(call differ,$(1),$(file < $(2))),FORCE)
# Tables that a scene names; its slices hold their checksums, so that another table's stage is made anew.
tables = $(wildcard $(shell cd $(1) 2> /dev/null && grep -oh 'file: [^,}]*' *.yaml | sort -u | while read -r _ name; do realpath -m "$$name"; done))
$(CASES:%=$(RESULTS)/%/.made/scene.seen): $(RESULTS)/%/.made/scene.seen: $$(call scene_of,$$*) $(call tool,scene) $$(call tables,$$(@D)) \
    $$(call other,$$(call settings,$$*),$$(@D)/settings) $$(foreach s,$$(SLICES),$$(call gone,$$(@D)/$$s.yaml))
	@mkdir -p $(@D)
	$(replace_if_changed) $(RESULTS)/$*/scene.yaml $(BIN)/pigment-scene $(call scene_of,$*) $(set-$*)
	@for stage in $(SLICES); do $(replace_if_changed) $(@D)/$$stage.yaml $(call slice,$*,$$stage); done
	@echo '$(call settings,$*)' > $(@D)/settings
	@touch $@
$(CASES:%=$(RESULTS)/%/scene.yaml): %/scene.yaml: %/.made/scene.seen ; +$(look_again)
$(call as_it_is,$(foreach s,$(SLICES),$(call slices,$s))): %.yaml: $$(@D)/scene.seen ; +$(look_again)

# ---- the chain
$(call each,packing,h5): $(RESULTS)/%/packing.h5: $(RESULTS)/%/.made/pack.yaml $(call tool,pack)
	$(call timed,pack) $< -o $@$(threads)

$(call each,kbrown,h5): $(RESULTS)/%/kbrown.h5: $(RESULTS)/%/.made/kbrown.yaml $(call tool,kbrown)
	$(call timed,kbrown) $< -o $@$(threads)

$(call each,dewatering,h5): $(RESULTS)/%/dewatering.h5: $(RESULTS)/%/.made/dewater.yaml $(call tool,dewater)
	$(BIN)/pigment-dewater $< -o $@

# packing.h5 always; the other two where the case has them.
starts = $(if $(run-$(1)),,packing $(filter kbrown dewatering,$(call files_of,$(1))))
taken := $(foreach c,$(CASES),$(if $(run-$c),$(RESULTS)/$c/trajectory.h5))
$(filter-out $(taken),$(call each,trajectory,h5)): $(RESULTS)/%/trajectory.h5: $(RESULTS)/%/.made/consolidate.yaml $(call tool,consolidate) \
    $$(foreach f,$$(call starts,$$*),$$(@D)/.made/$$f.sum)
	$(call timed,consolidate) $< $(foreach f,$(call starts,$*),--$f $(@D)/$f.h5) -o $@$(threads)

# A run of another case, or of another study, which is made first (the Makefile at the top does so).
run_of = $(BUILD)/studies/$(run-$(1))/trajectory.h5
$(taken): $(RESULTS)/%/trajectory.h5: $$(call run_of,$$*)
	@mkdir -p $(@D)
	ln -sfn ../../$(run-$*)/trajectory.h5 $@
$(filter-out $(RESULTS)/%,$(sort $(foreach c,$(CASES),$(if $(run-$c),$(call run_of,$c))))):
	@echo '$@ is not there: make study-$(firstword $(subst /, ,$(@:$(BUILD)/studies/%=%))) first' >&2; exit 1

$(call each,interactions,h5): $(RESULTS)/%/interactions.h5: $(RESULTS)/%/.made/interactions.yaml $(call tool,interactions)
	$(BIN)/pigment-interactions $< -o $@

define analysis
$(call each,$(1),h5): $(RESULTS)/%/$(1).h5: $(RESULTS)/%/.made/$(1).yaml $(RESULTS)/%/.made/trajectory.sum $(call tool,$(1))
	$$(call timed,$(1)) $$(@D)/trajectory.h5 --scene $$< -o $$@
endef
$(foreach a,$(ANALYSES),$(eval $(call analysis,$a)))

# ---- claims, figures, report: made anew as well when the cases or SIZE change, which no file's time says
sums_of_results := $(foreach f,$(FILES),$(call made,$f,sum))
ifneq ($(wildcard claims.py),)
JUDGED := $(RESULTS)/claims.csv $(FIGURES:%=$(RESULTS)/figures/%.svg)
# claims.py puts all of them in place at its end, or none: where it fails, what stood stays.
.PRECIOUS: $(JUDGED)
judged_with := $(SIZE) $(CASES) / $(FIGURES)
$(JUDGED) &: $(wildcard *.py) $(WORKFLOWS)/study.py $(WORKFLOWS)/layer.py $(WORKFLOWS)/run_errors.py $(sums_of_results) $(EXTRA:%=$(RESULTS)/%) \
    $(call other,$(judged_with),$(RESULTS)/.made/claims.settings)
	@mkdir -p $(RESULTS)/.made
	PYTHONPATH='$(WORKFLOWS)' PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 $(WORKFLOWS)/timed.py $(RESULTS)/.made/claims.took /usr/bin/python3 claims.py --results '$(RESULTS)' --size $(SIZE) --cases '$(CASES)' --figures '$(FIGURES)'
	@echo '$(judged_with)' > $(RESULTS)/.made/claims.settings
endif

files_shown = $(foreach c,$(REPORT_CASES),$(addprefix $(RESULTS)/$c/,$(addsuffix .h5,$(filter-out interactions,$(call files_of,$c)))))
$(RESULTS)/report.html: $(sums_of_results) $(JUDGED) $(call tool,report) $(call other,$(files_shown),$(RESULTS)/.made/report.settings)
	@mkdir -p $(RESULTS)/.made
	/usr/bin/python3 $(WORKFLOWS)/timed.py $(RESULTS)/.made/report.took $(BIN)/pigment-report $(files_shown) $(addprefix --claims ,$(filter %.csv,$(JUDGED))) $(addprefix --figure ,$(filter %.svg,$(JUDGED))) --title 'Study: $(STUDY)' -o $@$(threads)
	@echo '$(files_shown)' > $(RESULTS)/.made/report.settings

# ---- checksums of results
from-packing := pack.yaml
from-kbrown := kbrown.yaml
from-dewatering := dewater.yaml
from-interactions := interactions.yaml
from-trajectory = $(if $(run-$(1)),,consolidate.yaml) $(addsuffix .sum,$(call starts,$(1)))
$(foreach a,$(ANALYSES),$(eval from-$a := $a.yaml trajectory.sum))
define checksums
ifeq ($(DRY),)
$(call made,$(1),seen): $(RESULTS)/%/.made/$(1).seen: $(RESULTS)/%/$(1).h5 $$$$(call gone,$$$$(@D)/$(1).sum)
	@mkdir -p $$(@D)
	@$(replace_if_changed) $$(@D)/$(1).sum sha256sum < $$<
	@touch $$@
$(call made,$(1),sum): %.sum: %.seen ; +$(look_again)
else
# A result whose slice or inputs change will change; one that is only remade will not.
$(call as_it_is,$(call made,$(1),sum)): $(RESULTS)/%/.made/$(1).sum: $$$$(addprefix $(RESULTS)/$$$$*/.made/,$$$$(call from-$(1),$$$$*)) | $(RESULTS)/%/$(1).h5
	@# what is made from $$(notdir $$*)/$(1).h5 follows
endif
endef
$(foreach f,$(FILES),$(eval $(call checksums,$f)))
