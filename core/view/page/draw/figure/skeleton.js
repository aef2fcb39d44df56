// The skeleton of the figures: 13 bones of a person 1.75 m tall who stands upright, looks along +x and has
// the left hand at +y; z is up, the floor at 0. Lengths in m, angles in rad. Poses come from poses.js.

export const HEIGHT = 1.75; // m, of the figure as it is modelled
export const BREADTH = 0.49; // m, across the arms
export const DEPTH = 0.25; // m, of the chest

/** Bones by number: a joint stands at `at` in the pose of the model, and moves with its parent. */
export const BONES = [
    { name: "pelvis", parent: -1, at: [0, 0, 0.95] },
    { name: "chest", parent: 0, at: [0, 0, 1.08] },
    { name: "head", parent: 1, at: [0, 0, 1.5] },
    { name: "thighLeft", parent: 0, at: [0, 0.09, 0.92] },
    { name: "shinLeft", parent: 3, at: [0, 0.09, 0.48] },
    { name: "footLeft", parent: 4, at: [0, 0.09, 0.08] },
    { name: "thighRight", parent: 0, at: [0, -0.09, 0.92] },
    { name: "shinRight", parent: 6, at: [0, -0.09, 0.48] },
    { name: "footRight", parent: 7, at: [0, -0.09, 0.08] },
    { name: "armLeft", parent: 1, at: [0, 0.185, 1.42] },
    { name: "foreLeft", parent: 9, at: [0, 0.197, 1.14] },
    { name: "armRight", parent: 1, at: [0, -0.185, 1.42] },
    { name: "foreRight", parent: 11, at: [0, -0.197, 1.14] },
];
export const BONE = Object.fromEntries(BONES.map((bone, i) => [bone.name, i]));

/** The bone of the other side. */
export const MIRRORED = BONES.map((bone) => BONE[bone.name.replace(/Left|Right/, (side) => (side === "Left" ? "Right" : "Left"))]);

/** Product of quaternions [x, y, z, w]: b turns first. */
export function multiply(a, b) {
    const [ax, ay, az, aw] = a, [bx, by, bz, bw] = b;
    return [
        aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz,
    ];
}

/** Turns a vector by a unit quaternion. */
export function turn(q, [x, y, z]) {
    const [a, b, c, w] = q;
    const tx = 2 * (b * z - c * y), ty = 2 * (c * x - a * z), tz = 2 * (a * y - b * x);
    return [x + w * tx + b * tz - c * ty, y + w * ty + c * tx - a * tz, z + w * tz + a * ty - b * tx];
}

/** A turn about x (roll), then y (pitch: positive brings the head forward and a leg back), then z (yaw to the left). */
export function turnOf(pitch, roll = 0, yaw = 0) {
    const cx = Math.cos(roll / 2), sx = Math.sin(roll / 2), cy = Math.cos(pitch / 2), sy = Math.sin(pitch / 2), cz = Math.cos(yaw / 2), sz = Math.sin(yaw / 2);
    return [sx * cy * cz - cx * sy * sz, cx * sy * cz + sx * cy * sz, cx * cy * sz - sx * sy * cz, cx * cy * cz + sx * sy * sz];
}

/**
 * Places the joints: `root` is the pelvis's joint, `turns` the quaternion of each bone in the figure's frame.
 * Returns the joints' positions.
 */
export function placeJoints(root, turns) {
    const joints = [];
    BONES.forEach((bone, i) => {
        if (bone.parent < 0) return void joints.push(root);
        const from = BONES[bone.parent].at, offset = turn(turns[bone.parent], bone.at.map((v, k) => v - from[k]));
        joints[i] = offset.map((v, k) => v + joints[bone.parent][k]);
        return undefined;
    });
    return joints;
}
