// Marks of the balls of a game: a ring round each, its place on the floor while it is in the air, and an arrow at the
// edge of the picture to one that is out of sight.
import { stroke } from "./overlay.js";

const LOW = 0.4; // m: a ball whose centre is higher is in the air
const EDGE = 26; // CSS pixels from the edge of the picture to an arrow
const COLOUR = "#ffd21f", RIM = "#000000b0";

function outlined(pen, points, wide) {
    stroke(pen, points, RIM, wide + 2.5);
    stroke(pen, points, COLOUR, wide);
}

function ring([x, y], radius) {
    return Array.from({ length: 25 }, (_, k) => [x + radius * Math.cos((k * Math.PI) / 12), y + radius * Math.sin((k * Math.PI) / 12)]);
}

/** Draws an arrow at the edge, in the direction of a point out of sight. */
function pointTo(pen, view, [x, y]) {
    const midX = view.wide / 2, midY = view.high / 2, turn = Math.atan2(y - midY, x - midX);
    const reach = Math.min((midX - EDGE) / Math.abs(Math.cos(turn) || 1e-6), (midY - EDGE) / Math.abs(Math.sin(turn) || 1e-6));
    const tip = [midX + reach * Math.cos(turn), midY + reach * Math.sin(turn)];
    const wing = (by) => [tip[0] - 18 * Math.cos(turn + by), tip[1] - 18 * Math.sin(turn + by)];
    outlined(pen, [wing(0.6), tip, wing(-0.6)], 4);
}

/** Returns where a point of the scene, m, is on the screen, or in which direction if it is behind the camera. */
function find(view, at) {
    const spot = view.project(...at);
    if (spot) return spot;
    const m = view.camera.matrixWorld.elements, d = [0, 1, 2].map((k) => at[k] - m[12 + k]);
    const along = (column) => d[0] * m[column] + d[1] * m[column + 1] + d[2] * m[column + 2];
    return [view.wide / 2 + 1e4 * along(0), view.high / 2 + 1e4 * Math.abs(along(4)) + 1e4];
}

/** Marks balls {at: [x, y, z] in the picture, high: above the floor, m}; returns how many are out of sight. */
export function markBalls(pen, view, balls) {
    let out = 0;
    for (const { at, high } of balls) {
        const spot = find(view, at);
        if (spot[0] < 0 || spot[1] < 0 || spot[0] > view.wide || spot[1] > view.high) {
            pointTo(pen, view, spot);
            out++;
            continue;
        }
        outlined(pen, ring(spot, 11), 2.5);
        if (high < LOW) continue;
        const floor = at[2] - high + 0.02, foot = ring(at, 0.25).map(([x, y]) => view.project(x, y, floor));
        stroke(pen, [view.project(at[0], at[1], floor), [spot[0], spot[1] + 11]], "#00000090", 1.5);
        outlined(pen, foot, 1.5);
    }
    return out;
}
