// Shapes that scenery is made of: boxes, posts, balls, arches, as triangles with a colour for each corner. Lengths in m;
// colours are sRGB, 0 to 1. No part of three.js is needed.

/** Beside such a block nothing is hidden, m. */
export const FAR = 1e6;

/** Returns sRGB [r, g, b], 0 to 1, of 0xrrggbb or "#rrggbb". */
export function rgb(colour) {
    const n = typeof colour === "string" ? parseInt(colour.slice(1), 16) : colour;
    return [(n >> 16) & 255, (n >> 8) & 255, n & 255].map((c) => c / 255);
}

/** Returns a colour by a factor: below 1 darker, above 1 towards white. */
export function tone(colour, factor) {
    return colour.map((c) => (factor <= 1 ? c * factor : c + (1 - c) * Math.min(1, factor - 1)));
}

/** A number from 0 to 1 that depends on some numbers alone, so that each copy of a thing looks alike in each picture. */
export function draw(...of) {
    let h = 2166136261;
    for (const n of of) h = Math.imul(h ^ Math.round(1000 * n), 16777619);
    h ^= h >>> 15;
    h = Math.imul(h, 2246822519);
    return ((h ^ (h >>> 13)) >>> 0) / 4294967296;
}

export const MOST_PIECES = 128; // that repeat along an axis of a thing

/**
 * Divides a length into equal pieces of about `each` m: {count, grow}. There are `most` at most: a longer thing has larger
 * pieces, `grow` times as large; else `grow` is 1.
 */
export function divide(length, each, { least = 1, most = MOST_PIECES, round = Math.round } = {}) {
    const wanted = Math.max(least, round(length / each));
    return wanted > most ? { count: most, grow: length / (each * most) } : { count: wanted, grow: 1 };
}

/** Returns the vector across a block's longest edge that ends `beside` m beside the block, m. */
export function acrossOf(points, [mx, my], beside) {
    let longest = 0, x = 1, y = 0;
    points.forEach((a, i) => {
        const b = points[(i + 1) % points.length], length = Math.hypot(b[0] - a[0], b[1] - a[1]);
        if (length <= longest) return;
        longest = length;
        x = (b[1] - a[1]) / length;
        y = (a[0] - b[0]) / length;
    });
    const reach = Math.max(...points.map((p) => Math.abs((p[0] - mx) * x + (p[1] - my) * y)));
    return [x * (reach + beside), y * (reach + beside)];
}

/** Triangles of a polygon without holes, by cutting off its ears: indices of corners. */
export function cutEars(points) {
    const turn = ([ax, ay], [bx, by], [cx, cy]) => (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    const area = points.reduce((sum, p, i) => sum + p[0] * points[(i + 1) % points.length][1] - p[1] * points[(i + 1) % points.length][0], 0);
    const left = points.map((_, i) => i), out = [];
    if (area < 0) left.reverse();
    while (left.length > 2) {
        const n = left.length;
        let ear = left.findIndex((b, i) => {
            const [pa, pb, pc] = [left[(i + n - 1) % n], b, left[(i + 1) % n]].map((k) => points[k]);
            return turn(pa, pb, pc) > 1e-9 && !left.some((k) => ![pa, pb, pc].includes(points[k]) &&
                turn(pa, pb, points[k]) >= 0 && turn(pb, pc, points[k]) >= 0 && turn(pc, pa, points[k]) >= 0);
        });
        if (ear < 0) ear = 0; // corners on a line
        out.push([left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]]);
        left.splice(ear, 1);
    }
    return out;
}

/** Corners and faces of a ball of 80 triangles about the origin, of radius 1. */
const BALL = (() => {
    const g = (1 + Math.sqrt(5)) / 2, unit = (v) => v.map((c) => c / Math.hypot(...v));
    const at = [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g], [g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]].map(unit);
    const faces = [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6], [7, 1, 8],
        [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7], [9, 8, 1]];
    return faces.flatMap(([a, b, c]) => {
        const half = (p, q) => unit(at[p].map((v, k) => v + at[q][k])), ab = half(a, b), bc = half(b, c), ca = half(c, a);
        return [[at[a], ab, ca], [at[b], bc, ab], [at[c], ca, bc], [ab, bc, ca]];
    });
})();

/** Rows of 3 or 4 numbers, as the graphics processor takes them. Lists of JavaScript need twice the memory. */
class Rows {
    constructor(width) {
        this.width = width;
        this.list = new Float32Array(0);
        this.length = 0; // numbers
    }

    add(a, b, c, d) {
        if (this.length + this.width > this.list.length) {
            const more = new Float32Array(Math.max(3072, Math.ceil(1.5 * this.list.length)));
            more.set(this.list);
            this.list = more;
        }
        this.list[this.length] = a;
        this.list[this.length + 1] = b;
        this.list[this.length + 2] = c;
        if (this.width > 3) this.list[this.length + 3] = d;
        this.length += this.width;
    }

    values() {
        return this.list.subarray(0, this.length);
    }
}

/**
 * Triangles of things that stand. A thing is placed by `place`; `block` says which part of the floor the shapes after it
 * stand on, as they are lowered together where they hide the crowd.
 */
export class Pile {
    /** `floor`: height of the floor at [x, y], m. */
    constructor(beside = 1.2, floor = () => 0) {
        this.beside = beside;
        this.floor = floor;
        this.position = new Rows(3);
        this.normal = new Rows(3);
        this.colour = new Rows(4); // red, green, blue; and glow, 0 to 1, which needs no light
        this.where = new Rows(4); // middle and extent across of the block, as walls have them
        this.part = new Rows(3); // height of the shape's foot, m; height above which no eye sees it, m, 0: none; row of its body, -1: none
        this.rings = []; // footprints {ring, high} for the shade on the floor, m
        this.place(0, 0, 0);
    }

    get triangles() {
        return this.position.length / 9;
    }

    /** Takes away the triangles after the first `triangles` and the footprints after the first `rings`. */
    cut(triangles, rings) {
        for (const rows of [this.position, this.normal, this.colour, this.where, this.part]) rows.length = 3 * rows.width * triangles;
        this.rings.length = rings;
    }

    /** The shapes that follow stand at [x, y], turned by `turn` rad; on the body of row `row`. */
    place(x, y, turn, row = -1) {
        this.at = [x, y, Math.cos(turn), Math.sin(turn)];
        this.row = row;
        this.base = row < 0 ? this.floor([x, y]) : 0;
        this.roof = 0;
        this.middle = [x, y];
        this.across = [FAR, FAR];
    }

    /** Returns [x, y] of the scene. */
    out([x, y]) {
        const [ox, oy, c, s] = this.at;
        return [ox + c * x - s * y, oy + s * x + c * y];
    }

    /** The shapes that follow stand on a box of the floor, up to `high` m. A `landmark` is never lowered. */
    block(x0, y0, x1, y1, high, landmark = false) {
        if (this.row >= 0) return; // moves: it is neither lowered nor has it baked shade
        const ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map((p) => this.out(p));
        this.middle = [0, 1].map((k) => (ring[0][k] + ring[2][k]) / 2);
        this.across = landmark ? [FAR, FAR] : acrossOf(ring, this.middle, this.beside);
        if (high > 0) this.rings.push({ ring, high });
    }

    /** Adds a flat polygon with a colour, and normals of its corners if it belongs to something round. */
    face(points, colour, foot, glow = 0, normals = null) {
        const [a, b, c] = points, u = b.map((v, k) => v - a[k]), v = c.map((w, k) => w - a[k]);
        const flat = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        const length = Math.hypot(...flat) || 1, [ox, oy, cos, sin] = this.at, even = flat.map((w) => w / length);
        for (let i = 1; i + 1 < points.length; i++) {
            for (let corner = 0; corner < 3; corner++) {
                const k = corner ? i + corner - 1 : 0, n = normals ? normals[k] : even, [x, y, z] = points[k];
                this.position.add(ox + cos * x - sin * y, oy + sin * x + cos * y, z + this.base);
                this.normal.add(cos * n[0] - sin * n[1], sin * n[0] + cos * n[1], n[2]);
                this.colour.add(colour[0], colour[1], colour[2], glow);
                this.where.add(this.middle[0], this.middle[1], this.across[0], this.across[1]);
                this.part.add(foot, this.roof, this.row);
            }
        }
    }

    /** An upright prism on a ring that runs anti-clockwise; it gets narrower upwards by the factor `taper`. */
    prism(ring, z0, z1, colour, { taper = 1, top = colour, glow = 0, foot = z0 } = {}) {
        const n = ring.length, mid = [0, 1].map((k) => ring.reduce((sum, p) => sum + p[k], 0) / n);
        const upper = ring.map((p) => p.map((v, k) => mid[k] + taper * (v - mid[k])));
        ring.forEach((p, i) => {
            const j = (i + 1) % n;
            this.face([[...p, z0], [...ring[j], z0], [...upper[j], z1], [...upper[i], z1]], colour, foot, glow);
        });
        if (taper > 0.01) this.face(upper.map((p) => [...p, z1]), top, foot, glow);
        if (z0 > 0.2) this.face([...ring].reverse().map((p) => [...p, z0]), colour, foot, glow);
    }

    box(x0, y0, z0, x1, y1, z1, colour, options) {
        this.prism([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], z0, z1, colour, options);
    }

    /** A round post, or a cone where `taper` is small. */
    post(x, y, z0, z1, radius, colour, { sides = 10, taper = 1, top = colour, glow = 0, foot = z0 } = {}) {
        const ring = Array.from({ length: sides }, (_, i) => [Math.cos((2 * Math.PI * i) / sides), Math.sin((2 * Math.PI * i) / sides)]);
        const at = (k, z, r) => [x + r * ring[k][0], y + r * ring[k][1], z];
        const slope = (radius * (1 - taper)) / Math.max(z1 - z0, 1e-6), flat = Math.hypot(1, slope);
        const normal = (k) => [ring[k][0] / flat, ring[k][1] / flat, slope / flat];
        for (let i = 0; i < sides; i++) {
            const j = (i + 1) % sides;
            this.face([at(i, z0, radius), at(j, z0, radius), at(j, z1, radius * taper), at(i, z1, radius * taper)], colour, foot, glow,
                [normal(i), normal(j), normal(j), normal(i)]);
        }
        if (taper > 0.01) this.face(ring.map((_, k) => at(k, z1, radius * taper)), top, foot, glow);
    }

    /** A ball or egg; `half`: only what is above its middle. */
    ball(x, y, z, [rx, ry, rz], colour, { half = false, foot = z - rz, glow = 0 } = {}) {
        for (const corners of BALL) {
            if (half && corners.every((v) => v[2] < 0.05)) continue;
            const points = corners.map((v) => [x + rx * v[0], y + ry * v[1], z + rz * (half ? Math.max(0, v[2]) : v[2])]);
            const normals = corners.map((v) => {
                const n = [v[0] / rx, v[1] / ry, v[2] / rz], length = Math.hypot(...n);
                return n.map((c) => c / length);
            });
            this.face(points, colour, foot, glow, normals);
        }
    }

    /** A straight bar between two points, `thick` m. */
    bar([ax, ay, az], [bx, by, bz], thick, colour, foot = Math.min(az, bz)) {
        const h = thick / 2, along = [bx - ax, by - ay, bz - az], length = Math.hypot(...along);
        if (!(length > 0)) return;
        const d = along.map((v) => v / length), side = Math.abs(d[2]) > 0.9 ? [1, 0, 0] : [-d[1] / Math.hypot(d[0], d[1]), d[0] / Math.hypot(d[0], d[1]), 0];
        const up = [side[1] * d[2] - side[2] * d[1], side[2] * d[0] - side[0] * d[2], side[0] * d[1] - side[1] * d[0]];
        const corner = (p, i, j) => p.map((v, k) => v + h * (i * side[k] + j * up[k]));
        const around = [[-1, -1], [1, -1], [1, 1], [-1, 1]], a = [ax, ay, az], b = [bx, by, bz];
        around.forEach(([i, j], k) => {
            const [m, n] = around[(k + 1) % 4];
            this.face([corner(a, i, j), corner(b, i, j), corner(b, m, n), corner(a, m, n)], colour, foot);
        });
    }

    /** A panel from x0 to x1 in the planes y0 and y1 with an opening below an arch, which springs at `spring` and ends below z1. */
    arch(x0, x1, y0, y1, z0, spring, z1, colour, { pier = 0.12, pieces = 8, foot = z0 } = {}) {
        const wide = x1 - x0, a = x0 + pier * wide, b = x1 - pier * wide, mid = (a + b) / 2, r = (b - a) / 2, rise = Math.min(1.15 * r, z1 - spring - 0.1);
        const curve = Array.from({ length: pieces + 1 }, (_, i) => {
            const t = Math.PI * (1 - i / pieces);
            return [mid + r * Math.cos(t), spring + rise * Math.sin(t)];
        });
        for (const [y, way] of [[y0, 1], [y1, -1]]) {
            const front = (points) => this.face((way > 0 ? points : [...points].reverse()).map(([x, z]) => [x, y, z]), colour, foot);
            front([[x0, z0], [a, z0], [a, spring], [x0, spring]]);
            front([[b, z0], [x1, z0], [x1, spring], [b, spring]]);
            front([[x0, spring], [a, spring], [a, z1], [x0, z1]]);
            front([[b, spring], [x1, spring], [x1, z1], [b, z1]]);
            for (let i = 0; i < pieces; i++) front([curve[i], curve[i + 1], [curve[i + 1][0], z1], [curve[i][0], z1]]);
        }
        const inside = [[a, z0], ...curve, [b, z0]], dark = tone(colour, 0.86);
        for (let i = 0; i + 1 < inside.length; i++) {
            const [[px, pz], [qx, qz]] = [inside[i], inside[i + 1]];
            this.face([[px, y0, pz], [px, y1, pz], [qx, y1, qz], [qx, y0, qz]], dark, foot);
        }
        this.face([[x0, y0, z1], [x1, y0, z1], [x1, y1, z1], [x0, y1, z1]], colour, foot);
    }
}

/** Triangles of what is painted on the floor: lines, circles, areas; in the order in which they are added. */
export class Paint {
    /** `floor`: height of the floor at [x, y], m. */
    constructor(floor = () => 0) {
        this.floor = floor;
        this.position = new Rows(3);
        this.colour = new Rows(4);
    }

    get triangles() {
        return this.position.length / 9;
    }

    /** Takes away the triangles after the first `triangles`. */
    cut(triangles) {
        this.position.length = 9 * triangles;
        this.colour.length = 12 * triangles;
    }

    /** Adds triangles; `grain`: GRAIN of the shader. */
    add(points, faces, colour, grain = 0) {
        for (const face of faces) {
            for (const k of face) {
                this.position.add(points[k][0], points[k][1], this.floor(points[k]) + 0.004);
                this.colour.add(colour[0], colour[1], colour[2], grain);
            }
        }
    }

    area(points, colour, grain = 0) {
        this.add(points, cutEars(points), colour, grain);
    }

    line(points, wide, colour) {
        for (let i = 0; i + 1 < points.length; i++) {
            const [ax, ay] = points[i], [bx, by] = points[i + 1], length = Math.hypot(bx - ax, by - ay) || 1;
            const ux = ((bx - ax) / length) * (wide / 2), uy = ((by - ay) / length) * (wide / 2);
            this.area([[ax - ux + uy, ay - uy - ux], [bx + ux + uy, by + uy - ux], [bx + ux - uy, by + uy + ux], [ax - ux - uy, ay - uy + ux]], colour);
        }
    }

    ring([x, y], radius, wide, colour, sides = 48) {
        const at = (k, r) => [x + r * Math.cos((2 * Math.PI * k) / sides), y + r * Math.sin((2 * Math.PI * k) / sides)];
        for (let k = 0; k < sides; k++) {
            this.add([at(k, radius - wide / 2), at(k, radius + wide / 2), at(k + 1, radius + wide / 2), at(k + 1, radius - wide / 2)], [[0, 1, 2], [0, 2, 3]], colour);
        }
    }
}
