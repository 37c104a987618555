comma   := ,
CC      ?= cc
OPT     ?= -O3
BUILD   := build/$(if $(SAN),$(subst $(comma),-,$(SAN)),plain)
WARN    := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wno-psabi -Werror
CF       = -std=c11 -D_POSIX_C_SOURCE=200809L $(WARN) $(OPT) -g -ffp-contract=off -pthread -Isrc -I. \
           $(if $(SAN),-fsanitize=$(SAN) -fno-sanitize-recover=all) $(SIMD) $(CFLAGS)
# Libraries that are used where they are installed: fonts and JPEG images of POV-Ray scenes; mesh formats, loaded by those who need them.
FOUND   := $(foreach p,freetype2 libjpeg,$(shell pkg-config --exists $p 2>/dev/null && echo $p))
ASSIMP  := $(shell pkg-config --exists assimp 2>/dev/null && basename "$$(realpath "$$($(CC) -print-file-name=libassimp.so)")")
LIBS    := -lyaml -lpng -lz -lm -ldl $(foreach p,$(FOUND),$(shell pkg-config --libs $p))
FLOORS  := base geom scene spd io accel cost trace batch report cli
PACKAGES := gcc make git libc6-dev libyaml-dev zlib1g-dev libpng-dev libcmocka-dev gnuplot-nox pkg-config libfreetype-dev \
            libjpeg-dev libassimp-dev
VERSION := $(shell git describe --always --dirty --tags 2>/dev/null || echo unknown)

# Files for wider registers than every processor has; one is compiled two times more. Which are used is decided when the program runs.
ifeq ($(shell uname -m),x86_64)
WIDE    := $(BUILD)/src/accel/octree_crowd.avx2.o $(BUILD)/src/accel/octree_crowd.avx512.o
AVX512  := -mavx2 -mfma -mbmi -mlzcnt -mavx512f -mavx512vl -mavx512dq
%.avx2.o: SIMD := -mavx2
%.avx512.o: SIMD := $(AVX512)
%/bvh8_avx2.o: SIMD := -mavx2 -mfma -mbmi -mlzcnt
%/bvh8_avx512.o: SIMD := $(AVX512)
endif
OBJ     := $(patsubst %.c,$(BUILD)/%.o,$(wildcard src/*/*.c spd/*.c)) $(WIDE)
TESTS   := $(patsubst %.c,$(BUILD)/%,$(wildcard tests/test_*.c))
FUZZ    := $(patsubst tests/fuzz/fuzz_%.c,%,$(wildcard tests/fuzz/fuzz_*.c))
# A race needs threads: tests that start none, and readers, are not hunted for any.
SEQUENTIAL := aff flux formats geom interior mesh nff octree order partitions pov_% scene spd spd_pov
ifeq ($(SAN),thread)
TESTS   := $(filter-out $(SEQUENTIAL:%=$(BUILD)/tests/test_%),$(TESTS))
FUZZ    :=
endif

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

tests: $(TESTS) $(FUZZ:%=$(BUILD)/tests/fuzz/replay_%) $(BUILD)/raycost ## build the program and every test

test: layers $(TESTS:=.run) $(FUZZ:=.run) $(BUILD)/raycost ## run every test; SAN=address,undefined or SAN=thread runs them sanitized
	@RAYCOST=$(BUILD)/raycost sh tests/cli.sh
	@$(if $(SAN),,RAYCOST=$(BUILD)/raycost sh tests/shards.sh)

$(TESTS:=.run): %.run: %
	@./$<

$(FUZZ:=.run): %.run: $(BUILD)/tests/fuzz/replay_%
	@printf 'fuzz, %s: ' $*; $< tests/fuzz/$* tests/crashers/$* 2>$(BUILD)/replay_$*.log || { cat $(BUILD)/replay_$*.log; exit 1; }

faults: $(BUILD)/raycost $(BUILD)/shim.so ## what the world does to a run; KILLS=300 kills it more often
	@RAYCOST=$(BUILD)/raycost SHIM=$(BUILD)/shim.so bash tests/faults.sh

test-slurm: all ## shards through make, GNU parallel and a Slurm of its own on this machine
	@RAYCOST=$(BUILD)/raycost bash tests/slurm.sh

coverage: ## lines that the tests run, in percent
	@$(MAKE) -s BUILD=build/coverage OPT=-O1 CFLAGS=--coverage test faults >build/coverage.log 2>&1 || { tail -20 build/coverage.log; exit 1; }
	@cd build/coverage && gcov -n $$(find src spd -name '*.gcda') 2>/dev/null | awk -F '[:% ]+' \
		'/^File/ { own = /src.*[.]c|spd.*[.]c/ } /^Lines/ && own { lines += $$5; run += $$5 * $$3 / 100; own = 0 } END { printf "%.1f %% of %d lines\n", 100 * run / lines, lines }'

SECONDS ?= 60
fuzz: $(FUZZ:%=build/fuzz/fuzz_%) ## fuzz every reader for SECONDS=60 in all, or RUNS of SEED, under ASan and UBSan (clang with libFuzzer)
	@set -e; for f in $(FUZZ); do mkdir -p build/fuzz/corpus/$$f tests/crashers/$$f; echo "fuzz, $$f:"; \
		build/fuzz/fuzz_$$f -max_total_time=$$(($(SECONDS) / $(words $(FUZZ)) + 1)) $(if $(SEED),-seed=$(SEED)) $(if $(RUNS),-runs=$(RUNS)) -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 \
			$$(ls tests/fuzz/$$f.dict 2>/dev/null | sed s/^/-dict=/) -artifact_prefix=tests/crashers/$$f/ build/fuzz/corpus/$$f tests/fuzz/$$f \
			>build/fuzz/$$f.log 2>&1 || { tail -40 build/fuzz/$$f.log; exit 1; }; \
		grep -E 'number_of_executed_units|new_units_added|peak_rss' build/fuzz/$$f.log; done; rmdir tests/crashers/* 2>/dev/null || true

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

interiors: all ## the experiments of "A cost metric for scene-interior ray origins", with a report
	@$(BUILD)/raycost run jobs/fabianowski2009.yaml

bench: $(BUILD)/tests/bench $(BUILD)/tests/bench_bvh $(BUILD)/tests/bench_pov ## time building and shooting beside Embree, reading beside POV-Ray, where these are installed
	@./$(BUILD)/tests/bench
	@./$(BUILD)/tests/bench_bvh
	@./$(BUILD)/tests/bench_pov $(wildcard jobs/scenes/*.pov $(EXAMPLES:%=/usr/share/doc/povray/examples/%.pov))

# Examples of POV-Ray that bench reads: long programs, large CSG, functions, and those that ask trace() most.
EXAMPLES := advanced/abyss advanced/balcony/balcony advanced/benchmark/benchmark advanced/chess2 advanced/isocacti advanced/teapot/teapot3 \
            advanced/woodbox bsp/Tango incdemo/shapes language/tracevines

check-pov: $(BUILD)/tests/check_pov ## hold POV-Ray's example scenes against POV-Ray (needs povray, povray-examples, povray-includes)
	@sh tests/check_pov.sh ./$(BUILD)/tests/check_pov $(SCENES) $(LEAST)

golden: export UPDATE_GOLDEN = 1
golden: test ## rewrite tests/golden/, then read 'git diff'

clean: ## remove what was built (not out/)
	rm -rf build

help: ## this list
	@sed -n 's/^\([a-z-]*\):[^#]*## \(.*\)/\1|\2/p' Makefile | awk -F '|' '{ printf "make %-12s%s\n", $$1, $$2 }'

$(BUILD)/raycost: $(BUILD)/src/main.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS)

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS) -lcmocka

$(BUILD)/tests/fuzz/replay_%: $(BUILD)/tests/fuzz/fuzz_%.o $(BUILD)/tests/fuzz/fuzz.o $(BUILD)/tests/fuzz/replay.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS)

FUZZ_FLAGS = -std=c11 -Wno-psabi -D_POSIX_C_SOURCE=200809L -O2 -g -ffp-contract=off -pthread -Isrc -I. \
              -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all $(SIMD)
build/fuzz/%.o: %.c
	@mkdir -p $(@D)
	clang $(FUZZ_FLAGS) -MMD -MP -c $< -o $@
build/fuzz/%.avx2.o: %.c
	@mkdir -p $(@D)
	clang $(FUZZ_FLAGS) -MMD -MP -c $< -o $@
build/fuzz/%.avx512.o: %.c
	@mkdir -p $(@D)
	clang $(FUZZ_FLAGS) -MMD -MP -c $< -o $@
build/fuzz/fuzz_%: build/fuzz/tests/fuzz/fuzz_%.o build/fuzz/tests/fuzz/fuzz.o $(OBJ:$(BUILD)/%=build/fuzz/%)
	clang $(FUZZ_FLAGS) -fsanitize=fuzzer $^ -o $@ $(LIBS)

$(BUILD)/shim.so: tests/shim.c
	@mkdir -p $(@D)
	$(CC) -D_GNU_SOURCE -std=c11 -Wall -Wextra -Werror -O2 -shared -fPIC $< -o $@ -ldl

EMBREE := $(if $(wildcard /usr/include/embree3/rtcore.h),yes)
$(BUILD)/tests/bench_pov: %: %.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS)
$(BUILD)/tests/bench_pov.o: CFLAGS += -D_DEFAULT_SOURCE
$(BUILD)/tests/bench $(BUILD)/tests/bench_bvh: %: %.o $(OBJ)
	$(CC) $(CF) $^ -o $@ $(LIBS) $(if $(EMBREE),-lembree3)
$(BUILD)/tests/bench.o $(BUILD)/tests/bench_bvh.o: CFLAGS += $(if $(EMBREE),-DHAVE_EMBREE)

$(BUILD)/tests/check_pov: $(BUILD)/tests/check_pov.o $(OBJ)
	$(CC) $(CF) -D_DEFAULT_SOURCE $^ -o $@ $(LIBS)
$(BUILD)/tests/check_pov.o: CFLAGS += -D_DEFAULT_SOURCE

$(BUILD)/%.avx2.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CF) -MMD -MP -c $< -o $@
$(BUILD)/%.avx512.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CF) -MMD -MP -c $< -o $@

$(BUILD)/src/io/mesh_import.o: CFLAGS += $(if $(ASSIMP),-DASSIMP='"$(ASSIMP)"')

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

-include $(OBJ:.o=.d) $(TESTS:=.d) $(BUILD)/src/main.d $(BUILD)/tests/bench.d $(BUILD)/tests/bench_bvh.d $(BUILD)/tests/bench_pov.d
-include $(wildcard $(BUILD)/tests/fuzz/*.d build/fuzz/*/*/*.d build/fuzz/*/*.d)

.PHONY: $(TESTS:=.run) $(FUZZ:=.run) all deps tests test fuzz faults test-slurm coverage layers sweep paper hierarchies smits interiors bench check-pov golden clean help .FORCE
.SECONDARY:
.DELETE_ON_ERROR:
