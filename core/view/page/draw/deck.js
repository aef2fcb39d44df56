// One deck of the picture: the floor of a storey with its field, walls, gates, places, regions, scenery and the shade of these; or a
// stair. All is built at height 0; a matrix puts it where storeys.js says. A scene of one plane has one deck.
import * as THREE from "three";
import { addRims, addShaft, addSlope, addStair } from "./building.js";
import { FIELD_FRAGMENT, FLOOR_FRAGMENT, FLOOR_VERTEX, LOWERED, PAINT_FRAGMENT, PAINT_VERTEX } from "./ground_shaders.js";
import { meshOfPaint, meshOfPile } from "./scenery.js";
import { bakeShade } from "./shade.js";
import { Pile } from "./shapes.js";
import { meetsBlock } from "./sightline.js";
import { cutFloor } from "./storeys.js";
import { LANDMARK, Prism, wallMaterial } from "./walls.js";

const OVER = 0.12; // m: height of a field over the steps of a stair
const PIECE = 0.6, UNDER = 0.09; // m: of a floor with slopes; how far it is below their steps
const OPEN = 0.04; // m, drawn height of an open gate
const LOW_SUN = 0.8; // m: height up to which ordinary walls cast a shadow, so that rooms stay light
const GATE = 0xd55e00, GATE_EDGE = 0x7a3600;
const SHAFT = 2.4; // m: height of a shaft's frame on a storey

function circle([x, y], radius, sides = 40) {
    return Array.from({ length: sides }, (_, i) => {
        const a = (2 * Math.PI * i) / sides;
        return [x + radius * Math.cos(a), y + radius * Math.sin(a)];
    });
}

/** Line segments of an outline, a little above the floor; `floor`: its height at [x, y]. */
function outline(points, closed, floor, z = 0.02) {
    const out = [], at = (p) => [p[0], p[1], floor(p) + z];
    for (let i = 0; i + (closed ? 0 : 1) < points.length; i++) out.push(...at(points[i]), ...at(points[(i + 1) % points.length]));
    return out;
}

function placeLines(place, floor) {
    const points = place.points ?? [];
    if (place.kind === "point" && points.length) return outline(circle(points[0], place.radius || 0.5), true, floor);
    if (place.kind === "polygon") return outline(points, true, floor);
    if (place.kind === "line" || place.kind === "queue") return outline(points, false, floor);
    return [];
}

/** Cuts a quadrilateral into pieces of PIECE m along x and y. */
function piecesOf([a, b, c, d]) {
    const wide = Math.max(b[0] - a[0], c[0] - d[0]), columns = Math.ceil(wide / PIECE), rows = Math.ceil((d[1] - a[1]) / PIECE), mix = (p, q, t) => [p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])];
    const at = (i, j) => mix(mix(a, b, i / columns), mix(d, c, i / columns), j / rows);
    return Array.from({ length: columns * rows }, (_, n) => [n % columns, Math.floor(n / columns)]).map(([i, j]) => [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
}

/** Triangles of quadrilaterals [[x, y, z] four times], raised by `over` m. */
function quadGeometry(quads, over) {
    const geometry = new THREE.BufferGeometry(), position = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d].flatMap(([x, y, z]) => [x, y, z + over]));
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
    return geometry;
}

/** Triangles of quadrilaterals on the floor; `floor`: its height at [x, y], null where it is level. */
function floorGeometry(quads, floor) {
    const pieces = floor ? quads.flatMap(piecesOf) : quads, height = (p) => (floor ? floor(p) - (floor(p) > 0.01 ? UNDER : 0) : 0);
    return quadGeometry(pieces.map((quad) => quad.map((p) => [...p, height(p)])), 0);
}

/** Returns whether an upright block, as drawn for a camera at [x, y, z], hides a point from it; `seen`: uniforms of walls. */
function isHiddenBy(blocks, point, eye, seen) {
    const [kx0, ky0, kx1, ky1] = seen.keep.value.toArray(), edge = seen.edge.value;
    const low = [0, 1].map((k) => Math.min(point[k], eye[k])), high = [0, 1].map((k) => Math.max(point[k], eye[k]));
    // Same computation as in the walls' shader.
    const lowered = ({ middle: [mx, my], across: [ax, ay] }) => {
        const way = ax * (mx - eye[0]) + ay * (my - eye[1]) < 0 ? -1 : 1, x = mx + way * ax, y = my + way * ay;
        return x > kx0 + edge && y > ky0 + edge && x < kx1 - edge && y < ky1 - edge;
    };
    return blocks.some((block) => {
        const [from, to] = block.box;
        if (to[0] < low[0] || to[1] < low[1] || from[0] > high[0] || from[1] > high[1]) return false;
        const above = (p) => [p[0], p[1], p[2] - block.foot];
        return meetsBlock(above(point), above(eye), block.ring, lowered(block) ? Math.min(block.high, LOWERED) : block.high);
    });
}

export class Deck {
    /** `ground`: the Ground that it is part of; `number`: of the deck. */
    constructor(ground, number) {
        this.ground = ground;
        this.number = number;
        this.group = new THREE.Group();
        this.matrix = new THREE.Matrix4();
        this.uniforms = { ...ground.uniforms, cover: { value: new THREE.Vector4() }, rows: { value: new THREE.Vector2(0, 1) }, shade: { value: null }, shaded: { value: new THREE.Vector4() } };
        const material = (vertexShader, fragmentShader, more = {}) => new THREE.ShaderMaterial({ uniforms: this.uniforms, vertexShader, fragmentShader, depthWrite: false, defines: { MATERIAL: 0 }, ...more });
        this.floorMaterial = material(FLOOR_VERTEX, FLOOR_FRAGMENT);
        // What lies on a slab is a little above it, also from afar.
        this.slabMaterial = material(FLOOR_VERTEX, FLOOR_FRAGMENT, { depthWrite: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 8 });
        this.paintMaterial = material(PAINT_VERTEX, PAINT_FRAGMENT, { side: THREE.DoubleSide });
        this.fieldMaterial = material(FLOOR_VERTEX, FIELD_FRAGMENT, { transparent: true, side: THREE.DoubleSide });
        this.materials = [this.floorMaterial, this.slabMaterial, this.paintMaterial, this.fieldMaterial];
        for (const [k, of] of this.materials.entries()) of.userData.program = k;
        this.blocks = [];
    }

    /** Sets and returns the height above the deck's at [x, y] in plan; of stairs by their storey below, however they are stretched. */
    findFloor() {
        const { storeys } = this.ground, { flights, height } = storeys.decks[this.number];
        this.floorAt = flights.length ? (p) => storeys.elevation(this.number, p) - height : () => 0;
        return this.floorAt;
    }

    /** Builds everything of a deck. `parts`: {walls, places, areas, pile, paint} of it alone, `margin`: m of floor around the scene. */
    build(parts, margin) {
        const { storeys, colours } = this.ground, { walls } = parts;
        this.clear();
        this.parts = parts;
        if (storeys.isStorey(this.number)) this.lay(margin);
        const fixed = new Prism(this.ground.beside, this.floorAt);
        for (const wall of walls) if (!wall.name) fixed.wall(wall, wall.height || 2);
        this.addPrism(fixed, colours.wall, colours.edge);
        this.fixed = fixed.blocks;
        if (parts.paint.position.length) this.add(meshOfPaint(parts.paint, this.paintMaterial));
        if (parts.pile.position.length) this.add(meshOfPile(parts.pile, this.ground.scenery.material));
        this.gates();
    }

    hasSlopes() {
        return this.ground.storeys.decks[this.number].slopes.length > 0;
    }

    /** Lays the floor: without holes as far as the eye reaches, which is shown of the lowest storey in sight; and a slab. */
    lay(margin) {
        const { storeys, scene } = this.ground, [[x0, y0], [x1, y1]] = scene.area;
        const wide = x1 - x0 + 2 * margin, deep = y1 - y0 + 2 * margin, holes = storeys.holes(this.number);
        const ring = [[x0 - margin, y0 - margin], [x1 + margin, y0 - margin], [x1 + margin, y1 + margin], [x0 - margin, y1 + margin]];
        const floor = this.hasSlopes() ? this.floorAt : null;
        const plane = holes.length ? floorGeometry(cutFloor([ring], holes), null) : new THREE.PlaneGeometry(wide, deep).translate((x0 + x1) / 2, (y0 + y1) / 2, 0);
        this.floor = this.add(new THREE.Mesh(plane, storeys.several ? this.slabMaterial : this.floorMaterial), -1);
        this.slab = storeys.several ? this.add(new THREE.Mesh(floorGeometry(cutFloor(storeys.outlines[this.number], holes), floor), this.slabMaterial), -1) : null;
    }

    /** Adds what depends on how far the deck is stretched: places and regions, the rims of a slab, the frames of shafts and slopes; or a stair. */
    stretch(scale) {
        const { storeys, colours } = this.ground, { stair, height, slopes, lower, upper } = storeys.decks[this.number], pile = new Pile(), heightOf = (elevation) => scale * (elevation - height);
        const floor = (p) => (storeys.several ? heightOf(storeys.elevation(this.number, p)) : 0), { places, areas } = this.parts;
        this.stretched?.parts.forEach((part) => this.drop(part));
        this.stretched = { scale, parts: [
            this.addLines(places.flatMap((place) => placeLines(place, floor)), colours.place, 0.9),
            this.addLines(areas.flatMap(({ points }) => outline(points, true, floor, 0.015)), colours.region, 0.6),
        ] };
        if (!storeys.several) return;
        if (stair && lower < upper) {
            const treads = addStair(pile, stair, (p) => storeys.elevation(this.number, p), heightOf);
            this.treads = this.add(new THREE.Mesh(quadGeometry(treads, OVER), this.fieldMaterial));
            this.treads.visible = this.uniforms.cover.value.z > 0;
            this.stretched.parts.push(this.treads);
        }
        for (const slope of slopes) addSlope(pile, slope, heightOf);
        if (!stair) {
            addRims(pile, storeys.outlines[this.number]);
            for (const lift of storeys.lifts) if (lift.stops[0].storey <= this.number && this.number <= lift.stops.at(-1).storey) addShaft(pile, lift, SHAFT);
        }
        if (pile.position.length) this.stretched.parts.push(this.add(meshOfPile(pile, this.ground.scenery.material)));
    }

    /** Puts the deck where it is drawn: its height, by which factor it is stretched, whether it is shown, and as the ground about all. */
    place({ z, scale, shown }, isGround) {
        this.z = z;
        this.group.visible = shown;
        this.matrix.makeTranslation(0, 0, z);
        if (this.stretched?.scale !== scale) this.stretch(scale);
        for (const part of this.group.children) part.matrixWorld.copy(this.matrix);
        if (this.floor) this.floor.visible = isGround;
        if (this.slab) this.slab.visible = !isGround || this.hasSlopes();
    }

    /** Gives the floor, and what shows of it through paint, a material by its number. */
    cover(number) {
        for (const material of this.materials) {
            if (material.defines.MATERIAL === number) continue;
            material.defines.MATERIAL = number;
            material.needsUpdate = true;
        }
    }

    /** Returns whether a wall, as drawn for a camera at [x, y, z], hides a point from it; m. */
    between(point, eye) {
        const below = (p) => [p[0], p[1], p[2] - this.z];
        return this.group.visible && isHiddenBy(this.blocks, below(point), below(eye), this.ground.seen);
    }

    /** Named walls: closed ones stand, open ones are a strip on the floor. */
    gates() {
        const { open, beside } = this.ground, gates = new Prism(beside, this.floorAt);
        this.gateParts?.forEach((part) => this.drop(part));
        for (const wall of this.parts.walls) if (wall.name) gates.wall(wall, open[wall.name] ? OPEN : wall.height || 2);
        this.gateParts = this.addPrism(gates, GATE, GATE_EDGE);
        this.blocks = [...this.fixed, ...gates.blocks];
        this.shade();
    }

    /** Updates the shade around walls and closed gates, if they changed. */
    shade() {
        const walls = this.blocks.filter((block) => block.high > OPEN).map(({ ring, high }) => ({ ring, high: high < LANDMARK ? Math.min(high, LOW_SUN) : high }));
        const rings = [...walls, ...this.parts.pile.rings.filter(({ ring }) => this.ground.isNear(ring))], same = JSON.stringify(rings);
        if (same === this.shadeOf) return;
        this.shadeOf = same;
        this.uniforms.shade.value?.dispose();
        const baked = bakeShade(rings, this.ground.storeys.count);
        this.uniforms.shade.value = baked?.texture ?? null;
        this.uniforms.shaded.value.set(...(baked?.cover ?? [0, 0, 0, 0]));
    }

    /** Shows a field over the floor; null hides it. */
    setField(field) {
        const { storeys } = this.ground, { cover, rows } = this.uniforms, block = field?.blocks.find(({ sheet }) => sheet === storeys.decks[this.number].sheet);
        const known = field && (block || !storeys.several);
        if (this.treads) this.treads.visible = Boolean(known);
        if (!known) return cover.value.set(0, 0, 0, 0);
        const { first, y0, rows: count } = block ?? { first: 0, y0: field.y0, rows: field.rows };
        rows.value.set(first / field.rows, (first + count) / field.rows);
        return cover.value.set(field.x0, y0 - first * field.cell, field.columns * field.cell, field.rows * field.cell);
    }

    add(mesh, order = mesh.renderOrder) {
        mesh.frustumCulled = false;
        mesh.renderOrder = order;
        mesh.matrixWorld.copy(this.matrix);
        this.group.add(mesh);
        return mesh;
    }

    addPrism(prism, colour, edge) {
        if (prism.empty()) return [];
        const parts = prism.parts((ink, shader) => this.ground.material(`${ink} ${shader}`, () => wallMaterial(this.ground.seen, ink, shader)), colour, edge);
        return parts.map((part) => this.add(part));
    }

    addLines(positions, colour, opacity) {
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
        const lines = new THREE.LineSegments(geometry, this.ground.material(`${colour} ${opacity}`, () => new THREE.LineBasicMaterial({ color: colour, opacity, transparent: true })));
        lines.visible = positions.length > 0;
        return this.add(lines);
    }

    drop(part) {
        this.group.remove(part);
        part.geometry.dispose();
    }

    clear() {
        for (const part of [...this.group.children]) this.drop(part);
        this.gateParts = this.floor = this.slab = this.treads = this.stretched = null;
    }

    /** Gives back what the graphics card holds of it. */
    dispose() {
        this.clear();
        this.uniforms.shade.value?.dispose();
        for (const material of this.materials) material.dispose();
    }
}
