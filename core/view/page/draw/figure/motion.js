// How people move between frames, a slot each: phase and gait of their steps, and where they walk to beside where
// their chest points. Phases grow by the way that was walked, so that feet stay where they meet the floor.
import { NOBODY } from "../../net/crowd.js";
import { cyclesPerMetre, GAIT_COUNT, gaitOf } from "./poses.js";

export const STRIDE = 8; // bytes of a slot: phase, gait, way and chest, each of the previous frame and of the next
const SETTLE = 0.25; // s, time constant of the averaged velocity
const BREATH = 6; // s of the cycle of one who stands
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
    }

    grow(slots) {
        const kept = { vx: this.vx, vy: this.vy, phase: this.phase };
        for (const name of ["vx", "vy", "phase"]) {
            this[name] = new Float32Array(slots);
            if (kept[name]) this[name].set(kept[name].subarray(0, slots));
            else if (name === "phase") for (let s = 0; s < slots; s++) this.phase[s] = (Math.imul(s + 1, 0x9e3779b1) >>> 16) / 65536;
        }
        const bytes = new Uint8Array(STRIDE * slots);
        bytes.set(this.bytes.subarray(0, Math.min(bytes.length, this.bytes.length)));
        this.bytes = bytes;
        this.slots = slots;
    }

    /** Takes the step from frame `a` to frame `b`; `jumped`: what lies between them was not seen. */
    take(a, b, jumped) {
        const passed = b.time - a.time, seen = passed > 1e-6 && !jumped, { vx, vy, phase, bytes } = this;
        const kept = seen ? Math.exp(-passed / SETTLE) : 1, known = Math.min(a.slots, b.slots);
        const breath = seen ? passed / BREATH : 0;
        for (let slot = 0, w = 0; slot < b.slots; slot++, w += 4) {
            const at = 2 * w, to = STRIDE * slot;
            if (b.bytes[at + 5] === NOBODY) continue;
            const same = slot < known && a.bytes[at + 5] !== NOBODY && ((a.bytes[at + 7] ^ b.bytes[at + 7]) & 1) === 0;
            const chest = b.chests ? b.chests[slot] : b.bytes[at + 4];
            let moved = 0, walked = 0;
            if (same && seen) {
                const dx = b.x0 + b.sx * b.words[w] - a.x0 - a.sx * a.words[w], dy = b.y0 + b.sy * b.words[w + 1] - a.y0 - a.sy * a.words[w + 1];
                moved = Math.sqrt(dx * dx + dy * dy);
                if (moved > FASTEST * passed) moved = 0;
                else {
                    vx[slot] = kept * vx[slot] + ((1 - kept) * dx) / passed;
                    vy[slot] = kept * vy[slot] + ((1 - kept) * dy) / passed;
                }
            } else if (!same && !jumped) vx[slot] = vy[slot] = 0;
            const speed = Math.sqrt(vx[slot] * vx[slot] + vy[slot] * vy[slot]), k = Math.min(SPEEDS - 1, (32 * speed) | 0);
            let way = speed > 0.08 ? turnsOf(vx[slot], vy[slot]) - chest : 0;
            if (way > 128) way -= 256;
            else if (way < -128) way += 256;
            walked = moved * cycles[k];
            if (way > 72 || way < -72) { // backwards: the steps run back
                way += way > 0 ? -128 : 128;
                walked = -walked;
            }
            const before = phase[slot], next = before + walked + breath * Math.max(0, 1 - 4 * speed);
            phase[slot] = next - Math.floor(next);
            bytes[to] = 256 * before;
            bytes[to + 1] = 256 * phase[slot];
            bytes[to + 2] = same ? bytes[to + 3] : gaits[k];
            bytes[to + 3] = gaits[k];
            bytes[to + 4] = same ? bytes[to + 5] : way;
            bytes[to + 5] = Math.max(-44, Math.min(44, way));
            bytes[to + 6] = same ? bytes[to + 7] : chest;
            bytes[to + 7] = chest;
        }
    }
}
