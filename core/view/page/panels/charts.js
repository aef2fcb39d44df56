// Charts of what the server reports four times a second, kept by the page since the start.
import { Chart } from "./chart.js";
import { el, fill } from "../dom.js";
import { classColour, css, namedColour } from "../draw/palette.js";

const KEPT = 2400; // most points per series; beyond, every second one is dropped
const STAGES = ["perceive", "think", "prefer", "push", "solve", "move", "bodies", "infer", "observe"];

/** Values over time, of names that may come and go. Times ascend; a line leads from one point to the
    next only where all between them was seen. */
export class Series {
    constructor() {
        this.clear();
    }

    clear() {
        this.times = [];
        this.values = new Map();
        this.seen = []; // by point: whether the page saw all of the time since the previous point
    }

    /** `numbers`: {name: value} at time `t`, s. `since`: the page has seen all from this time until `t`, or
        behind it, where it went backwards; undefined after a jump. */
    add(t, numbers, since) {
        for (const name of Object.keys(numbers)) {
            if (!this.values.has(name)) this.values.set(name, Array(this.times.length).fill(NaN));
        }
        let at = this.times.length;
        while (at > 0 && this.times[at - 1] >= t) at--;
        if (this.times[at] !== t) {
            this.times.splice(at, 0, t);
            this.seen.splice(at, 0, this.seen[at] ?? false); // both halves of an interval that was seen are seen
            for (const [name, list] of this.values) list.splice(at, 0, numbers[name] ?? NaN);
        }
        const from = Math.min(t, since ?? t), to = Math.max(t, since ?? t);
        for (let i = 1; i < this.times.length; i++) {
            if (this.times[i - 1] >= from && this.times[i] <= to) this.seen[i] = true;
        }
        if (this.times.length > KEPT) this.thin();
    }

    thin() {
        const half = (list) => list.filter((_, i) => i % 2 === 0);
        this.seen = half(this.seen.map((seen, i) => seen && (this.seen[i - 1] ?? true)));
        this.times = half(this.times);
        for (const [name, list] of this.values) this.values.set(name, half(list));
    }

    /** Draws onto a chart, with gaps for times that the page did not see. */
    draw(chart, colour) {
        const spread = (list, gap) => list.flatMap((v, i) => (i > 0 && !this.seen[i] ? [gap(i), v] : [v]));
        chart.draw(spread(this.times, (i) => this.times[i]), [...this.values].map(([name, values], i) => (
            { name, values: spread(values, () => NaN), colour: colour(i, name) })));
    }
}

export class ChartsPage {
    /** `engine`: the node of charts for engineers. */
    constructor(node, engine) {
        this.node = node;
        this.engine = engine;
        this.states = []; // counts by state, of each machine
        this.speed = new Series();
        this.dense = new Series();
        this.failures = new Series();
        this.flows = new Series();
        this.stages = new Series();
        this.last = null; // status
        this.charts = {
            states: new Chart({ title: "People in each state", unit: "agents" }),
            flows: new Chart({ title: "Passed through lines, as their probes count", unit: "agents" }),
            speed: new Chart({ title: "Mean speed", unit: "m/s" }),
            dense: new Chart({ title: "Greatest density at each moment (Gaussian)", unit: "1/m²" }),
            failures: new Chart({ title: "Programs without a solution", unit: "%" }),
            stages: new Chart({ title: "Time of a step", unit: "ns per agent" }),
        };
        this.machine = el("select", { onchange: () => this.draw() });
        this.choice = el("label", {}, "Machine", this.machine);
        const { failures, stages, ...crowd } = this.charts;
        fill(node, el("div", { className: "row" }, this.choice), Object.values(crowd).map((c) => c.node));
        fill(engine, el("p", { className: "faint" }, "The cost of a step, and the people whose linear program has no solution: they take the velocity that violates it least."),
            stages.node, failures.node);
    }

    set(scene) {
        this.scene = scene;
        const names = (scene.machines ?? []).map((m) => m.name);
        if (names.join() !== [...this.machine.options].map((o) => o.textContent).join()) {
            fill(this.machine, names.map((name, i) => el("option", { value: String(i) }, name)));
            this.states = names.map(() => new Series());
        }
        this.choice.hidden = names.length < 2;
        this.charts.flows.node.hidden = !(scene.charts?.length > 0);
        this.live = scene.session !== "replay";
        this.charts.states.node.hidden = names.length === 0;
    }

    /** Marks a gap: the page did not get all data between the last point and the next. */
    lost() {
        this.last = null;
    }

    take(status) {
        const t = status.time, last = this.last;
        if (this.live && this.speed.times[this.speed.times.length - 1] > t) { // the run was restarted
            for (const series of [...this.states, this.speed, this.dense, this.failures, this.flows, this.stages]) series.clear();
        }
        const since = last && last.jumps === status.jumps && (!this.live || last.time <= t) ? last.time : undefined;
        this.last = status;
        (status.states ?? []).forEach((counts, m) => {
            const states = this.scene?.machines?.[m]?.states ?? [];
            this.states[m]?.add(t, Object.fromEntries(counts.map((n, i) => [states[i]?.name ?? String(i), n])), since);
        });
        if (Number.isFinite(status.mean_speed)) this.speed.add(t, { "": status.mean_speed }, since);
        if (Number.isFinite(status.density_max)) this.dense.add(t, { "": status.density_max }, since);
        if (Number.isFinite(status.failures)) this.failures.add(t, { "": 100 * status.failures }, since);
        this.flows.add(t, status.flows ?? {}, since);
        const stages = Object.entries(status.stage_ns ?? {}).map(([name, ns]) => [name, ns]);
        if (stages.length) this.stages.add(t, { all: stages.reduce((s, [, ns]) => s + ns, 0), ...Object.fromEntries(stages) }, since);
        this.draw();
    }

    draw() {
        if (!this.engine.hidden) this.drawEngine();
        if (this.node.hidden || !this.node.isConnected) return;
        const m = Number(this.machine.value) || 0;
        const first = Math.max(0, (this.scene?.states ?? []).findIndex((s) => s.machine === m));
        const classes = (i) => css(classColour(i));
        const one = () => "#0072b2";
        const counts = this.states[m];
        if (counts) counts.draw(this.charts.states, (i) => css(namedColour(this.scene?.states?.[first + i])));
        this.speed.draw(this.charts.speed, one);
        this.dense.draw(this.charts.dense, one);
        if (!this.charts.flows.node.hidden) this.flows.draw(this.charts.flows, classes);
    }

    drawEngine() {
        this.failures.draw(this.charts.failures, () => "#0072b2");
        this.stages.draw(this.charts.stages, (i, name) => (name === "all" ? "#888888" : css(classColour(Math.max(0, STAGES.indexOf(name))))));
    }
}
