// Colours. Classes: Okabe and Ito (2008), which people with any colour vision tell apart, then the
// same lighter and darker: those of palette.c, so that a group looks alike in pictures. Values: a ramp like viridis, whose lightness grows throughout.

const CLASSES = ["#0072b2", "#e69f00", "#009e73", "#d55e00", "#56b4e9", "#cc79a7", "#f0e442"];
const RAMP = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const HEAT = ["#1b1044", "#51127c", "#8c2981", "#b73779", "#de4968", "#f7705c", "#fe9f6d", "#fecf92", "#fcfdbf"];

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

/** sRGB of a share of the most, 0 to 1. */
export function valueColour(share, heat = false) {
    const stops = heat ? HEAT : RAMP;
    const at = Math.max(0, Math.min(1, share)) * (stops.length - 1);
    const i = Math.min(stops.length - 2, Math.floor(at));
    const a = channels(stops[i]), b = channels(stops[i + 1]);
    return a.map((c, k) => Math.round(c + (at - i) * (b[k] - c)));
}

export function css([r, g, b]) {
    return `rgb(${r} ${g} ${b})`;
}

/** 256 RGBA texels: of classes, or of values. */
export function table(kind) {
    const out = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; i++) {
        const rgb = kind === "class" ? classColour(i) : valueColour(i / 255, kind === "heat");
        out.set([...rgb, 255], 4 * i);
    }
    return out;
}

/** What people are coloured by: how it is called and whether by classes. */
export const COLOURS = {
    state: { name: "state", classes: true },
    group: { name: "group", classes: true },
    speed: { name: "speed", unit: "m/s" },
    force: { name: "net force", unit: "N" },
    compression: { name: "compression", unit: "N/m" },
    load: { name: "load from one side", unit: "N" },
    density: { name: "density", unit: "1/m²" },
    failed: { name: "solved programs", classes: true, names: ["solved", "no velocity satisfies all"], at: [4, 3] },
};

/** A unit as it is written: 1/m2 becomes 1/m². */
export function unitText(unit) {
    return (unit ?? "").replace(/2$/, "²").replace(/3$/, "³");
}

export const FIELDS = {
    none: { name: "none" },
    density: { name: "density", unit: "1/m²" },
    pressure: { name: "crowd pressure, where measured", unit: "1/s²" },
};
