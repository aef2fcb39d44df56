// Scenery of a scene message: things that stand or are carried by bodies, in one mesh, and what is painted on the floor, in
// another. It is drawn and nothing else: people neither meet nor see it.
import * as THREE from "three";
import { GRAIN, PAINT_FRAGMENT, PAINT_VERTEX } from "./ground_shaders.js";
import { ALONG, STANDING } from "./scenery_kinds.js";
import { SCENERY_FRAGMENT, SCENERY_VERTEX } from "./scenery_shaders.js";
import { Paint, Pile, draw, rgb } from "./shapes.js";

const PAINTED = { line: "#f7f6f1", ring: "#f7f6f1", area: "#b9c4a8" };

/** Whether a colour is that of a lawn: green that leans to yellow. */
function isLawn([red, green, blue]) {
    return green > red && red > blue;
}

function paintItem(paint, { kind, through = [], at = [], size, colour }) {
    const own = rgb(colour ?? PAINTED[kind]);
    if (kind === "line") paint.line(through, size[1], own);
    if (kind === "area") paint.area(through, own, isLawn(own) ? GRAIN.lawn : GRAIN.floor);
    if (kind === "ring") for (const p of at) paint.ring(p, size[0] / 2, 0.08, own);
}

/** Adds all copies of an item. `rowOf(name)`: the row of a body, -1 if there is none. */
function pileItem(pile, { kind, at = [], through = [], turns = [], size, colour, doors, body }, rowOf) {
    const own = colour ? { colour: rgb(colour) } : {};
    if (STANDING[kind]) {
        const row = body ? rowOf(body) : -1;
        if (body && row < 0) return; // it is not there, or not yet
        for (const [k, [x, y]] of at.entries()) {
            pile.place(x, y, (turns[k] * Math.PI) / 180, row);
            STANDING[kind](pile, size, { ...own, doors, seed: draw(x, y) });
        }
    } else if (ALONG[kind]) {
        for (let i = 0; i + 1 < through.length; i++) {
            const [ax, ay] = through[i], [bx, by] = through[i + 1];
            pile.place(ax, ay, Math.atan2(by - ay, bx - ax));
            ALONG[kind](pile, Math.hypot(bx - ax, by - ay), size[1], size[2], { ...own, seed: draw(ax, ay) });
        }
    }
}

/** Makes the triangles of scenery: {pile, paint}. */
export function buildScenery(items, bodies, beside) {
    const pile = new Pile(beside), paint = new Paint(), rows = new Map(bodies.map((body, row) => [body.name, row]));
    for (const item of items) {
        if (PAINTED[item.kind]) paintItem(paint, item);
        else pileItem(pile, item, (name) => rows.get(name) ?? -1);
    }
    return { pile, paint };
}

function meshOf(attributes, material, order) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, list, count] of attributes) geometry.setAttribute(name, new THREE.Float32BufferAttribute(list, count));
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
    return mesh;
}

export class Scenery {
    /** `floor`: uniforms of the floor, `seen`: of walls that are lowered, `poses`: of bodies. */
    constructor(floor, seen, poses) {
        this.paintMaterial = new THREE.ShaderMaterial({ uniforms: floor, vertexShader: PAINT_VERTEX, fragmentShader: PAINT_FRAGMENT, depthWrite: false, side: THREE.DoubleSide, defines: { MATERIAL: 0 } });
        this.material = new THREE.RawShaderMaterial({
            uniforms: { ...seen, poses: poses.poses, size: poses.size, share: poses.share, sky: floor.sky, extent: floor.extent, dim: floor.dim },
            vertexShader: SCENERY_VERTEX, fragmentShader: SCENERY_FRAGMENT, side: THREE.DoubleSide,
        });
    }

    /** Returns the triangles of some items, as buildScenery does. */
    shape(items, bodies = [], beside = 1) {
        return buildScenery(items, bodies, beside);
    }

    /** Returns the meshes of a scene message, and keeps the footprints {ring, high} of what stands, m. */
    build(scene, beside) {
        const { pile, paint } = this.shape(scene.scenery ?? [], scene.bodies, beside), meshes = [];
        this.rings = pile.rings;
        if (paint.position.length) meshes.push(meshOf([["position", paint.position, 3], ["ink", paint.colour, 4]], this.paintMaterial, -0.9));
        if (pile.position.length) {
            meshes.push(meshOf([["position", pile.position, 3], ["normal", pile.normal, 3], ["ink", pile.colour, 4], ["where", pile.where, 4], ["part", pile.part, 3]], this.material, 0));
        }
        return meshes;
    }
}
