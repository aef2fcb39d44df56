// The legend: what the colours of people and of the floor mean, with units.
import { byId, el, figure, fill, say } from "../dom.js";
import { classColour, COLOURS, css, FIELDS, namedColour, serviceColour, unitText, valueColour, wayColour } from "../draw/palette.js";

function ramp(calm = false) {
    const canvas = el("canvas", { width: 128, height: 1, "aria-hidden": "true" });
    const pen = canvas.getContext("2d");
    for (let i = 0; i < 128; i++) {
        pen.fillStyle = css(valueColour(i / 127, calm));
        pen.fillRect(i, 0, 1, 1);
    }
    return canvas;
}

const MANY = 8; // up to this number of states, empty ones are shown, too

export class Legend {
    constructor() {
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
        this.build();
    }

    fieldOf(of) {
        this.of = of;
        this.build();
    }

    build() {
        this.counts = null;
        const people = COLOURS[this.by].classes ? this.classes() : this.values();
        fill(this.node, people, this.of === "none" ? null : this.floor());
        this.numbers();
    }

    classes() {
        const several = (this.scene?.machines?.length ?? 0) > 1;
        const names = this.by === "group" ? (this.scene?.groups ?? []).map((g) => g.name)
            : COLOURS[this.by].names ?? (this.scene?.states ?? []).map((s) => (several ? `${this.scene.machines[s.machine]?.name} ${s.name}` : s.name));
        this.counts = names.map(() => el("span", { className: "faint" }));
        this.sums = [];
        return el("ul", { "aria-label": `People by ${COLOURS[this.by].name}` }, names.map((name, i) => {
            const swatch = el("span", { className: "swatch" });
            swatch.style.background = css(this.classColour(i));
            return [this.by === "state" ? this.outerRows(i, several) : null, el("li", {}, swatch, name, " ", this.counts[i])];
        }));
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
        if (this.high) say(this.high, figure(this.most));
        if (this.fieldHigh) say(this.fieldHigh, figure(this.fieldMost));
    }

    /** Sets the value of 255, for people, or for the floor if `field`. */
    setMost(value, field = false) {
        if (field) this.fieldMost = value;
        else this.most = value;
        this.numbers();
    }

    take(status) {
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
            this.counts[i].parentElement.hidden = this.counts.length > MANY && !n; // of more states, only those with people are shown
        });
    }
}
