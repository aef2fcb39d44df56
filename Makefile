# Builds Jostle. Sources are found by wildcard, not listed; each build has a folder, build/MODE.
# `make run` and `make test` install what is missing (.ci/setup); plain `make` only builds.
# BULLET=0 builds without bodies and Bullet, VIEW=0 without the live page and libwebsockets, CAIRO=0 without
# PNG images, videos and cairo.
VERSION := 0.1.0
MODE    ?= release
BULLET  ?= 1
CAIRO   ?= 1
VIEW    ?= 1
PREFIX  ?= /usr/local
LIBDIR  ?= $(PREFIX)/lib
# Folder where the program finds its Lua library, behaviours and scenes: this tree, unless it is installed. If relative, as
# PAGEDIR may be, too: relative to the folder of the program or shared library (core/base/format/installed.c).
DATADIR ?= $(CURDIR)
# Folder of the live page: core/view/page with its modules and three.js in one bundle, which needs npm. A release
# archive (`make dist`) has the page bundled, in `bundled`.
PAGE    := $(if $(wildcard bundled/main.js),bundled,build/page)
PAGEDIR ?= $(CURDIR)/$(PAGE)
# CROSS=aarch64-linux-gnu- builds for another machine; its libraries are expected where Debian's multiarch puts them.
CROSS   ?=
ifneq ($(CROSS),)
CC      := $(CROSS)gcc
CXX     := $(CROSS)g++
PKG     := PKG_CONFIG_LIBDIR=/usr/lib/$(CROSS:-=)/pkgconfig:/usr/share/pkgconfig pkg-config
else
PKG     := pkg-config
endif
# Edited files are noticed by inotify; without it (WATCH=0) they are not.
WATCH   ?= 1
# Mods as zip archives need libzip; without it, or with ZIP=0, they are refused.
ZIP     ?= $(if $(shell $(PKG) --exists libzip 2>/dev/null && echo 1),1,0)
WITHOUT := $(if $(filter-out file,$(origin ZIP)),$(if $(filter 0,$(ZIP)),-nozip))$(if $(filter 0,$(BULLET)),-nobullet)$(if $(filter 0,$(CAIRO)),-nocairo)$(if $(filter 0,$(VIEW)),-noview)$(if $(filter 0,$(WATCH)),-nowatch)$(if $(CROSS),-$(CROSS:-=))
B       ?= build/$(MODE)$(WITHOUT)
# SHARED: folder of the objects that builds of a MODE have in common, whatever they leave out and wherever they
# are installed. The few files that name a folder of the installation (PLACED) are compiled for each build. If B
# is given on the command line, all objects are in B.
SHARED  := $(if $(filter file,$(origin B)),build/$(MODE)$(if $(CROSS),-$(CROSS:-=)),$(B))
# ONLY="base geom ..." restricts the build to some folders of core/ and their unit tests.
ONLY    ?=

FOLDERS := $(if $(ONLY),$(ONLY),base base/number base/format simd task geom geom/field geom/ground agents nav/spots nav nav/near nav/walk nav/orca nav/move force force/push force/support force/contact force/stages body machine machine/steering world/input world/step_events world/routes world world/verbs world/embed scene/format scene/wall_files scene scene/reference lua/vm lua/language lua record/fields record record/probes record/danger view picture run/watch run run/resume run/results run/why run/mods live report render validate luatest sweep sweep/compare)
# Folders that are in libjostle-tools alone, not in libjostle: pages, pictures, reports.
TOOLS   := view picture live report render validate luatest sweep sweep/compare
SRC_C   := $(sort $(foreach d,$(FOLDERS),$(wildcard core/$(d)/*.c)))
# Kernels: one source, compiled for each instruction set that core/simd has lanes for.
SRC_WIDE := $(filter %_wide.c,$(SRC_C))
SRC_C   := $(filter-out $(SRC_WIDE),$(SRC_C))
MACHINE := $(shell $(CC) -dumpmachine)
ISAS    := scalar $(if $(findstring x86_64,$(MACHINE)),sse2 avx2 avx512) $(if $(findstring aarch64,$(MACHINE)),neon)
ISA.sse2   := -msse2
ISA.avx2   := -mavx2
ISA.avx512 := -mavx512f
SRC_CC  := $(sort $(foreach d,$(FOLDERS),$(wildcard core/$(d)/*.cc)))
ifeq ($(BULLET),0)
SRC_CC  :=
else
SRC_C   := $(filter-out core/body/no_bullet.c,$(SRC_C))
endif
SRC_C   := $(filter-out core/run/watch/watch_$(if $(filter 0,$(WATCH)),inotify,none).c,$(SRC_C))
SRC_C   := $(filter-out core/picture/canvas_$(if $(filter 0,$(CAIRO)),cairo,none).c,$(SRC_C))
SRC_C   := $(filter-out core/base/zip_$(if $(filter 0,$(ZIP)),libzip,none).c,$(SRC_C))
# One of three files, or groups of files, implements view.h: worker.c in WebAssembly alone (scripts/wasm/build.mk).
SERVERS := core/view/lws_% core/view/no_server.c core/view/worker.c
SRC_C   := $(filter-out $(filter-out core/view/$(or $(patsubst 0,no_server.c,$(filter 0,$(VIEW))),$(patsubst worker,worker.c,$(filter worker,$(VIEW))),lws_%),$(SERVERS)),$(SRC_C))
SRC_CLI := $(sort $(wildcard core/cli/*.c core/cli/bench/*.c))
TESTS   := $(sort $(foreach d,$(FOLDERS) $(if $(ONLY),,api load),$(wildcard tests/unit/$(subst /,_,$(d))_*.c)))
TESTS   := $(filter-out $(if $(filter 0,$(VIEW)),tests/unit/view_% tests/unit/live_view.c tests/unit/live_replay_page.c),$(TESTS))
BENCHES := $(sort $(wildcard tests/bench/*.c))
# pkg-config's name of Lua 5.4 differs between systems.
LUA     := $(firstword $(shell for p in lua5.4 lua-5.4 lua54 lua; do $(PKG) --exists "$$p >= 5.4" 2>/dev/null && echo $$p; done) lua5.4)
ENGINE_PKGS := $(LUA) yaml-0.1 sqlite3 expat libcjson $(if $(filter 0,$(ZIP)),,libzip) $(if $(filter 0,$(BULLET)),,bullet)
PKGS    := $(ENGINE_PKGS) $(if $(filter 0,$(CAIRO)),,cairo) $(if $(filter 0,$(VIEW)),,libwebsockets)

OPT.release := -O2 -DNDEBUG
OPT.debug   := -O0 -g
OPT.asan    := -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
OPT.ubsan   := -O1 -g1 -fsanitize=undefined -fno-sanitize-recover=all
OPT.tsan    := -O0 -g1 -fsanitize=thread
# For `make fuzz`: needs clang; with coverage counters for libFuzzer, and with assertions.
OPT.fuzz    := -O1 -g1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
OPT     := $(OPT.$(MODE))
$(if $(OPT),,$(error MODE=$(MODE) is not one of release, debug, asan, ubsan, tsan, fuzz))
ifeq ($(MODE),fuzz)
ifneq ($(findstring clang,$(CC)),clang)
override CC := clang
override CXX := clang++
endif
endif
WARN    := -Wall -Wextra -Wshadow -Wpointer-arith -Wstrict-prototypes -Wmissing-prototypes -Wvla
# Hardening of release builds against overruns of the stack and of buffers (LINK makes the table of imports
# read-only). Debug and sanitised builds find more by themselves.
HARD    := $(if $(filter release,$(MODE)),-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
# No contraction to fused multiply-add, no fast-math: every build must compute the same bits.
FP      := -ffp-contract=off -fno-math-errno -fno-trapping-math
PIC     := -fPIC
THREADS := -pthread
CFLAGS  ?=
CPPFLAGS_ALL := -Icore -Icore/include -DJOX_VERSION='"$(VERSION)"' -D_GNU_SOURCE
# Folders of the installation, defined only for the files that name them (PLACED) and for tests, so that all other
# objects can be shared.
PLACES  := -DJOX_DATADIR='"$(DATADIR)"' -DJOX_PAGEDIR='"$(PAGEDIR)"'
PLACED  := $(shell grep -lE 'JOX_(DATADIR|PAGEDIR)' $(SRC_C) $(SRC_CC) $(SRC_CLI))
# Static variables of inline C++ functions must not become symbols that all libraries of a process share.
UNIQUE  := $(shell echo | $(CXX) -fno-gnu-unique -x c++ -E - >/dev/null 2>&1 && echo -fno-gnu-unique)
CFLAGS_ALL  = -std=c17 $(OPT) $(HARD) $(WARN) $(FP) $(PIC) -fvisibility=hidden $(THREADS) -MMD -MP $(PKG_CFLAGS) $(CFLAGS)
# No vectorization of scalars in C++: with it, GCC 12 at -O3 rounds the sum of a shape's moments of inertia
# differently. The C++ files have no loops that would gain by it.
CXXFLAGS_ALL = -std=c++17 $(OPT) $(HARD) -Wall -Wextra $(FP) -fno-tree-slp-vectorize $(PIC) -fvisibility=hidden -fno-exceptions -fno-rtti $(UNIQUE) \
           $(THREADS) -MMD -MP $(PKG_CFLAGS) $(CFLAGS)
PKG_CFLAGS := $(shell $(PKG) --cflags $(PKGS) 2>/dev/null | sed 's/-I/-isystem /g')
PKG_LIBS   := $(shell $(PKG) --libs $(PKGS) 2>/dev/null)
LIBS       := $(PKG_LIBS) -lm -pthread
LIBS_jostle       := $(shell $(PKG) --libs $(ENGINE_PKGS) 2>/dev/null) -lm -pthread
LIBS_jostle-tools := $(LIBS)
LINK       := $(if $(filter 0,$(BULLET)),$(CC),$(CXX)) $(OPT) -pthread -Wl,-z,relro,-z,now $(LDFLAGS)

# Prints one short line per file; V=1 shows the commands.
ifeq ($(V),1)
Q   :=
say :=
else
Q   := @
say = @printf '  %-4s %s\n' $(1) $(2)
endif

objects  = $(foreach s,$(1),$(if $(filter $(s),$(PLACED)),$(B),$(SHARED))/$(basename $(s)).o)
OBJ_WIDE := $(foreach i,$(ISAS),$(SRC_WIDE:%.c=$(SHARED)/%.$(i).o))
OBJ     := $(call objects,$(SRC_C) $(SRC_CC)) $(OBJ_WIDE)
OBJ_jostle       := $(filter-out $(foreach d,$(TOOLS),$(SHARED)/core/$(d)/% $(B)/core/$(d)/%),$(OBJ))
OBJ_jostle-tools := $(OBJ)
OBJ_CLI := $(call objects,$(SRC_CLI))
UNIT    := $(TESTS:tests/unit/%.c=$(B)/unit/%)
BENCH   := $(BENCHES:tests/bench/%.c=$(B)/bench/%)
FUZZERS := $(patsubst tests/fuzz/%.c,$(B)/fuzz/%,$(sort $(wildcard tests/fuzz/*.c)))

.PHONY: reference all run test gallery fuzz fuzzers faults unit tests-built check analyse bench bench-record bench-peers bench-instructions arm cluster-test wasm wasm-test npm npm-test site site-test matrix soak install install-built uninstall dist deb deb-check wheel wheel-check container-check clean test-all format
LIBRARIES := jostle jostle-tools
all: $(B)/jostle $(if $(filter 0,$(VIEW)),,$(PAGE)/main.js) $(foreach l,$(LIBRARIES),$(B)/lib$(l).a $(B)/lib$(l).so.$(VERSION)) $(B)/lua/jostle.so

# The two commands of the README. Both first install missing packages, and build on all processors.
AT_ONCE = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(shell nproc))
run:
	@.ci/setup run
	@$(MAKE) --no-print-directory $(AT_ONCE) $(B)/jostle
	$(B)/jostle run scenes/tawaf.yaml --for $(DURATION) --report build/out/tawaf --summary build/out/tawaf.json
	@echo "See it live, and act on it:  $(B)/jostle run scenes/tawaf.yaml --view"
DURATION ?= 60
test:
	@.ci/setup test
	@$(MAKE) --no-print-directory $(AT_ONCE) all tests-built
	@B=$(B) SHARED=$(SHARED) .ci/suite check units scenes install wheel page
# Makes pictures and clips, as the live page draws them, of the shipped scenes that SCENES names (default: all).
gallery:
	@.ci/setup gallery
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) JOSTLE=$(B)/jostle /usr/bin/python3 tests/page/gallery.py build/out/gallery $(filter-out all,$(SCENES))
# All tests, with 10,000 connects to the live page, then the units under sanitisers.
test-all: test
	JOSTLE_VIEW_CYCLES=10000 $(B)/units view_stream
	@.ci/sanitizers
# Tests a build for AArch64 under an emulator (tests/arm).
arm:
	@.ci/setup arm
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) .ci/suite arm
# Tests scripts/cluster by a Slurm that it starts, and by Snakemake (tests/cluster).
cluster-test:
	@.ci/setup cluster
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) .ci/suite cluster
# Builds the engine for WebAssembly, with its JavaScript, in build/wasm/out (scripts/wasm).
wasm:
	@.ci/setup wasm
	@bash scripts/wasm/sources.sh build/wasm/sources $$(.ci/setup wasm-sources)
	@$(MAKE) --no-print-directory $(AT_ONCE) -f scripts/wasm/build.mk
wasm-test: wasm
	@$(MAKE) --no-print-directory -f scripts/wasm/build.mk wasm-tests-built
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) JOSTLE=$(B)/jostle .ci/suite wasm
# Makes the npm package, build/out/jostle-VERSION.tgz (scripts/npm).
npm: wasm
	@$(MAKE) --no-print-directory -f scripts/wasm/build.mk wasm-npm
npm-test: npm
	@$(MAKE) --no-print-directory $(NODE)
	@.ci/suite npm
# Makes the playground, a static site, in build/site: scenes and an editor in a browser's tab (scripts/site).
site: wasm
	@$(MAKE) --no-print-directory $(B)/jostle $(NODE)
	$(call say,SITE,scripts/site)
	$(Q)node scripts/site/build.mjs build/site $(B)/jostle build/wasm/out build/node
site-test: site
	@.ci/setup test
	@B=$(B) JOSTLE=$(B)/jostle .ci/suite site
# Proves that the hashes of the scenes in SCENES are the same for all threads, instruction sets, compilers and options
# that must not change results (tests/scenes/determinism.sh).
SCENES ?= all
JUDGE  := awk '{print; fflush()} /^not ok/ {bad = 1} END {exit bad}'
matrix:
	@.ci/setup test
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) JOSTLE=$(B)/jostle JOSTLE_MATRIX="$(SCENES)" bash tests/scenes/determinism.sh | $(JUDGE)
# Soak test: runs the Tawaf for SECONDS of wall time with reloads, page, recorder, input log and checkpoints, then
# makes 1,000 reloads and 10,000 page connects.
SECONDS ?= 3600
soak:
	@.ci/setup test
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) JOSTLE=$(B)/jostle JOSTLE_SOAK=$(SECONDS) bash tests/soak.sh | $(JUDGE)
bench:
	@.ci/setup bench
	@$(MAKE) --no-print-directory all $(BENCH)
	@for b in $(BENCH); do echo "== $$b"; $$b; done
	$(B)/jostle bench
	@B=$(B) bash tests/bench/reload.sh
	@B=$(B) bash tests/bench/functions.sh
# Times each scene, and appends a line for it to the table of this model of processor in tests/bench/results.
bench-record: all
	@B=$(B) bash tests/bench/record.sh
# Replaces the instruction counts that tests/scenes/instructions.sh compares; for deliberate changes of cost.
bench-instructions: all
	@B=$(B) JOSTLE=$(B)/jostle bash tests/scenes/instructions.sh --write
# Times other engines and Jostle in turn, on the same crowds.
PEERS := $(patsubst tests/bench/peers/%.cc,$(B)/bench/peer-%,$(wildcard tests/bench/peers/*.cc))
bench-peers:
	@.ci/setup peers
	@$(MAKE) --no-print-directory $(PEERS)
	@for peer in $(PEERS); do $$peer || exit 1; done
check:
	@.ci/setup test
	@$(MAKE) --no-print-directory all
	@B=$(B) SHARED=$(SHARED) .ci/suite check
# Analyses the C sources with cppcheck.
analyse:
	@.ci/setup test
	@B=$(B) .ci/analyse
tests-built: $(B)/units
# Runs the fuzzer that FUZZ names, or all, for TIME seconds each, by libFuzzer in a build of their own.
TIME ?= 60
fuzz:
	@.ci/setup test
	@$(MAKE) --no-print-directory MODE=fuzz fuzzers
	@B=build/fuzz TIME=$(TIME) bash tests/fuzz/run.sh $(FUZZ)
fuzzers: $(FUZZERS) $(B)/jostle
# Fault injection: runs each command with its n-th allocation, write, ... failing, for FAULTS values of n, or all.
FAULTS ?= all
faults:
	@.ci/setup test
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) FAULTS=$(FAULTS) bash tests/faults/run.sh

define compile
	@mkdir -p $(@D)
	$(call say,$(1),$<)
	$(Q)$(2) $(CPPFLAGS_ALL) $(if $(filter $<,$(PLACED)),$(PLACES)) $(3) -c $< -o $@
endef
$(B)/%.o: %.c Makefile
	$(call compile,CC,$(CC),$(CFLAGS_ALL))
# Files compiled at -O3, which vectorizes their loops over numbers without changing a bit: kernels and a few others.
VECTORISED := core/record/fields/density core/record/fields/density_put core/record/fields/density_diffuse \
           core/world/number_guard core/world/statistics core/agents/agents core/force/stages/forces core/force/push/pass_on core/force/contact/crush_load \
           core/machine/batches core/machine/think core/machine/target core/nav/near/perceive core/nav/move/move \
           $(foreach k,$(SRC_WIDE:%.c=%),$(ISAS:%=$k.%))
$(VECTORISED:%=$(SHARED)/%.o): OPT += $(if $(filter release,$(MODE)),-O3)
# Files in which tests spend little time, compiled at -O0 with sanitizers, in half of the time.
SELDOM_RUN := $(call objects,$(filter $(foreach d,cli run $(TOOLS),core/$(d)/%),$(SRC_C) $(SRC_CLI))) $(UNIT:%=%.o)
$(SELDOM_RUN): OPT += $(if $(filter asan ubsan,$(MODE)),-O0)
define wide
$(SHARED)/%_wide.$(1).o: %_wide.c Makefile
	$$(call compile,CC,$$(CC),$$(CFLAGS_ALL) $(ISA.$(1)) -DJOX_ISA_$(1))
endef
$(foreach i,$(ISAS),$(eval $(call wide,$(i))))
$(B)/%.o: %.cc Makefile
	$(call compile,CXX,$(CXX),$(CXXFLAGS_ALL))
ifneq ($(SHARED),$(B))
$(SHARED)/%.o: %.c Makefile
	$(call compile,CC,$(CC),$(CFLAGS_ALL))
$(SHARED)/%.o: %.cc Makefile
	$(call compile,CXX,$(CXX),$(CXXFLAGS_ALL))
endif
$(B)/internal.a: $(OBJ)
	@mkdir -p $(@D)
	@rm -f $@
	$(call say,AR,$@)
	$(Q)$(CROSS)ar rcs $@ $^
$(B)/jostle: $(OBJ_CLI) $(B)/internal.a | $(if $(filter 0,$(VIEW)),,$(PAGE)/main.js)
	$(call say,LINK,$@)
	$(Q)$(LINK) $^ -o $@ $(LIBS)
# The libraries export the public functions alone: hidden symbols become local.
define library
$(B)/$(1).o: $(OBJ_$(1))
	@mkdir -p $$(@D)
	$$(call say,LD,$$@)
	$$(Q)$$(CROSS)ld -r $$^ -o $$@
	$$(Q)$$(CROSS)objcopy --localize-hidden $$@
$(B)/lib$(1).a: $(B)/$(1).o
	@rm -f $$@
	$$(call say,AR,$$@)
	$$(Q)$$(CROSS)ar rcs $$@ $$^
$(B)/lib$(1).so.$(VERSION): $(B)/$(1).o
	$$(call say,LINK,$$@)
	$$(Q)$$(LINK) -shared -Wl,-soname,lib$(1).so.0 -Wl,--as-needed $$^ -o $$@ $$(LIBS_$(1))
endef
$(foreach l,$(LIBRARIES),$(eval $(call library,$(l))))
# Module for stock Lua interpreters: `require "jostle"`.
LUA_MODULE := $(patsubst scripts/lua/%.c,$(B)/lua/%.o,$(wildcard scripts/lua/*.c))
$(LUA_MODULE): $(B)/lua/%.o: scripts/lua/%.c Makefile
	$(call compile,LUA,$(CC),$(CFLAGS_ALL))
$(B)/lua/jostle.so: $(LUA_MODULE) $(B)/libjostle.a
	$(call say,LINK,$@)
	$(Q)$(LINK) -shared -Wl,--as-needed -Wl,--exclude-libs,ALL $(LUA_MODULE) $(B)/libjostle.a -o $@ $(LIBS_jostle)
# The live page: one bundle of its modules and of three.js, by esbuild; build/node has both, and ESLint, in the versions
# of core/view/page/package-lock.json.
NODE       := build/node/node_modules/.package-lock.json
PAGE_FILES := $(wildcard core/view/page/*.html core/view/page/*.css core/view/page/*.svg)
$(NODE): core/view/page/package-lock.json core/view/page/package.json
	@command -v npm >/dev/null || { echo "The live page is bundled with npm, which is not installed: install Node.js and npm, or build without the page, by VIEW=0." >&2; exit 1; }
	@mkdir -p build/node && cp core/view/page/package*.json build/node/
	$(call say,NPM,$<)
	$(Q)cd build/node && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >npm.log 2>&1 || { cat npm.log >&2; \
	    echo "npm could not install what the live page is bundled from (it needs its registry once). VIEW=0 builds without the page." >&2; exit 1; }
	@touch $@
build/page/main.js: $(NODE) $(PAGE_FILES) $(shell find core/view/page -name '*.js')
	@rm -rf $(@D) && mkdir -p $(@D)
	$(call say,PAGE,core/view/page)
	$(Q)cp $(PAGE_FILES) $(@D)/
	$(Q)cp build/node/node_modules/three/LICENSE $(@D)/three.LICENSE.txt
	$(Q)NODE_PATH=build/node/node_modules build/node/node_modules/.bin/esbuild core/view/page/main.js --bundle --format=esm \
	    --minify-whitespace --minify-syntax --legal-comments=none --log-level=warning --outfile=$@
# Each unit test has a main of its own, and may be linked as a program, $(B)/unit/NAME. $(B)/units has all of
# them in one program, their mains renamed: `units NAME...` runs those tests.
$(B)/unit/%.o: tests/unit/%.c Makefile
	@mkdir -p $(@D)
	$(call say,TEST,$<)
	$(Q)$(CC) $(CPPFLAGS_ALL) $(PLACES) -DJOX_BULLET=$(BULLET) $(CFLAGS_ALL) -Itests -c $< -o $@
$(B)/unit/%: $(B)/unit/%.o $(B)/internal.a
	$(call say,LINK,$@)
	$(Q)$(LINK) $^ -o $@ -lcmocka $(LIBS)
$(B)/units: tests/unit/all/units.c $(UNIT:%=%.o) $(B)/internal.a
	$(call say,LINK,$@)
	@mkdir -p $@.parts && rm -f $@.parts/*
	@printf 'UNIT(%s)\n' $(notdir $(UNIT)) >$@.parts/list.h
	$(Q)$(CC) -std=c17 $(OPT) $(WARN) -fPIC -DUNITS='"$@.parts/list.h"' -I. -c $< -o $@.parts/units.o
	$(Q)for unit in $(notdir $(UNIT)); do \
	    $(CROSS)objcopy --redefine-sym main=unit_$$unit $(B)/unit/$$unit.o $@.parts/$$unit.o || exit 1; done
	$(Q)$(LINK) $@.parts/*.o $(B)/internal.a -o $@ -lcmocka $(LIBS)
	@rm -f $@.parts/*.o
# Fuzzers are driven by libFuzzer's main with MODE=fuzz, else by that of tests/fuzz/support/replay.c, which replays
# stored inputs.
OBJ_FUZZ := $(patsubst %.c,$(B)/%.o,$(filter-out $(if $(filter fuzz,$(MODE)),%/replay.c),$(wildcard tests/fuzz/support/*.c)))
.SECONDARY: $(OBJ_FUZZ) $(FUZZERS:$(B)/fuzz/%=$(B)/tests/fuzz/%.o)
$(B)/fuzz/%: $(B)/tests/fuzz/%.o $(OBJ_FUZZ) $(filter-out %/main.o,$(OBJ_CLI)) $(B)/internal.a
	@mkdir -p $(@D)
	$(call say,LINK,$@)
	$(Q)$(LINK) $(if $(filter fuzz,$(MODE)),-fsanitize=fuzzer) $^ -o $@ $(LIBS)
$(B)/bench/%: tests/bench/%.c $(B)/internal.a
	@mkdir -p $(@D)
	$(call say,TEST,$<)
	$(Q)$(CC) $(CPPFLAGS_ALL) $(PLACES) -DJOX_BULLET=$(BULLET) $(CFLAGS_ALL) -Itests -c $< -o $@.o
	$(Q)$(LINK) $@.o $(B)/internal.a -o $@ $(LIBS)
$(B)/bench/peer-%: tests/bench/peers/%.cc $(B)/libjostle.a
	@mkdir -p $(@D)
	$(call say,PEER,$<)
	$(Q)$(CXX) -std=c++17 -O2 -Wall -Wextra -Icore/include -isystem /usr/include/recastnavigation $< $(B)/libjostle.a -o $@ -lDetourCrowd -lDetour $(LIBS)

# Generates reference pages and files for editors from the tables of words, keys and options; `make check`
# compares them.
reference: all
	@for page in $(REFERENCE); do $(B)/jostle reference $${page%%:*} > $${page#*:}; done
REFERENCE := behaviours:scripts/behaviour.md scenes:scripts/scene.md lua-ls:scripts/editor/jostle.lua \
           luacheck:scripts/editor/luacheckrc luacheck:.luacheckrc \
           scene-schema:scripts/scene.schema.json mod-schema:scripts/mod.schema.json inputs:scripts/input.md manual:scripts/jostle.1
# Runs the unit tests alone, each in a process of its own; ONLY="base geom" restricts them to some folders.
unit: $(B)/units
	@failed=0; for u in $(notdir $(UNIT)); do $(B)/units $$u || failed=$$((failed + 1)); done; \
	    echo "$(words $(UNIT)) tests, $$failed failed"; [ $$failed = 0 ]
# The program contains the paths of its installation, so each PREFIX has a build of its own.
INSTALL_B := build/install$(subst /,-,$(PREFIX))-$(MODE)$(WITHOUT)
D          = $(DESTDIR)$(PREFIX)
HEADERS   := $(sort $(wildcard core/include/*.h core/include/*.hpp))
L          = $(DESTDIR)$(LIBDIR)
install-built:
	@$(MAKE) --no-print-directory B=$(INSTALL_B) SHARED=$(SHARED) DATADIR=$(PREFIX)/share/jostle PAGEDIR=$(PREFIX)/share/jostle/page all
install: install-built
	install -d $(D)/bin $(L)/pkgconfig $(D)/include $(D)/share/man/man1
	install -m 755 $(INSTALL_B)/jostle $(D)/bin/jostle
	for l in $(LIBRARIES); do install -m 644 $(INSTALL_B)/lib$$l.a $(L)/ && \
	    install -m 755 $(INSTALL_B)/lib$$l.so.$(VERSION) $(L)/ && \
	    ln -sf lib$$l.so.$(VERSION) $(L)/lib$$l.so.0 && ln -sf lib$$l.so.0 $(L)/lib$$l.so || exit 1; done
	install -m 644 $(HEADERS) $(D)/include/
	install -d $(L)/lua/5.4
	install -m 644 $(INSTALL_B)/lua/jostle.so $(L)/lua/5.4/
	install -m 644 scripts/jostle.1 $(D)/share/man/man1/
	$(foreach l,$(LIBRARIES),printf 'prefix=%s\nlibdir=%s\nName: %s\nDescription: Dense crowds that push, scripted in Lua\nVersion: %s\nCflags: -I$${prefix}/include\nLibs: -L$${libdir} -l%s\nLibs.private: %s\n' '$(PREFIX)' '$(LIBDIR:$(PREFIX)/%=$${prefix}/%)' $(l) '$(VERSION)' $(l) '$(LIBS_$(l)) -lstdc++' > $(L)/pkgconfig/$(l).pc;)
	DESTDIR="$(DESTDIR)" scripts/cmake/install.sh $(L)/cmake/jostle $(PREFIX) $(VERSION) $(if $(findstring 64,$(MACHINE)),8,4) "$(LIBS_jostle)" "$(LIBS_jostle-tools)"
	install -d $(D)/share/jostle/page
	if [ -f $(PAGE)/main.js ]; then cp -R $(PAGE)/. $(D)/share/jostle/page; fi
	for d in scripts/editor scripts/cluster behaviours scenes; do install -d $(D)/share/jostle/$$d; cp -R $$d/. $(D)/share/jostle/$$d; done
	cp scripts/*.* $(D)/share/jostle/scripts/
uninstall:
	rm -rf $(D)/share/jostle $(L)/cmake/jostle
	rm -f $(D)/bin/jostle $(L)/lua/5.4/jostle.so $(LIBRARIES:%=$(L)/lib%.a) $(LIBRARIES:%=$(L)/lib%.so*) $(HEADERS:core/%=$(D)/%)
	rm -f $(LIBRARIES:%=$(L)/pkgconfig/%.pc) $(D)/share/man/man1/jostle.1
# Makes build/out/jostle-VERSION.tar.gz of the current commit, the same bytes each time, and its SHA-256 sum.
DIST := build/out/jostle-$(VERSION).tar.gz
dist: $(PAGE)/main.js
	@mkdir -p build/out
	git archive --format=tar --prefix=jostle-$(VERSION)/ HEAD > $(DIST:.gz=)
	tar --append --file=$(DIST:.gz=) --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX \
	    --mtime=@$$(git log -1 --format=%ct) --transform='s,^$(PAGE),jostle-$(VERSION)/bundled,' $(PAGE)
	gzip -n9f $(DIST:.gz=)
	cd build/out && sha256sum $(notdir $(DIST)) > SHA256SUMS
# Makes Debian packages of that archive in build/deb. `make deb-check` checks them with lintian, installs them into a
# root folder of their own, and runs what was installed.
deb: dist
	@.ci/setup deb
	rm -rf build/deb && mkdir -p build/deb
	tar -xzf $(DIST) -C build/deb
	cp -R build/deb/jostle-$(VERSION)/scripts/debian build/deb/jostle-$(VERSION)/debian
	cd build/deb/jostle-$(VERSION) && DEB_BUILD_OPTIONS=parallel=$$(nproc) dpkg-buildpackage -us -uc -b
deb-check: deb
	@bash tests/deb/run.sh build/deb
# Makes a wheel for Python with all libraries inside in build/out (scripts/python/wheel.py). `make wheel-check` installs it
# into a root folder without a compiler, and runs scenes there.
WHEEL_B := build/wheel$(WITHOUT)
wheel: $(PAGE)/main.js
	@.ci/setup wheel
	@$(MAKE) --no-print-directory $(AT_ONCE) B=$(WHEEL_B) SHARED=$(SHARED) DATADIR=. PAGEDIR=page \
	    PKG_LIBS="$$(/usr/bin/python3 scripts/python/wheel.py --libraries)" LDFLAGS="-Wl,--as-needed -Wl,--exclude-libs,ALL" \
	    $(WHEEL_B)/jostle $(WHEEL_B)/libjostle-tools.so.$(VERSION)
	@SOURCE_DATE_EPOCH=$${SOURCE_DATE_EPOCH:-$$(git log -1 --format=%ct 2>/dev/null)} /usr/bin/python3 scripts/python/wheel.py $(WHEEL_B) $(PAGE) build/out
wheel-check: $(B)/jostle
	@.ci/setup wheel-check
	@B=$(B) bash tests/wheel/run.sh root | $(JUDGE)
# Builds the image of scripts/container with Buildah, and uses it.
container-check: $(B)/jostle
	@.ci/setup container
	@B=$(B) bash tests/container/run.sh | $(JUDGE)
clean:
	rm -rf build
format:
	clang-format -i $$(git ls-files 'core/*.[ch]' 'core/*.cc' 'tests/*.[ch]' 'tests/*.cc')

-include $(shell find $(sort $(B) $(SHARED)) -name '*.d' 2>/dev/null)
