// The shade on the floor around walls: a texture seen from above, which the floor's shader
// reads. It has the ambient occlusion of walls and a soft shadow to one side.
import * as THREE from "three";

const MOST = 1024; // texels along the longer side
const FINEST = 32; // texels a metre
const AROUND = 0.7, SIDE = 0.5; // m: reach of the occlusion around a wall, and of its shadow
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

/**
 * Draws the shade of rings, all of the same orientation, as {texture, cover: [x0, y0, width, height]}; null
 * without rings. All rings are one path, so that overlapping shades are no darker.
 */
export function bakeShade(rings) {
    if (rings.length === 0) return null;
    const cover = coverOf(rings), scale = Math.min(FINEST, MOST / Math.max(cover[2], cover[3]));
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(2, Math.round(scale * cover[2]));
    canvas.height = Math.max(2, Math.round(scale * cover[3]));
    const pen = canvas.getContext("2d"), aside = 2 * canvas.width;
    // The walls are drawn outside the texture, so that only their shadows fall into it.
    const cast = (offset, blur, dark) => {
        pen.shadowColor = `rgb(0 0 0 / ${dark})`;
        pen.shadowBlur = scale * blur;
        pen.shadowOffsetX = aside + scale * offset[0];
        pen.shadowOffsetY = -scale * offset[1];
        pen.beginPath();
        for (const ring of rings) {
            ring.forEach(([x, y], i) => pen[i ? "lineTo" : "moveTo"](scale * (x - cover[0]) - aside, scale * (cover[1] + cover[3] - y)));
            pen.closePath();
        }
        pen.lineWidth = scale * 0.35 * blur;
        pen.lineJoin = "round";
        pen.fill();
        pen.stroke();
    };
    cast([0, 0], AROUND, 0.55);
    cast([-0.6 * SIDE, 0.8 * SIDE], SIDE, 0.4);
    const texture = new THREE.CanvasTexture(canvas);
    texture.generateMipmaps = false;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    return { texture, cover };
}
