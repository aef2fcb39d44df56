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
--- restricts `nearest` and `neighbours` to agents in a state of this name
---@param name string
---@return jostle.Number
function Number:in_state(name) end
--- restricts `nearest` and `neighbours` to agents in a state of this name
---@param name string
---@return jostle.Target
function Target:in_state(name) end
--- restricts them to agents whose machine has this name
---@param name string
---@return jostle.Number
function Number:of_machine(name) end
--- restricts them to agents whose machine has this name
---@param name string
---@return jostle.Target
function Target:of_machine(name) end
--- restricts them to agents of this group of the scene
---@param name string
---@return jostle.Number
function Number:of_group(name) end
--- restricts them to agents of this group of the scene
---@param name string
---@return jostle.Target
function Target:of_group(name) end
--- restricts them to agents whose public memory of this name is true, or is a number from least to greatest
---@param name string
---@return jostle.Number
function Number:where(name, ...) end
--- restricts them to agents whose public memory of this name is true, or is a number from least to greatest
---@param name string
---@return jostle.Target
function Target:where(name, ...) end
--- restricts them to agents that lie after a fall (see `balance`)
---@return jostle.Number
function Number:fallen() end
--- restricts them to agents that lie after a fall (see `balance`)
---@return jostle.Target
function Target:fallen() end
--- restricts `nearest` to bodies in the air, which touch neither the ground nor a fixed body and which nobody carries
---@return jostle.Target
function Target:flying() end
--- restricts them to agents and bodies that pass within this distance, m, of where the agent stands during the next 2 s if they keep their velocity
---@param metres number
---@return jostle.Number
function Number:incoming(metres) end
--- restricts them to agents and bodies that pass within this distance, m, of where the agent stands during the next 2 s if they keep their velocity
---@param metres number
---@return jostle.Target
function Target:incoming(metres) end
--- restricts a target, or `neighbours`, to what is nearer than this distance, m, between centres
---@param name string
---@return jostle.Number
function Number:within(name) end
--- restricts a target, or `neighbours`, to what is nearer than this distance, m, between centres
---@param name string
---@return jostle.Target
function Target:within(name) end
--- restricts them to what lies ahead: within this angle, degrees, to either side of where the agent looks
---@param name string
---@return jostle.Number
function Number:ahead(name) end
--- restricts them to what lies ahead: within this angle, degrees, to either side of where the agent looks
---@param name string
---@return jostle.Target
function Target:ahead(name) end

---@class jostle.Drawn

---@class jostle.Steering
---@operator add(jostle.Steering): jostle.Steering
---@operator mul(number|jostle.Number): jostle.Steering

---@class jostle.Machine
---@field name? string name of the behaviour in messages and for mods
---@field version? number a number for messages, chosen by the author
---@field start? string state in which agents begin
---@field defaults? jostle.State values for all states, drawn once per agent
---@field own? table own values besides the parameters, drawn once per agent: numbers, distributions, or places by name; a group of the scene may set them
---@field public? string|string[] memory that other agents may read, by `theirs` and `:where`
---@field counts? table memory that counts by itself, in all states; see `circuits`
---@field renamed? table<string, string> old name = new name, for states, own values and memory that were renamed: agents keep them at a reload. A scene, mod or other behaviour that uses the old name gets an error that names the new one
---@field states? table<string, jostle.State> name of a state = its table

---@class jostle.State
---@field steer? jostle.Steering|fun(me: jostle.Me): number, number where the agent wants to go: a steering word, a weighted sum of them, or function(me) that returns vx, vy in m/s
---@field lasts? number|jostle.Number|jostle.Drawn duration of the state, drawn on entering it; see `lasted`, s
---@field removes? boolean the agent leaves the world on entering
---@field lies? boolean the live page of a running scene shows the agent as lying down; nothing else changes
---@field become? string on entering, the agent changes to another machine, at its start; it keeps its body, the values that the scene gave it, and memory of the same name
---@field push_when? jostle.Condition the agent pushes only while this holds
---@field push_toward? string|jostle.Target|jostle.Number direction in which the agent pushes; without it the direction in which it wants to go
---@field push_weight? "equal"|"nearest" "equal" shares the push among all agents in the way, "nearest" gives it to the nearest
---@field push_only? string|string[] the agent pushes only agents with these tags
---@field ignore? string|string[] the agent does not avoid agents and bodies with these tags
---@field face? string|jostle.Target|jostle.Number where the agent looks; without it in its walking direction
---@field approach? string|jostle.Target|jostle.Number body or agent that the agent does not avoid in advance; it only does not overlap it. Agents are then kept apart by contacts alone, where forces are on
---@field kick? table kicks a body that it touches, with no wall between. The body passes the agent's own body until it is clear of it
---@field take? string|jostle.Target|jostle.Number body to pick up, if it is within 0.6 m and slower than 8 m/s, hands reach it and there is room to hold it. It is carried in front, its middle at 1.2 m above the ground; nearer or to a side where a wall, or a body that is static, driven or heavier than 200 kg, leaves no room, and it falls where there is none. Hands reach over obstacles that are lower than the lowest point of the body
---@field grasp? string|jostle.Target|jostle.Number agent to take hold of, if it is within 0.5 m. An agent that has fallen gets up the sooner, the more hold on to it. Both pull each other until the holder comes into a state without `grasp`, or 1 m is between them. The held agent is dragged, or carried while its own `damping` is 0; see `has` and `holders`
---@field grip? number greatest force with which the agent holds on; default 300, N
---@field throw? table throws the body that it carries, from its own side of walls
---@field colour? string colour of agents in this state where people are coloured by state; one of blue, orange, green, vermilion, sky, purple, yellow or grey, which all eyes tell apart, or "#rrggbb" in quotes. Default: one is chosen
---@field signal? string|table signal that the agent gives on entering, and again after each interval with { name, every = seconds }
---@field tell? table message that the agent tells on entering, after `set`: to whom, a target, or `neighbours(tag)` for all those; its name; and up to 4 values, numbers or targets. It waits for the receiver from the next step on (see `told`)
---@field set? table values to set on entering: memory = number, condition, true/false, or target; team = name of a team; tags = tag or list of tags, in place of those that the agent had. Teams and tags may be new
---@field counts? table memory that counts while the agent is in this state; see `circuits`
---@field on_enter? fun(me: jostle.Me) called when an agent enters the state
---@field on_exit? fun(me: jostle.Me) called when an agent leaves the state
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
---@field radius? number|jostle.Number|jostle.Drawn radius of the disc for which an agent keeps room as it walks, m; 0.02 to 5, default 0.2
---@field breadth? number|jostle.Number|jostle.Drawn breadth of the torso across the shoulders; 0: 2.25 times the radius, m; 0 to 10, default 0
---@field depth? number|jostle.Number|jostle.Drawn depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth, m; 0 to 10, default 0
---@field mass? number|jostle.Number|jostle.Drawn mass, kg; 1 to 10000, default 70
---@field restitution? number|jostle.Number|jostle.Drawn restitution of contacts between agents; 0 to 1, default 0
---@field damping? number|jostle.Number|jostle.Drawn how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace? number|jostle.Number|jostle.Drawn force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap? number|jostle.Number|jostle.Drawn time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste? number|jostle.Number|jostle.Drawn motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field step_back? number|jostle.Number|jostle.Drawn speed at which an agent that stands steps back to where it stood before it was moved, m/s; 0 to 2, default 0.11
---@field balance? number|jostle.Number|jostle.Drawn longest step by which an agent that forces throw regains its balance; 0: it never falls, m; 0 to 2, default 0
---@field stance? number|jostle.Number|jostle.Drawn how far to either side of an agent that stands its feet are; they hold it against forces from the side, m; 0 to 1, default 0
---@field rise? number|jostle.Number|jostle.Drawn time that an agent lies after a fall, until it gets up, s; 0 to 1e+06, default 5

---@class jostle.Transition
---@field to? string state to which it leads. An item without it is a reaction: what it says is done, and the agent stays in its state. All reactions that hold are carried out, then the first transition that holds is taken
---@field when? jostle.Condition|fun(me: jostle.Me): boolean the transition is taken when this holds; of several that hold, the first. Without it: at once
---@field every? number only when the time in the state reaches a multiple of this, s
---@field chance? number probability that it is taken, drawn each time that `when` becomes true
---@field set? table values to set when it is taken: memory, team and tags, as in a state
---@field signal? string signal that the agent gives when it is taken
---@field tell? table message that the agent tells when it is taken, as in a state
---@field on_take? fun(me: jostle.Me) called when it is taken
---@field id? string name for mods; default: the name in `to`, with #2, #3 for repeats

---@class jostle.Me
---@field id number number of the agent, never used for another one
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
---@field fallen number time since it fell; 0 while it stands, s
---@field team number number of its team; 0: none
---@field state string name of its state; nil of a neighbour without a machine
---@field machine string name of its machine; nil of a neighbour without one
---@field goal string its goal; can be set
---@field neighbours jostle.Me[] views of the agents that it sees, nearest first: those within perception, with no wall and no tall body between; its `neighbours` nearest, and in a crowd of at most 64 all of them. A view shows the agent as it was before the step; memory that is set in it changes after the step; memory that its machine lacks is nil
---@field signal fun(name: string) gives a signal: me.signal("alarm")
---@field tell any tells somebody a message, as `tell` does: me.tell(me.prey, "shot", { damage = 2 })
---@field told fun(name: string) the oldest message of this name that waits, a table of its `sender` and values; nil if none does. It is used up
---@field holding any the body that it carries, else the agent that it holds on to; nil: none. Memory that holds somebody is read in the same way: a view of an agent or body (a body has id, x, y, vx and vy), the name of a place, or nil; and it is set to one of them
---@field striker any who kicked or threw the body that hit it in the last step, else that body; nil: none
---@field in_sight boolean of a view: the agent sees it now. Of one whom it remembers and does not see, only `id` is known
---@field [string] any a parameter, or what memory declares

--- `inside(place) or inside(target, place)`: the agent, or the target, is in the place; at a point, line or queue no wall or closed gate may lie between, except a solid that contains the point
---@param a1 string|jostle.Target|jostle.Number
---@param a2? string|jostle.Target|jostle.Number
---@return jostle.Condition
function inside(a1, a2) end

--- `arrived(place)`: the agent is in the place; or agents within 0.3 m ahead of it, who have arrived there or stand there, have kept it from getting nearer for a second. So the last of a crowd arrive, too, where a place is full. It holds until the agent wants to move away
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function arrived(a1) end

--- `crosses(line)`: the agent crossed the line in the last step, from the line's right to its left
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function crosses(a1) end

--- `near(target, metres)`: the target is nearer than this distance, m; if it is a place, no wall or closed gate may lie between, except walls that its nearest point lies on or in
---@param a1 string|jostle.Target|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Condition
function near(a1, a2) end

--- `touches(target)`: the gap between the agent and the target, of torsos or discs, is below 5 cm
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function touches(a1) end

--- `first_in(queue)`: the agent is at the head of the queue that it steers in
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function first_in(a1) end

--- `joined(queue)`: the agent has come to the queue that it steers in, and taken its place there
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function joined(a1) end

--- `after(seconds)`: the agent has been in this state for at least this time, s
---@param a1 number|jostle.Number
---@return jostle.Condition
function after(a1) end

--- `lasted`: the duration that `lasts` drew for this state is over
---@type jostle.Condition
lasted = nil

--- `stuck(seconds)`: the agent has not moved by 0.25 m for this time, s
---@param a1 number|jostle.Number
---@return jostle.Condition
function stuck(a1) end

--- `fallen`: the agent lies after a fall (see `balance`); `now.fallen` is the time since then
---@type jostle.Condition
fallen = nil

--- `hit_by(target)`: a target faster than 1 m/s touches the agent, or hit it in the last step
---@param a1 jostle.Target
---@return jostle.Condition
function hit_by(a1) end

--- `grounded(target)`: the body touches the ground
---@param a1 jostle.Target
---@return jostle.Condition
function grounded(a1) end

--- `incoming(target, metres)`: the target, if it keeps its velocity, passes within this distance, m, of where the agent stands during the next 2 s
---@param a1 jostle.Target
---@param a2 number|jostle.Number
---@return jostle.Condition
function incoming(a1, a2) end

--- `kicked(target)`: the agent kicked or threw the body in the last step
---@param a1 jostle.Target
---@return jostle.Condition
function kicked(a1) end

--- `exists(target)`: there is such a person, body or place. Whom the agent remembers it knows to be in the world out of sight, too, unless the target has a filter; who has left the world does not exist
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function exists(a1) end

--- `same(target, target)`: both targets are the same person, body or place; false if there is none
---@param a1 string|jostle.Target|jostle.Number
---@param a2 string|jostle.Target|jostle.Number
---@return jostle.Condition
function same(a1, a2) end

--- `has(target)`: the agent carries the body (see `take`), or holds on to an agent that the target selects (see `grasp`)
---@param a1 jostle.Target
---@return jostle.Condition
function has(a1) end

--- `sees(target)`: the target exists and is within perception, with no wall and no tall body between
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function sees(a1) end

--- `heard(name [, metres])`: an agent within perception (and within this distance, m) gave the signal in the last step, with no wall of 1.3 m or more between; or the scene gives it now. Bodies between do not matter
---@param a1 string
---@param a2? number|jostle.Number
---@return jostle.Condition
function heard(a1, a2) end

--- `told(name)`: a message of this name waits for the agent (see `tell`). told(name).sender is who told it, a target; told(name).VALUE a value that it carries, a number, or a target where one is wanted. It waits until an item is taken whose `when` rests on it; of several the oldest is meant. At most 8 messages wait for an agent
---@param a1 string
---@return jostle.Condition
function told(a1) end

--- `shut(place)`: a gate at the place, or within 0.5 m of it, is closed, and the agent sees it: within perception, with no other wall between. Bodies between do not matter
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Condition
function shut(a1) end

--- `open(gate)`: the walls of this name are open. Agents know it wherever they are, as of a door whose opening is announced
---@param a1 string
---@return jostle.Condition
function open(a1) end

--- `density(place)` in 1/m2: people per square metre in a place; at a point, line or queue: within 2 m of it
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function density(a1) end

--- `count(place)`: number of people in a place
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function count(a1) end

--- `queued(queue)`: number of people who steer in the queue, also those on their way to their place in it
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function queued(a1) end

--- `distance(target)` in m: distance to the target; 0 in a place, infinite if there is no such target
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Number
function distance(a1) end

--- `neighbours(tag)`: number of agents that the agent sees and that bear the tag, or are "anyone", "teammates" or "opponents". Seen are its `neighbours` nearest, and in a crowd of at most 64 all agents, within perception, with no wall and no tall body between. `:in_state` and the like select among them
---@param a1 string
---@return jostle.Number
function neighbours(a1) end

--- `theirs(target, name)`: value of this memory of the target, an agent, if its machine makes it `public`; true is 1. 0 if there is no such agent or memory
---@param a1 jostle.Target
---@param a2 string
---@return jostle.Number
function theirs(a1, a2) end

--- `density_here` in 1/m2: people per square metre about the agent, from its neighbours' distances
---@type jostle.Number
density_here = nil

--- `headway` in m: free distance ahead to the next neighbour that does not come the other way; the perception radius if there is none
---@type jostle.Number
headway = nil

--- `eagerness`: how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds of `haste`
---@type jostle.Number
eagerness = nil

--- `pushed` in N: magnitude of the net force on the agent
---@type jostle.Number
pushed = nil

--- `compression` in N/m: sum of contact force magnitudes, divided by the circumference
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

--- `min(a, b)`: the smaller of two numbers
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Number
function min(a1, a2) end

--- `max(a, b)`: the greater of two numbers
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

--- `clamp(a, least, greatest)`: a, kept within two bounds
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@param a3 number|jostle.Number
---@return jostle.Number
function clamp(a1, a2, a3) end

--- `now.NAME`: what is measured of the agent now; NAME is one of speed fallen x y neighbours driven time density headway eagerness pushed compression load contacts holders time_in_state
---@type table<string, jostle.Number>
now = {}

--- `own.NAME`: the agent's own value: drawn from `defaults` or `own`, unless its group in the scene sets it; a number or a place
---@type table<string, jostle.Number>
own = {}

--- `nearest(tag)`: the nearest body or agent that bears the tag, or the nearest agent of "anyone", "opponents" or "teammates", that the agent sees: with no wall and no tall body between. `:in_state` and the like select among agents
---@param a1 string
---@return jostle.Target
function nearest(a1) end

--- `best(tag, score)`: of those that `nearest` chooses from, the one with the greatest score, a number in which `other` is the candidate; of equal ones agents before bodies, by ascending id
---@param a1 string
---@param a2 number|jostle.Number
---@return jostle.Target
function best(a1, a2) end

--- `other`: in the score of `best`: the candidate
---@type jostle.Target
other = nil

--- `nobody`: no person, body or place: memory that begins with it holds somebody, as `set = { prey = nearest "people" }`; a target everywhere else, which is not there once that person or body has left the world
---@type jostle.Target
nobody = nil

--- `holding`: the body that the agent carries (see `take`), else the agent that it holds on to (see `grasp`)
---@type jostle.Target
holding = nil

--- `striker`: the agent that kicked or threw the body which hit this one in the last step; that body, if nobody did
---@type jostle.Target
striker = nil

--- `one_of(set)`: a member of a set of places, drawn on entering the state; from then on it is the agent's `goal`
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Target
function one_of(a1) end

--- `goal`: the place that `one_of` drew last, or that a function or the scene set
---@type jostle.Target
goal = nil

--- `last_seen(memory)`: the point where the agent last saw whom this memory holds; none before it saw it
---@param a1 jostle.Target
---@return jostle.Target
function last_seen(a1) end

--- `home`: the place where the agent entered the world, or took up its present machine
---@type jostle.Target
home = nil

--- `seek(target)`: straight to the target; the agent passes over a line, and stops at a point
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function seek(a1) end

--- `field(place)`: the shortest way to the place, round walls and large bodies; to a set: to the member that is nearest by that way
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function field(a1) end

--- `away_from(target)`: straight away from the target
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function away_from(a1) end

--- `dodge(target [, metres])`: sideways, out of the line along which the target comes, until that passes at this distance, m; to the nearer side, or to the other one if a wall is in the way
---@param a1 jostle.Target
---@param a2? number
---@return jostle.Steering
function dodge(a1, a2) end

--- `orbit(place [, options])`: round a place, counter-clockwise. Options: inward, density_near, density_far, far and beyond set how dense the crowd about it may be
---@return jostle.Steering
function orbit(...) end

--- `queue(place)`: to the end of a queue, along it where walls hide that, and straight where they hide all of it (`field` leads round them); an agent that comes within 1 m of the queue takes the next place, and moves up as those before it leave
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function queue(a1) end

--- `along(place)`: in the direction of a line, or along a queue to its head
---@param a1 string|jostle.Target|jostle.Number
---@return jostle.Steering
function along(a1) end

--- `follow(target [, metres])`: to a position behind the target, at this distance, m
---@param a1 string|jostle.Target|jostle.Number
---@param a2? number
---@return jostle.Steering
function follow(a1, a2) end

--- `together([metres])`: towards the teammates that the agent sees, if they are farther away than this distance, m
---@param a1? number
---@return jostle.Steering
function together(a1) end

--- `drift(x, y)`: in the direction x east and y north, numbers or expressions; a length of 1 means the wanted speed
---@param a1 number|jostle.Number
---@param a2 number|jostle.Number
---@return jostle.Steering
function drift(a1, a2) end

--- `wander([place])`: walks about: turns gradually, and away from walls; with a place: stays within it
---@param a1? string|jostle.Target|jostle.Number
---@return jostle.Steering
function wander(a1) end

--- `formation(target [, metres])`: to the agent's place in a row, with this distance, m, from one to the next: along a line, or behind an agent and across the direction in which it looks. Agents keep the order in which they stand
---@param a1 string|jostle.Target|jostle.Number
---@param a2? number
---@return jostle.Steering
function formation(a1, a2) end

--- `gather(place [, degrees])`: to the agent's spot in a crowd that waits in a polygon, round walls and fixed bodies. The crowd fills the polygon from its front, which lies in this direction, degrees anti-clockwise from +x; agents stand 0.9 m apart, or closer where they are many, to 0.51 m and 1.2 breadths. Agents for whom there is no room stand around it
---@param a1 string|jostle.Target|jostle.Number
---@param a2? number
---@return jostle.Steering
function gather(a1, a2) end

--- `spread`: away from the neighbours
---@type jostle.Steering
spread = nil

--- `evade`: sideways, out of the way of oncoming agents; to the right of one that is straight ahead
---@type jostle.Steering
evade = nil

--- `hold`: the agent stands still
---@type jostle.Steering
hold = nil

--- `player`: a person at the live page, or the input log, drives this agent
---@type jostle.Steering
player = nil

--- `normal(mean, deviation [, least, greatest])`: a normal distribution, drawn once per agent
---@return jostle.Drawn
function normal(...) end

--- `lognormal(mean, deviation [, least, greatest])`: a number whose logarithm has a normal distribution of this mean and deviation, drawn once per agent
---@return jostle.Drawn
function lognormal(...) end

--- `gamma(shape, scale [, least, greatest])`: a gamma distribution; its mean is shape times scale, drawn once per agent
---@return jostle.Drawn
function gamma(...) end

--- `weibull(shape, scale [, least, greatest])`: a Weibull distribution, drawn once per agent
---@return jostle.Drawn
function weibull(...) end

--- `uniform(least, greatest)`: a uniform distribution between two bounds, drawn once per agent
---@return jostle.Drawn
function uniform(...) end

--- `choose(a, b, ...)`: one of up to 8 values, with equal probability, drawn once per agent
---@return jostle.Drawn
function choose(...) end

--- `circuits(place)`: for `counts`: net number of counter-clockwise turns about a place since the agent first crossed its start line; turns back are subtracted
---@param a1 string|jostle.Target|jostle.Number
---@return any
function circuits(a1) end

--- `memory { name = value, ... }`: declares the memory of each agent: numbers, booleans, and somebody, which begins as `nobody`; kept through reloads. The result is a table of their values as expressions and targets
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

--- `before(function)`: in a patch, for on_enter, on_exit, on_take, when or steer: runs a function(me) before what stands there, a function or not, which goes on to work and alone gives the result
---@param f fun(me: jostle.Me)
---@return any
function before(f) end

--- `afterwards(function)`: in a patch: as `before`, but runs the function after what stands there
---@param f fun(me: jostle.Me)
---@return any
function afterwards(f) end

--- `around(function)`: in a patch: calls function(me, previous) in place of what stands there; previous(me) calls that, and returns true or false for `when`, the velocity as two numbers in m/s for `steer`
---@param f fun(me: jostle.Me, previous: fun(me: jostle.Me): any, any): any, any
---@return any
function around(f) end

--- `settings.NAME`: in a mod: the value of a setting: a plain number, true or false, or a text
---@type table<string, jostle.Number>
settings = {}
