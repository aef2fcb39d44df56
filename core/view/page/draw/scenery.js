// Scenery of a scene message: things that stand or are carried by bodies, in one mesh, and what is painted on the floor, in
// another. It is drawn and nothing else: people neither meet nor see it.
import * as THREE from "three";
import { PAINT_FRAGMENT, PAINT_VERTEX } from "./ground_shaders.js";
import { buildScenery } from "./scenery_mesh.js";
import { SCENERY_FRAGMENT, SCENERY_VERTEX } from "./scenery_shaders.js";

function meshOf(attributes, material, order) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, rows] of attributes) geometry.setAttribute(name, new THREE.BufferAttribute(rows.values(), rows.width));
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

    /** Returns the meshes of a scene message; keeps the footprints {ring, high} of what stands, m, and says in `left` what was left out. */
    build(scene, beside) {
        const { pile, paint, text } = this.shape(scene.scenery ?? [], scene.bodies, beside), meshes = [];
        this.left = text;
        this.rings = pile.rings;
        if (paint.position.length) meshes.push(meshOf([["position", paint.position], ["ink", paint.colour]], this.paintMaterial, -0.9));
        if (pile.position.length) {
            meshes.push(meshOf([["position", pile.position], ["normal", pile.normal], ["ink", pile.colour], ["where", pile.where], ["part", pile.part]], this.material, 0));
        }
        return meshes;
    }
}
