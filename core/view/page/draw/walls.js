// Walls: upright blocks. Each vertex has the middle of its block and the extent across,
// by which the shader lowers blocks that would hide the crowd.
import * as THREE from "three";
import { boxOf } from "./camera.js";
import { WALL_EDGE_FRAGMENT, WALL_FRAGMENT, WALL_VERTEX } from "./ground_shaders.js";
import { FAR, acrossOf } from "./shapes.js";

const THIN = 0.12; // m, drawn thickness of walls that have none
export const LANDMARK = 3.5; // m: solid blocks of this height are what the scene is about, and are never lowered

/** A material of walls or of their edges. `seen`: uniforms of the shader that are shared. */
export function wallMaterial(seen, colour, fragmentShader) {
    return new THREE.ShaderMaterial({
        uniforms: { ...seen, colour: { value: new THREE.Color(colour) } },
        vertexShader: WALL_VERTEX, fragmentShader, side: THREE.DoubleSide,
    });
}

/** Triangles and edges of blocks. A wall may be lowered if the spot `beside` m from it is within the scene. `floor`: height at [x, y]. */
export class Prism {
    constructor(beside = 1.2, floor = () => 0) {
        this.floor = floor;
        this.beside = beside;
        this.faces = { position: [], normal: [], middle: [], across: [], foot: [] };
        this.edges = { position: [], normal: [], middle: [], across: [], foot: [] };
        this.blocks = []; // on rings that run counter-clockwise
    }

    add(part, points, normal) {
        for (const p of points) {
            const foot = this.floor(p);
            part.position.push(p[0], p[1], p[2] + foot);
            part.foot.push(foot);
            part.normal.push(...normal);
            part.middle.push(...this.middle);
            part.across.push(...this.across);
        }
    }

    /** An upright block on a polygon, from the floor to `high` m. */
    block(points, high, landmark = false) {
        const shape = points.map((p) => new THREE.Vector2(p[0], p[1]));
        const ring = THREE.ShapeUtils.isClockWise(shape) ? [...points].reverse() : points;
        this.middle = [0, 1].map((k) => ring.reduce((sum, p) => sum + p[k], 0) / ring.length);
        this.across = landmark ? [FAR, FAR] : acrossOf(ring, this.middle, this.beside);
        this.blocks.push({ ring, high, middle: this.middle, across: this.across, box: boxOf(ring, 0), foot: this.floor(this.middle) });
        ring.forEach((p, i) => {
            const q = ring[(i + 1) % ring.length], length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
            const a = [p[0], p[1]], b = [q[0], q[1]];
            this.add(this.faces, [[...a, 0], [...b, 0], [...b, high], [...a, 0], [...b, high], [...a, high]],
                [(b[1] - a[1]) / length, (a[0] - b[0]) / length, 0]);
            this.add(this.edges, [[...a, high], [...b, high]], [0, 0, 1]);
        });
        const corners = ring.map((p) => new THREE.Vector2(p[0], p[1]));
        for (const face of THREE.ShapeUtils.triangulateShape(corners, [])) {
            this.add(this.faces, face.map((i) => [ring[i][0], ring[i][1], high]), [0, 0, 1]);
        }
    }

    /** Adds a wall of the scene: solid, or a line that gets a visible thickness. */
    wall({ solid, points, closed }, high) {
        if (solid && points.length > 2) return this.block(points, high, high >= LANDMARK);
        const ends = points.length - (closed ? 0 : 1);
        for (let i = 0; i < ends; i++) {
            const a = points[i], b = points[(i + 1) % points.length];
            const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
            const ux = ((b[0] - a[0]) / length) * (THIN / 2), uy = ((b[1] - a[1]) / length) * (THIN / 2);
            this.block([[a[0] - ux - uy, a[1] - uy + ux], [a[0] - ux + uy, a[1] - uy - ux],
                [b[0] + ux + uy, b[1] + uy - ux], [b[0] + ux - uy, b[1] + uy + ux]], high);
        }
    }

    empty() {
        return this.faces.position.length === 0;
    }

    /** Returns the meshes of faces and edges. `materialOf(colour, fragment shader)` makes or finds their materials. */
    parts(materialOf, colour, edge) {
        const made = [[this.faces, colour, WALL_FRAGMENT, THREE.Mesh], [this.edges, edge, WALL_EDGE_FRAGMENT, THREE.LineSegments]];
        return made.map(([part, ink, fragmentShader, Kind]) => {
            const geometry = new THREE.BufferGeometry();
            for (const [name, size] of [["position", 3], ["normal", 3], ["middle", 2], ["across", 2], ["foot", 1]]) {
                geometry.setAttribute(name, new THREE.Float32BufferAttribute(part[name], size));
            }
            const node = new Kind(geometry, materialOf(ink, fragmentShader));
            node.frustumCulled = false;
            return node;
        });
    }
}
