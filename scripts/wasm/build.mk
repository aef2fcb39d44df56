# Builds the engine as WebAssembly modules, without and with threads, in build/wasm/out with their JavaScript (README.md). `make wasm` runs
# it, after it has unpacked the sources of the libraries. It is the Makefile with another compiler and fewer folders:
# clang is called without emcc's wrapper, which takes longer to start than most files to compile, and emcc links.
.DEFAULT_GOAL := wasm-module
WASM_SOURCES := build/wasm/sources
# emcc of Debian is a Python script whose JavaScript part needs modules of Debian's own folder.
export NODE_PATH := /usr/share/nodejs
# longjmp by the exceptions of WebAssembly, which cost nothing until one is thrown.
WASM_LONGJMP := -sSUPPORT_LONGJMP=wasm
WASM_CCACHE  := $(shell command -v ccache)
WASM_CFLAGS  := $(shell emcc $(WASM_LONGJMP) --cflags)
# Without stack coloring: with it, clang 14 reads lanes from a slot of the stack that another array has overwritten.
WASM_CODE    := -msimd128 -mllvm -no-stack-coloring
, := ,
override CC  := $(WASM_CCACHE) clang $(WASM_CFLAGS) $(WASM_CODE)
override CXX := $(WASM_CCACHE) clang++ $(WASM_CFLAGS) $(WASM_CODE)
# THREADED=1 builds the module with threads, of the other module's objects and of some of its own (below).
override B       := build/wasm/$(if $(THREADED),threads,release)
override CAIRO   := 0
override ZIP     := 0
override VIEW    := worker
override WATCH   := 0
override HARD    :=
override THREADS := $(if $(THREADED),-pthread)
override PIC     :=
override ISAS    := scalar wasm
override DATADIR := /jostle
override PAGEDIR := /jostle/page
# Folders of the engine, and of the tools those that the module calls.
override ONLY := base base/number base/format simd task geom geom/field geom/ground agents nav/spots nav nav/near nav/walk nav/orca \
    nav/move force force/push force/support force/contact force/stages body machine machine/steering world/input \
    world/step_events world/routes world world/verbs world/embed scene/format scene/wall_files scene scene/reference lua/vm lua/language \
    lua record/fields record record/probes record/danger view picture run/watch run run/resume run/results run/why run/mods live validate wasm
override PKG_CFLAGS := -isystem $(WASM_SOURCES)/lua5.4/src -isystem $(WASM_SOURCES)/libyaml/include -isystem $(WASM_SOURCES)/expat/expat/lib \
    -isystem $(WASM_SOURCES)/cjson -isystem $(WASM_SOURCES)/bullet/src -isystem build/wasm/include
# What a browser's tab has no use or no means for: sandboxing, child processes, the reproduction of claims.
WASM_LEFT_OUT := core/base/confine% core/task/children.c core/validate/repro%
include Makefile
OBJ := $(filter-out $(foreach s,$(WASM_LEFT_OUT),$(B)/$(basename $(s)).o),$(OBJ))

# ---- libraries ----
LIB_C := $(filter-out %/lua.c %/luac.c,$(wildcard $(WASM_SOURCES)/lua5.4/src/*.c)) $(wildcard $(WASM_SOURCES)/libyaml/src/*.c) \
    $(addprefix $(WASM_SOURCES)/expat/expat/lib/,xmlparse.c xmlrole.c xmltok.c) $(WASM_SOURCES)/cjson/cJSON.c
LIB_CC := $(foreach d,LinearMath BulletCollision/BroadphaseCollision BulletCollision/CollisionDispatch BulletCollision/CollisionShapes \
    BulletCollision/NarrowPhaseCollision BulletDynamics/ConstraintSolver BulletDynamics/Dynamics,$(wildcard $(WASM_SOURCES)/bullet/src/$(d)/*.cpp))
LIB_OBJ := $(LIB_C:$(WASM_SOURCES)/%.c=$(B)/lib/%.o) $(LIB_CC:$(WASM_SOURCES)/%.cpp=$(B)/lib/%.o)
# Headers that Debian's packages put elsewhere than their sources do. Of SQLite only the header is used (core/wasm/no_sqlite.c).
WASM_INCLUDE := build/wasm/include
$(WASM_INCLUDE)/.made:
	@mkdir -p $(@D)
	@echo '#define DEB_HOST_MULTIARCH "wasm32"' >$(@D)/lua5.4-deb-multiarch.h
	@touch $(@D)/expat_config.h # LIB_FLAGS has what it would say
	@cp /usr/include/sqlite3.h $(@D)/
	@touch $@
$(OBJ) $(LIB_OBJ): scripts/wasm/build.mk | $(WASM_INCLUDE)/.made
LIB_FLAGS := -DYAML_VERSION_STRING='"0.2.5"' -DYAML_VERSION_MAJOR=0 -DYAML_VERSION_MINOR=2 -DYAML_VERSION_PATCH=5 \
    -DXML_NS -DXML_DTD -DXML_CONTEXT_BYTES=1024 -DBYTEORDER=1234 -DHAVE_GETRANDOM -DNDEBUG -D_GNU_SOURCE -w
$(B)/lib/%.o: $(WASM_SOURCES)/%.c
	@mkdir -p $(@D)
	$(call say,LIB,$<)
	$(Q)$(CC) -O2 $(FP) $(LIB_FLAGS) $(PKG_CFLAGS) -c $< -o $@
$(B)/lib/%.o: $(WASM_SOURCES)/%.cpp
	@mkdir -p $(@D)
	$(call say,LIB,$<)
	$(Q)$(CXX) -O2 $(FP) -fno-exceptions -fno-rtti -DNDEBUG -w $(PKG_CFLAGS) -c $< -o $@

# ---- the module with threads ----
# Objects without atomic operations and without variables of threads serve both modules. The others, some 20, say in the
# release that they are unfit for shared memory, and are compiled once more; the linker refuses what this misses.
ifdef THREADED
UNSHARED := $(shell grep -l shared-mem $(patsubst $(B)/%,build/wasm/release/%,$(OBJ) $(LIB_OBJ)))
OBJ := $(foreach o,$(OBJ:$(B)/%=build/wasm/release/%),$(if $(filter $(o),$(UNSHARED)),$(o:build/wasm/release/%=$(B)/%),$(o)))
LIB_OBJ := $(LIB_OBJ:$(B)/%=build/wasm/release/%)
endif

# ---- the module ----
WASM_OUT := build/wasm/out
WASM_NAME := jostle$(if $(THREADED),-threads)
WASM_LINK := -O2 $(WASM_LONGJMP) $(if $(THREADED),-pthread -sPTHREAD_POOL_SIZE_STRICT=2 -Wno-pthreads-mem-growth) -sMODULARIZE=1 -sEXPORT_ES6=1 -sENVIRONMENT=web,worker \
    -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sINITIAL_MEMORY=32MB -sSTRICT=1 -sFILESYSTEM=1 -sFORCE_FILESYSTEM=1 -sNO_EXIT_RUNTIME=1 \
    -sINCOMING_MODULE_JS_API=instantiateWasm,print,printErr$(if $(THREADED),$(,)wasmMemory) \
    -sEXPORTED_FUNCTIONS=_malloc,_free -sEXPORTED_RUNTIME_METHODS=FS,UTF8ToString,stringToUTF8,lengthBytesUTF8 --no-entry
$(WASM_OUT)/$(WASM_NAME).mjs: $(OBJ) $(LIB_OBJ)
	@mkdir -p $(@D)
	$(call say,LINK,$@)
	$(Q)em++ $(WASM_LINK) $^ -o $@
	@rm -f $(WASM_OUT)/$(WASM_NAME).worker.js # thread.mjs is in its place
ifndef THREADED
$(WASM_OUT)/jostle-threads.mjs: $(OBJ) $(LIB_OBJ)
	$(Q)+$(MAKE) --no-print-directory -f scripts/wasm/build.mk THREADED=1 $@
endif
$(WASM_OUT)/%.mjs: scripts/wasm/%.mjs
	@mkdir -p $(@D)
	@cp $< $@
$(WASM_OUT)/shipped.json: scripts/wasm/shipped.mjs $(wildcard scripts/*.lua behaviours/*.lua scenes/*.* scenes/mods/*/*)
	@mkdir -p $(@D)
	$(call say,TEXT,$@)
	$(Q)node $< >$@.part && mv $@.part $@
# Licences of what the module contains.
$(WASM_OUT)/licences.txt: LICENSE $(LIB_OBJ)
	@mkdir -p $(@D)
	$(Q)for source in LICENSE $(WASM_SOURCES)/*/debian/copyright; do printf '==== %s\n\n' "$$source"; cat "$$source"; echo; done >$@.part
	@sed -i 's,^==== $(WASM_SOURCES)/\([^/]*\)/.*,==== \1,; s,^==== LICENSE,==== jostle,' $@.part && mv $@.part $@
wasm-module: $(addprefix $(WASM_OUT)/,licences.txt jostle.mjs jostle-threads.mjs shipped.json arguments.mjs engine.mjs folders.mjs load.mjs memory.mjs thread.mjs threads.mjs)
wasm-objects: $(OBJ) $(LIB_OBJ)
# The unit test of the lanes, as a program for Node.js.
WASM_LANES := build/wasm/test/lanes.cjs
$(WASM_LANES): tests/unit/simd_lanes.c tests/wasm/cmocka/cmocka.h core/simd/lanes_wasm.h $(B)/core/simd/packed.o
	@mkdir -p $(@D)
	$(call say,TEST,$<)
	$(Q)$(CC) $(CPPFLAGS_ALL) -std=c17 -O2 $(FP) -Itests/wasm/cmocka -Itests -c $< -o $(@D)/lanes.o
	$(Q)emcc -O1 -sENVIRONMENT=node -sSINGLE_FILE=1 $(@D)/lanes.o $(B)/core/simd/packed.o -o $(@D)/lanes.js && mv $(@D)/lanes.js $@
wasm-tests-built: $(WASM_LANES)
# The npm package, made of these and of scripts/npm.
NPM := build/wasm/npm
wasm-npm: wasm-module
	@rm -rf $(NPM) && mkdir -p $(NPM) build/out
	@cp -R scripts/npm/. $(NPM)/ && cp $(WASM_OUT)/* $(NPM)/
	@sed -i 's/VERSION/$(VERSION)/' $(NPM)/package.json $(NPM)/README.md
	$(call say,NPM,build/out/jostle-$(VERSION).tgz)
	$(Q)cd $(NPM) && npm pack --silent --pack-destination=../../out >/dev/null
.PHONY: wasm-module wasm-objects wasm-npm wasm-tests-built
