// The triangles of scenery, within a limit, so that no scene takes more memory than a browser gives a page. No part of
// three.js is needed.
import { GRAIN } from "./ground_shaders.js";
import { ALONG, STANDING } from "./scenery_kinds.js";
import { Paint, Pile, draw, rgb } from "./shapes.js";

/** Triangles of all scenery at most. */
export const MOST_TRIANGLES = 1.5e6;

const PAINTED = { line: "#f7f6f1", ring: "#f7f6f1", area: "#b9c4a8" };

/** Whether a colour is that of a lawn: green that leans to yellow. */
function isLawn([red, green, blue]) {
    return green > red && red > blue;
}

/** Functions that each paint a copy, or a stretch of a line. */
function* paintItem(paint, { kind, through = [], at = [], size, colour }) {
    const own = rgb(colour ?? PAINTED[kind]);
    if (kind === "line") for (let i = 0; i + 1 < through.length; i++) yield () => paint.line(through.slice(i, i + 2), size[1], own);
    if (kind === "area") yield () => paint.area(through, own, isLawn(own) ? GRAIN.lawn : GRAIN.floor);
    if (kind === "ring") for (const p of at) yield () => paint.ring(p, size[0] / 2, 0.08, own);
}

/** Functions that each add a copy, or a stretch of a fence. `rowOf(name)`: the row of a body, -1 if there is none. */
function* pileItem(pile, { kind, at = [], through = [], turns = [], size, colour, doors, body }, rowOf) {
    const own = colour ? { colour: rgb(colour) } : {};
    if (STANDING[kind]) {
        const row = body ? rowOf(body) : -1;
        if (body && row < 0) return; // it is not there, or not yet
        for (const [k, [x, y]] of at.entries()) {
            yield () => {
                pile.place(x, y, (turns[k] * Math.PI) / 180, row);
                STANDING[kind](pile, size, { ...own, doors, seed: draw(x, y) });
            };
        }
    } else if (ALONG[kind]) {
        for (let i = 0; i + 1 < through.length; i++) {
            const [ax, ay] = through[i], [bx, by] = through[i + 1], length = Math.hypot(bx - ax, by - ay);
            if (!(length > 0)) continue; // a point twice
            yield () => {
                pile.place(ax, ay, Math.atan2(by - ay, bx - ax));
                ALONG[kind](pile, length, size[1], size[2], { ...own, seed: draw(ax, ay) });
            };
        }
    }
}

/** Returns what is said of copies that are left out; an empty text if there are none. */
export function tellLeft(left, most) {
    const count = [...left.values()].reduce((sum, n) => sum + n, 0);
    if (count === 0) return "";
    const kinds = [...left].map(([kind, n]) => `${kind}: ${n}`).join(", ");
    return `Scenery has more than ${most / 1e6} million triangles. Not drawn: ${count} of its things (${kinds}). Remove some, or make them smaller.`;
}

/**
 * Makes the triangles of scenery: {pile, paint, left, text}. From the first copy that does not fit within `most` triangles,
 * all are left out: `left` counts them by kind, `text` tells it. `floor`: height of the floor at [x, y], m.
 */
export function buildScenery(items, bodies, beside, most = MOST_TRIANGLES, floor = undefined) {
    const pile = new Pile(beside, floor), paint = new Paint(floor), rows = new Map(bodies.map((body, row) => [body.name, row])), left = new Map();
    for (const item of items) {
        const copies = PAINTED[item.kind] ? paintItem(paint, item) : pileItem(pile, item, (name) => rows.get(name) ?? -1);
        for (const add of copies) {
            if (left.size === 0) {
                const stood = pile.triangles, painted = paint.triangles, rings = pile.rings.length;
                add();
                if (pile.triangles + paint.triangles <= most) continue;
                pile.cut(stood, rings);
                paint.cut(painted);
            }
            left.set(item.kind, (left.get(item.kind) ?? 0) + 1);
        }
    }
    return { pile, paint, left, text: tellLeft(left, most) };
}
