/* Examples of the scene format, at least one for each owner of keys; together they show every key.
   Tests read and run them, and the reference shows them. */
#include "scene/scene.h"

#define OPENING "jostle: 1\n"
#define STOREYS "storeys: {ground: {height: 0}, first: {height: 3.5}}\n"
#define STANDER "groups: {people: {behaviour: stander.lua, at: [[2, 2]]}}\n"
/* clang-format off */
const JoxExample jox_scene_examples[] = {
    {"scene", OPENING
     "include: running-through.yaml      # gives the groups `standing` and `runner`, and the place `goal`\n"
     "title: Running through, once more\n"
     "about: A runner pushes through a standing crowd, and back again.\n"
     "seed: 7\n"
     "step: 50 ms\n"
     "duration: 1 min\n"
     "gravity: 9.81\n"
     "bounds: [[-20, -20], [20, 20]]\n"
     "periodic: x\n"
     "player: runner\n"
     "input: dodgeball.input\n"
     "forces: {mode: physical}\n"
     "walking: {start_time: 0.5}\n"
     "guard: {people: remove, bodies: stop}\n"
     "limits: {memory: 16 MB}\n"
     "heatmap: {from: 5}\n"
     "report: {author: A. Engineer, project: Hall 3}\n"
     "camera: {position: [0, -15, 12], target: [0, 0, 0]}\n"
     "view: {tools: [throw, drag, push]}\n"
     "places: {door: {line: [[10, -1], [10, 1]]}}\n"
     "regions: {middle: [[-2, -2], [2, -2], [2, 2], [-2, 2]]}\n"
     "walls: [{line: [[-10, -5], [10, -5]]}]\n"
     "bodies: [{shape: {sphere: {radius: 0.2}}, mass: 2, at: [0, 3, 0.2]}]\n"
     "floor: grass\n"
     "scenery: [{kind: bush, at: [12, 0]}]\n"
     "groups: {standing: {tags: [crowd]}} # one more key for a group of the included scene\n"
     "sources: [{at: door, like: standing, rate: 0.5}]\n"
     "sinks: [{at: goal}]\n"
     "probes: {moved: {displacement: true}}\n"
     "events: [{at: 5, signal: go}]\n"
     "tally: {here: {group: standing}, there: {group: runner}}\n"
     "game: {ours: there, theirs: here, time: 20}\n"
     "criteria: {not too dense: {density: 9}}\n"},
    {"scene", OPENING
     "storeys: {ground: {height: 0}, first: {height: 3.5}}\n"
     "stairs: {north: {from: ground, to: first, path: [[4, 0], [10, 0]]}}\n"
     "lifts: {east: {area: [[12, 5], [13.6, 6.8]], door: [[12.35, 5], [13.25, 5]]}}\n"
     STANDER},
    {"storey", OPENING
     "storeys:                       # from the lowest up\n"
     "  basement: {height: -4.5}\n"
     "  street: {height: 0}\n"
     "  first: {height: 3.5}\n"
     "places: {hall: {polygon: [[0, 0], [9, 0], [9, 6], [0, 6]], storey: first}}\n"
     "groups: {people: {behaviour: stander.lua, count: 20, in: hall}}\n"},
    {"stair", OPENING
     "storeys: {ground: {height: 0}, first: {height: 3.5}, second: {height: 7}}\n"
     "stairs:\n"
     "  north: {from: ground, to: first, path: [[4, 0], [10.6, 0]], width: 1.5, landings: [[2.7, 3.9]]}\n"
     "  dog-leg: # two flights with a half landing between\n"
     "    {from: first, to: second, path: [[4, 6], [8, 6], [8, 7.6], [4, 7.6]]}\n"
     "  ramp up: {kind: ramp, from: ground, to: first, path: [[0, 20], [45, 20]], width: 2}\n"
     "  escalator up: {kind: escalator, way: up, speed: 0.65, from: ground, to: first, path: [[4, 12], [10, 12]], width: 1, closed: true}\n"
     "  aisle: {from: second, to: second, rise: 2, path: [[20, 0], [24, 0]]} # steps of a stand\n"
     STANDER},
    {"lift", OPENING
     "storeys: {basement: {height: -3.5}, ground: {height: 0}, first: {height: 4}, second: {height: 8}}\n"
     "lifts:\n"
     "  east: # two corners of the car, and its door on each storey\n"
     "    {area: [[10, 5], [11.6, 6.8]], door: [[10.35, 5], [11.25, 5]], capacity: 8}\n"
     "  fire lift: # through-car: the door of the first storey is on the other side\n"
     "    area: [[12, 5], [13.4, 5], [13.4, 7], [12, 7]]\n"
     "    storeys: [ground, first, second]\n"
     "    door: [[12.2, 5], [13.2, 5]]\n"
     "    doors: {first: [[12.2, 7], [13.2, 7]]}\n"
     "    capacity: 10\n"
     "    load: 800\n"
     "    speed: 1\n"
     "    acceleration: 0.6\n"
     "    opening: 2.5\n"
     "    closing: 3\n"
     "    dwell: 4\n"
     "    home: ground\n"
     "    returns: false\n"
     "    mode: out_of_use\n"
     "    first: second\n"
     "places: {down: {set: [east.ground, fire lift.ground]}}\n"
     "events:\n"
     "  - {at: 30, lift: east, mode: out_of_use}\n"
     "  - {at: 30, lift: fire lift, mode: firemen}\n"
     "groups:\n"
     "  visitors: {at: [[9, 3]], journey: [{ride: east.second}, {wait: 60}]}\n"
     "  in wheelchairs: {at: [[14, 3]], journey: [{ride: down, firemen: true}, {wait: 60}]}\n"},
    {"report", OPENING
     "report:\n"
     "  author: A. Engineer\n"
     "  organisation: Crowd Safety Ltd\n"
     "  project: Hall 3, emergency exits\n"
     "  reference: CS-2031, revision B\n"
     "  checked_by: B. Checker\n"
     "  approved_by: C. Approver\n"
     "  date: 2026-05-04\n"
     "  notes: Speeds and pre-movement times as in the fire strategy of 2025.\n"
     STANDER},
    {"criterion", OPENING
     "criteria:\n"
     "  everybody out: {cleared: 2 min, margin: 1.5} # required time times 1.5 within two minutes\n"
     "  room in the hall: {density: 4, at: hall, lasting: 10}\n"
     "  flow at the door: {flow: 1.3, of: door}\n"
     "  way through: {waiting: 60, of: passage}\n"
     "  nobody hurt: {load: 623}\n"
     "duration: 20\n"
     "places: {hall: {polygon: [[0, 0], [8, 0], [8, 6], [0, 6]]}, exit: {point: [14, 3], radius: 1}}\n"
     "walls: [{line: [[8, 2.5], [8, 0], [0, 0], [0, 6], [8, 6], [8, 3.5]]}]\n"
     "groups: {people: {behaviour: walker.lua, count: 10, in: hall, set: {goal: exit}}}\n"
     "sinks: [{at: exit}]\n"
     "probes:\n"
     "  door: {flow: [[8, 3.5], [8, 2.5]]}\n"
     "  passage: {transit: [[[6, 6], [6, 0]], [[8, 3.5], [8, 2.5]]]}\n"},
    {"tally", OPENING
     "tally:\n"
     "  worst: {memory: hits, group: blue, take: greatest, unit: hits}\n"
     "  hit now: {state: Hit}\n"
     "places: {half: {polygon: [[0, -4], [8, -4], [8, 4], [0, 4]]}}\n"
     "bodies: [{shape: {sphere: {radius: 0.1}}, mass: 0.4, at: [5, 0, 0.1], tags: [ball]}]\n"
     "groups: {blue: {behaviour: dodgeball.lua, at: [[2, 2]], set: {court: half}}}\n"},
    {"game", OPENING
     "player: red\n"
     "tally: {red: {memory: hits, group: blue}, blue: {memory: hits, group: red}}\n"
     "game:\n"
     "  ours: red\n"
     "  theirs: blue\n"
     "  points: 5 # or at the end of\n"
     "  time: 1 min\n"
     "  all: blue # or when so many hits were counted as there are people in blue\n"
     "  tie: theirs\n"
     "  rounds: 3\n"
     "  speed: 4 m/s\n"
     "  how: Run into the ball, and keep out of its way.\n"
     "  button: run\n"
     "  ball: ball\n"
     "  level: hard\n"
     "  levels: {easy: {group: blue, set: {reaction: 1}}, hard: {}}\n"
     "bodies: [{shape: {sphere: {radius: 0.1}}, mass: 0.4, at: [5, 0, 0.1], tags: [ball]}]\n"
     "places: {half: {polygon: [[0, -4], [8, -4], [8, 4], [0, 4]]}, other: {polygon: [[-8, -4], [0, -4], [0, 4], [-8, 4]]}}\n"
     "groups:\n"
     "  red: {behaviour: dodgeball.lua, at: [[-4, 0]], team: red, set: {court: other}}\n"
     "  blue: {behaviour: dodgeball.lua, at: [[4, 0]], team: blue, set: {court: half}}\n"},
    {"level", OPENING
     "player: one\n"
     "tally: {one: {group: one}, all: {}}\n"
     "game: {ours: one, theirs: all, time: 5 s, levels: {easy: {}, hard: {group: other, set: {speed: 2}}}}\n"
     "groups: {one: {behaviour: stander.lua, at: [[0, 0]]}, other: {behaviour: stander.lua, at: [[2, 2]]}}\n"},
    {"forces", OPENING
     "forces: {enabled: true, mode: literal}\n"
     STANDER},
    {"walking", OPENING
     "walking:\n"
#define X(name, unit, least, greatest, value, meaning) "  " #name ": " #value "\n"
     JOX_WALK_CONSTANTS(X)
#undef X
     STANDER},
    {"guard", OPENING
     "guard: {people: remove, bodies: stop}\n"
     STANDER},
    {"limits", OPENING
     "limits: {instructions: 50000, step_instructions: 5000000, load_instructions: 5000000,\n"
     "         memory: 8 MB, block: 1 MB, source: 64 KB, print: 5}\n"
     STANDER},
    {"heatmap", OPENING
     "heatmap: {area: [[-5, -5], [5, 5]], from: 30 s}\n"
     STANDER},
    {"heatmap", OPENING
     STOREYS
     "heatmap: {area: [[-5, -5], [5, 5]], storey: first}\n"
     STANDER},
    {"camera", OPENING
     "camera: {position: [0, -20, 15], target: [0, 0, 1]}\n"
     STANDER},
    {"view", OPENING
     "view: {tools: [push, parameters], colour: compression, field: density}\n"
     STANDER},
    {"place", OPENING
     "places:\n"
     "  tree:    {point: [12, 5], radius: 1}\n"
     "  gate:    {line: [[0, 0], [0, 4]]}\n"
     "  island:  {polygon: [[4, 2], [6, 2], [6, 4], [4, 4]], start: mark}\n"
     "  mark:    {line: [[6, 3], [9, 3]]}\n"
     "  counter: {queue: [[9, 8], [9, 6], [7, 6]], spacing: 60 cm}\n"
     "  sights:  {set: [tree, island]}\n"
     "groups:\n"
     "  walkers: {behaviour: walker.lua, at: [[2, 2], [2, 3]], set: {goal: tree}}\n"},
    {"place", OPENING
     STOREYS
     "places: {hall: {polygon: [[0, 0], [9, 0], [9, 6], [0, 6]], storey: first, refuge: true}}\n"
     STANDER},
    {"wall", OPENING
     "walls:\n"
     "  - {line: [[0, 0], [20, 0], [20, 10], [0, 10]], closed: true, height: 2.5, drawn: 0.4}\n"
     "  - {solid: [[9, 4], [11, 4], [11, 6], [9, 6]]}\n"
     "  - {line: [[9, 5], [0, 5]], name: fence, open: true}\n"
     "  - {file: hall.wkt, unit: 1 cm, origin: [-3000, 0]}   # drawn in centimetres; 30 m further east\n"
     STANDER},
    {"wall", OPENING
     STOREYS
     "walls: # on two storeys\n"
     "  - {line: [[0, 0], [20, 0]], storey: [ground, first]}\n"
     STANDER},
    {"scenery", OPENING
     "floor: asphalt\n"
     "scenery:\n"
     "  - {kind: tree, at: [[-6, 8], [0, 8.5], [6, 8]], size: [5, 5, 8]}\n"
     "  - {kind: house, at: [0, 14], turn: 10, colour: '#c9a27a'}\n"
     "  - {kind: bench, at: [[-3, 3], [3, 3]], faces: [0, 0]}\n"
     "  - {kind: line, through: [[-8, 0], [8, 0]], size: [0, 0.12, 0], colour: yellow}\n"
     "  - {kind: area, through: [[-8, -6], [8, -6], [8, -3], [-8, -3]], colour: green}\n"
     "  - {kind: train, at: [0, 0], size: [12, 2.6, 3.2], doors: [-4, 4], body: coach}\n"
     "bodies: [{name: coach, shape: {box: {size: [12, 2.6, 3]}}, kinematic: true, at: [-20, -4.5, 1.5], velocity: [1, 0, 0]}]\n"
     STANDER},
    {"scenery", OPENING
     STOREYS
     "scenery: [{kind: bench, at: [[6, 4], [9, 4]], storey: [ground, first]}]\n"
     STANDER},
    {"body", OPENING
     "bodies:\n"
     "  - name: ball\n"
     "    shape: {sphere: {radius: 11 cm}}\n"
     "    mass: 400 g\n"
     "    at: [0, 0, 1]\n"
     "    velocity: [3, 0, 2]\n"
     "    friction: 0.5\n"
     "    restitution: 0.7\n"
     "    damping: 0.1\n"
     "    repeat: {count: [3, 1, 1], step: [0.5, 0, 0]}\n"
     "    tags: [ball]\n"
     "  - {name: crate, shape: {box: {size: [1, 1, 1]}}, density: 300 kg/m3, at: [5, 0, 0.5], turn: 30}\n"
     "  - {name: turnstile, shape: {box: {size: [3, 0.1, 1]}}, kinematic: true, at: [-6, 0, 1], spin: [0, 0, 20 deg/s], force_limit: 300 N, at_limit: yield}\n"
     "  - {name: lift, shape: {box: {size: [2, 2, 0.2]}}, kinematic: true, at: [0, 9, 0.1], path: {through: [[0, 9, 4]], speed: 0.5, end: back}}\n"
     STANDER},
    {"body", OPENING
     STOREYS
     "bodies: [{shape: {box: {size: [1, 1, 1]}}, mass: 20, at: [6, 3, 0.5], storey: first}]\n"},
    {"path", OPENING
     "bodies:\n"
     "  - name: door                       # open after 5 s, for 20 s, and closed again\n"
     "    shape: {box: {size: [1.2, 0.1, 2]}}\n"
     "    at: [0, 3, 1]\n"
     "    kinematic: true\n"
     "    path: {through: [[1.2, 3, 1], [0, 3, 1]], speed: 0.5 m/s, after: 5, wait: 20, end: stay, force_limit: 150 N, reopens: true}\n"
     STANDER},
    {"repeat", OPENING
     "bodies:\n"
     "  - {name: chair, shape: {cylinder: {radius: 0.25, height: 0.5}}, mass: 6, at: [0, 3, 0.25], repeat: {count: [5, 2, 1], step: [1.2, 1, 0]}}\n"
     STANDER},
    {"shape", OPENING
     "bodies:\n"
     "  - {shape: {box: {size: [2, 1, 1]}}, mass: 40, at: [0, 0, 0.5]}\n"
     "  - {shape: {sphere: {radius: 0.3}}, mass: 5, at: [3, 0, 0.3]}\n"
     "  - {shape: {cylinder: {radius: 0.2, height: 1}}, mass: 20, at: [6, 0, 0.5]}\n"
     "  - {shape: {hull: {points: [[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, 1]]}}, mass: 30, at: [9, 0, 0.5]}\n"
     "  - {shape: {blocks: {size: [0.5, 0.5, 0.5], count: [4, 1, 2], bond: 300}}, mass: 80, at: [15, 0, 0.5]}\n"
     "  - shape: {compound: [{shape: {sphere: {radius: 0.3}}}, {shape: {sphere: {radius: 0.2}}, at: [0, 0, 0.4]}]}\n"
     "    mass: 12\n"
     "    at: [12, 0, 0.5]\n"},
    {"box", OPENING
     "bodies: [{shape: {box: {size: [1.2, 0.8, 1.5]}}, mass: 60, at: [0, 0, 0.75]}]\n"},
    {"sphere", OPENING
     "bodies: [{shape: {sphere: {radius: 0.5}}, mass: 10, at: [0, 0, 0.5]}]\n"},
    {"cylinder", OPENING
     "bodies: [{shape: {cylinder: {radius: 0.3, height: 0.9}}, mass: 15, at: [0, 0, 0.45]}]\n"},
    {"hull", OPENING
     "bodies:\n"
     "  - shape: {hull: {points: [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1.5]]}}\n"
     "    mass: 80\n"
     "    at: [0, 0, 0.1]\n"},
    {"blocks", OPENING
     "bodies:\n"
     "  - name: wall\n"
     "    shape: {blocks: {size: [0.5, 0.5, 0.4], count: [12, 1, 3], bond: 300 N, block_mass: 8 kg}}\n"
     "    friction: 0.4\n"
     "    at: [0, 3, 0.6]\n"
     STANDER},
    {"part", OPENING
     "bodies:\n"
     "  - shape:\n"
     "      compound:\n"
     "        - {shape: {box: {size: [1.5, 0.8, 0.1]}}, mass: 12}\n"
     "        - {shape: {cylinder: {radius: 0.05, height: 0.7}}, at: [0, 0, -0.4], mass: 6}\n"
     "    mass: 18\n"
     "    at: [0, 0, 0.75]\n"},
    {"group", OPENING
     "places:\n"
     "  hall: {polygon: [[0, 0], [20, 0], [20, 10], [0, 10]]}\n"
     "  stage: {polygon: [[0, 4], [3, 4], [3, 6], [0, 6]]}\n"
     "  exit: {point: [25, 5], radius: 1}\n"
     "  rope: {line: [[22, 8], [22, 0]]}\n"
     "groups:\n"
     "  audience: {mix: {walker.lua: 3, runner.lua: 1}, density: 1, in: hall, outside: [stage],\n"
     "             party: 4, tags: [guest], set: {goal: exit, speed: 'normal(1.3, 0.2, 0.5, 2)'}, basis: ticket sales of 2025}\n"
     "  staff: {behaviour: stander.lua, count: 12, fill: grid, in: stage, spacing: 60 cm, facing: 90 deg, team: house, colour: purple}\n"
     "  guards: {behaviour: stander.lua, at: [[23, 5], [24, 5]]}\n"
     "  press: {behaviour: stander.lua, count: 10, fill: line, in: rope, clothes: work}\n"
     "  guests: {behaviour: walker.lua, starts: [[0, 4, 2], [1.5, 0.5, 3, 1.3, 0]], set: {goal: exit}}\n"},
    {"group", OPENING
     "include: tawaf.yaml\n"
     "groups: {pilgrims: {count: 300, memory: {laps: 'choose(0, 3, 6)', touched: true}}}\n"},
    {"profile", OPENING
     "places: {hall: {polygon: [[0, 0], [20, 0], [20, 10], [0, 10]]}, exit: {point: [25, 5], radius: 1}}\n"
     "groups:\n"
     "  travellers:\n"
     "    behaviour: walker.lua\n"
     "    count: 20\n"
     "    in: hall\n"
     "    set: {goal: exit}\n"
     "    profiles:\n"
     "      alone: {share: 6}\n"
     "      child: {share: 1, set: {radius: 0.15, mass: 30, speed: 'normal(1, 0.1, 0.7, 1.3)'}}\n"
     "      luggage: {share: 2, set: {radius: 0.3, mass: 95, speed: 'normal(1.1, 0.15, 0.6, 1.5)'}}\n"
     "      wheelchair: {share: 0.5, set: {radius: 0.35, mass: 110, speed: 0.9}}\n"},
    {"step", OPENING
     STOREYS
     "lifts: {east: {area: [[12, 5], [13.6, 6.8]], door: [[12.35, 5], [13.25, 5]]}}\n"
     "places:\n"
     "  office: {polygon: [[0, 0], [8, 0], [8, 4], [0, 4]], storey: first}\n"
     "  street: {line: [[-3, -5], [-3, 5]]}\n"
     "groups:\n"
     "  in wheelchairs: {count: 3, in: office, journey: [{ride: east.ground, firemen: true}, {exit: street}]}\n"},
    {"step", OPENING
     "places:\n"
     "  hall: {polygon: [[0, 0], [20, 0], [20, 10], [0, 10]]}\n"
     "  gate_1: {queue: [[22, 3], [16, 3]]}\n"
     "  gate_2: {queue: [[22, 7], [16, 7]]}\n"
     "  kiosk: {point: [10, 1]}\n"
     "  platform: {polygon: [[24, 0], [30, 0], [30, 10], [24, 10]]}\n"
     "  train: {polygon: [[31, 0], [34, 0], [34, 10], [31, 10]]}\n"
     "walls: [{line: [[30.5, 0], [30.5, 10]], name: doors}]\n"
     "groups:\n"
     "  passengers:\n"
     "    count: 20\n"
     "    in: hall\n"
     "    journey:\n"
     "      - {until: go}\n"
     "      - {to: kiosk, wait: 'uniform(2, 5)', share: 0.3}\n"
     "      - {queue: [gate_1, gate_2], service: 'uniform(1, 3)'}\n"
     "      - {to: platform, front: train, open: doors}\n"
     "      - {exit: train}\n"
     "events: [{at: 1, signal: go}, {at: 40, open: doors}]\n"},
    {"group", OPENING
     "places: {hall: {polygon: [[0, 0], [20, 0], [20, 10], [0, 10]]}, exit: {point: [25, 5], radius: 1}}\n"
     "groups:\n"
     "  visitors:\n"
     "    count: 20\n"
     "    in: hall\n"
     "    profiles: {alone: {share: 3}, luggage: {share: 1, set: {radius: 0.3, mass: 95}}}\n"
     "    journey: [{exit: exit}]\n"},
    {"group", OPENING
     STOREYS
     "groups: {people: {behaviour: stander.lua, at: [[2, 2], [3, 2]], storey: first}}\n"},
    {"source", OPENING
     "places: {street: {point: [1, 5], radius: 1}, hall: {polygon: [[5, 0], [20, 0], [20, 10], [5, 10]]}, exit: {point: [25, 5], radius: 1}}\n"
     "groups: {visitors: {count: 10, in: hall, journey: [{exit: exit}]}}\n"
     "sources:\n"
     "  - {at: street, like: visitors, every: 90, people: 15}\n"
     "  - {at: street, like: visitors, times: [10, 12.5, 30]}\n"
     "  - {at: street, like: visitors, curve: [[0, 0.2], [60, 1.5], [120, 0]]}\n"},
    {"source", OPENING
     "include: tawaf.yaml\n"
     "groups: {pilgrims: {count: 300}}\n"
     "sources:\n"
     "  - {at: arrivals, like: pilgrims, keep: 300, memory: {laps: 0}}\n"
     "  - {at: gate_1, like: pilgrims, rate: 2, even: true, from: 10, until: 5 min}\n"},
    {"sink", OPENING
     "places: {exit: {point: [12, 2], radius: 1}}\n"
     "groups: {guests: {behaviour: stander.lua, at: [[6, 2], [12, 2]]}}\n"
     "sinks: [{at: exit, group: guests}]\n"},
    {"probe", OPENING
     "include: running-through.yaml\n"
     "probes:\n"
#define X(kind, name, form, options, example, meaning) "  " example "\n"
     JOX_PROBES(X)
#undef X
    },
    {"probe", OPENING
     STOREYS
     "stairs: {north: {from: ground, to: first, path: [[4, 0], [10, 0]]}}\n"
     "probes: {down the stair: {flow: [[7, -0.6], [7, 0.6]], storey: north}}\n"
     STANDER},
    {"map", OPENING
     "include: running-through.yaml\n"
     "probes: {fields: {map: {area: [[-2, -2], [6, 6]], cell: 0.1, kernel: 0.7, through_walls: true}}}\n"},
    {"lanes", OPENING
     "include: running-through.yaml\n"
     "probes: {order: {lanes: {area: [[-2, -2], [6, 6]], rows: 40 cm, along: y}, group: [standing, runner]}}\n"},
    {"oscillation", OPENING
     "include: running-through.yaml\n"
     "probes: {swirl: {oscillation: {area: [[-2, -2], [6, 6]], window: 2, span: 4}, every: 0.1}}\n"},
    {"event", OPENING
     STOREYS
     "lifts: {east: {area: [[12, 5], [13.6, 6.8]], door: [[12.35, 5], [13.25, 5]]}}\n"
     "events: [{at: 30, lift: east, mode: firemen}]\n"
     STANDER},
    {"event", OPENING
     "walls:\n"
     "  - {line: [[0, 0], [0, 2]], name: gate}\n"
     "  - {line: [[9, 0], [9, 2]], name: shutter, open: true}\n"
     "bodies:\n"
     "  - {name: crate, shape: {box: {size: [0.6, 0.6, 0.6]}}, mass: 20, at: [4, 5, 0.3]}\n"
     "  - {name: lift, shape: {box: {size: [2, 2, 0.2]}}, kinematic: true, at: [0, 9, 0.1]}\n"
     STANDER
     "events:\n"
     "  - {at: 15, move: lift, velocity: [0, 0, 0.5]}\n"
     "  - {at: 21, move: lift, velocity: [0, 0, 0]}\n"
     "  - {at: 5, signal: alarm}\n"
     "  - {at: 10, open: gate}\n"
     "  - {at: 1 min, close: gate}\n"
     "  - {at: 10, every: 5, until: 60, throw: crate, from: [4, 5, 2], velocity: [-4, 0, 3], spin: [0, 0, 2]}\n"
     "  - {at: 20, every: 10, push: crate, force: [60, 0], lasts: 1.5}\n"},
    {"event", OPENING
     STOREYS
     "bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, mass: 2, at: [6, 3, 0.2], storey: first}]\n"
     "events: [{at: 5, throw: ball, from: [2, 2, 1.5], storey: first, velocity: [4, 0, 2]}]\n"},
    {"mod",
     "name: calm\n"
     "title: Calm crowds\n"
     "version: 1.2.0\n"
     "api: 1\n"
     "depends: [\"base >= 1.0\"]\n"
     "optional: [signs]\n"
     "conflicts: [panic]\n"
     "load_after: [weather]\n"
     "settings:\n"
     "  patience: {value: 30, unit: s, least: 0, greatest: 600, meaning: waiting before people leave}\n"},
    {"setting",
     "name: calm\n"
     "version: 1.2.0\n"
     "api: 1\n"
     "settings:\n"
     "  patience: {value: 30, unit: s, least: 0, greatest: 600, meaning: waiting before people leave}\n"
     "  pace: {value: 0.8, meaning: share of the usual speed}\n"
     "  shoves: {value: false, meaning: whether people push}\n"
     "  manner: {value: polite, choices: [polite, rude], meaning: how people meet}\n"},
};
/* clang-format on */
const size_t jox_scene_example_count = sizeof jox_scene_examples / sizeof *jox_scene_examples;
