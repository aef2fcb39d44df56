// The shade that lies on the floor about walls, as a picture of it from above that the floor's program
// reads: what stands in the way of light from the sky, and a soft shadow to one side.
import * as THREE from "/three/build/three.module.js";

const MOST = 1024; // texels along the longer side
const FINEST = 32; // texels a metre
const AROUND = 0.7, SIDE = 0.5; // m, how far the shade about a wall reaches, and the shadow beside it
const EDGE = 3; // m about the walls

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
 * {texture, cover: [x0, y0, width, height]} of the shade of rings, which all run the same way round; null
 * without any. All rings are one path, so that shades that overlap are no darker.
 */
export function bakeShade(rings) {
    if (rings.length === 0) return null;
    const cover = coverOf(rings), scale = Math.min(FINEST, MOST / Math.max(cover[2], cover[3]));
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(2, Math.round(scale * cover[2]));
    canvas.height = Math.max(2, Math.round(scale * cover[3]));
    const pen = canvas.getContext("2d"), aside = 2 * canvas.width;
    // Only the shadows of what is drawn beside the picture fall into it.
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
