// The atlas of sprites: the figure of body.js drawn at start in poses and from directions into three textures,
// which hold what colour and light are computed from: the shares of parts in a pixel, its normal, and how open it is.
import * as THREE from "three";
import { PART } from "./body.js";
import { SURFACE } from "./looks.js";
import { ACTIONS, FRAMES, GAIT_COUNT, poseOf } from "./poses.js";
import { skinMesh } from "./skin.js";

export const WAYS = 8; // directions around half of the body; the other half is the mirrored pose
export const RISES = 5; // elevations: of the upright from the side to from above, of those who lie from their feet to their head
export const HALF = [0.68, 1.1]; // m: half of what a cell shows, across and up
export const MIDDLE = 0.95; // m: height of its middle
export const RISE = Math.PI / 8; // rad between elevations
const LYING_RISE = Math.PI / 6;
const EDGE = 0.04; // share of a cell around the figure that belongs to it

// Gaits whose phases the atlas has, as rows of the texture of poses; it also has one who stands, and the actions.
const WALKS = [2, 3, 5];
const SEEN = { throw: 12 }; // frame of an action that is not its first

/** Numbers of an atlas: `phases` of a gait, texels of a `cell`, `poses`, cells across and up (trousers, then robes). */
export function atlasOf(phases, cell) {
    const poses = 1 + WALKS.length * phases + ACTIONS.length - 1;
    return { phases, cell, poses, columns: WAYS * RISES, rows: 2 * poses };
}

/** Row of the texture of poses, and frame, of each pose of an atlas. */
function listPoses({ phases }) {
    const out = [[0, 0]];
    for (const gait of WALKS) for (let k = 0; k < phases; k++) out.push([gait, Math.round(((k + 0.5) * FRAMES) / phases)]);
    ACTIONS.slice(1).forEach((name, a) => out.push([GAIT_COUNT + a, SEEN[name] ?? 0]));
    return out;
}

/** Towards the eye, right and up of a column of cells, in the frame of the body; `lies`: of the row of those who lie. */
function axesOf(column, lies) {
    const yaw = (((column % WAYS) + 0.5) * Math.PI) / WAYS, level = Math.floor(column / WAYS);
    const rise = lies ? (level - 2) * LYING_RISE : level * RISE, [c, s] = [Math.cos(yaw), Math.sin(yaw)], [d, u] = [Math.cos(rise), Math.sin(rise)];
    return { eye: [c * d, s * d, u], right: [-s, c, 0], up: [-c * u, -s * u, d] };
}

const dot = (a, x, y, z) => a[0] * x + a[1] * y + a[2] * z;

/** The box of points from a direction, in halves of a cell: [x0, y0, x1, y1]. */
function boxOf(position, index, { right, up }) {
    let [x0, y0, x1, y1] = [1, 1, -1, -1];
    for (const i of index) {
        const x = position[3 * i], y = position[3 * i + 1], z = position[3 * i + 2] - MIDDLE;
        const a = dot(right, x, y, z) / HALF[0], b = dot(up, x, y, z) / HALF[1];
        x0 = Math.min(x0, a), x1 = Math.max(x1, a), y0 = Math.min(y0, b), y1 = Math.max(y1, b);
    }
    return [Math.max(-1, x0 - EDGE), Math.max(-1, y0 - EDGE), Math.min(1, x1 + EDGE), Math.min(1, y1 + EDGE)];
}

const BAKE_VERTEX = `
precision highp float;
precision highp int;
in vec3 position, normal, model; // moved by the pose; in the pose of the model
in uint part;
in vec3 eye, right, up;          // of the column: towards the eye, right and up of it
in float column, row;
uniform vec2 grid;               // cells across and up
out vec3 facing, where;
out vec2 inside;
flat out uint of;
void main() {
    vec3 at = position - vec3(0.0, 0.0, ${MIDDLE});
    inside = vec2(dot(at, right) / ${HALF[0]}, dot(at, up) / ${HALF[1]});
    facing = normal;
    where = model;
    of = part;
    gl_Position = vec4((vec2(column, row) + 0.5 + 0.5 * inside) / grid * 2.0 - 1.0, -dot(at, eye) / 4.0, 1.0);
}`;

const BAKE_FRAGMENT = `
precision highp float;
precision highp int;
in vec3 facing, where;
in vec2 inside;
flat in uint of;
layout(location = 0) out vec4 clothes;  // shares of top, sleeves, hips, legs
layout(location = 1) out vec4 body;     // of skin, hair and shoes; and of all
layout(location = 2) out vec4 surface;  // normal, and the share of the sky that is seen
` + SURFACE + `
void main() {
    if (max(abs(inside.x), abs(inside.y)) > 0.98) discard;
    uint p = of == ${PART.skirt}u ? (where.z < 0.5 ? ${PART.leg}u : ${PART.hips}u) : of;
    bool hair = p == ${PART.cover}u || (p == ${PART.head}u && hairy(where));
    clothes = vec4(p == ${PART.top}u, p == ${PART.sleeve}u, p == ${PART.hips}u, p == ${PART.leg}u);
    body = vec4(!hair && (p == ${PART.skin}u || p == ${PART.head}u), hair, p == ${PART.shoe}u, 1.0);
    surface = vec4(0.5 + 0.5 * normalize(facing), openOf(where, of));
}`;

/** Indices of the triangles of a mesh that people in trousers show, or in robes. */
function indexOf(mesh, robe) {
    const shown = (i) => (robe ? mesh.bone[4 * i + 3] !== PART.leg : mesh.piece[i] === 0), out = [];
    for (let t = 0; t < mesh.index.length; t += 3) {
        const corners = mesh.index.subarray(t, t + 3);
        if (corners.every(shown)) out.push(...corners);
    }
    return new THREE.BufferAttribute(new Uint16Array(out), 1);
}

/** Cells of a row and their axes, as attributes of instances. */
function axisAttributes(columns, lies) {
    const axes = columns.map((column) => axesOf(column, lies)), attribute = (numbers, size) => new THREE.InstancedBufferAttribute(new Float32Array(numbers), size);
    return { column: attribute(columns, 1), ...Object.fromEntries(["eye", "right", "up"].map((name) => [name, attribute(axes.flatMap((a) => a[name]), 3)])) };
}

/** A geometry of attributes, which several share. */
function geometryOf(index, attributes, instances) {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setIndex(index);
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.instanceCount = instances;
    return geometry;
}

/**
 * Bakes an atlas by a renderer from a mesh without hat and bag: {target of three textures, boxes: what figures cover of cells};
 * `smooth`: whether texels are interpolated; `acts`: numbers of the actions that anybody may do, the others are left out; `levels`: the
 * elevations to bake, which are added to those of `made` if that is given.
 */
export function bakeAtlas(renderer, atlas, mesh, { smooth, acts, levels, made = null }) {
    const { columns, rows, poses } = atlas, scene = new THREE.Scene(), { target, boxes } = made ?? emptyAtlas(atlas, smooth);
    const some = levels.flatMap((level) => Array.from({ length: WAYS }, (_, way) => WAYS * level + way)), all = Array.from({ length: columns }, (_, column) => column);
    const material = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3, vertexShader: BAKE_VERTEX, fragmentShader: BAKE_FRAGMENT, blending: THREE.NoBlending,
        uniforms: { grid: { value: new THREE.Vector2(columns, rows) } },
    });
    const parts = new THREE.BufferAttribute(mesh.bone.filter((_, i) => i % 4 === 3), 1), model = new THREE.BufferAttribute(mesh.position, 3);
    parts.gpuType = THREE.IntType;
    const outfits = [false, true].map((robe) => indexOf(mesh, robe)), [upright, lying] = [[some, false], [all, true]].map(([of, lies]) => axisAttributes(of, lies));
    listPoses(atlas).forEach(([of, frame], pose) => {
        const action = pose - WALKS.length * atlas.phases;
        const lies = pose === poses - 1, taken = lies ? all : some;
        if ((action > 0 && !acts.has(action)) || (lies && made)) return;
        const moved = skinMesh(mesh, poseOf(of, frame));
        const position = new THREE.BufferAttribute(moved.position, 3), normal = new THREE.BufferAttribute(moved.normal, 3);
        outfits.forEach((index, outfit) => {
            const row = pose + outfit * poses, ofRow = new THREE.InstancedBufferAttribute(new Float32Array([row]), 1, false, taken.length);
            const drawn = new THREE.Mesh(geometryOf(index, { position, normal, model, part: parts, row: ofRow, ...(lies ? lying : upright) }, taken.length), material);
            drawn.frustumCulled = false;
            scene.add(drawn);
            for (const column of taken) boxes.image.data.set(boxOf(moved.position, index.array, axesOf(column, lies)), 4 * (row * columns + column));
        });
    });
    drawInto(renderer, target, scene, !made);
    for (const drawn of scene.children) drawn.geometry.dispose();
    material.dispose();
    boxes.needsUpdate = true;
    return { target, boxes };
}

/** The textures of an atlas that nothing is in yet. */
function emptyAtlas({ cell, columns, rows }, smooth) {
    const target = new THREE.WebGLRenderTarget(columns * cell[0], rows * cell[1], {
        count: 3, generateMipmaps: true, depthBuffer: true,
        minFilter: smooth ? THREE.LinearMipmapNearestFilter : THREE.NearestMipmapNearestFilter, magFilter: smooth ? THREE.LinearFilter : THREE.NearestFilter,
    });
    return { target, boxes: new THREE.DataTexture(new Float32Array(4 * columns * rows), columns, rows, THREE.RGBAFormat, THREE.FloatType) };
}

/** Draws a scene into a target; `empty`: over nothing, else over what is there. */
function drawInto(renderer, target, scene, empty) {
    const colour = renderer.getClearColor(new THREE.Color()), alpha = renderer.getClearAlpha();
    renderer.setClearColor(0, 0);
    renderer.setRenderTarget(target);
    renderer.autoClear = empty;
    renderer.render(scene, new THREE.Camera());
    renderer.autoClear = true;
    renderer.setRenderTarget(null);
    renderer.setClearColor(colour, alpha);
}
