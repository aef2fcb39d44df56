// People: meshes in three levels of detail by distance, sprites of the same figure beyond, and the shade around their
// feet. Six draw calls for any number. Records are uploaded as they come; figure/levels.js chooses who is drawn how.
import * as THREE from "three";
import { NOBODY, PERSON } from "../net/crowd.js";
import { atlasOf, bakeAtlas, RISE, RISES } from "./figure/atlas.js";
import { makeBody } from "./figure/body.js";
import { ROW } from "./figure/decode.js";
import { elevationsSeen, Levels } from "./figure/levels.js";
import { CLOTHES } from "./figure/looks.js";
import { MESH_FRAGMENT, MESH_VERTEX } from "./figure/mesh.js";
import { Motion } from "./figure/motion.js";
import { ACTIONS, bakePoses } from "./figure/poses.js";
import { FAR_SHADE_FRAGMENT, FAR_SHADE_VERTEX, SHADE_FRAGMENT, SHADE_VERTEX } from "./figure/shadow.js";
import { SPRITE_FRAGMENT, SPRITE_VERTEX } from "./figure/sprites.js";

const PIXELS = [150, 84, 40]; // least height of people on the screen in each mesh level
// At most so many people in each mesh level; on a processor that draws by itself the least of it, and more as time allows.
const MOST = [110, 450, 1500], LEAST = [4, 16, 60];
const SPRITES = PIXELS.length; // list of those who are sprites; the next one is of all meshes
const ALL_LEVELS = Array.from({ length: RISES }, (_, level) => level); // elevations of the atlas
const ABOVE = [0.82, 0.97]; // sine of the eye's elevation between which the simulated outlines appear on the floor
const OWN_ACTS = ["brace", "carry", "lie"]; // what people do without a state that says so
const UNKNOWN = -1e9; // m: height of the floor under people of a frame who are not shown in it
const JUMP = 5; // s between two frames from which on nobody is seen to walk

export class People {
    /** `slow`: whether the processor draws the pictures. */
    constructor(slow) {
        this.slow = slow;
        this.detail = slow ? 0.1 : 1; // share of MOST that is drawn as meshes
        this.levels = new Levels(PIXELS, MOST);
        this.motion = new Motion();
        this.atlas = slow ? atlasOf(4, [20, 36]) : atlasOf(6, [32, 56]);
        this.uniforms = this.makeUniforms();
        this.capacity = 0;
        this.newest = 1; // index of the newer of the two records
        this.taken = null; // the frame of the last picture
        this.fresh = 0; // new frames since then
        this.stale = this.jumped = false; // whether any frame came since; whether time jumped
        this.baked = new Set(); // elevations that the atlas has
        this.acts = new Set(OWN_ACTS.map((name) => ACTIONS.indexOf(name))); // actions that the atlas has
        this.personVersion = -1;
        this.several = false; // whether there are storeys
        this.group = new THREE.Group();
        this.makeLayers();
        this.grow(ROW);
        this.allow();
    }

    makeUniforms() {
        const { columns, rows, phases, poses } = this.atlas, of = (value) => ({ value });
        this.kinds = integers(new Uint8Array(4 * 256), 256, THREE.RGBAIntegerFormat, THREE.UnsignedByteType);
        this.poses = posesTexture();
        return {
            older: of(null), newer: of(null), olderFloor: of(null), newerFloor: of(null), motion: of(null), person: of(null), kinds: of(this.kinds), colours: of(null), poses: of(this.poses),
            olderMap: of(new THREE.Vector4()), newerMap: of(new THREE.Vector4()), share: of(1), classes: of(1), clock: of(0),
            from: of(new THREE.Vector3()), upright: of(1), eye: of(new THREE.Vector3()), flat_view: of(0), metre: of(1), above: of(0),
            cells: of(new THREE.Vector4(columns, rows, phases, poses)), texels: of(this.atlas.cell[1]), boxes: of(null), plain: of(this.slow ? 1 : 0), least: of(this.slow ? 2.5 : 1), atlasClothes: of(null), atlasBody: of(null), atlasSurface: of(null),
        };
    }

    /** Creates a mesh for each level, one for the sprites and one for the shade. */
    makeLayers() {
        const material = (vertexShader, fragmentShader, more = {}) => new THREE.RawShaderMaterial({
            glslVersion: THREE.GLSL3, vertexShader, fragmentShader, ...more, uniforms: { ...this.uniforms, reach: { value: new THREE.Vector2() } },
        });
        const add = (of, geometry, drawn, list, order = 0) => {
            const layer = new of(geometry ? instanced(geometry) : new THREE.BufferGeometry(), drawn);
            layer.frustumCulled = false;
            layer.renderOrder = order;
            layer.visible = false; // until choose() knows who is drawn
            this.group.add(layer);
            return { layer, list };
        };
        const quad = quadGeometry(), soft = { transparent: true, depthWrite: false };
        this.bodies = PIXELS.map((_, level) => makeBody(level));
        const meshes = this.bodies.map((body, level) => add(THREE.Mesh, bodyGeometry(body), material(MESH_VERTEX, MESH_FRAGMENT), level));
        // Shades are over the floor, under all that stands on it.
        this.layers = [...meshes, add(THREE.Points, null, material(SPRITE_VERTEX, SPRITE_FRAGMENT), SPRITES),
            add(THREE.Mesh, quad, material(SHADE_VERTEX, SHADE_FRAGMENT, soft), SPRITES + 1, -0.5),
            add(THREE.Points, null, material(FAR_SHADE_VERTEX, FAR_SHADE_FRAGMENT, soft), SPRITES, -0.5)];
    }

    /** Creates room for so many slots; the next frame fills it again. */
    grow(need) {
        while (this.capacity < need) this.capacity = Math.max(ROW, 2 * this.capacity);
        for (const texture of [...(this.records ?? []), ...(this.floors ?? []), this.moves, this.persons]) texture?.dispose();
        const empty = () => new Uint32Array(2 * this.capacity).fill(NOBODY << 8);
        this.records = [0, 1].map(() => integers(empty(), ROW, THREE.RGIntegerFormat, THREE.UnsignedIntType));
        this.floors = this.several ? [0, 1].map(() => numbers(new Float32Array(this.capacity), ROW)) : null;
        this.motion.grow(this.capacity);
        this.moves = integers(new Uint16Array(this.motion.bytes.buffer), ROW, THREE.RGBAIntegerFormat, THREE.UnsignedShortType);
        this.persons = integers(new Uint8Array(PERSON * this.capacity), ROW, THREE.RGBAIntegerFormat, THREE.UnsignedByteType);
        this.uniforms.motion.value = this.moves;
        [this.uniforms.older.value, this.uniforms.newer.value] = this.records;
        this.uniforms.person.value = this.persons;
        this.levels.grow(this.capacity);
        const slots = this.levels.lists.map((list, k) => {
            const attribute = k === SPRITES ? new THREE.BufferAttribute(list, 1) : new THREE.InstancedBufferAttribute(list, 1);
            return attribute.setUsage(THREE.DynamicDrawUsage);
        });
        for (const { layer, list } of this.layers) {
            layer.geometry.dispose();
            layer.geometry.setAttribute("slot", slots[list]);
        }
        this.slots = slots;
        this.personVersion = -1;
    }

    /** Takes what groups wear and what states do, of a scene message; `several`: whether it has storeys. */
    set(scene, several) {
        if (several !== this.several) {
            this.several = several;
            for (const { layer } of this.layers) {
                layer.material.defines = several ? { STOREYS: 1 } : {};
                layer.material.needsUpdate = true;
            }
            this.grow(this.capacity);
            if (this.taken) this.fresh = 2; // both records are empty
            this.stale = this.taken !== null;
        }
        this.kinds.image.data.fill(0);
        (scene.groups ?? []).slice(0, 256).forEach((group, i) => (this.kinds.image.data[4 * i] = Math.max(0, CLOTHES.indexOf(scene.clothes?.[group.name]))));
        (scene.states ?? []).slice(0, 255).forEach((state, i) => (this.kinds.image.data[4 * i + 1] = Math.max(0, ACTIONS.indexOf(state.pose))));
        this.kinds.needsUpdate = true;
        const acts = (scene.states ?? []).map((state) => ACTIONS.indexOf(state.pose)).filter((action) => action > 0 && !this.acts.has(action));
        for (const action of acts) this.acts.add(action);
        if (acts.length > 0) this.baked.clear();
    }

    /** Notes a frame, which the next picture takes over: of a new tick, or the newest once more. */
    upload(crowd, kind) {
        const { next, previous } = crowd;
        this.stale = true;
        if (kind !== "new") return;
        this.fresh++;
        this.jumped ||= crowd.snap || next.time - previous.time > JUMP || next.time <= previous.time;
    }

    /** Takes over what came since the last picture, which may be several frames where pictures are slow. */
    takeFrames(crowd) {
        const { next, previous } = crowd, u = this.uniforms;
        if (!this.stale) return;
        const need = Math.max(next.slots, this.fresh > 1 ? previous.slots : 0);
        if (need > this.capacity) {
            this.grow(need);
            this.fresh = 2; // both records are empty
        }
        if (this.fresh > 0) {
            this.newest = 1 - this.newest;
            this.motion.take(this.taken ?? previous, next, this.jumped);
            this.moves.needsUpdate = true;
        }
        if (this.fresh > 1) this.write(1 - this.newest, previous);
        this.write(this.newest, next);
        u.newer.value = this.records[this.newest];
        u.older.value = this.records[1 - this.newest];
        if (this.floors) this.writeFloors(next, previous);
        for (const [map, of] of [[u.newerMap, next], [u.olderMap, previous]]) map.value.set(of.x0, of.y0, of.sx, of.sy);
        this.uploadPersons(crowd);
        this.taken = next;
        this.fresh = 0;
        this.stale = this.jumped = false;
    }

    /** Updates radii and groups that changed. */
    uploadPersons(crowd) {
        if (this.personVersion === crowd.personVersion) return;
        this.persons.image.data.set(crowd.person.subarray(0, PERSON * this.capacity));
        this.persons.needsUpdate = true;
        this.personVersion = crowd.personVersion;
    }

    write(which, frame) {
        const texture = this.records[which], data = new Uint8Array(texture.image.data.buffer);
        data.set(frame.bytes);
        for (let slot = frame.slots; slot < this.filled; slot++) data[8 * slot + 5] = NOBODY;
        this.filled = Math.max(this.filled ?? 0, frame.slots);
        texture.needsUpdate = true;
    }

    /** Notes that storeys are shown in another way. */
    liftAgain() {
        this.stale = true;
    }

    /** Uploads the heights of the floor under people. */
    writeFloors(next, previous) {
        const u = this.uniforms;
        for (const [which, { floors }] of [[this.newest, next], [1 - this.newest, previous]]) {
            const texture = this.floors[which], { data } = texture.image;
            for (let slot = 0; floors && slot < Math.min(data.length, floors.length); slot++) data[slot] = Number.isNaN(floors[slot]) ? UNKNOWN : floors[slot];
            texture.needsUpdate = true;
        }
        u.newerFloor.value = this.floors[this.newest];
        u.olderFloor.value = this.floors[1 - this.newest];
    }

    /** Chooses how everybody is drawn; `view`: {camera, top, metre: pixels of a metre at 1 m or everywhere, target}. */
    choose(crowd, { camera, top, metre, target }) {
        const u = this.uniforms, look = camera.matrixWorldInverse.elements, from = top ? target : camera.position;
        const matrix = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
        this.takeFrames(crowd);
        u.eye.value.copy(camera.position);
        u.from.value.copy(from);
        u.upright.value = top ? 0 : 1;
        u.flat_view.value = top ? 1 : 0;
        u.metre.value = metre;
        u.above.value = Math.min(1, Math.max(0, (look[10] - ABOVE[0]) / (ABOVE[1] - ABOVE[0])));
        this.levels.choose(crowd.next, matrix, from, metre, top);
        this.wanted = this.slow && !this.several ? elevationsSeen(top ? [1, 1, 1] : this.levels.range(from), RISE, RISES) : ALL_LEVELS;
        const { reach, counts } = this.levels;
        for (const { layer, list } of this.layers) {
            layer.material.uniforms.reach.value.set(Math.min(reach[list - 1] ?? 0, 1e9), Math.max(1e-3, Math.min(reach[list] ?? 1e9, 1e9)));
            if (list === SPRITES) layer.geometry.setDrawRange(0, counts[list]);
            else layer.geometry.instanceCount = counts[list];
            layer.visible = counts[list] > 0;
        }
        this.slots.forEach((slot, list) => { // only these are uploaded
            slot.clearUpdateRanges();
            slot.addUpdateRange(0, counts[list]);
            if (counts[list] > 0) slot.needsUpdate = true;
        });
    }

    /** Takes how long pictures take, ms: fewer people are meshes where they are slow. */
    spare(took) {
        if (took > 60) this.detail = Math.max(0.02, Math.max(0.5, 60 / took) * this.detail);
        else if (took < 25) this.detail = Math.min(1, 1.02 * this.detail + 0.001);
        this.allow();
    }

    allow() {
        this.levels.most = MOST.map((most, level) => Math.max(LEAST[level], Math.round(this.detail * most)));
    }

    /** Forgets the atlas, which went with the graphics card's memory. */
    loseAtlas() {
        this.baked.clear();
        this.target = this.uniforms.boxes.value = null;
    }

    /** Bakes the atlas of sprites as soon as somebody is one; where a processor draws, of the elevations in sight alone: all take it a second. */
    bakeIfNeeded(renderer) {
        const levels = this.levels.counts[SPRITES] === 0 ? [] : this.wanted.filter((level) => !this.baked.has(level)), u = this.uniforms;
        if (levels.length === 0) return;
        const made = this.baked.size > 0 ? { target: this.target, boxes: u.boxes.value } : null;
        const { target, boxes } = bakeAtlas(renderer, this.atlas, (this.figure ??= makeBody(this.slow ? 2 : 1, true)), { smooth: !this.slow, acts: this.acts, levels, made });
        for (const level of levels) this.baked.add(level);
        if (made) return;
        const [clothes, body, surface] = target.textures;
        this.target?.dispose();
        u.boxes.value?.dispose();
        this.target = target;
        u.boxes.value = boxes;
        u.atlasClothes.value = clothes;
        u.atlasBody.value = body;
        u.atlasSurface.value = surface;
    }
}

/** A texture of integers, `wide` texels in a row. */
function integers(data, wide, format, type) {
    const channels = { [THREE.RGIntegerFormat]: 2, [THREE.RGBAIntegerFormat]: 4 }[format];
    const texture = new THREE.DataTexture(data, wide, data.length / channels / wide, format, type);
    if (type === THREE.UnsignedIntType) texture.internalFormat = "RG32UI";
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    return texture;
}

/** A texture of numbers, `wide` texels in a row. */
function numbers(data, wide) {
    const texture = new THREE.DataTexture(data, wide, data.length / wide, THREE.RedFormat, THREE.FloatType);
    texture.needsUpdate = true;
    return texture;
}

function posesTexture() {
    const { data, width, height } = bakePoses();
    const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.HalfFloatType);
    texture.wrapS = THREE.RepeatWrapping;
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

function bodyGeometry(body) {
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(body.index, 1));
    geometry.setAttribute("position", new THREE.BufferAttribute(body.position, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(body.normal, 3));
    for (const [name, size] of [["bone", 4], ["piece", 1]]) {
        const attribute = new THREE.BufferAttribute(body[name], size);
        attribute.gpuType = THREE.IntType;
        geometry.setAttribute(name, attribute);
    }
    return geometry;
}

function quadGeometry() {
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute("corner", new THREE.BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
    return geometry;
}

/** A geometry of which instances are drawn, with the vertices of another. */
function instanced(geometry) {
    const made = new THREE.InstancedBufferGeometry();
    made.setIndex(geometry.index);
    for (const [name, attribute] of Object.entries(geometry.attributes)) made.setAttribute(name, attribute);
    return made;
}
