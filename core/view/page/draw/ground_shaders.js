// Shaders of the floor, of what is painted on it, of the sky and of walls.
import { LIGHT } from "./light.js";

export const LOWERED = 0.35; // m, drawn height of walls that would hide something

/** Walls: those that stand between the eye and the box `keep` are lowered. */
export const WALL_VERTEX = `
attribute vec2 middle, across; // of the wall's block; from its middle to beside it, m
attribute float foot;      // height of the floor under it, m
uniform vec3 eye;
uniform vec4 keep;         // x0, y0, x1, y1
uniform float lowered, edge; // edge: m within that box
varying vec3 facing;
varying float high;
void main() {
    vec2 behind = middle + (dot(across, middle - eye.xy) < 0.0 ? -across : across);
    bool hides = all(greaterThan(behind, keep.xy + edge)) && all(lessThan(behind, keep.zw - edge));
    vec3 at = position;
    if (hides && lowered > 0.5) at.z = min(at.z, foot + ${LOWERED});
    facing = normal;
    high = at.z - foot;
    gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(at, 1.0);
}`;

export const WALL_FRAGMENT = LIGHT + `
uniform vec3 colour;
varying vec3 facing;
varying float high;
void main() {
    float open = 0.78 + 0.22 * smoothstep(0.0, 1.2, high);
    gl_FragColor = vec4(lit(colour, normalize(facing), open), 1.0);
}`;

export const WALL_EDGE_FRAGMENT = `
uniform vec3 colour;
void main() { gl_FragColor = vec4(colour, 1.0); }`;

/** How fields and shade lie over the floor, and how it fades into the sky. */
const ON_FLOOR = `
uniform vec3 base, line, sky;
uniform float dim;         // factor of the materials' colours: a dark page has darker floors
uniform sampler2D field, ramp;
uniform vec4 cover;        // x0, y0, width, height of the field, m; width 0: none
uniform vec2 rows;         // share of its height at which this floor's rows begin and end
uniform sampler2D shade;   // of walls
uniform vec4 shaded;       // its area, as of cover; width 0: none
uniform float gain;        // factor of the field's values, so that people and floor share a scale
uniform vec3 extent;       // x, y of the scene's middle; distance up to which the floor is quite visible, m
varying vec2 ground;
/* The field, the shade of walls and the distance over a colour of the floor. */
vec3 onFloor(vec3 colour) {
    if (cover.z > 0.0) {
        vec2 at = (ground - cover.xy) / cover.zw;
        if (all(greaterThan(at, vec2(0.0, rows.x))) && all(lessThan(at, vec2(1.0, rows.y)))) {
            float v = gain * texture2D(field, at).r;
            if (v > 0.004) colour = mix(colour, texture2D(ramp, vec2(v, 0.5)).rgb, min(1.0, 0.2 + 3.0 * v));
        }
    }
    if (shaded.z > 0.0) {
        vec2 at = (ground - shaded.xy) / shaded.zw;
        // Weaker where a field's colours have to be read.
        if (all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0))))
            colour *= 1.0 - (cover.z > 0.0 ? 0.25 : 0.6) * texture2D(shade, at).a;
    }
    float far = distance(ground, extent.xy) / extent.z;
    return mix(colour, sky, smoothstep(1.0, 3.2, far));
}`;

export const FLOOR_VERTEX = `
varying vec2 ground;
void main() {
    ground = position.xy;
    gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0);
}`;

/** The floor's materials, by MATERIAL in the order of MATERIALS: a shader of one, as a processor that draws compiles for long. */
const FLOOR_COLOUR = `
uniform float spacing;     // m between thin lines; every fifth is thicker
float random(vec2 cell) {
    vec3 p = fract(vec3(cell.xyx) * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}
/* -0.5 to 0.5, smooth, with features of \`size\` m; 0 where they are smaller than a pixel. */
float grain(float size) {
    vec2 at = ground / size, i = floor(at), f = at - i, w = fwidth(at);
    f = f * f * (3.0 - 2.0 * f);
    float n = mix(mix(random(i), random(i + vec2(1.0, 0.0)), f.x), mix(random(i + vec2(0.0, 1.0)), random(i + 1.0), f.x), f.y);
    return (n - 0.5) * (1.0 - smoothstep(0.3, 0.9, max(w.x, w.y)));
}
/* Joints between tiles, 0 to 1, and in \`own\` -0.5 to 0.5 of each tile; rows are shifted by \`bond\` of a tile. */
float tiles(vec2 size, float bond, float joint, out float own) {
    vec2 at = ground / size;
    at.x += bond * floor(at.y);
    vec2 w = fwidth(ground / size), cell = floor(at), off = abs(fract(at) - 0.5);
    float fine = 1.0 - smoothstep(0.2, 0.6, max(w.x, w.y));
    own = (random(cell) - 0.5) * fine;
    vec2 edge = smoothstep(0.5 - joint / size - w, 0.5 - joint / size, off) * min(vec2(1.0), joint / size / max(w, 1e-6) + 0.25);
    return max(edge.x, edge.y) * fine;
}
float lines(float every, float wide) {
    vec2 at = ground / every, w = max(fwidth(at), 1e-6), off = abs(fract(at - 0.5) - 0.5) / w;
    return (1.0 - min(min(off.x, off.y) / wide, 1.0)) * (1.0 - smoothstep(0.08, 0.3, max(w.x, w.y)));
}
vec3 floorColour() {
    float own, joint;
#if MATERIAL == 0
    return mix(base, line, max(0.35 * lines(spacing, 1.0), 0.8 * lines(5.0 * spacing, 1.3)));
#else
    vec3 c;
#if MATERIAL == 1 // marble
    joint = tiles(vec2(1.6), 0.0, 0.012, own);
    float vein = grain(2.3) + 0.5 * grain(0.7);
    c = vec3(0.885, 0.875, 0.85) * (1.0 + 0.03 * own + 0.035 * vein - 0.1 * joint);
#elif MATERIAL == 2 // asphalt
    c = vec3(0.60, 0.61, 0.63) * (1.0 + 0.10 * grain(0.05) + 0.06 * grain(0.3) + 0.07 * grain(4.0));
#elif MATERIAL == 3 // concrete
    joint = tiles(vec2(3.0), 0.0, 0.015, own);
    c = vec3(0.79, 0.785, 0.77) * (1.0 + 0.02 * own + 0.05 * grain(1.7) + 0.03 * grain(0.12) - 0.12 * joint);
#elif MATERIAL == 4 // grass
    c = mix(vec3(0.47, 0.58, 0.34), vec3(0.58, 0.67, 0.42), 0.5 + 0.7 * grain(5.0) + 0.5 * grain(1.1)) * (1.0 + 0.16 * grain(0.11));
#elif MATERIAL == 5 // wood
    joint = tiles(vec2(1.8, 0.14), 0.37, 0.003, own);
    c = vec3(0.80, 0.68, 0.52) * (1.0 + 0.09 * own + 0.05 * grain(0.5) - 0.16 * joint);
#elif MATERIAL == 6 // court
    c = vec3(0.66, 0.74, 0.72) * (1.0 + 0.025 * grain(3.0) + 0.03 * grain(0.06));
#elif MATERIAL == 7 // sand
    c = vec3(0.88, 0.81, 0.67) * (1.0 + 0.06 * grain(2.5) + 0.05 * grain(0.6) + 0.08 * grain(0.05));
#elif MATERIAL == 8 // paving
    joint = tiles(vec2(0.6, 0.4), 0.5, 0.012, own);
    c = vec3(0.78, 0.755, 0.715) * (1.0 + 0.08 * own + 0.05 * grain(3.1) - 0.16 * joint);
#else // carpet
    joint = tiles(vec2(0.5), 0.0, 0.002, own);
    c = vec3(0.68, 0.71, 0.74) * (1.0 + 0.03 * own + 0.08 * grain(0.04) + 0.02 * grain(2.0));
#endif
    return c * dim;
#endif
}`;

export const FLOOR_FRAGMENT = ON_FLOOR + FLOOR_COLOUR + `
void main() { gl_FragColor = vec4(onFloor(floorColour()) * (gl_FrontFacing ? 1.0 : 0.7), 1.0); }`;

/** A field alone, over the steps of stairs. */
export const FIELD_FRAGMENT = `
uniform sampler2D field, ramp;
uniform vec4 cover;
uniform vec2 rows;
uniform float gain;
varying vec2 ground;
void main() {
    vec2 at = (ground - cover.xy) / max(cover.zw, vec2(1e-6));
    if (cover.z <= 0.0 || any(lessThan(at, vec2(0.0, rows.x))) || any(greaterThan(at, vec2(1.0, rows.y)))) discard;
    float v = gain * texture2D(field, at).r;
    if (v <= 0.004) discard;
    gl_FragColor = vec4(texture2D(ramp, vec2(v, 0.5)).rgb, min(1.0, 0.2 + 3.0 * v));
}`;

/** How paint varies: not at all, with the floor under it, as grass does. */
export const GRAIN = { none: 0, floor: 0.5, lawn: 1 };

/** What is painted on the floor. */
export const PAINT_VERTEX = `
attribute vec4 ink;        // colour, and how it varies
varying vec2 ground;
varying vec4 paint;
void main() {
    ground = position.xy;
    paint = ink;
    gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0);
}`;

export const PAINT_FRAGMENT = ON_FLOOR + FLOOR_COLOUR + `
varying vec4 paint;
/* How bright the floor (MATERIAL) is here, over its mean: boards, joints and grain show through the paint. */
float relief() {
#if MATERIAL == 0
    return 1.0 + 0.05 * grain(1.7) + 0.04 * grain(0.12);
#else
    const float MEAN[10] = float[10](1.0, 0.87, 0.613, 0.782, 0.52, 0.667, 0.707, 0.787, 0.75, 0.707);
    return dot(floorColour(), vec3(0.3333)) / (dim * MEAN[MATERIAL]);
#endif
}
void main() {
    vec3 colour = paint.rgb;
    if (paint.a > 0.75) { // dry and lush patches, tufts, blades
        float patch_ = grain(5.0) + 0.6 * grain(1.1);
        colour *= (1.0 + 0.16 * patch_ + 0.2 * grain(0.11)) * vec3(1.0 + 0.1 * patch_, 1.0, 1.0 - 0.12 * patch_);
    } else if (paint.a > 0.25) {
        colour *= relief();
    }
    gl_FragColor = vec4(onFloor(colour * mix(1.0, dim, 0.7)), 1.0);
}`;

/** The sky behind everything: a triangle over the window; at the horizon it has the colour that the floor fades into. */
export const SKY_VERTEX = `
varying vec3 ray;
void main() {
    bool flat_ = projectionMatrix[3][3] > 0.5;
    vec3 view = vec3(position.x / projectionMatrix[0][0], position.y / projectionMatrix[1][1], -1.0);
    ray = flat_ ? vec3(0.0, 0.0, -1.0) : view * mat3(viewMatrix);
    gl_Position = vec4(position.xy, 0.99999, 1.0);
}`;

export const SKY_FRAGMENT = `
uniform vec3 sky, zenith;
varying vec3 ray;
void main() { gl_FragColor = vec4(mix(sky, zenith, smoothstep(0.0, 0.55, normalize(ray).z)), 1.0); }`;
