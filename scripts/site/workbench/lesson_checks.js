// What each lesson of the tutorial asks for, by the title of its section. A check looks at what the engine says of the files, at what
// the crowd does when they run (engine/observe.js), or at the crowd that runs; what a lesson begins with passes none of its checks.

const SECONDS = 12; // for which a crowd is observed

const errorsIn = (problems, file) => problems.filter((p) => p.severity === "error" && (!file || p.file.endsWith(file)));
const goesTo = (tried, group, state) => tried.transitions.some((t) => t.group === group && t.to === state);
const moved = (box) => (box ? Math.hypot(box.right - box.left, box.high - box.low) : 0); // m
const sum = (census) => census.reduce((all, { people }) => all + people, 0);

/** Runs what is written; {} with nobody in it where it has errors. */
async function run(given, seconds = SECONDS, texts = given.texts, scene = given.scene) {
    const tried = await given.observe(texts, seconds, scene);
    return { people: {}, transitions: [], kicks: [], hits: [], reach: {}, bodies: {}, ...tried };
}

const item = (text, holds, why = "") => ({ text, holds: Boolean(holds), why });

/**
 * Checks by title. Each gets {texts, problems, observe(texts, seconds, scene), live: {news, scene, status, inspect}, lessons, scene: the
 * path of the lesson's} and returns [{text, holds, why}].
 */
export const CHECKS = {
    async "A court"(given) {
        const { texts, lessons, problems } = given, standIn = lessons.find((l) => l.title === "To the ball").after["dodge.lua"];
        const tried = await run(given, 0.1, { ...texts, "dodge.lua": standIn }), wrong = errorsIn(problems, "court.yaml").filter((p) => p.code !== "missing-file");
        return [
            item("The scene can be read", (texts["court.yaml"] ?? "").includes("jostle:") && wrong.length === 0, wrong[0]?.text),
            item("There is a player in each team", tried.people.red >= 1 && tried.people.blue >= 1),
            item("A ball lies in the red court", (tried.bodies.ball?.left ?? 1) < 0),
        ];
    },

    async "A player who stands"({ texts, problems }) {
        const wrong = errorsIn(problems, "dodge.lua"), other = errorsIn(problems, "court.yaml").filter((p) => !/has no 'court'/.test(p.text));
        return [
            item("dodge.lua returns a machine", texts["dodge.lua"] && wrong.length === 0 && other.length === 0, (wrong[0] ?? other[0])?.text),
            item("It has the state Wait, which steers by hold", /\bWait\s*=\s*\{[^}]*steer\s*=\s*hold/.test((texts["dodge.lua"] ?? "").replace(/--[^\n]*/g, ""))),
        ];
    },

    async "To the ball"(given) {
        const tried = await run(given);
        return [
            item("Red goes to the state Attack", goesTo(tried, "red", "Attack")),
            item("It runs to the ball", (tried.reach.red?.right ?? -9) > -2.6),
            item("The ball moves", moved(tried.bodies.ball) > 1),
        ];
    },

    async "A kick"(given) {
        const tried = await run(given);
        return [
            item("Red kicks the ball", tried.kicks.some((k) => k.group === "red")),
            item("The ball comes to the blue court", (tried.bodies.ball?.right ?? -9) > 0.5),
            item("Blue kicks it back", tried.kicks.some((k) => k.group === "blue")),
        ];
    },

    async "Out of the way"(given) {
        const { news } = given.live, machine = news.find((n) => n.machine === "dodge" && n.after.some((s) => s.state === "Defend"));
        const tried = await run(given, 120);
        return [
            item("The machine with Defend, Hit and Out was saved into the crowd that runs", machine && machine.after.some((s) => s.state === "Hit") && machine.after.some((s) => s.state === "Out"),
                "Save while the crowd runs: a restart begins anew"),
            item("No player was lost: as many before as after", machine && sum(machine.before) > 0 && sum(machine.before) === sum(machine.after)),
            item("A ball that hits a player brings them to Hit", tried.transitions.some((t) => t.to === "Hit")),
        ];
    },

    async "Two against two, with three balls"(given) {
        const tried = await run(given, 20), { scene } = given.live;
        return [
            item("Two players in each team", tried.people.red === 2 && tried.people.blue === 2),
            item("Three balls, all of which are kicked", Object.keys(tried.bodies).length === 3 && new Set(tried.kicks.map((k) => k.body)).size === 3),
            item("They are in the crowd that runs", scene?.bodies?.length === 3, "New bodies need a restart"),
        ];
    },

    async "A game that you play"(given) {
        const { scene, status } = given.live, tried = await run(given, 20);
        return [
            item("The machine plays both sides by itself", tried.kicks.some((k) => k.group === "red") && tried.kicks.some((k) => k.group === "blue")),
            item("The scene is a game", scene?.game, "A player and rules need a restart"),
            item("You play: a round has begun", status?.game?.on, "Press Play in the picture"),
            item("You drive a player of red", (status?.game?.on && peopleIn(scene, status, "Play") > 0), "Use WASD or the arrow keys; click the picture first"),
        ];
    },

    async "Why not?"({ live: { status, inspect } }) {
        const { agent, why } = inspect ?? {};
        return [
            item("A player is chosen", agent, "Click one in the picture, or find its number in the tab Person below it"),
            item("The transitions out of its state are listed there", agent && why?.transitions?.length > 0, "A state without transitions has none: choose a player who attacks or defends"),
            item("The time stands still, and the list is the same", agent && status?.paused, "Press Space in the picture, or the button at its top"),
        ];
    },

    async "A machine that a state runs"(given) {
        const tried = await run(given, 20), of = tried.transitions.filter((t) => t.group === "referee");
        return [
            item("The referee runs the patrol: it seeks a court and waits there", of.some((t) => /^Patrol\.\d.* wait/.test(t.to))),
            item("Near the ball it stands and watches", goesTo(tried, "referee", "Watch")),
            item("Then it goes back to the step that it left", of.some((t, n) => t.from === "Watch" && n > 0 && t.to === of[n - 1].from)),
            item("The scene runs in the picture", given.live.scene?.machines?.some((m) => m.name === "referee"), "Start it: it is another scene"),
        ];
    },

    async "People who know each other"(given) {
        const tag = await run(given, 30), lost = await run(given, 30, given.texts, "lost.yaml");
        const chasers = new Set(tag.transitions.filter((t) => t.to === "Chase").map((t) => t.group));
        return [
            item("In yard.yaml somebody chooses whom to chase, and catches them", tag.transitions.some((t) => t.from === "Chase" && t.to === "Walk")),
            item("Who is caught is told so, and chases then", chasers.size === 2),
            item("In lost.yaml somebody asks the way, and is answered", goesTo(lost, "lost", "Go")),
            item("They arrive", goesTo(lost, "lost", "There")),
            item("One of the two scenes runs in the picture", given.live.scene?.machines?.some((m) => m.name === "tag" || m.name === "lost"), "Start it: it is another scene"),
        ];
    },
};

/** What is said at the end of lessons at which something is finished. */
export const ENDS = { "A game that you play": "That is your game. Share it by a link or a zip, at the top; the next lessons show what else there is." };

/** People in the states of this name, by a scene message and a status. */
function peopleIn(scene, status, state) {
    return (scene?.machines ?? []).reduce((all, machine, m) => all + machine.states.reduce((own, { name }, s) => own + (name === state ? status.states?.[m]?.[s] ?? 0 : 0), 0), 0);
}
