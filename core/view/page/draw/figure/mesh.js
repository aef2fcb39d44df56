// Shaders of people as meshes: bones from the texture of poses move the vertices of body.js, scaled to the torso that is
// simulated. Atlas and picture use the same functions, so that sprites look like the meshes.
import { LIGHT } from "../light.js";
import { PART, PIECE } from "./body.js";
import { DECODE } from "./decode.js";
import { BAND } from "./levels.js";
import { LOOKS, SURFACE } from "./looks.js";
import { ARM_ACTIONS, FRAMES, GAIT_COUNT, ROWS } from "./poses.js";
import { BONE, BONES } from "./skeleton.js";

const float = (v) => (Number.isInteger(v) ? `${v}.0` : String(v));

/** GLSL: moves a vertex by bones. */
export const SKIN = `
uniform sampler2D poses;
const vec3 JOINTS[${BONES.length}] = vec3[](${BONES.map((bone) => `vec3(${bone.at.map(float).join(", ")})`).join(", ")});
const float BLOCK = ${BONES.length * ROWS}.0;
const int LIE = ${ROWS - 1};

vec3 spun(vec3 v, vec4 q) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec4 boneAt(uint bone, float row, float phase, float block) {
    return textureLod(poses, vec2(phase + ${float(0.5 / FRAMES)}, (block + float(bone) * ${ROWS}.0 + row + 0.5) / (2.0 * BLOCK)), 0.0);
}

// How somebody holds themselves: the rows of legs and arms in the texture of poses, and turns of head and legs.
struct Stance { float row, phase, armRow, armPhase, head, legs; };

/* Moves a point of a bone, \`at\` and \`n\` in the pose of the model; size: depth, breadth, height. */
void moveBone(uint bone, Stance s, vec3 size, vec3 at, vec3 n, out vec3 place, out vec3 facing) {
    bool arm = bone >= ${BONE.armLeft}u;
    bool held = arm && s.armRow >= 0.0;
    float row = held ? s.armRow : s.row, phase = held ? s.armPhase : s.phase;
    vec4 q = normalize(boneAt(bone, row, phase, 0.0));
    vec3 joint = boneAt(bone, row, phase, BLOCK).xyz;
    if (held) joint += boneAt(${BONE.chest}u, s.row, s.phase, BLOCK).xyz - boneAt(${BONE.chest}u, row, phase, BLOCK).xyz;
    float thick = mix(size.y, size.z, 0.5);
    vec3 scale = bone <= ${BONE.chest}u ? size : bone == ${BONE.head}u ? vec3(mix(size.z, 1.0, 0.3)) : arm ? vec3(thick, size.y, size.z) : vec3(thick, thick, size.z);
    vec3 o = (at - JOINTS[bone]) * scale;
    n /= scale;
    if (bone == ${BONE.head}u) {
        float c = cos(s.head), d = sin(s.head);
        o.xy = vec2(c * o.x - d * o.y, d * o.x + c * o.y);
        n.xy = vec2(c * n.x - d * n.y, d * n.x + c * n.y);
    }
    place = joint * vec3(size.z, size.y, size.z) + spun(o, q);
    facing = spun(n, q);
    if (bone >= ${BONE.thighLeft}u && bone <= ${BONE.footRight}u || bone == ${BONE.pelvis}u) {
        float turn = bone == ${BONE.pelvis}u ? 0.6 * s.legs : s.legs, c = cos(turn), d = sin(turn);
        place.xy = vec2(c * place.x - d * place.y, d * place.x + c * place.y);
        facing.xy = vec2(c * facing.x - d * facing.y, d * facing.x + c * facing.y);
    }
}

/* Moves a vertex by both of its bones. */
void moveVertex(uvec4 bone, Stance s, vec3 size, vec3 at, vec3 n, out vec3 place, out vec3 facing) {
    moveBone(bone.x, s, size, at, n, place, facing);
    if (bone.z > 0u && bone.y != bone.x) {
        vec3 p, f;
        moveBone(bone.y, s, size, at, n, p, f);
        float t = float(bone.z) / 255.0;
        place = mix(place, p, t);
        facing = mix(facing, f, t);
    }
    facing = normalize(facing);
}

/* Shortens a robe to a skirt, in the pose of the model. */
vec3 shortened(vec3 at, uint piece, bool skirt) {
    if (piece == ${PIECE.skirt}u && skirt && at.z < 0.96) {
        at.z = 0.96 - 0.55 * (0.96 - at.z);
        at.xy *= 0.94;
    }
    return at;
}
`;

/** GLSL: the stance of a person. */
export const STANCE = `
float turnBetween(vec2 from, vec2 to) { return atan(from.x * to.y - from.y * to.x, dot(from, to)); }
Stance stanceOf(Person p) {
    Stance s = Stance(p.gait, p.phase, -1.0, 0.0, clamp(turnBetween(p.chest, p.ahead), -1.2, 1.2), p.way);
    if (p.action > 0u) {
        float row = ${GAIT_COUNT - 1}.0 + float(p.action), phase = fract(clock * 0.8 + chance(p.look, 20u));
        if (p.action <= ${ARM_ACTIONS}u) {
            s.armRow = row;
            s.armPhase = phase;
        } else {
            s.row = row;
            s.phase = phase;
            s.legs = 0.0;
        }
    }
    if (p.lies) s = Stance(float(LIE), 0.0, -1.0, 0.0, 0.0, 0.0);
    return s;
}
`;

/** GLSL: which pixels a level draws where it fades into others: those whose threshold is in \`kept\`. */
export const FADE = `
flat in vec2 kept;
void fade() {
    uvec2 p = uvec2(gl_FragCoord.xy) & 3u;
    uint x = p.x ^ p.y;
    float threshold = (float(((x & 1u) << 3) | ((p.y & 1u) << 2) | (x & 2u) | ((p.y & 2u) >> 1)) + 0.5) / 16.0;
    if (threshold < kept.x || threshold >= kept.y) discard;
}
`;

/** GLSL: \`kept\` of a level by the distance of a person; \`reach\`: where this level and the one before it end, m. */
export const KEEP = `
uniform vec3 from;          // that distances are from
uniform float upright;      // 0: only distances on the floor count
uniform vec2 reach;
flat out vec2 kept;
void keep(vec2 at, float base) {
    float d = length(vec3(at - from.xy, upright * (0.9 + base - from.z)));
    kept = vec2(smoothstep(${float(1 - BAND)} * reach.y, reach.y, d), reach.x > 0.0 ? smoothstep(${float(1 - BAND)} * reach.x, reach.x, d) : 1.0);
    if (kept.y >= 1.0) kept.y = 2.0;
}
`;

/** GLSL: the frame of somebody's body in the world: front, left and up, leaning or lying. */
export const AXES = `
void axesOf(Person p, out vec3 front, out vec3 left, out vec3 up) {
    vec2 chest = p.lies ? p.ahead : p.chest;
    front = vec3(chest, 0.0);
    left = vec3(-chest.y, chest.x, 0.0);
    up = vec3(p.lean, 1.0 - 0.5 * dot(p.lean, p.lean));
    if (p.lies) { // the head ahead, on the back or on the front
        up = front;
        front = vec3(0.0, 0.0, chance(p.look, 21u) < 0.6 ? 1.0 : -1.0);
        left = cross(up, front);
    }
}
vec3 originOf(Person p, vec3 up) {
    return p.lies ? vec3(p.at, p.base + 0.14 + p.height) - 0.875 * p.size.z * up : vec3(p.at, p.base);
}
`;

export const MESH_VERTEX = DECODE + LOOKS + SKIN + STANCE + AXES + KEEP + `
in vec3 position, normal;
in uvec4 bone;              // first and second bone, share of the second in 255ths, part
in uint piece;
out vec3 facing, paint, hair, where;
flat out uint part;
void main() {
    Person p = decode();
    Outfit o = dress(p.look, p.clothes, p.colour, p.plays, classes);
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    keep(p.at, p.base);
    if (!p.here || !wears(o, piece, bone.w) || kept.x >= 1.0 || kept.y <= 0.0) return;
    part = bone.w;
    paint = paintOf(o, part);
    hair = o.hair;
    where = position;
    vec3 c, n, front, left, up;
    moveVertex(bone, stanceOf(p), p.size, shortened(position, piece, o.skirt), normal, c, n);
    axesOf(p, front, left, up);
    facing = front * n.x + left * n.y + up * n.z;
    gl_Position = projectionMatrix * viewMatrix * vec4(originOf(p, up) + front * c.x + left * c.y + up * c.z, 1.0);
}`;

export const MESH_FRAGMENT = `
precision highp float;
precision highp int;
in vec3 facing, paint, hair, where;
flat in uint part;
out vec4 drawn;
` + FADE + LIGHT + SURFACE + `
void main() {
    fade();
    vec3 colour = part == ${PART.head}u && hairy(where) ? hair : paint;
    if (part == ${PART.head}u) colour = mix(colour, vec3(0.07, 0.05, 0.05), 0.85 * eyeAt(where));
    drawn = vec4(lit(colour, normalize(facing), openOf(where, part)), 1.0);
}`;
