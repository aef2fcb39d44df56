---@meta
-- Definitions of the words of behaviours for lua-language-server.
-- Made by `jostle reference lua-ls`. In .luarc.json: "workspace.library": ["scripts/editor"]

---@class jostle.Condition
---@operator band(jostle.Condition): jostle.Condition
---@operator bor(jostle.Condition): jostle.Condition
---@operator bnot: jostle.Condition

---@class jostle.Number
---@operator add(number|jostle.Number): jostle.Number
---@operator sub(number|jostle.Number): jostle.Number
---@operator mul(number|jostle.Number): jostle.Number
---@operator div(number|jostle.Number): jostle.Number
---@operator unm: jostle.Number
local Number = {}
---@param n number|jostle.Number
---@return jostle.Condition
function Number:above(n) end
---@param n number|jostle.Number
---@return jostle.Condition
function Number:below(n) end
---@param n number|jostle.Number
---@return jostle.Condition
function Number:at_least(n) end
---@param n number|jostle.Number
---@return jostle.Condition
function Number:at_most(n) end
---@param n number|jostle.Number
---@return jostle.Condition
function Number:is(n) end

---@class jostle.Target
local Target = {}
--- of `nearest` and `neighbours`: only agents in a state of this name
---@param name string
---@return jostle.Number
function Number:in_state(name) end
--- of `nearest` and `neighbours`: only agents in a state of this name
---@param name string
---@return jostle.Target
function Target:in_state(name) end
--- the same: only agents whose machine has this name
---@param name string
---@return jostle.Number
function Number:of_machine(name) end
--- the same: only agents whose machine has this name
---@param name string
---@return jostle.Target
function Target:of_machine(name) end
--- the same: only agents of a group of the scene
---@param name string
---@return jostle.Number
function Number:of_group(name) end
--- the same: only agents of a group of the scene
---@param name string
---@return jostle.Target
function Target:of_group(name) end
--- the same: only those whose public memory of this name is true, or is a number within bounds, both included
---@param name string
---@return jostle.Number
function Number:where(name, ...) end
--- the same: only those whose public memory of this name is true, or is a number within bounds, both included
---@param name string
---@return jostle.Target
function Target:where(name, ...) end

---@class jostle.Drawn

---@class jostle.Steering
---@operator add(jostle.Steering): jostle.Steering
---@operator mul(number|jostle.Number): jostle.Steering

---@class jostle.Machine
---@field name? string how messages and mods call it
---@field version? number set by the author, shown in messages
---@field start? string where agents begin
---@field defaults? jostle.State values for all states, drawn once per agent
---@field own? table own values besides the parameters, drawn once per agent: numbers, distributions, or places by name; a group may set them
---@field public? string|string[] memory that others may ask for, by `theirs` and `:where`
---@field counts? table memory that counts by itself, in all states
---@field renamed? table<string, string> old name = new name, of states, own values and memory, which agents keep at a reload. A scene, mod or other behaviour that uses the old name gets a message with the new one
---@field states? table<string, jostle.State> name = state

---@class jostle.State
---@field steer? jostle.Steering|fun(me: jostle.Me): number, number where the agent wants to go: a value, a weighted sum, or function(me) that returns vx, vy in m/s
---@field lasts? number|jostle.Number|jostle.Drawn drawn on entering; see `lasted`, s
---@field removes? boolean the agent leaves the world on entering
---@field lies? boolean the live page of a running scene shows the agent as lying; nothing else changes
---@field become? string on entering, goes on with another machine, from its start; keeps its body, what the scene gave it, and memory by name
---@field push_when? jostle.Condition pushes only while this holds
---@field push_toward? string|jostle.Target|jostle.Number pushes that way; else the way it wants to go
---@field push_weight? "equal"|"nearest" shares the push among all in the way, or gives it to the nearest
---@field push_only? string|string[] pushes only agents with these tags
---@field ignore? string|string[] does not avoid agents and bodies with these tags
---@field face? string|jostle.Target|jostle.Number looks at; else where it walks
---@field approach? string|jostle.Target|jostle.Number a body or agent: not avoided in advance, only not overlapped; agents are kept apart by contacts alone, where forces are on
---@field kick? table kicks a body that it touches, with no wall between
---@field take? string|jostle.Target|jostle.Number picks up a body within 0.6 m that is slower than 8 m/s, where hands reach it and there is room to hold it; it is carried in front, its middle at 1.2 m, nearer or to a side where a wall, or a body that is static, driven or heavier than 200 kg, leaves no room, and falls where there is none. Hands reach over what is lower than the lowest point of what they hold
---@field grasp? string|jostle.Target|jostle.Number takes hold of somebody within 0.5 m, and pulls and is pulled until it comes into a state without `grasp` or 1 m is between them; the agent that is held is dragged, or carried while its own `damping` is 0; see `has` and `holders`
---@field grip? number the greatest force with which it holds on; else 300, N
---@field throw? table throws the body that it carries, from its own side of walls
---@field colour? string of agents in this state where people are coloured by state; without it one is chosen; one of blue, orange, green, vermilion, sky, purple, yellow or grey, which all eyes tell apart, or "#rrggbb" in quotes
---@field signal? string|table calls out on entering, and every so often with { name, every = seconds }
---@field set? table on entering, memory = number, condition or true/false; team = name of a team and tags = tag or list of tags, replacing those it had: of the scene, or new ones
---@field counts? table memory that counts while in this state
---@field on_enter? fun(me: jostle.Me) called on entering
---@field on_exit? fun(me: jostle.Me) called on leaving
---@field speed? number|jostle.Number|jostle.Drawn wanted speed, m/s; 0 to 20, default 1.3
---@field max_speed? number|jostle.Number|jostle.Drawn hard cap on speed; only a contact impulse exceeds it, m/s; 0 to 30, default 1.8
---@field perception? number|jostle.Number|jostle.Drawn radius within which neighbours and bodies are seen, m; 0 to 100, default 3
---@field neighbours? number|jostle.Number|jostle.Drawn greatest number of neighbours that are considered; 0 to 16, default 10
---@field horizon? number|jostle.Number|jostle.Drawn time ahead for which other agents are avoided, s; 0.01 to 30, default 0.5
---@field wall_horizon? number|jostle.Number|jostle.Drawn time ahead for which walls are avoided, s; 0.01 to 30, default 0.3
---@field push? number|jostle.Number|jostle.Drawn force with which an agent pushes agents in its way, N; 0 to 5000, default 0
---@field push_reach? number|jostle.Number|jostle.Drawn greatest gap over which an agent pushes, m; 0 to 2, default 0.1
---@field push_angle? number|jostle.Number|jostle.Drawn half-angle of the cone in which an agent pushes, degree; 0 to 180, default 60
---@field absorb? number|jostle.Number|jostle.Drawn share of a force that is passed on (k of equations 8 and 9); 0 to 1, default 0.8
---@field brace_angle? number|jostle.Number|jostle.Drawn half-angle of the cone that takes a passed-on force, degree; 0 to 180, default 60
---@field yield? number|jostle.Number|jostle.Drawn share of mutual avoidance that the agent takes; 0.5 is reciprocal; 0 to 1, default 0.5
---@field radius? number|jostle.Number|jostle.Drawn radius of the agent's disc, m; 0.02 to 5, default 0.2
---@field mass? number|jostle.Number|jostle.Drawn mass, kg; 1 to 10000, default 70
---@field restitution? number|jostle.Number|jostle.Drawn restitution of contacts between agents; 0 to 1, default 0
---@field damping? number|jostle.Number|jostle.Drawn how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace? number|jostle.Number|jostle.Drawn force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap? number|jostle.Number|jostle.Drawn time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste? number|jostle.Number|jostle.Drawn motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field turn? number|jostle.Number|jostle.Drawn share of the radius that an agent under way saves in contacts by turning a shoulder; 0 to 0.6, default 0.4

---@class jostle.Transition
---@field to? string where it leads
---@field when? jostle.Condition|fun(me: jostle.Me): boolean absent: always; the first that holds wins
---@field chance? number rolled each time `when` turns true
---@field set? table memory, team and tags, as of a state
---@field signal? string calls out
---@field on_take? fun(me: jostle.Me) called when it is taken
---@field id? string how mods name it; else its target, with #2, #3 for repeats

---@class jostle.Me
---@field id number the agent's number, never used again
---@field x number position east, m
---@field y number position north, m
---@field vx number velocity east, m/s
---@field vy number velocity north, m/s
---@field time number simulated time, s
---@field time_in_state number since the state was entered, s
---@field density number people per square metre around the agent, 1/m2
---@field pushed number magnitude of the net force, N
---@field compression number sum of contact force magnitudes over circumference, N/m
---@field load number greatest push borne from any one direction: over directions d, the greatest sum of the positive parts of f.d over its contacts f, N
---@field team number 0 is none
---@field state string name of its state; nil of a neighbour without a machine
---@field machine string name of its machine; nil of a neighbour without one
---@field goal string can be set
---@field neighbours jostle.Me[] views of the agents that `nearest "anyone"` chooses from: nearest first, within perception, with no wall and no tall body between; its `neighbours` nearest, and in a crowd of at most 64 all of them. As they were before the step; memory set in them changes after it, and memory that their machine lacks is nil
---@field signal fun(name: string) calls out: me.signal("alarm")
---@field [string] any a parameter, or what memory declares

--- `inside(place) or inside(target, place)`: the agent, or a target, is in a place; of a point, line or queue no wall or closed gate may lie between, except solids that contain the point
---@param a1 string|jostle.Target|jostle.Number
---@param a2? string|jostle.Target|jostle.Number
---@return jostle.Condition
function inside(a1, a2) end

--- `crosses(line)`: the last step crossed a line, from its right to its left
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function crosses(a1) end

--- `near(target, metres)`: the target is nearer than so many metres; of a place, no wall or closed gate may lie between, except walls that its nearest point lies on or in
---@param a1 string|jostle.Target|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Condition
function near(a1, a2) end

--- `touches(target)`: the gap to the target is below 5 cm
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function touches(a1) end

--- `first_in(queue)`: the agent heads the queue that it steers in
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function first_in(a1) end

--- `after(seconds)`: the agent has been in this state for so many seconds
---@param a1 number|jostle.Number
---@return jostle.Condition
function after(a1) end

--- `lasted`: the duration that `lasts` drew has passed
---@type jostle.Condition
lasted = nil

--- `stuck(seconds)`: the agent has not moved by 0.25 m for so many seconds
---@param a1 number|jostle.Number
---@return jostle.Condition
function stuck(a1) end

--- `hit_by(target)`: a target faster than 1 m/s touches the agent, or hit it in the last step
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function hit_by(a1) end

--- `grounded(target)`: the body touches the ground
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function grounded(a1) end

--- `incoming(target, metres)`: the target, going on as it moves, passes within so many metres in the next 2 s
---@param a1 string|jostle.Target|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Condition
function incoming(a1, a2) end

--- `kicked(target)`: the agent kicked or threw the body in the last step
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function kicked(a1) end

--- `has(target)`: the agent carries the body (see `take`), or holds on to an agent that the target selects (see `grasp`)
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function has(a1) end

--- `sees(target)`: the target is there, within perception, with no wall and no tall body between
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function sees(a1) end

--- `heard(name [, metres])`: somebody within perception (and so many metres), with no wall of 1.3 m or more between, gave the signal in the last step, or the scene gives it now; bodies are no hindrance
---@param a1 string
---@param a2? number|jostle.Number
---@return jostle.Condition
function heard(a1, a2) end

--- `shut(place)`: a gate at the place, or within half a metre of it, is closed, and the agent sees that: within perception, with no other wall before it; bodies are no hindrance
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function shut(a1) end

--- `open(gate)`: the walls of this name are open, wherever they are: all know it, as of a door that is announced
---@param a1 string
---@return jostle.Condition
function open(a1) end

--- `density(place)` in 1/m2: people per square metre in a place; of a point, line or queue: within 2 m
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function density(a1) end

--- `count(place)`: people in a place
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function count(a1) end

--- `queued(queue)`: people who steer in a queue, on their way to their place in it too
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function queued(a1) end

--- `distance(target)` in m: to the target, 0 in a place; infinite where there is none
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function distance(a1) end

--- `neighbours(tag)`: agents seen, with no wall and no tall body between, that bear a tag, or are "anyone", "teammates", "opponents": of its `neighbours` nearest, and in a crowd of at most 64 of all within perception; the methods with a colon select among them
---@param a1 string
---@return jostle.Number
function neighbours(a1) end

--- `theirs(target, name)`: memory of another agent that its machine makes `public`, true as 1; 0 if there is no such agent or memory
---@param a1 string|jostle.Target|jostle.Number
---@param a2 string
---@return jostle.Number
function theirs(a1, a2) end

--- `density_here` in 1/m2: people per square metre about the agent, from its neighbours' distances
---@type jostle.Number
density_here = nil

--- `headway` in m: free distance ahead to the next neighbour that does not come the other way; perception if there is none
---@type jostle.Number
headway = nil

--- `eagerness`: how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds of `haste`
---@type jostle.Number
eagerness = nil

--- `pushed` in N: magnitude of the net force on the agent
---@type jostle.Number
pushed = nil

--- `compression` in N/m: sum of contact force magnitudes over circumference
---@type jostle.Number
compression = nil

--- `load` in N: greatest push borne from any one direction: over directions d, the greatest sum of the positive parts of f.d over its contacts f
---@type jostle.Number
load = nil

--- `contacts`: agents and bodies touched
---@type jostle.Number
contacts = nil

--- `holders`: agents that hold on to the agent (see `grasp`)
---@type jostle.Number
holders = nil

--- `time_in_state` in s: since the state was entered
---@type jostle.Number
time_in_state = nil

--- `min(a, b)`: the lesser of two
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Number
function min(a1, a2) end

--- `max(a, b)`: the greater of two
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Number
function max(a1, a2) end

--- `abs(a)`: absolute value
---@param a1 number|jostle.Number
---@return jostle.Number
function abs(a1) end

--- `sqrt(a)`: square root; 0 of a negative number
---@param a1 number|jostle.Number
---@return jostle.Number
function sqrt(a1) end

--- `clamp(a, least, greatest)`: kept between two bounds
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@param a3 number|jostle.Number
---@return jostle.Number
function clamp(a1, a2, a3) end

--- `now.NAME`: what is measured of the agent now; NAME is one of speed x y neighbours driven time density headway eagerness pushed compression load contacts holders time_in_state
---@type table<string, jostle.Number>
now = {}

--- `own.NAME`: the agent's own value: drawn from `defaults`, or given by the scene's group, which may be a place too
---@type table<string, jostle.Number>
own = {}

--- `nearest(tag)`: the nearest body or agent seen, with no wall and no tall body between, that bears a tag, or of "anyone", "opponents" or "teammates"; the methods with a colon select among agents
---@param a1 string
---@return jostle.Target
function nearest(a1) end

--- `one_of(set)`: a member of a set of places, drawn on entering the state; `goal` from then on
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Target
function one_of(a1) end

--- `goal`: the place that one_of drew last, or that a function set
---@type jostle.Target
goal = nil

--- `home`: the agent's own post: where it arrived, or took up its present machine
---@type jostle.Target
home = nil

--- `seek(target)`: straight to the target: a line is passed, at a point one stops
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function seek(a1) end

--- `field(place)`: the shortest way to the place round walls and large bodies; of a set, to the nearest member
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function field(a1) end

--- `away_from(target)`: straight away from the target
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function away_from(a1) end

--- `orbit(place [, options])`: round a place, counter-clockwise; options inward, density_near, density_far, far, beyond shape the density about it
---@return jostle.Steering
function orbit(...) end

--- `queue(place)`: to one's place in a queue, in order of arrival
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function queue(a1) end

--- `along(place)`: in a line's direction, or along a queue to its head
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function along(a1) end

--- `follow(target [, metres])`: behind the target, at a distance
---@param a1 string|jostle.Target|jostle.Number
---@param a2? number
---@return jostle.Steering
function follow(a1, a2) end

--- `together([metres])`: towards the teammates seen, once they are farther than that
---@param a1? number
---@return jostle.Steering
function together(a1) end

--- `drift(x, y)`: in the direction x east and y north, numbers or expressions; a length of 1 is the wanted speed
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Steering
function drift(a1, a2) end

--- `wander([place])`: walks about, turning gradually, and back from walls; with a place: within it
---@param a1? string|jostle.Target|jostle.Number
---@return jostle.Steering
function wander(a1) end

--- `formation(target [, metres])`: to the agent's place in a row, so far apart: along a line, or behind an agent and across the direction it looks in; in the order in which they stand
---@param a1 string|jostle.Target|jostle.Number
---@param a2? number
---@return jostle.Steering
function formation(a1, a2) end

--- `gather(place [, degrees])`: to the agent's spot among those who wait in a polygon, round walls and fixed bodies: they fill it from its front, which lies in that direction, anti-clockwise from +x, 0.9 m apart, or closer, to 0.51 m and 1.2 breadths, where they are many; those for whom there is no room stand about it
---@param a1 string|jostle.Target|jostle.Number
---@param a2? number
---@return jostle.Steering
function gather(a1, a2) end

--- `spread`: away from the neighbours
---@type jostle.Steering
spread = nil

--- `evade`: sideways, out of the way of oncoming agents; to the right of one straight ahead
---@type jostle.Steering
evade = nil

--- `hold`: stands
---@type jostle.Steering
hold = nil

--- `player`: a person, or the input log, drives this agent
---@type jostle.Steering
player = nil

--- `normal(mean, deviation [, least, greatest])`: a normal distribution, drawn once per agent
---@return jostle.Drawn
function normal(...) end

--- `lognormal(mean, deviation [, least, greatest])`: a number whose logarithm has a normal distribution of this mean and deviation, drawn once per agent
---@return jostle.Drawn
function lognormal(...) end

--- `gamma(shape, scale [, least, greatest])`: a gamma distribution, of mean shape times scale, drawn once per agent
---@return jostle.Drawn
function gamma(...) end

--- `weibull(shape, scale [, least, greatest])`: a Weibull distribution, drawn once per agent
---@return jostle.Drawn
function weibull(...) end

--- `uniform(least, greatest)`: even between two bounds, drawn once per agent
---@return jostle.Drawn
function uniform(...) end

--- `choose(a, b, ...)`: one of up to 8 values, all alike, drawn once per agent
---@return jostle.Drawn
function choose(...) end

--- `circuits(place)`: for `counts`: net counter-clockwise turns about a place since its start line was first crossed; walking back counts down
---@param a1 string|jostle.Target|jostle.Number
---@return any
function circuits(a1) end

--- `memory { name = value, ... }`: what each agent remembers: numbers and booleans, kept through reloads; the result gives the values as expressions
---@return any
function memory(...) end

--- `machine { ... }`: the table that a behaviour returns
---@param sheet jostle.Machine
---@return any
function machine(sheet) end

--- `patch "behaviour" { ... }`: in a mod: changes a behaviour's table, key by key; returned by the file
---@param behaviour string
---@return fun(sheet: table): any
function patch(behaviour) end

--- `replace "behaviour" { ... }`: in a mod: replaces a behaviour's whole table; returned by the file
---@param behaviour string
---@return fun(sheet: table): any
function replace(behaviour) end

--- `none`: in a patch: removes a key or a state
---@type any
none = nil

--- `settings.NAME`: in a mod: the values of its settings, plain numbers
---@type table<string, jostle.Number>
settings = {}
