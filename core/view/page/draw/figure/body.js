// The shape of a person in levels of detail: closed tubes around the bones of skeleton.js, and the pieces that only some
// wear. A vertex knows its two bones, its part of the body (which decides its colour) and the piece it belongs to.
import { BONE } from "./skeleton.js";

/** Parts of the body and of clothes, by number; shaders know them by these numbers. */
export const PART = { top: 0, sleeve: 1, hips: 2, leg: 3, skin: 4, head: 5, shoe: 6, bag: 7, cover: 8, hat: 9, skirt: 10 };

/** Pieces that are not everybody's: veil or long hair, hat, bag, skirt or robe. 0: of everybody. */
export const PIECE = { body: 0, cover: 1, hat: 2, bag: 3, skirt: 4 };

/** Corners around a tube by its `kind`, for each level of detail. */
const SIDES = { trunk: [16, 10, 6], limb: [10, 6, 4], head: [14, 8, 5], foot: [8, 5, 3] };

const bones = (a, b = a, share = 0) => [BONE[a], BONE[b], share];

/** A ring: its centre, half depth along x, half breadth along y, options. `fine`: only in levels below this. */
const ring = (z, x, y, deep, wide, bone, part, more = {}) => ({ z, x, y, deep, wide, bone, part, fine: 9, round: 2, ...more });

function trunk() {
    const p = bones("pelvis"), c = bones("chest"), m = (share) => bones("pelvis", "chest", share);
    return { kind: "trunk", rings: [
        ring(0.82, 0, 0, 0.05, 0.06, p, PART.hips, { fine: 2 }), ring(0.86, 0, 0, 0.098, 0.145, p, PART.hips), ring(0.93, -0.004, 0, 0.118, 0.172, p, PART.hips, { fine: 2 }),
        ring(0.985, -0.002, 0, 0.115, 0.17, m(0.1), PART.hips), ring(0.98, -0.002, 0, 0.122, 0.177, m(0.1), PART.top), ring(1.06, 0.002, 0, 0.11, 0.157, m(0.4), PART.top),
        ring(1.15, 0.004, 0, 0.112, 0.16, m(0.8), PART.top, { fine: 1 }), ring(1.26, 0.004, 0, 0.124, 0.178, c, PART.top, { round: 2.3 }), ring(1.35, 0, 0, 0.122, 0.186, c, PART.top, { fine: 1, round: 2.4 }),
        ring(1.42, -0.006, 0, 0.102, 0.178, c, PART.top, { round: 2.4 }), ring(1.46, -0.008, 0, 0.082, 0.14, c, PART.top, { fine: 2 }), ring(1.49, -0.006, 0, 0.062, 0.078, c, PART.top),
        ring(1.505, -0.004, 0, 0.053, 0.058, c, PART.top, { fine: 1 }),
    ] };
}

function neck() {
    const part = PART.skin;
    return { kind: "limb", rings: [ring(1.48, -0.004, 0, 0.05, 0.054, bones("chest"), part, { fine: 2 }), ring(1.505, -0.003, 0, 0.048, 0.05, bones("chest", "head", 0.4), part),
        ring(1.56, 0.004, 0, 0.047, 0.047, bones("head"), part)] };
}

function head() {
    const p = bones("head"), part = PART.head;
    return { kind: "head", ends: [true, true], rings: [
        ring(1.518, 0.022, 0, 0.03, 0.026, p, part), ring(1.532, 0.02, 0, 0.062, 0.046, p, part, { fine: 2 }), ring(1.56, 0.014, 0, 0.083, 0.062, p, part),
        ring(1.593, 0.01, 0, 0.094, 0.071, p, part, { fine: 1, nose: 0.004 }), ring(1.612, 0.009, 0, 0.097, 0.074, p, part, { fine: 1, nose: 0.02 }), ring(1.632, 0.007, 0, 0.099, 0.076, p, part, { nose: 0.008 }),
        ring(1.672, 0.003, 0, 0.102, 0.079, p, part, { fine: 1 }), ring(1.705, -0.002, 0, 0.095, 0.074, p, part), ring(1.733, -0.006, 0, 0.071, 0.055, p, part, { fine: 2 }), ring(1.748, -0.008, 0, 0.03, 0.024, p, part),
    ] };
}

function leg(side, sign) {
    const t = bones(`thigh${side}`), s = bones(`shin${side}`), hip = (share) => bones("pelvis", `thigh${side}`, share), knee = (share) => bones(`thigh${side}`, `shin${side}`, share);
    const at = (z, x, y, deep, wide, bone, part, more) => ring(z, x, sign * y, deep, wide, bone, part, more);
    return { kind: "limb", rings: [
        at(0.95, 0, 0.08, 0.075, 0.07, hip(0.3), PART.hips, { fine: 2 }), at(0.87, 0, 0.086, 0.098, 0.084, hip(0.7), PART.hips), at(0.78, 0.002, 0.087, 0.091, 0.08, t, PART.hips, { fine: 1 }),
        at(0.64, 0.004, 0.088, 0.077, 0.07, t, PART.hips), at(0.53, 0.004, 0.089, 0.066, 0.063, knee(0.15), PART.hips, { fine: 1 }), at(0.48, 0.004, 0.09, 0.063, 0.06, knee(0.5), PART.hips), at(0.48, 0.004, 0.09, 0.063, 0.06, knee(0.5), PART.leg),
        at(0.42, -0.002, 0.09, 0.061, 0.057, knee(0.9), PART.leg, { fine: 1 }), at(0.34, -0.008, 0.09, 0.062, 0.055, s, PART.leg), at(0.2, -0.006, 0.09, 0.052, 0.049, s, PART.leg, { fine: 2 }), at(0.085, 0, 0.09, 0.05, 0.048, s, PART.leg), at(0.075, 0, 0.09, 0.03, 0.03, s, PART.leg, { fine: 1 }),
    ] };
}

/** A foot is a tube along x: `z` of its rings is where along x they are, `deep` is up, `x` the height of the middle. */
function foot(side, sign) {
    const f = bones(`foot${side}`), at = (along, up, high, wide, more) => ring(along, up, sign * 0.09, high, wide, f, PART.shoe, { along: true, ...more });
    return { kind: "foot", ends: [true, true], rings: [at(-0.078, 0.045, 0.02, 0.02), at(-0.06, 0.047, 0.047, 0.036), at(-0.01, 0.05, 0.055, 0.041, { fine: 2 }), at(0.05, 0.036, 0.04, 0.045), at(0.12, 0.027, 0.03, 0.047, { fine: 1 }),
        at(0.165, 0.022, 0.022, 0.034), at(0.182, 0.02, 0.01, 0.016, { fine: 1 })] };
}

function arm(side, sign) {
    const a = bones(`arm${side}`), f = bones(`fore${side}`), elbow = (share) => bones(`arm${side}`, `fore${side}`, share), shoulder = bones("chest", `arm${side}`, 0.6);
    const at = (z, x, y, deep, wide, bone, part, more) => ring(z, x, sign * y, deep, wide, bone, part, more);
    return { kind: "limb", ends: [true, true], rings: [
        at(1.453, -0.004, 0.168, 0.024, 0.016, bones("chest", `arm${side}`, 0.3), PART.top), at(1.444, -0.004, 0.178, 0.046, 0.033, shoulder, PART.top, { fine: 2 }), at(1.415, -0.003, 0.188, 0.056, 0.045, bones("chest", `arm${side}`, 0.85), PART.top),
        at(1.32, 0, 0.194, 0.052, 0.045, a, PART.top), at(1.22, 0, 0.196, 0.046, 0.041, a, PART.top, { fine: 1 }), at(1.16, 0, 0.197, 0.042, 0.039, elbow(0.3), PART.top), at(1.16, 0, 0.197, 0.042, 0.039, elbow(0.3), PART.sleeve),
        at(1.12, 0, 0.197, 0.04, 0.037, elbow(0.75), PART.sleeve, { fine: 1 }), at(1.04, 0, 0.198, 0.04, 0.035, f, PART.sleeve), at(0.915, 0, 0.198, 0.034, 0.031, f, PART.sleeve),
        at(0.92, 0, 0.198, 0.029, 0.023, f, PART.skin), at(0.875, 0.002, 0.198, 0.036, 0.02, f, PART.skin, { fine: 2 }), at(0.82, 0.008, 0.196, 0.041, 0.019, f, PART.skin), at(0.755, 0.012, 0.192, 0.032, 0.016, f, PART.skin, { fine: 1 }), at(0.725, 0.012, 0.19, 0.014, 0.01, f, PART.skin),
    ] };
}

/** Veil or long hair around the head; the shader leaves the face free. */
function cover() {
    const h = bones("head"), down = (share) => bones("head", "chest", share), part = PART.cover;
    return { kind: "head", piece: PIECE.cover, ends: [false, true], rings: [
        ring(1.38, -0.08, 0, 0.045, 0.11, bones("chest"), part, { fine: 1 }), ring(1.42, -0.07, 0, 0.055, 0.115, down(0.9), part, { back: 1 }), ring(1.5, -0.05, 0, 0.062, 0.092, down(0.5), part, { back: 1, fine: 2 }), ring(1.56, -0.03, 0, 0.082, 0.088, h, part, { back: 1 }),
        ring(1.63, -0.02, 0, 0.1, 0.09, h, part, { back: 1 }), ring(1.685, -0.008, 0, 0.106, 0.09, h, part), ring(1.725, -0.008, 0, 0.094, 0.077, h, part, { fine: 2 }), ring(1.757, -0.01, 0, 0.062, 0.05, h, part), ring(1.766, -0.01, 0, 0.02, 0.016, h, part, { fine: 2 }),
    ] };
}

function hat() {
    const h = bones("head"), part = PART.hat;
    return { kind: "head", piece: PIECE.hat, ends: [true, true], rings: [
        ring(1.672, 0.055, 0, 0.125, 0.075, h, part, { fine: 1 }), ring(1.678, 0.05, 0, 0.13, 0.082, h, part), ring(1.69, -0.002, 0, 0.109, 0.086, h, part), ring(1.735, -0.006, 0, 0.095, 0.076, h, part), ring(1.762, -0.008, 0, 0.055, 0.044, h, part), ring(1.768, -0.008, 0, 0.015, 0.012, h, part, { fine: 2 }),
    ] };
}

function bag() {
    const c = bones("chest"), part = PART.bag, square = { round: 3.5 };
    return { kind: "limb", piece: PIECE.bag, ends: [true, true], rings: [
        ring(1.05, -0.165, 0, 0.03, 0.09, c, part, { ...square, fine: 2 }), ring(1.075, -0.17, 0, 0.062, 0.13, c, part, square), ring(1.22, -0.178, 0, 0.074, 0.142, c, part, square), ring(1.37, -0.165, 0, 0.06, 0.13, c, part, square), ring(1.42, -0.15, 0, 0.03, 0.09, c, part, square),
    ] };
}

/** A robe to the ankles; the shader shortens it to a skirt. Its hem follows both legs. */
function skirt() {
    const part = PART.skirt, p = bones("pelvis"), legs = (low) => [BONE[low ? "shinLeft" : "thighLeft"], BONE[low ? "shinRight" : "thighRight"], "side"];
    return { kind: "trunk", piece: PIECE.skirt, rings: [
        ring(1.06, 0.002, 0, 0.114, 0.162, bones("pelvis", "chest", 0.4), part), ring(0.96, 0, 0, 0.132, 0.186, p, part), ring(0.8, 0, 0, 0.142, 0.195, legs(false), part), ring(0.64, 0, 0, 0.146, 0.196, legs(false), part, { fine: 1 }),
        ring(0.5, 0, 0, 0.15, 0.198, legs(false), part), ring(0.34, -0.006, 0, 0.156, 0.2, legs(true), part, { fine: 2 }), ring(0.2, -0.01, 0, 0.16, 0.204, legs(true), part), ring(0.07, -0.01, 0, 0.165, 0.21, legs(true), part),
    ].reverse() };
}

const TUBES = [trunk(), neck(), head(), leg("Left", 1), leg("Right", -1), foot("Left", 1), foot("Right", -1), arm("Left", 1), arm("Right", -1), cover(), hat(), bag(), skirt()];

/** A point of a ring at an angle: a superellipse; the nose, and a face that no veil covers. */
function pointOf(r, angle) {
    const power = 2 / r.round, bend = (v) => Math.sign(v) * Math.abs(v) ** power, c = bend(Math.cos(angle)), s = bend(Math.sin(angle));
    if (r.along) return [r.z, r.y + r.wide * s, Math.max(0, r.x + r.deep * c)];
    let x = r.x + r.deep * c, y = r.y + r.wide * s;
    if (r.nose && Math.cos(angle) > 0.97) x += r.nose;
    if (r.back && Math.cos(angle) > 0) { // sides of a face
        x = r.x + 0.25 * r.deep * c;
        y = r.y + r.wide * Math.sign(s || 1) * Math.max(Math.abs(s), 0.92);
    }
    return [x, y, r.z];
}

/** Adds a tube of a level to `out`; its ends are closed by a vertex each where they are in sight (`ends`). */
function addTube(tube, level, out) {
    const rings = tube.rings.filter((r) => r.fine > level), sides = SIDES[tube.kind][level], first = out.points.length;
    const put = (at, r, side) => {
        const [a, b, given] = r.bone;
        let share = given;
        if (share === "side") share = 0.5 - 0.5 * Math.max(-1, Math.min(1, at[1] / 0.12));
        out.points.push(at);
        out.bones.push([a, b, Math.round(255 * share), r.part]);
        out.pieces.push(tube.piece ?? PIECE.body);
        out.seams.push(side);
    };
    for (const r of rings) for (let s = 0; s < sides; s++) put(pointOf(r, (2 * Math.PI * s) / sides), r, s);
    for (let i = 0; i + 1 < rings.length; i++) {
        if (Math.abs(rings[i].z - rings[i + 1].z) < 0.001 && rings[i].part !== rings[i + 1].part) continue; // a change of colour
        for (let s = 0; s < sides; s++) {
            const a = first + i * sides + s, b = first + i * sides + ((s + 1) % sides);
            out.triangles.push([a, b, b + sides], [a, b + sides, a + sides]);
        }
    }
    const middle = (r) => (r.along ? [r.z, r.y, r.x] : [r.x, r.y, r.z]);
    const ends = [[0, rings[0], false], [rings.length - 1, rings.at(-1), true]].filter((_, k) => tube.ends?.[k]);
    for (const [i, r, last] of ends) {
        const pole = out.points.length;
        put(middle(r), r, -1);
        for (let s = 0; s < sides; s++) {
            const a = first + i * sides + s, b = first + i * sides + ((s + 1) % sides);
            out.triangles.push(last ? [a, b, pole] : [b, a, pole]);
        }
    }
}

/** Normals: of the triangles around a point, those of the other side of a change of colour too. */
function normalsOf({ points, triangles, pieces }) {
    const sums = new Map(), key = (i) => `${pieces[i]} ${points[i].map((v) => Math.round(5e3 * v)).join()}`;
    const keys = points.map((_, i) => key(i));
    for (const [a, b, c] of triangles) {
        const u = points[b].map((v, k) => v - points[a][k]), w = points[c].map((v, k) => v - points[a][k]);
        const n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
        for (const k of new Set([keys[a], keys[b], keys[c]])) {
            const sum = sums.get(k) ?? [0, 0, 0];
            sums.set(k, sum.map((v, i) => v + n[i]));
        }
    }
    return points.map((_, i) => {
        const n = sums.get(keys[i]) ?? [0, 0, 1], size = Math.hypot(...n) || 1;
        return n.map((v) => v / size);
    });
}

/** Turns triangles whose corners run the wrong way: those of tubes that go down or along x. */
function orient(tube, from, out) {
    const down = tube.rings[0].z > tube.rings.at(-1).z, along = tube.rings[0].along;
    if (down !== Boolean(along)) for (let i = from; i < out.triangles.length; i++) out.triangles[i].reverse();
}

/**
 * The mesh of a level of detail, 0 the finest: {position, normal: Float32Array; bone: Uint8Array of first and second
 * bone, share of the second in 255ths, part; piece: Uint8Array; index: Uint16Array}. `plain`: without hat and bag.
 */
export function makeBody(level, plain = false) {
    const out = { points: [], bones: [], pieces: [], seams: [], triangles: [] };
    for (const tube of TUBES) {
        if (plain && (tube.piece === PIECE.hat || tube.piece === PIECE.bag)) continue;
        const from = out.triangles.length;
        addTube(tube, level, out);
        orient(tube, from, out);
    }
    return {
        position: new Float32Array(out.points.flat()), normal: new Float32Array(normalsOf(out).flat()),
        bone: new Uint8Array(out.bones.flat()), piece: new Uint8Array(out.pieces), index: new Uint16Array(out.triangles.flat()),
    };
}
