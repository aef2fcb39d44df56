---@meta
-- Definitions of the words of behaviours and of their tests for lua-language-server.
-- Made by `jostle reference lua-ls`. In .luarc.json: "workspace.library": ["scripts/editor"]

--- Holds or does not: `a & b`, `a | b`, `~a`.
---@class jostle.Condition
---@operator band(jostle.Condition): jostle.Condition
---@operator bor(jostle.Condition): jostle.Condition
---@operator bnot: jostle.Condition

--- A number that is computed in each step.
---@class jostle.Number
---@operator add(jostle.Value): jostle.Number
---@operator sub(jostle.Value): jostle.Number
---@operator mul(jostle.Value): jostle.Number
---@operator mul(jostle.Steering): jostle.Steering
---@operator div(jostle.Value): jostle.Number
---@operator unm: jostle.Number
local Number = {}
--- the number is greater than the bound
---@param bound jostle.Value
---@return jostle.Condition
function Number:above(bound) end
--- the number is less than the bound
---@param bound jostle.Value
---@return jostle.Condition
function Number:below(bound) end
--- the number is not less than the bound
---@param bound jostle.Value
---@return jostle.Condition
function Number:at_least(bound) end
--- the number is not greater than the bound
---@param bound jostle.Value
---@return jostle.Condition
function Number:at_most(bound) end
--- the number is equal to the bound
---@param bound jostle.Value
---@return jostle.Condition
function Number:is(bound) end

--- A number of people that are seen.
---@class jostle.Counted: jostle.Number
local Counted = {}
--- restricts `nearest`, `best`, `neighbours` and targets that are somebody to agents in a state of this name
---@param name string
---@return jostle.Counted
function Counted:in_state(name) end
--- restricts them to agents whose machine has this name
---@param name string
---@return jostle.Counted
function Counted:of_machine(name) end
--- restricts them to agents of this group of the scene
---@param name string
---@return jostle.Counted
function Counted:of_group(name) end
--- restricts them to agents whose public memory of this name is true, or is a number from least to greatest; :where(name, false) to those of whom it is false
---@param name string
---@param least? number
---@param greatest? number
---@return jostle.Counted
function Counted:where(name, least, greatest) end
--- restricts them to agents that lie after a fall (see `balance`)
---@return jostle.Counted
function Counted:fallen() end
--- restricts them to agents and bodies that pass within this distance, m, of where the agent stands during the next 2 s if they keep their velocity
---@param metres number
---@return jostle.Counted
function Counted:incoming(metres) end
--- restricts a target, or `neighbours`, to what is nearer than this distance, m, between centres
---@param metres number
---@return jostle.Counted
function Counted:within(metres) end
--- restricts them to what lies ahead: within this angle, degrees, to either side of where the agent looks
---@param degrees number
---@return jostle.Counted
function Counted:ahead(degrees) end
--- the list in memory holds this number or target
---@param item any
---@return jostle.Counted
function Counted:contains(item) end

--- A person, body or place. Its numbers are 0 if it is not there, or not seen.
---@class jostle.Target
---@field speed jostle.Number present speed, m/s
---@field fallen jostle.Number time since the agent fell; 0 while it stands, s
---@field x jostle.Number position east, m
---@field y jostle.Number position north; in a building with storeys, in plan, m
---@field storey jostle.Number number of the storey: 0 is the lowest one; on a stair, the nearer in height
---@field height jostle.Number elevation of the floor on which the agent is, also of a lift's car; 0 without storeys, m
---@field neighbours jostle.Number neighbours seen
---@field driven jostle.Number speed that a person or an input log asks of the agent (`player`); 0: none, m/s
---@field played jostle.Number 1 once a person or an input log drives the agent (`player`), also while it is to stand; before 0
---@field button jostle.Number 1 while the person who drives the agent holds the button, else 0
---@field time jostle.Number simulated time, s
---@field density jostle.Number people per square metre about the agent, from its neighbours' distances, 1/m2
---@field headway jostle.Number free distance ahead to the next neighbour that does not come the other way; the perception radius if there is none, m
---@field eagerness jostle.Number how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds of `haste`
---@field pushed jostle.Number magnitude of the net force on the agent, N
---@field compression jostle.Number sum of contact force magnitudes, divided by the circumference, N/m
---@field load jostle.Number greatest push borne from any one direction: over directions d, the greatest sum of the positive parts of f.d over its contacts f, N
---@field contacts jostle.Number agents and bodies touched
---@field holders jostle.Number agents that hold on to the agent (see `grasp`)
---@field time_in_state jostle.Number since the state was entered, s
local Target = {}
--- restricts `nearest`, `best`, `neighbours` and targets that are somebody to agents in a state of this name
---@param name string
---@return jostle.Target
function Target:in_state(name) end
--- restricts them to agents whose machine has this name
---@param name string
---@return jostle.Target
function Target:of_machine(name) end
--- restricts them to agents of this group of the scene
---@param name string
---@return jostle.Target
function Target:of_group(name) end
--- restricts them to agents whose public memory of this name is true, or is a number from least to greatest; :where(name, false) to those of whom it is false
---@param name string
---@param least? number
---@param greatest? number
---@return jostle.Target
function Target:where(name, least, greatest) end
--- restricts them to agents that lie after a fall (see `balance`)
---@return jostle.Target
function Target:fallen() end
--- restricts `nearest` to bodies in the air, which touch neither the ground nor a fixed body and which nobody carries
---@return jostle.Target
function Target:flying() end
--- restricts them to agents and bodies that pass within this distance, m, of where the agent stands during the next 2 s if they keep their velocity
---@param metres number
---@return jostle.Target
function Target:incoming(metres) end
--- restricts a target, or `neighbours`, to what is nearer than this distance, m, between centres
---@param metres number
---@return jostle.Target
function Target:within(metres) end
--- restricts them to what lies ahead: within this angle, degrees, to either side of where the agent looks
---@param degrees number
---@return jostle.Target
function Target:ahead(degrees) end
--- the list in memory holds this number or target
---@param item any
---@return jostle.Target
function Target:contains(item) end

---@class jostle.Nobody: jostle.Target

--- A message that waits: `sender`, and the values that it carries.
---@class jostle.Message: jostle.Condition
---@field sender jostle.Target
---@field [string] jostle.Memory

--- What memory holds: a number, a condition, or somebody.
---@class jostle.Memory: jostle.Number, jostle.Condition, jostle.Target

--- What `memory` declares, as expressions.
---@class jostle.Remembered
---@field [string] jostle.Memory

--- An own value of the agent: a number or a place.
---@class jostle.OwnValue: jostle.Number

---@class jostle.Own
---@field [string] jostle.OwnValue what `own` declares
---@field speed jostle.OwnValue wanted speed, m/s; 0 to 20, default 1.3
---@field max_speed jostle.OwnValue hard cap on speed; only a contact impulse exceeds it, m/s; 0 to 30, default 1.8
---@field perception jostle.OwnValue radius within which neighbours and bodies are seen, m; 0 to 100, default 3
---@field neighbours jostle.OwnValue greatest number of neighbours that are considered; 0 to 16, default 10
---@field horizon jostle.OwnValue time ahead for which other agents are avoided, s; 0.01 to 30, default 0.5
---@field wall_horizon jostle.OwnValue time ahead for which walls are avoided, s; 0.01 to 30, default 0.3
---@field push jostle.OwnValue force with which an agent pushes agents in its way, N; 0 to 5000, default 0
---@field push_reach jostle.OwnValue greatest gap over which an agent pushes, m; 0 to 2, default 0.1
---@field push_angle jostle.OwnValue half-angle of the cone in which an agent pushes, degree; 0 to 180, default 60
---@field absorb jostle.OwnValue share of a force that is passed on (k of equations 8 and 9); 0 to 1, default 0.8
---@field brace_angle jostle.OwnValue half-angle of the cone that takes a passed-on force, degree; 0 to 180, default 60
---@field yield jostle.OwnValue share of mutual avoidance that the agent takes; 0.5 is reciprocal; 0 to 1, default 0.5
---@field radius jostle.OwnValue radius of the disc for which an agent keeps room as it walks, m; 0.02 to 5, default 0.2
---@field breadth jostle.OwnValue breadth of the torso across the shoulders; 0: 2.25 times the radius, m; 0 to 10, default 0
---@field depth jostle.OwnValue depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth, m; 0 to 10, default 0
---@field mass jostle.OwnValue mass, kg; 1 to 10000, default 70
---@field restitution jostle.OwnValue restitution of contacts between agents; 0 to 1, default 0
---@field damping jostle.OwnValue how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace jostle.OwnValue force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap jostle.OwnValue time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste jostle.OwnValue motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field step_back jostle.OwnValue speed at which an agent that stands steps back to where it stood before it was moved, m/s; 0 to 2, default 0.11
---@field balance jostle.OwnValue longest step by which an agent that forces throw regains its balance; 0: it never falls, m; 0 to 2, default 0
---@field stance jostle.OwnValue how far to either side of an agent that stands its feet are; they hold it against forces from the side, m; 0 to 1, default 0
---@field rise jostle.OwnValue time that an agent lies after a fall, until it gets up, s; 0 to 1e+06, default 5
---@field stair_up jostle.OwnValue wanted speed up stairs, along the slope; 0: that of level ground, lessened by the slope, m/s; 0 to 5, default 0
---@field stair_down jostle.OwnValue the same down stairs, m/s; 0 to 5, default 0
---@field escalator_walk jostle.OwnValue chance that an agent walks on a running escalator; otherwise it stands on it; 0 to 1, default 0.25
---@field lifts jostle.OwnValue how an agent gets to other storeys: 0 never by a lift, 0.5 either by stairs or by a lift that takes less time, 1 only by lifts and ramps, as it cannot use stairs; 0 to 1, default 0.5

---@class jostle.Now
---@field speed jostle.Number present speed, m/s
---@field fallen jostle.Number time since the agent fell; 0 while it stands, s
---@field x jostle.Number position east, m
---@field y jostle.Number position north; in a building with storeys, in plan, m
---@field storey jostle.Number number of the storey: 0 is the lowest one; on a stair, the nearer in height
---@field height jostle.Number elevation of the floor on which the agent is, also of a lift's car; 0 without storeys, m
---@field neighbours jostle.Number neighbours seen
---@field driven jostle.Number speed that a person or an input log asks of the agent (`player`); 0: none, m/s
---@field played jostle.Number 1 once a person or an input log drives the agent (`player`), also while it is to stand; before 0
---@field button jostle.Number 1 while the person who drives the agent holds the button, else 0
---@field time jostle.Number simulated time, s
---@field density jostle.Number people per square metre about the agent, from its neighbours' distances, 1/m2
---@field headway jostle.Number free distance ahead to the next neighbour that does not come the other way; the perception radius if there is none, m
---@field eagerness jostle.Number how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds of `haste`
---@field pushed jostle.Number magnitude of the net force on the agent, N
---@field compression jostle.Number sum of contact force magnitudes, divided by the circumference, N/m
---@field load jostle.Number greatest push borne from any one direction: over directions d, the greatest sum of the positive parts of f.d over its contacts f, N
---@field contacts jostle.Number agents and bodies touched
---@field holders jostle.Number agents that hold on to the agent (see `grasp`)
---@field time_in_state jostle.Number since the state was entered, s

--- A value that is drawn once for each agent.
---@class jostle.Drawn

---@class jostle.Counter

---@class jostle.None

---@class jostle.Back

--- A behaviour: what its file returns.
---@class jostle.MachineValue

--- A direction in which to go: weighted sums, `0.8 * seek(goal) + 0.2 * spread`.
---@class jostle.Steering
---@operator add(jostle.Steering): jostle.Steering
---@operator mul(jostle.Value): jostle.Steering

---@alias jostle.Value number|jostle.Number
---@alias jostle.Place string|jostle.Target|jostle.OwnValue
---@alias jostle.AnyTarget string|jostle.Target|jostle.OwnValue
---@alias jostle.Tag "anyone"|"teammates"|"opponents"|string

--- Values of parameters, as in `defaults`.
---@class jostle.Parameters
---@field speed? jostle.Value|jostle.Drawn wanted speed, m/s; 0 to 20, default 1.3
---@field max_speed? jostle.Value|jostle.Drawn hard cap on speed; only a contact impulse exceeds it, m/s; 0 to 30, default 1.8
---@field perception? jostle.Value|jostle.Drawn radius within which neighbours and bodies are seen, m; 0 to 100, default 3
---@field neighbours? jostle.Value|jostle.Drawn greatest number of neighbours that are considered; 0 to 16, default 10
---@field horizon? jostle.Value|jostle.Drawn time ahead for which other agents are avoided, s; 0.01 to 30, default 0.5
---@field wall_horizon? jostle.Value|jostle.Drawn time ahead for which walls are avoided, s; 0.01 to 30, default 0.3
---@field push? jostle.Value|jostle.Drawn force with which an agent pushes agents in its way, N; 0 to 5000, default 0
---@field push_reach? jostle.Value|jostle.Drawn greatest gap over which an agent pushes, m; 0 to 2, default 0.1
---@field push_angle? jostle.Value|jostle.Drawn half-angle of the cone in which an agent pushes, degree; 0 to 180, default 60
---@field absorb? jostle.Value|jostle.Drawn share of a force that is passed on (k of equations 8 and 9); 0 to 1, default 0.8
---@field brace_angle? jostle.Value|jostle.Drawn half-angle of the cone that takes a passed-on force, degree; 0 to 180, default 60
---@field yield? jostle.Value|jostle.Drawn share of mutual avoidance that the agent takes; 0.5 is reciprocal; 0 to 1, default 0.5
---@field radius? jostle.Value|jostle.Drawn radius of the disc for which an agent keeps room as it walks, m; 0.02 to 5, default 0.2
---@field breadth? jostle.Value|jostle.Drawn breadth of the torso across the shoulders; 0: 2.25 times the radius, m; 0 to 10, default 0
---@field depth? jostle.Value|jostle.Drawn depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth, m; 0 to 10, default 0
---@field mass? jostle.Value|jostle.Drawn mass, kg; 1 to 10000, default 70
---@field restitution? jostle.Value|jostle.Drawn restitution of contacts between agents; 0 to 1, default 0
---@field damping? jostle.Value|jostle.Drawn how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace? jostle.Value|jostle.Drawn force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap? jostle.Value|jostle.Drawn time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste? jostle.Value|jostle.Drawn motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field step_back? jostle.Value|jostle.Drawn speed at which an agent that stands steps back to where it stood before it was moved, m/s; 0 to 2, default 0.11
---@field balance? jostle.Value|jostle.Drawn longest step by which an agent that forces throw regains its balance; 0: it never falls, m; 0 to 2, default 0
---@field stance? jostle.Value|jostle.Drawn how far to either side of an agent that stands its feet are; they hold it against forces from the side, m; 0 to 1, default 0
---@field rise? jostle.Value|jostle.Drawn time that an agent lies after a fall, until it gets up, s; 0 to 1e+06, default 5
---@field stair_up? jostle.Value|jostle.Drawn wanted speed up stairs, along the slope; 0: that of level ground, lessened by the slope, m/s; 0 to 5, default 0
---@field stair_down? jostle.Value|jostle.Drawn the same down stairs, m/s; 0 to 5, default 0
---@field escalator_walk? jostle.Value|jostle.Drawn chance that an agent walks on a running escalator; otherwise it stands on it; 0 to 1, default 0.25
---@field lifts? jostle.Value|jostle.Drawn how an agent gets to other storeys: 0 never by a lift, 0.5 either by stairs or by a lift that takes less time, 1 only by lifts and ramps, as it cannot use stairs; 0 to 1, default 0.5

---@class jostle.Machine
---@field name? string name of the behaviour in messages and for mods
---@field version? number a number for messages, chosen by the author
---@field start? string state in which agents begin
---@field defaults? jostle.Parameters values for all states, drawn once per agent
---@field own? table<string, number|boolean|string|jostle.Drawn> own values besides the parameters, drawn once per agent: numbers, distributions, or places by name; a group of the scene may set them
---@field public? string|string[] memory that other agents may read, by `theirs` and `:where`
---@field counts? table<string, jostle.Counter> memory that counts by itself, in all states; see `circuits`
---@field renamed? table<string, string> old name = new name, for states, own values and memory that were renamed: agents keep them at a reload. A scene, mod or other behaviour that uses the old name gets an error that names the new one
---@field states? table<string, jostle.State> name of a state = its table

---@class jostle.State: jostle.Parameters
---@field [integer] jostle.Transition the items are its transitions and reactions
---@field steer? jostle.Steering|fun(me: jostle.Me): number, number where the agent wants to go: a steering word, a weighted sum of them, or function(me) that returns vx, vy in m/s
---@field runs? jostle.MachineValue a machine that the agent runs while it is in this state, which begins anew each time. Its states are named after this one, "Guard.Walk", and inherit what they do not set; the transitions of this state come first, and its clocks are its own
---@field ends? boolean the machine ends in this state; a state that runs it finds `done` true
---@field lasts? jostle.Value|jostle.Drawn duration of the state, drawn on entering it; see `lasted`, s
---@field removes? boolean the agent leaves the world on entering
---@field lies? boolean the live page shows the agent as lying down; nothing else changes
---@field pose? "brace"|"raise"|"carry"|"throw"|"point"|"sit"|"kneel" how the live page draws the agent: "brace", "raise", "carry", "throw" or "point" with its arms, "sit" or "kneel" with its whole body; nothing else changes
---@field become? string on entering, the agent changes to another machine, at its start; it keeps its body, the values that the scene gave it, and memory of the same name
---@field push_when? jostle.Condition the agent pushes only while this holds
---@field push_toward? jostle.AnyTarget direction in which the agent pushes; without it the direction in which it wants to go
---@field push_weight? "equal"|"nearest" "equal" shares the push among all agents in the way, "nearest" gives it to the nearest
---@field push_only? string|string[] the agent pushes only agents with these tags
---@field ignore? string|string[] the agent does not avoid agents and bodies with these tags
---@field face? jostle.AnyTarget where the agent looks; without it in its walking direction
---@field approach? jostle.AnyTarget body or agent that the agent does not avoid in advance; it only does not overlap it. Agents are then kept apart by contacts alone, where forces are on
---@field stays_in? jostle.AnyTarget polygon that the agent does not leave of its own accord, as a player a court: it stops with its whole body before the edges, however it is steered or driven, and comes back if others pushed it out
---@field kick? jostle.Kick kicks a body that it touches, with no wall between. The body passes the agent's own body until it is clear of it
---@field take? jostle.AnyTarget body to pick up, if it is within 0.6 m and slower than 8 m/s, hands reach it and there is room to hold it. It is carried in front, its middle at 1.2 m above the ground; nearer or to a side where a wall, or a body that is static, driven or heavier than 200 kg, leaves no room, and it falls where there is none. Hands reach over obstacles that are lower than the lowest point of the body
---@field drop? jostle.AnyTarget body that the agent carries and lets fall, as `drop = holding`
---@field grasp? jostle.AnyTarget agent to take hold of, if it is within 0.5 m. An agent that has fallen gets up the sooner, the more hold on to it. Both pull each other until the holder comes into a state without `grasp`, or 1 m is between them. The held agent is dragged, or carried while its own `damping` is 0; see `has` and `holders`
---@field grip? jostle.Value greatest force with which the agent holds on; default 300, N
---@field throw? jostle.Throw throws the body that it carries, from its own side of walls
---@field colour? string colour of agents in this state where people are coloured by state; one of blue, orange, green, vermilion, sky, purple, yellow, wine or grey, which all eyes tell apart, or "#rrggbb" in quotes. Default: one is chosen
---@field signal? string|jostle.Signal signal that the agent gives on entering, and again after each interval with { name, every = seconds }
---@field tell? jostle.Tell message that the agent tells on entering: to whom, a target, also one that is remembered and out of sight, or `neighbours(tag)` for all those; its name; and up to 4 values, numbers, conditions (1 if they hold, else 0) or targets. Its values are those before `set`. It waits for the receiver from the next step on (see `told`)
---@field set? jostle.Set values to set on entering, all of them computed from what was before: memory = number, condition, true/false, target, or a list's :push(item), :remove(item) or :clear(); team = name of a team; tags = tag or list of tags, in place of those that the agent had. Teams and tags may be new
---@field counts? table<string, jostle.Counter> memory that counts while the agent is in this state; see `circuits`
---@field on_enter? fun(me: jostle.Me) called when an agent enters the state
---@field on_exit? fun(me: jostle.Me) called when an agent leaves the state

---@class jostle.Transition
---@field to? string|jostle.Back state to which it leads; see `back`. An item without it is a reaction: what it says is done, and the agent stays in its state. All reactions that hold are carried out, then the first transition that holds is taken
---@field when? jostle.Condition|fun(me: jostle.Me): boolean the transition is taken when this holds; of several that hold, the first. Without it: at once
---@field every? number only when the time in the state reaches a multiple of this, s
---@field chance? jostle.Value probability that it is taken, drawn each time that `when` becomes true
---@field set? jostle.Set values to set when it is taken: memory, team and tags, as in a state
---@field signal? string signal that the agent gives when it is taken
---@field tell? jostle.Tell message that the agent tells when it is taken, as in a state
---@field on_take? fun(me: jostle.Me) called when it is taken
---@field id? string name for mods; default: the name in `to`, with #2, #3 for repeats

---@class jostle.Kick
---@field [1] jostle.Target the body
---@field at? jostle.AnyTarget target of the kick; straight ahead without it, or while there is no such target in sight
---@field impulse? jostle.Value change of the body's velocity (impulse in N s per kg of the body), m/s
---@field speed? jostle.Value in place of `impulse`: speed of the body after the kick, exactly towards `at`, however it moved before; 0 stops it, m/s
---@field lift? jostle.Value angle of the kick above the horizontal, so that the body flies and falls; default 0. The impulse keeps its size, degree

---@class jostle.Throw
---@field [1] jostle.Target the body
---@field at? jostle.AnyTarget target of the throw
---@field speed? jostle.Value horizontal speed of the throw, m/s

---@class jostle.Signal
---@field [1] string its name
---@field every? number time between two signals, s

--- A message: to whom, its name, and up to four values.
---@class jostle.Tell
---@field [1] jostle.Target|jostle.Counted
---@field [2] string
---@field [string] jostle.Value|jostle.Target

--- Values to set: memory, team and tags.
---@class jostle.Set
---@field team? string
---@field tags? string|string[]
---@field [string] number|boolean|jostle.Number|jostle.Condition|jostle.Target

--- Options of `orbit`.
---@class jostle.OrbitOptions
---@field inward? number -10 to 10, default 0.5
---@field density_near? number 0 to 20 1/m2, default 5.6
---@field density_far? number 0 to 20 1/m2, default 4.6
---@field far? number 0.1 to 10000 m, default 40
---@field beyond? number 0 to 10000 m, default 50

--- The agent that a function runs for. Memory and parameters can be set. To have your memory
--- completed too, name it: ---@class jostle.Me, and ---@field laps number.
---@class jostle.Me
---@field [string] any what memory declares
---@field id number number of the agent, never used for another one
---@field x number position east, m
---@field y number position north; in a building with storeys, in plan, m
---@field storey number number of the storey: 0 is the lowest one; on a stair, the nearer in height
---@field height number elevation of the floor on which the agent is; 0 without storeys, m
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
---@field neighbours jostle.View[] views of the agents that it sees, nearest first: those within perception, with no wall and no tall body between; its `neighbours` nearest, and in a crowd of at most 64 all of them. A view shows the agent as it was before the step; memory that is set in it changes after the step; memory that its machine lacks is nil
---@field signal fun(name: string) gives a signal: me.signal("alarm")
---@field tell fun(whom: jostle.View, name: string, values?: table<string, number|jostle.View>) tells somebody a message, as `tell` does: me.tell(me.prey, "shot", { damage = 2 })
---@field told fun(name: string): jostle.Told|nil the oldest message of this name that waits, a table of its `sender` and values; nil if none does. It is used up when the functions and items of this step are done; further calls get the next one
---@field holding jostle.View|nil the body that it carries, else the agent that it holds on to; nil: none. A list in memory is read as a table, a copy, and changed by setting it to a table. Memory that holds somebody is read in the same way: a view of an agent or body (a body has id, x, y, vx and vy), the name of a place, or nil; and it is set to one of them
---@field striker jostle.View|nil who kicked or threw the body that hits it, else that body; nil: none
---@field speed number wanted speed, m/s; 0 to 20, default 1.3
---@field max_speed number hard cap on speed; only a contact impulse exceeds it, m/s; 0 to 30, default 1.8
---@field perception number radius within which neighbours and bodies are seen, m; 0 to 100, default 3
---@field horizon number time ahead for which other agents are avoided, s; 0.01 to 30, default 0.5
---@field wall_horizon number time ahead for which walls are avoided, s; 0.01 to 30, default 0.3
---@field push number force with which an agent pushes agents in its way, N; 0 to 5000, default 0
---@field push_reach number greatest gap over which an agent pushes, m; 0 to 2, default 0.1
---@field push_angle number half-angle of the cone in which an agent pushes, degree; 0 to 180, default 60
---@field absorb number share of a force that is passed on (k of equations 8 and 9); 0 to 1, default 0.8
---@field brace_angle number half-angle of the cone that takes a passed-on force, degree; 0 to 180, default 60
---@field yield number share of mutual avoidance that the agent takes; 0.5 is reciprocal; 0 to 1, default 0.5
---@field radius number radius of the disc for which an agent keeps room as it walks, m; 0.02 to 5, default 0.2
---@field breadth number breadth of the torso across the shoulders; 0: 2.25 times the radius, m; 0 to 10, default 0
---@field depth number depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth, m; 0 to 10, default 0
---@field mass number mass, kg; 1 to 10000, default 70
---@field restitution number restitution of contacts between agents; 0 to 1, default 0
---@field damping number how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace number force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap number time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste number motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field step_back number speed at which an agent that stands steps back to where it stood before it was moved, m/s; 0 to 2, default 0.11
---@field balance number longest step by which an agent that forces throw regains its balance; 0: it never falls, m; 0 to 2, default 0
---@field stance number how far to either side of an agent that stands its feet are; they hold it against forces from the side, m; 0 to 1, default 0
---@field rise number time that an agent lies after a fall, until it gets up, s; 0 to 1e+06, default 5
---@field stair_up number wanted speed up stairs, along the slope; 0: that of level ground, lessened by the slope, m/s; 0 to 5, default 0
---@field stair_down number the same down stairs, m/s; 0 to 5, default 0
---@field escalator_walk number chance that an agent walks on a running escalator; otherwise it stands on it; 0 to 1, default 0.25
---@field lifts number how an agent gets to other storeys: 0 never by a lift, 0.5 either by stairs or by a lift that takes less time, 1 only by lifts and ramps, as it cannot use stairs; 0 to 1, default 0.5

--- Another agent, or a body, as it was before the step. Memory alone can be set.
---@class jostle.View
---@field [string] any what its memory declares
---@field id number number of the agent, never used for another one
---@field x number position east, m
---@field y number position north; in a building with storeys, in plan, m
---@field storey number number of the storey: 0 is the lowest one; on a stair, the nearer in height
---@field height number elevation of the floor on which the agent is; 0 without storeys, m
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
---@field in_sight boolean of a view: the agent sees it now. Of one whom it remembers and does not see, only `id` is known
---@field speed number wanted speed, m/s; 0 to 20, default 1.3
---@field max_speed number hard cap on speed; only a contact impulse exceeds it, m/s; 0 to 30, default 1.8
---@field perception number radius within which neighbours and bodies are seen, m; 0 to 100, default 3
---@field neighbours number greatest number of neighbours that are considered; 0 to 16, default 10
---@field horizon number time ahead for which other agents are avoided, s; 0.01 to 30, default 0.5
---@field wall_horizon number time ahead for which walls are avoided, s; 0.01 to 30, default 0.3
---@field push number force with which an agent pushes agents in its way, N; 0 to 5000, default 0
---@field push_reach number greatest gap over which an agent pushes, m; 0 to 2, default 0.1
---@field push_angle number half-angle of the cone in which an agent pushes, degree; 0 to 180, default 60
---@field absorb number share of a force that is passed on (k of equations 8 and 9); 0 to 1, default 0.8
---@field brace_angle number half-angle of the cone that takes a passed-on force, degree; 0 to 180, default 60
---@field yield number share of mutual avoidance that the agent takes; 0.5 is reciprocal; 0 to 1, default 0.5
---@field radius number radius of the disc for which an agent keeps room as it walks, m; 0.02 to 5, default 0.2
---@field breadth number breadth of the torso across the shoulders; 0: 2.25 times the radius, m; 0 to 10, default 0
---@field depth number depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth, m; 0 to 10, default 0
---@field mass number mass, kg; 1 to 10000, default 70
---@field restitution number restitution of contacts between agents; 0 to 1, default 0
---@field damping number how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace number force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap number time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste number motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field step_back number speed at which an agent that stands steps back to where it stood before it was moved, m/s; 0 to 2, default 0.11
---@field balance number longest step by which an agent that forces throw regains its balance; 0: it never falls, m; 0 to 2, default 0
---@field stance number how far to either side of an agent that stands its feet are; they hold it against forces from the side, m; 0 to 1, default 0
---@field rise number time that an agent lies after a fall, until it gets up, s; 0 to 1e+06, default 5
---@field stair_up number wanted speed up stairs, along the slope; 0: that of level ground, lessened by the slope, m/s; 0 to 5, default 0
---@field stair_down number the same down stairs, m/s; 0 to 5, default 0
---@field escalator_walk number chance that an agent walks on a running escalator; otherwise it stands on it; 0 to 1, default 0.25
---@field lifts number how an agent gets to other storeys: 0 never by a lift, 0.5 either by stairs or by a lift that takes less time, 1 only by lifts and ramps, as it cannot use stairs; 0 to 1, default 0.5

--- A message that waited.
---@class jostle.Told
---@field sender jostle.View|nil who told it
---@field [string] any the values that it carries

--- `inside(place) or inside(target, place)`: the agent, or the target, is in the place; at a point, line or queue no wall or closed gate may lie between, except a solid that contains the point
---@overload fun(place: jostle.Place): jostle.Condition
---@param target jostle.AnyTarget
---@param place jostle.Place
---@return jostle.Condition
function inside(target, place) end

--- `arrived(place)`: the agent is in the place; or agents within 0.3 m ahead of it, who have arrived there or stand there, have kept it from getting nearer for a second. So the last of a crowd arrive, too, where a place is full. It holds until the agent wants to move away
---@param place jostle.Place
---@return jostle.Condition
function arrived(place) end

--- `crosses(line)`: the agent crossed the line in the last step, from the line's right to its left
---@param line jostle.Place
---@return jostle.Condition
function crosses(line) end

--- `near(target, metres)`: the target is nearer than this distance, m; if it is a place, no wall or closed gate may lie between, except walls that its nearest point lies on or in
---@overload fun(value: number, wanted: number, tolerance: number)
---@param target jostle.AnyTarget
---@param metres jostle.Value
---@return jostle.Condition
function near(target, metres) end

--- `touches(target)`: the gap between the agent and the target, of torsos or discs, is below 5 cm
---@param target jostle.AnyTarget
---@return jostle.Condition
function touches(target) end

--- `first_in(queue)`: the agent is at the head of the queue that it steers in
---@param queue jostle.Place
---@return jostle.Condition
function first_in(queue) end

--- `joined(queue)`: the agent has come to the queue that it steers in, and taken its place there
---@param queue jostle.Place
---@return jostle.Condition
function joined(queue) end

--- `after(seconds)`: the agent has been in this state for at least this time, s
---@param seconds jostle.Value
---@return jostle.Condition
function after(seconds) end

--- `lasted`: the duration that `lasts` drew for this state is over
---@type jostle.Condition
lasted = nil

--- `done`: the machine that this state runs has ended: it is in a state with `ends = true`
---@type jostle.Condition
done = nil

--- `stuck(seconds)`: the agent has not moved by 0.25 m for this time, s
---@param seconds jostle.Value
---@return jostle.Condition
function stuck(seconds) end

--- `fallen`: the agent lies after a fall (see `balance`); `now.fallen` is the time since then
---@type jostle.Condition
fallen = nil

--- `hit_by(target)`: a target faster than 1 m/s touches the agent, or hit it in the last step
---@param target jostle.Target
---@return jostle.Condition
function hit_by(target) end

--- `grounded(target)`: the body touches the ground
---@param target jostle.Target
---@return jostle.Condition
function grounded(target) end

--- `incoming(target, metres)`: the target, if it keeps its velocity, passes within this distance, m, of where the agent stands during the next 2 s
---@param target jostle.Target
---@param metres jostle.Value
---@return jostle.Condition
function incoming(target, metres) end

--- `kicked(target)`: the agent kicked or threw the body in the last step
---@param target jostle.Target
---@return jostle.Condition
function kicked(target) end

--- `exists(target)`: there is such a person, body or place. Whom the agent remembers it knows to be in the world out of sight, too, unless the target has a filter; who has left the world does not exist
---@param target jostle.AnyTarget
---@return jostle.Condition
function exists(target) end

--- `same(target, target)`: both targets are the same person, body or place; false if there is none
---@param target jostle.AnyTarget
---@param target2 jostle.AnyTarget
---@return jostle.Condition
function same(target, target2) end

--- `has(target)`: the agent carries the body (see `take`), or holds on to an agent that the target selects (see `grasp`)
---@param target jostle.Target
---@return jostle.Condition
function has(target) end

--- `sees(target)`: the target exists and is within perception, with no wall and no tall body between
---@param target jostle.AnyTarget
---@return jostle.Condition
function sees(target) end

--- `heard(name [, metres])`: an agent within perception (and within this distance, m) gave the signal in the last step, with no wall of 1.3 m or more between; or the scene gives it now. Bodies between do not matter
---@param name string
---@param metres? jostle.Value
---@return jostle.Condition
function heard(name, metres) end

--- `told(name)`: a message of this name waits for the agent (see `tell`). told(name).sender is who told it, a target; told(name).VALUE a value that it carries, a number, or a target where one is wanted (0, or nobody, if it carries the other). It waits until an item is taken whose `when` rests on it; of several the oldest is meant. All items of a step that hold rest on the same message, and on entering the next state it can still be read; then it is used up. It waits over states, and over `become`, in which nothing asks for it, and does not grow old: tell a time with it to ask for its age. At most 16 messages wait for an agent; then the oldest goes, and the run says so
---@param name string
---@return jostle.Message
function told(name) end

--- `shut(place)`: a gate at the place, or within 0.5 m of it, is closed, and the agent sees it: within perception, with no other wall between. Bodies between do not matter
---@param place jostle.Place
---@return jostle.Condition
function shut(place) end

--- `open(gate)`: the walls of this name are open. Agents know it wherever they are, as of a door whose opening is announced
---@param gate string
---@return jostle.Condition
function open(gate) end

--- `rode`: the agent has left the lift in which it steers by `ride`, on whichever storey it was let out, or was on the storey already
---@type jostle.Condition
rode = nil

--- `riding`: the agent, which steers by `ride`, is in the car, also while that moves
---@type jostle.Condition
riding = nil

--- `in_use(place)`: the lift of the place, or one of a set, serves everybody's calls: it is neither out of use nor left to firemen. Agents know it wherever they are, as of a sign
---@param place jostle.Place
---@return jostle.Condition
function in_use(place) end

--- `density(place)` in 1/m2: people per square metre in a place; at a point, line or queue: within 2 m of it
---@param place jostle.Place
---@return jostle.Number
function density(place) end

--- `count(place)`: number of people in a place
---@param place jostle.Place
---@return jostle.Number
function count(place) end

--- `queued(queue)`: number of people who steer in the queue, also those on their way to their place in it
---@param queue jostle.Place
---@return jostle.Number
function queued(queue) end

--- `left(place)`: number of people who have left the world from this place, the smallest one in which they stood
---@param place jostle.Place
---@return jostle.Number
function left(place) end

--- `distance(target)` in m: distance to the target; 0 in a place, infinite if there is no such target. Straight, also through floors: the way there may be longer
---@param target jostle.AnyTarget
---@return jostle.Number
function distance(target) end

--- `neighbours(tag)`: number of agents that the agent sees and that bear the tag, or are "anyone", "teammates" or "opponents". Seen are its `neighbours` nearest, and in a crowd of at most 64 all agents, within perception, with no wall and no tall body between. `:in_state` and the like select among them
---@param tag jostle.Tag
---@return jostle.Counted
function neighbours(tag) end

--- `theirs(target, name)`: value of this memory of the target, an agent, if its machine makes it `public`; true is 1. 0 if there is no such agent or memory
---@param target jostle.Target
---@param name string
---@return jostle.Number
function theirs(target, name) end

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
---@param a jostle.Value
---@param b jostle.Value
---@return jostle.Number
function min(a, b) end

--- `max(a, b)`: the greater of two numbers
---@param a jostle.Value
---@param b jostle.Value
---@return jostle.Number
function max(a, b) end

--- `abs(a)`: absolute value
---@param a jostle.Value
---@return jostle.Number
function abs(a) end

--- `sqrt(a)`: square root; 0 of a negative number
---@param a jostle.Value
---@return jostle.Number
function sqrt(a) end

--- `either(condition, a, b)`: the number a where the condition holds, else b; both are computed
---@param condition jostle.Condition
---@param a jostle.Value
---@param b jostle.Value
---@return jostle.Number
function either(condition, a, b) end

--- `clamp(a, least, greatest)`: a, kept within two bounds
---@param a jostle.Value
---@param least jostle.Value
---@param greatest jostle.Value
---@return jostle.Number
function clamp(a, least, greatest) end

--- `now.NAME`: what is measured of the agent now; NAME is one of speed fallen x y storey height neighbours driven played button time density headway eagerness pushed compression load contacts holders time_in_state
---@type jostle.Now
now = nil

--- `own.NAME`: the agent's own value: drawn from `defaults` or `own`, unless its group in the scene sets it; a number or a place
---@type jostle.Own
own = nil

--- `nearest(tag)`: the nearest body or agent that bears the tag, or the nearest agent of "anyone", "opponents" or "teammates", that the agent sees: with no wall and no tall body between. `:in_state` and the like select among agents
---@param tag jostle.Tag
---@return jostle.Target
function nearest(tag) end

--- `best(tag, score)`: of those that `nearest` chooses from, the one with the greatest score, a number in which `other` is the candidate; of equal ones agents before bodies, by ascending id
---@param tag jostle.Tag
---@param score jostle.Value
---@return jostle.Target
function best(tag, score) end

--- `other`: in the score of `best` and `best_place`: the candidate
---@type jostle.Target
other = nil

--- `nobody`: no person, body or place: memory that begins with it holds somebody, as `set = { prey = nearest "people" }`; a target everywhere else, which is not there once that person or body has left the world
---@type jostle.Nobody
nobody = nil

--- `holding`: the body that the agent carries (see `take`), else the agent that it holds on to (see `grasp`)
---@type jostle.Target
holding = nil

--- `striker`: the agent that kicked or threw the body which hits this one, as `hit_by` sees it; that body, if nobody else did
---@type jostle.Target
striker = nil

--- `best_place(set, score)`: the member of a set of places with the greatest score, a number over the candidate `other`; of the same score, the first. It is judged anew in each step: `set` remembers it
---@param set jostle.Place
---@param score jostle.Value
---@return jostle.Target
function best_place(set, score) end

--- `one_of(set)`: a member of a set of places, drawn on entering the state; from then on it is the agent's `goal`. In `set` and `tell`: drawn when that is done
---@param set jostle.Place
---@return jostle.Target
function one_of(set) end

--- `goal`: the place that `one_of` drew last, or that a function or the scene set
---@type jostle.Target
goal = nil

--- `last_seen(memory)`: the point where the agent last saw whom this memory holds; none before it saw it
---@param memory jostle.Target
---@return jostle.Target
function last_seen(memory) end

--- `home`: the place where the agent entered the world, or took up its present machine
---@type jostle.Target
home = nil

--- `seek(target)`: straight to the target; the agent passes over a line, and stops at a point
---@param target jostle.AnyTarget
---@return jostle.Steering
function seek(target) end

--- `field(target)`: the shortest way to the target, round walls and large bodies; to a set: to the member that is nearest by that way. To an agent, a body, `home` or a place last seen: round walls and fixed bodies, and straight if no way leads there
---@param target jostle.AnyTarget
---@return jostle.Steering
function field(target) end

--- `away_from(target)`: straight away from the target
---@param target jostle.AnyTarget
---@return jostle.Steering
function away_from(target) end

--- `dodge(target [, metres])`: sideways, out of the line along which the target comes, until that passes at this distance, m; to the nearer side, or to the other one if a wall is in the way
---
--- `metres`: 0 to 100 m
---@param target jostle.Target
---@param metres? number
---@return jostle.Steering
function dodge(target, metres) end

--- `orbit(place [, options])`: round a place, counter-clockwise. Options: inward, density_near, density_far, far and beyond set how dense the crowd about it may be
---
--- `inward`: -10 to 10
---
--- `density_near`: 0 to 20 1/m2
---
--- `density_far`: 0 to 20 1/m2
---
--- `far`: 0.1 to 10000 m
---
--- `beyond`: 0 to 10000 m
---@param place jostle.Place
---@param options? jostle.OrbitOptions
---@return jostle.Steering
function orbit(place, options) end

--- `queue(place)`: to the end of a queue, along it where walls hide that, and straight where they hide all of it (`field` leads round them); an agent that comes within 1 m of the queue takes the next place, and moves up as those before it leave
---@param place jostle.Place
---@return jostle.Steering
function queue(place) end

--- `ride(place)`: in a lift to the storey of the place, which the key `lifts` of a scene makes for each of its storeys (`LIFT.STOREY`), or by the lift of a set that takes least time: to the door, where the agent calls the lift and waits beside the door; in, when it is there, goes its way and has room; and out on that storey (see `rode`). It stands still where the place is no lift's
---@param place jostle.Place
---@return jostle.Steering
function ride(place) end

--- `along(place)`: in the direction of a line, or along a queue to its head
---@param place jostle.Place
---@return jostle.Steering
function along(place) end

--- `follow(target [, metres])`: to a position behind the target, at this distance, m
---
--- `metres`: 0 to 1000 m
---@param target jostle.AnyTarget
---@param metres? number
---@return jostle.Steering
function follow(target, metres) end

--- `together([metres])`: towards the teammates that the agent sees, if they are farther away than this distance, m
---
--- `metres`: 0 to 1000 m
---@param metres? number
---@return jostle.Steering
function together(metres) end

--- `drift(x, y)`: in the direction x east and y north, numbers or expressions; a length of 1 means the wanted speed
---
--- `x`: -100 to 100
---
--- `y`: -100 to 100
---@param x jostle.Value
---@param y jostle.Value
---@return jostle.Steering
function drift(x, y) end

--- `wander([place])`: walks about: turns gradually, and away from walls; with a place: stays within it
---@param place? jostle.Place
---@return jostle.Steering
function wander(place) end

--- `formation(target [, metres])`: to the agent's place in a row, with this distance, m, from one to the next: along a line, or behind an agent and across the direction in which it looks. Agents keep the order in which they stand
---
--- `metres`: 0.1 to 100 m
---@param target jostle.AnyTarget
---@param metres? number
---@return jostle.Steering
function formation(target, metres) end

--- `gather(place [, degrees])`: to the agent's spot in a crowd that waits in a polygon, round walls and fixed bodies. The crowd fills the polygon from its front, which lies in this direction, degrees anti-clockwise from +x; agents stand 0.9 m apart, or closer where they are many, to 0.51 m and 1.2 breadths. Agents for whom there is no room stand around it
---
--- `degrees`: -360 to 360 deg
---@param place jostle.Place
---@param degrees? number
---@return jostle.Steering
function gather(place, degrees) end

--- `spread_over(place)`: to the agent's spot in a crowd that spreads evenly over the whole of a polygon, round walls and fixed bodies; the fewer they are, the farther apart they stand, up to 12 m
---@param place jostle.Place
---@return jostle.Steering
function spread_over(place) end

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
---@param mean number
---@param deviation number
---@param least? number
---@param greatest? number
---@return jostle.Drawn
function normal(mean, deviation, least, greatest) end

--- `lognormal(mean, deviation [, least, greatest])`: a number whose logarithm has a normal distribution of this mean and deviation, drawn once per agent
---@param mean number
---@param deviation number
---@param least? number
---@param greatest? number
---@return jostle.Drawn
function lognormal(mean, deviation, least, greatest) end

--- `gamma(shape, scale [, least, greatest])`: a gamma distribution; its mean is shape times scale, drawn once per agent
---@param shape number
---@param scale number
---@param least? number
---@param greatest? number
---@return jostle.Drawn
function gamma(shape, scale, least, greatest) end

--- `weibull(shape, scale [, least, greatest])`: a Weibull distribution, drawn once per agent
---@param shape number
---@param scale number
---@param least? number
---@param greatest? number
---@return jostle.Drawn
function weibull(shape, scale, least, greatest) end

--- `uniform(least, greatest)`: a uniform distribution between two bounds, drawn once per agent
---@param least number
---@param greatest number
---@return jostle.Drawn
function uniform(least, greatest) end

--- `choose(a, b, ...)`: one of up to 8 values, with equal probability, drawn once per agent
---@param a number
---@param b number
---@param ... number
---@return jostle.Drawn
function choose(a, b, ...) end

--- `circuits(place)`: for `counts`: net number of counter-clockwise turns about a place since the agent first crossed its start line; turns back are subtracted
---@param place jostle.Place
---@return jostle.Counter
function circuits(place) end

--- `memory { name = value, ... }`: declares the memory of each agent: numbers, booleans, somebody, which begins as `nobody`, and lists (`list`); kept through reloads. The result is a table of their values as expressions and targets
---@generic T: table<string, any>
---@param declared T
---@return T|jostle.Remembered
function memory(declared) end

--- `list(capacity [, nobody])`: for `memory`: begins as an empty list of at most so many numbers, 1 to 16, or with `nobody` of people, bodies and places. mine.LIST.size, .first and .last read it, mine.LIST:contains(item) asks; `set` changes it: by mine.LIST:push(item), after which a full list lacks its first, :remove(item), which removes all that are the item, or :clear(). Who has left the world is in no list any more
---@param capacity any
---@param nobody? any
---@return any
function list(capacity, nobody) end

--- `machine { ... }`: the table that a behaviour returns, or that a state runs (see `runs`)
---@param sheet jostle.Machine
---@return jostle.MachineValue
function machine(sheet) end

--- `sequence { step, ... }`: a machine of steps, one after the other, which ends after the last; a state runs it (see `runs`). A step is a steering: seek, field, queue and ride are over when the agent is there; wait(seconds); a machine, over when it has ended; a function(me), called once; or a state's table, with `lasts` or `when`, the condition that it is over. A text names the step after it, as does `name` in a table; other steps are called "1 seek post", "2 wait". Keys of a machine may stand in it, too
---@param steps table
---@return jostle.MachineValue
function sequence(steps) end

--- `wait(seconds)`: a step of a sequence: the agent stands for this time, s: a number, distribution or expression
---@param seconds jostle.Value|jostle.Drawn
---@return any
function wait(seconds) end

--- `back`: for `to`: the state that the agent left when it entered the present one, other than by `back`; if there is none, the state in which the machine begins
---@type jostle.Back
back = nil

--- `patch "behaviour" { ... }`: in a mod: changes a behaviour's table, key by key; returned by the file
---@param behaviour string
---@return fun(changes: table): any
function patch(behaviour) end

--- `replace "behaviour" { ... }`: in a mod: replaces a behaviour's whole table; returned by the file
---@param behaviour string
---@return fun(sheet: jostle.Machine): any
function replace(behaviour) end

--- `none`: in a patch: removes a key or a state
---@type jostle.None
none = nil

--- `before(function)`: in a patch, for on_enter, on_exit, on_take, when or steer: runs a function(me) before what stands there, a function or not, which goes on to work and alone gives the result
---@param run fun(me: jostle.Me)
---@return any
function before(run) end

--- `afterwards(function)`: in a patch: as `before`, but runs the function after what stands there
---@param run fun(me: jostle.Me)
---@return any
function afterwards(run) end

--- `around(function)`: in a patch: calls function(me, previous) in place of what stands there; previous(me) calls that, and returns true or false for `when`, the velocity as two numbers in m/s for `steer`
---@param run fun(me: jostle.Me, previous: fun(me: jostle.Me): any, any): any, any
---@return any
function around(run) end

--- `settings.NAME`: in a mod: the value of a setting: a plain number, true or false, or a text
---@type table<string, any>
settings = nil

-- Tests, NAME_test.lua, which `jostle test` runs.

---@class jostle.SceneOptions
---@field set? table<string, string|number|boolean> settings of the scene by path, as `jostle run --set`
---@field mods? string[] folders of mods
---@field seed? integer seed of the run
---@field dt? number length of a step, s
---@field threads? integer threads that step the scene; default 1

---@class jostle.AgentsOptions
---@field agents? string only agents of this group

---@class jostle.ReachesOptions
---@field within? number time for it, s
---@field agents? string only agents of this group
---@field count? integer how many must get there; default: all
---@field any? boolean one is enough

---@class jostle.DuringOptions
---@field during? number time that is run, s
---@field agents? string only agents of this group

---@class jostle.WhyOptions
---@field agents? string only agents of this group
---@field state? string agents in this state
---@field to? string transitions to this state alone

--- An agent of a scene, as it is now.
---@class jostle.TestAgent
---@field id integer
---@field state string
---@field machine string
---@field group string|nil
---@field team string|integer|nil a number: of a party
---@field own table<string, number|string> own values; of places the name
---@field x number position east, m
---@field y number position north, m
---@field vx number velocity east, m/s
---@field vy number velocity north, m/s
---@field now number present speed, m/s
---@field density number
---@field compression number
---@field load number
---@field fallen number
---@field pushed number
---@field [string] any what its memory declares
---@field speed number wanted speed, m/s; 0 to 20, default 1.3
---@field max_speed number hard cap on speed; only a contact impulse exceeds it, m/s; 0 to 30, default 1.8
---@field perception number radius within which neighbours and bodies are seen, m; 0 to 100, default 3
---@field neighbours number greatest number of neighbours that are considered; 0 to 16, default 10
---@field horizon number time ahead for which other agents are avoided, s; 0.01 to 30, default 0.5
---@field wall_horizon number time ahead for which walls are avoided, s; 0.01 to 30, default 0.3
---@field push number force with which an agent pushes agents in its way, N; 0 to 5000, default 0
---@field push_reach number greatest gap over which an agent pushes, m; 0 to 2, default 0.1
---@field push_angle number half-angle of the cone in which an agent pushes, degree; 0 to 180, default 60
---@field absorb number share of a force that is passed on (k of equations 8 and 9); 0 to 1, default 0.8
---@field brace_angle number half-angle of the cone that takes a passed-on force, degree; 0 to 180, default 60
---@field yield number share of mutual avoidance that the agent takes; 0.5 is reciprocal; 0 to 1, default 0.5
---@field radius number radius of the disc for which an agent keeps room as it walks, m; 0.02 to 5, default 0.2
---@field breadth number breadth of the torso across the shoulders; 0: 2.25 times the radius, m; 0 to 10, default 0
---@field depth number depth of the torso; 0: 1.25 times the radius; a disc unless less than the breadth, m; 0 to 10, default 0
---@field mass number mass, kg; 1 to 10000, default 70
---@field restitution number restitution of contacts between agents; 0 to 1, default 0
---@field damping number how fast the feet stop a velocity given by force, 1/s; 0 to 50, default 2.5
---@field brace number force of others that the feet of an agent under way withstand, N; 0 to 5000, default 200
---@field time_gap number time gap kept to people ahead, by the walking law; 0: velocities are chosen by ORCA, s; 0 to 10, default 0
---@field haste number motivation: 0 calm, 0.5 normal, 1 keen; bounds eagerness; 0 to 1, default 0.5
---@field step_back number speed at which an agent that stands steps back to where it stood before it was moved, m/s; 0 to 2, default 0.11
---@field balance number longest step by which an agent that forces throw regains its balance; 0: it never falls, m; 0 to 2, default 0
---@field stance number how far to either side of an agent that stands its feet are; they hold it against forces from the side, m; 0 to 1, default 0
---@field rise number time that an agent lies after a fall, until it gets up, s; 0 to 1e+06, default 5
---@field stair_up number wanted speed up stairs, along the slope; 0: that of level ground, lessened by the slope, m/s; 0 to 5, default 0
---@field stair_down number the same down stairs, m/s; 0 to 5, default 0
---@field escalator_walk number chance that an agent walks on a running escalator; otherwise it stands on it; 0 to 1, default 0.25
---@field lifts number how an agent gets to other storeys: 0 never by a lift, 0.5 either by stairs or by a lift that takes less time, 1 only by lifts and ramps, as it cannot use stairs; 0 to 1, default 0.5

--- A body of a scene, as it is now: m and m/s.
---@class jostle.TestBody
---@field x number
---@field y number
---@field z number
---@field vx number
---@field vy number
---@field vz number

--- A scene within a test.
---@class jostle.Scene
local Scene = {}

--- `test(name, run)`: declares a test; it passes if `run` raises no error
---@param name string
---@param run fun()
function test(name, run) end

--- `scene(what [, options])`: loads a scene: a table with the keys of a scene's file, where `behaviour` may also be the text of a behaviour, or the path of a scene. Agents get teams, own values and memory from their group: `{ behaviour = "runner.lua", at = { { 0, 0 } }, team = "red", set = { shoe = 44 }, memory = { laps = 1 } }`
---@param what string|table
---@param options? jostle.SceneOptions
---@return jostle.Scene
function scene(what, options) end

--- `refused(what, text)`: the scene must be refused with an error that has this text
---@param what string|table
---@param text string
function refused(what, text) end

--- `equal(value, wanted)`: both values must be the same
---@param value any
---@param wanted any
function equal(value, wanted) end

--- `truthy(value [, message])`: the value must be neither false nor nil
---@param value any
---@param message? string
function truthy(value, message) end

--- `fails(run [, text])`: the function must raise an error that has this text
---@param run fun()
---@param text? string
function fails(run, text) end

--- `s:run(seconds)`: runs the scene for so many simulated seconds
---@param seconds number
function Scene:run(seconds) end

--- `s:step([steps])`: runs one step, or so many
---@param steps? integer
function Scene:step(steps) end

--- `s:time()`: the simulated time, s
---@return number
function Scene:time() end

--- `s:count([state [, options]])`: the number of agents, of those in a state
---@param state? string
---@param options? jostle.AgentsOptions
---@return integer
function Scene:count(state, options) end

--- `s:entered(state [, options])`: the number of agents that have been in a state
---@param state string
---@param options? jostle.AgentsOptions
---@return integer
function Scene:entered(state, options) end

--- `s:agents([group])`: the agents, of a group, by ascending id
---@param group? string
---@return jostle.TestAgent[]
function Scene:agents(group) end

--- `s:agent(id)`: the agent with this id; nil if it has left. Fields: `state`, `machine`, `group`, `team`, `x`, `y`, in a building `storey` and, of those on one, `stair`, `own.NAME` for own values, memory and parameters by their names. Memory of somebody is the id of a person, the text "place 'north'" or "body 3", or nil for nobody; a list is a table, of ids if it holds people. Any other name is an error
---@param id integer
---@return jostle.TestAgent|nil
function Scene:agent(id) end

--- `s:body(name)`: a body by its name
---@param name string
---@return jostle.TestBody
function Scene:body(name) end

--- `s:reaches(state [, options])`: runs the scene until its agents have been in a state; they must get there in time
---@param state string
---@param options? jostle.ReachesOptions
function Scene:reaches(state, options) end

--- `s:never(state [, options])`: runs the scene; nobody may come into the state, nor have been in it
---@param state string
---@param options? jostle.DuringOptions
function Scene:never(state, options) end

--- `s:slower_than(speed [, options])`: runs the scene; nobody may be faster, m/s
---@param speed number
---@param options? jostle.DuringOptions
function Scene:slower_than(speed, options) end

--- `s:faster_than(speed [, options])`: runs the scene; the mean speed, which it returns, must be greater, m/s
---@param speed number
---@param options? jostle.DuringOptions
---@return number
function Scene:faster_than(speed, options) end

--- `s:why([who])`: why agents stay in their states, as `jostle why` says it: one by its id, or several
---@param who? integer|jostle.WhyOptions
---@return string
function Scene:why(who) end

--- `s:hash()`: the hash of the state of the scene, by which runs are compared
---@return string
function Scene:hash() end
