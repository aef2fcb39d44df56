// Chooses the level of detail of everybody in sight, in the order of their distance from the eye. One pass over
// all slots a picture; the rest is the graphics card's.
import { NOBODY } from "../../net/crowd.js";

export const BAND = 0.06; // share of a level's reach over which it fades into the next one
const RINGS = 256; // of equal width, of the histogram of distances
const MIDDLE = 0.9; // m, height of a person's middle
const AROUND = 1.2; // m around it that may be drawn
const MARGIN = 1; // m that people may be nearer or farther in the picture than in the newest frame
const SETTLE = 0.25; // share of the way to its new value that a reach goes each picture, when it grows

/**
 * Elevations, from 0 to `count` - 1 and `rise` rad apart, from which people are seen whose middles are `above` m below the eye and from
 * `near` to `far` m away.
 */
export function elevationsSeen([above, near, far], rise, count) {
    const of = (away) => Math.min(count - 1, Math.max(0, Math.floor(Math.asin(Math.min(1, Math.max(0, above / away))) / rise + 0.5)));
    const [low, high] = [of(far), of(near)];
    return Array.from({ length: high - low + 1 }, (_, i) => low + i);
}

export class Levels {
    /** `pixels`: least height of people on the screen in each mesh level; `most`: people in each, at most. */
    constructor(pixels, most) {
        this.pixels = pixels;
        this.most = most;
        this.reach = pixels.map(() => 0); // m: up to where each level is drawn
        this.lists = [...pixels, 0, 0].map(() => new Uint32Array(0)); // of each level; of the sprites; of all meshes
        this.counts = this.lists.map(() => 0);
        this.rings = new Uint32Array(RINGS);
        this.seen = new Uint32Array(0);
        this.away = new Float32Array(0);
    }

    grow(slots) {
        this.seen = new Uint32Array(slots);
        this.away = new Float32Array(slots);
        this.lists = this.lists.map(() => new Uint32Array(slots));
    }

    /**
     * Fills `lists` and `counts`, of the levels and last of the sprites. `matrix`: clip coordinates of the world, by columns;
     * `from`: {x, y, z} that distances are from; `metre`: pixels of a metre at 1 m, or everywhere (`flat`).
     */
    choose(frame, matrix, from, metre, flat) {
        const furthest = this.pixels.map((least) => (1.7 * metre) / least);
        // From above all are as tall on the screen: then distance orders them only.
        const whole = furthest.map((far) => (flat ? (far >= 1 ? Infinity : 0) : far));
        const count = this.collect(frame, matrix, from, flat), far = this.spread(count, Math.max(1, ...whole.filter(Number.isFinite), flat ? 400 : 1));
        let sum = 0, ring = 0;
        this.reach = whole.map((most, level) => {
            sum = 0;
            const begin = ring;
            while (ring < RINGS && sum + this.rings[ring] <= this.most[level]) sum += this.rings[ring++];
            const wanted = Math.min(most, ring === RINGS ? Infinity : (ring / RINGS) * far), now = this.reach[level];
            if (begin === ring && ring < RINGS) return Math.min(now, wanted);
            return wanted > now && now > 0 && Number.isFinite(wanted) ? now + SETTLE * (wanted - now) : wanted;
        });
        for (let level = 1; level < this.reach.length; level++) this.reach[level] = Math.max(this.reach[level], this.reach[level - 1]);
        this.count = count;
        this.deal(count);
    }

    /** Notes who is in sight, and how far away; returns how many. */
    collect(frame, m, from, flat) {
        const { words, bytes, x0, y0, sx, sy, slots, floors } = frame, { seen, away } = this;
        const level = flat ? 0 : MIDDLE - from.z;
        const ox = m[8] * MIDDLE + m[12], oy = m[9] * MIDDLE + m[13], ow = m[11] * MIDDLE + m[15];
        const edgeX = AROUND * Math.hypot(m[0], m[4], m[8]), edgeY = AROUND * Math.hypot(m[1], m[5], m[9]);
        let count = 0;
        for (let slot = 0, w = 0; slot < slots; slot++, w += 4) {
            if (bytes[2 * w + 5] === NOBODY) continue;
            const x = x0 + sx * words[w], y = y0 + sy * words[w + 1];
            let cw = m[3] * x + m[7] * y + ow, cx = m[0] * x + m[4] * y + ox, cy = m[1] * x + m[5] * y + oy, dz = level;
            if (floors) {
                const z = floors[slot];
                if (z !== z) continue; // on a storey that is not shown
                cw += m[11] * z;
                cx += m[8] * z;
                cy += m[9] * z;
                dz += flat ? 0 : z;
            }
            if (cw < -AROUND || cx > cw + edgeX || -cx > cw + edgeX || cy > cw + edgeY || -cy > cw + edgeY) continue;
            const dx = x - from.x, dy = y - from.y;
            seen[count] = slot;
            away[count++] = Math.sqrt(dx * dx + dy * dy + dz * dz);
        }
        return count;
    }

    /** Height of an eye at `from` above the middles of people, and how far away the nearest and the farthest in sight are, m. */
    range(from) {
        const { count, away } = this, above = from.z - MIDDLE;
        let near = Infinity, far = 0;
        for (let i = 0; i < count; i++) {
            if (away[i] < near) near = away[i];
            if (away[i] > far) far = away[i];
        }
        return [above, Math.max(0.1, near - MARGIN), far + MARGIN];
    }

    /** Counts who is in each ring up to `far` m; returns `far`. */
    spread(count, far) {
        const rings = this.rings.fill(0), per = RINGS / far, { away } = this;
        for (let i = 0; i < count; i++) {
            const ring = (away[i] * per) | 0;
            if (ring < RINGS) rings[ring]++;
        }
        return far;
    }

    /** Puts everybody into the list of their level; who is between two levels is in both. */
    deal(count) {
        const { seen, away, lists } = this, [a, b, c] = this.reach, fade = 1 - BAND - 0.02;
        const [l0, l1, l2, l3, l4] = lists, fa = fade * a, fb = fade * b, fc = fade * c;
        let n0 = 0, n1 = 0, n2 = 0, n3 = 0, n4 = 0;
        for (let i = 0; i < count; i++) {
            const slot = seen[i], d = away[i] - 0.3, e = away[i] + 0.3; // m: they walk until the next frame
            if (d < a) l0[n0++] = slot;
            if (e >= fa && d < b) l1[n1++] = slot;
            if (e >= fb && d < c) l2[n2++] = slot;
            if (d < c) l4[n4++] = slot;
            if (e >= fc) l3[n3++] = slot;
        }
        this.counts = [n0, n1, n2, n3, n4];
    }
}
