// Buildings of the scenery: arcades, minarets, houses. Called by scenery_kinds.js.
import { divide, draw, rgb, tone } from "./shapes.js";

const MOST_WINDOWS = 48; // of a face, along each axis
const CREAM = rgb(0xe6dfd0), GOLD = rgb(0xc9a24a), PANE = rgb(0x54687a), FRAME = rgb(0xf0ece2);
const PLASTERS = [0xe3c9a0, 0xd9b28a, 0xe8dcc0, 0xcfa07c, 0xdcc6b6, 0xe6d3b1].map(rgb), TILES = [0xa8573c, 0xb4634a, 0x9c4f38].map(rgb);
const SHUTTERS = [0x4d6b57, 0x6b4f3a, 0x3f5f78, 0x7a3f35].map(rgb);

/** Arches between piers, in one storey or two, before a wall; small domes on the roof. */
function arcade(pile, [x, y, z], { colour = CREAM }) {
    const bays = divide(x, 4.6).count, wide = x / bays, f = -y / 2, b = y / 2, roof = z - 0.7, storeys = z > 7 ? 2 : 1, high = roof / storeys;
    pile.block(-x / 2, f, x / 2, b, 0);
    for (let s = 0; s < storeys; s++) {
        const z0 = s * high;
        for (let k = 0; k < bays; k++) {
            const x0 = -x / 2 + k * wide;
            pile.arch(x0, x0 + wide, f, f + 0.6, z0, z0 + 0.55 * high, z0 + high - 0.25, tone(colour, 0.98 + 0.03 * (k % 2)));
        }
        pile.box(-x / 2, f - 0.15, z0 + high - 0.25, x / 2, f + 0.6, z0 + high, tone(colour, 1.15));
    }
    pile.box(-x / 2, b - 0.3, 0, x / 2, b, roof, tone(colour, 0.9));
    pile.box(-x / 2, f, roof - 0.3, x / 2, b, roof, tone(colour, 1.05));
    pile.box(-x / 2, f - 0.1, roof, x / 2, f + 0.25, z, colour);
    for (let k = 0; k < bays; k++) pile.ball(-x / 2 + (k + 0.5) * wide, 0.1 * y, roof, [0.3 * wide, Math.min(0.3 * wide, 0.36 * y), 0.26 * wide], tone(colour, 1.2), { half: true });
}

function minaret(pile, [x, y, z], { colour = CREAM }) {
    const r = Math.min(x, y) / 2, levels = [[0, 0.28, 1, 4], [0.28, 0.58, 0.72, 8], [0.6, 0.8, 0.5, 12], [0.82, 0.89, 0.36, 12]];
    pile.block(-r, -r, r, r, 0);
    for (const [from, to, share, sides] of levels) {
        if (sides === 4) pile.box(-r, -r, from * z, r, r, to * z, colour);
        else pile.post(0, 0, from * z, to * z, share * r, tone(colour, 1.05), { sides, taper: 0.95 });
    }
    for (const [at, share] of [[0.28, 1.12], [0.58, 1.02], [0.8, 0.74]]) {
        pile.post(0, 0, at * z - 0.03 * z, at * z, 0.7 * share * r, tone(colour, 0.9), { sides: 12, taper: 1.4 });
        pile.post(0, 0, at * z, at * z + 0.02 * z, share * r, tone(colour, 1.15), { sides: 12 });
    }
    pile.ball(0, 0, 0.89 * z, [0.38 * r, 0.38 * r, 0.05 * z], tone(colour, 1.2), { half: true });
    pile.post(0, 0, 0.93 * z, z, 0.12 * r, GOLD, { sides: 6, taper: 0.05 });
}

/** Windows of one face of a house: on y, between x0 and x1. */
function windows(pile, x0, x1, y, way, { count: storeys, grow: v }, high, seed, shutter) {
    const { count: columns, grow: u } = divide(x1 - x0, 2.7, { most: MOST_WINDOWS }), wide = (x1 - x0) / columns;
    const pane = (a, b, low, top, out, colour) => pile.box(a, y + (way < 0 ? -out : 0), low, b, y + (way < 0 ? 0 : out), top, colour, { foot: high });
    const door = Math.floor(columns * draw(seed, 7));
    for (let s = 0; s < storeys; s++) {
        for (let k = 0; k < columns; k++) {
            const mid = x0 + (k + 0.5) * wide, low = s * high + 0.9 * v, top = s * high + Math.min(high - 0.5 * v, 2.4 * v);
            if (s === 0 && way < 0 && k === door) {
                pane(mid - 0.65 * u, mid + 0.65 * u, 0.02 * v, 2.35 * v, 0.05, FRAME);
                pane(mid - 0.52 * u, mid + 0.52 * u, 0, 2.2 * v, 0.08, tone(shutter, 0.8));
                continue;
            }
            pane(mid - 0.52 * u, mid + 0.52 * u, low - 0.08 * v, top + 0.08 * v, 0.05, FRAME);
            pane(mid - 0.42 * u, mid + 0.42 * u, low, top, 0.07, PANE);
            pane(mid - 0.03 * u, mid + 0.03 * u, low, top, 0.085, FRAME);
            if (way < 0) for (const side of [-0.74, 0.74]) pane(mid + (side - 0.18) * u, mid + (side + 0.18) * u, low - 0.05 * v, top + 0.05 * v, 0.06, shutter);
            if (way < 0 && s > 0 && draw(seed, s, k) < 0.25) { // a balcony
                pile.box(mid - 0.95 * u, y - 0.6, s * high + 0.1 * v, mid + 0.95 * u, y, s * high + 0.22 * v, tone(FRAME, 0.8));
                for (let n = 0; n <= 8; n++) pile.box(mid + (0.23 * n - 0.93) * u, y - 0.58, s * high + 0.22 * v, mid + (0.23 * n - 0.9) * u, y - 0.55, s * high + 1.05 * v, tone(PANE, 0.5));
                pile.box(mid - 0.95 * u, y - 0.6, s * high + 1.02 * v, mid + 0.95 * u, y - 0.53, s * high + 1.08 * v, tone(PANE, 0.5));
            }
        }
    }
}

function house(pile, [x, y, z], { colour, seed }) {
    const a = x / 2, b = y / 2, wall = colour ?? PLASTERS[Math.floor(6 * draw(seed))], tile = TILES[Math.floor(3 * draw(seed, 2))], eaves = 0.82 * z;
    const storeys = divide(eaves, 3, { most: MOST_WINDOWS }), high = eaves / storeys.count, shutter = SHUTTERS[Math.floor(4 * draw(seed, 3))], foot = eaves;
    pile.block(-a, -b, a, b, z);
    pile.box(-a, -b, 0, a, b, eaves, wall);
    pile.box(-a - 0.03, -b - 0.03, 0, a + 0.03, b + 0.03, 0.5, tone(wall, 0.8), { foot });
    windows(pile, -a + 0.3, a - 0.3, -b, -1, storeys, high, seed, shutter);
    windows(pile, -a + 0.3, a - 0.3, b, 1, storeys, high, seed, shutter);
    const o = 0.35;
    pile.face([[-a, -b - o, eaves], [a, -b - o, eaves], [a, 0, z], [-a, 0, z]], tile, foot);
    pile.face([[a, b + o, eaves], [-a, b + o, eaves], [-a, 0, z], [a, 0, z]], tone(tile, 0.95), foot);
    pile.face([[a, -b - o, eaves], [-a, -b - o, eaves], [-a, 0, z - 0.1], [a, 0, z - 0.1]], tone(wall, 0.7), foot);
    pile.face([[-a, b + o, eaves], [a, b + o, eaves], [a, 0, z - 0.1], [-a, 0, z - 0.1]], tone(wall, 0.7), foot);
    for (const side of [-1, 1]) {
        const gable = [[side * a, -b, eaves], [side * a, b, eaves], [side * a, 0, z]];
        pile.face(side > 0 ? gable : gable.reverse(), wall, foot);
    }
    const at = (draw(seed, 9) - 0.5) * x * 0.6;
    pile.box(at - 0.3, 0.15 * y, eaves, at + 0.3, 0.15 * y + 0.6, z + 0.5, tone(wall, 0.85), { foot });
}

const BUILDINGS = { arcade, minaret, house };
export const HOUSES = Object.keys(BUILDINGS);

/** Draws a building of a kind about its own origin. */
export function drawBuilding(pile, kind, size, own) {
    BUILDINGS[kind](pile, size, own);
}
