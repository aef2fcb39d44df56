// The first tab: what the scene is, what to try, and its present state.
import { clock, el, figure, fill, say } from "../dom.js";
import { SERVICE } from "../draw/palette.js";
import { TOOLS } from "../controls/tools.js";

const TRIES = { throw: "Throw a box", drag: "Drag a body", push: "Push somebody" };

const COARSE = 1.1; // m, R of a kernel beyond which a density is too smooth for a level of service

/** The row of a greatest density, 1/m², of a Gaussian with R = `r`, m. A level of service only where R is about 1 m. */
export function densityText(dense, r) {
    const level = SERVICE.find(([, up]) => dense < up)?.[0];
    return `${figure(dense)} per m² (Gaussian, R = ${figure(r)} m), ${r > COARSE
        ? "coarse, as people are far apart: no level of service" : `level of service ${level}`}`;
}

export class ScenePage {
    /** `page`: {tool(name), show(tab), lifts(counts): rows [name, text]} */
    constructor(node, page) {
        this.page = page;
        this.title = el("h2");
        this.about = el("p");
        this.tries = el("div", { className: "row" });
        this.files = el("p", { className: "faint" });
        this.figures = el("dl", { className: "pairs" });
        this.exits = el("dl", { className: "pairs" });
        this.exitPart = el("div", { hidden: true }, el("h2", {}, "Passed, people"), this.exits);
        this.lifts = el("dl", { className: "pairs" });
        this.liftPart = el("div", { hidden: true }, el("h2", {}, "Lifts"), this.lifts);
        this.hints = el("ul");
        this.hintPart = el("div", { hidden: true }, el("h2", {}, "Hints on the behaviours"), this.hints);
        fill(node, this.title, this.about, el("h2", {}, "To try"),
            el("p", { className: "faint" }, "Click a person: what it wants, sees and feels, and why. Space stops the time."), this.tries,
            this.files, el("h2", {}, "Now"), this.figures, this.liftPart, this.exitPart, this.hintPart);
        this.rows = new Map();
    }

    set(scene) {
        say(this.title, scene.title || scene.file || "Jostle");
        const groups = (scene.groups ?? []).map((g) => g.name), bodies = (scene.bodies ?? []).length;
        const names = groups.slice(0, 6).join(", ") + (groups.length > 6 ? ", and others" : "");
        say(this.about, scene.about || `${groups.length === 1 ? "One group" : `${groups.length} groups`} of people: ${names}${bodies ? `; ${bodies} bodies` : ""}.`);
        const live = scene.session !== "replay";
        say(this.files, live ? "Files of behaviours and of the scene take effect as soon as they are saved." : "This is a recording: the bar below goes to any time of it.");
        fill(this.tries, Object.entries(TRIES).filter(([tool]) => scene.tools?.[tool]).map(([tool, text]) =>
            el("button", { type: "button", title: TOOLS[tool].hint, onclick: () => this.page.tool(tool) }, text)),
        scene.tools?.parameters ? el("button", { type: "button", onclick: () => this.page.show("parameters") }, "Change how they behave") : null);
    }

    take(status) {
        const dense = status.density_max;
        const rows = { "time": clock(status.time), "people": figure(status.agents), "mean speed": `${figure(status.mean_speed)} m/s` };
        if (Number.isFinite(dense)) rows["greatest density now"] = densityText(dense, status.density_r);
        if (status.bodies) rows["bodies"] = figure(status.bodies);
        this.show(this.figures, rows);
        const lifts = this.page.lifts(status.lifts);
        this.liftPart.hidden = lifts.length === 0;
        this.show(this.lifts, Object.fromEntries(lifts));
        this.showHints(status.hints ?? []);
        const flows = status.flows ?? {};
        this.exitPart.hidden = Object.keys(flows).length === 0;
        this.show(this.exits, Object.fromEntries(Object.entries(flows).map(([name, n]) => [name, figure(n)])));
    }

    /** Shows sentences on parts of the scene that have had no effect so far; mostly there are none. */
    showHints(hints) {
        const known = hints.join("\n");
        if (this.hinted === known) return;
        this.hinted = known;
        this.hintPart.hidden = hints.length === 0;
        fill(this.hints, hints.map((hint) => el("li", {}, hint)));
    }

    /** Shows rows of names and values; only changed ones are written again. */
    show(list, rows) {
        const names = Object.keys(rows).join("\n");
        if (this.rows.get(list)?.names !== names) {
            const cells = Object.fromEntries(Object.keys(rows).map((name) => [name, el("dd")]));
            fill(list, Object.entries(cells).map(([name, cell]) => [el("dt", {}, name), cell]));
            this.rows.set(list, { names, cells });
        }
        for (const [name, text] of Object.entries(rows)) say(this.rows.get(list).cells[name], text);
    }
}
