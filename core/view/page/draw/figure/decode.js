// GLSL that reads a person's record: the bytes of two frames as they came, and what motion.js adds. People slide
// from the previous frame to the next one. Lengths in m, angles in rad.
import { GAIT_STEPS } from "./motion.js";
import { STEP } from "./piles.js";
import { ACTIONS } from "./poses.js";
import { BREADTH, DEPTH, HEIGHT } from "./skeleton.js";

export const ROW = 1024; // slots in a row of the textures of records
export const FLAT_DEPTH = 0.53; // depth of a person by their breadth, where only a disc is simulated

export const DECODE = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
in uint slot;
uniform usampler2D older, newer;   // place x and y of 16 bits; heading, state, value, flags
uniform usampler2D motion;         // phase, gait or height, way and chest, each of the previous frame and the next
uniform usampler2D person;         // radius, group, breadth and depth of the torso in cm (0: a disc)
uniform usampler2D kinds;          // 256 texels: clothes of a group, action of a state
uniform sampler2D colours;
uniform vec4 olderMap, newerMap;   // x0, y0, sx, sy
#ifdef STOREYS
uniform sampler2D olderFloor, newerFloor; // m: height in the picture of the floor under people
#endif
uniform float share, classes, clock;
uniform mat4 viewMatrix, projectionMatrix;
const float TURN = 6.28318530718;

struct Person {
    vec2 at, ahead, chest, lean;
    float base;                    // height of the floor
    float half_axis, surface;      // half of the length of the torso's axis, 0 of a disc; the surface's distance from it
    vec3 size;                     // depth, breadth and height, of those of the model
    float phase, gait, way;        // of the steps; where they lead beside the chest, rad
    float height;                  // that one who lies is above the floor
    vec3 colour;
    uint action, clothes, look;    // look: random bits of this person
    bool here, lies, plays;
};

ivec2 texelOf(uint at) { return ivec2(int(at % ${ROW}u), int(at / ${ROW}u)); }
vec2 placeOf(uint bits, vec4 map) { return map.xy + map.zw * vec2(float(bits & 65535u), float(bits >> 16)); }
vec4 bytesOf(uint bits) { return vec4(float(bits & 255u), float((bits >> 8) & 255u), float((bits >> 16) & 255u), float(bits >> 24)); }

// Lean under pushes, in the direction of the push.
vec2 leanOf(float flags) {
    float code = floor(flags / 8.0), way = mod(code - 1.0, 8.0) * TURN / 8.0;
    return code < 0.5 || code > 24.5 ? vec2(0.0) : (0.1 + 0.12 * floor((code - 1.0) / 8.0)) * vec2(cos(way), sin(way));
}

// Between two 256ths of a turn on the shorter way.
float between(float a, float b, float t) { return a + t * (mod(b - a + 384.0, 256.0) - 128.0); }
vec2 wayOf(float turns) { return vec2(cos(turns * TURN / 256.0), sin(turns * TURN / 256.0)); }
float signedByte(float b) { return b > 127.5 ? b - 256.0 : b; }

uint bitsOf(uint n) {
    n = (n ^ 61u) ^ (n >> 16);
    n *= 9u;
    n ^= n >> 4;
    n *= 0x27d4eb2du;
    return n ^ (n >> 15);
}

/* A random share of a person, 0 to 1, by the number of the question. */
float chance(uint look, uint question) { return float(bitsOf(look + question * 0x9e3779b9u) & 65535u) / 65535.0; }

Person decode() {
    ivec2 texel = texelOf(slot);
    uvec2 was = texelFetch(older, texel, 0).xy, is = texelFetch(newer, texel, 0).xy;
    uvec4 moves = texelFetch(motion, texel, 0), body = texelFetch(person, texel, 0);
    vec4 before = bytesOf(was.y), info = bytesOf(is.y);
    // A slot that was empty or has another person now does not slide.
    bool another = before.y > 254.5 || mod(before.w, 2.0) != mod(info.w, 2.0);
    float t = another ? 1.0 : share;
    Person p;
    p.at = mix(placeOf(was.x, olderMap), placeOf(is.x, newerMap), t);
    p.base = 0.0;
#ifdef STOREYS
    float below = texelFetch(olderFloor, texel, 0).r, now = texelFetch(newerFloor, texel, 0).r;
    p.base = below < -1e8 ? now : mix(below, now, t);
#endif
    float heading = between(before.x, info.x, t);
    p.ahead = wayOf(heading);
    vec4 phases = bytesOf(moves.x | (moves.y << 16)), ways = bytesOf(moves.z | (moves.w << 16));
    p.phase = between(phases.x, phases.y, t) / 256.0;
    p.gait = mix(phases.z, phases.w, t) / ${GAIT_STEPS}.0;
    p.way = mix(signedByte(ways.x), signedByte(ways.y), t) * TURN / 256.0;
    bool torso = body.z > body.w;
    float radius = (body.x < 1u ? 20.0 : max(float(body.x), 5.0)) / 100.0; // 0: not told yet
    p.half_axis = torso ? float(body.z - body.w) / 200.0 : 0.0;
    p.surface = torso ? float(body.w) / 200.0 : radius;
    p.chest = torso ? wayOf(between(ways.z, ways.w, t)) : p.ahead;
    p.look = bitsOf(slot + 1u);
    float wide = 2.0 * (p.half_axis + p.surface);
    float tall = 1.72 * clamp(sqrt(wide / 0.42), 0.6, 1.08) * (0.94 + 0.12 * chance(p.look, 1u));
    p.size = vec3((torso ? 2.0 * p.surface : ${FLAT_DEPTH} * wide) / ${DEPTH}, wide / ${BREADTH}, tall / ${HEIGHT});
    float failed = mod(floor(info.w / 2.0), 2.0);
    float row = classes < 0.5 ? info.z : classes < 1.5 ? info.y : classes < 2.5 ? float(body.y)
        : classes < 3.5 ? 4.0 - failed : floor(mod(heading + 256.0, 256.0));
    p.colour = texelFetch(colours, ivec2(int(row), 0), 0).rgb;
    p.lean = mix(leanOf(before.w), leanOf(info.w), t);
    p.here = info.y < 254.5;
    p.plays = mod(floor(info.w / 4.0), 2.0) > 0.5;
    float code = floor(info.w / 8.0);
    p.lies = code > 30.5;
    p.height = p.lies ? mix(phases.z, phases.w, t) * ${STEP} : 0.0;
    p.clothes = texelFetch(kinds, ivec2(int(body.y), 0), 0).r;
    p.action = texelFetch(kinds, ivec2(int(info.y), 0), 0).g;
    // Pushed: arms before the chest. Who carries a body or holds somebody has them ahead.
    if (p.action == 0u && code > 8.5 && !p.lies) p.action = code < 24.5 ? ${ACTIONS.indexOf("brace")}u : ${ACTIONS.indexOf("carry")}u;
    return p;
}
`;

/** GLSL: where the eye is. */
export const VIEW = `
uniform vec3 eye;
uniform float flat_view;   // 1: from above, without perspective
uniform float metre;       // pixels of a metre at 1 m, or everywhere from above
vec3 towardsEye(vec3 at) {
    return flat_view > 0.5 ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : normalize(eye - at);
}
`;
