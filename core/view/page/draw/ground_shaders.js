// Shaders of the floor and of walls.

export const LOWERED = 0.35; // m, drawn height of walls that would hide something

/** Walls: those that stand between the eye and the box `keep` are lowered. */
export const WALL_VERTEX = `
attribute vec2 middle, across; // of the wall's block; from its middle to beside it, m
uniform vec3 eye;
uniform vec4 keep;         // x0, y0, x1, y1
uniform float lowered, edge; // edge: m within that box
varying vec3 facing;
varying float high;
void main() {
    vec2 behind = middle + (dot(across, middle - eye.xy) < 0.0 ? -across : across);
    bool hides = all(greaterThan(behind, keep.xy + edge)) && all(lessThan(behind, keep.zw - edge));
    vec3 at = position;
    if (hides && lowered > 0.5) at.z = min(at.z, ${LOWERED});
    facing = normal;
    high = at.z;
    gl_Position = projectionMatrix * viewMatrix * vec4(at, 1.0);
}`;

export const WALL_FRAGMENT = `
uniform vec3 colour;
varying vec3 facing;
varying float high;
void main() {
    float light = 0.72 + 0.34 * facing.z + 0.14 * dot(facing.xy, vec2(0.55, -0.83));
    gl_FragColor = vec4(colour * light * (0.86 + 0.14 * smoothstep(0.0, 1.2, high)), 1.0);
}`;

export const WALL_EDGE_FRAGMENT = `
uniform vec3 colour;
void main() { gl_FragColor = vec4(colour, 1.0); }`;

/** The floor with lines every so many metres, and the field over it. */
export const FLOOR_VERTEX = `
varying vec2 ground;
void main() {
    ground = position.xy;
    gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}`;

export const FLOOR_FRAGMENT = `
uniform vec3 base, line;
uniform float spacing;     // m between thin lines; every fifth is thicker
uniform sampler2D field, ramp;
uniform vec4 cover;        // x0, y0, width, height of the field, m; width 0: none
uniform sampler2D shade;   // of walls
uniform vec4 shaded;       // its area, as of cover; width 0: none
uniform float gain;        // factor of the field's values, so that people and floor share a scale
varying vec2 ground;
float lines(float every, float wide) {
    vec2 at = ground / every;
    vec2 off = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), 1e-6);
    return 1.0 - min(min(off.x, off.y) / wide, 1.0);
}
void main() {
    vec3 colour = mix(base, line, max(0.35 * lines(spacing, 1.0), 0.8 * lines(5.0 * spacing, 1.3)));
    if (cover.z > 0.0) {
        vec2 at = (ground - cover.xy) / cover.zw;
        if (all(greaterThan(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)))) {
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
    gl_FragColor = vec4(colour, 1.0);
}`;
