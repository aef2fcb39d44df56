// What a person gives the agent that they drive: a direction and a button, by keys (WASD or arrows, Space), a gamepad or
// touch, relative to the camera.

const KEYS = {
    w: [0, 1], arrowup: [0, 1], s: [0, -1], arrowdown: [0, -1],
    a: [-1, 0], arrowleft: [-1, 0], d: [1, 0], arrowright: [1, 0],
};

export class Player {
    /** `page`: {view, connection} */
    constructor(page) {
        this.page = page;
        this.ids = [];
        this.id = null;
        this.on = false;
        this.speed = 3; // m/s
        this.uses = false; // whether the scene's game has a use for the button
        this.held = new Set(); // keys
        this.half = false; // Shift is held
        this.sticks = new Map(); // by source: {right, up: -1 to 1, button}
        this.sent = "";
        window.addEventListener("blur", () => this.letGo());
    }

    set(ids) {
        this.ids = ids ?? [];
        if (!this.ids.includes(this.id)) this.id = this.ids[0] ?? null;
        if (this.id === null) this.on = false;
    }

    /** Takes over the agent at the beginning of a run: from now on the machine leaves it to the person. */
    join() {
        this.sent = "";
        this.send();
    }

    /** True if the key is the player's. */
    key(event, down) {
        const key = event.key.toLowerCase();
        const mine = KEYS[key] || (this.uses && key === " ");
        if (!this.on || this.id === null || !mine || event.ctrlKey || event.metaKey || event.altKey) return false;
        if (down) this.held.add(key);
        else this.held.delete(key);
        this.half = event.shiftKey;
        this.send();
        return true;
    }

    /** Takes the state of a stick and a button, from a gamepad or from touch. */
    stick(source, right, up, button) {
        this.sticks.set(source, { right, up, button });
        if (this.on) this.send();
    }

    letGo() {
        this.held.clear();
        this.sticks.clear();
        if (this.on) this.send();
    }

    /** Returns what is wanted in the picture: right and up, together at most 1, and whether the button is held. */
    wanted() {
        let right = 0, up = 0, button = this.held.has(" ");
        for (const key of this.held) {
            right += KEYS[key]?.[0] ?? 0;
            up += KEYS[key]?.[1] ?? 0;
        }
        const length = Math.max(1, Math.hypot(right, up)), part = this.half ? 0.5 : 1;
        [right, up] = [(part * right) / length, (part * up) / length];
        for (const stick of this.sticks.values()) {
            button ||= stick.button;
            if (Math.hypot(stick.right, stick.up) > Math.hypot(right, up)) [right, up] = [stick.right, stick.up];
        }
        return { right, up, button };
    }

    /** Sends the wanted velocity and the button, if they changed. */
    send() {
        const { right, up, button } = this.wanted();
        const m = this.page.view.camera.matrixWorld.elements; // its first column points right
        const flat = Math.hypot(m[0], m[1]) || 1, x = m[0] / flat, y = m[1] / flat;
        const round = (v) => Number(v.toFixed(2)) || 0; // m/s, so that a trembling stick does not fill the log
        const vx = round(this.speed * (right * x - up * y)), vy = round(this.speed * (right * y + up * x));
        const words = this.uses ? [vx, vy, Number(button)] : [vx, vy], line = `${this.id} ${words.join(" ")}`;
        if (line === this.sent || this.id === null) return;
        if (this.page.connection.input("player", this.id, ...words)) this.sent = line;
    }
}
