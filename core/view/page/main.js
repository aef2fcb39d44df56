// The page: connects the socket, the picture and the panels, and runs the loop.
import { AboutCard } from "./panels/about.js";
import { ActPage } from "./panels/act.js";
import { AgentPage, announce } from "./panels/agent.js";
import { ChartsPage } from "./panels/charts.js";
import { Connection } from "./net/connection.js";
import { Bar } from "./controls/bar.js";
import { Compass } from "./controls/compass.js";
import { bindKeys, Figures, TimeBar, ToolBar, WORDS } from "./controls/controls.js";
import { Crowd, FLAG, NOBODY, readField } from "./net/crowd.js";
import { byId, el, say, typing } from "./dom.js";
import { Help, Meter } from "./panels/help.js";
import { EndCard } from "./panels/end.js";
import { Legend } from "./panels/legend.js";
import { Loading } from "./panels/loading.js";
import { MachinePage } from "./panels/machine.js";
import { Messages } from "./panels/messages.js";
import { Follow } from "./draw/follow.js";
import { describe, Overlay } from "./draw/overlay.js";
import { CLASSES_TOLD, COLOURS, FIELDS } from "./draw/palette.js";
import { News } from "./panels/news.js";
import { Panel } from "./panels/panel.js";
import { ParametersPage } from "./panels/parameters.js";
import { savePicture } from "./draw/picture.js";
import { Player } from "./controls/player.js";
import { Replay, seePerson } from "./controls/replay.js";
import { StoreyPanel } from "./controls/storey_panel.js";
import { ScenePage } from "./panels/scene.js";
import { Tools, TOOLS } from "./controls/tools.js";
import { Gamepads } from "./controls/gamepad.js";
import { Touch } from "./controls/touch.js";
import { markBalls } from "./draw/ball_marks.js";
import { PlayCamera } from "./draw/play_camera.js";
import { GamePanel } from "./panels/game.js";
import { View } from "./draw/view.js";

const LINKS = { connecting: "connecting", open: "connected", lost: "not connected, trying again" };
const HERE = location.host;
const LOST = {
    gone: `The program at ${HERE} does not answer. If it has ended, start it again, as by \`jostle run SCENE --view\`, and open the address that it prints. This page tries again by itself.`,
    token: `The program at ${HERE} refuses this page, whose address is of an earlier start. Open the address that the program printed last.`,
    full: `The program at ${HERE} answers, but admits no further page: close another one. This page tries again by itself.`,
};
const PROTOCOL = 8; // of the messages, as the program counts it
const MOVE = 0.08; // share of the distance to the target that an arrow key moves

/** What people are coloured by at first: where the scene leaves it open, the outer states of machines with many states. */
function firstColour({ view, machines = [] }) {
    const many = machines.some((machine) => machine.states.length > CLASSES_TOLD && machine.outer?.length);
    return view.colour === "state" && !view.given && many ? "outer" : view.colour;
}

class Page {
    constructor() {
        this.crowd = new Crowd();
        this.view = new View(byId("picture"), this.crowd);
        this.eye = new Follow(this.view);
        this.overlay = new Overlay(byId("overlay"), this.view, this.crowd);
        this.loading = new Loading();
        this.messages = new Messages();
        this.meter = new Meter();
        this.legend = new Legend({ keep: (kept) => this.view.colourBy(this.colour, kept), fix: (fixed) => this.connection.send({ do: "scale", fixed }) });
        this.slot = null; // slot of the chosen person
        this.person = null; // last message about them
        this.following = false;
        this.colour = "state";
        this.field = "none";
        this.makeParts();
        this.keys();
        this.point();
        this.theme();
        this.resize();
        new ResizeObserver(() => this.resize()).observe(byId("stage"));
        requestAnimationFrame(() => this.loop());
    }

    makeParts() {
        this.connection = new Connection({
            json: (message) => this.timed(() => this.take(message)),
            binary: (buffer) => this.timed(() => this.takeBinary(buffer)),
            state: (state, cause) => this.link(state, cause),
        });
        const send = (command) => this.connection.send(command) || this.messages.say("Not connected: that was not sent.", "warning");
        this.end = new EndCard({ send });
        this.news = new News();
        this.about = new AboutCard();
        this.compass = new Compass(this.view, () => this.redraw());
        this.storeys = new StoreyPanel({ view: this.view, crowd: this.crowd, shown: () => this.overlay.place() });
        this.overlay.covered = [this.compass.button, this.compass.bar, this.storeys.node, byId("score")];
        this.strip = new Bar(WORDS);
        this.bar = new TimeBar(send, this.strip);
        this.replay = new Replay(send);
        this.player = new Player({ view: this.view, connection: this.connection });
        this.game = new GamePanel({ send, play: (on) => this.playGame(on) });
        this.gamepads = new Gamepads(this.player, () => this.game.press());
        this.touch = new Touch(byId("stage"), this.player);
        this.playCamera = new PlayCamera(this.view);
        this.tools = new Tools(byId("picture"), {
            view: this.view, crowd: this.crowd, overlay: this.overlay, connection: this.connection,
            inspect: (slot) => this.inspect(slot), box: () => this.act.box(),
            gravity: () => this.scene.tools.gravity, share: () => this.crowd.share(performance.now()),
            agentId: (slot) => (this.person && this.person.slot === slot ? this.person.id : null),
        });
        this.toolBar = new ToolBar({
            tool: (name) => this.tool(name), colour: (by) => this.colourBy(by), field: (of) => this.fieldOf(of),
            top: () => this.top(), home: () => this.view.goHome(), follow: () => this.follow(),
            picture: () => savePicture(this.view, this.overlay, this.scene?.title ?? "Jostle"),
            names: () => this.names(), help: () => this.help.toggle(), about: () => this.about.toggle(),
        }, this.strip);
        this.about.button = this.toolBar.about;
        this.figures = new Figures(this.strip);
        this.help = new Help({ meter: this.meter, view: this.view, connection: this.connection });
        this.panel = new Panel(() => this.charts?.draw());
        const pages = this.panel.pages;
        this.agentPage = new AgentPage(pages.agent, { letGo: () => this.inspect(null), recorded: () => this.recorded(), find: (text) => this.connection.send({ do: "inspect", find: text }) });
        this.parameters = new ParametersPage(pages.parameters, { connection: this.connection });
        this.machine = new MachinePage(pages.machine, (machine, state) => {
            this.parameters.show(machine, state);
            this.panel.show("parameters");
            this.panel.tabs.parameters.focus();
        });
        this.charts = new ChartsPage(pages.charts, pages.engine);
        this.scenePage = new ScenePage(pages.scene, { tool: (name) => this.tool(name), show: (tab) => this.panel.show(tab), lifts: (counts) => this.view.ground.lifts.describe(this.crowd.next, counts) });
        this.act = new ActPage(pages.act, { connection: this.connection, player: this.player, playing: (on) => this.playing(on) });
    }

    keys() {
        const step = (x, y) => () => this.move(x, y);
        const next = (choices, now) => {
            const names = Object.keys(choices);
            return names[(names.indexOf(now) + 1) % names.length];
        };
        const turn = (...by) => () => (this.view.turnBy(...by), true);
        bindKeys({
            " ": () => (this.bar.toggle(), true), ".": () => (this.bar.stepOnce(), true),
            t: () => (this.top(), true), f: () => (this.follow(), true), h: () => (this.view.goHome(), true),
            n: () => (this.names(), true), s: () => this.storeys.next(), PageUp: () => this.storeys.step(1), PageDown: () => this.storeys.step(-1), p: () => (savePicture(this.view, this.overlay, this.scene?.title ?? "Jostle"), true),
            c: () => (this.colourBy(next(COLOURS, this.colour)), true), d: () => (this.fieldOf(next(FIELDS, this.field)), true),
            a: () => (this.about.toggle(), true), "?": () => (this.help.toggle(), true), Escape: () => this.escape(),
            ArrowLeft: step(-1, 0), ArrowRight: step(1, 0), ArrowUp: step(0, 1), ArrowDown: step(0, -1),
            q: turn(-0.12, 0, 1), e: turn(0.12, 0, 1), r: turn(0, 0.1, 1), v: turn(0, -0.1, 1),
            "+": turn(0, 0, 1.15), "=": turn(0, 0, 1.15), "-": turn(0, 0, 1 / 1.15),
            Enter: (event) => (event.target === this.view.canvas ? (this.tools.act(), true) : undefined),
            ...Object.fromEntries(Object.entries(TOOLS).map(([name, t]) => [t.key, () => (this.tool(name), true)])),
        }, this.player, typing);
    }

    /** Shows the name under the pointer, even if not all names are shown. */
    point() {
        const canvas = byId("picture");
        const take = (at) => { this.overlay.stale ||= this.overlay.point(at); };
        canvas.addEventListener("pointermove", (event) => {
            const box = canvas.getBoundingClientRect();
            take([event.clientX - box.left, event.clientY - box.top]);
        });
        canvas.addEventListener("pointerleave", () => take(null));
    }

    /** Moves the camera's target, in directions of the picture. */
    move(right, up) {
        const { view } = this, away = view.top ? view.flatSize / view.flat.zoom : view.camera.position.distanceTo(view.controls.target);
        const m = view.camera.matrixWorld.elements, flat = Math.hypot(m[0], m[1]) || 1;
        const x = (m[0] / flat) * MOVE * away, y = (m[1] / flat) * MOVE * away;
        view.moveBy(right * x - up * y, right * y + up * x);
        return true;
    }

    escape() {
        if (this.game.pause()) return true;
        if (this.player.on) this.act.play(false);
        else if (this.tools.gesture) this.tools.cancel();
        else if (this.strip.close()) return true;
        else if (!this.help.node.hidden) this.help.toggle(false);
        else if (this.end.close() || this.about.closeAsked()) return true;
        else if (this.view.tool !== "select") this.tool("select");
        else this.inspect(null);
        return true;
    }

    timed(work) {
        const begun = performance.now();
        work();
        this.meter.messages += performance.now() - begun;
    }

    /** Shows how the connection stands; `cause`: why there is none, once that is known. */
    link(state, cause = null) {
        const node = byId("link");
        node.dataset.state = state;
        say(node, LINKS[state]);
        node.title = LINKS[state];
        if (state === "open" && !this.scene) this.loading.connected();
        if (state === "lost" && !this.scene) this.loading.fail(LOST[cause] ?? "");
        this.messages.stand("link", state === "lost" && this.scene ? `The connection is lost. ${LOST[cause] ?? ""}` : "");
        if (state === "open") this.again();
    }

    /** What a new connection has to know. */
    again() {
        this.crowd.snap = true;
        this.charts.lost();
        if (!this.scene) return; // a scene message sets the initial state
        this.connection.send({ do: "colour", by: COLOURS[this.colour].asks ?? this.colour });
        if (this.field !== "none") this.connection.send({ do: "field", of: this.field });
        if (this.slot !== null && !this.recorded()) this.connection.send({ do: "inspect", slot: this.slot });
    }

    take(message) {
        const taken = {
            scene: () => this.takeScene(message), status: () => this.takeStatus(message),
            errors: () => [this.messages, this.news].forEach((part) => part.showErrors(message.errors ?? [])),
            say: () => this.messages.say(message.text, message.level),
            inspect: () => this.takePerson(message), who: () => this.agentPage.takeWho(message), lua: () => this.parameters.takeLua(message.text),
            refused: () => this.messages.say(message.text, "warning"), time: () => this.takeTime(message),
            reloaded: () => this.news.take(message),
        }[message.type];
        if (taken) taken();
    }

    takeScene(scene) {
        if (scene.protocol !== PROTOCOL) return this.messages.stand("protocol", "This page is of another version than the program. Reload it.");
        const first = !this.scene;
        if (first) this.loading.scene(scene);
        if (!scene.restarts) scene.game = null; // nor does the page begin rounds
        this.scene = scene;
        say(byId("title"), scene.title || scene.file || "Jostle");
        byId("title").title = byId("title").textContent;
        document.title = `${scene.title || scene.file || "Jostle"} – Jostle`;
        for (const part of [this.end, this.about, this.bar, this.replay, this.view, this.storeys, this.legend, this.machine, this.parameters, this.charts, this.scenePage, this.toolBar]) part.set(scene);
        this.overlay.set(this.view.shown);
        if (this.view.ground.scenery.left) this.messages.say(this.view.ground.scenery.left, "warning");
        this.enablePerson(this.slot !== null);
        this.panel.offer("act", this.act.set(scene));
        const live = scene.session !== "replay";
        this.panel.offer("engine", live);
        this.panel.offer("machine", (scene.machines ?? []).length > 0);
        this.panel.offer("parameters", live && (scene.machines ?? []).length > 0);
        this.game.set(scene);
        if (first || !this.toolBar.tools[this.view.tool]) this.tool("select");
        else this.toolBar.show(this.view.tool);
        if (first && COLOURS[scene.view?.colour]) this.colourBy(firstColour(scene));
        if (first && FIELDS[scene.view?.field]) this.fieldOf(scene.view.field);
        this.redraw();
        return undefined;
    }

    takeStatus(status) {
        if (!this.recorded()) this.end.take(status);
        if (!this.end.node.hidden && !this.about.asked) this.about.close(); // two cards cover each other in a small window
        this.messages.stand("break", status.broke && status.paused ? status.broke.trim() : "");
        this.bar.take(status);
        this.game.take(status);
        this.figures.take(status);
        this.legend.take(status);
        this.machine.take(status);
        this.charts.take(status);
        this.scenePage.take(status);
        this.parameters.take(status);
        this.act.takeGates(status.walls);
        if (this.recorded()) this.seePerson();
        if (this.view.ground.setOpen(status.walls)) this.redraw();
        if (!this.described || status.time < this.described || status.time > this.described + 10) {
            this.described = status.time;
            describe(byId("described"), status);
        }
    }

    /** Takes the times of a recording. */
    takeTime(message) {
        this.replay.take(message);
        this.end.takeTime(message);
    }

    takePerson(message) {
        const agent = message.agent;
        if (!agent && this.slot === null) return;
        if (agent && agent.slot !== this.slot) {
            if (!message.found) return; // about the person chosen before
            this.slot = this.overlay.chosen = agent.slot;
            this.panel.show("agent");
        }
        this.agentPage.take(message);
        if (!agent) {
            this.slot = this.overlay.chosen = this.overlay.forces = this.person = null;
            this.messages.say("The person that was chosen is gone.");
            this.enablePerson(false);
        } else {
            if (this.person?.id !== agent.id) announce(byId("described"), agent);
            this.person = agent;
            this.overlay.forces = message.forces ?? null;
            this.machine.mark(agent.machine, agent.state);
        }
        this.overlay.stale = true;
    }

    takeBinary(buffer) {
        const kind = new DataView(buffer).getUint32(0, true);
        if (kind === 1) {
            const taken = this.crowd.take(buffer, performance.now());
            if (this.crowd.previous === this.crowd.next) this.loading.people(this.crowd.everybody().length);
            this.view.takeFrame(taken);
            this.legend.setMost(this.crowd.next.most);
            if (taken === "new" && this.recorded()) this.noticeGone();
            this.findPlayers();
        } else if (kind === 2) {
            this.crowd.takePeople(buffer);
            this.view.people.uploadPersons(this.crowd);
            this.redraw();
        } else if (kind === 3) {
            const field = readField(buffer);
            if (field.which !== ["density", "pressure"].indexOf(this.field)) return;
            this.view.ground.setField(field, field.most);
            this.legend.setMost(field.most, true);
            this.redraw();
        }
    }

    /** In a recording a slot is all that is known of who was chosen: once it is another's, they are gone. */
    noticeGone() {
        const { slot, crowd } = this;
        if (slot !== null && (!crowd.alive(slot) || (crowd.another(slot) && !this.scene.periodic))) this.takePerson({ agent: null });
    }

    /** Slots of players, where the scene has any. */
    findPlayers() {
        if (!this.scene?.tools?.players?.length) return;
        const { bytes, slots } = this.crowd.next;
        this.overlay.players = [];
        for (let slot = 0; slot < slots && this.overlay.players.length < 16; slot++) {
            if (bytes[8 * slot + 7] & FLAG.player && bytes[8 * slot + 5] !== NOBODY) this.overlay.players.push(slot);
        }
    }

    enablePerson(chosen) {
        this.panel.enable("agent", chosen || !this.recorded(), "Click a person");
    }

    inspect(slot) {
        if (slot === this.slot) return;
        this.slot = this.overlay.chosen = slot;
        this.person = this.overlay.forces = null;
        if (this.recorded()) this.seePerson();
        if (!this.recorded() || slot !== null) this.connection.send({ do: "inspect", slot });
        this.enablePerson(slot !== null);
        if (slot === null) this.agentPage.none();
        else if (this.view.tool === "select") this.panel.show("agent");
        if (slot === null) this.follow(false);
        this.redraw();
    }

    recorded() {
        return this.scene?.session === "replay";
    }

    /** Shows what the frames of a recording tell of the chosen person. */
    seePerson() {
        const seen = this.slot === null ? undefined : seePerson(this.view, this.crowd, this.scene, this.slot);
        if (seen) this.agentPage.takeSeen(seen);
        else if (seen === null) this.takePerson({ agent: null });
    }

    tool(name) {
        if (!this.toolBar.tools[name]) return;
        this.tools.cancel();
        this.view.tool = name;
        this.view.useControls();
        this.toolBar.show(name);
        say(byId("hint"), TOOLS[name].hint);
    }

    colourBy(by) {
        this.colour = by;
        this.toolBar.colour.value = by;
        this.view.colourBy(by);
        this.legend.colourBy(by);
        this.connection.send({ do: "colour", by: COLOURS[by].asks ?? by });
    }

    fieldOf(of) {
        this.field = of;
        this.toolBar.field.value = of;
        this.view.ground.setField(null);
        this.legend.fieldOf(of);
        this.connection.send({ do: "field", of });
        this.redraw();
    }

    top() {
        this.view.setTop(!this.view.top);
        this.overlay.place();
        this.toolBar.top.setAttribute("aria-pressed", String(this.view.top));
    }

    follow(on = !this.following) {
        this.following = on && this.slot !== null;
        if (this.following) {
            this.storeys.follow(this.slot);
            this.eye.begin();
        }
        if (on && this.slot === null) this.messages.say("Choose a person first: click one.");
        this.toolBar.follow.setAttribute("aria-pressed", String(this.following));
    }

    /** Shows all names, no name, or as many as have room, in turn. */
    names() {
        const next = { some: "all", all: "none", none: "some" }[this.overlay.names];
        this.overlay.names = next;
        this.toolBar.names.setAttribute("aria-pressed", { some: "mixed", all: "true", none: "false" }[next]);
        this.messages.say({ some: "Names: as many as have room.", all: "Names: all.", none: "Names: under the pointer." }[next]);
        this.redraw();
    }

    /** Gives the player of a game to the person, or takes them away. */
    playGame(on) {
        const { game } = this.scene, { player } = this;
        player.uses = Boolean(game?.button);
        player.speed = game?.speed ?? player.speed;
        if (!on) player.letGo();
        player.on = on && player.id !== null;
        this.touch.show(on, game?.button);
        say(byId("hint"), on ? "" : TOOLS[this.view.tool].hint);
        this.overlay.marks = null;
        this.overlay.playing = on;
        byId("stage").classList.toggle("playing", on);
        if (!on) return this.redraw();
        this.overlay.marks = (pen) => markBalls(pen, this.view, this.balls());
        if (this.view.top) this.top();
        this.playCamera.begin();
        player.join();
        this.view.canvas.focus({ preventScroll: true });
    }

    /** Positions of the bodies that the game marks, m. */
    balls() {
        const { bodies, game } = this.scene;
        return bodies.flatMap((body, row) => (game?.balls.includes(body.name) ? [this.crowd.findBody(row)] : [])).filter(Boolean);
    }

    /** Keeps a game's camera behind the player. */
    keepUpWithPlayer(share, now) {
        const slot = this.overlay.players[0], at = slot === undefined ? null : this.crowd.position(slot, share);
        if (at) this.player.send(); // keys that are held mean the picture as it is turned now
        if (at) this.playCamera.keepUp(at, this.crowd.floor(slot, 1) || 0, () => [...Array(this.crowd.next.slots).keys()].filter((s) => s !== slot).map((s) => this.crowd.position(s, 1)).filter(Boolean), now);
    }

    playing(on) {
        say(byId("hint"), on ? "W A S D or arrows drive the player. Escape ends." : TOOLS[this.view.tool].hint);
        if (on) this.view.canvas.focus();
    }

    theme() {
        const query = matchMedia("(prefers-color-scheme: dark)");
        const set = () => {
            this.view.theme(query.matches);
            this.overlay.theme(query.matches);
            this.legend.build();
            this.charts.draw();
        };
        query.addEventListener("change", set);
        set();
    }

    resize() {
        this.view.resize();
        this.overlay.resize();
        this.charts.draw();
    }

    redraw() {
        this.view.dirty = true;
    }

    loop() {
        const begun = performance.now();
        const share = this.crowd.share(begun);
        const at = this.following ? this.crowd.position(this.slot, share) : null;
        if (at) this.storeys.follow(this.slot);
        if (at) this.eye.keepUp(at, this.crowd.floor(this.slot, share) || 0, begun);
        this.gamepads.poll();
        if (this.game.playing) this.keepUpWithPlayer(share, begun);
        if (this.view.draw(begun, this.drawn)) {
            this.overlay.draw(share);
            this.compass.update();
            this.about.seen();
            this.meter.add(performance.now() - begun, this.view.called);
            this.drawn = begun;
        } else {
            if (this.overlay.stale) this.overlay.draw(share);
            this.drawn = undefined;
        }
        requestAnimationFrame(() => this.loop());
    }
}

try {
    window.page = new Page(); // for the browser's console, and for tests
} catch (error) {
    document.body.prepend(el("p", { role: "alert", className: "errors" }, error.message));
    throw error;
}
