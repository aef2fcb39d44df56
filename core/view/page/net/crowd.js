// The last two frames as received, and access to their positions, states and bodies.

const HEADER = 48; // bytes of a frame before its slots
const BODY = 20, CAR = 8;
const HEIGHTS = 8; // bytes of the range of heights, behind the bodies of frames with storeys
const GONE = -500; // m: bodies lower than this are not there
const STAND = 4, CHEST = 1; // bits of the bytes of a slot behind the bodies
export const PERSON = 4; // bytes of a slot in Crowd.person
export const NOBODY = 255;
export const FLAG = { parity: 1, failed: 2, player: 4 }; // higher bits: lean under pushes, or lying

/** Reads a frame's header; its slots stay where they are in the buffer. Lengths in m. */
export function readFrame(buffer) {
    const view = new DataView(buffer);
    const slots = view.getUint32(16, true), bodies = view.getUint32(20, true), more = view.getUint32(44, true);
    const end = HEADER + 8 * slots + BODY * bodies, storeys = more & STAND ? readStands(buffer, view, end, slots) : null, last = storeys?.end ?? end;
    if (buffer.byteLength < last + (more & CHEST) * slots) throw new Error("a frame that is cut short");
    return {
        ...storeys, floors: null,
        tick: view.getUint32(4, true), time: view.getFloat64(8, true), slots, bodies,
        x0: view.getFloat32(24, true), y0: view.getFloat32(28, true),
        sx: view.getFloat32(32, true), sy: view.getFloat32(36, true),
        most: view.getFloat32(40, true),
        bytes: new Uint8Array(buffer, HEADER, 8 * slots),
        words: new Uint16Array(buffer, HEADER, 4 * slots),
        poses: new DataView(buffer, HEADER + 8 * slots, BODY * bodies),
        chests: more & CHEST ? new Uint8Array(buffer, last, slots) : null, // 256ths of a turn; null: all are discs
        cars: readCars(new DataView(buffer, last + (more & CHEST) * slots)),
    };
}

/** Reads what frames with storeys have behind the bodies: deck and height of each slot, m from z0 by steps of sz. */
function readStands(buffer, view, end, slots) {
    const first = end + HEIGHTS;
    if (buffer.byteLength < first + STAND * slots) throw new Error("a frame that is cut short");
    return { z0: view.getFloat32(end, true), sz: view.getFloat32(end + 4, true), stands: new Uint16Array(buffer, first, 2 * slots), end: first + STAND * slots };
}

/** Reads the cars of lifts, in the order of the scene message. */
function readCars(view) {
    return Array.from({ length: Math.floor(view.byteLength / CAR) }, (_, lift) => {
        const at = CAR * lift;
        return {
            height: view.getFloat32(at, true), // m
            open: view.getUint8(at + 4) / 255, // share of the door
            stop: view.getUint8(at + 5), // on whose storey its riders are
            people: view.getUint8(at + 6),
            mode: view.getUint8(at + 7), // 0 in use, 1 out of use, 2 firemen
        };
    });
}

/** Reads a field: cells of `cell` m, rows from y0 upwards; 255 is `most`. */
export function readField(buffer) {
    const view = new DataView(buffer);
    const columns = view.getUint32(8, true), rows = view.getUint32(12, true);
    if (buffer.byteLength < 32 + columns * rows) throw new Error("a field that is cut short");
    return {
        which: view.getUint32(4, true), columns, rows,
        x0: view.getFloat32(16, true), y0: view.getFloat32(20, true),
        cell: view.getFloat32(24, true), most: view.getFloat32(28, true),
        cells: new Uint8Array(buffer, 32, columns * rows), blocks: readBlocks(view, 32 + columns * rows),
    };
}

/** Reads the rows that each sheet has of a field, {sheet, first, rows, y0: m in plan}; none of one plane. */
function readBlocks(view, end) {
    return Array.from({ length: Math.floor((view.byteLength - end) / 16) }, (_, b) => {
        const at = end + 16 * b;
        return { sheet: view.getUint32(at, true), first: view.getUint32(at + 4, true), rows: view.getUint32(at + 8, true), y0: view.getFloat32(at + 12, true) };
    });
}

export class Crowd {
    constructor() {
        this.previous = null;
        this.next = null;
        this.storeys = null; // draw/storeys.js
        this.person = new Uint8Array(0); // a slot's radius in cm, group, and breadth and depth of the torso in cm; 0: a disc
        this.personVersion = 0;
        this.arrived = 0;
        this.interval = 50; // ms between frames, as measured
        this.snap = true; // true: no previous frame to slide from
    }

    /** Takes a frame that arrived at `now` (ms). Returns "new", or "same" for a tick seen already. */
    take(buffer, now) {
        const frame = readFrame(buffer);
        this.storeys?.lift(frame);
        if (this.next && frame.tick === this.next.tick && frame.slots === this.next.slots) {
            this.next = frame;
            return "same";
        }
        const back = this.next && frame.time < this.next.time;
        this.snap = !this.next || back || frame.time - this.next.time > 5;
        if (!this.snap) {
            const gap = Math.min(1000, Math.max(4, now - this.arrived));
            this.interval += 0.2 * (gap - this.interval);
        }
        this.arrived = now;
        this.previous = this.next ?? frame;
        this.next = frame;
        return "new";
    }

    /** Takes radii, groups and torsos of slots from `first` on. */
    takePeople(buffer) {
        const view = new DataView(buffer);
        const first = view.getUint32(4, true), count = view.getUint32(8, true), size = view.getUint32(12, true);
        if (buffer.byteLength < 16 + size * count) throw new Error("people that are cut short");
        if (this.person.length < PERSON * (first + count)) {
            const grown = new Uint8Array(PERSON * (first + count)).fill(0);
            grown.set(this.person);
            this.person = grown;
        }
        const given = new Uint8Array(buffer, 16, size * count);
        for (let n = 0; n < count; n++) {
            for (let k = 0; k < PERSON; k++) this.person[PERSON * (first + n) + k] = k < size ? given[size * n + k] : 0;
        }
        this.personVersion++;
    }

    /** Returns the share of the way from the previous frame to the next, 0 to 1, at `now` (ms). */
    share(now) {
        if (this.snap || !this.next) return 1;
        return Math.min(1, (now - this.arrived) / this.interval);
    }

    alive(slot) {
        return this.next !== null && slot < this.next.slots && this.next.bytes[8 * slot + 5] !== NOBODY;
    }

    /** Returns whether a slot had another person in the previous frame, or its person crossed a periodic edge. */
    another(slot) {
        const at = 8 * slot + 7, a = this.previous.bytes, b = this.next.bytes;
        return at < Math.min(a.length, b.length) && ((a[at] ^ b[at]) & FLAG.parity) !== 0;
    }

    /** Computes the heights of people anew, as storeys are shown in another way. */
    lift() {
        for (const frame of new Set([this.previous, this.next])) if (frame) this.storeys.lift(frame);
    }

    /** Returns the deck that a slot's person is on. */
    deck(slot) {
        return this.next?.stands ? this.next.stands[2 * slot] : 0;
    }

    /** Returns the elevation of a slot's person, m. */
    elevation(slot) {
        return this.next?.stands ? this.next.z0 + this.next.sz * this.next.stands[2 * slot + 1] : 0;
    }

    /** Returns the height in the picture of the floor under a slot's person, m; NaN if that is not shown. */
    floor(slot, share) {
        const { previous: a, next: b } = this;
        if (!b.floors) return 0;
        const slides = share < 1 && slot < a.slots && a.floors && a.bytes[8 * slot + 5] !== NOBODY && !this.another(slot) && !Number.isNaN(a.floors[slot]);
        return slides ? (1 - share) * a.floors[slot] + share * b.floors[slot] : b.floors[slot];
    }

    /** Returns the position of a slot's person at a share of the way, m in plan; null if the slot is empty. */
    position(slot, share) {
        if (!this.alive(slot)) return null;
        const b = this.next, a = this.previous;
        let x = b.x0 + b.sx * b.words[4 * slot], y = b.y0 + b.sy * b.words[4 * slot + 1];
        if (share < 1 && slot < a.slots && a.bytes[8 * slot + 5] !== NOBODY && !this.another(slot)) {
            x = (1 - share) * (a.x0 + a.sx * a.words[4 * slot]) + share * x;
            y = (1 - share) * (a.y0 + a.sy * a.words[4 * slot + 1]) + share * y;
        }
        return [x, y];
    }

    /** Returns the positions of all people in the newest frame: [x, y] of each, m. */
    everybody() {
        const out = [];
        for (let slot = 0; slot < (this.next?.slots ?? 0); slot++) {
            const at = this.position(slot, 1);
            if (at) out.push(at);
        }
        return out;
    }

    /** m */
    radius(slot) {
        return PERSON * slot < this.person.length ? this.person[PERSON * slot] / 100 : 0.2;
    }

    /** Returns breadth and depth of a slot's torso, m, and where its chest points, degrees; null of a disc. */
    torso(slot) {
        const at = PERSON * slot, breadth = this.person[at + 2] / 100, depth = this.person[at + 3] / 100;
        if (!(breadth > depth) || !this.next?.chests) return null;
        return { breadth, depth, chest: (360 * this.next.chests[slot]) / 256 };
    }

    /** m: how far a slot's person reaches from its centre. */
    reach(slot) {
        return Math.max(this.radius(slot), (this.torso(slot)?.breadth ?? 0) / 2);
    }

    group(slot) {
        return this.person[PERSON * slot + 1];
    }

    /** Returns where a body is in the newest frame: {at: [x, y, z] in the picture, deck, high: above the floor}, m; null if there is none. */
    findBody(row) {
        if (!this.next || row >= this.next.bodies) return null;
        const at = BODY * row, p = this.next.poses;
        return placeBody(this.storeys, [p.getFloat32(at, true), p.getFloat32(at + 4, true), p.getFloat32(at + 8, true)]);
    }

    /** Returns the position of a body in the picture: [x, y, z], m; null if there is none. */
    bodyPosition(row) {
        return this.findBody(row)?.at ?? null;
    }
}

/** Returns where a body is drawn that is at [x, y, z] of the plane: {at, deck, high, floor}, m. */
function placeBody(storeys, [x, y, z]) {
    if (!storeys?.several || z < GONE) return { at: [x, y, z], deck: 0, high: z, floor: 0 };
    const deck = storeys.deckAt([x, y]), plan = storeys.toPlan(deck, [x, y]), floor = storeys.heightAt(deck, plan);
    return { at: [...plan, storeys.drawnDecks[deck].shown ? floor + z : 2 * GONE], deck, high: z, floor };
}

/** Writes x, y, z and the floor's height, and a unit quaternion of each body into `out`, `stride` numbers apart. */
export function readPoses(frame, storeys, out, offset, stride, count) {
    const p = frame.poses;
    for (let row = 0; row < Math.min(count, frame.bodies); row++) {
        const at = BODY * row, o = offset + stride * row;
        for (let k = 0; k < 3; k++) out[o + k] = p.getFloat32(at + 4 * k, true);
        for (let k = 0; k < 4; k++) out[o + 4 + k] = p.getInt16(at + 12 + 2 * k, true) / 32767;
        if (!storeys?.several) continue;
        const placed = placeBody(storeys, out.slice(o, o + 3));
        out.set([...placed.at, placed.floor], o);
    }
}
