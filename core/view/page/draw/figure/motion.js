// How people move between frames, a slot each: phase and gait of their steps, and where they walk to beside where
// their chest points. Phases grow by the way that was walked, so that feet stay where they meet the floor. Who lies has
// a height in the place of the gait.
import { NOBODY } from "../../net/crowd.js";
import { Piles } from "./piles.js";
import { cyclesPerMetre, GAIT_COUNT, gaitOf } from "./poses.js";

export const STRIDE = 8; // bytes of a slot: phase, gait or height, way and chest, each of the previous frame and of the next
const SETTLE = 0.25; // s, time constant of the averaged velocity
const BREATH = 6; // s of the cycle of one who stands
const LIES = 31; // flags of a record by 8, of one who has fallen
const FASTEST = 12; // m/s: faster is a jump
export const GAIT_STEPS = Math.floor(255 / (GAIT_COUNT - 1)); // of a byte between two gaits

// Gait and cycles a metre by speed, in steps of 1/32 m/s.
const SPEEDS = 256, gaits = new Uint8Array(SPEEDS), cycles = new Float32Array(SPEEDS);
for (let k = 0; k < SPEEDS; k++) {
    gaits[k] = Math.round(GAIT_STEPS * gaitOf(k / 32));
    cycles[k] = cyclesPerMetre(gaitOf(k / 32));
}

/** The angle of a direction in 256ths of a turn, -128 to 128, by a polynomial: off by less than 0.1 of them. */
function turnsOf(x, y) {
    const across = Math.abs(x), up = Math.abs(y), t = across > up ? up / across : across / Math.max(up, 1e-9);
    const eighth = t * (32 + (1 - t) * (9.98 + 2.7 * t)), quarter = up > across ? 64 - eighth : eighth, half = x < 0 ? 128 - quarter : quarter;
    return y < 0 ? -half : half;
}

export class Motion {
    constructor() {
        this.slots = 0;
        this.bytes = new Uint8Array(0);
        this.piles = new Piles();
    }

    grow(slots) {
        const kept = { vx: this.vx, vy: this.vy, phase: this.phase };
        for (const name of ["vx", "vy", "phase"]) {
            this[name] = new Float32Array(slots);
            if (kept[name]) this[name].set(kept[name].subarray(0, slots));
            else if (name === "phase") for (let s = 0; s < slots; s++) this.phase[s] = (Math.imul(s + 1, 0x9e3779b1) >>> 16) / 65536;
        }
        const heights = new Uint8Array(slots);
        heights.set((this.heights ?? heights).subarray(0, slots));
        this.heights = heights;
        const bytes = new Uint8Array(STRIDE * slots);
        bytes.set(this.bytes.subarray(0, Math.min(bytes.length, this.bytes.length)));
        this.bytes = bytes;
        this.packed = new Uint32Array(bytes.buffer);
        this.slots = slots;
    }

    /** Takes the step from frame `a` to frame `b`; `jumped`: what lies between them was not seen. */
    take(a, b, jumped) {
        const passed = b.time - a.time, seen = passed > 1e-6 && !jumped, { vx, vy, phase, packed } = this;
        const kept = seen ? Math.exp(-passed / SETTLE) : 1, gain = seen ? (1 - kept) / passed : 0, known = Math.min(a.slots, b.slots);
        const breath = seen ? passed / BREATH : 0, furthest = (FASTEST * passed) ** 2;
        const { words, slots, chests } = b, now = new Uint32Array(b.words.buffer, b.words.byteOffset, 2 * slots);
        const { words: words0 } = a, before = new Uint32Array(a.words.buffer, a.words.byteOffset, 2 * a.slots);
        const { sx, sy } = b, sx0 = a.sx, sy0 = a.sy, ox = b.x0 - a.x0, oy = b.y0 - a.y0;
        const lying = [];
        for (let slot = 0, k = 0; slot < slots; slot++, k += 2) {
            const info = now[k + 1]; // heading, state, value, flags
            if (((info >> 8) & 255) === NOBODY) continue;
            if (info >>> 27 === LIES) lying.push(slot);
            const was = slot < known ? before[k + 1] : NOBODY << 8;
            const same = ((was >> 8) & 255) !== NOBODY && ((was ^ info) & (1 << 24)) === 0;
            const chest = chests ? chests[slot] : info & 255;
            let x = vx[slot], y = vy[slot], moved = 0;
            if (same && seen) {
                const dx = ox + sx * words[2 * k] - sx0 * words0[2 * k], dy = oy + sy * words[2 * k + 1] - sy0 * words0[2 * k + 1], d = dx * dx + dy * dy;
                if (d < furthest) {
                    moved = Math.sqrt(d);
                    vx[slot] = x = kept * x + gain * dx;
                    vy[slot] = y = kept * y + gain * dy;
                }
            } else if (!same && !jumped) vx[slot] = vy[slot] = x = y = 0;
            const speed = Math.sqrt(x * x + y * y), step = Math.min(SPEEDS - 1, (32 * speed) | 0), gait = gaits[step];
            let way = 0;
            if (speed > 0.08) {
                way = turnsOf(x, y) - chest;
                if (way < -128) way += 256;
                if (way > 72 || way < -72) { // backwards: the steps run back
                    way += way > 0 ? -128 : 128;
                    moved = -moved;
                }
                way = Math.max(-44, Math.min(44, way));
            }
            const from = phase[slot];
            let to = from + moved * cycles[step];
            if (speed < 0.25) to += breath * (1 - 4 * speed);
            to -= Math.floor(to);
            phase[slot] = to;
            const steps = packed[k], turns = packed[k + 1];
            packed[k] = ((256 * from) & 255) | (((256 * to) & 255) << 8) | (same ? (steps >>> 24) << 16 : gait << 16) | (gait << 24);
            packed[k + 1] = (same ? (turns >>> 8) & 255 : way & 255) | ((way & 255) << 8) | (same ? (turns >>> 24) << 16 : chest << 16) | (chest << 24);
        }
        if (lying.length > 0 || this.piles.turns.size > 0) this.stack(lying, b, known, before);
    }

    /** Writes how high they lie, in frame `b`; `before`: the words of frame `a`, of `known` slots. */
    stack(lying, b, known, before) {
        const { words, bytes, x0, y0, sx, sy, stands } = b, at = new Float64Array(3 * lying.length), apart = 10 + 65536 * sy;
        // Those of one deck lie on each other.
        lying.forEach((slot, i) => at.set([x0 + sx * words[4 * slot], y0 + sy * words[4 * slot + 1] + (stands ? apart * stands[2 * slot] : 0), bytes[8 * slot + 4]], 3 * i));
        this.piles.stack(lying, at).forEach((height, i) => {
            const slot = lying[i], lay = slot < known && before[2 * slot + 1] >>> 27 === LIES;
            this.bytes[STRIDE * slot + 2] = lay ? this.heights[slot] : height;
            this.bytes[STRIDE * slot + 3] = this.heights[slot] = height;
        });
    }
}
