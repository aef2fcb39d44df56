// Actions besides the tools: gates, signals, the size of boxes, a player.
import { el, fill, say } from "../dom.js";

export class ActPage {
    /** `page`: {connection, player, playing()} */
    constructor(node, page) {
        this.node = node;
        this.page = page;
        this.size = el("input", { type: "number", min: 0.1, max: 3, step: 0.1, value: 0.4 });
        this.mass = el("input", { type: "number", min: 0.1, max: 1000, step: "any", value: 20 });
        this.gates = new Map();
        this.shown = "";
    }

    /** Returns size (edge, m) and mass (kg) of the next box. */
    box() {
        const within = (input, fallback) => {
            const v = Number(input.value);
            return v > 0 && Number.isFinite(v) ? Math.min(Number(input.max), Math.max(Number(input.min), v)) : fallback;
        };
        return { size: within(this.size, 0.4), mass: within(this.mass, 20) };
    }

    /** Shows the actions that a scene offers; returns false if there are none. */
    set(scene) {
        const tools = scene.tools ?? {};
        this.page.player.set(tools.players);
        const offered = { gates: tools.gates ? tools.walls ?? [] : [], signals: tools.signals ? tools.signal_names ?? [] : [],
            throw: Boolean(tools.throw), players: tools.players ?? [] };
        const any = offered.gates.length + offered.signals.length + offered.players.length > 0 || offered.throw;
        const same = JSON.stringify(offered);
        if (same === this.shown) return any;
        this.shown = same;
        this.gates.clear();
        fill(this.node, this.gatePart(offered.gates), this.signalPart(offered.signals),
            this.playerPart(offered.players), offered.throw ? this.boxPart() : null);
        return any;
    }

    gatePart(names) {
        if (names.length === 0) return [];
        return [el("h2", {}, "Gates"), names.map((name) => {
            const state = el("span", { className: "faint" });
            const button = el("button", { type: "button", onclick: () => this.turn(name) }, "Open");
            button.setAttribute("aria-label", `Open ${name}`);
            this.gates.set(name, { button, state, open: false });
            return el("div", { className: "row" }, button, el("strong", {}, name), state);
        })];
    }

    turn(name) {
        const gate = this.gates.get(name);
        this.page.connection.input(gate.open ? "close" : "open", name);
    }

    /** Sets which gates are open. */
    takeGates(open) {
        for (const [name, gate] of this.gates) {
            if (!(name in (open ?? {}))) continue;
            gate.open = Boolean(open[name]);
            say(gate.button, gate.open ? "Close" : "Open");
            gate.button.setAttribute("aria-label", `${gate.open ? "Close" : "Open"} ${name}`);
            say(gate.state, gate.open ? "is open" : "is closed");
        }
    }

    signalPart(names) {
        if (names.length === 0) return [];
        return [el("h2", {}, "Signals"), el("p", { className: "faint" }, "Everybody hears it in the next step."),
            el("div", { className: "row" }, names.map((name) => el("button", { type: "button",
                onclick: () => this.page.connection.input("signal", name) }, name)))];
    }

    playerPart(ids) {
        if (ids.length === 0) return [];
        const player = this.page.player;
        this.drive = el("button", { type: "button", "aria-pressed": "false", onclick: () => this.play(!player.on) }, "Drive with the keys");
        const speed = el("input", { type: "range", min: 0.5, max: 5, step: 0.5, value: player.speed, oninput: () => {
            player.speed = Number(speed.value);
            say(shown, `${player.speed} m/s`);
        } });
        const shown = el("span", { className: "faint" }, `${player.speed} m/s`);
        const choice = el("select", { onchange: () => {
            player.letGo();
            player.id = Number(choice.value);
        } }, ids.map((id) => el("option", { value: String(id) }, `agent ${id}`)));
        return [el("h2", {}, "Player"), el("div", { className: "row" }, this.drive, ids.length > 1 ? el("label", {}, "Who", choice) : null),
            el("div", { className: "row" }, el("label", {}, "Speed", speed), shown),
            el("p", { className: "faint" }, "W A S D or the arrow keys, as the picture is turned; Shift walks at half the speed; Escape ends.")];
    }

    play(on) {
        const player = this.page.player;
        if (!on) player.letGo();
        player.on = on;
        this.drive?.setAttribute("aria-pressed", String(on));
        this.page.playing(on);
    }

    boxPart() {
        return [el("h2", {}, "Boxes to throw"), el("div", { className: "row" },
            el("label", {}, "Edge, m", this.size), el("label", {}, "Mass, kg", this.mass))];
    }
}
