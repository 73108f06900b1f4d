# A thin front of CMake. `make help` lists the targets.
BUILD ?= build
JOBS  ?= $(shell nproc)
PREFIX ?= /usr/local

.PHONY: all packages programs demo test gallery site reproduce reproduce-full reference reference-check ranks bench bench-estimates install clean help sanitize
all: ## build/scree and libscree (static and shared)
	@mkdir -p $(BUILD)
	@cmake --preset release -B $(BUILD) >$(BUILD)/configure.log 2>&1 || \
	    { bash cmake/packages.sh --check && cat $(BUILD)/configure.log; exit 1; }
	@cmake --build $(BUILD) -j $(JOBS)

packages: ## install missing Debian packages (root or sudo), or say which
	@bash cmake/packages.sh

demo: packages ## the main job, with figures: a biaxial test past its peak, into out-demo/
	@$(MAKE) --no-print-directory all
	@bash cmake/demo.sh $(BUILD)/scree out-demo

test: packages ## all tests
	@$(MAKE) --no-print-directory all
	@cd $(BUILD) && ctest --output-on-failure -j $(JOBS)

programs: ## install what some published experiments are compared with, or go on without
	@bash cmake/packages.sh --reproduce

reproduce: all programs ## the published experiments in their quick forms, compared in docs/reproduction.md
	@$(BUILD)/scree reproduce -o out-reproduce/quick; status=$$?; \
	    $(BUILD)/scree report out-reproduce -o docs/reproduction.md || status=$$?; exit $$status

# A copy of the program, so that building does not change what goes on running; what decides most comes first.
FIRST = biaxial-preparation biaxial-boundaries biaxial-timescales biaxial-timescales-large
reproduce-full: all programs ## the same with the sources' own numbers: many hours; interrupt it and call it again
	@! git rev-parse -q --verify HEAD >/dev/null 2>&1 || git diff --quiet HEAD || \
	    { echo "make reproduce-full: files differ from the commit that the runs would name: commit them first" >&2; exit 2; }
	@mkdir -p out-reproduce && cp $(BUILD)/scree out-reproduce/scree.new && mv out-reproduce/scree.new out-reproduce/scree
	@bash cmake/records.sh restore out-reproduce/full records; \
	for only in $(FIRST:%=--only=%) ""; do \
	    out-reproduce/scree reproduce --full $$only -o out-reproduce/full; status=$$?; [ $$status -ne 130 ] || break; \
	done; \
	    bash cmake/records.sh keep out-reproduce/full records; \
	    $(BUILD)/scree report out-reproduce -o docs/reproduction.md || status=$$?; exit $$status

reference: all ## store the state checksums anew: after a change that means to alter bits, and says so in CHANGELOG.md
	@$(BUILD)/tests/write_reference >$(BUILD)/small.txt && cp $(BUILD)/small.txt tests/reference/small.txt
	@bash tests/reference/quick.sh $(BUILD)/scree write

reference-check: all ## the built-in cases in their quick forms against the stored checksums: minutes
	@bash tests/reference/quick.sh $(BUILD)/scree compare

ranks: ## the built-in cases on 1 to 8 processes x 1, 2 threads against each other and the stored checksums (preset mpi): hours
	@cmake --preset mpi >/dev/null && cmake --build build-mpi -j $(JOBS) --target scree_cli
	@bash tests/reference/ranks.sh build-mpi/scree ranks.txt; bash tests/reference/ranks.sh --table ranks.txt

bench: all ## particle-steps per second, memory, and peers where they are installed
	@cmake --build $(BUILD) -j $(JOBS) --target benches
	@bash bench/run.sh $(BUILD)

bench-estimates: all ## what `scree check` promises against what runs take: minutes
	@bash bench/check_estimates.sh $(BUILD)/scree

sanitize: packages ## the tests under the address, undefined and thread sanitizers
	@for p in asan tsan; do cmake --preset $$p >/dev/null && cmake --build --preset $$p -j $(JOBS) && ctest --preset $$p -j $(JOBS) || exit 1; done

gallery: all ## docs/gallery.md and its pictures anew: runs of some seconds each, in all some minutes
	@bash docs/make_gallery.sh $(BUILD)/scree

site: ## the documentation as pages for a browser, with search, into build-site/
	@bash cmake/packages.sh --site
	@bash cmake/site.sh build-site

install: all ## into PREFIX (default /usr/local)
	@cmake --install $(BUILD) --prefix $(PREFIX)

clean: ## remove what was built
	@rm -rf build build-dev build-asan build-tsan build-clang build-mpi build-site out-demo

help: ## this list
	@grep -E '^[a-z-]+:.*##' Makefile | sed -E 's/:[^#]*## /\t/' | expand -t 18
