// What lies under the pointer: the nearest person or body, measured on the screen.
import { NOBODY } from "../net/crowd.js";

const REACH = 24; // CSS pixels around the pointer

/** Returns the slot of the person nearest to a CSS pixel, or null; near ties go to the one in front. */
export function pickPerson(view, crowd, px, py, share, reach = REACH) {
    const frame = crowd.next;
    if (!frame) return null;
    const camera = view.camera;
    camera.updateMatrixWorld();
    // The product of both matrices is computed once, as the loop runs over all people.
    const m = multiply(camera.projectionMatrix.elements, camera.matrixWorldInverse.elements);
    const { floors } = frame, MIDDLE = 0.9;
    let best = null, least = Infinity;
    for (let slot = 0; slot < frame.slots; slot++) {
        if (frame.bytes[8 * slot + 5] === NOBODY) continue;
        let x = frame.x0 + frame.sx * frame.words[4 * slot], y = frame.y0 + frame.sy * frame.words[4 * slot + 1], z = MIDDLE + (floors ? floors[slot] : 0);
        if (Number.isNaN(z)) continue; // on a storey that is not shown
        const w = m[3] * x + m[7] * y + m[11] * z + m[15];
        if (w <= 0) continue;
        let sx = (0.5 + (0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12])) / w) * view.wide;
        let sy = (0.5 - (0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13])) / w) * view.high;
        if (Math.abs(sx - px) > 4 * reach || Math.abs(sy - py) > 4 * reach) continue;
        [x, y] = crowd.position(slot, share);
        if (floors) z = MIDDLE + crowd.floor(slot, share);
        [sx, sy] = view.project(x, y, z) ?? [sx, sy];
        // Upright people are taller than wide: half of the height counts.
        const tall = Math.max(1, 0.8 * heightOf(view, x, y, z - MIDDLE));
        const d = Math.hypot(sx - px, Math.max(0, Math.abs(sy - py) - tall / 2));
        const score = d + 0.02 * w;
        if (d < reach && score < least && !view.isCovered([x, y, z])) {
            least = score;
            best = slot;
        }
    }
    return best;
}

function heightOf(view, x, y, floor) {
    const feet = view.project(x, y, floor), head = view.project(x, y, floor + 1.7);
    return feet && head ? Math.abs(feet[1] - head[1]) : 0;
}

/** The row of the body nearest to a CSS pixel, or null. */
export function pickBody(view, crowd, bodies, px, py) {
    let best = null, least = Infinity;
    for (let row = 0; row < bodies.radii.length; row++) {
        const at = crowd.bodyPosition(row);
        const spot = at && view.project(...at);
        if (!spot || view.isCovered(at)) continue;
        const pixels = view.pixelsOfMetre() / view.ratio / (view.top ? 1 : spot[2]);
        const d = Math.hypot(spot[0] - px, spot[1] - py);
        if (d < Math.max(12, bodies.radii[row] * pixels) && d + spot[2] < least) {
            least = d + spot[2];
            best = row;
        }
    }
    return best;
}

/** Multiplies matrices, stored by columns as in three.js and OpenGL. */
function multiply(a, b) {
    const out = new Float64Array(16);
    for (let column = 0; column < 4; column++) {
        for (let row = 0; row < 4; row++) {
            for (let k = 0; k < 4; k++) out[4 * column + row] += a[4 * k + row] * b[4 * column + k];
        }
    }
    return out;
}
