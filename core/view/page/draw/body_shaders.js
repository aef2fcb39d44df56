// Shaders of bodies and of the shade under them.

/** Bodies: all parts of all of them in one mesh, whose vertices know the row of their body. */
export const BODY_VERTEX = `
precision highp float;
attribute vec3 position;
attribute vec3 normal;
attribute vec4 tint;       // colour, and the body's row
uniform sampler2D poses;   // four texels a body: previous place and turn, next place and turn
uniform vec2 size;         // of the texture
uniform float share, chosen;
uniform mat4 viewMatrix, projectionMatrix;
varying vec3 facing, colour;
varying float high;
vec4 texel(float index) {
    float row = floor((index + 0.5) / size.x);
    return texture2D(poses, vec2(index - row * size.x + 0.5, row + 0.5) / size);
}
vec3 turned(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
void main() {
    float at = 4.0 * tint.w;
    vec4 q0 = texel(at + 1.0), q1 = texel(at + 3.0);
    vec4 q = mix(dot(q0, q1) < 0.0 ? -q0 : q0, q1, share);
    q = dot(q, q) < 1e-6 ? vec4(0.0, 0.0, 0.0, 1.0) : normalize(q);
    vec3 p = mix(texel(at).xyz, texel(at + 2.0).xyz, share) + turned(position, q);
    facing = turned(normal, q);
    high = p.z;
    colour = abs(tint.w - chosen) < 0.5 ? vec3(1.0, 0.85, 0.3) : tint.rgb;
    gl_Position = projectionMatrix * viewMatrix * vec4(p, 1.0);
}`;

/** The shade under bodies: a rectangle a body, on the floor under its two axes that lie flattest. */
export const BODY_SHADE_VERTEX = `
precision highp float;
attribute vec3 position;   // of a corner: sign along both axes; and the body's row
attribute vec3 half_size;  // m, of the box about the body
attribute vec3 centre;     // m, of that box, in the body's frame
uniform sampler2D poses;
uniform vec2 size;
uniform float share;
uniform mat4 viewMatrix, projectionMatrix;
varying vec2 at, reach;
varying float dark;
const float SOFT = 0.35;   // m
vec4 texel(float index) {
    float row = floor((index + 0.5) / size.x);
    return texture2D(poses, vec2(index - row * size.x + 0.5, row + 0.5) / size);
}
vec3 turned(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
void main() {
    float first = 4.0 * position.z;
    vec4 q0 = texel(first + 1.0), q1 = texel(first + 3.0);
    vec4 q = mix(dot(q0, q1) < 0.0 ? -q0 : q0, q1, share);
    q = dot(q, q) < 1e-6 ? vec4(0.0, 0.0, 0.0, 1.0) : normalize(q);
    vec3 x = turned(vec3(1.0, 0.0, 0.0), q), y = turned(vec3(0.0, 1.0, 0.0), q), z = turned(vec3(0.0, 0.0, 1.0), q);
    vec3 p = mix(texel(first).xyz, texel(first + 2.0).xyz, share) + turned(centre, q);
    vec3 one = x * half_size.x, other = y * half_size.y;
    if (abs(x.z) > abs(y.z) && abs(x.z) > abs(z.z)) one = z * half_size.z;
    else if (abs(y.z) > abs(z.z)) other = z * half_size.z;
    reach = vec2(length(one.xy), length(other.xy));
    vec2 a = reach.x > 0.01 ? one.xy / reach.x : vec2(1.0, 0.0), b = reach.y > 0.01 ? other.xy / reach.y : vec2(-a.y, a.x);
    at = position.xy * (reach + SOFT);
    float low = p.z - abs(x.z) * half_size.x - abs(y.z) * half_size.y - abs(z.z) * half_size.z;
    dark = 0.42 * (1.0 - smoothstep(0.0, 1.2, low));
    gl_Position = projectionMatrix * viewMatrix * vec4(p.xy + a * at.x + b * at.y, 0.008, 1.0);
    if (dark < 0.01 || p.z < -10.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
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
