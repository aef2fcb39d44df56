// Chooses the camera's position and direction so that a scene fills the window.
import * as THREE from "three";

const TURNS = [0, -15, 15, -30, 30, -45, 45, -60, 60, -75, 75, -90, 90]; // candidate directions: degrees from the south, eastwards
const RISES = [36, 48, 60]; // candidate elevations: degrees above the floor
const BETWEEN = 30; // degrees above the floor from which one looks between storeys
const FILL = 0.94; // share of the window that the scene fills
const RELUCTANCE = 0.1; // share of the score that a turn of 90 degrees from the south costs
const STEEP = [48, 0.01]; // degrees of elevation above which people look flat; share of the score that each further degree costs
const EVEN = 0.7; // weight of perspective: power of the ratio of the nearest and farthest distance
const NARROW = 1; // width / height of a window below which a scene's own camera moves back
const TALL = 2.1; // m: height that has to be visible, that of the tallest figures
const WIDE = 0.4; // m: margin around people
const TALLEST = 3; // m: walls count as visible height up to this

/** The corners of a box [[x0, y0], [x1, y1]] between two heights, m. */
function cornersOf([[x0, y0], [x1, y1]], [low, high]) {
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].flatMap(([x, y]) => [new THREE.Vector3(x, y, low), new THREE.Vector3(x, y, high)]);
}

/** Right, up and forward of an eye that looks down by `rise` rad from `turn` rad east of the south. */
function axesOf(turn, rise) {
    const ahead = new THREE.Vector3(-Math.sin(turn) * Math.cos(rise), Math.cos(turn) * Math.cos(rise), -Math.sin(rise));
    const right = new THREE.Vector3(Math.cos(turn), Math.sin(turn), 0);
    return { right, up: new THREE.Vector3().crossVectors(right, ahead), ahead };
}

/**
 * Returns the nearest camera position with these axes that has all points in view. The tangents bound
 * x - tx z and -x - tx z of every point (z: its depth), which gives where the four planes of the
 * window meet.
 */
function standOf(points, { right, up, ahead }, tangents) {
    const sides = [right, up].map((axis, i) => {
        let low = -Infinity, high = -Infinity;
        for (const p of points) {
            const along = p.dot(axis), depth = tangents[i] * p.dot(ahead);
            high = Math.max(high, along - depth);
            low = Math.max(low, -along - depth);
        }
        return { at: (high - low) / 2, back: -(high + low) / (2 * tangents[i]) };
    });
    const back = Math.min(sides[0].back, sides[1].back, ...points.map((p) => p.dot(ahead) - 1));
    return new THREE.Vector3().addScaledVector(right, sides[0].at).addScaledVector(up, sides[1].at).addScaledVector(ahead, back);
}

/**
 * Scores how well a window is filled: the share of it that the floor covers, times the share that the box around
 * the floor spans (so that long scenes lie along a diagonal), reduced if far parts look much smaller.
 */
function scoreOf(points, low, eye, { right, up, ahead }, tangents, turn, rise) {
    let area = 0, nearest = Infinity, farthest = 0;
    const floor = points.filter((p) => p.z === low).map((p) => {
        const v = p.clone().sub(eye), depth = v.dot(ahead);
        nearest = Math.min(nearest, depth);
        farthest = Math.max(farthest, depth);
        return [v.dot(right) / depth / tangents[0], v.dot(up) / depth / tangents[1]];
    });
    floor.forEach(([x, y], i) => {
        const [nx, ny] = floor[(i + 1) % floor.length];
        area += (x * ny - nx * y) / 8; // the window is 2 by 2
    });
    const steep = STEEP[1] * Math.max(0, rise * (180 / Math.PI) - STEEP[0]);
    const [[x0, y0], [x1, y1]] = boxOf(floor, 0), span = ((x1 - x0) * (y1 - y0)) / 4;
    return Math.abs(area) * span * (nearest / farthest) ** EVEN * (1 - (RELUCTANCE * Math.abs(turn)) / (Math.PI / 2)) * (1 - steep);
}

/** Returns the height that has to be visible in a scene, that of heads and of walls, m. */
export function heightOf(scene) {
    return Math.min(TALLEST, Math.max(TALL, ...(scene.walls ?? []).map((wall) => wall.height || 0)));
}

/** Tangents of half of a window, of which a margin is left free; `fieldOfView` is its height in degrees, `aspect` its width by its height. */
function tangentsOf(fieldOfView, aspect) {
    const high = FILL * Math.tan((fieldOfView / 2) * (Math.PI / 180));
    return [high * aspect, high];
}

/** The camera {at, look} at a point, which looks ahead at the height `aim`, m. */
function lookAt(at, ahead, aim) {
    return { at, look: at.clone().addScaledVector(ahead, (aim - at.z) / ahead.z) };
}

/** Returns the camera {at, look} with the best score that shows a box of the floor between two heights [low, high], m. */
export function fitBox(box, heights, fieldOfView, aspect) {
    const tangents = tangentsOf(fieldOfView, aspect), points = cornersOf(box, heights);
    let best = null;
    for (const turn of TURNS.map((t) => (t * Math.PI) / 180)) {
        for (const rise of RISES.map((r) => (r * Math.PI) / 180)) {
            const axes = axesOf(turn, rise), at = standOf(points, axes, tangents);
            const score = scoreOf(points, heights[0], at, axes, tangents, turn, rise);
            if (!best || score > best.score) best = { score, at, ahead: axes.ahead };
        }
    }
    return lookAt(best.at, best.ahead, heights[0]);
}

/**
 * Returns the camera {at, look} that shows points [x, y, z] of several storeys from BETWEEN degrees above them, across the shorter side
 * of a box around them: so one looks between storeys that are spread. It looks at the height `aim`, m.
 */
export function fitStoreys(corners, [[x0, y0], [x1, y1]], aim, fieldOfView, aspect) {
    const turn = y1 - y0 > x1 - x0 ? Math.PI / 2 : 0, axes = axesOf(turn, (BETWEEN * Math.PI) / 180);
    const at = standOf(corners.map((p) => new THREE.Vector3(...p)), axes, tangentsOf(fieldOfView, aspect));
    return lookAt(at, axes.ahead, aim);
}

/**
 * Returns the camera that a scene gives, {at, look} as [x, y, z], m, moved back on its
 * line of sight if the window is narrow, so that it shows the same width.
 */
export function standAt({ at, look }, aspect) {
    const target = new THREE.Vector3(...look), back = Math.max(1, NARROW / aspect);
    return { at: new THREE.Vector3(...at).sub(target).multiplyScalar(back).add(target), look: target };
}

/** The box around points [x, y], m, grown where it is less than `least` m wide; null without points. */
export function boxOf(points, least = 2) {
    if (points.length === 0) return null;
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const p of points) {
        for (let k = 0; k < 2; k++) {
            low[k] = Math.min(low[k], p[k]);
            high[k] = Math.max(high[k], p[k]);
        }
    }
    for (let k = 0; k < 2; k++) {
        const more = Math.max(0, least - (high[k] - low[k])) / 2;
        low[k] -= more;
        high[k] += more;
    }
    return [low, high];
}

const LARGER = 8; // a crowd and its places may take this many times the area of a crowd without walls
const NEAR = 0.4; // share of the size of walls and crowd: distance from these within which places are shown

/** Points around a place, m. */
function extentOf({ kind, points = [], radius = 0 }) {
    return kind === "point" ? points.flatMap(([x, y]) => [[x - radius, y - radius], [x + radius, y + radius]]) : points;
}

/**
 * Returns the box that a picture of a scene has to show: walls, people, and the places
 * near them. Far places (where people go once they are out) are left out, unless a crowd that
 * no wall encloses walks to them. `people`: [x, y] of each.
 */
export function sceneBox(scene, people) {
    const places = (scene.places ?? []).filter((p) => p.kind !== "set").map(extentOf);
    const figures = people.flatMap(([x, y]) => [[x - WIDE, y - WIDE], [x + WIDE, y + WIDE]]);
    const core = boxOf([...(scene.walls ?? []).flatMap((w) => w.points ?? []), ...figures]);
    if (!core) return boxOf([...places.flat(), ...(scene.areas ?? []).flatMap(({ points }) => points)]) ?? scene.area;
    const all = boxOf([...core, ...places.flat()]), area = ([[x0, y0], [x1, y1]]) => (x1 - x0) * (y1 - y0);
    if (!scene.walls?.length && area(all) <= LARGER * area(core)) return all;
    const margin = NEAR * Math.max(Math.sqrt(area(core)), 10);
    const low = core[0].map((v) => v - margin), high = core[1].map((v) => v + margin);
    const inside = (p) => p.every((v, k) => v > low[k] && v < high[k]);
    const near = places.filter((points) => points.some(inside)).flat().map((p) => p.map((v, k) => Math.min(high[k], Math.max(low[k], v))));
    return boxOf([...core, ...near]);
}
