// Shaders of bodies and of the shade under them.
import { POSE } from "./pose_shaders.js";

/** Bodies: all parts of all of them in one mesh, whose vertices know the row of their body. */
export const BODY_VERTEX = `
precision highp float;
` + POSE + `
attribute vec3 position;
attribute vec3 normal;
attribute vec4 tint;       // colour, and the body's row
uniform float chosen;
uniform mat4 viewMatrix, projectionMatrix;
varying vec3 facing, colour;
varying float high;
void main() {
    vec4 q;
    vec3 p = poseOf(tint.w, q);
    p += turned(position, q);
    facing = turned(normal, q);
    high = p.z - floorUnder(tint.w);
    colour = abs(tint.w - chosen) < 0.5 ? vec3(1.0, 0.85, 0.3) : tint.rgb;
    gl_Position = projectionMatrix * viewMatrix * vec4(p, 1.0);
}`;

/** The shade under bodies: a rectangle a body, on the floor under its two axes that lie flattest. */
export const BODY_SHADE_VERTEX = `
precision highp float;
` + POSE + `
attribute vec3 position;   // of a corner: sign along both axes; and the body's row
attribute vec3 half_size;  // m, of the box about the body
attribute vec3 centre;     // m, of that box, in the body's frame
uniform mat4 viewMatrix, projectionMatrix;
varying vec2 at, reach;
varying float dark;
const float SOFT = 0.35;   // m
void main() {
    vec4 q;
    vec3 p = poseOf(position.z, q);
    vec3 x = turned(vec3(1.0, 0.0, 0.0), q), y = turned(vec3(0.0, 1.0, 0.0), q), z = turned(vec3(0.0, 0.0, 1.0), q);
    p += turned(centre, q);
    vec3 one = x * half_size.x, other = y * half_size.y;
    if (abs(x.z) > abs(y.z) && abs(x.z) > abs(z.z)) one = z * half_size.z;
    else if (abs(y.z) > abs(z.z)) other = z * half_size.z;
    reach = vec2(length(one.xy), length(other.xy));
    vec2 a = reach.x > 0.01 ? one.xy / reach.x : vec2(1.0, 0.0), b = reach.y > 0.01 ? other.xy / reach.y : vec2(-a.y, a.x);
    at = position.xy * (reach + SOFT);
    float under = floorUnder(position.z), low = p.z - under - abs(x.z) * half_size.x - abs(y.z) * half_size.y - abs(z.z) * half_size.z;
    dark = 0.42 * (1.0 - smoothstep(0.0, 1.2, low));
    gl_Position = projectionMatrix * viewMatrix * vec4(p.xy + a * at.x + b * at.y, under + 0.008, 1.0);
    if (dark < 0.01 || p.z < -500.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}`;

export const BODY_SHADE_FRAGMENT = `
precision highp float;
varying vec2 at, reach;
varying float dark;
const float SOFT = 0.35;
void main() {
    vec2 inside = max(reach - 0.15, vec2(0.0));
    float d = min(1.0, length(max(abs(at) - inside, 0.0)) / (SOFT + 0.15));
    gl_FragColor = vec4(0.05, 0.06, 0.09, dark * (1.0 - d) * (1.0 - d));
}`;

/** The edges of bodies, by the same vertices. */
export const BODY_EDGE_FRAGMENT = `
precision highp float;
varying vec3 facing, colour;
void main() { gl_FragColor = vec4(colour * 0.45, 1.0); }`;

export const BODY_FRAGMENT = `
precision highp float;
varying vec3 facing, colour;
varying float high;
void main() {
    vec3 n = normalize(facing);
    float light = 0.6 + 0.2 * n.z + 0.35 * max(0.0, dot(n, vec3(0.45, -0.55, 0.7)));
    gl_FragColor = vec4(colour * light * (0.8 + 0.2 * smoothstep(0.0, 0.5, high)), 1.0);
}`;
