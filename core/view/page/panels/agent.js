// One person: state, parameters and who set them, memory, why it came here, forces, velocities.
import { amount, clock, el, figure, fill, say, svg } from "../dom.js";
import { FORCE_COLOURS } from "../draw/overlay.js";
import { drawVelocities, PLANE_COLOURS } from "./velocity.js";

const KINDS = { agent: "other people", wall: "walls", contact: "what it touches", body: "bodies", force: "forces" };

function swatch(colour) {
    const node = el("span", { className: "swatch" });
    node.style.background = colour;
    return node;
}

/** Rows of names and values. */
function pairs(list) {
    return el("dl", { className: "pairs" }, list.map(([name, value]) => [el("dt", {}, name), el("dd", {}, value)]));
}

/** Rows of a torso: {breadth, depth: m, chest: degrees, spin: degrees/s or undefined}; none of a disc. */
function torsoRows(torso) {
    if (!torso) return [];
    const spin = torso.spin === undefined ? "" : `, turning by ${Math.round(torso.spin)}°/s`;
    return [["breadth, depth", `${figure(torso.breadth)} m, ${figure(torso.depth)} m`], ["chest", `to ${Math.round(torso.chest) % 360}°${spin}`]];
}

/** Where somebody is, with storeys the name of theirs, or of the stair, and the height of its floor. */
function placeText({ x, y, storey, height }) {
    return `${figure(x)}, ${figure(y)} m${storey ? ` on ${storey}, ${height.toFixed(1)} m high` : ""}`;
}

/** A term of a condition, with its value and what there is where it does not hold. */
function termRow(term) {
    const mark = el("span", { className: term.holds ? "holds" : "fails", role: "img", "aria-label": term.holds ? "holds" : "does not hold" }, term.holds ? "✓" : "✗");
    if (term.kind !== "word") {
        return el("li", {}, mark, ` ${term.kind === "all" ? "all of" : "one of"}`, el("ul", { className: "terms" }, sortedTerms(term.terms).map(termRow)));
    }
    const said = [term.measure, term.note].filter(Boolean).join("; ");
    return el("li", {}, mark, " ", el("code", {}, term.text), said ? el("span", { className: "faint" }, ` ${said}`) : null);
}

/** Terms that do not hold come first. */
function sortedTerms(terms) {
    return [...terms.filter((t) => !t.holds), ...terms.filter((t) => t.holds)];
}

/** A transition out of the state, and the terms that it waits for. */
function transitionRow(t) {
    const file = t.file.split("/").pop();
    const missing = t.fires ? "fires next" : t.misses === 0 ? "" : t.misses === 1 ? "one term is missing" : `${t.misses} terms are missing`;
    const terms = !t.when ? [] : t.when.kind === "all" ? sortedTerms(t.when.terms) : [t.when];
    return el("div", { className: "transition" },
        el("p", {}, el("strong", {}, t.to ? `→ ${t.back ? "back, to " : ""}${t.to}` : "reaction"), el("span", { className: "faint" }, ` ${file}:${t.line} ${missing}`)),
        el("ul", { className: "terms" }, terms.map(termRow),
            t.function ? el("li", {}, "a function: ", el("span", { className: "faint" }, t.function)) : null,
            t.chance_note ? el("li", {}, el("span", { className: "faint" }, t.chance_note)) : null));
}

const FEW = 3; // more messages are folded
let unfolded = false;

/** The messages that wait, the oldest first. */
function messageRows(texts) {
    const rows = texts.map((text) => el("p", { className: "faint" }, `message ${text}`));
    if (rows.length <= FEW) return rows;
    return el("details", { open: unfolded, ontoggle: (event) => (unfolded = event.target.open) },
        el("summary", {}, `${rows.length} messages wait, the oldest: ${texts[0]}`), rows);
}

/** What the person waits for: every transition out of its state, the nearest to firing first. */
function whyRows(why) {
    if (!why) return [el("p", { className: "faint" }, "It has no behaviour.")];
    const messages = messageRows(why.messages);
    const deeds = why.does.map((text) => el("p", { className: "faint" }, text));
    const last = why.transitions.some((t) => t.to) ? null : el("p", { className: "faint" }, "Nothing leads out of this state.");
    return [messages, deeds, why.transitions.map(transitionRow), last];
}

/** Shows named values in `list`, or hides `part`, which has the list, if there are none. */
function showValues(part, list, values = {}) {
    const entries = Object.entries(values);
    part.hidden = entries.length === 0;
    fill(list, entries.map(([name, value]) => [el("dt", {}, name), el("dd", {}, typeof value === "number" ? figure(value) : String(value))]));
}

export class AgentPage {
    /** `page`: {letGo(), find(text), recorded()} */
    constructor(node, page) {
        this.node = node;
        this.page = page;
        this.id = null;
        this.none();
    }

    none(text = "Click a person in the picture, or give the picture the focus and press Enter.") {
        this.id = null;
        fill(this.node, el("p", { className: "faint" }, text), this.page.recorded() ? null : this.finder());
    }

    /** A field that chooses a person by id, or the one who has been longest in a state or of a group. */
    finder() {
        const field = el("input", { type: "search", placeholder: "17, a state, a group", "aria-label": "Find a person by id, state or group" });
        const submit = (event) => {
            event.preventDefault();
            if (field.value.trim()) this.page.find(field.value.trim());
        };
        return el("form", { className: "row", onsubmit: submit }, field, el("button", {}, "Find"));
    }

    /** Takes an `inspect` message. */
    take(message) {
        const agent = message.agent;
        if (!agent) {
            if (this.id !== null) this.none("This person is gone. Click another one.");
            return;
        }
        if (this.id !== agent.id) this.build(agent);
        const speed = Math.hypot(agent.vx, agent.vy);
        fill(this.state, pairs([
            ["state", `${agent.state}, for ${amount(agent.since, "s")}`],
            ["machine", agent.machine],
            ["group", agent.group ?? "–"],
            ["place", placeText(agent)],
            ["speed", amount(speed, "m/s")],
            ["radius, mass", `${figure(agent.radius)} m, ${figure(agent.mass)} kg`],
            ...torsoRows(agent.torso),
            ...(agent.holds ? [["holds", agent.holds]] : []),
            ...(agent.held_by ? [["held by", `agent ${agent.held_by.join(", ")}`]] : []),
            ...(agent.fallen ? [["lies since its fall", `for ${amount(agent.fallen, "s")}`]] : []),
            ["compression", amount(message.compression, "N/m")],
            ["load from one side", amount(message.load, "N")],
        ]));
        this.failed.hidden = !message.failed;
        fill(this.last, message.last ? [
            el("p", {}, el("strong", {}, message.last.from ? `${message.last.from} → ${message.last.to} at ${clock(message.last.time)}` : `In ${message.last.to} since ${clock(message.last.time)}`),
                message.last.from ? null : ", which was before it was looked at"),
            message.last.why ? el("code", { className: "code" }, message.last.why) : null,
        ] : el("p", { className: "faint" }, "None since it was chosen."));
        fill(this.why, whyRows(message.why));
        drawVelocities(this.picture, message);
        this.unseen.hidden = message.max_speed > 0 || (message.planes ?? []).length > 0;
        fill(this.planes, Object.entries(KINDS).map(([kind, name]) => {
            const n = (message.planes ?? []).filter((p) => p.kind === kind).length;
            return n ? el("li", {}, swatch(PLANE_COLOURS[kind]), `${name}: ${n}`) : null;
        }));
        fill(this.forces, (message.forces ?? []).map((f) => el("li", {}, swatch(FORCE_COLOURS[f.kind] ?? "#999999"),
            `${f.kind} ${amount(Math.hypot(f.fx, f.fy), "N")}`)));
        this.noForce.hidden = (message.forces ?? []).length > 0;
        fill(this.parameters, (message.parameters ?? []).map((p) => [
            el("dt", {}, p.name), el("dd", {}, `${figure(p.value)} `, el("span", { className: "faint" }, p.set ?? ""))]));
        showValues(this.memoryPart, this.memory, message.memory);
        showValues(this.ownPart, this.own, message.own);
    }

    /** Takes a `who` message: which person of the recorded run is in a slot. */
    takeWho(message) {
        this.who = message;
    }

    /** Takes a person of a recording: {slot, time, state, group, x, y, storey, height, speed, radius, torso}. */
    takeSeen(seen) {
        this.id = `slot ${seen.slot}`;
        const who = this.who?.slot === seen.slot && this.who.id >= 0 ? this.who : null;
        fill(this.node, el("div", { className: "row" }, el("h2", {}, "Person"), el("button", { type: "button", onclick: () => this.page.letGo() }, "Let go")),
            pairs([["state", seen.state ?? "–"], ["group", seen.group ?? "–"], ["place", placeText(seen)],
                ["speed", `${figure(seen.speed)} m/s`], ["radius", `${figure(seen.radius)} m`], ...torsoRows(seen.torso), ...(who ? [["agent", String(who.id)]] : [])]),
            who ? el("p", { className: "faint" }, "Why it stays, a new run of the scene tells: ",
                el("code", {}, `jostle why ${who.scene ?? "SCENE"} --agent ${who.id} --at ${Number(seen.time.toFixed(2))}`)) : null);
    }

    build(agent) {
        this.id = agent.id;
        this.state = el("div");
        this.failed = el("p", { hidden: true, className: "warning" },
            "No velocity satisfies all half-planes: the one that violates them least was taken.");
        this.last = el("div");
        this.why = el("div", { className: "why" });
        this.picture = svg("svg", { class: "velocity", role: "img", "aria-label": "Velocities: forbidden half-planes, the preferred and the chosen one" });
        this.unseen = el("p", { className: "faint" }, "Known from the next step on.");
        this.planes = el("ul", { className: "key" });
        this.forces = el("ul", { className: "key" });
        this.noForce = el("p", { className: "faint" }, "No force acts.");
        this.parameters = el("dl", { className: "pairs" });
        this.memory = el("dl", { className: "pairs" });
        this.memoryPart = el("div", {}, el("h2", {}, "Memory"), this.memory);
        this.own = el("dl", { className: "pairs" });
        this.ownPart = el("div", {}, el("h2", {}, "Own values"), this.own);
        fill(this.node,
            el("div", { className: "row" }, el("h2", {}, `Agent ${agent.id}`), el("button", { type: "button", onclick: () => this.page.letGo() }, "Let go")),
            this.finder(), this.state, this.failed,
            el("h2", {}, "Why it stays"), this.why,
            el("h2", {}, "Last transition"), this.last,
            el("h2", {}, "Velocities, m/s"), this.picture, this.unseen,
            el("p", { className: "faint" }, "Shaded: forbidden. Dashed: preferred, and the greatest speed. Solid: chosen."), this.planes,
            el("h2", {}, "Forces"), this.forces, this.noForce, this.memoryPart, this.ownPart, el("h2", {}, "Parameters"), this.parameters);
    }
}

/** The text for screen readers when a person is chosen. */
export function announce(node, agent) {
    say(node, agent ? `Agent ${agent.id}, ${agent.state}` : "");
}
