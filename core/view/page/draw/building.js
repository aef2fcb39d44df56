// What a building of several storeys is made of besides walls: slabs, stairs, ramps and escalators, shafts and cars of lifts, as
// triangles of shapes.js. Heights are above the floor of the deck, m; of a stair above its lower storey, and stretched where storeys are
// spread: rails and steps have the size of people all the same.
import { Pile, rgb, tone } from "./shapes.js";

const RISER = 0.17, THICK = 0.22, RAIL = 0.95; // m: of a step; of a slab; height of a handrail
const STRIDE = 0.5; // m between bends of a handrail
const CAR = 2.1, LEAF = 0.05; // m: height of a lift's car and door; thickness of the door
const STEPS = rgb(0xc4cad2), RISERS = rgb(0x9aa3ae), METAL = rgb(0x5b6672), BELT = rgb(0x717b87), ARROW = rgb(0xf0b429), EDGE = rgb(0x8d97a3), FLOOR = rgb(0xd9c9a3), DOOR = rgb(0x7f99b2);

const along = ([x, y], [dx, dy], far, aside = 0) => [x + far * dx - aside * dy, y + far * dy + aside * dx];

/** Adds the rims of a slab around outlines and holes. */
export function addRims(pile, rings) {
    for (const ring of rings) ring.forEach((a, i) => {
        const b = ring[(i + 1) % ring.length];
        pile.face([[a[0], a[1], -THICK], [b[0], b[1], -THICK], [b[0], b[1], 0], [a[0], a[1], 0]], EDGE, 0);
    });
}

/** Adds the steps, or the slope, of a flight, and returns its corners; `heightOf`: height of an elevation. */
function addFlight(pile, { kind, width, way }, { from, along: dir, run, low, slope }, heightOf) {
    const half = width / 2, z = heightOf(low), rise = heightOf(low + slope * run) - z, belt = kind === "escalator";
    const at = (far, aside, high) => [...along(from, dir, far, aside), high];
    if (kind === "ramp") pile.face([at(0, -half, z), at(run, -half, z + rise), at(run, half, z + rise), at(0, half, z)], STEPS, z);
    const count = kind === "ramp" ? 0 : Math.max(1, Math.round(Math.abs(rise) / RISER)), tread = run / count;
    for (let i = 0; i <= count && count > 0; i++) {
        const top = i === count ? z + rise : z + ((i + 0.5) * rise) / count, below = i === 0 ? z : z + ((i - 0.5) * rise) / count;
        pile.face([at(i * tread, half, below), at(i * tread, -half, below), at(i * tread, -half, top), at(i * tread, half, top)], belt ? tone(BELT, 0.7) : RISERS, z);
        if (i < count) pile.face([at(i * tread, -half, top), at((i + 1) * tread, -half, top), at((i + 1) * tread, half, top), at(i * tread, half, top)], belt ? BELT : STEPS, z);
    }
    for (const side of [-half, half]) { // strings, or an escalator's sides
        const [under, over] = belt ? [-0.15, 0.85] : [-0.2, 0.1];
        pile.face([at(0, side, z + under), at(run, side, z + rise + under), at(run, side, z + rise + over), at(0, side, z + over)], belt ? METAL : EDGE, z);
    }
    if (way !== "both") addArrows(pile, at, { run, z, rise, half, up: way === "up" });
    return [at(0, -half, z), at(run, -half, z + rise), at(run, half, z + rise), at(0, half, z)];
}

/** Adds chevrons that point the way that a flight is walked or runs. */
function addArrows(pile, at, { run, z, rise, half, up }) {
    const wide = 0.55 * half, long = (up ? 1 : -1) * wide, thick = (up ? -1 : 1) * 0.18, count = Math.max(1, Math.floor(run / 1.4));
    for (let i = 0; i < count; i++) {
        const middle = ((i + 0.5) * run) / count;
        const on = (far, aside) => at(far, aside, z + (rise * far) / run + 0.12);
        for (const side of [-1, 1]) {
            const [a, b] = [middle + long / 2, middle - long / 2];
            pile.face([on(a, 0), on(b, side * wide), on(b + thick, side * wide), on(a + thick, 0)], ARROW, z, 1);
        }
    }
}

/** Adds the level parts of a stair, what its flights leave of its path, and returns their corners. */
function addLandings(pile, stair, floor) {
    const { path, flights, width } = stair, half = width / 2, out = [];
    for (let i = 0; i + 1 < path.length; i++) {
        const a = path[i], b = path[i + 1], length = Math.hypot(b[0] - a[0], b[1] - a[1]), dir = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        const own = flights.map((f) => ({ at: (f.from[0] - a[0]) * dir[0] + (f.from[1] - a[1]) * dir[1], aside: (f.from[0] - a[0]) * dir[1] - (f.from[1] - a[1]) * dir[0], f }))
            .filter(({ at, aside, f }) => Math.abs(aside) < 0.01 && at > -0.01 && at < length && f.along[0] * dir[0] + f.along[1] * dir[1] > 0.99).sort((p, q) => p.at - q.at);
        let from = 0;
        for (const { at, f } of [...own, { at: length, f: { run: 0 } }]) {
            const begins = i > 0 && from === 0 ? -half : from, ends = at === length && i + 2 < path.length ? length + half : at;
            if (at - from > 0.01) {
                const z = floor(along(a, dir, (from + at) / 2)), corner = (far, aside) => [...along(a, dir, far, aside), z];
                out.push([corner(begins, -half), corner(ends, -half), corner(ends, half), corner(begins, half)]);
                pile.face(out.at(-1), STEPS, z);
            }
            from = at + f.run;
        }
    }
    return out;
}

/** Adds the handrails along both sides of a stair, from its foot to its head. */
function addRails(pile, { outline, kind }, floor) {
    const n = outline.length / 2, high = kind === "escalator" ? 0.9 : RAIL;
    for (const first of [0, n]) {
        for (let i = first; i < first + n - 1; i++) {
            const a = outline[i], b = outline[i + 1], length = Math.hypot(b[0] - a[0], b[1] - a[1]), dir = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
            const count = Math.max(1, Math.ceil(length / STRIDE));
            const points = Array.from({ length: count + 1 }, (_, k) => along(a, dir, (k * length) / count)).map((p) => [...p, floor(p)]);
            points.forEach((p, k) => {
                if (k > 0) pile.bar([points[k - 1][0], points[k - 1][1], points[k - 1][2] + high], [p[0], p[1], p[2] + high], 0.06, METAL);
                if (k % 3 === 0 && kind !== "escalator") pile.bar(p, [p[0], p[1], p[2] + high], 0.04, METAL);
            });
        }
    }
}

/** Adds a stair, and returns the corners of its flights and landings; `elevation`: of its floor at [x, y]; `heightOf`: height of an elevation. */
export function addStair(pile, stair, elevation, heightOf) {
    const floor = (p) => heightOf(elevation(p));
    addRails(pile, stair, floor);
    return [...stair.flights.map((flight) => addFlight(pile, stair, flight, heightOf)), ...addLandings(pile, stair, floor)];
}

/** Adds a slope of a storey: steps or a ramp without rails, as people may step on to it from its sides. */
export function addSlope(pile, stair, heightOf) {
    for (const flight of stair.flights) addFlight(pile, stair, flight, heightOf);
}

/** Adds the frame of a lift's shaft, `high` m, to a storey. */
export function addShaft(pile, { outline }, high) {
    outline.forEach((a, i) => {
        const b = outline[(i + 1) % outline.length];
        pile.bar([...a, 0], [...a, high], 0.07, METAL);
        pile.bar([...a, high], [...b, high], 0.06, METAL);
        pile.bar([...a, 0.03], [...b, 0.03], 0.06, METAL);
    });
}

/** The car of a lift. */
export function makeCar({ outline }) {
    const pile = new Pile(), ring = outline;
    pile.prism(ring, -0.12, 0.01, METAL, { top: FLOOR });
    ring.forEach((a, i) => {
        const b = ring[(i + 1) % ring.length];
        pile.bar([...a, 0], [...a, CAR], 0.05, FLOOR);
        pile.bar([...a, CAR], [...b, CAR], 0.08, FLOOR);
    });
    return pile;
}

/** A leaf of a lift's door, from one point to another. */
export function makeLeaf(a, b) {
    const pile = new Pile(), length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1, x = ((b[0] - a[0]) / length) * LEAF, y = ((b[1] - a[1]) / length) * LEAF;
    pile.prism([[a[0] + y, a[1] - x], [b[0] + y, b[1] - x], [b[0] - y, b[1] + x], [a[0] - y, a[1] + x]], 0, CAR, DOOR);
    return pile;
}
