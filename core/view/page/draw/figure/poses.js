// Poses of the figures. Gaits (standing, walking, running) are cycles of FRAMES frames in which a foot on the floor
// stays where it is while the body passes over it; actions are held by arms or body. bakePoses() writes them
// into the half floats of a texture. Lengths in m, angles in rad, speeds in m/s.
import { BONE, BONES, MIRRORED, placeJoints, turnOf } from "./skeleton.js";

export const FRAMES = 32; // of a cycle, which begins as the left heel meets the floor

// Speed; length of a cycle of two steps (after Murray 1967 for walking); share of it that a foot is on the floor; height that
// it is lifted; swing of the arms and bend of the elbows; lean of the trunk; foot's pitch at its start and its end.
const GAITS = [
    { speed: 0, stride: 0, floor: 1, lift: 0, arms: 0, elbows: 0.22, trunk: 0.02, heel: 0, toe: 0 },
    { speed: 0.35, stride: 0.68, floor: 0.68, lift: 0.05, arms: 0.13, elbows: 0.24, trunk: 0.03, heel: 0.1, toe: 0.3 },
    { speed: 0.8, stride: 1.08, floor: 0.64, lift: 0.07, arms: 0.28, elbows: 0.28, trunk: 0.03, heel: 0.22, toe: 0.6 },
    { speed: 1.35, stride: 1.44, floor: 0.61, lift: 0.09, arms: 0.42, elbows: 0.34, trunk: 0.04, heel: 0.34, toe: 0.85 },
    { speed: 1.9, stride: 1.73, floor: 0.57, lift: 0.11, arms: 0.56, elbows: 0.5, trunk: 0.07, heel: 0.38, toe: 0.95 },
    { speed: 2.6, stride: 1.9, floor: 0.4, lift: 0.22, arms: 0.55, elbows: 1.35, trunk: 0.13, heel: 0.05, toe: 0.8 },
    { speed: 4, stride: 2.7, floor: 0.33, lift: 0.34, arms: 0.75, elbows: 1.5, trunk: 0.18, heel: 0, toe: 0.9 },
    { speed: 6.5, stride: 3.9, floor: 0.26, lift: 0.45, arms: 0.95, elbows: 1.55, trunk: 0.24, heel: 0, toe: 1 },
];
export const GAIT_COUNT = GAITS.length;

/** Actions by number, behind the gaits in the texture; of `arms` legs and trunk go on as the gait has them. */
export const ACTIONS = ["none", "brace", "raise", "carry", "throw", "point", "sit", "kneel", "lie"];
export const ARM_ACTIONS = 5; // actions 1 to this are of arms

const ANKLE = BONES[BONE.footLeft].at[2], SOLE = { heel: -0.06, ball: 0.12 }; // m: height of the ankle; where a foot rolls, from under it
const THIGH = BONES[BONE.thighLeft].at[2] - BONES[BONE.shinLeft].at[2], SHIN = BONES[BONE.shinLeft].at[2] - ANKLE;
const REACH = 0.998 * (THIGH + SHIN); // m: a leg is never quite straight
const STANCE = 0.075; // m from the middle to a foot

const mix = (a, b, t) => a + (b - a) * t;
const wave = (phase, shift = 0) => Math.cos(2 * Math.PI * (phase - shift));
const ease = (t) => t * t * (3 - 2 * t);

/** Returns a gait's position in the rows of GAITS for a speed, 0 to GAIT_COUNT - 1. */
export function gaitOf(speed) {
    let row = 1;
    while (row < GAITS.length - 1 && speed > GAITS[row].speed) row++;
    const [a, b] = [GAITS[row - 1], GAITS[row]];
    return row - 1 + Math.min(1, Math.max(0, (speed - a.speed) / (b.speed - a.speed)));
}

/** Returns cycles per metre at a position in the rows of GAITS; half way to the first the feet hardly move. */
export function cyclesPerMetre(gait) {
    const row = Math.min(GAITS.length - 2, Math.floor(gait)), a = GAITS[row], b = GAITS[row + 1];
    return 1 / Math.max(0.34, mix(a.stride, b.stride, gait - row));
}

/** Where the ankle of a foot is, and its pitch: {x, z, pitch}; `t` since its heel met the floor, in cycles. */
export function ankleAt(gait, t) {
    const half = 0.5 * gait.floor * gait.stride;
    const rolled = (middle, pitch) => { // about heel or ball: positive pitch lifts the heel
        const about = pitch < 0 ? SOLE.heel : SOLE.ball, c = Math.cos(pitch), s = Math.sin(pitch);
        return { x: middle + about - about * c + ANKLE * s, z: about * s + ANKLE * c, pitch };
    };
    if (gait.stride === 0) return rolled(0, 0);
    if (t < gait.floor) {
        const u = t / gait.floor, middle = half * (1 - 2 * u);
        if (u < 0.2) return rolled(middle, -gait.heel * (1 - u / 0.2));
        return rolled(middle, u < 0.55 ? 0 : gait.toe * ((u - 0.55) / 0.45) ** 2);
    }
    const u = (t - gait.floor) / (1 - gait.floor), from = rolled(-half, gait.toe), to = rolled(half, -gait.heel);
    const slow = (-gait.stride * (1 - gait.floor)) * 0.5; // the speed over the floor changes without a jerk
    const [h0, h1, h2, h3] = [2 * u ** 3 - 3 * u * u + 1, u ** 3 - 2 * u * u + u, -2 * u ** 3 + 3 * u * u, u ** 3 - u * u];
    const bell = Math.sin(Math.PI * u ** 0.8);
    return {
        x: h0 * from.x + h1 * slow + h2 * to.x + h3 * slow,
        z: mix(from.z, to.z, ease(u)) + gait.lift * bell * bell,
        pitch: mix(gait.toe + 0.4 * gait.lift * bell, -gait.heel, ease(Math.min(1, u * 1.15))),
    };
}

/** Returns the highest that a hip at `x` may be for its ankle. */
function reachOf(ankle, x) {
    return ankle.z + Math.sqrt(Math.max(0.01, REACH * REACH - (ankle.x - x) ** 2));
}

/** Pitches of thigh and shin of a leg whose hip and ankle are at points of the plane x, z; the knee bends forward. */
function bendLeg(hip, ankle) {
    const dx = ankle.x - hip.x, dz = ankle.z - hip.z, d = Math.min(REACH, Math.hypot(dx, dz));
    const straight = Math.atan2(-dx, -dz); // pitch of a straight leg
    const corner = Math.acos(Math.min(1, (THIGH * THIGH + d * d - SHIN * SHIN) / (2 * THIGH * d)));
    const knee = Math.acos(Math.max(-1, Math.min(1, (THIGH * THIGH + SHIN * SHIN - d * d) / (2 * THIGH * SHIN))));
    return { thigh: straight - corner, shin: straight - corner + Math.PI - knee };
}

/** Pelvis of a gait over the cycle: heights that both legs on the floor reach, smoothed. */
function pelvisHeights(gait) {
    const hang = BONES[0].at[2] - BONES[BONE.thighLeft].at[2], N = FRAMES;
    const least = Array.from({ length: N }, (_, f) => {
        const legs = [0, 0.5].map((shift) => {
            const t = (f / N + shift) % 1, ankle = ankleAt(gait, t);
            return reachOf(ankle, 0.03 * wave(t)) + (t > gait.floor && gait.floor < 0.5 ? 0.05 : 0);
        });
        return Math.min(0.935, ...legs) + hang;
    });
    const wide = 3, lowest = least.map((_, f) => Math.min(...Array.from({ length: 2 * wide + 1 }, (__, k) => least[(f + k - wide + N) % N])));
    const flight = gait.floor < 0.5 ? 0.025 : 0; // runners fly between steps
    return lowest.map((_, f) => {
        let sum = 0;
        for (let k = -wide; k <= wide; k++) sum += lowest[(f + k + N) % N];
        return sum / (2 * wide + 1) - flight * (1 + wave((2 * f) / N, gait.floor)) * 0.5;
    });
}

/** The frame `f` of a gait: {root, turns}. */
function poseOfGait(gait, f, heights) {
    const phase = f / FRAMES, turns = [], still = gait.stride === 0;
    const sway = still ? 0.012 * Math.sin(2 * Math.PI * phase) : 0.02 * Math.sin(2 * Math.PI * (phase - 0.04)) / (1 + gait.speed / 3);
    const yaw = still ? 0 : -0.11 * Math.min(1, gait.speed) * wave(phase);
    const root = [gait.trunk * -0.1, sway, still ? BONES[0].at[2] + 0.002 : heights[f]];
    turns[BONE.pelvis] = turnOf(0.4 * gait.trunk, 0, yaw);
    turns[BONE.chest] = turnOf(gait.trunk + (still ? 0.012 * wave(2 * phase) : 0), 0, -0.9 * yaw);
    turns[BONE.head] = turnOf(0.3 * gait.trunk, 0, -0.2 * yaw);
    const joints = placeJoints(root, BONES.map((_, i) => turns[i] ?? [0, 0, 0, 1]));
    for (const [side, shift, sign] of [["Left", 0, 1], ["Right", 0.5, -1]]) {
        const hip = joints[BONE[`thigh${side}`]], ankle = ankleAt(gait, (phase + shift) % 1);
        const { thigh, shin } = bendLeg({ x: hip[0], z: hip[2] }, ankle);
        const roll = Math.atan2(sign * (still ? 0.1 : STANCE) - hip[1], hip[2] - ankle.z), out = sign * 0.1;
        turns[BONE[`thigh${side}`]] = turnOf(thigh, roll);
        turns[BONE[`shin${side}`]] = turnOf(shin, roll);
        turns[BONE[`foot${side}`]] = turnOf(ankle.pitch, 0, out);
        const swing = gait.arms * wave(phase + shift), ahead = 0.5 - 0.5 * wave(phase + shift);
        const arm = swing + 0.04 + (gait.elbows > 1 ? 0.15 : 0.02);
        turns[BONE[`arm${side}`]] = turnOf(arm, sign * (0.03 + 0.02 * gait.elbows), 0);
        turns[BONE[`fore${side}`]] = turnOf(arm - gait.elbows * (0.75 + 0.5 * ahead) , sign * 0.02, -sign * 0.25 * Math.min(1, gait.elbows));
    }
    return { root, turns };
}

/** Arms of an action: pitch, roll and yaw of the left upper arm and forearm; the right ones are mirrored or given. */
const ARMS = {
    brace: () => ({ arm: [-0.75, 0.1, -0.35], fore: [-2.3, 0, -0.5] }),
    raise: (f) => ({ arm: [-2.75 + 0.12 * wave((2 * f) / FRAMES), 0.28, 0], fore: [-3.0 + 0.3 * wave((2 * f) / FRAMES), 0.1, 0] }),
    carry: () => ({ arm: [-0.25, 0.08, 0], fore: [-1.45, 0, -0.35] }),
    throw: (f) => {
        const t = f / FRAMES, back = t < 0.5 ? ease(t / 0.5) : 1 - ease(Math.min(1, (t - 0.5) / 0.2));
        return { arm: [-1.1 * back - 0.2, 0.1, 0], fore: [-1.3 * back - 0.5, 0, 0],
            right: { arm: [mix(-1.3, -2.6, back), -0.5 * back, 0], fore: [mix(-1.4, -4.1, back), -0.3 * back, 0] } };
    },
    point: () => ({ arm: [0.05, 0.05, 0], fore: [-0.25, 0.02, -0.1], right: { arm: [-1.5, -0.05, 0], fore: [-1.55, 0, 0] } }),
};

/** Changes a standing pose to one of an action. */
function poseOfAction(name, f) {
    const pose = poseOfGait(GAITS[0], f, null), { turns } = pose;
    const both = (bone, pitch, roll = 0, yaw = 0) => {
        turns[BONE[`${bone}Left`]] = turnOf(pitch, roll, yaw);
        turns[BONE[`${bone}Right`]] = turnOf(pitch, -roll, -yaw);
    };
    if (ARMS[name]) {
        const { arm, fore, right } = ARMS[name](f);
        both("arm", ...arm);
        both("fore", ...fore);
        if (right) {
            turns[BONE.armRight] = turnOf(...right.arm);
            turns[BONE.foreRight] = turnOf(...right.fore);
        }
    } else if (name === "sit") {
        pose.root = [-0.1, 0, 0.49];
        both("thigh", -1.5, 0.08);
        both("shin", 0.05, 0.02);
        both("foot", 0);
        both("arm", -0.35, 0.1);
        both("fore", -1.25, 0, -0.2);
    } else if (name === "kneel") {
        pose.root = [-0.12, 0, 0.34];
        both("thigh", -1.15, 0.1);
        both("shin", 1.5, 0.05);
        both("foot", 1.5);
        both("arm", -0.3, 0.08);
        both("fore", -1.0, 0, -0.3);
    } else if (name === "lie") {
        both("arm", 0.05, 0.5);
        both("fore", -0.3, 0.35);
        both("thigh", -0.12, 0.14);
        both("shin", 0.18, 0.1);
        both("foot", 0.5, 0, 0.4);
    }
    return pose;
}

/** The pose of a row (gaits, then actions without "none") and frame: {turns, joints} by bone. */
export function poseOf(row, f) {
    const pose = row < GAITS.length ? poseOfGait(GAITS[row], f, heightsOf(row)) : poseOfAction(ACTIONS[row - GAITS.length + 1], f);
    return { turns: pose.turns, joints: placeJoints(pose.root, pose.turns) };
}
const known = [];
const heightsOf = (row) => (known[row] ??= pelvisHeights(GAITS[row]));

export const ROWS = GAITS.length + ACTIONS.length - 1;
export { GAITS };

const number = new Float32Array(1), numberBits = new Uint32Array(number.buffer);

/** A number as the bits of a half float; |value| < 65504. */
export function toHalf(value) {
    number[0] = value;
    const bits = numberBits[0], exponent = ((bits >>> 23) & 255) - 112;
    const sign = (bits >>> 16) & 0x8000;
    if (exponent <= 0) return exponent < -10 ? sign : sign | (((bits & 0x7fffff) | 0x800000) >>> (14 - exponent));
    return sign | ((exponent << 10) + (((bits & 0x7fffff) + 0x1000) >>> 13));
}

/**
 * Bakes all poses: {data: Uint16Array of half floats, width, height}. A texel row has the frames of a bone in a row of
 * poses, at (bone * ROWS + row): its quaternion; the same rows above have its joint. Neighbours have quaternions of one sign, so
 * that the graphics card may interpolate between frames, and between gaits.
 */
export function bakePoses() {
    const width = FRAMES, block = BONES.length * ROWS, height = 2 * block, data = new Uint16Array(4 * width * height);
    for (let row = 0; row < ROWS; row++) {
        let before = null;
        for (let f = 0; f < FRAMES; f++) {
            const { turns, joints } = poseOf(row, f);
            for (let bone = 0; bone < BONES.length; bone++) {
                const at = 4 * ((bone * ROWS + row) * width + f), q = turns[bone], p = before?.[bone] ?? [0, 0, 0, 1];
                const sign = q[0] * p[0] + q[1] * p[1] + q[2] * p[2] + q[3] * p[3] < 0 ? -1 : 1;
                for (let k = 0; k < 4; k++) data[at + k] = toHalf((q[k] *= sign));
                for (let k = 0; k < 3; k++) data[at + 4 * width * block + k] = toHalf(joints[bone][k]);
            }
            before = turns;
        }
    }
    return { data, width, height };
}

/** Mirrors a pose: the left becomes the right. For the tests. */
export function mirrorPose({ turns, joints }) {
    return {
        turns: MIRRORED.map((other) => [-turns[other][0], turns[other][1], -turns[other][2], turns[other][3]]),
        joints: MIRRORED.map((other) => [joints[other][0], -joints[other][1], joints[other][2]]),
    };
}
