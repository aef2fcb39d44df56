// The static parts of the picture: decks with floors, walls, gates, places and regions; the lifts between them; and the sky.
import * as THREE from "three";
import { boxOf } from "./camera.js";
import { Deck } from "./deck.js";
import { Lifts } from "./lifts.js";
import { table } from "./palette.js";
import { Scenery } from "./scenery.js";
import { SKY_FRAGMENT, SKY_VERTEX } from "./ground_shaders.js";

/** Materials of the floor, by their names in scenes, in the order of the shader's numbers. */
const MATERIALS = ["plain", "marble", "asphalt", "concrete", "grass", "wood", "court", "sand", "paving", "carpet"];

const THEMES = {
    light: { base: 0xe9ebee, line: 0xcdd2d9, wall: 0xa9b1bb, edge: 0x5a6470, place: 0x0072b2, region: 0x8a94a3, sky: 0xe6eaef, zenith: 0xb4cbe2, dim: 1 },
    dark: { base: 0x20242a, line: 0x353b44, wall: 0x6b7684, edge: 0xa9b4c0, place: 0x56b4e9, region: 0x5d6774, sky: 0x15181c, zenith: 0x0c1016, dim: 0.36 },
};

export class Ground {
    /** `poses`: the uniforms of bodies that have their poses. */
    constructor(poses) {
        this.group = new THREE.Group();
        this.uniforms = {
            base: { value: new THREE.Color() }, line: { value: new THREE.Color() }, spacing: { value: 1 },
            field: { value: null }, ramp: { value: texture(table("value"), 256, 1, THREE.RGBAFormat) }, gain: { value: 1 },
            dim: { value: 1 }, extent: { value: new THREE.Vector3(0, 0, 1) },
            sky: { value: new THREE.Color() }, zenith: { value: new THREE.Color() },
        };
        // Camera position for lowering walls, and the box of the floor that they must not hide, m.
        this.seen = { eye: { value: new THREE.Vector3() }, keep: { value: new THREE.Vector4() }, lowered: { value: 1 }, edge: { value: 0.4 } };
        this.sky = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.ShaderMaterial({
            uniforms: this.uniforms, vertexShader: SKY_VERTEX, fragmentShader: SKY_FRAGMENT, depthWrite: false, depthTest: false,
        }));
        this.sky.geometry.setAttribute("position", new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
        this.sky.frustumCulled = false;
        this.sky.renderOrder = -2;
        this.scenery = new Scenery(this.uniforms, this.seen, poses);
        this.lifts = new Lifts(this.scenery.material);
        this.carried = new THREE.Group(); // scenery on bodies, which moves by their poses
        this.group.add(this.sky, this.carried, this.lifts.group);
        this.materials = new Map(); // kept across scene messages, as a new material compiles its shader again
        this.decks = [];
        this.theme("light");
    }

    theme(name) {
        this.colours = THEMES[name];
        this.uniforms.base.value.set(this.colours.base);
        this.uniforms.line.value.set(this.colours.line);
        this.uniforms.ramp.value.image.data = table("value"); // of the theme
        this.uniforms.ramp.value.needsUpdate = true;
        this.uniforms.sky.value.set(this.colours.sky);
        this.uniforms.zenith.value.set(this.colours.zenith);
        this.uniforms.dim.value = this.colours.dim;
        if (this.scene) this.build(this.scene, this.storeys);
    }

    /** Takes a scene message, as storeys have unfolded it. Of one in which bodies alone have changed, only what they carry is built anew. */
    set(scene, storeys) {
        const { area, floor, walls, places, areas, scenery } = scene, text = JSON.stringify([area, floor, walls, places, areas, scenery]);
        if (text !== this.built || storeys !== this.storeys) this.build(scene, storeys);
        this.built = text;
        this.scene = scene;
        this.carry();
    }

    /** Builds everything that stands. */
    build(scene, storeys) {
        this.scene = scene;
        this.storeys = storeys;
        const walls = scene.walls ?? [];
        this.open = Object.fromEntries(walls.filter((w) => w.name).map((w) => [w.name, Boolean(w.open)]));
        const [[x0, y0], [x1, y1]] = scene.area;
        const margin = 3 * Math.max(8, Math.hypot(x1 - x0, y1 - y0)); // there it has faded into the sky
        this.uniforms.spacing.value = Math.max(x1 - x0, y1 - y0) > 80 ? 10 : 1;
        this.uniforms.extent.value.set((x0 + x1) / 2, (y0 + y1) / 2, Math.max(8, Math.hypot(x1 - x0, y1 - y0)));
        const box = boxOf(walls.flatMap((w) => w.points ?? []));
        this.beside = box ? Math.min(1.2, 0.15 * Math.min(box[1][0] - box[0][0], box[1][1] - box[0][1])) : 1.2;
        this.seen.edge.value = this.beside / 3;
        this.changeDecks(storeys.decks.length);
        const shapes = this.scenery.build(scene, this.beside, this.decks.map((deck) => deck.findFloor()));
        this.decks.forEach((deck, k) => {
            const own = ({ deck: of }) => (of ?? 0) === k;
            deck.cover(Math.max(0, MATERIALS.indexOf(scene.floor)));
            deck.build({ walls: walls.filter(own), places: (scene.places ?? []).filter(own), areas: scene.areas.filter(own), ...shapes[k] }, margin);
        });
        this.lifts.set(storeys);
        this.place();
    }

    /** Makes as many decks as there are to be. */
    changeDecks(count) {
        for (const deck of this.decks.splice(count)) {
            this.group.remove(deck.group);
            deck.dispose();
        }
        while (this.decks.length < count) {
            const deck = new Deck(this, this.decks.length);
            this.decks.push(deck);
            this.group.add(deck.group);
        }
    }

    /** Adds the scenery that bodies carry. */
    carry() {
        for (const part of [...this.carried.children]) {
            this.carried.remove(part);
            part.geometry.dispose();
        }
        const mesh = this.scenery.carried(this.scene, this.beside);
        if (mesh) this.carried.add(mesh);
    }

    /** Puts all decks where storeys says. */
    place() {
        const ground = this.storeys.ground();
        this.decks.forEach((deck, k) => deck.place(this.storeys.drawnDecks[k], k === ground));
    }

    /** Sets the camera's position; from above no wall hides anything. */
    seenFrom(eye, top) {
        this.seen.eye.value.copy(eye);
        this.seen.lowered.value = top ? 0 : 1;
    }

    /** Sets the box [[x0, y0], [x1, y1]] that walls must not hide, m. */
    inside([[x0, y0], [x1, y1]]) {
        this.seen.keep.value.set(x0, y0, x1, y1);
    }

    /** Returns whether a wall or a floor, as drawn for a camera at [x, y, z], hides a point from it; m. */
    between(point, eye) {
        return this.decks.some((deck) => deck.between(point, eye)) || this.storeys.hides(point, eye);
    }

    /** Returns whether a footprint lies near the scene, so that its shade is worth its texels. */
    isNear(ring) {
        const [[x0, y0], [x1, y1]] = this.scene.area, margin = 0.25 * Math.max(x1 - x0, y1 - y0);
        return ring.some(([x, y]) => x > x0 - margin && x < x1 + margin && y > y0 - margin && y < y1 + margin);
    }

    /** Sets which gates are open; true if that changed. */
    setOpen(open) {
        const changed = new Set();
        for (const [name, value] of Object.entries(open ?? {})) {
            if (name in this.open && this.open[name] !== Boolean(value)) changed.add(name);
            this.open[name] = Boolean(value);
        }
        for (const deck of this.decks) if (deck.parts.walls.some((wall) => changed.has(wall.name))) deck.gates();
        return changed.size > 0;
    }

    /** Returns the material of a key, created on first use. */
    material(key, make) {
        if (!this.materials.has(key)) this.materials.set(key, make());
        return this.materials.get(key);
    }

    /** Shows a field over the floors, `scale` at the end of the ramp; null hides it. */
    setField(field, scale) {
        for (const deck of this.decks) deck.setField(field);
        if (!field) return;
        const old = this.uniforms.field.value;
        if (old && old.image.width === field.columns && old.image.height === field.rows) {
            old.image.data = field.cells;
            old.needsUpdate = true;
        } else {
            old?.dispose();
            this.uniforms.field.value = texture(field.cells, field.columns, field.rows, THREE.RedFormat);
        }
        this.uniforms.gain.value = field.most / scale;
    }
}

function texture(data, columns, rows, format) {
    const made = new THREE.DataTexture(data, columns, rows, format, THREE.UnsignedByteType);
    made.magFilter = made.minFilter = THREE.LinearFilter;
    made.generateMipmaps = false;
    made.unpackAlignment = 1;
    made.needsUpdate = true;
    return made;
}
