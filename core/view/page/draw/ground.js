// The static parts of the picture: the floor with its field, walls, gates, places and regions.
import * as THREE from "three";
import { boxOf } from "./camera.js";
import { table } from "./palette.js";
import { Scenery } from "./scenery.js";
import { bakeShade } from "./shade.js";
import { FLOOR_FRAGMENT, FLOOR_VERTEX, LOWERED, SKY_FRAGMENT, SKY_VERTEX } from "./ground_shaders.js";
import { meetsBlock } from "./sightline.js";
import { LANDMARK, Prism, wallMaterial } from "./walls.js";

/** Materials of the floor, by their names in scenes, in the order of the shader's numbers. */
const MATERIALS = ["plain", "marble", "asphalt", "concrete", "grass", "wood", "court", "sand", "paving", "carpet"];
const OPEN = 0.04; // m, drawn height of an open gate

const THEMES = {
    light: { base: 0xe9ebee, line: 0xcdd2d9, wall: 0xa9b1bb, edge: 0x5a6470, place: 0x0072b2, region: 0x8a94a3, sky: 0xe6eaef, zenith: 0xb4cbe2, dim: 1 },
    dark: { base: 0x20242a, line: 0x353b44, wall: 0x6b7684, edge: 0xa9b4c0, place: 0x56b4e9, region: 0x5d6774, sky: 0x15181c, zenith: 0x0c1016, dim: 0.36 },
};
const LOW_SUN = 0.8; // m: height up to which ordinary walls cast a shadow, so that rooms stay light
const GATE = 0xd55e00, GATE_EDGE = 0x7a3600;

function circle([x, y], radius, sides = 40) {
    return Array.from({ length: sides }, (_, i) => {
        const a = (2 * Math.PI * i) / sides;
        return [x + radius * Math.cos(a), y + radius * Math.sin(a)];
    });
}

/** Line segments of an outline, a little above the floor. */
function outline(points, closed, z = 0.02) {
    const out = [];
    for (let i = 0; i + (closed ? 0 : 1) < points.length; i++) {
        out.push(...points[i].slice(0, 2), z, ...points[(i + 1) % points.length].slice(0, 2), z);
    }
    return out;
}

function placeLines(place) {
    const points = place.points ?? [];
    if (place.kind === "point" && points.length) return outline(circle(points[0], place.radius || 0.5), true);
    if (place.kind === "polygon") return outline(points, true);
    if (place.kind === "line" || place.kind === "queue") return outline(points, false);
    return [];
}

export class Ground {
    /** `poses`: the uniforms of bodies that have their poses. */
    constructor(poses) {
        this.group = new THREE.Group();
        this.uniforms = {
            base: { value: new THREE.Color() }, line: { value: new THREE.Color() }, spacing: { value: 1 },
            field: { value: null }, ramp: { value: texture(table("value"), 256, 1, THREE.RGBAFormat) },
            cover: { value: new THREE.Vector4() }, gain: { value: 1 },
            shade: { value: null }, shaded: { value: new THREE.Vector4() },
            dim: { value: 1 }, extent: { value: new THREE.Vector3(0, 0, 1) },
            sky: { value: new THREE.Color() }, zenith: { value: new THREE.Color() },
        };
        // Camera position for lowering walls, and the box of the floor that they must not hide, m.
        this.seen = { eye: { value: new THREE.Vector3() }, keep: { value: new THREE.Vector4() }, lowered: { value: 1 }, edge: { value: 0.4 } };
        const material = new THREE.ShaderMaterial({
            uniforms: this.uniforms, vertexShader: FLOOR_VERTEX, fragmentShader: FLOOR_FRAGMENT,
            depthWrite: false, defines: { MATERIAL: 0 },
        });
        this.floor = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
        this.floor.frustumCulled = false;
        this.floor.renderOrder = -1;
        this.sky = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.ShaderMaterial({
            uniforms: this.uniforms, vertexShader: SKY_VERTEX, fragmentShader: SKY_FRAGMENT, depthWrite: false, depthTest: false,
        }));
        this.sky.geometry.setAttribute("position", new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
        this.sky.frustumCulled = false;
        this.sky.renderOrder = -2;
        this.scenery = new Scenery(this.uniforms, this.seen, poses);
        this.materials = new Map(); // kept across scene messages, as a new material compiles its shader again
        this.walls = [];
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
        if (this.scene) this.set(this.scene);
    }

    /** Builds everything of a scene message. */
    set(scene) {
        this.scene = scene;
        this.clear();
        this.walls = scene.walls ?? [];
        this.open = Object.fromEntries(this.walls.filter((w) => w.name).map((w) => [w.name, Boolean(w.open)]));
        const [[x0, y0], [x1, y1]] = scene.area;
        const margin = 3 * Math.max(8, Math.hypot(x1 - x0, y1 - y0)); // there it has faded into the sky
        this.floor.geometry.dispose();
        this.floor.geometry = new THREE.PlaneGeometry(x1 - x0 + 2 * margin, y1 - y0 + 2 * margin);
        this.floor.geometry.translate((x0 + x1) / 2, (y0 + y1) / 2, 0);
        this.uniforms.spacing.value = Math.max(x1 - x0, y1 - y0) > 80 ? 10 : 1;
        this.cover(Math.max(0, MATERIALS.indexOf(scene.floor)));
        this.uniforms.extent.value.set((x0 + x1) / 2, (y0 + y1) / 2, Math.max(8, Math.hypot(x1 - x0, y1 - y0)));
        this.group.add(this.floor, this.sky);
        const box = boxOf(this.walls.flatMap((w) => w.points ?? []));
        this.beside = box ? Math.min(1.2, 0.15 * Math.min(box[1][0] - box[0][0], box[1][1] - box[0][1])) : 1.2;
        this.seen.edge.value = this.beside / 3;
        const fixed = new Prism(this.beside);
        for (const wall of this.walls) if (!wall.name) fixed.wall(wall, wall.height || 2);
        this.addPrism(fixed, this.colours.wall, this.colours.edge);
        this.fixed = fixed.blocks;
        for (const mesh of this.scenery.build(scene, this.beside)) this.group.add(mesh);
        const places = (scene.places ?? []).flatMap(placeLines);
        const regions = Object.values(scene.regions ?? {}).flatMap((points) => outline(points, true, 0.015));
        this.addLines(places, this.colours.place, 0.9);
        this.addLines(regions, this.colours.region, 0.6);
        this.gates();
    }

    /** Gives the floor, and what shows of it through paint, a material of MATERIALS. */
    cover(number) {
        for (const material of [this.floor.material, this.scenery.paintMaterial]) {
            if (material.defines.MATERIAL === number) continue;
            material.defines.MATERIAL = number;
            material.needsUpdate = true;
        }
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

    /** Returns whether a wall, as drawn for a camera at [x, y, z], hides a point from it; m. */
    between(point, eye) {
        const [kx0, ky0, kx1, ky1] = this.seen.keep.value.toArray(), edge = this.seen.edge.value;
        const low = [0, 1].map((k) => Math.min(point[k], eye[k])), high = [0, 1].map((k) => Math.max(point[k], eye[k]));
        // Same computation as in the walls' shader.
        const lowered = ({ middle: [mx, my], across: [ax, ay] }) => {
            const way = ax * (mx - eye[0]) + ay * (my - eye[1]) < 0 ? -1 : 1, x = mx + way * ax, y = my + way * ay;
            return x > kx0 + edge && y > ky0 + edge && x < kx1 - edge && y < ky1 - edge;
        };
        return (this.blocks ?? []).some((block) => {
            const [from, to] = block.box;
            if (to[0] < low[0] || to[1] < low[1] || from[0] > high[0] || from[1] > high[1]) return false;
            return meetsBlock(point, eye, block.ring, lowered(block) ? Math.min(block.high, LOWERED) : block.high);
        });
    }

    /** Named walls: closed ones stand, open ones are a strip on the floor. */
    gates() {
        this.gateParts?.forEach((part) => this.drop(part));
        const gates = new Prism(this.beside);
        for (const wall of this.walls) {
            if (wall.name) gates.wall(wall, this.open[wall.name] ? OPEN : wall.height || 2);
        }
        this.gateParts = this.addPrism(gates, GATE, GATE_EDGE);
        this.blocks = [...this.fixed, ...gates.blocks];
        this.shade();
    }

    /** Updates the shade around walls and closed gates, if they changed. */
    shade() {
        const walls = this.blocks.filter((block) => block.high > OPEN).map(({ ring, high }) => ({ ring, high: high < LANDMARK ? Math.min(high, LOW_SUN) : high }));
        const rings = [...walls, ...this.scenery.rings.filter(({ ring }) => this.isNear(ring))], same = JSON.stringify(rings);
        if (same === this.shadeOf) return;
        this.shadeOf = same;
        this.uniforms.shade.value?.dispose();
        const baked = bakeShade(rings);
        this.uniforms.shade.value = baked?.texture ?? null;
        this.uniforms.shaded.value.set(...(baked?.cover ?? [0, 0, 0, 0]));
    }

    /** Returns whether a footprint lies near the scene, so that its shade is worth its texels. */
    isNear(ring) {
        const [[x0, y0], [x1, y1]] = this.scene.area, margin = 0.25 * Math.max(x1 - x0, y1 - y0);
        return ring.some(([x, y]) => x > x0 - margin && x < x1 + margin && y > y0 - margin && y < y1 + margin);
    }

    /** Sets which gates are open; true if that changed. */
    setOpen(open) {
        let changed = false;
        for (const [name, value] of Object.entries(open ?? {})) {
            if (name in this.open && this.open[name] !== Boolean(value)) changed = true;
            this.open[name] = Boolean(value);
        }
        if (changed) this.gates();
        return changed;
    }

    /** Returns the material of a key, created on first use. */
    material(key, make) {
        if (!this.materials.has(key)) this.materials.set(key, make());
        return this.materials.get(key);
    }

    addPrism(prism, colour, edge) {
        if (prism.empty()) return [];
        const parts = prism.parts((ink, shader) => this.material(`${ink} ${shader}`, () => wallMaterial(this.seen, ink, shader)), colour, edge);
        this.group.add(...parts);
        return parts;
    }

    addLines(positions, colour, opacity) {
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
        const lines = new THREE.LineSegments(geometry, this.material(`${colour} ${opacity}`, () => new THREE.LineBasicMaterial({ color: colour, opacity, transparent: true })));
        lines.frustumCulled = false;
        lines.visible = positions.length > 0;
        this.group.add(lines);
        return lines;
    }

    drop(part) {
        this.group.remove(part);
        part.geometry.dispose();
    }

    clear() {
        for (const part of [...this.group.children]) if (part !== this.floor && part !== this.sky) this.drop(part);
        this.gateParts = null;
    }

    /** Shows a field over the floor, `scale` at the end of the ramp; null hides it. */
    setField(field, scale) {
        if (!field) return this.uniforms.cover.value.set(0, 0, 0, 0);
        const old = this.uniforms.field.value;
        if (old && old.image.width === field.columns && old.image.height === field.rows) {
            old.image.data = field.cells;
            old.needsUpdate = true;
        } else {
            old?.dispose();
            this.uniforms.field.value = texture(field.cells, field.columns, field.rows, THREE.RedFormat);
        }
        this.uniforms.gain.value = field.most / scale;
        this.uniforms.cover.value.set(field.x0, field.y0, field.columns * field.cell, field.rows * field.cell);
        return undefined;
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
