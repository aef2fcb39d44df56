// The machine as a graph: people in each state, and transitions per second.
import { el, figure, fill, say, svg } from "../dom.js";
import { BOX, layOut } from "./layout.js";
import { css, namedColour } from "../draw/palette.js";

export class MachinePage {
    /** `chosen(machine, state)` is called with the indices of a state that was clicked. */
    constructor(node, chosen) {
        this.node = node;
        this.chosen = chosen;
        this.at = 0;
        this.shown = "";
    }

    set(scene) {
        const machines = scene.machines ?? [];
        // Scene messages come on any change; unchanged parts are not rebuilt.
        const same = JSON.stringify([scene.states, machines.map((m) => [m.name, m.start, m.states.map((s) => s.name), m.transitions])]);
        this.scene = scene;
        this.machines = machines;
        if (same === this.shown) return;
        this.shown = same;
        this.at = Math.min(this.at, Math.max(0, machines.length - 1));
        this.build();
    }

    build() {
        if (this.machines.length === 0) {
            fill(this.node, el("p", { className: "faint" }, "This session has no state machines."));
            this.counts = this.fired = this.rates = [];
            return;
        }
        const machine = this.machines[this.at];
        const choice = el("select", { onchange: () => this.show(Number(choice.value)) },
            this.machines.map((m, i) => el("option", { value: String(i), selected: i === this.at }, m.name)));
        this.number = el("span", { className: "faint" });
        this.rates = machine.transitions.map(() => el("span", { className: "n faint" }));
        fill(this.node,
            el("div", { className: "row" }, el("label", {}, "Machine", choice), this.number),
            this.graph(machine),
            el("h2", {}, "Transitions"),
            el("ul", { className: "moves" }, machine.transitions.map((t, i) => el("li", {}, this.rates[i],
                el("strong", {}, t.reaction ? `${t.from}, reaction` : `${t.from} → ${t.back ? `back, or ${t.to}` : t.to}`), " ", el("code", {}, t.text ?? ""),
                el("span", { className: "faint" }, chance(t), t.line ? ` line ${t.line}` : "")))));
        if (this.status) this.take(this.status);
    }

    show(index) {
        this.at = index;
        this.build();
    }

    graph(machine) {
        const plan = layOut(machine);
        const first = (this.scene.states ?? []).findIndex((s) => s.machine === this.at);
        this.counts = machine.states.map(() => svg("text", { class: "count", y: 13 }, "0"));
        this.fired = plan.edges.map((e) => svg("text", { class: "fired", x: e.x, y: e.y + 4 }));
        this.paths = plan.edges.map((e, i) => svg("path", { class: "edge", d: e.path, "marker-end": "url(#tip)" },
            svg("title", {}, `${machine.transitions[i].from} to ${machine.transitions[i].to}: ${machine.transitions[i].text ?? ""}`)));
        this.nodes = machine.states.map((state, i) => {
            const { x, y } = plan.nodes[i];
            const dot = svg("circle", { cx: -BOX.wide / 2 + 11, cy: -9, r: 5 });
            dot.style.fill = css(namedColour(this.scene.states?.[Math.max(0, first) + i]));
            const node = svg("g", {
                class: `node${state.name === machine.start ? " start" : ""}`, transform: `translate(${x} ${y})`,
                tabindex: 0, role: "button", "aria-label": `State ${state.name}: its parameters`,
            }, svg("rect", { x: -BOX.wide / 2, y: -BOX.high / 2, width: BOX.wide, height: BOX.high, rx: 8 }), dot,
            svg("text", { y: -4, x: 6 }, short(state.name)), this.counts[i], svg("title", {}, state.name));
            const act = () => this.chosen(this.at, i);
            node.addEventListener("click", act);
            node.addEventListener("keydown", (event) => {
                if (event.key !== "Enter" && event.key !== " ") return;
                event.preventDefault();
                act();
            });
            return node;
        });
        const tip = svg("marker", { id: "tip", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto" },
            svg("path", { d: "M0 0.5 L8 4 L0 7.5 z", fill: "var(--faint)" }));
        return svg("svg", { class: "graph", viewBox: `0 0 ${plan.width} ${plan.height}`, role: "group", "aria-label": `States of ${machine.name}` },
            svg("defs", {}, tip), this.paths, this.nodes, this.fired);
    }

    take(status) {
        this.status = status;
        if (!this.machines?.length) return;
        const counts = status.states?.[this.at] ?? [], fired = status.fired?.[this.at] ?? [];
        say(this.number, `${figure(counts.reduce((a, b) => a + b, 0))} agents`);
        this.counts.forEach((node, i) => say(node, figure(counts[i] ?? 0)));
        this.fired.forEach((node, i) => {
            say(node, fired[i] ? `${figure(fired[i])}/s` : "");
            say(this.rates[i], `${figure(fired[i] ?? 0)} a second`);
            this.paths[i].classList.toggle("busy", fired[i] > 0);
        });
    }

    /** Marks the state of the chosen person. */
    mark(name, state) {
        const machine = this.machines?.[this.at];
        this.nodes?.forEach((node, i) => node.classList.toggle("chosen", machine?.name === name && machine.states[i].name === state));
    }
}

function short(name) {
    return name.length > 13 ? `${name.slice(0, 12)}…` : name;
}

function chance(transition) {
    const p = transition.chance;
    return p === undefined || p === null || p === 1 ? "" : ` with chance ${figure(p)}`;
}
