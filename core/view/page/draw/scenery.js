// Scenery of a scene message: things that stand or are carried by bodies, in a mesh for each deck and one for what is carried, and what
// is painted on the floor. It is drawn and nothing else: people neither meet nor see it.
import * as THREE from "three";
import { buildScenery, MOST_TRIANGLES, tellLeft } from "./scenery_mesh.js";
import { SCENERY_FRAGMENT, SCENERY_VERTEX } from "./scenery_shaders.js";

function meshOf(attributes, material, order) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, rows] of attributes) geometry.setAttribute(name, new THREE.BufferAttribute(rows.values(), rows.width));
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
    return mesh;
}

/** The mesh of what is painted, and of what stands. */
export function meshOfPaint(paint, material) {
    return meshOf([["position", paint.position], ["ink", paint.colour]], material, -0.9);
}

export function meshOfPile(pile, material) {
    return meshOf([["position", pile.position], ["normal", pile.normal], ["ink", pile.colour], ["where", pile.where], ["part", pile.part]], material, 0);
}

export class Scenery {
    /** `floor`: uniforms of the floor, `seen`: of walls that are lowered, `poses`: of bodies. */
    constructor(floor, seen, poses) {
        this.material = new THREE.RawShaderMaterial({
            uniforms: { ...seen, poses: poses.poses, size: poses.size, share: poses.share, sky: floor.sky, extent: floor.extent, dim: floor.dim },
            vertexShader: SCENERY_VERTEX, fragmentShader: SCENERY_FRAGMENT, side: THREE.DoubleSide,
        });
    }

    /** Returns the triangles of some items, as buildScenery does. */
    shape(items, bodies = [], beside = 1, most = MOST_TRIANGLES, floor = undefined) {
        return buildScenery(items, bodies, beside, most, floor);
    }

    /** Returns the triangles of each deck, {pile, paint}, and keeps those of what is carried; says in `left` what was left out. `floors`: heights of decks. */
    build(scene, beside, floors) {
        const left = new Map();
        let most = MOST_TRIANGLES;
        const shape = (items, floor) => {
            const shapes = this.shape(items, scene.bodies, beside, most, floor);
            most -= shapes.pile.triangles + shapes.paint.triangles;
            for (const [kind, n] of shapes.left) left.set(kind, (left.get(kind) ?? 0) + n);
            return shapes;
        };
        const items = scene.scenery ?? [], made = floors.map((floor, k) => shape(items.filter(({ body, deck }) => !body && deck === k), floor));
        this.loads = shape(items.filter(({ body }) => body)).pile;
        this.left = tellLeft(left, MOST_TRIANGLES);
        return made;
    }

    /** Returns the mesh of what is carried by bodies; null if nothing is. */
    carried() {
        return this.loads.position.length ? meshOfPile(this.loads, this.material) : null;
    }
}
