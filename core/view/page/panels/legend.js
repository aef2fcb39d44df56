// The legend: what the colours of people and of the floor mean, with units.
import { byId, el, figure, fill, say } from "../dom.js";
import { classColour, CLASSES_TOLD, COLOURS, css, FIELDS, namedColour, outerStates, serviceColour, unitText, valueColour, wayColour } from "../draw/palette.js";

function ramp(calm = false) {
    const canvas = el("canvas", { width: 128, height: 1, "aria-hidden": "true" });
    const pen = canvas.getContext("2d");
    for (let i = 0; i < 128; i++) {
        pen.fillStyle = css(valueColour(i / 127, calm));
        pen.fillRect(i, 0, 1, 1);
    }
    return canvas;
}

const MANY = CLASSES_TOLD; // up to this number of states, empty ones are shown, too
const SHADES = ["", "pale ", "dark "]; // of classes beyond those with a colour of their own
const OWN_RANGE = "The range holds 98 % of this scene's figures, outliers aside: the colour of its end means that or more. Press for the range that all scenes share";
const SHARED_RANGE = "The range is the one that all scenes share. Press for one that fits this scene";

export class Legend {
    /** `page`: {keep(function of a class, or null), fix(on)} */
    constructor(page) {
        this.page = page;
        this.fixed = false;
        this.kept = null; // the class that alone keeps its colour
        this.node = byId("legend");
        this.by = "state";
        this.of = "none";
        this.most = 0;
        this.fieldMost = 0;
        this.scene = null;
    }

    set(scene) {
        this.scene = scene;
        this.build();
    }

    colourBy(by) {
        this.by = by;
        this.kept = null;
        this.build();
    }

    fieldOf(of) {
        this.of = of;
        this.build();
    }

    build() {
        this.counts = this.high = this.fieldHigh = null;
        const people = COLOURS[this.by].classes ? this.classes() : this.values();
        fill(this.node, people, this.of === "none" ? null : this.floor(), this.high || this.fieldHigh ? this.rangeButton() : null);
        this.numbers();
    }

    /** Switches between the range of this scene and the one of all. */
    rangeButton() {
        return el("button", { type: "button", "aria-pressed": String(this.fixed), title: this.fixed ? SHARED_RANGE : OWN_RANGE,
            onclick: () => this.page.fix(!this.fixed) }, "Fixed range");
    }

    /** Lets one class alone keep its colour, or all of them again. */
    keep(i) {
        this.kept = this.kept === i ? null : i;
        for (const [k, button] of this.buttons.entries()) button.setAttribute("aria-pressed", String(k === this.kept));
        const outer = this.by === "outer" ? outerStates(this.scene) : null;
        this.page.keep(this.kept === null ? null : outer ? (k) => outer[k]?.machine === this.outer[i].machine && outer[k]?.name === this.outer[i].name : (k) => k === i);
    }

    classes() {
        const several = (this.scene?.machines?.length ?? 0) > 1;
        const called = (s) => (several ? `${this.scene.machines[s.machine]?.name} ${s.name}` : s.name);
        this.outer = [...new Set(outerStates(this.scene))];
        const names = this.by === "group" ? (this.scene?.groups ?? []).map((g) => g.name)
            : COLOURS[this.by].names ?? (this.by === "outer" ? this.outer : this.scene?.states ?? []).map(called);
        this.counts = names.map(() => el("span", { className: "faint" }));
        this.sums = [];
        const ownTable = ["state", "group", "outer"].includes(this.by);
        this.buttons = names.map((name, i) => {
            const swatch = el("span", { className: "swatch", "data-shape": ownTable ? String(Math.floor(i / CLASSES_TOLD) % 3) : "0" });
            swatch.style.background = css(this.classColour(i));
            const shade = ownTable ? SHADES[Math.floor(i / CLASSES_TOLD) % 3] : "";
            if (!ownTable) return el("span", {}, swatch, name);
            return el("button", { type: "button", className: "class", "aria-pressed": String(i === this.kept),
                title: `${shade ? `A ${shade}colour. ` : ""}Press: only ${name} in colour`, onclick: () => this.keep(i) }, swatch, name, " ", this.counts[i]);
        });
        return el("ul", { "aria-label": `People by ${COLOURS[this.by].name}` }, this.buttons.map((button, i) =>
            [this.by === "state" ? this.outerRows(i, several) : null, el("li", {}, button)]));
    }

    /** Rows of the states that run a machine whose first state is the i-th of all states: they count all within them. */
    outerRows(i, several) {
        const states = this.scene?.states ?? [], machine = states[i]?.machine;
        const first = states.findIndex((s) => s.machine === machine);
        const rows = (this.scene?.machines?.[machine]?.outer ?? []).filter((outer) => first + outer.within[0] === i);
        return rows.map((outer) => {
            const count = el("span", { className: "faint" });
            const row = el("li", { className: "sum" }, several ? `${this.scene.machines[machine].name} ${outer.name}` : outer.name, " ", count);
            this.sums.push({ machine, within: outer.within, count, row });
            return row;
        });
    }

    classColour(i) {
        if (this.by === "service") return serviceColour(i);
        if (this.by === "direction") return wayColour(i / 4);
        if (COLOURS[this.by].at) return classColour(COLOURS[this.by].at[i]);
        if (this.by === "outer") return namedColour(this.outer[i]);
        return namedColour(this.scene?.[this.by === "group" ? "groups" : "states"]?.[i]);
    }

    values() {
        const colour = COLOURS[this.by], unit = unitText(this.scene?.colours?.[this.by]?.unit ?? colour.unit);
        this.high = el("span");
        return el("span", { className: "ramp" }, `People: ${colour.name}`, el("span", {}, "0"), ramp(colour.table === "calm"), this.high, unit);
    }

    floor() {
        this.fieldHigh = el("span");
        return el("span", { className: "ramp" }, `Floor: ${FIELDS[this.of].name}`, el("span", {}, "0"), ramp(), this.fieldHigh, FIELDS[this.of].unit);
    }

    numbers() {
        if (this.high) say(this.high, `≥ ${figure(this.most)}`);
        if (this.fieldHigh) say(this.fieldHigh, `≥ ${figure(this.fieldMost)}`);
    }

    /** Sets the value of 255, for people, or for the floor if `field`. */
    setMost(value, field = false) {
        if (field) this.fieldMost = value;
        else this.most = value;
        this.numbers();
    }

    take(status) {
        if (this.fixed !== Boolean(status.fixed)) {
            this.fixed = Boolean(status.fixed);
            this.build();
        }
        if (this.by === "outer") this.takeOuter(status);
        if (this.by !== "state" || !this.counts) return;
        // Counts are by machine; the legend has the global list of states.
        for (const { machine, within, count, row } of this.sums) {
            const n = within.reduce((sum, s) => sum + (status.states?.[machine]?.[s] ?? 0), 0);
            say(count, figure(n));
            row.hidden = this.counts.length > MANY && !n;
        }
        const at = {};
        (this.scene.states ?? []).forEach((state, i) => {
            const k = at[state.machine] ?? 0;
            at[state.machine] = k + 1;
            const n = status.states?.[state.machine]?.[k];
            if (!this.counts[i]) return;
            say(this.counts[i], n === undefined ? "" : figure(n));
            this.counts[i].closest("li").hidden = this.counts.length > MANY && !n; // of more states, only those with people are shown
        });
    }

    /** Counts people by outer state. */
    takeOuter(status) {
        const counts = this.outer.map(() => 0), at = {};
        outerStates(this.scene).forEach((outer) => {
            const k = at[outer.machine] ?? 0;
            at[outer.machine] = k + 1;
            counts[this.outer.findIndex((o) => o.machine === outer.machine && o.name === outer.name)] += status.states?.[outer.machine]?.[k] ?? 0;
        });
        counts.forEach((n, i) => {
            say(this.counts[i], figure(n));
            this.counts[i].closest("li").hidden = counts.length > MANY && !n;
        });
    }
}
