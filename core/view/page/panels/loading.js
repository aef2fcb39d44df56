// What is being done until the first picture is there, and what to do if the connection fails.
import { byId, el, figure, fill, say } from "../dom.js";
import { LINK_WORDS } from "../net/connection.js";

const STEPS = { connect: LINK_WORDS.connecting, scene: "Loading the scene", people: "Placing people", picture: "Preparing the picture" };

export class Loading {
    constructor() {
        this.node = byId("loading");
        this.rows = Object.fromEntries(Object.entries(STEPS).map(([key, text]) => [key, el("li", {}, text)]));
        this.trouble = el("p", { className: "warning", role: "alert", hidden: true });
        fill(this.node, el("ol", {}, Object.values(this.rows)), this.trouble);
        this.reach("connect");
    }

    /** Marks the steps before `key` as done, and `key` as begun; `text` tells what came of the one before. */
    reach(key, text = null) {
        const keys = Object.keys(STEPS), at = keys.indexOf(key);
        keys.forEach((k, i) => (this.rows[k].dataset.state = i < at ? "done" : i === at ? "now" : "later"));
        if (text && at > 0) say(this.rows[keys[at - 1]], text);
        this.fail("");
    }

    connected() {
        this.reach("scene", LINK_WORDS.connected);
    }

    scene(scene) {
        const count = (list, one, many) => `${figure(list.length)} ${list.length === 1 ? one : many}`;
        this.reach("people", `Scene: ${count(scene.groups ?? [], "group", "groups")}, ${count(scene.places ?? [], "place", "places")}, ${count(scene.bodies ?? [], "body", "bodies")}`);
    }

    people(count) {
        this.reach("picture", `${figure(count)} ${count === 1 ? "person" : "people"} placed`);
    }

    fail(text) {
        this.trouble.hidden = !text;
        say(this.trouble, text);
    }
}
