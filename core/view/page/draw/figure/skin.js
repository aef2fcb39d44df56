// Moves the vertices of body.js by a pose of poses.js, as the shader of mesh.js does on the graphics card: for the atlas of
// sprites, and for the tests.
import { BONES, turn } from "./skeleton.js";

/** Moves a point (or, `normal`, a direction) of the model by one bone of a pose. */
function moveBy(pose, bone, v, normal) {
    const from = BONES[bone].at, to = pose.joints[bone];
    if (normal) return turn(pose.turns[bone], v);
    return turn(pose.turns[bone], v.map((c, k) => c - from[k])).map((c, k) => c + to[k]);
}

/** Positions and normals of a mesh in a pose: {position, normal: Float32Array}. */
export function skinMesh(mesh, pose) {
    const count = mesh.piece.length, position = new Float32Array(3 * count), normal = new Float32Array(3 * count);
    for (let i = 0; i < count; i++) {
        const [a, b, share] = mesh.bone.subarray(4 * i, 4 * i + 3), t = a === b ? 0 : share / 255;
        for (const [to, from, isNormal] of [[position, mesh.position, false], [normal, mesh.normal, true]]) {
            const v = [from[3 * i], from[3 * i + 1], from[3 * i + 2]], p = moveBy(pose, a, v, isNormal);
            const q = t > 0 ? moveBy(pose, b, v, isNormal) : p;
            for (let k = 0; k < 3; k++) to[3 * i + k] = p[k] + t * (q[k] - p[k]);
        }
    }
    return { position, normal };
}
