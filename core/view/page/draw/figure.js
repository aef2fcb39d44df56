// The figure of a person: legs, a body that widens to the shoulders, arms and a head. 1 m high, 1 m
// wide across the shoulders (+-y), looking along +x; the shader scales it and swings its limbs.

// Height, half width and half depth of the rings of each part, from below; `swing`: which way a limb
// swings and the height around which it does; `limb`: 0 body, 1 leg, 2 arm, 3 head.
const PARTS = [
    { sides: 6, limb: 1, y: 0.14, swing: [1, 0.48], rings: [[0.0, 0.09, 0.17], [0.05, 0.1, 0.13], [0.25, 0.11, 0.12], [0.5, 0.16, 0.17]] },
    { sides: 6, limb: 1, y: -0.14, swing: [-1, 0.48], rings: [[0.0, 0.09, 0.17], [0.05, 0.1, 0.13], [0.25, 0.11, 0.12], [0.5, 0.16, 0.17]] },
    { sides: 10, limb: 0, y: 0, swing: [0, 0], rings: [[0.44, 0.28, 0.2], [0.5, 0.31, 0.21], [0.6, 0.3, 0.2], [0.73, 0.39, 0.24], [0.79, 0.4, 0.22],
        [0.825, 0.26, 0.16], [0.845, 0.12, 0.12], [0.87, 0.11, 0.12]] },
    { sides: 6, limb: 2, y: 0.42, swing: [-0.8, 0.79], rings: [[0.42, 0.055, 0.07], [0.6, 0.075, 0.09], [0.76, 0.09, 0.11], [0.81, 0.04, 0.05]] },
    { sides: 6, limb: 2, y: -0.42, swing: [0.8, 0.79], rings: [[0.42, 0.055, 0.07], [0.6, 0.075, 0.09], [0.76, 0.09, 0.11], [0.81, 0.04, 0.05]] },
    { sides: 8, limb: 3, y: 0, swing: [0, 0], rings: [-90, -50, -15, 20, 55, 90].map((up) => {
        const a = (up * Math.PI) / 180;
        return [0.925 + 0.075 * Math.sin(a), 0.17 * Math.cos(a), 0.21 * Math.cos(a)];
    }) },
];

/** {corner, normal, swing: Float32Array, index: Uint16Array}; `swing`: way, height (m of 1 m), limb. */
export function makeFigure() {
    const corner = [], normal = [], swing = [], index = [];
    for (const part of PARTS) {
        const first = corner.length / 3, { rings, sides } = part;
        rings.forEach(([z, wide, deep], i) => {
            const [za, wa] = rings[Math.max(0, i - 1)], [zb, wb] = rings[Math.min(rings.length - 1, i + 1)];
            const slope = Math.max(-2, Math.min(4, (-0.4 * (wb - wa)) / (zb - za)));
            for (let s = 0; s < sides; s++) {
                const angle = (2 * Math.PI * s) / sides;
                corner.push(deep * Math.cos(angle), part.y + wide * Math.sin(angle), z);
                normal.push(Math.cos(angle), Math.sin(angle), slope);
                swing.push(...part.swing, part.limb);
                if (i + 1 === rings.length) continue;
                const a = first + i * sides + s, b = first + i * sides + ((s + 1) % sides);
                index.push(a, b, b + sides, a, b + sides, a + sides);
            }
        });
    }
    return { corner: new Float32Array(corner), normal: new Float32Array(normal), swing: new Float32Array(swing), index: new Uint16Array(index) };
}
