/* Errors of scenes: code, exact position and hint of each kind of error; all are reported
   at once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene_texts.h"

static const JoxErrorCase CASES[] = {
    {"@seeed: 3\n" GROUP, "unknown-key", "Did you mean 'seed'?"},
    /* Texts with zero bytes, and bytes that are no characters. */
    {"title: @\"a\\0b\"\n" GROUP, "bad-text", "Take \\0 or"},
    {"title: @\"a\\x00b\"\n" GROUP, "bad-text", "Take \\0 or"},
    {"title: x\n@\"se\\0ed\": 3\n" GROUP, "bad-text", "Take \\0 or"},
    {"title: [1, @\"\\u0000\"]\n" GROUP, "bad-text", "Take \\0 or"},
    {"title: x\n# K\xc3\xa4se, gr\xc3\xbc\xc3\x9f@\xe9\n" GROUP, "bad-text", "Latin-1"},
    {"title: @\xff\n" GROUP, "bad-text", "Save the file as UTF-8"},
    {"title: \xc3\xa4@\xed\xa0\x80\n" GROUP, "bad-text", "Save the file as UTF-8"},
    {"title: x\ntitel: \xc3\xa4@\x01\n" GROUP, "bad-yaml", "Take it out"},
    {"title: x\n" GROUP "# @\xc3", "bad-text", "Save the file as UTF-8"},
    {"forces: {enabled: true, @mood: literal}\n" GROUP, "unknown-key", "Did you mean 'mode'?"},
    {"step: @fast\n" GROUP, "bad-type", "Numbers are in SI units"},
    {"step: @[1]\n" GROUP, "bad-type", NULL},
    {"step: @0x1\n" GROUP, "bad-type", "Numbers are in SI units"},
    {"step: @3 kg\n" GROUP, "bad-unit", "Units here: s, ms, min, h"},
    {"step: @0.05 furlong\n" GROUP, "bad-unit", "Units here: s, ms, min, h"},
    {"step: @0\n" GROUP, "out-of-range", NULL},
    {"step: @nan\n" GROUP, "out-of-range", NULL},
    {"gravity: @1e300\n" GROUP, "out-of-range", NULL},
    {"gravity: @1e999\n" GROUP, "out-of-range", NULL},
    {"seed: @1.5\n" GROUP, "bad-type", NULL},
    {"forces: {enabled: @maybe}\n" GROUP, "bad-type", NULL},
    {"forces: {mode: @soft}\n" GROUP, "bad-value", NULL},
    {"places:\n  a: {polygon: [[0, 0], [1, 1], @[1, 0], [0, 1]]}\n" GROUP, "self-crossing",
     "Put the corners in order"},
    {"places: {a: {polygon: [[0, 0], [1, 1], @[1, 0], [0, 1]]}}\n" WITH("count: 3, in: a"),
     "self-crossing", NULL},
    {WITH("at: [[0, 0]], colour: @vermillion"), "bad-value", "Did you mean 'vermilion'?"},
    {WITH("at: [[0, 0]], colour: @'#12345'"), "bad-value", "or \"#rrggbb\" in quotes"},
    {WITH("at: [[0, 0]], colour: @[1, 0, 0]"), "bad-value", "blue, orange,"},
    {"groups:\n  g:\n    behaviour: stander\n    at: [[0, 0]]\n    colour:@ #123456\n", "bad-value",
     "or \"#rrggbb\" in quotes"},
    {"places:\n  a: {polygon: @[[0, 0], [1, 1]]}\n" GROUP, "bad-type", "[[0, 0], [1, 0], ...]"},
    {"places:\n  a: {point: [@1e300, 0]}\n" GROUP, "out-of-range", NULL},
    {"places:\n  a: {line: [[@nan, 0], [1, 1]]}\n" GROUP, "out-of-range", NULL},
    {"places: {a: {point: @5}, b: {point: [0, 0], radius: 9}, s: {set: [a, b]}}\n" WITH(
         "count: 3, in: [b, s], outside: a"),
     "bad-type", "[x, y]"},
    {"places: {a: @{set: []}}\n" GROUP, "bad-place", "set: [NAME, NAME]"},
    {"places: @[a, b]\n" GROUP, "bad-type", NULL},
    {"regions: @7\n" GROUP, "bad-type", NULL},
    {"walking: {@wall_radius: 0.6}\n" GROUP, "unknown-key", "See wall_reach"},
    {"sinks: @5\n" GROUP, "bad-type", NULL},
    {"sources: @{rate: 3}\n" GROUP, "bad-type", NULL},
    {SQUARE "sources: [{at: @[box], like: g, rate: 1}]\n" GROUP, "bad-type", NULL},
    {SQUARE "sources: [{at: box, like: @gg, rate: 1}]\n" GROUP, "unknown-group",
     "Did you mean 'g'?"},
    {"probes: @[a]\n" GROUP, "bad-type", "probes: {door"},
    {"probes: {a: @{}}\n" GROUP, "bad-probe", NULL},
    {"probes: {a: @{flow: [[0, 0], [1, 0]], winding: [0, 0]}}\n" GROUP, "bad-probe", NULL},
    {"probes: {a: {@flaw: [[0, 0], [1, 0]], failures: 1}}\n" GROUP, "unknown-key",
     "Did you mean 'flow'?"},
    {"probes: {a: {flow: @[[0, 0], [0, 0]]}}\n" GROUP, "bad-probe", "Nobody crosses a point"},
    {"probes: {a: {flow: @[[0, 0], [1, 0], [2, 0]]}}\n" GROUP, "bad-probe", "[[0, 0], [0, 2]]"},
    {"probes: {a: {flow: @[[0, 0]]}}\n" GROUP, "bad-type", NULL},
    {"probes: {a: {transit: @[[[0, 0], [0, 2]]]}}\n" GROUP, "bad-type", "transit: ["},
    {"probes: {a: {transit: [[[0, 0], [0, 2]], @[[5, 0], [5, 0]]]}}\n" GROUP, "bad-probe", NULL},
    {"probes: {a: {measure: @[[0, 0], [1, 0]]}}\n" GROUP, "bad-type", NULL},
    {"probes: {a: {measure: [[0, 0], [1, 0], @[2, 0]]}}\n" GROUP, "self-crossing", NULL},
    {"probes: {a: {measure: [[0, 0], [1, 1], @[1, 0], [0, 1]]}}\n" GROUP, "self-crossing", NULL},
    {"probes: {a: {failures: 1, group: @gg}}\n" GROUP, "unknown-group", "Did you mean 'g'?"},
    {"probes: {a: {failures: @0}}\n" GROUP, "out-of-range", NULL},
    {"probes: {a: {failures: 1, from: 5, until: @5}}\n" GROUP, "bad-probe", NULL},
    {"probes: {a: {failures: 1, cutoff: @2}}\n" GROUP, "bad-probe", "Leave it out"},
    {"probes: {a: {displacement: @false}}\n" GROUP, "bad-probe", "Take the probe away"},
    {"probes: {a: {displacement: true, along: @[0, 0]}}\n" GROUP, "bad-probe", "[1, 0]"},
    {"probes: {a: {winding: @5}}\n" GROUP, "bad-type", "[x, y]"},
    {"probes: {a: {map: {area: @[[0, 0], [0, 1]]}}}\n" GROUP, "no-area", NULL},
    {"probes: {a: {map: {cell: @0}}}\n" GROUP, "out-of-range", NULL},
    {"probes: {a: {lanes: @{rows: 1}}}\n" GROUP, "missing-key", NULL},
    {"probes: {a: {lanes: {area: [[0, 0], [1, 1]], along: @z}}}\n" GROUP, "bad-value", NULL},
    {"probes: {@density: {failures: 1}}\n" GROUP, "bad-name", "Choose another"},
    {"probes: {@../a: {failures: 1}}\n" GROUP, "bad-name", "Letters, digits"},
    {"groups: {@\"`id > x`\": {behaviour: stander, at: [[0, 0]]}}\n", "bad-name",
     "Letters, digits"},
    {"groups: {@\"\": {behaviour: stander, at: [[0, 0]]}}\n", "bad-name", "Letters, digits"},
    {"groups: {@\"\\U0001F600\": {behaviour: stander, at: [[0, 0]]}}\n", "bad-name", NULL},
    {"groups: {@\"right\\u202eleft\": {behaviour: stander, at: [[0, 0]]}}\n", "bad-name", NULL},
    {"places: {@\"a'b\": {point: [0, 0]}}\n" GROUP, "bad-name", "Letters, digits"},
    {"regions: {@a<b: [[0, 0], [1, 0], [1, 1]]}\n" GROUP, "bad-name", "Letters, digits"},
    {WITH("at: [[0, 0]], team: @\"red; drop\""), "bad-name", "Letters, digits"},
    {WITH("at: [[0, 0]], tags: [good, @$(x)]"), "bad-name", "Letters, digits"},
    {"walls: [{line: [[0, 3], [2, 3]], name: @\" gate\"}]\n" GROUP, "bad-name", NULL},
    {"bodies: [{name: @-x, shape: {box: {size: [1, 1, 1]}}, mass: 9, at: [5, 5, 1]}]\n" GROUP,
     "bad-name", NULL},
    {"player: @[g]\n" GROUP, "bad-type", NULL},
    {"groups: {g: {behaviour: @nobody.lua, at: [[0, 0]]}}\n", "missing-file", "Looked beside"},
    {"groups: {g: {mix: @5, at: [[0, 0]]}}\n", "bad-type", "mix: {"},
    {"groups: {g: {mix: {stander: @-1}, at: [[0, 0]]}}\n", "out-of-range", NULL},
    {"places: {mataf: {point: [0, 0]}}\n" WITH("count: 3, in: @matafs"), "unknown-place",
     "Did you mean 'mataf'?"},
    {"seed: 1\n@seed: 2\n" GROUP, "duplicate-key", "Keep one of them"},
    {"title: @*nothing\n" GROUP, "unknown-anchor", NULL},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, mass: @-4, at: [0, 0, 1]}\n", "out-of-range",
     NULL},
    {"bodies:\n  - {shape: @{}, mass: 4, at: [0, 0, 1]}\n", "bad-shape", "sphere"},
    {"bodies:\n  - @{mass: 4, at: [0, 0, 1]}\n", "missing-key", "one of box"},
    {"bodies:\n  - {shape: {hull: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, @1e300]]}}, "
     "mass: 1, at: [0, 0, 1]}\n",
     "out-of-range", NULL},
    {WITH("at: [[0, 0]], set: {mass: @-5}"), "out-of-range", NULL},
    {WITH("at: [[0, 0]], set: {mass: @'uniform(60, -5)'}"), "bad-distribution", "normal("},
    {WITH("at: [[0, 0]], set: {mass: @'uniform(-5, 60)'}"), "out-of-range", NULL},
    {WITH("at: [[0, 0]], set: {mass: @'choose(70, -5)'}"), "out-of-range", NULL},
    {WITH("at: [[0, 0]], set: {speed: @'normal(1)'}"), "bad-distribution", "normal("},
    {WITH("at: [[0, 0]], set: {speed: @nan}"), "bad-type", "uniform("},
    {WITH("at: [[0, 0]], set: {speed: @3 kg}"), "bad-unit", "Units here: m/s, km/h"},
    {WITH("at: [[0, 0]], memory: {laps: @3 kg}"), "bad-type", "uniform("},
    {WITH("at: [[0, 0]], set: {speed: @[1]}"), "bad-type", "uniform("},
    {WITH("at: [[0, 0]], set: {goal: @nowhere}"), "unknown-place", NULL},
    {SQUARE WITH("count: @0, in: box"), "out-of-range", "where a source is like it"},
    {SQUARE "sources: [{at: box, like: g, rate: 1}]\n" WITH("count: @-1"), "out-of-range", NULL},
    {SQUARE "sources: [{at: box, like: @g, rate: 1}]\n" WITH("at: [[0, 0]], set: {goal: antipode}"),
     "bad-value", "bound for a place"},
    {WITH("starts: @5"), "bad-type", "starts: [["},
    {WITH("starts: @[]"), "bad-type", "starts: [["},
    {WITH("starts: [[0, 1, 2], @[3, 1]]"), "bad-type", "[0, 1.5, 2]"},
    {WITH("starts: [[0, 1, 2], @[3, 1, 1, 2]]"), "bad-type", "[0, 1.5, 2]"},
    {WITH("starts: [[@-1, 1, 2]]"), "out-of-range", NULL},
    {WITH("starts: [[0, 1, 2, 0, @-50]]"), "out-of-range", NULL},
    {WITH("starts: [[0, 1, @2 s]]"), "bad-unit", "Units here: m"},
    {WITH("starts: [[0, 1, @wall]]"), "bad-type", NULL},
    {"bounds: [[0, 0], [5, 5]]\n" WITH("starts: [[0, 1, 1], @[9, 9, 9]]"), "out-of-bounds", NULL},
    {WITH("starts: @[[0, 1, 2]], set: {goal: antipode}"), "bad-value", "bound for a place"},
    {"groups:\n  g: @{behaviour: stander, starts: [[0, 1, 2]], count: 3}\n", "too-many-keys",
     "Each start is one agent"},
    {SQUARE WITH("count: 3, in: box, fill: @hexx"), "bad-value", "Did you mean 'hex'?"},
    {SQUARE "groups:\n  g: @{behaviour: stander, count: 100, in: box, spacing: 1}\n", "too-many",
     "Lower count"},
    {"places: {a: {point: [0, 0], radius: 1000}}\ngroups:\n  a: &a {behaviour: stander, count: "
     "600000, fill: circle, in: a}\n  b: {<<: *a, count: @400001}\n",
     "too-many", NULL},
    {"bounds: [[0, 0], [5, 5]]\n" WITH("at: [[1, 1], @[9, 9]]"), "out-of-bounds", NULL},
    {"bounds: @[[0, 0], [0, 5]]\n" GROUP, "no-area", NULL},
    {"<<: @5\n" GROUP, "bad-merge", NULL},
    {"title: @]\n" GROUP, "bad-yaml", "Check indentation"},
    {"places:\n@\there: {point: [0, 0]}\n" GROUP, "tab", "Indent by spaces"},
    {"places:\n  here:\n  @\tpoint: [0, 0]\n" GROUP, "tab", "Indent by spaces"},
    {"title: a\n---\n@title: b\n", "bad-yaml", NULL},
    {"@[a, b]: 3\n" GROUP, "bad-key", NULL},
    {"include: @{a: b}\n" GROUP, "bad-type", "include: other.yaml"},
    {"include: @gone.yaml\n" GROUP, "unreadable-file", NULL},
    {"forces: @soft\n" GROUP, "bad-type", NULL},
    {"title: @[a]\n" GROUP, "bad-type", NULL},
    {"places: {a: @{radius: 3}}\n" GROUP, "bad-place", NULL},
    {"places: {a: @{point: [0, 0], line: [[0, 0], [1, 1]]}}\n" GROUP, "bad-place", NULL},
    {"places: {a: {line: @[[0, 0], [1, 1], [2, 0]]}}\n" GROUP, "bad-place", "A polyline"},
    {"places: {a: {line: [[0, 0], @[1]]}}\n" GROUP, "bad-type", "[x, y]"},
    {"places:\n  b: {point: [0, 0]}\n  a: {polygon: [[0, 0], [2, 0], [0, 2]], start: @b}\n" GROUP,
     "bad-place", NULL},
    {"places: {a: {point: [0, 0]}, b: {set: [a]}, c: {set: [a, @b]}}\n" GROUP, "bad-place", NULL},
    {"places: {a: {polygon: @[[0, 0], [1e-4, 0], [0, 1e-4]]}}\n" GROUP, "no-area", NULL},
    {"places: {a: {point: [0, 0]}, b: {set: [a, @[a]]}}\n" GROUP, "bad-type", NULL},
    {"walls: @{line: [[0, 0], [1, 1]]}\n" GROUP, "bad-type", NULL},
    {"walls:\n  - @{height: 2}\n" GROUP, "bad-wall", NULL},
    {"walls:\n  - @{line: [[0, 0], [1, 1]], solid: [[0, 0], [2, 0], [0, 2]]}\n" GROUP, "bad-wall",
     NULL},
    {"walls: [@5]\n" GROUP, "bad-type", NULL},
    {"bodies: @{mass: 4}\n" GROUP, "bad-type", NULL},
    {"bodies:\n  - @{shape: {sphere: {radius: 1}}, mass: 4, density: 9, at: [0, 0, 1]}\n",
     "bad-body", NULL},
    {"bodies:\n  - {shape: @{sphere: {radius: 1}, box: {size: [1, 1, 1]}}, at: [0, 0, 1]}\n",
     "bad-shape", "{sphere: {radius: 0.1}}"},
    {"bodies:\n  - {shape: {compound: [{shape: @{compound: []}}]}, at: [0, 0, 1]}\n", "bad-shape",
     NULL},
    {"bodies:\n  - {shape: {compound: @[]}, at: [0, 0, 1]}\n", "bad-type", NULL},
    {"bodies:\n  - {shape: {hull: {points: @[[0, 0, 0]]}}, at: [0, 0, 1]}\n", "bad-type",
     "[[0, 0, 0], ...]"},
    {"bodies:\n  - {shape: {sphere: {@radios: 1, radius: 1}}, at: [0, 0, 1]}\n", "unknown-key",
     "Did you mean 'radius'?"},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: @[0, 1]}\n", "bad-type", "[x, y, z]"},
    {"bodies:\n  - {shape: {blocks: {size: [1, 1, 1], count: [2, @1.5, 1], bond: 9}}, at: [0, 0, "
     "1]}\n",
     "bad-type", NULL},
    {"bodies:\n  - {shape: {blocks: {size: [1, 1, 1], count: [2, @0, 1], bond: 9}}, at: [0, 0, "
     "1]}\n",
     "out-of-range", NULL},
    {"bodies:\n  - {shape: {blocks: {size: [1, 1, 1], count: @[99, 99, 1], bond: 9}}, at: [0, 0, "
     "1]}\n",
     "out-of-range", NULL},
    {"bodies:\n  - {shape: {blocks: {size: [1, 1, 1], count: [2, 1, 1], bond: @0}}, at: [0, 0, "
     "1]}\n",
     "out-of-range", NULL},
    {"bodies:\n  - {shape: {blocks: @{size: [1, 1, 1], count: [2, 1, 1]}}, at: [0, 0, 1]}\n",
     "missing-key", "force that breaks"},
    {"bodies:\n  - {mass: 4, at: [0, 0, 1], shape: {blocks: {size: [1, 1, 1], count: [2, 1, 1], "
     "bond: "
     "9, block_mass: @3}}}\n",
     "bad-body", NULL},
    {"bodies:\n  - {density: @80, at: [0, 0, 1], shape: {compound: [{shape: {sphere: {radius: "
     "1}}}]}}\n",
     "bad-body", "masses of its parts"},
    {"bodies:\n  - {at: [0, 0, 1], shape: {compound: [{shape: @{blocks: {size: [1, 1, 1], count: "
     "[2, "
     "1, 1], bond: 9}}}]}}\n",
     "bad-shape", NULL},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: [0, 0, 1], repeat: {count: [1, @0.5, 1], "
     "step: "
     "[1, 1, 1]}}\n",
     "out-of-range", NULL},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: [0, 0, 1], repeat: {count: @[99, 99, 1], "
     "step: "
     "[1, 1, 1]}}\n",
     "out-of-range", NULL},
    {"groups: @[a]\n", "bad-type", NULL},
    {"groups: @none\n", "bad-type", NULL},
    {"groups: {g: @{at: [[0, 0]]}}\n", "missing-key", "behaviour: walker.lua"},
    {"groups: {g: @{behaviour: stander}}\n", "missing-key", "count: 100"},
    {"groups: {g: @{behaviour: stander, count: 3}}\n", "missing-key", "in: NAME"},
    {"places: {p: {point: [0, 0], radius: 0.01}}\n"
     "groups: {g: @{behaviour: stander, count: 5000, fill: circle, in: p}}\n",
     "too-many", NULL},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: [0, 0, 1], repeat: @{count: [2, 1, 1], "
     "step: [0, 1, 1]}}\n",
     "bad-body", NULL},
    {"bodies: [{shape: {sphere: {radius: 1}}, at: [0, 0, 1], kinematic: true, mass: @3}]\n" GROUP,
     "bad-body", "Leave out its mass"},
    {"bodies: [{shape: {sphere: {radius: 1}}, at: [0, 0, 1], path: @{through: [[1, 0, 1]], speed: "
     "1}}]\n" GROUP,
     "bad-body", "Add `kinematic: true`"},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: [0, 0, 1], kinematic: true, velocity: @[1, "
     "0, 0],\n"
     "     path: {through: [[1, 0, 1]], speed: 1}}\n" GROUP,
     "bad-body", "Leave out the velocity or the path"},
    {"bodies: [{shape: {sphere: {radius: 1}}, at: [0, 0, 1], force_limit: @150}]\n" GROUP,
     "bad-body", "Add `kinematic: true`"},
    {"bodies: [{shape: {sphere: {radius: 1}}, at: [0, 0, 1], at_limit: @end}]\n" GROUP, "bad-body",
     "Add `kinematic: true`"},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: [0, 0, 1], kinematic: true, force_limit: "
     "@150,\n"
     "     path: {through: [[1, 0, 1]], speed: 1, force_limit: 200}}\n" GROUP,
     "bad-body", "Leave one of them out"},
    {"bodies:\n  - {shape: {sphere: {radius: 1}}, at: [0, 0, 1], kinematic: true,\n"
     "     path: {through: @[], speed: 1}}\n" GROUP,
     "bad-type", "[[5, 0, 1], ...]"},
    {SQUARE "groups: {g: @{behaviour: stander, count: 3, fill: circle, in: box}}\n", "bad-fill",
     "point and radius"},
    {SQUARE "groups: {g: @{behaviour: stander, count: 3, fill: line, in: box}}\n", "bad-fill",
     "place with line"},
    {WITH("at: [[0, 0]], set: @[a]"), "bad-type", NULL},
    {WITH("at: [[0, 0]], memory: {laps: @many}"), "bad-type", NULL},
    {SQUARE WITH("count: 3, in: box, @parti: 2"), "unknown-key", "Did you mean 'party'?"},
    {SQUARE "sources: [@{at: box, like: g}]\n" GROUP, "missing-key", "rate: 2"},
    {SQUARE "sources: [{at: box, like: g, people: @4, rate: 1}]\n" GROUP, "bad-value", "every"},
    {SQUARE "sources: [{at: box, like: g, times: [3, @-1]}]\n" GROUP, "out-of-range", NULL},
    {SQUARE "sources: [{at: box, like: g, curve: [[5, 1], @[4, 1]]}]\n" GROUP, "out-of-range",
     "curve: [[0, 0]"},
    {SQUARE "sources: [{at: box, like: g, curve: @[[5, 1]]}]\n" GROUP, "bad-type", NULL},
    {SQUARE "groups: {g: {count: 1, in: box, journey: [{to: @bax}]}}\n", "unknown-place", "box"},
    {SQUARE "groups: {g: {count: 1, in: box, journey: [{queue: @box}]}}\n", "bad-place",
     "queue: [[0, 0]"},
    {SQUARE "groups: {g: {count: 1, in: box, journey: [{open: @door}]}}\n", "unknown-wall", NULL},
    {SQUARE "groups: {g: {count: 1, in: box, journey: [{to: box, wait: @-3}]}}\n", "out-of-range",
     NULL},
    {SQUARE "groups: {g: {count: 1, in: box, journey: [@{share: 0.5}]}}\n", "missing-key",
     "{to: hall}"},
    {SQUARE "groups: {g: {count: 1, in: box, journey: @[{exit: box}, {to: box}]}}\n", "bad-value",
     "last step"},
    {SQUARE "sinks: [{at: box, group: @gg}]\n" GROUP, "unknown-group", "Did you mean 'g'?"},
    {"heatmap: {area: [[0, 0], @[1]]}\n" GROUP, "bad-type", "[x, y]"},
    {"floor: @marbel\n" GROUP, "bad-value", "Did you mean 'marble'?"},
    {"scenery: [{kind: @tre, at: [1, 1]}]\n" GROUP, "bad-value", "Did you mean 'tree'?"},
    {"scenery: [{kind: tree, at: [1, 1], @siz: [1, 1, 1]}]\n" GROUP, "unknown-key",
     "Did you mean 'size'?"},
    {"scenery: [@{kind: tree}]\n" GROUP, "missing-key", "at: [2, 3]"},
    {"scenery: [{kind: tree, at: [1, 1], through: @[[0, 0], [1, 1]]}]\n" GROUP, "bad-scenery",
     "at: [2, 3]"},
    {"scenery: [{kind: hedge, at: @[1, 1]}]\n" GROUP, "bad-scenery", "Give the points"},
    {"scenery: [{kind: area, through: @[[0, 0], [1, 1]]}]\n" GROUP, "bad-scenery", NULL},
    {"scenery: [{kind: tree, at: [1, 1], doors: @[3]}]\n" GROUP, "bad-scenery", NULL},
    {"scenery: [{kind: train, at: [1, 1], doors: @3}]\n" GROUP, "bad-type", "doors: [-4, 4]"},
    {CRATE "scenery: [{kind: train, at: [0, 0], body: @crat}]\n" GROUP, "unknown-body", "crate"},
    {"camera: {position: @far}\n" GROUP, "bad-type", "[x, y, z]"},
    {"view: {tools: [throw, @darg]}\n" GROUP, "bad-value", "Did you mean 'drag'?"},
    {"view: {tools: @cameras}\n" GROUP, "bad-value", NULL},
    {"view: {tools: [@[push]]}\n" GROUP, "bad-type", NULL},
    {"view: {colour: @speeds}\n" GROUP, "bad-value", "Did you mean 'speed'?"},
    {"view: {field: @heat}\n" GROUP, "bad-value", NULL},
    {"view: {@tool: push}\n" GROUP, "unknown-key", "Did you mean 'tools'?"},
    {"view: @push\n" GROUP, "bad-type", NULL},
    {"walls:\n  - {line: [[0, 0], [1, 1]], open: @true}\n" GROUP, "bad-wall", "name: gate"},
    {"events: @{at: 3}\n" GROUP, "bad-type", "events: ["},
    {"events: [@5]\n" GROUP, "bad-type", NULL},
    {"events: [@{at: 3}]\n" GROUP, "bad-event", "{at: 20, open: gate}"},
    {"events: [@{at: 3, signal: a, open: b}]\n" GROUP, "bad-event", "{at: 20, open: gate}"},
    {"events: [@{signal: a}]\n" GROUP, "missing-key", NULL},
    {"events: [{at: @-1, signal: a}]\n" GROUP, "out-of-range", NULL},
    {"events: [{at: 1, every: @0, signal: a}]\n" GROUP, "out-of-range", NULL},
    {"events: [{at: 9, every: 1, until: @5, signal: a}]\n" GROUP, "bad-event", NULL},
    {"events: [{at: 1, until: @5, signal: a}]\n" GROUP, "bad-event", "every: 5"},
    {"events: [{at: 1, signal: @[a]}]\n" GROUP, "bad-type", NULL},
    {"events: [{at: 1, signal: @''}]\n" GROUP, "bad-event", NULL},
    {"events: [{at: 1, @opens: gate, signal: a}]\n" GROUP, "unknown-key", "'open'"},
    {GATE "events: [{at: 1, open: @gates}]\n" GROUP, "unknown-wall", "Did you mean 'gate'?"},
    {"events: [{at: 1, close: @gate}]\n" GROUP, "unknown-wall", "Give walls names"},
    {GATE "events: [{at: 1, open: gate, velocity: @[1, 0, 0]}]\n" GROUP, "bad-event", NULL},
    {CRATE "events: [{at: 1, throw: @crat, velocity: [1, 0, 0]}]\n" GROUP, "unknown-body",
     "Did you mean 'crate'?"},
    {"events: [{at: 1, throw: @crate, velocity: [1, 0, 0]}]\n" GROUP, "unknown-body",
     "Give bodies names"},
    {CRATE "events: [{at: 1, throw: @rock, velocity: [1, 0, 0]}]\n" GROUP, "bad-event",
     "Give it a mass above 0"},
    {CRATE "events: [@{at: 1, throw: crate}]\n" GROUP, "bad-event", "velocity: [5, 0, 3]"},
    {CRATE "events: [{at: 1, throw: crate, velocity: [1, 0, @1e300]}]\n" GROUP, "out-of-range",
     NULL},
    {CRATE "events: [{at: 1, throw: crate, from: @[1, 0]}]\n" GROUP, "bad-type", "[x, y, z]"},
    {CRATE "events: [@{at: 1, push: crate, force: [9, 0]}]\n" GROUP, "bad-event", "lasts: 3"},
    {CRATE "events: [{at: 1, push: @rock, force: [9, 0], lasts: 1}]\n" GROUP, "bad-event",
     "Give it a mass above 0"},
    {CRATE "events: [{at: 1, push: @crat, force: [9, 0], lasts: 1}]\n" GROUP, "unknown-body",
     "Did you mean 'crate'?"},
    {CRATE "places: {crate: {point: [0, 0]}}\nevents: [{at: 1, push: @crate, force: [9, 0], "
           "lasts: 1}]\n" GROUP,
     "bad-event", "another name"},
    {"events: [{at: 1, signal: go, lasts: @1}]\n" GROUP, "bad-event", NULL},
    {CRATE "events: [{at: 1, every: 2, push: crate, force: [9, 0], lasts: @3}]\n" GROUP,
     "bad-event", NULL},
    {"bodies: [{shape: {sphere: {radius: 1}}, at: [0, 0, 0], repeat: {count: [64, 64, 1], step: "
     "[3, 3, "
     "3]}}, @{shape: {blocks: {size: [1, 1, 1], count: [9, 9, 9], bond: 9, block_mass: 1}}, at: "
     "[0, 0, "
     "0], repeat: {count: [64, 64, 1], step: [9, 9, 9]}}, {shape: {sphere: {radius: 1}}, at: [0, "
     "0, "
     "9]}]\n" GROUP,
     "too-many-bodies", "fewer copies"},
    /* the name of a wall that could not be read is not reported as missing, too */
    {"walls: [{line: @[[0, 0]], name: gate}]\nevents: [{at: 1, open: gate}]\n" GROUP, "bad-type",
     NULL},
};

static void every_error_has_position_and_hint(void **state) {
    (void)state;
    assert_int_equal(count_wrong_cases(CASES, sizeof CASES / sizeof *CASES), 0);
}

/* Errors of a whole scene are reported at its first key. */
static void empty_scenes_are_errors(void **state) {
    (void)state;
    static const struct {
        const char *text, *code;
        int line, column;
    } WHOLE[] = {{"", "bad-yaml", 1, 1},
                 {"# nothing\n", "bad-yaml", 1, 1},
                 {"[a, b]\n", "bad-yaml", 1, 1},
                 {GROUP, "missing-key", 1, 1},
                 {"# none\n\njostle: 1\ntitle: Empty\n", "empty-scene", 3, 1}};
    for (size_t w = 0; w < sizeof WHOLE / sizeof *WHOLE; w++) {
        JoxDiagnostics d = {0};
        assert_null(read_scene_text(WHOLE[w].text, NULL, 0, &d));
        if (d.errors != 1 ||
            !is_diagnostic(&d.items[0], WHOLE[w].code, WHOLE[w].line, WHOLE[w].column, NULL))
            print_diagnostics(&d, WHOLE[w].code);
        assert_int_equal(d.errors, 1);
        assert_true(
            is_diagnostic(&d.items[0], WHOLE[w].code, WHOLE[w].line, WHOLE[w].column, NULL));
        jox_diag_free(&d);
    }
}

static void errors_are_reported_together(void **state) {
    (void)state;
    const char *text = "jostle: 1\n"
                       "sead: 4\n"
                       "step: 9 m\n"
                       "places: {a: {point: [0, 0]}}\n"
                       "groups:\n"
                       "  g: {behaviour: gone.lua, count: 0, in: a}\n"
                       "  h: {behaviour: stander, count: 5, in: b, team: [1]}\n"
                       "sinks: [{at: c}]\n";
    static const struct {
        const char *code;
        int line, column;
    } WANTED[] = {{"unknown-key", 2, 1},   {"bad-unit", 3, 7},       {"missing-file", 6, 18},
                  {"out-of-range", 6, 35}, {"unknown-place", 7, 41}, {"bad-type", 7, 50},
                  {"unknown-place", 8, 14}};
    JoxDiagnostics d = {0};
    assert_null(read_scene_text(text, NULL, 0, &d));
    if (d.errors != 7)
        print_diagnostics(&d, text);
    assert_int_equal(d.errors, 7);
    for (int w = 0; w < 7; w++) {
        int found = 0;
        for (size_t i = 0; i < d.count; i++)
            found +=
                is_diagnostic(&d.items[i], WANTED[w].code, WANTED[w].line, WANTED[w].column, NULL);
        if (found != 1)
            print_diagnostics(&d, WANTED[w].code);
        assert_int_equal(found, 1);
    }
    JoxText out = {0};
    jox_diag_print(&d, &out);
    assert_non_null(strstr(out.data, "scenes/test.yaml:2:1: unknown key 'sead' of a scene. "
                                     "Did you mean 'seed'?\n    2 | sead: 4\n      | ^^^^\n"));
    jox_text_free(&out);
    jox_diag_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_error_has_position_and_hint),
        cmocka_unit_test(empty_scenes_are_errors),
        cmocka_unit_test(errors_are_reported_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
