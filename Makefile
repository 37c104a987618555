comma   := ,
CC      ?= cc
OPT     ?= -O3
BUILD   := build/$(if $(SAN),$(subst $(comma),-,$(SAN)),plain)
WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wno-psabi -Werror
CF       = -std=c11 -D_POSIX_C_SOURCE=200809L $(WARN) $(OPT) -g -ffp-contract=off -pthread -Isrc -I. \
           $(if $(SAN),-fsanitize=$(SAN) -fno-sanitize-recover=all) $(CFLAGS)
# Libraries that are used where they are installed: fonts and JPEG images of POV-Ray scenes, mesh formats.
FOUND   := $(foreach p,freetype2 libjpeg assimp,$(shell pkg-config --exists $p 2>/dev/null && echo $p))
LIBS    := $(if $(filter assimp,$(FOUND)),-lassimp) -lyaml -lpng -lz -lm \
           $(foreach p,$(filter-out assimp,$(FOUND)),$(shell pkg-config --libs $p))
FLOORS  := base geom scene spd io accel cost trace batch report cli
PACKAGES := gcc make git libc6-dev libyaml-dev zlib1g-dev libpng-dev libcmocka-dev gnuplot-nox pkg-config libfreetype-dev \
            libjpeg-dev libassimp-dev
VERSION := $(shell git describe --always --dirty --tags 2>/dev/null || echo unknown)

# Compiled a second time for processors with AVX2, chosen when the program runs.
WIDE    := $(if $(filter x86_64,$(shell uname -m)),$(BUILD)/src/accel/octree_crowd.avx2.o)
OBJ     := $(patsubst %.c,$(BUILD)/%.o,$(wildcard src/*/*.c spd/*.c)) $(WIDE)
TESTS   := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/test_*.c))

# What SIZE holds reaches the sweep as data: not expanded by make, not read by the shell.
override SIZE := $(value SIZE)
export SIZE

all: $(BUILD)/raycost ## build the program

deps: ## install what is missing (Debian: apt)
	@command -v dpkg-query apt-get >/dev/null || { echo "deps: no apt here; needed are: $(PACKAGES)" >&2; exit 1; }; \
	missing=; for p in $(PACKAGES); do \
		dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
	[ -z "$$missing" ] && exit 0; \
	root=; [ "$$(id -u)" = 0 ] || root=sudo; \
	$$root apt-get update -q && $$root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $$missing

test: $(TESTS) $(BUILD)/raycost layers ## run every test; SAN=address,undefined or SAN=thread runs them sanitized
	@set -e; for t in $(TESTS); do ./$$t; done
	@RAYCOST=$(BUILD)/raycost sh tests/cli.sh

layers: ## prove that every folder includes only its own floor and those below
	@sh tests/layers.sh $(FLOORS)

sweep: all ## predicted and actual cost of every octree variant; SIZE=1,2,3 chooses the scenes' sizes
	@$(BUILD)/raycost run jobs/sweep.yaml $${SIZE:+--set "size=$$SIZE"}

paper: all ## the experiments of "Cost prediction for ray shooting", with a report
	@$(BUILD)/raycost run jobs/aronov2002.yaml

hierarchies: all ## the experiments of "A cost model for ray tracing hierarchies", with a report
	@$(BUILD)/raycost run jobs/subramanian1990.yaml

smits: all ## the experiments of "Efficiency issues for ray tracing", with a report
	@$(BUILD)/raycost run jobs/smits1999.yaml

bench: $(BUILD)/tests/bench $(BUILD)/tests/bench_bvh ## time building and shooting, beside Embree where libembree-dev is installed
	@./$(BUILD)/tests/bench
	@./$(BUILD)/tests/bench_bvh

check-pov: $(BUILD)/tests/check_pov ## hold POV-Ray's example scenes against POV-Ray (needs povray, povray-examples, povray-includes)
	@sh tests/check_pov.sh ./$(BUILD)/tests/check_pov

golden: export UPDATE_GOLDEN = 1
golden: test ## rewrite tests/golden/, then read 'git diff'

clean: ## remove what was built (not out/)
	rm -rf build

help: ## this list
	@sed -n 's/^\([a-z]*\):[^#]*## \(.*\)/\1|\2/p' Makefile | awk -F '|' '{ printf "make %-12s%s\n", $$1, $$2 }'

$(BUILD)/raycost: $(BUILD)/src/main.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS)

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS) -lcmocka

EMBREE := $(if $(wildcard /usr/include/embree3/rtcore.h),yes)
$(BUILD)/tests/bench $(BUILD)/tests/bench_bvh: %: %.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS) $(if $(EMBREE),-lembree3)
$(BUILD)/tests/bench.o $(BUILD)/tests/bench_bvh.o: CFLAGS += $(if $(EMBREE),-DHAVE_EMBREE)

$(BUILD)/tests/check_pov: $(BUILD)/tests/check_pov.o $(OBJ)
	$(CC) $(CF) -D_DEFAULT_SOURCE $^ -o $@ $(LIBS)
$(BUILD)/tests/check_pov.o: CFLAGS += -D_DEFAULT_SOURCE

$(BUILD)/%.avx2.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CF) -mavx2 -MMD -MP -c $< -o $@

$(BUILD)/src/io/mesh_import.o: CFLAGS += $(if $(filter assimp,$(FOUND)),-DHAVE_ASSIMP)

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CF) -MMD -MP -c $< -o $@

ifneq ($(filter freetype2,$(FOUND)),)
$(BUILD)/src/io/pov_font.o: CFLAGS += -DHAVE_FREETYPE $(shell pkg-config --cflags freetype2)
endif
ifneq ($(filter libjpeg,$(FOUND)),)
$(BUILD)/src/io/pov_picture.o: CFLAGS += -DHAVE_JPEG $(shell pkg-config --cflags libjpeg)
endif

# The version is looked up at every build, but main is compiled anew only when it changed.
$(BUILD)/src/main.o: CFLAGS += -DVERSION='"$(VERSION)"'
$(BUILD)/src/main.o: $(BUILD)/version
$(BUILD)/version: .FORCE
	@mkdir -p $(@D); echo '$(VERSION)' | cmp -s - $@ || echo '$(VERSION)' > $@

-include $(OBJ:.o=.d) $(TESTS:=.d) $(BUILD)/src/main.d $(BUILD)/tests/bench.d $(BUILD)/tests/bench_bvh.d

.PHONY: all deps test layers sweep paper hierarchies smits bench check-pov golden clean help .FORCE
.SECONDARY:
.DELETE_ON_ERROR:
