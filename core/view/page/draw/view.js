// The picture: renderer and cameras; decides when to draw, and maps points to the screen.
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import * as THREE from "three";
import { Bodies } from "./bodies.js";
import { fitBox, fitStoreys, heightOf, sceneBox, standAt } from "./camera.js";
import { Ground } from "./ground.js";
import { COLOURS, outerStates, table, useDarkRamps } from "./palette.js";
import { People } from "./people.js";
import { Storeys } from "./storeys.js";

THREE.ColorManagement.enabled = false; // colours are sRGB all along, as in pictures
const FIELD_OF_VIEW = 34; // degrees
const LONGEST = 4000; // ms between pictures: longer is a pause
const FAST = 40, SLOW = 240, COARSE = 0.5; // ms between pictures of a processor below which it draws all pixels, and above which half along a side
const HIDDEN = 1; // layer that no camera shows
const STILL = 400; // ms without a change, after which all pixels are drawn

export class View {
    constructor(canvas, crowd) {
        this.canvas = canvas;
        this.crowd = crowd;
        this.storeys = crowd.storeys = new Storeys();
        this.renderer = makeRenderer(canvas);
        this.scene = new THREE.Scene();
        this.people = new People(this.renderer.slow);
        this.bodies = new Bodies();
        this.ground = new Ground(this.bodies.uniforms);
        this.scene.add(this.ground.group, this.people.group, this.bodies.group);
        this.scene.matrixWorldAutoUpdate = false; // everything is placed by shaders
        this.perspective = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.1, 5000);
        this.flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 5000);
        this.perspective.up.set(0, 0, 1);
        this.flat.up.set(0, 1, 0);
        this.orbit = this.makeControls(this.perspective);
        this.slide = this.makeControls(this.flat);
        this.slide.enableRotate = false;
        this.top = false;
        this.tool = "select";
        this.tables = {};
        this.colourBy("state");
        this.dirty = true;
        this.slow = 0; // ms between pictures, averaged
        this.changed = 0; // ms: when the picture last changed
        this.coarse = 1; // share of the screen's pixels along a side that are drawn
        this.coming = this.renderer.slow ? new Set() : null; // materials in the picture while they come one by one; null: all are
        this.called = 0; // ms that the calls of the last picture took; with software rendering they block
        this.useControls();
        canvas.addEventListener("webglcontextrestored", () => {
            this.people.loseAtlas();
            this.compiled = false;
            this.dirty = true;
        });
    }

    makeControls(camera) {
        const controls = new OrbitControls(camera, this.canvas);
        controls.screenSpacePanning = camera === this.flat;
        if (camera === this.perspective) controls.maxPolarAngle = 0.495 * Math.PI; // not below the floor
        controls.minDistance = 0.5;
        controls.zoomSpeed = 1.2;
        controls.addEventListener("change", () => this.moved());
        controls.addEventListener("start", () => (this.handled = true));
        return controls;
    }

    /** Called when the camera has moved: positions on the screen and the picture change. */
    moved() {
        this.camera?.updateMatrixWorld();
        this.dirty = true;
    }

    get camera() {
        return this.top ? this.flat : this.perspective;
    }

    get controls() {
        return this.top ? this.slide : this.orbit;
    }

    /** With an active tool, the left button belongs to it, and the right one turns, or pans from above. */
    useControls() {
        this.orbit.enabled = !this.top;
        this.slide.enabled = this.top;
        const free = this.tool === "select";
        this.orbit.mouseButtons = free ? { LEFT: 0, MIDDLE: 2, RIGHT: 2 } : { LEFT: -1, MIDDLE: 2, RIGHT: 0 };
        this.slide.mouseButtons = free ? { LEFT: 2, MIDDLE: 2, RIGHT: 2 } : { LEFT: -1, MIDDLE: 2, RIGHT: 2 };
        this.orbit.touches = free ? { ONE: 0, TWO: 2 } : { ONE: -1, TWO: 2 };
        this.slide.touches = free ? { ONE: 1, TWO: 2 } : { ONE: -1, TWO: 2 };
        this.dirty = true;
    }

    /** Takes a scene message; the camera and how storeys are shown stay as they are when the scene is the same. */
    set(message) {
        const name = `${message.file} ${message.session}`;
        this.takeStoreys(message.storeys ? { ...message.storeys, lifts: message.lifts ?? [] } : null, this.known === name, message.camera);
        const scene = this.storeys.unfold(message);
        this.storeys.measure(scene);
        this.crowd.lift();
        this.ground.set(scene, this.storeys);
        this.people.set(scene, this.storeys.several);
        this.bodies.set(scene.bodies ?? []);
        if (this.crowd.next) this.bodies.upload(this.crowd);
        this.named = { state: scene.states ?? [], group: scene.groups ?? [], outer: outerStates(scene) };
        this.dropTables(["state", "group", "outer"]);
        this.colourBy(this.by);
        this.shown = scene;
        if (this.known !== name) {
            this.known = name;
            this.home = scene.camera;
            this.peopled = false;
            this.goHome();
        }
        this.dirty = true;
    }

    /** Takes the storeys of a scene message; those of the same scene keep their view. `home`: the scene's own camera, if it has one. */
    takeStoreys(given, same, home) {
        const text = JSON.stringify(given);
        if (text === this.given) return;
        const { view, chosen } = this.storeys;
        this.given = text;
        this.storeys = this.crowd.storeys = new Storeys(given);
        if (home) this.storeys.view = "stacked"; // it looks at true heights
        if (same) Object.assign(this.storeys, { view, chosen: Math.min(chosen, this.storeys.count - 1) });
        if (this.top) this.storeys.top = true;
        this.storeys.arrange();
    }

    /** Shows storeys in another way, {view, chosen, top}: the eye goes along with the chosen storey. */
    showStoreys(changes) {
        const { storeys } = this, { target } = this.controls, before = storeys.at[storeys.chosen], view = storeys.view;
        Object.assign(storeys, changes);
        storeys.arrange();
        this.crowd.lift();
        this.people.liftAgain();
        if (this.crowd.next) this.bodies.upload(this.crowd);
        this.ground.place();
        if (!storeys.several) return;
        if (storeys.view !== view && !this.handled) this.goHome();
        else if (changes.chosen !== undefined && !this.top) this.moveBy(0, 0, storeys.at[storeys.chosen] - (storeys.view === view ? target.z : before));
        this.dirty = true;
    }

    /** Moves to the scene's camera, or to where everything fills the window. */
    goHome() {
        if (!this.shown) return;
        this.handled = false;
        const box = sceneBox(this.shown, this.crowd.everybody());
        const [[x0, y0], [x1, y1]] = box, wide = x1 - x0, deep = y1 - y0;
        const aspect = this.wide / this.high;
        const [low, high] = this.storeys.range(), tall = heightOf(this.shown), aim = (low + high) / 2;
        const fitted = this.home && this.storeys.view !== "exploded" ? standAt(this.home, aspect)
            : high > low ? fitStoreys([...this.storeys.corners(tall), ...[x0, x1].flatMap((x) => [[x, y0, low], [x, y1, low]])], box, aim, FIELD_OF_VIEW, aspect) : fitBox(box, [low, low + tall], FIELD_OF_VIEW, aspect);
        this.ground.inside(box);
        this.orbit.target.copy(fitted.look);
        this.perspective.position.copy(fitted.at);
        this.orbit.maxDistance = this.slide.maxDistance = 8 * Math.max(4, wide, deep, high - low);
        this.lookDown(new THREE.Vector3((x0 + x1) / 2, (y0 + y1) / 2, aim), Math.max(4, 1.1 * Math.max(wide / aspect, deep)));
        this.flat.zoom = 1;
        this.dirty = true;
        this.orbit.update();
        this.slide.update();
        this.moved();
    }

    lookDown(at, size) {
        if (size) this.flatSize = size;
        this.slide.target.set(at.x, at.y, at.z);
        this.flat.position.set(at.x, at.y, at.z + 1000);
        this.frameFlat();
    }

    /** Switches to the view from above, or back; both look at the same spot. */
    setTop(top) {
        if (top === this.top) return;
        const target = this.controls.target.clone();
        this.top = top;
        this.showStoreys({ top });
        if (top) {
            this.lookDown(target);
            const away = this.perspective.position.distanceTo(target);
            this.flat.zoom = this.flatSize / (2 * away * Math.tan((FIELD_OF_VIEW / 2) * (Math.PI / 180)));
            this.flat.updateProjectionMatrix();
        } else {
            this.perspective.position.add(target.clone().sub(this.orbit.target));
            this.orbit.target.copy(target);
        }
        this.useControls();
        this.controls.update();
        this.moved();
    }

    /** Moves the eye and what it looks at, m. */
    moveBy(dx, dy, dz = 0) {
        this.handled = true;
        for (const v of [this.camera.position, this.controls.target]) {
            v.x += dx;
            v.y += dy;
            v.z += dz;
        }
        this.controls.update();
        this.moved();
    }

    /** Turns around the target (rad), rises (rad) and changes the distance (factor). */
    turnBy(turn, climb, nearer) {
        this.handled = true;
        if (this.top) {
            this.flat.zoom *= nearer;
            this.flat.updateProjectionMatrix();
        } else {
            const offset = this.perspective.position.clone().sub(this.orbit.target);
            const s = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
            s.theta += turn;
            s.phi = Math.max(0.02, Math.min(0.495 * Math.PI, s.phi - climb));
            s.radius /= nearer;
            const v = new THREE.Vector3().setFromSpherical(s);
            this.perspective.position.copy(this.orbit.target).add(new THREE.Vector3(v.x, -v.z, v.y));
        }
        this.controls.update();
        this.moved();
    }

    /** Sets what people are coloured by: one of palette.js; `kept` as for its table(), null: all. */
    colourBy(by, kept = null) {
        const u = this.people.uniforms, colour = COLOURS[by];
        u.classes.value = { state: 1, outer: 1, group: 2, failed: 3, direction: 4 }[by] ?? 0;
        const named = this.named?.[by], kind = named ? by : colour.table ?? (colour.classes ? "class" : "value");
        if (kept || this.kept) this.dropTables([kind]);
        this.by = by;
        this.kept = kept;
        u.colours.value = this.tables[kind] ??= smallTexture(table(kind, colour.most, named, kept));
        this.dirty = true;
    }

    /** Drops tables of colours, so that they are made anew. */
    dropTables(kinds = Object.keys(this.tables)) {
        for (const kind of kinds) {
            this.tables[kind]?.dispose();
            this.tables[kind] = null;
        }
    }

    theme(dark) {
        useDarkRamps(dark);
        this.dropTables();
        this.colourBy(this.by, this.kept);
        this.ground.theme(dark ? "dark" : "light");
        this.renderer.setClearColor(this.ground.colours.sky);
        this.dirty = true;
    }

    /** Takes the size of the window; a camera that was not moved still shows the whole scene. */
    resize() {
        const box = this.canvas.parentElement.getBoundingClientRect();
        const wide = Math.max(1, Math.round(box.width)), high = Math.max(1, Math.round(box.height));
        this.wide = wide;
        this.high = high;
        this.sharpen();
        this.perspective.aspect = wide / high;
        this.perspective.updateProjectionMatrix();
        this.frameFlat();
        if (this.peopled && !this.handled) this.goHome();
        this.dirty = true;
    }

    /** Sets the pixels of the picture; `whole`: as many as the screen has, however slow. */
    sharpen(whole = false) {
        this.screenRatio = Math.min(2, window.devicePixelRatio || 1);
        this.whole = whole;
        this.ratio = whole ? this.screenRatio : this.screenRatio * this.coarse;
        this.dirty = true;
    }

    /** Gives the canvas its size just before it is drawn on, as a canvas of another size is empty. */
    sizeCanvas() {
        const size = [this.wide, this.high, this.ratio].join();
        if (size === this.sized) return;
        this.sized = size;
        this.renderer.setPixelRatio(this.ratio);
        this.renderer.setSize(this.wide, this.high, false);
    }

    /** The window of the view from above, m. */
    frameFlat() {
        const half = (this.flatSize ?? 10) / 2;
        this.flat.left = (-half * this.wide) / this.high;
        this.flat.right = -this.flat.left;
        this.flat.top = half;
        this.flat.bottom = -half;
        this.flat.updateProjectionMatrix();
    }

    /** Takes the newest frame of the crowd; `kind` as Crowd.take says. */
    takeFrame(kind) {
        this.people.upload(this.crowd, kind);
        this.bodies.upload(this.crowd);
        if (!this.peopled && !this.handled && this.crowd.next.slots > 0) this.goHome(); // the positions of people are known now
        this.peopled ||= this.crowd.next.slots > 0;
        this.dirty = true;
    }

    /** Screen pixels (not CSS pixels) of a metre at distance 1 m, or of a metre from above. */
    pixelsOfMetre() {
        const high = this.high * this.ratio;
        return 0.5 * high * this.camera.projectionMatrix.elements[5];
    }

    /** Draws if anything moved since the last time; true if it did. */
    draw(now, drawn) {
        const share = this.crowd.share(now);
        const rides = this.ground.lifts.move(this.crowd.previous, this.crowd.next, share);
        const moving = this.people.uniforms.share.value !== share || rides;
        if (!this.dirty && !moving) return this.drawStill(now);
        if (this.whole) this.sharpen();
        this.changed = now;
        return this.render(now, drawn, share);
    }

    /** Draws all of the screen's pixels once nothing has moved for a while, where fewer were drawn; true if it did. */
    drawStill(now) {
        if (this.coarse === 1 || this.whole || now - this.changed < STILL) return false;
        this.sharpen(true);
        return this.render(now, now, this.people.uniforms.share.value);
    }

    render(now, drawn, share) {
        this.dirty = false;
        this.people.uniforms.share.value = this.bodies.uniforms.share.value = share;
        const camera = this.camera;
        camera.updateMatrixWorld();
        this.ground.seenFrom(camera.position, this.top);
        if (this.crowd.next) {
            const { previous, next } = this.crowd;
            this.people.uniforms.clock.value = (next.time - (1 - share) * (next.time - previous.time)) % 1000;
            this.people.choose(this.crowd, { camera, top: this.top, metre: this.pixelsOfMetre(), target: this.controls.target });
        }
        this.people.bakeIfNeeded(this.renderer);
        this.sizeCanvas();
        this.reveal();
        this.compile(camera);
        const begun = performance.now();
        this.renderer.render(this.scene, camera);
        this.called = performance.now() - begun;
        if (this.coming && this.crowd.next) this.compileLayer(camera, HIDDEN); // for the next pictures
        if (this.crowd.next) this.canvas.parentElement.classList.remove("empty"); // until then it would be black
        this.spare(now, drawn);
        return true;
    }

    /** Begins to compile the programs of all that is in the first picture, so that none waits for another. */
    compile(camera) {
        if (this.compiled || !this.crowd.next) return;
        this.compiled = true;
        this.compileLayer(camera, 0);
    }

    compileLayer(camera, layer) {
        const mask = camera.layers.mask;
        camera.layers.set(layer);
        this.scene.traverseVisible((node) => node.material && node.layers.test(camera.layers) && this.renderer.compile(node, camera, this.scene));
        camera.layers.mask = mask;
    }

    /**
     * Where a processor draws, begins with what stands and walks, and adds shades, lines and paint one program a picture: to compile each
     * takes it up to a tenth of a second, which would keep the first picture of the crowd waiting.
     */
    reveal() {
        if (!this.coming || !this.crowd.next) return;
        const isFirst = this.coming.size === 0;
        let added = isFirst ? 1 : 0, left = 0;
        this.scene.traverseVisible((node) => {
            const { material } = node;
            if (!material) return;
            const program = material.userData.program ?? material; // decks have materials of their own with the same program
            const isNew = !this.coming.has(program), waits = isNew && added > 0 && (!isFirst || isTrimming(node));
            if (waits) left++;
            else if (isNew) {
                this.coming.add(program);
                added++;
            }
            node.layers.set(waits ? HIDDEN : 0);
        });
        if (left === 0) this.coming = null;
        else this.dirty = true;
    }

    /** Draws fewer people as meshes when pictures are slow, and more when they are fast again; a processor then draws fewer pixels. */
    spare(now, drawn) {
        const took = now - (drawn ?? now);
        if (took <= 0 || took > LONGEST) return;
        this.slow += 0.1 * (took - this.slow);
        this.people.spare(this.slow);
        const coarse = !this.renderer.slow || this.slow < FAST ? 1 : this.slow > SLOW ? COARSE : this.coarse;
        if (coarse === this.coarse) return;
        this.coarse = coarse;
        this.sharpen();
    }

    /** CSS pixels of a point (m): [x, y, depth]; null behind the eye. */
    project(x, y, z) {
        const v = new THREE.Vector3(x, y, z).applyMatrix4(this.camera.matrixWorldInverse);
        if (!this.top && v.z > -this.camera.near) return null;
        const depth = -v.z;
        v.applyMatrix4(this.camera.projectionMatrix);
        return [(0.5 + 0.5 * v.x) * this.wide, (0.5 - 0.5 * v.y) * this.high, depth];
    }

    /** The line through a CSS pixel: {origin, direction}. */
    rayAt(px, py) {
        const ndc = new THREE.Vector2((2 * px) / this.wide - 1, 1 - (2 * py) / this.high);
        const ray = new THREE.Raycaster();
        ray.setFromCamera(ndc, this.camera);
        return ray.ray;
    }

    /** Whether the floor of a storey hides a point of the picture, [x, y, z], from the eye. */
    isCovered(at) {
        return this.storeys.hides(at, this.top ? [at[0], at[1], this.camera.position.z] : this.camera.position.toArray());
    }

    /** The floor under a CSS pixel that is shown: {deck, at: [x, y] in plan, z: height in the picture}, or null. */
    groundAt(px, py) {
        const { origin, direction } = this.rayAt(px, py);
        return this.storeys.hit(origin.toArray(), direction.toArray());
    }

    /** Where the line through a CSS pixel meets the height z (m): [x, y], or null. */
    floorAt(px, py, z = 0) {
        const { origin, direction } = this.rayAt(px, py);
        const t = (z - origin.z) / direction.z;
        return Number.isFinite(t) && t > 0 ? [origin.x + t * direction.x, origin.y + t * direction.y] : null;
    }
}

/** Returns whether a part of the picture may come a little later than the crowd: lines, shades and paint. */
function isTrimming({ isLineSegments, material, renderOrder }) {
    return isLineSegments || material.transparent || (renderOrder < 0 && renderOrder > -1);
}

/** Returns whether the processor draws the pictures: then edges are not smoothed, to save time. */
function drawsSlowly() {
    const probe = document.createElement("canvas").getContext("webgl");
    const known = probe?.getExtension("WEBGL_debug_renderer_info");
    const name = known ? probe.getParameter(known.UNMASKED_RENDERER_WEBGL) : "";
    probe?.getExtension("WEBGL_lose_context")?.loseContext();
    return /swiftshader|llvmpipe|softpipe|software/i.test(name);
}

function makeRenderer(canvas) {
    const slow = drawsSlowly();
    const wanted = { antialias: !slow, alpha: false, powerPreference: "high-performance" };
    const context = canvas.getContext("webgl2", wanted);
    if (!context) throw new Error("This browser shows no 3-D graphics (WebGL 2). Turn on hardware acceleration, or try another browser.");
    const renderer = new THREE.WebGLRenderer({ canvas, context });
    renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // the shaders compute with colours as they are shown
    renderer.slow = slow;
    return renderer;
}

function smallTexture(data) {
    const made = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat, THREE.UnsignedByteType);
    made.magFilter = made.minFilter = THREE.NearestFilter;
    made.needsUpdate = true;
    return made;
}
