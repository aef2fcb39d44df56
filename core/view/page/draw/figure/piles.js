// How high people lie who have fallen over others: each lies on those who fell before and are beneath. Heights are
// drawn only, as bodies would cut through each other; the simulation has one floor.
export const STEP = 0.02; // m of height that a unit of a byte stands for
const DEEP = 0.18; // m, of one who lies
const MOST = 4; // people above each other
const NEAR = 0.36; // m between the axes of two who touch
const ALONG = [-0.55, 0, 0.55]; // m from the middle towards the head: spots of a body
const BUCKETS = 4096, CELL = 2; // m

export class Piles {
    constructor() {
        this.turns = new Map(); // of a slot: when it fell, counted
        this.next = 0;
    }

    /** Heights in STEPs of those who lie, in their order. `slots`: who; `at`: x, y (m) and heading (256ths of a turn) of each. */
    stack(slots, at) {
        const heights = new Uint8Array(slots.length), lying = new Set(slots);
        for (const slot of this.turns.keys()) if (!lying.has(slot)) this.turns.delete(slot);
        for (const slot of slots) if (!this.turns.has(slot)) this.turns.set(slot, this.next++);
        if (slots.length < 2) return heights;
        const order = slots.map((slot, i) => i).sort((a, b) => this.turns.get(slots[a]) - this.turns.get(slots[b]));
        const cells = new Map(), levels = new Uint8Array(slots.length), spots = new Float64Array(2 * ALONG.length * slots.length);
        const cellOf = (x, y) => (Math.imul(Math.floor(x / CELL), 73856093) ^ Math.imul(Math.floor(y / CELL), 19349663)) & (BUCKETS - 1);
        for (const i of order) {
            const x = at[3 * i], y = at[3 * i + 1], turn = (at[3 * i + 2] * Math.PI) / 128, first = 2 * ALONG.length * i;
            ALONG.forEach((along, k) => {
                spots[first + 2 * k] = x + along * Math.cos(turn);
                spots[first + 2 * k + 1] = y + along * Math.sin(turn);
            });
            let level = 0;
            for (const [dx, dy] of AROUND) for (const other of cells.get(cellOf(x + dx, y + dy)) ?? []) {
                if (levels[other] >= level && touch(spots, first, 2 * ALONG.length * other)) level = levels[other] + 1;
            }
            levels[i] = Math.min(level, MOST - 1);
            heights[i] = Math.round((levels[i] * DEEP) / STEP);
            const key = cellOf(x, y);
            if (cells.has(key)) cells.get(key).push(i);
            else cells.set(key, [i]);
        }
        return heights;
    }
}

const AROUND = [-CELL, 0, CELL].flatMap((dx) => [-CELL, 0, CELL].map((dy) => [dx, dy]));

/** Whether two bodies, by the places of their first spots, touch. */
function touch(spots, a, b) {
    for (let i = a; i < a + 2 * ALONG.length; i += 2) for (let j = b; j < b + 2 * ALONG.length; j += 2) {
        if ((spots[i] - spots[j]) ** 2 + (spots[i + 1] - spots[j + 1]) ** 2 < NEAR * NEAR) return true;
    }
    return false;
}
