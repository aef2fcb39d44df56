// The gallery's data: titles, sentences, people and previews of the shipped scenes.
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, readdirSync, copyFileSync, statSync, writeFileSync } from "node:fs";
import { basename, extname, join } from "node:path";

/** Headings of the gallery, and the scenes below them; what is named nowhere comes below the last one. */
const SUBJECTS = [
    ["Play", "You drive somebody, by keys, touch or a gamepad.", /^(dodgeball|dodgeball-500|catch|tackle)$/],
    ["Dense crowds", "Thousands who press, push and break things.",
        /^(tawaf|tawaf-few|office|wall-breaking|circle|two-bottlenecks|mosh-pit|san-fermin|crowd-collapse|running-through|outbreak)$/],
    ["Ways out and ways through", "People leave, queue, choose gates and catch trains.",
        /^(evacuation|arena|metro|station|train-doors|gates|drill|counter|two-exits|exit-lost|premovement|premovement-many)$/],
    ["People with aims", "Behaviours in Lua: parties, thieves, sellers, rescuers.", /^(pickpocket|market|rescue|tour|families|slow-group|slow-person)$/],
    ["Pushing and giving way", "How forces go through a crowd, and who makes room.",
        /^(push-row|push-row-wall|pressed-row|wall-.*|stability|rude-polite|hurried-polite|giving-way|tawaf-.*|two-bottlenecks-full|dodgeball.*)$/],
    ["Held against real crowds", "Corridors, doors and corners of published experiments.",
        /^(bend|bidirectional|bottleneck|corner-.*|corridor.*|door-.*|exit|opening-.*|ring|single-file|counterflow|one-way|counter-rooms|room-exit)$/],
    ["Test cases of guidelines", "Of RiMEA, ISO 20414 and IMO 1533.", /./],
];
/** s after which a scene shows what it is about, where that is not the usual time. */
const BEFORE = { tawaf: 2, "tawaf-pushing": 2, "tawaf-queue": 2, "tawaf-few": 10, counterflow: 5, "one-way": 2, arena: 6, circle: 16, metro: 70, "wall-breaking": 14, evacuation: 12,
    "two-bottlenecks": 25, "san-fermin": 10, "running-through": 3, "push-row": 2, dodgeball: 3, outbreak: 20, station: 20, office: 12 };
const OTHERWISE = 8; // s
const FEW = 30; // people who are drawn by their outlines; of more there are dots
const MOST_PEOPLE = 2500; // drawn in a preview; of more, each n-th
const FLOOR = "#dadddf";

const unquoted = (text) => text?.trim().replace(/^"(.*)"$/, "$1").replace(/^'(.*)'$/, "$1");

/** The value of a plain key on the first level of a scene, or of a scene that it includes. */
function valueOf(read, path, key) {
    const text = read(path), value = new RegExp(`^${key}: *(.*)$`, "m").exec(text)?.[1];
    const include = /^include: *([\w./-]+)/m.exec(text)?.[1];
    return value ? unquoted(value) : include ? valueOf(read, `scenes/${include}`, key) : undefined;
}

/** The middle and breadth of a drawn person, in the drawing's units: of a circle, or of the box about a path. */
function middleOf(line) {
    const circle = /cx="([\d.]+)" cy="([\d.]+)" r="([\d.]+)"/.exec(line)?.slice(1).map(Number);
    if (circle) return [circle[0], circle[1], 2 * circle[2]];
    const points = [...line.matchAll(/[ML]([\d.-]+) ([\d.-]+)/g)].map((m) => [Number(m[1]), Number(m[2])]);
    if (points.length === 0) return null;
    const [xs, ys] = [0, 1].map((k) => points.map((p) => p[k]));
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    return [(left + right) / 2, (low + high) / 2, Math.max(right - left, high - low)];
}

/** The people of a drawing as one line of round dots for each colour: a tenth of the bytes. */
function dotsOf(people, every) {
    let n = 0;
    return people.split("<g class=").slice(1).map((group) => {
        const colour = /fill="([^"]+)"/.exec(group)?.[1] ?? "#1f2933", all = group.split("\n").map(middleOf).filter(Boolean).filter(() => n++ % every === 0);
        if (all.length === 0) return "";
        const wide = all.map((p) => p[2]).sort((a, b) => a - b)[all.length >> 1] * 0.9 * Math.sqrt(Math.min(every, 3));
        return `<path fill="none" stroke="${colour}" stroke-width="${Math.max(1.6, wide).toFixed(1)}" stroke-linecap="round" d="${all.map(([x, y]) => `M${x.toFixed(1)} ${y.toFixed(1)}h0`).join("")}"/>`;
    }).join("\n");
}

/** Cuts a drawing by `jostle render` down to the crowd: no head, names and legend. Returns the SVG text, and how many people there are. */
export function cutPreview(svg) {
    const [, x, y, width, height] = /<clipPath id="clip0"><rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)"/.exec(svg);
    const people = Number(/([\d,]+) (?:people|person)</.exec(svg)?.[1].replaceAll(",", "") ?? 0);
    const begin = svg.indexOf("\n", svg.indexOf('<g clip-path="url(#clip0)">')), start = svg.indexOf('<g id="people"'), end = svg.indexOf('<g id="headings"');
    const above = svg.indexOf('<g id="bodies-above"'), names = svg.indexOf('<g id="names"');
    const crowd = people > FEW ? dotsOf(svg.slice(start, end), Math.ceil(people / MOST_PEOPLE)) : svg.slice(start, end);
    const inner = svg.slice(begin, start) + crowd + (above > 0 && people <= MOST_PEOPLE ? svg.slice(above, names) : "");
    const plain = inner.replace(/<title>[^<]*<\/title>/g, "").replace(/(\d+\.\d)\d+/g, "$1").replace(/ stroke-linejoin="round"/g, "");
    return { people, svg: `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${x} ${y} ${width} ${height}"><rect x="${x}" y="${y}" width="${width}" height="${height}" fill="${FLOOR}"/>${plain}</svg>\n` };
}

/** Draws a scene, unless the drawing at `path` is newer than the scene: all of them take a minute. */
function drawPreview(jostle, root, name, path) {
    const scene = join(root, "scenes", `${name}.yaml`), full = `${path}.full.svg`;
    if (!existsSync(full) || statSync(full).mtimeMs < statSync(scene).mtimeMs) {
        execFileSync(jostle, ["render", scene, "--at", String(BEFORE[name] ?? OTHERWISE), "--no-mods", "--size", "960x600", "--out", full, "--quiet"], { stdio: ["ignore", "ignore", "pipe"] });
    }
    return cutPreview(readFileSync(full, "utf8"));
}

/**
 * Returns [{title, text, scenes: [{name, title, about, people, picture}]}] and writes previews into OUT/previews: pictures of
 * the live page from the first of the folders `pictures` that has one, else drawings, which `cache` keeps.
 */
export function makeGallery({ root, jostle, out, cache, pictures, read }) {
    mkdirSync(join(out, "previews"), { recursive: true });
    mkdirSync(cache, { recursive: true });
    const names = readdirSync(join(root, "scenes")).filter((f) => f.endsWith(".yaml")).map((f) => basename(f, ".yaml")).sort();
    const subjects = SUBJECTS.map(([title, text]) => ({ title, text, scenes: [] }));
    for (const name of names) {
        const path = `scenes/${name}.yaml`, { svg, people } = drawPreview(jostle, root, name, join(cache, name));
        const shot = pictures.flatMap((folder) => ["jpg", "webp"].map((ending) => join(folder, `${name}.${ending}`))).find(existsSync);
        const picture = `previews/${name}${shot ? extname(shot) : ".svg"}`;
        if (shot) copyFileSync(shot, join(out, picture));
        else writeFileSync(join(out, picture), svg);
        const row = { name, title: valueOf(read, path, "title") ?? name, about: valueOf(read, path, "about") ?? "", people, picture };
        subjects[SUBJECTS.findIndex(([, , which]) => which.test(name))].scenes.push(row);
    }
    const first = (which) => (a, b) => order(which, a.name) - order(which, b.name);
    SUBJECTS.forEach(([, , which], n) => subjects[n].scenes.sort(first(which)));
    return subjects;
}

/** The place of a name in an expression that lists names; those that it does not list come last. */
function order(which, name) {
    const at = which.source.indexOf(name);
    return at < 0 ? 1e6 : at;
}
