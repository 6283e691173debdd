# The cases of the studies of coating layers: a case's name says what it changes in its scene, part by part.
#   hll llh abs eva   drying strategy                      25um     thickness of the wet layer
#   w4                width, um                            s1       seed of the packing and the noise
#   p25               surface potential, mV (negative)     k5       Debye length, nm
#   m2                viscosity of the liquid, mPa s       t7       surface tension, mN/m
#   b                 with Brownian motion                 darcy    fluxes as written, not scaled to a final solids content
#   limited           surface limited to 500 kPa           hard     evaporation twice as high while it is high
#   open              a substrate ten times as permeable   e        in front: the strategy is a table, NAME.csv beside the scene
# One absolute dewatering profile for all thicknesses: what takes 25 um to 88 wt-% in half a second, going on afterwards, so
# that every layer comes to rest by itself.
# From the command line: WIDTH (um), SEEDS (a list) in place of those of SIZE; both are in the names, so results never mix.
SIZE ?= quick
full := $(filter full,$(SIZE))
WIDTH ?= $(if $(full),5,4)
SEEDS ?= 1 2 3
SCENE ?= ../drying/scene.yaml
upper = $(shell echo '$(1)' | tr a-z A-Z)
setting = $(or \
  $(if $(filter hll llh abs eva,$(1)),--set dewatering.strategy=$(call upper,$(1))),\
  $(if $(filter %um,$(1)),--set layer.thickness="$(1:%um=%) um"),\
  $(if $(filter b darcy,$(1)),),\
  $(if $(filter limited,$(1)),--set free_surface.model=pressure_limited --set free_surface.max="500 kPa"),\
  $(if $(filter hard,$(1)),--set dewatering.evaporation.high="80 g/m2/s"),\
  $(if $(filter open,$(1)),--set dewatering.absorption.permeability="1e-17 m2"),\
  $(if $(filter w%,$(1)),--set layer.width="$(1:w%=%) um"),\
  $(if $(filter s%,$(1)),--set seed=$(1:s%=%)),\
  $(if $(filter p%,$(1)),--set particles.0.surface_potential="-$(1:p%=%) mV"),\
  $(if $(filter k%,$(1)),--set colloidal.electrostatic.debye_length="$(1:k%=%) nm"),\
  $(if $(filter m%,$(1)),--set liquid.viscosity="$(1:m%=%) mPa s"),\
  $(if $(filter t%,$(1)),--set free_surface.surface_tension="$(1:t%=%) mN/m"))
parts = $(subst -, ,$(1))
table = $(filter e,$(firstword $(call parts,$(1))))
whole_set = $(if $(call table,$(1)),--set dewatering.file=$(word 2,$(call parts,$(1))).csv) \
  $(foreach t,$(if $(call table,$(1)),$(wordlist 3,9,$(call parts,$(1))),$(call parts,$(1))),$(call setting,$t)) \
  $(if $(filter b,$(call parts,$(1))),,--set brownian=null) \
  $(if $(filter darcy,$(call parts,$(1))),--set dewatering.final_solids=null --set dewatering.reference_thickness=null,--set dewatering.reference_thickness="25 um") \
  $(if $(filter 10um,$(call parts,$(1))),--set output.every="2 ms") --set stepping.until="$(call until,$(1))"
# At the rates of the thick layers one of 10 um is drained in a tenth of their time. Its runs end at about 81 wt-%: they come to no
# rest, since one that is drained so fast jams at 83 wt-% before its particles have stopped moving against each other.
until-hll := 0.064 s
until-llh := 0.154 s
until-abs := 0.044 s
until-eva := 0.148 s
# Likewise 20 um after 0.2 s, and after 0.12 s where the fluxes are not scaled down. Without Brownian motion the last hundredths of a second
# of a layer that jams take most of the time of a run, so quick runs end before.
until = $(if $(filter 10um,$(call parts,$(1))),$(until-$(firstword $(call parts,$(1)))),$(if $(filter darcy,$(call parts,$(1))),0.12 s,$(if \
  $(and $(filter 20um,$(call parts,$(1))),$(filter-out b,$(lastword $(call parts,$(1))))),0.2 s,$(UNTIL))))
UNTIL ?= $(if $(full),0.8 s,0.36 s)
# $(call layers,CASES): what each changes and lacks. To be called before ../rules.mk is read.
define layer_case
set-$(1) := $(call whole_set,$(1)) $(ANALYSIS)
without-$(1) := $(if $(filter b,$(call parts,$(1))),,kbrown)
endef
layers = $(foreach c,$(1),$(eval $(call layer_case,$c)))
