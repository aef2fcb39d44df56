// Tests whether an upright block or a turned box is between two points. Points are [x, y, z], m.

/** Returns the part of a -> b that is between two heights: [from, to], 0 to 1, or null. */
function within(a, b, low, high) {
    const dz = b[2] - a[2];
    if (Math.abs(dz) < 1e-9) return a[2] > low && a[2] < high ? [0, 1] : null;
    const ends = [(low - a[2]) / dz, (high - a[2]) / dz].sort((p, q) => p - q);
    const from = Math.max(0, ends[0]), to = Math.min(1, ends[1]);
    return from < to ? [from, to] : null;
}

function inside(ring, x, y) {
    let odd = false;
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
        const [xi, yi] = ring[i], [xj, yj] = ring[j];
        if (yi > y !== yj > y && x < xi + ((y - yi) / (yj - yi)) * (xj - xi)) odd = !odd;
    }
    return odd;
}

/** Returns whether a -> b passes through an upright block on a ring of points, from the floor to `high`. */
export function meetsBlock(a, b, ring, high) {
    const part = within(a, b, 0, high);
    if (!part) return false;
    const dx = b[0] - a[0], dy = b[1] - a[1];
    const x = a[0] + part[0] * dx, y = a[1] + part[0] * dy;
    if (inside(ring, x, y)) return true;
    const ex = (part[1] - part[0]) * dx, ey = (part[1] - part[0]) * dy;
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
        const px = ring[j][0] - x, py = ring[j][1] - y, qx = ring[i][0] - ring[j][0], qy = ring[i][1] - ring[j][1];
        const cross = ex * qy - ey * qx, t = (px * qy - py * qx) / cross, u = (px * ey - py * ex) / cross;
        if (t >= 0 && t <= 1 && u >= 0 && u <= 1) return true;
    }
    return false;
}

/** Returns whether a -> b passes through a box at the origin with these half sizes. */
export function meetsBox(a, b, half) {
    let from = 0, to = 1;
    for (let k = 0; k < 3; k++) {
        const d = b[k] - a[k];
        if (Math.abs(d) < 1e-9) {
            if (Math.abs(a[k]) > half[k]) return false;
            continue;
        }
        const s = (-half[k] - a[k]) / d, t = (half[k] - a[k]) / d;
        from = Math.max(from, Math.min(s, t));
        to = Math.min(to, Math.max(s, t));
    }
    return from < to;
}
