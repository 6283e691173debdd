# The cases of the studies of coating layers: a case's name says what it changes in its scene, part by part.
#   hll llh abs eva   drying strategy                      25um     thickness of the wet layer
#   w4                width, um                            s1       seed of the packing and the noise
#   p25               surface potential, mV (negative)     k5       Debye length, nm
#   m2                viscosity of the liquid, mPa s, with the dewatering of 0.89 mPa s but for darcy
#   t7                surface tension, mN/m
#   b                 with Brownian motion                 darcy    fluxes as written, not scaled to a final solids content
#   limited           surface limited to 500 kPa           thesis   hydrodynamics as printed in the source
#   h80               evaporation while it is high, g/m2/s l8       while it is low
#   a10               permeability of the substrate's cake, 1e-18 m2
#   n3                tolerance of the steps, in thousandths
#   u0.2              the run ends at this time, s         e        in front: the strategy is a table, NAME.csv beside the scene
# One absolute dewatering profile for all thicknesses: what takes 25 um to 88 wt-% in half a second, going on afterwards, so
# that every layer comes to rest by itself.
# From the command line: WIDTH (um), SEEDS (a list) in place of those of SIZE, and VARY, further parts for every case ("h60 l10 u0.3"); all are
# in the names, so results never mix.
SIZE ?= quick
empty :=
space := $(empty) $(empty)
full := $(filter full,$(SIZE))
WIDTH ?= $(if $(full),5,4)
SEEDS ?= 1 2 3
piece := $(subst $(space),-,$(strip w$(WIDTH) $(VARY)))
SCENE ?= ../drying/scene.yaml
upper = $(shell echo '$(1)' | tr a-z A-Z)
setting = $(or \
  $(if $(filter hll llh abs eva,$(1)),--set dewatering.strategy=$(call upper,$(1))),\
  $(if $(filter %um,$(1)),--set layer.thickness="$(1:%um=%) um"),\
  $(if $(filter b darcy,$(1)),),\
  $(if $(filter limited,$(1)),--set free_surface.model=pressure_limited --set free_surface.max="500 kPa"),\
  $(if $(filter thesis,$(1)),--set hydrodynamics.model=thesis),\
  $(if $(filter u%,$(1)),),\
  $(if $(filter h%,$(1)),--set dewatering.evaporation.high="$(1:h%=%) g/m2/s"),\
  $(if $(filter l%,$(1)),--set dewatering.evaporation.low="$(1:l%=%) g/m2/s"),\
  $(if $(filter a%,$(1)),--set dewatering.absorption.permeability="$(1:a%=%)e-18 m2"),\
  $(if $(filter n%,$(1)),--set stepping.tolerance=$(1:n%=%)e-3),\
  $(if $(filter w%,$(1)),--set layer.width="$(1:w%=%) um"),\
  $(if $(filter s%,$(1)),--set seed=$(1:s%=%)),\
  $(if $(filter p%,$(1)),--set particles.0.surface_potential="-$(1:p%=%) mV"),\
  $(if $(filter k%,$(1)),--set colloidal.electrostatic.debye_length="$(1:k%=%) nm"),\
  $(if $(filter m%,$(1)),--set liquid.viscosity="$(1:m%=%) mPa s"),\
  $(if $(filter t%,$(1)),--set free_surface.surface_tension="$(1:t%=%) mN/m"))
parts = $(subst -, ,$(1))
table = $(filter e,$(firstword $(call parts,$(1))))
whole_set = $(if $(call table,$(1)),--set dewatering.file=$(word 2,$(call parts,$(1))).csv) \
  $(foreach t,$(if $(call table,$(1)),$(wordlist 3,99,$(call parts,$(1))),$(call parts,$(1))),$(call setting,$t)) \
  $(if $(filter b,$(call parts,$(1))),,--set brownian=null) \
  $(if $(filter darcy,$(call parts,$(1))),--set dewatering.final_solids=null --set dewatering.reference_thickness=null,--set dewatering.reference_thickness="25 um") \
  $(call same_flux,$(if $(call table,$(1)),,$(filter m%,$(call parts,$(1)))),$(filter darcy,$(call parts,$(1)))) \
  $(if $(filter 10um,$(call parts,$(1))),--set output.every="2 ms") --set stepping.until="$(call until,$(1))"
# Darcy's flux goes with permeability over viscosity, so that a permeability that rises with the viscosity leaves it as it is at 0.89 mPa s.
same_flux = $(if $(1),$(if $(2),,--set dewatering.absorption.permeability="$(shell awk 'BEGIN { printf "%.9f", $(1:m%=%) / 0.89 }')e-18 m2"))
# Every run ends by itself, at rest or where the surface presses on packed particles. At 83 wt-%, when the layer is a network of near
# contacts, it may take several minutes of one core to the one or the other; quick runs end there instead. Those of 10 um, drained in a tenth of the
# time, reach it before they can be at rest. Dear runs end at the last time that a claim asks for: those with Brownian motion, whose
# steps are short at all times, those of the colloidal study, of a large piece, at other rates; the thin ones of several viscosities, which are compared at 75 wt-%; and the uncharged ones, in which every
# pair becomes a contact, at 0.1 s.
until-10um-hll := 0.07
until-10um-llh := 0.18
until-10um-abs := 0.056
until-10um-eva := 0.166
until-hll := 0.34
until-llh := 0.46
until-abs := 0.36
until-eva := 0.42
# One packing goes on to its rest at 85 wt-%, which takes as long as all before.
until-eva-rest := 0.46
# LLH at several double layers and potentials, until half of all particles are clustered at 10 nm as well, at 0.42 s; claims ask for no later time.
until-llh-k := 0.43
# Tables: when as much liquid is lost as under HLL at 0.36 s, 8.64 g/m2 before scaling, so that the ends compare at the same solids.
until-e-hll := 0.36
until-e-lhl := 0.36
until-e-hhl := 0.36
until-e-mmm := 0.393
until-e-hlh := 0.403
until-e-lhh := 0.403
until-e-llh := 0.424
told = $(patsubst u%,%,$(filter u%,$(call parts,$(1))))
strategy_of = $(if $(table),e-$(word 2,$(parts)),$(firstword $(parts)))
quick_end = $(if $(full),,$(or $(if $(filter p0,$(parts)),0.1),$(if $(filter 20um,$(parts)),0.12),$(if $(filter b h80 a10 thesis n3 w8,$(parts))$(and $(filter k%,$(parts)),$(filter hll,$(parts))),0.2),\
  $(if $(filter 10um,$(parts)),$(until-10um-$(strategy_of))),$(and $(filter k%,$(parts)),$(filter llh,$(parts)),$(until-llh-k)),$(and $(filter eva,$(parts)),$(filter s1,$(parts)),$(until-eva-rest)),$(until-$(strategy_of))))
# Full runs end after the last time that a claim asks for where they are dear (every pair becomes a contact, or comes nearer than a nanometre; a
# piece sixteen times as large), or made for comparison there alone (other rates, resistances, tolerance).
full_end = $(if $(filter p0 p5 k1 k0.5 w20 h80 a10 thesis n3,$(parts)),0.205)
until = $(or $(call told,$(1)),$(if $(full),$(full_end),$(call quick_end,$(1))),0.8) s
# $(call layers,CASES): what each changes and lacks. To be called before ../rules.mk is read.
define layer_case
set-$(1) := $(call whole_set,$(1)) $(ANALYSIS)
without-$(1) := $(if $(filter b,$(call parts,$(1))),,kbrown)
endef
layers = $(foreach c,$(1),$(eval $(call layer_case,$c)))
