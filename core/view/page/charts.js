// Charts of what the server reports four times a second, kept by the page since the start.
import { Chart } from "./chart.js";
import { el, fill } from "./dom.js";
import { classColour, css } from "./palette.js";

const KEPT = 2400; // points a series; then every second one goes
const STAGES = ["perceive", "think", "prefer", "push", "solve", "move", "bodies", "infer", "observe"];

/** Values over time, of names that may come and go. */
class Series {
    constructor() {
        this.clear();
    }

    clear() {
        this.times = [];
        this.values = new Map();
    }

    /** `numbers`: {name: value} at time `t`, s. Time that goes back starts anew. */
    add(t, numbers) {
        const last = this.times[this.times.length - 1];
        if (last !== undefined && t < last) this.clear();
        if (t === last) return;
        for (const name of Object.keys(numbers)) {
            if (!this.values.has(name)) this.values.set(name, Array(this.times.length).fill(NaN));
        }
        this.times.push(t);
        for (const [name, list] of this.values) list.push(numbers[name] ?? NaN);
        if (this.times.length <= KEPT) return;
        const thin = (list) => list.filter((_, i) => i % 2 === 0);
        this.times = thin(this.times);
        for (const [name, list] of this.values) this.values.set(name, thin(list));
    }

    list(colour) {
        return [...this.values].map(([name, values], i) => ({ name, values, colour: colour(i, name) }));
    }
}

export class ChartsPage {
    constructor(node) {
        this.node = node;
        this.census = []; // of each machine
        this.speed = new Series();
        this.dense = new Series();
        this.failures = new Series();
        this.flows = new Series();
        this.stages = new Series();
        this.charts = {
            census: new Chart({ title: "People in each state", unit: "agents" }),
            flows: new Chart({ title: "Passed through lines", unit: "agents" }),
            speed: new Chart({ title: "Mean speed", unit: "m/s" }),
            dense: new Chart({ title: "Greatest density", unit: "1/m²" }),
            failures: new Chart({ title: "Programs without a solution", unit: "%" }),
            stages: new Chart({ title: "Time of a step", unit: "ns per agent" }),
        };
        this.machine = el("select", { onchange: () => this.draw() });
        this.choice = el("label", {}, "Machine", this.machine);
        fill(node, el("div", { className: "row" }, this.choice), Object.values(this.charts).map((c) => c.node));
    }

    set(hello) {
        this.hello = hello;
        const names = (hello.machines ?? []).map((m) => m.name);
        if (names.join() !== [...this.machine.options].map((o) => o.textContent).join()) {
            fill(this.machine, names.map((name, i) => el("option", { value: String(i) }, name)));
            this.census = names.map(() => new Series());
        }
        this.choice.hidden = names.length < 2;
        this.charts.flows.node.hidden = !(hello.charts?.length > 0);
        const live = hello.session !== "replay";
        this.charts.stages.node.hidden = this.charts.failures.node.hidden = !live;
        this.charts.census.node.hidden = names.length === 0;
    }

    take(status) {
        const t = status.time;
        (status.census ?? []).forEach((counts, m) => {
            const states = this.hello?.machines?.[m]?.states ?? [];
            this.census[m]?.add(t, Object.fromEntries(counts.map((n, i) => [states[i]?.name ?? String(i), n])));
        });
        if (Number.isFinite(status.mean_speed)) this.speed.add(t, { "": status.mean_speed });
        if (Number.isFinite(status.density_max)) this.dense.add(t, { "": status.density_max });
        if (Number.isFinite(status.failures)) this.failures.add(t, { "": 100 * status.failures });
        this.flows.add(t, status.flows ?? {});
        const stages = Object.entries(status.stage_ns ?? {}).map(([name, ns]) => [name, ns]);
        if (stages.length) this.stages.add(t, { all: stages.reduce((s, [, ns]) => s + ns, 0), ...Object.fromEntries(stages) });
        this.draw();
    }

    draw() {
        if (this.node.hidden || !this.node.isConnected) return;
        const m = Number(this.machine.value) || 0;
        const first = Math.max(0, (this.hello?.states ?? []).findIndex((s) => s.machine === m));
        const classes = (i) => css(classColour(i));
        const one = () => "#0072b2";
        const stage = (i, name) => (name === "all" ? "#888888" : css(classColour(Math.max(0, STAGES.indexOf(name)))));
        const census = this.census[m];
        if (census) this.charts.census.draw(census.times, census.list((i) => classes(first + i)));
        this.charts.speed.draw(this.speed.times, this.speed.list(one));
        this.charts.dense.draw(this.dense.times, this.dense.list(one));
        if (!this.charts.flows.node.hidden) this.charts.flows.draw(this.flows.times, this.flows.list(classes));
        if (this.charts.stages.node.hidden) return;
        this.charts.failures.draw(this.failures.times, this.failures.list(one));
        this.charts.stages.draw(this.stages.times, this.stages.list(stage));
    }
}
