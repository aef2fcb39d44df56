// Shaders of the shade that people cast on the floor: where their feet are, and away from the sun. Seen from above it has the
// outline that is simulated, in the person's colour. A quad each near the eye; a point each where they are sprites.
import { SUN } from "../light.js";
import { DECODE, VIEW } from "./decode.js";

const CAST = [-SUN[0] / SUN[2], -SUN[1] / SUN[2]], LONG = Math.hypot(...CAST); // m of shadow of a metre of height
const SHADOW = 0.75; // of it are drawn, as the shadow fades

const COMMON = DECODE + VIEW + `
uniform float plain;        // 1: only the shade at the feet
out vec2 ground;            // m from the person's middle
flat out vec4 axis;         // half of the torso's axis; its radius; height by that of the model
flat out vec4 body;         // to the head of one who lies; whether; whether it is a player
flat out vec3 tint;
const vec2 ALONG = vec2(${CAST.map((v) => (v / LONG).toFixed(5)).join(", ")}), ACROSS = vec2(-ALONG.y, ALONG.x);

/* The box around the shade along the light and across: nearest, farthest, half across. */
vec3 spread(Person p) {
    axis = vec4(p.half_axis * vec2(-p.chest.y, p.chest.x), p.surface, p.size.z);
    body = vec4(p.ahead * 0.6 * p.size.z, p.lies ? 1.0 : 0.0, p.plays ? 1.0 : 0.0);
    tint = p.colour;
    float reach = p.lies ? 1.1 : p.half_axis + p.surface + 0.16;
    return vec3(-reach, p.lies || plain > 0.5 ? reach : ${(SHADOW * LONG).toFixed(4)} * p.size.z + 0.3, reach);
}
`;

export const SHADE_VERTEX = COMMON + `
in vec2 corner;
void main() {
    Person p = decode();
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    if (!p.here) return;
    vec3 box = spread(p);
    ground = ALONG * mix(box.x, box.y, 0.5 + 0.5 * corner.x) + ACROSS * corner.y * box.z;
    gl_Position = projectionMatrix * viewMatrix * vec4(p.at + ground, p.base + 0.012, 1.0);
}`;

export const FAR_SHADE_VERTEX = COMMON + `
uniform float least;        // pixels of a radius below which there is no shade
flat out mat2 across;       // from the point's pixels to the box on the floor, m
flat out vec2 middle;
void main() {
    Person p = decode();
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    if (!p.here) return;
    vec3 box = spread(p);
    middle = 0.5 * (box.x + box.y) * ALONG;
    vec4 seen = viewMatrix * vec4(p.at + middle, p.base + 0.012, 1.0);
    vec4 clip = projectionMatrix * seen;
    float pixels = metre / clip.w;
    if (pixels * p.surface < least) return;
    vec3 a = (viewMatrix * vec4(ALONG, 0.0, 0.0)).xyz, b = (viewMatrix * vec4(ACROSS, 0.0, 0.0)).xyz;
    vec2 tilt = flat_view > 0.5 ? vec2(0.0) : seen.xy / -seen.z;
    vec2 u = pixels * 0.5 * (box.y - box.x) * (a.xy + a.z * tilt), v = pixels * box.z * (b.xy + b.z * tilt);
    gl_PointSize = 2.0 * max(abs(u.x) + abs(v.x), abs(u.y) + abs(v.y));
    mat2 screen = mat2(u, v);
    if (abs(determinant(screen)) < 0.05) return;
    across = mat2(ALONG * 0.5 * (box.y - box.x), ACROSS * box.z) * inverse(screen) * gl_PointSize;
    gl_Position = clip;
}`;

const SHADE = `
const vec2 CAST = vec2(${CAST.map((v) => v.toFixed(5)).join(", ")});
float awayFrom(vec2 at, vec2 a, vec2 b) {
    vec2 way = b - a;
    return distance(at, a + way * clamp(dot(at - a, way) / max(dot(way, way), 1e-6), 0.0, 1.0));
}
vec4 shadeAt(vec2 at, float soften) {
    float radius = axis.z, d = awayFrom(at, -axis.xy, axis.xy), dark;
    vec3 colour = vec3(0.04, 0.05, 0.08);
    if (body.z > 0.5) return vec4(colour, 0.5 * (1.0 - smoothstep(0.05, 0.34, awayFrom(at, -body.xy, body.xy))));
    dark = 0.46 * (1.0 - smoothstep(0.3 * radius, radius + 0.1, d));
    if (plain < 0.5) {
        vec2 far = ${SHADOW} * CAST * axis.w;
        float t = clamp(dot(at, far) / dot(far, far), 0.0, 1.0), wide = mix(0.14, 0.22, t), soft = mix(0.05, 0.12, t);
        dark = 1.0 - (1.0 - dark) * (1.0 - 0.24 * (1.0 - smoothstep(wide - soft, wide + soft, awayFrom(at, vec2(0.0), far))) * (1.0 - 0.6 * t));
    }
    if (above > 0.0) { // the disc or the capsule
        float inside = 1.0 - smoothstep(-soften, soften, d - radius), edge = inside * smoothstep(-2.5 * soften - 0.01, -soften - 0.01, d - radius);
        float cover = above * max(0.55 * inside, 0.9 * edge);
        colour = mix(colour, tint * mix(0.95, 0.6, edge), cover / max(cover + dark * (1.0 - cover), 1e-3));
        dark = cover + dark * (1.0 - cover);
    }
    if (body.w > 0.5) {
        float ring = 1.0 - smoothstep(0.025, 0.03 + soften, abs(d - radius - 0.08));
        colour = mix(colour, vec3(1.0), ring);
        dark = max(dark, 0.95 * ring);
    }
    return vec4(colour, dark);
}
`;

const INPUTS = `
precision highp float;
uniform float above, plain; // above: 1 where seen from above
flat in vec4 axis, body;
flat in vec3 tint;
out vec4 drawn;
`;

export const SHADE_FRAGMENT = INPUTS + SHADE + `
in vec2 ground;
void main() {
    drawn = shadeAt(ground, fwidth(ground.x) + fwidth(ground.y));
    if (drawn.a < 0.004) discard;
}`;

export const FAR_SHADE_FRAGMENT = INPUTS + SHADE + `
flat in mat2 across;
flat in vec2 middle;
void main() {
    vec2 at = across * (vec2(gl_PointCoord.x, 1.0 - gl_PointCoord.y) - 0.5);
    drawn = shadeAt(middle + at, 0.03);
    if (drawn.a < 0.004) discard;
}`;
