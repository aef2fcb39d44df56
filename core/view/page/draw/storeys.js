// Storeys of a building and the stairs between them. The program has all of them side by side in one plane, as sheets; the
// picture has them above each other. This module alone knows both: it takes points of the plane to the plan and to a height, and
// back. A deck is a storey, or a stair between storeys: storeys from the lowest up, then the stairs. In a scene of one plane there is
// one deck, at height 0. Lengths in m; no part of three.js is needed.

/** How storeys are shown: at their heights, those above the chosen one cut off; spread, so that one looks between them; one alone. */
export const VIEWS = { stacked: "Stacked", exploded: "Exploded", one: "One storey" };

const SPREAD = 0.62; // of the depth of the floors: between two storeys that are exploded. Seen from 30 degrees above, neither covers the other
const NEAR = 0.02; // m: points this near to a line lie on it
const SLOPES = 12; // steps by which the point is found where a line meets a floor with slopes
const MANY = 8; // storeys: of more that are spread the picture holds those about the chosen one
const MOST_DEPTH = 200; // m: deeper floors are not spread further

const sub = (a, b) => [a[0] - b[0], a[1] - b[1]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
const clamp = (v, low, high) => Math.min(high, Math.max(low, v));

/** The distance of a point from a segment. */
function distanceTo(p, a, b) {
    const way = sub(b, a), from = sub(p, a), t = clamp(dot(from, way) / (dot(way, way) || 1), 0, 1);
    return Math.hypot(from[0] - t * way[0], from[1] - t * way[1]);
}

/** The distance of a point from a ring of points. */
function distanceToRing(p, ring) {
    return Math.min(...ring.map((a, i) => distanceTo(p, a, ring[(i + 1) % ring.length])));
}

/** Whether a point is inside a ring. */
export function isInside(ring, [x, y]) {
    let odd = false;
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
        const [xi, yi] = ring[i], [xj, yj] = ring[j];
        if (yi > y !== yj > y && x < xi + ((y - yi) / (yj - yi)) * (xj - xi)) odd = !odd;
    }
    return odd;
}

/** The convex hull of points, counter-clockwise. */
export function hullOf(points) {
    const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]), hull = [];
    const add = (p, least) => {
        const turns = () => {
            const [a, b] = hull.slice(-2);
            return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0;
        };
        while (hull.length > least && !turns()) hull.pop();
        hull.push(p);
    };
    for (const p of sorted) add(p, 1);
    const lower = hull.length;
    for (const p of sorted.reverse().slice(1)) add(p, lower);
    hull.pop();
    return hull;
}

/**
 * Cuts the floor within outlines, without holes, into quadrilaterals [[x, y] four times], of which some have two corners in one. Rings
 * may overlap in any way: a point is floor if it is in an outline and in no hole.
 */
export function cutFloor(outlines, holes) {
    const edges = [outlines, holes].flatMap((rings, hole) => rings.flatMap((ring, k) => ring.map((a, i) => {
        const b = ring[(i + 1) % ring.length];
        return { low: a[1] < b[1] ? a : b, high: a[1] < b[1] ? b : a, hole, ring: `${hole} ${k}` };
    }))).filter(({ low, high }) => high[1] - low[1] > 1e-9);
    const at = ({ low, high }, y) => low[0] + ((y - low[1]) / (high[1] - low[1])) * (high[0] - low[0]);
    const levels = edges.flatMap(({ low, high }) => [low[1], high[1]]);
    edges.forEach((a, i) => edges.slice(0, i).forEach((b) => { // where two cross
        const from = Math.max(a.low[1], b.low[1]), to = Math.min(a.high[1], b.high[1]);
        if (to - from < 1e-9) return;
        const first = at(a, from) - at(b, from), last = at(a, to) - at(b, to);
        if (first * last < 0) levels.push(from + ((to - from) * first) / (first - last));
    }));
    const rows = levels.sort((a, b) => a - b).filter((y, i) => i === 0 || y - levels[i - 1] > 1e-9), out = [];
    for (let i = 0; i + 1 < rows.length; i++) {
        const [y0, y1] = [rows[i], rows[i + 1]], middle = (y0 + y1) / 2;
        const met = edges.filter(({ low, high }) => low[1] < middle && high[1] > middle).sort((a, b) => at(a, middle) - at(b, middle));
        const inside = [new Set(), new Set()]; // outlines and holes that the row is in
        let begun = null;
        for (const edge of met) {
            const rings = inside[edge.hole];
            if (!rings.delete(edge.ring)) rings.add(edge.ring);
            const floor = inside[0].size > 0 && inside[1].size === 0;
            if (floor && !begun) begun = edge;
            if (floor || !begun) continue;
            out.push([[at(begun, y0), y0], [at(edge, y0), y0], [at(edge, y1), y1], [at(begun, y1), y1]]);
            begun = null;
        }
    }
    return out;
}

/** Whether walls that lie on a ring alone, which is drawn in another way. */
function liesOn(points, ring) {
    return points.every((p) => distanceToRing(p, ring) < NEAR);
}

export class Storeys {
    /** `given`: the member "storeys" of a scene message, with its "lifts"; null for one plane. */
    constructor(given = null) {
        this.several = given !== null;
        this.pitch = given?.pitch ?? 0;
        this.origin = given?.origin ?? 0;
        this.list = given?.list ?? [{ name: "", height: 0 }];
        this.lifts = given?.lifts ?? [];
        const deckOf = (name, lower, upper, sheet, stair, slopes) => ({ name, height: this.list[lower].height, lower, upper, sheet, stair, slopes, flights: (stair ? [stair] : slopes).flatMap(({ flights }) => flights) });
        this.decks = [...this.list.map(({ name }, k) => deckOf(name, k, k, k, null, (given?.stairs ?? []).filter((s) => s.lower === k && s.upper === k))),
            ...(given?.stairs ?? []).map((stair) => deckOf(stair.name, stair.lower, stair.upper, stair.sheet, stair, []))];
        this.view = given ? "exploded" : "stacked";
        this.chosen = this.list.length - 1;
        this.top = false; // whether the eye looks straight down
        this.outlines = this.list.map(() => []); // rings of the floors in plan, as `measure` finds them
        this.size = 0; // m: depth of the floors
        this.arrange();
    }

    get count() {
        return this.list.length;
    }

    /** Whether a number is that of a storey, not of a stair. */
    isStorey(deck) {
        return deck < this.count;
    }

    // ---- from the plane to the plan and back ----

    /** The deck of a position of the plane. */
    deckAt([x, y]) {
        if (!this.several) return 0;
        const sheet = clamp(Math.floor((y - this.origin) / this.pitch), 0, Math.max(...this.decks.map((deck) => deck.sheet)));
        if (sheet < this.count) return sheet;
        const plan = [x, y - sheet * this.pitch], away = (deck) => (isInside(deck.stair.outline, plan) ? 0 : distanceToRing(plan, deck.stair.outline));
        const there = this.decks.filter((deck) => deck.stair && deck.sheet === sheet && deck.lower !== deck.upper);
        return this.decks.indexOf(there.reduce((best, deck) => (away(deck) < away(best) ? deck : best)));
    }

    /** [x, y] in plan of a position on a deck, and the position of a point in plan. */
    toPlan(deck, [x, y]) {
        return [x, y - this.decks[deck].sheet * this.pitch];
    }

    toPlane(deck, [x, y]) {
        return [x, y + this.decks[deck].sheet * this.pitch];
    }

    /** Elevation of the floor of a deck at a point in plan: at the nearest point of a flight. So rows of seats rise with the aisles between them. */
    elevation(deck, p) {
        const { flights, height } = this.decks[deck];
        if (!this.several) return 0;
        let best = height, least = Infinity;
        for (const { from, along, run, low, slope } of flights) {
            const far = clamp(dot(sub(p, from), along), 0, run), away = Math.hypot(p[0] - from[0] - far * along[0], p[1] - from[1] - far * along[1]);
            if (away < least) [least, best] = [away, low + slope * far];
        }
        return best;
    }

    /** A scene message with everything in plan, and with the deck of each wall, place, area and thing. Walls of stairs and shafts are left out. */
    unfold(scene) {
        const unfolded = ({ points = [], ...rest }) => {
            const deck = points.length ? this.deckAt(points[0]) : 0;
            return { ...rest, deck, points: points.map((p) => [...this.toPlan(deck, p), ...p.slice(2)]) };
        };
        const areas = Object.entries(scene.regions ?? {}).map(([name, points]) => unfolded({ name, points }));
        const walls = (scene.walls ?? []).map(unfolded);
        return { ...scene, walls: walls.filter((wall) => !this.isDrawnOtherwise(wall)), places: (scene.places ?? []).map(unfolded), areas, scenery: (scene.scenery ?? []).flatMap((item) => this.unfoldItem(item)) };
    }

    /** A thing of the scenery on its deck; one whose copies stand on several, as one on each. What a body carries has no deck. */
    unfoldItem(item) {
        if (item.body || !this.several) return [{ ...item, deck: 0 }];
        if (item.through?.length) {
            const deck = this.deckAt(item.through[0]);
            return [{ ...item, deck, through: item.through.map((p) => this.toPlan(deck, p)) }];
        }
        const decks = (item.at ?? []).map((p) => this.deckAt(p));
        return [...new Set(decks)].map((deck) => {
            const kept = (list) => list.filter((_, i) => decks[i] === deck);
            return { ...item, deck, at: kept(item.at).map((p) => this.toPlan(deck, p)), turns: kept(item.turns ?? []) };
        });
    }

    /** Whether a wall is one that the program puts around a stair or a shaft, or the door of a lift, which are drawn with these. */
    isDrawnOtherwise({ deck, name, solid, points }) {
        if (!this.several || solid) return false;
        if (name) return this.lifts.some(({ stops }) => stops.some(({ wall }) => wall === name));
        const { stair } = this.decks[deck];
        if (stair) return liesOn(points, stair.outline);
        return this.decks.some((d) => d.stair && d.lower === deck && d.lower < d.upper && liesOn(points, d.stair.outline))
            || this.lifts.some((lift) => liesOn(points, lift.outline));
    }

    /** Finds the floors' outlines and depth, of an unfolded scene. */
    measure(scene) {
        if (!this.several) return;
        this.outlines = this.list.map((_, k) => {
            const walls = scene.walls.filter((wall) => wall.deck === k && wall.points.length > 1), rims = walls.filter((wall) => wall.outline);
            if (rims.length) return rims.map((wall) => wall.points);
            const near = [...this.stairsAt(k).map((d) => d.stair.outline), ...this.lifts.map((lift) => lift.outline)];
            const corners = walls.flatMap((wall) => wall.points), points = corners.length > 2 ? corners : [...scene.places.filter((p) => p.deck === k).flatMap((p) => p.points), ...near.flat()];
            const hull = hullOf(points.map((p) => p.slice(0, 2)));
            return hull.length > 2 ? [hull] : [];
        });
        const all = this.outlines.flat(2), span = (axis) => Math.max(...all.map((p) => p[axis])) - Math.min(...all.map((p) => p[axis]));
        this.size = all.length ? Math.min(MOST_DEPTH, Math.min(span(0), span(1))) : 0;
        this.arrange();
    }

    /** Decks of the stairs that begin, end or pass on a storey. */
    stairsAt(storey) {
        return this.decks.filter((deck) => deck.stair && deck.lower < deck.upper && deck.lower <= storey && storey <= deck.upper);
    }

    /** Rings of the holes in the floor of a storey: over stairs that come from below, and shafts. */
    holes(storey) {
        const shafts = this.lifts.filter(({ stops }) => stops[0].storey < storey && storey <= stops.at(-1).storey);
        return [...this.stairsAt(storey).filter((deck) => deck.lower < storey).map((deck) => deck.stair.outline), ...shafts.map((lift) => lift.outline)];
    }

    // ---- how they are shown ----

    /** Computes where decks are drawn; called when anything of the view has changed. */
    arrange() {
        const heights = this.list.map((storey) => storey.height), spread = SPREAD * this.size;
        this.at = heights.map(() => heights[0]);
        for (let k = 1; k < heights.length; k++) {
            const rise = heights[k] - heights[k - 1];
            this.at[k] = this.at[k - 1] + (this.view === "exploded" ? Math.max(rise, spread) : rise);
        }
        this.drawnDecks = this.decks.map(({ lower, upper, height, stair }) => {
            const rise = this.list[upper].height - height, drawn = this.at[upper] - this.at[lower];
            return { z: this.at[lower], scale: stair && rise > 0 ? drawn / rise : 1, shown: this.isShown(lower, upper) };
        });
    }

    /** Whether what stands on a storey, or leads from one to another, is shown. */
    isShown(lower, upper = lower) {
        if (this.view === "one") return lower <= this.chosen && this.chosen <= upper;
        return this.view === "stacked" || this.top ? lower <= this.chosen : true;
    }

    /** Height in the picture of an elevation on a deck; and of one anywhere, as of a lift. */
    drawn(deck, elevation) {
        const { z, scale } = this.drawnDecks[deck];
        return z + scale * (elevation - this.decks[deck].height);
    }

    drawnBetween(elevation) {
        const k = clamp(this.list.findLastIndex((storey) => storey.height <= elevation), 0, Math.max(0, this.count - 2));
        const [low, high] = [this.list[k], this.list[k + 1] ?? this.list[k]], rise = high.height - low.height;
        return this.at[k] + (rise > 0 ? ((elevation - low.height) / rise) * (this.at[k + 1] - this.at[k]) : elevation - low.height);
    }

    /** Height in the picture of the floor at a point in plan. */
    heightAt(deck, p) {
        return this.several ? this.drawn(deck, this.elevation(deck, p)) : 0;
    }

    /** The storey nearest to an elevation. */
    nearestStorey(elevation) {
        return this.list.reduce((best, { height }, k) => (Math.abs(height - elevation) < Math.abs(this.list[best].height - elevation) ? k : best), 0);
    }

    /** Gives a frame the heights in the picture of its people, by slot: NaN of those who are not shown. In one plane there are none. */
    lift(frame) {
        if (!this.several || !frame.stands) return;
        const { stands, slots, z0, sz, x0, y0, sx, sy, words } = frame, floors = (frame.floors ??= new Float32Array(slots)), { decks, drawnDecks, at } = this;
        const base = decks.map(({ height }, k) => (drawnDecks[k].shown ? drawnDecks[k].z - drawnDecks[k].scale * height : NaN));
        for (let slot = 0; slot < slots; slot++) {
            const deck = stands[2 * slot], height = z0 + sz * stands[2 * slot + 1];
            floors[slot] = base[deck] + drawnDecks[deck].scale * height;
            if (deck >= at.length || !drawnDecks[deck].shown) continue;
            if (decks[deck].flights.length > 0) floors[slot] = this.heightAt(deck, [x0 + sx * words[4 * slot], y0 + sy * words[4 * slot + 1]]);
            else if (Math.abs(height - decks[deck].height) > 0.05) floors[slot] = this.drawnBetween(height); // rides in a lift
        }
    }

    /** Whether the picture of all has to hold a storey: of many that are spread, those near the chosen one. */
    isFramed(k) {
        return this.isShown(k) && (this.view !== "exploded" || this.count <= MANY || Math.abs(k - this.chosen) <= MANY / 2 - 1);
    }

    /** Least and greatest height in the picture of the storeys that it has to hold. */
    range() {
        const shown = this.at.filter((_, k) => this.isFramed(k));
        return [Math.min(...shown), Math.max(...shown)];
    }

    /** The corners of the floors that the picture has to hold, and of what is `tall` m high on them: [x, y, z]. */
    corners(tall) {
        return this.at.flatMap((z, k) => (this.isFramed(k) ? this.outlines[k].flat().flatMap(([x, y]) => [[x, y, z], [x, y, z + tall]]) : []));
    }

    /** The lowest storey that is shown: the ground about the building is at its height. */
    ground() {
        return this.at.findIndex((_, k) => this.isShown(k));
    }

    /** Whether a storey has floor at a point in plan: the ground has it everywhere. */
    hasFloor(storey, p) {
        if (this.holes(storey).some((ring) => isInside(ring, p))) return false;
        return storey === this.ground() || this.outlines[storey].some((ring) => isInside(ring, p));
    }

    /**
     * The floor that is shown where a line from `origin` along `way`, [x, y, z], first meets one: {deck, at: [x, y] in plan, z}; null if
     * it meets none.
     */
    hit(origin, way) {
        let best = null;
        const meet = (deck, t) => {
            if (!(t > 0) || (best && t >= best.t)) return;
            const at = [origin[0] + t * way[0], origin[1] + t * way[1]];
            if (this.isStorey(deck) ? this.hasFloor(deck, at) : isInside(this.decks[deck].stair.outline, at)) best = { deck, at, z: origin[2] + t * way[2], t };
        };
        this.decks.forEach(({ stair, lower, upper }, deck) => {
            const { scale, shown } = this.drawnDecks[deck];
            if (!shown || (stair && lower === upper)) return;
            if (!stair) return meet(deck, this.meetFloor(deck, origin, way));
            for (const { from, along, run, low, slope } of stair.flights) { // the plane of each flight, and the level ones at its ends
                const k = scale * slope, base = this.drawn(deck, low) - k * dot(from, along), t = (k * dot(origin, along) + base - origin[2]) / (way[2] - k * dot(way, along));
                const far = dot(sub([origin[0] + t * way[0], origin[1] + t * way[1]], from), along);
                if (far >= 0 && far <= run) meet(deck, t);
                for (const height of [low, low + slope * run]) {
                    const level = (this.drawn(deck, height) - origin[2]) / way[2], p = [origin[0] + level * way[0], origin[1] + level * way[1]];
                    if (Math.abs(this.elevation(deck, p) - height) < 0.05) meet(deck, level);
                }
            }
            return undefined;
        });
        return best && { deck: best.deck, at: best.at, z: best.z };
    }

    /** How far along a line it meets the floor of a storey, which slopes may raise. */
    meetFloor(storey, origin, way) {
        let t = (this.at[storey] - origin[2]) / way[2];
        for (let i = 0; i < SLOPES && this.decks[storey].flights.length > 0 && Number.isFinite(t); i++) t = (this.heightAt(storey, [origin[0] + t * way[0], origin[1] + t * way[1]]) - origin[2]) / way[2];
        return t;
    }

    /** Whether the floor of a storey is between two points [x, y, z]. */
    hides(a, b) {
        return this.several && this.at.some((_, k) => {
            const t = this.meetFloor(k, a, b.map((v, axis) => v - a[axis]));
            return this.isShown(k) && t > 1e-3 && t < 1 - 1e-3 && this.hasFloor(k, [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
        });
    }
}
