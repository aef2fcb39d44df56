// Five hundred people on a circle, each bound for the opposite point, drawn by three.js as capsules.
import * as three from "three";
import { Scene } from "jostle";

const scene = await Scene.load({ scene: "scenes/circle.yaml", set: { "groups.crossing.count": 500, "places.centre.radius": 40 } });
const COUNT = scene.agents, STEP = 0.05; // s, of the scene

const renderer = new three.WebGLRenderer({ antialias: true });
document.body.append(renderer.domElement);
const camera = new three.PerspectiveCamera(42, 1, 1, 400);
camera.up.set(0, 0, 1);
const world = new three.Scene();
world.background = new three.Color(0xdfe5ea);
world.add(new three.HemisphereLight(0xffffff, 0x8a8074, 2.2));
const sun = new three.DirectionalLight(0xffffff, 1.6);
sun.position.set(-30, -40, 60);
world.add(sun);
const floor = new three.Mesh(new three.CircleGeometry(70, 96), new three.MeshLambertMaterial({ color: 0xc9ced3 }));
world.add(floor);

const person = new three.CapsuleGeometry(0.24, 1.25, 4, 10).rotateX(Math.PI / 2).translate(0, 0, 0.865);
const people = new three.InstancedMesh(person, new three.MeshLambertMaterial(), COUNT);
const colours = Array.from({ length: COUNT }, (_, id) => new three.Color().setHSL(id / COUNT, 0.55, 0.5));
people.frustumCulled = false;
world.add(people);

/** Positions of all people by id: the order of agents changes from step to step. */
function positions() {
    const id = scene.column("id"), x = scene.column("x"), y = scene.column("y");
    const at = new Float32Array(2 * COUNT);
    id.forEach((one, i) => at.set([x[i], y[i]], 2 * one));
    return at;
}

let now = positions(), before = now, begun = performance.now() / 1000;
const spot = new three.Matrix4();
renderer.setAnimationLoop((milliseconds) => {
    const time = milliseconds / 1000;
    for (let made = 0; scene.time < time - begun && made < 3; made++) {
        scene.step();
        [before, now] = [now, positions()];
    }
    if (scene.time < time - begun) begun = time - scene.time; // too slow for real time
    const share = 1 - Math.min(1, (scene.time - (time - begun)) / STEP);
    const mix = (k) => before[k] + (now[k] - before[k]) * share;
    for (let id = 0; id < COUNT; id++) {
        people.setMatrixAt(id, spot.makeTranslation(mix(2 * id), mix(2 * id + 1), 0));
        people.setColorAt(id, colours[id]);
    }
    people.instanceMatrix.needsUpdate = people.instanceColor.needsUpdate = true;
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight;
    camera.position.set(76 * Math.sin(time / 30), -76 * Math.cos(time / 30), 54);
    camera.lookAt(0, 0, 0);
    camera.updateProjectionMatrix();
    renderer.render(world, camera);
    document.title = `${COUNT} people, ${scene.time.toFixed(1)} s`;
});
