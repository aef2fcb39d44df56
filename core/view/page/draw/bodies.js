// Bodies: all parts of all bodies in one mesh, their edges in another; their poses are a texture.
import * as THREE from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { readPoses } from "../net/crowd.js";
import { BODY_EDGE_FRAGMENT, BODY_FRAGMENT, BODY_SHADE_FRAGMENT, BODY_SHADE_VERTEX, BODY_VERTEX } from "./body_shaders.js";
import { meetsBox } from "./sightline.js";

const EDGE = 30; // degrees between two faces from which their edge is drawn
const ROW = 1024; // texels of the texture's rows: 256 bodies
// Wood, cloth, metal and others; they also differ in lightness.
const TINTS = [0xb08a5b, 0x8fa3ad, 0xc9b79c, 0x7d8a6a, 0x9c6b5a, 0xd8cfc0];

/** One part's geometry in its body's frame: sizes in m, `turn` a quaternion. It also has its bounding box in that frame. */
function makePart(part) {
    const geometry = shapeOf(part).toNonIndexed(), frame = new THREE.Matrix4().compose(
        new THREE.Vector3(...(part.at ?? [0, 0, 0])), new THREE.Quaternion(...(part.turn ?? [0, 0, 0, 1])), new THREE.Vector3(1, 1, 1));
    const box = new THREE.Box3().setFromBufferAttribute(geometry.attributes.position), middle = box.getCenter(new THREE.Vector3());
    geometry.userData = {
        into: frame.clone().multiply(new THREE.Matrix4().setPosition(middle)).invert(),
        half: box.getSize(new THREE.Vector3()).multiplyScalar(0.5).toArray(),
    };
    geometry.applyMatrix4(frame);
    return geometry;
}

function shapeOf({ shape, size = [], points = [] }) {
    if (shape === "sphere") return new THREE.SphereGeometry(size[0], 14, 10);
    if (shape === "cylinder") { // along z; three.js has it along y
        return new THREE.CylinderGeometry(size[0], size[0], size[1], 14).rotateX(Math.PI / 2);
    }
    if (shape === "hull" && points.length >= 4) {
        const hull = new ConvexGeometry(points.map((p) => new THREE.Vector3(...p)));
        // Points of one plane have no hull.
        if (hull.attributes.position.count >= 12) return { toNonIndexed: () => hull }; // already without an index
    }
    const [x, y, z] = size.length === 3 ? size : [0.3, 0.3, 0.3];
    return new THREE.BoxGeometry(x, y, z);
}

export class Bodies {
    constructor() {
        this.uniforms = {
            poses: { value: null }, size: { value: new THREE.Vector2(ROW, 1) },
            share: { value: 1 }, chosen: { value: -1 },
        };
        this.material = new THREE.RawShaderMaterial({
            uniforms: this.uniforms, vertexShader: BODY_VERTEX, fragmentShader: BODY_FRAGMENT, side: THREE.DoubleSide,
        });
        this.edgeMaterial = new THREE.RawShaderMaterial({
            uniforms: this.uniforms, vertexShader: BODY_VERTEX, fragmentShader: BODY_EDGE_FRAGMENT,
        });
        this.shadeMaterial = new THREE.RawShaderMaterial({
            uniforms: this.uniforms, vertexShader: BODY_SHADE_VERTEX, fragmentShader: BODY_SHADE_FRAGMENT,
            transparent: true, depthWrite: false, side: THREE.DoubleSide, forceSinglePass: true,
        });
        this.group = new THREE.Group();
        this.radii = []; // m, of a sphere around each body
        this.names = [];
    }

    /** Builds the mesh of the bodies of a scene message, in place of the old one. */
    set(list) {
        for (const mesh of [...this.group.children]) {
            this.group.remove(mesh);
            mesh.geometry.dispose();
        }
        this.names = list.map((body) => body.name);
        this.radii = [];
        this.seen = null;
        if (list.length === 0) return;
        const parts = list.map((body) => body.parts.map(makePart));
        const kinds = [...new Set(list.map(kindOf))];
        const tints = list.map((body) => new THREE.Color(TINTS[kinds.indexOf(kindOf(body)) % TINTS.length]));
        this.boxes = parts.map((geometries) => geometries.map((g) => g.userData));
        this.radii = parts.map((geometries) => Math.max(0, ...geometries.map(reachOf)));
        this.group.add(this.shades(parts));
        const edges = parts.map((geometries) => geometries.map((g) => new THREE.EdgesGeometry(g, EDGE)));
        this.group.add(this.made(parts, tints, this.material, THREE.Mesh), this.made(edges, tints, this.edgeMaterial, THREE.LineSegments));
        this.makeTexture(list.length);
    }

    /** A rectangle on the floor for the shade of each body. */
    shades(parts) {
        const corners = [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]];
        const position = [], half = [], centre = [];
        parts.forEach((geometries, row) => {
            const box = new THREE.Box3();
            for (const g of geometries) box.union(new THREE.Box3().setFromBufferAttribute(g.attributes.position));
            if (box.isEmpty()) return;
            const size = box.getSize(new THREE.Vector3()), middle = box.getCenter(new THREE.Vector3());
            for (const corner of corners) {
                position.push(...corner, row);
                half.push(size.x / 2, size.y / 2, size.z / 2);
                centre.push(middle.x, middle.y, middle.z);
            }
        });
        const geometry = new THREE.BufferGeometry();
        for (const [name, list] of [["position", position], ["half_size", half], ["centre", centre]]) {
            geometry.setAttribute(name, new THREE.Float32BufferAttribute(list, 3));
        }
        const mesh = new THREE.Mesh(geometry, this.shadeMaterial);
        mesh.frustumCulled = false;
        mesh.renderOrder = -0.6; // over the floor, under all that stands on it
        return mesh;
    }

    /** Merges the parts of all bodies into one mesh, and disposes of their geometries. */
    made(parts, tints, material, Kind) {
        const total = parts.flat().reduce((n, g) => n + g.attributes.position.count, 0);
        const position = new Float32Array(3 * total), normal = new Float32Array(3 * total), tint = new Float32Array(4 * total);
        let at = 0;
        parts.forEach((geometries, row) => {
            const { r, g: green, b } = tints[row];
            for (const g of geometries) {
                position.set(g.attributes.position.array, 3 * at);
                if (g.attributes.normal) normal.set(g.attributes.normal.array, 3 * at);
                for (let i = 0; i < g.attributes.position.count; i++, at++) tint.set([r, green, b, row], 4 * at);
                g.dispose?.();
            }
        });
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
        geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
        geometry.setAttribute("tint", new THREE.BufferAttribute(tint, 4));
        const mesh = new Kind(geometry, material);
        mesh.frustumCulled = false;
        return mesh;
    }

    makeTexture(count) {
        this.uniforms.poses.value?.dispose();
        const rows = Math.max(1, Math.ceil((4 * count) / ROW));
        this.poses = new Float32Array(4 * ROW * rows);
        for (let row = 0; row < count; row++) this.poses[16 * row + 2] = this.poses[16 * row + 10] = -1000; // below the floor until the pose is known
        const texture = new THREE.DataTexture(this.poses, ROW, rows, THREE.RGBAFormat, THREE.FloatType);
        texture.magFilter = texture.minFilter = THREE.NearestFilter;
        texture.generateMipmaps = false;
        texture.needsUpdate = true;
        this.uniforms.poses.value = texture;
        this.uniforms.size.value.set(ROW, rows);
        this.known = count;
    }

    /** Returns whether a body hides a point from a camera at [x, y, z]; m. */
    between(point, eye) {
        const a = new THREE.Vector3(...point), b = new THREE.Vector3(...eye), line = new THREE.Line3(a, b), nearest = new THREE.Vector3();
        return this.radii.some((radius, row) => {
            const [x, y, z, , ...turn] = this.poses.subarray(16 * row + 8, 16 * row + 16), at = new THREE.Vector3(x, y, z);
            if (line.closestPointToPoint(at, true, nearest).distanceTo(at) > radius) return false;
            const back = new THREE.Quaternion(...turn).normalize().conjugate();
            const [from, to] = [a, b].map((v) => v.clone().sub(at).applyQuaternion(back));
            return this.boxes[row].some(({ into, half }) => meetsBox(...[from, to].map((v) => v.clone().applyMatrix4(into).toArray()), half));
        });
    }

    /** Takes the poses of the last two frames. */
    upload(crowd) {
        if (this.radii.length === 0) return;
        readPoses(crowd.previous, crowd.storeys, this.poses, 0, 16, this.known);
        readPoses(crowd.next, crowd.storeys, this.poses, 8, 16, this.known);
        // A body that was not there before does not slide.
        for (let row = crowd.previous.bodies; row < Math.min(this.known, crowd.next.bodies); row++) {
            this.poses.copyWithin(16 * row, 16 * row + 8, 16 * row + 16);
        }
        this.uniforms.poses.value.needsUpdate = true;
    }
}

/** Returns how far a geometry extends from its body's origin, m. */
function reachOf(geometry) {
    const p = geometry.attributes.position;
    let most = 0;
    for (let i = 0; i < p.count; i++) most = Math.max(most, Math.hypot(p.getX(i), p.getY(i), p.getZ(i)));
    return most;
}

/** The kind of a body: "desk" of "desk-1"; bodies of one kind look alike. */
function kindOf(body) {
    return (body.name ?? "thrown").replace(/[-_ ]?\d+$/, "");
}
