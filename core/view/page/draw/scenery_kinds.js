// What the kinds of scenery look like, in shapes of shapes.js. Each kind is drawn about its own origin, on the floor; x is to
// the right, y to the back, its front looks towards -y. `size`: its lengths along x, y and z, m.
import { HOUSES, drawBuilding } from "./scenery_buildings.js";
import { MOST_PIECES, divide, draw, rgb, tone } from "./shapes.js";

const WOOD = rgb(0xa9825a), METAL = rgb(0x6d747c), DARK = rgb(0x2e333a), WHITE = rgb(0xf2f1ec), STONE = rgb(0xcfc8ba), GLASS = rgb(0x7d97a8);
const LEAVES = [0x5f8f4a, 0x6f9d4f, 0x4f8048, 0x7fa657].map(rgb), BARK = rgb(0x6f5640), GREEN = rgb(0x00855a), LIGHT = rgb(0xfff0c8);
const MOST_ROWS = 64; // of seats
const SEATS = [0x3c6fa8, 0x4a7db5, 0x35659c].map(rgb);

/** A crown of leaves: balls around a middle. */
function leaves(pile, [x, y, z], [rx, ry, rz], colour, seed, count = 6) {
    pile.ball(x, y, z, [0.78 * rx, 0.78 * ry, 0.8 * rz], tone(colour, 0.94), { foot: z - rz });
    for (let i = 0; i < count; i++) {
        const turn = 2 * Math.PI * ((i + 0.4 * draw(seed, i)) / count), high = 0.75 * (draw(seed, i, 1) - 0.4), out = 0.55 * (1 - 0.5 * Math.abs(high));
        const r = 0.42 + 0.16 * draw(seed, i, 2);
        pile.ball(x + out * rx * Math.cos(turn), y + out * ry * Math.sin(turn), z + high * rz, [r * rx, r * ry, r * rz],
            tone(colour, 0.88 + 0.2 * draw(seed, i, 3)), { foot: z - rz });
    }
}

function tree(pile, [x, y, z], { colour, seed }) {
    const crown = 0.62 * z, middle = z - crown / 2, trunk = 0.035 * z;
    pile.block(-trunk, -trunk, trunk, trunk, 1.2);
    pile.post(0, 0, 0, middle, trunk, BARK, { sides: 7, taper: 0.6 });
    leaves(pile, [0, 0, middle], [x / 2, y / 2, crown / 2], colour ?? LEAVES[Math.floor(4 * draw(seed))], seed, 7);
}

function bush(pile, [x, y, z], { colour, seed }) {
    pile.block(-x / 2, -y / 2, x / 2, y / 2, z);
    leaves(pile, [0, 0, 0.45 * z], [x / 2, y / 2, 0.55 * z], colour ?? LEAVES[Math.floor(4 * draw(seed))], seed, 5);
}

function lamp(pile, [, , z]) {
    pile.block(-0.08, -0.08, 0.08, 0.08, 1);
    pile.post(0, 0, 0, 0.3, 0.11, DARK, { sides: 8 });
    pile.post(0, 0, 0.3, z - 0.35, 0.055, DARK, { sides: 8, taper: 0.7 });
    pile.post(0, 0, z - 0.35, z - 0.05, 0.1, LIGHT, { sides: 8, taper: 1.5, glow: 0.9 });
    pile.post(0, 0, z - 0.05, z + 0.06, 0.2, DARK, { sides: 8, taper: 0.3 });
}

function bench(pile, [x, y, z], { colour = WOOD }) {
    const seat = 0.55 * z;
    pile.block(-x / 2, -y / 2, x / 2, y / 2, z);
    for (const end of [-1, 1]) {
        const at = end * (x / 2 - 0.2);
        pile.box(at - 0.04, -y / 2 + 0.05, 0, at + 0.04, y / 2 - 0.05, seat, DARK);
        pile.box(at - 0.03, y / 2 - 0.12, seat, at + 0.03, y / 2 - 0.06, z, DARK);
    }
    for (let k = 0; k < 3; k++) pile.box(-x / 2, -y / 2 + k * (y / 3.3), seat, x / 2, -y / 2 + k * (y / 3.3) + 0.24 * y, seat + 0.04, tone(colour, 0.96 + 0.04 * k));
    for (const at of [seat + 0.12, z - 0.12]) pile.box(-x / 2, y / 2 - 0.12, at, x / 2, y / 2 - 0.07, at + 0.1, colour);
}

function seats(pile, [x, y, z], { colour, seed }) {
    const { count: rows } = divide(y, 0.85, { most: MOST_ROWS }), { count: places, grow } = divide(x, 0.55, { round: Math.floor });
    const deep = y / rows, rise = z / rows, half = 0.21 * grow;
    for (let row = 0; row < rows; row++) {
        const front = -y / 2 + row * deep, top = row * rise + 0.02;
        pile.block(-x / 2, front, x / 2, front + deep, top + 0.4);
        pile.box(-x / 2, front, 0, x / 2, front + deep, top, rgb(0xb9bcc0), { top: rgb(0xc8cace) });
        for (let k = 0; k < places; k++) {
            const at = -x / 2 + ((k + 0.5) * x) / places, own = colour ? tone(colour, 0.92 + 0.16 * draw(seed, row, k)) : SEATS[Math.floor(3 * draw(seed, row, k))];
            pile.box(at - half, front + 0.38 * deep, top + 0.34, at + half, front + 0.82 * deep, top + 0.42, own, { foot: 0.3 });
            pile.box(at - half, front + 0.78 * deep, top + 0.42, at + half, front + 0.86 * deep, top + 0.78, own, { foot: 0.3 });
        }
    }
}

/** Stripes of an awning, which slopes towards the front. */
function awning(pile, x0, x1, front, back, low, high, colour, foot) {
    const stripes = divide(x1 - x0, 0.35, { least: 3 }).count;
    for (let k = 0; k < stripes; k++) {
        const a = x0 + ((x1 - x0) * k) / stripes, b = x0 + ((x1 - x0) * (k + 1)) / stripes, own = k % 2 ? WHITE : colour;
        pile.face([[a, front, low], [b, front, low], [b, back, high], [a, back, high]], own, foot);
        pile.face([[a, back, high - 0.02], [b, back, high - 0.02], [b, front, low - 0.02], [a, front, low - 0.02]], tone(own, 0.75), foot);
        pile.face([[a, front, low - 0.16], [b, front, low - 0.16], [b, front, low], [a, front, low]], tone(own, 0.93), foot);
    }
}

function stall(pile, [x, y, z], { colour, seed }) {
    const cloth = colour ?? [0xc1443c, 0x2f7d5b, 0x2b6ca3, 0xd08a2c, 0x7b4b94].map(rgb)[Math.floor(5 * draw(seed))], top = 0.9;
    pile.block(-x / 2, -y / 2, x / 2, y / 2, z);
    pile.box(-x / 2, -y / 2, 0, x / 2, 0, top, WOOD, { top: tone(WOOD, 1.25) });
    for (const [px, py] of [[-1, -1], [1, -1], [-1, 1], [1, 1]]) {
        pile.box(px * (x / 2 - 0.05) - 0.04, py * (y / 2 - 0.05) - 0.04, 0, px * (x / 2 - 0.05) + 0.04, py * (y / 2 - 0.05) + 0.04, py > 0 ? z : z - 0.35, tone(WOOD, 0.8));
    }
    const goods = [0xd9534a, 0xe9b949, 0x7fae4d, 0xe08a3c, 0x8a5a9e, 0xf0e2b8].map(rgb), { count: crates, grow } = divide(x, 0.55, { least: 2 }), r = 0.1 * grow;
    for (let k = 0; k < crates; k++) {
        const at = -x / 2 + ((k + 0.5) * x) / crates, half = 0.42 * (x / crates);
        pile.box(at - half, -y / 2 + 0.08, top, at + half, -0.08, top + 0.1, tone(WOOD, 0.85), { foot: 0.5 });
        for (let n = 0; n < 6; n++) {
            pile.ball(at + half * (1.3 * draw(seed, k, n) - 0.65), -y / 4 + (y / 2 - 0.4) * (draw(seed, n, k, 1) - 0.5), top + 0.13, [r, Math.min(r, y / 8 + 0.1), 0.08], goods[Math.floor(6 * draw(seed, k))], { half: true, foot: 0.5 });
        }
    }
    awning(pile, -x / 2 - 0.1, x / 2 + 0.1, -y / 2 - 0.35, y / 2, z - 0.35, z, cloth, 1.5);
}

function stage(pile, [x, y, z]) {
    const deck = Math.min(1.2, 0.2 * z), a = x / 2, b = y / 2, truss = rgb(0x8d939b);
    pile.block(-a, -b, a, b, z);
    pile.box(-a, -b, 0, a, b, deck, rgb(0x24262b), { top: rgb(0x4a3f38) });
    pile.box(-a, b - 0.15, deck, a, b, z - 0.6, rgb(0x17181c));
    const up = 0.6 * divide(z, 0.6).grow, on = 0.7 * divide(x, 0.7).grow; // between the bars of the truss, m
    const wide = 0.62 * a, low = deck + 0.28 * (z - deck), high = z - 1;
    for (let k = 0; k < 12; k++) { // the screen: bands of colour
        const p = -wide + (2 * wide * k) / 12, q = -wide + (2 * wide * (k + 1)) / 12, own = [0x2a1f6f, 0x5b2a86, 0xa6317f, 0xe0524f, 0xf0924a, 0xf7cf62][Math.min(k, 11 - k)];
        pile.face([[p, b - 0.17, low], [q, b - 0.17, low], [q, b - 0.17, high], [p, b - 0.17, high]], rgb(own), 1, 0.85);
    }
    for (const px of [-1, 1]) {
        for (const py of [-1, 1]) {
            for (const [i, j] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) pile.box(px * (a - 0.25) + 0.15 * i - 0.03, py * (b - 0.25) + 0.15 * j - 0.03, 0, px * (a - 0.25) + 0.15 * i + 0.03, py * (b - 0.25) + 0.15 * j + 0.03, z, truss);
            for (let k = 0; k + up < z; k += up) pile.bar([px * (a - 0.25) - 0.15, py * (b - 0.25) - 0.15, k], [px * (a - 0.25) + 0.15, py * (b - 0.25) - 0.15, k + up], 0.04, truss, 0);
        }
        for (let k = 0; k < 3; k++) { // loudspeakers beside the deck
            const at = px * (a - 1.1);
            pile.box(at - 0.5, -b + 0.1, deck + 0.85 * k, at + 0.5, -b + 0.8, deck + 0.85 * k + 0.8, rgb(0x1d1f23));
            pile.box(at - 0.36, -b + 0.08, deck + 0.85 * k + 0.14, at + 0.36, -b + 0.1, deck + 0.85 * k + 0.66, rgb(0x3a3d43));
        }
    }
    for (const [py, lift] of [[-b + 0.25, 0], [b - 0.25, 0]]) {
        for (const i of [-0.15, 0.15]) pile.bar([-a, py + i, z + lift], [a, py + i, z + lift], 0.06, truss, 1);
        for (let k = -a; k + on <= a; k += on) pile.bar([k, py - 0.15, z], [k + on, py + 0.15, z], 0.04, truss, 1);
    }
    const lights = divide(x, 1.3, { least: 4 }).count, inks = [0xff5fa2, 0x5fc8ff, 0xffd35f, 0x8f7bff].map(rgb);
    for (let k = 0; k < lights; k++) {
        const at = -a + 0.6 + ((x - 1.2) * (k + 0.5)) / lights;
        pile.post(at, -b + 0.25, z - 0.45, z - 0.08, 0.16, DARK, { sides: 8, taper: 0.7, foot: 1 });
        pile.post(at, -b + 0.25, z - 0.5, z - 0.45, 0.15, inks[k % 4], { sides: 8, glow: 1, foot: 1 });
    }
}

/** A net between the corners of a quadrangle: `across` and `down` threads. */
function net(pile, [a, b, c, d], across, down) {
    const mix = (p, q, t) => p.map((v, k) => v + t * (q[k] - v));
    for (let k = 0; k <= across; k++) pile.bar(mix(a, b, k / across), mix(d, c, k / across), 0.012, rgb(0xe4e6e8), 0.5);
    for (let k = 0; k <= down; k++) pile.bar(mix(a, d, k / down), mix(b, c, k / down), 0.012, rgb(0xe4e6e8), 0.5);
}

function goal(pile, [x, y, z], { colour = WHITE }) {
    const a = x / 2, f = -y / 2, g = y / 2;
    for (const end of [-a, a]) {
        pile.post(end, f, 0, z, 0.05, colour, { sides: 8 });
        pile.bar([end, f, z], [end, g, 0.04], 0.03, METAL, 0.3);
        pile.bar([end, f, 0.04], [end, g, 0.04], 0.03, METAL, 0);
    }
    pile.bar([-a, f, z], [a, f, z], 0.1, colour, 0.5);
    pile.bar([-a, g, 0.04], [a, g, 0.04], 0.03, METAL, 0);
    net(pile, [[-a, f, z], [a, f, z], [a, g, 0.04], [-a, g, 0.04]], divide(x, 1 / 3).count, 8);
}

function posts(pile, [x, , z], { colour = WHITE }) {
    for (const end of [-1, 1]) {
        pile.post((end * x) / 2, 0, 0, 1.6, 0.14, rgb(0x2d5fa8), { sides: 10 });
        pile.post((end * x) / 2, 0, 0, z, 0.06, colour, { sides: 8 });
    }
    pile.bar([-x / 2, 0, Math.min(3, 0.4 * z)], [x / 2, 0, Math.min(3, 0.4 * z)], 0.1, colour, 0.5);
}

function sign(pile, [x, y, z]) {
    const low = 2.4, high = low + z, f = -y / 2 - 0.01, mid = low + z / 2;
    pile.box(-x / 2, -y / 2, low, x / 2, y / 2, high, GREEN, { glow: 0.8 });
    for (const [way, at] of [[1, f], [-1, -f]]) { // an arrow and a door
        const show = (points) => pile.face((way > 0 ? points : [...points].reverse()).map(([px, pz]) => [px, at, pz]), WHITE, low, 1);
        show([[-0.32 * x, mid - 0.06 * z], [0, mid - 0.06 * z], [0, mid + 0.06 * z], [-0.32 * x, mid + 0.06 * z]]);
        show([[-0.06 * x, mid - 0.26 * z], [0.12 * x, mid], [-0.06 * x, mid + 0.26 * z]]);
        show([[0.22 * x, low + 0.15 * z], [0.38 * x, low + 0.15 * z], [0.38 * x, high - 0.15 * z], [0.22 * x, high - 0.15 * z]]);
    }
}

function turnstile(pile, [x, y, z]) {
    pile.block(-x / 2, -y / 2, x / 2, y / 2, z);
    pile.box(-x / 2, -y / 2, 0, x / 2, y / 2, z, rgb(0xa9b1b9), { top: rgb(0x3b4650) });
    pile.box(-x / 2 - 0.01, -0.3 * y, 0.72 * z, -x / 2 + 0.01, 0.3 * y, 0.9 * z, rgb(0x36c26e), { glow: 0.9, foot: 0.3 });
    pile.box(-0.25 * x, -0.25 * y, z, 0.25 * x, 0.25 * y, z + 0.03, rgb(0xf2c14b), { foot: 0.3 });
}

function kiosk(pile, [x, y, z], { colour = rgb(0x3f6f8f) }) {
    pile.block(-x / 2, -y / 2, x / 2, y / 2, z);
    pile.box(-x / 2, -y / 2, 0, x / 2, y / 2, 1, tone(colour, 0.85));
    pile.box(-x / 2 + 0.06, -y / 2 + 0.06, 1, x / 2 - 0.06, y / 2 - 0.06, z - 0.4, rgb(0xbcd0da));
    pile.box(-x / 2 - 0.12, -y / 2 - 0.3, z - 0.4, x / 2 + 0.12, y / 2 + 0.12, z, colour, { foot: 1 });
    pile.box(-x / 2, -y / 2 - 0.14, 0.96, x / 2, -y / 2, 1.02, WOOD, { foot: 0.3 });
    for (let k = 0; k < 5; k++) pile.box(-x / 2 + 0.15 + (k * (x - 0.3)) / 5, -y / 2 + 0.03, 1.15, -x / 2 + 0.1 + ((k + 1) * (x - 0.3)) / 5, -y / 2 + 0.05, 1.6, [0xd9534a, 0xe9b949, 0x7fae4d, 0x2b6ca3, 0xf0e2b8].map(rgb)[k], { foot: 0.3 });
}

/** One long side of a carriage at y; doors are gaps of 1.4 m. `way`: -1 where its outside looks towards -y. */
function side(pile, x, y, z, way, gaps, colour) {
    const a = x / 2, cuts = [-a, ...gaps.flatMap((g) => [g - 0.7, g + 0.7]), a], thick = 0.05;
    pile.block(-a, y - thick, a, y + thick, 0);
    for (let k = 0; k < cuts.length; k += 2) {
        const [p, q] = [cuts[k], cuts[k + 1]];
        if (q - p < 0.05) continue;
        pile.box(p, y - thick, 0, q, y + thick, 0.95, rgb(0xe3e6e9));
        pile.box(p, y + way * thick - 0.012, 0.45, q, y + way * thick + 0.012, 0.72, colour);
        pile.box(p, y - thick, 2.05, q, y + thick, z - 0.3, rgb(0xe3e6e9));
        const panes = divide(q - p, 1.6).count, wide = (q - p) / panes;
        for (let n = 0; n < panes; n++) {
            pile.box(p + n * wide, y - thick, 0.95, p + n * wide + 0.12, y + thick, 2.05, rgb(0xe3e6e9));
            pile.box(p + n * wide + 0.12, y - 0.02, 0.95, p + (n + 1) * wide, y + 0.02, 2.05, GLASS);
        }
        pile.box(q - 0.12, y - thick, 0.95, q, y + thick, 2.05, rgb(0xe3e6e9));
    }
    for (const g of gaps) pile.box(g - 0.7, y - thick, 2.1, g + 0.7, y + thick, z - 0.3, colour);
}

function train(pile, [x, y, z], { colour = rgb(0xc8452f), doors }) {
    const a = x / 2, b = y / 2, gaps = doors ? [...doors].sort((p, q) => p - q) : [-0.375, -0.125, 0.125, 0.375].map((share) => share * x);
    pile.block(-a, -b, a, b, 0);
    side(pile, x, -b, z, -1, gaps, colour);
    side(pile, x, b, z, 1, [], colour);
    for (const end of [-1, 1]) {
        pile.block(end * a - 0.06, -b, end * a + 0.06, b, 0);
        pile.box(end * a - 0.06, -b, 0, end * a + 0.06, b, 1, colour);
        pile.box(end * a - 0.05, -b + 0.25, 1, end * a + 0.05, b - 0.25, 2.1, DARK);
        for (const edge of [-b, b - 0.25]) pile.box(end * a - 0.06, edge, 1, end * a + 0.06, edge + 0.25, 2.1, rgb(0xe3e6e9));
        pile.box(end * a - 0.06, -b, 2.1, end * a + 0.06, b, z - 0.3, colour);
        for (const edge of [-1, 1]) pile.box(end * a + 0.05 * end - 0.02, edge * 0.72 * b - 0.12, 0.55, end * a + 0.05 * end + 0.02, edge * 0.72 * b + 0.12, 0.75, LIGHT, { glow: 1 });
    }
    pile.block(-a, -b, a, b, 0, true);
    const { count: seated, grow } = divide(x, 1.1, { least: 0 });
    for (let k = 0; k + 1 < seated; k++) { // seats along the far side
        pile.box(-a + 0.4 + 1.1 * grow * k, b - 0.55, 0.4, -a + 0.4 + (1.1 * k + 0.95) * grow, b - 0.1, 0.48, rgb(0x3d5f8f));
    }
    pile.roof = z - 0.3; // whoever looks from above sees into it
    pile.box(-a, -b, z - 0.3, a, b, z, rgb(0xc2c7cc), { taper: 0.97 });
}

/** The draped cube: black cloth with a gold band, a door towards +x, and a skirt of marble. */
function kaaba(pile, [x, y, z]) {
    const a = x / 2, b = y / 2, cloth = rgb(0x1a1816), gold = rgb(0xc9a24a), bands = [[0, 0.66, cloth], [0.66, 0.67, gold], [0.67, 0.735, rgb(0x9c7a31)], [0.735, 0.745, gold], [0.745, 0.985, cloth], [0.985, 1, rgb(0x2b2825)]];
    pile.block(-a, -b, a, b, z, true);
    pile.prism([[-a - 0.3, -b - 0.3], [a + 0.3, -b - 0.3], [a + 0.3, b + 0.3], [-a - 0.3, b + 0.3]], 0, 0.35, rgb(0xe9e4d8), { taper: 0.97 });
    for (const [from, to, own] of bands) {
        const out = own === cloth ? 0 : 0.03;
        pile.box(-a - out, -b - out, from * z + (from ? 0 : 0.3), a + out, b + out, to * z, own, { top: to === 1 ? rgb(0xd8d3c6) : own });
    }
    for (const [w, n] of [[x, 0], [y, 1]]) { // ornaments of the band, and lamps of gold thread under it
        const { count, grow } = divide(w, 1.1, { least: 0 });
        for (let k = 0; k < count; k++) {
            const at = -w / 2 + ((k + 0.5) * w) / count;
            for (const way of [-1, 1]) {
                const [h, k0, k1] = n ? [way * (a + 0.045), at - 0.32 * grow, at + 0.32 * grow] : [way * (b + 0.045), at - 0.32 * grow, at + 0.32 * grow];
                const spot = (z0, z1, c0, c1) => (n ? pile.box(h - 0.012, c0, z0, h + 0.012, c1, z1, gold) : pile.box(c0, h - 0.012, z0, c1, h + 0.012, z1, gold));
                spot(0.683 * z, 0.722 * z, k0, k1);
                if (k % 3 === 1) spot(0.585 * z, 0.635 * z, at - 0.28 * grow, at + 0.28 * grow);
            }
        }
    }
    pile.box(a, -b + 1.9, 2.1, a + 0.1, -b + 3.9, 5.3, gold);
    pile.box(a + 0.08, -b + 2.1, 2.25, a + 0.13, -b + 3.7, 5.1, rgb(0xe2c476));
    pile.ball(a + 0.05, -b - 0.02, 1.5, [0.22, 0.22, 0.26], rgb(0xd5d7da)); // the frame of the Black Stone
    pile.ball(a + 0.16, -b - 0.13, 1.5, [0.12, 0.12, 0.15], rgb(0x201a18));
    pile.bar([0.8, b, z - 1.2], [0.8, b + 1.3, z - 1.35], 0.22, gold, 0); // the spout over the Hijr
}

function maqam(pile, [x, y, z]) {
    const r = Math.min(x, y) / 2, gold = rgb(0xc9a24a);
    pile.block(-r, -r, r, r, z, true);
    pile.post(0, 0, 0, 0.7, r, rgb(0x3a3835), { sides: 8 });
    pile.post(0, 0, 0.7, z - 0.9, 0.86 * r, rgb(0xb9cdd2), { sides: 8 });
    for (let k = 0; k < 8; k++) {
        const t = (2 * Math.PI * k) / 8;
        pile.post(0.9 * r * Math.cos(t), 0.9 * r * Math.sin(t), 0.7, z - 0.9, 0.05, gold, { sides: 5 });
    }
    pile.post(0, 0, z - 0.9, z - 0.75, r, gold, { sides: 8 });
    pile.ball(0, 0, z - 0.75, [0.85 * r, 0.85 * r, 0.6], gold, { half: true });
    pile.post(0, 0, z - 0.2, z, 0.04, gold, { sides: 5 });
}

function pillar(pile, [x, y, z], { colour = STONE }) {
    const r = Math.min(x, y) / 2;
    pile.block(-r, -r, r, r, z);
    pile.box(-1.15 * r, -1.15 * r, 0, 1.15 * r, 1.15 * r, 0.25, colour);
    pile.post(0, 0, 0.25, z - 0.3, 0.88 * r, colour, { sides: 12, taper: 0.92 });
    pile.box(-1.2 * r, -1.2 * r, z - 0.3, 1.2 * r, 1.2 * r, z, tone(colour, 1.1));
}

function block(pile, [x, y, z], { colour = rgb(0xb9b3a6) }) {
    pile.block(-x / 2, -y / 2, x / 2, y / 2, z);
    pile.box(-x / 2, -y / 2, 0, x / 2, y / 2, z, colour, { top: tone(colour, 1.08) });
}

/** Kinds that stand at a point: (pile, size, {colour, seed, doors}). */
export const STANDING = { tree, bush, lamp, bench, seats, stall, stage, goal, posts, sign, turnstile, kiosk, train, kaaba, maqam, pillar, block,
    ...Object.fromEntries(HOUSES.map((kind) => [kind, (pile, size, own) => drawBuilding(pile, kind, size, own)])) };

/** Kinds that stand along a segment of `length` m from the origin along +x: (pile, length, width, height, {colour, seed}). */
export const ALONG = {
    parapet(pile, length, wide, high, { colour = rgb(0xddd8cd) }) {
        pile.block(-wide / 2, -wide / 2, length + wide / 2, wide / 2, high);
        pile.box(-wide / 2, -wide / 2, 0, length + wide / 2, wide / 2, high - 0.08, colour);
        pile.box(-0.62 * wide, -0.62 * wide, high - 0.08, length + 0.62 * wide, 0.62 * wide, high, tone(colour, 1.3));
    },
    fence(pile, length, wide, high, { colour = METAL }) {
        pile.block(0, -wide / 2, length, wide / 2, 0);
        const pieces = divide(length, 1.6).count;
        for (let k = 0; k <= pieces; k++) pile.box((length * k) / pieces - wide / 2, -wide / 2, 0, (length * k) / pieces + wide / 2, wide / 2, high, colour);
        for (const z of [0.35 * high, 0.67 * high, high]) pile.bar([0, 0, z], [length, 0, z], 0.6 * wide, colour, 0);
    },
    hedge(pile, length, wide, high, { colour = LEAVES[2], seed }) {
        pile.block(0, -wide / 2, length, wide / 2, high);
        pile.box(0, -0.42 * wide, 0, length, 0.42 * wide, 0.8 * high, tone(colour, 0.9));
        const step = Math.max(0.8 * wide, length / MOST_PIECES);
        for (let k = 0; k <= length / step; k++) {
            pile.ball(Math.min(length, step * k), 0, 0.62 * high, [0.775 * step, 0.55 * wide, 0.4 * high * (0.9 + 0.2 * draw(seed, k))], tone(colour, 0.9 + 0.2 * draw(seed, k, 1)));
        }
    },
};
