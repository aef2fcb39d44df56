# Jostle. Sources are found, never listed; everything is built in build/MODE.
# `make run` and `make test` install what is missing (.ci/setup); plain `make` only builds.
# BULLET=0 leaves out bodies and Bullet, VIEW=0 the live page and libwebsockets, CAIRO=0 images and cairo.
VERSION := 0.1.0
MODE    ?= release
BULLET  ?= 1
CAIRO   ?= 1
VIEW    ?= 1
PREFIX  ?= /usr/local
LIBDIR  ?= $(PREFIX)/lib
# Where the program finds its library of Lua, behaviours and scenes: this tree, until it is installed.
DATADIR ?= $(CURDIR)
# Its live page, and the three.js that the page uses (Debian's libjs-three).
PAGEDIR ?= $(CURDIR)/core/view/page
THREEDIR ?= /usr/share/javascript/three
# CROSS=aarch64-linux-gnu- builds for another machine, with its libraries as Debian lays them beside ours.
CROSS   ?=
ifneq ($(CROSS),)
CC      := $(CROSS)gcc
CXX     := $(CROSS)g++
PKG     := PKG_CONFIG_LIBDIR=/usr/lib/$(CROSS:-=)/pkgconfig:/usr/share/pkgconfig pkg-config
else
PKG     := pkg-config
endif
WITHOUT := $(if $(filter 0,$(BULLET)),-nobullet)$(if $(filter 0,$(CAIRO)),-nocairo)$(if $(filter 0,$(VIEW)),-noview)$(if $(CROSS),-$(CROSS:-=))
B       ?= build/$(MODE)$(WITHOUT)
# Objects are shared by builds that differ in what they leave out or in where they are installed: the few
# files that name a folder of the installation are compiled for each. A B that is given has its own.
SHARED  := $(if $(filter file,$(origin B)),build/$(MODE)$(if $(CROSS),-$(CROSS:-=)),$(B))
# ONLY="base geom ..." restricts the build to some folders of core/ and their unit tests.
ONLY    ?=

FOLDERS := $(if $(ONLY),$(ONLY),base base/number base/format simd task geom geom/field geom/ground agents nav/spots nav nav/near nav/walk nav/orca nav/move force force/push force/support force/contact force/stages body machine machine/steering world/input world/happened world/routes world world/verbs world/embed scene/format scene/walls scene scene/reference lua/vm lua/language lua record/fields record record/probes record/danger view picture run/watch run run/resume run/results run/mods live report render validate luatest sweep sweep/compare)
# Of them, what libjostle leaves to libjostle-tools: pages, pictures, reports.
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
SRC_C   := $(filter-out core/body/none.c,$(SRC_C))
endif
SRC_C   := $(filter-out core/picture/canvas_$(if $(filter 0,$(CAIRO)),cairo,none).c,$(SRC_C))
SRC_C   := $(filter-out $(if $(filter 0,$(VIEW)),core/view/lws_%,core/view/none.c),$(SRC_C))
SRC_CLI := $(sort $(wildcard core/cli/*.c core/cli/bench/*.c))
TESTS   := $(sort $(foreach d,$(FOLDERS) $(if $(ONLY),,api load),$(wildcard tests/unit/$(subst /,_,$(d))_*.c)))
TESTS   := $(filter-out $(if $(filter 0,$(VIEW)),tests/unit/view_% tests/unit/live_view.c tests/unit/live_replay_page.c),$(TESTS))
BENCHES := $(sort $(wildcard tests/bench/*.c))
# Systems give Lua 5.4 different names.
LUA     := $(firstword $(shell for p in lua5.4 lua-5.4 lua54 lua; do $(PKG) --exists "$$p >= 5.4" 2>/dev/null && echo $$p; done) lua5.4)
ENGINE_PKGS := $(LUA) yaml-0.1 sqlite3 expat libcjson $(if $(filter 0,$(BULLET)),,bullet)
PKGS    := $(ENGINE_PKGS) $(if $(filter 0,$(CAIRO)),,cairo) $(if $(filter 0,$(VIEW)),,libwebsockets)

OPT.release := -O2 -DNDEBUG
OPT.debug   := -O0 -g
OPT.asan    := -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
OPT.ubsan   := -O1 -g1 -fsanitize=undefined -fno-sanitize-recover=all
OPT.tsan    := -O1 -g1 -fsanitize=thread
# For fuzzers (`make fuzz`): by clang, with counters of what was reached, and with assertions.
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
# What an overrun of the stack, of a buffer or of the table of imports would need is not there; debug and
# sanitised builds find more by themselves.
HARD    := $(if $(filter release,$(MODE)),-fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
# No contraction, no fast-math: every build must compute the same bits.
FP      := -ffp-contract=off -fno-math-errno -fno-trapping-math
CFLAGS  ?=
CPPFLAGS_ALL := -Icore -Icore/include -DJOX_VERSION='"$(VERSION)"' -D_GNU_SOURCE
# What differs between builds that share objects is known to the files that name it alone, and to tests.
PLACES  := -DJOX_DATADIR='"$(DATADIR)"' -DJOX_PAGEDIR='"$(PAGEDIR)"' -DJOX_THREEDIR='"$(THREEDIR)"'
PLACED  := $(shell grep -lE 'JOX_(DATADIR|PAGEDIR|THREEDIR)' $(SRC_C) $(SRC_CC) $(SRC_CLI))
# Statics of inline functions must not become process-wide symbols.
UNIQUE  := $(shell echo | $(CXX) -fno-gnu-unique -x c++ -E - >/dev/null 2>&1 && echo -fno-gnu-unique)
CFLAGS_ALL  = -std=c17 $(OPT) $(HARD) $(WARN) $(FP) -fPIC -fvisibility=hidden -pthread -MMD -MP $(PKG_CFLAGS) $(CFLAGS)
# At -O3, GCC 12 rounds a sum of a shape's moments otherwise once it puts its scalars into vectors: not for C++,
# which has no loops that cost.
CXXFLAGS_ALL = -std=c++17 $(OPT) $(HARD) -Wall -Wextra $(FP) -fno-tree-slp-vectorize -fPIC -fvisibility=hidden -fno-exceptions -fno-rtti $(UNIQUE) \
           -pthread -MMD -MP $(PKG_CFLAGS) $(CFLAGS)
PKG_CFLAGS := $(shell $(PKG) --cflags $(PKGS) 2>/dev/null | sed 's/-I/-isystem /g')
PKG_LIBS   := $(shell $(PKG) --libs $(PKGS) 2>/dev/null)
LIBS       := $(PKG_LIBS) -lm -pthread
LIBS_jostle       := $(shell $(PKG) --libs $(ENGINE_PKGS) 2>/dev/null) -lm -pthread
LIBS_jostle-tools := $(LIBS)
LINK       := $(if $(filter 0,$(BULLET)),$(CC),$(CXX)) $(OPT) -pthread -Wl,-z,relro,-z,now $(LDFLAGS)

# One short line a file; V=1 shows the commands.
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

.PHONY: reference all run test gallery fuzz fuzzers faults unit tests-built check bench bench-record bench-peers bench-instructions arm matrix soak install install-built uninstall dist deb deb-check clean test-all format
LIBRARIES := jostle jostle-tools
all: $(B)/jostle $(foreach l,$(LIBRARIES),$(B)/lib$(l).a $(B)/lib$(l).so.$(VERSION)) $(B)/lua/jostle.so

# The two commands of the README. Both first install what is missing, and build on all processors.
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
	@B=$(B) SHARED=$(SHARED) .ci/suite check units scenes install page
# Pictures and clips of shipped scenes, as the live page draws them: of those that SCENES names, or all.
gallery:
	@.ci/setup gallery
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) JOSTLE=$(B)/jostle /usr/bin/python3 tests/page/gallery.py build/out/gallery $(filter-out all,$(SCENES))
test-all: test
	JOSTLE_VIEW_CYCLES=10000 $(B)/units view_stream
	@.ci/sanitizers
# The same engine for AArch64, under an emulator (tests/arm).
arm:
	@.ci/setup arm
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) .ci/suite arm
# One hash for all that changes no result: of the scenes that SCENES names.
SCENES ?= all
JUDGE  := awk '{print; fflush()} /^not ok/ {bad = 1} END {exit bad}'
matrix:
	@.ci/setup test
	@$(MAKE) --no-print-directory $(B)/jostle
	@B=$(B) JOSTLE=$(B)/jostle JOSTLE_MATRIX="$(SCENES)" bash tests/scenes/determinism.sh | $(JUDGE)
# The Tawaf with all that goes on beside a run, for so many seconds; then 1,000 reloads and 10,000 page connects.
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
# A line for each scene into the table of this machine's model of processor.
bench-record: all
	@B=$(B) bash tests/bench/record.sh
# Replaces the instruction counts that tests/scenes/instructions.sh compares: after a deliberate change.
bench-instructions: all
	@B=$(B) JOSTLE=$(B)/jostle bash tests/scenes/instructions.sh --write
# Other engines on the same crowds, in turn with ours.
PEERS := $(patsubst tests/bench/peers/%.cc,$(B)/bench/peer-%,$(wildcard tests/bench/peers/*.cc))
bench-peers:
	@.ci/setup peers
	@$(MAKE) --no-print-directory $(PEERS)
	@for peer in $(PEERS); do $$peer || exit 1; done
check:
	@.ci/setup test
	@$(MAKE) --no-print-directory all
	@B=$(B) SHARED=$(SHARED) .ci/suite check
tests-built: $(B)/units
# Fuzzers: TIME seconds each, of all or of the one that FUZZ names; by libFuzzer, in a build of their own.
TIME ?= 60
fuzz:
	@.ci/setup test
	@$(MAKE) --no-print-directory MODE=fuzz fuzzers
	@B=build/fuzz TIME=$(TIME) bash tests/fuzz/run.sh $(FUZZ)
fuzzers: $(FUZZERS) $(B)/jostle
# One thing fails, the n-th each time: FAULTS of them for each command and part, or all.
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
# Kernels, and what has loops over numbers that become vector operations, of the same bits.
VECTORISED := core/record/fields/density core/record/fields/density_put core/record/fields/density_diffuse \
           core/world/guard core/world/statistics core/agents/agents core/force/stages/forces core/force/push/pass_on core/force/contact/crush_load \
           core/machine/group core/machine/think core/machine/target core/nav/near/perceive core/nav/move/move \
           $(foreach k,$(SRC_WIDE:%.c=%),$(ISAS:%=$k.%))
$(VECTORISED:%=$(SHARED)/%.o): OPT += $(if $(filter release,$(MODE)),-O3)
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
$(B)/jostle: $(OBJ_CLI) $(B)/internal.a
	$(call say,LINK,$@)
	$(Q)$(LINK) $^ -o $@ $(LIBS)
# What leaves the libraries: the public calls alone. Hidden symbols become local.
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
# The module of Lua, for programs that are run by an interpreter of theirs: `require "jostle"`.
LUA_MODULE := $(patsubst scripts/lua/%.c,$(B)/lua/%.o,$(wildcard scripts/lua/*.c))
$(LUA_MODULE): $(B)/lua/%.o: scripts/lua/%.c Makefile
	$(call compile,LUA,$(CC),$(CFLAGS_ALL))
$(B)/lua/jostle.so: $(LUA_MODULE) $(B)/libjostle.a
	$(call say,LINK,$@)
	$(Q)$(LINK) -shared -Wl,--as-needed -Wl,--exclude-libs,ALL $(LUA_MODULE) $(B)/libjostle.a -o $@ $(LIBS_jostle)
# A unit test is a program of its own; $(B)/units is all of them in one, which is linked once: `units NAME...`
# runs those, in the place of their main.
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
# In builds by libFuzzer its main drives a target, in others tests/fuzz/support/replay.c.
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

# Pages and files for editors, made of the tables of words and keys; `make check` compares them.
reference: all
	@for page in $(REFERENCE); do $(B)/jostle reference $${page%%:*} > $${page#*:}; done
REFERENCE := behaviours:scripts/behaviour.md scenes:scripts/scene.md lua-ls:scripts/editor/jostle.lua \
           luacheck:scripts/editor/luacheckrc luacheck:.luacheckrc \
           scene-schema:scripts/scene.schema.json mod-schema:scripts/mod.schema.json inputs:scripts/input.md manual:scripts/jostle.1
# Unit tests alone, each in a process of its own: `make unit`, or `make unit ONLY="base geom"` for some folders.
unit: $(B)/units
	@failed=0; for u in $(notdir $(UNIT)); do $(B)/units $$u || failed=$$((failed + 1)); done; \
	    echo "$(words $(UNIT)) tests, $$failed failed"; [ $$failed = 0 ]
# Installed files know where the library's Lua lies, so that each PREFIX is built apart.
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
	install -d $(D)/share/jostle/page
	if [ -d core/view/page ]; then cp -R core/view/page/. $(D)/share/jostle/page; fi
	for d in scripts behaviours scenes; do install -d $(D)/share/jostle/$$d; cp -R $$d/. $(D)/share/jostle/$$d; done
	rm -rf $(D)/share/jostle/scripts/debian $(D)/share/jostle/scripts/python $(D)/share/jostle/scripts/lua
uninstall:
	rm -rf $(D)/share/jostle
	rm -f $(D)/bin/jostle $(L)/lua/5.4/jostle.so $(LIBRARIES:%=$(L)/lib%.a) $(LIBRARIES:%=$(L)/lib%.so*) $(HEADERS:core/%=$(D)/%)
	rm -f $(LIBRARIES:%=$(L)/pkgconfig/%.pc) $(D)/share/man/man1/jostle.1
# build/out/jostle-VERSION.tar.gz: what is committed, the same bytes each time, and its sum.
DIST := build/out/jostle-$(VERSION).tar.gz
dist:
	@mkdir -p build/out
	git archive --format=tar --prefix=jostle-$(VERSION)/ HEAD | gzip -n9 > $(DIST)
	cd build/out && sha256sum $(notdir $(DIST)) > SHA256SUMS
# Debian packages of that archive, in build/deb; `make deb-check` looks at them with lintian and runs what is
# installed from them in a root of its own.
deb: dist
	@.ci/setup deb
	rm -rf build/deb && mkdir -p build/deb
	tar -xzf $(DIST) -C build/deb
	cp -R build/deb/jostle-$(VERSION)/scripts/debian build/deb/jostle-$(VERSION)/debian
	cd build/deb/jostle-$(VERSION) && DEB_BUILD_OPTIONS=parallel=$$(nproc) dpkg-buildpackage -us -uc -b
deb-check: deb
	@bash tests/deb/run.sh build/deb
clean:
	rm -rf build
format:
	clang-format -i $$(git ls-files 'core/*.[ch]' 'core/*.cc' 'tests/*.[ch]' 'tests/*.cc')

-include $(shell find $(sort $(B) $(SHARED)) -name '*.d' 2>/dev/null)
