// Colours. Classes: Okabe and Ito (2008), which people with any colour vision tell apart, then the
// same lighter and darker: those of palette.c, so that a group looks alike in pictures. Values: pale
// for nothing to dark for the most, as in palette.c, one ramp for people and floor.

export const CLASSES_TOLD = 8; // classes that all eyes tell apart
const CLASSES = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9", "#cc79a7", "#f0e442", "#7d1f4a"];
const RAMP = ["#fbf6d3", "#fde39a", "#fcc562", "#f8a140", "#ee762f", "#d84a2c", "#b32536", "#82123f", "#4d0b3b"];
// For figures that are no danger, such as speed.
const CALM = ["#f6f5dc", "#d3e8cf", "#a3d6cf", "#6bbdcf", "#3c9cc4", "#2577ad", "#1a528b", "#142f63"];
const DARKEST = 0.8; // share of a ramp that a dark floor uses: the rest is as dark as the floor
// Headings from east by north: hues around the circle that also differ in lightness.
const WAYS = ["#d55e00", "#f0b942", "#7fb842", "#1c9e77", "#37a6dd", "#2c5fb8", "#7b4aa8", "#c0508f"];

/** Levels of service of walkways, people per m2 up to which each holds (Fruin 1971). */
export const SERVICE = [["A", 0.31], ["B", 0.43], ["C", 0.72], ["D", 1.08], ["E", 2.17], ["F", Infinity]];

function channels(hex) {
    return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

/** sRGB [r, g, b], 0 to 255, of class `index`. */
export function classColour(index) {
    const base = channels(CLASSES[index % CLASSES.length]);
    const turn = Math.floor(index / CLASSES.length) % 3;
    if (turn === 0) return base;
    const towards = turn === 1 ? 255 : 0;
    return base.map((c) => Math.round(c + 0.45 * (towards - c)));
}

let onDark = false;

/** Chooses ramps for a dark floor, which lead from its darkness up to pale: the most always stands out. */
export function useDarkRamps(on) {
    onDark = on;
}

/** sRGB of a share of the greatest value, 0 to 1; `calm`: for figures that are no danger. */
export function valueColour(share, calm = false, dark = onDark) {
    const stops = calm ? CALM : RAMP, of = Math.max(0, Math.min(1, share));
    return between(stops, (dark ? DARKEST * (1 - of) : of) * (stops.length - 1));
}

/** sRGB of a heading, in turns from the east, counter-clockwise. */
export function wayColour(turn) {
    return between([...WAYS, WAYS[0]], (turn - Math.floor(turn)) * WAYS.length);
}

/** sRGB of level of service `index` of SERVICE. */
export function serviceColour(index) {
    return valueColour([0, 0.15, 0.32, 0.5, 0.7, 0.92][index]);
}

/** sRGB at `at` of a list of colours: at 1.5, half of the second and half of the third. */
function between(stops, at) {
    const i = Math.min(stops.length - 2, Math.floor(at));
    const a = channels(stops[i]), b = channels(stops[i + 1]);
    return a.map((c, k) => Math.round(c + (at - i) * (b[k] - c)));
}

export function css([r, g, b]) {
    return `rgb(${r} ${g} ${b})`;
}

const NOBODYS = [0x77, 0x77, 0x77]; // people without a class

/** sRGB of a state or group in the scene message: its own colour, else the one that pictures use. */
export function namedColour(named) {
    return named?.colour ? channels(named.colour) : NOBODYS;
}

/** The states of a scene message, each with the colour of the first state within the outermost state around it. */
export function outerStates(scene) {
    const states = scene?.states ?? [], seen = new Map();
    const machines = scene?.machines ?? [];
    return states.map((state, i) => {
        const first = states.findIndex((s) => s.machine === state.machine);
        const around = (machines[state.machine]?.outer ?? []).filter((outer) => outer.within.includes(i - first))
            .sort((a, b) => b.within.length - a.within.length)[0];
        const name = `${state.machine} ${around?.name ?? state.name}`;
        if (!seen.has(name)) seen.set(name, { machine: state.machine, name: around?.name ?? state.name, colour: CLASSES[seen.size % CLASSES.length] });
        return seen.get(name);
    });
}

/** Colour of texel `i` of 256 of a table of classes, values, headings, or levels of service up to `most`. */
const TEXELS = {
    class: (i) => classColour(i),
    value: (i) => valueColour(i / 255),
    calm: (i) => valueColour(i / 255, true),
    way: (i) => wayColour(i / 256),
    service: (i, most) => serviceColour(SERVICE.findIndex(([, up]) => (i / 255) * most < up)),
};

/** 256 RGBA texels of a kind, or of the states or groups `named`; of these only `kept` (a function of the index) keep their colours. */
export function table(kind, most = 0, named = null, kept = null) {
    const out = new Uint8Array(4 * 256), others = onDark ? [0x45, 0x4b, 0x54] : [0xc4, 0xc9, 0xd0];
    for (let i = 0; i < 256; i++) {
        const colour = kept && !kept(i) ? others : named ? namedColour(named[i]) : TEXELS[kind](i, most);
        out.set([...colour, 255], 4 * i);
    }
    return out;
}

/** What people can be coloured by: its name, and whether it has classes. */
export const COLOURS = {
    state: { name: "state", classes: true },
    outer: { name: "outer state", classes: true, asks: "state" },
    group: { name: "group", classes: true },
    speed: { name: "speed", unit: "m/s", table: "calm" },
    force: { name: "net force", unit: "N" },
    compression: { name: "compression", unit: "N/m" },
    load: { name: "load from one side", unit: "N" },
    density: { name: "density", unit: "1/m²" },
    service: { name: "level of service", unit: "1/m²", most: 8, table: "service", classes: true,
        names: SERVICE.map(([level, up], i) => (up === Infinity ? `${level} over ${SERVICE[i - 1][1]}` : `${level} to ${up}`)) },
    direction: { name: "way they go", table: "way", classes: true, names: ["east", "north", "west", "south"] },
    failed: { name: "solved programs", classes: true, asks: "state", names: ["solved", "no velocity satisfies all"], at: [4, 3] },
};

/** Formats a unit: 1/m2 becomes 1/m². */
export function unitText(unit) {
    return (unit ?? "").replace(/2$/, "²").replace(/3$/, "³");
}

export const FIELDS = {
    none: { name: "none" },
    density: { name: "density", unit: "1/m²" },
    pressure: { name: "crowd pressure, where measured", unit: "1/s²" },
};
