// The shade on the floor around walls: a texture seen from above, which the floor's shader
// reads. It has the ambient occlusion of what stands on the floor, and the soft shadow that the sun casts from it.
import * as THREE from "three";
import { SUN } from "./light.js";

const MOST = 1024; // texels along the longer side
const FINEST = 32; // texels a metre
const AROUND = 0.7; // m: reach of the occlusion around a wall
const TALLEST = 9; // m: what is higher casts no longer shadow, else a minaret's would cover the crowd
const SOFT = [0.25, 1.1]; // m: blur of the shadows of low and of high things
const HIGH = 2.5; // m: height from which on shadows are blurred like those of high things
const EDGE = 3; // m: margin around the walls

/** The box of some rings of points, with an edge: [x0, y0, width, height], m. */
function coverOf(rings) {
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const p of rings.flat()) {
        for (let k = 0; k < 2; k++) {
            low[k] = Math.min(low[k], p[k] - EDGE);
            high[k] = Math.max(high[k], p[k] + EDGE);
        }
    }
    return [...low, high[0] - low[0], high[1] - low[1]];
}

/** The area that the shadow of an upright block covers: its footprint, swept away from the sun; parts of one orientation. */
function sweptFrom({ ring, high }) {
    const long = Math.min(high, TALLEST) / SUN[2], d = [-SUN[0] * long, -SUN[1] * long], out = [ring, ring.map((p) => p.map((v, k) => v + d[k]))];
    ring.forEach((p, i) => {
        const q = ring[(i + 1) % ring.length], part = [p, q, [q[0] + d[0], q[1] + d[1]], [p[0] + d[0], p[1] + d[1]]];
        out.push((q[0] - p[0]) * d[1] - (q[1] - p[1]) * d[0] < 0 ? part.reverse() : part);
    });
    return out;
}

/**
 * Draws the shade of blocks {ring, high}, all of the same orientation, as {texture, cover: [x0, y0, width, height]}; null
 * without any. All rings of a kind are one path, so that overlapping shades are no darker. `storeys`: number of such textures, which
 * get fewer texels where there are many.
 */
export function bakeShade(blocks, storeys = 1) {
    if (blocks.length === 0) return null;
    const cover = coverOf(blocks.map(({ ring }) => ring)), scale = Math.min(FINEST, MOST / Math.sqrt(storeys) / Math.max(cover[2], cover[3]));
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(2, Math.round(scale * cover[2]));
    canvas.height = Math.max(2, Math.round(scale * cover[3]));
    const pen = canvas.getContext("2d"), aside = 2 * canvas.width;
    // The shapes are drawn outside the texture, so that only their shadows fall into it.
    const cast = (rings, blur, dark, grow) => {
        if (rings.length === 0) return;
        pen.shadowColor = `rgb(0 0 0 / ${dark})`;
        pen.shadowBlur = scale * blur;
        pen.shadowOffsetX = aside;
        pen.shadowOffsetY = 0;
        pen.beginPath();
        for (const ring of rings) {
            ring.forEach(([x, y], i) => pen[i ? "lineTo" : "moveTo"](scale * (x - cover[0]) - aside, scale * (cover[1] + cover[3] - y)));
            pen.closePath();
        }
        pen.lineWidth = scale * grow;
        pen.lineJoin = "round";
        pen.fill();
        if (grow > 0) pen.stroke();
    };
    cast(blocks.map(({ ring }) => ring), AROUND, 0.55, 0.35 * AROUND);
    const isHigh = ({ high }) => high >= HIGH;
    cast(blocks.filter((block) => !isHigh(block)).flatMap(sweptFrom), SOFT[0], 0.36, 0);
    cast(blocks.filter(isHigh).flatMap(sweptFrom), SOFT[1], 0.42, 0);
    const texture = new THREE.CanvasTexture(canvas);
    texture.generateMipmaps = false;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    return { texture, cover };
}
