// People: everyone as a point, those near the eye as figures, and the shade around their feet. Three
// draw calls for any number.
import * as THREE from "three";
import { NOBODY, PERSON } from "../net/crowd.js";
import { makeFigure } from "./figure.js";
import { FIGURE_FRAGMENT, FIGURE_VERTEX, POINT_FRAGMENT, POINT_VERTEX, SHADE_FRAGMENT, SHADE_VERTEX } from "./shaders.js";

const FIGURES = 4608; // at most; a little more than are chosen, for the margin
const MARGIN = 0.4; // m: people in this margin are drawn as both, so that nobody is missing between two frames
const RINGS = 128; // rings around the camera, of equal area
const FIGURE_PIXELS = 20; // people who are taller on the screen are drawn as figures

export class People {
    /** `most`: people drawn as figures, at most. */
    constructor(most) {
        this.uniforms = {
            mapA: { value: new THREE.Vector4() }, mapB: { value: new THREE.Vector4() },
            share: { value: 1 }, swapped: { value: 0 }, classes: { value: 1 },
            colours: { value: null }, pixels: { value: 1 }, tall: { value: 0 },
            nearer: { value: 0 }, eye: { value: new THREE.Vector3() }, passed: { value: 1 }, clock: { value: 0 },
        };
        this.most = most; // fewer where drawing is slow
        this.capacity = 0;
        this.counts = new Uint32Array(RINGS);
        this.newest = 1; // index of the newer of the two buffers
        this.personVersion = -1;
        this.group = new THREE.Group();
        this.makeFigures();
        this.grow(1024);
    }

    material(vertexShader, fragmentShader, more = {}) {
        return new THREE.RawShaderMaterial({ uniforms: this.uniforms, vertexShader, fragmentShader, ...more });
    }

    /** Creates buffers for so many slots; the next frame fills them again. */
    grow(slots) {
        while (this.capacity < slots) this.capacity = Math.max(1024, 2 * this.capacity);
        if (this.points) {
            this.group.remove(this.points, this.shades);
            this.points.geometry.dispose();
        }
        const empty = () => new Uint8Array(8 * this.capacity).fill(NOBODY);
        this.buffers = [0, 1].map(() => new THREE.InterleavedBuffer(empty(), 8));
        this.persons = new THREE.BufferAttribute(new Uint8Array(PERSON * this.capacity), PERSON);
        const geometry = new THREE.BufferGeometry();
        setRecords(geometry, this.buffers);
        geometry.setAttribute("person", this.persons);
        this.chests = [0, 1].map(() => new THREE.BufferAttribute(new Uint8Array(this.capacity), 1));
        setChests(geometry, this.chests);
        this.looks = Uint8Array.from({ length: this.capacity }, (_, slot) => lookOf(slot));
        geometry.setAttribute("look", new THREE.BufferAttribute(this.looks, 1));
        for (const buffer of [...this.buffers, ...this.chests]) buffer.setUsage(THREE.DynamicDrawUsage);
        this.points = new THREE.Points(geometry, this.pointMaterial ??= this.material(POINT_VERTEX, POINT_FRAGMENT));
        this.points.frustumCulled = false;
        this.shades = new THREE.Points(geometry, this.shadeMaterial ??= this.material(SHADE_VERTEX, SHADE_FRAGMENT, {
            transparent: true, depthWrite: false,
        }));
        this.shades.frustumCulled = false;
        this.shades.renderOrder = -0.5; // over the floor, under all that stands on it
        this.group.add(this.shades, this.points);
        this.personVersion = -1;
    }

    makeFigures() {
        const figure = makeFigure();
        const geometry = new THREE.InstancedBufferGeometry();
        geometry.setIndex(new THREE.BufferAttribute(figure.index, 1));
        geometry.setAttribute("corner", new THREE.BufferAttribute(figure.corner, 3));
        geometry.setAttribute("normal", new THREE.BufferAttribute(figure.normal, 3));
        geometry.setAttribute("swing", new THREE.BufferAttribute(figure.swing, 3));
        this.near = [0, 1].map(() => new THREE.InstancedInterleavedBuffer(new Uint8Array(8 * FIGURES), 8));
        this.nearPersons = new THREE.InstancedBufferAttribute(new Uint8Array(PERSON * FIGURES), PERSON);
        setRecords(geometry, this.near);
        geometry.setAttribute("person", this.nearPersons);
        this.nearChests = [0, 1].map(() => new THREE.InstancedBufferAttribute(new Uint8Array(FIGURES), 1));
        setChests(geometry, this.nearChests);
        this.nearLooks = new THREE.InstancedBufferAttribute(new Uint8Array(FIGURES), 1);
        geometry.setAttribute("look", this.nearLooks);
        for (const buffer of [...this.near, ...this.nearChests]) buffer.setUsage(THREE.DynamicDrawUsage);
        this.figures = new THREE.Mesh(geometry, this.material(FIGURE_VERTEX, FIGURE_FRAGMENT));
        this.figures.frustumCulled = false;
        this.group.add(this.figures);
    }

    /** Uploads a frame: into the older buffer if it is a new tick, else over the newest. */
    upload(crowd, kind) {
        const frame = crowd.next;
        if (frame.slots > this.capacity) {
            this.grow(frame.slots);
            this.write(this.newest, crowd.previous);
        }
        if (kind === "new") this.newest = 1 - this.newest;
        this.write(this.newest, frame);
        this.uniforms.passed.value = Math.max(1e-3, frame.time - crowd.previous.time);
        this.uniforms.swapped.value = this.newest === 0 ? 1 : 0;
        this.points.geometry.setDrawRange(0, frame.slots);
        this.uploadPersons(crowd);
    }

    /** Updates radii and groups that changed. */
    uploadPersons(crowd) {
        if (this.personVersion === crowd.personVersion) return;
        this.persons.array.set(crowd.person.subarray(0, PERSON * this.capacity));
        this.persons.needsUpdate = true;
        this.personVersion = crowd.personVersion;
    }

    write(which, frame) {
        const buffer = this.buffers[which];
        buffer.array.set(frame.bytes);
        buffer.clearUpdateRanges();
        buffer.addUpdateRange(0, frame.bytes.length);
        if (frame.slots > 0) buffer.needsUpdate = true;
        if (frame.chests) {
            this.chests[which].array.set(frame.chests);
            this.chests[which].needsUpdate = true;
        }
        this.uniforms[which === 0 ? "mapA" : "mapB"].value.set(frame.x0, frame.y0, frame.sx, frame.sy);
    }

    /** Chooses who is drawn as a figure: the nearest to `eye` (m) who are tall enough on the screen. */
    chooseNear(crowd, eye, pixels, top) {
        const u = this.uniforms, frame = crowd.next;
        u.eye.value.copy(eye);
        const reach = top ? 0 : this.reachOf(frame, eye, (1.7 * pixels) / FIGURE_PIXELS);
        const count = reach > 0 ? this.collect(crowd, eye, reach) : 0;
        this.figures.geometry.instanceCount = count;
        this.figures.visible = count > 0 && frame !== null;
        u.nearer.value = count > 0 ? reach : 0;
        for (const [buffer, size] of [[this.near[0], 8], [this.near[1], 8], [this.nearPersons, PERSON], [this.nearLooks, 1],
            [this.nearChests[0], 1], [this.nearChests[1], 1]]) {
            buffer.clearUpdateRanges();
            buffer.addUpdateRange(0, size * count);
            if (count > 0) buffer.needsUpdate = true;
        }
    }

    /** Returns the distance (m), at most `furthest`, within which all people may be figures. */
    reachOf(frame, eye, furthest) {
        const rise = eye.z - 0.85, flat = furthest * furthest - rise * rise;
        if (flat <= 0) return 0;
        const { words, bytes, x0, y0, sx, sy } = frame, counts = this.counts.fill(0), perRing = RINGS / flat;
        for (let slot = 0, w = 0; slot < frame.slots; slot++, w += 4) {
            const dx = x0 + sx * words[w] - eye.x, dy = y0 + sy * words[w + 1] - eye.y, d = dx * dx + dy * dy;
            if (d < flat && bytes[2 * w + 5] !== NOBODY) counts[(d * perRing) | 0]++;
        }
        let ring = 0;
        for (let sum = 0; ring < RINGS; ring++) {
            sum += counts[ring];
            if (sum > this.most) break;
        }
        return ring === 0 ? 0 : Math.sqrt((ring / RINGS) * flat + rise * rise);
    }

    /** Copies the records of those within `reach` m; returns how many there are. */
    collect(crowd, eye, reach) {
        const b = crowd.next, a = crowd.previous, person = crowd.person;
        const { words, bytes, x0, y0, sx, sy } = b;
        const newer = this.near[this.newest].array, older = this.near[1 - this.newest].array;
        const persons = this.nearPersons.array, looks = this.nearLooks.array;
        const chests = this.nearChests.map((chest) => chest.array);
        const rise = eye.z - 0.85, flat = (reach + MARGIN) ** 2 - rise * rise;
        let count = 0;
        for (let slot = 0, w = 0; slot < b.slots && count < FIGURES; slot++, w += 4) {
            const dx = x0 + sx * words[w] - eye.x, dy = y0 + sy * words[w + 1] - eye.y;
            if (dx * dx + dy * dy > flat || bytes[2 * w + 5] === NOBODY) continue;
            const to = 8 * count, from = 8 * slot, known = slot < a.slots;
            for (let k = 0; k < 8; k++) {
                newer[to + k] = bytes[from + k];
                older[to + k] = known ? a.bytes[from + k] : NOBODY;
            }
            for (let k = 0; k < PERSON; k++) persons[PERSON * count + k] = person[PERSON * slot + k];
            if (b.chests) {
                chests[this.newest][count] = b.chests[slot];
                chests[1 - this.newest][count] = (known ? a.chests : b.chests)?.[slot] ?? b.chests[slot];
            }
            looks[count] = this.looks[slot];
            count++;
        }
        return count;
    }
}

/** 0 to 255: how the person of a slot differs from others, the same in every picture. */
function lookOf(slot) {
    return (Math.imul(slot + 1, 0x9e3779b1) >>> 24) & 255;
}

function setChests(geometry, [a, b]) {
    geometry.setAttribute("chestA", a);
    geometry.setAttribute("chestB", b);
}

function setRecords(geometry, [a, b]) {
    const attribute = (buffer, at) => new THREE.InterleavedBufferAttribute(buffer, 4, at, false);
    geometry.setAttribute("position", attribute(a, 0));
    geometry.setAttribute("infoA", attribute(a, 4));
    geometry.setAttribute("placeB", attribute(b, 0));
    geometry.setAttribute("infoB", attribute(b, 4));
}
