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

    /** Returns the triangles of each deck, {pile, paint}; `floors`: heights of decks. */
    build(scene, beside, floors) {
        this.standing = new Map(); // what was left out
        this.room = MOST_TRIANGLES;
        return floors.map((floor, k) => {
            const shapes = this.shape((scene.scenery ?? []).filter(({ body, deck }) => !body && deck === k), scene.bodies, beside, this.room, floor);
            this.room -= shapes.pile.triangles + shapes.paint.triangles;
            for (const [kind, n] of shapes.left) this.standing.set(kind, (this.standing.get(kind) ?? 0) + n);
            return shapes;
        });
    }

    /** Returns the mesh of what is carried by bodies, null if nothing is; says in `left` what was left out of all. */
    carried(scene, beside) {
        const { pile, left } = this.shape((scene.scenery ?? []).filter(({ body }) => body), scene.bodies, beside, this.room), all = new Map(this.standing);
        for (const [kind, n] of left) all.set(kind, (all.get(kind) ?? 0) + n);
        this.left = tellLeft(all, MOST_TRIANGLES);
        return pile.position.length ? meshOfPile(pile, this.material) : null;
    }
}
