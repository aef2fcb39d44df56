// Parameters of a state, changed while the run goes on; and the line of Lua that makes a change permanent.
import { el, figure, fill, say } from "../dom.js";
import { unitText } from "../draw/palette.js";
import { settingsPart } from "./settings.js";

const PERIOD = 100; // ms between commands of one slider

export class ParametersPage {
    /** `page`: {connection} */
    constructor(node, page) {
        this.node = node;
        this.page = page;
        this.machine = 0;
        this.state = 0;
        this.changed = new Map(); // "machine state parameter" -> value set on this page
        this.shown = "";
        node.addEventListener("pointerdown", (event) => (this.held = event.target.type === "range"));
        window.addEventListener("pointerup", () => {
            this.held = false;
            if (this.late) this.build();
            this.late = false;
        });
    }

    set(scene) {
        this.machines = scene.machines ?? [];
        this.allowed = Boolean(scene.tools?.parameters);
        this.mods = scene.mods ?? [];
        const same = JSON.stringify([this.allowed, this.machines, this.mods]);
        if (same === this.shown) return;
        this.shown = same;
        this.changed.clear(); // values are now those of the files, or came with the scene message
        this.machine = Math.min(this.machine, Math.max(0, this.machines.length - 1));
        this.build();
    }

    /** Opens the state with most people, unless the user chose one; a state that is shown stays. */
    take(status) {
        if (this.chosen || (this.opened && !this.node.hidden) || !this.machines?.length || !status.states?.length) return;
        const counts = status.states.flatMap((states, m) => states.map((n, s) => [n, m, s]));
        const [most, machine, state] = counts.reduce((a, b) => (b[0] > a[0] ? b : a));
        if (most === 0) return;
        if (this.opened && machine === this.machine && state === this.state) return;
        this.opened = true;
        this.machine = machine;
        this.state = state;
        this.build();
    }

    /** Shows a state, by indices. */
    show(machine, state) {
        this.chosen = true;
        this.machine = machine;
        this.state = state;
        this.build();
    }

    build() {
        if (this.held) { // a slider is being dragged
            this.late = true;
            return;
        }
        const focus = this.focus();
        const machine = this.machines?.[this.machine];
        const mods = settingsPart(this.mods ?? [], this.allowed, (...words) => this.page.connection.input("setting", ...words.map(quote)));
        if (!machine) return void fill(this.node, mods, el("p", { className: "faint" }, "This session has no state machines."));
        const states = [...machine.states, ...machine.outer ?? [], ...machine.defaults ? [{ name: "defaults", parameters: machine.defaults }] : []];
        this.state = Math.min(this.state, states.length - 1);
        const choose = (list, at, change, order = list.map((_, i) => i)) => {
            const node = el("select", { onchange: () => change(Number(node.value)) },
                order.map((i) => el("option", { value: String(i), selected: i === at }, list[i].within ? `${list[i].name}, with all within it` : list[i].name)));
            return node;
        };
        const state = states[this.state];
        this.paste = el("div", { className: "paste", hidden: true });
        fill(this.node, mods, el("div", { className: "row" },
            el("label", {}, "Machine", choose(this.machines, this.machine, (i) => this.show(i, 0))),
            el("label", {}, "State", choose(states, this.state, (i) => this.show(this.machine, i), inOrder(states)))),
        el("p", { className: "faint" }, this.allowed
            ? `A change holds for everybody in ${state.within ? "the states within it" : "this state"}, now and later, until the file is saved again.`
            : "This scene does not let the page change parameters."),
        this.paste, this.list(machine, state));
        this.focus(focus);
    }

    /** Returns which control has the focus; given that, restores it after a rebuild. */
    focus(which) {
        if (which) return this.node.querySelector(which)?.focus();
        const at = document.activeElement, part = this.node.contains(at) && at.closest("[data-parameter]");
        return part ? `[data-parameter="${CSS.escape(part.dataset.parameter)}"] ${at.type ? `[type="${at.type}"]` : at.localName}` : null;
    }

    /** Sorts parameters: first those that files or people set, then the engine's defaults. */
    list(machine, state) {
        const own = [], rest = [];
        for (const p of state.parameters) {
            const mine = p.set !== "engine" || this.changed.has(`${machine.name} ${state.name} ${p.name}`);
            (mine ? own : rest).push(this.parameter(machine, state, p));
        }
        if (rest.length === 0) return own;
        const name = `${rest.length} more, as the engine has them`;
        return [own, el("details", { open: own.length === 0 || this.unfolded, ontoggle: (event) => (this.unfolded = event.target.open) },
            el("summary", {}, name), rest)];
    }

    parameter(machine, state, p) {
        const key = `${machine.name} ${state.name} ${p.name}`;
        const value = this.changed.get(key) ?? p.value;
        const unit = p.unit ? ` ${unitText(p.unit)}` : "";
        const from = el("span", { className: "from" }, this.changed.has(key) ? "set on this page" : p.set ?? "");
        const text = value === null || value === undefined ? p.text ?? "" : "";
        const part = el("div", { className: "parameter", "data-parameter": p.name }, el("div", { className: "row" }, el("strong", {}, p.name),
            text ? el("code", {}, text) : null, from));
        if (p.apart?.length) part.append(el("p", { className: "faint" }, `${p.apart.join(", ")} ${p.apart.length > 1 ? "set their own" : "sets its own"}`));
        if (!this.allowed) {
            if (!text) part.firstChild.append(`${figure(value)}${unit}`);
            return part;
        }
        const [least, most, step] = range(p, value);
        const slider = el("input", { type: "range", min: least, max: most, step, value: value ?? least, "aria-label": `${p.name}${unit}` });
        const number = el("input", { type: "number", step: "any", value: value ?? "", placeholder: text ? "–" : "", "aria-label": `${p.name} as a number${unit}` });
        const lua = el("button", { type: "button", title: "The line of Lua that keeps this value", disabled: value === null || value === undefined,
            onclick: () => this.page.connection.send({ do: "lua", machine: machine.name, state: state.name, parameter: p.name, value: Number(number.value) }) }, "Lua");
        const change = (v) => {
            if (!Number.isFinite(v)) return;
            this.changed.set(key, v);
            say(from, "set on this page");
            lua.disabled = false;
            this.send(key, ["set", machine.name, state.name, p.name, v]);
        };
        slider.addEventListener("input", () => {
            number.value = slider.value;
            change(Number(slider.value));
        });
        number.addEventListener("change", () => {
            if (number.value === "") return;
            slider.value = number.value;
            change(Number(number.value));
        });
        part.append(el("div", { className: "row" }, slider, number, el("span", { className: "faint" }, unit), lua));
        return part;
    }

    /** Sends the newest value, at most every PERIOD. */
    send(key, words) {
        this.waiting ??= new Map();
        const first = !this.waiting.has(key);
        this.waiting.set(key, words);
        if (!first) return;
        setTimeout(() => {
            const last = this.waiting.get(key);
            this.waiting.delete(key);
            this.page.connection.input(...last);
        }, PERIOD);
    }

    /** Shows the line of Lua in the server's answer. */
    takeLua(text) {
        if (!this.paste) return;
        const copied = el("span", { className: "faint", role: "status" });
        const code = el("code", { className: "code" }, text);
        const copy = el("button", { type: "button", onclick: () => copyText(text, code, copied) }, "Copy");
        this.paste.hidden = false;
        fill(this.paste, el("div", { className: "row" }, "To keep it, write in the file:", copy, copied), code);
        this.paste.scrollIntoView({ block: "nearest" });
    }
}

/** Indices of states in the order of a list: those that run a machine come before the states within them. */
function inOrder(states) {
    const first = (i) => states[i].within?.[0] ?? i;
    return states.map((_, i) => i).sort((a, b) => first(a) - first(b) || (states[b].within?.length ?? 0) - (states[a].within?.length ?? 0));
}

/** A word of an input line; one with blanks stands in quotes. */
function quote(word) {
    return /[\s"\\]/.test(word) ? `"${word.replace(/["\\]/g, "\\$&")}"` : word;
}

async function copyText(text, code, said) {
    try {
        await navigator.clipboard.writeText(text);
        say(said, "copied");
    } catch { // without permission to copy, the text is at least selected
        window.getSelection().selectAllChildren(code);
        say(said, "selected: copy it with Ctrl+C");
    }
}

/** Ends and step of a slider: the parameter's own range if it is narrow enough, else one around its value. */
function range(p, value) {
    const size = Math.abs(value ?? 0) || 1;
    const least = Number.isFinite(p.least) && p.least > -4 * size - 10 ? p.least : -3 * size;
    const handy = Number.isFinite(p.most) && p.most <= 20 * size;
    let most = handy ? p.most : Math.min(Number.isFinite(p.most) ? p.most : Infinity, 4 * size);
    if (p.unit === "N" && !handy) most = Math.max(most, 600);
    const step = 10 ** Math.floor(Math.log10(Math.max(1e-6, (most - least) / 200)));
    return [least, Math.max(most, value ?? 0), Number(step.toPrecision(1))];
}
