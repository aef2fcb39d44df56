// The figure of a person: a body of turned rings, elliptic like shoulders, and a head. 1 m high, 1 m
// wide across the shoulders (+-y), looking along +x; the shader scales it.

// Height, half width and half depth of the body's rings, from the feet up.
const RINGS = [
    [0.0, 0.3, 0.22], [0.1, 0.27, 0.2], [0.45, 0.36, 0.24], [0.7, 0.47, 0.26], [0.79, 0.45, 0.24],
    [0.835, 0.2, 0.15], [0.85, 0.0, 0.0],
];
const SIDES = 10;
const HEAD = { at: 0.92, radius: 0.08, wide: 0.3, rings: 5, sides: 8 };

/** {corner, normal: Float32Array, index: Uint16Array} */
export function makeFigure() {
    const corner = [], normal = [], index = [];
    const rings = (count, sides, ring) => {
        const first = corner.length / 3;
        for (let i = 0; i < count; i++) {
            for (let s = 0; s < sides; s++) {
                const [at, n] = ring(i, (2 * Math.PI * s) / sides);
                corner.push(...at);
                normal.push(...n);
                if (i + 1 === count) continue;
                const a = first + i * sides + s, b = first + i * sides + ((s + 1) % sides);
                index.push(a, b, b + sides, a, b + sides, a + sides);
            }
        }
    };
    rings(RINGS.length, SIDES, (i, angle) => {
        const [z, wide, deep] = RINGS[i];
        const [za, wa] = RINGS[Math.max(0, i - 1)], [zb, wb] = RINGS[Math.min(RINGS.length - 1, i + 1)];
        const slope = -(wb - wa) / (zb - za);
        return [[deep * Math.cos(angle), wide * Math.sin(angle), z],
            [Math.cos(angle), Math.sin(angle), Math.max(-0.5, Math.min(4, 0.4 * slope))]];
    });
    rings(HEAD.rings, HEAD.sides, (i, angle) => {
        const up = -Math.PI / 2 + (Math.PI * i) / (HEAD.rings - 1);
        const n = [Math.cos(up) * Math.cos(angle), Math.cos(up) * Math.sin(angle), Math.sin(up)];
        return [[HEAD.wide * n[0], 0.85 * HEAD.wide * n[1], HEAD.at + HEAD.radius * n[2]], n];
    });
    return { corner: new Float32Array(corner), normal: new Float32Array(normal), index: new Uint16Array(index) };
}
