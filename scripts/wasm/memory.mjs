// Reads what the module has written into its memory: columns, events and bodies. Places are indices of 4 or 8 bytes.
const ARRAYS = [Uint8Array, Uint16Array, Uint32Array, Int32Array, BigUint64Array, Float32Array, Float64Array]; // JoType

// Fields of the events of jostle_read.h: u a whole number, f a float, each of 4 bytes.
const EVENTS = [
    ["transitions", "u:agent u:machine u:from u:to"],
    ["touches", "u:agent u:kind u:other u:began f:force"],
    ["hits", "u:agent u:body f:impulse f:x f:y f:z"],
    ["breaks", "u:body u:bonds u:pieces"],
    ["entered", "u:agent u:group f:x f:y"],
    ["left", "u:agent u:group f:x f:y"],
    ["said", "u:agent u:signal f:x f:y"],
    ["actions", "u:agent u:kind u:other f:x f:y"],
].map(([name, fields]) => ({ name, fields: fields.split(" ").map((field) => field.split(":")) }));

const BODY = ["x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz"]; // JoBodyState

/** The numbers of a column that is described at a place of `words`; null: there are none. As jo_world_column says, in place where it can be. */
export function readColumn(memory, at) {
    const [data, stride, count, type] = memory.words.subarray(at, at + 4);
    if (!data) return null;
    const Numbers = ARRAYS[type], { buffer } = memory.bytes;
    if (stride === Numbers.BYTES_PER_ELEMENT) return new Numbers(buffer, data, count);
    const one = (i) => new Numbers(buffer, data + i * stride, 1)[0];
    return Numbers.from({ length: count }, (_, i) => one(i)); // one number for all, or numbers among others
}

/** Lists of events by kind: at a place of `words` are the addresses of all lists, then their lengths. */
export function readEvents({ words, floats }, at) {
    return Object.fromEntries(EVENTS.map(({ name, fields }, kind) => {
        const data = words[at + kind] >>> 2, count = words[at + EVENTS.length + kind];
        const event = (i) => Object.fromEntries(fields.map(([type, field], f) => [field, (type === "f" ? floats : words)[data + i * fields.length + f]]));
        return [name, Array.from({ length: count }, (_, i) => event(i))];
    }));
}

/** Place, turn and velocity of the body at a place of `doubles`. */
export const readBody = ({ doubles }, at) => Object.fromEntries(BODY.map((key, k) => [key, doubles[at + k]]));
