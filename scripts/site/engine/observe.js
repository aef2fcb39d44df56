// What a crowd does in a number of seconds, for the checks of lessons: who went to which state, kicks, hits, and where bodies went.

const KICK = 0; // JoDone of jostle_read.h
const MOST = 400; // transitions told

/** Takes the greatest and least of a position into `box`. */
function widen(box, x, y) {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.low = Math.min(box.low, y);
    box.high = Math.max(box.high, y);
}

const boxAt = (x, y) => ({ left: x, right: x, low: y, high: y });

/**
 * Steps a scene for some seconds. Returns {people, transitions, kicks, hits, reach, bodies}: people by group at the start; who (group)
 * took which transition (machine, from, to) when (s); kicks and hits {time, group, body}; and the boxes (m) that groups and bodies were in.
 */
export function observe(scene, seconds) {
    const groups = new Map(), people = {}, reach = {}, bodies = {}, transitions = [], kicks = [], hits = [];
    const look = () => {
        const { entered, transitions: taken, actions, hits: struck } = scene.events(), { time } = scene;
        for (const { agent, group } of entered) {
            const name = scene.name("group", group);
            groups.set(agent, name);
            if (time === 0 || scene.tick <= 1) people[name] = (people[name] ?? 0) + 1;
        }
        for (const { agent, machine, from, to } of taken) {
            if (transitions.length < MOST) transitions.push({ time, group: groups.get(agent), machine: scene.name("machine", machine), from: scene.name("state", from, machine), to: scene.name("state", to, machine) });
        }
        for (const { agent, kind, other } of actions) if (kind === KICK) kicks.push({ time, group: groups.get(agent), body: scene.name("body", other) });
        for (const { agent, body } of struck) hits.push({ time, group: groups.get(agent), body: scene.name("body", body) });
        const ids = [...scene.column("id")].map(Number), xs = [...scene.column("x")], ys = [...scene.column("y")];
        ids.forEach((id, n) => widen((reach[groups.get(id)] ??= boxAt(xs[n], ys[n])), xs[n], ys[n]));
        for (const { name, x, y } of scene.bodies()) widen((bodies[name] ??= boxAt(x, y)), x, y);
    };
    look();
    while (scene.time < seconds - 1e-6) {
        scene.step(1);
        look();
    }
    return { people, transitions, kicks, hits, reach, bodies };
}
