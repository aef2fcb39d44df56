#include "lua/language/vocabulary.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"

#define CONDITION JOX_NODE_CONDITION
#define NUMBER JOX_NODE_NUMBER
#define TARGET JOX_NODE_TARGET
#define STEER JOX_NODE_STEER
#define NOW JOX_OP_NOW
/* clang-format off */
const JoxWord jox_words[] = {
    /* conditions */
    {"inside", "t?p", CONDITION, JOX_OP_INSIDE, 0, "inside(place) or inside(target, place)", "",
     "the agent, or the target, is in the place; at a point, line or queue no wall or closed gate "
     "may lie between, except a solid that contains the point", "inside \"yard\""},
    {"arrived", "p", CONDITION, JOX_OP_ARRIVED, 0, "arrived(place)", "",
     "the agent is in the place; or agents within 0.3 m ahead of it, who have arrived there or stand there, have kept "
     "it from getting nearer for a second. So the last of a crowd arrive, too, where a place is full. It holds until "
     "the agent wants to move away", "arrived \"post\""},
    {"crosses", "p", CONDITION, JOX_OP_CROSSES, 0, "crosses(line)", "",
     "the agent crossed the line in the last step, from the line's right to its left", "crosses \"mid\""},
    {"near", "tn", CONDITION, JOX_OP_NEAR, 0, "near(target, metres)", "",
     "the target is nearer than this distance, m; if it is a place, no wall or closed gate may "
     "lie between, except walls that its nearest point lies on or in", "near(\"post\", 2)"},
    {"touches", "t", CONDITION, JOX_OP_TOUCHES, 0, "touches(target)", "",
     "the gap between the agent and the target, of torsos or discs, is below 5 cm", "touches(nearest \"ball\")"},
    {"first_in", "p", CONDITION, JOX_OP_FIRST_IN, 0, "first_in(queue)", "",
     "the agent is at the head of the queue that it steers in", "first_in \"row\""},
    {"joined", "p", CONDITION, JOX_OP_JOINED, 0, "joined(queue)", "",
     "the agent has come to the queue that it steers in, and taken its place there", "joined \"row\""},
    {"after", "n", CONDITION, JOX_OP_AFTER, 0, "after(seconds)", "",
     "the agent has been in this state for at least this time, s", "after(5)"},
    {"lasted", NULL, CONDITION, JOX_OP_LASTED, 0, "lasted", "",
     "the duration that `lasts` drew for this state is over", "lasted"},
    {"done", NULL, CONDITION, JOX_OP_DONE, 0, "done", "",
     "the machine that this state runs has ended: it is in a state with `ends = true`", "done"},
    {"stuck", "n", CONDITION, JOX_OP_STUCK, 0, "stuck(seconds)", "",
     "the agent has not moved by 0.25 m for this time, s", "stuck(3)"},
    {"fallen", NULL, CONDITION, JOX_OP_FALLEN, 0, "fallen", "",
     "the agent lies after a fall (see `balance`); `now.fallen` is the time since then", "fallen"},
    {"hit_by", "m", CONDITION, JOX_OP_HIT_BY, 0, "hit_by(target)", "",
     "a target faster than 1 m/s touches the agent, or hit it in the last step", "hit_by(nearest \"ball\")"},
    {"grounded", "m", CONDITION, JOX_OP_GROUNDED, 0, "grounded(target)", "",
     "the body touches the ground", "grounded(nearest \"ball\")"},
    {"incoming", "mn", CONDITION, JOX_OP_INCOMING, 0, "incoming(target, metres)", "",
     "the target, if it keeps its velocity, passes within this distance, m, of where the agent "
     "stands during the next 2 s",
     "incoming(nearest \"ball\", 0.5)"},
    {"kicked", "m", CONDITION, JOX_OP_KICKED, 0, "kicked(target)", "",
     "the agent kicked or threw the body in the last step", "kicked(nearest \"ball\")"},
    {"exists", "t", CONDITION, JOX_OP_EXISTS, 0, "exists(target)", "",
     "there is such a person, body or place. Whom the agent remembers it knows to be in the world out of sight, "
     "too, unless the target has a filter; who has left the world does not exist", "exists(mine.prey)"},
    {"same", "tt", CONDITION, JOX_OP_SAME, 0, "same(target, target)", "",
     "both targets are the same person, body or place; false if there is none", "same(mine.prey, nearest \"people\")"},
    {"has", "m", CONDITION, JOX_OP_HAS, 0, "has(target)", "",
     "the agent carries the body (see `take`), or holds on to an agent that the target selects (see `grasp`)", "has(nearest \"ball\")"},
    {"sees", "t", CONDITION, JOX_OP_SEES, 0, "sees(target)", "",
     "the target exists and is within perception, with no wall and no tall body between", "sees(nearest \"people\")"},
    {"heard", "s?n", CONDITION, JOX_OP_HEARD, 0, "heard(name [, metres])", "",
     "an agent within perception (and within this distance, m) gave the signal in the last step, "
     "with no wall of 1.3 m or more between; or the scene gives it now. Bodies between do not "
     "matter",
     "heard(\"alarm\", 10)"},
    {"told", "s", CONDITION, JOX_OP_TOLD, 0, "told(name)", "",
     "a message of this name waits for the agent (see `tell`). told(name).sender is who told it, a target; "
     "told(name).VALUE a value that it carries, a number, or a target where one is wanted (0, or nobody, if it carries the other). It waits until an item "
     "is taken whose `when` rests on it; of several the oldest is meant. All items of a step that hold rest on the same message, "
     "and on entering the next state it can still be read; then it is used up. It waits over states, and over `become`, in which nothing "
     "asks for it, and does not grow old: tell a time with it to ask for its age. At most 16 messages wait for an agent; then the oldest goes, and the run says so", "told \"shot\""},
    {"shut", "p", CONDITION, JOX_OP_SHUT, 0, "shut(place)", "",
     "a gate at the place, or within 0.5 m of it, is closed, and the agent sees it: within "
     "perception, with no other wall between. Bodies between do not matter", "shut \"mid\""},
    {"open", "w", CONDITION, JOX_OP_OPEN, 0, "open(gate)", "",
     "the walls of this name are open. Agents know it wherever they are, as of a door whose "
     "opening is announced",
     "open \"gate\""},
    {"rode", NULL, CONDITION, JOX_OP_RODE, 0, "rode", "",
     "the agent has left the lift in which it steers by `ride`, on whichever storey it was let out, or was on the storey already", "rode"},
    {"riding", NULL, CONDITION, JOX_OP_RIDING, 0, "riding", "",
     "the agent, which steers by `ride`, is in the car, also while that moves", "riding"},
    {"in_use", "p", CONDITION, JOX_OP_IN_USE, 0, "in_use(place)", "",
     "the lift of the place, or one of a set, serves everybody's calls: it is neither out of use nor left to firemen. Agents "
     "know it wherever they are, as of a sign", "in_use \"east.first\""},
    /* numbers */
    {"density", "p", NUMBER, JOX_OP_PLACE_DENSITY, 0, "density(place)", "1/m2",
     "people per square metre in a place; at a point, line or queue: within 2 m of it", "density \"yard\""},
    {"count", "p", NUMBER, JOX_OP_PLACE_COUNT, 0, "count(place)", "", "number of people in a place",
     "count \"yard\""},
    {"queued", "p", NUMBER, JOX_OP_QUEUED, 0, "queued(queue)", "",
     "number of people who steer in the queue, also those on their way to their place in it", "queued \"row\""},
    {"left", "p", NUMBER, JOX_OP_LEFT, 0, "left(place)", "",
     "number of people who have left the world from this place, the smallest one in which they stood", "left \"post\""},
    {"distance", "t", NUMBER, JOX_OP_DISTANCE, 0, "distance(target)", "m",
     "distance to the target; 0 in a place, infinite if there is no such target. Straight, also through floors: the way there may be longer", "distance \"post\""},
    {"neighbours", "g", NUMBER, JOX_OP_NEIGHBOURS, 0, "neighbours(tag)", "",
     "number of agents that the agent sees and that bear the tag, or are \"anyone\", "
     "\"teammates\" or \"opponents\". Seen are its `neighbours` nearest, and in a crowd of at "
     "most 64 all agents, within perception, with no wall and no tall body between. `:in_state` "
     "and the like select among them", "neighbours \"people\""},
    {"theirs", "ms", NUMBER, JOX_OP_THEIRS, 0, "theirs(target, name)", "",
     "value of this memory of the target, an agent, if its machine makes it `public`; true is 1. "
     "0 if there is no such agent or memory", "theirs(nearest \"people\", \"laps\")"},
#define X(name, word, unit, meaning, value) \
    {#word, NULL, NUMBER, NOW, JOX_NOW_##name, #word, unit, meaning, #word},
    JOX_MEASURED_WORDS(X)
#undef X
    {"min", "nn", NUMBER, JOX_OP_MIN, 0, "min(a, b)", "", "the smaller of two numbers", "min(1.2, 2 - density_here)"},
    {"max", "nn", NUMBER, JOX_OP_MAX, 0, "max(a, b)", "", "the greater of two numbers", "max(now.speed, own.speed)"},
    {"abs", "n", NUMBER, JOX_OP_ABS, 0, "abs(a)", "", "absolute value", "abs(now.x)"},
    {"sqrt", "n", NUMBER, JOX_OP_SQRT, 0, "sqrt(a)", "", "square root; 0 of a negative number",
     "sqrt(density_here)"},
    {"either", "cnn", NUMBER, JOX_OP_EITHER, 0, "either(condition, a, b)", "",
     "the number a where the condition holds, else b; both are computed",
     "either(stuck(5), 2, 0.5) * own.speed"},
    {"clamp", "nnn", NUMBER, JOX_OP_CLAMP, 0, "clamp(a, least, greatest)", "",
     "a, kept within two bounds", "clamp(headway / 0.95, 0.2, own.speed)"},
    {"now", NULL, 0, 0, 0, "now.NAME", "",
     "what is measured of the agent now; NAME is one of"
#define X(name, ...) " " #name
     JOX_MEASURED(X),
#undef X
     "now.speed"},
    {"own", NULL, 0, 0, 0, "own.NAME", "",
     "the agent's own value: drawn from `defaults` or `own`, unless its group in the scene sets "
     "it; a number or a place", "own.speed"},
    /* targets */
    {"nearest", "g", TARGET, JOX_TARGET_NEAREST, 0, "nearest(tag)", "",
     "the nearest body or agent that bears the tag, or the nearest agent of \"anyone\", "
     "\"opponents\" or \"teammates\", that the agent sees: with no wall and no tall body between. "
     "`:in_state` and the like select among agents", "nearest \"ball\""},
    {"best", "gn", TARGET, JOX_TARGET_NEAREST, 0, "best(tag, score)", "",
     "of those that `nearest` chooses from, the one with the greatest score, a number in which `other` is the "
     "candidate; of equal ones agents before bodies, by ascending id", "best(\"people\", other.speed - distance(other))"},
    {"other", NULL, TARGET, JOX_TARGET_OTHER, 0, "other", "", "in the score of `best` and `best_place`: the candidate",
     "best(\"people\", theirs(other, \"laps\"))"},
    {"nobody", NULL, TARGET, JOX_TARGET_NOBODY, 0, "nobody", "",
     "no person, body or place: memory that begins with it holds somebody, as `set = { prey = nearest \"people\" }`; "
     "a target everywhere else, which is not there once that person or body has left the world",
     "nobody"},
    {"holding", NULL, TARGET, JOX_TARGET_HOLDING, 0, "holding", "",
     "the body that the agent carries (see `take`), else the agent that it holds on to (see `grasp`)", "holding"},
    {"striker", NULL, TARGET, JOX_TARGET_STRIKER, 0, "striker", "",
     "the agent that kicked or threw the body which hits this one, as `hit_by` sees it; that body, if nobody else did", "striker"},
    {":in_state", "*", TARGET, 0, 0, "of:in_state(name)", "",
     "restricts `nearest`, `best`, `neighbours` and targets that are somebody to agents in a state of this name",
     "nearest(\"people\"):in_state(\"Start\")"},
    {":of_machine", "*", TARGET, 0, 0, "of:of_machine(name)", "",
     "restricts them to agents whose machine has this name",
     "nearest(\"anyone\"):of_machine(\"example\")"},
    {":of_group", "*", TARGET, 0, 0, "of:of_group(name)", "",
     "restricts them to agents of this group of the scene", "nearest(\"anyone\"):of_group(\"people\")"},
    {":where", "*", TARGET, 0, 0, "of:where(name [, least [, greatest]])", "",
     "restricts them to agents whose public memory of this name is true, or is a number from "
     "least to greatest; :where(name, false) to those of whom it is false", "nearest(\"people\"):where(\"laps\", 0, 2)"},
    {":fallen", "*", TARGET, 0, 0, "of:fallen()", "",
     "restricts them to agents that lie after a fall (see `balance`)",
     "nearest(\"anyone\"):fallen()"},
    {":flying", "*", TARGET, 0, 0, "of:flying()", "",
     "restricts `nearest` to bodies in the air, which touch neither the ground nor a fixed body "
     "and which nobody carries",
     "nearest(\"ball\"):flying()"},
    {":incoming", "*", TARGET, 0, 0, "of:incoming(metres)", "",
     "restricts them to agents and bodies that pass within this distance, m, of where the agent "
     "stands during the next 2 s if they keep their velocity",
     "nearest(\"ball\"):flying():incoming(0.6)"},
    {":within", "*", TARGET, 0, 0, "of:within(metres)", "",
     "restricts a target, or `neighbours`, to what is nearer than this distance, m, between centres", "nearest(\"people\"):within(2)"},
    {":ahead", "*", TARGET, 0, 0, "of:ahead(degrees)", "",
     "restricts them to what lies ahead: within this angle, degrees, to either side of where the agent looks",
     "nearest(\"people\"):ahead(60)"},
    {"best_place", "pn", TARGET, JOX_TARGET_BEST_PLACE, 0, "best_place(set, score)", "",
     "the member of a set of places with the greatest score, a number over the candidate `other`; of the same score, the "
     "first. It is judged anew in each step: `set` remembers it",
     "best_place(\"ends\", 0 - distance(other) - 5 * density(other))"},
    {"one_of", "p", TARGET, JOX_TARGET_ONE_OF, 0, "one_of(set)", "",
     "a member of a set of places, drawn on entering the state; from then on it is the agent's "
     "`goal`. In `set` and `tell`: drawn when that is done",
     "one_of \"ends\""},
    {"goal", NULL, TARGET, JOX_TARGET_GOAL, 0, "goal", "",
     "the place that `one_of` drew last, or that a function or the scene set", "goal"},
    {"last_seen", "m", TARGET, JOX_TARGET_LAST_SEEN, 0, "last_seen(memory)", "",
     "the point where the agent last saw whom this memory holds; none before it saw it", "last_seen(mine.prey)"},
    {"home", NULL, TARGET, JOX_TARGET_HOME, 0, "home", "",
     "the place where the agent entered the world, or took up its present machine", "home"},
    /* steering */
    {"seek", "t", STEER, JOX_STEER_SEEK, 0, "seek(target)", "",
     "straight to the target; the agent passes over a line, and stops at a point", "seek \"post\""},
    {"field", "t", STEER, JOX_STEER_FIELD, 0, "field(target)", "",
     "the shortest way to the target, round walls and large bodies; to a set: to the member that "
     "is nearest by that way. To an agent, a body, `home` or a place last seen: round walls and fixed bodies, and "
     "straight if no way leads there", "field(last_seen(mine.prey))"},
    {"away_from", "t", STEER, JOX_STEER_AWAY_FROM, 0, "away_from(target)", "",
     "straight away from the target", "away_from(nearest \"ball\")"},
    {"dodge", "m?d", STEER, JOX_STEER_DODGE, 0, "dodge(target [, metres])", "",
     "sideways, out of the line along which the target comes, until that passes at this distance, "
     "m; to the nearer side, or to the other one if a wall is in the way", "dodge(nearest \"ball\", 0.8)"},
    {"orbit", "*", STEER, JOX_STEER_ORBIT, 0, "orbit(place [, options])", "",
     "round a place, counter-clockwise. Options: inward, density_near, density_far, far and "
     "beyond set how dense the crowd about it may be", "orbit(\"yard\", { far = 20 })"},
    {"queue", "p", STEER, JOX_STEER_QUEUE, 0, "queue(place)", "",
     "to the end of a queue, along it where walls hide that, and straight where they hide all of it (`field` leads round "
     "them); an agent that comes within 1 m of the queue takes the next place, and moves up as those before it leave",
     "queue \"row\""},
    {"ride", "p", STEER, JOX_STEER_RIDE, 0, "ride(place)", "",
     "in a lift to the storey of the place, which the key `lifts` of a scene makes for each of its storeys (`LIFT.STOREY`), "
     "or by the lift of a set that takes least time: to the door, where the agent calls the lift and waits beside the door; in, when it "
     "is there, goes its way and has room; and out on that storey (see `rode`). It stands still where the place is no lift's", "ride \"east.first\""},
    {"along", "p", STEER, JOX_STEER_ALONG, 0, "along(place)", "",
     "in the direction of a line, or along a queue to its head", "along \"row\""},
    {"follow", "t?d", STEER, JOX_STEER_FOLLOW, 0, "follow(target [, metres])", "",
     "to a position behind the target, at this distance, m", "follow(nearest \"people\", 1)"},
    {"together", "?d", STEER, JOX_STEER_TOGETHER, 0, "together([metres])", "",
     "towards the teammates that the agent sees, if they are farther away than this distance, m", "seek(\"post\") + 0.5 * together(1)"},
    {"drift", "nn", STEER, JOX_STEER_DRIFT, 0, "drift(x, y)", "",
     "in the direction x east and y north, numbers or expressions; a length of 1 means the wanted "
     "speed", "drift(1, 0.1 * mine.laps)"},
    {"wander", "?p", STEER, JOX_STEER_WANDER, 0, "wander([place])", "",
     "walks about: turns gradually, and away from walls; with a place: stays within it", "wander \"yard\""},
    {"formation", "t?d", STEER, JOX_STEER_FORMATION, 0, "formation(target [, metres])", "",
     "to the agent's place in a row, with this distance, m, from one to the next: along a line, "
     "or behind an agent and across the direction in which it looks. Agents keep the order in "
     "which they stand", "formation(\"mid\", 0.8)"},
    {"gather", "p?d", STEER, JOX_STEER_GATHER, 0, "gather(place [, degrees])", "",
     "to the agent's spot in a crowd that waits in a polygon, round walls and fixed bodies. The "
     "crowd fills the polygon from its front, which lies in this direction, degrees "
     "anti-clockwise from +x; agents stand 0.9 m apart, or closer where they are many, to 0.51 m "
     "and 1.2 breadths. Agents for whom there is no room stand around it", "gather(\"yard\", 90)"},
    {"spread_over", "p", STEER, JOX_STEER_GATHER, 1, "spread_over(place)", "",
     "to the agent's spot in a crowd that spreads evenly over the whole of a polygon, round walls and fixed bodies; the "
     "fewer they are, the farther apart they stand, up to 12 m", "spread_over \"yard\""},
    {"spread", NULL, STEER, JOX_STEER_SPREAD, 0, "spread", "",
     "away from the neighbours", "0.3 * spread + seek \"post\""},
    {"evade", NULL, STEER, JOX_STEER_EVADE, 0, "evade", "",
     "sideways, out of the way of oncoming agents; to the right of one that is straight ahead", "seek \"post\" + 0.5 * evade"},
    {"hold", NULL, STEER, JOX_STEER_HOLD, 0, "hold", "", "the agent stands still", "hold"},
    {"player", NULL, STEER, JOX_STEER_PLAYER, 0, "player", "",
     "a person at the live page, or the input log, drives this agent", "player"},
    /* drawn values */
#define X(kind, name, arguments, meaning, example)                                                 \
    {#name, "*", JOX_NODE_DIST, JOX_DIST_##kind, 0, #name "(" arguments ")", "",                   \
     meaning ", drawn once per agent", example},
    JOX_DISTS(X)
#undef X
    /* the machine's table */
    {"circuits", "p", JOX_NODE_CIRCUITS, 0, 0, "circuits(place)", "",
     "for `counts`: net number of counter-clockwise turns about a place since the agent first "
     "crossed its start line; turns back are subtracted", "circuits \"yard\""},
    {"memory", "*", 0, 0, 0, "memory { name = value, ... }", "",
     "declares the memory of each agent: numbers, booleans, somebody, which begins as `nobody`, and lists (`list`); kept through "
     "reloads. The result is a table of their values as expressions and targets", "memory { laps = 0, touched = false, prey = nobody }"},
    {"list", "*", 0, 0, 0, "list(capacity [, nobody])", "",
     "for `memory`: begins as an empty list of at most so many numbers, 1 to 16, or with `nobody` of people, bodies and "
     "places. mine.LIST.size, .first and .last read it, mine.LIST:contains(item) asks; `set` changes it: by "
     "mine.LIST:push(item), after which a full list lacks its first, :remove(item), which removes all that are the "
     "item, or :clear(). Who has left the world is in no list any more", "memory { met = list(8, nobody), times = list(3) }"},
    {":contains", "*", CONDITION, 0, 0, "list:contains(item)", "", "the list in memory holds this number or target", "mine.met:contains(nearest \"people\")"},
    {"machine", "*", 0, 0, 0, "machine { ... }", "", "the table that a behaviour returns, or that a state runs (see `runs`)",
     "machine { name = \"m\", start = \"A\", states = { A = {} } }"},
    {"sequence", "*", 0, 0, 0, "sequence { step, ... }", "",
     "a machine of steps, one after the other, which ends after the last; a state runs it (see `runs`). A step is a "
     "steering: seek, field, queue and ride are over when the agent is there; wait(seconds); a machine, over when it has "
     "ended; a function(me), called once; or a state's table, with `lasts` or `when`, the condition that it is over. "
     "A text names the step after it, as does `name` in a table; other steps are called \"1 seek post\", \"2 wait\". "
     "Keys of a machine may stand in it, too",
     "sequence { seek \"post\", wait(2) }"},
    {"wait", "*", 0, 0, 0, "wait(seconds)", "",
     "a step of a sequence: the agent stands for this time, s: a number, distribution or expression",
     "sequence { wait(uniform(1, 2)), seek \"post\" }"},
    {"back", NULL, 0, 0, 0, "back", "",
     "for `to`: the state that the agent left when it entered the present one, other than by `back`; if there is "
     "none, the state in which the machine begins", "back"},
    {"patch", "*", 0, 0, 0, "patch \"behaviour\" { ... }", "",
     "in a mod: changes a behaviour's table, key by key; returned by the file",
     "patch \"stander\" { defaults = { perception = 2 } }"},
    {"replace", "*", 0, 0, 0, "replace \"behaviour\" { ... }", "",
     "in a mod: replaces a behaviour's whole table; returned by the file",
     "replace \"stander\" { name = \"stander\", start = \"Stand\", states = { Stand = {} } }"},
    {"none", NULL, 0, 0, 0, "none", "", "in a patch: removes a key or a state",
     "patch \"stander\" { defaults = { perception = none } }"},
    {"before", "*", 0, 0, 0, "before(function)", "",
     "in a patch, for on_enter, on_exit, on_take, when or steer: runs a function(me) before what stands "
     "there, a function or not, which goes on to work and alone gives the result",
     "patch \"stander\" { states = { Stand = { on_enter = before(function(me) me.speed = 1 end) } } }"},
    {"afterwards", "*", 0, 0, 0, "afterwards(function)", "",
     "in a patch: as `before`, but runs the function after what stands there",
     "patch \"stander\" { states = { Stand = { on_exit = afterwards(function(me) me.speed = 1 end) } } }"},
    {"around", "*", 0, 0, 0, "around(function)", "",
     "in a patch: calls function(me, previous) in place of what stands there; previous(me) calls that, and "
     "returns true or false for `when`, the velocity as two numbers in m/s for `steer`",
     "patch \"stander\" { states = { Stand = { steer = around(function(me, previous) "
     "local x, y = previous(me) return 2 * x, 2 * y end) } } }"},
    {"settings", NULL, 0, 0, 0, "settings.NAME", "",
     "in a mod: the value of a setting: a plain number, true or false, or a text", "patch \"stander\" { defaults = { perception = settings.reach } }"},
    {"require", "*", 0, 0, 0, "require \"name\"", "",
     "returns what another file returns: one beside this file, or of the library; in a mod also "
     "\"mod:name\"",
     "require \"crowd\""},
    {"print", "*", 0, 0, 0, "print(...)", "", "writes a line to the output; the number of lines a second is limited",
     "print(\"loaded\")"},
};
const size_t jox_word_count = sizeof jox_words / sizeof *jox_words;

const JoxWordNumber jox_word_numbers[] = {
    {"orbit", "inward", -10, 10, 0.5, ""},
    {"orbit", "density_near", 0, 20, 5.6, "1/m2"},
    {"orbit", "density_far", 0, 20, 4.6, "1/m2"},
    {"orbit", "far", 0.1, 10000, 40, "m"},
    {"orbit", "beyond", 0, 10000, 50, "m"},
    {"dodge", "metres", 0, 100, 1, "m"},
    {":incoming", "metres", 0.01, 100, NAN, "m"},
    {":within", "metres", 0.01, 1000, NAN, "m"},
    {":ahead", "degrees", 1, 179, NAN, "degrees"},
    {"follow", "metres", 0, 1000, 1, "m"},
    {"together", "metres", 0, 1000, 1, "m"},
    {"formation", "metres", 0.1, 100, 0.7, "m"},
    {"gather", "degrees", -360, 360, 90, "deg"},
    {"drift", "x", -100, 100, NAN, ""},
    {"drift", "y", -100, 100, NAN, ""},
};
const size_t jox_word_number_count = sizeof jox_word_numbers / sizeof *jox_word_numbers;

const JoxTableKey jox_table_keys[] = {
    {"machine", "name", "text", "", "name of the behaviour in messages and for mods", "name = \"walker\"", 0, 0},
    {"machine", "version", "number", "", "a number for messages, chosen by the author", "version = 1", 0, 0},
    {"machine", "start", "name of a state", "", "state in which agents begin", "start = \"Start\"", 0, 0},
    {"machine", "defaults", "table of parameters", "", "values for all states, drawn once per agent",
     "defaults = { speed = normal(1.3, 0.2), radius = 0.2 }", 0, 0},
    {"machine", "own", "table", "", "own values besides the parameters, drawn once per agent: numbers, distributions, or places by name; a group of the scene may set them",
     "own = { courage = uniform(0, 1), camp = \"yard\" }", 0, 0},
    {"machine", "public", "name or list of names", "", "memory that other agents may read, by `theirs` and `:where`",
     "public = { \"laps\" }", 0, 0},
    {"machine", "counts", "table", "", "memory that counts by itself, in all states; see `circuits`",
     "counts = { laps = circuits \"yard\" }", 0, 0},
    {"machine", "renamed", "table of names", "", "old name = new name, for states, own values and memory that were renamed: agents keep them at a reload. A scene, mod or other behaviour that uses the old name gets an error that names the new one",
     "renamed = { Old = \"Start\" }", 0, 0},
    {"machine", "states", "table of states", "", "name of a state = its table", "states = { Start = { steer = hold } }", 0, 0},
    {"state", "steer", "steering or function", "", "where the agent wants to go: a steering word, a weighted sum of them, or function(me) that returns vx, vy in m/s",
     "steer = 0.8 * seek(\"post\") + 0.2 * spread", 0, 0},
    {"state", "runs", "machine", "", "a machine that the agent runs while it is in this state, which begins anew each time. Its states are named after this one, \"Guard.Walk\", and inherit what they do not set; the transitions of this state come first, and its clocks are its own",
     "runs = machine { start = \"Wait\", states = { Wait = { steer = hold } } }", 0, 0},
    {"state", "ends", "true or false", "", "the machine ends in this state; a state that runs it finds `done` true", "ends = true", 0, 0},
    {"state", "lasts", "number, distribution", "s", "duration of the state, drawn on entering it; see `lasted`", "lasts = uniform(1, 3)", 0, 1e6},
    {"state", "removes", "true or false", "", "the agent leaves the world on entering", "removes = false", 0, 0},
    {"state", "lies", "true or false", "", "the live page shows the agent as lying down; nothing else changes", "lies = true", 0, 0},
    {"state", "pose", "name of a pose", "", "how the live page draws the agent: \"brace\", \"raise\", \"carry\", \"throw\" or \"point\" with its arms, \"sit\" or \"kneel\" with its whole body; nothing else changes",
     "pose = \"raise\"", 0, 0},
    {"state", "become", "name of a behaviour", "", "on entering, the agent changes to another machine, at its start; it keeps its body, the values that the scene gave it, and memory of the same name",
     "become = \"stander\"", 0, 0},
    {"state", "push_when", "condition", "", "the agent pushes only while this holds", "push_when = stuck(2)", 0, 0},
    {"state", "push_toward", "target", "", "direction in which the agent pushes; without it the direction in which it wants to go", "push_toward = \"post\"", 0, 0},
    {"state", "push_weight", "\"equal\" or \"nearest\"", "", "\"equal\" shares the push among all agents in the way, \"nearest\" gives it to the nearest",
     "push_weight = \"nearest\"", 0, 0},
    {"state", "push_only", "tag or list of tags", "", "the agent pushes only agents with these tags", "push_only = \"people\"", 0, 0},
    {"state", "ignore", "tag or list of tags", "", "the agent does not avoid agents and bodies with these tags", "ignore = { \"people\" }", 0, 0},
    {"state", "face", "target", "", "where the agent looks; without it in its walking direction", "face = \"post\"", 0, 0},
    {"state", "approach", "target", "", "body or agent that the agent does not avoid in advance; it only does not overlap it. Agents are then kept apart by contacts alone, where forces are on",
     "approach = nearest \"ball\"", 0, 0},
    {"state", "stays_in", "target", "", "polygon that the agent does not leave of its own accord, as a player a court: it stops with its whole body before the edges, however it is steered or driven, and comes back if others pushed it out",
     "stays_in = \"yard\"", 0, 0},
    {"state", "kick", "table", "", "kicks a body that it touches, with no wall between. The body passes the agent's own body until it is clear of it", "kick = { nearest \"ball\", at = \"post\", impulse = 4 }", 0, 0},
    {"state", "take", "target", "", "body to pick up, if it is within 0.6 m and slower than 8 m/s, hands reach it and there is room to hold it. It is carried in front, its middle at 1.2 m above the ground; nearer or to a side where a wall, or a body that is static, driven or heavier than 200 kg, leaves no room, and it falls where there is none. Hands reach over obstacles that are lower than the lowest point of the body", "take = nearest \"ball\"", 0, 0},
    {"state", "drop", "target", "", "body that the agent carries and lets fall, as `drop = holding`", "drop = nearest \"ball\"", 0, 0},
    {"state", "grasp", "target", "", "agent to take hold of, if it is within 0.5 m. An agent that has fallen gets up the sooner, the more hold on to it. Both pull each other until the holder comes into a state without `grasp`, or 1 m is between them. The held agent is dragged, or carried while its own `damping` is 0; see `has` and `holders`", "grasp = nearest \"people\"", 0, 0},
    {"state", "grip", "number", "N", "greatest force with which the agent holds on; default 300", "grasp = nearest \"people\", grip = 400", 0, JOX_MOST_GRIP},
    {"state", "throw", "table", "", "throws the body that it carries, from its own side of walls", "throw = { nearest \"ball\", at = \"post\", speed = 6 }", 0, 0},
    {"state", "colour", "text", "", "colour of agents in this state where people are coloured by state; one of " JOX_COLOUR_RULE ". Default: one is chosen",
     "colour = \"vermilion\"", 0, 0},
    {"state", "signal", "name, or table", "", "signal that the agent gives on entering, and again after each interval with { name, every = seconds }",
     "signal = { \"alarm\", every = 1 }", 0, 0},
    {"state", "tell", "table", "", "message that the agent tells on entering: to whom, a target, also one that is remembered and out of sight, or `neighbours(tag)` for all those; its name; and up to 4 values, numbers, conditions (1 if they hold, else 0) or targets. Its values are those before `set`. It waits for the receiver from the next step on (see `told`)",
     "tell = { nearest \"people\", \"shot\", damage = 2 }", 0, 0},
    {"state", "set", "table", "", "values to set on entering, all of them computed from what was before: memory = number, condition, true/false, target, or a list's :push(item), :remove(item) or :clear(); team = name of a team; tags = tag or list of tags, in place of those that the agent had. Teams and tags may be new",
     "set = { laps = mine.laps + 1, tags = \"people\" }", 0, 0},
    {"state", "counts", "table", "", "memory that counts while the agent is in this state; see `circuits`", "counts = { laps = circuits \"yard\" }", 0, 0},
    {"state", "on_enter", "function(me)", "", "called when an agent enters the state", "on_enter = function(me) me.laps = 1 end", 0, 0},
    {"state", "on_exit", "function(me)", "", "called when an agent leaves the state", "on_exit = function(me) me.laps = 2 end", 0, 0},
    {"transition", "to", "name of a state, or back", "", "state to which it leads; see `back`. An item without it is a reaction: what it says is done, and the agent stays in its state. All reactions that hold are carried out, then the first transition that holds is taken", "to = \"Next\"", 0, 0},
    {"transition", "when", "condition or function(me)", "", "the transition is taken when this holds; of several that hold, the first. Without it: at once", "when = after(1)", 0, 0},
    {"transition", "every", "plain number", "s", "only when the time in the state reaches a multiple of this", "every = 0.5", 0.01, 1e6},
    {"transition", "chance", "number", "", "probability that it is taken, drawn each time that `when` becomes true", "chance = 0.5", 0, 1},
    {"transition", "set", "table", "", "values to set when it is taken: memory, team and tags, as in a state", "set = { touched = true }", 0, 0},
    {"transition", "signal", "name", "", "signal that the agent gives when it is taken", "signal = \"alarm\"", 0, 0},
    {"transition", "tell", "table", "", "message that the agent tells when it is taken, as in a state",
     "tell = { neighbours(\"people\"):within(5), \"shot\" }", 0, 0},
    {"transition", "on_take", "function(me)", "", "called when it is taken", "on_take = function(me) me.touched = true end", 0, 0},
    {"transition", "id", "text", "", "name for mods; default: the name in `to`, with #2, #3 for repeats", "id = \"leave\"", 0, 0},
    {"kick", "at", "target", "", "target of the kick; straight ahead without it, or while there is no such target in sight", "at = \"post\"", 0, 0},
    {"kick", "impulse", "number", "m/s", "change of the body's velocity (impulse in N s per kg of the body)", "impulse = 2 + 2 * now.speed", 0, 50},
    {"kick", "speed", "number", "m/s", "in place of `impulse`: speed of the body after the kick, exactly towards `at`, however it moved before; 0 stops it", "speed = 5 + 2 * now.speed", 0, 50},
    {"kick", "lift", "number", "degree", "angle of the kick above the horizontal, so that the body flies and falls; default 0. The impulse keeps its size", "lift = 30", 0, 90},
    {"throw", "at", "target", "", "target of the throw", "at = nearest \"people\"", 0, 0},
    {"throw", "speed", "number", "m/s", "horizontal speed of the throw", "speed = 6", 0.1, 40},
    {"signal", "every", "plain number", "s", "time between two signals", "every = 0.5", 0.01, 1e6},
};
const size_t jox_table_key_count = sizeof jox_table_keys / sizeof *jox_table_keys;

const JoxMeKey jox_me_keys[] = {
    {"id", "number", "", "number of the agent, never used for another one"},
    {"x", "number", "m", "position east"},
    {"y", "number", "m", "position north; in a building with storeys, in plan"},
    {"storey", "number", "", "number of the storey: 0 is the lowest one; on a stair, the nearer in height"},
    {"height", "number", "m", "elevation of the floor on which the agent is; 0 without storeys"},
    {"vx", "number", "m/s", "velocity east"},
    {"vy", "number", "m/s", "velocity north"},
    {"time", "number", "s", "simulated time"},
    {"time_in_state", "number", "s", "since the state was entered"},
    {"density", "number", "1/m2", "people per square metre around the agent"},
    {"pushed", "number", "N", "magnitude of the net force"},
    {"compression", "number", "N/m", "sum of contact force magnitudes over circumference"},
    {"load", "number", "N", JOX_LOAD_MEANING},
    {"fallen", "number", "s", "time since it fell; 0 while it stands"},
    {"team", "number", "", "number of its team; 0: none"},
    {"state", "text", "", "name of its state; nil of a neighbour without a machine"},
    {"machine", "text", "", "name of its machine; nil of a neighbour without one"},
    {"goal", "name of a place", "", "its goal; can be set"},
    {"neighbours", "list", "", "views of the agents that it sees, nearest first: those within perception, with no wall and no tall body between; its `neighbours` nearest, and in a crowd of at most 64 all of them. A view shows the agent as it was before the step; memory that is set in it changes after the step; memory that its machine lacks is nil"},
    {"signal", "function(name)", "", "gives a signal: me.signal(\"alarm\")"},
    {"tell", "function(whom, name, values)", "", "tells somebody a message, as `tell` does: me.tell(me.prey, \"shot\", { damage = 2 })"},
    {"told", "function(name)", "", "the oldest message of this name that waits, a table of its `sender` and values; nil if none does. It is used up when the functions and items of this step are done; further calls get the next one"},
    {"holding", "view", "", "the body that it carries, else the agent that it holds on to; nil: none. A list in memory is read as a table, a copy, and changed by setting it to a table. Memory that holds somebody is read in the same way: a view of an agent or body (a body has id, x, y, vx and vy), the name of a place, or nil; and it is set to one of them"},
    {"striker", "view", "", "who kicked or threw the body that hits it, else that body; nil: none"},
    {"in_sight", "true or false", "", "of a view: the agent sees it now. Of one whom it remembers and does not see, only `id` is known"},
};
const size_t jox_me_key_count = sizeof jox_me_keys / sizeof *jox_me_keys;
/* clang-format on */

size_t jox_table_key_names(const char *owner, bool parameters, const char **names,
                           size_t capacity) {
    size_t n = 0;
    for (size_t k = 0; k < jox_table_key_count && n < capacity; k++)
        if (strcmp(jox_table_keys[k].owner, owner) == 0)
            names[n++] = jox_table_keys[k].name;
    for (int p = 0; parameters && p < JOX_PARAM_COUNT && n < capacity; p++)
        names[n++] = jox_parameters[p].name;
    return n;
}

const char *jox_word_example(const char *name) {
    for (size_t i = 0; i < jox_word_count; i++)
        if (strcmp(jox_words[i].name, name) == 0)
            return jox_words[i].example;
    JOX_ASSERT(!"a word with a row");
    return "";
}

const JoxWordNumber *jox_word_number(const char *word, uint32_t n) {
    for (size_t i = 0; i < jox_word_number_count; i++)
        if (strcmp(jox_word_numbers[i].word, word) == 0 && n-- == 0)
            return &jox_word_numbers[i];
    return NULL;
}

JoxParameterInfo jox_table_key_number(const char *owner, const char *name) {
    for (size_t k = 0; k < jox_table_key_count; k++) {
        const JoxTableKey *key = &jox_table_keys[k];
        if (strcmp(key->owner, owner) == 0 && strcmp(key->name, name) == 0)
            return (JoxParameterInfo){key->name,  key->unit,     key->meaning,
                                      key->least, key->greatest, 0};
    }
    JOX_ASSERT(!"a key with a row");
    return (JoxParameterInfo){name, "", "", 0, 0, 0};
}
