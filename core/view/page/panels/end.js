// The card at the end of a run or of a recording: what happened, from the engine's figures, and what can be done next.
import { byId, clock, el, figure, fill } from "../dom.js";
import { SERVICE } from "../draw/palette.js";

const TITLES = { left: "Everybody has left", failed: "The run cannot go on" };

const NOTES = { time: "Play goes on beyond this time.", left: "The time is stopped. Play goes on without people." };

/** "97 left by south, the last at 53 s; 3 are still inside." */
function leavingSentence(end) {
    const people = (n) => `${figure(n)} ${n === 1 ? "person" : "people"}`;
    const inside = end.inside === 0 ? "nobody is inside" : end.inside === 1 ? "1 is still inside" : `${figure(end.inside)} are still inside`;
    if (end.left === 0) return `${people(end.people)} took part; ${end.inside === end.people ? "nobody left" : inside}.`;
    const used = end.exits.filter((exit) => exit.people > 0), named = used.reduce((sum, exit) => sum + exit.people, 0);
    const ways = used.map((exit) => `${figure(exit.people)} by ${exit.name}`);
    if (named < end.left) ways.push(`${figure(end.left - named)} elsewhere`);
    const who = used.length === 1 && named === end.left ? `${figure(end.left)} left by ${used[0].name}`
        : used.length === 0 ? `${figure(end.left)} left` : `${figure(end.left)} left (${ways.join(", ")})`;
    return `${who}, the last at ${figure(Number(end.last.toFixed(1)))} s; ${inside}.`;
}

/** "Greatest density: 5.2 people per m² at 31 s, in hall (level of service F)." */
function densitySentence(density) {
    const [x, y] = density.at.map((v) => figure(Number(v.toFixed(1))));
    const level = SERVICE.find(([, up]) => density.most < up)[0];
    return `Greatest density: ${figure(density.most)} people per m² (Gaussian, R = 1 m) at ${figure(Number(density.time.toFixed(1)))} s, at (${x}, ${y}) m`
        + `${density.where} – level of service ${level} (Fruin).`;
}

/** The sentences of the card, from the member `end` of a status. */
export function endSentences(end) {
    const out = end.why === "failed" && end.failure ? [end.failure] : [];
    out.push(leavingSentence(end));
    if (end.density) out.push(densitySentence(end.density));
    if (end.falls) out.push(end.falls === 1 ? "1 person fell." : `${figure(end.falls)} falls.`);
    for (const { name, verdict, figure: value, limit, unit } of end.criteria ?? []) {
        const compared = value === null ? "" : ` (${Number(value.toPrecision(5))}, at most ${Number(limit.toPrecision(5))} ${unitText(unit)})`;
        out.push(`Criterion ${name}: ${verdict}${compared}.`);
    }
    return out;
}

/** A unit as people write it: "1/m2" becomes "per m²". */
function unitText(unit) {
    return { "1/m2": "per m²", "1/(m s)": "per m and s" }[unit] ?? unit;
}

export class EndCard {
    /** `page`: {send(command)} */
    constructor(page) {
        this.page = page;
        this.node = byId("end");
        this.node.addEventListener("keydown", (event) => {
            if (event.key === "Escape" && this.close()) event.stopPropagation();
        });
        this.shown = ""; // the end that was shown, or closed, already
    }

    set(scene) {
        const name = `${scene.session} ${scene.file}`;
        if (this.name !== name) this.forget();
        this.name = name;
        this.scene = scene;
    }

    /** A run goes on or begins again: its next end is a new one. */
    forget() {
        this.shown = "";
        this.hide();
    }

    /** Takes a status of a running scene. Scenes that are games have a card of their own. */
    take({ end, time }) {
        if (!end) {
            if (this.shown && (this.time === undefined || time < this.time || this.why !== "left")) this.forget();
            return;
        }
        this.time = time;
        if (this.shown || this.scene?.game) return;
        this.why = end.why;
        this.shown = "shown";
        const again = this.scene?.restarts ? [
            this.button("Again", `Run it again with seed ${end.seed}`, () => this.page.send({ do: "restart", seed: end.seed }), true),
            this.button("Another seed", `Run it with seed ${end.seed + 1}`, () => this.page.send({ do: "restart", seed: end.seed + 1 })),
        ] : [];
        this.show(TITLES[end.why] ?? `${figure(end.time)} s are over`, endSentences(end), [...again,
            this.button("Compare", "The command that compares this scene with a changed copy", () => this.tell([
                "Save a changed copy of the scene as changed.yaml. This runs both with ten seeds and says what differs:"], end.compare)),
            this.button("Report", "The command that writes a report of this run", () => this.tell([
                "This runs the scene again with this seed and writes report/index.html:",
                end.acted ? "What was done by hand on this page is not part of it." : null], end.report)),
        ], NOTES[end.why] ?? null);
    }

    /** Takes a `time` message of a recording. */
    takeTime({ from, until, at }) {
        if (at < until) return void (this.shown && this.forget());
        if (this.shown) return;
        this.shown = "shown";
        const quoted = /^[\w./-]+$/.test(this.scene.file) ? this.scene.file : `'${this.scene.file.replaceAll("'", "'\\''")}'`;
        this.show("End of the recording", [`${clock(until - from)} of ${this.scene.title || this.scene.file} have been shown.`], [
            this.button("Again", "Play it from its beginning", () => this.page.send({ do: "pause", on: false }), true),
            this.button("Report", "The command that measures this recording", () => this.tell(["This measures the recording and writes report/index.html:"],
                `jostle report ${quoted} --out report`)),
        ]);
    }

    button(text, title, onclick, main = false) {
        return el("button", { type: "button", title, onclick, className: main ? "main" : "" }, text);
    }

    show(title, sentences, buttons, note = null) {
        this.more = el("div", { hidden: true, "aria-live": "polite" });
        const close = el("button", { type: "button", className: "close", "aria-label": "Close", title: "Close (Esc)", onclick: () => this.close() }, "×");
        fill(this.node, el("h2", { id: "end-title" }, title), sentences.map((text) => el("p", {}, text)),
            el("div", { className: "row" }, buttons), this.more,
            note ? el("p", { className: "faint" }, note) : null, close); // last in the order of Tab
        this.node.hidden = false;
        // Whoever types or plays elsewhere keeps the focus.
        const at = document.activeElement;
        if (at === document.body || at?.id === "picture") {
            this.node.querySelector("button").focus({ preventScroll: true });
        }
    }

    /** Shows a command below the buttons, ready to be copied. */
    tell(lines, command) {
        const copy = el("button", { type: "button", onclick: async () => {
            try {
                await navigator.clipboard.writeText(command);
                copy.textContent = "Copied";
            } catch {
                getSelection().selectAllChildren(code); // without permission the user copies what is selected
                copy.textContent = "Selected";
            }
        } }, "Copy");
        const code = el("code", { className: "code" }, command);
        fill(this.more, lines.filter(Boolean).map((line) => el("p", {}, line)), el("div", { className: "paste" }, code), copy);
        this.more.hidden = false;
    }

    hide() {
        const inside = this.node.contains(document.activeElement);
        this.node.hidden = true;
        if (inside) byId("picture").focus({ preventScroll: true });
    }

    /** Closes the card; false if it is closed. */
    close() {
        if (this.node.hidden) return false;
        this.hide();
        return true;
    }
}
